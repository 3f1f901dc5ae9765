"""The steps of the recursions: the parts that a step names add up to its result."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.derivation.arm_values import arms
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Node, Relation
from dynsolve.notation.tree_values import compile_trees
from dynsolve.quantities.stages import Stage
from dynsolve.solution.solution import Solution


def solved(name: str) -> Solution:
    return dynsolve.solve(name, method="newton-euler")


def last(node: Node) -> Node:
    """The value at the end of an equation."""
    assert isinstance(node, Relation)
    return node.parts[-1]


def adds_up(solution: Solution, step: Step) -> bool:
    """Whether the values of the parts, at a random state, are together that of the result."""
    (line,), (result,) = step.lines, step.result
    values, _ = next(arms(solution.robot))
    *parts, whole = compile_trees([last(node) for node in (*line.formulas, result)]).run(values)
    return all(abs(sum(part[i][0] for part in parts) - whole[i][0]) < 1e-9 for i in range(3))


@pytest.mark.parametrize("name", ["planar-2r", "rp-vertical", "spherical-rrp"])
def test_the_parts_of_a_step_add_up_to_its_result(name: str) -> None:
    solution = solved(name)
    told = [step for step in solution.steps if step.stage is Stage.NEWTON_EULER and step.lines]
    assert len(told) >= 4
    assert [step.id for step in told if not adds_up(solution, step)] == []


def test_every_quantity_of_a_short_arm_has_its_step() -> None:
    ids = [step.id for step in solved("planar-2r").steps if step.stage is Stage.NEWTON_EULER]
    outwards = [f"{name}{i}" for i in (1, 2) for name in ("wl", "wdl", "al", "acl")]
    assert ids == ["links", *outwards, "fl2", "nl2", "fl1", "nl1", "tau1", "tau2", "lagrange"]


def test_only_what_is_asked_and_what_leads_to_it_is_told() -> None:
    text = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nmasses: [{mass: m, link: 2}]\nfind: [wdl2]\n"
    ids = [step.id for step in dynsolve.solve(text).steps if step.stage is Stage.NEWTON_EULER]
    assert ids == ["links", "wl1", "wdl1", "wl2", "wdl2"]
