"""Whether a table moves the hand as the drawn joint axes do: the product of exponentials.

    H(q⁰ + δ) = e^{[S_1] δ_1} ... e^{[S_n] δ_n} H(q⁰)

where S_i is the screw of axis i in the pose that is drawn and q⁰ the coordinates there
(Lynch and Park, Modern Robotics, 4.1; Murray, Li and Sastry 3.2.2).  Computed in floating point
at letters and displacements of samples from the lines of the drawing alone, it shares nothing with
the frames that the table was made from but q⁰.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import TypeVar

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.newton_euler import Rotation, Vector, applied, cross, dot, minus, plus, scaled, times
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.drawing.normals import DrawnAxis, Normals

TOLERANCE = 1e-9
_T = TypeVar("_T")


def verify_drawing(normals: Normals, hand_frame: Node, states: int = 5) -> float:
    """The largest error of a printed H of the hand against the drawn axes.

    Raises VerificationError where it is more than `TOLERANCE`.
    """
    program = compile_trees([hand_frame])
    worst = 0.0
    ways = {axis.coordinate: f"way of {axis.coordinate}" for axis in normals.drawing.axes}
    found = states_with(normals.drawing.ring, partial(drawn_coordinates, normals), ways.values())
    for letters, drawn in islice(found, states):
        moved = {name: value + letters[ways[name]] for name, value in drawn.items()}
        (home,), (there,) = program.run({**letters, **drawn}), program.run({**letters, **moved})
        worst = max(worst, _home_error(normals, letters, home))
        displaced = [letters[ways[axis.coordinate]] for axis in normals.drawing.axes]
        worst = max(worst, _distance(_exponentials(normals, letters, displaced, home), there))
    if not worst <= TOLERANCE:
        raise VerificationError(
            f"the table moves the hand otherwise than the drawn axes do, by {worst:.1e}; "
            "this is a fault of dynsolve"
        )
    return worst


def drawn_coordinates(normals: Normals, letters: Mapping[str, float]) -> dict[str, float]:
    """q⁰, the coordinates in the pose that is drawn."""
    return {
        axis.coordinate: _drawn_coordinate(normals, i, axis, letters)
        for i, axis in enumerate(normals.drawing.axes)
    }


def _drawn_coordinate(normals: Normals, i: int, axis: DrawnAxis, letters: Mapping[str, float]) -> float:
    drawing, before, after = normals.drawing, normals.all[i], normals.all[i + 1]
    if drawing.zero_is_drawn:
        return letters[axis.coordinate] if drawing.drawn_slide(axis) else 0.0
    z = _vector(axis.line.direction, letters)
    if axis.slides:
        return dot(_vector(after.start - before.end, letters), z)
    x, turned = _vector(before.x, letters), _vector(after.x, letters)
    return math.atan2(dot(cross(x, turned), z), dot(x, turned))


def _vector(column: Matrix, letters: Mapping[str, float]) -> Vector:
    x, y, z = (evaluate(entry, letters) for entry in column.entries)
    return x, y, z


def _home_error(normals: Normals, letters: Mapping[str, float], home: Sequence[Sequence[float]]) -> float:
    """How far the hand is from where it is drawn, and its axes from those that are drawn."""
    hand = normals.drawing.hand
    drawn = [(3, hand.at), (2, hand.z), (0, hand.x)]
    return max(
        abs(home[row][column] - value)
        for column, vector in drawn
        if vector is not None
        for row, value in enumerate(_vector(vector, letters))
    )


def _exponentials(
    normals: Normals,
    letters: Mapping[str, float],
    displaced: Sequence[float],
    home: Sequence[Sequence[float]],
) -> list[list[float]]:
    """The hand's frame after every joint was displaced, the last first."""
    R: Rotation = _triple(_triple(row) for row in home)
    o: Vector = _triple(row[3] for row in home)
    for axis, amount in reversed(list(zip(normals.drawing.axes, displaced, strict=True))):
        z = _vector(axis.line.direction, letters)
        if axis.slides:
            o = plus(o, scaled(z, amount))
            continue
        point, turn = _vector(axis.line.point, letters), rodrigues(z, amount)
        R, o = times(turn, R), plus(point, applied(turn, minus(o, point)))
    return [[*row, x] for row, x in zip(R, o, strict=True)] + [[0.0, 0.0, 0.0, 1.0]]


def _triple(values: Iterable[_T]) -> tuple[_T, _T, _T]:
    """The first three."""
    x, y, z, *_ = values
    return x, y, z


def rodrigues(z: Vector, angle: float) -> Rotation:
    """e^{[z] θ} = 1 + sin θ [z] + (1 - cos θ) [z]²"""
    c, s = math.cos(angle), math.sin(angle)
    x, y, w = z
    return (
        (c + x * x * (1 - c), x * y * (1 - c) - w * s, x * w * (1 - c) + y * s),
        (y * x * (1 - c) + w * s, c + y * y * (1 - c), y * w * (1 - c) - x * s),
        (w * x * (1 - c) - y * s, w * y * (1 - c) + x * s, c + w * w * (1 - c)),
    )


def _distance(ours: Sequence[Sequence[float]], theirs: Sequence[Sequence[float]]) -> float:
    return max(
        abs(a - b) for row, other in zip(ours, theirs, strict=True) for a, b in zip(row, other, strict=True)
    )
