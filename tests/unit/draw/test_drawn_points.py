"""A robot that was given by a drawing shows the letters of its points, and where the world's axes point."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from dynsolve.draw.drawn_points import as_drawn, given_lengths
from dynsolve.draw.lengths import ASIDE, SAME, WORLD
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.scene import scene
from dynsolve.draw.skeleton import numbers, orientation
from dynsolve.draw.vectors import ORIGIN
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from tests.unit.draw.pictures import drawn_text, names

SLANTED = """axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {slide: d2, along: [cos(30deg), 0, sin(30deg)]}
  - {turn: q3, about: [0, -1, 0], through: [b, 0, c]}
tip: [b + l, 0, c]
"""
BENT = """axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: q2, about: [0, 1, 0], through: [h*sin(45deg), 0, b + h*cos(45deg)]}
tip: [h*sin(45deg) + l, 0, b + h*cos(45deg)]
zero: drawn
"""
LEANING = """axes:
  - {turn: t1, about: [sin(20deg), 0, cos(20deg)], through: [0, 0, 0]}
  - {turn: t2, about: [0, 1, 0], through: [L*sin(20deg), 0, L*cos(20deg)]}
tip: [L*sin(20deg) + l, 0, L*cos(20deg)]
zero: drawn
"""


@pytest.mark.parametrize(
    ("drawing", "ends"),
    [
        (SLANTED, {"b": lambda b, c, **_: (b, 0, 0), "c": lambda b, c, **_: (b, 0, c)}),
        (BENT, {"b": lambda b, **_: (0, 0, b), "h": lambda b, h, **_: (h * 0.5**0.5, 0, b + h * 0.5**0.5)}),
        (LEANING, {}),
    ],
)
def test_the_letters_of_a_drawing_lead_from_point_to_point(
    drawing: str, ends: dict[str, Callable[..., tuple[float, float, float]]]
) -> None:
    """But for those that a row of the table is; the way is the one whose corners are nearest to the arm."""
    problem = read_problem(drawing.encode(), "drawing.yaml")
    values = numbers(problem)
    pose = best_pose(
        problem.robot, values, orientation(problem.robot, values, True), as_drawn(problem, values)
    )
    shown = [node for joint in problem.robot.joints for node in joint.written[1:3]]
    found = given_lengths(problem, values, pose, shown)
    for each in found:
        where = ends[to_unicode(each.node)](**values.values)
        assert each.end == pytest.approx([x / values.unit for x in where])
    assert [to_unicode(each.node) for each in found] == list(ends)
    assert all(each.start in (ORIGIN, *(other.end for other in found)) for each in found)
    assert set(ends) <= set(names(drawn_text(drawing), "length"))


@pytest.mark.parametrize(
    ("robot", "axes", "said"),
    [
        (SLANTED, [], [SAME]),
        (LEANING, ["x_w", "y_w", "z_w"], [WORLD, ASIDE]),
        ("base: Rz(30deg)*Rx(20deg)\ndh: [{theta: q1*, a: l}]\n", ["x_w", "y_w", "z_w"], [WORLD, ASIDE]),
        ("base: Rx(90deg)\ndh: [{theta: q1*, a: l}]\n", [], []),
        ("base: {move: [0, 0, h]}\ndh: [{theta: q1*, a: l}]\n", ["x_w", "y_w", "z_w"], [WORLD]),
    ],
)
def test_the_axes_of_the_world_are_shown_once(robot: str, axes: list[str], said: list[str]) -> None:
    picture = drawn_text(robot)
    assert [name for name in names(picture, "axis") if name.endswith("w")] == axes
    assert [each for each in (SAME, WORLD, ASIDE) if each in picture.caption] == said


def test_a_sheet_that_asks_for_the_table_shows_the_given_letters_in_its_place() -> None:
    problem = read_problem(BENT.encode(), "drawing.yaml")
    assert "√2 h/2 + b" in names(scene(problem), "length")
    sheet = scene(problem, frames=False)
    assert sorted(names(sheet, "length")) == ["b", "h", "l"] and SAME not in sheet.caption
    leaning = scene(read_problem(LEANING.encode(), "drawing.yaml"), frames=False)
    assert WORLD in leaning.caption and ASIDE not in leaning.caption


def test_a_mass_centre_at_an_irrational_distance_has_its_root() -> None:
    bent = (
        SLANTED.replace("30deg", "45deg")
        .replace("[b, 0, c]", "[0.3, 0, 0.3]")
        .replace("b + l, 0, c", "0.5, 0, 0.3")
    )
    masses = "masses:\n  - {mass: 2, link: 2, center: {drawn: [0.1, 0, 0.1]}}\n  - {mass: 1, link: 3}\n"
    picture = scene(read_problem(f"{bent}{masses}".encode(), "drawing.yaml"))
    assert [name for name in names(picture, "length") if "√" in name] == ["√2/5"]
