"""The arm in a pose beside a step: its body, and arrows at its tip."""

from __future__ import annotations

from collections.abc import Mapping

from dynsolve.document import Picture
from dynsolve.document.figures import ArmArrow, ArmFigure
from dynsolve.draw import annotate, paths
from dynsolve.draw.drawn_lengths import numbers
from dynsolve.draw.held_pose import held_pose
from dynsolve.draw.labels import place
from dynsolve.draw.latex import to_latex_picture
from dynsolve.draw.occupied import Taken
from dynsolve.draw.orientation import orientation
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import Pose
from dynsolve.draw.scene import Scene, framed, leads
from dynsolve.draw.solids import ground, solids
from dynsolve.draw.svg import to_svg
from dynsolve.draw.vectors import NEAR, Vector, length, unit
from dynsolve.notation.printing import Style
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem.model import Problem

_ARROW = 62.0
_END_ON = 0.12
"""An arrow that is foreshortened more is drawn as one that is seen end on."""


def drawn_arm(figure: ArmFigure, problem: Problem, style: Style) -> Picture | None:
    """The arm of a figure as a block of a document; None where no such pose is found."""
    robot, values = problem.robot, numbers(problem)
    world = orientation(robot, values, problem.normals is not None)
    found = held_pose(robot, values, world, figure.zeros)
    if found is None:
        return None
    pose, at = found
    body = (*ground(pose.parts, pose.view), *solids(pose.parts, pose.view, world.up))
    notes = annotate.Notes(style, Taken())
    notes.taken.add(body)
    for arrow in figure.arrows:
        _arrow(arrow, at, pose, notes)
    labels = place(notes.wanted, notes.taken)
    lines = (*body, *notes.paths, *leads(labels))
    scene = Scene("", figure.caption, figure.caption, lines, labels, framed(lines, labels), style)
    return Picture(to_svg(scene), figure.caption, to_latex_picture(scene))


def _arrow(arrow: ArmArrow, at: Mapping[str, float], pose: Pose, notes: annotate.Notes) -> None:
    x, y, z = (float(evaluate(part, at)) for part in arrow.direction)
    direction: Vector = (x, y, z)
    if length(direction) < NEAR:
        return
    tip = pose.view.point(pose.skeleton.frames[-1].origin)
    dx, dy = pose.view.direction(unit(direction))
    if (dx**2 + dy**2) ** 0.5 < _END_ON:
        notes.draw(
            Path(paths.circle(tip, 7.0), paths.VARIABLE, 1.8, paths.WHITE),
            Path(paths.circle(tip, 2.4), None, fill=paths.VARIABLE),
        )
        notes.label(arrow.name, [tip], (1.0, -1.0), paths.VARIABLE, "axis", 8.0)
        return
    end = (tip[0] + dx * _ARROW, tip[1] + dy * _ARROW)
    short = (tip[0] + dx * (_ARROW - 7.0), tip[1] + dy * (_ARROW - 7.0))
    notes.draw(
        Path(paths.line(tip, short), paths.WHITE, 5.0),
        Path(paths.line(tip, short), paths.VARIABLE, 2.4),
        Path(paths.head(end, (dx, dy), 11.0), None, fill=paths.VARIABLE),
    )
    notes.label(arrow.name, [end], (dx, dy), paths.VARIABLE, "axis")
