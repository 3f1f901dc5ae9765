"""The ring: polynomials in sines, cosines and symbols, with a normal form.

Every quantity of a manipulator's dynamics is a polynomial with rational
coefficients in the sines s and cosines c of a few basic angles, in lengths,
masses, velocities, accelerations, and in the roots and inverses that the problem
file writes down.  Modulo the relations

    s² + c² = 1,   r² = radicand,   u·p = 1,

each has one normal form: two expressions are equal exactly when their normal
forms are the same.  That is a proof and not a heuristic.  Products are FLINT's.

The basic angles are chosen once for a robot, so that every angle that occurs is
an integer combination of them: the absolute angles of parallel joints, θ₁, θ₁ + θ₂,
and halves where half an angle occurs.

`ring_plan` says what a ring must hold for some formulas, `ring_values` makes the ring,
and gives the value of a formula in it, and that of an element in numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from dynsolve.algebra.angles import Angle, Atom, name_alone, names_of
from dynsolve.algebra.generators import (
    Generator,
    Pair,
    Relations,
    dotted,
    is_sign,
    lay_out,
    sine_cosine_pairs,
)
from dynsolve.algebra.rationals import fraction, rational
from dynsolve.algebra.ring_plan import ConstantAngles, RingPlan, minimal_polynomial
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function, Node, Number

Terms = tuple[tuple[float, tuple[tuple[int, int], ...]], ...]
"""Of each term its coefficient, and its generators with their powers."""


def terms_of(poly: fmpq_mpoly) -> Terms:
    """The terms of a polynomial in floating point."""
    places = [index for index, degree in enumerate(poly.degrees()) if degree > 0]
    return tuple(
        (
            int(coefficient.p) / int(coefficient.q),
            tuple((index, int(exponents[index])) for index in places if exponents[index]),
        )
        for exponents, coefficient in zip(poly.monoms(), poly.coeffs(), strict=True)
    )


class Expr:
    """An element of a ring, in normal form.  Immutable; `==` decides equality exactly."""

    __slots__ = ("_terms", "poly", "ring")

    def __init__(self, ring: Ring, poly: fmpq_mpoly) -> None:
        self.ring = ring
        self.poly = poly
        self._terms: Terms | None = None

    def __add__(self, other: Expr) -> Expr:
        return Expr(self.ring, self.poly + other.poly)

    def __sub__(self, other: Expr) -> Expr:
        return Expr(self.ring, self.poly - other.poly)

    def __neg__(self) -> Expr:
        return Expr(self.ring, -self.poly)

    def __mul__(self, other: Expr | int | Fraction) -> Expr:
        if isinstance(other, Expr):
            return Expr(self.ring, self.ring.reduce(self.poly * other.poly))
        return Expr(self.ring, self.poly * rational(other))

    __rmul__ = __mul__

    def __truediv__(self, other: int | Fraction) -> Expr:
        return Expr(self.ring, self.poly / rational(other))

    def __pow__(self, exponent: int) -> Expr:
        power = self.ring.one
        for _ in range(exponent):
            power = power * self
        return power

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Expr) and bool(self.poly == other.poly)

    def __hash__(self) -> int:
        return hash(str(self.poly))

    def __repr__(self) -> str:
        """The normal form as text, for people who debug."""
        names = [_text(g) for g in self.ring.generators]
        terms = []
        for exponents, coefficient in self.poly.to_dict().items():
            powers = [f"{names[i]}^{e}" if e > 1 else names[i] for i, e in enumerate(exponents) if e]
            terms.append("*".join([str(coefficient), *powers]))
        return f"Expr({' + '.join(terms) or '0'})"

    @property
    def is_zero(self) -> bool:
        """Whether it is 0."""
        return not self.poly

    @property
    def is_number(self) -> bool:
        """Whether it is a rational number."""
        return bool(self.poly.is_constant())

    @property
    def used(self) -> tuple[int, ...]:
        """The places of the generators that occur."""
        return tuple(i for i, degree in enumerate(self.poly.degrees()) if degree > 0)

    @property
    def terms(self) -> Terms:
        """Its terms in floating point, written once: it is evaluated at many points."""
        if self._terms is None:
            self._terms = terms_of(self.poly)
        return self._terms

    def quotient(self, divisor: Expr) -> Expr | None:
        """This over a divisor, None where that does not divide it."""
        quotient, rest = divmod(self.poly, divisor.poly)
        return None if rest else Expr(self.ring, quotient)

    def __len__(self) -> int:
        """The number of terms of the normal form."""
        return len(self.poly)

    @property
    def number(self) -> Fraction:
        """Its value where `is_number`."""
        value = self.poly.leading_coefficient() if self.poly else fmpq(0)
        return fraction(value)


def _text(g: Generator) -> str:
    if g.kind in ("sin", "cos"):
        return f"{g.kind}({' + '.join(f'{rate}*{atom}' for atom, rate in g.angle.terms)})"
    return dotted(g.name, g.dots) or f"{g.kind}{g.index}"


MOST_TURNS = 64
"""The largest multiple of a basic angle that is expanded."""


class Ring:
    """The ring of one robot; see the module's text.  `build.build_ring` makes one.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> coordinates = [("q1", "revolute"), ("q2", "revolute")]
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> ring = build_ring(coordinates, [Symbol("l1")], [Angle.of("q1"), both])
    >>> s, c = ring.sin(both), ring.cos(both)
    >>> s * s + c * c == ring.one
    True
    """

    def __init__(self, coordinates: Sequence[tuple[str, str]], plan: RingPlan) -> None:
        self.coordinates = tuple(coordinates)
        self.names = tuple(name for name, _ in coordinates)
        self.plan = plan
        self.generators = lay_out(plan)
        self.ctx: Any = fmpq_mpoly_ctx.get(("x", max(len(self.generators), 1)), Ordering.lex)
        self._gens: tuple[fmpq_mpoly, ...] = self.ctx.gens()
        self.zero = Expr(self, self.ctx.constant(0))
        self.one = Expr(self, self.ctx.constant(1))
        self.symbol_indices = {(g.name, g.dots): g.index for g in self.generators if g.kind == "symbol"}
        self.parameters = tuple(name for name in plan.symbols if name not in self.names)
        self.pairs = sine_cosine_pairs(self.generators)
        self._relations = Relations(self._gens, self.pairs)
        self.reduce = self._relations.reduce
        self.reduce_roots = self._relations.reduce_roots
        self.relations = self._relations.of
        self.radicands = self._relations.radicands
        self.inverses = self._relations.inverses
        self._signs = tuple(g.index for g in self.generators if is_sign(g.node))
        self._spare_inverses = [g.index for g in self.generators if g.kind == "inverse"]
        self._turned: dict[Angle, tuple[fmpq_mpoly, fmpq_mpoly]] = {}
        self._constants = ConstantAngles(
            plan.constants, self._constant_sqrt, self._constant_pair, self._constant_generator()
        )

    def _constant_generator(self) -> fmpq_mpoly | None:
        """cos δ, a zero of its minimal polynomial."""
        for g in self.generators:
            if g.kind == "constant":
                minimal, degree = minimal_polynomial(self._gens[g.index], g.angle.degrees)
                self._relations.adjoin_constant(g.index, degree, minimal)
                return self._gens[g.index]
        return None

    def dot(self, left: Sequence[Expr], right: Sequence[Expr]) -> Expr:
        """Σ left_k right_k, reduced once."""
        total = None
        for a, b in zip(left, right, strict=True):
            if a.poly and b.poly:
                product = a.poly * b.poly
                total = product if total is None else total + product
        return self.zero if total is None else Expr(self, self.reduce(total))

    # -- elements ----------------------------------------------------------------------------------

    def constant(self, value: int | Fraction) -> Expr:
        """The rational number `value`."""
        return self.one * value

    def generator(self, index: int) -> Expr:
        """One variable as an element of the ring."""
        return Expr(self, self._gens[index])

    def symbol(self, name: str, dots: int = 0) -> Expr:
        """A coordinate, its velocity (dots = 1) or acceleration (2), or a parameter."""
        index = self.symbol_indices.get((name, dots))
        if index is None:
            raise AlgebraError(f"{dotted(name, dots)} is not a symbol of this problem")
        return Expr(self, self._gens[index])

    def function(self, node: Function) -> Expr:
        """A function that is a generator of its own."""
        for g in self.generators:
            if g.kind == "function" and g.node == node:
                return self.generator(g.index)
        raise AlgebraError(f"this {node.name} does not occur in the problem")

    def has_symbol(self, name: str, dots: int = 0) -> bool:
        """Whether the ring has this symbol."""
        return (name, dots) in self.symbol_indices

    def cos(self, angle: Angle) -> Expr:
        """The cosine of an angle that the ring was built for."""
        return Expr(self, self._turn(angle)[0])

    def sin(self, angle: Angle) -> Expr:
        """The sine of an angle that the ring was built for."""
        return Expr(self, self._turn(angle)[1])

    def _turn(self, angle: Angle) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        found = self._turned.get(angle)
        if found is None:
            multiples, degrees = self.plan.multiples(angle)
            c, s = self._constants.cos_sin(degrees, self.ctx)
            for pair, times in zip(self.pairs, multiples, strict=True):
                c2, s2 = self._times(pair, times)
                c, s = self.reduce(c * c2 - s * s2), self.reduce(s * c2 + c * s2)
            found = self._turned[angle] = (c, s)
        return found

    def _times(self, pair: Pair, times: int) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """cos and sin of a multiple of a basic angle."""
        if abs(times) > MOST_TURNS:
            raise AlgebraError(
                f"an angle of {abs(times)} times a basic angle is more than {MOST_TURNS} times"
            )
        c1, s1 = self._gens[pair.cosine], self._gens[pair.sine]
        c, s = self.ctx.constant(1), self.ctx.constant(0)
        for _ in range(abs(times)):
            c, s = self.reduce(c * c1 - s * s1), self.reduce(s * c1 + c * s1)
        return c, (s if times > 0 else -s)

    def multiples(self, angle: Angle) -> tuple[int, ...]:
        """The multiples of the basic angles, one a pair, that add up to an angle without its constant."""
        return self.plan.multiples(angle)[0]

    def root(self, argument: Node, value: Expr) -> Expr:
        """The square root of a tree with this value: of a number exactly, of anything else as a generator."""
        if value.is_number:
            return Expr(self, self._constants.sqrt(value.number, self.ctx))
        for g in self.generators:
            if g.kind == "root" and g.node == argument:
                return self.generator(g.index)
        raise AlgebraError("this root does not occur in the problem")

    def adjoin_root(self, index: int, radicand: Expr) -> None:
        """Make a generator the square root of an expression in the generators laid out after it."""
        self._relations.adjoin_root(index, radicand.poly)

    def _constant_sqrt(self, prime: int) -> fmpq_mpoly | None:
        for g in self.generators:
            if g.kind == "root" and g.node == Number(prime):
                return self._gens[g.index]
        return None

    def _constant_pair(self, i: int, times: int) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        pairs = self.pairs[len(self.pairs) - len(self.plan.constants.pairs) :]
        return self._times(pairs[i], times)

    # -- inverses ----------------------------------------------------------------------------------

    def inverse(self, expr: Expr) -> Expr:
        """1 / expr, for an expression without coordinates.

        Each irreducible factor p gets a generator u with the relation u·p = 1.
        """
        if expr.is_zero:
            raise AlgebraError("the denominator is zero")
        if self.depends_on_coordinates(expr):
            raise AlgebraError(
                "a denominator contains a joint variable", "denominators are free of coordinates"
            )
        rationalized = self._relations.rationalized(expr.poly)
        if rationalized is not None:
            conjugate, norm = rationalized
            return Expr(self, conjugate) * self.inverse(Expr(self, norm))
        content, factors = expr.poly.factor()
        result = self.one * Fraction(int(content.q), int(content.p))
        for factor, times in factors:
            result = result * (self._inverse_generator(factor) ** int(times))
        return result

    def conjugate(self, expr: Expr) -> Expr | None:
        """a - b√p of an expression a + b√p; None where it has no square root."""
        found = self._relations.rationalized(expr.poly)
        return None if found is None else Expr(self, found[0])

    def _inverse_generator(self, factor: fmpq_mpoly) -> Expr:
        lead = factor.leading_coefficient()
        factor = factor / lead
        for index, known in self.inverses.items():
            if known == factor:
                return self.generator(index) * Fraction(int(lead.q), int(lead.p))
        if not self._spare_inverses:
            raise NoRoom
        index = self._spare_inverses.pop()
        self._relations.adjoin_inverse(index, factor)
        return self.generator(index) * Fraction(int(lead.q), int(lead.p))

    # -- calculus ----------------------------------------------------------------------------------

    @cached_property
    def _rates(self) -> tuple[tuple[tuple[Pair, Fraction], ...], ...]:
        """For each coordinate the pairs whose angle depends linearly on it, with the rate."""
        return tuple(
            tuple(
                (pair, rate) for pair in self.pairs for atom, rate in pair.angle.terms if atom == ((name, 1),)
            )
            for name in self.names
        )

    @cached_property
    def _product_rates(self) -> tuple[tuple[tuple[Pair, Expr], ...], ...]:
        """For each coordinate the pairs with it in a product, as in sin(q₂ q₃), with ∂angle/∂q."""
        return tuple(
            tuple((pair, rate) for pair in self.pairs if not (rate := self._product_rate(pair, name)).is_zero)
            for name in self.names
        )

    def _product_rate(self, pair: Pair, name: str) -> Expr:
        rate = self.zero
        for atom, factor in pair.angle.terms:
            if atom != ((name, 1),) and dict(atom).get(name, 0) > 0:
                rate = rate + self._atom_slope(atom, name) * factor
        return rate

    def _atom_slope(self, atom: Atom, name: str) -> Expr:
        """∂atom/∂name of a product of names."""
        slope = self.constant(dict(atom)[name])
        for other, exponent in atom:
            power = exponent - (other == name)
            factor = self.symbol(other) if power >= 0 else self.inverse(self.symbol(other))
            slope = slope * factor ** abs(power)
        return slope

    def diff(self, expr: Expr, k: int) -> Expr:
        """∂expr/∂q_k, k from 0, at constant velocities."""
        total = expr.poly.derivative(self.symbol_indices[(self.names[k], 0)])
        for pair, rate in self._rates[k]:
            total += self._by_angle(expr, pair) * rational(rate)
        for pair, slope in self._product_rates[k]:
            total += self._by_angle(expr, pair) * slope.poly
        return Expr(self, self.reduce(total))

    def _by_angle(self, expr: Expr, pair: Pair) -> fmpq_mpoly:
        """∂expr/∂angle, by (sin α)' = cos α and (cos α)' = -sin α."""
        turned = expr.poly.derivative(pair.sine) * self._gens[pair.cosine]
        turned -= expr.poly.derivative(pair.cosine) * self._gens[pair.sine]
        return turned

    def diff_velocity(self, expr: Expr, k: int) -> Expr:
        """∂expr/∂q̇_k, k from 0."""
        return Expr(self, expr.poly.derivative(self.symbol_indices[(self.names[k], 1)]))

    def time_derivative(self, expr: Expr) -> Expr:
        """d expr/dt = Σ_k ∂expr/∂q_k q̇_k + ∂expr/∂q̇_k q̈_k."""
        total = self.zero
        for k, name in enumerate(self.names):
            total += self.diff(expr, k) * self.symbol(name, 1)
            total += self.diff_velocity(expr, k) * self.symbol(name, 2)
        return total

    def coefficient(self, expr: Expr, name: str, dots: int = 0) -> Expr:
        """∂expr/∂symbol: of an expression linear in the symbol, its coefficient."""
        return Expr(self, expr.poly.derivative(self.symbol_indices[(name, dots)]))

    def without(self, expr: Expr, dots: int) -> Expr:
        """The expression with all velocities (dots = 1) or accelerations (dots = 2) put to 0; sgn 0 is 0."""
        poly = expr.poly
        degrees = poly.degrees()
        indices = [self.symbol_indices[(name, dots)] for name in self.names]
        for index in (*indices, *(self._signs if dots == 1 else ())):
            if degrees[index]:
                poly %= self._gens[index]
        return Expr(self, poly)

    def at_rest(self, expr: Expr) -> Expr:
        """The expression at q = 0."""
        used = expr.poly.degrees()
        there = {self.symbol_indices[(name, 0)]: self.ctx.constant(0) for name in self.names}
        for pair in {pair for pairs in self._rates for pair, _ in pairs}:
            if used[pair.sine] or used[pair.cosine]:
                there[pair.cosine], there[pair.sine] = self._turn(self.plan.at_rest(pair.angle))
        return self.put(expr, there)

    def at_pose(self, expr: Expr, pose: Mapping[str, Fraction | int]) -> Expr:
        """The value where some coordinates have so many degrees in its sines and cosines."""
        there, used = {}, expr.poly.degrees()
        for pair in self.pairs:
            if used[pair.sine] > 0 or used[pair.cosine] > 0:
                angle = Angle((), pair.angle.degrees)
                for atom, rate in pair.angle.terms:
                    at = pose.get(name_alone(atom))
                    angle = angle + (Angle(((atom, rate),)) if at is None else Angle((), rate * at))
                there[pair.cosine], there[pair.sine] = self._turn(angle)
        return self.put(expr, there)

    def put(self, expr: Expr, images: Mapping[int, fmpq_mpoly]) -> Expr:
        """The expression with polynomials for some generators."""
        if not expr.poly:
            return expr
        point = [images.get(i, g) for i, g in enumerate(self._gens)]
        return Expr(self, self.reduce(expr.poly.compose(*point, ctx=self.ctx)))

    @cached_property
    def moving(self) -> frozenset[int]:
        """The generators of coordinates, their rates and the sines and cosines of what turns."""
        turning = {
            i
            for pair in self.pairs
            if not set(self.names).isdisjoint(names_of(pair.angle))
            for i in (pair.sine, pair.cosine)
        }
        symbols = {i for (name, _), i in self.symbol_indices.items() if name in self.names}
        return frozenset(turning | symbols | set(self._signs))

    def depends_on_coordinates(self, expr: Expr) -> bool:
        """Whether a coordinate, its velocity or acceleration occurs."""
        degrees = expr.poly.degrees()
        return any(degrees[i] > 0 for i in self.moving)  # of 0 they are -1

    def moving_degree(self, expr: Expr) -> int:
        """The degree in the coordinates, the sines and cosines of their angles, and their rates."""
        return max((sum(int(e[i]) for i in self.moving) for e in expr.poly.monoms()), default=0)


class NoRoom(Exception):
    """The ring needs more generators for inverses than were set aside."""
