"""Forward dynamics: the accelerations that given forces make.

    q̈ = D⁻¹ (τ + Q - C q̇ - friction - g)

D⁻¹ is the adjugate over the determinant, block by block: of a diagonal D the reciprocals.

Lynch, Park, Modern Robotics, section 8.5 (2017).

The equations of motion of a constrained mechanism without the multipliers.

The columns of Z span the rates that the constraints leave free, A_c Z = 0.  The forces of the
constraints do no work on these:

    Zᵀ (D q̈ + C q̇ + friction + g) = Zᵀ (τ + Q)

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.3 (1994).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from msgspec import Struct

from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of, inverse_times
from dynsolve.algebra.lowest_terms import without_shared
from dynsolve.algebra.matrix import Matrix, work
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.spaces import nullspace
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import FOR_EVERY_Q

MOST_PRODUCTS = 50_000
"""Accelerations that may come to more products of terms are not multiplied out: nobody could read them."""

MOST_TERMS = 400
"""Results, or equations together, of more terms are not written out: collected they fill a page."""

TOO_LARGE = "multiplied out they are too large to be read"

SINGULAR = "the inertia matrix has no inverse: its determinant is 0 in every configuration"


def rules(robot: Robot) -> Iterator[Rule]:
    """The accelerations q̈, of a robot with masses; with constraints these have the rule."""
    if robot.has_dynamics and not robot.questions.constraints:
        yield Rule("qdd_forward", ("D", *acting_names(robot)), partial(accelerations, robot))


def driving_forces(robot: Robot) -> Matrix:
    """τ, n×1, by the names of the generalized forces; 0 where no motor drives a coordinate."""
    ring, passive = robot.ring, robot.actions.passive
    entries = [ring.zero if k in passive else ring.symbol(name) for k, name in enumerate(robot.inputs)]
    return Matrix.column(ring, entries)


def outside_names(robot: Robot) -> tuple[str, ...]:
    """The rule of the forces from outside, where there are any."""
    return (FOR_EVERY_Q,) if robot.questions.loads else ()


def acting_names(robot: Robot) -> tuple[str, ...]:
    """The rules of the forces that act beside τ."""
    return ("Cqd", "g", *robot.actions.resistance, *outside_names(robot))


def acting_forces(robot: Robot, *forces: Matrix) -> Matrix:
    """τ + Q - C q̇ - friction - g, n×1, from the forces of `acting_names`."""
    total = driving_forces(robot)
    for name, force in zip(acting_names(robot), forces, strict=True):
        total = total + force if name == FOR_EVERY_Q else total - force
    return total


def accelerations(robot: Robot, D: Matrix, *forces: Matrix) -> Matrix | FractionMatrix | Skipped:
    """q̈, n×1, from D and the forces of `acting_names`."""
    acting = acting_forces(robot, *forces)
    if work(D) * max(1, max(map(len, acting.entries))) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    found = inverse_times(D, acting)
    return Skipped(SINGULAR) if found is None else if_readable(found)


def if_readable(value: Matrix | FractionMatrix) -> Matrix | FractionMatrix | Skipped:
    """A value that is not too long to be read."""
    fractions = list(map(fraction_of, value.entries))
    terms = sum(len(one.numerator) + len(one.denominator) for one in fractions)
    return Skipped(TOO_LARGE, value) if terms > MOST_TERMS else value


# The equations of motion of a constrained mechanism without the multipliers


class Reduced(Struct, frozen=True):
    """Z, n×(n-c), and (left, right) of each equation.

    `zeros` are products that constraints make 0, and that were put in; an equation is divided by what both
    sides share.
    """

    free: Matrix
    equations: tuple[tuple[Expr, Expr], ...]
    zeros: tuple[Expr, ...]
    is_divided: bool


def reduced(
    robot: Robot, A: Matrix, kept: Sequence[Expr], forces: Matrix, *loads: Matrix
) -> Reduced | Skipped:
    """The equations without multipliers; `forces` are their left sides, n×1, `loads` Q where there is any.

    What is `kept` at 0 are functions of the coordinates, of the rates and of the accelerations.
    """
    Z = nullspace(A)
    if not Z.shape[1]:
        return Skipped("the constraints leave nothing free to move")
    if sum(map(len, forces.entries)) * max(map(len, Z.entries)) > MOST_TERMS:
        return Skipped("multiplied out the equations are too long to be read")
    driving = driving_forces(robot)
    for Q in loads:
        driving = driving + Q
    products = [zero for zero in kept if len(zero) == 1]
    used: dict[Expr, None] = {}
    equations, divided = [], []
    for whole, right in zip((Z.T @ forces).entries, (Z.T @ driving).entries, strict=True):
        left = whole
        for zero in products:
            rest = divmod(left.poly, zero.poly)[1]
            used |= {zero: None} if rest != left.poly else {}
            left = Expr(left.ring, rest)
        both = (left, right) if right.is_zero or left.is_zero else tuple(without_shared((left, right)))
        equations.append((both[0], both[1]))
        divided.append(both != (left, right))
    return Reduced(Z, tuple(equations), tuple(used), any(divided))
