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
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.constants import ConstantAngles
from dynsolve.algebra.evaluate import value_of
from dynsolve.algebra.expr import Expr, Generator, Pair, rational
from dynsolve.algebra.ring_plan import Survey, survey
from dynsolve.algebra.values import evaluate
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Node, Number, Quotient

MOST_TURNS = 64
"""The largest multiple of a basic angle that is expanded."""


class Ring:
    """The ring of one robot; see the module's text.

    >>> from dynsolve.notation.tree import Symbol
    >>> coordinates = [("q1", "revolute"), ("q2", "revolute")]
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> ring = Ring.build(coordinates, [Symbol("l1")], [Angle.of("q1"), both])
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
        return Ring._of(coordinates, plan)

    @staticmethod
    def _of(coordinates: Sequence[tuple[str, str]], plan: Survey) -> Ring:
        while True:
            try:
                ring = Ring(coordinates, plan)
                for tree in plan.denominators:
                    ring.expr(Quotient(Number(1), tree))
                return ring
            except _NoRoom:
                plan = plan.with_more_inverses()

    def with_symbols(self, names: Iterable[str]) -> Ring:
        """This ring with further parameters; its own generators keep their places."""
        plan = replace(self._plan, symbols=(*self._plan.symbols, *names))
        return Ring._of(self.coordinates, plan)

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
            raise AlgebraError(
                f"{name}{'_' + 'd' * dots + 'ot' if dots else ''} is not a symbol of this problem"
            )
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
            multiples, degrees = self._plan.multiples(angle)
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
        """The integer multiples of the basic angles, one a pair, that make up an angle but for a constant."""
        return self._plan.multiples(angle)[0]

    def expr(self, node: Node) -> Expr:
        """The exact value of a tree; see `algebra.from_tree`."""
        return value_of(self, node)

    def root(self, argument: Node, value: Expr) -> Expr:
        """The square root of a tree with this value: of a number exactly, of anything else as a generator."""
        if value.is_number:
            return Expr(self, self._constants.sqrt(value.number, self.ctx))
        for g in self.generators:
            if g.kind == "root" and g.node == argument:
                return self.generator(g.index)
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
            raise AlgebraError(
                "a denominator contains a joint variable", "denominators are free of coordinates"
            )
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
        """(conjugate, norm) where the root of a number occurs: 1/(a + b√2) = (a - b√2)/(a² - 2b²)."""
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
                (pair, rate) for pair in self.pairs for atom, rate in pair.angle.terms if atom == ((name, 1),)
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
            total += turned * rational(rate)
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
        used = expr.poly.degrees()
        point = list(self._gens)
        for name in self.names:
            point[self._symbols[(name, 0)]] = self.ctx.constant(0)
        for pair in {pair for pairs in self._rates for pair, _ in pairs}:
            if used[pair.sine] or used[pair.cosine]:
                point[pair.cosine], point[pair.sine] = self._turn(self._plan.at_rest(pair.angle))
        return Expr(self, self.reduce(expr.poly.compose(*point, ctx=self.ctx)))

    @cached_property
    def _moving(self) -> frozenset[int]:
        turning = {i for pairs in self._rates for pair, _ in pairs for i in (pair.sine, pair.cosine)}
        return frozenset(
            turning | {index for (name, _), index in self._symbols.items() if name in self.names}
        )

    def depends_on_coordinates(self, expr: Expr) -> bool:
        """Whether a coordinate, its velocity or acceleration occurs."""
        degrees = expr.poly.degrees()
        return any(degrees[i] > 0 for i in self._moving)  # of 0 they are -1

    def evaluate(self, expr: Expr, values: Mapping[str, float]) -> float:
        """The value at plain names: `theta1`, `theta1_dot`, `theta1_ddot` and the parameters."""
        return evaluate(expr, values)


class _NoRoom(Exception):
    """The ring needs more generators for inverses than were set aside."""
