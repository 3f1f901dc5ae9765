"""What a file asks of the kinematics: what becomes of it, and every fault with its place and remedy."""

from __future__ import annotations

import pytest

from dynsolve.notation.tree import Reference
from dynsolve.problem import read_problem
from tests.unit.problem.marked import PLANAR, errors, places, unmarked

ELBOW = """
dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}]
"""


def asked(text: str, table: str = PLANAR):
    return read_problem(table + text).robot.questions


def test_a_file_without_questions_asks_nothing() -> None:
    found = asked("find: [Jv]")
    assert (found.points, found.task, found.asked) == ((), None, frozenset())


def test_points_are_given_as_centres_are() -> None:
    robot = read_problem(PLANAR + "points: {P: {link: 2, at: {near: [lc2, 0, 0]}}, E: {link: 1}}").robot
    ring, (first, second) = robot.ring, robot.questions.points
    assert (first.name, first.link) == ("P", 2)
    assert first.position.entries == (ring.symbol("lc2") - ring.symbol("l2"), ring.zero, ring.zero)
    assert (second.name, second.link, second.position.is_zero) == ("E", 1, True)


@pytest.mark.parametrize(
    ("base", "written", "axes"),
    [
        ("", "link: 2", None),
        ("", "link: 2, in: link", 2),
        ("", "link: 2, in: 1", 1),
        ("", "link: 2, in: 0", None),
        ("base: Rx(90deg)\n", "link: 2, in: 0", 0),
    ],
)
def test_the_axes_of_a_velocity_are_those_of_a_frame_or_the_world(
    base: str, written: str, axes: int | None
) -> None:
    (point,) = asked(f"points: {{P: {{{written}}}}}", base + PLANAR).points
    assert point.axes == axes


@pytest.mark.parametrize(
    ("table", "text", "entries"),
    [
        (PLANAR, "find: [Jr]", "xy"),
        (ELBOW, "find: [Jr]", "xyz"),
        ("convention: modified\ndh: [{theta: q1*}, {theta: q2*, a: l1}, {a: l2}]\n", "find: [r]", "xy"),
        ("base: Rx(90deg)\n" + PLANAR, "marks: {r: 2}", "xz"),
        ("dh: [{d: d1*}]\n", "find: [Jr_dot]", "z"),
        (PLANAR, "find: [tau]", None),
    ],
)
def test_the_task_is_by_default_what_moves_of_the_tip(table: str, text: str, entries: str | None) -> None:
    task = asked(text, table).task
    wanted = entries and tuple(Reference("tip", "xyz".index(axis) + 1, 1) for axis in entries)
    assert (task and task.entries) == wanted


def test_a_task_may_hold_coordinates_of_points_and_of_joints() -> None:
    task = asked("points: {P: {link: 1}}\ntask: [P.x - tip.y, theta1 + 2*theta2, sin(theta1)]").task
    assert task is not None and task.rows == 3 and not task.is_default
    assert Reference("P", 1, 1) in task.entries[0].terms


def test_a_twist_has_six_rates() -> None:
    task = asked("task: twist").task
    assert task is not None and (task.rows, task.entries) == (6, ())


def test_only_what_is_asked_for_is_kept_in_mind() -> None:
    assert asked("find: [tau, Jr, J_dot]\nmarks: {r: 1}").asked == {"Jr", "J_dot", "r"}
    assert asked("points: {P: {link: 2}}\nfind: [pP, vP]").asked == {"pP", "vP"}


FAULTS = {
    "points as a list": ("points: «[P]»", "a mapping from names", "points: {P:"),
    "a bad name": ("points: {«tip»: {link: 1}}", "cannot be the name of a point", "a letter, and digits"),
    "a body's name": (
        "masses: [{mass: m, name: p, link: 1}]\npoints: {«p»: {link: 1}}", "the name of a body", "another"
    ),
    "no link": ("points: {P: «{at: tip}»}", "no `link`", "link: 1"),
    "link 0": ("points: {P: {link: «0»}}", "the ground", "from 1 to 2"),
    "no such link": ("points: {P: {link: «3»}}", "there is no link 3", "from 1 to 2"),
    "a coordinate": ("points: {P: {link: 1, at: [«theta1», 0, 0]}}", "contains the coordinate", "table"),
    "axes of no frame": ("points: {P: {link: 1, in: «3»}}", "there is no frame 3", "in: link"),
    "axes that are no frame": ("points: {P: {link: 1, in: «world»}}", "is a whole number", "in: link"),
    "a place": ("points: {P: {link: 1, at: «end»}}", "tip, origin, midpoint", "{near:"),
    "names beside numbers": ("reach: [«px», 1]\nfind: [inverse]", "names px", "name all"),
    "no number": ("reach: [«l1», 1]\nfind: [inverse]", "l1 has no number", "under `values`"),
    "no number in a formula": (
        "values: {l1: 1}\nreach: [l1 + «l2», 1]\nfind: [inverse]", "l2 has no number", "under `values`"
    ),
    "too few values": ("reach: «[1]»\nfind: [inverse]", "reach has 1 value; the task has 2", "one value for"),
    "a bare angle": ("task: [theta1 + theta2]\nreach: [«1.2»]\nfind: [inverse]", "stands as an angle", "deg"),
    "an angle for a length": ("reach: [«30deg», 1]\nfind: [inverse]", "a length, not an angle", "a number"),
    "a coordinate to reach": ("reach: [1, 2*«theta1»]", "contains the coordinate", "numbers and parameters"),
    "one argument": ("task: [theta1]\nreach: [«atan2»(1)]\nfind: [inverse]", "two arguments", "atan2(y, x)"),
    "no numbers to reach": ("reach: [px, py]\nstate: «reach»\nfind: [inverse]", "the numbers", "reach:"),
    "a weight of no coordinate": ("weights: {«theta3»: 2}", "no coordinate", "theta"),
    "a weight that moves": ("weights: {theta1: «theta2»}", "contains the coordinate", "parameters"),
    "too few weights": ("weights: «[[1]]»", "is 2×2", "weights: {"),
    "weights that are not symmetric": ("weights: «[[1, 2], [0, 1]]»", "not symmetric", "positive"),
    "weights that are not positive": ("weights: «[[1, 2], [2, 1]]»", "not positive definite", "positive"),
    "nothing to linearize at": ("linearize: «{}»", "linearize has no coordinate", "linearize: {"),
    "weights by inertia without masses": ("weights: «D»", "no body has mass", "weights: {"),
    "weights as a number": ("weights: «2»", "a mapping or a matrix", "weights: {"),
    "limits of no coordinate": ("limits: {«theta3»: [0, 1]}", "no coordinate", "theta"),
    "one end": ("limits: {theta1: «[0]»}", "1 ends, not 2", "limits: {"),
    "no range": ("limits: {theta1: «90deg»}", "a list [low, high]", "limits: {"),
    "a bare angle as a limit": ("limits: {theta1: [0, «90»]}", "stands as an angle", "90deg"),
    "limits that cross": (
        "reach: [1, 1]\nlimits: {theta1: «[90deg, 0]»}\nfind: [inverse]", "ends before", "lower"
    ),
    "no rotation": (
        "task: pose\nreach: «[1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1]»\nfind: [inverse]",
        "these rows are no rotation", "row by row",
    ),
    "a rotation in few digits": (
        "task: pose\nreach: «[1, 0, 0, 0.866, -0.5, 0, 0.5, 0.866, 0, 0, 0, 1]»\nfind: [inverse]",
        "by 4.4e-05", "sqrt(3)/2",
    ),
    "few values of a pose": (
        "task: pose\nreach: «[px, py, pz]»\nfind: [inverse]", "the task has 12", "one value for"
    ),
    "an unknown point": ("task: [«R».x]", "there is no point R", "tip"),
    "a misspelled tip": ("task: [«tp».x]", "there is no point tp", "did you mean `tip`?"),
    "an empty task": ("task: «[]»", "no components", "task: [tip.x"),
    "a denominator": ("task: [«1/tip.x»]", "stands in a denominator", "sums, products"),
    "a root": ("task: [«sqrt(tip.x^2 + tip.y^2)»]", "under a root", "sums, products"),
    "a root of a coordinate": ("task: [«sqrt(theta1)»]", "under a root", "sums, products"),
    "steady as a list": ("steady: «[theta1]»", "a mapping from coordinates to their", "steady: {q1: W}"),
    "a rate of no coordinate": ("steady: {«theta3»: W}", "no coordinate and no rate", "theta"),
    "a rate that moves": ("steady: {theta1: «theta2»}", "contains the coordinate", "parameters"),
    "an acceleration": ("steady: «{theta1'': 1}»", "an acceleration is 0", "steady: {q1: W}"),
    "rates of all": ("steady: «{theta1: W, theta2: W}»", "no coordinate is left", "steady: {q1: W}"),
    "no r of a twist": ("task: twist\nfind: [«r»]", "`r` is no answer of this problem", ""),
}  # fmt: skip


@pytest.mark.parametrize(("marked", "message", "help"), FAULTS.values(), ids=FAULTS)
def test_faults(marked: str, message: str, help: str) -> None:
    text, wanted = unmarked(PLANAR + marked)
    found = errors(text)
    assert places(found) == wanted
    assert message in found[0].message and help in found[0].help


FORCES = {
    "forces as a mapping": ("forces: «{link: 1}»", "must be a list", "a force is written"),
    "no force": ("forces:\n  - «{link: 1}»", "neither a `force` nor a `moment`", "a force is written"),
    "no link": ("forces:\n  - «{force: [F, 0, 0]}»", "no `link`", "link: 1"),
    "two components": ("forces:\n  - {link: 1, force: «[F, 0]»}", "2 components", "[x, y, z]"),
    "who": ("forces:\n  - {link: 1, force: [F, 0, 0], by: «me»}", "one of world, robot", "write one of"),
    "axes": ("forces:\n  - {link: 1, force: [F, 0, 0], in: «tool»}", "no rotation", "Rz(90deg)"),
    "state as a list": ("state: «[q1]»", "a mapping from coordinates", "state: {q1: 90deg"),
    "no coordinate": ("state: {«q3»: 0}", "no coordinate and no rate", "state: {q1"),
    "a bare number": ("state: {theta1: «90»}", "bare number 90", "did you mean 90deg?"),
    "a coordinate in a value": ("state: {theta1: «theta2»}", "contains the coordinate", "numbers and param"),
    "a velocity of another length": ("velocity: «[vx]»", "the task has 2 components", "one for each"),
    "a velocity as a number": ("velocity: «3»", "a list of expressions", "velocity: [vx, vy]"),
    "rates without a velocity": (
        "find: [«qd»]",
        "`qd` is found from `velocity`, which is not given",
        "[vx, vy]",
    ),
    "twice": ("state: {theta1': 1, «theta1_dot»: 2}", "has a value already", "keep one"),
}


@pytest.mark.parametrize(("marked", "message", "help"), FORCES.values(), ids=FORCES)
def test_faults_of_forces_and_of_the_state(marked: str, message: str, help: str) -> None:
    text, wanted = unmarked(PLANAR + marked)
    found = errors(text)
    assert places(found) == wanted
    assert message in found[0].message and help in found[0].help


def test_the_state_knows_rates_by_primes_and_by_dots() -> None:
    state = asked("state: {theta1: 90deg, theta1': 1, theta2_ddot: w}").state
    assert list(state.by_symbol) == [("theta1", 0), ("theta1", 1), ("theta2", 2)]
