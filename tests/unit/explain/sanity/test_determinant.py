"""The determinant of D's coupled coordinates, from its formula to the value."""

from __future__ import annotations

import pytest

from dynsolve.algebra.expr import Expr
from tests.support import solved
from tests.unit.explain.told import said, shown, step
from tests.unit.explain.working.evaluated import members

WITH_ONE = ("elbow-3r", "planar-2r", "planar-2r-friction", "planar-2r-remote", "rp-parameters")


def test_the_entries_are_put_in_multiplied_out_and_collected_line_by_line() -> None:
    (line,) = shown("elbow-3r", "definite")
    assert line.split(" = ") == [
        "d₂₂ d₃₃ - d₂₃²",
        "(d₂₂ - 2d₂₃ + d₃₃) d₃₃ - (d₂₃ - d₃₃)²",
        "(m₂ l_c2² + m₃ L₂² + I_2zz)(m₃ l_c3² + I_3zz) - (m₃ L₂ l_c3 c₃)²",
        "m₂ m₃ l_c2² l_c3² + m₂ I_3zz l_c2² + m₃² L₂² l_c3² + m₃ I_3zz L₂² + m₃ I_2zz l_c3² + I_2zz I_3zz "
        "- m₃² L₂² l_c3² c₃²",
        "m₃ (l_c3² (m₂ l_c2² + I_2zz + m₃ L₂² s₃²) + I_3zz L₂²) + I_3zz (m₂ l_c2² + I_2zz)",
    ]
    assert said(step("elbow-3r", "definite").why, "elbow-3r").endswith(
        "written with differences of entries, the entries put in, multiplied out, and collected with "
        "s₃² + c₃² = 1:"
    )


def test_differences_of_entries_are_used_where_they_are_shorter_alone() -> None:
    assert " - 2d₁₂ " in shown("planar-2r", "definite")[0]
    plain = shown("planar-2r-remote", "definite")[0]
    assert plain.split(" = ")[1].startswith("(m₁ l_c1² + m₂ l₁² + I₁)(m₂ l_c2² + I₂) - (m₂ l₁ l_c2 cos(")


def test_entries_that_make_a_product_need_no_further_line() -> None:
    assert shown("planar-2r-friction", "definite")[0].count(" = ") == 2
    assert said(step("planar-2r-friction", "definite").why, "planar-2r-friction").endswith(
        "written with differences of entries, and the entries put in:"
    )


@pytest.mark.parametrize("problem", WITH_ONE)
def test_every_member_is_the_determinant(problem: str) -> None:
    (result,) = step(problem, "definite").result
    values = members(solved(problem).robot.ring, result)
    assert values and all(isinstance(value, Expr) and value == values[0] for value in values)
