"""Motion under constraints against Pinocchio's constrained dynamics, a tip that is held in its place.

Pinocchio solves D q̈ + C q̇ + g = τ + Jᵀ f and J q̈ + J̇ q̇ = 0 on numbers (its `constraintDynamics`);
ours has the multipliers in closed form, and q̈ is what they leave.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
import yaml

from tests.oracle.comparison import random_state
from tests.oracle.pinocchio_arm import model_of
from tests.oracle.reading import Arm, Array, read
from tests.support import assert_close, numbers, solve_json

TEXTS = {
    "planar": """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
masses:
  - {mass: m1, link: 1, center: midpoint}
  - {mass: m2, link: 2, center: midpoint, inertia: {zz: 2}}
  - {mass: m3, link: 3, center: tip}
friction: {q1: {viscous: b1, coulomb: b2}, q3: b3}
constraints: [tip.x - x0, tip.y - y0]
find: [D, C, g, Ac, lambda, friction]
""",
    "spatial": """
gravity: [0, 0, -g]
dh: [{d: q1*}, {theta: q2*, alpha: 90deg}, {theta: q3*, a: l1}, {d: q4*}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 3, center: midpoint}, {mass: m3, link: 4, center: tip}]
constraints: [tip.x - x0, tip.y - y0, tip.z - z0]
find: [D, C, g, Ac, lambda]
""",
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_a_tip_that_is_held(text: str) -> None:
    problem, solution = yaml.safe_load(text), solve_json(text)
    forces = [coordinate["force"] for coordinate in solution["coordinates"]]
    for seed in range(3):
        values, q, qd, _ = random_state(problem, seed)
        tau = np.random.default_rng(seed).normal(size=len(q))
        values |= {"b1": 0.7, "b2": 0.4, "b3": 1.3} | dict(zip(forces, tau, strict=True))
        ours = {name: np.array(numbers(solution["results"][name], values)) for name in problem["find"]}
        tau -= ours.get("friction", np.zeros(len(q))).ravel()
        multipliers = ours["lambda"].ravel()
        free = tau + ours["Ac"].T @ multipliers - ours["C"] @ qd - ours["g"].ravel()
        accelerations, force = held_tip(read(problem, values), q, qd, tau)
        assert_close(np.linalg.solve(ours["D"], free), accelerations, "q_ddot")
        assert_close(multipliers, force[: len(multipliers)], "lambda")


def held_tip(arm: Arm, q: Array, qd: Array, tau: Array) -> tuple[Array, Array]:
    """The accelerations of an arm whose tip stays where it is, and the force that holds it there."""
    model, frames, E = model_of(arm)
    joint, place = frames[-1]
    along = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    contacts = pin.StdVec_RigidConstraintModel()
    contacts.append(pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, joint, place, along))
    found = pin.StdVec_RigidConstraintData()
    found.append(contacts[0].createData())
    data = model.createData()
    pin.initConstraintDynamics(model, data, contacts, found)
    settings = pin.ProximalSettings(1e-14, 1e-10, 20)  # across its plane a planar arm is held already
    pin.constraintDynamics(model, data, E @ q, E @ qd, E @ tau, contacts, found, settings)
    return E.T @ data.ddq, found[0].contact_force.linear
