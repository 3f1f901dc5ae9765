"""Collecting polynomials in the parameters: common factors out, sums of lengths kept together.

    m₁ l_c1² + m₂ l₁² + m₂ l_c2²  ->  m₁ l_c1² + m₂ (l₁² + l_c2²)

A polynomial is a dictionary {monomial in atoms: factor} (see `atoms` and `terms`).
Of the ways of drawing an atom out of the terms that share it, the one that leaves the
fewest operations is taken; a sum that recurs as a whole, a₃ + x₃, becomes an atom of its
own, so that squares are completed: (a₃ + x₃)².

The factor that all entries of a matrix share: (1/12) m l² in front of the tensor of a rod.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from fractions import Fraction
from math import lcm

from dynsolve.algebra.compact.atoms import AtomPlace, AtomTable, Rank
from dynsolve.algebra.compact.terms import (
    Monomial,
    Polynomial,
    Rational,
    add_term,
    common,
    content,
    divide,
    exact,
    factors_of,
    join,
    joined_pair,
    multiply,
    primitive,
    rational_root,
    whole_content,
)
from dynsolve.notation.build import (
    QUARTERS,
    cost,
    ends,
    number_in_front,
    plus_first,
    split_sign,
    summands,
    times,
    total,
)
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    walk,
)

SEARCHED = 14
"""Up to this number of terms every promising split is tried; above it the likeliest alone."""

SMALLEST_PRODUCT = 3
"""The terms of (a + b)², multiplied out."""

JOINED = 60
"""Up to this number of terms sums that recur as a whole are looked for."""

APART = 6
"""Up to this number of products of rates, those of three coordinates, they stand apart."""

SMALL_WHOLE = 9
"""Decimals are drawn out of a sum where that leaves whole numbers up to this one."""


class Collector:
    """Writes polynomials in plain symbols as trees.

    A sum is written once and remembered: PUMA 560 would take half as long again without.
    """

    def __init__(
        self,
        atoms: AtomTable,
        *,
        decimal: bool = False,
        typed: Collection[Rational] = (),
        spelled: Iterable[Sum] = (),
    ) -> None:
        self.atoms = atoms
        self.decimal = decimal
        self.typed = typed
        self._known: dict[frozenset[tuple[Monomial, Rational]], Node] = {}
        self._costs: dict[int, tuple[Node, int]] = {}
        self._fractions: dict[int, Polynomial] = {}
        self._products: dict[tuple[Rational, Monomial, tuple[Node, ...]], Node] = {}
        self._decomposed: dict[Node, tuple[Rational, Monomial]] = {}
        self._places: dict[Monomial, tuple[object, ...]] = {}
        self._has_parameters = any(rank is Rank.PARAMETER for rank, _ in atoms.ranks)
        self._spelled = dict(primitive(self.terms_of(one)) for one in spelled)

    def cost(self, node: Node) -> int:
        """The operations of a tree, counted once a tree."""
        return cost(node, self._costs)

    def form(self, poly: Polynomial) -> Node:
        """The collected tree of a polynomial."""
        if not poly:
            return ZERO
        if len(poly) == 1:
            ((mono, factor),) = poly.items()
            return self.product(factor, mono, ())
        factor, mono, rest = self.primitive(poly)
        return self.product(factor, mono, (self._sum(rest),))

    def factored(self, poly: Polynomial) -> Node:
        """The collected tree of a polynomial, or the product of sums that it is, where that is shorter."""
        plain, product = self.form(poly), self.product_of_sums(poly)
        return plain if product is None else min(plain, product, key=self.cost)

    def product_of_sums(self, poly: Polynomial) -> Node | None:
        """The product of sums that a polynomial is; None where it is none."""
        factors = factors_of(poly) if len(poly) >= SMALLEST_PRODUCT else ()
        if not factors or (self.decimal and not all(self._is_legible(part) for part, _ in factors)):
            return None
        factor: Rational = 1
        mono: Monomial = ()
        for part, exponent in factors:
            own, atoms = self.whole(part)
            factor *= own**exponent
            mono = multiply(mono, tuple((atom, e * exponent) for atom, e in atoms))
        return self.product(factor, mono, ())

    def whole(self, poly: Polynomial, beside: int = 0) -> tuple[Rational, Monomial]:
        """A polynomial as (factor, monomial), a sum with whole numbers as one atom: ½ and (2 q̇₁ + q̇₂).

        With the sign of what stands `beside` a difference of rates is turned so that no minus is before both.
        """
        if len(poly) == 1:
            ((mono, factor),) = poly.items()
            return factor, mono
        shared = whole_content(poly.values())
        if self.decimal and not self._is_of_rates(poly, shared):
            shared = self.content(poly.values())  # 1.5 + 0.5 m, and not 0.5 (3 + m)
        is_difference = bool(beside) and len({f > 0 for f in poly.values()}) == 2 and self._has_rates(poly)
        if beside < 0 if is_difference else self.mostly_negative(poly):
            shared = -shared
        node = self.form({mono: exact(f, shared) for mono, f in poly.items()})
        if is_difference and isinstance(node, Sum):
            node = Sum(tuple(plus_first(node.terms)))
        factor, mono = self.decompose(node)
        return factor * shared, mono

    def _typed_in(self, poly: Polynomial) -> Rational | None:
        """The decimal to draw out of a length so that its own ones were typed: 250 k (r - 0.4)."""
        shared = common(poly) if self.typed else ()
        if not self.typed or not all(self._is_length(divide(mono, shared)) for mono in poly):
            return None
        sizes: list[Rational] = [f if f > 0 else -f for f in poly.values()]
        for size in sizes:
            rest = {exact(other, size) for other in sizes} - {1}
            if rest and all(number in self.typed for number in rest):
                return size
        return None

    def _twice_a_distance(self, poly: Polynomial) -> Rational | None:
        """The number to draw out of 2d - l, of a coordinate and lengths, which is 2(d - l/2); else None."""
        moving = [f if f > 0 else -f for mono, f in poly.items() if self._is_coordinate(mono)]
        is_twice = moving == [2 * whole_content(poly.values())] and all(map(self._is_length, poly))
        return moving[0] if is_twice else None

    def _is_legible(self, poly: Polynomial) -> bool:
        """Whether decimals of a sum are drawn out of it: 20x - 7 of a typed x - 0.35, and not 7x - 20."""
        return self._typed_in(poly) is not None or len({abs(f) for f in poly.values()}) == 1

    def _is_length(self, mono: Monomial) -> bool:
        """Whether a monomial is a length, a coordinate or 1."""
        ranks = [self.atoms.ranks[atom][0] for atom, _ in mono]
        return not mono or (mono[0][1] == 1 and ranks in ([Rank.PARAMETER], [Rank.COORDINATE]))

    def _is_of_rates(self, poly: Polynomial, number: Rational) -> bool:
        """Whether a polynomial is the number times rates and twice rates: 2q̇₁ q̇₂ + q̇₂²."""
        whole = all(abs(f) in (number, 2 * number) for f in poly.values())
        return whole and all(self.atoms.ranks[atom][0] >= Rank.RATE for mono in poly for atom, _ in mono)

    def _has_rates(self, poly: Polynomial) -> bool:
        """Whether there is a rate in each term."""
        return all(any(self.atoms.ranks[atom][0] >= Rank.RATE for atom, _ in mono) for mono in poly)

    def primitive(self, poly: Polynomial) -> tuple[Rational, Monomial, Polynomial]:
        """(factor, monomial, rest) with poly = factor · monomial · rest, the rest with few minus signs."""
        mono = self._worth_drawing(poly, common(poly))
        twice = self._twice_a_distance(self._divided(poly, mono, 1))
        factor = self._typed_in(poly) or twice or self.content(poly.values())
        if factor.denominator != 1 and (self._of_several_bodies(poly) or self._of_powers(poly)):
            factor = 1
        if self.has_root(mono):
            factor = whole_content(poly.values())
        rest = self._divided(poly, mono, factor)
        if (factor != 1 or mono) and self.mostly_negative(rest):
            factor, rest = -factor, {m: -f for m, f in rest.items()}
        return factor, mono, rest

    def has_root(self, mono: Monomial) -> bool:
        """Whether fractions are drawn out beside a root of a number that is: √2 (a + 4b)/2."""
        return not self.decimal and any(self.atoms.ranks[atom][0] is Rank.ROOT for atom, _ in mono)

    def _of_several_bodies(self, poly: Polynomial) -> bool:
        """Whether terms have different masses and fractions: m₁ r²/2 + m₂ l²/12 stays two terms.

        Not where all are of squares of parts, 3m₁ (a/4)² + 3m₂ (b/2)², which are 3(m₁ a² + 4m₂ b²)/16.
        """
        ranks = self.atoms.ranks
        above = {abs(f.numerator) for f in poly.values()}
        below = {f.denominator for f in poly.values()}
        of_squares = all(any(e == 2 and ranks[a][0] is Rank.PARAMETER for a, e in mono) for mono in poly)
        of_parts = len(above) == 1 and 1 not in below and all(map(rational_root, below))
        if len(below) == 1 or (of_squares and of_parts):
            return False
        return len({tuple(a for a, _ in mono if ranks[a][0] is Rank.LEADING) for mono in poly}) > 1

    def _of_powers(self, poly: Polynomial) -> bool:
        """Whether each term has another power of a coordinate: k x²/2 + k₃ x⁴/4."""
        moving = (atom for atom, _ in min(poly) if self.atoms.ranks[atom][0] is Rank.COORDINATE)
        powers = ([dict(mono).get(atom, 0) for mono in poly] for atom in moving)
        return any(min(own) > 1 and len({*own}) == len(poly) for own in powers)

    def content(self, factors: Iterable[Rational]) -> Rational:
        """The factor worth drawing out; of decimals only one that all are equal to."""
        if not self.decimal:
            return content(factors)
        sizes: set[Rational] = {f if f > 0 else -f for f in factors}
        return sizes.pop() if len(sizes) == 1 else 1

    def mostly_negative(self, poly: Polynomial) -> bool:
        """Whether a sum reads better with its sign turned: more minus than plus, or as many and one first.

        Of several coordinates the one with the largest number decides, 3q₁ - 2q₂, as a spring restores it.
        Of as many a coordinate counts as first, d - l/2 and not l/2 - d, and a mass before sums of moments of
        inertia, and 1 before cos v; other sums with angles stay as they are, c₂ - a c₁ s₂, and one of numbers
        and parameters, r - 0.1 or 0.1 - r.
        """
        if largest := self._largest_of_coordinates(poly):
            return largest < 0
        negative = sum(f < 0 for f in poly.values())
        if 2 * negative != len(poly):
            return 2 * negative > len(poly)
        highest = max(self.atoms.ranks[atom][0] for mono in poly for atom, _ in mono)
        if highest >= Rank.TRIG:
            return self._is_turned_with_angles(poly)
        if () in poly and highest is Rank.PARAMETER:
            return False
        return self.starts_negative(poly)

    def _is_turned_with_angles(self, poly: Polynomial) -> bool:
        """Whether it is cos v - 1 for 1 - cos v, or a mass has a minus beside sums of moments of inertia."""
        if () in poly:
            ranks = {self.atoms.ranks[atom][0] for mono in poly for atom, _ in mono}
            return ranks == {Rank.TRIG} and len(poly) == 2 and -poly[()] >= max(poly.values())
        first = {min((self.atoms.ranks[atom], atom) for atom, _ in mono): f for mono, f in poly.items()}
        ranks = {rank for (rank, _), _ in first}
        sums = [self.atoms.nodes[atom] for (rank, _), atom in first if rank is Rank.SUM]
        of_moments = all(self._is_mass(mono) for one in sums for mono in self.terms_of(one))
        return ranks == {Rank.LEADING, Rank.SUM} and of_moments and first[min(first)] < 0

    def _largest_of_coordinates(self, poly: Polynomial) -> Rational:
        """The largest number before one of several coordinates beside lengths; 0 where two are as large."""
        alone = {mono[0][0]: f for mono, f in poly.items() if mono and self._is_length(mono)}
        if len(alone) + (() in poly) < len(poly):
            return 0
        own = [f for atom, f in alone.items() if self.atoms.ranks[atom][0] is Rank.COORDINATE]
        sizes: list[Rational] = [f if f > 0 else -f for f in own]
        largest = max(sizes, default=0)
        if len(own) == 1 or sizes.count(largest) > 1:
            return 0
        return largest if largest in own else -largest

    def starts_negative(self, poly: Polynomial) -> bool:
        """Whether the first term has a minus, or the first in which a coordinate stands and no rate."""
        moving = [mono for mono in poly if self._is_moving(mono)]
        return poly[min(moving or poly, key=self.order)] < 0

    def _is_moving(self, mono: Monomial) -> bool:
        ranks = {self.atoms.ranks[atom][0] for atom, _ in mono}
        return Rank.COORDINATE in ranks and max(ranks) < Rank.RATE

    def _oriented(self, node: Sum) -> tuple[int, Node]:
        """(±1, the sum with that sign): as a factor one sum has one orientation, wherever it stands."""
        terms = {mono: factor for factor, mono in map(self.decompose, node.terms)}
        if not self.mostly_negative(terms):
            return 1, node
        return -1, total([self.product(-f, m, ()) for m, f in self.ordered(terms)])

    def side_by_side(self, products: Iterable[tuple[Rational, Monomial, Node]]) -> Node:
        """Σ factor · monomial · tree with nothing drawn out or turned: D is read off from its row."""
        added = self.added(products, oriented=False)
        return total([self.product(f, m, ()) for m, f in self.ordered(added)])

    def apart(self, products: Iterable[tuple[Rational, Monomial, Node]]) -> Node:
        """Σ factor · monomial · tree of different rates: a few stand apart where sums multiply them.

        A book writes 2(m₂ l² + m₃ d²) s₂ c₂ θ̇₁ θ̇₂ - 2m₃ d c₂² θ̇₁ ḋ, and draws no angle or rate out of it.
        """
        poly = self.added(products)
        sums = Counter(
            a for mono in poly for a, _ in mono if self.atoms.ranks[a][0] in (Rank.SUM, Rank.TRIG_SUM)
        )
        if not (1 < len(poly) <= APART and sums) or max(sums.values()) > 1:
            return self.form(poly)
        number = self.content(poly.values())
        number = 1 if number.denominator == 1 else number
        shared = tuple((a, e) for a, e in common(poly) if self.atoms.ranks[a][0] < Rank.TRIG)
        terms = [self.product(f, m, ()) for m, f in self.ordered(self._divided(poly, shared, number))]
        return self.product(number, shared, (total(terms),)) if shared or number != 1 else total(terms)

    @staticmethod
    def _divided(poly: Polynomial, mono: Monomial, factor: Rational) -> Polynomial:
        if not mono:
            return poly if factor == 1 else {m: exact(f, factor) for m, f in poly.items()}
        return {divide(m, mono): exact(f, factor) for m, f in poly.items()}

    def _worth_drawing(self, poly: Polynomial, shared: Monomial) -> Monomial:
        """The common monomial without lengths, coordinates and velocities that stay behind in some terms.

        A book writes l² + l a c, and not l (l + a c); and k x + k₃ x³.  Beside a sine or cosine that is drawn
        out too it writes l (a + l s) c, of two such lengths a b (a + b c), and of fractions l (a + l b/c).
        """
        if len(poly) > SEARCHED or len(poly) == 1:
            return shared
        uneven = [atom for atom, _ in shared if len({dict(mono)[atom] for mono in poly}) > 1]
        ranks = {self.atoms.ranks[atom][0] for atom, _ in shared}
        lengths = [atom for atom in uneven if self.atoms.ranks[atom][0] is Rank.PARAMETER]
        stay = {Rank.RATE}
        if Rank.TRIG not in ranks:
            stay.add(Rank.COORDINATE)
            if len(lengths) == 1 and all(e > 0 for mono in poly for _, e in mono):
                stay.add(Rank.PARAMETER)
        kept = [(a, e) for a, e in shared if a not in uneven or self.atoms.ranks[a][0] not in stay]
        return tuple(kept)

    def product(self, factor: Rational, mono: Monomial, more: tuple[Node, ...]) -> Node:
        """factor · monomial · more as a tree, in printing order."""
        key = factor, mono, more
        found = self._products.get(key)
        if found is None:
            found = self._products[key] = self._product(factor, mono, more)
        return found

    def _product(self, factor: Rational, mono: Monomial, more: tuple[Node, ...]) -> Node:
        atoms = [*mono, *((self.atoms.number(node), 1) for node in more)]
        if not self.decimal:
            for place, (atom, exponent) in enumerate(atoms):
                if exponent == 1 and (poly := self._of_fractions(atom)):
                    factor, whole = self._without_fractions(factor, poly)
                    atoms[place : place + 1] = whole or [(atom, 1)]
                    break
                if exponent == 2 and (half := self._half_a_square(factor, atom)):
                    factor, atoms[place] = Fraction(1, 2), (half, 2)
                    break
        for place, (atom, exponent) in enumerate(atoms):
            if exponent == 2 and (below := self._denominator(atom)) and not factor % Fraction(below**2, 2):
                terms = self._of_fractions(atom).items()
                scaled = total([self.product(exact(f * below, 1), mono, ()) for mono, f in terms])
                factor, atoms[place] = exact(factor, below**2), (self.atoms.number(scaled), 2)
                break
        atoms.sort(key=lambda item: self.atoms.ranks[item[0]])
        decimal = self.decimal and not self._is_half_of_letters(factor, atoms)
        return times(factor, [(self.atoms.nodes[a], e) for a, e in atoms], decimal=decimal)

    def _is_half_of_letters(self, factor: Rational, atoms: Iterable[tuple[int, int]]) -> bool:
        """Whether a half, a quarter or an eighth that nobody typed is beside letters: m l/2, 3m/4.

        Beside masses alone it comes from lengths in numbers: 0.25 m.
        """
        is_typed = not self.typed or abs(factor) in self.typed
        letters = {1: (Rank.LEADING, Rank.PARAMETER), 3: (Rank.LEADING,)}.get(abs(factor.numerator), ())
        return (
            factor.denominator in QUARTERS
            and not is_typed
            and self._has_parameters
            and any(self.atoms.ranks[atom][0] in letters for atom, _ in atoms)
        )

    def _of_fractions(self, atom: int) -> Polynomial:
        """The terms of a sum with fractions in it; none of any other atom."""
        found = self._fractions.get(atom)
        if found is None:
            node = self.atoms.nodes[atom]
            terms = node.terms if isinstance(node, Sum) else ()
            found = {mono: f for f, mono in map(self.decompose, terms)}
            if all(f.denominator == 1 for f in found.values()):
                found = {}
            self._fractions[atom] = found
        return found

    def _without_fractions(self, factor: Rational, poly: Polynomial) -> tuple[Rational, Monomial]:
        """A number put into a sum of fractions, 4(a + b/3) as 4a + 4b/3; m₁/3 + m₂ stays what it is.

        Twice a sum, as a derivative has it, stays twice that sum where fractions would stay in it too, and
        a coordinate less a fraction is one distance everywhere: 2m (d - l/2).
        """
        if self._is_from_a_coordinate(poly):
            return factor, ()
        scaled = {mono: exact(f * factor, 1) for mono, f in poly.items()}
        shared = whole_content(scaled.values())
        if factor in (1, -1) or (factor in (2, -2) and shared.denominator != 1):
            return factor, ()
        if any(abs(Fraction(f) / shared) > SMALL_WHOLE for f in scaled.values()):
            shared = 1
        parts = [self.decompose(self.product(exact(f, shared), mono, ())) for mono, f in scaled.items()]
        # what is left in the terms may share a number again: (2M₁ b² + 2M₂ (3b² + c²))/6
        again = whole_content(f for f, _ in parts) if shared != 1 else 1
        own, whole = self.decompose(total([self.product(exact(f, again), mono, ()) for f, mono in parts]))
        return shared * again * own, whole

    def _half_a_square(self, factor: Rational, atom: int) -> int | None:
        """The sum of ½ (q - 1/4)², which is (4q - 1)²/32."""
        root, node = rational_root(2 * factor), self.atoms.nodes[atom]
        if root is None or root.numerator != 1 or root == 1 or not isinstance(node, Sum):
            return None
        terms = [self.decompose(term) for term in node.terms]
        if all(abs(f * root) != 1 for f, _ in terms):
            return None
        return self.atoms.number(total([self.product(f * root, mono, ()) for f, mono in terms]))

    def _denominator(self, atom: int) -> int:
        """2 of a sum x + y/2, of which 2 (x + y/2)² is ½ (2x + y)²; 0 of d - l/2, and without fractions."""
        terms = self._of_fractions(atom)
        if not terms or self._is_from_a_coordinate(terms):
            return 0
        return lcm(*(f.denominator for f in terms.values()))

    def _is_from_a_coordinate(self, poly: Polynomial) -> bool:
        """Whether it is a coordinate and other terms: d - l/2."""
        return any(f in (1, -1) and self._is_coordinate(mono) for mono, f in poly.items())

    def _is_coordinate(self, mono: Monomial) -> bool:
        return len(mono) == 1 and mono[0][1] == 1 and self.atoms.ranks[mono[0][0]][0] is Rank.COORDINATE

    def _is_mass(self, mono: Monomial) -> bool:
        return len(mono) == 1 and mono[0][1] == 1 and self.atoms.ranks[mono[0][0]][0] is Rank.LEADING

    def decompose(self, node: Node) -> tuple[Rational, Monomial]:
        """(factor, monomial) of a tree that is a product; a sum counts as one atom."""
        found = self._decomposed.get(node)
        if found is None:
            found = self._decomposed[node] = self._decompose(node)
        return found

    def _decompose(self, node: Node) -> tuple[Rational, Monomial]:
        match node:
            case Negative(argument):
                factor, mono = self.decompose(argument)
                return -factor, mono
            case Number(p, q):
                return (p if q == 1 else Fraction(p, q)), ()
            case Product(factors):
                factor, mono = 1, ()
                for part in factors:
                    own, more = self.decompose(part)
                    factor, mono = factor * own, multiply(mono, more)
                return factor, mono
            case Quotient(numerator, denominator):
                f, above = self.decompose(numerator)
                g, below = self.decompose(denominator)
                return exact(f, g), divide(above, below)
            case Power(base, Number(p, 1)):
                factor, mono = self.decompose(base)
                return factor**p, tuple((atom, e * p) for atom, e in mono)
        return 1, ((self.atoms.number(node), 1),)

    def terms_of(self, node: Node) -> Polynomial:
        """A sum as a polynomial."""
        return {mono: f for f, mono in map(self.decompose, summands(node))}

    def direction(self, nodes: Sequence[Node]) -> list[Node]:
        """Components without what numbers and roots of these all share: (c₁, s₁) of (√2 c₁, √2 s₁)."""
        parts = [self.decompose(node) for node in nodes]
        filled = [(factor, mono) for factor, mono in parts if factor]
        size = whole_content([factor for factor, _ in filled])
        shared = common([mono for _, mono in filled])
        roots = tuple(part for part in shared if self.atoms.ranks[part[0]][0] is Rank.ROOT)
        if size == 1 and not roots:
            return [*nodes]
        return [
            self.product(exact(factor, size), divide(mono, roots), ()) if factor else ZERO
            for factor, mono in parts
        ]

    def sum_of(self, products: Iterable[tuple[Rational, Monomial, Node]]) -> Node:
        """Σ factor · monomial · tree, with what the products share drawn out."""
        return self.form(self.added(products))

    def added(
        self, products: Iterable[tuple[Rational, Monomial, Node]], *, oriented: bool = True
    ) -> Polynomial:
        """The same as a polynomial in atoms, each sum with one sign where they are `oriented`."""
        poly: Polynomial = {}
        for factor, mono, node in products:
            sign, inner = split_sign(node)
            terms: tuple[Node, ...] = (inner,)
            if isinstance(inner, Sum) and not mono:
                terms = inner.terms
            elif isinstance(inner, Sum):
                turned, inner = self._oriented(inner) if oriented else (1, inner)
                terms, sign = (inner,), sign * turned
            for term in terms:
                own, rest = self.decompose(term)
                add_term(poly, multiply(mono, rest) if mono else rest, factor * own * sign)
        return poly

    def _sum(self, poly: Polynomial) -> Node:
        key = frozenset(poly.items())
        found = self._known.get(key)
        if found is None:
            joined = self._joined(poly)
            found = self._known[key] = self.form(joined) if joined else self._split(poly)
        return found

    def _split(self, poly: Polynomial) -> Node:
        plain = self._arranged([self.product(f, m, ()) for m, f in self.ordered(poly)])
        best, least = plain, self.cost(plain)
        alike = [part for part in self._of_moments(poly) if 2 < len(part) < len(poly)]
        if alike:
            rest = {m: f for m, f in poly.items() if not any(m in part for part in alike)}
            node = self._arranged([self.form(part) for part in (*alike, rest) if part])
            if self.cost(node) < least:
                best, least = node, self.cost(node)
        for atom in self._worth_splitting(poly):
            node = self._split_by(poly, atom)
            # Books draw a mass out rather than a length, though it may cost one operation more.
            price = self.cost(node) - (self.atoms.ranks[atom][0] is Rank.LEADING)
            if price < least:
                best, least = node, price
        completed = self._completed(poly)
        # A book writes the distance, (d - l/2)² + l²/12, with either sign, at two operations more.
        return best if completed is None or self.cost(completed) - 2 > least else completed

    def _of_moments(self, poly: Polynomial) -> Iterable[Polynomial]:
        """The terms that are moments of inertia, by their fractions: (B + C + A s²)/2 beside m l²/8."""
        found: dict[int, Polynomial] = {}
        for mono, f in poly.items():
            still = [power for power in mono if self.atoms.ranks[power[0]][0] < Rank.TRIG]
            if f.denominator != 1 and self._is_mass(tuple(still)):
                found.setdefault(f.denominator, {})[mono] = f
        return found.values()

    def _completed(self, poly: Polynomial) -> Node | None:
        """a x² + b x y + c y² + ..., x being a coordinate, as a (x + b y / 2a)² + (c - b² / 4a) y² + ...

        y may be 1: d²/2 - d/10 + 1/200 is (d - 1/10)²/2.
        """
        ranks = self.atoms.ranks
        squares = {mono[0][0]: f for mono, f in poly.items() if len(mono) == 1 and mono[0][1] == 2}
        for x in squares:
            if ranks[x][0] is not Rank.COORDINATE:
                continue
            with_x = [mono for mono in poly if any(atom == x for atom, _ in mono)]
            mixed = [mono for mono in with_x if dict(mono)[x] == 1]
            if len(with_x) != 2 or len(mixed) != 1 or len(mixed[0]) > 2:
                continue
            y = divide(mixed[0], ((x, 1),))
            of_y = multiply(y, y)
            half = exact(poly[mixed[0]], 2 * squares[x])
            square = poly.get(of_y, 0) - squares[x] * half * half
            if of_y not in poly or any(exponent != 1 for _, exponent in y) or bool(y) != bool(square):
                continue
            rest = {mono: f for mono, f in poly.items() if mono not in with_x}
            add_term(rest, of_y, square - rest.get(of_y, 0))
            other = y[0][0] if y else self.atoms.number(ONE)
            whole = self.atoms.number(self._sum_node(x, other, half))
            return self.form({((whole, 2),): squares[x], **rest})
        return None

    def _worth_splitting(self, poly: Polynomial) -> list[int]:
        """The atoms that most terms share, leading ones first."""
        counts = Counter(atom for mono in poly for atom, e in mono if e > 0)
        shared = [a for a, n in counts.items() if n > 1]
        shared = [a for a in shared if not self._is_own_square(poly, a)]
        shared.sort(key=lambda a: (-counts[a], self.atoms.ranks[a]))
        return shared if len(poly) <= SEARCHED else shared[:1]

    def _is_own_square(self, poly: Polynomial, atom: int) -> bool:
        """Whether a length, coordinate, sine or velocity is squared in one term and not in another.

        No book draws that out: I_xx s² + 2I_xy s c and not s (I_xx s + 2I_xy c).
        """
        rank = self.atoms.ranks[atom][0]
        if rank not in (Rank.PARAMETER, Rank.COORDINATE, Rank.SUM, Rank.TRIG, Rank.RATE) or (
            rank is not Rank.RATE and len(poly) > SEARCHED
        ):
            return False
        return len({e for mono in poly for a, e in mono if a == atom and e > 0}) > 1

    def _split_by(self, poly: Polynomial, atom: int) -> Node:
        having = {m: f for m, f in poly.items() if any(a == atom and e > 0 for a, e in m)}
        rest = {m: f for m, f in poly.items() if m not in having}
        parts = [having, rest] if min(poly, key=self.order) in having else [rest, having]
        return self._arranged([self.form(part) for part in parts if part])

    def _arranged(self, nodes: list[Node]) -> Node:
        """The sum of trees; where one is a sum itself, its terms find their places among the others."""
        if len(nodes) == 1 or not any(isinstance(split_sign(node)[1], Sum) for node in nodes):
            return total(nodes)
        flat = total(nodes)
        if not isinstance(flat, Sum):
            return flat
        return total(sorted(flat.terms, key=lambda term: self.order(self.decompose(term)[1])))

    def order(self, mono: Monomial) -> tuple[object, ...]:
        """The place of a term in a sum: by its velocities, its angles, its symbols; squares first.

        The square of a distance without angles, (d - l/2)², stands before all other terms without angles.
        """
        found = self._places.get(mono)
        if found is None:
            found = self._places[mono] = self._place(mono)
        return found

    def _place(self, mono: Monomial) -> tuple[object, ...]:
        ranks = sorted((self.atoms.ranks[atom], -exponent) for atom, exponent in mono)
        rates = [rank for rank in ranks if rank[0][0] >= Rank.RATE]
        trig = [rank for rank in ranks if rank[0][0] is Rank.TRIG] or self._last_angle(mono)
        return not rates, rates, trig, not self._is_distance(mono), ranks

    def _last_angle(self, mono: Monomial) -> list[tuple[AtomPlace, int]]:
        """Where a squared sum of angles stands, (a c₂ + b c₂₃)²: before the terms of its last angle."""
        for atom, exponent in mono:
            if self.atoms.ranks[atom][0] is Rank.TRIG_SUM and exponent == 2:
                angles = {node for node in walk(self.atoms.nodes[atom]) if isinstance(node, Function)}
                rank, order = max(self.atoms.ranks[self.atoms.number(angle)] for angle in angles)
                return [((rank, order[:2]), -exponent)]
        return []

    def _is_distance(self, mono: Monomial) -> bool:
        """Whether a term is the square of a sum in which a coordinate stands."""
        if len(mono) != 1 or mono[0][1] != 2:
            return False
        node = self.atoms.nodes[mono[0][0]]
        parts = [split_sign(term)[1] for term in node.terms] if isinstance(node, Sum) else []
        numbers = [self.atoms.number(part) for part in parts if isinstance(part, Symbol)]
        return any(self.atoms.ranks[number][0] is Rank.COORDINATE for number in numbers)

    def ordered(self, poly: Polynomial) -> list[tuple[Monomial, Rational]]:
        """The terms in printing order."""
        return sorted(poly.items(), key=lambda item: self.order(item[0]))

    # -- sums that recur as a whole --------------------------------------------------------------

    def _joined(self, poly: Polynomial) -> Polynomial | None:
        """The polynomial with x + y as one atom where it depends on x and y through their sum alone."""
        if not 3 <= len(poly) <= JOINED:
            return None
        found = joined_pair(poly)
        if found is None:
            return None
        x, y, ratio = found
        if self.decimal and not ends(ratio.denominator):
            return None  # 20s₂/7
        if self.atoms.ranks[y][0] is Rank.COORDINATE is not self.atoms.ranks[x][0] and ratio < 0:
            x, y, ratio = y, x, exact(1, ratio)
        node = self._sum_node(x, y, ratio)
        terms = self.terms_of(node)
        key, scale = primitive(terms)
        size = exact(scale, self._spelled[key]) if key in self._spelled else self._typed_in(terms) or 1
        if size != 1:  # θ - 20z is -20(z - 0.05 θ), where that or 0.05 was typed
            node = total([self.product(exact(f, size), mono, ()) for mono, f in self.ordered(terms)])
        whole = self.atoms.number(node)
        return {
            mono: exact(f * size ** dict(mono).get(whole, 0), 1)
            for mono, f in join(poly, x, y, whole).items()
        }

    def _sum_node(self, x: int, y: int, ratio: Rational) -> Node:
        """x + ratio·y as a tree, flat and in order; a difference starts with x."""
        poly: Polynomial = {}
        for atom, factor in ((x, 1), (y, ratio)):
            node = self.atoms.nodes[atom]
            for term in node.terms if isinstance(node, Sum) else (node,):
                own, mono = self.decompose(term)
                poly[mono] = own * factor
        terms = [self.product(f, m, ()) for m, f in self.ordered(poly)]
        if ratio < 0 and not isinstance(self.atoms.nodes[x], Sum):
            terms.sort(key=lambda term: isinstance(term, Negative))
        return total(terms)


def product_of_sums(rates: Node) -> Node:
    """A sum of products of rates as a product, where that is one; else as it is.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> u, v, q = (Symbol(name, 1) for name in "uvq")
    >>> to_unicode(product_of_sums(Sum((Product((Number(2), u, q)), Product((Number(2), v, q))))))
    '2q̇ (u̇ + v̇)'
    """
    collector = Collector(AtomTable())
    for symbol in dict.fromkeys(part for part in walk(rates) if isinstance(part, Symbol)):
        collector.atoms.number(symbol, Rank.RATE)
    found = collector.factored(collector.terms_of(rates))
    return rates if isinstance(found, Sum) else found


# The factor that all entries of a matrix share: (1/12) m l² in front of the tensor of a rod


def matrix_factor(collector: Collector, matrix: Matrix) -> tuple[Node, Matrix] | None:
    """(factor, rest) with matrix = factor · rest; None unless that takes fractions out of several entries.

    Masses and lengths go with the fraction, angles and rates stay; a length alone stays too: no entry
    is read more easily without it.
    """
    entries = {entry: collector.decompose(entry) for row in matrix.rows for entry in row if entry != ZERO}
    filled = sum(entry != ZERO for row in matrix.rows for entry in row)
    if filled < 2 or not any(isinstance(split_sign(entry)[1], Quotient) for entry in entries):
        return None
    number = whole_content([factor for factor, _ in entries.values()])
    ranks = collector.atoms.ranks
    shared = tuple(
        (atom, exponent)
        for atom, exponent in common([mono for _, mono in entries.values()])
        if ranks[atom][0] <= Rank.SUM
    )
    if number.denominator == 1 or not shared:
        return None
    rest: dict[Node, Node] = {
        entry: collector.product(exact(factor, number), divide(mono, shared), ())
        for entry, (factor, mono) in entries.items()
    }
    if any(isinstance(part, Quotient) for entry in rest.values() for part in walk(entry)):
        return None
    whole = collector.product(number, shared, ())
    front = number_in_front(whole)
    match front:  # a fraction stays one among decimals: ½ b
        case Product((Number(p, q), *others)) if isinstance(whole, Quotient):
            front = Product((Quotient(Number(p), Number(q)), *others))
    return front, Matrix(tuple(tuple(rest.get(entry, entry) for entry in row) for row in matrix.rows))
