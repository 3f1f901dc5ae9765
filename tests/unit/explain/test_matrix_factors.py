"""What all entries of a matrix share stands in front of it, where that takes fractions out of the entries."""

from __future__ import annotations

import pytest

from dynsolve.explain.matrix_factors import factored
from dynsolve.notation.tree import Node
from dynsolve.notation.unicode import to_unicode
from tests.support import solved

FACTORS = [
    ("crustcrawler-2r", "I_body2", "(1/12) m₂ L₂² [[0, 0, 0], [0, 1, 0], [0, 0, 1]]"),
    ("crustcrawler-2r", "Jv2", "½ L₂ [[-s₁ c₂, -c₁ s₂], [c₁ c₂, -s₁ s₂], [0, c₂]]"),
    ("crustcrawler-2r", "rc2", "[[L₂ c₁ c₂/2], [L₂ s₁ c₂/2], [L₁ + L₂ s₂/2]]"),  # not all have L₂/2
    ("box-cylinder-rod-sphere", "I_body2", "(1/12) m₂ [[l₂² + b², 0, 0], [0, l₂² + b², 0], [0, 0, 2b²]]"),
    ("box-cylinder-rod-sphere", "I4", "(2/5) m₄ r₄² [[1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
    (
        "spherical-rrp",
        "Jv2",
        "[[-l_c2 s₁ c₂, -l_c2 c₁ s₂, 0], [l_c2 c₁ c₂, -l_c2 s₁ s₂, 0], [0, l_c2 c₂, 0]]",
    ),
]


@pytest.mark.parametrize(("problem", "name", "wanted"), FACTORS)
def test_fractions_that_all_entries_share_stand_in_front(problem: str, name: str, wanted: str) -> None:
    solution = solved(problem)
    assert to_unicode(factored(solution._context, solution.forms(name)), solution.style) == wanted


def last(node: Node) -> Node:
    return node.parts[-1]  # type: ignore[attr-defined,no-any-return]


def test_the_factors_of_a_product_of_matrices_are_multiplied() -> None:
    steps = {step.id: step for step in solved("crustcrawler-2r").explain(["vectorized"])}
    shown = to_unicode(steps["D_direct2"].working[0], solved("crustcrawler-2r").style)
    assert "= ¼ m₂ L₂² [[-s₁ c₂" in shown


def test_every_line_of_a_turned_tensor_has_its_factor_in_front() -> None:
    """R (I Rᵀ) of a cylinder: (1/12) m₁ does not go into the entries on the way."""
    solution = solved("crustcrawler-2r")
    step = next(step for step in solution.explain(["inertia"]) if step.id == "I1")
    lines = [to_unicode(last(line), solution.style) for line in (*step.working, *step.result)]
    assert len(lines) == 3 and all(line.startswith("(1/12) m₁ [[") for line in lines)


def test_a_fraction_in_front_stays_one_among_decimals() -> None:
    arm = "dh: [{theta: q1*, a: b}]\nmasses: [{mass: m, link: 1, center: midpoint}]\nfriction: {q1: 0.3}\n"
    solution = solved(f"gravity: [0, -g, 0]\n{arm}find: [D]\n")
    shown = factored(solution._context, solution.forms("Jv1"))
    assert to_unicode(factored(solution._context, solution.forms("rc1")), solution.style).startswith("½ b [")
    assert "0.5" not in to_unicode(shown, solution.style)
