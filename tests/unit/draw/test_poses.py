"""The pose in which an arm is drawn, and the world around it."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from dynsolve.draw.drawn_points import as_drawn
from dynsolve.draw.labels import Taken
from dynsolve.draw.lengths import WORLD, has_world, moves, world_frame
from dynsolve.draw.mass_centers import with_masses
from dynsolve.draw.paths import BLACK, flattened
from dynsolve.draw.pose_search import best_pose, closing_links, last_links
from dynsolve.draw.poses import Notes, Pose
from dynsolve.draw.scene import OFF_LINKS, allowed_pose, scene
from dynsolve.draw.skeleton import generic_numbers, numbers, orientation, skeleton
from dynsolve.draw.vectors import NEAR, ORIGIN, Vector, cross, distance, dot, facing, length, subtract
from dynsolve.notation.printing import Style
from dynsolve.problem import load, read_problem
from dynsolve.robot.model import Robot
from tests.support import LIBRARY
from tests.unit.draw.pictures import drawn_text, names, overlapping, struck_through
from tests.unit.problem.test_drawing import FOUR_JOINTS, OFFSET_ARM, RPR, RRRP

# -- an arm from a drawing is shown in the pose of the drawing, wherever its joints are counted from -


AXES = {  # the directions of the joint axes in the files
    OFFSET_ARM: [(0, 0, 1), (0, 1, 0), (1, 0, 0)],
    FOUR_JOINTS: [(0, 0, 1), (0, 0, 1), (1, 0, 0), (0, 1, 0)],
    RRRP: [(0, 0, 1), (0, -1, 0), (0, -1, 0), (0, 0, -1)],
    RPR: [(0, 0, 1), (0, -1, 0), (1, 0, 0)],
}


@pytest.mark.parametrize("zero", ["drawn", "table"])
@pytest.mark.parametrize(("text", "axes"), AXES.items())
def test_the_axes_point_as_they_are_drawn(text: str, axes: list[tuple[int, int, int]], zero: str) -> None:
    problem = read_problem(f"{text}zero: {zero}\n", "drawn.yaml")
    known = numbers(problem)
    q = as_drawn(problem, known)
    assert q is not None
    frames = skeleton(problem.robot, known, q).frames
    assert [round(dot(frame.z, axis), 9) for frame, axis in zip(frames, axes, strict=False)] == [1] * len(
        axes
    )


def test_a_table_has_no_such_pose() -> None:
    problem = read_problem("dh: [{theta: q1*, a: l1}]\n", "own.yaml")
    assert as_drawn(problem, numbers(problem)) is None


PLANES = {  # the axis of both joints, two directions in its plane, and which of them leads to the right
    (0, 0, 1): ("[1, 0, 0]", "[1, 1, 0]", 0),
    (0, 1, 0): ("[1, 0, 0]", "[1, 0, 1]", 0),
    (1, 0, 0): ("[0, 1, 0]", "[0, 1, 1]", 1),
}


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("axis", PLANES)
def test_a_drawing_in_a_plane_is_not_mirrored(axis: tuple[int, int, int], sign: int) -> None:
    """Whichever way its joints turn, and so whichever way z of frame 0 points."""
    elbow, tip, right = PLANES[axis]
    about = [sign * entry for entry in axis]
    turns = (f"{{turn: q{i}, about: {about}, through: {at}}}" for i, at in ((1, "[0, 0, 0]"), (2, elbow)))
    problem = read_problem(f"axes: [{', '.join(turns)}]\ntip: {tip}\n", "plane.yaml")
    known = numbers(problem)
    world = orientation(problem.robot, known, drawn=True)
    assert world.normal is not None
    view = facing(world.normal, world.up)
    assert view.right[right] == pytest.approx(1.0) and max(view.up) == pytest.approx(1.0)
    pose = best_pose(problem.robot, known, world, as_drawn(problem, known))
    first, last = (
        pose.view.point(frame.origin) for frame in (pose.skeleton.frames[0], pose.skeleton.frames[-1])
    )
    assert scene(problem).paths and last[0] > first[0] and last[1] < first[1]


# -- The last link of a modified table, which no origin ends (Craig, Introduction to Robotics, section 3.4)


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


# -- linkages that are drawn closed, though a table has them open ------------------------------------


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


SLIDER_CRANK = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: r}, {theta: q2*, a: l}, {from: 0, theta: 90deg, alpha: 90deg}, {d: x*}]
points: {P: {link: 2, at: tip}, S: {link: 4, at: tip}}
masses: [{mass: m, link: 1, center: tip}]
constraints: [P.x - S.x, P.y - S.y]
"""


def test_a_closed_chain_is_drawn_open_though_its_lengths_allow_a_folded_pose() -> None:
    problem = read_problem(SLIDER_CRANK.encode(), "slider-crank.yaml")
    values = numbers(problem)
    pose = allowed_pose(problem.robot, values, orientation(problem.robot, values))
    assert pose is not None
    base, pin, slider = (pose.skeleton.frames[k].origin for k in (0, 1, 4))
    assert slider[0] > 0.4
    assert abs(pin[1]) > 0.4
    assert distance(base, slider) > 0.4


def test_without_constraints_every_pose_is_allowed() -> None:
    problem = read_problem(f"{ARMS}\n".encode(), "tree.yaml")
    values = numbers(problem)
    assert allowed_pose(problem.robot, values, orientation(problem.robot, values)) is None


# -- the world around a base that is moved in it, or leans -------------------------------------------


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


# -- what stands at an angle in space is seen to do so ------------------------------------------------

THREE_SLIDES = "dh: [{d: d1*, alpha: 90deg}, {d: d2*, alpha: 45deg, theta: 90deg}, {d: d3*}]"
CARRIAGE = (
    "convention: modified\ndh: [{alpha: 90deg, d: x*}, {theta: q2*, a: l1}, {theta: q3*, a: l2}, {a: l3}]"
)
GATE = "base: Rx(60deg)\ndh: [{theta: q1*, a: w}, {theta: q2*, alpha: 90deg}, {theta: q3*, a: l}]"


@pytest.mark.parametrize(("text", "least"), [(THREE_SLIDES, 35), (CARRIAGE, 35), (GATE, 23)])
def test_axes_at_an_angle_do_not_look_parallel(text: str, least: float) -> None:
    """The first slide does not seem to run upwards, nor an axis that leans by 60° by 8°."""
    problem = read_problem(text.encode(), "own.yaml")
    known = numbers(problem)
    world = orientation(problem.robot, known)
    pose = best_pose(problem.robot, known, world)
    axes = [world.up, *(frame.z for frame in pose.skeleton.frames)]
    for a, b in pairwise(axes):
        if length(cross(a, b)) > NEAR:
            (x, y), (u, v) = (pose.view.direction(each) for each in (a, b))
            assert math.degrees(math.atan2(abs(x * v - y * u), abs(x * u + y * v))) > least
