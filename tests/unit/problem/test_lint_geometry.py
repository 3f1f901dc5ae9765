"""What lint finds by the geometry of the robot, against numbers: turning matrices, places, drawn angles."""

from __future__ import annotations

from math import cos, radians, sin
from random import Random

import pytest

from dynsolve.algebra.matrix import determinant
from dynsolve.derivation.rules import derive
from dynsolve.problem.lint import lint_text
from dynsolve.problem.reader import read_problem

Rows = list[list[float]]


def codes(text: str, line: int = 0) -> list[str]:
    return [found.code for found in lint_text(text) if not line or found.line == line]


def product(a: Rows, b: Rows) -> Rows:
    return [
        [sum(x * y for x, y in zip(row, column, strict=True)) for column in zip(*b, strict=True)] for row in a
    ]


def turned(axis: str, degrees: float) -> Rows:
    c, s = cos(radians(degrees)), sin(radians(degrees))
    return {
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }[axis]


# -- which axes a body turns about -----------------------------------------------------------------

Joint = tuple[str, int, int]
"""The column of the variable, and constant θ and α in degrees."""


def orientation(joints: list[Joint], modified: bool, q: list[float], axes: Rows) -> Rows:
    found = [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]]
    for (column, theta, alpha), angle in zip(joints, q, strict=True):
        about_z = turned("z", theta + (angle if column == "theta" else 0))
        pair = [turned("x", alpha), about_z] if modified else [about_z, turned("x", alpha)]
        for rotation in pair:
            found = product(found, rotation)
    return product(found, axes)


def turns_about(joints: list[Joint], modified: bool, axes: Rows) -> set[str]:
    """The axes of the body that its angular velocity ever has a component along: Rᵀ dR/dq_k is skew."""
    random, found = Random(7), set()
    for _ in range(3):
        q = [random.uniform(-170, 170) for _ in joints]
        R = orientation(joints, modified, q, axes)
        for k in range(len(joints)):
            moved = orientation(joints, modified, [x + 1e-3 * (i == k) for i, x in enumerate(q)], axes)
            spin = product([list(column) for column in zip(*R, strict=True)], moved)
            parts = {"x": spin[2][1] - spin[1][2], "y": spin[0][2] - spin[2][0], "z": spin[1][0] - spin[0][1]}
            found |= {axis for axis, part in parts.items() if abs(part) > 1e-7}
    return found


@pytest.mark.parametrize("seed", range(24))
def test_a_moment_is_missed_where_the_body_turns_about_its_axis(seed: int) -> None:
    random = Random(seed)
    modified = random.random() < 0.4
    joints = [
        (
            random.choice(["theta", "theta", "d"]),
            random.choice([0, 30, 90]),
            random.choice([0, 0, 0, 90, -90, 45]),
        )
        for _ in range(random.randint(1, 3))
    ]
    if all(column == "d" for column, _, _ in joints):
        joints[0] = ("theta", *joints[0][1:])
    rows = [
        f"{{theta: {f'q{k}* + ' if column == 'theta' else ''}{theta}deg, alpha: {alpha}deg"
        + (f", d: q{k}*}}" if column == "d" else ", a: 1}")
        for k, (column, theta, alpha) in enumerate(joints, 1)
    ]
    axes, name = random.choice(
        [([("x", 0)], ""), ([("x", 90)], "Rx(90deg)"), ([("z", 30), ("x", 90)], "Rz(30deg) Rx(90deg)")]
    )
    own = [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]]
    for axis, angle in axes:
        own = product(own, turned(axis, angle))
    given = random.choice(["{zz: I}", "{xx: I}", "{yy: I, zz: J}", "{yy: I, zz: I}", "{xx: I, yy: I}"])
    text = (
        f"convention: {'modified' if modified else 'standard'}\ndh: [{', '.join(rows)}]\n"
        f"masses: [{{mass: m, link: {len(rows)}, center: origin, inertia: {given}"
        + (f", axes: {name}" if name else "")
        + "}]\n"
    )
    has = {"xx", "yy", "zz"} & set(given.replace("{", " ").replace(":", " ").split())
    missing = {"x", "y", "z"} - {axis[0] for axis in has}
    if given in ("{yy: I, zz: I}", "{xx: I, yy: I}"):
        missing = set()  # a thin rod along the third axis has them
    expected = bool(missing & turns_about(joints, modified, own))
    assert ("left-out-moment" in codes(text)) == expected


def test_a_zero_that_is_written_is_meant() -> None:
    text = "dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]\n"
    body = "masses: [{mass: m, link: 2, center: tip, inertia: {xx: 0, yy: 0, zz: I}}]"
    assert codes(text + body) == []


def test_turns_that_carry_each_other() -> None:
    """The pendulum of Furuta: xx and yy of a thin rod are enough; zz alone is not."""
    model = (
        "model:\n  coordinates: {a: revolute, b: revolute}\n  bodies:\n    - {mass: m, at: [0, 0, 0], "
        "turn: [{by: a, about: [0, 0, 1]}, {by: b, about: [1, 0, 0]}], inertia: INERTIA}"
    )
    assert codes(model.replace("INERTIA", "{yy: I, zz: I}")) == []
    assert codes(model.replace("INERTIA", "{zz: I}")) == ["left-out-moment"]


# -- rods beside their links -----------------------------------------------------------------------


@pytest.mark.parametrize("modified", [False, True])
@pytest.mark.parametrize("axis", "xyz")
@pytest.mark.parametrize(
    "row", ["a: l", "d: h", "d: h, a: l", "a: l, alpha: 90deg", "d: h, a: l, alpha: 90deg"]
)
def test_a_rod_lies_from_joint_to_joint_or_across(row: str, axis: str, modified: bool) -> None:
    rows = ["theta: q1*", "theta: 0, " + row] if modified else ["theta: q1*, " + row]
    text = (
        f"convention: {'modified' if modified else 'standard'}\n"
        f"dh: [{', '.join(f'{{{one}}}' for one in rows)}]\n"
        f"masses: [{{mass: m, link: 1, center: midpoint, shape: {{rod: {{length: l, axis: {axis}}}}}}}]"
    )
    (body,) = read_problem(text).robot.bodies
    along = {name for name, entry in zip("xyz", body.center.entries, strict=True) if not entry.is_zero}
    assert ("beside-its-link" in codes(text)) == (len(along) > 1 and axis in along)


def test_axes_turned_into_the_link_hold_the_rod() -> None:
    text = (
        "dh: [{theta: q1*, d: l, a: l}]\n"
        "masses: [{mass: m, link: 1, center: midpoint, axes: Ry(-45deg), "
        "shape: {rod: {length: sqrt(2)*l, axis: x}}}]"
    )
    assert codes(text) == []


# -- angles as drawn -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("degrees", "offset"), [(0, False), (90, True), (30, True), (-90, True), (180, True)]
)
@pytest.mark.parametrize("zero", ["", "zero: table\n", "zero: drawn\n"])
def test_angles_that_are_not_zero_as_drawn(degrees: int, offset: bool, zero: str) -> None:
    """A planar arm whose second link is drawn at an angle to the first."""
    tip = f"[l + a*cos({degrees}deg), a*sin({degrees}deg), 0]"
    text = (
        "axes:\n  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}\n"
        f"  - {{turn: q2, about: [0, 0, 1], through: [l, 0, 0]}}\ntip: {tip}\n{zero}"
    )
    assert codes(text) == (["drawn-angles"] if offset and "drawn" not in zero else [])


# -- coordinates without inertia, against D itself ---------------------------------------------------

MASS_3 = "masses: [{mass: m, name: 3, link: 3, center: [b, 0, 0], inertia: {xx: A, yy: B, zz: C}}]"
IDLE = [
    ("[{theta: q1*, d: h}, {theta: q2*, a: l, alpha: 90deg}, {d: q3*}]", MASS_3, ["q1", "q2"]),
    ("[{theta: q1*, a: l}, {theta: q2*, a: l, alpha: 90deg}, {d: q3*}]", MASS_3, []),
    ("[{theta: q1*, alpha: 90deg}, {theta: q2*, alpha: 90deg}, {d: q3*}]", MASS_3, []),
    ("[{theta: 90deg, alpha: 90deg}, {d: x*, alpha: -90deg}, {theta: q1* + q2*, a: u}]", MASS_3,
     ["q1", "q2"]),
    ("[{d: x*, a: l}, {d: y*, alpha: 90deg}, {d: z*}]", MASS_3, ["x", "y"]),
    ("[{theta: q1*, d: h}, {theta: q2*, a: l, alpha: 90deg}, {d: q3*}]",
     MASS_3.replace("}]", "}, {mass: n, name: 1, link: 1, center: origin, inertia: {zz: J}}]"), []),
    ("[{theta: q1*, a: l}, {theta: q2*, alpha: 90deg}, {theta: q3*}, {theta: q4*}]", MASS_3, ["q4"]),
]  # fmt: skip


@pytest.mark.parametrize(("rows", "masses", "idle"), IDLE)
def test_coordinates_that_move_nothing_or_only_together(rows: str, masses: str, idle: list[str]) -> None:
    text = f"gravity: none\ndh: {rows}\n{masses}\n"
    found = [one.message for one in lint_text(text) if one.code == "moves-no-mass"]
    whose = (
        "nothing that has mass moves with {}"
        if len(idle) == 1
        else "what has mass moves with {} only together"
    )
    assert found == ([f"{whose.format(' and '.join(idle))}: D is singular"] if idle else [])
    assert determinant(derive(read_problem(text).robot)["D"]).is_zero is bool(idle)
