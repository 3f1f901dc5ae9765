"""Names for recurring sub-expressions of long formulas: h = m₂ l₁ l_c2 s₂.

A sum that stands in several places is named once, whichever its sign; so is a part
of several sums; so is a product.  Names build on each other, the inner ones first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations
from math import gcd, lcm

from msgspec import Struct

from dynsolve.notation.build import cost, negated, split_sign, times, total
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    children,
    with_children,
)

SHORTEST_SUM = 5
"""The operations from which on a recurring sum is worth a name."""

SHORTEST_PRODUCT = 4
"""The operations from which on a recurring product is worth a name: m₂ l₁ l_c2 s₂."""

LEAST_SAVED = 12
"""The operations that a name in a long model saves, at least: below that it is one more to look up."""

_GLANCE = 3
"""The operations below which a meaning is read as quickly as its name, however often it stands."""

ROUNDS = 8
"""How often parts that sums share are looked for; each round finds those that do not overlap."""

_Key = frozenset[Node]


class Definition(Struct, frozen=True):
    """name = meaning"""

    name: Symbol
    meaning: Node


def name_recurring(
    entries: Sequence[Node], names: Iterator[Symbol], *, whole: bool = True, decimal: bool = False
) -> tuple[tuple[Definition, ...], list[Node]]:
    """(definitions in order of dependence, the entries in which they are used).

    Entries that are equal but for sign count once; with `whole` false they count each,
    so that what several entries consist of gets a name.  A `whole` model is a long one, in
    which a name must save more.  `decimal` says that numbers are decimals.

    >>> from dynsolve.notation.python import to_python
    >>> m, l, r, q, I = map(Symbol, ("m", "l", "r", "q", "I"))
    >>> product = Product((m, l, r, Function("sin", q)))
    >>> entries = [Negative(product), Sum((I, product))]
    >>> definitions, used = name_recurring(entries, iter([Symbol("h")]), whole=False)
    >>> to_python(definitions[0].meaning)
    'm*l*r*sin(q)'
    >>> list(map(to_python, used))
    ['-h', 'I + h']
    """
    sharing = _Sharing(decimal)
    roots = [sharing.intern(entry) for entry in entries]
    sharing.share_parts()
    roots = sharing.united(roots)
    uses = sharing.uses(dict.fromkeys(split_sign(r)[1] for r in roots) if whole else roots)
    writer = _Writer(sharing.terms, uses, names, decimal, LEAST_SAVED if whole else 0)
    used = [writer.write(root) for root in roots]
    return tuple(writer.definitions), used


class _Sharing:
    """Sums and products as nodes of a graph in which equal ones, but for sign, are one."""

    def __init__(self, decimal: bool) -> None:
        self.decimal = decimal
        self.sums: dict[_Key, Symbol] = {}
        self.terms: dict[Symbol, tuple[Node, ...]] = {}
        self._order: dict[Symbol, int] = {}
        self._costs: dict[int, tuple[Node, int]] = {}
        self._multiples = Multiples(decimal)
        self.intern: Callable[[Node], Node] = cache(self._interned)

    # -- reading -----------------------------------------------------------------------------------

    def _interned(self, node: Node) -> Node:
        """The node with a placeholder for every sum in it."""
        match node:
            case Sum(parts):
                return self.placeholder([self.intern(part) for part in parts])
            case Product(parts):
                return times(1, [(self.intern(part), 1) for part in parts], decimal=self.decimal)
            case Negative(part):
                return negated(self.intern(part))
            case Power(base, exponent):
                sign, inner = split_sign(self.intern(base))
                odd = isinstance(exponent, Number) and exponent.p % 2
                return Negative(Power(inner, exponent)) if sign < 0 and odd else Power(inner, exponent)
            case Quotient(numerator, denominator):
                sign, inner = split_sign(self.intern(numerator))
                quotient = Quotient(inner, denominator)
                return Negative(quotient) if sign < 0 else quotient
        return node

    def placeholder(self, terms: Sequence[Node]) -> Node:
        """± the placeholder of a sum."""
        key = frozenset(terms)
        found = self._known(key) or self._multiples.found(map(_monomial, terms))
        if found is not None:
            return found
        flip = sum(isinstance(t, Negative) for t in terms) * 2 > len(terms)
        name = Symbol(f" {len(self.terms)}")
        self.sums[_opposite(key) if flip else key] = name
        self._order[name] = len(self.terms)
        self.terms[name] = tuple(map(negated, terms)) if flip else tuple(terms)
        self._multiples.add(name, self.terms[name])
        return Negative(name) if flip else name

    def _known(self, key: _Key) -> Node | None:
        if key in self.sums:
            return self.sums[key]
        opposite = self.sums.get(_opposite(key))
        return None if opposite is None else Negative(opposite)

    # -- parts that sums share ---------------------------------------------------------------------

    def share_parts(self) -> None:
        """Give a placeholder to every part of two terms or more that stands in several sums."""
        for _ in range(ROUNDS):
            if not self._share_round():
                return

    def _share_round(self) -> bool:
        holders: dict[_Key, set[Symbol]] = {}
        for shared, both in self._common_parts():
            holders.setdefault(shared, set()).update(both)
        gains = {part: self._gain(part, len(held)) for part, held in holders.items()}
        changed = False
        for part in sorted(gains, key=lambda p: -gains[p]):
            if gains[part] <= 0:
                break
            users = [name for name in holders[part] if self._holds(name, part)]
            if self._gain(part, len(users) + (self._known(part) is not None)) > 0:
                self._put(part, sorted(users, key=self._order.__getitem__))
                changed = True
        return changed

    def _common_parts(self) -> Iterator[tuple[_Key, tuple[Symbol, Symbol]]]:
        """The common part of two sums, up to its sign, together with the two."""
        by_term: dict[Node, list[Symbol]] = {}
        for name, terms in self.terms.items():
            for term in terms:
                by_term.setdefault(split_sign(term)[1], []).append(name)
        meeting: Counter[tuple[Symbol, Symbol]] = Counter()
        for names in by_term.values():
            meeting.update(combinations(names, 2))
        for (a, b), count in meeting.items():
            if count < 2:
                continue
            left, right = frozenset(self.terms[a]), frozenset(self.terms[b])
            for other in (right, _opposite(right)):
                shared = left & other
                if len(shared) > 1:
                    yield _canonical(shared), (a, b)

    def _gain(self, part: _Key, users: int) -> int:
        size = sum(cost(split_sign(term)[1], self._costs) for term in part) + len(part) - 1
        return (users - 1) * size - 2 if size >= SHORTEST_SUM else 0

    def _holds(self, name: Symbol, part: _Key) -> bool:
        terms = frozenset(self.terms[name])
        return len(part) < len(terms) and (part <= terms or _opposite(part) <= terms)

    def _put(self, part: _Key, users: Sequence[Symbol]) -> None:
        """The placeholder of a part in the sums that hold it, its terms in the order of the first of them."""
        order = [split_sign(term)[1] for term in self.terms[users[0]]]
        whole = self.placeholder(sorted(part, key=lambda term: order.index(split_sign(term)[1])))
        for name in users:
            terms = self.terms[name]
            mine = part if part <= frozenset(terms) else _opposite(part)
            one = whole if mine == part else negated(whole)
            self.terms[name] = exchanged(terms, mine, one)

    # -- products that are sums by themselves ------------------------------------------------------

    def united(self, roots: Sequence[Node]) -> list[Node]:
        """The entries with c (a s + b c) as a s c + b c², where that has a placeholder; the sums, too.

        Then the smallest of the multiples of a sum is what its placeholder stands for: 2σ, and no σ/2.
        """

        def multiplied(node: Node) -> Node | None:
            return self._multiples.in_product(node, self.terms) if isinstance(node, Product) else None

        roots = self._everywhere(multiplied, roots)
        smallest = self._multiples.smallest

        def scaled(node: Node) -> Node | None:
            match node:
                case Symbol() if node in smallest:
                    return times(1 / smallest[node], [(node, 1)], decimal=self.decimal)
                case Power(Symbol() as name, Number(p, 1)) if name in smallest:
                    return times(1 / smallest[name] ** p, [(name, p)], decimal=self.decimal)
                case Product(factors) if any(map(scaled, factors)):
                    parts = [(scaled(factor) or factor, 1) for factor in factors]
                    return times(1, parts, decimal=self.decimal)
                case Quotient(numerator, Number(p, q)) if whole := scaled(numerator):
                    return times(Fraction(q, p), [(whole, 1)], decimal=self.decimal)
            return None

        roots = self._everywhere(scaled, roots)
        for name, part in smallest.items():
            terms = self.terms[name]
            self.terms[name] = tuple(times(part, [(term, 1)], decimal=self.decimal) for term in terms)
        return roots

    def _everywhere(self, change: Callable[[Node], Node | None], roots: Sequence[Node]) -> list[Node]:
        """The sums changed where `change` has something for a part, and so the entries."""

        @cache
        def put(node: Node) -> Node:
            found = change(node)
            if found is None:
                found = node if isinstance(node, Function) else with_children(node, put)
            return found

        for name, terms in self.terms.items():
            self.terms[name] = tuple(map(put, terms))
        return [put(root) for root in roots]

    def uses(self, roots: Iterable[Node]) -> Counter[Node]:
        """How often each sum and product stands in the entries and in the distinct sums."""
        uses: Counter[Node] = Counter()
        pending = list(roots)
        met: set[Node] = set()
        while pending:
            node = split_sign(pending.pop())[1]
            if isinstance(node, Symbol) and node not in self.terms:
                continue
            uses[node] += 1
            if node in met:
                continue
            met.add(node)
            if not isinstance(node, Function):  # nothing in an angle gets a name
                pending.extend(self.terms[node] if isinstance(node, Symbol) else children(node))
        return uses


class _Writer:
    """Puts sums back, or names for them."""

    def __init__(
        self,
        terms: Mapping[Symbol, tuple[Node, ...]],
        uses: Mapping[Node, int],
        names: Iterator[Symbol],
        decimal: bool,
        least: int,
    ) -> None:
        self.terms, self.uses, self.names, self.decimal, self.least = terms, uses, names, decimal, least
        self.definitions: list[Definition] = []
        self.write: Callable[[Node], Node] = cache(self._written)

    def _written(self, node: Node) -> Node:
        match node:
            case Symbol():
                if node not in self.terms:
                    return node
                return self._named(node, total([self.write(t) for t in self.terms[node]]), SHORTEST_SUM)
            case Negative(part):
                return times(-1, [(self.write(part), 1)], decimal=self.decimal)
            case Product(parts):
                whole = times(1, [(self.write(part), 1) for part in parts], decimal=self.decimal)
                return self._named(node, whole, SHORTEST_PRODUCT)
            case Power(base, exponent):
                return Power(self.write(base), exponent)
            case Quotient(numerator, denominator):
                return Quotient(self.write(numerator), denominator)
        return node

    def _named(self, node: Node, meaning: Node, shortest: int) -> Node:
        """The name of a meaning that is used often enough and more than a glance, else the meaning."""
        uses, size = self.uses.get(node, 0), cost(meaning)
        saves = size >= _GLANCE and (uses - 1) * size >= self.least
        if not (saves if self.least else uses > 1 and size >= shortest):
            return meaning
        name = next(self.names)
        self.definitions.append(Definition(name, meaning))
        return name


def _opposite(part: _Key) -> _Key:
    return frozenset(map(negated, part))


def _canonical(part: _Key) -> _Key:
    """The part or its opposite, the same for both."""
    opposite = _opposite(part)
    minus = sum(isinstance(t, Negative) for t in part)
    if 2 * minus != len(part):
        return opposite if 2 * minus > len(part) else part
    return min(part, opposite, key=lambda p: sorted(map(repr, p)))


def exchanged(terms: Sequence[Node], part: Collection[Node], one: Node) -> tuple[Node, ...]:
    """Terms with one in the place of the first of a part of them, and without the others of it."""
    place = next(i for i, term in enumerate(terms) if term in part)
    return (*terms[:place], one, *(term for term in terms[place:] if term not in part))


def rewritten(node: Node, leaf: Callable[[Node], Node]) -> Node:
    """A tree of sums, products and quotients, what these are made of changed, added and multiplied anew.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> h = Symbol("h")
    >>> half = Negative(Quotient(h, Number(2)))
    >>> to_unicode(rewritten(half, lambda leaf: Negative(h) if leaf == h else leaf))
    'h/2'
    """
    match node:
        case Sum(terms):
            return total([rewritten(term, leaf) for term in terms])
        case Negative(argument):
            return negated(rewritten(argument, leaf))
        case Product(factors):
            return times(1, [(rewritten(factor, leaf), 1) for factor in factors])
        case Quotient(numerator, denominator):
            return times(1, [(rewritten(numerator, leaf), 1), (rewritten(denominator, leaf), -1)])
    return leaf(node)


def expanded_once(definitions: Sequence[Definition], node: Node) -> Node:
    """A tree with the meanings put in for the names that stand in it, as they were defined."""
    meanings: dict[Node, Node] = {definition.name: definition.meaning for definition in definitions}

    def put(part: Node) -> Node:
        return meanings.get(part, part) if isinstance(part, Symbol) else with_children(part, put)

    return put(node)


def expanded(definitions: Sequence[Definition], nodes: Sequence[Node]) -> list[Node]:
    """Trees with the meanings put back for the names; what recurs is shared and not repeated."""
    meanings: dict[Node, Node] = {}

    @cache
    def put(node: Node) -> Node:
        return meanings.get(node, node) if isinstance(node, Symbol) else with_children(node, put)

    for definition in definitions:
        meanings[definition.name] = put(definition.meaning)
    return [put(node) for node in nodes]


# -- sums that are multiples of each other: 4κ s c + m = 2 (2κ s c + m/2), and c (2κ s + m c) = 2κ s c + m c²
# Sums are compared as polynomials in what their terms are products of.

_Monomial = frozenset[tuple[Node, int]]
_Primitive = frozenset[tuple[_Monomial, Fraction]]

LONGEST = 6
"""Up to this number of terms a sum is multiplied out: a longer one is no part of a product that recurs."""


class Multiples:
    """The sums that have a placeholder, up to rational factors."""

    def __init__(self, decimal: bool) -> None:
        self.decimal = decimal
        self._known: dict[_Primitive, tuple[Symbol, Fraction]] = {}
        self.smallest: dict[Symbol, Fraction] = {}
        """Of a placeholder of which there is a part, ½ of it or less, the smallest."""

    def add(self, name: Symbol, terms: Sequence[Node]) -> None:
        """Remember what a placeholder stands for."""
        key, content = _primitive(map(_monomial, terms))
        self._known.setdefault(key, (name, content))

    def found(self, terms: Iterable[tuple[_Monomial, Fraction]]) -> Node | None:
        """A sum as a rational multiple of one that has a placeholder."""
        key, content = _primitive(terms)
        for sign in (1, -1):
            known = self._known.get(key if sign > 0 else frozenset((mono, -f) for mono, f in key))
            if known is not None:
                name, own = known
                if content < own:
                    self.smallest[name] = min(content / own, self.smallest.get(name, Fraction(1)))
                return times(sign * content / own, [(name, 1)], decimal=self.decimal)
        return None

    def in_product(self, product: Product, terms: dict[Symbol, tuple[Node, ...]]) -> Node | None:
        """A product of a sine or cosine and a sum as the placeholder of both, multiplied out."""
        factors = flat_factors(product)
        angles = [factor for factor in factors if isinstance(factor, Function)]
        sums = [factor for factor in factors if isinstance(factor, Symbol) and factor in terms]
        for name in sums:
            if len(terms[name]) > LONGEST:
                continue
            for angle in angles:
                both = self.found((_times(mono, angle), f) for mono, f in map(_monomial, terms[name]))
                if both is not None:
                    rest = list(factors)
                    rest[rest.index(name)] = both
                    rest.remove(angle)
                    return times(1, [(factor, 1) for factor in rest], decimal=self.decimal)
        return None


def _primitive(terms: Iterable[tuple[_Monomial, Fraction]]) -> tuple[_Primitive, Fraction]:
    """(terms with coprime whole factors, what they were divided by)"""
    found = list(terms)
    content = Fraction(gcd(*(f.numerator for _, f in found)), lcm(*(f.denominator for _, f in found)))
    return frozenset((mono, f / content) for mono, f in found), content


def _monomial(term: Node) -> tuple[_Monomial, Fraction]:
    sign, inner = split_sign(term)
    number = Fraction(sign)
    if isinstance(inner, Quotient) and isinstance(inner.denominator, Number):
        number /= Fraction(inner.denominator.p, inner.denominator.q)
        inner = inner.numerator
    exponents: dict[Node, int] = {}
    for factor in flat_factors(inner):
        match factor:
            case Number(p, q):
                number *= Fraction(p, q)
            case Power(base, Number(p, 1)):
                exponents[base] = exponents.get(base, 0) + p
            case _:
                exponents[factor] = exponents.get(factor, 0) + 1
    return frozenset(exponents.items()), number


def _times(mono: _Monomial, factor: Node) -> _Monomial:
    exponents = dict(mono)
    exponents[factor] = exponents.get(factor, 0) + 1
    return frozenset(exponents.items())
