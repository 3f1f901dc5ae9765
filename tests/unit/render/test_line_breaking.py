"""Formulas in pieces, and the lines that are made of them."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dynsolve.document import Document, Formula
from dynsolve.notation.extent import Ruler
from dynsolve.notation.markup import LatexPrinter, TypstPrinter
from dynsolve.notation.text import read
from dynsolve.notation.tree import Letter, Matrix, Number, Product, Relation, Symbol, equation
from dynsolve.render.latex import latex_notation, render_fragment
from dynsolve.render.line_breaking import FormulaSplitter, Piece, lines, together
from dynsolve.render.typesetting import INDENT, INSIDE, Typesetter
from dynsolve.render.typst import typst_notation

LONG = "m1*(a1 + b1 + c1*(d1 + e1 + f1 + g1 + h1 + i1 + j1 + k1) + l1)*q1 + m2*(a2 + b2)/2 + (a3 + b3)^2"


def splitter() -> FormulaSplitter:
    return FormulaSplitter(latex_notation(LatexPrinter()), Ruler())


def setter(room: float) -> Typesetter:
    return Typesetter(latex_notation(LatexPrinter()), Ruler(), room)


pieces = st.lists(
    st.builds(Piece, st.just("x"), st.floats(0.5, 9), st.integers(0, 7)), min_size=1, max_size=40
)


@given(pieces, st.floats(10, 40))
def test_lines_keep_every_piece_in_order_and_fit(parts: list[Piece], room: float) -> None:
    broken = lines(parts, room, room - 1)
    assert [piece for line in broken for piece in line] == parts
    for place, line in enumerate(broken):
        assert sum(piece.width for piece in line) <= (room if place == 0 else room - 1) + 1e-9


@given(pieces)
def test_joined_pieces_are_the_same_formula(parts: list[Piece]) -> None:
    joined = together(parts, 12, "".join)
    assert "".join(piece.text for piece in joined) == "x" * len(parts)
    assert abs(sum(p.width for p in joined) - sum(p.width for p in parts)) < 1e-6
    assert all(piece.width <= 12 or piece.text == "x" for piece in joined)


def bare(text: str) -> str:
    """A formula without blanks and the sizes of its parentheses."""
    return re.sub(r"\{\}| |\\left|\\right|\\[bB]ig[lr]", "", text)


def test_pieces_are_the_formula() -> None:
    node = read(LONG).tree
    text = " ".join(piece.text for piece in splitter().pieces(node))
    assert bare(text) == bare(LatexPrinter().text(node))


@pytest.mark.parametrize("terms", [1, 30])
def test_parentheses_are_larger_than_those_in_them(terms: int) -> None:
    """Also where they are written for a line that may end in them."""
    inner = " + ".join(f"e{k}" for k in range(terms))
    node = read(f"m1*(a1 + b1*(c1 + d1*(f1 + {inner})))").tree
    shown = render_fragment(Document((Formula(node),))).partition(r"\begin{")[2]
    assert re.findall(r"(\\[bB]igl)?\(", shown) == [r"\Bigl", r"\bigl", ""]
    assert re.findall(r"(\\[bB]igr)?\)", shown) == ["", r"\bigr", r"\Bigr"]


def test_a_denominator_that_fits_no_line_stands_behind_a_slash() -> None:
    node = read("-(a + b)/(m1*q1^2 + (I1 + I2)*c)").tree
    setting = [FormulaSplitter(latex_notation(LatexPrinter()), Ruler(), 6, most) for most in (5, 50)]
    broken, whole = ["".join(piece.text for piece in one.pieces(node)) for one in setting]
    assert r"\frac" not in broken and ")/(" in bare(broken)
    assert r"\frac" in whole


def test_a_numerator_that_a_line_has_room_for_stands_above_as_a_whole() -> None:
    """And not 1/(9c) alone, with what else is above behind it."""
    node = read("b*(m2*(3*l1*l2 + l2^2) + 9*I2)/(9*c)").tree
    setting = [FormulaSplitter(latex_notation(LatexPrinter()), Ruler(), 6, most) for most in (8, 32)]
    broken, whole = ["".join(piece.text for piece in one.pieces(node)) for one in setting]
    assert r"\frac{1}" in broken
    assert whole == LatexPrinter().text(node)


def test_a_short_formula_stands_on_one_line() -> None:
    node = equation(Symbol("P1"), read("m1*g*l1").tree)
    assert [line.right for line in setter(30).set(Formula(node))] == ["P_{1} = m_{1} g l_{1}"]


def test_a_long_sum_is_broken_before_its_signs() -> None:
    node = equation(Symbol("tau1"), read(LONG).tree)
    broken = setter(20).set(Formula(node))
    assert len(broken) > 2
    assert broken[0].left == r"\tau_{1}"
    assert all(line.right.startswith(("{} +", "{} -", "{} =")) for line in broken)
    assert all(bool(line.indent) for line in broken[1:])


def test_lines_that_begin_a_member_are_level_and_others_are_moved_in() -> None:
    chain = equation(Symbol("c"), Symbol("d"), read("+".join(f"a{i}" for i in range(12))).tree)
    for room in (8, 12, 20):
        broken = setter(room).set(Formula(chain))
        assert len(broken) > 1
        assert all(bool(line.indent) is not line.right.startswith("{} =") for line in broken)


def test_a_wide_matrix_is_given_entry_by_entry() -> None:
    entry = read("m1*l1 + m2*l2 + m3*l3 + I1 + I2 + I3").tree
    matrix = Matrix(((entry, Number(0)), (Number(0), entry)))
    names = tuple(tuple(Symbol(f"d{i}{j}") for j in (1, 2)) for i in (1, 2))
    broken = setter(24).set(Formula(equation(Letter("D", style="bold"), matrix), entries=names))
    assert [line.left for line in broken] == ["d_{11}", "d_{12}"]
    assert broken[0].right.startswith("{} = d_{22} {} = m_{1}")
    assert broken[1].right == "{} = d_{21} {} = 0"


def test_an_optional_formula_whose_matrices_do_not_fit_is_left_out() -> None:
    entry = read("m1*l1 + m2*l2 + m3*l3 + I1 + I2 + I3").tree
    node = equation(Letter("x"), Matrix(((entry, entry),)))
    assert setter(24 - INDENT).set(Formula(node, optional=True)) == []


def test_equations_in_one_display_keep_their_signs() -> None:
    node = Relation((Symbol("q1"), read("2*l1/3").tree, Number(667, 1000)), ("=", "≈"))
    (line,) = setter(30).equations([node])
    assert (line.left, line.right.count("="), line.right.count(r"\approx")) == ("q_{1}", 1, 1)


def typst_setter(room: float) -> Typesetter:
    return Typesetter(typst_notation(TypstPrinter()), Ruler(), room)


def test_a_line_ends_outside_parentheses_where_what_they_hold_fits() -> None:
    node = equation(Symbol("K1"), read("(a1 + b1*c1 + d1*e1)*f1 + (a2*b2 + c2*d2 + e2*f2)*g2*h2").tree)
    first, second = setter(19).set(Formula(node))
    assert first.right.endswith("f_{1}")
    assert second.right.startswith("{} + (")
    assert second.indent == INDENT


def test_a_line_that_begins_in_parentheses_is_moved_in_further() -> None:
    node = equation(Symbol("K1"), read("2*(a1*b1*c1 + d1*e1*f1 + a2*b2*c2 + d2*e2*f2 + (g1 + h1)*k1)").tree)
    _, *others = setter(16).set(Formula(node))
    assert [line.indent for line in others] == [INDENT + INSIDE] * len(others)


def test_a_term_that_takes_several_lines_shares_none_with_a_term_beside_it() -> None:
    wide = "(a1*b1*c1 + d1*e1*f1 + a2*b2*c2 + d2*e2*f2)*k1"
    for sides in (f"x1*y1 + {wide} + z1", f"{wide} + x1*y1 + z1"):
        texts = [line.right for line in setter(16).set(Formula(equation(Symbol("K1"), read(sides).tree)))]
        inside = [text for text in texts if text.count("(") != text.count(")")]
        assert len(inside) == 2
        assert not any("x_" in text or "z_" in text for text in inside)


def test_what_takes_many_lines_in_parentheses_is_broken_at_their_outermost_signs() -> None:
    wide = "(a1*b1*c1 + d1*e1*f1 + a2*b2*c2 + d2*e2*f2)*k1"
    node = equation(Symbol("K1"), read(f"2*({wide} + (x1*x2 + y1*y2)*k2 + (z1*z2 + w1*w2)*k3)").tree)
    texts = [line.right.strip("{} ") for line in setter(18).set(Formula(node))]
    assert [text[:9] for text in texts if text.startswith("+ (")] == ["+ (x_{1} ", "+ (z_{1} "]


def test_each_sign_of_a_chain_begins_a_line_where_one_line_is_too_short() -> None:
    long = [read("*".join(f"{letter}{i}" for i in range(1, 7))).tree for letter in "abc"]
    broken = setter(15).set(Formula(equation(Symbol("P1"), *long)))
    assert [line.right.count("=") for line in broken] == [1, 1, 1]
    names = equation(Symbol("d12"), Symbol("d21"), long[0])
    (line,) = setter(15).set(Formula(names))
    assert line.right.count("=") == 2, "but not the sign after a name"


def test_a_product_of_matrices_that_is_broken_has_its_sign() -> None:
    wide = Matrix(((read("a1*b1*c1*d1*e1").tree,) * 2,) * 2)
    node = equation(Letter("H"), Product((wide, wide)))
    broken = typst_setter(17).set(Formula(node))
    assert ["dot.op" in line.right for line in broken] == [False, True]


def test_parentheses_on_different_lines_are_one_size_and_no_smaller_than_those_in_them() -> None:
    inner = "(m1*a1^2/2 + b1*c1*(d1 - e1/2)^2 + f1*g1*h1*i1*j1)*k1^2"
    node = equation(Symbol("K1"), read(f"m2*(({inner} + {inner.replace('1', '3')})*q1 + a2)").tree)
    text = " ".join(line.right for line in typst_setter(24).set(Formula(node)))
    open_ones: list[float] = []
    sizes = re.findall(r"lr\(size: #([\d.]+)em, \\([()])\)", text)
    assert len(sizes) >= 6
    for size, side in sizes:
        if side == "(":
            assert not open_ones or float(size) <= open_ones[-1]
            open_ones.append(float(size))
        else:
            assert float(size) == open_ones.pop()
    assert open_ones == []


def test_names_of_a_chain_stand_together_on_as_few_lines_as_hold_them() -> None:
    names = [Symbol(f"a{k}") for k in range(12)]
    lines = [line.alone for line in setter(12.0).equations([equation(*names)])]
    assert len(lines) <= 3
    assert sum(line.count("=") for line in lines) == 11


def test_an_equation_among_others_whose_left_side_is_wide_is_broken_on_both_sides() -> None:
    node = equation(read(LONG).tree, read(LONG).tree)
    ruler = Ruler()
    found = setter(20).equations([node])
    assert len(found) > 4
    assert all(ruler.width(node) > 20 >= line.width for line in found)
    assert sum(line.right.startswith("{} =") for line in found) == 1
