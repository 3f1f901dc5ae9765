"""What the step of equilibria says of a steady motion, in which some rates are constant."""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.steady import may_be_held, steady_energy, steady_forces
from dynsolve.document import Prose
from dynsolve.explain.citations import GOLDSTEIN
from dynsolve.explain.context import Context
from dynsolve.explain.writing import is_small, listed, side_by_side
from dynsolve.notation.tree import Negative, Node, Parenthesized, Product, Sum, Symbol, equation
from dynsolve.quantities import letters

SOURCE = GOLDSTEIN.section("2.7")
FORCES = Sum((Product((letters.C, letters.QD)), letters.G))
SECOND = letters.partial_derivative(Parenthesized(FORCES), letters.Q)


def why(context: Context) -> Prose:
    """Which rates are held, by what, and what is left of the equations of the others."""
    robot = context.robot
    rates = robot.questions.model.steady
    passive = {robot.coordinates[k].name for k in robot.actions.passive}
    free = [Symbol(name) for name, _ in rates if name in passive]
    driven = [Symbol(name) for name, _ in rates if name not in passive]
    held = [equation(Symbol(name, 1), value) for name, value in rates]
    said: Prose = ("In this motion ", side_by_side(held), " all the time; the other rates and all "
                   "accelerations are 0. ")  # fmt: skip
    if driven:
        said = (*said, "Motors keep the rate of ", *listed(driven), ", whatever that takes. ")
    if free:
        said = (*said, "No motor drives ", *listed(free), ". ")
    return (*said, "Of the equations of the others ", FORCES, " is left. ")


def forces(context: Context) -> Matrix:
    """C q̇ + g in this motion, n×1."""
    return steady_forces(context.robot, context.values["C"], context.values["g"])


def working(context: Context) -> tuple[Node, ...]:
    """The values of these forces, where they are not too long."""
    shown = context.show(forces(context))
    return (shown,) if is_small(shown) else ()


def energy(context: Context) -> tuple[Prose, Node]:
    """What the stability follows from, and the energy whose derivatives these forces are."""
    value = context.show(steady_energy(context.robot, context.values["P"], context.values["K"]))
    shown = equation(letters.STEADY_ENERGY, Sum((letters.P, Negative(letters.K))), value)
    said: Prose = (
        "These forces are the derivatives of V, the potential energy less the kinetic energy of the motion. "
        "Where the matrix of its second derivatives is positive definite, the motion is stable",
    )
    if may_be_held(context.robot, context.values["D"]):
        return (*said, ". Elsewhere nothing is said: what V alone lets fall may be held by forces of "
                       "first order in the rates, or by a rate that is free to change. "), shown  # fmt: skip
    return (*said, "; where it falls in some direction, it is not. "), shown
