"""Angles inside sines as programs print them, decimals in radians."""

from __future__ import annotations

import pytest

import dynsolve


@pytest.mark.parametrize(
    ("sine", "expected"),
    [
        ("cos(q1 - 1.5707963267948966)", "correct"),
        ("cos(q1 - 1.5708)", "correct"),
        ("-sin(q1 + 3.14159)", "correct"),
        ("(sin(q1 - 0.7854) + cos(q1 - 0.7854))/sqrt(2)", "correct"),
        ("cos(q1 + 1.5708)", "wrong"),
        ("cos(q1 - 1.5808)", "wrong"),
        ("cos(q1 - 90)", "wrong"),
        ("cos(q1 - 1.5)", "wrong"),
    ],
)
def test_a_decimal_is_the_angle_that_it_rounds(sine: str, expected: str) -> None:
    report = dynsolve.check("planar-2r", f"answers:\n  P1: m1*g*lc1*({sine})\n")
    assert [str(a.verdict) for a in report.answers if a.name == "P1"] == [expected]
