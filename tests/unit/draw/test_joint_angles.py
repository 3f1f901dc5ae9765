"""The arrow of every joint's angle runs from the x axis before the joint to the one after it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import pytest

from dynsolve.draw.joint_angles import joint_angles, names_of_angles, offsets, parallels
from dynsolve.draw.labels import Taken
from dynsolve.draw.lengths import TWISTS, twists
from dynsolve.draw.paths import GREY, VARIABLE, flattened
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.poses import Notes, Pose, reach_of_axis
from dynsolve.draw.scene import CORNERS, OFFSETS, RINGS, scene
from dynsolve.draw.skeleton import numbers, orientation
from dynsolve.draw.vectors import Point, Vector, add, cross, dot, scale
from dynsolve.notation.printing import Style
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import load, read_problem
from dynsolve.problem.model import Problem
from dynsolve.robot.model import JointType
from tests.support import LIBRARY
from tests.unit.draw.pictures import names

HEAD = 9.0
"""The length of the head of an axis."""

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
        ("-q1*", "q₁", 0.0),
        ("-q1* - 20deg", "q₁ + 20°", 0.0),
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
    assert offsets(pose) == pytest.approx([math.radians(degrees)] * bool(degrees))
    caption = scene(problem).caption
    assert (OFFSETS in caption, CORNERS in caption) == (bool(degrees), abs(degrees) == 90)


def test_a_negative_angle_is_drawn_the_other_way() -> None:
    """From x_0 about -z_0, and not by the rest of a turn about z_0."""
    pose, notes = shown(read_problem("dh: [{theta: -q1* - 20deg, a: l1}]", "one.yaml"))
    (leg,) = pose.skeleton.legs
    assert leg.turn == pytest.approx(-leg.angle % (2 * math.pi))
    middle = add(
        scale(leg.before, math.cos(leg.turn / 2)), scale(cross(leg.axis, leg.before), -math.sin(leg.turn / 2))
    )
    arc = next(path for path in notes.paths if path.stroke == VARIABLE)
    points = [point for part in flattened(arc.commands) for point in part]
    angles = [bearing(pose, leg.start, point) for point in points]
    wanted = bearing(pose, (0.0, 0.0, 0.0), pose.view.point(middle))
    assert min(abs(math.remainder(angle - wanted, 2 * math.pi)) for angle in angles) < 0.2


def test_a_waist_has_its_angle_about_the_origin_of_the_base() -> None:
    """The joint itself stands above that."""
    pose, _ = shown(library("elbow-3r"))
    assert pose.skeleton.legs[0].center == pose.skeleton.frames[0].origin
    assert pose.parts.joints[0].center != pose.skeleton.frames[0].origin


def test_lines_that_are_parallel_to_axes_are_said() -> None:
    """As many as are dashed, and each in the direction of the axis that is named."""
    for name, lines in (("crustcrawler-2r", 1), ("in3140-rp", 2), ("planar-2r", 0), ("five-bar", 0)):
        problem = library(name)
        pose, notes = shown(problem)
        dashed = [path for path in (*notes.paths, *notes.behind) if path.dashed and path.stroke == GREY]
        named = parallels(problem.robot, pose)
        assert len(named) == len(dashed) == lines
        for axis, path in zip(named, dashed, strict=True):
            assert axis is not None
            letter, frame = axis
            (x0, y0), (x1, y1) = (points[0] for _, points in path.commands)
            x, y = pose.view.direction(getattr(pose.skeleton.frames[frame], letter))
            assert (x1 - x0) * y == pytest.approx((y1 - y0) * x, abs=1e-6)


def test_the_head_of_an_axis_is_beyond_the_arc_that_begins_on_it() -> None:
    pose, notes = shown(library("elbow-3r"))
    leg = pose.skeleton.legs[0]
    origin = pose.view.point(leg.center)
    x, y = pose.view.direction(leg.before)
    starts = [path.commands[0][1][0] for path in notes.paths if path.stroke == VARIABLE]
    on_axis = [p for p in starts if abs((p[0] - origin[0]) * y - (p[1] - origin[1]) * x) < 1e-6]
    (start,) = (math.dist(origin, point) for point in on_axis)
    assert start < reach_of_axis((x, y), pose) * math.hypot(x, y) - HEAD


# -- the angles of a table that no joint turns -------------------------------------------------------


@pytest.mark.parametrize(
    ("arm", "angles"),
    [
        ("dh: [{theta: q1*, d: d1, alpha: 45deg}, {theta: q2*, a: a2}]", ["45°"]),
        ("dh: [{theta: q1*, d: d1, alpha: -45deg}, {theta: q2*, a: a2}]", ["45°"]),
        ("dh: [{theta: q1*, d: d1, alpha: -gamma}, {theta: q2*, a: a2}]", ["γ"]),
        ("dh: [{theta: 20deg, d: q1*, alpha: 90deg}, {theta: q2*, a: a2}]", ["20°"]),
        ("convention: modified\ndh: [{theta: q1*}, {theta: q2*, a: a1, alpha: 30deg}]", ["30°"]),
        ("dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2* + 45deg, a: a2, alpha: 180deg}]", []),
    ],
)
def test_an_angle_of_the_table_that_no_joint_turns_is_marked(arm: str, angles: list[str]) -> None:
    picture = scene(read_problem(f"{arm}\n".encode(), "twisted.yaml"))
    shown_angles = [to_unicode(label.node) for label in picture.labels if label.kind == "angle"]
    assert [name for name in shown_angles if name != "45°" or angles] == angles
    assert (TWISTS in picture.caption) is bool(angles)


def test_without_frames_only_what_is_between_joint_axes_is_marked() -> None:
    rows = "{theta: 20deg, d: q1*, alpha: 45deg}, {theta: q2*, a: a2}"
    problem = read_problem(f"dh: [{rows}]\n".encode(), "twisted.yaml")
    found = [scene(problem, frames=frames).labels for frames in (True, False)]
    angles = [[to_unicode(x.node) for x in labels if x.kind == "angle"] for labels in found]
    assert angles == [["45°", "20°"], ["45°"]]


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_a_twist_leads_from_one_z_axis_to_the_next(convention: str) -> None:
    rows = "{theta: q1*, d: d1, a: a1, alpha: -50deg}, {theta: q2*, a: a2, alpha: 30deg}"
    problem = read_problem(f"convention: {convention}\ndh: [{rows}]\n".encode(), "twisted.yaml")
    pose, _ = shown(problem)
    for row, (at, first, side, size, _) in enumerate(twists(problem.robot, pose), 1):
        turned = add(scale(first, math.cos(size)), scale(side, math.sin(size)))
        frames = pose.skeleton.frames
        assert at == frames[row].origin and first == frames[row - 1].z
        assert turned == pytest.approx(frames[row].z)
        assert math.degrees(size) == pytest.approx((-50.0, 30.0)[row - 1])


def test_an_angle_that_is_zero_as_it_is_drawn_is_shown_by_its_sense() -> None:
    """Half a turn or more about the joint, in the plane and with its axis; the caption says what it is."""
    text = (
        "gravity: [0, 0, -g]\naxes:\n  - {turn: a, about: [0, -1, 0], through: [0, 0, 0]}\n"
        "  - {turn: b, about: [0, 1, 0], through: [L*cos(30deg), 0, L*sin(30deg)]}\n"
        "tip: [L*cos(30deg) + M, 0, L*sin(30deg)]\nzero: drawn\nfind: [DH]\n"
    )
    problem = read_problem(text.encode(), "drawn.yaml")
    picture = scene(problem)
    red = [path for path in picture.paths if path.stroke == VARIABLE and path.width == 1.4]
    turns = []
    for path in red:
        pieces = list(flattened(path.commands))
        steps = [math.atan2(a[1] - b[1], b[0] - a[0]) for a, b in pieces]
        turns.append(sum(math.remainder(b - a, 2 * math.pi) for a, b in pairwise(steps)))
    assert [turn > 0 for turn in turns] == [True, False]
    assert min(map(abs, turns)) > math.pi / 2 and RINGS in picture.caption


@pytest.mark.parametrize(("tip", "name"), [("[1, 0, 0.5]", "-q₂"), ("[1, 0, 1.5]", "q₂")])
def test_a_negative_angle_is_drawn_in_its_own_sense(tip: str, name: str) -> None:
    """Of a drawing, whose pose is given: from x₁ to x₂."""
    turns = (
        "{turn: q1, about: [0, 0, 1], through: [0, 0, 0]}, {turn: q2, about: [0, -1, 0], through: [0, 0, 1]}"
    )
    problem = read_problem(f"axes: [{turns}]\ntip: {tip}\nzero: table\n".encode(), "elbow.yaml")
    assert name in names(scene(problem, star=False), "variable")
