"""Names of generalized forces in what is solved for: the inputs of the motors.

In q̈ = D⁻¹ (τ + Q - C q̇ - g) and λ = -(A_c D⁻¹ A_cᵀ)⁻¹ (A_c D⁻¹ (τ + Q - C q̇ - g) + Ȧ_c q̇) a name as τ₁
is what a motor gives, never the student's own answer τ₁, which holds the accelerations; a coordinate
without a motor has none.  In equations of motion, D q̈ + C q̇ + g - A_cᵀ λ, a name as λ₁ is the force of a
constraint, and never the answer λ.
"""

from __future__ import annotations

from dynsolve.notation.tree import Node, Number, Reference, Symbol
from dynsolve.notation.walk import with_children
from dynsolve.quantities import families
from dynsolve.quantities.constraint_families import MULTIPLIERS
from dynsolve.quantities.index import Quantities
from dynsolve.robot.model import Robot


def with_inputs(robot: Robot, named: Quantities, name: str, node: Node) -> Node:
    """The tree of the answer `name`, forces and multipliers being inputs in those that hold them."""
    if name in families.HOLD_FORCES:
        return _with_forces(robot, named, node)
    if robot.questions.constraints and named[name].family in (families.TAU, families.FORCE):
        return _with_multipliers(robot, named, node)
    return node


def _with_forces(robot: Robot, named: Quantities, node: Node) -> Node:
    def put(part: Node) -> Node:
        match part:
            case Reference(quantity, row) if named[quantity].family in (families.TAU, families.FORCE):
                k = named[quantity].index[0] - 1 if row is None else row - 1
                return Number(0) if k in robot.actions.passive else Symbol(robot.coordinates[k].force)
        return with_children(part, put)

    return put(node)


def _with_multipliers(robot: Robot, named: Quantities, node: Node) -> Node:
    names = multiplier_names(robot)

    def put(part: Node) -> Node:
        match part:
            case Reference(quantity, row) if named[quantity].family in MULTIPLIERS:
                return Symbol(names[(*named[quantity].index, row or 1)[0] - 1])
        return with_children(part, put)

    return put(node)


def multiplier_names(robot: Robot) -> tuple[str, ...]:
    """Names for λ_1, λ_2, ..., which no parameter has."""
    names = tuple(f"lambda{i}" for i in range(1, len(robot.questions.constraints) + 1))
    return names if set(names).isdisjoint(robot.parameters) else tuple(f"{name}_" for name in names)
