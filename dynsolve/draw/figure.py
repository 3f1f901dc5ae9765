"""Drawings beside a step: a triangle, a projection; their lines, arcs and names on paper."""

from __future__ import annotations

import math
from collections.abc import Iterator

from dynsolve.document import Picture
from dynsolve.document.figures import Figure, FigureAngle, FigureLine, LineKind, Place
from dynsolve.draw import paths
from dynsolve.draw.annotate import Notes
from dynsolve.draw.labels import place
from dynsolve.draw.latex import to_latex_picture
from dynsolve.draw.occupied import Taken
from dynsolve.draw.paths import Path
from dynsolve.draw.scene import Scene, framed, leads
from dynsolve.draw.svg import to_svg
from dynsolve.draw.vectors import Point
from dynsolve.notation.printing import Style

UNIT = 54.0
"""Picture units for 1 of a figure."""

_ARC = 30.0
_POINT = 3.6


def drawn(figure: Figure, style: Style) -> Picture:
    """A figure as a block of a document.

    >>> from dynsolve.notation.tree import Symbol
    >>> line = FigureLine((0.0, 0.0), (2.0, 1.0), LineKind.LENGTH, Symbol("l1"))
    >>> drawn(Figure("A link.", (line,)), Style()).svg[:4]
    '<svg'
    """
    scene = figure_scene(figure, style)
    return Picture(to_svg(scene), figure.caption, to_latex_picture(scene))


def figure_scene(figure: Figure, style: Style) -> Scene:
    """The lines and arcs of a figure with their names in places of their own."""
    notes = Notes(style, Taken())
    for line in sorted(figure.lines, key=lambda line: line.kind is LineKind.LENGTH):
        notes.draw(*_line(line))
    for angle in figure.angles:
        notes.draw(*_angle(angle))
    for at in figure.points:
        notes.draw(Path(paths.circle(_on_paper(at), _POINT), None, fill=paths.BLACK))
    for line in figure.lines:
        _name_line(line, notes)
    for angle in figure.angles:
        _name_angle(angle, notes)
    labels = place(notes.wanted, notes.taken)
    drawn_paths = (*notes.paths, *leads(labels))
    return Scene("", figure.caption, figure.caption, drawn_paths, labels, framed(drawn_paths, labels), style)


_LOOKS = {
    LineKind.AXIS: (paths.FRAME, 1.4),
    LineKind.LENGTH: (paths.BLACK, 2.2),
    LineKind.HELP: (paths.GREY, 1.0),
}


def _line(line: FigureLine) -> Iterator[Path]:
    a, b = _on_paper(line.start), _on_paper(line.end)
    colour, width = _LOOKS[line.kind]
    yield Path(paths.line(a, b), colour, width, dashed=line.kind is LineKind.HELP)
    if line.kind is LineKind.AXIS:
        yield Path(paths.head(b, (b[0] - a[0], b[1] - a[1])), None, fill=colour)


def _name_line(line: FigureLine, notes: Notes) -> None:
    if line.name is None:
        return
    a, b = _on_paper(line.start), _on_paper(line.end)
    colour, _ = _LOOKS[line.kind]
    along = (b[0] - a[0], b[1] - a[1])
    if line.kind is LineKind.AXIS:
        notes.label(line.name, [b], along, colour, "axis")
        return
    anchors = [(a[0] + part * along[0], a[1] + part * along[1]) for part in (0.5, 0.4, 0.6, 0.3, 0.7)]
    colour = paths.BLACK if line.kind is LineKind.HELP else colour
    notes.label(line.name, anchors, (along[1], -along[0]), colour, "length")


def _angle(angle: FigureAngle) -> Iterator[Path]:
    """An arc with a head at its end."""
    radius = _radius(angle)
    size = angle.end - angle.start
    short = angle.end - math.copysign(min(6.0 / radius, abs(size) / 2), size)
    tip, before = (_on_arc(angle, t) for t in (angle.end, short))
    center = _on_paper(angle.at)
    yield Path(paths.arc(center, (radius, 0.0), (0.0, -radius), angle.start, short), paths.VARIABLE, 1.4)
    yield Path(paths.head(tip, (tip[0] - before[0], tip[1] - before[1]), 8.0), None, fill=paths.VARIABLE)


def _name_angle(angle: FigureAngle, notes: Notes) -> None:
    size = angle.end - angle.start
    anchors = [_on_arc(angle, angle.start + part * size) for part in (0.5, 0.35, 0.65)]
    x, y = _on_paper(angle.at)
    notes.label(angle.name, anchors, (anchors[0][0] - x, anchors[0][1] - y), paths.VARIABLE, "variable")


def _radius(angle: FigureAngle) -> float:
    """The radius of an arc; of a small angle it is larger."""
    return _ARC if abs(angle.end - angle.start) > 0.6 else _ARC + 18.0


def _on_arc(angle: FigureAngle, t: float) -> Point:
    radius = _radius(angle)
    return paths.on_ellipse(_on_paper(angle.at), (radius, 0.0), (0.0, -radius), t)


def _on_paper(at: Place) -> Point:
    """On paper y grows downwards."""
    return UNIT * at[0], -UNIT * at[1]
