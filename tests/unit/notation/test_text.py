"""Plain-text formulas: what is read, and what is said about what is not."""

from __future__ import annotations

import random
import time

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from dynsolve.errors import ReadError
from dynsolve.notation.text import Name, read
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

a, b, c, d, x = map(Symbol, "abcdx")


def n(p, q=1):
    return Number(p, q)


def sqrt(argument):
    return Function("sqrt", argument)


READ = [
    # numbers are exact
    ("0", n(0)),
    ("007", n(7)),
    ("9.81", n(981, 100)),
    ("0.50", n(1, 2)),
    (".5", n(1, 2)),
    ("5.", n(5)),
    ("1e-3", n(1, 1000)),
    ("2.5E+2", n(250)),
    ("1e5", n(100000)),
    # angles
    ("90deg", Degrees(90)),
    ("90°", Degrees(90)),
    ("90 deg", Degrees(90)),
    ("22.5deg", Degrees(45, 2)),
    ("-90deg", Negative(Degrees(90))),
    ("pi/2", Quotient(Symbol("pi"), n(2))),
    ("π/2", Quotient(Symbol("pi"), n(2))),
    # names
    ("θ1", Symbol("theta1")),
    ("theta₁", Symbol("theta1")),
    ("lambda", Symbol("lambda")),
    ("theta1_dot", Symbol("theta1_dot")),
    ("E", Symbol("E")),
    # sums and products lie flat, in the order of the text
    ("a+b-c", Sum((a, b, Negative(c)))),
    ("a - (b - c)", Sum((a, Negative(Sum((b, Negative(c))))))),
    ("(a+b)+c", Sum((Sum((a, b)), c))),
    ("a*b*c", Product((a, b, c))),
    ("a·b×c", Product((a, b, c))),
    ("a/b*c", Product((Quotient(a, b), c))),
    ("a*b/c", Quotient(Product((a, b)), c)),
    ("a/b/c", Quotient(Quotient(a, b), c)),
    ("a/(b*c)", Quotient(a, Product((b, c)))),
    # signs
    ("-a*b", Negative(Product((a, b)))),
    ("-a/b", Negative(Quotient(a, b))),
    ("+a", a),
    ("a*-b", Product((a, Negative(b)))),
    ("a--b", Sum((a, Negative(Negative(b))))),
    ("a − b", Sum((a, Negative(b)))),
    # powers
    ("x^2", Power(x, n(2))),
    ("x**2", Power(x, n(2))),
    ("x²", Power(x, n(2))),
    ("x⁻²", Power(x, Negative(n(2)))),
    ("x^-2", Power(x, Negative(n(2)))),
    ("-x^2", Negative(Power(x, n(2)))),
    ("-x²", Negative(Power(x, n(2)))),
    ("(-x)^2", Power(Negative(x), n(2))),
    ("2^3^2", Power(n(2), n(9))),
    ("x^(4/2)", Power(x, n(2))),
    ("x^20", Power(x, n(20))),
    ("a*b^2", Product((a, Power(b, n(2))))),
    # roots and functions
    ("sqrt(2)", sqrt(n(2))),
    ("x^(1/2)", sqrt(x)),
    ("x^0.5", sqrt(x)),
    ("√2*x", Product((sqrt(n(2)), x))),
    ("x^1/2", Quotient(Power(x, n(1)), n(2))),
    ("sin(a)", Function("sin", a)),
    ("cos (a + b)", Function("cos", Sum((a, b)))),
    ("sin(a)^2", Power(Function("sin", a), n(2))),
    ("sin^2(a)", Power(Function("sin", a), n(2))),
    ("cos²(a)", Power(Function("cos", a), n(2))),
    # space
    ("\ta\n*\u00a0b ", Product((a, b))),
]


@pytest.mark.parametrize(("text", "tree"), READ, ids=[text for text, _ in READ])
def test_reads(text, tree):
    assert read(text).tree == tree


def starred(name):
    return Symbol(name, 0, True)


STARS = [
    ("theta1*", starred("theta1")),
    ("θ1*", starred("theta1")),
    ("theta1* + 90deg", Sum((starred("theta1"), Degrees(90)))),
    ("theta1* - 90deg", Sum((starred("theta1"), Negative(Degrees(90))))),
    ("p2* - p1*", Sum((starred("p2"), Negative(starred("p1"))))),
    ("-L2*", Negative(starred("L2"))),
    ("(q1*)", starred("q1")),
    ("q1*/2", Quotient(starred("q1"), n(2))),
    ("2*q1*", Product((n(2), starred("q1")))),
    ("q1* * 2", Product((starred("q1"), n(2)))),
    ("a*b", Product((a, b))),
    ("a*2", Product((a, n(2)))),
    ("a*(b)", Product((a, b))),
    ("a*90deg", Product((a, Degrees(90)))),
    ("a**2", Power(a, n(2))),
    ("a * b", Product((a, b))),
]


@pytest.mark.parametrize(("text", "tree"), STARS, ids=[text for text, _ in STARS])
def test_the_star_marks_a_joint_variable(text, tree):
    assert read(text, stars=True).tree == tree


def test_a_star_with_a_sign_after_it_is_a_product_where_stars_mark_nothing():
    assert read("a*-b").tree == Product((a, Negative(b)))
    assert read("a*-b", stars=True).tree == Sum((starred("a"), Negative(b)))


def test_names_come_with_their_places():
    text = "θ1* + beta*pi + sin(L2)"
    assert read(text, stars=True).names == (
        Name("theta1", 0, 2, True),
        Name("beta", 6, 4),
        Name("L2", 20, 2),
    )


def test_derivatives_are_read_where_they_are_asked_for():
    assert read("theta1_dot*L2_ddot", dots=True).tree == Product((Symbol("theta1", 1), Symbol("L2", 2)))


# text, where the fault is, words of the message, words of the remedy
MISTAKES = [
    ("m1 g", 2, "a `*` is missing between `m1` and `g`", "m1*g"),
    ("2l1", 1, "a `*` is missing", "2*l1"),
    ("m1(l1+l2)", 2, "a `*` is missing", "m1*(l1+l2)"),
    ("(a)(b)", 3, "a `*` is missing", "(a)*(b)"),
    ("2 sin(x)", 1, "a `*` is missing", "2*sin(x)"),
    ("a*b c", 3, "a `*` is missing", "a*b*c"),
    ("πr", 0, "a `*` is missing", "π*r"),
    ("2 3", 1, "an operator is missing", ""),
    ("1.5.2", 3, "an operator is missing", "one point"),
    ("theta1 deg", 7, "directly after a number", "90deg"),
    ("90degrees", 2, "degrees are written `deg`", "90deg"),
    ("exp(x)", 0, "unknown function `exp`", "sin, cos, tan and sqrt"),
    ("Sin(x)", 0, "unknown function `Sin`", "did you mean `sin`"),
    ("a + coss(x)", 4, "unknown function `coss`", "did you mean `cos`"),
    ("load(x)", 0, "unknown function `load`", "load*(...)"),
    ("theta1(t)", 6, "a `*` is missing", ""),
    ("sin x", 0, "needs its argument in parentheses", "sin(x)"),
    ("sin", 0, "needs its argument in parentheses", ""),
    ("sin^-1(x)", 0, "power of `sin`", "inverse"),
    ("sin()", 3, "nothing between these parentheses", ""),
    ("sin(a, b)", 5, "`,` has no meaning", "one argument"),
    ("9,81", 1, "`,` has no meaning", "9.81"),
    ("", 0, "no formula", ""),
    (" \n", 0, "no formula", ""),
    ("a +", 2, "ends after `+`", ""),
    ("a*", 1, "ends after `*`", "the star that marks a joint variable"),
    ("-", 0, "ends after `-`", ""),
    ("*a", 0, "begins with `*`", ""),
    ("a*/b", 2, "`/` cannot follow `*`", ""),
    ("(a", 0, "never closed", ""),
    ("a*(b + (c)", 2, "never closed", ""),
    ("a)", 1, "closes nothing", ""),
    ("()", 0, "nothing between", ""),
    ("x^y", 2, "whole number", ""),
    ("x^(3/2)", 1, "whole number", "sqrt"),
    ("x^21", 1, "from -20 to 20", ""),
    ("x²¹", 1, "from -20 to 20", ""),
    ("9**9**9", 1, "from -20 to 20", ""),
    ("x^2²^3", 4, "power of a power", ""),
    ("x²^3", 2, "power of a power", ""),
    ("a = b", 2, "`=` has no meaning", "right-hand side"),
    ("[a]", 0, "`[` has no meaning", "( )"),
    ("theta1'", 6, "no meaning", "derivative"),
    ("\\theta", 0, "no meaning", "plain text"),
    ("__import__('os')", 0, "no meaning", ""),
    ("a.b", 1, "no meaning", ""),
    ("°", 0, "no meaning", "after a number"),
    ("½", 0, "U+00BD", "1/2"),
    ("\u0430", 0, "U+0430", "Latin letter `a`"),
    ("m\u0456*x", 1, "U+0456", "Latin letter `i`"),
    ("a\x00", 1, "U+0000", "delete"),
    ("a\u200bb", 1, "U+200B ZERO WIDTH SPACE", "delete"),
    ("a\u202eb", 1, "U+202E", "delete"),
    ("\ufeffa", 0, "U+FEFF", "delete"),
    ("\x1b[31m", 0, "U+001B", "delete"),
    ("θ\u03071", 1, "U+0307", "delete"),
    ("٣", 0, "U+0663", ""),
    ("1" * 61, 0, "more than 60 digits", ""),
    ("1e99999999999", 0, "more than 60 digits", ""),
    ("1e-61", 0, "more than 60 digits", ""),
]


@pytest.mark.parametrize(
    ("text", "offset", "message", "help"), MISTAKES, ids=[repr(row[0]) for row in MISTAKES]
)
def test_a_mistake_has_its_place_and_its_remedy(text, offset, message, help):
    with pytest.raises(ReadError) as caught:
        read(text)
    error = caught.value
    assert message in error.message
    assert help in error.help
    assert error.offset == offset
    assert error.length >= 1
    assert f"{error.message}{error.help}".isprintable()


HUGE = {
    "long": "a+" * 5000 + "a",
    "parentheses": "(" * 5000,
    "closed parentheses": "(" * 60 + "a" + ")" * 60,
    "functions": "sin(" * 2000,
    "signs": "-" * 9999 + "a",
    "roots": "√" * 9999,
    "power tower": "2^" * 4000 + "2",
    "tower of ones": "1^" * 4000 + "1",
    "divisions": "1/" * 4000 + "1",
    "powers of powers": "(" * 20 + "a+b" + ")^20" * 20,
    "numbers of powers": "(" * 20 + "9" + ")^20" * 20,
    "products of sums": "*".join(["(a+b+c+d)"] * 12),
    "terms of a power": "(a+b+c+d+e+f)^20",
    "exponent of powers": "x^(" * 30 + "9" + "^9)" * 30,
    "exponent": "x^" + "9" * 4400,
    "raised": "x" + "²" * 9000,
    "digits": "0." + "1" * 5000,
}


@pytest.mark.parametrize("text", HUGE.values(), ids=HUGE)
def test_what_would_cost_too_much_is_refused_at_once(text):
    began = time.process_time()
    with pytest.raises(ReadError):
        read(text)
    assert time.process_time() - began < 2  # computing any of these takes years, or all memory


def test_long_texts_within_the_bounds_are_read():
    assert len(read("+".join(["m1*l1*sin(q1)"] * 700)).tree.terms) == 700
    assert read("(" * 49 + "a" + ")" * 49).tree == a


@given(st.text(max_size=60))
@example("𝟙")
def test_any_text_is_read_or_refused(text):
    for stars in (False, True):
        try:
            read(text, stars=stars)
        except ReadError as error:
            assert 0 <= error.offset <= len(text)
            assert f"{error.message}{error.help}".isprintable()


PIECES = [
    "a",
    "theta1",
    "θ",
    "π",
    "pi",
    "2",
    "9.81",
    "90deg",
    "1e3",
    "sin",
    "sqrt",
    "(",
    ")",
    "+",
    "-",
    "*",
    "/",
]
PIECES += ["^", "**", "²", "⁻¹", "√", ",", " ", "·", "1/2", "°", "deg"]


@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join))
def test_any_row_of_tokens_is_read_or_refused(text):
    for stars in (False, True):
        try:
            read(text, stars=stars)
        except ReadError as error:
            assert 0 <= error.offset <= len(text)
            assert error.length >= 1


def test_random_bytes_are_read_or_refused():
    source = random.Random(1)
    for _ in range(200):
        text = source.randbytes(50).decode("latin-1")
        try:
            read(text)
        except ReadError as error:
            assert error.message
