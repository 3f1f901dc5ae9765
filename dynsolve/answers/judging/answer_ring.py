"""The ring that a hand-in is judged in: the problem's, refined by what the answers bring.

An answer may hold angles that the problem's ring does not know (θ/2, 2θ₁ - θ₂ on
another basis of angles), roots, denominators, names of its own, or arguments that nobody
expects (sin θ̇₂).  An `AnswerRingPlan` holds what was collected of these from trees
(`evaluate`), within bounds; an `AnswerRing` is the ring that holds them, with the
robot and its key carried over.

Contexts are FLINT's for a number of generators and never for names, and the number
of generators that answers may bring is bounded: nothing a hand-in says can make the
process grow without end.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from math import prod
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, Contents
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_plan import RingPlan
from dynsolve.algebra.ring_values import ring_of
from dynsolve.algebra.sampling import Transfer
from dynsolve.answers.judging.evaluate import Known, KnownValues, extension_of
from dynsolve.derivation.graph import Derivation, Skipped, known
from dynsolve.derivation.rules import course_rules
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Node
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Robot

MOST_NEW = 48
"""The most generators that the answers of one hand-in may bring."""

MOST_DENOMINATORS = 12
"""Generators are set aside for the denominators of answers up to this number."""

FINEST = 8
"""The largest multiple of a refined angle that an angle of the problem may become."""


class AnswerRingPlan(Struct, frozen=True, dict=True):
    """The plan of the answers' ring: the problem's ring and what answers bring, put together step by step."""

    base: Ring
    brought: Contents = field(default_factory=Contents)

    def extended(self, more: Contents) -> AnswerRingPlan:
        """The plan that holds more; itself where there is no more.

        Raises AlgebraError where that would refine the ring beyond its bounds.
        """
        if not more:
            return self
        plan = AnswerRingPlan(self.base, self.brought.joined(more))
        plan.check()
        return plan

    def check(self) -> None:
        """Compare the plan with its bounds."""
        brought, plan = self.brought, self.plan
        if len(brought.symbols) + len(brought.functions) + 2 * len(brought.roots) > MOST_NEW:
            raise AlgebraError("the answer brings too many names that the problem does not have")
        if len(plan.basic_angles) > len(self.base.pairs) + MOST_NEW // 4:
            raise AlgebraError("the answer brings too many angles that the problem does not have")
        for pair in self.base.pairs:
            if prod(abs(m) + 1 for m in plan.multiples(pair.angle)[0]) > 4 * FINEST:
                raise AlgebraError("the answer divides an angle too finely")

    @cached_property
    def plan(self) -> RingPlan:
        """The plan by which the ring is laid out."""
        return self.base.plan.extended(self.brought, MOST_DENOMINATORS)

    @property
    def is_the_problems(self) -> bool:
        """Whether the problem's ring holds everything as it is."""
        return self.plan == self.base.plan


class AnswerRing:
    """A ring that holds the problem and its answers, with the robot and the key in it.

    `key` is the derivation of the problem carried over, `robot` the robot; `rules`
    are the textbook's rules on that robot; `known_values` are those of functions and terms
    that hand-ins have brought before.
    Without a plan it is the problem's own.
    """

    def __init__(self, robot: Robot, key: Derivation, plan: AnswerRingPlan | None = None) -> None:
        self._key = key
        self._robot = robot
        self.base = robot.ring
        self.plan = plan = AnswerRingPlan(robot.ring) if plan is None else plan
        self.same = plan.is_the_problems
        self.ring: Ring = robot.ring if self.same else ring_of(robot.ring.coordinates, plan.plan)
        self._moved: dict[str, Any] = {}
        self._expr = Transfer(self.base, self.ring)
        self.known_values = KnownValues()

    def refined(self, plan: AnswerRingPlan) -> AnswerRing:
        """The ring of another plan: this one where it holds everything."""
        is_held = plan is self.plan or plan.is_the_problems
        return self if is_held else AnswerRing(self._robot, self._key, plan)

    @cached_property
    def known(self) -> Known:
        """What an answer need not bring."""
        return Known(self.ring, self.known_values.terms)

    @cached_property
    def robot(self) -> Robot:
        """The robot with its values in this ring."""
        return self._robot if self.same else self.move(self._robot)

    def key(self, name: str) -> Any:
        """The key's value of a name, in this ring."""
        found = self._moved.get(name)
        if found is None:
            value = known(self._key[name])
            if isinstance(value, Skipped) and value.one is not None:
                value = value.one
            found = self._moved[name] = self.move(value)
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
        """A value of the problem's ring, or anything that is made of such values, in this ring.

        What is in a ring of its own, as equilibria are, stays there.
        """
        if self.same or (isinstance(value, Expr | Matrix) and value.ring is not self.base):
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
        if isinstance(value, Struct) and not isinstance(value, (Angle, Node)):
            return self._record(value)
        return value

    def _record(self, value: Any) -> Any:
        moved = {name: self.move(getattr(value, name)) for name in value.__struct_fields__}
        if all(moved[name] is getattr(value, name) for name in moved):
            return value
        return replace(value, **moved)


class AnswerRingBuilder:
    """Takes trees one by one; what goes over a bound is refused and leaves the others alone.

    `base` is the ring of the problem alone, `plan` what was admitted so far.
    """

    def __init__(self, base: AnswerRing) -> None:
        self.base = base
        self.plan = base.plan

    def admit(self, node: Node) -> None:
        """Make room for a tree; raises AlgebraError where there is none."""
        self.plan = self.plan.extended(extension_of(node, self.base.known))

    def build(self) -> AnswerRing:
        """The ring for all trees that were admitted."""
        return self.base.refined(self.plan)
