"""The compact form: from a normal form to what a textbook would print.

    d₁₁ = m₁ l_c1² + m₂ (l₁² + l_c2² + 2 l₁ l_c2 c₂) + I₁ + I₂

1. A polynomial is collected by velocities and accelerations; those that share a
   coefficient are merged, (q̇₂ + q̇₃).
2. A coefficient is a sum over monomials in the parameters of small trigonometric
   polynomials.  Each is written in its best dress (`algebra.dress`), an angle group
   at a time from the base outwards; dresses that others wear already are preferred
   (`algebra.wardrobe`).
3. What is left are polynomials in the parameters (`algebra.collect`): common
   factors out, masses first, recurring sums of lengths kept together.

Where two orders of collecting compete (velocities outside or inside, masses
outside or inside), the cheaper result is taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction

from dynsolve.algebra.angles import Angle, angle_node
from dynsolve.algebra.compact.choice import Face
from dynsolve.algebra.compact.collect import Atoms, Collector, Mono, Poly, Rank
from dynsolve.algebra.compact.groups import angle_groups
from dynsolve.algebra.compact.terms import (
    Exponents,
    Factor,
    Frame,
    Terms,
    exact,
    primitive,
    read_terms,
    split_middle,
    split_tail,
)
from dynsolve.algebra.compact.trig_forms import Monomial
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.notation import tree
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import ZERO, Function, Node, Number, Symbol

MUCH_CHEAPER = 0.75
"""Energies and torques stay collected by velocities unless another order costs less than this part."""

LARGE = 60
"""From this number of terms on one way of collecting is tried and not two."""


class Compactor:
    """Writes exact expressions of one ring as a person would.

    `leading` names the masses and moments of inertia in the order in which a sum
    mentions them; `parallel` are groups of coordinates that turn about parallel axes;
    `decimal` says that numbers are decimals, which are not drawn out of sums.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.notation.python import to_python
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
    ) -> None:
        self.ring = ring
        self.atoms = Atoms()
        self.collector = Collector(self.atoms, decimal=decimal)
        self._order = {name: i for i, name in enumerate(leading)}
        self._kinds = {g.index: self._kind(g) for g in ring.generators}
        self._symbol_atoms: dict[int, tuple[int, int]] = {}
        self._number_symbols()
        self._groups = angle_groups(ring, parallel)
        self._places = [group.places for group in self._groups]
        self._forms: dict[str, Node] = {}
        self._scalars: dict[tuple[Frame, frozenset[tuple[Exponents, Factor]]], Node] = {}
        self._waves: dict[tuple[int, str, Exponents], tuple[int, int]] = {}

    # -- atoms -------------------------------------------------------------------------------------

    def _kind(self, g: Generator) -> str:
        if g.kind in ("sin", "cos", "constant"):
            return "angle"
        if g.kind == "symbol" and g.dots:
            return "rate"
        return "leading" if g.name in self._order else "parameter"

    def _number_symbols(self) -> None:
        """Number the symbols in printing order: masses, g, other parameters, coordinates, velocities."""

        def rank(g: Generator) -> Rank:
            kind = self._kinds[g.index]
            if isinstance(g.node, Number):
                return Rank.ROOT
            if kind == "parameter":
                return Rank.COORDINATE if g.name in self.ring.names else Rank.PARAMETER
            return Rank.LEADING if kind == "leading" else Rank.RATE

        def place(g: Generator) -> tuple[object, ...]:
            return (
                rank(g),
                self._order.get(g.name, 0),
                g.dots != 2,
                g.name != "g",
                g.kind != "symbol",
                g.index,
            )

        for g in sorted(self.ring.generators, key=place):
            if g.kind in ("symbol", "root"):
                self._symbol_atoms[g.index] = self.atoms.number(self._node(g), rank(g)), 1

    def _node(self, g: Generator) -> Node:
        if g.kind == "symbol":
            return Symbol(g.name, g.dots)
        assert g.node is not None
        return Function("sqrt", g.node)

    def _symbol_atom(self, index: int) -> tuple[int, int]:
        """(atom, ±1) of a generator; an inverse is what it inverts, to the power -1."""
        found = self._symbol_atoms.get(index)
        if found is None:
            inverted = self.form(Expr(self.ring, self.ring.inverses[index]))
            found = self._symbol_atoms[index] = self.atoms.number(inverted), -1
        return found

    def _mono(self, generators: Sequence[int], exponents: Sequence[int]) -> Mono:
        """The monomial in atoms of some generators' exponents."""
        parts = []
        for i, e in zip(generators, exponents, strict=True):
            if e:
                atom, sign = self._symbol_atom(i)
                parts.append((atom, sign * e))
        parts.sort()
        return tuple(parts)

    def _wave_mono(self, mono: Monomial, g: int) -> tuple[int, Mono]:
        """(±1, the monomial in atoms) of sines and cosines in the angles of a group."""
        sign, parts = 1, []
        for (name, turns), e in mono:
            turned, atom = self._wave_atom(g, name, turns)
            sign *= turned**e
            parts.append((atom, e))
        return sign, tuple(sorted(parts))

    def _wave_atom(self, g: int, name: str, turns: Exponents) -> tuple[int, int]:
        """(±1, atom) of a wave; see `_points_back` for how its angle is written."""
        found = self._waves.get((g, name, turns))
        if found is None and name == "sqrt":
            found = 1, self.atoms.number(Function(name, Number(turns[0])), Rank.ROOT)
        elif found is None:
            angle = self._groups[g].angle(turns)
            sign = 1
            if self._points_back(angle):
                angle, sign = -angle, (-1 if name == "sin" else 1)
            last = max(k for k, t in enumerate(turns) if t)
            order = (g, last, sum(map(abs, turns)), name != "sin")
            found = (
                sign,
                self.atoms.number(Function(name, angle_node(angle, self.ring.names)), Rank.WAVE, order),
            )
        self._waves[g, name, turns] = found
        return found

    def _points_back(self, angle: Angle) -> bool:
        """Whether the angle reads better with its sign turned.

        Few minus signs, and of as many the last coordinate positive: q₁ + q₂ - q₄, and q₂ - q₁.
        """
        rates = dict(angle.terms)
        moving = [rates[((name, 1),)] for name in self.ring.names if ((name, 1),) in rates]
        moving = moving or [rate for _, rate in angle.terms]
        negative = sum(rate < 0 for rate in moving)
        return 2 * negative > len(moving) or (2 * negative == len(moving) and bool(moving) and moving[-1] < 0)

    # -- the entrance ------------------------------------------------------------------------------

    def form(self, expr: Expr) -> Node:
        """The compact tree of an expression."""
        if expr.is_zero:
            return ZERO
        key = str(expr.poly)
        found = self._forms.get(key)
        if found is None:
            frame, terms = read_terms(expr, self._places, self._kinds)
            found = self._forms[key] = self._by_rates(frame, terms)
        return found

    def matrix(self, matrix: Matrix) -> tree.Matrix:
        """The compact trees of a matrix's entries."""
        return tree.Matrix(tuple(tuple(map(self.form, row)) for row in matrix.rows))

    # -- velocities and accelerations --------------------------------------------------------------

    def _by_rates(self, frame: Frame, terms: Terms) -> Node:
        """What has accelerations, what has velocities and what has neither, each by itself."""
        if not frame.rates:
            return self._scalar(frame, terms)
        accelerations = sum(self.ring.generators[i].dots == 2 for i in frame.rates)
        start = len(frame.symbols) + sum(width for _, width in frame.groups) - len(frame.rates)
        kinds: dict[tuple[int, int], Terms] = {}
        for e, f in terms.items():
            rates = e[start:]
            kind = sum(rates[:accelerations]), sum(rates[accelerations:])
            kinds.setdefault(kind, {})[e] = f
        return total(
            [self._one_kind(frame, part, kind) for kind, part in sorted(kinds.items(), reverse=True)]
        )

    def _one_kind(self, frame: Frame, terms: Terms, kind: tuple[int, int]) -> Node:
        """Velocities outside; or angles outside and velocities inside, where that is much cheaper."""
        if (
            kind == (0, 2)
            and any(f.denominator % 2 == 0 for f in terms.values())
            and not self.collector.decimal
        ):
            half = Fraction(1, 2)  # an energy: its ½ in front
            terms = {e: exact(f, half) for e, f in terms.items()}
            return times(half, [(self._outside_or_inside(frame, terms, kind), 1)])
        return self._outside_or_inside(frame, terms, kind)

    def _outside_or_inside(self, frame: Frame, terms: Terms, kind: tuple[int, int]) -> Node:
        split = split_tail(terms, len(frame.rates))
        inner = frame.without_rates()
        outside = self._merged(split, frame.rates, lambda part: self._scalar(inner, part))
        if len(split) == 1 or len(terms) > LARGE:
            return outside
        inside = self._by_angles(frame, terms)
        cost = self.collector.cost
        return inside if cost(inside) < cost(outside) * (1 if kind == (0, 1) else MUCH_CHEAPER) else outside

    def _merged(
        self, split: Mapping[Exponents, Terms], places: Sequence[int], form: Callable[[Terms], Node]
    ) -> Node:
        """Σ part · monomial, where monomials whose parts differ by a rational factor are summed first."""
        return self._paired(((self._mono(places, key), part) for key, part in split.items()), form)

    def _paired(self, parts: Iterable[tuple[Mono, Terms]], form: Callable[[Terms], Node]) -> Node:
        numbers: list[tuple[Factor, Mono, Node]] = []
        shared: dict[object, tuple[Terms, Factor, Poly]] = {}
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
        return self.collector.sum_of((*numbers, *sums))

    # -- coefficients: no velocities ---------------------------------------------------------------

    def _scalar(self, frame: Frame, terms: Terms) -> Node:
        """The cheaper of two: angles outside and masses inside, or masses outside."""
        scale: Factor = 1
        if len(terms) > LARGE and not self.collector.decimal:
            numbers, scale = primitive(terms)
            key = frame, numbers
        else:
            key = frame, frozenset(terms.items())
        found = self._scalars.get(key)
        if found is None:
            shared, rest = self._without_common(frame, dict(key[1]))
            found = self._by_angles(frame, rest)
            if frame.leading and len(terms) <= LARGE:
                found = min(self._by_masses(frame, rest), found, key=self.collector.cost)
            found = self._scalars[key] = self.collector.sum_of([(*shared, found)])
        return found if scale == 1 else times(scale, [(found, 1)])

    def _without_common(self, frame: Frame, terms: Terms) -> tuple[tuple[Factor, Mono], Terms]:
        """(what all terms share of parameters and numbers, the rest)"""
        start = sum(width for _, width in frame.groups)
        symbols = zip(*(e[start:] for e in terms), strict=True)
        least = tuple(min(powers) for powers in symbols)
        factor = self.collector.content(terms.values())
        if factor == 1 and not any(least):
            return (1, ()), terms
        rest = {
            (*e[:start], *(x - y for x, y in zip(e[start:], least, strict=True))): exact(f, factor)
            for e, f in terms.items()
        }
        return (factor, self._mono(frame.symbols, least)), rest

    def _by_masses(self, frame: Frame, terms: Terms) -> Node:
        """Σ mass · (what it multiplies); masses that multiply the same are summed first."""
        start = sum(width for _, width in frame.groups)
        split = split_middle(terms, start, start + len(frame.leading))
        inner = frame.without_leading()
        return self._merged(split, frame.leading, lambda part: self._by_angles(inner, part))

    # -- angle groups from the base outwards -------------------------------------------------------

    def _by_angles(self, frame: Frame, terms: Terms) -> Node:
        """Σ b · X_b over the monomials b of one angle group, the X_b by the next group and so on."""
        while frame.groups:
            width = frame.groups[0][1]
            if any(any(e[:width]) for e in terms):
                return self._by_group(frame, terms)
            terms = {e[width:]: f for e, f in terms.items()}
            frame = frame.without_group()
        return self._without_angles(frame, terms)

    def _by_group(self, frame: Frame, terms: Terms) -> Node:
        (g, width), inner = frame.groups[0], frame.without_group()
        faces: dict[Exponents, Face] = {}
        for e, f in terms.items():
            faces.setdefault(e[width:], {})[e[:width]] = f
        collected: dict[Monomial, Terms] = {}
        for rest, dress in self._groups[g].wardrobe.choose(faces).items():
            for mono, f in dress:
                collected.setdefault(mono, {})[rest] = f
        parts = []
        for mono, part in collected.items():
            sign, wave = self._wave_mono(mono, g)
            parts.append((wave, part if sign > 0 else {e: -f for e, f in part.items()}))
        return self._paired(parts, lambda part: self._by_angles(inner, part))

    def _without_angles(self, frame: Frame, terms: Terms) -> Node:
        """Parameters, and velocities where they have come along."""
        if frame.rates:
            split = split_tail(terms, len(frame.rates))
            inner = frame.without_rates()
            return self._merged(split, frame.rates, lambda part: self._without_angles(inner, part))
        poly: Poly = {}
        for e, f in terms.items():
            mono = self._mono(frame.symbols, e)
            poly[mono] = poly.get(mono, 0) + f
        return self.collector.form(poly)
