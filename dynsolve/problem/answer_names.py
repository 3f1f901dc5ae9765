"""What was meant by a word that is no name of an answer: torque is tau, kinetic energy K.

Remarks of a problem's author on results: `remarks: {Kv2: "The squares add up."}`, plain words.
"""

from __future__ import annotations

import re
from difflib import get_close_matches

from msgspec import Struct

from dynsolve.problem.kinds import describe, nearest
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, YamlNode
from dynsolve.quantities.index import Quantities

# What was meant by a word that is no name of an answer: torque is tau, kinetic energy K

TERMS = {
    "tau": ("torque", "joint torque", "force", "generalized force", "equations of motion", "eom", "dynamics"),
    "D": ("inertia matrix", "mass matrix", "inertia"),
    "C": ("coriolis", "coriolis matrix", "centrifugal", "coriolis and centrifugal"),
    "c": ("christoffel", "christoffel symbols"),
    "g": ("gravity", "gravity vector", "gravitational", "gravity terms", "gravity torques"),
    "K": ("kinetic", "kinetic energy", "kinetic energies"),
    "P": ("potential", "potential energy", "potential energies"),
    "L": ("lagrange", "lagrangian", "lagrange function"),
    "friction": ("friction force", "friction torque", "damping", "dissipation"),
    "DH": ("denavit hartenberg", "dh table", "dh parameters", "table"),
    "A": ("transformation", "transformations", "link transformations"),
    "H": ("forward kinematics", "fk", "pose", "homogeneous transformation"),
    "J": ("jacobian", "jacobian matrix", "manipulator jacobian", "jacobi"),
    "Jv": ("linear jacobian", "linear velocity jacobian", "position jacobian"),
    "Jw": ("angular jacobian", "angular velocity jacobian", "orientation jacobian"),
    "det": ("determinant", "jacobian determinant"),
    "singular": ("singularity", "singularities", "singular configurations"),
    "inverse": ("inverse kinematics", "ik"),
    "r": ("task", "task function"),
    "Jr": ("task jacobian",),
    "rc": ("mass centre", "mass center", "center of mass", "centre of mass", "com"),
    "v": ("velocity", "velocities", "linear velocity"),
    "w": ("omega", "angular velocity", "angular velocities"),
    "I": ("inertia tensor", "tensor"),
    "qd": ("joint velocity", "joint velocities", "joint rates"),
    "qdd": ("joint acceleration", "joint accelerations"),
    "Y": ("regressor", "regressor matrix"),
    "a": ("parameters", "dynamic parameters", "base parameters"),
    "equilibria": ("equilibrium", "equilibrium points", "rest positions"),
    "linear_A": ("linearization", "linearisation", "state matrix", "linearize"),
    "linear_B": ("input matrix",),
    "qdd_forward": ("forward dynamics", "acceleration", "accelerations"),
    "Lambda": ("task inertia", "operational space inertia"),
    "Q": ("external forces", "external torques"),
    "tau_static": ("static torque", "static torques", "statics", "holding torques"),
    "Ac": ("constraint jacobian", "constraint matrix"),
    "lambda": ("multiplier", "multipliers", "lagrange multipliers"),
    "nullspace": ("null space", "kernel"),
    "rangespace": ("range space", "image"),
    "definite": ("positive definite", "definiteness"),
}
"""What the field calls the answers, and the families of answers."""

_CLOSE = 0.84


def answer_meant(names: Quantities, text: str) -> str:
    """The question whether an answer was meant, or a family of them, or nothing.

    >>> from dynsolve.quantities.owners import Owners
    >>> from dynsolve.robot.model import Coordinate, JointType
    >>> names = Quantities(Owners(1, (Coordinate("q1", JointType.REVOLUTE, 1),), ("1",), frozenset("1")))
    >>> [answer_meant(names, word) for word in ("Torques", "kinetic energy 1", "inertia-matrix", "foo")]
    ['did you mean `tau`?', 'did you mean `K1`?', 'did you mean `D`?', '']
    """
    words = text.strip().lower()[:60]
    digits = words[len(words.rstrip("0123456789")) :]
    called = {_folded(term): name for name, terms in TERMS.items() for term in terms if names.members(name)}
    close = get_close_matches(_folded(words), called, 1, _CLOSE)
    meant = called[close[0]] if close else ""
    if meant and digits:
        meant = names.canonical(meant + digits) or meant
    meant = meant or nearest(text, names.examples())
    return f"did you mean `{meant}`?" if meant else ""


def _folded(words: str) -> str:
    """The letters of words, without the sign of a plural."""
    return re.sub(r"[^a-z]", "", words).removesuffix("s")


# Remarks of a problem's author on results

_HELP = PROBLEM["remarks"].help


class Remark(Struct, frozen=True):
    """What an author says of a result: its name, as an answer and as the file has it, and the words."""

    name: str
    key: str
    texts: tuple[str, ...]


def read_remarks(faults: Faults, node: YamlNode | None, names: Quantities | None) -> tuple[Remark, ...]:
    """The remarks of a file; `names` are None where the robot is faulty, and nothing is known of answers."""
    if node is None or isinstance(node, FaultyNode):
        return ()
    if not isinstance(node, MappingNode):
        faults.error(node.span, f"remarks is a mapping, not {describe(node)}", _HELP)
        return ()
    found: dict[str, Remark] = {}
    for key, value in node.entries:
        texts = _texts(faults, value, key.decoded)
        name = key.decoded if names is None else names.canonical(key.decoded)
        if name is None:
            meant = answer_meant(names, key.decoded) if names else ""
            message = f"`{key.decoded[:40]}` is no result of this problem"
            faults.error(key.span, message, meant or "results are P1, Kv1, K, L, tau1, D, d11, ...")
        elif name in found:
            faults.error(key.span, f"{name} has a remark already", "write both as a list of lines")
        elif texts:
            found[name] = Remark(name, key.decoded, texts)
    return tuple(found.values())


def _texts(faults: Faults, node: YamlNode, of: str) -> tuple[str, ...]:
    """The lines of text of a remark."""
    lines = node.items if isinstance(node, ListNode) else (node,)
    for line in lines:
        if not isinstance(line, FaultyNode) and not (isinstance(line, ScalarNode) and line.decoded.strip()):
            faults.error(line.span, f"the remark on {of} is words, not {describe(line)}", _HELP)
    return tuple(" ".join(line.decoded.split()) for line in lines if isinstance(line, ScalarNode))
