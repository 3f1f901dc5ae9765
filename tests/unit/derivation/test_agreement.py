"""Different ways to one quantity agree, exactly."""

from __future__ import annotations

from hypothesis import given, settings

from dynsolve.derivation.euler_lagrange import agreement, given_axes_agree
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import course_rules, derive
from dynsolve.problem import read_problem
from tests.robots import robots


@settings(max_examples=25)
@given(robots(max_joints=3))
def test_the_courses_energies_are_those_of_the_link_frames(text: str) -> None:
    robot = read_problem(text).robot
    course, fast = Derivation(course_rules(robot)), derive(robot)
    for body in robot.bodies:
        assert course[f"Kv{body.name}"] == fast[f"Kv{body.name}"]
        if given_axes_agree(robot, body, fast):
            assert course[f"Kw{body.name}"] == fast[f"Kw{body.name}"]


@settings(max_examples=25)
@given(robots(max_joints=3))
def test_reading_off_and_assembling_agree(text: str) -> None:
    robot = read_problem(text).robot
    assert agreement(robot, derive(robot)).holds


def test_a_value_put_in_stands_for_its_rule() -> None:
    robot = read_problem(
        "title: t\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\ngravity: [0, -g, 0]\n"
    ).robot
    ring = robot.ring
    slip = Derivation(derive(robot).rules.values(), {"P1": ring.symbol("m") * ring.symbol("g")})
    assert slip["P"] == ring.symbol("m") * ring.symbol("g")
    assert slip["g"].is_zero
    assert slip["D"] == derive(robot)["D"]
