"""Uniform bodies in a picture: their forms, and their sizes where the picture knows them."""

from __future__ import annotations

import math

import pytest
from msgspec.structs import replace

from dynsolve.draw.mass_centers import DrawnBody, Form, drawn_bodies, sleeves, with_masses
from dynsolve.draw.paths import flattened
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.skeleton import numbers, orientation, skeleton
from dynsolve.draw.solids import BODY, body_solids
from dynsolve.draw.vectors import dot
from dynsolve.problem import load, read_problem
from dynsolve.problem.model import Problem
from dynsolve.robot.model import JointType
from tests.support import LIBRARY
from tests.unit.draw.pictures import drawn

TELESCOPE = next(path for path in LIBRARY if path.stem == "box-cylinder-rod-sphere")

ARM = """
dh: [{{theta: q1*, a: l1}}]
values: {{l1: 0.5, r: 0.1}}
masses: [{{mass: m1, link: 1, center: midpoint, shape: {shape}}}]
"""


def bodies(problem: Problem, q: float = 0.0) -> tuple[DrawnBody, ...]:
    robot, values = problem.robot, numbers(problem)
    return drawn_bodies(robot, values, with_masses(robot, values, skeleton(robot, values, [q] * robot.n)))


@pytest.mark.parametrize(
    ("shape", "form", "halves"),
    [
        ("{box: {x: l1, y: 0.2, z: b}}", Form.BOX, (0.5, 0.2, None)),
        ("{sphere: {radius: 0.1}}", Form.BALL, (0.2, 0.2, 0.2)),
        ("{sphere: {radius: c}}", Form.BALL, (None, None, None)),
        ("{rod: {length: l1, axis: x}}", Form.ROUND, (0.5, None, None)),
        ("{cylinder: {radius: r, length: l1, axis: x}}", Form.ROUND, (0.5, 0.2, 0.2)),
    ],
)
def test_sides_that_are_known(shape: str, form: Form, halves: tuple[float | None, ...]) -> None:
    """Half of each side over the longest length of the table; a letter without a number has no length."""
    (body,) = bodies(read_problem(ARM.format(shape=shape).encode(), "arm.yaml"))
    assert body.form is form
    assert body.halves == pytest.approx(halves)
    assert min(body.on_paper(100.0)) >= 3.0


def test_every_body_of_the_telescope_is_drawn() -> None:
    """A cylinder upright, a box and a rod along the arm, a sphere at its tip."""
    problem = load(TELESCOPE)
    found = bodies(problem, 0.6)
    assert [body.form for body in found] == [Form.ROUND, Form.BOX, Form.ROUND, Form.BALL]
    assert [body.link for body in found] == [1, 2, 3, 3]
    upright, box, rod, _ = found
    assert abs(dot(upright.axes[upright.main], (0.0, 0.0, 1.0))) == pytest.approx(1.0)
    assert abs(dot(box.axes[2], rod.axes[rod.main])) == pytest.approx(1.0)
    colours = {path.fill for path in drawn(TELESCOPE).paths}
    assert {BODY.top, BODY.side} <= colours


def test_a_slide_stands_at_the_end_of_the_body_that_it_slides_in() -> None:
    problem = load(TELESCOPE)
    (row, reach), *others = sleeves(problem.robot, numbers(problem)).items()
    box = bodies(problem)[1]
    assert (row, others) == (3, [])
    assert reach == pytest.approx(2 * (box.halves[2] or 0.0))


def test_a_guide_stands_at_the_mass_centre_of_the_body_that_it_is_part_of() -> None:
    """Craig, figure 6.7: the first mass is that of the guide, and not on the rod that slides in it."""
    problem = load(next(path for path in LIBRARY if path.stem == "rp-vertical"))
    robot, values = problem.robot, numbers(problem)
    pose = best_pose(robot, values, orientation(robot, values), None)
    guide = pose.parts.joints[1]
    assert guide.type is JointType.PRISMATIC
    assert guide.center == pytest.approx(pose.skeleton.masses[0].center, abs=0.05)


def test_point_masses_have_no_body() -> None:
    assert bodies(read_problem(ARM.format(shape="point").encode(), "arm.yaml")) == ()


def test_a_rod_in_a_thicker_body_is_hidden_there() -> None:
    """Of two bodies about one point along x, what is drawn of the thin one lies beyond the other's ends."""
    text = """
dh: [{theta: q1*, a: l1}]
values: {l1: 1}
masses:
  - {mass: m1, link: 1, center: midpoint, shape: {box: {x: 0.4, y: 0.2, z: 0.2}}}
  - {mass: m2, link: 1, center: midpoint, shape: {rod: {length: 0.8, axis: x}}}
"""
    problem = read_problem(text, "arm.yaml")
    robot, values = problem.robot, numbers(problem)
    pose = best_pose(robot, values, orientation(robot, values))
    _, *rods = body_solids(pose.bodies, replace(pose.parts, joints=()), pose.view, (0.0, 0.0, 1.0))
    assert len(rods) == 2
    size, center = pose.view.size, pose.view.point(pose.bodies[0].center)
    for rod in rods:
        ends = [math.dist(point, center) for piece in flattened(rod.paths[0].commands) for point in piece]
        assert min(ends) > 0.2 * size - 3.0 and max(ends) == pytest.approx(0.4 * size, abs=3.0)
