"""The compact form is the same function, and reads as a textbook prints it."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.compact.spelling import Speller
from dynsolve.algebra.compact.trig_forms import ConstantForms, TrigForm, TrigPolynomial, trig_forms
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, evaluate, value_of
from dynsolve.derivation.rules import derive
from dynsolve.explain.forms import Forms
from dynsolve.notation.printing import Style
from dynsolve.notation.python import to_python
from dynsolve.notation.text import read
from dynsolve.notation.tree import Matrix, Symbol
from dynsolve.notation.tree_values import compile_trees
from dynsolve.notation.tree_values import evaluate as value_of_tree
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from tests.robots import robots

# -- the compact form is the same function, and reads as a textbook prints it ------------------------


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
        ("m1*(a + b)*(a + b + 2*c)*cos(q1)", "m1*(a + b)*(a + b + 2*c)*cos(q1)"),
        ("m1*(a - d)^2*q1_dot", "m1*(d - a)**2*q1_dot"),
        ("a*q1_dot + a*q2_dot", "a*(q1_dot + q2_dot)"),
        ("I1*q1_dot^2/2 + I1*q1_dot*q2_dot + I1*q2_dot^2/2", "I1*(q1_dot + q2_dot)**2/2"),
        ("-a*sin(q1) - b*sin(q1 + q2)", "-a*sin(q1) - b*sin(q1 + q2)"),
        (
            "(m1*a^2 + I1)*q1_dot^2 + I1*(2*q1_dot*q2_dot + q2_dot^2)",
            "m1*a**2*q1_dot**2 + I1*(q1_dot + q2_dot)**2",
        ),
        (
            "sin(q1 + q2)*((b + a*cos(q2))*q1_dot^2 + b*(2*q1_dot*q2_dot + q2_dot^2))",
            "sin(q1 + q2)*(a*cos(q2)*q1_dot**2 + b*(q1_dot + q2_dot)**2)",
        ),
        (
            "sin(q1)^2*sin(q1 + q2)^2 + sin(q1)*cos(q1)*sin(q1 + q2)*cos(q1 + q2) - 1",
            "sin(q1)*sin(q1 + q2)*cos(q2) - 1",
        ),
        ("m1*a*(sin(q1 + q3) - sin(q1 + 2*q2 + q3))", "-2*m1*a*sin(q2)*cos(q1 + q2 + q3)"),
        ("2*a*q1_dot*q2_dot + a*q2_dot^2", "a*(2*q1_dot*q2_dot + q2_dot**2)"),
        ("m1*a^2/3", "m1*a**2/3"),
        ("m1*b^2/2 + m2*a^2*cos(q1)^2/12", "m1*b**2/2 + m2*a**2*cos(q1)**2/12"),
        ("m1*(a^2 + 3*b^2)*cos(q1)/12", "m1*(a**2 + 3*b**2)*cos(q1)/12"),
        ("(sin(q1)*a*q1_dot)^2 + (cos(q1)*a*q1_dot)^2", "a**2*q1_dot**2"),
        ("a*q1_ddot + b*q1_dot + g*cos(q1)", "a*q1_ddot + b*q1_dot + g*cos(q1)"),
        ("7 + 3*sin(q1) - 5*cos(q1)^2", "2 + 5*sin(q1)**2 + 3*sin(q1)"),
        ("m1*(a^2 + a*b*cos(q2))", "m1*(a**2 + a*b*cos(q2))"),
        ("m1*a*(b + a*sin(q1))*cos(q1)", "m1*a*cos(q1)*(b + a*sin(q1))"),
        ("m1*(d + a*sin(q1))*d*cos(q1)", "m1*d*cos(q1)*(d + a*sin(q1))"),
        ("a^2*b*cos(q1) + a*b^2*cos(q1 + q2)", "a*b*(a*cos(q1) + b*cos(q1 + q2))"),
        ("a^3*b + a*b^3 + 2*a^2*b^2*cos(q2)", "a*b*(a**2 + b**2 + 2*a*b*cos(q2))"),
        ("c^2*(a*b + b^2*sin(q1)^2)", "c**2*b*(a + b*sin(q1)**2)"),
        ("m1*(a*c + a^2/b)", "m1*a*(a/b + c)"),
        ("sqrt(2)*(a/2 + 2*b)", "sqrt(2)*(a + 4*b)/2"),
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
        (
            "m1*a^2*(3/2 + cos(q1)) + m2*(a^2 + b^2/3 + a*b*cos(q2))",
            "m1*a**2*(3/2 + cos(q1)) + m2*(a**2 + b**2/3 + a*b*cos(q2))",
        ),
        ("4*m1*a^2/9 + I1*(3*b^5/5 + 5*b^3/2)", "4*m1*a**2/9 + I1*(3*b**5/5 + 5*b**3/2)"),
        ("3*m1*a^2/16 + 3*m2*b^2/4", "3*(m1*a**2 + 4*m2*b**2)/16"),
        ("(m1*a^2/64 + m2*b^2/16)*(3 + 2*cos(q1))", "(m1*a**2 + 4*m2*b**2)*(3 + 2*cos(q1))/64"),
        ("m1*a^2/12 + m2*b^2/3", "m1*a**2/12 + m2*b**2/3"),
        ("(m1*a^2/2 - 2*I1 + 2*I2 - 2*I3)*cos(q1)", "2*(m1*a**2/4 - I1 + I2 - I3)*cos(q1)"),
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
        (
            "-(m2*(a + d)^2 + I1 - m1*c^2 - I2 + I3 - I4)*sin(q1)*cos(q1)",
            "-(m2*(a + d)**2 + I1 - m1*c**2 - I2 + I3 - I4)*sin(q1)*cos(q1)",
        ),
        ("k*(a + 2*q2 - 3*q1)", "-k*(3*q1 - a - 2*q2)"),
        ("k*(4*q1 - 5*q2 + q3)", "-k*(5*q2 - 4*q1 - q3)"),
        ("a*(cos(q1) - 1)", "-a*(1 - cos(q1))"),
        ("m1*(d*sin(q1) - a*cos(q1) - b*cos(q1 + q2))^2", "m1*(a*cos(q1) + b*cos(q1 + q2) - d*sin(q1))**2"),
        (
            "((m1*a^2 + I1)*cos(q2) - m1*a*sin(q2))*q1_ddot + I2*q2_ddot",
            "((m1*a**2 + I1)*cos(q2) - m1*a*sin(q2))*q1_ddot + I2*q2_ddot",
        ),
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
        ("-d*sin(q1)*q1_dot + cos(q1)*d_dot", "cos(q1)*d_dot - d*sin(q1)*q1_dot"),
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
        ("a*(2*m1/3 + 2*m2)*sin(q1)", "2*a*(m1/3 + m2)*sin(q1)"),
        ("a*(m1/3 + m2)*sin(q1)", "a*(m1/3 + m2)*sin(q1)"),
        ("3*m1/2 + m2", "3*m1/2 + m2"),
        ("(3*m1/2 + m2)*q1_dot + a*m2*d_dot", "(3*m1/2 + m2)*q1_dot + m2*a*d_dot"),  # an entry of D as it is
        ("4*m1*a^2/3 + 4*m1*b^2 + m1*c^2/4", "m1*(4*a**2/3 + 4*b**2 + c**2/4)"),
        ("(4*sin(q1) + sin(q2)/2)*a", "a*(4*sin(q1) + sin(q2)/2)"),
        ("m1*(a^2/12 + b^2)", "m1*(a**2/12 + b**2)"),
        (  # no (2*m1*b**2 + 2*m2*(3*b**2 + c**2))*(...)/6
            "(m1*b^2 + m2*(3*b^2 + c^2))*(2*q1_dot*q2_dot + q2_dot^2)/3",
            "(m1*b**2 + m2*(3*b**2 + c**2))*(2*q1_dot*q2_dot + q2_dot**2)/3",
        ),
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
        ("m1*a*(sin(q1)*cos(30deg) - cos(q1)*sin(30deg))", "m1*a*sin(q1 - 0.5235987755982988)"),
        ("m1*a*(cos(q1)*cos(60deg) - sin(q1)*sin(60deg))", "m1*a*cos(q1 + 1.0471975511965976)"),
        ("m1*a*(cos(q1)*sin(60deg) + sin(q1)*cos(60deg))", "m1*a*sin(q1 + 1.0471975511965976)"),
        ("(m1*a + m2*b)*(sin(q1) - cos(q1))*cos(45deg)", "(m1*a + m2*b)*sin(q1 - 0.7853981633974483)"),
        ("m1*a*sin(q1)*cos(45deg)", "sqrt(2)*m1*a*sin(q1)/2"),
        ("m1*a*(sin(q1) - 2*cos(q1))*cos(45deg)", "sqrt(2)*m1*a*(sin(q1) - 2*cos(q1))/2"),
        ("m1*a*(sqrt(3)*sin(q1) - cos(q1))/2", "m1*a*(sqrt(3)*sin(q1) - cos(q1))/2"),
        (
            "m1*a*(sin(17deg)*cos(30deg) + cos(17deg)*sin(30deg))",
            "m1*a*(sqrt(3)*sin(0.29670597283903605) + cos(0.29670597283903605))/2",
        ),
        ("m1*a*(cos(q1)*cos(25deg) + sin(q1)*sin(25deg))", "m1*a*cos(q1 - 0.4363323129985824)"),
    ],
)
def test_a_constant_angle_is_added_to_another(written: str, printed: str) -> None:
    assert compact(written) == printed


QUANTITIES = ["D", "C", "g", "tau", "K", "P", "L", "ddt1", "dLdq1", "H1"]


@settings(max_examples=12)
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


# -- squares of sums of sines and cosines, found in polynomials that are multiplied out --------------


def ring() -> Ring:
    joints = [("q1", "revolute"), ("q2", "revolute"), ("d3", "prismatic")]
    angles = [Angle.of("q1"), Angle.of("q1") + Angle.of("q2")]
    return build_ring(joints, [Symbol(name) for name in ("m", "a", "b", "l")], angles)


R = ring()
Q1, Q12 = Angle.of("q1"), Angle.of("q1") + Angle.of("q2")
M, A, B, L = map(R.symbol, ("m", "a", "b", "l"))
C1, S1, C12, S12, D3 = R.cos(Q1), R.sin(Q1), R.cos(Q12), R.sin(Q12), R.symbol("d3")

FORMS = [
    # an arm in a turning plane: Murray, Li, Sastry (1994), example 4.3, has m_3 (l_1 c_2 + r_2 c_23)²
    (M * (A * C1 + B * C12) ** 2, "m (a cos(q₁) + b cos(q₁ + q₂))²"),
    (M * (A * S1 + B * S12) ** 2, "m (a sin(q₁) + b sin(q₁ + q₂))²"),
    (M * (A * C1 - B * C12) ** 2, "m (a cos(q₁) - b cos(q₁ + q₂))²"),
    (M * (L + A * C1 + B * C12) ** 2, "m (l + a cos(q₁) + b cos(q₁ + q₂))²"),
    (M * (L + A * S1) ** 2, "m (l + a sin(q₁))²"),
    # sines and cosines together: a mass centre beside the axis of its link
    (M * (A * C1 - B * S12) ** 2, "m (a cos(q₁) - b sin(q₁ + q₂))²"),
    (M * (A * C1 - B * S1) ** 2, "m (b sin(q₁) - a cos(q₁))²"),
    (M * (A * C1 + B * C12) ** 2 + M * L**2, "m (l² + (a cos(q₁) + b cos(q₁ + q₂))²)"),
    # no square: the elbow's own coupling, and a difference of squares
    (M * (A**2 + B**2 + A * B * C1 * 2), "m (a² + b² + 2a b cos(q₁))"),
    # a rod that slides past its joint: the distance of its middle, and its moment about that
    (M * (D3**2 - D3 * L + L**2 / 3), "m ((d₃ - l/2)² + l²/12)"),
    (M * (D3**2 + D3 * L + L**2 / 3), "m ((l/2 + d₃)² + l²/12)"),
    (M * (D3**2 - D3 * L + L**2 / 3 + A**2), "m ((d₃ - l/2)² + a² + l²/12)"),
    # a distance that is a sum stands beside one sine or cosine
    (M * (A * C1 - (B + L) * S12) ** 2, "m (a cos(q₁) - (b + l) sin(q₁ + q₂))²"),
    (M * (A + (D3 - L / 2) * S1 + B * C1) ** 2, "m (a + (d₃ - l/2) sin(q₁) + b cos(q₁))²"),
    # a moment of inertia beside the square of three roots, and beside that of two
    (
        M * ((A + (D3 - L / 2) * S1 + B * C1) ** 2 + L**2 * S1**2 / 12),
        "m ((a + (d₃ - l/2) sin(q₁) + b cos(q₁))² + l² sin²(q₁)/12)",
    ),
    (
        M * ((A * C1 + B * C12 / 2) ** 2 + B**2 * C12**2 / 12),
        "m (a² cos²(q₁) + a b cos(q₁) cos(q₁ + q₂) + b² cos²(q₁ + q₂)/3)",
    ),
]


@pytest.mark.parametrize(("value", "form"), FORMS, ids=[form for _, form in FORMS])
def test_forms(value: Expr, form: str) -> None:
    assert to_unicode(Compactor(R, ["m"], [["q1", "q2"]]).form(value)) == form


def test_squares_of_one_angle_stand_beside_those_of_another() -> None:
    """The distance of a point of a third joint from the waist: the squares of both its components."""
    axes = [("q1", "revolute"), ("q2", "revolute")]
    two = build_ring(axes, [Symbol(name) for name in "mabl"], [Angle.of("q1"), Angle.of("q2")])
    m, a, b, length = map(two.symbol, "mabl")
    s, c, c1 = two.sin(Angle.of("q2")), two.cos(Angle.of("q2")), two.cos(Angle.of("q1"))
    value = m * ((b - length * s) ** 2 + c1**2 * (a + length * c) ** 2)
    form = to_unicode(Compactor(two, ["m"], [["q1"], ["q2"]]).form(value))
    assert form == "m (cos²(q₁) (a + l cos(q₂))² + (b - l sin(q₂))²)"


def test_what_is_written_is_what_was_meant() -> None:
    draw = random.Random(3)
    for _ in range(40):
        roots = [draw.choice((-2, -1, 1, 3)) * one for one in (A * C1, B * C12, L, B * S1, A * S12)]
        value = M * sum(draw.sample(roots, draw.randint(2, 4)), R.zero) ** 2 + M * draw.choice(roots) * D3
        state = {name: draw.uniform(0.3, 1.5) for name in ("m", "a", "b", "l", "q1", "q2", "d3")}
        tree = Compactor(R, ["m"], [["q1", "q2"]]).form(value)
        assert value_of_tree(tree, state) == pytest.approx(evaluate(value, state))


# -- every form is the same function; constant angles are written as a person writes them ------------


ANGLES = (0.7, -1.3)


def value(form: TrigForm, delta: float = 0.0) -> float:
    total = 0.0
    for monomial, factor in form.items():
        term = float(factor)
        for (name, multiples), exponent in monomial:
            if name == "sqrt":
                term *= math.sqrt(multiples[0]) ** exponent
            else:
                angle = (
                    delta * multiples[0]
                    if delta
                    else sum(t * a for t, a in zip(multiples, ANGLES, strict=True))
                )
                term *= getattr(math, name)(angle) ** exponent
        total += term
    return total


def plain_value(poly: TrigPolynomial) -> float:
    functions = [f(a) for a in ANGLES for f in (math.sin, math.cos)]
    return sum(
        float(f) * math.prod(w**e for w, e in zip(functions, exponents, strict=True))
        for exponents, f in poly.items()
    )


powers = st.tuples(st.integers(0, 1), st.integers(0, 3), st.integers(0, 1), st.integers(0, 3))
polynomials = st.dictionaries(powers, st.integers(-5, 5).filter(bool), min_size=1, max_size=5)


@given(polynomials)
def test_every_form_is_the_same_function(poly: TrigPolynomial) -> None:
    for form in trig_forms(poly):
        assert value(form) == pytest.approx(plain_value(poly), abs=1e-9)


@pytest.mark.parametrize(
    ("poly", "function"),
    [
        ({(0, 2, 0, 0): 2, (0, 0, 0, 0): -1}, "cos(2,0)"),
        ({(1, 1, 0, 0): 2}, "sin(2,0)"),
        ({(1, 0, 1, 0): 1, (0, 1, 0, 1): 1}, "cos(-1,1)"),
        ({(1, 0, 0, 1): 1, (0, 1, 1, 0): 1}, "sin(1,1)"),
    ],
)
def test_what_is_one_sine_or_cosine_is_found(poly: TrigPolynomial, function: str) -> None:
    single = [
        f"{name}({','.join(map(str, multiples))})"
        for form in trig_forms(poly)
        if len(form) == 1
        for monomial in form
        for (name, multiples), _ in monomial
    ]
    assert function in single


@given(
    st.sampled_from([10, 5, 18, 9]),
    st.dictionaries(st.integers(0, 5), st.integers(-4, 4).filter(bool), min_size=1),
    st.integers(1, 4),
)
def test_constant_forms_are_the_same_number(degrees: int, powers: dict[int, int], times: int) -> None:
    write = ConstantForms(Fraction(degrees), {Fraction(degrees * times)})
    delta = math.radians(degrees)
    number = sum(f * math.cos(delta) ** k for k, f in powers.items())
    for form in write({(k,): f for k, f in powers.items()}):
        assert value(form, delta) == pytest.approx(number, abs=1e-9)


def test_the_square_of_a_sine_that_is_written_stays_one() -> None:
    problem = read_problem(
        "gravity: none\ndh: [{theta: q1*, alpha: 20deg}, {d: q2*}]\n"
        "masses: [{mass: m, link: 2, center: tip, inertia: {xx: A, yy: B, zz: C}}]\n"
    )
    D = Forms(problem.robot, derive(problem.robot))("D")
    assert isinstance(D, Matrix)
    assert to_unicode(D.rows[0][0]) == "(m q₂² + B) sin²(20°) + C cos²(20°)"


@pytest.mark.parametrize(
    ("angle", "entry"),
    [
        ("45deg", "m l² (1 + c₂²)/8 + (B + C + C₂ + A₂ s₂² + B₂ c₂²)/2"),
        ("30deg", "m l² (3 + c₂²)/16 + (B + 3C + 3C₂ + A₂ s₂² + B₂ c₂²)/4"),
    ],
)
def test_moments_of_inertia_share_the_fraction_of_a_fixed_angle(angle: str, entry: str) -> None:
    problem = read_problem(
        f"gravity: none\ndh: [{{theta: q1*, alpha: {angle}}}, {{theta: q2*, a: l}}]\nmasses:\n"
        "  - {mass: M, link: 1, center: origin, inertia: {xx: A, yy: B, zz: C}}\n"
        "  - {mass: m, link: 2, center: midpoint, inertia: {xx: A2, yy: B2, zz: C2}}\n"
    )
    D = Forms(problem.robot, derive(problem.robot))("D")
    assert isinstance(D, Matrix)
    assert to_unicode(D.rows[0][0], Style(shorthand={"q2": "2"})) == entry


def test_a_coordinate_less_a_length_is_one_sum_in_d_the_energies_and_the_forces() -> None:
    rod = "{mass: m, link: 2, center: [0, 0, -l/2], shape: {rod: {length: l, axis: z}}}"
    slides = "gravity: none\ndh: [{theta: q1*, alpha: 90deg}, {d: q2*}]\n"
    problem = read_problem(f"{slides}masses: [{rod}]\n")
    forms = Forms(problem.robot, derive(problem.robot))
    assert to_unicode(forms("tau1")) == "m ((q₂ - l/2)² + l²/12) q̈₁ + 2m (q₂ - l/2) q̇₁ q̇₂"
    twice = 2 * problem.robot.ring.symbol("q2") - problem.robot.ring.symbol("l")
    assert to_unicode(forms.of(twice)) == "2(q₂ - l/2)"
    assert to_unicode(forms.of(twice * twice / 2)) == "2(q₂ - l/2)²"


@pytest.mark.parametrize(
    ("spring", "force"),
    [
        ("{stiffness: 250, of: z, rest: 0.4}", "250(z - 0.4)"),
        ("{stiffness: k, of: z - 0.05*y, rest: z0}", "k (z - 0.05 y - z₀)"),
        ("{stiffness: k, of: y - 0.3*z}", "-0.3 k (y - 0.3 z)"),
        ("{energy: 0.15*k*(z - 0.35)^4}", "0.6 k (z - 0.35)³"),
        ("{energy: 0.15*k*(z - l)^2}", "0.3 k (z - l)"),
        ("{energy: k*z^2/2 + k3*z^4/4}", "k z + k₃ z³"),
        ("{stiffness: 40, of: z, rest: 2*l - 0.3}", "40(z - 2l + 0.3)"),
        ("{stiffness: k, of: a*z, rest: a - 0.1}", "a k (a z - a + 0.1)"),
        ("{stiffness: 3, of: z, rest: 20deg}", "3(z - π/9)"),
        ("{stiffness: k, of: z - a*y, rest: h}", "k (z - a y - h)"),
        ("{stiffness: k, of: z + a*y, rest: h}", "k (z + a y - h)"),
    ],
)
def test_a_decimal_is_drawn_out_of_a_length_where_that_leaves_what_was_typed(spring: str, force: str) -> None:
    slides = "gravity: none\ndh: [{d: z*}, {d: y*}]\nmasses: [{mass: m, link: 1}, {mass: 1.5, link: 2}]\n"
    problem = read_problem(f"{slides}springs: [{spring}]\n")
    g = Forms(problem.robot, derive(problem.robot))("g")
    assert isinstance(g, Matrix) and to_unicode(g.rows[0][0]) == force


def test_beside_decimals_quarters_of_masses_and_energies_are_fractions_everywhere() -> None:
    body = "{mass: m, at: [a*cos(q), a*sin(q), 0], turn: q, inertia: {zz: m*a^2/2}}"
    problem = read_problem(
        f"gravity: none\nmodel: {{coordinates: {{q: revolute}}, bodies: [{body}]}}\n"
        "friction: {q: 0.05}\nsprings: [{energy: k*q^2/2 + c*q^4/4}]\n"
    )
    forms = Forms(problem.robot, derive(problem.robot))
    shown = [to_unicode(forms(name)) for name in ("Kw1", "K", "dLdqd1", "D", "Ps")]
    assert shown == ["m a² q̇²/4", "3m a² q̇²/4", "3m a² q̇/2", "[[3m a²/2]]", "½ k q² + ¼ c q⁴"]


def test_beside_masses_alone_quarters_are_of_lengths_in_numbers() -> None:
    masses = "masses: [{mass: m, link: 1, center: midpoint}, {mass: 0.3, link: 1, center: tip}]\n"
    problem = read_problem(f"gravity: none\ndh: [{{theta: q*, a: 1}}]\n{masses}")
    assert to_unicode(Forms(problem.robot, derive(problem.robot))("D")) == "[[0.3 + 0.25 m]]"


@pytest.mark.parametrize("arm", ["R - 0.1", "0.1 - R", "a - b", "b - a", "b - 0.7 a"])
def test_a_difference_is_written_as_it_was_typed_wherever_it_is_a_factor(arm: str) -> None:
    typed = arm.replace("0.7 ", "0.7*")
    body = f"{{mass: m, at: [({typed})*sin(theta), -({typed})*cos(theta), 0]}}"
    problem = read_problem(
        f"gravity: [0, -g, 0]\nmodel: {{coordinates: {{theta: revolute}}, bodies: [{body}]}}\n"
    )
    forms = Forms(problem.robot, derive(problem.robot))
    assert to_unicode(forms("P")) == f"-m g ({arm}) cos(θ)"
    assert to_unicode(forms("g")) == f"[[m g ({arm}) sin(θ)]]"
    assert to_unicode(forms("D")) == f"[[m ({arm})²]]"


@pytest.mark.parametrize(
    ("turn", "inertia", "energy"),
    [
        ("q2 - q1/0.1", "J", "½ J (q̇₂ - 10q̇₁)²"),
        ("q2 - q1/0.1", "0.004", "½·0.004 (q̇₂ - 10q̇₁)²"),
        ("q2 - 5*q1", "J", "½ J (q̇₂ - 5q̇₁)²"),
        ("q1/0.3 - q2", "J", "½ J (10q̇₁/3 - q̇₂)²"),
    ],
)
def test_a_rate_is_written_as_its_angle_was_typed(turn: str, inertia: str, energy: str) -> None:
    body = f"{{mass: 2, at: [q1, 0, 0], turn: {turn}, inertia: {{zz: {inertia}}}}}"
    model = f"{{coordinates: {{q1: prismatic, q2: revolute}}, bodies: [{body}]}}"
    problem = read_problem(f"gravity: none\nmodel: {model}\n")
    assert to_unicode(Forms(problem.robot, derive(problem.robot))("Kw1")) == energy


def test_a_number_beside_a_parameter_takes_the_sign_that_saves_a_minus() -> None:
    mass = "{mass: m, center: [-0.1, 0, 0], link: 1}"
    problem = read_problem(f"gravity: [0, -g, 0]\ndh: [{{theta: q1*, a: R}}]\nmasses: [{mass}]\n")
    g = Forms(problem.robot, derive(problem.robot))("g")
    assert to_unicode(g) == "[[m g (R - 0.1) cos(q₁)]]"


@pytest.mark.parametrize(
    ("rows", "entry"),
    [
        ("{theta: q1*, a: 0.2, alpha: 90deg}, {theta: q2*, a: 0.3}", "0.5 (0.2 + 0.3 cos(q₂))²"),
        (
            "{theta: q1*, a: 0.2, alpha: -90deg}, {theta: q2* - 90deg, a: 0.1, alpha: -90deg}, {d: q3*}",
            "0.5 (0.2 + 0.1 sin(q₂) + q₃ cos(q₂))²",
        ),
    ],
)
def test_a_mass_in_numbers_stands_before_the_square_of_a_distance(rows: str, entry: str) -> None:
    last = rows.count("{")
    problem = read_problem(f"gravity: none\ndh: [{rows}]\nmasses: [{{mass: 0.5, link: {last}}}]\n")
    D = Forms(problem.robot, derive(problem.robot))("D")
    assert isinstance(D, Matrix) and to_unicode(D.rows[0][0]) == entry


def test_the_minus_of_a_sum_that_is_turned_stands_before_its_fraction() -> None:
    terms = Speller()(read("x*(c - s) + y*(s - c)/2").tree)
    assert terms == read("x*(c - s) - y*(c - s)/2").tree, "and not + (-y (c - s))/2, which LaTeX would have"


WAIST = "gravity: [0, 0, -g]\ndh:\n  - {theta: q1*, d: h, a: a, alpha: 90deg}\n"


@pytest.mark.parametrize(
    ("rows", "masses", "entry", "symbol"),
    [
        (
            "  - {theta: 30deg, a: b}\n  - {theta: q2*, a: l}\n",
            "[{mass: m, link: 3, center: tip}]",
            "m (√3 b/2 + a + l cos(q₂ + 30°))²",
            "-m l sin(q₂ + 30°) (√3 b + 2a + 2l cos(q₂ + 30°))/2",
        ),
        (
            "  - {theta: q2*, alpha: 90deg}\n  - {d: q3*}\n  - {theta: q4*, a: e}\n",
            "[{mass: m3, link: 3, center: tip}, {mass: m4, link: 4, center: tip}]",
            "m₄ ((a + q₃ s₂ + e c₂ c₄)² + e² s₄²) + m₃ (a + q₃ s₂)²",
            "m₄ (a + q₃ s₂ + e c₂ c₄)(q₃ c₂ - e s₂ c₄) + m₃ q₃ c₂ (a + q₃ s₂)",
        ),
    ],
)
def test_beside_a_mass_stands_the_square_of_its_distance_from_the_first_axis(
    rows: str, masses: str, entry: str, symbol: str
) -> None:
    """Where it has a root of a number, or angles of several groups; and so its slope, in c₁₂₁."""
    problem = read_problem(f"{WAIST}{rows}masses: {masses}\n")
    forms = Forms(problem.robot, derive(problem.robot))
    style = Style(shorthand={"q2": "2", "q4": "4"})
    assert to_unicode(forms.matrix("D").rows[0][0], style) == entry
    assert to_unicode(forms.christoffel(0, 1, 0), style) == symbol


def test_an_expression_of_another_ring_is_refused() -> None:
    """Its generators stand for other angles: s₂ would be printed as s₁₂."""
    one, other = (
        build_ring(COORDINATES, [], preferred=[Angle.of("q1"), second])
        for second in (Angle.of("q2"), Angle.of("q1") + Angle.of("q2"))
    )
    with pytest.raises(ValueError, match="another ring"):
        Compactor(other).form(one.sin(Angle.of("q2")))


def test_of_a_given_model_masses_and_inertias_stand_first_by_their_dimensions() -> None:
    energies = "K: m*x'^2/2 + (J + m*l^2)*a'^2/2, P: m*g*x + m*g*l*cos(a)"
    problem = read_problem(f"model: {{coordinates: {{x: prismatic, a: revolute}}, {energies}}}\n")
    forms = Forms(problem.robot, derive(problem.robot))
    assert [to_unicode(forms(name)) for name in ("P", "dLdq2")] == ["m g (x + l cos(a))", "m g l sin(a)"]
    assert to_unicode(forms.matrix("D").rows[1][1]) == "m l² + J"
