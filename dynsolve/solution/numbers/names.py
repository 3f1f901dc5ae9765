"""Which results are shown in numbers, stage by stage, and the textbook's letter of each."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.notation.tree import Node, Product, Symbol
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Robot

Shown = tuple[str, Node]
"""The name of a result, and the letter it is shown by."""


def main_results(robot: Robot) -> dict[Stage, list[Shown]]:
    """The results that an exercise asks for, by stage."""
    last = len(robot.joints)
    found: dict[Stage, list[Shown]] = {
        Stage.KINEMATICS: [(f"H{last}", letters.H(robot, last))],
        Stage.JACOBIAN: [("Jv", letters.JV), ("Jw", letters.JW)],
    }
    if not robot.bodies:
        return found
    return found | {
        Stage.INERTIA: [],
        Stage.ENERGY: [("P", letters.P), ("K", letters.K)],
        Stage.LAGRANGIAN: [("L", letters.L)],
        Stage.TORQUE: [(f"tau{q.index}", letters.force(q)) for q in robot.coordinates],
        Stage.VECTORIZED: [
            ("D", letters.D),
            ("C", letters.C),
            ("Cqd", Product((letters.C, letters.QD))),
            ("g", letters.G),
        ],
    }


def all_results(robot: Robot) -> dict[Stage, list[Shown]]:
    """Every result of the derivation, by stage."""
    found = main_results(robot)
    found[Stage.KINEMATICS] = [
        *((f"A{joint.index}", letters.A(joint.index)) for joint in robot.joints),
        *((f"H{joint.index}", letters.H(robot, joint.index)) for joint in robot.joints),
    ]
    if not robot.bodies:
        return found
    found[Stage.INERTIA] = [shown for body in robot.bodies for shown in _inertia(body)]
    energies = [(f"P{body.name}", letters.of_body("P", body)) for body in robot.bodies]
    found[Stage.ENERGY] = [
        *energies,
        ("P", letters.P),
        *(shown for body in robot.bodies for shown in _motion(body)),
        ("K", letters.K),
    ]
    found[Stage.TORQUE] = []
    for q in robot.coordinates:
        rate, k = letters.rate(q), q.index
        momentum = letters.slope(letters.L, rate)
        found[Stage.TORQUE] += [
            (f"dLdqd{k}", momentum),
            (f"ddt{k}", letters.time_rate(momentum)),
            (f"dLdq{k}", letters.slope(letters.L, Symbol(q.name))),
            (f"tau{k}", letters.force(q)),
        ]
    return found


def _inertia(body: Body) -> Iterator[Shown]:
    b = body.name
    yield f"rc{b}", letters.rc(body)
    if not body.is_point:
        yield f"R{b}", letters.of_body("R", body, "bold")
        yield f"I{b}", letters.of_body("I", body, "script")


def _motion(body: Body) -> Iterator[Shown]:
    b = body.name
    yield f"Jv{b}", letters.jv(body)
    yield f"Jw{b}", letters.jw(body)
    yield f"v{b}", letters.of_body("v", body, "bold")
    yield f"w{b}", letters.of_body("omega", body, "bold")
    yield f"Kv{b}", letters.energy_part("v", body)
    yield f"Kw{b}", letters.energy_part("omega", body)
    yield f"K{b}", letters.of_body("K", body)
