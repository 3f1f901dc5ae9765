"""The terminal: colours and strokes."""

from __future__ import annotations

import pytest

from dynsolve.document import Document, Fold, Formula, Heading, List, Note, Table, Text
from dynsolve.explain.writing import side_by_side
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.template import formula
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    ZERO,
    Derivative,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.notation.unicode import to_unicode, width
from dynsolve.render.latex import LatexPrinter
from dynsolve.render.page import in_line
from dynsolve.render.terminal import break_sum, render
from dynsolve.render.terminal_boxes import entry_equations
from tests.support import document, solved

# -- documents in a terminal: nothing runs over, nothing is broken inside a matrix -------------------


LIBRARY = ["in3140-rp", "planar-2r", "rp-vertical", "numeric-2r", "puma560-first3"]


def lines(*blocks: object, columns: int = 80) -> list[str]:
    return [line.text for line in render(Document(blocks), columns)]  # type: ignore[arg-type]


def tree(text: str) -> Node:
    return read(text).tree


def matrix(*rows: str) -> Matrix:
    return Matrix(tuple(tuple(map(tree, row.split(", "))) for row in rows))


def test_a_matrix_stands_in_brackets_level_with_its_name() -> None:
    shown = lines(Formula(equation(Letter("D"), matrix("m1 + m2, 0", "0, m2"))))
    assert shown == ["    D = ⎡m₁ + m₂  0 ⎤", "        ⎣   0     m₂⎦", ""]


def test_a_row_needs_no_tall_brackets() -> None:
    assert lines(Formula(matrix("a, b, c"))) == ["    [a  b  c]", ""]


def test_a_transpose_stands_at_the_top() -> None:
    shown = lines(Formula(Product((Transpose(matrix("a", "b")), matrix("a", "b")))))
    assert shown == ["    ⎡a⎤ᵀ ⎡a⎤", "    ⎣b⎦  ⎣b⎦", ""]


def test_a_chain_that_does_not_fit_has_a_member_a_line() -> None:
    wide = matrix(", ".join(["abcd*efgh"] * 4), ", ".join(["0"] * 4))
    shown = lines(Formula(equation(Letter("H"), Product((wide, wide)), wide)), columns=100)
    row = "⎡abcd efgh  abcd efgh  abcd efgh  abcd efgh⎤"
    assert [line.rstrip() for line in shown[::2]] == [f"    H = {row} {row}", f"      = {row}", ""]


def test_equations_on_one_line_that_do_not_fit_go_on_below_after_a_comma() -> None:
    unit = matrix("1, 0", "0, 1")
    matrices = side_by_side([equation(Letter("A", Number(k)), unit) for k in (1, 2, 3)])
    assert lines(Formula(matrices), columns=35) == [
        "    A₁ = ⎡1  0⎤, A₂ = ⎡1  0⎤,",
        "         ⎣0  1⎦       ⎣0  1⎦",
        "",
        "    A₃ = ⎡1  0⎤",
        "         ⎣0  1⎦",
        "",
    ]


def test_a_matrix_too_wide_is_given_entry_by_entry() -> None:
    long = " + ".join(f"m{i}*l{i}*cos(q{i})" for i in range(1, 8))
    shown = lines(Formula(equation(Letter("D"), matrix(f"{long}, x", "x, 0"))), columns=80)
    assert shown[0].startswith("    D₁₁ = m₁ l₁ cos(q₁) + ")
    assert "    D₁₂ = D₂₁ = x" in shown
    assert "    D₂₂ = 0" in shown


def test_matrices_without_a_letter_that_are_equal_and_too_wide_are_equated_entry_by_entry() -> None:
    long = " + ".join(f"m{i}*l{i}*cos(q{i})" for i in range(1, 8))
    shown = lines(Formula(equation(matrix(long, "x"), matrix("a", "b"))), columns=100)
    assert " ".join(" ".join(shown).split()) == f"{to_unicode(tree(long))} = a x = b"


def test_names_of_entries_are_used() -> None:
    long = " + ".join(f"m{i}*l{i}*cos(q{i})" for i in range(1, 8))
    names = ((Letter("tau", Number(1)),), (Letter("f", Number(2)),))
    shown = lines(Formula(equation(Letter("tau"), matrix(long, "x")), entries=names))
    assert "    f₂ = x" in shown


def test_an_optional_formula_is_left_out_where_it_does_not_fit() -> None:
    long = " + ".join(f"m{i}*l{i}*cos(q{i})" for i in range(1, 8))
    node = Product((matrix(f"{long}, x"), matrix("a", "b")))
    assert lines(Formula(node, optional=True)) == []
    assert lines(Formula(node, optional=True), columns=200) != []


def test_the_source_stands_at_the_right() -> None:
    (line, _) = lines(Formula(equation(Letter("L"), tree("K - P")), "Spong et al. 7.1"))
    assert line.startswith("    L = K - P  ") and line.endswith("(Spong et al. 7.1)") and width(line) == 80


def test_every_kind_of_block() -> None:
    shown = lines(
        Heading("Title", 1),
        Heading("Part"),
        Text(("Look at ", Letter("H", Number(1), Number(0)), " here.")),
        List((("one",), ("two",))),
        Note(("mind this",)),
        Table(("i", Letter("theta")), (("1", tree("theta1 + 90deg")),)),
        Fold("More", (Text(("inside",)),)),
    )
    text = "\n".join(shown)
    for piece in (
        "Title\n═════",
        "Part\n────",
        "Look at H₁⁰ here.",
        "• one",
        "Note: mind this",
        "1   θ₁ + 90°",
    ):
        assert piece in text
    assert "More\ninside" in text


def test_prose_is_wrapped_between_words_and_not_inside_a_formula() -> None:
    formula = equation(Letter("D"), tree("m1*l1 + m2*l2"))
    for columns in range(40, 70):
        shown = lines(
            Text(("some words before the formula ", formula, ", and some after it.")), columns=columns
        )
        assert any("D = m₁ l₁ + m₂ l₂" in line for line in shown)
        assert all(width(line) <= columns for line in shown)


def test_a_sum_is_broken_outside_its_parentheses() -> None:
    assert break_sum("a b (c + d + e) + f (g + h + i) + j (k + l)", 20, 20) == [
        "a b (c + d + e)",
        "+ f (g + h + i)",
        "+ j (k + l)",
    ]


def test_escape_codes_do_not_reach_the_terminal() -> None:
    assert not any("\x1b" in line for line in lines(Heading("bad \x1b[31m title"), Text(("\x1b]0;x\x07",))))


@pytest.mark.parametrize("columns", [60, 80, 132])
@pytest.mark.parametrize("stem", LIBRARY)
def test_no_line_of_a_solution_runs_over_and_no_matrix_is_text(stem: str, columns: int) -> None:
    shown = [line.text for line in render(document(stem), columns, solved(stem).style)]
    assert not [text for text in shown if width(text) > columns]
    assert not [text for text in shown if "[[" in text]
    following = zip(shown, shown[1:], shown[2:], strict=False)  # words lead to a display
    alone = [text for text, gap, after in following if text[-1:] == ":" and not gap and after[:1] > " "]
    assert not alone


def test_of_a_chain_the_member_that_does_not_fit_is_left_out() -> None:
    long = " + ".join(f"m{i}*l{i}*cos(q{i})" for i in range(1, 8))
    product = Product((matrix(f"{long}, x"), matrix("a", "b")))
    node = equation(Letter("v"), product, matrix("c", "d"))
    assert lines(Formula(node)) == lines(Formula(node, optional=True))
    assert lines(Formula(node)) == lines(Formula(equation(Letter("v"), matrix("c", "d"))))


def test_a_transposed_matrix_that_is_too_wide_is_written_row_after_row() -> None:
    wide = Transpose(matrix(*([", ".join(["a1 + b1*c1 + d1*e1"] * 5)] * 2)))
    q = Letter("q", None, None, "bold")
    shown = lines(Formula(equation(q, Product((wide, q)))), columns=60)
    assert max(map(width, shown)) <= 60
    letters = "".join("".join(line.split()) for line in shown)
    assert letters.count("a₁+b₁c₁+d₁e₁") == 10 and letters.endswith("]]ᵀq")


# -- fractions among words, and entries that are zero ------------------------------------------------


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
        return [to_unicode(chain) for chain in entry_equations(of, left, formula, PLAIN)]

    assert texts(D) == ["D₁₁ = a", "D₁₂ = D₂₁ = D₂₂ = 0"]
    assert texts(Sum((D, Negative(D)))) == ["(D - D)₁₁ = a", "every other entry = 0"]
    assert texts(Sum((D, Negative(D))), Matrix(((ZERO,), (ZERO,)))) == ["(D - D)₁ = (D - D)₂ = 0"]


@pytest.mark.parametrize(
    ("text", "told"),
    [("det (𝐀 𝐁) = det {wide}", ["det (A B) = det M", "M₁₁ = "]), ("det 𝐀 = det {wide}", ["A₁₁ = "])],
)
def test_a_wide_matrix_within_a_formula_is_named_apart(text: str, told: list[str]) -> None:
    wide = matrix("abcdefgh + ijklmnop, 0", "0, abcdefgh - ijklmnop")
    shown = [line for line in lines(Formula(formula(text, wide=wide)), columns=44) if line.strip()]
    assert all(line.strip().startswith(start) for line, start in zip(shown, told, strict=False))


def test_matrices_in_a_parenthesis_that_is_too_wide_are_left_out() -> None:
    wide = matrix("a1 + b1*c1 + d1*e1", "m1*l1*cos(q1)")
    node = equation(Letter("v"), Product((Number(2), Parenthesized(Sum((wide, wide, wide, wide))))))
    assert lines(Formula(node, optional=True)) == []
