"""The independent computation: against closed forms, and against results that are wrong."""

from __future__ import annotations

import math

import pytest
from msgspec.structs import replace

import dynsolve
from dynsolve.derivation.newton_euler import Arm, Mass, Motion, energies, inverse_dynamics
from dynsolve.derivation.verification import verify
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Matrix, Node, Number, Product, Sum

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
