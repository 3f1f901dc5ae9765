"""Linkages that are drawn closed, though a table has them open."""

from __future__ import annotations

import pytest

from dynsolve.draw.pose_search import closing_links
from dynsolve.draw.scene import allowed_pose, scene
from dynsolve.draw.skeleton import generic_numbers, numbers, orientation, skeleton
from dynsolve.draw.vectors import subtract
from dynsolve.problem import load, read_problem
from dynsolve.robot.model import Robot
from tests.support import LIBRARY

FIVE_BAR = """
dh:
  - {{theta: q1*, a: l1}}
  - {{from: 0, theta: q2*, a: l2}}
  - {{from: 2, theta: {third}, a: {length}}}
  - {{from: 1, theta: q2* - q1*, a: l4}}
"""


def closed(robot: Robot) -> list[tuple[int, int]]:
    pose = skeleton(robot, generic_numbers(robot), [0.4, 1.3, 0.2, 0.9][: robot.n])
    origins = {pose.frames[k].origin: k for k in range(len(pose.frames))}
    return [(origins[start], origins[end]) for start, end in closing_links(robot, pose)]


def test_the_parallelogram_is_closed_where_links_3_and_4_meet() -> None:
    """Spong, Hutchinson, Vidyasagar (2006), section 7.4: link 4 joins the ends of links 1 and 3."""
    robot = load(next(path for path in LIBRARY if path.stem == "five-bar")).robot
    assert closed(robot) == [(1, 3)]


@pytest.mark.parametrize(
    ("third", "length", "loops"),
    [("q1* - q2*", "l1", [(1, 3)]), ("q1* - q2*", "l3", []), ("q1* + q2*", "l1", []), ("q3*", "l1", [])],
)
def test_what_only_looks_closed_in_one_pose_is_open(third: str, length: str, loops: list[object]) -> None:
    """Another length, or another angle, and the ends come apart."""
    assert closed(read_problem(FIVE_BAR.format(third=third, length=length), "bars.yaml").robot) == loops


@pytest.mark.parametrize("name", ["planar-2r", "scara-rrpr"])
def test_a_chain_has_no_loop(name: str) -> None:
    assert closed(load(next(path for path in LIBRARY if path.stem == name)).robot) == []


ARMS = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {from: 0, theta: q3*, a: l3}, {theta: q4*, a: l4}]"
ENDS = "points: {A: {link: 2, at: [0, 0, 0]}, B: {link: 4, at: [0, 0, 0]}}"


@pytest.mark.parametrize(("apart", "gap"), [("", 0.0), (" - l0", 1.0)])
def test_constraints_hold_in_the_picture(apart: str, gap: float) -> None:
    """Two ends of a tree that its constraints keep together, or level and a length apart, are drawn so."""
    text = f"{ARMS}\n{ENDS}\nconstraints: [A.x - B.x{apart}, A.y - B.y]"
    problem = read_problem(f"{text}\nmasses: [{{mass: m, link: 1, center: tip}}]".encode(), "loop.yaml")
    values = numbers(problem)
    pose = allowed_pose(problem.robot, values, orientation(problem.robot, values))
    assert pose is not None
    ends = subtract(pose.skeleton.frames[2].origin, pose.skeleton.frames[4].origin)
    assert ends == pytest.approx((gap, 0.0, 0.0), abs=1e-6)
    assert scene(problem).paths


def test_without_constraints_every_pose_is_allowed() -> None:
    problem = read_problem(f"{ARMS}\n".encode(), "tree.yaml")
    values = numbers(problem)
    assert allowed_pose(problem.robot, values, orientation(problem.robot, values)) is None
