"""Drawings beside a step: of lengths and angles, and of the arm in a singular configuration."""

from __future__ import annotations

import re
from itertools import combinations
from math import pi

import pytest

import dynsolve
from dynsolve.document.figures import ArmFigure, Figure, FigureAngle, FigureLine, LineKind
from dynsolve.draw.figure import TIP_ON, axes_through_tip, drawn, drawn_arm, figure_scene
from dynsolve.draw.paths import VARIABLE
from dynsolve.draw.pose_search import held_pose
from dynsolve.draw.skeleton import numbers, orientation, skeleton
from dynsolve.draw.vectors import dot, length, point_to_segment, subtract
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Symbol
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from dynsolve.robot.model import JointType

# -- drawings beside a step: every name stands once, and on no other ---------------------------------


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


# -- the arm in a singular configuration, as it is drawn: the tip does not move along the arrow ------


ELBOW = (
    "dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {theta: q3*, a: L3}]\nfind: [singular]\n"
)
SLIDING = """
dh:
  - {theta: q1* + 180deg, d: L1, alpha: 90deg}
  - {theta: -90deg, d: d2* + L2, alpha: 90deg}
  - {theta: q3* + 90deg, a: L3}
find: [singular]
"""
PLANAR = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nfind: [singular]\n"
MODIFIED = """
dh: [{theta: q1*, d: d1}, {theta: q2*, alpha: 90deg}, {theta: q3*, a: a2}, {a: a3}]
find: [singular]
"""
TURNING = PLANAR.replace("find", "task: [tip.x, tip.y, q1 + q2]\nfind")
"""With the direction of the hand a third component, no motion of the tip alone is lost."""


def figures(text: str) -> list[ArmFigure]:
    steps = dynsolve.solve(text).steps
    return [step.figure for step in steps if isinstance(step.figure, ArmFigure)]


@pytest.mark.parametrize(("text", "count"), [(ELBOW, 2), (SLIDING, 2), (PLANAR, 1), (TURNING, 0)])
def test_a_case_has_its_drawing(text: str, count: int) -> None:
    assert len(figures(text)) == count


@pytest.mark.parametrize("text", [ELBOW, SLIDING, PLANAR])
def test_the_arm_of_a_case_is_small(text: str) -> None:
    for figure in figures(text):
        picture = drawn_arm(figure, read_problem(text, "own.yaml"), Style())
        assert picture is not None
        height = re.search(r'height="([.0-9]+)" viewBox', picture.svg)
        assert height is not None
        assert float(height[1]) <= 230.0


@pytest.mark.parametrize("text", [ELBOW, SLIDING, PLANAR])
def test_the_tip_does_not_move_along_the_arrow(text: str) -> None:
    """Each joint moved a little, in numbers: the motion of the tip is orthogonal to w."""
    problem = read_problem(text, "own.yaml")
    robot, known = problem.robot, numbers(problem)
    for figure in figures(text):
        found = held_pose(robot, known, orientation(robot, known), figure.zeros)
        assert found is not None
        _, at = found
        assert max(abs(float(evaluate(zero, at))) for zero in figure.zeros) < 1e-6
        units = [known.unit if c.type is JointType.PRISMATIC else 1.0 for c in robot.coordinates]
        q = [at[c.name] / unit for c, unit in zip(robot.coordinates, units, strict=True)]
        (arrow,) = figure.arrows
        x, y, z = (float(evaluate(part, at)) for part in arrow.direction)
        assert length((x, y, z)) > 1e-3
        for k in range(robot.n):
            tips = [
                skeleton(robot, known, [*q[:k], q[k] + change, *q[k + 1 :]]).frames[-1].origin
                for change in (-1e-5, 1e-5)
            ]
            assert abs(dot(subtract(tips[1], tips[0]), (x, y, z))) < 1e-8


@pytest.mark.parametrize("text", [ELBOW, SLIDING, PLANAR])
def test_no_arrow_lies_on_the_last_link(text: str) -> None:
    problem = read_problem(text, "own.yaml")
    known = numbers(problem)
    for figure in figures(text):
        found = held_pose(problem.robot, known, orientation(problem.robot, known), figure.zeros)
        picture = drawn_arm(figure, problem, Style())
        assert found is not None and picture is not None
        pose, _ = found
        link = [pose.view.point(point) for point in pose.skeleton.path[-2:]]
        number = "(-?[.0-9]+)"
        line = f'"M{number} {number}L{number} {number}"'
        shaft = re.search(f'{line}[^>]*stroke="{VARIABLE}" stroke-width="2.4"', picture.svg)
        assert shaft is not None
        x0, y0, x1, y1 = map(float, shaft.groups())
        assert point_to_segment(((x0 + x1) / 2, (y0 + y1) / 2), link[0], link[1]) > 8.0


@pytest.mark.parametrize(
    ("text", "axes"),
    [
        (ELBOW, [["z₀"], []]),
        (SLIDING, [["z₀"], []]),
        (PLANAR, [[]]),
        (f"convention: modified\n{MODIFIED}", [["z₁"], []]),
    ],
)
def test_the_axis_on_which_the_tip_lies_is_drawn(text: str, axes: list[list[str]]) -> None:
    """There the tip does not move as that joint turns; the axis is dashed, and the caption says so."""
    problem = read_problem(text, "own.yaml")
    known = numbers(problem)
    drawn = []
    for figure in figures(text):
        found = held_pose(problem.robot, known, orientation(problem.robot, known), figure.zeros)
        picture = drawn_arm(figure, problem, Style())
        assert found is not None and picture is not None
        drawn.append([to_unicode(name) for name, _ in axes_through_tip(problem.robot, known, found[0])])
        assert (TIP_ON[0] in picture.caption) is bool(drawn[-1])
        assert ("stroke-dasharray" in picture.svg) is bool(drawn[-1])
    assert drawn == axes


def test_the_same_drawing_every_time() -> None:
    problem = read_problem(PLANAR, "own.yaml")
    (figure,) = figures(PLANAR)
    first, second = (drawn_arm(figure, problem, Style()) for _ in range(2))
    assert first is not None
    assert first == second
    assert "<svg" in first.svg and "picture" in first.latex
    assert first.caption == "The arm in this case: its tip cannot move along the arrow."


def test_no_drawing_where_nothing_is_zero() -> None:
    problem = read_problem(PLANAR, "own.yaml")
    never = ArmFigure("", (Symbol("l1"),))
    assert drawn_arm(never, problem, Style()) is None
