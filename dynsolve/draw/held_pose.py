"""The pose and the view in which a robot shows best among those where some formulas are 0."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from random import Random

from dynsolve.algebra.expr import Expr
from dynsolve.draw.drawn_lengths import RobotNumbers, finite
from dynsolve.draw.orientation import Orientation
from dynsolve.draw.pose import Choice, Pose, cost_of, taste
from dynsolve.draw.pose_search import improved, options_of, pose_of
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import evaluate
from dynsolve.robot.model import JointType, Robot

_STARTS, _IMPROVED = 30, 3
_STEPS = 40
_SEED = 1955
_DIFFERENCE, _CLOSE = 1e-6, 1e-9


def held_pose(
    robot: Robot, numbers: RobotNumbers, orientation: Orientation, zeros: Sequence[Node | Expr]
) -> tuple[Pose, Mapping[str, float]] | None:
    """A pose in which all formulas are 0, and the values of all symbols there; None where none is found."""
    options = options_of(robot, orientation)
    random = Random(_SEED)  # noqa: S311 - the same poses every time are wanted
    formulas = _Formulas(robot, numbers, zeros)

    def cost(choice: Choice) -> float:
        pose = pose_of(robot, numbers, orientation, choice)
        return round(cost_of(pose, orientation) + taste(robot, pose, choice), 6)

    views = options[robot.n :]
    usual = tuple(values[len(values) // 2] for values in views)
    starts = [tuple(random.choice(values) for values in options[: robot.n]) for _ in range(_STARTS)]
    found = dict.fromkeys(q for start in starts if (q := formulas.zero_near(start)) is not None)
    if not found:
        return None
    choices = sorted(((*q, *usual) for q in found), key=lambda choice: (cost(choice), choice))[:_IMPROVED]
    seen = (improved(c, [*((value,) for value in c[: robot.n]), *views], cost) for c in choices)
    best = min(seen, key=lambda choice: (cost(choice), choice))
    return pose_of(robot, numbers, orientation, best), formulas.values(best[: robot.n])


class _Formulas:
    """Formulas at poses; prismatic coordinates of a pose are in picture lengths."""

    def __init__(self, robot: Robot, numbers: RobotNumbers, zeros: Sequence[Node | Expr]) -> None:
        self.robot, self.numbers, self.zeros = robot, numbers, zeros

    def values(self, q: Sequence[float]) -> dict[str, float]:
        """The value of every symbol."""
        pairs = zip(self.robot.coordinates, q, strict=True)
        lengths = {c.name: x * self._unit(c.type) for c, x in pairs}
        return {**self.numbers.values, **lengths}

    def _unit(self, kind: JointType) -> float:
        return self.numbers.unit if kind is JointType.PRISMATIC else 1.0

    def at(self, q: Sequence[float]) -> list[float]:
        """The formulas' values."""
        values = self.values(q)
        return [
            finite(zero, values) if isinstance(zero, Expr) else float(evaluate(zero, values))
            for zero in self.zeros
        ]

    def zero_near(self, start: Sequence[float]) -> tuple[float, ...] | None:
        """A pose near another at which everything is 0, by Newton's method; None where none is found."""
        try:
            return self._newton(list(start))
        except (ArithmeticError, ValueError, KeyError):
            return None

    def _newton(self, q: list[float]) -> tuple[float, ...] | None:
        for _ in range(_STEPS):
            f = self.at(q)
            if max(map(abs, f)) < _CLOSE:
                return tuple(round(self._wrapped(k, x), 9) for k, x in enumerate(q))
            for value, row in zip(f, zip(*self._slopes(q, f), strict=True), strict=True):
                square = sum(x * x for x in row)
                if square > _CLOSE:  # one equation after the other, each by its own gradient
                    q = [x - value * slope / square for x, slope in zip(q, row, strict=True)]
        return None

    def _slopes(self, q: Sequence[float], f: Sequence[float]) -> Iterator[list[float]]:
        """∂f/∂q_k, for each k."""
        for k in range(len(q)):
            moved = [*q[:k], q[k] + _DIFFERENCE, *q[k + 1 :]]
            yield [(b - a) / _DIFFERENCE for a, b in zip(f, self.at(moved), strict=True)]

    def _wrapped(self, k: int, x: float) -> float:
        if self.robot.coordinates[k].type is JointType.PRISMATIC:
            return x
        return math.remainder(x, 2 * math.pi)
