"""Every family of quantities, one record each, in the order of the derivation.

By the sections of the textbook:

    kinematics      A and H, and the Jacobian of the end of the arm
    bodies          mass centres, velocities, inertia
    energies        P and K of bodies and of the robot, L
    lagrange        the derivatives of L, the generalized forces
    vectorized      D, the Christoffel symbols, C, g

What acts beside gravity, and what only some exercises ask, is in the files `*_families` of
`dynsolve.quantities`.  To add a quantity:

1. its record in the file of its section, at its place in the derivation;
2. its formula in `dynsolve.derivation`, in the file of its section of the textbook, and its rule there;
3. its step in the stage's file of `dynsolve.explain`.

Reading, judging, marks, numbers, JSON and NumPy take what they must know from the record.
"""

from __future__ import annotations

from dynsolve.quantities import (
    action_families,
    constraint_families,
    definite_families,
    kinematic_families,
    model_families,
    recursion_families,
    static_families,
)
from dynsolve.quantities.families import bodies, energies, kinematics, lagrange, vectorized
from dynsolve.quantities.families.bodies import I_BODY, JV_BODY, JW_BODY, RC, I, R, V, W
from dynsolve.quantities.families.energies import K_BODY, KV, KW, P_BODY, K, L, P
from dynsolve.quantities.families.kinematics import DH, H0, JV, JW, A, H, J
from dynsolve.quantities.families.lagrange import DDT, DLDQ, DLDQD, FORCE, TAU
from dynsolve.quantities.families.vectorized import C_SYMBOL, CHRISTOFFEL, CQD, C, D, G
from dynsolve.quantities.family import Family

__all__ = [
    "H0", "DH", "A", "H", "JV", "JW", "J",
    "RC", "R", "JV_BODY", "JW_BODY", "V", "W", "I_BODY", "I",
    "P_BODY", "KV", "KW", "K_BODY", "P", "K", "L",
    "DLDQD", "DDT", "DLDQ", "FORCE", "TAU",
    "D", "CHRISTOFFEL", "C_SYMBOL", "C", "G", "CQD",
    "FAMILIES", "HOLD_FORCES",
]  # fmt: skip

FAMILIES: tuple[Family, ...] = (
    *kinematics.FAMILIES,
    *kinematic_families.FAMILIES,
    *bodies.FAMILIES,
    *energies.OF_BODIES,
    *action_families.OF_ENERGY,
    *energies.OF_ROBOT,
    *action_families.OF_TORQUE,
    *lagrange.FAMILIES,
    *vectorized.FAMILIES,
    *action_families.OF_THE_MODEL,
    *recursion_families.FAMILIES,
    *model_families.FAMILIES,
    *static_families.FAMILIES,
    *constraint_families.FAMILIES,
    *definite_families.FAMILIES,
)

HOLD_FORCES = frozenset(
    {constraint_families.LAMBDA.name, constraint_families.REDUCED.name, model_families.QDD_FORWARD.name}
)
"""The names of the results that hold the generalized forces by their names."""
