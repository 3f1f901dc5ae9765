"""The compact form is the same function, and reads as a textbook prints it."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.ring_values import build_ring, evaluate, value_of
from dynsolve.derivation.rules import derive
from dynsolve.explain.forms import Forms
from dynsolve.notation.python import to_python
from dynsolve.notation.text import read
from dynsolve.notation.tree import Matrix
from dynsolve.notation.tree_values import compile_trees
from dynsolve.problem import read_problem
from tests.robots import robots

COORDINATES = [("q1", "revolute"), ("q2", "revolute"), ("q3", "revolute"), ("d", "prismatic")]


def compact(text: str) -> str:
    """The compact form of a formula in three parallel joints and a slide; m and I are masses and inertias."""
    tree = read(text, dots=True).tree
    absolute = [
        Angle.of("q1"),
        Angle.of("q1") + Angle.of("q2"),
        Angle.of("q1") + Angle.of("q2") + Angle.of("q3"),
    ]
    ring = build_ring(COORDINATES, [tree], preferred=absolute)
    leading = [name for name in ring.parameters if name[0] in "mI"]
    return to_python(
        Compactor(ring, sorted(leading, key=lambda name: (name[0] != "m", name))).form(value_of(ring, tree))
    )


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("m1*a*g + m2*a*g", "g*a*(m1 + m2)"),
        ("cos(q1)*cos(q2) - sin(q1)*sin(q2)", "cos(q1 + q2)"),
        ("m2*a^2 + m2*b^2 + 2*m2*a*b*cos(q2)", "m2*(a**2 + b**2 + 2*a*b*cos(q2))"),
        ("m1*a*cos(q1) + m2*b*cos(q1) + m2*c*cos(q1 + q2)", "(m1*a + m2*b)*cos(q1) + m2*c*cos(q1 + q2)"),
        ("I1*sin(q2)^2 + I2*cos(q2)^2", "I1*sin(q2)**2 + I2*cos(q2)**2"),
        ("m1*(a + b)^2", "m1*(a + b)**2"),
        ("m1*(a - d)^2*q1_dot", "m1*(d - a)**2*q1_dot"),
        ("a*q1_dot + a*q2_dot", "a*(q1_dot + q2_dot)"),
        ("I1*q1_dot^2/2 + I1*q1_dot*q2_dot + I1*q2_dot^2/2", "I1*(q1_dot + q2_dot)**2/2"),
        ("-a*sin(q1) - b*sin(q1 + q2)", "-a*sin(q1) - b*sin(q1 + q2)"),
        ("2*a*q1_dot*q2_dot + a*q2_dot^2", "a*(2*q1_dot*q2_dot + q2_dot**2)"),
        ("m1*a^2/3", "m1*a**2/3"),
        ("m1*b^2/2 + m2*a^2*cos(q1)^2/12", "m1*b**2/2 + m2*a**2*cos(q1)**2/12"),
        ("m1*(a^2 + 3*b^2)*cos(q1)/12", "m1*(a**2 + 3*b**2)*cos(q1)/12"),
        ("(sin(q1)*a*q1_dot)^2 + (cos(q1)*a*q1_dot)^2", "a**2*q1_dot**2"),
        ("a*q1_ddot + b*q1_dot + g*cos(q1)", "a*q1_ddot + b*q1_dot + g*cos(q1)"),
    ],
)
def test_it_reads_as_a_textbook_prints_it(written: str, printed: str) -> None:
    assert compact(written) == printed


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("m1*(d^2 - d*l + l^2/3) + m2*d^2", "m1*((d - l/2)**2 + l**2/12) + m2*d**2"),
        ("2*m1*(d^2 - d*l + l^2/3) + 2*m2*d^2", "2*(m1*((d - l/2)**2 + l**2/12) + m2*d**2)"),
        (
            "m1*(a^2/3 - b^2/12) + m2*(d^2 - d*l + l^2/3)",
            "m1*(4*a**2 - b**2)/12 + m2*((d - l/2)**2 + l**2/12)",
        ),
        (
            "m1*(2*a^2/3 - b^2/6) + m2*(2*d^2 - 2*d*l + 2*l^2/3)",
            "m1*(4*a**2 - b**2)/6 + 2*m2*((d - l/2)**2 + l**2/12)",
        ),
        ("m1*(d - l/2) + m2*d", "m1*(d - l/2) + m2*d"),
        ("m1*(2*d - l) + 2*m2*d", "2*(m1*(d - l/2) + m2*d)"),
    ],
)
def test_a_polynomial_and_a_multiple_of_it_are_spelled_alike(written: str, printed: str) -> None:
    assert compact(written) == printed


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("(l/2 - d)*sin(q1)", "-(d - l/2)*sin(q1)"),
        ("(d - l/2)*sin(q1)", "(d - l/2)*sin(q1)"),
        ("(I1 - m1*a^2 - I2)*cos(q1)", "-(m1*a**2 - I1 + I2)*cos(q1)"),
        ("m1*(l/2 - d)^2*sin(q1)^2", "m1*(d - l/2)**2*sin(q1)**2"),
        ("m1*(l/2 - d)^2*cos(q2)^2 + m2*d^2*cos(q2)^2", "(m1*(d - l/2)**2 + m2*d**2)*cos(q2)**2"),
        ("l/2 - d", "l/2 - d"),
    ],
)
def test_a_sum_that_is_a_factor_has_one_orientation(written: str, printed: str) -> None:
    assert compact(written) == printed


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        (
            "2*m1*d*cos(q2)^2*q1_dot*d_dot - 2*(m1*d^2 + I1)*sin(q2)*cos(q2)*q1_dot*q2_dot",
            "2*m1*d*cos(q2)**2*q1_dot*d_dot - 2*(m1*d**2 + I1)*sin(q2)*cos(q2)*q1_dot*q2_dot",
        ),
        ("m1*(d - l/2)*q1_dot^2 + m2*d*q1_dot^2", "(m1*(d - l/2) + m2*d)*q1_dot**2"),
        ("(m1*a^2 + I1)*q1_dot^2/2 + I2*q2_dot^2/2", "((m1*a**2 + I1)*q1_dot**2 + I2*q2_dot**2)/2"),
    ],
)
def test_products_of_rates_stand_apart(written: str, printed: str) -> None:
    assert compact(written) == printed


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("(I2 - I1)*sin(q1)*cos(q1)", "-(I1 - I2)*sin(q1)*cos(q1)"),  # as (I1 - I2) is spelled elsewhere
        ("-(d - l/2)*cos(q1)", "-(d - l/2)*cos(q1)"),  # a distance keeps its orientation
        ("-I1 + m1*l^2*sin(q1)^2 + m2*a^2*cos(q1)^2", "m1*l**2*sin(q1)**2 + m2*a**2*cos(q1)**2 - I1"),
        ("-d*sin(q1)*q1_dot + cos(q1)*d_dot", "-d*sin(q1)*q1_dot + cos(q1)*d_dot"),  # in the order of the q's
        ("cos(q1)*d_dot - a*sin(q1)*d_dot", "(cos(q1) - a*sin(q1))*d_dot"),
        ("l + d/2 + a/2", "l + a/2 + d/2"),  # no (2*l + a + d)/2
        ("d/4 + a/2", "(2*a + d)/4"),
    ],
)
def test_a_minus_stands_where_a_textbook_has_it(written: str, printed: str) -> None:
    assert compact(written) == printed


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("a*(2*m1/3 + 2*m2)*sin(q1)", "2*a*(m1 + 3*m2)*sin(q1)/3"),
        ("a*(m1/3 + m2)*sin(q1)", "a*(m1 + 3*m2)*sin(q1)/3"),
        ("4*m1*a^2/3 + 4*m1*b^2 + m1*c^2/4", "m1*(4*a**2/3 + 4*b**2 + c**2/4)"),
        ("(4*sin(q1) + sin(q2)/2)*a", "a*(4*sin(q1) + sin(q2)/2)"),
        ("m1*(a^2/12 + b^2)", "m1*(a**2/12 + b**2)"),
    ],
)
def test_no_number_stands_before_a_sum_of_fractions(written: str, printed: str) -> None:
    assert compact(written) == printed


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("sin(q1)*cos(beta) - cos(q1)*sin(beta)", "sin(q1 - beta)"),
        ("sin(beta)*cos(phi) + cos(beta)*sin(phi)", "sin(beta + phi)"),
        ("m1*g*(cos(q1)*cos(beta) - sin(q1)*sin(beta))", "m1*g*cos(q1 + beta)"),
        ("a*cos(q1)*sin(beta) + b*sin(q1)*cos(beta)", "b*sin(q1)*cos(beta) + a*cos(q1)*sin(beta)"),
    ],
)
def test_a_constant_angle_is_added_to_another(written: str, printed: str) -> None:
    assert compact(written) == printed


QUANTITIES = ["D", "C", "g", "tau", "K", "P", "L", "ddt1", "dLdq1", "H1"]


@settings(max_examples=25)
@given(robots(max_joints=3))
def test_it_is_the_same_function(text: str) -> None:
    robot = read_problem(text).robot
    values = derive(robot)
    forms = Forms(robot, values)
    names = [name for q in robot.coordinates for name in (q.name, q.velocity, q.acceleration)]
    point = {name: 0.31 + 0.17 * k for k, name in enumerate([*names, *robot.ring.parameters])}
    for quantity in QUANTITIES:
        value = values[quantity]
        entries = value.entries if hasattr(value, "entries") else (value,)
        form = forms(quantity)
        trees = [e for row in form.rows for e in row] if isinstance(form, Matrix) else [form]
        for exact, tree in zip(entries, trees, strict=True):
            number = evaluate(exact, point)
            (printed,) = compile_trees([tree]).run(point)
            assert printed == pytest.approx(number, rel=1e-9, abs=1e-9), f"{quantity}: {to_python(tree)}"
