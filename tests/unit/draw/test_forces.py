"""Forces from outside: an arrow at the point where each acts."""

from __future__ import annotations

import pytest

from dynsolve.draw.forces import FORCES, MOMENTS, TURNING, drawn_forces
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.scene import Scene
from dynsolve.draw.skeleton import numbers, orientation
from dynsolve.problem import read_problem
from tests.unit.draw.pictures import drawn_text, names, overlapping

ARM = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"


@pytest.mark.parametrize(
    ("force", "letters", "direction"),
    [
        ("force: [0, -F, 0]", ["F"], (0.0, -1.0, 0.0)),
        ("force: [0, -F, 0], by: robot", ["F"], (0.0, 1.0, 0.0)),
        ("force: [0, 0, F]", ["F"], (0.0, 0.0, 1.0)),
        ("force: [3, 4, 0]", ["F₁"], (0.6, 0.8, 0.0)),
    ],
)
def test_a_force_is_drawn_at_its_point(force: str, letters: list[str], direction: tuple[float, ...]) -> None:
    text = f"{ARM}forces: [{{link: 2, at: tip, {force}}}]\nfind: [Q]"
    problem = read_problem(text, "force.yaml")
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    ((_, _, at, way),) = drawn_forces(problem.robot, values, pose)
    assert at == pytest.approx(pose.skeleton.frames[2].origin) and way == pytest.approx(direction)
    picture = drawn_text(text)
    assert names(picture, "force") == letters and overlapping(picture) == []
    assert said_in(picture) == [FORCES]


def said_in(picture: Scene) -> list[str]:
    return [each for each in (FORCES, MOMENTS, TURNING) if each in picture.caption]


@pytest.mark.parametrize(
    ("force", "said"),
    [
        ("moment: [0, 0, M]", [MOMENTS]),
        ("force: [F*cos(q1), F*sin(q1), 0]", [TURNING]),
        ("force: [F*cos(q1), 0, 0], moment: [0, 0, M]", [MOMENTS, TURNING]),
        ("force: [F, 0, 0], moment: [0, 0, M*q1]", [FORCES, MOMENTS]),
    ],
)
def test_what_has_no_arrow_is_said(force: str, said: list[str]) -> None:
    """Each by itself: beside a moment the force is drawn."""
    picture = drawn_text(f"{ARM}forces: [{{link: 2, at: tip, {force}}}]\nfind: [Q]")
    assert bool(names(picture, "force")) == (FORCES in said) and said_in(picture) == said
