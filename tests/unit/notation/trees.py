"""Random trees, and their exact values by two readings that share nothing with the readers under test."""

from __future__ import annotations

import ast
import random
from fractions import Fraction
from functools import reduce
from operator import add, mul

from hypothesis import strategies as st

from dynsolve.notation import tree
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

A, B, C, TWO = Symbol("a"), Symbol("b"), Symbol("c"), Number(2)

ONE_OF_EACH: list[tuple[Node, tuple[Node, ...]]] = [
    (Number(1, 2), ()),
    (tree.Degrees(90), ()),
    (A, ()),
    (tree.Reference("I1", 1, 3), ()),
    (Sum((A, B, TWO)), (A, B, TWO)),
    (Product((A, B)), (A, B)),
    (tree.Quotient(A, B), (A, B)),
    (Power(A, TWO), (A, TWO)),
    (tree.Negative(A), (A,)),
    (tree.Function("sin", A), (A,)),
    (tree.Arguments((A, B)), (A, B)),
    (tree.Matrix(((A, B), (C, TWO))), (A, B, C, TWO)),
    (tree.Letter("J", A, B, "bold"), (A, B)),
    (tree.Letter("J", None, B), (B,)),
    (tree.Letter("D"), ()),
    (tree.Entry(A, B), (A, B)),
    (tree.Row((A, B)), (A, B)),
    (tree.Words("and"), ()),
    (tree.Transpose(A), (A,)),
    (tree.Cross(A, B), (A, B)),
    (tree.Derivative(A, B), (A, B)),
    (tree.Derivative(None, B, total=True), (B,)),
    (tree.BigSum(A, B, TWO, C), (A, B, TWO, C)),
    (tree.Integral(A, B, TWO, C), (A, B, TWO, C)),
    (tree.Parenthesized(A), (A,)),
    (tree.Slashed(A), (A,)),
    (tree.Relation((A, B, C), ("=", "≈")), (A, B, C)),
]
"""A node of each class, and its parts."""

NAMES = ["a", "m1", "theta1", "lc2", "I1zz", "lambda", "None", "load", "q_1", "E"]
FUNCTIONS = ["sin", "cos", "tan", "sqrt"]

numbers = st.builds(
    lambda value: Number(value.numerator, value.denominator),
    st.fractions(min_value=0, max_value=50, max_denominator=100),
)
symbols = st.builds(Symbol, st.sampled_from(NAMES), st.integers(0, 2))
undegreed = st.one_of(symbols, symbols, numbers)
leaves = undegreed | st.builds(Degrees, st.integers(0, 360), st.integers(1, 4))
exponents = st.one_of(
    st.builds(Number, st.integers(0, 4)),
    st.builds(lambda p: Negative(Number(p)), st.integers(1, 3)),
)


def _grow(parts):
    several = st.lists(parts, min_size=2, max_size=3).map(tuple) | st.tuples(parts)
    return st.one_of(
        st.builds(Sum, several),
        st.builds(Product, several),
        st.builds(Quotient, parts, parts),
        st.builds(Product, several.map(lambda factors: (Negative(factors[0]), *factors[1:]))),
        st.builds(Power, parts, exponents),
        st.builds(Negative, parts),
        st.builds(Function, st.sampled_from(FUNCTIONS), parts),
        st.builds(Parenthesized, parts),
    )


trees = _grow(_grow(leaves | _grow(leaves)))
rational_trees = _grow(_grow(undegreed | _grow(undegreed)))
"""Trees without degrees, which Python text gives in radians to double precision."""


def symbol_value(name: str) -> Fraction:
    """Some value for a symbol, of a numerator that makes accidents unlikely."""
    source = random.Random(name)
    return Fraction(source.randint(2, 10**6), source.randint(2, 10**6))


def function_value(name: str, argument: Fraction) -> Fraction:
    """Some value for a function at an argument: equal arguments have equal values, no more is needed."""
    return symbol_value(f"{name} of {argument}")


def python_identifier(symbol: Symbol) -> str:
    name = symbol.name + ["", "_dot", "_ddot"][symbol.dots]
    return name + "_" if name in ("lambda", "None") else name


def tree_value(node: Node) -> Fraction:
    """The value of a tree; ZeroDivisionError where it has none."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Degrees(p, q):
            return Fraction(p, q) * symbol_value("pi") / 180
        case Symbol():
            return symbol_value(python_identifier(node))
        case Sum(terms):
            return reduce(add, map(tree_value, terms))
        case Product(factors):
            return reduce(mul, map(tree_value, factors))
        case Quotient(numerator, denominator):
            return tree_value(numerator) / tree_value(denominator)
        case Power(base, exponent):
            return tree_value(base) ** int(tree_value(exponent))
        case Negative(argument):
            return -tree_value(argument)
        case Function(name, argument):
            return function_value(name, tree_value(argument))
        case Parenthesized(argument):
            return tree_value(argument)
    raise AssertionError(node)


def python_value(text: str) -> Fraction:
    """The exact value of a text as Python's own grammar reads it."""
    return _ast_value(ast.parse(text, mode="eval").body)


def _ast_value(node: ast.expr) -> Fraction:
    match node:
        case ast.Constant(value):
            return Fraction(str(value))
        case ast.Name(name):
            return symbol_value(name)
        case ast.UnaryOp(ast.USub(), operand):
            return -_ast_value(operand)
        case ast.Call(ast.Name(name), [argument]):
            return function_value(name, _ast_value(argument))
        case ast.BinOp(left, ast.Add(), right):
            return _ast_value(left) + _ast_value(right)
        case ast.BinOp(left, ast.Sub(), right):
            return _ast_value(left) - _ast_value(right)
        case ast.BinOp(left, ast.Mult(), right):
            return _ast_value(left) * _ast_value(right)
        case ast.BinOp(left, ast.Div(), right):
            return _ast_value(left) / _ast_value(right)
        case ast.BinOp(left, ast.Pow(), right):
            return _ast_value(left) ** int(_ast_value(right))
    raise AssertionError(ast.dump(node))
