"""The Newton-Euler recursions, as printed, compared with recursive Newton-Euler on numbers.

There every vector lies along the axes of the world, moments are about its origin, and a row of the
table is four elementary motions; here the results are turned into the links' frames.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

from msgspec import Struct

from dynsolve.derivation.arm_values import RobotValues, arms
from dynsolve.derivation.newton_euler import (
    ZERO,
    Arm,
    MovingFrame,
    Vector,
    applied,
    cross,
    held_by_joints,
    minus,
    outwards,
    plus,
    scaled,
    times,
    transposed,
)
from dynsolve.derivation.verification import TOLERANCE as VERIFICATION_TOLERANCE
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import quantities
from dynsolve.questions import newton_euler as families
from dynsolve.questions.held import Held
from dynsolve.robot.model import Convention, Robot
from dynsolve.robot.questions import Load


def recursion_names(robot: Robot, wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are of the recursions."""
    every = quantities(robot).values()
    return tuple(q.name for q in every if q.family in families.FAMILIES and q.name in wanted)


def verify_recursions(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of the recursions with the motions and forces of the arm in numbers.

    `results` are trees by name (see `recursion_names`).  Raises VerificationError where one is off by more
    than rounding.
    """
    program = compile_trees(list(results.values()))
    for values, arm in islice(arms(robot), states if results else 0):
        links = _Links(robot, values, arm)
        for name, mine in zip(results, program.run(values), strict=True):
            theirs = links.value(name)
            size = max((1.0, *map(abs, theirs)))
            if not _gap(mine, theirs) <= VERIFICATION_TOLERANCE * size:
                raise VerificationError(
                    f"{name} differs from the motion of the arm; this is a fault of dynsolve"
                )


class _Links(Struct, dict=True):
    """What the recursions give, from an arm at a state."""

    robot: Robot
    values: Mapping[str, float]
    arm: Arm

    def __post_init__(self) -> None:
        self._lifted = outwards(self.arm, self.arm.qd, self.arm.qdd, scaled(self.arm.gravity, -1.0))[0]
        self._held = held_by_joints(self.arm, self._lifted, self.arm.qd, self.arm.qdd)
        modified = self.robot.convention is Convention.MODIFIED
        joints = self.robot.joints
        at_rest = outwards(self.arm, self.arm.qd, self.arm.qdd, ZERO)[0]
        self._frames = self._lifted if modified else at_rest
        self._about = [joint.index if modified else joint.parent for joint in joints]
        """The frame, for each link, whose origin its moment is about."""

        for load in self.robot.questions.loads:
            self._take_off(load)

    def _take_off(self, load: Load) -> None:
        """Every joint on the way to a force from outside holds so much less."""
        numbers, frame = RobotValues(self.robot, self.values), self._frames[load.link]
        force, moment = numbers.vector(load.force), numbers.vector(load.moment)
        if load.axes is not None:
            turned = times(frame.R, numbers.rotation(load.axes))
            force, moment = applied(turned, force), applied(turned, moment)
        if load.by_robot:
            force, moment = scaled(force, -1.0), scaled(moment, -1.0)
        at = plus(frame.o, applied(frame.R, numbers.vector(load.position)))
        link = load.link
        while link:
            held, about = self._held[link - 1]
            self._held[link - 1] = minus(held, force), minus(about, plus(moment, cross(at, force)))
            link = self.robot.joints[link - 1].parent

    def value(self, name: str) -> Vector:
        """A result along the axes of its link's frame."""
        quantity = quantities(self.robot)[name]
        place = quantity.index[0]
        link = self.robot.bodies[place - 1].link if quantity.family is families.ACL else place
        frame = self._frames[link]
        return applied(transposed(frame.R), self._in_world(quantity.family, place, link, frame))

    def _in_world(self, family: Family, place: int, link: int, frame: MovingFrame) -> Vector:
        if family is families.WL:
            return frame.w
        if family is families.WDL:
            return frame.dw
        if family is families.AL:
            return frame.dv
        if family is families.ACL:
            numbers = RobotValues(self.robot, self.values)
            arm = applied(frame.R, numbers.vector(self.robot.bodies[place - 1].center))
            return plus(frame.dv, plus(cross(frame.dw, arm), cross(frame.w, cross(frame.w, arm))))
        force, moment = self._held[link - 1]
        if family is families.FL:
            return force
        return minus(moment, cross(self._frames[self._about[link - 1]].o, force))


def _gap(mine: Any, theirs: Sequence[float]) -> float:
    gaps = [abs(a - b) for (a,), b in zip(mine, theirs, strict=True)]
    return max((gap if gap == gap else float("inf") for gap in gaps), default=0.0)


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    held.hold(verify_recursions, recursion_names(held.robot, held.wanted))
