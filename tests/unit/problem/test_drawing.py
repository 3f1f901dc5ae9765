"""Joint axes from a drawing: the tables that are found, and every fault where it stands.

The tables of the exams are one admissible choice each; with these files the procedure comes to the
same one, save where a comment says otherwise.
"""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

import dynsolve
from dynsolve.notation.printing import Style
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import Problem, read_problem
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import assert_close, numbers, solve_json
from tests.unit.problem.marked import errors, places, unmarked

STARRED = Style(star=True)

# INF3480 (University of Oslo), exam 2013, exercise 2a
PAINTING_ARM = """
axes:
  - {turn: theta1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: theta2, about: [0, -1, 0], through: [L2/sqrt(2), 0, L1 + L2/sqrt(2)]}
  - {slide: L3, along: [cos(45deg), 0, sin(45deg)]}
tip: [(L2 + L3)/sqrt(2), 0, L1 + (L2 + L3)/sqrt(2)]
"""
# Sapienza Robotics 1, exam 12 July 2021, exercise 1a
RRRP = """
axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: q2, about: [0, -1, 0], through: [B, 0, A]}
  - {turn: q3, about: [0, -1, 0], through: [B + C, 0, A]}
  - {slide: q4, along: [0, 0, -1], through: [B + C + D, 0, A]}
tip: {at: [B + C + D, 0, A - q4], z: [0, 0, -1]}
"""
# Sapienza Robotics 1, exam 21 October 2022, exercise 1a
RPR = """
axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {slide: q2, along: [0, -1, 0], through: [0, 0, d1]}
  - {turn: q3, about: [1, 0, 0], through: [0, -q2, d1]}
tip: [0, -q2, d1 + a3]
"""
# INF3480 (University of Oslo), exam 2018, task 2a; there the last row has θ = 90°, for another x of the hand
OFFSET_ARM = """
axes:
  - {turn: theta1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: theta2, about: [0, 1, 0], through: [0, Loff, L1]}
  - {slide: L3, along: [1, 0, 0], through: [0, Loff, L1 + L2]}
tip: [L3, Loff, L1 + L2]
"""
# INF3480 (University of Oslo), exam 2009, exercise 2; there l1 stands in row 1: axes 1 and 2 are one line
FOUR_JOINTS = """
axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {slide: q2, along: [0, 0, 1]}
  - {turn: q3, about: [1, 0, 0], through: [0, 0, l1 + l2]}
  - {turn: q4, about: [0, 1, 0], through: [loff, 0, l1 + l2]}
tip: [loff, l3 + l4, l1 + l2]
"""
PLANAR = """
axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: q2, about: [0, 0, 1], through: [l1, 0, 0]}
tip: [l1 + l2, 0, 0]
"""


def table(text: str) -> list[str]:
    """The rows of a file's table, a text each: θ d a α."""
    return [
        " ".join(to_unicode(cell, STARRED).replace(" ", "") for cell in joint.written)
        for joint in read(text).robot.joints
    ]


def read(text: str) -> Problem:
    return read_problem(text, "drawn.yaml")


TABLES = [
    (PAINTING_ARM, "drawn", ["θ₁⋆ √2L₂/2+L₁ √2L₂/2 90°", "θ₂⋆-45° 0 0 -90°", "0 L₃⋆ 0 0"]),
    (PAINTING_ARM, "table", ["θ₁⋆ √2L₂/2+L₁ √2L₂/2 90°", "θ₂⋆ 0 0 -90°", "0 L₃⋆ 0 0"]),
    (RRRP, "drawn", ["q₁⋆ A B 90°", "q₂⋆ 0 C 0", "q₃⋆ 0 D 90°", "0 q₄⋆ 0 0"]),
    (RPR, "drawn", ["q₁⋆ d₁ 0 90°", "90° q₂⋆ 0 90°", "q₃⋆ 0 a₃ 0"]),
    (OFFSET_ARM, "drawn", ["θ₁⋆ L₁ 0 -90°", "θ₂⋆-90° Loff L₂ -90°", "0 L₃⋆ 0 0"]),
    (FOUR_JOINTS, "drawn", ["q₁⋆ 0 0 0", "90° q₂⋆+l₁+l₂ 0 90°", "q₃⋆+90° loff 0 90°", "q₄⋆ l₃+l₄ 0 0"]),
    (FOUR_JOINTS, "table", ["q₁⋆ 0 0 0", "90° q₂⋆ 0 90°", "q₃⋆ loff 0 90°", "q₄⋆ l₃+l₄ 0 0"]),
]


@pytest.mark.parametrize(("text", "zero", "rows"), TABLES)
def test_the_table_is_that_of_the_exercise(text: str, zero: str, rows: list[str]) -> None:
    assert table(f"{text}zero: {zero}") == rows


MODIFIED = [
    # α and a are those of the row before, and the hand takes a fixed row where it is off the last axis
    (PLANAR, ["q₁⋆ 0 0 0", "q₂⋆ 0 l₁ 0", "0 0 l₂ 0"]),
    (RRRP, ["q₁⋆ A 0 0", "q₂⋆ 0 B 90°", "q₃⋆ 0 C 0", "0 q₄⋆ D 90°"]),
    (RPR, ["q₁⋆ d₁ 0 0", "90° q₂⋆ 0 90°", "q₃⋆ 0 0 90°", "0 0 a₃ 0"]),
]


@pytest.mark.parametrize(("text", "rows"), MODIFIED)
def test_craigs_table_shifts_the_same_lengths_and_angles(text: str, rows: list[str]) -> None:
    assert table(f"convention: modified\n{text}zero: drawn") == rows


def test_coordinates_may_be_in_another_order() -> None:
    names = [q.name for q in read(PLANAR + "coordinates: [q2, q1]").robot.coordinates]
    assert names == ["q2", "q1"]


ONE = "{turn: q1, about: [0, 0, 1], through: [0, 0, 0]}"
SLIDE, BEND = "{slide: d, along: [0, 0, 1]}", "{turn: q, about: [0, 1, 0]"
FAULTS = {
    "no hand": (f"«axes»: [{ONE}]", "no place", "tip: [x, y, z]"),
    "no axes": ("«axes»: []\ntip: [0, 0, 0]", "no joint axes", "{turn: theta1"),
    "a table too": (f"«dh»: [{{theta: q1*}}]\naxes: [{ONE}]\ntip: [l, 0, 0]", "both given", "delete `dh`"),
    "a base too": (f"«base»: Rx(90deg)\naxes: [{ONE}]\ntip: [l, 0, 0]", "both given", "delete `base`"),
    "a tip without axes": ("«tip»: [0, 0, 0]\ndh: [{theta: q1*, a: l}]", "belongs to `axes`", "delete it"),
    "neither": ("axes: [«{about: [0, 0, 1]}»]\ntip: [l, 0, 0]", "neither `turn` nor `slide`", "{turn:"),
    "both": ("axes: [«{turn: q1, slide: q2}»]\ntip: [l, 0, 0]", "both turns and slides", "two axes"),
    "no point": ("axes: [«{turn: q1, about: [0, 0, 1]}»]\ntip: [l, 0, 0]", "no `through`", "{turn: theta1"),
    "no direction": ("axes: [«{slide: q1}»]\ntip: [l, 0, 0]", "no `along`", "{turn: theta1"),
    "about of a slide": (
        "axes: [{slide: q1, «about»: [0, 0, 1]}]\ntip: [l, 0, 0]",
        "belongs to `turn`",
        "along: [x, y, z]",
    ),
    "two components": ("axes: [{slide: q1, along: «[0, 1]»}]\ntip: [l, 0, 0]", "2 components", "[x, y, z]"),
    "no direction at all": ("axes: [{slide: q1, along: [«0, 0, 0»]}]\ntip: [l, 0, 0]", "is 0", "[0, 0, 1]"),
    "a name twice": (
        f"axes: [{ONE}, «{{turn: q1, about: [0, 1, 0], through: [0, 0, 0]}}»]\ntip: [l, 0, 0]",
        "another axis already",
        "a coordinate of its own",
    ),
    "an angle in the drawing": (f"axes: [{ONE}]\ntip: [«q1», 0, 0]", "the coordinate q1", "one pose"),
    "a slide in a direction": (
        "axes: [{slide: d, along: [0, 0, 1]}, {slide: e, along: [«d», 1, 0]}]\ntip: [l, e, d]",
        "contains the coordinate d",
        "one pose",
    ),
    "the tip stays behind": (
        f"axes: [{SLIDE}, {BEND}, through: [0, 0, d]}}]\ntip: [«l, 0, h»]",
        "the tip does not move with the slide d",
        "add d times",
    ),
    "an axis stays behind": (
        f"axes: [{SLIDE}, {BEND}, through: [«0, 0, h»]}}]\ntip: [l, 0, d]",
        "axis 2 does not move with the slide d",
        "add d times",
    ),
    "an axis moves with what follows": (
        f"axes: [{BEND}, through: [«0, 0, d»]}}, {SLIDE}]\ntip: [l, 0, d]",
        "axis 1 comes before the slide d",
        "leave d out",
    ),
    "an angle that is no number of degrees": (
        f"axes: [{ONE}, «{{turn: q2, about: [3, 0, 4], through: [0, 0, h]}}»]\ntip: [l, 0, h]",
        "the angle between two axes",
        "name it",
    ),
    "an offset that is no number of degrees": (
        f"zero: drawn\naxes: [«{ONE}», {{turn: q2, about: [0, 0, 1], through: [B, C, 0]}}]\ntip: [B, C, 0]",
        "at the joint of q1",
        "zero: table",
    ),
    "a length that is the root of sines": (
        f"axes: [{ONE}, {{turn: q2, about: [cos(b), 0, sin(b)], through: [0, 0, 0]}}]\ntip: «[A, B, 0]»",
        "the root of an expression with sines and cosines",
        "with letters for the lengths",
    ),
    "x of the hand not across": (
        f"axes: [{ONE}]\ntip: {{at: [l, 0, 0], z: [0, 0, 1], x: [«0, 1, 1»]}}",
        "not perpendicular",
        "mend",
    ),
    "x without z": (f"axes: [{ONE}]\ntip: {{at: [l, 0, 0], «x»: [0, 1, 1]}}", "an x and no z", "its z too"),
    "another zero": (f"axes: [{ONE}]\ntip: [l, 0, 0]\nzero: «here»", "one of table, drawn", "drawn"),
}


@pytest.mark.parametrize(("marked", "message", "help"), FAULTS.values(), ids=FAULTS)
def test_a_fault_is_told_where_it_stands(marked: str, message: str, help: str) -> None:
    text, expected = unmarked(marked)
    found = errors(text)
    assert places(found) == expected
    assert message in found[0].message
    assert help in found[0].help


# -- points and bodies in the drawing --------------------------------------------------------------

RRP_AS_DRAWN = """
axes:
  - {turn: theta1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: theta2, about: [0, -1, 0], through: [0, 0, L1]}
  - {slide: d3, along: [1, 0, 0], through: [0, 0, L1]}
tip: [a2 + d3, 0, L1]
zero: ZERO
masses:
  - {mass: m2, link: 2, center: {drawn: [lc2, 0, L1]}, inertia: {xx: Ix, yy: Iy, zz: Iz}, axes: base}
  - {mass: m3, link: 3, center: {drawn: [d3 + lc3, 0, L1]}}
points:
  P: {link: 3, at: {drawn: [d3, 0, L1 + h]}}
find: [pP, D]
"""
RRP_IN_FRAMES = """
dh:
  - {theta: theta1*, d: L1, alpha: 90deg}
  - {theta: theta2* + 90deg, alpha: 90deg}
  - {d: d3* + a2}
masses:
  - {mass: m2, link: 2, center: [0, 0, lc2], inertia: {xx: Ix, yy: Iy, zz: Iz}, axes: base}
  - {mass: m3, link: 3, center: [0, 0, lc3 - a2]}
points:
  P: {link: 3, at: [h, 0, -a2]}
find: [pP, D]
"""


def results(text: str) -> dict[str, object]:
    found: dict[str, object] = solve_json(text)["results"]
    return {name: found[name] for name in ("pP", "D", "H")}


def test_points_of_the_drawing_are_the_same_in_their_frames() -> None:
    assert results(RRP_AS_DRAWN.replace("ZERO", "drawn")) == results(RRP_IN_FRAMES)


def test_they_are_so_too_where_the_coordinates_are_the_tables() -> None:
    """With θ_2 and d_3 of the table in the place of θ_2 + 90° and d_3 + a_2."""
    values = {"theta1": 0.3, "theta2": 0.4, "d3": 0.7, "L1": 1.1, "a2": 0.6, "lc2": 0.2, "lc3": 0.5, "h": 0.9,
              "m2": 2.0, "m3": 3.0, "Ix": 0.1, "Iy": 0.2, "Iz": 0.4}  # fmt: skip
    table = values | {"theta2": values["theta2"] + pi / 2, "d3": values["d3"] + values["a2"]}
    ours, theirs = results(RRP_AS_DRAWN.replace("ZERO", "table")), results(RRP_IN_FRAMES)
    for name, value in ours.items():
        assert_close(numbers(value, table), numbers(theirs[name], values), name)


# -- axes of bodies: those of the world in the pose that is drawn ----------------------------------

ON_ITS_SIDE = """
axes:
  - {turn: q1, about: [1, 0, 0], through: [0, 0, 0]}
  - {turn: q2, about: [0, 0, 1], through: [h, 0, 0]}
  - {slide: q3, along: [0, 1, 0], through: [h, 0, 0]}
tip: [h, q3, 0]
zero: ZERO
masses:
  - {mass: m1, link: 1, center: {drawn: [h/2, b, 0]}, inertia: {xx: A1}, axes: base}
  - {mass: m2, link: 2, center: {drawn: [h, b, 0]}, inertia: {xx: A, yy: B, zz: C}, axes: GIVEN}
  - {mass: m3, link: 3, center: {drawn: [h, q3, b]}, inertia: {xx: A, yy: B, zz: C, xy: E}, axes: base}
find: [D]
"""


def turned_about(axis: int, angle: float) -> np.ndarray:
    x, y = (axis + 1) % 3, (axis + 2) % 3
    found = np.eye(3)
    found[x, x] = found[y, y] = np.cos(angle)
    found[y, x], found[x, y] = np.sin(angle), -np.sin(angle)
    return found


def energy_on_its_side(q: np.ndarray, rates: np.ndarray, at: dict[str, float]) -> float:
    """K by differences of where each body is and how it is turned from the pose that is drawn."""
    A, B, C, h, b = (at[name] for name in ("A", "B", "C", "h", "b"))
    tensors = (np.diag([at["A1"], 0, 0]), np.diag([A, B, C]), np.diag([A, B, C]))
    tensors[2][0, 1] = tensors[2][1, 0] = at["E"]

    def placed(t: float) -> list[tuple[np.ndarray, np.ndarray]]:
        q1, q2, q3 = q + t * rates
        first, elbow = turned_about(0, q1), np.array([h, 0, 0])
        second = first @ turned_about(2, q2)
        return [
            (first, first @ np.array([h / 2, b, 0])),
            (second, first @ elbow + second @ np.array([0, b, 0])),
            (second, first @ elbow + second @ np.array([0, q3, b])),
        ]

    step, energy = 1e-5, 0.0
    masses = (at["m1"], at["m2"], at["m3"])
    places = zip(placed(-step), placed(0), placed(step), masses, tensors, strict=True)
    for (R0, r0), (R, _), (R1, r1), mass, tensor in places:
        v, W = (r1 - r0) / (2 * step), R.T @ (R1 - R0) / (2 * step)
        w = np.array([W[2, 1], W[0, 2], W[1, 0]])
        energy += (mass * v @ v + w @ tensor @ w) / 2
    return float(energy)


@pytest.mark.parametrize(("zero", "back"), [("drawn", 0), ("table", pi / 2)])
@pytest.mark.parametrize("given", ["base", "{base: Rx(q1) Rz(q2)}"])
def test_the_axes_of_bodies_are_those_of_the_drawings_world(zero: str, back: float, given: str) -> None:
    """Frame 0 has its z along the world's x; in the table θ_2 is 90° as drawn."""
    if zero == "table" and given != "base":
        given = "{base: Rx(q1) Rz(q2 - 90deg)}"
    text = ON_ITS_SIDE.replace("ZERO", zero).replace("GIVEN", given)
    at = {
        "A1": 0.3,
        "A": 0.4,
        "B": 0.7,
        "C": 0.9,
        "E": 0.1,
        "h": 1.1,
        "b": 0.2,
        "m1": 2.0,
        "m2": 3.0,
        "m3": 1.5,
    }
    q, rates = np.array([0.3, 0.8, 0.6]), np.array([0.7, -0.4, 0.9])
    table = {"q1": q[0], "q2": q[1] + back, "q3": q[2]}
    D = np.array(numbers(solve_json(text)["results"]["D"], at | table), float)
    assert_close(rates @ D @ rates / 2, energy_on_its_side(q, rates, at), given, 1e-7)


def test_the_bodies_of_a_drawing_are_given_as_they_are_drawn() -> None:
    told = text_of(ON_ITS_SIDE.replace("ZERO", "drawn").replace("GIVEN", "base"))
    given = " ".join(told[: told.index("To be found")].split())
    assert (
        "body 2 in link 2, of mass m₂, its mass centre at (h, b, 0) in this pose, its axes in this " in given
    )
    assert "in this pose those of the world; body 3" in given
    assert "𝐇₀" not in given  # frame 0 is to be found
    first, second = "[cos(q2), -sin(q2), 0]", "[cos(q1)*sin(q2), cos(q1)*cos(q2), -sin(q1)]"
    rows = f"{{base: [{first}, {second}, [sin(q1)*sin(q2), sin(q1)*cos(q2), cos(q1)]]}}"
    told = text_of(ON_ITS_SIDE.replace("ZERO", "drawn").replace("GIVEN", rows))
    assert "seen from the world, along (c₂, c₁ s₂, s₁ s₂)" in " ".join(told.split())


def test_the_coordinates_of_a_drawn_mass_centre_in_its_frame_follow_in_the_drawn_pose() -> None:
    told = text_of(
        """
axes:
  - {turn: a, about: [0, 1, 0], through: [0, 0, 0]}
  - {slide: b, along: [0, 0, 1], through: [W, 0, 0]}
tip: [W, 0, b]
zero: drawn
masses:
  - {mass: m, link: 1, center: {drawn: [W/2, 0, h]}}
  - {mass: M, link: 2, center: {drawn: [W, k, b]}}
"""
    )
    words = " ".join(told.split())
    assert "a point of mass M at (W, k, b) in this pose" in words
    assert "h: coordinate z of the mass centre of body 1 as drawn (m)" in words
    assert "is drawn at (W/2, 0, h); its constant coordinates in frame 1 are found in that pose." in words
    assert "is drawn at (W, k, b); its constant coordinates in frame 2 are found in that pose." in words
    assert "𝐫_c1¹ = (𝐑₁^w)ᵀ (𝐫_c1 - 𝐨₁) = " in words
    assert "given by its coordinates" not in words


def text_of(problem: str) -> str:
    return report(dynsolve.solve(problem), Format.TEXT).decode()


DRAWN_FAULTS = {
    "without a drawing": (
        "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1, center: «{drawn: [l, 0, 0]}»}]",
        "there is no drawing",
        "`axes`",
    ),
    "it stays behind": (
        RRP_AS_DRAWN.replace("{drawn: [d3 + lc3, 0, L1]}", "«{drawn: [lc3, 0, L1]}»").replace(
            "ZERO", "drawn"
        ),
        "not fixed in link 3",
        "the letters of the slides",
    ),
    "a denominator of zero": (
        RRP_AS_DRAWN.replace("{drawn: [d3 + lc3, 0, L1]}", "{drawn: [«d3 + 1/0», 0, L1]}").replace(
            "ZERO", "table"
        ),
        "the denominator is zero",
        "",
    ),
    "two ways at once": (
        "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1, center: «{along: 1/2, drawn: [l, 0, 0]}»}]",
        "one of along, near and drawn",
        "tip",
    ),
}


@pytest.mark.parametrize(("marked", "message", "help"), DRAWN_FAULTS.values(), ids=DRAWN_FAULTS)
def test_a_point_that_is_not_in_the_drawing_is_told(marked: str, message: str, help: str) -> None:
    text, expected = unmarked(marked)
    found = errors(text)
    assert places(found) == expected
    assert message in found[0].message
    assert help in found[0].help


@pytest.mark.parametrize("mass", ["m", "2"])
@pytest.mark.parametrize(("typed", "has_decimals"), [("0.35", True), ("7/20", False)])
def test_numbers_of_a_drawing_are_written_as_they_were_typed(
    mass: str, typed: str, has_decimals: bool
) -> None:
    text = f"""
axes:
  - {{turn: q1, about: [0, 0, 1], through: [0, 0, 0]}}
  - {{turn: q2, about: [0, 0, 1], through: [{typed}, 0, 0]}}
tip: [1, 0, 0]
masses: [{{mass: {mass}, link: 2, center: tip}}]
"""
    assert read_problem(text).robot.has_decimals is has_decimals
