"""Springs at the joints that they act on."""

from __future__ import annotations

import pytest

from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.poses import NO_DAMPERS, OTHER_SPRINGS, SPRINGS, joint_springs
from dynsolve.draw.skeleton import numbers, orientation
from dynsolve.problem import read_problem
from tests.support import LIBRARY
from tests.unit.draw.pictures import drawn, drawn_text, names, overlapping

ROWS = """
dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: l2, alpha: 90deg}, {d: q3*}]
masses: [{mass: m3, link: 3, center: tip}]
"""


@pytest.mark.parametrize(
    ("of", "rows"),
    [("q2", [2]), ("2*q3", [3]), ("-q1", [1]), ("q1 - q2", []), ("q2 + q3", [])],
)
def test_a_spring_is_at_the_one_joint_that_it_acts_on(of: str, rows: list[int]) -> None:
    """None is drawn that couples two joints: it is at neither of them."""
    problem = read_problem(f"{ROWS}springs: [{{stiffness: k, of: {of}}}]", "spring.yaml")
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    assert [part.row for part, _ in joint_springs(problem.robot, values, pose)] == rows


def test_each_spring_has_its_stiffness() -> None:
    picture = drawn_text(f"{ROWS}springs: [{{stiffness: k2, of: q2}}, {{stiffness: 2*k3, of: q3, rest: L}}]")
    assert names(picture, "spring") == ["k₂", "2k₃"]
    assert SPRINGS in picture.caption and overlapping(picture) == []


def test_an_elastic_joint_has_a_spring_between_its_motor_and_its_link() -> None:
    """Its deflection is q₁ - q₂, of which only q₁ is an angle of the table."""
    picture = drawn(next(path for path in LIBRARY if path.stem == "elastic-joint"))
    assert names(picture, "spring") == ["k"]


def test_without_springs_nothing_is_said_of_them() -> None:
    assert SPRINGS not in drawn(next(path for path in LIBRARY if path.stem == "planar-2r")).caption


@pytest.mark.parametrize(
    ("acts", "said"),
    [
        ("springs: [{stiffness: k, of: q2}]", [SPRINGS]),
        ("springs: [{stiffness: k, of: q1 - q2}]", [OTHER_SPRINGS]),
        ("springs: [{energy: k*sin(q1)^2}]", [OTHER_SPRINGS]),
        ("dampers: [{damping: b, of: q1 - q2}]", [NO_DAMPERS]),
    ],
)
def test_what_is_not_drawn_is_said(acts: str, said: list[str]) -> None:
    caption = drawn_text(f"{ROWS}{acts}").caption
    assert [each for each in (SPRINGS, OTHER_SPRINGS, NO_DAMPERS) if each in caption] == said


def test_branches_share_the_length_that_they_begin_with() -> None:
    rows = "dh: [{theta: q1*}, {theta: q2*, a: l1}, {from: 1, theta: q3*, a: l1}]"
    assert names(drawn_text(f"convention: modified\n{rows}\n"), "length") == ["l₁"]
