"""The arrow of every joint's angle runs from the x axis before the joint to the one after it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest

from dynsolve.draw.annotate import Notes
from dynsolve.draw.drawn_lengths import numbers
from dynsolve.draw.joint_angles import has_offsets, has_parallels, joint_angles, names_of_angles
from dynsolve.draw.occupied import Taken
from dynsolve.draw.orientation import orientation
from dynsolve.draw.paths import GREY, VARIABLE, flattened
from dynsolve.draw.pose import Pose
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.vectors import Point, Vector, cross, dot
from dynsolve.notation.printing import Style
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import load, read_problem
from dynsolve.problem.model import Problem
from dynsolve.robot.model import JointType
from tests.support import LIBRARY

OFFSET = b"dh: [{theta: q1* + 90deg, a: l1}, {theta: q2* - 30deg, a: l2}]"
TURNED_DOWN = b"base: Rx(180deg)\ndh: [{theta: q1*, a: l1}, {theta: q2* + 90deg, a: l2}]"


def shown(problem: Problem) -> tuple[Pose, Notes]:
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    notes = Notes(Style(decimal=True), Taken())
    joint_angles(pose, names_of_angles(problem.robot), notes)
    return pose, notes


def library(name: str) -> Problem:
    return load(next(path for path in LIBRARY if path.stem == name))


def arcs(notes: Notes) -> Iterator[tuple[Point, Point]]:
    """Where each arrow starts, and its tip; its arc may be in pieces, those behind the joint apart."""
    drawn = [path for path in (*notes.paths, *notes.behind) if VARIABLE in (path.stroke, path.fill)]
    heads = [next(flattened(path.commands))[0] for path in drawn if path.fill == VARIABLE]
    starts = [next(flattened(path.commands))[0] for path in drawn if not path.fill]
    for tip in heads:
        yield from ((start, tip) for start in starts)


def bearing(pose: Pose, center: Vector, point: Point) -> float:
    x, y = pose.view.point(center)
    return math.atan2(point[1] - y, point[0] - x)


@pytest.mark.parametrize(
    "problem",
    [
        read_problem(OFFSET, "offset.yaml"),
        read_problem(TURNED_DOWN, "turned.yaml"),
        library("planar-2r"),
        library("five-bar"),
        library("box-cylinder-rod-sphere"),
        library("spherical-rrp"),
        library("elbow-3r"),
    ],
    ids=lambda problem: problem.title or "offset",
)
def test_each_arrow_runs_from_axis_to_axis(problem: Problem) -> None:
    """About the origin on the joint's axis, but for the degrees that the table adds to a coordinate."""
    pose, notes = shown(problem)
    found = list(arcs(notes))
    for part in pose.parts.joints:
        if part.type is not JointType.REVOLUTE:
            continue
        leg = pose.skeleton.legs[part.row - 1]
        wanted = [bearing(pose, (0.0, 0.0, 0.0), pose.view.point(x)) for x in (leg.before, leg.turned)]
        center = problem.robot.joints[part.row - 1].parent
        about = pose.skeleton.frames[center].origin
        assert any(
            all(
                abs(math.remainder(bearing(pose, about, point) - angle, 2 * math.pi)) < 0.02
                for point, angle in zip(ends, wanted, strict=True)
            )
            for ends in found
        ), part.row


@pytest.mark.parametrize(
    ("column", "name", "degrees"),
    [
        ("q1* + 90deg", "q₁", 90.0),
        ("q1* - 45deg", "q₁", -45.0),
        ("q1* + 270deg", "q₁", -90.0),
        ("q1*", "q₁", 0.0),
        ("90deg - q1*", "90° - q₁", 0.0),
        ("q1* + beta", "q₁ + β", 0.0),
    ],
)
def test_degrees_beside_a_coordinate_are_drawn_apart(column: str, name: str, degrees: float) -> None:
    problem = read_problem(f"dh: [{{theta: {column}, a: l1}}]", "one.yaml")
    pose, notes = shown(problem)
    (leg,) = pose.skeleton.legs
    assert math.degrees(leg.offset) == pytest.approx(degrees)
    assert dot(leg.turned, leg.after) == pytest.approx(math.cos(leg.offset))
    assert dot(cross(leg.turned, leg.after), leg.axis) == pytest.approx(math.sin(leg.offset))
    assert [to_unicode(label.node, notes.style) for label in notes.wanted if label.kind == "variable"] == [
        name
    ]
    assert has_offsets(pose) is bool(degrees)


def test_a_waist_has_its_angle_about_the_origin_of_the_base() -> None:
    """The joint itself stands above that."""
    pose, _ = shown(library("elbow-3r"))
    assert pose.skeleton.legs[0].center == pose.skeleton.frames[0].origin
    assert pose.parts.joints[0].center != pose.skeleton.frames[0].origin


def test_lines_that_are_parallel_to_axes_are_said() -> None:
    pose, notes = shown(library("spherical-rrp"))
    dashed = [path for path in (*notes.paths, *notes.behind) if path.dashed and path.stroke == GREY]
    assert has_parallels(pose) and dashed
    for name in ("planar-2r", "five-bar"):
        flat, none = shown(library(name))
        assert not has_parallels(flat) and not [path for path in none.paths if path.dashed]
