"""Steps of equilibria: the equations of motion near one, linear."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.minors import determinant
from dynsolve.derivation import linearization
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Prose
from dynsolve.explain.citations import SLOTINE_LI
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import listed, side_by_side
from dynsolve.notation.tree import (
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.EQUILIBRIA
_SOURCE = SLOTINE_LI.section("3.3")
_INVERSE = Power(letters.D, Negative(Number(1)))
_F, _S = letters.bold("F"), letters.bold("S")
_DG = Row((Words("∂"), letters.G, Words("/∂"), letters.Q))
_ZERO, _ONE = letters.bold("0"), letters.bold("E")


def steps(context: Context) -> Iterator[Step]:
    """A and B of the motion near an equilibrium."""
    wanted = context.wanted
    if "linear_A" in wanted:
        yield _state_matrix(context)
    if "linear_B" in wanted:
        yield _input_matrix(context)


def _at(context: Context) -> Prose:
    """The equilibrium in words: at q₁ = 0, q₂ = 0."""
    values = context.robot.questions.model.equilibrium
    return (
        "at ",
        side_by_side([equation(Symbol(name, dots), value) for (name, dots), value in values.items()]),
    )


def _skipped(name: str, value: Skipped) -> Step:
    return Step(name, STAGE, "Not derived", (f"{value.why[0].upper()}{value.why[1:]}.",), detail=Detail.BRIEF)


def _state_matrix(context: Context) -> Step:
    robot, value = context.robot, context.values["linear_A"]
    if isinstance(value, Skipped):
        return _skipped("linear_A", value)
    has_friction = "friction" in robot.actions.kinds
    damped: Node = Negative(Product((_INVERSE, _F))) if has_friction else _ZERO
    blocks = Matrix(((_ZERO, _ONE), (Negative(Product((_INVERSE, _DG))), damped)))
    distance = Sum((letters.Q, Negative(letters.bold("q", Words("e")))))
    why: Prose = (
        "The state is how far the coordinates are from the equilibrium, ", distance,
        ", and their rates; the inputs are counted from the forces that hold it. ", *_balanced(context),
        Product((letters.C, letters.QD)), " is of second order in the rates and falls away; so does every "
        "change of ", letters.D, ", which stands beside an acceleration. The rest is taken ",
        *_at(context), ".",
    )  # fmt: skip
    at = linearization.at_equilibrium(robot)
    D, g = at.matrix(context.values["D"]), linearization.stiffness(robot, context.values["g"])
    working = [equation(letters.D, context.show(D)), equation(_det(), context.show(determinant(D)))]
    working.append(equation(_DG, context.show(g)))
    if has_friction:
        working.append(equation(_F, context.show(linearization.damping(robot, context.values["friction"]))))
    return Step(
        id="linear_A",
        stage=STAGE,
        title="The motion near the equilibrium",
        why=why,
        formula=equation(letters.LINEAR_A, blocks),
        source=_SOURCE,
        working=tuple(working),
        result=(equation(letters.LINEAR_A, context.form("linear_A")),),
        notes=_notes(context),
        detail=Detail.BRIEF,
    )


def _det() -> Node:
    return Row((Words("det "), letters.D))


def _balanced(context: Context) -> Prose:
    passive = [Symbol(context.robot.coordinates[k].name) for k in context.robot.actions.passive]
    if not passive:
        return ()
    which = "it" if len(passive) == 1 else "them"
    return (
        "No motor drives ",
        *listed(passive),
        f": in the equilibrium gravity and springs do not move {which}. ",
    )


def _notes(context: Context) -> tuple[Prose, ...]:
    if any(not one.coulomb.is_zero for one in context.robot.actions.friction):
        return (("Coulomb friction jumps where a rate changes its sign: it has no part in a linear model.",),)
    return ()


def _input_matrix(context: Context) -> Step:
    robot, value = context.robot, context.values["linear_B"]
    if isinstance(value, Skipped):
        return _skipped("linear_B", value)
    inputs: list[Node] = [letters.force(robot.coordinates[k]) for k in linearization.driven(robot)]
    column = Matrix(((_ZERO,), (Product((_INVERSE, _S)),)))
    every = len(inputs) == robot.n
    return Step(
        id="linear_B",
        stage=STAGE,
        title="What the inputs do to it",
        why=("A column for each input: ", *listed(inputs), ". ", _S, " is the identity matrix." if every
             else " has a 1 in the row of each, a column each."),
        formula=equation(letters.LINEAR_B, column),
        source=_SOURCE,
        result=(equation(letters.LINEAR_B, context.form("linear_B")),),
        detail=Detail.BRIEF,
    )  # fmt: skip
