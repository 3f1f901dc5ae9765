"""Singular configurations of arms that the literature discusses, and what is lost there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

import dynsolve
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.configurations import states_of, zero_near
from dynsolve.derivation.rules import derive
from dynsolve.derivation.search_ring import search_ring
from dynsolve.derivation.singular.sets import SingularSet, singular_set
from dynsolve.notation.python import to_python
from dynsolve.notation.tree_values import compile_trees
from dynsolve.problem import read_problem
from dynsolve.questions.singular.forms import SingularForms
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import ROOT

# -- singular configurations of arms whose Jacobians the literature discusses ------------------------


# (the table, the task, the rank, the alternatives; official results of INF3480 2010, 2012 (UiO) and
# Robotics 1, 2022 and 2023 (Sapienza), and of Spong, Hutchinson, Vidyasagar, section 4.9)
ARMS = [
    ("dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]", "", 2, [["sin(q2)"]]),
    ("dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]", "", 2, [["sin(q2)", "sin(q3)"]]),
    ("dh: [{theta: q1* + 180deg, d: L1, alpha: 90deg}, {theta: -90deg, d: d2* + L2, alpha: 90deg}, "
     "{theta: q3* + 90deg, a: L3}]", "", 3, [["cos(q3)"], ["L2 + d2 + L3*cos(q3)"]]),
    ("dh: [{d: d1*, alpha: -90deg}, {d: d2*, a: l1, alpha: 60deg}, {theta: q3*, a: l2}]", "", 3,
     [["sin(q3)"]]),
    ("gravity: none\ndh: [{theta: q1* + 90deg, alpha: 90deg}, {d: q2*, alpha: -90deg}, "
     "{theta: q3*, alpha: 90deg}, {d: q4*}]", "task: [tip.x, tip.y, q1 + q3]", 3, [["q2", "sin(q3)"]]),
    ("dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, alpha: 90deg}, {d: d3*}]", "", 3,
     [["d3"], ["sin(q2)"]]),
]  # fmt: skip


def set_of(table: str, task: str) -> Any:
    robot = read_problem(f"{table}\n{task}\nfind: [Jr]\n").robot
    ring = search_ring(robot.ring, (), {})
    return singular_set(derive(robot)["Jr"].map(Transfer(robot.ring, ring)))


OFFSET = """
dh: [{theta: q1*, d: L1, alpha: 90deg, a: a1}, {theta: q2*, a: L2, d: e}, {theta: q3*, a: L3, alpha: 90deg},
     {theta: q4*, a: L4}]
"""


@pytest.mark.parametrize(("table", "task", "rank", "alternatives"), ARMS)
def test_the_alternatives(table: str, task: str, rank: int, alternatives: list[list[str]]) -> None:
    found = set_of(table, task)
    form = Compactor(found.minors[0].ring).form
    written = [sorted(to_python(form(c.expr)) for c in one) for one in found.alternatives]
    assert found.rank == rank
    assert sorted(written) == sorted(sorted(one) for one in alternatives)


@pytest.mark.parametrize(
    ("offset", "lengths"), [("2", "11"), ("2*l", "ll"), ("b + c", "bc"), ("b + 2*c", ["b", "2*c"])]
)
def test_a_factor_that_is_0_where_another_is_as_well_is_no_case(offset: str, lengths: Sequence[str]) -> None:
    """a₁ + a₂ c₂ + a₃ c₂₃ is 0 at c₂ = c₂₃ = -1 alone where a₁ = a₂ + a₃: the arm is folded."""
    second, third = lengths
    rows = (
        f"{{theta: q1*, a: {offset}, alpha: 90deg}}, {{theta: q2*, a: {second}}}, {{theta: q3*, a: {third}}}"
    )
    found = dynsolve.solve(f"gravity: none\ndh: [{rows}]\nfind: [singular]\n").to_json()["results"]
    assert found["singular"] == [["sin(q3) = 0"]]


def test_what_cannot_hold_together_is_not_listed() -> None:
    """Its minors vanish for q₂ + q₃ = 0 and L₃ = a₁ alone, or never: that is a condition on lengths."""
    found = set_of(OFFSET, "task: twist")
    assert (found.rank, found.alternatives) == (4, ())
    assert found.pivots == 2 and sum(map(len, found.minors)) < 30


def test_what_is_there_for_some_lengths_alone_says_for_which() -> None:
    found = set_of(
        "dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {d: d3*, alpha: 90deg}, "
        "{theta: q4*, a: L4}]", "",
    )  # fmt: skip
    form = Compactor(found.minors[0].ring).form
    told = [[to_python(form(bound.value)) for bound in bounds] for bounds in found.exist]
    assert told == [["L4 - L2"], ["L4 - L2"], [], []]


def test_what_vanishes_with_a_factor_of_all_minors_is_no_case_of_special_lengths() -> None:
    """Where s2 = 0 and a1 = a2 they are 0 because a1 + a2 c2 is, and that is a case."""
    found = set_of("dh: [{theta: q1*, a: a1, alpha: 90deg}, {theta: q2*, a: a2}]", "")
    form = Compactor(found.minors[0].ring).form
    ((bound,),) = found.exist
    assert not found.special and not found.may_be_others
    assert (to_python(form(bound.value)), bound.is_strict) == ("a2 - a1", False)


def test_what_is_too_long_is_left_out_by_count() -> None:
    """Seven joints and a point: the cases have too many terms, and no clock decides."""
    table = (ROOT / "problems" / "panda-7r.yaml").read_text("utf-8").split("dh:")[1].split("masses:")[0]
    assert set_of(f"dh:{table}", "task: [tip.x, tip.y, tip.z]") is None


# -- what is lost at singular configurations: as many directions as the rank is less, Jᵀ w = 0 for each


WRIST = "{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {theta: q3*}"
LOSING = {
    # table, task, rows of J, the rank of each case
    "two links": ("{theta: q1*, a: l1}, {theta: q2*, a: l2}", "[tip.x, tip.y]", 2, [1]),
    "a wrist, all six rates": (WRIST, "twist", 6, [2]),
    "two links and a slide, all six rates": (
        "{theta: q1*, a: l1}, {theta: q2*, a: l2, alpha: 180deg}, {d: d3*}, {theta: q4*}", "twist", 6, [3]),
}  # fmt: skip


@pytest.mark.parametrize(("table", "task", "rows", "ranks"), LOSING.values(), ids=LOSING)
def test_every_direction_that_is_lost_is_found(table: str, task: str, rows: int, ranks: list[int]) -> None:
    """The verification of `solve` holds each of them against the Jacobian in numbers."""
    solution = dynsolve.solve(f"dh: [{table}]\ntask: {task}\nfind: [singular]\n")
    found = solution.values["singular"]
    assert isinstance(found, SingularSet)
    assert [loss.rank for loss in found.losses] == ranks
    assert [len(loss.directions) for loss in found.losses] == [rows - rank for rank in ranks]


FEW = [
    WRIST,
    "{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {theta: q3*, d: h}",
    "{theta: q1*, a: a1}, {theta: q2*, a: a2, alpha: 180deg}, {d: q3*}, {theta: q4*, d: d4}",
    "{theta: q1*, alpha: 90deg}, {d: q2*, alpha: -90deg}, {theta: q3*, a: l, alpha: 90deg}",
    "{theta: q1*, a: l}, {theta: q2*, a: l}, {theta: q3*, a: l}, {d: q4*, alpha: 90deg}, {theta: q5*, a: c}",
]


@pytest.mark.parametrize("table", FEW)
def test_a_motion_that_is_lost_is_possible_close_by(table: str) -> None:
    """Of few joints and all six rates: w is in the range of J, nearly, as soon as the arm is not singular."""
    solution = dynsolve.solve(f"gravity: none\ndh: [{table}]\ntask: twist\nfind: [singular]\n")
    robot = solution.robot
    shown = SingularForms(robot, solution.values)
    found = shown.singular_set
    assert found is not None and found.losses
    program = compile_trees([shown.matrix(solution.values["Jr"])])
    for loss, zeros, lost in zip(found.losses, shown.singular, shown.lost_here, strict=True):
        assert loss.everywhere == loss.impossible == 6 - found.rank
        start = states_of(robot, program)[0]
        there = zero_near(robot, compile_trees(zeros), start)
        assert there is not None and lost
        close = there | {
            name: there[name] + 1e-5 * (start[name] - there[name] + 1) for name, _ in robot.ring.coordinates
        }
        J = np.array(program.run(close)[0])
        reached = J @ np.linalg.pinv(J)
        for w in np.array(compile_trees(lost).run(there)):
            assert np.allclose(reached @ w, w, atol=1e-3)


def test_the_minors_of_a_jacobian_with_a_column_of_zeros_are_its_own() -> None:
    """Joint 3 turns about the line through the tip: no entry of another matrix is told, nor a place."""
    rows = "{theta: q1*, alpha: -90deg}, {theta: q2*, a: b, alpha: 90deg}, {theta: q3*, d: c}"
    solution = dynsolve.solve(f"gravity: none\ndh: [{rows}]\nfind: [det, singular]\n")
    text = " ".join(report(solution, Format.TEXT).decode().split())
    assert "Column 3 is 0, so the determinant is 0 in every configuration" in text
    assert "its rank is at most 2; column 3 is 0." in text and "turned among each other" not in text
    assert "minor (rows 1, 2, columns 1, 2) = (b s₂ - c c₂)(c s₂ + b c₂)" in text


def test_what_cannot_be_parted_is_not_said_to_be_lost() -> None:
    """What is orthogonal to the motions that are never possible has a component 1 + l² cos²(q3)."""
    table = "{theta: q1*, alpha: 90deg}, {theta: q2*, alpha: -90deg}, {theta: q3*, a: l, alpha: 90deg}"
    steps = dynsolve.solve(f"gravity: none\ndh: [{table}]\ntask: twist\nfind: [singular]\n").steps
    why = next(step.why for step in steps if step.id == "singular_1")
    told = "".join(part if isinstance(part, str) else "·" for part in why)
    assert "is orthogonal to ·, ·, · and ·. " in told and "lost" not in told
    assert "3 motions are impossible in every configuration, here 4." in told


@pytest.mark.parametrize(
    ("table", "task", "loads"),
    [
        (
            WRIST,
            "twist",
            {"singular_1": "A moment along it needs no ", "lost": "A force along it, "},
        ),
        (FEW[1], "twist", {"singular_1": "A force and a moment along it need no "}),
        ("{theta: q1*, a: l}, {d: d2*}", "[tip.x, tip.y, tip.z]", {"lost": "A force along it, "}),
    ],
)
def test_it_is_said_what_a_vector_is(table: str, task: str, loads: dict[str, str]) -> None:
    """By what it has: of no moment it is a force."""
    text = f"gravity: none\ndh: [{table}]\ntask: {task}\nfind: [singular, lost]\n"
    words = {
        step.id: "".join(part for part in step.why if isinstance(part, str))
        for step in dynsolve.solve(text).steps
    }
    assert all(told in words[name] for name, told in loads.items())


def test_a_determinant_of_one_factor_is_0_there_for_all_parameters() -> None:
    """q2 sin(beta) = q3 cos(beta), also where sin(beta) = 0 and q2 is not given by it."""
    solution = dynsolve.solve(
        "gravity: none\ndh: [{theta: q1*, a: l, alpha: beta}, {d: q2*, alpha: -90deg}, {d: q3*}]\n"
        "find: [singular]\n"
    )
    found = solution.values["singular"]
    assert isinstance(found, SingularSet)
    assert not found.special and not found.may_be_others
