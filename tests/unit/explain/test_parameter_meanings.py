"""What a parameter is, told from where it stands."""

from __future__ import annotations

import pytest

from dynsolve.explain.notation_list import problem_names
from dynsolve.explain.parameter_meanings import meanings, told_together
from dynsolve.notation.tree import Node, Symbol
from tests.support import solved

MASS = "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]"


def told(problem: str) -> dict[str, str]:
    """The names that are told together -> their meaning."""
    known = [
        (name, meaning) for name, (_, _, meaning) in meanings(solved(problem).robot).items() if meaning.words
    ]
    return {" ".join(names): words for names, words in told_together(known)}


# rows of the table, and what is told of a length in them
LENGTHS = [
    ("[{theta: q1*, a: l1}, {theta: q2*, a: l2}]", "l1 l2", "length of link i, from 𝐨ᵢ₋₁ to 𝐨ᵢ"),
    ("[{theta: q1*, a: l2}, {theta: q2*, a: l1}]", "l2", "length of link 1, from 𝐨₀ to 𝐨₁"),
    ("[{theta: q1*, a: l1, d: h}, {theta: q2*}]", "l1", "distance from 𝐳₀ to 𝐳₁, along 𝐱₁"),
    ("[{theta: q1*, d: h}, {theta: q2*}]", "h", "distance from 𝐨₀ to 𝐨₁, along 𝐳₀"),
    ("[{theta: q1*}, {d: q2* + h}]", "h", "constant part of d in row 2 of the table"),
    ("[{theta: q1*, a: l}, {theta: q2*, a: l}]", "l", "length of links 1 and 2"),
    ("[{theta: q1*, a: l}, {theta: q2*, a: l, d: h}]", "l", "length in rows 1 and 2 of the table"),
    ("[{theta: q1*, a: l/2}, {theta: q2*}]", "l", "twice the length of link 1, from 𝐨₀ to 𝐨₁"),
    ("[{theta: q1*, d: -2*h}, {theta: q2*}]", "h", "half the distance from 𝐨₀ to 𝐨₁, against 𝐳₀"),
    ("[{theta: q1*}, {d: q2* + 3*e}]", "e", "1/3 of the constant part of d in row 2 of the table"),
    ("[{theta: q1*, a: l + b}, {theta: q2*}]", "b", "lengths in row 1 of the table"),
]


@pytest.mark.parametrize(("table", "names", "meaning"), LENGTHS)
def test_a_length_of_the_table(table: str, names: str, meaning: str) -> None:
    found = told(f"gravity: [0, -g, 0]\ndh: {table}\n{MASS}")
    assert {name: words for key, words in found.items() for name in key.split()}[names.split()[0]] == meaning
    assert names in found or " " not in names


def test_a_length_along_the_vertical_is_a_height() -> None:
    assert told(f"dh: [{{theta: q1*, d: h}}, {{theta: q2*}}]\n{MASS}")["h"] == "height of 𝐨₁ above 𝐨₀"
    turned = "base: Rx(90deg)\ngravity: [0, 0, -g]"
    assert (
        told(f"{turned}\ndh: [{{theta: q1*, d: h}}, {{theta: q2*}}]\n{MASS}")["h"] != "height of 𝐨₁ above 𝐨₀"
    )


def test_where_the_base_is() -> None:
    moved = "base: {rotate: Rx(30deg), move: [0, 0, h0]}"
    assert told(f"{moved}\ndh: [{{theta: q1*, a: l}}, {{theta: q2*}}]\n{MASS}")["h0"] == (
        "coordinate z of 𝐨₀ in the world"
    )


# the one body, and what is told of its parameters
BODIES = [
    ("{mass: m, link: 1, center: tip, shape: {cylinder: {radius: r, length: 2*h}}}", "h",
     "half the length of body 1"),
    ("{mass: m, link: 1, center: tip, shape: {cylinder: {radius: r/2, length: h}}}", "r",
     "twice the radius of body 1"),
    ("{mass: m, link: 1, center: tip, shape: {rod: {length: a + b}}}", "a b", "in the length of body 1"),
    ("{mass: m, link: 1, center: tip, shape: {hollow_cylinder: {outer: 2*r, inner: r, length: h}}}", "r",
     "inner radius of body 1"),
    ("{mass: m, link: 1, center: {near: [c, 0, 0]}}", "c", "distance from 𝐨₀ to the mass centre of body 1"),
    ("{mass: m, link: 1, center: [c, 0, 0]}", "c", "distance from 𝐨₁ to the mass centre of body 1"),
    ("{mass: m, link: 1, center: [x1, y1, 0]}", "x1 y1",
     "coordinates x and y of the mass centre of body 1, in frame 1"),
    ("{mass: m, link: 1, center: [-x1, y1, 0]}", "x1",
     "minus coordinate x of the mass centre of body 1, in frame 1"),
    ("{mass: m, link: 1, center: tip, inertia: {xx: A, zz: B}}", "A",
     "moment of inertia of body 1 about axis x through its mass centre"),
    ("{mass: m, link: 1, center: tip, inertia: {xx: A, yy: A}}", "A",
     "moment of inertia of body 1 about axes x and y through its mass centre"),
    ("{mass: m, link: 1, center: tip, inertia: {xx: I1xx, zz: I1zz}}", "I1xx I1zz",
     "moment of inertia of body 1 about axes x and z through its mass centre"),
    ("{mass: m, link: 1, center: tip, inertia: {zz: J}, about: joint}", "J",
     "moment of inertia of body 1 about axis z through its joint"),
    ("{mass: m, link: 1, center: tip, shape: {disk: {radius: r}}}", "r", "radius of body 1"),
    ("{mass: m, link: 1}, {mass: m, link: 1}", "m", "mass of bodies 1 and 2"),
    ("{mass: 2*m, link: 1}", "m", "half the mass of body 1"),
    ("{mass: 2*m, link: 1}, {mass: m, link: 1}", "m", "mass of body 2"),
    ("{mass: 1/m, link: 1}", "m", "inverse of the mass of body 1"),
    ("{mass: m^2, link: 1}", "m", "in the mass of body 1"),
    ("{mass: m, link: 1, center: [2*c, 0, 0]}", "c",
     "half the distance from 𝐨₁ to the mass centre of body 1"),
    ("{mass: m, link: 1, center: [-2*x1, y1, 0]}", "x1",
     "minus half the coordinate x of the mass centre of body 1, in frame 1"),
    ("{mass: m1, link: 1, center: [x1, -p, 0]}, {mass: m2, link: 1, center: [-p, y2, 0]}", "y2",
     "coordinate y of the mass centre of body 2, in frame 1"),
    ("{mass: m, link: 1, center: tip, inertia: {zz: J/2}}", "J",
     "twice the moment of inertia of body 1 about axis z through its mass centre"),
    ("{mass: M + m, link: 1}", "M m", "part of the mass of body 1"),
    ("{link: 1, shape: {rod: {length: b, density: rho0 + k*x}}}", "rho0 k",
     "parameter of the density of body 1"),
    ("{link: 1, shape: {rod: {length: b, density: rho*(1 + x/b)}}}, "
     "{link: 1, shape: {rod: {length: b, density: rho}}}", "rho", "density of body 2"),
    ("{link: 1, shape: {rod: {length: b, density: 2*rho}}}, "
     "{link: 1, shape: {rod: {length: b, density: rho*x/b}}}", "rho",
     "parameter of the density of bodies 1 and 2"),
]  # fmt: skip


@pytest.mark.parametrize(("body", "names", "meaning"), BODIES)
def test_a_parameter_of_a_body(body: str, names: str, meaning: str) -> None:
    found = told(f"gravity: [0, -g, 0]\ndh: [{{theta: q*, a: l}}]\nmasses: [{body}]")
    assert found[names] == meaning


# the file, a parameter that is a part of an expression alone, and what is told of it: its dimension
PARTS = [
    ("masses: [{mass: m, link: 1, center: tip, inertia: {zz: m*b^2/12}}]", "b", "length (m)"),
    ("masses: [{mass: m, link: 1, center: tip, inertia: {zz: J + M*l^2}}]", "J",
     "moment of inertia (kg m^2)"),
    ("masses: [{mass: m, link: 1, center: tip, inertia: {zz: J + M*l^2}}]", "M", "mass (kg)"),
    ("masses: [{mass: m, link: 1, center: [b/2 - c, 0, 0]}]", "b", "length (m)"),
    ("masses: [{mass: m, link: 1}]\nsprings: [{stiffness: k + b^2, of: q}]", "k", "torque (N m)"),
    ("masses: [{mass: m, link: 1}]\npoints: {P: {link: 1, at: [b + c, 0, 0]}}\nfind: [pP]", "b",
     "length (m)"),
    ("masses: [{mass: m, link: 1}]\nforces: [{link: 1, at: [b/3, 0, 0], force: [2*F, 0, 0]}]\nfind: [Q]", "F",
     "force (N)"),
    ("masses: [{mass: m, link: 1}]\nconstraints: [tip.x^2 + tip.y^2 - R^2*(1 + k)]\nfind: [Ac]", "R",
     "constant in the constraints (m)"),
    ("masses: [{mass: m, link: 1}]\nconstraints: [{rates: r*q'}]\nfind: [Ac]", "r",
     "constant in the constraints ()"),
]  # fmt: skip


@pytest.mark.parametrize(("rest", "name", "meaning"), PARTS)
def test_what_is_part_of_an_expression_is_called_by_its_dimension(rest: str, name: str, meaning: str) -> None:
    robot = solved(f"gravity: [0, -g, 0]\ndh: [{{theta: q*, a: l}}]\n{rest}").robot
    (line,) = (line for line in problem_names(robot) if Symbol(name) in line.signs)
    singular = str(line.words).removesuffix("s") if len(line.signs) > 1 else line.words
    assert f"{singular} ({line.unit})" == meaning


def test_a_length_in_positions_is_no_moment_of_inertia() -> None:
    robot = solved("""
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies:
    - {mass: M, at: [x, 0, 0], turn: x/rho, inertia: {zz: I}}
    - mass: m
      at: [x + l/2*sin(theta), -l/2*cos(theta), 0]
      turn: theta
      about: [0, 0, 1]
      inertia: {zz: m*l^2/12}
""").robot
    called = {sign: line.words for line in problem_names(robot) for sign in line.signs}
    assert called[Symbol("l")] == "length in the given positions"
    assert called[Symbol("rho")] == "length", "it stands in a turn alone"


def test_in_the_modified_table_a_length_is_that_of_the_link_before() -> None:
    table = "dh: [{theta: q1*}, {theta: q2*, a: l1}, {d: d3*}]"
    bodies = (
        "masses: [{mass: m1, link: 1}, {mass: m2, link: 2, center: [c, 0, 0]}, "
        "{mass: m3, link: 3, center: origin}]"
    )
    found = told(f"convention: modified\n{table}\n{bodies}")
    assert found["l1"] == "length of link 1, from 𝐨₁ to 𝐨₂"
    assert found["c"] == "distance from 𝐨₂ to the mass centre of body 2"


def test_in_the_modified_table_a_link_that_branches_has_no_one_length() -> None:
    rows = "{theta: q1*}, {a: l, theta: q2*}, {a: b, theta: q3*, from: 1}"
    body = "masses: [{mass: m, link: 2, center: [c, 0, 0]}]"
    found = told(f"convention: modified\ndh: [{rows}]\n{body}")
    assert (found["l"], found["b"]) == tuple(f"distance from 𝐳₁ to 𝐳{k}, along 𝐱₁" for k in "₂₃")
    found = told(f"convention: modified\ndh: [{rows.replace('a: b', 'a: l')}]\n{body}")
    assert found["l"] == "length in rows 2 and 3 of the table"


ACTING = """
gravity: none
dh: [{theta: q1*}, {d: q2*}]
masses: [{mass: m1, link: 1, center: origin, inertia: {zz: I1}}, {mass: m2, link: 2}]
springs: [{stiffness: k1, of: q1}, {stiffness: k2, of: q2}]
dampers: [{damping: b1, of: q1}, {damping: b2, of: q2}]
friction: {q1: f1, q2: {viscous: f2, coulomb: c2}}
"""


def test_what_turns_and_what_slides_have_units_of_their_own() -> None:
    found = {name: unit for name, (_, unit, _) in meanings(solved(ACTING).robot).items()}
    assert [found[name] for name in ("k1", "b1", "f1")] == ["N m/rad", "N m s/rad", "N m s/rad"]
    assert [found[name] for name in ("k2", "b2", "f2", "c2")] == ["N/m", "N s/m", "N s/m", "N"]


EXPRESSIONS = """
gravity: [0, -g/6*cos(beta), -g/6*sin(beta)]
dh: [{theta: q1*}, {d: q2*}]
masses: [{mass: m1, link: 1, center: origin, inertia: {zz: I1}}, {mass: m2, link: 2}]
springs: [{stiffness: 2*k1, of: q1}, {stiffness: k2/3, of: q2, rest: 2*delta}, {stiffness: 2*k, of: q1},
          {stiffness: 3*k, of: q1}]
dampers: [{damping: b/2, of: q1}]
motors: [{turns: q1, inertia: J, ratio: 1/R}, {turns: q2, inertia: J2, ratio: 1/r}]
"""


def test_what_is_in_an_expression_alone_is_told_by_what_that_is() -> None:
    robot = solved(EXPRESSIONS).robot
    for frames in (True, False):
        lines = [line for line in problem_names(robot, frames=frames) if not isinstance(line.words, Node)]
        found = {sign.name: f"{line.words} ({line.unit})" for line in lines for sign in line.signs}
        assert found | EXPRESSIONS_TOLD == found


EXPRESSIONS_TOLD = {
    "g": "6 times the acceleration of gravity (m/s^2)",
    "k1": "half the stiffness of a spring (N m/rad)",
    "k2": "3 times the stiffness of a spring (N/m)",
    "k": "in the stiffness of a spring (N m/rad)",
    "delta": "half the rest position of a spring (m)",
    "b": "twice the coefficient of a damper (N m s/rad)",
    "R": "inverse of the ratio of a gear ()",
    "r": "inverse of the ratio of a gear (m)",
}


def test_what_turns_a_length_into_an_angle_is_a_length() -> None:
    text = """
gravity: none
model:
  coordinates: {x: prismatic, q: revolute}
  bodies:
    - {mass: m, at: [x, 0, 0], turn: x/rho + n*q + delta, inertia: {zz: J}}
"""
    found = meanings(solved(text).robot)
    assert [found[name][1] for name in ("rho", "n", "delta")] == ["m", "", "rad"]
