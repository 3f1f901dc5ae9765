"""The compact form: from a normal form to what a textbook would print.

    d₁₁ = m₁ l_c1² + m₂ (l₁² + l_c2² + 2 l₁ l_c2 c₂) + I₁ + I₂

1. A polynomial is collected by velocities and accelerations; those that share a
   coefficient are merged, (q̇₂ + q̇₃).
2. A coefficient is a sum over monomials in the parameters of small trigonometric
   polynomials.  Each is written in its best dress (`algebra.dress`), an angle group
   at a time from the base outwards, and dresses that others wear already are
   preferred.
3. What is left are polynomials in the parameters (`algebra.collect`): common
   factors out, masses first, recurring sums of lengths kept together.

Masses may be collected first or last; the cheaper of the two is taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from flint import Ordering, fmpq_mpoly_ctx

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.build import negated, split_sign, times, total
from dynsolve.algebra.collect import Atoms, Collector, Mono, Poly, Rank, content, multiply, scaled_key
from dynsolve.algebra.dress import Dress, Monomial, dresses
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Generator, Ring
from dynsolve.notation import tree
from dynsolve.notation.tree import ZERO, Function, Node, Number, Product, Sum, Symbol, number

Terms = dict[tuple[int, ...], Fraction]
"""{exponents of all generators: factor}"""

LARGE = 400
"""From this number of terms on only one way of collecting is tried."""


class _Chosen(NamedTuple):
    dress: Dress
    scale: Fraction


class Compactor:
    """Writes exact expressions of one ring as a person would.

    `leading` names the masses and moments of inertia; `parallel` are groups of
    coordinates that turn about parallel axes.

    >>> from dynsolve.notation.python import to_python
    >>> ring = Ring.build([("q1", "revolute")], [Symbol("l")], [Angle.of("q1")])
    >>> s, c, l = ring.sin(Angle.of("q1")), ring.cos(Angle.of("q1")), ring.symbol("l")
    >>> to_python(Compactor(ring).form(l * c * c - l * s * s))
    'l*cos(2*q1)'
    """

    def __init__(
        self, ring: Ring, leading: Iterable[str] = (), parallel: Iterable[Iterable[str]] = ()
    ) -> None:
        self.ring = ring
        self.atoms = Atoms()
        self.collector = Collector(self.atoms)
        self._leading = {name: i for i, name in enumerate(leading)}
        self._kind: list[str] = []
        self._lay_atoms()
        self._rates = [i for i, kind in enumerate(self._kind) if kind == "rate"]
        self._leading_places = [i for i, kind in enumerate(self._kind) if kind == "leading"]
        self._groups = _angle_groups(ring, [frozenset(g) for g in parallel])
        self._forms: dict[str, Node] = {}
        self._scalars: dict[frozenset[tuple[tuple[int, ...], Fraction]], Node] = {}
        self._dressed: dict[tuple[int, frozenset[tuple[tuple[int, ...], Fraction]]], list[Dress]] = {}
        self._waves: dict[tuple[str, Angle], tuple[int, Node]] = {}

    # -- atoms -------------------------------------------------------------------------------------

    def _lay_atoms(self) -> None:
        """Number the symbols in printing order: masses and inertias, g, the other parameters, coordinates."""
        self._kind = [self._kind_of(g) for g in self.ring.generators]
        ranks = {"leading": Rank.LEADING, "coordinate": Rank.COORDINATE, "rate": Rank.RATE}

        def place(g: Generator) -> tuple[object, ...]:
            rank = ranks.get(self._kind[g.index], Rank.PARAMETER)
            return rank, self._leading.get(g.name, 0), g.dots != 2, g.name != "g", g.index

        for g in sorted(self.ring.generators, key=place):
            if g.kind in ("symbol", "root"):
                self.atoms.number(self._node_of(g), ranks.get(self._kind[g.index], Rank.PARAMETER))

    def _kind_of(self, g: Generator) -> str:
        if g.kind == "symbol":
            if g.dots:
                return "rate"
            if g.name in self._leading:
                return "leading"
            return "coordinate" if g.name in self.ring.names else "parameter"
        return "angle" if g.kind in ("sin", "cos") else "parameter"

    def _node_of(self, g: Generator) -> Node:
        match g.kind:
            case "symbol":
                return Symbol(g.name, g.dots)
            case "root":
                assert g.node is not None
                return Function("sqrt", g.node)
            case "constant":
                return Function("cos", _angle_node(g.angle))
        return self._poly_node(self.ring.inverses[g.index])

    def _poly_node(self, poly: object) -> Node:
        return self.form(Expr(self.ring, poly))

    def _mono(self, exponents: Sequence[int], used: Iterable[int]) -> Mono:
        """The monomial in atoms of some generators' exponents; an inverse has a negative exponent."""
        mono: Mono = ()
        for i in used:
            if exponents[i]:
                g = self.ring.generators[i]
                sign = -1 if g.kind == "inverse" else 1
                mono = multiply(mono, ((self.atoms.number(self._node_of(g)), sign * exponents[i]),))
        return mono

    # -- the entrance ------------------------------------------------------------------------------

    def form(self, expr: Expr) -> Node:
        """The compact tree of an expression."""
        if expr.is_zero:
            return ZERO
        key = str(expr.poly)
        found = self._forms.get(key)
        if found is None:
            found = self._forms[key] = self._by_rates(self._terms(expr))
        return found

    def matrix(self, matrix: Matrix) -> tree.Matrix:
        """The compact trees of a matrix's entries."""
        return tree.Matrix(tuple(tuple(map(self.form, row)) for row in matrix.rows))

    def _terms(self, expr: Expr) -> Terms:
        """{exponents: factor}, read off through a ring of the used generators alone, which is faster."""
        degrees = expr.poly.degrees()
        used = [i for i, d in enumerate(degrees) if d]
        if not used:
            return {(0,) * len(degrees): expr.number}
        small = fmpq_mpoly_ctx.get(("x", len(used)), Ordering.lex)
        projected = expr.poly.project_to_context(small, {i: k for k, i in enumerate(used)})
        width = len(degrees)
        result: Terms = {}
        for exponents, f in projected.to_dict().items():
            full = [0] * width
            for i, e in zip(used, exponents, strict=True):
                full[i] = int(e)
            result[tuple(full)] = Fraction(int(f.p), int(f.q))
        return result

    # -- by velocities and accelerations -----------------------------------------------------------

    def _by_rates(self, terms: Terms) -> Node:
        """The cheaper of two ways: velocities outside, or the angles outside and the velocities with the parameters."""
        split = _split(terms, self._rates)
        if len(split) == 1 and not any(next(iter(split))):
            return self._scalar(terms)
        outside = self._merged(split, self._rates, self._scalar)
        if len(split) == 1 or len(terms) > LARGE:
            return outside
        inside = self._trig_outer(terms, 0)
        return min(outside, inside, key=self.collector.cost)

    def _merged(
        self, split: Mapping[tuple[int, ...], Terms], places: Sequence[int], form: Callable[[Terms], Node]
    ) -> Node:
        """Σ part · monomial, where monomials whose parts differ by a rational factor are summed first."""
        shared: dict[object, tuple[Terms, Poly]] = {}
        for key, part in split.items():
            identity, lead = scaled_key(part)
            first, factors = shared.setdefault(identity, (part, {}))
            factors[self._mono_at(places, key)] = lead / first[min(first)]
        return self.collector.sum_of(
            times(1, [(form(part), 1), (self.collector.form(factors), 1)]) for part, factors in shared.values()
        )

    # -- coefficients: no velocities ----------------------------------------------------------------

    def _scalar(self, terms: Terms) -> Node:
        """The cheaper of two ways: angles outside and masses inside, or masses outside."""
        key = frozenset(terms.items())
        found = self._scalars.get(key)
        if found is None:
            shared, rest = self._without_common(terms)
            found = self._trig_outer(rest, 0)
            split = _split(rest, self._leading_places)
            if len(terms) <= LARGE and len(split) > 1:
                other = self._merged(split, self._leading_places, lambda part: self._trig_outer(part, 0))
                found = min(other, found, key=self.collector.cost)
            found = self._scalars[key] = self.collector.sum_of([times(1, [(shared, 1), (found, 1)])])
        return found

    def _without_common(self, terms: Terms) -> tuple[Node, Terms]:
        """(what all terms share of parameters and numbers, the rest)"""
        places = [i for i, kind in enumerate(self._kind) if kind not in ("angle", "rate")]
        least = [min(e[i] for e in terms) if i in places else 0 for i in range(len(self._kind))]
        factor = content(terms.values())
        rest = {tuple(x - y for x, y in zip(e, least, strict=True)): f / factor for e, f in terms.items()}
        return self.collector.product(factor, self._mono(least, places), ()), rest

    def _mono_at(self, generators: Sequence[int], exponents: Sequence[int]) -> Mono:
        full = [0] * len(self._kind)
        for i, e in zip(generators, exponents, strict=True):
            full[i] = e
        return self._mono(full, generators)

    # -- angle groups from the base outwards ----------------------------------------------------------

    def _trig_outer(self, terms: Terms, level: int) -> Node:
        for g in range(level, len(self._groups)):
            group = self._groups[g]
            if any(e[i] for e in terms for pair in group.pairs for i in (pair.sine, pair.cosine)):
                return self._by_group(terms, g)
        return self._leaf(terms)

    def _leaf(self, terms: Terms) -> Node:
        """No angles left: parameters, and velocities where they have come along."""
        split = _split(terms, self._rates)
        if len(split) > 1:
            return self._merged(split, self._rates, self._leaf)
        return self.collector.form({self._mono(e, range(len(e))): f for e, f in terms.items()})

    def _by_group(self, terms: Terms, g: int) -> Node:
        """Σ b · X_b over the monomials b of one angle group."""
        group = self._groups[g]
        places = [i for pair in group.pairs for i in (pair.sine, pair.cosine)]
        faces: dict[tuple[int, ...], dict[tuple[int, ...], Fraction]] = {}
        for e, f in terms.items():
            rest = list(e)
            for i in places:
                rest[i] = 0
            faces.setdefault(tuple(rest), {})[tuple(e[i] for i in places)] = f
        collected: dict[Monomial, Terms] = {}
        for rest_key, chosen in self._choose(faces, g).items():
            for mono, f in chosen.dress.items():
                collected.setdefault(mono, {})[rest_key] = f * chosen.scale
        return self._summed(collected, g)

    def _summed(self, collected: Mapping[Monomial, Terms], g: int) -> Node:
        """Σ b · X_b, with monomials that share their X up to a factor merged."""
        shared: dict[object, tuple[Terms, Poly]] = {}
        for mono, part in collected.items():
            identity, lead = scaled_key(part)
            first, factors = shared.setdefault(identity, (part, {}))
            factors[self._wave_mono(mono, g)] = lead / first[min(first)]
        return self.collector.sum_of(
            times(1, [(self._trig_outer(part, g + 1), 1), (self.collector.form(factors), 1)])
            for part, factors in shared.values()
        )

    def _wave_mono(self, mono: Monomial, g: int) -> Mono:
        result: Mono = ()
        for (name, turns), exponent in mono:
            atom = self._wave_atom(name, self._groups[g].angle(turns))
            result = multiply(result, ((atom, exponent),))
        return result

    def _wave_atom(self, name: str, angle: Angle) -> int:
        key = (name, angle)
        found = self._waves.get(key)
        if found is None:
            node = Function(name, _angle_node(angle))
            found = self._waves[key] = (self.atoms.number(node, Rank.WAVE), node)
        return found[0]

    # -- the choice of dresses --------------------------------------------------------------------------

    def _choose(
        self, faces: Mapping[tuple[int, ...], dict[tuple[int, ...], Fraction]], g: int
    ) -> dict[tuple[int, ...], _Chosen]:
        """A dress for each face: the cheapest, then again with what others wear already at half price."""
        options: dict[tuple[int, ...], tuple[list[Dress], Fraction]] = {}
        for rest, face in faces.items():
            lead = face[min(face)]
            key = (g, frozenset((e, f / lead) for e, f in face.items()))
            known = self._dressed.get(key)
            if known is None:
                known = self._dressed[key] = dresses({e: f / lead for e, f in face.items()})
            options[rest] = (known, lead)
        worn: dict[Monomial, int] = {}
        picked: dict[tuple[int, ...], Dress] = {}
        for _ in range(2):
            picked = {
                rest: min(known, key=lambda d: _dress_cost(d, worn)) for rest, (known, _) in options.items()
            }
            worn = {}
            for dress in picked.values():
                for mono in dress:
                    worn[mono] = worn.get(mono, 0) + 1
        return {rest: _Chosen(picked[rest], lead) for rest, (_, lead) in options.items()}


def _dress_cost(dress: Dress, worn: Mapping[Monomial, int]) -> float:
    """What a dress costs: its terms, each with its coefficient, and what it takes to write the waves."""
    price = 0.0
    for mono, factor in dress.items():
        waves = sum(_wave_cost(turns) + (e > 1) + 1 for (_, turns), e in mono)
        new = waves if worn.get(mono, 0) < 2 else waves / 4
        price += 3 + new + (0.5 if abs(factor) != 1 else 0)
    return price


def _wave_cost(turns: Sequence[int]) -> int:
    return 1 + sum(1 + (abs(t) != 1) for t in turns if t) - 1


def _split(terms: Terms, places: Sequence[int]) -> dict[tuple[int, ...], Terms]:
    """The terms by their exponents at some places, which are put to 0."""
    result: dict[tuple[int, ...], Terms] = {}
    for e, f in terms.items():
        key = tuple(e[i] for i in places)
        if any(key):
            rest = list(e)
            for i in places:
                rest[i] = 0
            e = tuple(rest)
        result.setdefault(key, {})[e] = f
    return result


class _Group(NamedTuple):
    """The basic angles of one parallel group."""

    pairs: tuple[object, ...]

    def angle(self, turns: Sequence[int]) -> Angle:
        total_angle = Angle()
        for pair, t in zip(self.pairs, turns, strict=True):
            total_angle = total_angle + pair.angle * t  # type: ignore[attr-defined]
        return total_angle


def _angle_groups(ring: Ring, parallel: Sequence[frozenset[str]]) -> list[_Group]:
    """The pairs by parallel group, in the order of their first coordinates; constant angles last."""
    groups: list[tuple[set[str], list[object]]] = []
    for pair in ring.pairs:
        names = {name for atom, _ in pair.angle.terms for name, _ in atom} & set(ring.names)
        for group in parallel:
            if names & group:
                names |= group
        for known, members in groups:
            if known & names:
                known |= names
                members.append(pair)
                break
        else:
            groups.append((names, [pair]))
    groups.sort(key=lambda g: min((ring.names.index(n) for n in g[0] if n in ring.names), default=len(ring.names)))
    return [_Group(tuple(members)) for _, members in groups]


def _angle_node(angle: Angle) -> Node:
    """An angle as a tree: θ₁ + θ₂, 2θ₂ - β/2."""
    terms: list[Node] = []
    for atom, rate in angle.terms:
        node = times(rate, [(Symbol(name), e) for name, e in atom])
        terms.append(node)
    if angle.degrees:
        d = angle.degrees
        node = tree.Degrees(abs(d.numerator), d.denominator)
        terms.append(negated(node) if d < 0 else node)
    return total(terms) if terms else Number(0)
