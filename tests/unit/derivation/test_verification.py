"""The independent computation, and other ways to one quantity that must agree."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from msgspec.structs import replace

import dynsolve
from dynsolve.derivation.elimination import determinant, is_positive_definite, rank, solved
from dynsolve.derivation.euler_lagrange import agreement, given_axes_agree
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.newton_euler import Arm, Mass, Motion, energies, inverse_dynamics
from dynsolve.derivation.rules import course_rules, derive
from dynsolve.derivation.verification import verify
from dynsolve.errors import ProblemError, VerificationError
from dynsolve.notation.tree import Matrix, Node, Number, Product, Sum
from dynsolve.problem import read_problem
from tests.robots import robots

# -- the independent computation: against closed forms, and against results that are wrong -----------


ONE = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
NONE = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
DOWN = (0.0, -9.81, 0.0)


def pendulum(q: float, qd: float, qdd: float) -> Arm:
    """A point of 2 kg, 0.5 m from a revolute joint; y points up."""
    row = (
        Motion("z", True, q, ((0, 1.0),)),
        Motion("z", False, 0.0),
        Motion("x", False, 0.5),
        Motion("x", True, 0.0),
    )
    return Arm((row,), (Mass(2.0, 1, (0.0, 0.0, 0.0), NONE),), (ONE, (0.0, 0.0, 0.0)), DOWN, (qd,), (qdd,))


def test_a_pendulum() -> None:
    arm = pendulum(0.4, 1.1, -0.6)
    (tau,) = inverse_dynamics(arm, arm.qd, arm.qdd, arm.gravity)
    assert tau == pytest.approx(2 * 0.25 * -0.6 + 2 * 9.81 * 0.5 * math.cos(0.4), rel=1e-14)
    kinetic, potential = energies(arm)
    assert kinetic == pytest.approx(0.5 * 2 * 0.25 * 1.1**2)
    assert potential == pytest.approx(2 * 9.81 * 0.5 * math.sin(0.4))


def test_a_slide_on_a_turntable_feels_centrifugal_and_coriolis_forces() -> None:
    """In polar coordinates: τ = m r² φ̈ + 2 m r ṙ φ̇ and f = m (r̈ - r φ̇²), Goldstein, chapter 1."""
    m, r, rd, rdd, w, dw = 3.0, 0.8, 0.5, -0.2, 1.7, 0.9
    turn = (Motion("z", True, 0.3, ((0, 1.0),)), Motion("x", True, math.pi / 2))
    slide = (Motion("z", False, r, ((1, 1.0),)),)
    mass = Mass(m, 2, (0.0, 0.0, 0.0), NONE)
    arm = Arm((turn, slide), (mass,), (ONE, (0.0, 0.0, 0.0)), (0.0, 0.0, 0.0), (w, rd), (dw, rdd))
    torque, force = inverse_dynamics(arm, arm.qd, arm.qdd, arm.gravity)
    assert torque == pytest.approx(m * r**2 * dw + 2 * m * r * rd * w)
    assert force == pytest.approx(m * (rdd - r * w**2))


def test_a_spinning_body_takes_its_gyroscopic_moment() -> None:
    """M = I α + ω × I ω for a disk that spins while its axis is turned."""
    spin, precession = 5.0, 2.0
    turn = (Motion("z", True, 0.0, ((0, 1.0),)), Motion("x", True, math.pi / 2))
    wheel = (Motion("z", True, 0.0, ((1, 1.0),)),)
    disk = Mass(0.0, 2, (0.0, 0.0, 0.0), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 2.0)))
    arm = Arm((turn, wheel), (disk,), (ONE, (0.0, 0.0, 0.0)), (0.0, 0.0, 0.0), (precession, spin), (0.0, 0.0))
    kinetic, _ = energies(arm)
    assert kinetic == pytest.approx(0.5 * (1.0 * precession**2 + 2.0 * spin**2))
    assert inverse_dynamics(arm, arm.qd, arm.qdd, arm.gravity) == pytest.approx([0.0, 0.0], abs=1e-12)


@pytest.fixture(scope="module")
def solution() -> dynsolve.Solution:
    return dynsolve.solve("planar-2r")


def results(solution: dynsolve.Solution) -> dict[str, Node]:
    forms = {name: solution.forms(name) for name in ("J", "D", "C", "g", "tau", "K", "P")}
    return {"H": solution.forms("H2"), **forms}


def spoiled(tree: Node) -> Node:
    """The tree with its first entry off by a part in a million."""
    if isinstance(tree, Matrix):
        (first, *others), *rows = tree.rows
        return Matrix(((spoiled(first), *others), *rows))
    return Sum((Product((tree, Number(1_000_001, 1_000_000))), Number(1, 1_000_000)))


@pytest.mark.parametrize("name", ["H", "J", "D", "C", "g", "tau", "K", "P"])
def test_a_wrong_result_is_found(solution: dynsolve.Solution, name: str) -> None:
    right = results(solution)
    assert verify(solution.robot, right).max_relative_error < 1e-12
    with pytest.raises(VerificationError, match=f"^{name if name != 'C' else 'Cqd'} differs"):
        verify(solution.robot, {**right, name: spoiled(right[name])})


def test_a_result_of_the_wrong_shape_is_found(solution: dynsolve.Solution) -> None:
    right = results(solution)
    tau = right["tau"]
    assert isinstance(tau, Matrix)
    with pytest.raises(VerificationError):
        verify(solution.robot, {**right, "tau": Matrix(tau.rows[:1])})


def test_the_same_states_every_time(solution: dynsolve.Solution) -> None:
    assert verify(solution.robot, results(solution)) == verify(solution.robot, results(solution))


def test_masses_do_not_hide_each_other(solution: dynsolve.Solution) -> None:
    """A body left out of the independent computation is noticed."""
    robot = replace(solution.robot, bodies=solution.robot.bodies[:1])
    with pytest.raises(VerificationError):
        verify(robot, results(solution))


# -- different ways to one quantity agree, exactly ---------------------------------------------------


@settings(max_examples=25)
@given(robots(max_joints=3))
def test_the_courses_energies_are_those_of_the_link_frames(text: str) -> None:
    robot = read_problem(text).robot
    course, fast = Derivation(course_rules(robot)), derive(robot)
    for body in robot.bodies:
        assert course[f"Kv{body.name}"] == fast[f"Kv{body.name}"]
        if given_axes_agree(robot, body, fast):
            assert course[f"Kw{body.name}"] == fast[f"Kw{body.name}"]


@settings(max_examples=25)
@given(robots(max_joints=3))
def test_reading_off_and_assembling_agree(text: str) -> None:
    robot = read_problem(text).robot
    assert agreement(robot, derive(robot)).holds


def test_a_value_put_in_stands_for_its_rule() -> None:
    robot = read_problem(
        "title: t\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\ngravity: [0, -g, 0]\n"
    ).robot
    ring = robot.ring
    slip = Derivation(derive(robot).rules.values(), {"P1": ring.symbol("m") * ring.symbol("g")})
    assert slip["P"] == ring.symbol("m") * ring.symbol("g")
    assert slip["g"].is_zero
    assert slip["D"] == derive(robot)["D"]


# -- tables whose rows start from earlier frames: the derivation goes by the links, not by the rows --


TWO_ARMS = """
gravity: [0, -g, 0]
dh:
  - {theta: q1*, a: l1}
  - {theta: q2*, a: l2}
  - {from: 1, theta: q3*, a: l3}
  - {from: 3, d: q4*, alpha: beta}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {zz: I2}}
  - {mass: m3, link: 3, center: midpoint, inertia: {zz: I3}}
  - {mass: m4, link: 4, center: [x, y, 0]}
"""
APART = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {from: 0, theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""

MODIFIED = """
convention: modified
gravity: [0, -g, 0]
dh:
  - {theta: q1*}
  - {a: l1, theta: q2*}
  - {from: 1, a: l1, theta: q3*}
  - {from: 3, a: l3, alpha: beta, d: q4*}
masses:
  - {mass: m1, link: 1, center: [lc1, 0, 0]}
  - {mass: m2, link: 2, center: [lc2, 0, 0], inertia: {zz: I2}}
  - {mass: m3, link: 3, center: [lc3, 0, 0], inertia: {zz: I3}}
  - {mass: m4, link: 4, center: [x, y, 0]}
"""


@pytest.mark.parametrize("text", [TWO_ARMS, MODIFIED], ids=["standard", "modified"])
def test_both_ways_and_the_check_agree(text: str) -> None:
    """The textbook's Jacobians, those in the links' frames, the recursions, and the check on numbers."""
    problem = read_problem(text, "tree.yaml")
    solution = dynsolve.solve(problem)
    assert solution.agreement is not None
    assert solution.agreement.holds
    by_recursions = dynsolve.solve(problem, method="newton-euler")
    assert solution.values["tau"] == by_recursions.values["tau"]


def test_two_pendulums_on_one_base_do_not_know_of_each_other() -> None:
    results = dynsolve.solve(APART).to_json()["results"]
    assert results["D"] == [["m1*l1**2", "0"], ["0", "m2*l2**2"]]
    assert results["g"] == ["m1*g*l1*cos(q1)", "m2*g*l2*cos(q2)"]
    assert results["H"][1][0] == ["cos(q2)", "-sin(q2)", "0", "l2*cos(q2)"]


def test_a_branch_leaves_the_rest_of_the_arm_alone() -> None:
    """Joint 2 moves neither link 3 nor link 4."""
    solution = dynsolve.solve(TWO_ARMS)
    assert all(entry == 0 for entry in solution.symbolic("Jv3")[:, 1])
    assert solution.D[1, 2] == solution.D[1, 3] == 0


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ("1", "none of frame 0"),
        ("-1", "none of frame 0"),
        ("base", "none of frame 0"),
        ("[0]", "none of frame 0"),
    ],
)
def test_a_row_starts_from_an_earlier_frame(start: str, message: str) -> None:
    with pytest.raises(ProblemError, match=message) as raised:
        read_problem(f"dh: [{{from: {start}, theta: q1*, a: l1}}]\n", "tree.yaml")
    assert raised.value.findings[0].line == 1


def test_the_frame_before_may_be_named() -> None:
    problem = read_problem("dh: [{from: 0, theta: q1*, a: l1}, {from: 1, theta: q2*, a: l2}]\n", "chain.yaml")
    assert not problem.robot.is_tree


# -- elimination on numbers, against values that are known and against NumPy -------------------------


ROUNDING = 1e-10


def test_known_values() -> None:
    assert solved([[2.0, 1.0], [1.0, 3.0]], [3.0, 5.0]) == pytest.approx([0.8, 1.4])
    assert determinant([[0.0, 2.0], [3.0, 1.0]]) == pytest.approx(-6.0)
    assert determinant([[1.0, 2.0, 0.0], [2.0, 4.0, 1.0], [0.0, 1.0, 1.0]]) == pytest.approx(-1.0)
    assert determinant([[1.0, 2.0], [2.0, 4.0]]) == 0.0
    assert rank([[0.0, 0.0], [0.0, 0.0]], ROUNDING) == 0
    assert rank([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]], ROUNDING) == 2


def test_what_is_rounding() -> None:
    small = [[1e-3, 0.0], [0.0, 1e-8]]
    assert rank(small, 1e-4) == 1
    assert rank(small, 1e-6) == 2
    assert rank(small, 1e-2, scale=1.0) == 0
    assert is_positive_definite(small)
    assert not is_positive_definite(small, 1e-4)


@pytest.mark.parametrize("size", [1, 2, 3, 5])
def test_as_numpy_has_it(size: int) -> None:
    random = np.random.default_rng(size)
    for _ in range(20):
        A, b = random.normal(size=(size, size)), random.normal(size=size)
        assert solved(A.tolist(), b.tolist()) == pytest.approx(np.linalg.solve(A, b).tolist(), rel=1e-6)
        assert determinant(A.tolist()) == pytest.approx(np.linalg.det(A))
        for columns in range(1, size + 1):
            thin = A[:, :columns]
            assert rank((thin @ thin.T).tolist(), ROUNDING) == np.linalg.matrix_rank(thin) == columns
        symmetric = A + A.T
        definite = bool((np.linalg.eigvalsh(symmetric) > 0).all())
        assert is_positive_definite(symmetric.tolist()) is definite
        assert is_positive_definite((A @ A.T).tolist())
