"""Fractions among words, and entries that are zero."""

from __future__ import annotations

import pytest

from dynsolve.document import Formula
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    ZERO,
    Derivative,
    Letter,
    Matrix,
    Negative,
    Node,
    Parenthesized,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.unicode import to_unicode
from dynsolve.render.latex import LatexPrinter
from dynsolve.render.page import in_line
from dynsolve.render.terminal_boxes import entry_equations

Q1, L, D = Symbol("q1", 1), Letter("L", style="script"), Letter("D", style="bold")


@pytest.mark.parametrize(
    ("node", "latex"),
    [
        (read("m1*l1^2/12").tree, "m_{1} l_{1}^{2}/12"),
        (read("d3 - l3/2").tree, "d_{3} - l_{3}/2"),
        (
            read("g*(m1*l1/2 + m2)*c2/3").tree,
            r"\frac{g \left( \frac{m_{1} l_{1}}{2} + m_{2} \right) c_{2}}{3}",
        ),
        (read("1/2*m1*l1^2").tree, r"\frac{1}{2} m_{1} l_{1}^{2}"),
        (equation(Symbol("d11"), read("m1*r1^2/2").tree), "d_{11} = m_{1} r_{1}^{2}/2"),
        (Derivative(L, Q1), r"\partial \mathcal{L}/\partial \dot{q}_{1}"),
        (
            Derivative(Parenthesized(Sum((L, L))), Q1),
            r"\frac{\partial}{\partial \dot{q}_{1}} (\mathcal{L} + \mathcal{L})",
        ),
    ],
)
def test_a_fraction_among_words_has_a_stroke(node: Node, latex: str) -> None:
    assert LatexPrinter().text(in_line(node)) == latex
    assert to_unicode(in_line(node)) == to_unicode(node)


def test_zeros_without_a_letter_are_told_in_words() -> None:
    a = Symbol("a")
    matrix = Matrix(((a, ZERO), (ZERO, ZERO)))
    formula = Formula(equation(D, matrix))

    def texts(left: Node, of: Matrix = matrix) -> list[str]:
        return [to_unicode(chain) for chain in entry_equations(of, left, formula)]

    assert texts(D) == ["D₁₁ = a", "D₁₂ = D₂₁ = D₂₂ = 0"]
    assert texts(Sum((D, Negative(D)))) == ["(D - D)₁₁ = a", "every other entry = 0"]
    assert texts(Sum((D, Negative(D))), Matrix(((ZERO,), (ZERO,)))) == ["(D - D)₁ = (D - D)₂ = 0"]
