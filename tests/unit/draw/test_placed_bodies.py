"""Pictures of bodies that are given by their positions, and of springs."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path
from random import Random

import pytest

from dynsolve.draw import draw, is_drawn, placed_bodies
from dynsolve.draw.placed_bodies import (
    BALLS,
    BOXES,
    DISKS,
    RODS,
    ROLLING,
    SPRINGS,
    placed_scene,
)
from dynsolve.draw.placed_pose import Kind, Piece, Place, placed_pose, ways
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.poses import (
    DAMPERS,
    MOTORS,
    OTHER_DAMPERS,
    OTHER_MOTORS,
    OTHER_SPRINGS,
    drawn_motors,
    joint_springs,
)
from dynsolve.draw.poses import SPRINGS as SPRINGS_AT_JOINTS
from dynsolve.draw.scene import IN_SI, scene
from dynsolve.draw.skeleton import finite, numbers, orientation
from dynsolve.draw.vectors import NEAR, cross, distance, dot, point_to_segment, scale
from dynsolve.errors import UsageError
from dynsolve.notation.tree import Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import load, read_problem
from dynsolve.problem.model import Problem
from tests.support import ALL_PROBLEMS, LIBRARY
from tests.unit.draw.pictures import drawn, drawn_text, names, overlapping, struck_through

# -- pictures of bodies that are given by their positions --------------------------------------------


TESTS = Path(__file__).parents[2]
PLACED = [
    *(path for path in ALL_PROBLEMS if "\n  bodies:" in path.read_text(encoding="utf-8")),
    TESTS / "golden" / "models" / "acrobot.yaml",
    TESTS / "golden" / "models" / "disk-down-a-slope.yaml",
    TESTS / "golden" / "models" / "sapienza-2022-09-pulley.yaml",
    TESTS / "golden" / "constraints" / "sapienza-2017-07-pp-line.yaml",
    TESTS / "golden" / "asked" / "goldstein-2-18-hoop.yaml",
    TESTS / "golden" / "asked" / "sapienza-2016-10-three-masses.yaml",
    TESTS / "strangers" / "cases" / "stability-beside-a-length.yaml",
]

LINKS = "at: [0.5*cos(a) + 0.3*cos(a + b), 0.5*sin(a) + 0.3*sin(a + b), 0]"
SPACE = "at: [r*cos(a) - l*sin(b)*sin(a), r*sin(a) + l*sin(b)*cos(a), l*cos(b)]"
ELLIPSE = "at: [l*cos(a), r*sin(a), b*0]"
HUNG = "at: [l + r*sin(a), r*cos(a)/2 + r*cos(a)/2, b]"
CURVE = "at: [b*cos(a), b*sin(a), b^2/r]"


def bodies(*written: str) -> Problem:
    listed = "".join(f"\n    - {{mass: m{i}, {text}}}" for i, text in enumerate(written, 1))
    types = "{a: revolute, b: prismatic}" if {HUNG, CURVE} & set(written) else "{a: revolute, b: revolute}"
    return read_problem(f"model:\n  coordinates: {types}\n  bodies:{listed}".encode(), "bodies.yaml")


@pytest.mark.parametrize("path", PLACED, ids=lambda path: path.stem)
def test_labels_keep_apart_and_each_body_is_named_once(path: Path) -> None:
    problem = load(path)
    picture = placed_scene(problem, star=False)
    assert overlapping(picture) == [] and struck_through(picture) == []
    frame = picture.frame
    for label in picture.labels:
        assert frame.left <= label.box.left and label.box.right <= frame.right
        assert frame.top <= label.box.top and label.box.bottom <= frame.bottom
    assert len(names(picture, "mass")) == len(problem.robot.bodies)
    shown = names(picture)
    assert all(to_unicode(Symbol(q.name)) in shown for q in problem.robot.coordinates)


@pytest.mark.parametrize("written", [LINKS, SPACE, ELLIPSE, HUNG, CURVE])
def test_the_pieces_lead_to_the_body_and_a_rod_keeps_its_length(written: str) -> None:
    """Held to numbers at random states."""
    robot = bodies(written).robot
    (way,) = ways(robot)
    random = Random(7)
    parameters = {name: random.uniform(0.5, 2.0) for name in robot.ring.parameters}
    sizes: dict[Piece, set[float]] = {}
    for _ in range(4):
        values = parameters | {q.name: random.uniform(-2, 2) for q in robot.coordinates}

        def at(place: Place, values: dict[str, float] = values) -> tuple[float, float, float]:
            x, y, z = (finite(entry, values) for entry in place)
            return x, y, z

        x, y, z = robot.bodies[0].center.entries
        assert way[-1].end == (x, y, z) and all(a.end == b.start for a, b in pairwise(way))
        assert distance(at(way[0].start), (0.0, 0.0, 0.0)) < NEAR
        for piece in way:
            size = distance(at(piece.start), at(piece.end))
            sizes.setdefault(piece, set()).add(round(size, 9))
            if piece.length is not None:
                assert size == pytest.approx(abs(finite(piece.length, values)))
    for piece, found in sizes.items():
        assert (len(found) == 1) == (piece.kind in (Kind.ROD, Kind.FIXED))


@pytest.mark.parametrize(
    ("written", "kinds"),
    [
        (LINKS, [Kind.ROD, Kind.ROD]),
        (SPACE, [Kind.ROD, Kind.ROD]),
        (ELLIPSE, [Kind.OTHER, Kind.OTHER]),
        (HUNG, [Kind.FIXED, Kind.SLIDE, Kind.ROD]),
        (CURVE, [Kind.SLIDE, Kind.SLIDE]),
    ],
)
def test_what_is_a_rod(written: str, kinds: list[Kind]) -> None:
    problem = bodies(written)
    assert [piece.kind for piece in ways(problem.robot)[0]] == kinds
    assert (RODS in placed_scene(problem).caption) == (Kind.ROD in kinds)


def test_the_way_to_a_body_leads_by_another_that_lies_on_it() -> None:
    """Whatever the order of the coordinates and of the terms."""
    robot = bodies("at: [r*cos(b), r*sin(b), 0]", "at: [l*cos(a) + r*cos(b), l*sin(a) + r*sin(b), 0]").robot
    first, second = ways(robot)
    assert second[: len(first)] == first


BOOM = (
    "model:\n  coordinates: {q1: revolute, d2: prismatic, q3: revolute}\n  bodies:\n"
    "    - {mass: m1, at: [(d2 - e)*cos(q1), (d2 - e)*sin(q1), 0]}\n"
    "    - {mass: m2, at: [d2*cos(q1) + l*sin(q3), d2*sin(q1) - l*cos(q3), 0]}\n"
)


def test_pieces_follow_each_other_as_their_coordinates_do_and_a_difference_leads_back() -> None:
    """The load hangs from the end of the boom d2, from which e leads back to the sleeve."""
    problem = read_problem(BOOM.encode(), "boom.yaml")
    d, e, rod = map(problem.robot.ring.symbol, ("d2", "e", "l"))
    sleeve, hung = ways(problem.robot)
    assert [piece.length for piece in sleeve] == [d, e]
    assert [piece.length for piece in hung] == [d, rod]
    assert sleeve[0] == hung[0]
    pose = placed_pose(problem)
    assert 0.0 < pose.values["e"] < pose.values["d2"]


def test_a_ball_is_a_point_mass_and_a_box_turns_or_slides() -> None:
    assert BALLS in placed_scene(bodies(SPACE)).caption
    turned = placed_scene(bodies(f"{SPACE}, turn: a, inertia: {{zz: I}}"))
    assert BOXES in turned.caption and BALLS not in turned.caption


def test_an_angle_is_drawn_from_where_it_is_0() -> None:
    """On paper, of the pendulum of a cart: from the upright, to the right."""
    picture = placed_scene(load(next(path for path in ALL_PROBLEMS if path.stem == "cart-pole")))
    (zero,) = (path for path in picture.paths if path.dashed)
    (_, (a,)), (_, (b,)) = zero.commands
    assert math.isclose(a[0], b[0]) and b[1] < a[1]


def test_energies_have_no_picture() -> None:
    problem = load(next(path for path in ALL_PROBLEMS if path.stem == "ball-and-beam"))
    assert not is_drawn(problem.robot)
    with pytest.raises(UsageError, match="say where anything is"):
        draw(problem)


NOT_DRAWN = placed_bodies.OTHER_SPRINGS, placed_bodies.OTHER_DAMPERS

CART = """
model:
  coordinates: {x: prismatic, y: prismatic, a: revolute}
  bodies:
    - {mass: M, at: [x, 0, 0]}
    - {mass: m, at: [y + r, 0, 0]}
    - {mass: mp, at: [x + l*sin(a), -l*cos(a), 0]}
"""


@pytest.mark.parametrize(
    ("acts", "drawn", "said"),
    [
        ("springs: [{stiffness: k, of: x}]", ["k"], SPRINGS),
        ("springs: [{stiffness: 2*k, of: a}]", ["2k"], SPRINGS),
        ("dampers: [{damping: b, of: x}]", ["b"], DAMPERS),
        ("springs: [{stiffness: k, of: x - y}]", [], NOT_DRAWN[0]),  # the bodies are y + r - x apart
        ("springs: [{stiffness: k, of: x + a*l}]", [], NOT_DRAWN[0]),
        ("springs: [{energy: k*sin(a)^2}]", [], NOT_DRAWN[0]),
        ("dampers: [{damping: b, of: a}]", ["b"], DAMPERS),
        ("dampers: [{damping: b, of: x - y}]", [], NOT_DRAWN[1]),
    ],
)
def test_springs_and_dampers_are_where_they_act(acts: str, drawn: list[str], said: str) -> None:
    """Between two points whose distance they act on, or at an angle; of the others it is said."""
    picture = placed_scene(read_problem(f"{CART}{acts}".encode(), "cart.yaml"), star=False)
    assert [*names(picture, "spring"), *names(picture, "damper")] == drawn
    assert [each for each in (SPRINGS, DAMPERS, *NOT_DRAWN) if each in picture.caption] == [said]
    assert overlapping(picture) == []


def test_a_disk_touches_its_line_where_it_is_at_rest() -> None:
    """Of a disk of radius r above the axis x it is that axis, whatever r is."""
    text = "model:\n  coordinates: {x: prismatic}\n  bodies:\n    - {mass: m, at: [x, r, 0], turn: -x/r}"
    problem = read_problem(f"{text}\ngravity: [0, -g, 0]".encode(), "disk.yaml")
    (body,) = problem.robot.bodies
    pose = placed_pose(problem)
    rolls = pose.rolls(body)
    assert rolls is not None and {DISKS, ROLLING} <= said_of_disks(problem)
    to_rest = scale(cross(*rolls), 1.0 / dot(rolls[0], rolls[0]))
    assert to_rest == pytest.approx((0.0, -pose.values["r"], 0.0))


@pytest.mark.parametrize(
    ("second", "wide", "lengths"),
    [
        ("[X + s*cos(alpha), -s*sin(alpha), 0], turn: -s/R", None, ["R", "X⋆", "s⋆"]),
        ("[X - s*cos(30deg), -s*sin(30deg), 0]", 12.0, ["X⋆", "s⋆"]),
    ],
)
def test_a_wedge_reaches_up_to_what_moves_on_it(second: str, wide: float | None, lengths: list[str]) -> None:
    """Its slope touches the disk or the block, and one of its edges is that along which it slides."""
    text = (
        "gravity: [0, -g, 0]\nmodel:\n  coordinates: {X: prismatic, s: prismatic}\n  bodies:\n"
        f"    - {{mass: M, at: [X, 0, 0]}}\n    - {{mass: m, at: {second}}}\n"
    )
    problem = read_problem(text.encode(), "wedge.yaml")
    pose, picture = placed_pose(problem), placed_scene(problem)
    (wedge,) = placed_bodies.wedges(pose)
    upper, lower, corner = wedge.corners
    radius = wide or pose.values["R"] * pose.view.size
    center = pose.point(wedge.carried.center.entries)
    assert point_to_segment(center, upper, lower) == pytest.approx(radius)
    assert center[1] < upper[1] + (lower[1] - upper[1]) * (center[0] - upper[0]) / (lower[0] - upper[0])
    assert corner == pytest.approx((upper[0], lower[1]))
    assert upper[0] == pytest.approx(pose.point(wedge.carrier.center.entries)[0])
    assert sorted(names(picture, "length")) == lengths and names(picture, "mass") == ["M", "m"]
    assert placed_bodies.WEDGES in picture.caption and overlapping(picture) == []


@pytest.mark.parametrize("second", ["[X, -s, 0]", "[X + s, 0, 0]", "[X + l*sin(s), -l*cos(s), 0]"])
def test_what_moves_across_or_along_or_turns_needs_no_wedge(second: str) -> None:
    kind = "revolute" if "sin" in second else "prismatic"
    bodies = f"{{mass: M, at: [X, 0, 0]}}, {{mass: m, at: {second}}}"
    text = f"model: {{coordinates: {{X: prismatic, s: {kind}}}, bodies: [{bodies}]}}\ngravity: [0, -g, 0]"
    assert not list(placed_bodies.wedges(placed_pose(read_problem(text.encode(), "cart.yaml"))))


def said_of_disks(problem: Problem) -> set[str]:
    return {each for each in (DISKS, ROLLING) if each in placed_scene(problem).caption}


@pytest.mark.parametrize(
    ("coordinates", "at", "turn", "rolls"),
    [
        ("x: prismatic, y: prismatic", "[x, y, 0]", "y/R", True),  # on a rope that x moves
        ("x: prismatic, s: prismatic", "[x + s*cos(alpha), -s*sin(alpha), 0]", "-s/R", True),  # a wedge
        (
            "q: revolute, s: prismatic",
            "[s*cos(q) - R*sin(q), s*sin(q) + R*cos(q), 0]",
            "q - s/R",
            True,
        ),  # beam
        ("q: revolute, s: prismatic", "[s*cos(q) - R*sin(q), s*sin(q) + R*cos(q), 0]", "-s/R", False),
        ("q: revolute, s: prismatic", "[l*sin(q), -l*cos(q), 0]", "q - s/R", False),  # a pulley
        ("x: prismatic, q: revolute", "[x + l*sin(q), -l*cos(q), 0]", "q - x/R", False),  # no floor there
        ("x: prismatic, q: revolute", "[x + l*sin(q), -l*cos(q), 0]", "-x/R", False),
        ("x: prismatic, z: prismatic", "[x, R, z]", "-x/R", False),  # it slides along its axis
        ("x: prismatic", "[x, 0, x]", "[{by: x/R, about: [1, 0, 0]}]", False),  # a screw
        ("theta: revolute", "[r*theta, r, 0]", "-theta", True),
        ("theta: revolute", "[2*r*theta, r, 0]", "-theta", True),
    ],
)
def test_a_disk_touches_a_line_on_which_it_does_not_slide(
    coordinates: str, at: str, turn: str, rolls: bool
) -> None:
    """The line may move; where the disk slides on any, none is drawn and none is told."""
    text = f"model:\n  coordinates: {{{coordinates}}}\n  bodies:\n    - {{mass: m, at: {at}, turn: {turn}}}"
    problem = read_problem(f"{text}\ngravity: [0, -g, 0]".encode(), "disk.yaml")
    assert said_of_disks(problem) == ({DISKS, ROLLING} if rolls else {DISKS})


def test_a_pose_keeps_the_constraints() -> None:
    path = TESTS / "golden" / "constraints" / "sapienza-2017-07-pp-line.yaml"
    values = placed_pose(load(path)).values
    q1, q2, alpha, k0 = (values[name] for name in ("q1", "q2", "alpha", "k0"))
    assert -q1 * math.cos(alpha) + q2 * math.sin(alpha) + k0 == pytest.approx(0.0, abs=1e-5)


# -- springs at the joints that they act on ----------------------------------------------------------


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
    assert SPRINGS_AT_JOINTS in picture.caption and overlapping(picture) == []


def test_an_elastic_joint_has_a_spring_between_its_motor_and_its_link() -> None:
    """Its deflection is q₁ - q₂, of which only q₁ is an angle of the table."""
    picture = drawn(next(path for path in LIBRARY if path.stem == "elastic-joint"))
    assert names(picture, "spring") == ["k"]


@pytest.mark.parametrize(
    ("motors", "rows", "letters"),
    [
        ("motors: [{turns: m*, inertia: J}]\nsprings: [{stiffness: k, of: q2 - m}]", [2], ["m⋆"]),
        ("motors: [{turns: m*, inertia: J, carrier: 2}]\nsprings: [{stiffness: k, of: q3 - m}]", [3], ["m⋆"]),
        ("motors: [{turns: m*, inertia: J}]", [1], ["m⋆"]),
        ("motors: [{turns: q2, inertia: J}]", [], []),
        ("motors: [{turns: q2, inertia: J, carrier: 1, ratio: n}]", [2], ["J"]),
        ("motors: [{turns: q3, inertia: 0.01, carrier: 2, ratio: 50}]", [3], []),
    ],
)
def test_a_motor_stands_at_its_joint(motors: str, rows: list[int], letters: list[str]) -> None:
    problem = read_problem(f"{ROWS}{motors}", "motor.yaml")
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    assert [part.row for part, _ in drawn_motors(problem.robot, values, pose)] == rows
    picture = scene(problem)
    assert [name for name in names(picture, "variable") if name == "m⋆"] + names(picture, "motor") == letters
    assert (MOTORS in picture.caption, OTHER_MOTORS in picture.caption) == (bool(rows), not rows)
    assert overlapping(picture) == []


def test_without_springs_nothing_is_said_of_them() -> None:
    assert SPRINGS_AT_JOINTS not in drawn(next(path for path in LIBRARY if path.stem == "planar-2r")).caption


@pytest.mark.parametrize(
    ("acts", "said"),
    [
        ("springs: [{stiffness: k, of: q2}]", [SPRINGS_AT_JOINTS]),
        ("springs: [{stiffness: k, of: q1 - q2}]", [OTHER_SPRINGS]),
        ("springs: [{energy: k*sin(q1)^2}]", [OTHER_SPRINGS]),
        ("dampers: [{damping: b, of: q1 - q2}]", [OTHER_DAMPERS]),
        ("dampers: [{damping: b, of: q2}]", [DAMPERS]),
        ("dampers: [{damping: b, of: q3}]", [DAMPERS]),
    ],
)
def test_what_is_not_drawn_is_said(acts: str, said: list[str]) -> None:
    caption = drawn_text(f"{ROWS}{acts}").caption
    assert [
        each for each in (SPRINGS_AT_JOINTS, OTHER_SPRINGS, DAMPERS, OTHER_DAMPERS) if each in caption
    ] == said


@pytest.mark.parametrize("spring", ["", "springs: [{stiffness: k, of: q2}]"])
def test_a_damper_of_an_angle_stands_round_its_joint_clear_of_all_else(spring: str) -> None:
    rows = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nmasses: [{mass: m, link: 2, center: tip}]\n"
    picture = drawn_text(f"{rows}dampers: [{{damping: b, of: q2}}]\n{spring}")
    assert names(picture, "damper") == ["b"]
    assert overlapping(picture) == [] and struck_through(picture) == []


def test_what_unit_the_number_at_a_damper_has_is_said() -> None:
    assert IN_SI in drawn_text(f"{ROWS}dampers: [{{damping: 0.1, of: q2}}]").caption
    assert IN_SI not in drawn_text(f"{ROWS}dampers: [{{damping: b, of: q2}}]").caption


def test_a_spring_along_the_variable_of_a_joint_is_drawn_there() -> None:
    rows = "dh: [{theta: p1*, a: l1}, {theta: p2* - p1*, a: l2}]\nmasses: [{mass: m, link: 2, center: tip}]\n"
    picture = drawn_text(f"{rows}springs: [{{stiffness: k, of: p2 - p1}}, {{stiffness: c, of: p2}}]")
    assert names(picture, "spring") == ["k"]
    assert OTHER_SPRINGS in picture.caption


def test_branches_share_the_length_that_they_begin_with() -> None:
    rows = "dh: [{theta: q1*}, {theta: q2*, a: l1}, {from: 1, theta: q3*, a: l1}]"
    assert names(drawn_text(f"convention: modified\n{rows}\n"), "length") == ["l₁"]


def test_a_length_on_the_other_side_has_its_terms_without_their_sign() -> None:
    rows = "dh: [{theta: q1*, alpha: 90deg}, {d: w* + b}, {from: 1, d: -w* - b}, {from: 1, d: b - 3*w*}]"
    lengths = [name for name in names(drawn_text(rows), "variable") if "w" in name]
    assert sorted(lengths) == ["3w⋆ - b", "w⋆ + b", "w⋆ + b"]


PLANE = "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]"
ROLLS = (
    "model:\n  coordinates: {s: prismatic}\n"
    "  bodies: [{mass: m, at: [s, r, 0], turn: -s/r, inertia: {zz: J}}]"
)


@pytest.mark.parametrize(
    ("pull", "rest", "angle"),
    [
        ("[g*sin(beta), -g*cos(beta), 0]", PLANE, ["β"]),
        ("[g*sin(beta), -g*cos(beta), 0]", ROLLS, ["β"]),
        ("[0, -g*sin(beta), -g*cos(beta)]", PLANE, ["β"]),
        ("[0, -g, 0]", PLANE, []),
        ("[ga, -gb, 0]", PLANE, []),
    ],
)
def test_the_angle_of_gravity_is_drawn(pull: str, rest: str, angle: list[str]) -> None:
    problem = read_problem(f"gravity: {pull}\n{rest}\n".encode(), "problem.yaml")
    assert names(placed_scene(problem) if rest is ROLLS else scene(problem), "angle") == angle
