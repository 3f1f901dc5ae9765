"""The steps of a long model: nothing in them speaks of what the report does not show."""

from __future__ import annotations

import re
from functools import cache
from unicodedata import normalize

import pytest

import dynsolve
from dynsolve.algebra import matrix as algebra
from dynsolve.document import Reference
from dynsolve.explain.long_model.vectorized import on_parallel_axes
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Letter, Matrix, Number, Product, Relation, Row, Symbol, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from dynsolve.render.prose import with_formulas
from tests.support import solved
from tests.unit.explain.sanity.checks import context
from tests.unit.explain.working.evaluated import evaluated

LONG = ("stanford-6", pytest.param("puma560", marks=pytest.mark.slow))


@cache
def steps(problem: str) -> dict[str, Step]:
    return {step.id: step for step in solved(problem).explain(short=solved(problem).abbreviated())}


def said(step: Step, problem: str) -> str:
    style = solved(problem).style
    lines = [part for line in step.lines for part in (*line.by, *line.formulas)]
    parts = [*step.why, *lines, *step.concluding, *(part for note in step.notes for part in note)]
    told = (part for part in parts if not isinstance(part, Reference))  # as on a page without numbers
    return "".join(part if isinstance(part, str) else to_unicode(part, style) for part in told)


def shown(problem: str, name: str) -> list[str]:
    return [to_unicode(result, solved(problem).style) for result in steps(problem)[name].result]


@pytest.mark.parametrize("problem", LONG)
def test_nothing_is_read_off_and_nothing_compared(problem: str) -> None:
    told = steps(problem)
    assert not {"Cqd", "agreement", "D_direct"} & told.keys()
    assert not any("read off" in said(step, problem) + step.title for step in told.values())


def test_the_products_of_rates_are_collected_before_the_symbols_are_used() -> None:
    """Spong, Hutchinson, Vidyasagar, section 7.3: the sum of d_kj,i q_i q_j is half that of both slopes."""
    step = steps("stanford-6")["forces"]
    line, names = step.lines
    assert normalize("NFC", to_unicode(line.formulas[0])) == normalize(
        "NFC", "Σⱼ₌₁⁶ ḋₖⱼ q̇ⱼ = Σᵢ₌₁⁶ Σⱼ₌₁⁶ (∂dₖⱼ/∂qᵢ) q̇ᵢ q̇ⱼ = ½ Σᵢ₌₁⁶ Σⱼ₌₁⁶ (∂dₖⱼ/∂qᵢ + ∂dₖᵢ/∂qⱼ) q̇ᵢ q̇ⱼ"
    )
    before = to_unicode(names.formulas[0], solved("stanford-6").style)
    assert "cᵢⱼₖ = ½ (∂dₖⱼ/∂qᵢ + ∂dₖᵢ/∂qⱼ - ∂dᵢⱼ/∂qₖ)" in before and "gₖ = ∂𝒫/∂qₖ" in before


@pytest.mark.parametrize("problem", LONG)
def test_why_the_matrix_is_skew_symmetric(problem: str) -> None:
    """Spong, Hutchinson, Vidyasagar, section 7.5.1: half of the slopes in n_kj cancel."""
    step = steps(problem)["skew"]
    (line,) = step.lines
    raised = {6: "⁶", 7: "⁷"}[solved(problem).robot.n]
    assert normalize("NFC", to_unicode(line.formulas[0], solved(problem).style)).endswith(
        normalize("NFC", f"= Σᵢ₌₁{raised} (∂dᵢⱼ/∂qₖ - ∂dₖᵢ/∂qⱼ) q̇ᵢ")
    )
    solution = solved(problem)
    ring, n, D, C = solution.robot.ring, solution.robot.n, solution.values["D"], solution.values["C"]
    rates = [ring.symbol(q.name, dots=1) for q in solution.robot.coordinates]
    for k, j in ((0, 1), (1, 4), (4, 5)):
        ours = sum(
            ((ring.diff(D[i, j], k) - ring.diff(D[k, i], j)) * rates[i] for i in range(n)), start=ring.zero
        )
        assert ours == ring.time_derivative(D[k, j]) - C[k, j] * 2


@pytest.mark.slow
def test_the_potential_energy_of_which_g_is_made() -> None:
    assert "𝒫 = g (m₁ y₁ + κ₂₄ s₂ + κ₅ c₂ + s₂₃ (κ₂₂ + σ₅) + c₂₃ (κ₂₁ + σ₆))" in said(
        steps("puma560")["g"], "puma560"
    )
    assert not steps("puma560")["P"].result


@pytest.mark.slow
def test_a_spherical_wrist_and_its_point_that_is_written_once() -> None:
    step = steps("puma560")["axes"]
    assert "The last three axes, 𝐳₃, 𝐳₄ and 𝐳₅, meet in 𝐨₄: a spherical wrist." in said(step, "puma560")
    assert "Frame i is 𝐇ᵢ⁰ = 𝐀₁ … 𝐀ᵢ." in said(step, "puma560")
    assert "slides" not in said(step, "puma560")
    assert [text.rpartition(", ")[2] for text in shown("puma560", "axes")[-2:]] == ["𝐨₅ = 𝐨₄", "𝐨₆ = 𝐨₄"]
    assert "c₂ c₃ - s₂ s₃ = c₂₃" in said(steps("puma560")["H6"], "puma560")


@pytest.mark.parametrize("problem", LONG)
def test_indices_among_words_are_set_as_in_formulas(problem: str) -> None:
    """An i in a sentence is a formula of its own, or one that the writer of words knows: frame i."""
    for step in steps(problem).values():
        lines = [part for line in step.lines for part in line.by]
        parts = [*step.why, *lines, *step.concluding, *(part for note in step.notes for part in note)]
        words = [piece for part in parts if isinstance(part, str) for piece in with_formulas(part)]
        assert not [word for word in words if isinstance(word, str) and re.search(r"\b[ijk]\b", word)]


@pytest.mark.slow
def test_the_sign_of_products_of_inertia_is_said_where_there_are_any() -> None:
    """Spong, Hutchinson, Vidyasagar, section 7.2.1: I_xy is minus the integral of x y."""
    minus = "An entry off the diagonal is minus the integral of the product of two coordinates"
    assert minus in said(steps("puma560")["tensors"], "puma560")
    assert minus not in said(steps("stanford-6")["tensors"], "stanford-6")


@pytest.mark.parametrize("problem", LONG)
def test_the_jacobian_by_its_columns(problem: str) -> None:
    """Each column of J_v once, in order; the wrist's axes pass through the point that they do not move."""
    solution, step = solved(problem), steps(problem)["J"]
    beside, angular = step.result
    assert isinstance(beside, Row) and isinstance(angular, Relation) and angular.parts[0] == letters.JW
    columns = [part.parts[-1] for part in beside.parts if isinstance(part, Relation) for _ in part.parts[:-1]]
    J = solution.values["Jv"]
    assert len(columns) == solution.robot.n
    for k, column in enumerate(columns):
        if isinstance(column, Matrix):
            assert evaluated(solution.robot.ring, column) == J.column_at(k)
        else:
            assert J.column_at(k).is_zero and column == Letter("0", style="bold")


@pytest.mark.parametrize("problem", LONG)
def test_the_last_frame_by_two_halves(problem: str) -> None:
    """Spong, Hutchinson, Vidyasagar, section 3.1: H_6^0 = H_3^0 H_6^3."""
    solution, step = solved(problem), steps(problem)["H6"]
    assert step.formula is not None and to_unicode(step.formula).endswith("= H₃⁰ H₆³")
    (line,) = step.lines
    assert [to_unicode(half)[:14] for half in line.formulas] == ["H₃⁰ = A₁ A₂ A₃", "H₆³ = A₄ A₅ A₆"]
    first, second = (
        evaluated(solution.robot.ring, half.parts[-1]) for half in line.formulas if isinstance(half, Relation)
    )
    assert first == solution.values["H3"] and first @ second == solution.values["H6"]


@pytest.mark.parametrize(
    ("problem", "check"),
    [
        ("stanford-6", "0, d₂ and d₆ + d₃."),
        pytest.param(
            "puma560",
            "a₂ + a₃ = 0.4521, -d₃ = -0.15005 and d₄ = 0.4318 (in m).",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_where_the_end_is_with_all_angles_0(problem: str, check: str) -> None:
    """By hand: the lengths of the table along its axes, which only the right angles turn."""
    told = said(steps(problem)["H6"], problem).partition("To check: ")[2]
    assert normalize("NFKC", told) == normalize(
        "NFKC", f"with all joint angles 0 the entries of o₆ are {check}"
    )


@pytest.mark.parametrize("problem", LONG)
def test_the_jacobian_of_one_body(problem: str) -> None:
    """Spong, Hutchinson, Vidyasagar, section 7.2.2: the columns are those of the mass centre's velocity."""
    solution, step = solved(problem), steps(problem)["kinetics"]
    ring, center = solution.robot.ring, solution.values["rc3"]
    place, *columns = (part.parts[-1] for part in step.lines[0].formulas if isinstance(part, Relation))
    assert evaluated(ring, place) == center
    for q, column in zip(solution.robot.coordinates, columns, strict=False):
        slopes = [ring.diff(entry, q.index - 1) for entry in center.entries]
        value = evaluated(ring, column)
        assert isinstance(value, algebra.Matrix) and list(value.entries) == slopes
    assert len(columns) == 3


@pytest.mark.parametrize("problem", LONG)
def test_the_last_entry_of_the_inertia_matrix(problem: str) -> None:
    """On what D does not depend stands with the Christoffel symbols, and is not said again."""
    told = steps(problem)
    assert "like one body" in said(told["christoffel"], problem)
    assert "like one body" not in said(told["dependence"], problem)


@pytest.mark.parametrize("problem", LONG)
def test_why_symbols_are_opposites(problem: str) -> None:
    """What is said of d_jk holds of D, and what follows of the symbols holds of them."""
    solution = solved(problem)
    D, ring, n = solution.values["D"], solution.robot.ring, solution.robot.n
    assert "there cᵢⱼₖ = -cᵢₖⱼ" in said(steps(problem)["christoffel"], problem)
    symbols = solution.values["christoffel"]
    for i in range(n):
        for j in range(i, n):
            for k in range(i, n):
                assert ring.diff(D[j, k], i).is_zero
                assert symbols[i, j, k] == -symbols[i, k, j]


@pytest.mark.parametrize(
    ("problem", "first"), [("scara-rrpr", 1), pytest.param("puma560", 2, marks=pytest.mark.slow)]
)
def test_symbols_of_parallel_axes(problem: str, first: int) -> None:
    """∂²r/∂q_i ∂q_j = z_i × ∂r/∂q_j where i ≤ j: it is the same for equal z_i."""
    solution = solved(problem)
    told, n = on_parallel_axes(context(problem)), solution.robot.n
    assert f"joints {first} and {first + 1} are parallel" in "".join(
        part if isinstance(part, str) else to_unicode(part, solution.style) for part in told
    )
    symbols = solution.values["christoffel"]
    for j in range(first, n):
        for k in range(n):
            assert symbols[first - 1, j, k] == symbols[first, j, k]


def test_axes_that_are_not_parallel_make_no_symbols_equal() -> None:
    assert on_parallel_axes(context("stanford-6")) == ()


@pytest.mark.parametrize("problem", LONG)
def test_the_third_rows_of_rotations_between_the_frames_that_are_shown(problem: str) -> None:
    solution, step = solved(problem), steps(problem)["potentials"]
    (line,) = step.lines
    for formula in line.formulas:
        assert isinstance(formula, Relation) and isinstance(formula.parts[0], Product)
        frame = formula.parts[0].factors[1]
        assert isinstance(frame, Letter) and isinstance(frame.sub, Number)
        rows = evaluated(solution.robot.ring, formula.parts[1])
        assert rows.rows[0] == solution.values[f"H{frame.sub.p}"].rows[2][:3]


@pytest.mark.parametrize("problem", LONG)
def test_on_what_the_inertia_matrix_depends(problem: str) -> None:
    solution = solved(problem)
    D, ring = solution.values["D"], solution.robot.ring
    _, _, told = said(steps(problem)["D"], problem).partition("depends on ")
    names = told.partition(" alone")[0]
    for k, q in enumerate(solution.robot.coordinates):
        changes = any(not ring.diff(entry, k).is_zero for entry in D.entries)
        assert (to_unicode(Symbol(q.name), solution.style) in names) is changes


@pytest.mark.parametrize("problem", LONG)
def test_an_entry_of_C_stands_for_all(problem: str) -> None:
    told = steps(problem)
    first, *zero = told["C"].result
    assert not any(isinstance(part, Matrix) for part in walk(first))
    (full,) = told["C_entries"].result
    assert isinstance(full, Relation) and isinstance(full.parts[-1], Matrix)
    entries = [entry for row in full.parts[-1].rows for entry in row]
    assert isinstance(first, Relation) and first.parts[-1] in entries
    assert len(zero[0].parts) - 1 == sum(to_unicode(entry) == "0" for entry in entries)


def test_of_what_is_read_off_from_the_recursions_g_alone_is_written() -> None:
    solution = dynsolve.solve("stanford-6", method="newton-euler")
    (step,) = (s for s in solution.explain(short=solution.abbreviated()) if s.id == "Cqd")
    (result,) = step.result
    assert to_unicode(result).startswith("g = [[0], [-g (")
