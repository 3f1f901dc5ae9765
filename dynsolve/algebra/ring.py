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
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import comb, cos, pi, radians, sin, sqrt
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from dynsolve.algebra.angles import Angle, Atom, angle_from_tree
from dynsolve.algebra.constants import ConstantAngles
from dynsolve.algebra.survey import Survey, survey
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

MOST_TERMS = 200_000
"""A product that may have more terms than this is refused before it is formed."""

MOST_TURNS = 64
"""The largest multiple of a basic angle that is expanded."""


@dataclass(frozen=True, slots=True)
class Generator:
    """What a variable of the polynomial ring stands for.

    kind is one of `sin`, `cos` (with `angle`), `symbol` (with `name`, `dots`),
    `root` (√ of `node`), `inverse` (1 / `node`'s value, set when first met) or
    `constant` (cos of a constant `angle` of some degrees).
    """

    kind: str
    index: int
    name: str = ""
    dots: int = 0
    angle: Angle = Angle()
    node: Node | None = None


@dataclass(frozen=True, slots=True)
class Pair:
    """The sine and cosine of a basic angle, by the indices of their generators."""

    angle: Angle
    sine: int
    cosine: int


class Expr:
    """An element of a ring, in normal form.  Immutable; `==` decides equality exactly."""

    __slots__ = ("poly", "ring")

    def __init__(self, ring: Ring, poly: fmpq_mpoly) -> None:
        self.ring = ring
        self.poly = poly

    def __add__(self, other: Expr) -> Expr:
        return Expr(self.ring, self.poly + other.poly)

    def __sub__(self, other: Expr) -> Expr:
        return Expr(self.ring, self.poly - other.poly)

    def __neg__(self) -> Expr:
        return Expr(self.ring, -self.poly)

    def __mul__(self, other: Expr | int | Fraction) -> Expr:
        if isinstance(other, Expr):
            return Expr(self.ring, self.ring.reduce(self.poly * other.poly))
        return Expr(self.ring, self.poly * _rational(other))

    __rmul__ = __mul__

    def __truediv__(self, other: int | Fraction) -> Expr:
        return Expr(self.ring, self.poly / _rational(other))

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
        return f"Expr({self.ring.describe(self)})"

    @property
    def is_zero(self) -> bool:
        """Whether it is 0."""
        return not self.poly

    @property
    def is_number(self) -> bool:
        """Whether it is a rational number."""
        return bool(self.poly.is_constant())

    def __len__(self) -> int:
        """The number of terms of the normal form."""
        return len(self.poly)

    @property
    def number(self) -> Fraction:
        """Its value where `is_number`."""
        value = self.poly.leading_coefficient() if self.poly else fmpq(0)
        return Fraction(int(value.p), int(value.q))


class Ring:
    """The ring of one robot; see the module's text.

    >>> from dynsolve.notation.tree import Symbol
    >>> ring = Ring.build([("q1", "revolute"), ("q2", "revolute")], [Symbol("l1")], [Angle.of("q1"), Angle.of("q2")])
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> s, c = ring.sin(both), ring.cos(both)
    >>> s * s + c * c == ring.one
    True
    """

    def __init__(self, coordinates: Sequence[tuple[str, str]], plan: Survey) -> None:
        self.coordinates = tuple(coordinates)
        self.names = tuple(name for name, _ in coordinates)
        self._plan = plan
        self.generators = self._lay_out(plan)
        self.ctx: Any = fmpq_mpoly_ctx.get(("x", max(len(self.generators), 1)), Ordering.lex)
        self._gens: tuple[fmpq_mpoly, ...] = self.ctx.gens()
        self.zero = Expr(self, self.ctx.constant(0))
        self.one = Expr(self, self.ctx.constant(1))
        self._symbols = {(g.name, g.dots): g.index for g in self.generators if g.kind == "symbol"}
        self.parameters = tuple(name for name in plan.symbols if name not in self.names)
        self.pairs = self._make_pairs()
        self._pair_relations = [
            (p.sine, self._gens[p.sine] ** 2 + self._gens[p.cosine] ** 2 - 1) for p in self.pairs
        ]
        self._root_relations: list[tuple[int, int, fmpq_mpoly]] = []
        self._inverse_relations: list[tuple[int, fmpq_mpoly]] = []
        self._spare_inverses = [g.index for g in self.generators if g.kind == "inverse"]
        self.inverses: dict[int, fmpq_mpoly] = {}
        self._turned: dict[Angle, tuple[fmpq_mpoly, fmpq_mpoly]] = {}
        self._constants = ConstantAngles(
            plan.constants, self._constant_sqrt, self._constant_pair, self._constant_generator()
        )
        self._settle_roots()

    @staticmethod
    def build(
        coordinates: Sequence[tuple[str, str]],
        trees: Iterable[Node],
        angles: Iterable[Angle] = (),
        preferred: Sequence[Angle] = (),
    ) -> Ring:
        """The smallest ring that holds everything in `trees` and the sine and cosine of `angles`.

        `coordinates` are (name, "revolute" | "prismatic"); `preferred` angles are
        taken as basic ones as far as they are independent.  Raises AlgebraError
        for a number used as an angle.
        """
        trees = tuple(trees)
        plan = survey([name for name, _ in coordinates], trees, tuple(preferred), tuple(angles))
        while True:
            try:
                ring = Ring(coordinates, plan)
                for tree in plan.denominators:
                    ring.expr(Quotient(Number(1), tree))
                return ring
            except _NoRoom:
                plan = plan.with_more_inverses()

    # -- the layout: reducible generators first, so that the lexicographic order reduces them ------

    def _lay_out(self, plan: Survey) -> tuple[Generator, ...]:
        laid: list[Generator] = []

        def add(kind: str, **what: Any) -> None:
            laid.append(Generator(kind, len(laid), **what))

        for _ in range(plan.inverses):
            add("inverse")
        for kind in ("sin", "cos"):
            for angle in plan.basic_angles:
                add(kind, angle=angle)
        for node in reversed(plan.roots):
            add("root", node=node)
        if plan.constants.generator_degrees is not None:
            add("constant", angle=Angle((), plan.constants.generator_degrees))
        for dots in (2, 1, 0):
            for name in self.names:
                add("symbol", name=name, dots=dots)
        for name in plan.symbols:
            if name not in self.names:
                add("symbol", name=name)
        return tuple(laid)

    def _make_pairs(self) -> tuple[Pair, ...]:
        sines = [g for g in self.generators if g.kind == "sin"]
        cosines = [g for g in self.generators if g.kind == "cos"]
        return tuple(Pair(s.angle, s.index, c.index) for s, c in zip(sines, cosines, strict=True))

    def _constant_generator(self) -> fmpq_mpoly | None:
        found = [g.index for g in self.generators if g.kind == "constant"]
        return self._gens[found[0]] if found else None

    def _settle_roots(self) -> None:
        generator = self._constant_generator()
        if generator is not None:
            index = next(g.index for g in self.generators if g.kind == "constant")
            relation, degree = self._constants.relation(generator)
            self._root_relations.append((index, degree, relation))
        for g in reversed([g for g in self.generators if g.kind == "root"]):
            assert g.node is not None
            self._root_relations.insert(0, (g.index, 2, self._gens[g.index] ** 2 - self.expr(g.node).poly))

    # -- normal form -------------------------------------------------------------------------------

    def reduce(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """The normal form of a polynomial."""
        if not self.pairs and not self._root_relations and not self._inverse_relations:
            return poly
        degrees = poly.degrees()
        for index, relation in self._pair_relations:
            if degrees[index] > 1:
                poly %= relation
        for index, degree, relation in self._root_relations:
            if poly.degrees()[index] >= degree:
                poly %= relation
        if self._inverse_relations:
            poly = self._without_inverses(poly)
        return poly

    def _without_inverses(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        before = None
        while poly != before:
            before = poly
            degrees = poly.degrees()
            for index, relation in self._inverse_relations:
                if degrees[index]:
                    poly %= relation
            for index, relation in self._pair_relations:
                if degrees[index] > 1:
                    poly %= relation
        return poly

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
        """The element that one variable is."""
        return Expr(self, self._gens[index])

    def symbol(self, name: str, dots: int = 0) -> Expr:
        """A coordinate, its velocity (dots = 1) or acceleration (2), or a parameter."""
        index = self._symbols.get((name, dots))
        if index is None:
            raise AlgebraError(f"{name}{'_' + 'd' * dots + 'ot' if dots else ''} is not a symbol of this problem")
        return Expr(self, self._gens[index])

    def has_symbol(self, name: str, dots: int = 0) -> bool:
        """Whether `symbol` knows it."""
        return (name, dots) in self._symbols

    def cos(self, angle: Angle) -> Expr:
        """The cosine of an angle that the ring was built for."""
        return Expr(self, self._turn(angle)[0])

    def sin(self, angle: Angle) -> Expr:
        """The sine of an angle that the ring was built for."""
        return Expr(self, self._turn(angle)[1])

    def _turn(self, angle: Angle) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        found = self._turned.get(angle)
        if found is None:
            c, s = self._constants.cos_sin(angle.degrees, self.ctx)
            for pair, times in self._multiples(angle):
                c2, s2 = self._times(pair, times)
                c, s = self.reduce(c * c2 - s * s2), self.reduce(s * c2 + c * s2)
            found = self._turned[angle] = (c, s)
        return found

    def _times(self, pair: Pair, times: int) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """cos and sin of a multiple of a basic angle."""
        if abs(times) > MOST_TURNS:
            raise AlgebraError(f"an angle of {abs(times)} times a basic angle is more than {MOST_TURNS} times")
        c1, s1 = self._gens[pair.cosine], self._gens[pair.sine]
        c, s = self.ctx.constant(1), self.ctx.constant(0)
        for _ in range(abs(times)):
            c, s = self.reduce(c * c1 - s * s1), self.reduce(s * c1 + c * s1)
        return c, (s if times > 0 else -s)

    def multiples(self, angle: Angle) -> tuple[int, ...]:
        """The integer coefficients of an angle's linear part in the basic angles, one a pair."""
        return self._plan.multiples(angle)

    def _multiples(self, angle: Angle) -> list[tuple[Pair, int]]:
        return [(p, m) for p, m in zip(self.pairs, self._plan.multiples(angle), strict=True) if m]

    # -- from trees --------------------------------------------------------------------------------

    def expr(self, node: Node) -> Expr:
        """The exact value of a tree.

        Raises AlgebraError for an unknown symbol, a zero denominator, an angle that
        is a bare number, or a product over the bound.
        """
        match node:
            case Number(p, q):
                return self.constant(Fraction(p, q))
            case Symbol(name, dots):
                return self.symbol(name, dots)
            case Negative(argument):
                return -self.expr(argument)
            case Parenthesized(argument):
                return self.expr(argument)
            case Sum(terms):
                return self._sum(map(self.expr, terms))
            case Product(factors):
                product = self.one
                for factor in factors:
                    product = self._product(product, self.expr(factor))
                return product
            case Quotient(numerator, denominator):
                return self._product(self.expr(numerator), self.inverse(self.expr(denominator)))
            case Power(base, exponent):
                return self._power(self.expr(base), exponent)
            case Function(name, argument):
                return self._function(name, argument)
            case Degrees(p, q):
                return self.symbol("pi") * Fraction(p, 180 * q)
        raise AlgebraError("this is not an expression")

    def _sum(self, terms: Iterable[Expr]) -> Expr:
        total = self.zero
        for term in terms:
            total = total + term
        return total

    def _product(self, left: Expr, right: Expr) -> Expr:
        if len(left.poly) * len(right.poly) > MOST_TERMS:
            raise AlgebraError("the product has too many terms", "write it with an abbreviation")
        return left * right

    def _power(self, base: Expr, exponent: Node) -> Expr:
        match exponent:
            case Number(p, 1):
                count = p
            case Negative(Number(p, 1)):
                base, count = self.inverse(base), p
            case _:
                raise AlgebraError("an exponent must be a whole number", "write sqrt(...) for a root")
        terms = max(len(base.poly), 1)
        if count > MOST_TURNS or comb(terms + count - 1, count) > MOST_TERMS:
            raise AlgebraError(f"the power {count} is too large")
        return base**count

    def _function(self, name: str, argument: Node) -> Expr:
        if name == "sqrt":
            return self._sqrt(argument)
        angle = angle_from_tree(argument)
        match name:
            case "sin":
                return self.sin(angle)
            case "cos":
                return self.cos(angle)
            case "tan":
                return self.sin(angle) * self.inverse(self.cos(angle))
        raise AlgebraError(f"{name} is not a function that occurs here", "known are sin, cos, tan and sqrt")

    def _sqrt(self, argument: Node) -> Expr:
        value = self.expr(argument)
        if value.is_number:
            return Expr(self, self._constants.sqrt(value.number, self.ctx))
        for g in self.generators:
            if g.kind == "root" and g.node == argument:
                return Expr(self, self._gens[g.index])
        raise AlgebraError("this root does not occur in the problem")

    def _constant_sqrt(self, prime: int) -> fmpq_mpoly | None:
        for g in self.generators:
            if g.kind == "root" and g.node == Number(prime):
                return self._gens[g.index]
        return None

    def _constant_pair(self, i: int, times: int) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        pairs = self.pairs[len(self.pairs) - len(self._plan.constants.pairs) :]
        return self._times(pairs[i], times)

    # -- inverses ----------------------------------------------------------------------------------

    def inverse(self, expr: Expr) -> Expr:
        """1 / expr, for an expression without coordinates.

        Each irreducible factor p gets a generator u with the relation u·p = 1.
        """
        if expr.is_zero:
            raise AlgebraError("the denominator is zero")
        if self.depends_on_coordinates(expr):
            raise AlgebraError("a denominator contains a joint variable", "denominators are free of coordinates")
        root = self._root_part(expr.poly)
        if root is not None:
            conjugate, norm = root
            return Expr(self, conjugate) * self.inverse(Expr(self, norm))
        content, factors = expr.poly.factor()
        result = self.one * Fraction(int(content.q), int(content.p))
        for factor, times in factors:
            result = result * (self._inverse_generator(factor) ** int(times))
        return result

    def _root_part(self, poly: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly] | None:
        """(conjugate, norm) of a polynomial in which a root of a number occurs: 1/(a+b√2) = (a-b√2)/(a²-2b²)."""
        degrees = poly.degrees()
        for index, degree, _ in self._root_relations:
            if degree == 2 and degrees[index]:
                conjugate = poly.compose(
                    *(-g if i == index else g for i, g in enumerate(self._gens)), ctx=self.ctx
                )
                return conjugate, self.reduce(poly * conjugate)
        return None

    def _inverse_generator(self, factor: fmpq_mpoly) -> Expr:
        lead = factor.leading_coefficient()
        factor = factor / lead
        for index, known in self.inverses.items():
            if known == factor:
                return self.generator(index) * Fraction(int(lead.q), int(lead.p))
        if not self._spare_inverses:
            raise _NoRoom
        index = self._spare_inverses.pop()
        self.inverses[index] = factor
        self._inverse_relations.append((index, self._gens[index] * factor - 1))
        return self.generator(index) * Fraction(int(lead.q), int(lead.p))

    # -- calculus ----------------------------------------------------------------------------------

    @cached_property
    def _rates(self) -> tuple[tuple[tuple[Pair, Fraction], ...], ...]:
        """For each coordinate the pairs whose angle it turns, with the rate."""
        return tuple(
            tuple(
                (pair, rate)
                for pair in self.pairs
                for atom, rate in pair.angle.terms
                if atom == ((name, 1),)
            )
            for name in self.names
        )

    def diff(self, expr: Expr, k: int) -> Expr:
        """∂expr/∂q_k, k from 0, at constant velocities."""
        poly = expr.poly
        total = poly.derivative(self._symbols[(self.names[k], 0)])
        for pair, rate in self._rates[k]:
            turned = poly.derivative(pair.sine) * self._gens[pair.cosine]
            turned -= poly.derivative(pair.cosine) * self._gens[pair.sine]
            total += turned * _rational(rate)
        return Expr(self, self.reduce(total))

    def diff_velocity(self, expr: Expr, k: int) -> Expr:
        """∂expr/∂q̇_k, k from 0."""
        return Expr(self, expr.poly.derivative(self._symbols[(self.names[k], 1)]))

    def time_derivative(self, expr: Expr) -> Expr:
        """d expr/dt = Σ_k ∂expr/∂q_k q̇_k + ∂expr/∂q̇_k q̈_k."""
        total = self.zero
        for k, name in enumerate(self.names):
            total += self.diff(expr, k) * self.symbol(name, 1)
            total += self.diff_velocity(expr, k) * self.symbol(name, 2)
        return total

    def coefficient(self, expr: Expr, name: str, dots: int = 0) -> Expr:
        """∂expr/∂symbol: of an expression linear in the symbol, its coefficient."""
        return Expr(self, expr.poly.derivative(self._symbols[(name, dots)]))

    def without(self, expr: Expr, dots: int) -> Expr:
        """The expression with all velocities (dots = 1) or accelerations (dots = 2) put to 0."""
        poly = expr.poly
        degrees = poly.degrees()
        for name in self.names:
            index = self._symbols[(name, dots)]
            if degrees[index]:
                poly %= self._gens[index]
        return Expr(self, poly)

    def at_rest(self, expr: Expr) -> Expr:
        """The expression at q = 0."""
        values = {self._symbols[(name, 0)]: 0 for name in self.names}
        for pairs in self._rates:
            for pair, _ in pairs:
                values |= {pair.sine: 0, pair.cosine: 1}
        return self._put(expr, values)

    def _put(self, expr: Expr, values: Mapping[int, int]) -> Expr:
        used = expr.poly.degrees()
        wanted = {i: v for i, v in values.items() if used[i]}
        if not wanted:
            return expr
        point = [self.ctx.constant(wanted[i]) if i in wanted else g for i, g in enumerate(self._gens)]
        return Expr(self, self.reduce(expr.poly.compose(*point, ctx=self.ctx)))

    @cached_property
    def _moving(self) -> frozenset[int]:
        turning = {i for pairs in self._rates for pair, _ in pairs for i in (pair.sine, pair.cosine)}
        return frozenset(turning | {index for (name, _), index in self._symbols.items() if name in self.names})

    def depends_on_coordinates(self, expr: Expr) -> bool:
        """Whether a coordinate, its velocity or acceleration occurs."""
        degrees = expr.poly.degrees()
        return any(degrees[i] > 0 for i in self._moving)  # of 0 they are -1

    # -- numbers -----------------------------------------------------------------------------------

    def evaluate(self, expr: Expr, values: Mapping[str, float]) -> float:
        """The value at plain names: `theta1`, `theta1_dot`, `theta1_ddot` and the parameters."""
        point = self.point(values)
        total = 0.0
        for exponents, coefficient in zip(expr.poly.monoms(), expr.poly.coeffs(), strict=True):
            term = int(coefficient.p) / int(coefficient.q)
            for value, exponent in zip(point, exponents, strict=True):
                if exponent:
                    term *= value ** int(exponent)
            total += term
        return total

    def point(self, values: Mapping[str, float]) -> list[float]:
        """The value of every generator."""
        point = [0.0] * len(self.generators)
        later: list[Generator] = []
        for g in reversed(self.generators):
            if g.kind == "symbol":
                name = g.name + ("", "_dot", "_ddot")[g.dots]
                point[g.index] = pi if g.name == "pi" else values.get(name, 0.0)
            elif g.kind in ("sin", "cos", "constant"):
                angle = radians(float(g.angle.degrees)) + sum(
                    float(rate) * _atom_value(atom, values) for atom, rate in g.angle.terms
                )
                point[g.index] = sin(angle) if g.kind == "sin" else cos(angle)
            else:
                later.append(g)
        for g in sorted(later, key=lambda g: (g.kind == "inverse", -g.index)):
            if g.kind == "root":
                assert g.node is not None
                point[g.index] = sqrt(self._value(self.expr(g.node).poly, point))
            elif g.index in self.inverses:
                point[g.index] = 1 / self._value(self.inverses[g.index], point)
        return point

    @staticmethod
    def _value(poly: fmpq_mpoly, point: Sequence[float]) -> float:
        total = 0.0
        for exponents, coefficient in zip(poly.monoms(), poly.coeffs(), strict=True):
            term = int(coefficient.p) / int(coefficient.q)
            for value, exponent in zip(point, exponents, strict=True):
                term *= value ** int(exponent) if exponent else 1.0
            total += term
        return total

    def describe(self, expr: Expr) -> str:
        """The normal form as text, for people who debug."""
        names = [
            f"{g.kind}({' + '.join(f'{r}*{a}' for a, r in g.angle.terms)})"
            if g.kind in ("sin", "cos")
            else g.name + ("", "_dot", "_ddot")[g.dots] or f"{g.kind}{g.index}"
            for g in self.generators
        ]
        terms = []
        for exponents, coefficient in expr.poly.to_dict().items():
            powers = [f"{names[i]}^{e}" if e > 1 else names[i] for i, e in enumerate(exponents) if e]
            terms.append("*".join([str(coefficient), *powers]))
        return " + ".join(terms) or "0"


class _NoRoom(Exception):
    """The ring needs more generators for inverses than were set aside."""


def _rational(value: int | Fraction) -> fmpq:
    return fmpq(value) if isinstance(value, int) else fmpq(value.numerator, value.denominator)


def _atom_value(atom: Atom, values: Mapping[str, float]) -> float:
    product = 1.0
    for name, exponent in atom:
        product *= values.get(name, 0.0) ** exponent
    return product


