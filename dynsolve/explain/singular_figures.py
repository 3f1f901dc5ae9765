"""Drawings of singular configurations: the arm there, and the directions that are lost at its tip."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.document.figures import ArmArrow, ArmFigure
from dynsolve.notation.tree import ZERO, Matrix, Node, Reference
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP

MOST_ARROWS = 3
_POSITIONS = 3
"""The rows of J that are velocities of the tip."""


def figure_of(
    robot: Robot, matrix: str, zeros: Sequence[Node], names: Sequence[Node], lost: Sequence[Matrix]
) -> ArmFigure | None:
    """The arm where the conditions hold; None without links, or where no motion of the tip is lost.

    `matrix` is the Jacobian that loses rank, `lost` the columns w with wᵀ J = 0.
    """
    axes = _axes_of_rows(robot, matrix)
    if not robot.has_table or axes is None:
        return None
    arrows = tuple(
        ArmArrow(name, direction)
        for name, w in zip(names, lost, strict=True)
        if (direction := _motion(w, axes)) is not None
    )
    if not arrows or len(arrows) > MOST_ARROWS:
        return None
    those = "the arrow" if len(arrows) == 1 else "the arrows"
    return ArmFigure(f"The arm in this case: its tip cannot move along {those}.", tuple(zeros), arrows)


def _axes_of_rows(robot: Robot, matrix: str) -> tuple[int | None, ...] | None:
    """The axis of the world along which each row of a Jacobian is a velocity of the tip, or None."""
    task = robot.questions.task
    if matrix == "J" or task is None or task.is_twist:
        return (*range(_POSITIONS), *(None,) * _POSITIONS)
    return tuple(map(_axis, task.entries))


def _axis(entry: Node) -> int | None:
    if isinstance(entry, Reference) and entry.quantity == TIP and entry.row is not None:
        return entry.row - 1
    return None


def _motion(w: Matrix, axes: Sequence[int | None]) -> tuple[Node, Node, Node] | None:
    """A lost direction as a motion of the tip; None where something else takes part in it."""
    found: list[Node] = [ZERO, ZERO, ZERO]
    for (component,), axis in zip(w.rows, axes, strict=True):
        if axis is not None:
            found[axis] = component
        elif component != ZERO:
            return None
    return (found[0], found[1], found[2]) if any(part != ZERO for part in found) else None
