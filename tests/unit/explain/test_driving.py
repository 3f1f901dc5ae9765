"""What stands on the other side of a row of the equations of motion: everything that acts."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.document import Reference
from dynsolve.notation.unicode import UnicodePrinter

ARM = "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
FORCE = "forces: [{link: 1, at: tip, force: [F, 0, 0]}]\n"
CONSTRAINT = "constraints: [tip.x - k]\n"


@pytest.mark.parametrize(
    ("more", "row"),
    [
        ("", "τ₁"),
        (FORCE, "τ₁ + Q₁"),
        (CONSTRAINT, "τ₁ + (𝐀_cᵀ 𝛌)₁"),
        (FORCE + CONSTRAINT, "τ₁ + Q₁ + (𝐀_cᵀ 𝛌)₁"),
    ],
)
def test_a_row_says_what_acts(more: str, row: str) -> None:
    for method in ("lagrange", "newton-euler"):
        solution = dynsolve.solve(ARM + more, method=method)
        step = next(step for step in solution.steps if step.id == "tau1")
        assert UnicodePrinter(solution.style).text(step.result[0]).startswith(f"{row} = ")


@pytest.mark.parametrize(
    ("more", "rest", "conserved"),
    [
        ("", "𝐂 𝐪̇ + 𝐠 = 𝛕 - 𝐃 𝐪̈", "As long as τ₁ = 0, "),
        (FORCE, "𝐂 𝐪̇ + 𝐠 = 𝛕 + 𝐐 - 𝐃 𝐪̈", "As long as τ₁ + Q₁ = 0, "),
        (CONSTRAINT, "𝐂 𝐪̇ + 𝐠 = 𝛕 + 𝐀_cᵀ 𝛌 - 𝐃 𝐪̈", "by the power of 𝛕 alone: as long as 𝛕 = 𝟎"),
    ],
)
def test_what_is_read_off_and_conserved_counts_all_that_acts(more: str, rest: str, conserved: str) -> None:
    solution = dynsolve.solve(ARM + "gravity: none\n" + more)
    steps = {step.id: step for step in solution.steps}
    printer = UnicodePrinter(solution.style)
    told = (*steps["conserved"].why, *steps["conserved"].concluding)
    parts = (part for part in told if not isinstance(part, Reference))
    said = "".join(part if isinstance(part, str) else printer.text(part) for part in parts)
    assert printer.text(steps["Cqd"].formula) == rest
    assert conserved in said


def test_one_constraint_has_numbers_and_not_matrices_of_one() -> None:
    solution = dynsolve.solve(f"{ARM}{CONSTRAINT}find: [lambda]\n")
    shown = [n for step in solution.steps if step.id in ("hc", "lambda") for n in step.result]
    texts = [UnicodePrinter(solution.style).text(node) for node in shown]
    assert len(texts) == 2
    assert not any("[" in text for text in texts)
