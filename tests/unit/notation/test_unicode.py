"""Unicode: one line as a textbook looks in a terminal."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import HealthCheck, assume, given, settings

from dynsolve.notation.build import times
from dynsolve.notation.printing import Style
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    BigSum,
    Cross,
    Degrees,
    Derivative,
    Function,
    Integral,
    Letter,
    Matrix,
    Negative,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
)
from dynsolve.notation.unicode import printable, to_unicode, width
from tests.unit.notation.eye import Eye
from tests.unit.notation.trees import tree_value, trees

COORDINATES = Style(
    shorthand={"theta1": "1", "theta2": "2", "theta3": "3", "q10": "10", "L2": "2", "th1": "h1", "th2": "h2"}
)

TEXTS = [
    ("theta1", "θ₁"),
    ("theta1_dot", "θ\u0307₁"),
    ("theta1_ddot", "θ\u0308₁"),
    ("L2_dot^2", "L\u0307₂²"),
    ("slide_dot", "slide\u0307"),
    ("lambda", "λ"),
    ("load", "load"),
    ("load1", "load₁"),
    ("m_i", "mᵢ"),
    ("lc1^2", "l_c1²"),
    ("I1zz", "I_1zz"),
    ("Ixx1", "I_xx1"),
    ("I_xx_1", "I_{xx,1}"),
    ("x_1_2", "x_{1,2}"),
    ("J_omega1", "J_ω1"),
    # shorthands
    ("sin(theta1)", "s₁"),
    ("cos(theta1 + theta2)", "c₁₂"),
    ("cos(theta1 + theta2 + theta3)", "c₁₂₃"),
    ("sin(theta1)^2", "s₁²"),
    ("sin(theta1 + q10)", "s_{1,10}"),
    ("cos(th1 + th2)", "c_{h1,h2}"),
    ("sin(theta1 - theta2)", "sin(θ₁ - θ₂)"),
    ("sin(2*theta2 + theta3)", "sin(2θ₂ + θ₃)"),
    ("sin(theta2 + theta2)", "sin(θ₂ + θ₂)"),
    ("sin(theta1_dot)", "sin(θ\u0307₁)"),
    ("sin(beta)", "sin(β)"),
    ("cos(2*theta1)^2", "cos²(2θ₁)"),
    ("cos(2*theta1)^-2", "cos(2θ₁)⁻²"),
    ("tan(theta1)", "tan(θ₁)"),
    # products
    ("m1*g*L1", "m₁ g L₁"),
    ("2*m2*L2", "2m₂ L₂"),
    ("-2*m2", "-2m₂"),
    ("1/2*m1", "½ m₁"),
    ("5/12*m1", "(5/12) m₁"),
    ("m1*2", "m₁·2"),
    ("m1*(1/2)", "m₁·½"),
    ("m1*(5/12)", "m₁ (5/12)"),
    ("2*3", "2·3"),
    ("2*3^2", "2·3²"),
    ("2*(a + b)", "2(a + b)"),
    ("m1*(a + b)", "m₁ (a + b)"),
    ("(a + b)*(c + d)", "(a + b)(c + d)"),
    ("(a + b)*c", "(a + b) c"),
    ("a*(b*c)", "a b c"),
    ("a*(-b)", "a (-b)"),
    ("2*sqrt(3)*a", "2√3 a"),
    # quotients
    ("m1*g*L1/2", "m₁ g L₁/2"),
    ("(a + b)/2", "(a + b)/2"),
    ("a/(2*b)", "a/(2b)"),
    ("a/b^2", "a/b²"),
    ("(a/b)*c", "(a/b) c"),
    ("c*(a/b)", "c a/b"),
    ("(a/b)/c", "(a/b)/c"),
    ("a*(b/c)/d", "(a b/c)/d"),
    ("(-a)/b", "-a/b"),
    ("-(a/b)*c", "-(a/b) c"),
    ("-(a + b)/c", "-(a + b)/c"),
    ("a - (-b)", "a - (-b)"),
    # powers and roots
    ("(1/2)^2", "(½)²"),
    ("(a + b)^2", "(a + b)²"),
    ("(-a)^2", "(-a)²"),
    ("(2*a)^2", "(2a)²"),
    ("-(a + b)", "-(a + b)"),
    ("--a/b", "-(-a/b)"),
    ("(--a)/b", "-(-a)/b"),
    ("x^-2", "x⁻²"),
    ("(x^2)^3", "(x²)³"),
    ("sqrt(2)", "√2"),
    ("sqrt(a + b)", "√(a + b)"),
    ("sqrt(2)^2", "(√2)²"),
    ("90deg", "90°"),
    ("22.5deg", "22.5°"),
    ("a*90deg", "a·90°"),
    ("9.81", "981/100"),
]


@pytest.mark.parametrize(("text", "printed"), TEXTS, ids=[text for text, _ in TEXTS])
def test_formulas(text, printed):
    assert to_unicode(read(text, dots=True).tree, COORDINATES) == printed


def test_without_a_style_functions_are_written_out():
    assert to_unicode(Function("sin", Symbol("theta1"))) == "sin(θ₁)"


i, t = Letter("i"), Symbol("t")
LAGRANGIAN = Letter("L", style="script")
RATE = Derivative(LAGRANGIAN, Symbol("theta1", 1))
TEXTBOOK = [
    (Letter("J", sub=Row((Letter("v", sub=Number(1)),)), style="bold"), "J_v1"),
    (Letter("J", sub=Letter("omega", sub=Number(1)), style="bold"), "J_ω1"),
    (Letter("H", sub=Number(2), sup=Number(0), style="bold"), "H₂⁰"),
    (Letter("A", sub=Sum((i, Negative(Number(1))))), "Aᵢ₋₁"),
    (Letter("r", sub=Row((Letter("c"), i))), "r_ci"),
    (Letter("c", sub=Row((i, Letter("j"), Letter("k")))), "cᵢⱼₖ"),
    (Letter("d", sub=Row((Number(1), Words(","), Number(2)))), "d_{1,2}"),
    (Letter("Rot", Row((Words("z"), Words(","), Letter("theta", i))), style="upright"), "Rot_{z,θᵢ}"),
    (Letter("q", dots=2, style="bold"), "q\u0308"),
    (Letter("I", sub=Number(1), style="bold script"), "𝓘₁"),
    (LAGRANGIAN, "ℒ"),
    (Letter("K", style="script"), "𝒦"),
    (Letter("P", style="script"), "𝒫"),
    (Transpose(Letter("J", sub=Letter("v"))), "J_vᵀ"),
    (Transpose(Letter("R", sub=Number(1), sup=Number(0))), "(R₁⁰)ᵀ"),
    (Transpose(Product((Symbol("A"), Symbol("B")))), "(A B)ᵀ"),
    (Cross(Letter("z", Number(0)), Sum((Symbol("a"), Symbol("b")))), "z₀ × (a + b)"),
    (Cross(Letter("z"), Parenthesized(Sum((Symbol("a"), Symbol("b"))))), "z × (a + b)"),
    (Cross(Symbol("a"), Cross(Symbol("b"), Symbol("c"))), "a × (b × c)"),
    (RATE, "∂ℒ/∂θ\u0307₁"),
    (Derivative(RATE, t, total=True), "d/dt (∂ℒ/∂θ\u0307₁)"),
    (Derivative(None, t, total=True), "d/dt"),
    (Derivative(Symbol("x"), t, total=True), "dx/dt"),
    (Product((Derivative(Quotient(Symbol("a"), Symbol("b")), t, True), Symbol("c"))), "(d/dt (a/b)) c"),
    (Integral(Product((Symbol("rho"), Symbol("x"))), Symbol("x"), Number(0), Symbol("l")), "∫₀^l ρ x dx"),
    (BigSum(Product((Letter("m", i), Symbol("g"))), i, Number(1), Letter("n")), "Σᵢ₌₁ⁿ mᵢ g"),
    (BigSum(Sum((Letter("K", i), Symbol("g"))), i, Number(1), Number(12)), "Σᵢ₌₁¹² (Kᵢ + g)"),
    (Matrix(((Number(1, 2), Symbol("a")), (Number(0), Negative(Symbol("b"))))), "[[½, a], [0, -b]]"),
    (equation(Symbol("a"), Symbol("b"), Number(1)), "a = b = 1"),
    (Product((Negative(Symbol("a")), Symbol("b"))), "-a b"),
    (Product((Negative(Quotient(Symbol("a"), Symbol("b"))), Symbol("c"))), "-(a/b) c"),
    (Words("no mass"), "no mass"),
    (Words("\x1b[2J\u202e"), "\ufffd[2J\ufffd"),
    (Degrees(100, 3), "(100/3)°"),
]


@pytest.mark.parametrize(("tree", "printed"), TEXTBOOK, ids=[printed for _, printed in TEXTBOOK])
def test_formulas_of_the_textbook(tree, printed):
    assert to_unicode(tree, COORDINATES) == printed


def test_the_star_is_shown_where_it_is_asked_for():
    tree = Power(Symbol("L2", 1, star=True), Number(2))
    assert to_unicode(tree) == "L\u0307₂²"
    assert to_unicode(tree, Style(star=True)) == "L\u0307₂⋆²"


@pytest.mark.parametrize(
    ("text", "shown"),
    [("15.696", "15.696"), ("0.078125", "0.078125"), ("1/3", "0.333333"), ("0.1234567", "0.123457"),
     ("0.9999996001", "1.00000"), ("123456789/1000", "123457")],
)  # fmt: skip
def test_decimals_that_end_soon_are_not_rounded(text: str, shown: str) -> None:
    value, style = Fraction(text), Style(decimal=True, digits=6)
    number = Number(value.numerator, value.denominator)
    assert to_unicode(number, style) == shown
    assert style.rounds(number) == (Fraction(shown) != value)


@pytest.mark.parametrize(
    ("text", "shown"), [("1/3", "m/3"), ("0.1234567", "0.123457 m"), ("1/1001", "0.000999001 m")]
)
def test_beside_letters_a_short_fraction_stays_one(text: str, shown: str) -> None:
    style = Style(decimal=True, digits=6, fractions=True)
    assert to_unicode(times(Fraction(text), [(Symbol("m"), 1)], decimal=True), style) == shown


def test_decimals_where_they_are_asked_for():
    tree = Product((Number(981, 100), Symbol("m1")))
    assert to_unicode(tree, Style(decimal=True)) == "9.81 m₁"


WIDTHS = [("", 0), ("abc", 3), ("θ\u0307₁", 2), ("L\u0308₂²", 3), ("ℒ", 1), ("｜", 2), ("∂ℒ/∂θ\u0307₁", 6)]


@pytest.mark.parametrize(("text", "columns"), WIDTHS)
def test_width(text, columns):
    assert width(text) == columns


def test_printable_leaves_plain_text_alone():
    assert printable("m₁ g") == "m₁ g"


@given(trees)
def test_any_tree_is_printed_on_one_line_with_balanced_parentheses(tree):
    text = to_unicode(tree, COORDINATES)
    assert text.isprintable()
    assert text.count("(") == text.count(")")
    assert "--" not in text


@given(trees)
@settings(suppress_health_check=[HealthCheck.filter_too_much], max_examples=200)
def test_the_eye_reads_the_value_of_the_tree(tree):
    try:
        value = tree_value(tree)
    except ZeroDivisionError:
        assume(False)
    for style in (Style(), Style(decimal=True)):
        for tight in (False, True):
            eye = Eye(to_unicode(tree, style), tight)
            assert eye.sum() == value
            assert not eye.pieces
