"""The arrow of every joint's angle runs from the x axis before the joint to the one after it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest

from dynsolve.draw.annotate import Notes
from dynsolve.draw.drawn_lengths import numbers
from dynsolve.draw.joint_angles import has_parallels, joint_angles
from dynsolve.draw.occupied import Taken
from dynsolve.draw.orientation import orientation
from dynsolve.draw.paths import GREY, VARIABLE, flattened
from dynsolve.draw.pose import Pose
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.vectors import Point, Vector
from dynsolve.notation.printing import Style
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
    joint_angles(pose, [joint.written[0] for joint in problem.robot.joints], notes)
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
    """An offset in the table is in the angle that is drawn, as it is in its name."""
    pose, notes = shown(problem)
    found = list(arcs(notes))
    for part in pose.parts.joints:
        if part.type is not JointType.REVOLUTE:
            continue
        leg = pose.skeleton.legs[part.row - 1]
        wanted = [bearing(pose, (0.0, 0.0, 0.0), pose.view.point(x)) for x in (leg.before, leg.after)]
        assert any(
            [bearing(pose, part.center, point) for point in ends] == pytest.approx(wanted, abs=0.02)
            for ends in found
        ), part.row


def test_lines_that_are_parallel_to_axes_are_said() -> None:
    pose, notes = shown(library("spherical-rrp"))
    dashed = [path for path in (*notes.paths, *notes.behind) if path.dashed and path.stroke == GREY]
    assert has_parallels(pose) and dashed
    flat, none = shown(library("planar-2r"))
    assert not has_parallels(flat) and not [path for path in none.paths if path.dashed]
