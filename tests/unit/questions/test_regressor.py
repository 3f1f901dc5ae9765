"""τ = Y a: its product, its length against the rank of numbers, and lengths that the literature counts."""

from __future__ import annotations

from pathlib import Path

import pytest

import dynsolve
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.rules import derive
from dynsolve.errors import ProblemError, VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation import tree
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from dynsolve.questions.parameters.check import verify_model
from dynsolve.questions.parameters.derive import minimal_parameters, parameters_for, regressor
from dynsolve.robot.model import Robot

PROBLEMS = Path(__file__).parents[3] / "problems"

OFFSET = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1 + l2}, {theta: q2*}]
masses: [{mass: m, link: 2, center: [x, y, 0]}]
parameters: {known: [l1, l2, g]}
find: [Y, a]
"""


def solved(text: str) -> tuple[Robot, Derivation]:
    robot = read_problem(text).robot
    return robot, derive(robot)


def of_library(stem: str, known: str) -> tuple[Robot, Derivation]:
    text = (PROBLEMS / f"{stem}.yaml").read_text(encoding="utf-8")
    kept = [line for line in text.splitlines() if not line.startswith("find:")]
    return solved("\n".join((*kept, f"parameters: {{known: [{known}]}}", "find: [Y, a]", "")))


def test_an_unknown_that_motions_tell_by_itself_is_an_entry() -> None:
    """Rods and a load of unknown masses, lengths known: none stands with another, M₁ p² - M₃ (3p² - q²)."""
    rods = """
gravity: none
dh: [{theta: q1*, a: p}, {theta: q2*, a: q}]
masses:
  - {mass: M1, link: 1, center: midpoint, shape: {rod: {length: p}}}
  - {mass: M2, link: 2, center: midpoint, shape: {rod: {length: q}}}
  - {mass: M3, link: 2, center: tip}
parameters: {known: [p, q]}
find: [Y, a]
"""
    robot, values = solved(rods)
    assert {*values["a"].entries} == {robot.ring.symbol(name) for name in ("M1", "M2", "M3")}
    assert values["Y"] @ values["a"] == values["tau"]


@pytest.mark.parametrize(
    ("stem", "known", "length"),
    [
        ("planar-2r", "", 5),
        ("planar-2r", "g", 5),  # Spong, Hutchinson, Vidyasagar (2006), section 7.5.3
        ("planar-2r", "l1, g", 4),
        ("in3140-rp", "g", 2),  # I_1zz and m_2 alone stand in its forces
        ("scara-rrpr", "a1, a2, g", 5),
        # Khalil and Dombre (2002), section 9.4, with lengths and g known
        pytest.param("puma560", "a2, a3, d3, d4, g", 36, marks=pytest.mark.slow),
    ],
)
def test_the_length_is_the_literatures(stem: str, known: str, length: int) -> None:
    _, values = of_library(stem, known)
    parameters = values["a"]
    assert len(parameters.rows) == length
    assert values["Y"] @ parameters == values["tau"]


def test_a_known_sum_of_lengths_is_divided_out() -> None:
    """(l1 + l2) m beside m counts as one parameter where the lengths are known."""
    _, values = solved(OFFSET)
    found = {str(entry) for entry in values["a"].entries}
    assert found == {"Expr(1*m*x^2 + 1*m*y^2)", "Expr(1*m*x)", "Expr(1*m*y)", "Expr(1*m)"}
    assert values["Y"] @ values["a"] == values["tau"]


def test_division_by_a_known_length() -> None:
    """With l1³ m given and l1 known, Y divides by l1."""
    text = "dh: [{theta: q1*, a: l1}]\ngravity: [0, -g, 0]\nmasses: [{mass: m, link: 1}]\n"
    found = dynsolve.solve(text + "parameters: {known: [l1, g], p1: l1*m}\nfind: [Y, a]\n").to_json()
    assert found["results"]["a"] == ["m*l1"]
    assert found["results"]["Y"] == [["l1*q1_ddot + g*cos(q1)"]]
    found = dynsolve.solve(text + "parameters: {known: [l1, g], p1: l1^3*m}\nfind: [Y, a]\n").to_json()
    assert found["results"]["Y"] == [["(l1*q1_ddot + g*cos(q1))/l1**2"]]


def test_friction_and_a_spring_at_rest_elsewhere_are_two_parameters() -> None:
    """f_c sgn(q̇) and −k x₀ differ where the motion goes back: the length of a is verified there too."""
    found = dynsolve.solve(
        "dh: [{d: x*}]\nmasses: [{mass: m, link: 1}]\nfriction: {x: {coulomb: fc}}\n"
        "springs: [{stiffness: k, of: x, rest: x0}]\ngravity: [0, 0, 0]\nfind: [Y, a]\n"
    ).to_json()
    assert sorted(found["results"]["a"]) == ["fc", "k", "k*x0", "m"]


def test_parameters_that_do_not_reach_are_told() -> None:
    text = "dh: [{theta: q1*, a: l1}]\ngravity: [0, -g, 0]\nmasses: [{mass: m, link: 1}]\n"
    found = dynsolve.solve(text + "parameters: {p1: m*l1^2}\nfind: [Y]\n").to_json()
    why = "the forces are not linear in the given parameters; they would be if g and l1 were `known`"
    assert found["results"]["Y"] == {"skipped": why}
    found = dynsolve.solve(text + "parameters: {p1: m*l1^2, known: [g, l1]}\nfind: [Y]\n").to_json()
    assert "skipped" not in found["results"]["Y"]


def test_the_parameters_that_belong_to_a_regressor() -> None:
    robot, values = of_library("planar-2r", "g")
    Y, tau = values["Y"], values["tau"]
    turned = Matrix(Y.ring, tuple(tuple(reversed(row)) for row in Y.rows))
    assert parameters_for(robot, tau, turned) == Matrix(Y.ring, tuple(reversed(values["a"].rows)))
    assert parameters_for(robot, tau, turned.block(0, 2, 0, 4)) is None
    assert parameters_for(robot, tau, tau) is None


def test_zero_forces_need_no_parameters() -> None:
    robot, _ = of_library("planar-2r", "g")
    none = Matrix.zero(robot.ring, 2, 1)
    parameters = minimal_parameters(robot, none)
    assert not isinstance(parameters, Skipped) and not parameters.rows
    assert not isinstance(regressor(robot, none, parameters), Skipped)


def test_the_check_finds_a_wrong_entry_and_a_parameter_too_many() -> None:
    robot, values = of_library("planar-2r", "g")
    forms = Forms(robot, values)
    right = {name: forms(name) for name in ("Y", "a", "tau")}
    verify_model(robot, right)
    Y, a = right["Y"], right["a"]
    assert isinstance(Y, tree.Matrix) and isinstance(a, tree.Matrix)
    with pytest.raises(VerificationError, match="differs"):
        verify_model(robot, {**right, "Y": tree.Matrix((Y.rows[1], Y.rows[0]))})
    longer = tree.Matrix((*a.rows, (tree.Symbol("m1"),)))
    with pytest.raises(VerificationError, match="minimal"):
        verify_model(robot, {**right, "Y": tree.Matrix(tuple((*r, tree.ZERO) for r in Y.rows)), "a": longer})


@pytest.mark.parametrize("name", ["Y", "a", "equilibria", "balance", "linear_A", "Lambda"])
def test_without_masses_nothing_is_asked_of_the_model(name: str) -> None:
    with pytest.raises(ProblemError, match="no answer of this problem"):
        read_problem(f"dh: [{{theta: q1*, a: l1}}]\nfind: [{name}]\n")


@pytest.mark.parametrize(("axes", "is_said"), [("alpha: 90deg", True), ("alpha: 0", False)])
def test_that_a_squared_sine_is_put_otherwise_is_said_where_there_is_one(axes: str, is_said: bool) -> None:
    arm = f"""
gravity: [0, 0, -g]
dh: [{{theta: q1*, d: h, {axes}}}, {{theta: q2*, a: l2}}]
masses: [{{mass: m, link: 2, center: {{near: [lc, 0, 0]}}, inertia: {{xx: Ix, yy: Iy, zz: Iz}}}}]
find: [Y, a]
"""
    (step,) = (step for step in dynsolve.solve(arm).steps if step.id == "a")
    told = "".join(part if isinstance(part, str) else to_unicode(part) for part in step.lines[0].by)
    assert ("occur with sin²(q₂) = 1 - cos²(q₂), without" in told) is is_said
