"""Numbers worked out by hand.

The planar elbow manipulator of Spong, Hutchinson, Vidyasagar (section 7.4, the book's
symbols) with two uniform unit rods, m = 1 kg, l = 1 m, l_c = 1/2 m, I = 1/12 kg m²:

    d₁₁ = m₁ l_c1² + m₂ (l₁² + l_c2² + 2 l₁ l_c2 c₂) + I₁ + I₂     h = -m₂ l₁ l_c2 s₂
    d₁₂ = m₂ (l_c2² + l₁ l_c2 c₂) + I₂    d₂₂ = m₂ l_c2² + I₂
    C q̇ = [h (2 q̇₁ q̇₂ + q̇₂²), -h q̇₁²]
    g = [(m₁ l_c1 + m₂ l₁) g c₁ + m₂ l_c2 g c₁₂, m₂ l_c2 g c₁₂]
"""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

import dynsolve

RODS = {"m1": 1, "m2": 1, "l1": 1, "lc1": "1/2", "lc2": "1/2", "I1": "1/12", "I2": "1/12", "g": "9.81"}


@pytest.fixture(scope="module")
def arm() -> dynsolve.Solution:
    solution = dynsolve.solve("planar-2r")
    return solution.with_values(**{k: v for k, v in RODS.items() if k in solution.robot.parameters})  # type: ignore[arg-type]


def rationals(matrix: sympy.Matrix) -> list[Fraction]:
    return [Fraction(int(entry.p), int(entry.q)) for entry in matrix]


def test_elbow_at_a_right_angle(arm: dynsolve.Solution) -> None:
    """q = (0, 90°), q̇ = (1, 2) rad/s, q̈ = (3, 6) rad/s²"""
    state = arm.at(q1="0deg", q2="90deg", q1_dot=1, q2_dot=2, q1_ddot=3, q2_ddot=6)
    third = Fraction(1, 3)
    assert rationals(state.symbolic("D")) == [5 * third, third, third, third]
    assert rationals(state.symbolic("Cqd")) == [-4, Fraction(1, 2)]
    assert rationals(state.symbolic("g")) == [Fraction("14.715"), 0]
    # 5/3·3 + 1/3·6 - 4 + 14.715;  1/3·3 + 1/3·6 + 1/2
    assert rationals(state.symbolic("tau")) == [Fraction("17.715"), Fraction("3.5")]
    # ½ (5/3·1 + 2·1/3·1·2 + 1/3·4);  9.81·(0 + ½)
    assert rationals(sympy.Matrix([state.symbolic("K"), state.symbolic("P")])) == [
        Fraction(13, 6),
        Fraction("4.905"),
    ]


def test_stretched_out_at_thirty_degrees(arm: dynsolve.Solution) -> None:
    """q = (30°, 0): d₁₁ = 1/4 + 1 + 1/4 + 1 + 1/6 = 8/3, d₁₂ = 1/4 + 1/2 + 1/12 = 5/6, g₁ = 2·9.81·√3/2"""
    state = arm.at(q1="30deg", q2=0)
    assert rationals(state.symbolic("D")) == [Fraction(8, 3), Fraction(5, 6), Fraction(5, 6), Fraction(1, 3)]
    weight = sympy.sqrt(3) * sympy.Rational(981, 100)
    assert (state.symbolic("g") - sympy.Matrix([weight, weight / 4])).is_zero_matrix
    assert state.number("g") == [[pytest.approx(16.99141842)], [pytest.approx(4.247854605)]]
