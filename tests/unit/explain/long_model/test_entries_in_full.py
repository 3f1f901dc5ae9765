"""The entries of a long model that are worked out in full: each line holds, exactly."""

from __future__ import annotations

from functools import cache

import pytest

from dynsolve.algebra.matrix import cross
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.derivation.kinematics import axis, origin, rotation
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.recurring import expanded
from dynsolve.explain.step import Step
from dynsolve.notation.tree import (
    Cross,
    Derivative,
    Letter,
    Matrix,
    Node,
    Product,
    Relation,
    Row,
    Slashed,
    Sum,
    Symbol,
    walk,
)
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from tests.support import solved
from tests.unit.explain.working.evaluated import evaluated

LONG = ("stanford-6", pytest.param("puma560", marks=pytest.mark.slow))


def names(problem: str) -> Abbreviated:
    found = solved(problem).abbreviated()
    assert found is not None
    return found


@cache
def steps(problem: str) -> dict[str, Step]:
    return {step.id: step for step in solved(problem).explain(short=names(problem))}


def told(problem: str, name: str) -> Step:
    return steps(problem)[name]


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


ENTRY = [("stanford-6", 2), pytest.param("puma560", 4, marks=pytest.mark.slow)]
"""j of the entry d_j5 that is worked out."""


@pytest.mark.parametrize(("problem", "j"), ENTRY)
def test_an_entry_of_D(problem: str, j: int) -> None:
    solution, step = solved(problem), told(problem, "D_entry")
    (result,) = step.result
    found = values(problem, result)
    assert found and set(found) == {solution.values["D"][j - 1, 4]}


@pytest.mark.parametrize(("problem", "j"), ENTRY)
def test_its_vectors_are_those_of_the_base_turned_into_the_link(problem: str, j: int) -> None:
    """z and r_c - o of the two joints, from H as the report derives it; and z × (r_c - o), and products."""
    solution, step = solved(problem), told(problem, "D_entry")
    H, ring = solution.values, solution.robot.ring
    lines = iter(step.lines)
    for body in (5, 6):
        back, center = rotation(H[f"H{body}"]).T, H[f"rc{body}"]
        axes = [back @ axis(H[f"H{k}"]) for k in (j - 1, 4)]
        levers = [back @ (center - origin(H[f"H{k}"])) for k in (j - 1, 4)]
        vectors, products = next(lines), next(lines)
        each = [part for row in vectors.formulas for part in (row.parts if isinstance(row, Row) else [row])]
        shown = [part.parts[-1] for part in each if isinstance(part, Relation)]
        assert [evaluated(ring, vector) for vector in shown] == [*axes, *levers]
        for formula, z, lever in zip(products.formulas, axes, levers, strict=True):
            assert isinstance(formula, Relation)
            put_in, value = formula.parts[1:]
            assert isinstance(put_in, Cross) and isinstance(value, Matrix)
            assert evaluated(ring, value) == cross(z, lever)
        moved, turned = (values(problem, each) for each in next(lines).formulas)
        left, right = (cross(z, lever) for z, lever in zip(axes, levers, strict=True))
        mass = next(each.mass for each in solution.robot.bodies if each.link == body)
        assert moved and set(moved) == {ring.dot(left.entries, right.entries) * mass}
        tensor = solution.values[f"I_body{body}"]
        assert turned == [(axes[0].T @ tensor @ axes[1])[0, 0]]
    assert not list(lines)


@pytest.mark.parametrize(("problem", "j"), ENTRY)
def test_several_bodies_and_both_parts_contribute(problem: str, j: int) -> None:
    step = told(problem, "D_entry")
    assert step.formula is not None
    formula = to_unicode(step.formula, solved(problem).style)
    for term in ("m₅ (", "m₆ (", "𝓘₅", "𝓘₆"):
        assert term in formula


@pytest.mark.parametrize(
    ("problem", "shown", "ijk"),
    [
        ("stanford-6", "c₂₆₅ = ½ (∂d₅₆/∂θ₂ + ∂d₂₅/∂θ₆ - ∂d₂₆/∂θ₅) = ½ (∂d₂₅/∂θ₆ - ∂d₂₆/∂θ₅)", (1, 5, 4)),
        pytest.param(
            "puma560",
            "c₄₆₅ = ½ (∂d₅₆/∂θ₄ + ∂d₄₅/∂θ₆ - ∂d₄₆/∂θ₅) = ½ (∂d₄₅/∂θ₆ - ∂d₄₆/∂θ₅)",
            (3, 5, 4),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_a_christoffel_symbol(problem: str, shown: str, ijk: tuple[int, int, int]) -> None:
    solution, step = solved(problem), told(problem, "christoffel")
    first, names, entries, last, again = step.lines
    assert to_unicode(first.formulas[0], solution.style) == shown
    assert again.in_columns and len(again.formulas) > 5
    for formula in (*names.formulas, *entries.formulas, *again.formulas):
        assert slope_of(problem, formula) in values(problem, formula)
        assert len(set(values(problem, formula))) == 1
    found = values(problem, last.formulas[0])
    assert len(found) > 2 and set(found) == {solution.values["christoffel"][ijk]}


def slope_of(problem: str, formula: Node) -> Expr:
    """What the derivative on the left of an equation is: of a name, or of an entry of D."""
    solution = solved(problem)
    ring = solution.robot.ring
    assert isinstance(formula, Relation)
    slope = formula.parts[0]
    slope = slope.fraction if isinstance(slope, Slashed) else slope
    assert isinstance(slope, Derivative) and isinstance(slope.by, Symbol)
    by = next(q.index - 1 for q in solution.robot.coordinates if q.name == slope.by.name)
    entries = {
        letters.entry("d", i + 1, j + 1): solution.values["D"][i, j] for i in range(6) for j in range(6)
    }
    if slope.of in entries:
        return ring.diff(entries[slope.of], by)
    assert slope.of is not None
    (value,) = expanded(names(problem).definitions, [slope.of])
    return ring.diff(value_of(ring, value), by)


@pytest.mark.slow
def test_the_names_that_a_christoffel_symbol_needs() -> None:
    _, found, entries, last, again = told("puma560", "christoffel").lines
    style = solved("puma560").style
    shown = [to_unicode(formula, style) for line in (found, entries, last) for formula in line.formulas]
    assert shown == [
        "∂σ₈/∂θ₆ = κ₇ c₆ - κ₈ s₆ = σ₁₂",
        "∂σ₉/∂θ₆ = κ₁₇ s₆² - 4κ₆ s₆ c₆ - κ₁₇ c₆² = -2σ₂₈",
        "∂σ₁₆/∂θ₆ = s₅ ∂σ₉/∂θ₆ + c₅ ∂σ₈/∂θ₆ = c₅ σ₁₂ - 2s₅ σ₂₈",
        "∂d₄₅/∂θ₆ = -∂σ₁₆/∂θ₆ = -(c₅ σ₁₂ - 2s₅ σ₂₈)",
        "∂d₄₆/∂θ₅ = σ₁₂ c₅ - κ₁₆ s₅",
        "c₄₆₅ = ½ (2s₅ σ₂₈ - c₅ σ₁₂ - σ₁₂ c₅ + κ₁₆ s₅) = -(c₅ σ₁₂ - s₅ (κ₁₆/2 + σ₂₈)) = -σ₃₃",
    ]
    assert to_unicode(found.by[2], style) == "c₆² - s₆² = cos(2θ₆)"
    shown = [to_unicode(formula, style) for formula in again.formulas]
    assert {"∂σ₅/∂θ₄ = -σ₄", "∂σ₁₄/∂θ₆ = 2σ₉"} < set(shown) and "∂σ₈/∂θ₆ = σ₁₂" not in shown


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


@pytest.mark.parametrize(
    ("problem", "k"), [("stanford-6", 3), pytest.param("puma560", 6, marks=pytest.mark.slow)]
)
def test_a_row_of_the_forces(problem: str, k: int) -> None:
    """In d_kj, c_ijk and g_k: with the values of these it is the force that the robot has, exactly."""
    solution, step = solved(problem), told(problem, "model")
    ((formula,),) = (line.formulas for line in step.lines)
    assert isinstance(formula, Relation)
    ring, D, symbols = solution.robot.ring, solution.values["D"], solution.values["christoffel"]
    n, names = solution.robot.n, [q.name for q in solution.robot.coordinates]
    row = {letters.entry("g", k): solution.values["g"][k - 1, 0]}
    row |= {letters.entry("d", *sorted((k, j))): D[k - 1, j - 1] for j in range(1, n + 1)}
    row |= {
        letters.entry("c", i, j, k): symbols[i - 1, j - 1, k - 1]
        for i in range(1, n + 1)
        for j in range(i, n + 1)
    }
    total = ring.zero
    for term in terms_of(formula.parts[1]):
        value = ring.one
        for factor in term.factors if isinstance(term, Product) else (term,):
            value *= row[factor] if factor in row else value_of(ring, factor)
        total += value
    forces = [ring.symbol(q.name, dots=2) * D[k - 1, j] for j, q in enumerate(solution.robot.coordinates)]
    forces += [
        ring.symbol(names[i], dots=1) * ring.symbol(names[j], dots=1) * symbols[min(i, j), max(i, j), k - 1]
        for i in range(n)
        for j in range(n)
    ]
    assert total == sum(forces, start=solution.values["g"][k - 1, 0])


def terms_of(node: Node) -> tuple[Node, ...]:
    assert isinstance(node, Sum)
    return node.terms
