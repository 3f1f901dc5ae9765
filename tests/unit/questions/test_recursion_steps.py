"""The steps of the recursions: the parts that a step names add up to its result."""

from __future__ import annotations

import numpy as np
import pytest

import dynsolve
from dynsolve.derivation.arm_values import arms
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Node, Relation, Row, Words
from dynsolve.notation.tree_values import compile_trees
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities.stages import Stage
from dynsolve.solution.solution import Solution
from tests.support import assert_close, numbers


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


# -- of trees, of links without mass or moment of inertia, of joints that no motor drives -----------

TREE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3, from: 1}, {a: l4, from: 3}]
masses:
  - {mass: m2, link: 2, center: {near: [c2, 0, 0]}, inertia: {zz: I2}}
  - {mass: m4, link: 4}
passive: [q3]
find: [tau, fl1, nl1, nl3, nl4]
"""


def why(step: Step) -> str:
    return to_unicode(Row(tuple(Words(part) if isinstance(part, str) else part for part in step.why)))


def test_the_moments_of_a_link_are_about_the_origin_that_its_row_starts_from() -> None:
    steps = {step.id: step for step in dynsolve.solve(TREE).steps}
    assert "o₁" in why(steps["nl3"]) and "o₃" in why(steps["nl4"])
    assert "frame p, from which row i starts" in why(steps["links"])


def test_laws_are_named_where_they_say_something() -> None:
    steps = {step.id: step for step in dynsolve.solve(TREE).steps}
    assert "Euler's law" not in why(steps["nl4"]) + why(steps["nl1"])  # a point mass, and no mass
    assert why(steps["fl1"]) == "The link has no mass: it passes on what the links after it need."


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_without_gravity_nothing_is_said_of_it(convention: str) -> None:
    arm = "gravity: none\ndh: [{theta: q1*}]\nmasses: [{mass: m, link: 1, center: [l, 0, 0]}]\n"
    solution = dynsolve.solve(f"{arm}convention: {convention}\n", method="newton-euler")
    steps = {step.id: step for step in solution.steps}
    assert "ravity" not in why(steps["links"]) and why(steps["al1"]).endswith("The base is at rest.")


def test_no_motor_is_said_to_drive_what_none_drives() -> None:
    steps = {step.id: step for step in dynsolve.solve(TREE, method="newton-euler").steps}
    assert why(steps["tau3"]) == "No motor drives q₃: τ₃ = 0."
    loaded = TREE.replace("find:", "forces: [{link: 2, at: tip, force: [F, 0, 0]}]\nfind:")
    steps = {step.id: step for step in dynsolve.solve(loaded, method="newton-euler").steps}
    assert why(steps["tau1"]).endswith(
        "What acts from outside is added on both sides."
    )  # f and n are less by it


def test_of_a_tree_the_recursions_go_from_row_to_row() -> None:
    more = TREE.replace("{a: l4, from: 3}]", "{theta: q4*, a: l4, from: 3}, {a: l5, from: 4}]")
    steps = {step.id: step for step in dynsolve.solve(more, method="newton-euler").steps}
    assert to_unicode(steps["outwards_fixed"].result[0]) == "ωᵢⁱ = (Rᵢ^p)ᵀ ω_p^p"
    assert to_unicode(steps["inwards"].result[0]).startswith("fᵢⁱ = Rₖⁱ fₖ^k + ")
    assert "Each link k that follows link i" in why(steps["inwards"])
    loaded = more.replace("find:", "forces: [{link: 2, at: tip, force: [F, 0, 0]}]\nfind:")
    steps = {step.id: step for step in dynsolve.solve(loaded, method="newton-euler").steps}
    assert to_unicode(steps["inwards"].result[0]).endswith(" - Fⱼⁱ")
    assert to_unicode(steps["inwards"].result[1]).endswith(" - r_Fjⁱ × Fⱼⁱ - Mⱼⁱ")


def accelerated(q: np.ndarray, rates: np.ndarray, dots: np.ndarray, at: dict[str, float]) -> np.ndarray:
    """τ of TREE by d/dt ∂L/∂q̇ - ∂L/∂q, all of it by differences."""

    def lagrangian(q: np.ndarray, v: np.ndarray) -> float:
        def tip(*turns: tuple[float, float]) -> np.ndarray:
            return sum(length * np.array([np.cos(angle), np.sin(angle)]) for length, angle in turns)

        def places(q: np.ndarray) -> np.ndarray:
            first, long = (at["l1"], q[0]), at["l3"] + at["l4"]
            return np.array([tip(first, (at["c2"], q[0] + q[1])), tip(first, (long, q[0] + q[2]))])

        step = 1e-4
        moved = (places(q + step * v) - places(q - step * v)) / (2 * step)
        masses = np.array([at["m2"], at["m4"]])
        kinetic = (masses * (moved**2).sum(axis=1)).sum() / 2 + at["I2"] * (v[0] + v[1]) ** 2 / 2
        return float(kinetic - at["g"] * masses @ places(q)[:, 1])

    h, one = 1e-3, np.eye(len(q))

    def momentum(t: float) -> np.ndarray:
        there, v = q + t * rates + t * t / 2 * dots, rates + t * dots
        return np.array(
            [(lagrangian(there, v + h * e) - lagrangian(there, v - h * e)) / (2 * h) for e in one]
        )

    slope = np.array([(lagrangian(q + h * e, rates) - lagrangian(q - h * e, rates)) / (2 * h) for e in one])
    return (momentum(h) - momentum(-h)) / (2 * h) - slope


def test_the_forces_of_a_tree_are_those_of_its_lagrangian_in_numbers() -> None:
    at = {"l1": 0.7, "l2": 0.5, "l3": 0.4, "l4": 0.3, "c2": 0.2, "m2": 1.5, "m4": 2.0, "I2": 0.1, "g": 9.81}
    q, rates, dots = np.array([0.3, 0.8, -0.5]), np.array([0.4, -0.7, 0.9]), np.array([0.2, 0.5, -0.6])
    state = {
        f"q{k + 1}{end}": float(x[k])
        for k in range(3)
        for end, x in (("", q), ("_dot", rates), ("_ddot", dots))
    }
    found = numbers(dynsolve.solve(TREE, method="newton-euler").to_json()["results"]["tau"], at | state)
    assert_close(found, accelerated(q, rates, dots, at), "tau", 1e-5)
