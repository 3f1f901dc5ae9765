"""Names of generalized forces in what is solved for: the inputs of the motors.

In q̈ = D⁻¹ (τ + Q - C q̇ - g) and λ = -(A_c D⁻¹ A_cᵀ)⁻¹ (A_c D⁻¹ (τ + Q - C q̇ - g) + Ȧ_c q̇) a name as τ₁
is what a motor gives, never the student's own answer τ₁, which holds the accelerations; a coordinate
without a motor has none.
"""

from __future__ import annotations

from dynsolve.notation.tree import Node, Number, Reference, Symbol
from dynsolve.notation.walk import with_children
from dynsolve.quantities import families
from dynsolve.quantities.index import Quantities
from dynsolve.robot.model import Robot


def with_inputs(robot: Robot, named: Quantities, name: str, node: Node) -> Node:
    """The tree of the answer `name`, generalized forces being inputs in those that hold them."""
    if name not in families.HOLD_FORCES:
        return node

    def put(part: Node) -> Node:
        match part:
            case Reference(quantity, row) if named[quantity].family in (families.TAU, families.FORCE):
                k = named[quantity].index[0] - 1 if row is None else row - 1
                return Number(0) if k in robot.actions.passive else Symbol(robot.coordinates[k].force)
        return with_children(part, put)

    return put(node)
