"""What stands on the other side of a row of the equations of motion: everything that acts."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.notation.unicode import UnicodePrinter

ARM = "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
FORCE = "forces: [{link: 1, at: tip, force: [F, 0, 0]}]\n"
CONSTRAINT = "constraints: [tip.x - k]\n"


@pytest.mark.parametrize(
    ("more", "row"),
    [
        ("", "τ₁"),
        (FORCE, "τ₁ + Q₁"),
        (CONSTRAINT, "τ₁ + (A_cᵀ λ)₁"),
        (FORCE + CONSTRAINT, "τ₁ + Q₁ + (A_cᵀ λ)₁"),
    ],
)
def test_a_row_says_what_acts(more: str, row: str) -> None:
    for method in ("lagrange", "newton-euler"):
        solution = dynsolve.solve(ARM + more, method=method)
        step = next(step for step in solution.steps if step.id == "tau1")
        assert UnicodePrinter(solution.style).text(step.result[0]).startswith(f"{row} = ")
