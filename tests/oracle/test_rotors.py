"""Rotors against Pinocchio, which has each as a body of its own, on a joint of the link that carries it.

The body has no mass and a moment about its axis alone; its joint turns with the ratio of the gear times
the rate of the coordinate.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
import yaml

from tests.oracle.comparison import random_state
from tests.oracle.pinocchio_arm import model_of
from tests.oracle.reading import read
from tests.support import assert_close, numbers, solve_json

TEXTS = {
    "tilted": """
gravity: [gx, 0, -g]
dh: [{theta: q1*, d: l1, a: l2, alpha: 90deg}, {theta: q2*, a: l3, alpha: 30deg}, {theta: q3*, a: l4}]
masses:
  - {mass: m1, link: 1, center: [x1, y1, 0], inertia: {xx: 2, yy: 3, zz: 4}}
  - {mass: m2, link: 2, center: [x2, 0, z2], inertia: {xx: 2, yy: 2, zz: 1}}
  - {mass: m3, link: 3, center: [x3, 0, 0]}
motors:
  - {turns: q1, inertia: J1, ratio: n1}
  - {turns: q2, inertia: J2, ratio: n2, carrier: 1, axis: z}
  - {turns: q3, inertia: J3, ratio: n3, carrier: 2, axis: x}
find: [tau]
""",
    "slide": """
convention: modified
dh: [{theta: q1*}, {alpha: 90deg, a: l1, theta: q2*}, {alpha: 60deg, d: q3*}]
masses: [{mass: m1, link: 2, center: [x1, 0, 0], inertia: {zz: 2}}, {mass: m2, link: 3, center: origin}]
motors: [{turns: q3, inertia: J1, ratio: n1, carrier: 2, axis: y}, {turns: q2, inertia: J2, carrier: 3}]
find: [tau]
""",
}
JOINTS = {"x": pin.JointModelRX, "y": pin.JointModelRY, "z": pin.JointModelRZ}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_rotors_are_bodies_on_joints_of_their_own(text: str) -> None:
    problem, results = yaml.safe_load(text), solve_json(text)["results"]
    for seed in range(3):
        values, q, qd, qdd = random_state(problem, seed)
        values |= {f"{letter}{i}": 0.3 * i + seed for i in (1, 2, 3) for letter in "Jn"}
        model, frames, E = model_of(read(problem, values))
        for place, motor in enumerate(problem["motors"]):
            axis = motor.get("axis", "z")
            link, where = frames[motor["carrier"] - 1] if "carrier" in motor else (0, pin.SE3.Identity())
            joint = model.addJoint(link, JOINTS[axis](), where, f"rotor{place}")
            tensor = np.diag([float(axis == other) * values[motor["inertia"]] for other in "xyz"])
            inertia = pin.Inertia(0.0, np.zeros(3), np.eye(3))
            inertia.inertia = tensor
            model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
            spin = np.zeros(len(q))
            spin[["q1", "q2", "q3"].index(motor["turns"])] = values[motor["ratio"]] if "ratio" in motor else 1
            E = np.vstack([E, spin])
        tau = E.T @ pin.rnea(model, model.createData(), E @ q, E @ qd, E @ qdd)
        assert_close(numbers(results["tau"], values), tau, "tau")
