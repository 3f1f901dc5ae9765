"""Names in a short model: for moments of inertia that come up again and again, and Christoffel symbols.

The kinetic energy of an arm with bodies of many parts has long sums of masses and lengths as factors:

    m₂ (4l₂² - b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12) + m₄ d₃²

Each stands in L, in momenta, forces, D, C and the summary.  It is named where it is met first
(`explain.named_steps`), with its derivative where a joint that slides changes it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import AlgebraError
from dynsolve.explain.abbreviations import (
    RECURRING,
    WITH_RATES,
    Abbreviated,
    Exchange,
    Index,
    InertiaNames,
    as_shown,
    free_names,
    free_single,
    short_names_taken,
    symbols_put,
)
from dynsolve.explain.context import is_short
from dynsolve.explain.entry_formulas import collected, coriolis_matrix
from dynsolve.explain.forms import Forms
from dynsolve.explain.named_steps import introduced
from dynsolve.explain.recurring import Definition, expanded
from dynsolve.notation.build import cost, negated, split_sign, summands, times, total
from dynsolve.notation.differentiation import by_symbol, differentiated, product_of
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import (
    ZERO,
    Function,
    Matrix,
    Negative,
    Node,
    Sum,
    Symbol,
    children,
    equation,
    mapped,
    walk,
    with_children,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Robot

_OF_COORDINATES = ("dLdqd", "ddt", "dLdq", "tau")
"""What the names of the quantities of each coordinate begin with."""

LEAST_SAVED_BY_SUMS = 80
"""The operations that a name saves in the energies, momenta, forces and D, at least: four lines of text."""

SHORTEST = 4
"""The operations from which on such a sum, or one in its derivative, is worth a name."""


# -- which sums get a name -------------------------------------------------------------------------


def name_inertias(forms: Forms, names: Iterator[Symbol]) -> InertiaNames:
    """Names for the sums by which LEAST_SAVED_BY_SUMS operations are saved; none of robots in numbers."""
    robot = forms.robot
    if robot.is_numeric:
        return InertiaNames()
    of_coordinates = (f"{stem}{q.index}" for q in robot.coordinates for stem in _OF_COORDINATES)
    counted = (name for name in ("K", "D", "Cqd", *of_coordinates) if name in forms.values.rules)
    trees = [forms(name) for name in counted]
    found: list[Definition] = []
    while (best := _worth_a_name(trees)) is not None:
        found.append(Definition(next(names), best))
        trees = [Exchange.of(found[-1]).put(node) for node in trees]
    return _with_slopes(forms, found, names)


def _worth_a_name(trees: Iterable[Node]) -> Sum | None:
    """The sum without sines and rates by which most operations are saved."""
    uses = Counter(part for tree in trees for part in _sums(tree) if not _moves(part))
    saved = {part: (count - 1) * cost(part) for part, count in uses.items() if cost(part) >= SHORTEST}
    best = max(saved, key=lambda part: saved[part], default=None)
    return None if best is None or saved[best] < LEAST_SAVED_BY_SUMS else best


def _sums(node: Node) -> Iterator[Sum]:
    if isinstance(node, Sum):
        yield node
    if not isinstance(node, Function):
        for part in children(node):
            yield from _sums(part)


def _moves(node: Node) -> bool:
    """Whether there are sines or rates in a tree, and not parameters and lengths alone."""
    return any(isinstance(part, Function) or (isinstance(part, Symbol) and part.dots) for part in walk(node))


def _with_slopes(forms: Forms, found: Sequence[Definition], names: Iterator[Symbol]) -> InertiaNames:
    """The names with their derivatives by the coordinates; sums in these have names too."""
    ring = forms.robot.ring
    slopes: list[tuple[Node, Symbol, Node, Node]] = []
    for one, meaning in zip(found, expanded(found, [one.name for one in found]), strict=True):
        value = value_of(ring, meaning)
        for k, by in enumerate(map(Symbol, ring.names)):
            if not (slope := ring.diff(value, k)).is_zero:
                in_letters = letters.partial_derivative(one.name, by)
                slopes.append((in_letters, by, differentiated(meaning, by_symbol(by)).tree, forms.of(slope)))
    sums = (part for *_, written in slopes for part in walk(written) if isinstance(part, Sum))
    long = (part for part in dict.fromkeys(sums) if cost(part) >= SHORTEST)
    definitions = (*found, *(Definition(name, part) for part, name in zip(long, names, strict=False)))
    named = InertiaNames(definitions, (), tuple(map(Exchange.of, definitions)))
    equal: dict[Node, list[Node]] = {}
    exchanges = list(named.exchanges)
    for name, by, termwise, written in slopes:
        short, rate = named.put(written), Symbol(by.name, 1)
        equal.setdefault(short, []).append(name)
        pairs = ((termwise, short), (_times(termwise, rate), _times(short, rate)))
        exchanges += [Exchange(written, form) for written, form in pairs if isinstance(written, Sum)]
    return InertiaNames(
        definitions,
        tuple(equation(*left, right) for right, left in equal.items()),
        tuple(exchanges),
        frozenset(ring.names.index(by.name) + 1 for _, by, _, _ in slopes),
    )


def _times(node: Node, rate: Symbol) -> Node:
    """The terms of a sum times a rate, as the chain rule has them."""
    return total([product_of(1, [(term, 1), (rate, 1)]) for term in summands(node)])


# -- names for what Christoffel symbols are: h of the planar elbow, or σ₁, σ₂,  --------------------
# Symbols are equal, or opposite, again and again: c_112 = -c_121.  Where all are one value but for its sign,
# that is the books' h (Spong, Hutchinson, Vidyasagar, section 7.4).  Otherwise they get names where C would
# fill half a page; C, Ḋ and N = Ḋ - 2C are then short sums of names and rates.
#
# What recurs in the energies already is named there, and the symbols are written by that.

LONG_CORIOLIS = 50
"""The operations of C from which on its symbols get names: it would not fit the page as a matrix."""


def name_symbols(forms: Forms) -> Abbreviated | None:
    """The model with names for its Christoffel symbols, and for long sums of masses and lengths in it.

    None where it is short without, or the arm longer.
    """
    robot, C = forms.robot, forms("C")
    if not is_short(robot, forms) or not isinstance(C, Matrix):
        return None
    taken = short_names_taken(robot)
    free = free_names(RECURRING, taken)
    inertias = name_inertias(forms, free)

    def form(value: Expr) -> Node:
        return inertias.put(forms.of(value))

    D, g = inertias.put(forms("D")), inertias.put(forms("g"))
    assert isinstance(D, Matrix) and isinstance(g, Matrix)
    values: Mapping[Index, Expr] = forms.values["christoffel"]
    order = [values[key] for key in as_shown(values)]
    definitions: Sequence[Definition] = ()
    made: dict[Expr, Node] = {}
    if (single := free_single(taken)) and _is_one_value(forms, values):
        first = next(value for value in order if not value.is_zero)  # it has a plus
        definitions = (Definition(single, form(first)),)
        made = {first: single, -first: Negative(single), robot.ring.zero: ZERO}
    elif sum(cost(inertias.put(entry)) for row in C.rows for entry in row) >= LONG_CORIOLIS:
        beside = () if robot.is_numeric else (D, g)  # in numbers 0.48 c₂₃ is a multiple by accident
        namer = _SymbolNames(form, order, free, *beside)
        made, definitions = {value: namer.written(value) for value in order}, namer.definitions
    symbols = {key: made[value] if made else form(value) for key, value in values.items()}
    sums = (*inertias.definitions, *definitions)
    if not sums:
        return None
    names_of_symbols = {one.name for one in definitions if one.name != single}
    named = {value: node for value, node in made.items() if not names_of_symbols.isdisjoint(walk(node))}
    C = coriolis_matrix(robot.ring.names, lambda i, j, k: symbols[min(i, j), max(i, j), k])

    def beside_rates(node: Node) -> Node:
        """With the names where products of rates have them: by their places in the tree, or by values."""
        if isinstance(node, Matrix):
            return with_children(node, beside_rates)
        both = map(inertias.put, (node, _by_products_of_rates(forms, named, node)))
        return min((_symbols_put_by_rates(definitions, each) for each in both), key=cost)

    of_coordinates = (f"{stem}{q.index}" for q in robot.coordinates for stem in _OF_COORDINATES)
    written: dict[str, Node] = {"D": D, "C": C, "g": g}
    for name in ("K", "L", "Cqd", *of_coordinates):
        if name in forms.values.rules:
            has_rates = definitions and WITH_RATES.fullmatch(name)
            written[name] = (beside_rates if has_rates else inertias.put)(forms(name))
    found = Abbreviated((), sums, D, C, g, symbols, inertias=inertias, at_symbols=True, forms=written)
    return _numbered_as_met(robot, found)


def _numbered_as_met(robot: Robot, short: Abbreviated) -> Abbreviated:
    """The same, σ₁ the name that is introduced first, σ₂ the next."""
    numbered = [one.name for one in short.sums if one != short.single]
    met = [one.name for names in introduced(robot, short).values() for one in names]
    met += [name for name in numbered if name not in met]
    if met == numbered:
        return short
    others: dict[Node, Node] = dict(zip(met, numbered, strict=True))

    def put(node: Any) -> Any:
        return mapped(node, lambda part: others.get(part, part))

    def of(definitions: Iterable[Definition]) -> tuple[Definition, ...]:
        return tuple(Definition(put(one.name), put(one.meaning)) for one in definitions)

    inertias = short.inertias
    return replace(
        short,
        sums=of(short.sums),
        D=put(short.D),
        C=put(short.C),
        g=put(short.g),
        christoffel={key: put(node) for key, node in short.christoffel.items()},
        inertias=InertiaNames(
            of(inertias.definitions),
            tuple(map(put, inertias.slopes)),
            tuple(Exchange(put(one.meaning), put(one.name)) for one in inertias.exchanges),
            inertias.by,
        ),
        forms={name: put(node) for name, node in short.forms.items()},
    )


def _symbols_put_by_rates(symbols: Sequence[Definition], node: Node) -> Node:
    """A sum with the names of symbols in the terms with rates."""
    if isinstance(node, Sum):
        return total([_symbols_put_by_rates(symbols, term) for term in node.terms])
    has_rates = any(isinstance(part, Symbol) and part.dots == 1 for part in walk(node))
    return symbols_put(symbols, node) if has_rates else node


_Rates = tuple[tuple[Node, int], ...]
"""A product of two rates: each with its power."""


def _by_products_of_rates(forms: Forms, symbols: Mapping[Expr, Node], node: Node) -> Node:
    """A sum in which multiples of symbols stand by their names beside q̇_i q̇_j.

    They are found by their values, as factors common to several terms may have been taken out of the sum.
    """
    ring = forms.robot.ring
    terms = [(term, _factors_of_rates(ring, term)) for term in summands(node)]
    whole: dict[_Rates, Expr] = {}
    for _, factors in terms:
        for rates, factor in factors.items():
            whole[rates] = whole.get(rates, ring.zero) + factor
    named = {rates: form for rates, factor in whole.items() if (form := _multiple(symbols, factor, rates))}
    written: list[Node] = []
    done: dict[_Rates, tuple[Node, Node]] = {}
    place = 0
    for term, factors in terms:
        met = [rates for rates in whole if rates in factors and rates in named]
        if not met:
            written.append(term)
            continue
        taken = (factors[rates] * value_of(ring, times(1, rates)) for rates in met)
        rest = value_of(ring, term) - sum(taken, start=ring.zero)
        place = place if done else len(written)
        done |= {rates: named[rates] for rates in met}
        if not rest.is_zero:
            written += summands(forms.of(rest))
    return total([*written[:place], collected(done.values()), *written[place:]])


def _factors_of_rates(ring: Ring, term: Node) -> dict[_Rates, Expr]:
    """What stands beside each product of two rates in a term; nothing of one without an exact value."""
    places = [ring.symbol_indices[name, 1] for name in ring.names]
    try:
        poly = value_of(ring, term).poly
    except AlgebraError:
        return {}
    split: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for exponents, number in poly.to_dict().items():
        powers = tuple(int(exponents[i]) for i in places)
        if sum(powers) == 2:
            rest = tuple(0 if i in places else int(e) for i, e in enumerate(exponents))
            split.setdefault(powers, {})[rest] = number
    return {
        tuple((Symbol(name, 1), e) for name, e in zip(ring.names, powers, strict=True) if e): Expr(
            ring, ring.ctx.from_dict(split[powers])
        )
        for powers in sorted(split, reverse=True)
    }


def _multiple(symbols: Mapping[Expr, Node], factor: Expr, rates: _Rates) -> tuple[Node, Node] | None:
    """A symbol that has a name, with its sign, and a number times rates, where that is a factor with them."""
    for value, name in symbols.items():
        ratio = None if value.is_zero else factor.quotient(value)
        if ratio is not None and ratio.is_number and not ratio.is_zero:
            sign = 1 if ratio.number > 0 else -1
            return times(sign, [(name, 1)]), times(sign * ratio.number, rates)
    return None


def _is_one_value(forms: Forms, symbols: Mapping[Index, Expr]) -> bool:
    """Whether several symbols are not zero, all of them the same but for sign, and worth a name."""
    found = [value for value in symbols.values() if not value.is_zero]
    alike = all(value in (found[0], -found[0]) for value in found)
    return len(found) > 1 and alike and cost(forms.of(found[0])) >= SHORTEST


class _SymbolNames:
    """Names symbols; one that has another as factor or part is written by that, one in `beside` has none."""

    def __init__(
        self, form: Callable[[Expr], Node], values: Sequence[Expr], names: Iterator[Symbol], *beside: Node
    ) -> None:
        self.beside = beside
        self.forms: dict[Expr, Node] = {}
        for value in values:
            if value not in self.forms and -value not in self.forms:
                self.forms[value] = form(value)
        self.definitions: list[Definition] = []
        self._names = names
        self._done: dict[Expr, Node] = {}

    def written(self, value: Expr) -> Node:
        """A symbol by its name, by that of another one, or as it is."""
        if value not in self.forms:
            return total([negated(self.written(-value))])
        found = self._done.get(value)
        if found is None:
            form = self.forms[value]
            worth = self._is_worth_a_name(form)
            found = (self._multiple(value) or self._named(self._sum(form))) if worth else form
            self._done[value] = found
        return found

    def _is_worth_a_name(self, form: Node) -> bool:
        """Whether it is long, twice it (beside q̇₁ q̇₂) too, and stands beside products of rates alone."""
        if min(cost(form), cost(times(2, [(form, 1)]))) < SHORTEST:
            return False
        put = Exchange(split_sign(form)[1], Symbol("")).put
        return all(put(node) == node for node in self.beside)

    def _named(self, form: Node) -> Node:
        minus = isinstance(summands(form)[0], Negative)  # of a sum, that every term has one
        name = next(self._names)
        self.definitions.append(Definition(name, total([negated(form)]) if minus else form))
        return Negative(name) if minus else name

    def _multiple(self, value: Expr) -> Node | None:
        """The symbol as a product in which another one, worth a name, is a factor."""
        sign, inner = split_sign(self.forms[value])
        factors = Counter(flat_factors(inner))
        for other, form in self.forms.items():
            other_sign, part = split_sign(form)
            own = Counter(flat_factors(part))
            if own < factors and self._is_worth_a_name(part):
                rest = [(factor, 1) for factor in (factors - own).elements()]
                return times(sign * other_sign, [(self.written(other), 1), *rest])
        return None

    def _sum(self, form: Node) -> Node:
        """A sum in which all terms of another symbol's stand, with the name of that in their place."""
        terms = summands(form)
        for other, part in self.forms.items():
            for sign in (1, -1):
                own = summands(part) if sign > 0 else tuple(map(negated, summands(part)))
                if 1 < len(own) < len(terms) and set(own) <= set(terms):
                    rest = [term for term in terms if term not in own]
                    return total([*rest, times(sign, [(self.written(other), 1)])])
        return form
