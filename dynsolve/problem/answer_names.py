"""What was meant by a word that is no name of an answer: torque is tau, kinetic energy K."""

from __future__ import annotations

import re
from difflib import get_close_matches

from dynsolve.problem.fields import nearest
from dynsolve.quantities.index import Quantities

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
