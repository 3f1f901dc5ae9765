"""What constraints hold points to is drawn where it holds them."""

from __future__ import annotations

import pytest

from dynsolve.draw.closings import CURVES, MEETINGS, NOT_HELD, OTHERS, PIVOTS, WALLS, closings
from dynsolve.draw.lengths import Length
from dynsolve.draw.parts import RADIUS
from dynsolve.draw.poses import Pose
from dynsolve.draw.scene import allowed_pose
from dynsolve.draw.skeleton import numbers, orientation
from dynsolve.draw.vectors import Vector, dot, subtract
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from tests.unit.draw.pictures import drawn_text, names, overlapping

TWO = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
THREE = TWO.replace("}]", "}, {theta: q3*, a: l3}]")
ENDS = (
    "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {from: 0, theta: q3*, a: l3}, {theta: q4*, a: l4}]\n"
    "points: {A: {link: 2}, B: {link: 4}}\n"
)
SPACE = "dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, a: a3}]\n"
CLOSED = [
    (TWO, "tip.x - k", WALLS, ["k"]),
    (TWO, "tip.y", WALLS, []),
    (TWO, "h - tip.x*sin(beta) + tip.y*cos(beta)", WALLS, ["h"]),
    (SPACE, "tip.x - k", WALLS, ["k"]),
    (TWO, "tip.x^2 - 2*b*tip.x + tip.y^2", CURVES, []),
    (THREE, "tip.x - b, tip.y + c", PIVOTS, ["b", "c"]),
    (ENDS, "A.x - B.x, A.y - B.y", MEETINGS, []),
    (ENDS, "A.x - B.x - b, A.y - B.y", "", ["b"]),
    (ENDS, "(A.x - B.x)^2 + (A.y - B.y)^2 - b^2", OTHERS, []),
    (TWO, "q1 - q2", OTHERS, []),
    (f"{TWO}values: {{l1: 1, l2: 1, k: 5}}\n", "tip.x - k", NOT_HELD, []),
]


@pytest.mark.parametrize(("arm", "kept", "said", "lengths"), CLOSED)
def test_what_holds_a_point_is_drawn_with_the_lengths_that_say_where(
    arm: str, kept: str, said: str, lengths: list[str]
) -> None:
    picture = drawn_text(f"{arm}masses: [{{mass: m, link: 2}}]\nconstraints: [{kept}]\n")
    known = (WALLS, CURVES, PIVOTS, MEETINGS, OTHERS, NOT_HELD)
    assert [each for each in known if each in picture.caption] == [said] * bool(said)
    of_table = {"l₁", "l₂", "l₃", "l₄", "d₁", "a₂", "a₃"}
    assert sorted(set(names(picture, "length")) - of_table) == lengths
    assert overlapping(picture) == []


def held(arm: str, kept: str) -> tuple[Pose, tuple[Length, ...]]:
    problem = read_problem(f"{arm}constraints: [{kept}]\n".encode(), "held.yaml")
    values = numbers(problem)
    world = orientation(problem.robot, values)
    pose = allowed_pose(problem.robot, values, world)
    assert pose is not None
    return pose, closings(problem.robot, values, pose, world).lengths


def test_the_lengths_lead_from_the_base_to_the_pivot() -> None:
    pose, (along_x, along_y) = held(THREE, "b - tip.x, tip.y + c")
    assert [to_unicode(each.node) for each in (along_x, along_y)] == ["b", "c"]
    assert along_x.start == (0.0, 0.0, 0.0) and along_x.end == along_y.start
    assert along_y.end == pytest.approx(pose.skeleton.frames[-1].origin, abs=1e-6)


def test_the_length_between_two_ends_leads_from_one_to_the_other() -> None:
    pose, (apart,) = held(ENDS, "A.x - B.x - b, A.y - B.y")
    ends = subtract(pose.skeleton.frames[2].origin, pose.skeleton.frames[4].origin)
    assert subtract(apart.end, apart.start) == pytest.approx(ends, abs=1e-6)
    assert apart.start == pytest.approx(pose.skeleton.frames[4].origin, abs=1e-6)


def test_the_points_of_constraints_have_their_names() -> None:
    assert names(drawn_text(f"{ENDS}constraints: [A.x - B.x, A.y - B.y]\n"), "point") == ["A", "B"]


@pytest.mark.parametrize(
    ("arm", "kept", "into"),
    [
        (TWO, "tip.x - w", (1.0, 0.0, 0.0)),
        (THREE, "tip.x - w", (1.0, 0.0, 0.0)),
        (THREE, "w - tip.x", (1.0, 0.0, 0.0)),
        (THREE, "tip.y + c", (0.0, -1.0, 0.0)),
        (THREE, "tip.y", (0.0, -1.0, 0.0)),
    ],
)
def test_an_arm_stays_on_the_free_side_of_a_wall(arm: str, kept: str, into: Vector) -> None:
    """Every joint is clear of the wall by more than the radius of a joint."""
    pose, _ = held(arm, kept)
    face = dot(pose.skeleton.frames[-1].origin, into)
    joints = [dot(part.center, into) for part in pose.parts.joints[1:]]
    assert max(joints) < face - pose.view.space(RADIUS)
