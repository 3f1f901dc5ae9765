"""Models without a Denavit-Hartenberg table: bodies by their positions, or energies that are given.

Of a mechanism by positions a body's mass centre is a function of the coordinates, and its
orientation a product of turns.  Otherwise the file gives the inertia matrix, the energies or
the Lagrangian themselves, and no body is known.
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.notation.tree import Node


@dataclass(frozen=True, slots=True)
class BodyTurn:
    """A turn of a body about an axis that the turns before it carry along.

    `axis` (3×1) is a unit vector in the axes so far turned.  The angle is linear in the
    coordinates: `rates` (1×n) are its derivatives, free of coordinates, and `rotation` (3×3)
    turns by it.  `angle` is the angle as the file writes it.
    """

    axis: Matrix
    rates: Matrix
    rotation: Matrix
    angle: Node


@dataclass(frozen=True, slots=True)
class GivenModel:
    """What a file gives in the place of bodies: D and P, K and P, or L; what it does not give is None.

    D is n×n, the others are scalars.
    """

    D: Matrix | None = None
    K: Expr | None = None
    P: Expr | None = None
    L: Expr | None = None
