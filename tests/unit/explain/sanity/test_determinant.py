"""The determinant of D's coupled coordinates, from its formula to the value."""

from __future__ import annotations

import pytest

from dynsolve.algebra.ring import Expr
from dynsolve.notation.unicode import to_unicode
from tests.support import solved
from tests.unit.explain.told import said, step
from tests.unit.explain.working.evaluated import members

WITH_ONE = ("elbow-3r", "planar-2r", "planar-2r-friction", "planar-2r-remote", "rp-parameters")


def determinants(problem: str) -> list[str]:
    """The lines from the formulas of the determinants to their values."""
    style = solved(problem).style
    return [to_unicode(node, style) for node in step(problem, "definite").lines[-1].formulas]


def operations(problem: str) -> str:
    """What leads from line to line."""
    return said(step(problem, "definite").lines[-1].by, problem)


def test_the_entries_are_put_in_multiplied_out_and_collected_line_by_line() -> None:
    (line,) = determinants("elbow-3r")
    assert line.split(" = ") == [
        "d₂₂ d₃₃ - d₂₃²",
        "(d₂₂ - 2d₂₃ + d₃₃) d₃₃ - (d₂₃ - d₃₃)²",
        "(m₂ l_c2² + m₃ L₂² + I_2zz)(m₃ l_c3² + I_3zz) - (m₃ L₂ l_c3 c₃)²",
        "m₂ m₃ l_c2² l_c3² + m₂ I_3zz l_c2² + m₃² L₂² l_c3² + m₃ I_3zz L₂² + m₃ I_2zz l_c3² + I_2zz I_3zz "
        "- m₃² L₂² l_c3² c₃²",
        "m₂ m₃ l_c2² l_c3² + m₂ I_3zz l_c2² + m₃² L₂² l_c3² s₃² + m₃ I_3zz L₂² + m₃ I_2zz l_c3² "
        "+ I_2zz I_3zz",
    ]
    assert operations("elbow-3r") == (
        "With these, the entries put in, multiplied out, and collected with s₃² + c₃² = 1:"
    )


def test_differences_of_entries_have_lines_of_their_own() -> None:
    line, _ = step("elbow-3r", "definite").lines
    assert said(line.by, "elbow-3r") == (
        "Row 3 is subtracted from row 2, and then column 3 from column 2, which does not change the "
        "determinant. This replaces d₂₂ and d₂₃ by:"
    )
    assert [to_unicode(node, solved("elbow-3r").style) for node in line.formulas] == [
        "d₂₂ - 2d₂₃ + d₃₃ = m₂ l_c2² + m₃ L₂² + I_2zz",
        "d₂₃ - d₃₃ = m₃ L₂ l_c3 c₃",
    ]


def test_differences_of_entries_are_used_where_they_are_shorter_alone() -> None:
    assert " - 2d₁₂ " in determinants("planar-2r")[0]
    (plain,) = determinants("planar-2r-remote")
    assert plain.split(" = ")[1].startswith("(m₁ l_c1² + m₂ l₁² + I₁)(m₂ l_c2² + I₂) - (m₂ l₁ l_c2 cos(")


def test_a_determinant_in_numbers_is_multiplied_out_as_it_stands() -> None:
    (line,) = determinants("numeric-2r")
    assert line.split(" = ")[:2] == ["d₁₁ d₂₂ - d₁₂²", "(0.862833 + 0.48 c₂)·0.167 - (0.167 + 0.24 c₂)²"]


def test_entries_that_make_a_product_need_no_further_line() -> None:
    assert determinants("planar-2r-friction")[-1].count(" = ") == 2
    assert operations("planar-2r-friction") == "With these, the entries put in:"


@pytest.mark.parametrize("problem", WITH_ONE)
def test_every_member_is_the_determinant(problem: str) -> None:
    (result,) = step(problem, "definite").lines[-1].formulas
    values = members(solved(problem).robot.ring, result)
    assert values and all(isinstance(value, Expr) and value == values[0] for value in values)
