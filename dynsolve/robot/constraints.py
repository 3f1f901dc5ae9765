"""Constraints on the motion of a manipulator: A_c(q) q̇ = 0."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.notation.tree import Node


@dataclass(frozen=True, slots=True)
class Constraint:
    """One equation that every motion keeps.

    `entry` is what is 0: h(q), holonomic, in which coordinates of points may stand as they do in a
    task; or, `in_rates`, a sum of rates with factors that depend on the coordinates.
    """

    entry: Node
    in_rates: bool = False
