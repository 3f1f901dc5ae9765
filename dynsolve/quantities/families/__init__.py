"""Every family of quantities, one record each, in the order of the derivation.

By the sections of the textbook:

    bodies          A and H, the Jacobian of the end of the arm; mass centres, velocities, inertia
    lagrange        P, K and L; the derivatives of L, the generalized forces; D, the Christoffel symbols, C,
                    g

What acts beside gravity is in `quantities.action_families`; what only some exercises ask, with its
question in `dynsolve.questions`.  To add a quantity of the course:

1. its record in the file of its section, at its place in the derivation;
2. its formula in `dynsolve.derivation`, in the file of its section of the textbook, and its rule there;
3. its step in the stage's file of `dynsolve.explain`.

Reading, judging, marks, numbers, JSON and NumPy take what they must know from the record.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from dynsolve.quantities import action_families
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
from dynsolve.quantities.stages import Stage

__all__ = [
    "H0", "DH", "A", "H", "JV", "JW", "J",
    "RC", "R", "JV_BODY", "JW_BODY", "V", "W", "I_BODY", "I",
    "P_BODY", "KV", "KW", "K_BODY", "P", "K", "L",
    "DLDQD", "DDT", "DLDQ", "FORCE", "TAU",
    "D", "CHRISTOFFEL", "C_SYMBOL", "C", "G", "CQD",
    "FAMILIES", "holds_forces",
]  # fmt: skip


def _asked_for(stages: Iterable[Stage]) -> Iterator[Family]:
    """Those of questions, each in its own folder."""
    for stage in stages:
        yield from getattr(stage.part(), "FAMILIES", ())


_STAGES = list(Stage)
_BODIES = _STAGES.index(Stage.INERTIA)

FAMILIES: tuple[Family, ...] = (
    *bodies.KINEMATICS_FAMILIES,
    *_asked_for(_STAGES[:_BODIES]),
    *bodies.FAMILIES,
    *lagrange.OF_BODIES,
    *action_families.OF_ENERGY,
    *lagrange.OF_ROBOT,
    *action_families.OF_TORQUE,
    *lagrange.FAMILIES,
    *lagrange.VECTORIZED_FAMILIES,
    *action_families.OF_THE_MODEL,
    *_asked_for(_STAGES[_BODIES:]),
)

_HOLD_FORCES = frozenset(family.name for family in FAMILIES if family.holds_forces)


def holds_forces(name: str) -> bool:
    """Whether a result, or an entry of it, holds the generalized forces by their names: lambda, lambda2."""
    return name.rstrip("0123456789") in _HOLD_FORCES
