"""Every family of quantities, one record each, in the order of the derivation.

By the sections of the textbook:

    bodies          A and H, the Jacobian of the end of the arm; mass centres, velocities, inertia
    lagrange        P, K and L; the derivatives of L, the generalized forces; D, the Christoffel symbols, C,
                    g

What acts beside gravity, and what only some exercises ask, is in the files `*_families` of
`dynsolve.quantities`.  To add a quantity:

1. its record in the file of its section, at its place in the derivation;
2. its formula in `dynsolve.derivation`, in the file of its section of the textbook, and its rule there;
3. its step in the stage's file of `dynsolve.explain`.

Reading, judging, marks, numbers, JSON and NumPy take what they must know from the record.
"""

from __future__ import annotations

from dynsolve.quantities import action_families, kinematic_families, model_families
from dynsolve.quantities.families import bodies, lagrange
from dynsolve.quantities.families.bodies import (
    DH,
    H0,
    I_BODY,
    JV,
    JV_BODY,
    JW,
    JW_BODY,
    RC,
    A,
    H,
    I,
    J,
    R,
    V,
    W,
)
from dynsolve.quantities.families.lagrange import (
    C_SYMBOL,
    CHRISTOFFEL,
    CQD,
    DDT,
    DLDQ,
    DLDQD,
    FORCE,
    K_BODY,
    KV,
    KW,
    P_BODY,
    TAU,
    C,
    D,
    G,
    K,
    L,
    P,
)
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
    *bodies.KINEMATICS_FAMILIES,
    *kinematic_families.FAMILIES,
    *bodies.FAMILIES,
    *lagrange.OF_BODIES,
    *action_families.OF_ENERGY,
    *lagrange.OF_ROBOT,
    *action_families.OF_TORQUE,
    *lagrange.FAMILIES,
    *lagrange.VECTORIZED_FAMILIES,
    *action_families.OF_THE_MODEL,
    *action_families.FAMILIES,
    *model_families.FAMILIES,
    *action_families.STATIC_FAMILIES,
    *action_families.CONSTRAINT_FAMILIES,
    *action_families.DEFINITE_FAMILIES,
)

HOLD_FORCES = frozenset(
    {action_families.LAMBDA.name, action_families.REDUCED.name, model_families.QDD_FORWARD.name}
)
"""The names of the results that hold the generalized forces by their names."""
