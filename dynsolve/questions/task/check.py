"""What is asked of the kinematics, compared with the motion of the arm in numbers.

Positions, velocities and accelerations of points come from the outward half of recursive
Newton-Euler; how the task changes, from the task itself along a motion of the arm, by
quotients of differences.  A Jacobian is held to what it does: J q̇ is a velocity, and
J q̈ + J̇ q̇ an acceleration.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import islice
from typing import Any

from msgspec import Struct

from dynsolve.derivation.arm_values import RobotValues, arm_at, arms
from dynsolve.derivation.elimination import determinant
from dynsolve.derivation.newton_euler import (
    ZERO,
    Arm,
    MovingFrame,
    Vector,
    applied,
    cross,
    outwards,
    plus,
    transposed,
)
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node, Reference, Symbol, column, mapped
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.questions.held import Held
from dynsolve.questions.rates.check import TOLERANCE as DETERMINANT_TOLERANCE
from dynsolve.questions.rates.check import products
from dynsolve.questions.rates.check import transposed as columns_of
from dynsolve.questions.rates.derive import whole_or_task
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, NamedPoint

TOLERANCE = 1e-7
"""The largest relative error that counts as that of a quotient of differences."""

STEP = 0.02
"""The time between two positions of the arm on its way."""

Entries = Sequence[float]
Compared = tuple[str, Entries, Entries]
"""The name of a result, what follows from it, and the same by the motion of the arm."""


def checked_names(robot: Robot, wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are compared, and what is needed with them."""
    letters = ("p", "Jv", "Jw", "v")
    names = [letter + point.name for point in robot.questions.points for letter in letters]
    names += ["Jv", "Jw", "Jv_dot", "Jw_dot", "r", "Jr", "Jr_dot"]
    return tuple(name for name in names if name in wanted)


def verify_kinematics(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of points, the task and Jacobians with the motion of the arm.

    `results` are trees by name (see `checked_names`).  Raises VerificationError where one is
    off by more than `TOLERANCE` of its size.
    """
    program = compile_trees(list(results.values()))
    for values, arm in islice(arms(robot), states if results else 0):
        ours = dict(zip(results, program.run(values), strict=True))
        for name, mine, theirs in _Motion(robot, values, arm).compared(ours):
            if not _distance(mine, theirs) <= TOLERANCE:
                raise VerificationError(
                    f"{name} differs from the motion of the arm; this is a fault of dynsolve"
                )


class _Motion(Struct, dict=True):
    """An arm that moves from a state on with constant accelerations."""

    robot: Robot
    values: Mapping[str, float]
    arm: Arm

    def compared(self, ours: Mapping[str, Any]) -> Iterator[Compared]:
        """Every result that is there, beside what the arm does."""
        for point in self.robot.questions.points:
            yield from self._point(point, ours)
        last = self.frames[-1]
        for part, rate in (("Jv", last.dv), ("Jw", last.dw)):
            if f"{part}_dot" in ours:
                yield f"{part}_dot", self._acceleration(ours[part], ours[f"{part}_dot"]), rate
        if self.robot.questions.task is not None:
            yield from self._task(ours)

    # -- by recursive Newton-Euler -----------------------------------------------------------------

    @cached_property
    def frames(self) -> list[MovingFrame]:
        """The frames with their velocities and accelerations."""
        return outwards(self.arm, self.arm.qd, self.arm.qdd, ZERO)[0]

    def _point(self, point: NamedPoint, ours: Mapping[str, Any]) -> Iterator[Compared]:
        frame, p = self.frames[point.link], point.name
        arm = applied(frame.R, self._numbers.vector(point.position))
        velocity = plus(frame.v, cross(frame.w, arm))
        if f"p{p}" in ours:
            yield f"p{p}", _flat(ours[f"p{p}"]), plus(frame.o, arm)
        if f"v{p}" in ours:
            yield f"v{p}", _flat(ours[f"v{p}"]), self._along(point.axes, velocity)
        for name, rate in ((f"Jv{p}", velocity), (f"Jw{p}", frame.w)):
            if name in ours:
                yield name, _times(ours[name], self.arm.qd), self._along(point.axes, rate)

    def _along(self, frame: int | None, vector: Vector) -> Vector:
        """A vector of the world along the axes of a frame, None for those of the world."""
        if frame is None:
            return vector
        return applied(transposed(self.frames[frame].R), vector)

    @cached_property
    def _numbers(self) -> RobotValues:
        return RobotValues(self.robot, self.values)

    def _acceleration(self, J: Any, J_dot: Any) -> list[float]:
        """J q̈ + J̇ q̇"""
        parts = zip(_times(J, self.arm.qdd), _times(J_dot, self.arm.qd), strict=True)
        return [a + b for a, b in parts]

    # -- by differences ----------------------------------------------------------------------------

    def _task(self, ours: Mapping[str, Any]) -> Iterator[Compared]:
        task, last = self.robot.questions.task, self.frames[-1]
        is_twist = task is not None and task.is_twist
        if "r" in ours and not is_twist:
            yield "r", _flat(ours["r"]), self._task_at(0.0)
        if "Jr" not in ours:
            return
        rates: tuple[Entries, Entries] = (*last.v, *last.w), (*last.dv, *last.dw)
        first, second = rates if is_twist else self._slopes
        yield "Jr", _times(ours["Jr"], self.arm.qd), first
        if "Jr_dot" in ours:
            yield "Jr_dot", self._acceleration(ours["Jr"], ours["Jr_dot"]), second

    @cached_property
    def _slopes(self) -> tuple[list[float], list[float]]:
        """ṙ and r̈: quotients of differences over 1, 2 and 3 steps, extrapolated to none."""
        now = self._task_at(0.0)
        firsts, seconds = [], []
        for times in (1, 2, 3):
            h = times * STEP
            ahead, behind = self._task_at(h), self._task_at(-h)
            firsts.append([(a - b) / (2 * h) for a, b in zip(ahead, behind, strict=True)])
            seconds.append([(a - 2 * x + b) / h**2 for a, x, b in zip(ahead, now, behind, strict=True)])
        return _extrapolated(firsts), _extrapolated(seconds)

    def _task_at(self, t: float) -> list[float]:
        """r at time t: its formula at the positions of its points."""
        values = dict(self.values)
        for q in self.robot.coordinates:
            values[q.name] += t * values[q.velocity] + t**2 / 2 * values[q.acceleration]
        frames, _ = outwards(arm_at(self.robot, values), self.arm.qd, self.arm.qdd, ZERO)
        for name, position in self._positions(frames):
            values |= {_coordinate(name, axis): x for axis, x in enumerate(position, 1)}
        (result,) = self._task_program.run(values)
        return _flat(result)

    def _positions(self, frames: Sequence[MovingFrame]) -> Iterator[tuple[str, Sequence[float]]]:
        yield TIP, frames[-1].o
        for point in self.robot.questions.points:
            frame = frames[point.link]
            yield point.name, plus(frame.o, applied(frame.R, self._numbers.vector(point.position)))

    @cached_property
    def _task_program(self) -> Program:
        task = self.robot.questions.task
        assert task is not None
        return compile_trees([column(*(mapped(entry, _as_symbol) for entry in task.entries))])


def _as_symbol(part: Node) -> Node:
    """A coordinate of a point under a name of its own, which no parameter can have."""
    if isinstance(part, Reference) and part.row is not None:
        return Symbol(_coordinate(part.quantity, part.row))
    return part


def _coordinate(point: str, row: int) -> str:
    return f"{point}[{row}]"


def _extrapolated(slopes: Sequence[Sequence[float]]) -> list[float]:
    """The limit for steps of 0 of what was found with 1, 2 and 3: what is left is of order h⁶."""
    return [(15 * a - 6 * b + c) / 10 for a, b, c in zip(*slopes, strict=True)]


def _flat(rows: Any) -> list[float]:
    return [entry for row in rows for entry in row]


def _times(rows: Any, rates: Sequence[float]) -> list[float]:
    return [sum(c * x for c, x in zip(row, rates, strict=True)) for row in rows]


def _distance(mine: Entries, theirs: Entries) -> float:
    """The largest difference, relative to the size of what is compared."""
    size = max((1.0, *(abs(x) for x in theirs)))
    gaps = [abs(a - b) / size for a, b in zip(mine, theirs, strict=True)]
    return max((gap if gap == gap else float("inf") for gap in gaps), default=0.0)


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    held.hold(verify_kinematics, checked_names(held.robot, held.wanted))
    if "det" in held.wanted:
        held.hold(verify_determinant, (whole_or_task(held.robot), "det"))


def verify_determinant(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare det J, or det J Jᵀ where J is not square, with elimination on numbers.

    The Jacobian is taken as it is printed, for it has been held to the motion of the arm.  Raises
    VerificationError where they differ.
    """
    program = compile_trees(list(results.values()))
    for values, _ in islice(arms(robot), states):
        J, ours = program.run(values)
        rows = [list(row) for row in J]
        if len(rows) > len(rows[0]):
            rows = products(columns_of(rows), columns_of(rows))
        elif len(rows) < len(rows[0]):
            rows = products(rows, rows)
        theirs = determinant(rows)
        if not abs(ours - theirs) <= DETERMINANT_TOLERANCE * max(1.0, abs(theirs)):
            raise VerificationError("det differs from elimination; this is a fault of dynsolve")
