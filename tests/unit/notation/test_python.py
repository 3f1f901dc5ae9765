"""Python text: what it looks like, and that Python and the reader read the tree's value from it."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, assume, given, settings

from dynsolve.errors import ReadError
from dynsolve.notation.printing import Style
from dynsolve.notation.python import PythonPrinter, python_name, to_python
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Letter,
    Matrix,
    Negative,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from tests.unit.notation.trees import python_value, rational_trees, tree_value

a, b, c, x = map(Symbol, "abcx")
HALF = Number(1, 2)
TWO = Number(2)

PRINTED = [
    (Number(981, 100), "981/100"),
    (Symbol("theta1", 1), "theta1_dot"),
    (Symbol("theta1", 2), "theta1_ddot"),
    (Symbol("lambda"), "lambda_"),
    (Symbol("lambda", 1), "lambda_dot"),
    (Symbol("True"), "True_"),
    (Symbol("theta1", 0, True), "theta1"),
    (Degrees(90), "1.5707963267948966"),
    (Degrees(45, 2), "0.39269908169872414"),
    (Sum((a, Negative(b), c)), "a - b + c"),
    (Sum((Negative(a), Negative(b))), "-a - b"),
    (Sum((a, Negative(Sum((b, c))))), "a - (b + c)"),
    (Sum((a, Sum((Negative(b), c)))), "a - b + c"),
    (Sum((a, Product((Negative(b), c)))), "a - b*c"),
    (Sum((a, Negative(Product((Negative(b), c))))), "a - (-b*c)"),
    (Sum((a,)), "a"),
    (Sum(()), "0"),
    (Product(()), "1"),
    (Product((HALF, a)), "1/2*a"),
    (Product((a, Sum((b, c)))), "a*(b + c)"),
    (Product((a, Negative(b))), "a*(-b)"),
    (Product((Negative(a), b)), "-a*b"),
    (Quotient(Product((a, b)), TWO), "a*b/2"),
    (Quotient(Sum((a, b)), TWO), "(a + b)/2"),
    (Quotient(a, Product((b, c))), "a/(b*c)"),
    (Quotient(a, Quotient(b, c)), "a/(b/c)"),
    (Quotient(Quotient(a, b), c), "a/b/c"),
    (Quotient(a, Power(b, TWO)), "a/b**2"),
    (Quotient(a, HALF), "a/(1/2)"),
    (Quotient(a, Negative(b)), "a/(-b)"),
    (Power(x, TWO), "x**2"),
    (Power(x, Negative(TWO)), "x**(-2)"),
    (Power(HALF, TWO), "(1/2)**2"),
    (Power(Negative(x), TWO), "(-x)**2"),
    (Negative(Power(x, TWO)), "-x**2"),
    (Power(Sum((a, b)), TWO), "(a + b)**2"),
    (Power(Power(x, TWO), TWO), "(x**2)**2"),
    (Power(Function("sin", x), TWO), "sin(x)**2"),
    (Function("cos", Sum((Product((TWO, a)), b))), "cos(2*a + b)"),
    (Negative(Negative(a)), "-(-a)"),
    (Parenthesized(a), "(a)"),
    (Power(Parenthesized(Sum((a, b))), TWO), "(a + b)**2"),
    (Matrix(((a, b), (Number(0), Negative(c)))), "[[a, b], [0, -c]]"),
]


@pytest.mark.parametrize(("tree", "text"), PRINTED, ids=[text for _, text in PRINTED])
def test_prints(tree, text):
    assert to_python(tree) == text


DECIMALS = [
    (Number(981, 100), "9.81"),
    (Number(1, 8), "0.125"),
    (Number(1, 3), "1/3"),
    (Number(1, 1000), "0.001"),
    (Number(12), "12"),
    (Power(Number(1, 2), TWO), "(0.5)**2"),
]


@pytest.mark.parametrize(("tree", "text"), DECIMALS)
def test_decimals_only_where_they_are_exact(tree, text):
    assert to_python(tree, decimal=True) == text


def test_the_name_of_a_symbol():
    assert (python_name("theta1", 1), python_name("lambda")) == ("theta1_dot", "lambda_")


def test_a_letter_of_the_textbook_is_no_python():
    with pytest.raises(TypeError, match="Letter cannot be written in Python"):
        to_python(Sum((a, Letter("H"))))


def test_shared_parts_are_printed_once():
    tree = a
    for _ in range(24):
        tree = Sum((Product((tree, b)), Product((tree, c))))
        tree = Function("sin", Parenthesized(tree)) if len(to_python(tree)) > 10**6 else tree
        if isinstance(tree, Function):
            break
    printer = PythonPrinter()
    assert printer.text(tree) is printer.text(tree)
    assert printer.text(Sum((tree, tree))).count("sin(") == 2


def test_a_printer_keeps_what_it_remembers():
    printer = PythonPrinter()
    texts = {printer.text(Sum((Symbol(f"x{index}"), a))) for index in range(1000)}
    assert len(texts) == 1000  # an address that is used again would give an old text


@given(rational_trees)
@settings(suppress_health_check=[HealthCheck.filter_too_much], max_examples=200)
def test_python_reads_the_value_of_the_tree(tree):
    try:
        value = tree_value(tree)
    except ZeroDivisionError:
        assume(False)
    assert python_value(to_python(tree)) == value
    assert python_value(PythonPrinter(Style(decimal=True)).text(tree)) == value


@given(rational_trees)
@settings(suppress_health_check=[HealthCheck.filter_too_much], max_examples=200)
def test_the_reader_reads_the_value_of_the_tree(tree):
    try:
        value = tree_value(tree)
        reading = read(to_python(tree), dots=True)
    except (ZeroDivisionError, ReadError):  # 0**-1, or larger than a text may be
        assume(False)
    assert tree_value(reading.tree) == value


FORMULAS = [
    "m1*L1**2*cos(theta1 + theta2)",
    "-m2*l1*lc2*sin(q2)",
    "I1zz*theta1_dot**2/2 + m2*(L2_dot**2 + L2**2*theta1_dot**2)/2",
    "(m1*lc1 + m2*l1)*g*cos(q1) - (a - b)**2/(2*c)",
    "lambda_*sqrt(2)/(1 - x**(-2))",
]


@pytest.mark.parametrize("text", FORMULAS)
def test_what_is_read_is_printed_as_it_was(text):
    assert to_python(read(text, dots=True).tree) == text
