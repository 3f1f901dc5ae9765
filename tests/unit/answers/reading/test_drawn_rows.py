"""Matrices whose rows stand on lines of their own, aligned or not, side by side; and entries left blank."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import checker, verdicts
from tests.unit.answers.reading.submissions import report

D = (("I1zz + m2*L2^2", "0"), ("0", "m2"))
C = (("m2*L2*L2'", "m2*L2*θ1'"), ("-m2*L2*θ1'", "0"))
g = (("0",), ("0",))
BRACKETS = ["[]", "||", "⎡⎤"]
BETWEEN = ["   ", ", ", ",   "]


def judged(text: str, file: str = "report.txt", stem: str = "in3140-rp") -> dict[str, str]:
    return verdicts(checker(stem)(report(text, file, stem)))


def drawn(rows: tuple[tuple[str, ...], ...], brackets: str, between: str) -> list[str]:
    return [f"{brackets[0]} {between.join(row)}  {brackets[1]}" for row in rows]


@pytest.mark.parametrize("brackets", BRACKETS)
@pytest.mark.parametrize("between", BETWEEN)
def test_rows_below_each_other(brackets: str, between: str) -> None:
    text = "\n\n".join(
        f"{name} = {upper}\n    {lower}"
        for name, rows in (("D", D), ("C(q,qd)", C), ("g", g))
        for upper, lower in [drawn(rows, brackets, between)]
    )
    right, wrong = judged(text), judged(text.replace("I1zz", "2*I1zz").replace("L2'", "L2''"))
    assert [right[name] for name in "DCg"] == ["correct"] * 3
    assert [wrong[name] for name in "DC"] == ["wrong"] * 2


@pytest.mark.parametrize("brackets", BRACKETS)
@pytest.mark.parametrize("between", BETWEEN)
def test_rows_side_by_side(brackets: str, between: str) -> None:
    upper, lower = zip(*(drawn(rows, brackets, between) for rows in (D, C, g)), strict=True)
    text = f"D = {upper[0]}   C = {upper[1]}   g = {upper[2]}\n    {'      '.join(lower)}\n"
    right, wrong = judged(text), judged(text.replace("I1zz", "2*I1zz"))
    assert [right[name] for name in "DCg"] == ["correct"] * 3
    assert [wrong[name] for name in "DC"] == ["wrong", "correct"]


@pytest.mark.parametrize("brackets", ["[]", "||", "()", "  "])
@pytest.mark.parametrize("head", ["D =", "D(q) :=", "Inertia: D ="])
def test_blanks_inside_entries_part_none_where_the_shape_says_so(brackets: str, head: str) -> None:
    left, right = brackets
    upper, lower = "1/2 m2 L2^2 + I1zz", "1/2 m2 L2 cos(theta1) + m1"
    text = (
        f"{head}\n{left} {upper:<27}m2 L2 cos(theta1) {right}\n"
        f"{left} {lower:<27}1/3 m2 L2^2       {right}\n\nK = m1"
    )
    found = report(text, "report.txt", "in3140-rp")
    expected = (
        "D = [[1/2 m2 L2^2 + I1zz, m2 L2 cos(theta1)], [1/2 m2 L2 cos(theta1) + m1, 1/3 m2 L2^2]]\nK = m1"
    )
    assert [(one.name, one.read_as, one.fault) for one in found.answers] == [
        (one.name, one.read_as, one.fault) for one in report(expected, "report.txt", "in3140-rp").answers
    ]


@pytest.mark.parametrize("blank", ["", "\n"])
def test_an_entry_of_a_column_may_begin_with_a_minus(blank: str) -> None:
    text = f"g =\n{blank} m2*g*sin(theta1)\n      -m2*g\n\nh =\n{blank} m2*g\n -m2*g*L2\n\nf2 = h^T h"
    expected = "g = [m2*g*sin(theta1); -m2*g]\nh = [m2*g; -m2*g*L2]\nf2 = h^T h"
    found, read = (report(one, "report.txt", "in3140-rp").answers for one in (text, expected))
    assert [(one.name, one.read_as, one.fault) for one in found] == [
        (one.name, one.read_as, one.fault) for one in read
    ]
    assert found[0].name == "g" and "h" not in found[-1].read_as


@pytest.mark.parametrize("text", [
    "K =\n m1*g\n -m2*g",
    "P =\n\n  m1*g\n  - m2*g",
    "d11 =\n      2\n m2*L2",
])  # fmt: skip
def test_lines_of_a_scalar_are_no_rows(text: str) -> None:
    (answer,) = report(text, "report.txt", "in3140-rp").answers
    assert answer.node is not None and not answer.fault


def test_lines_of_a_program_are_no_rows() -> None:
    text = (
        "D = [ I1zz + m2*L2^2  0 ; 0  m2 ]\nC(q,qd) = [ m2*L2*L2'  m2*L2*θ1' ; -m2*L2*θ1'  0 ]\ng = [0; 0]\n"
    )
    assert [judged(text)[name] for name in "DCg"] == ["correct"] * 3


def test_a_line_end_within_brackets_ends_a_row_and_dots_do_not() -> None:
    tau = "(I1zz + m2*L2^2)*θ1'' + 2*m2*L2*L2'*θ1'{}\n       (m2)*(L2'' - L2*θ1'^2)"
    assert judged(f"tau = [{tau.format('')}];")["tau"] == "correct"
    assert judged(f"tau = [{tau.format(';')}];")["tau"] == "correct"
    assert judged(f"tau = [{tau.format(' ...')}];")["tau"] != "correct"
    assert judged(f"tau = [{tau.format('').replace('(m2)', '(2*m2)')}];")["tau"] == "wrong"


@pytest.mark.parametrize("remark", ["   [Coriolis]", "  (Gravitation und Feder)", "  [sentrifugal]  "])
def test_words_in_brackets_behind_a_line_are_no_part_of_it(remark: str) -> None:
    f2 = "f2 = m2*L2'' - m2*L2*θ1'^2"
    assert judged(f2 + remark)["f2"] == "correct"
    assert judged(f2.replace("^2", "") + remark)["f2"] == "wrong"


@pytest.mark.parametrize("zero", ["", r"\cdot", " "])
def test_what_stands_for_0_beside_a_diagonal(zero: str) -> None:
    text = rf"$$D = \begin{{bmatrix}} {{}}&{zero}\\{zero}&m_2\end{{bmatrix}}$$"
    found = [judged(text.replace("{}", d11), "report.md")["D"] for d11 in ("I_{1zz}+m_2L_2^2", "m_2L_2^2")]
    assert found == ["correct", "wrong"]


@pytest.mark.parametrize("d21", [r"\cdot", "*", r"m_2(l_{c2}^2 + l_1 l_{c2} c_2) + I_2", ""])
def test_a_mark_below_the_diagonal(d21: str) -> None:
    d11 = r"m_1 l_{c1}^2 + m_2(l_1^2 + l_{c2}^2 + 2 l_1 l_{c2} c_2) + I_1 + I_2"
    d12 = r"m_2(l_{c2}^2 + l_1 l_{c2} c_2) + I_2"
    text = rf"$$D = \begin{{bmatrix}} {d11} & {d12} \\ {d21} & m_2 l_{{c2}}^2 + I_2 \end{{bmatrix}}$$"
    found = judged(text, "report.md", "planar-2r")
    if d21:
        assert found["D"] == "correct"
    else:
        entries = ("correct", "correct", "unreadable", "correct")
        assert tuple(found[name] for name in ("d11", "d12", "d21", "d22")) == entries


@pytest.mark.parametrize("between", [r",\\", r"\\", ",&", "&"])
def test_commas_beside_the_signs_of_a_matrix(between: str) -> None:
    g1, g2 = r"(m_1 l_{c1} + m_2 l_1) g c_1 + m_2 l_{c2} g c_{12}", r"m_2 l_{c2} g c_{12}"
    text = rf"$$g = \begin{{bmatrix}} {g1} {between} {{}} \end{{bmatrix}}$$"
    found = [judged(text.replace("{}", last), "report.md", "planar-2r")["g"] for last in (g2, g1)]
    assert found == ["correct", "wrong"]
