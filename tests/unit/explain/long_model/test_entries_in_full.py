"""The entries of a long model that are worked out in full: each line holds, exactly."""

from __future__ import annotations

import pytest

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import cross
from dynsolve.algebra.ring_values import value_of
from dynsolve.derivation.kinematics import axis, origin, rotation
from dynsolve.explain.abbreviations import Abbreviated, expanded
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Cross, Derivative, Letter, Matrix, Node, Relation, Row
from dynsolve.notation.unicode import to_unicode
from dynsolve.notation.walk import walk
from tests.support import solved
from tests.unit.explain.working.evaluated import evaluated

LONG = ("stanford-6", pytest.param("puma560", marks=pytest.mark.slow))


def names(problem: str) -> Abbreviated:
    found = solved(problem).abbreviated()
    assert found is not None
    return found


def told(problem: str, name: str) -> Step:
    solution = solved(problem)
    return next(step for step in solution.explain(short=names(problem)) if step.id == name)


def values(problem: str, equation: Node) -> list[Expr]:
    """What the members of an equation without letters and derivatives are worth."""
    assert isinstance(equation, Relation)
    plain = [
        part
        for part in equation.parts
        if not any(isinstance(inner, Letter | Derivative) for inner in walk(part))
    ]
    ring = solved(problem).robot.ring
    return [value_of(ring, part) for part in expanded(names(problem).definitions, plain)]


@pytest.mark.parametrize(
    ("problem", "i"), [("stanford-6", 4), pytest.param("puma560", 5, marks=pytest.mark.slow)]
)
def test_an_entry_of_D(problem: str, i: int) -> None:
    solution, step = solved(problem), told(problem, "D_entry")
    (result,) = step.result
    found = values(problem, result)
    assert found and set(found) == {solution.values["D"][i - 1, 5]}


@pytest.mark.parametrize(
    ("problem", "i"), [("stanford-6", 4), pytest.param("puma560", 5, marks=pytest.mark.slow)]
)
def test_its_vectors_are_those_of_the_base_turned_into_the_last_frame(problem: str, i: int) -> None:
    """z and r_c - o of the two joints, from H as the report derives it; and z × (r_c - o)."""
    solution, step = solved(problem), told(problem, "D_entry")
    H, ring = solution.values, solution.robot.ring
    back, center = rotation(H["H6"]).T, H["rc6"]
    axes = [back @ axis(H[f"H{k}"]) for k in (i - 1, 5)]
    levers = [back @ (center - origin(H[f"H{k}"])) for k in (i - 1, 5)]
    vectors, products = step.lines
    beside, *rest = vectors.formulas
    assert isinstance(beside, Row)
    shown = [part.parts[-1] for part in (*beside.parts, *rest) if isinstance(part, Relation)]
    assert levers[0] == levers[1]
    assert [evaluated(ring, vector) for vector in shown] == [*axes, levers[0]]
    for formula, z, lever in zip(products.formulas, axes, levers, strict=True):
        assert isinstance(formula, Relation)
        put_in, value = formula.parts[1:]
        assert isinstance(put_in, Cross) and isinstance(value, Matrix)
        assert evaluated(ring, value) == cross(z, lever)


@pytest.mark.parametrize(
    ("problem", "shown", "ijk"),
    [
        ("stanford-6", "c₄₅₆ = ½ (∂d₅₆/∂θ₄ + ∂d₄₆/∂θ₅ - ∂d₄₅/∂θ₆) = ½ (∂d₄₆/∂θ₅ - ∂d₄₅/∂θ₆) =", (3, 4, 5)),
        pytest.param(
            "puma560",
            "c₆₆₅ = ½ (∂d₅₆/∂θ₆ + ∂d₅₆/∂θ₆ - ∂d₆₆/∂θ₅) = ∂d₅₆/∂θ₆ = -(κ₇ c₆ - κ₈ s₆) = -σ₁₂",
            (5, 5, 4),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_a_christoffel_symbol(problem: str, shown: str, ijk: tuple[int, int, int]) -> None:
    solution, step = solved(problem), told(problem, "christoffel")
    (formula,) = step.lines[0].formulas
    assert to_unicode(formula, solution.style).startswith(shown)
    assert set(values(problem, formula)) == {solution.values["christoffel"][ijk]}


@pytest.mark.parametrize("problem", LONG)
def test_a_gravity_term(problem: str) -> None:
    """Each derivative of a name is that of its value; the entry is the one of g."""
    solution, step = solved(problem), told(problem, "g")
    _, slopes, entry = step.lines
    for formula in slopes.formulas:
        assert isinstance(formula, Relation)
        slope = formula.parts[0]
        assert isinstance(slope, Derivative)
        (value,) = (
            value_of(solution.robot.ring, part) for part in expanded(names(problem).definitions, [slope.of])
        )
        found = values(problem, formula)
        assert found and set(found) == {solution.robot.ring.diff(value, 4)}
    assert values(problem, entry.formulas[0]) == [solution.values["g"][4, 0]]


@pytest.mark.slow
def test_the_names_that_a_gravity_term_needs() -> None:
    _, slopes, entry = told("puma560", "g").lines
    style = solved("puma560").style
    assert [to_unicode(formula, style) for formula in (*slopes.formulas, *entry.formulas)] == [
        "∂σ₂/∂θ₅ = κ₁₃ c₅ + s₅ (κ₃ + σ₁) = σ₆",
        "∂σ₅/∂θ₅ = -c₄ ∂σ₂/∂θ₅ = -c₄ σ₆",
        "∂σ₆/∂θ₅ = c₅ (κ₃ + σ₁) - κ₁₃ s₅ = -σ₂",
        "g₅ = ∂𝒫/∂θ₅ = g (s₂₃ ∂σ₅/∂θ₅ + c₂₃ ∂σ₆/∂θ₅) = -g (c₂₃ σ₂ + s₂₃ c₄ σ₆)",
    ]
