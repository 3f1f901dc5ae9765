"""What each term of a force is, and the section that closes a solution."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

import dynsolve
from dynsolve.document import Heading
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail
from dynsolve.explain.terms import terms_of, value_of_term
from dynsolve.notation.rounding import marked
from dynsolve.notation.tree import ZERO, equation
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import measured_steps, solution_document
from dynsolve.solution.summary import TITLE, in_model
from tests.robots import robots
from tests.support import STEMS, document, solved
from tests.unit.explain.test_abbreviated_steps import displayed


def table(problem: str) -> list[list[str]]:
    (step,) = (step for step in solved(problem).steps if step.id == "terms")
    assert step.table is not None
    style = solved(problem).style
    return [
        [part if isinstance(part, str) else to_unicode(part, style) for part in row]
        for row in step.table.rows
    ]


def words(problem: str) -> str:
    (step,) = (step for step in solved(problem).steps if step.id == "terms")
    return "".join(part for part in step.why if isinstance(part, str))


def test_every_term_of_the_course_s_manipulator() -> None:
    assert table("in3140-rp") == [
        ["τ₁", "d₁₁ θ̈₁ = (m₂ L₂² + I_1zz) θ̈₁", "inertial"],
        ["", "2c₁₂₁ θ̇₁ L̇₂ = 2m₂ L₂ θ̇₁ L̇₂", "Coriolis"],
        ["f₂", "d₂₂ L̈₂ = m₂ L̈₂", "inertial"],
        ["", "c₁₁₂ θ̇₁² = -m₂ L₂ θ̇₁²", "centrifugal"],
    ]


def test_coupling_and_gravity() -> None:
    kinds = [(force, kind) for force, _, kind in table("planar-2r")]
    assert kinds == [
        ("τ₁", "inertial"), ("", "coupling inertia"), ("", "Coriolis"), ("", "centrifugal"), ("", "gravity"),
        ("τ₂", "coupling inertia"), ("", "inertial"), ("", "centrifugal"), ("", "gravity"),
    ]  # fmt: skip


def test_of_terms_of_one_order_in_the_rates_all_are_written_out_or_none() -> None:
    forms = {row[1] for row in table("planar-2r")}
    assert {"d₁₁ q̈₁", "d₁₂ q̈₂", "d₂₁ q̈₁", "d₂₂ q̈₂", "c₁₁₂ q̇₁² = m₂ l₁ l_c2 s₂ q̇₁²"} <= forms


def test_where_units_are_unknown_none_are_said() -> None:
    unit = "Each term has the unit of its force"
    assert unit in words("planar-2r") and unit not in words("numeric-2r")


@settings(max_examples=5, deadline=None)
@given(robots(max_joints=3))
def test_the_terms_of_any_robot_make_its_forces(problem: str) -> None:
    solution = dynsolve.solve(problem)
    context = Context(solution.robot, solution.values, solution.forms)
    for q in solution.robot.coordinates:
        values = [value_of_term(context, term) for term in terms_of(context, q.index - 1)]
        assert sum(values, start=solution.robot.ring.zero) == solution.values[f"tau{q.index}"]


IN_EVERY_DETAIL = {"in3140-rp", "planar-2r", "elbow-3r", "scara-rrpr"}
LONG = {"puma560", "stanford-6", "panda-7r"}
CLOSED = [
    *((problem, detail) for problem in sorted(IN_EVERY_DETAIL) for detail in Detail),
    *((problem, Detail.NORMAL) for problem in sorted(STEMS - IN_EVERY_DETAIL - LONG)),
]


@pytest.mark.parametrize(("problem", "detail"), CLOSED)
def test_every_solution_ends_with_its_model(problem: str, detail: Detail) -> None:
    short = solved(problem).abbreviated("auto")
    blocks = document(problem, detail).blocks
    headings = [place for place, block in enumerate(blocks) if isinstance(block, Heading)]
    last = headings[-3 if detail is Detail.FULL else -1]  # before the verification and the notation
    assert blocks[last] == Heading(TITLE, closing=True)
    definitions = (
        [equation(one.name, one.meaning) for one in short.sums] if short and short.at_symbols else []
    )
    shown = [node for node in displayed(blocks[last:]) if node not in definitions]
    solution = solved(problem)
    steps = measured_steps(solution.explain(short=short), solution.robot, solution.style)
    by_id = {step.id: step for step in steps}
    forces = [by_id[f"tau{q.index}"].result[0] for q in solution.robot.coordinates]
    for k in solution.robot.actions.passive:
        forces[k] = equation(ZERO, *forces[k].parts[1:])
    for line in by_id["model"].lines:
        forces = list(line.formulas)
    matrices = by_id["model"].result or tuple(by_id[name].result[0] for name in "DCg")
    wanted = [*matrices, *forces] if solved(problem).is_short else []
    model = [marked(node, solution.style) for node in (by_id["model"].formula, *wanted)]
    assert shown[: len(model)] == model
    asked = set(solution.problem.find) - in_model(solution.robot)
    assert (len(shown) > len(model)) <= bool(asked)


def test_a_part_of_a_solution_has_no_summary() -> None:
    blocks = solution_document(solved("planar-2r"), stages=["energy"]).blocks
    assert not any(isinstance(block, Heading) and block.text == TITLE for block in blocks)
