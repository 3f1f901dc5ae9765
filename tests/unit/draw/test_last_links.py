"""The last link of a modified table, which no origin ends (Craig, Introduction to Robotics, section 3.4)."""

from __future__ import annotations

import pytest

from dynsolve.draw.mass_centers import with_masses
from dynsolve.draw.pose_search import last_links
from dynsolve.draw.scene import OFF_LINKS
from dynsolve.draw.skeleton import numbers, skeleton
from dynsolve.draw.vectors import Vector, distance
from dynsolve.problem import read_problem
from tests.unit.draw.pictures import drawn_text

ARM = """
convention: {convention}
dh:
  - {{theta: q1*, d: d1}}
  - {{theta: q2*, alpha: 90deg}}
  {tool}
masses:
  - {{mass: m1, link: 1, center: origin, shape: point}}
  - {{mass: m2, link: 2, {body}}}
"""
BODY = "center: [c, 0, 0], inertia: {xx: Ixx, yy: Iyy, zz: Izz}"
BEYOND = 0.2


def text_of(body: str = BODY, convention: str = "modified", tool: str = "") -> str:
    return ARM.format(body=body, convention=convention, tool=tool)


def link_and_mass(text: str) -> tuple[tuple[tuple[Vector, Vector], ...], Vector, Vector]:
    """What is drawn as last links, where that of the arm begins, and its mass centre."""
    problem = read_problem(text.encode(), "arm.yaml")
    values = numbers(problem)
    pose = with_masses(problem.robot, values, skeleton(problem.robot, values, [0.4, 1.1]))
    return last_links(problem.robot, pose, BEYOND), pose.frames[2].origin, pose.masses[1].center


@pytest.mark.parametrize(
    ("body", "beyond"),
    [
        (BODY, BEYOND),
        ("center: [0, 0, c], inertia: {xx: Ixx}", BEYOND),
        ("center: [c, 0, 0], shape: point", 0.0),
        ("center: [c, 0, 0], shape: {sphere: {radius: r}}", 0.0),
    ],
)
def test_the_last_link_leads_past_its_mass_centre(body: str, beyond: float) -> None:
    """A point mass ends it, and a body with a shape is drawn itself."""
    ((start, end),), origin, center = link_and_mass(text_of(body))
    assert start == origin
    assert distance(center, end) == pytest.approx(beyond)
    assert distance(start, end) == pytest.approx(distance(start, center) + beyond)


@pytest.mark.parametrize(
    "text",
    [
        text_of(tool="- {a: l2}"),
        text_of(convention="standard"),
        text_of("center: origin, shape: point"),
        text_of("center: [b, c, 0], shape: point"),
    ],
    ids=["a row for the tool", "standard", "at the origin", "off all axes"],
)
def test_what_the_table_draws_or_does_not_know_has_no_such_link(text: str) -> None:
    assert link_and_mass(text)[0] == ()


def test_a_mass_centre_on_the_last_link_has_no_dashed_line() -> None:
    assert OFF_LINKS not in drawn_text(text_of()).caption
    assert OFF_LINKS in drawn_text(text_of("center: [b, c, 0], shape: point")).caption
