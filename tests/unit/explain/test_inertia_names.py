"""Names for long sums of masses and lengths: defined at the kinetic energy, the same values from there on."""

from __future__ import annotations

from functools import cache

import pytest

from dynsolve.explain.abbreviations import InertiaNames
from dynsolve.explain.named_steps import DERIVATIVES
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.tree import Node, Relation, walk
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import solution_document
from tests.support import solved
from tests.unit.explain.test_abbreviated_steps import displayed
from tests.unit.explain.test_symbol_names import assert_same, known, last, named

BOX = "box-cylinder-rod-sphere"
NAMED = (BOX, "spherical-rrp", "puma560-first3")


def inertias(problem: str) -> InertiaNames:
    found = named(problem).inertias
    assert found is not None
    return found


@cache
def steps(problem: str) -> dict[str, Step]:
    return {step.id: step for step in solved(problem).explain(short=named(problem))}


def shown(problem: str, node: Node) -> str:
    return to_unicode(node, solved(problem).style)


@pytest.mark.parametrize(("problem", "definitions"), [
    (BOX, ["m₂ (4l₂² - b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12) + m₄ d₃²",
           "m₂ (4l₂² + b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12) + m₄ (2r₄²/5 + d₃²)",
           "m₃ (d₃ - l₃/2) + m₄ d₃"]),
    ("spherical-rrp", ["m₂ l_c2² + m₃ d₃² + I₂"]),
    ("elbow-3r", []),  # the longest sum would save 48 operations
])  # fmt: skip
def test_what_is_named(problem: str, definitions: list[str]) -> None:
    assert [shown(problem, one.meaning) for one in inertias(problem).definitions] == definitions


@pytest.mark.parametrize(("problem", "slopes"), [
    (BOX, ["∂σ₁/∂d₃ = ∂σ₂/∂d₃ = 2σ₃"]),
    ("spherical-rrp", ["∂σ₁/∂d₃ = 2m₃ d₃"]),
    ("puma560-first3", []),  # of an arm that only turns they are constant
])  # fmt: skip
def test_their_derivatives(problem: str, slopes: list[str]) -> None:
    assert [shown(problem, slope) for slope in inertias(problem).slopes] == slopes


@pytest.mark.parametrize(("problem", "users"), [
    ("spherical-rrp", {"ddt1", "ddt2", "dLdq3", "christoffel"}),  # θ₂ is not in σ₁, nor is σ₁ in ∂ℒ/∂ḋ₃
    ("puma560-first3", set()),
])  # fmt: skip
def test_the_derivatives_are_referred_to_where_they_are_used(problem: str, users: set[str]) -> None:
    assert {name for name, step in steps(problem).items() if DERIVATIVES in step.names} == users


@pytest.mark.parametrize("problem", NAMED)
@pytest.mark.parametrize(
    "name", ["K", "L", "tau1", "tau2", "tau3", "ddt1", "dLdqd2", "dLdq2", "D", "Cqd", "g"]
)
def test_results_in_names_mean_the_same(problem: str, name: str) -> None:
    values, step = known(problem), steps(problem)[name]
    wanted = evaluate(solved(problem).forms(name), values)
    lines = [line.formulas[0] for line in step.lines if name not in ("K", "g") and not line.label]
    for node in (*lines, step.result[0]):
        found = evaluate(last(node), values)
        assert_same(found, wanted) if isinstance(found, list) else assert_same([found], [wanted])


@pytest.mark.parametrize(("problem", "name", "row"), [
    (BOX, "g", "g₂ = m₂ g l₂ c₂/2 + m₃ g (d₃ - l₃/2) c₂ + m₄ g d₃ c₂ = g (m₂ l₂/2 + σ₃) c₂"),
    (BOX, "g", "g₃ = m₃ g s₂ + m₄ g s₂ = g (m₃ + m₄) s₂"),
    ("spherical-rrp", "D_sum", "d₁₁ = I₁ + m₂ l_c2² c₂² + I₂ c₂² + m₃ d₃² c₂² = I₁ + σ₁ c₂²"),
    ("spherical-rrp", "D_sum", "d₂₂ = m₂ l_c2² + I₂ + m₃ d₃² = σ₁"),
])  # fmt: skip
def test_a_sum_stands_before_its_name(problem: str, name: str, row: str) -> None:
    """What is worked out anew is the plain sum, and the name only what it comes to."""
    step, values = steps(problem)[name], known(problem)
    rows = {
        shown(problem, node): node
        for node in (*(n for line in step.lines for n in line.formulas), *step.result)
    }
    relation = rows[row]
    assert isinstance(relation, Relation)
    plain, named = relation.parts[-2:]
    assert evaluate(plain, values) == pytest.approx(evaluate(named, values))


def test_a_line_that_only_sorts_is_left_out() -> None:
    """d/dt (σ₂ θ̇₂) is one look, where the sum that σ₂ stands for took two lines."""
    step = steps(BOX)["ddt2"]
    assert not step.lines and not step.concluding
    assert shown(BOX, last(step.result[0])) == "σ₂ θ̈₂ + 2σ₃ θ̇₂ d\u0307₃"


@pytest.mark.parametrize(
    ("detail", "stages"), [(Detail.NORMAL, None), (Detail.BRIEF, None), (Detail.NORMAL, ["torque"]),
                           (Detail.BRIEF, ["torque"]), (Detail.NORMAL, ["vectorized"])],
)  # fmt: skip
def test_they_are_defined_before_they_are_used(detail: Detail, stages: list[str] | None) -> None:
    names = inertias(BOX).symbols
    nodes = list(displayed(solution_document(solved(BOX), detail, stages).blocks))
    uses = [node for node in nodes if not names.isdisjoint(walk(node))]
    assert isinstance(uses[0], Relation) and uses[0].parts[0] in names


def test_the_kinetic_energy_is_collected_before_the_names_are_put_in() -> None:
    step = steps(BOX)["K"]
    assert ["".join(map(str, line.by)) for line in step.lines[2:]] == ["Abbreviations:", "Hence:"]
    collected = shown(BOX, step.lines[1].formulas[0])
    assert "(m₂ (4l₂² - b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12) + m₄ d₃²) c₂²" in collected
    assert step.concluding == ("With the abbreviations:",)
