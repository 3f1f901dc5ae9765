"""Springs, rotors and friction: the balance of power, the recursions, and results that are wrong."""

from __future__ import annotations

from random import Random

import pytest
from msgspec.structs import replace

import dynsolve
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.link_frame import velocities
from dynsolve.derivation.rules import derive
from dynsolve.derivation.verification import verify
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node, Number, Product
from dynsolve.problem import read_problem
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Method

ACTING = """
friction: {q1: {viscous: f1, coulomb: c1}, q2: {coulomb: c2}}
springs: [{stiffness: k, of: 2*q2 - q1, rest: x0}, {energy: h*q1^3 + h*(1 - cos(q2))}]
dampers: [{damping: b, of: q2 - q1}]
motors: [{turns: q1, inertia: J1, ratio: n1}, {turns: q2, inertia: J2, ratio: n2, carrier: 1, axis: y},
         {turns: q1, inertia: J3, ratio: n3, carrier: 2, axis: x}]
"""
TILTED = """
gravity: [gx, 0, -g]
dh: [{theta: q1*, d: l1, a: l2, alpha: 90deg}, {theta: q2*, a: l3, alpha: 30deg}]
masses: [{mass: m1, link: 1, center: [x1, 0, 0], inertia: {xx: Ix, yy: Iy, zz: Iz}}, {mass: m2, link: 2}]
"""
SLIDING = """
convention: modified
dh: [{theta: q1*}, {alpha: 90deg, a: l1, d: q2*}]
masses: [{mass: m1, link: 1, center: [x1, 0, 0], inertia: {zz: Iz}}, {mass: m2, link: 2, center: origin}]
"""
DRAWN = """
model:
  coordinates: {q1: prismatic, q2: revolute}
  bodies: [{mass: m1, at: [q1, 0, 0]}, {mass: m2, at: [q1 + l*sin(q2), 0, l*cos(q2)]}]
springs: [{stiffness: k, of: q1, rest: x0}]
friction: {q1: f1, q2: {coulomb: c2}}
motors: [{turns: q1, inertia: J1, ratio: n1}]
"""
ELASTIC = """
dh: [{theta: q1*, a: l1}]
masses: [{mass: m1, link: 1}]
motors: [{turns: q2*, inertia: J}]
springs: [{stiffness: k, of: q1 - q2}]
dampers: [{damping: b, of: q1 - q2}]
"""
EVERY = {
    "tilted": TILTED + ACTING,
    "sliding": SLIDING + ACTING,
    "mechanism": DRAWN,
    "elastic": ELASTIC,
}


@pytest.mark.parametrize("text", EVERY.values(), ids=EVERY)
def test_power_is_balanced(text: str) -> None:
    """d/dt (K + P) = q̇ᵀ τ - q̇ᵀ friction, exactly: the drives' power less what friction takes."""
    robot = read_problem(text).robot
    values, qd = derive(robot), velocities(robot)
    stored: Expr = values["K"] + values["P"]
    supplied = (qd.T @ values["tau"])[0, 0]
    lost = (qd.T @ values["friction"])[0, 0]
    assert robot.ring.time_derivative(stored) == supplied - lost


@pytest.mark.parametrize("text", EVERY.values(), ids=EVERY)
def test_friction_takes_power_whatever_the_rates(text: str) -> None:
    robot = read_problem(text).robot
    lost = (velocities(robot).T @ derive(robot)["friction"])[0, 0]
    draw = Random(3)
    for _ in range(20):
        values = {name: draw.uniform(0.1, 2) for name in robot.parameters}
        for q in robot.coordinates:
            values |= {q.name: draw.uniform(-2, 2), q.velocity: draw.uniform(-2, 2)}
        assert evaluate(lost, values) >= 0


@pytest.mark.parametrize("name", ["tilted", "sliding", "elastic"])
def test_the_recursions_give_the_forces_of_the_lagrangian(name: str) -> None:
    robot = read_problem(EVERY[name]).robot
    by_recursions = replace(robot, questions=replace(robot.questions, method=Method.NEWTON_EULER))
    assert derive(by_recursions)["tau"] == derive(robot)["tau"]


def test_at_rest_there_is_no_friction_in_g() -> None:
    robot = read_problem(TILTED + ACTING).robot
    values = derive(robot)
    assert values["g"] == values["g_direct"]
    assert not any(map(robot.ring.depends_on_coordinates, _without_coordinates(robot, values["friction"])))


def _without_coordinates(robot: Robot, friction) -> list[Expr]:
    """The friction with every rate put to 0."""
    return [robot.ring.without(entry, 1) for entry in friction.entries]


@pytest.mark.parametrize("name", ["friction", "g", "D", "K", "P"])
def test_a_wrong_result_is_found(name: str) -> None:
    solution = dynsolve.solve(TILTED + ACTING)
    results: dict[str, Node] = {n: solution.forms(n) for n in ("D", "C", "g", "friction", "tau", "K", "P")}
    assert verify(solution.robot, results).max_relative_error < 1e-12
    spoilt = results[name]
    rows = getattr(spoilt, "rows", None)
    doubled = Product((Number(2), spoilt)) if rows is None else replace(spoilt, rows=(rows[1], rows[0]))
    with pytest.raises(VerificationError, match=name):
        verify(solution.robot, results | {name: doubled})
