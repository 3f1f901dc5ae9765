"""Absolute angles: where consecutive axes are parallel, and with which sign they add up."""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, sin

import numpy as np
import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.robot.geometry import Turn, absolute_angles

NAMES = ("q1", "q2", "q3", "q4")
q1, q2, q3, q4 = (Angle.of(name) for name in NAMES)


def degrees(value: int) -> Angle:
    return Angle((), Fraction(value))


def turn(theta: Angle, alpha: Angle | int = 0) -> Turn:
    angle = alpha if isinstance(alpha, Angle) else degrees(alpha)
    return Turn(theta, angle, bool(theta.terms))


CASES = [
    ("planar", [turn(q1), turn(q2), turn(q3)], False, [q1, q1 + q2, q1 + q2 + q3]),
    ("an elbow", [turn(q1, 90), turn(q2), turn(q3)], False, [q1, q2, q2 + q3]),
    ("an elbow, modified", [turn(q1), turn(q2, -90), turn(q3)], True, [q1, q2, q2 + q3]),
    ("a scara", [turn(q1), turn(q2, 180), turn(degrees(0)), turn(q4)], False, [q1, q1 + q2, q1 + q2 - q4]),
    ("a fixed row between", [turn(q1), turn(degrees(30)), turn(q2)], False, [q1, q1 + q2]),
    ("a tilted row between", [turn(q1), turn(degrees(30), 45), turn(q2)], False, [q1, q2]),
    ("tilted and back", [turn(q1, 45), turn(degrees(0), -45), turn(q2)], False, [q1, q1 + q2]),
    ("a symbolic tilt", [turn(q1, Angle.of("beta")), turn(q2)], False, [q1, q2]),
    (
        "a symbolic tilt and back",
        [turn(q1, Angle.of("beta")), turn(degrees(0), -Angle.of("beta")), turn(q2)],
        False,
        [q1, q1 + q2],
    ),
    ("absolute coordinates", [turn(q1), turn(q2 - q1), turn(q3 - q2)], False, [q1, q2, q3]),
    (
        "an offset",
        [turn(q1 + degrees(90)), turn(q2 - degrees(60))],
        False,
        [q1, q1 + q2 - degrees(60)],
    ),
    ("turned over twice", [turn(q1, 180), turn(q2, 180), turn(q3)], False, [q1, q1 - q2, q1 - q2 + q3]),
]


@pytest.mark.parametrize(("name", "turns", "modified", "expected"), CASES, ids=[case[0] for case in CASES])
def test_running_sums(name: str, turns: list[Turn], modified: bool, expected: list[Angle]) -> None:
    found = absolute_angles(turns, NAMES, modified)
    assert [angle if angle in expected else -angle for angle in found] == expected


def about_z(x: float) -> np.ndarray:
    return np.array([[cos(x), -sin(x), 0], [sin(x), cos(x), 0], [0, 0, 1]])


def about_x(x: float) -> np.ndarray:
    return np.array([[1, 0, 0], [0, cos(x), -sin(x)], [0, sin(x), cos(x)]])


@pytest.mark.parametrize("flips", [(0, 0), (1, 0), (0, 1), (1, 1)])
def test_the_orientation_is_a_function_of_the_absolute_angle(flips: tuple[int, int]) -> None:
    """Changing the angles so that the last absolute one stays leaves the last frame as it is."""
    turns = [turn(q1, 180 * flips[0]), turn(q2, 180 * flips[1]), turn(q3)]
    last = absolute_angles(turns, NAMES, modified=False)[-1]
    signs = [float(dict(last.terms)[((name, 1),)]) for name in NAMES[:3]]

    def orientation(values: list[float]) -> np.ndarray:
        rotation = np.eye(3)
        for value, flip in zip(values, (*flips, 0), strict=True):
            rotation = rotation @ about_z(value) @ about_x(pi * flip)
        return rotation

    start = [0.3, -0.7, 1.1]
    changed = [start[0] + 0.4, start[1] - 0.4 * signs[0] / signs[1], start[2]]
    assert np.allclose(orientation(start), orientation(changed))
    other = [start[0] + 0.4, start[1] + 0.4 * signs[0] / signs[1], start[2]]
    assert not np.allclose(orientation(start), orientation(other))
