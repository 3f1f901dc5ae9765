"""The dimensions of symbols, concluded from their roles in a problem, and of terms.

A mass stands under `mass`, a length under `a`, a moment of inertia in a tensor; so
every term of an answer has a dimension, and terms that cannot be added are a slip
that can be named without a key.  Where a problem gives numbers for lengths or
masses nothing can be told, and nothing is said.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

from dynsolve.algebra.generators import Generator, is_sign
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.build import summands, total
from dynsolve.notation.tree import Function, Negative, Node, Number, Power, Product, Reference, Symbol, walk
from dynsolve.notation.tree_values import recalled
from dynsolve.robot.model import GivenModel, JointType, Robot
from dynsolve.robot.units import (
    ACCELERATION,
    ENERGY,
    FORCE,
    INERTIA,
    LENGTH,
    MASS,
    NONE,
    Dimension,
    dimension,
    times,
)

MOST_REMEMBERED = 10_000
"""Of so many terms the dimension is remembered."""


class Dimensions:
    """The dimensions of the generators of a ring; `known` is False where the problem has bare numbers.

    They follow from the model, and `with_questions` from what is asked of it, too: from forces, and rates.
    """

    def __init__(self, ring: Ring, robot: Robot, *, with_questions: bool = False) -> None:
        self.ring = ring
        self.robot = robot
        self.known = True
        self._of: dict[int, Dimension] = {}
        self._products: dict[tuple[int, ...], Dimension | None] = {}
        self._coordinates()
        roles = [(e, d) for e, d in _roles(robot) if not e.is_zero]
        asked = [(e, d) for e, d in _roles_of_questions(robot) if not e.is_zero] if with_questions else []
        for _ in range(3):
            for expr, role in (*roles, *asked):
                self._learn(expr, role)
        self._products.clear()
        self.known = all(self._sound(expr, role) for expr, role in roles)

    def _coordinates(self) -> None:
        for q in self.robot.coordinates:
            for dots in (0, 1, 2):
                self._of[self.ring.symbol_indices[(q.name, dots)]] = times(q.dimension, dimension(time=-dots))
        for g in self.ring.generators:
            if g.kind in ("sin", "cos", "constant") or is_sign(g.node):
                self._of[g.index] = NONE
            if g.kind == "symbol" and g.name == "pi":
                self._of[g.index] = NONE

    def _learn(self, expr: Expr, role: Dimension) -> None:
        """Conclude the dimension of a symbol that is the only unknown one of a term."""
        for exponents, _ in _terms(expr):
            unknown = [(i, e) for i, e in enumerate(exponents) if e and i not in self._of]
            unknown = [(i, e) for i, e in unknown if self.of_generator(self.ring.generators[i]) is None]
            if len(unknown) != 1:
                continue
            index, power = unknown[0]
            rest = self._product((i, e) for i, e in enumerate(exponents) if e and i != index)
            if rest is None:
                continue
            a, b, c = ((x - y) / int(power) for x, y in zip(role, rest, strict=True))
            if self.ring.generators[index].kind == "symbol":
                self._of[index] = (a, b, c)
            elif index in self.ring.inverses:  # of a symbol, or of a sum with one
                self._learn(Expr(self.ring, self.ring.inverses[index]), (-a, -b, -c))

    def _sound(self, expr: Expr, role: Dimension) -> bool:
        """Whether every term of a role has its dimension; a bare number for a length does not."""
        return all(found in (None, role) for found in self.terms(expr))

    def of_generator(self, g: Generator) -> Dimension | None:
        """The dimension of one generator, None where it is unknown."""
        if g.index in self._of:
            return self._of[g.index]
        found: Dimension | None = None
        if g.kind == "root":
            inner = self.of(Expr(self.ring, self.ring.radicands[g.index]))
            found = None if inner is None else tuple(x / 2 for x in inner)  # type: ignore[assignment]
        elif g.kind == "inverse" and g.index in self.ring.inverses:
            inner = self.of(Expr(self.ring, self.ring.inverses[g.index]))
            found = None if inner is None else tuple(-x for x in inner)  # type: ignore[assignment]
        if found is not None:
            self._of[g.index] = found
        return found

    def _product(self, powers: Iterable[tuple[int, int]]) -> Dimension | None:
        total = NONE
        for index, power in powers:
            found = self.of_generator(self.ring.generators[index])
            if found is None:
                return None
            total = times(total, found, power)
        return total

    def terms(self, expr: Expr) -> Iterator[Dimension | None]:
        """The dimension of every term, None where a symbol's is unknown."""
        for exponents, _ in _terms(expr):
            yield self._of_term(exponents)

    def _of_term(self, exponents: tuple[int, ...]) -> Dimension | None:
        """The dimension of a term, which is remembered: a cohort has few different ones."""
        return recalled(self._products, exponents, lambda: self._product(_powers(exponents)), MOST_REMEMBERED)

    def of(self, expr: Expr) -> Dimension | None:
        """The dimension of an expression, None where it is unknown or its terms differ."""
        found = set(self.terms(expr))
        return found.pop() if len(found) == 1 else None

    def fits(self, expr: Expr, wanted: Dimension) -> bool:
        """Whether every term has a dimension, as far as it is known."""
        return not self.known or all(found in (None, wanted) for found in self.terms(expr))


def _powers(exponents: tuple[int, ...]) -> Iterator[tuple[int, int]]:
    """(generator, exponent) of the generators that occur."""
    return ((i, e) for i, e in enumerate(exponents) if e)


def _terms(expr: Expr) -> Iterator[tuple[tuple[int, ...], Any]]:
    yield from expr.poly.to_dict().items()


def _roles(robot: Robot) -> Iterator[tuple[Expr, Dimension]]:
    """The expressions whose dimension follows from their place in the problem."""
    for joint in robot.joints:
        yield joint.a, LENGTH
        yield joint.d, LENGTH
    for entry in robot.base_position.entries:
        yield entry, LENGTH
    for body in robot.bodies:
        shape = body.density.shape if body.density is not None else body.shape
        for _, size in shape.dimensions if shape is not None else ():
            yield size, LENGTH
        yield body.mass, MASS
        for entry in body.center.entries:
            yield entry, LENGTH
        if body.about_point is not None:
            for entry in body.about_point.entries:
                yield entry, LENGTH
        if body.inertia is not None:
            for entry in body.inertia.entries:
                yield entry, INERTIA
    for entry in robot.gravity.entries:
        yield entry, ACCELERATION
    if robot.given is not None:
        yield from _given_roles(robot, robot.given)
    for act in robot.actions.acts:
        for value, _, role, *_ in act.parameters(robot):
            if role is not None:
                yield value, role


def _given_roles(robot: Robot, given: GivenModel) -> Iterator[tuple[Expr, Dimension]]:
    """The dimensions of given energies, and of the entries of a given D."""
    for energy in (given.K, given.P, given.L):
        if energy is not None:
            yield energy, ENERGY
    for row, q in zip(given.D.rows if given.D else (), robot.coordinates, strict=False):
        for entry, other in zip(row, robot.coordinates, strict=True):
            lengths = (q.type is JointType.PRISMATIC) + (other.type is JointType.PRISMATIC)
            yield entry, times(INERTIA, LENGTH, -lengths)


def _roles_of_questions(robot: Robot) -> Iterator[tuple[Expr, Dimension]]:
    """The same of what is asked: forces from outside, points, the rates of the task."""
    asked = robot.questions
    for load in asked.loads:
        yield from ((entry, FORCE) for entry in load.force.entries)
        yield from ((entry, ENERGY) for entry in load.moment.entries)
        yield from ((entry, LENGTH) for entry in load.position.entries)
    for point in asked.points:
        yield from ((entry, LENGTH) for entry in point.position.entries)
    yield from (found for one in asked.constraints for found in _of_constraint(robot, one.entry))
    task = asked.task
    if task is None:
        return
    kinds = [LENGTH] * 3 + [NONE] * 3 if task.is_twist else [_of_component(robot, e) for e in task.entries]
    for dots, values in ((1, asked.velocity), (2, asked.acceleration)):
        for kind, entry in zip(kinds, values.entries if values is not None else (), strict=False):
            if kind is not None:
                yield entry, times(kind, dimension(time=-dots))


def _of_constraint(robot: Robot, entry: Node) -> Iterator[tuple[Expr, Dimension]]:
    """What stands in a constraint beside coordinates of points: all its terms have one dimension."""
    terms = summands(entry)
    found = {_of_tree(robot, term) for term in terms} - {None}
    if len(found) == 1:
        (kind,) = found
        beside = [term for term in terms if not any(isinstance(part, Reference) for part in walk(term))]
        assert kind is not None
        yield value_of(robot.ring, total(beside)), kind


def _of_tree(robot: Robot, node: Node) -> Dimension | None:
    """The dimension of a product of coordinates, rates and numbers; None where a parameter stands in it."""
    match node:
        case Number() | Function("sin" | "cos"):
            return NONE
        case Reference():
            return LENGTH
        case Symbol(name, dots):
            types = {q.name: q.type for q in robot.coordinates}
            base = LENGTH if types.get(name) is JointType.PRISMATIC else NONE
            return times(base, dimension(time=-dots)) if name in types else None
        case Negative(argument):
            return _of_tree(robot, argument)
        case Power(base, Number(p, q)):
            inner = _of_tree(robot, base)
            return None if inner is None else times(NONE, inner, Fraction(p, q))
        case Product(factors):
            whole = NONE
            for factor in factors:
                own = _of_tree(robot, factor)
                if own is None:
                    return None
                whole = times(whole, own)
            return whole
    return None


def _of_component(robot: Robot, entry: Node) -> Dimension | None:
    """A component of a task: a length where points or sliding joints make it, a number where angles do."""
    if any(isinstance(part, Reference) for part in walk(entry)):
        return LENGTH
    types = {q.name: q.type for q in robot.coordinates}
    found = {types.get(part.name) for part in walk(entry) if isinstance(part, Symbol)}
    return NONE if found == {JointType.REVOLUTE} else LENGTH if found == {JointType.PRISMATIC} else None


def measured_along(robot: Robot, form: Expr) -> Dimension | None:
    """What a linear form of the coordinates is measured in: a length where a length stands in it alone.

    In y - 0.2 φ the number beside the angle hides a length; in φ - 5 y that beside y one over a length.
    """
    slopes = [(q.dimension, robot.ring.diff(form, k)) for k, q in enumerate(robot.coordinates)]
    alone = {kind for kind, slope in slopes if slope in (robot.ring.one, -robot.ring.one)}
    found = alone or {kind for kind, slope in slopes if slope.is_number and not slope.is_zero}
    return LENGTH if LENGTH in found else NONE if found else None
