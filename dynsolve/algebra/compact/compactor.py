"""The compact form of exact expressions; see the text of this package for its steps.

A polynomial is collected by velocities and accelerations, each coefficient by masses
or by sines and cosines, an angle group at a time from the base outwards, and what is
left by parameters.  Where two orders of collecting compete (velocities outside or
inside, masses outside or inside), the result with fewer operations is taken.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial

from dynsolve.algebra.compact.atoms import RingAtoms
from dynsolve.algebra.compact.collect import Collector
from dynsolve.algebra.compact.proof import Proof, plain_form
from dynsolve.algebra.compact.spelling import in_one_spelling
from dynsolve.algebra.compact.terms import (
    Exponents,
    Monomial,
    Polynomial,
    Rational,
    TermLayout,
    Terms,
    exact,
    factors_of,
    multiply,
    primitive,
    read_terms,
    split_middle,
    split_tail,
    square_in,
    whole_content,
)
from dynsolve.algebra.compact.trig_forms import TrigMonomial, TrigPolynomial, angle_groups
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.errors import attempted, warn_left_out
from dynsolve.notation import tree
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import ZERO, Node

MUCH_CHEAPER = 0.75
"""Energies, momenta, torques stay collected by velocities unless another order costs less than this part."""

LONG = 60
"""From this number of operations on a momentum or an entry of C takes the cheaper order, as velocities do."""

SMALLEST_SQUARE = 3
"""The terms of (a c₂ + b c₂₃)², multiplied out."""

LARGE = 60
"""From this number of terms on one way of collecting is tried and not two."""


class Compactor:
    """Writes exact expressions of one ring as a person would.

    `leading` names the masses and moments of inertia in the order in which a sum
    mentions them; `parallel` are groups of coordinates that turn about parallel axes;
    `decimal` says that numbers are decimals, which are not drawn out of sums;
    `angles_outside` that masses are never collected outside sines and cosines; from `large` terms
    on one way of collecting is tried and not two.

    >>> from dynsolve.algebra.angles import Angle
    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.python import to_python
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([("q1", "revolute")], [Symbol("l")], [Angle.of("q1")])
    >>> s, c, l = ring.sin(Angle.of("q1")), ring.cos(Angle.of("q1")), ring.symbol("l")
    >>> to_python(Compactor(ring).form(l * c * c - l * s * s))
    'l*cos(2*q1)'
    """

    def __init__(
        self,
        ring: Ring,
        leading: Iterable[str] = (),
        parallel: Iterable[Iterable[str]] = (),
        *,
        decimal: bool = False,
        angles_outside: bool = False,
        large: int = LARGE,
    ) -> None:
        self.ring = ring
        self._groups = angle_groups(ring, parallel)
        self._atoms = RingAtoms(ring, leading, self._groups, self.form)
        self.collector = Collector(self._atoms.table, decimal=decimal)
        self._proof = Proof(ring)
        self._angles_outside = angles_outside
        self._large = large
        # The entries of D and C come again in the steps and in τ; a 7R arm would take a sixth longer without.
        self._forms: dict[str, Node] = {}
        self._coefficients: dict[tuple[TermLayout, frozenset[tuple[Exponents, Rational]]], Node] = {}
        self._grouped_by_angles: dict[tuple[TermLayout, frozenset[tuple[Exponents, Rational]]], Node] = {}

    # -- the entrance ------------------------------------------------------------------------------

    def form(self, expr: Expr) -> Node:
        """The compact tree of an expression; its plain form where that is not equal to its value."""
        if expr.is_zero:
            return ZERO
        key = str(expr.poly)
        found = self._forms.get(key)
        if found is None:
            plain = partial(plain_form, expr)
            found = attempted(partial(self._collected, expr), plain, "a compact form")
            if not self._proof.holds(expr, found):
                warn_left_out("a compact form", "it is not equal to its value")
                found = plain()
            self._forms[key] = found
        return found

    def _collected(self, expr: Expr) -> Node:
        layout, terms = read_terms(expr, [group.places for group in self._groups], self._atoms.kinds)
        return in_one_spelling(self._by_rates(layout, terms))

    def matrix(self, matrix: Matrix) -> tree.Matrix:
        """The compact trees of a matrix's entries."""
        return tree.Matrix(tuple(tuple(map(self.form, row)) for row in matrix.rows))

    # -- velocities and accelerations --------------------------------------------------------------

    def _by_rates(self, layout: TermLayout, terms: Terms) -> Node:
        """The terms with accelerations, those with velocities and all others, each collected separately."""
        if not layout.rates:
            return self._coefficient(layout, terms)
        accelerations = sum(self.ring.generators[i].dots == 2 for i in layout.rates)
        start = len(layout.symbols) + sum(width for _, width in layout.groups) - len(layout.rates)
        kinds: dict[tuple[int, int], Terms] = {}
        for e, f in terms.items():
            rates = e[start:]
            kind = sum(rates[:accelerations]), sum(rates[accelerations:])
            kinds.setdefault(kind, {})[e] = f
        return total(
            [self._one_kind(layout, part, kind) for kind, part in sorted(kinds.items(), reverse=True)]
        )

    def _one_kind(self, layout: TermLayout, terms: Terms, kind: tuple[int, int]) -> Node:
        """Velocities outside; or angles outside and velocities inside, where that is much cheaper."""
        if kind == (0, 2) and not self.collector.decimal and self._is_energy(layout, terms):
            half = Fraction(1, 2)  # an energy: its ½ in front
            terms = {e: exact(f, half) for e, f in terms.items()}
            return times(half, [(self._outside_or_inside(layout, terms, kind), 1)])
        return self._outside_or_inside(layout, terms, kind)

    @staticmethod
    def _is_energy(layout: TermLayout, terms: Terms) -> bool:
        """Whether a square has a factor ½, m (l q̇)²/2: in a force only what is no square has one."""
        start = sum(width for _, width in layout.groups)
        stop = start + len(layout.leading)
        return any(
            f.denominator % 2 == 0 and not any(x % 2 for x in (*e[:start], *e[stop:]))
            for e, f in terms.items()
        )

    def _outside_or_inside(self, layout: TermLayout, terms: Terms, kind: tuple[int, int]) -> Node:
        split = split_tail(terms, len(layout.rates))
        inner = layout.without_rates()
        parts = self._grouped(
            self._monomials(split, layout.rates), lambda part: self._coefficient(inner, part)
        )
        outside = self.collector.sum_of(parts)
        if len(split) == 1:
            return outside
        if len(terms) <= self._large:
            inside = self._by_angles(layout, terms)
            cost = self.collector.cost
            shortest = kind == (0, 1) and (not layout.leading or cost(outside) > LONG)
            if cost(inside) < cost(outside) * (1 if shortest else MUCH_CHEAPER):
                return inside
        return self.collector.apart(parts)

    def _merged(
        self, split: Mapping[Exponents, Terms], places: Sequence[int], form: Callable[[Terms], Node]
    ) -> Node:
        """Σ part · monomial, where monomials whose parts differ by a rational factor are summed first."""
        return self.collector.sum_of(self._grouped(self._monomials(split, places), form))

    def _monomials(
        self, split: Mapping[Exponents, Terms], places: Sequence[int]
    ) -> Iterator[tuple[Monomial, Terms]]:
        return ((self._atoms.monomial(places, key), part) for key, part in split.items())

    def _grouped(
        self, parts: Iterable[tuple[Monomial, Terms]], form: Callable[[Terms], Node]
    ) -> list[tuple[Rational, Monomial, Node]]:
        """(factor, monomial, form of a part); a part that is a number goes into the coefficient."""
        numbers: list[tuple[Rational, Monomial, Node]] = []
        shared: dict[object, tuple[Terms, Rational, Polynomial]] = {}
        for mono, part in parts:
            if len(part) == 1:
                ((exponents, number),) = part.items()
                if not any(exponents):
                    numbers.append((number, mono, tree.ONE))
                    continue
            key, scale = primitive(part)
            _, own, factors = shared.setdefault(key, (part, scale, {}))
            factors[mono] = exact(scale, own)
        sums = ((*self.collector.whole(factors), form(part)) for part, _, factors in shared.values())
        return [*numbers, *sums]

    # -- coefficients: no velocities ---------------------------------------------------------------

    def _coefficient(self, layout: TermLayout, terms: Terms) -> Node:
        """The cheaper of two: angles outside and masses inside, or masses outside."""
        if self._angles_outside:
            return self._by_angles(layout, terms)
        scale: Rational = 1
        if len(terms) > self._large and not self.collector.decimal:
            numbers, scale = primitive(terms)
            key = layout, numbers
        else:
            key = layout, frozenset(terms.items())
        found = self._coefficients.get(key)
        if found is None:
            shared, rest = self._without_common(layout, dict(key[1]))
            size, rest = self._usual(layout, rest)
            found = self._by_angles(layout, rest)
            if layout.leading and len(terms) <= self._large:
                found = min(self._by_masses(layout, rest), found, key=self.collector.cost)
            if size != 1:
                found = self.collector.sum_of([(size, (), found)])
            found = self._coefficients[key] = self.collector.sum_of([(*shared, found)])
        return found if scale == 1 else times(scale, [(found, 1)])

    def _usual(self, layout: TermLayout, terms: Terms) -> tuple[Rational, Terms]:
        """(size, terms / size): a polynomial and twice it are spelled alike.

        The size is the largest factor of a square of lengths, where that is the same beside each mass; where
        there is no square, that of most terms.  None is taken that would make finer fractions than halves of
        what they are, nor of squares alone, m (h² + 3r²) c/12.
        """
        if self.collector.decimal or len(terms) > LARGE:
            return 1, terms
        angles = sum(width for _, width in layout.groups)
        lengths = angles + len(layout.leading)
        sizes: dict[Exponents, Rational] = {e: f if f > 0 else -f for e, f in terms.items()}
        squares = {e: f for e, f in sizes.items() if any(e[lengths:]) and not any(x % 2 for x in e[lengths:])}
        if len(squares) == len(terms):
            return 1, terms
        of_masses: dict[Exponents, Rational] = {e[angles:lengths]: 0 for e in terms}
        for e, f in squares.items():
            of_masses[e[angles:lengths]] = max(f, of_masses[e[angles:lengths]])
        if len(set(of_masses.values())) > 1:
            return 1, terms
        counts = Counter(sizes.values())
        size = max(squares.values()) if squares else max(counts, key=lambda f: (counts[f], f))
        rest = {e: exact(f, size) for e, f in terms.items()}
        finer = whole_content(rest.values()).denominator > 2 * whole_content(terms.values()).denominator
        return (1, terms) if finer else (size, rest)

    def _without_common(self, layout: TermLayout, terms: Terms) -> tuple[tuple[Rational, Monomial], Terms]:
        """(the parameters and numbers that all terms share, the rest): l² + l a c keeps its l."""
        start = sum(width for _, width in layout.groups)
        symbols = zip(*(e[start:] for e in terms), strict=True)
        least = tuple(min(powers) if len(set(powers)) == 1 else 0 for powers in symbols)
        factor = self.collector.content(terms.values())
        if factor.denominator != 1 and len({f.denominator for f in terms.values()}) > 1:
            stop = start + len(layout.leading)
            if len({e[start:stop] for e in terms}) > 1:  # m₁ r²/2 + m₂ l²/12
                factor = 1
        if factor == 1 and not any(least):
            return (1, ()), terms
        rest = {
            (*e[:start], *(x - y for x, y in zip(e[start:], least, strict=True))): exact(f, factor)
            for e, f in terms.items()
        }
        return (factor, self._atoms.monomial(layout.symbols, least)), rest

    def _by_masses(self, layout: TermLayout, terms: Terms) -> Node:
        """Σ mass · factor; masses with equal factors are summed first."""
        start = sum(width for _, width in layout.groups)
        split = split_middle(terms, start, start + len(layout.leading))
        inner = layout.without_leading()
        return self._merged(split, layout.leading, lambda part: self._beside_mass(inner, part))

    def _beside_mass(self, layout: TermLayout, terms: Terms) -> Node:
        """The factor of a mass: with a square where that is no longer, completed where it is shorter."""
        size, terms = self._usual(layout, terms)
        cost, best = self.collector.cost, self._by_angles(layout, terms)
        squared = self._with_square(layout, terms)
        if squared is not None and cost(squared) <= cost(best):
            best = squared
        completed = self._with_square(layout, terms, completed=True)
        inside = self._squares_inside(layout, terms)
        for other in (completed, inside):
            if other is not None and cost(other) < cost(best):
                best = other
        return best if size == 1 else self.collector.product(size, (), (best,))

    def _squares_inside(self, layout: TermLayout, terms: Terms) -> Node | None:
        """(e - l s₃)² + c₂² (a + l c₃)²: squares beside what stands there of the first of several groups."""
        if len(layout.groups) <= 1 or layout.rates:
            return None
        (g, width), inner = layout.groups[0], layout.without_group()
        split: dict[Exponents, Terms] = {}
        for e, f in terms.items():
            split.setdefault(e[:width], {})[e[width:]] = f
        if all(len(part) < SMALLEST_SQUARE for part in split.values()):
            return None
        parts = []
        for exponents, part in split.items():
            sign, trig = self._atoms.basic_trig_monomial(exponents, g)
            parts.append((sign, trig, self._beside_mass(inner, part)))
        return self.collector.sum_of(parts)

    def _with_square(self, layout: TermLayout, terms: Terms, *, completed: bool = False) -> Node | None:
        """(Σ root)² + the rest, where sines and cosines of one angle group make a square."""
        while layout.groups and not any(any(e[: layout.groups[0][1]]) for e in terms):
            terms = {e[layout.groups[0][1] :]: f for e, f in terms.items()}
            layout = layout.without_group()
        if not layout.groups or layout.rates or len(terms) < SMALLEST_SQUARE:
            return None
        g, width = layout.groups[0]
        inner = sum(more for _, more in layout.groups[1:])
        if any(any(e[width : width + inner]) for e in terms):
            return None
        found = square_in(terms, width + inner, completed=completed)
        if found is None:
            return None
        root: Polynomial = {}
        for factor, exponents in found.roots:
            sign, trig = self._atoms.basic_trig_monomial(exponents[:width], g)
            symbols = self._atoms.monomial(layout.symbols, exponents[width + inner :])
            root[multiply(trig, symbols)] = sign * factor
        if self.collector.starts_negative(root):
            root = {mono: -factor for mono, factor in root.items()}
        number, mono = self.collector.decompose(tree.Power(self.collector.form(root), tree.Number(2)))
        rest = self._by_angles(layout, found.rest) if found.rest else ZERO
        return self.collector.sum_of([(number, mono, tree.ONE), (1, (), rest)])

    # -- angle groups from the base outwards -------------------------------------------------------

    def _by_angles(self, layout: TermLayout, terms: Terms) -> Node:
        """Σ b · X_b over the monomials b of one angle group, the X_b by the next group and so on."""
        while layout.groups:
            width = layout.groups[0][1]
            if any(any(e[:width]) for e in terms):
                key = layout, frozenset(terms.items())
                found = self._grouped_by_angles.get(key)
                if found is None:
                    found = self._grouped_by_angles[key] = self._by_group(layout, terms)
                return found
            terms = {e[width:]: f for e, f in terms.items()}
            layout = layout.without_group()
        return self._without_angles(layout, terms)

    def _by_group(self, layout: TermLayout, terms: Terms) -> Node:
        """The same, where the first angle group occurs: its polynomials in the forms that are chosen."""
        (g, width), inner = layout.groups[0], layout.without_group()
        polynomials: dict[Exponents, TrigPolynomial] = {}
        for e, f in terms.items():
            polynomials.setdefault(e[width:], {})[e[:width]] = f
        collected: dict[TrigMonomial, Terms] = {}
        for rest, form, factor in self._groups[g].forms.choose(polynomials):
            for mono, f in form:
                collected.setdefault(mono, {})[rest] = f * factor
        parts = []
        for mono, part in collected.items():
            sign, trig = self._atoms.trig_monomial(mono, g)
            parts.append((trig, part if sign > 0 else {e: -f for e, f in part.items()}))
        poly = self.collector.added(self._grouped(parts, lambda part: self._by_angles(inner, part)))
        return self.collector.form(self._atoms.with_angles_added(poly))

    def _without_angles(self, layout: TermLayout, terms: Terms) -> Node:
        """The terms without angles: parameters, and velocities if these were not split off before."""
        if layout.rates:
            split = split_tail(terms, len(layout.rates))
            inner = layout.without_rates()
            return self._merged(split, layout.rates, lambda part: self._without_angles(inner, part))
        plain = self._of_symbols(layout, terms)
        factors = factors_of(terms) if len(terms) >= SMALLEST_SQUARE and not self.collector.decimal else ()
        if not factors:
            return plain
        parts = [(self._of_symbols(layout, part), exponent) for part, exponent in factors]
        return min(plain, times(1, parts), key=self.collector.cost)

    def _of_symbols(self, layout: TermLayout, terms: Terms) -> Node:
        """The terms with the symbols of a layout, collected."""
        poly: Polynomial = {}
        for e, f in terms.items():
            mono = self._atoms.monomial(layout.symbols, e)
            poly[mono] = poly.get(mono, 0) + f
        return self.collector.form(poly)
