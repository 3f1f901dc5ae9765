"""Inverse kinematics of a pose held against products of matrices and Newton's method, from the table alone.

The branches are put into A_1 ... A_n, multiplied in floating point; each configuration that
Newton's method finds from random starts must be one of them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from tests.support import FUNCTIONS, solve_json

Vector = npt.NDArray[np.float64]

KNOWN = FUNCTIONS | {name: getattr(math, name) for name in ("asin", "acos", "atan2")}
STARTS, STEPS = 10, 30

# the rows (d, a, alpha in degrees) of joints that turn; d of a slide is None
Row = tuple[float | None, float, float]

ARMS: dict[str, list[Row]] = {
    "PUMA 560": [
        (0, 0, 90), (0, 0.4, 0), (0.15, 0.02, -90), (0.4, 0, 90), (0, 0, -90), (0, 0, 0)
    ],
    "Stanford": [
        (0, 0, -90), (0.2, 0, 90), (None, 0, 0), (0, 0, -90), (0, 0, 90), (0.3, 0, 0)
    ],
    "three parallel axes": [
        (0.1, 0, 90), (0, 0.4, 0), (0, 0.4, 0), (0.1, 0, 90), (0.1, 0, -90), (0.1, 0, 0)
    ],
    "SCARA": [(0.5, 0.4, 0), (0, 0.3, 180), (None, 0, 0), (0.1, 0, 0)],
}  # fmt: skip


def matrix(row: Row, q: float) -> Vector:
    """Rot(z, θ) Trans(z, d) Trans(x, a) Rot(x, α)"""
    d, a, alpha = row
    theta, d = (0.0, q) if d is None else (q, d)
    c, s, ca, sa = (
        math.cos(theta),
        math.sin(theta),
        math.cos(math.radians(alpha)),
        math.sin(math.radians(alpha)),
    )
    return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])


class Arm:
    """A table, and the branches that the JSON has for it."""

    def __init__(self, rows: list[Row]) -> None:
        self.rows = rows
        self.turning = np.array([row[0] is not None for row in rows])
        table = ", ".join(self._written(k, *row) for k, row in enumerate(rows, 1))
        results = solve_json(f"gravity: none\ndh: [{table}]\ntask: pose\nfind: [inverse]\n")["results"]
        self.branches: list[dict[str, Any]] = results["inverse"]

    @staticmethod
    def _written(k: int, d: float | None, a: float, alpha: float) -> str:
        moves = f"d: q{k}*" if d is None else f"theta: q{k}*, d: {d}"
        return f"{{{moves}, a: {a}, alpha: {alpha}deg}}"

    def pose(self, q: Vector) -> Vector:
        """The position and the rows of the rotation."""
        H = np.eye(4)
        for row, value in zip(self.rows, q, strict=True):
            H = H @ matrix(row, float(value))
        return np.concatenate((H[:3, 3], H[:3, :3].ravel()))

    def solutions(self, pose: Vector) -> list[Vector]:
        """The configurations of the branches."""
        names = [*"xyz", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3))]
        given = dict(zip(names, map(float, pose), strict=True))
        found = (self._configuration(branch, dict(given)) for branch in self.branches)
        return [q for q in found if q is not None]

    def _configuration(self, branch: Mapping[str, Any], values: dict[str, float]) -> Vector | None:
        try:
            for name, formula in branch.items():
                if name != "when":
                    values[name] = eval(formula, dict(KNOWN), values)  # noqa: S307 - results of our own
            for condition in branch.get("when", ()):
                left, right = (eval(side, dict(KNOWN), values) for side in condition.split(" = "))  # noqa: S307
                assert math.isclose(left, right, abs_tol=1e-9)
        except ValueError:  # beyond reach
            return None
        return np.array([values[f"q{k}"] for k in range(1, len(self.rows) + 1)])

    def newton(self, pose: Vector, draw: np.random.Generator) -> list[Vector]:
        """What Newton's method leads to from random configurations."""
        found = []
        for _ in range(STARTS):
            q = draw.uniform(-3, 3, len(self.rows))
            for _ in range(STEPS):
                gap = pose - self.pose(q)
                if np.abs(gap).max() < 1e-11:
                    found.append(q)
                    break
                steps = 1e-6 * np.eye(len(q))
                slopes = np.array([(self.pose(q + h) - self.pose(q - h)) / 2e-6 for h in steps]).T
                step = np.linalg.lstsq(slopes, gap, rcond=1e-9)[0]
                q = q + step * min(1.0, 1.0 / np.abs(step).max())
        return found

    def is_same(self, q: Vector, other: Vector) -> bool:
        """Whether two configurations are the same, angles modulo 2π."""
        gap = np.where(self.turning, (q - other + math.pi) % (2 * math.pi) - math.pi, q - other)
        return bool(np.abs(gap).max() < 1e-5)


@pytest.mark.parametrize("name", ARMS)
def test_the_branches_are_those_that_reach_a_pose(name: str) -> None:
    draw = np.random.default_rng(11)
    arm = Arm(ARMS[name])
    hits = 0
    for _ in range(3):
        pose = arm.pose(draw.uniform(-2, 2, len(arm.rows)))
        branches = arm.solutions(pose)
        assert branches
        assert all(np.allclose(arm.pose(q), pose, atol=1e-8) for q in branches)
        assert not any(arm.is_same(a, b) for k, a in enumerate(branches) for b in branches[:k])
        found = arm.newton(pose, draw)
        hits += len(found)
        assert all(any(arm.is_same(q, other) for other in branches) for q in found)
    assert hits > 3
