"""What a sound problem file becomes."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.text import read
from dynsolve.problem import load, read_problem
from dynsolve.problem.schema import template
from dynsolve.robot.model import AxesKind, Convention, JointType
from tests.support import LIBRARY, TEXTBOOKS
from tests.unit.problem.marked import PLANAR, RP


def column(robot, *texts: str) -> Matrix:
    return Matrix.column(robot.ring, [value_of(robot.ring, read(text).tree) for text in texts])


def center(fields: str, table: str = PLANAR) -> tuple[Matrix, Matrix]:
    """The centre of a body, and the function that makes columns of its ring."""
    robot = read_problem(f"{table}masses:\n  - {{mass: m1, {fields}}}\n").robot
    return robot, robot.bodies[0].center


@pytest.mark.parametrize("path", LIBRARY + TEXTBOOKS, ids=lambda path: path.stem)
def test_every_file_of_the_library_and_of_the_textbooks_loads(path: Path) -> None:
    problem = load(path)
    assert problem.stem == path.stem
    assert problem.title
    assert problem.source
    assert problem.robot.n >= 2
    assert not problem.warnings


def test_the_course_manipulator() -> None:
    problem = read_problem(template(), "rp.yaml")
    robot = problem.robot
    assert problem.title == "RP manipulator"
    assert problem.find == ("tau", "D", "C", "g")
    assert robot.convention is Convention.STANDARD
    assert [(q.name, q.type, q.force) for q in robot.coordinates] == [
        ("theta1", JointType.REVOLUTE, "tau1"),
        ("L2", JointType.PRISMATIC, "f2"),
    ]
    assert robot.joints[0].theta == Angle.of("theta1") + Angle((), Fraction(90))
    assert robot.joints[0].variable == "theta"
    assert robot.joints[0].rates == ((0, Fraction(1)),)
    assert robot.joints[1].d == robot.ring.symbol("L2")
    assert robot.parameters == ("L1", "m1", "I1zz", "m2", "g")
    first, second = robot.bodies
    assert first.center == column(robot, "0", "-L1/2", "0")
    assert first.axes.kind is AxesKind.BASE
    assert not first.is_point
    assert second.is_point
    assert second.center.is_zero
    assert robot.gravity == column(robot, "0", "0", "-g")


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ("link: 1, center: tip", "0 0 0"),
        ("link: 1, center: origin", "0 0 0"),
        ("link: 1, center: midpoint", "-l/2 -h*sin(beta)/2 -h*cos(beta)/2"),
        ("link: 1, center: {along: 1/3}", "-2*l/3 -2*h*sin(beta)/3 -2*h*cos(beta)/3"),
        ("link: 1, center: {near: [x, y, z]}", "x-l y-h*sin(beta) z-h*cos(beta)"),
        ("link: 1, center: [x, y, z]", "x y z"),
    ],
)
def test_centres_in_the_standard_convention(fields: str, expected: str) -> None:
    robot, found = center(fields, "dh:\n  - {theta: q1*, d: h, a: l, alpha: beta}\n")
    assert found == column(robot, *expected.split())


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ("link: 1, center: tip", "l -h*sin(beta) h*cos(beta)"),
        ("link: 1, center: origin", "0 0 0"),
        ("link: 1, center: midpoint", "l/2 -h*sin(beta)/2 h*cos(beta)/2"),
        ("link: 1, center: {along: f}", "f*l -f*h*sin(beta) f*h*cos(beta)"),
        ("link: 1, center: {near: [x, y, z]}", "x y z"),
        ("link: 2, center: origin", "0 0 0"),
    ],
)
def test_centres_in_the_modified_convention(fields: str, expected: str) -> None:
    table = "convention: modified\ndh:\n  - {theta: q1*}\n  - {theta: q2*, d: h, a: l, alpha: beta}\n"
    robot, found = center(fields, table)
    assert found == column(robot, *expected.split())


def test_the_tip_and_the_origin_of_a_prismatic_link_are_fixed() -> None:
    for word in ("tip", "origin", "{along: 1}"):
        _, found = center(f"link: 2, center: {word}", RP)
        assert found.is_zero


def test_about_the_joint() -> None:
    fields = "link: 2, center: tip, inertia: {zz: I2}, about: joint"
    robot = read_problem(f"{PLANAR}masses:\n  - {{mass: m2, {fields}}}\n").robot
    assert robot.bodies[0].about_point == column(robot, "-l2", "0", "0")
    robot = read_problem(f"{PLANAR}masses:\n  - {{mass: m2, {fields.replace('joint', 'origin')}}}\n").robot
    assert robot.bodies[0].about_point == column(robot, "0", "0", "0")


@pytest.mark.parametrize(
    ("table", "fields", "axis"),
    [
        (PLANAR, "link: 1", "x"),
        (PLANAR, "link: 1, axes: Rz(90deg)", "y"),
        (PLANAR, "link: 1, axes: Ry(90deg)", "z"),
        (PLANAR, "link: 1, axes: base", "x"),
        (RP, "link: 1", "y"),
        (RP, "link: 1, axes: base", "z"),
        (RP, "link: 1, axes: {base: Rz(theta1)}", "z"),
        (RP, "link: 2", "z"),
        (RP, "link: 2, axes: base", "x"),
        ("convention: modified\n" + PLANAR, "link: 1", "x"),
    ],
)
def test_a_rod_lies_along_its_link(table: str, fields: str, axis: str) -> None:
    # the frame of row 1 of RP has its z along the base's x: 90deg of theta, 90deg of alpha
    text = f"{table}masses:\n  - {{mass: m, {fields}, center: origin, shape: {{rod: {{length: l}}}}}}\n"
    assert read_problem(text).robot.bodies[0].shape.axis == axis


def test_a_disk_turns_about_z_and_what_is_written_wins() -> None:
    def axis(shape: str) -> str:
        text = f"{PLANAR}masses:\n  - {{mass: m, link: 1, center: tip, shape: {shape}}}\n"
        return read_problem(text).robot.bodies[0].shape.axis

    assert axis("{disk: {radius: r}}") == "z"
    assert axis("{disk: {radius: r, axis: x}}") == "x"
    assert axis("{rod: {length: r, axis: z}}") == "z"
    assert axis("{sphere: {radius: r}}") == ""


def test_an_inertia_wins_over_a_shape() -> None:
    fields = "link: 1, center: tip, shape: {sphere: {radius: r}}, inertia: {xx: A, xy: -B}"
    body = read_problem(f"{PLANAR}masses:\n  - {{mass: m, {fields}}}\n").robot.bodies[0]
    ring = body.mass.ring
    A, B, zero = ring.symbol("A"), ring.symbol("B"), ring.zero
    assert body.shape is None
    assert body.inertia == Matrix.of(ring, [[A, -B, zero], [-B, zero, zero], [zero, zero, zero]])


def test_couplings_have_their_rates() -> None:
    robot = read_problem(
        "dh:\n  - {theta: p1*}\n  - {theta: 2*(p2* - p1*/3) + 30deg}\n  - {d: -x*/2 + h}"
    ).robot
    assert [joint.rates for joint in robot.joints] == [
        ((0, Fraction(1)),),
        ((0, Fraction(-2, 3)), (1, Fraction(2))),
        ((2, Fraction(-1, 2)),),
    ]


def test_coordinates_in_another_order() -> None:
    robot = read_problem("coordinates: [p2, p1]\ndh:\n  - {theta: p1*}\n  - {theta: p2*}").robot
    assert [q.name for q in robot.coordinates] == ["p2", "p1"]
    assert [joint.rates for joint in robot.joints] == [((1, Fraction(1)),), ((0, Fraction(1)),)]


def test_fixed_rows_and_leading_ones() -> None:
    text = "dh:\n  - {d: h}\n  - {theta: q1*}\n  - {a: l}\nmasses: [{mass: m, link: 1}, {mass: m, link: 3}]"
    robot = read_problem(text).robot
    assert [joint.variable for joint in robot.joints] == [None, "theta", None]
    assert [body.link for body in robot.bodies] == [1, 3]


def test_greek_letters_and_degree_signs() -> None:
    robot = read_problem("dh:\n  - {theta: θ1* + 90°, alpha: β}").robot
    assert robot.joints[0].theta == Angle.of("theta1") + Angle((), Fraction(90))
    assert set(robot.parameters) == {"beta", "g"}


def test_gravity() -> None:
    robot = read_problem("gravity: none\n" + PLANAR).robot
    assert robot.gravity.is_zero
    assert "g" not in robot.parameters
    problem = read_problem("gravity: [0, 0, g]\n" + PLANAR)
    assert [finding.code for finding in problem.warnings] == ["gravity-upward"]
    for usual in ("[0, 0, -9.81]", "[0, -g, 0]", "[g, 0, 0]", "[0, g*sin(a), -g*cos(a)]"):
        assert not read_problem(f"gravity: {usual}\n{PLANAR}").warnings


def test_the_base() -> None:
    robot = read_problem("base: {rotate: Rz(90deg) Rx(90deg), move: [0, 0, h]}\n" + PLANAR).robot
    ring = robot.ring
    expected = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
    assert robot.base_rotation == Matrix.of(ring, [[ring.constant(x) for x in row] for row in expected])
    assert robot.base_position == column(robot, "0", "0", "h")
    listed = read_problem("base: [[0, 0, 1], [1, 0, 0], [0, 1, 0]]\n" + PLANAR).robot
    assert [e.number for e in listed.base_rotation.entries] == [e.number for e in robot.base_rotation.entries]


def test_exact_lists_of_axes() -> None:
    listed = "[[1, 0, 0], [0, sqrt(3)/2, -1/2], [0, 0.5, sqrt(3)/2]]"
    for axes in (listed, "Rx(30deg)", "Rx(10deg) Rx(20deg)", "Rx(pi/6)"):
        text = f"{PLANAR}masses:\n  - {{mass: m, link: 1, axes: {axes}}}\n"
        rotation = read_problem(text).robot.bodies[0].axes.rotation
        assert rotation[2, 1] * 2 == rotation.ring.one
        assert rotation[1, 1] * rotation[1, 1] * 4 == rotation.ring.constant(3)


def test_the_exercise() -> None:
    text = "values: {l1: 0.4, θ: 30deg}\nunits: {l1: m}\nmarks: {M: 2.5, f2: 3, K1: 4}\n"
    problem = read_problem(text + "find: [phi1, f1, Cqd, M, m12]\n" + PLANAR + "masses: [{mass: m, link: 1}]")
    assert problem.values["l1"] == Fraction(2, 5)
    assert float(problem.values["theta"]) == pytest.approx(0.5235987755982988, abs=1e-15)
    assert problem.units == {"l1": "m"}
    assert problem.marks == {"D": Fraction(5, 2), "tau2": 3, "K1": 4}
    assert problem.find == ("g1", "tau1", "Cqd", "D", "d12")


FAMILIES = {
    "A": "A1 A2",
    "H": "H1 H2",
    "rc": "rc1 rcp",
    "v": "v1 vp",
    "w": "w1 wp",
    "Kv": "Kv1 Kvp",
    "Kw": "Kwp",  # a point mass has none
    "dLdqd": "dLdqd1 dLdqd2",
    "ddt": "ddt1 ddt2",
    "dLdq": "dLdq1 dLdq2",
    "c": "c111 c112 c121 c122 c221 c222",  # c_211 is c_121
    "K": "K",
    "g": "g",
    "Jv": "Jv",
    "tau": "tau",
}


@pytest.mark.parametrize(("asked", "found"), FAMILIES.items())
def test_a_family_stands_for_all_its_members(asked: str, found: str) -> None:
    rod = "{name: p, mass: m2, link: 2, shape: {rod: {length: l}}, center: tip}"
    bodies = f"masses: [{{mass: m1, link: 1}}, {rod}]\n"
    table = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l}]\n"
    assert read_problem(f"{table}{bodies}find: [{asked}]\n").find == tuple(found.split())
    assert read_problem(f"{table}{bodies}find: {asked}\n").find == tuple(found.split())


def test_parts_of_a_file_have_places() -> None:
    problem = read_problem(RP + "masses:\n  - {mass: m1, link: 1, axes: {base: Rz(theta1)}}\n", "rp.yaml")
    finding = problem.finding(("masses", 0, "axes", "nothing"), "these axes do not turn with their link")
    assert str(finding).splitlines()[0] == "rp.yaml:6:31: these axes do not turn with their link"
    assert problem.finding(("values",), "x").line == 0


def test_a_table_alone_is_a_problem() -> None:
    problem = read_problem(PLANAR, "folder/arm.yaml")
    assert problem.title == "arm"
    assert problem.robot.bodies == ()


@pytest.mark.parametrize("center", ["center: origin, ", ""])
def test_a_rotor_without_mass_needs_no_center(center: str) -> None:
    text = PLANAR + f"masses: [{{mass: 0, link: 1, {center}inertia: {{zz: Im}}}}]"
    body = read_problem(text).robot.bodies[0]
    assert body.mass.is_zero
    assert not body.is_point


def test_names_of_bodies() -> None:
    robot = read_problem(PLANAR + "masses: [{mass: m1, link: 1}, {name: p, mass: mp, link: 2}]").robot
    assert [body.name for body in robot.bodies] == ["1", "p"]


def test_a_symbol_of_unit_lengths_may_be_a_mass_and_an_inertia() -> None:
    text = PLANAR + "masses: [{mass: m, link: 1, center: midpoint, inertia: {zz: m/12}}]"
    assert read_problem(text).robot.parameters == ("l1", "l2", "m", "g")


def test_marks_say_what_is_asked_for_where_find_does_not() -> None:
    assert read_problem(f"marks: {{D: 2, J: 1}}\n{PLANAR}").find == ("D", "J")
    assert read_problem(f"marks: {{D: 2}}\nfind: [tau]\n{PLANAR}").find == ("tau",)
