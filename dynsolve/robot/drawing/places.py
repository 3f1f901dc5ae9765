"""Where a sliding axis is laid that is drawn nowhere in particular.

A prismatic joint has a direction and no place (Craig 3.4): its axis may be any line along
it.  Of the lines through the axis before, through the axis after it or the hand, and
through the origin of the world, those are taken with which fewest lengths of the table differ from 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from dynsolve.algebra.matrix import Matrix
from dynsolve.robot.drawing.drawn import Drawing, DrawnAxis, Line
from dynsolve.robot.drawing.normals import NeedsMore, NoAngle
from dynsolve.robot.drawing.procedure import normals_of
from dynsolve.robot.drawing.rows import rows_of

_MOST_CHOICES = 81


def placed(drawing: Drawing) -> Drawing:
    """The drawing with every sliding axis in a place.

    Raises what `normals_of` and `rows_of` raise.
    """
    if all(axis.is_placed for axis in drawing.axes):
        return drawing
    choices = [tuple(_choices(drawing, i)) for i in range(len(drawing.axes))]
    every = (
        replace(drawing, axes=axes) for axes, _ in zip(product(*choices), range(_MOST_CHOICES), strict=False)
    )
    return min(every, key=_offsets)


def _choices(drawing: Drawing, i: int) -> Iterator[DrawnAxis]:
    """The axis as it is, or in each of the places it may have."""
    axis = drawing.axes[i]
    if axis.is_placed:
        yield axis
        return
    points = [other.line.point for other in drawing.axes[:i][::-1] if other.is_placed][:1]
    points += [other.line.point for other in drawing.axes[i + 1 :] if other.is_placed][:1]
    points += [drawing.hand.at, Matrix.zero(drawing.ring, 3, 1)]
    for point in dict.fromkeys(points):
        yield replace(axis, line=Line(point, axis.line.direction))


def _offsets(drawing: Drawing) -> int:
    """How many lengths of the table and of the base differ from 0; many where there is no table."""
    try:
        normals = normals_of(drawing)
        lengths = [length for row in rows_of(normals) for length in (row.a, row.d)]
    except (NoAngle, NeedsMore):
        return 4 * len(drawing.axes)
    lengths += normals.all[0].end.entries
    return sum(not length.is_zero for length in lengths)
