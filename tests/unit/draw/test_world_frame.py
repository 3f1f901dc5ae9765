"""The world around a base that is moved in it, or leans."""

from __future__ import annotations

import math

import pytest

from dynsolve.draw.labels import Taken
from dynsolve.draw.lengths import WORLD, has_world, moves, world_frame
from dynsolve.draw.paths import BLACK, flattened
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.poses import Notes, Pose
from dynsolve.draw.skeleton import numbers, orientation
from dynsolve.draw.vectors import ORIGIN, dot, subtract
from dynsolve.notation.printing import Style
from dynsolve.problem import read_problem
from tests.unit.draw.pictures import drawn_text, names, overlapping, struck_through

ROWS = "dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: l2}]\n"
PLANAR = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
WORLD_AXES = ["x_w", "y_w", "z_w"]


@pytest.mark.parametrize(
    ("base", "rows", "axes", "others"),
    [
        ("{rotate: Rx(30deg), move: [0, 0, h0]}", ROWS, WORLD_AXES, ["30°", "h₀"]),
        ("{rotate: Ry(-30deg)}", ROWS, ["z_w"], ["30°"]),
        ("{rotate: Rz(30deg), move: [b, h, 0]}", PLANAR, WORLD_AXES, ["30°", "b", "h"]),
        ("{move: [0.2, 0, 0.5]}", ROWS, WORLD_AXES, ["0.2", "0.5"]),
        ("{move: [0, 0, -h0]}", ROWS, WORLD_AXES, ["h₀"]),
        ("Rx(90deg)", ROWS, [], []),
        ("Rz(-90deg)", PLANAR, [], []),
    ],
)
def test_what_is_shown_of_the_world(base: str, rows: str, axes: list[str], others: list[str]) -> None:
    """Its axes and the moves along them, the angle of a single turn; nothing where turns are right angles."""
    picture = drawn_text(f"base: {base}\n{rows}")
    assert [name for name in names(picture, "axis") if name.endswith("w")] == axes
    table = {"d₁", "l₁", "l₂"}
    assert sorted({*names(picture, "length"), *names(picture, "angle")} - table) == sorted(others)
    assert (WORLD in picture.caption) is bool(axes)
    assert overlapping(picture) == [] and struck_through(picture) == []


def posed(base: str) -> tuple[Pose, Notes]:
    problem = read_problem(f"base: {base}\n{ROWS}", "leaning.yaml")
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    notes = Notes(Style(), Taken())
    assert has_world(problem.robot, values)
    world_frame(problem.robot, values, pose, notes)
    return pose, notes


@pytest.mark.parametrize("base", ["Rx(30deg)", "Rx(-30deg)", "Ry(40deg)", "Ry(130deg)"])
def test_the_arc_of_a_leaning_base_runs_from_z_of_the_world_to_z_of_frame_0(base: str) -> None:
    pose, notes = posed(base)
    (arc,) = (path for path in notes.paths if path.stroke == BLACK)
    points = [point for piece in flattened(arc.commands) for point in piece]
    at = pose.view.point(ORIGIN)
    for point, axis in ((points[0], (0.0, 0.0, 1.0)), (points[-1], pose.skeleton.frames[0].z)):
        x, y = pose.view.direction(axis)
        assert math.atan2(point[1] - at[1], point[0] - at[0]) == pytest.approx(math.atan2(y, x))


def test_moves_lead_from_the_world_to_frame_0() -> None:
    problem = read_problem(f"base: {{move: [b, 0, -0.5]}}\n{ROWS}", "moved.yaml")
    along_x, along_z = moves(problem.robot, numbers(problem))
    assert along_z.end == pytest.approx(ORIGIN) and along_z.start == along_x.end
    assert subtract(along_x.end, along_x.start)[0] > 0.0
    assert dot(subtract(along_z.end, along_z.start), (0.0, 0.0, 1.0)) < 0.0
