"""The ring that a hand-in is judged in: the problem's, refined by what the answers bring.

An answer may hold angles that the problem's ring does not know (θ/2, 2θ₁ - θ₂ on
another lattice), roots, denominators, names of its own, or arguments that nobody
expects (sin(θ₂ θ₃)).  A `Plan` collects these from trees, within bounds; a `Field`
is the ring that holds them, with the robot and its key carried over.

Contexts are FLINT's for a number of generators and never for names, and the number
of generators that answers may bring is bounded: nothing a hand-in says can make the
process grow without end.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import prod
from typing import Any, TypeVar

from dynsolve.algebra.angles import Angle, Atom
from dynsolve.algebra.build import ring_of
from dynsolve.algebra.constants import plan_constants
from dynsolve.algebra.evaluate import value_of
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.integer_basis import Vector, integer_basis
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_gcd
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_plan import RingPlan
from dynsolve.answers.judging.evaluate import Values
from dynsolve.answers.judging.ring_extension import Known, Needs, needs_of
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import course_rules
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Node, Number
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Robot

MOST_NEW = 48
"""The most generators that the answers of one hand-in may bring."""

FINEST = 8
"""The largest multiple of a refined angle that an angle of the problem may become."""

_T = TypeVar("_T")


@dataclass(frozen=True)
class Plan:
    """The plan of a field: the problem's ring and what answers bring, put together step by step."""

    base: Ring
    symbols: tuple[str, ...] = ()
    angles: tuple[Angle, ...] = ()
    radicands: tuple[Fraction, ...] = ()
    roots: tuple[Node, ...] = ()
    denominators: int = 0
    opaque: tuple[tuple[str, Node], ...] = ()

    def with_needs(self, needs: Needs) -> Plan:
        """The plan that holds one more tree; itself where the problem's ring holds the tree as it is.

        Raises AlgebraError where that would refine the ring beyond its bounds.
        """
        if not needs:
            return self
        plan = replace(
            self,
            symbols=_joined(self.symbols, needs.symbols),
            angles=_joined(self.angles, needs.angles),
            radicands=_joined(self.radicands, needs.radicands),
            roots=_joined(self.roots, needs.roots),
            denominators=min(self.denominators + needs.denominators, 12),
            opaque=_joined(self.opaque, needs.opaque),
        )
        plan.check()
        return plan

    def check(self) -> None:
        """Hold the plan against its bounds."""
        if len(self.symbols) + 2 * len(self.roots) > MOST_NEW:
            raise AlgebraError("the answer brings too many names that the problem does not have")
        survey = self.survey
        if len(survey.basic_angles) > len(self.base.pairs) + MOST_NEW // 4:
            raise AlgebraError("the answer brings too many angles that the problem does not have")
        for pair in self.base.pairs:
            if prod(abs(m) + 1 for m in survey.multiples(pair.angle)[0]) > 4 * FINEST:
                raise AlgebraError("the answer divides an angle too finely")

    @cached_property
    def survey(self) -> RingPlan:
        """The plan as a ring is laid out by."""
        plan = self.base.plan
        vectors, rates = _split_all(self.angles, plan)
        offsets = dict(plan.turning)
        known = dict(plan.fixed)
        for atom, found in rates.items():
            known[atom] = rational_gcd([*found, *([known[atom]] if atom in known else [])])
        constant = plan.constants
        degrees = [a.degrees for a in self.angles] + list(constant.pairs)
        if constant.generator_degrees is not None:
            degrees.append(constant.generator_degrees)
        constants = constant
        if any(d % 90 for d in degrees) or self.radicands:
            constants = plan_constants(degrees, [*map(Fraction, constant.primes), *self.radicands])
        old = plan.roots[len(constant.primes) :]
        roots = (*(Number(p) for p in constants.primes), *_joined(old, self.roots))
        return RingPlan(
            coordinates=plan.coordinates,
            symbols=_joined(plan.symbols, self.symbols),
            roots=roots,
            denominators=plan.denominators,
            turning=tuple((v, offsets.get(v, Angle())) for v in integer_basis([*offsets, *vectors])),
            fixed=tuple(known.items()),
            constants=constants,
            inverses=plan.inverses + 2 * self.denominators,
        )

    @property
    def is_the_problems(self) -> bool:
        """Whether the problem's ring holds everything as it is."""
        return self.survey == self.base.plan


def _joined(first: tuple[_T, ...], second: Iterable[_T]) -> tuple[_T, ...]:
    return tuple(dict.fromkeys((*first, *second)))


def _split_all(angles: Iterable[Angle], plan: RingPlan) -> tuple[list[Vector], dict[Atom, list[Fraction]]]:
    """The coordinate parts of angles as vectors, and the rates of their other atoms."""
    vectors: list[Vector] = []
    others: dict[Atom, list[Fraction]] = {}
    for angle in angles:
        rates = dict(angle.terms)
        vector = tuple(rates.pop(((name, 1),), Fraction(0)) for name in plan.coordinates)
        if any(vector):
            vectors.append(vector)
        for atom, rate in rates.items():
            others.setdefault(atom, []).append(rate)
    return vectors, others


class Field:
    """A ring that holds the problem and its answers, with the robot and the key in it.

    `key` is the derivation of the problem carried over, `robot` the robot; `rules`
    are the textbook's rules on that robot; `values` remembers those of functions and terms.
    Without a plan it is the problem's own.
    """

    def __init__(self, robot: Robot, key: Derivation, plan: Plan | None = None) -> None:
        self._key = key
        self._robot = robot
        self.base = robot.ring
        self.plan = plan = Plan(robot.ring) if plan is None else plan
        self.same = plan.is_the_problems
        self.opaque = dict(plan.opaque)
        self.ring: Ring = robot.ring if self.same else ring_of(robot.ring.coordinates, plan.survey)
        self._moved: dict[str, Any] = {}
        self.values = Values()

    def refined(self, plan: Plan) -> Field:
        """The field of another plan: this one where it holds everything."""
        return self if plan is self.plan else Field(self._robot, self._key, plan)

    @cached_property
    def known(self) -> Known:
        """What an answer need not bring."""
        return Known(self.ring, self.values.terms)

    @cached_property
    def robot(self) -> Robot:
        """The robot with its values in this ring."""
        return self._robot if self.same else self.move(self._robot)

    def key(self, name: str) -> Any:
        """The key's value of a name, in this ring."""
        found = self._moved.get(name)
        if found is None:
            found = self._moved[name] = self.move(self._key[name])
        return found

    @cached_property
    def dimensions(self) -> Dimensions:
        """The dimensions of this ring's symbols."""
        return Dimensions(self.ring, self.robot)

    @cached_property
    def rules(self) -> Mapping[str, Any]:
        """The textbook's rules, on the robot of this ring."""
        return {rule.name: rule for rule in course_rules(self.robot)}

    # -- carrying over -----------------------------------------------------------------------------

    def move(self, value: Any) -> Any:
        """A value of the problem's ring, or anything that is made of such values, in this ring."""
        if self.same:
            return value
        if isinstance(value, Expr):
            return self._expr(value)
        if isinstance(value, Ring):
            return self.ring
        if isinstance(value, Matrix):
            return Matrix.of(self.ring, ((self._expr(e) for e in row) for row in value.rows))
        if isinstance(value, tuple):
            return tuple(self.move(item) for item in value)
        if isinstance(value, Mapping):
            return {name: self.move(item) for name, item in value.items()}
        if is_dataclass(value) and not isinstance(value, (type, Angle, Node)):
            return self._record(value)
        return value

    def _record(self, value: Any) -> Any:
        moved = {f.name: self.move(getattr(value, f.name)) for f in fields(value)}
        if all(moved[f.name] is getattr(value, f.name) for f in fields(value)):
            return value
        return replace(value, **moved)

    def _expr(self, expr: Expr) -> Expr:
        if expr.ring is self.ring:
            return expr
        if not expr.poly:
            return self.ring.zero
        return Expr(self.ring, self.ring.reduce(expr.poly.compose(*self._images, ctx=self.ring.ctx)))

    @cached_property
    def _images(self) -> tuple[Any, ...]:
        """What each generator of the problem's ring is in this one."""
        return tuple(image.poly for image in self._make_images())

    def _make_images(self) -> Iterator[Expr]:
        ring = self.ring
        waiting: list[int] = []
        images: list[Expr] = []
        for g in self.base.generators:
            match g.kind:
                case "sin":
                    images.append(ring.sin(g.angle))
                case "cos" | "constant":
                    images.append(ring.cos(g.angle))
                case "symbol":
                    images.append(ring.symbol(g.name, g.dots))
                case "root":
                    assert g.node is not None
                    images.append(ring.root(g.node, value_of(ring, g.node)))
                case _:
                    waiting.append(g.index)
                    images.append(ring.zero)
        for index in waiting:
            inverted = self.base.inverses.get(index)
            if inverted is not None:
                polys = [image.poly for image in images]
                value = Expr(ring, ring.reduce(inverted.compose(*polys, ctx=ring.ctx)))
                images[index] = ring.inverse(value)
        yield from images


@dataclass
class FieldBuilder:
    """Takes trees one by one; what goes over a bound is refused and leaves the others alone.

    `base` is the field of the problem alone, `plan` what was admitted so far.
    """

    base: Field
    plan: Plan = field(init=False)

    def __post_init__(self) -> None:
        self.plan = self.base.plan

    def admit(self, node: Node) -> None:
        """Make room for a tree; raises AlgebraError where there is none."""
        self.plan = self.plan.with_needs(needs_of(node, self.base.known))

    def field(self) -> Field:
        """The field for all trees that were admitted."""
        return self.base.refined(self.plan)
