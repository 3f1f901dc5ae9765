"""Drawings beside a step: every name stands once, and on no other."""

from __future__ import annotations

from itertools import combinations
from math import pi

from dynsolve.document.figures import Figure, FigureAngle, FigureLine, LineKind
from dynsolve.draw.figure import drawn, figure_scene
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Symbol

TRIANGLE = Figure(
    "A triangle.",
    (
        FigureLine((0.0, 0.0), (1.5, 0.0), LineKind.LENGTH, Symbol("l1")),
        FigureLine((1.5, 0.0), (1.5, 1.2), LineKind.LENGTH, Symbol("l2")),
        FigureLine((0.0, 0.0), (1.5, 1.2), LineKind.HELP, Symbol("r")),
        FigureLine((0.0, 0.0), (0.0, 1.0), LineKind.AXIS, Symbol("y")),
    ),
    (FigureAngle((1.5, 0.0), 0.0, pi / 2, Symbol("q2")),),
    ((0.0, 0.0), (1.5, 1.2)),
)


def test_every_name_stands_once_and_on_no_other() -> None:
    labels = figure_scene(TRIANGLE, Style()).labels
    assert sorted(label.node.name for label in labels if isinstance(label.node, Symbol)) == [
        "l1",
        "l2",
        "q2",
        "r",
        "y",
    ]
    assert not any(a.box.overlaps(b.box) for a, b in combinations(labels, 2))


def test_y_grows_upwards() -> None:
    scene = figure_scene(TRIANGLE, Style())
    ends = [points[0] for path in scene.paths for letter, points in path.commands if letter == "L"]
    assert min(y for _, y in ends) < 0


def test_a_picture_has_its_words() -> None:
    picture = drawn(TRIANGLE, Style())
    assert "<desc>A triangle.</desc>" in picture.svg
    assert picture.latex.startswith("{")
    assert picture.caption == "A triangle."
