"""Steps of equilibria: where nothing moves, how stable that is, the motion near one of them, linear."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.minors import determinant
from dynsolve.derivation import linearization
from dynsolve.derivation.equilibria import Equilibria, Point, Stability
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Prose
from dynsolve.explain.citations import SLOTINE_LI, spong
from dynsolve.explain.configurations import ConfigurationForms
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import is_small, listed, side_by_side
from dynsolve.notation.tree import (
    Degrees,
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
_DG = letters.partial_derivative(letters.G, letters.Q)
_ZERO, _ONE = letters.bold("0"), letters.bold("E")


def steps(context: Context) -> Iterator[Step]:
    """The equilibria with their stability; A and B of the motion near one."""
    wanted = context.wanted
    if "equilibria" in wanted:
        yield from _equilibria(context)
    if "balance" in wanted:
        yield _balance(context)
    if "linear_A" in wanted:
        yield _state_matrix(context)
    if "linear_B" in wanted:
        yield _input_matrix(context)


# -- where nothing moves ---------------------------------------------------------------------------


def _equilibria(context: Context) -> Iterator[Step]:
    robot, found = context.robot, context.values["equilibria"]
    if isinstance(found, Skipped):
        yield _skipped("equilibria", found)
        return
    shown = ConfigurationForms(robot, context.values)
    held = robot.questions.model.inputs_given
    why: Prose = ("In an equilibrium rates and accelerations are 0, and of the equations of motion ",
                  letters.G, " is left. ")  # fmt: skip
    if held:
        passive = [Symbol(robot.coordinates[k].name) for k in robot.actions.passive]
        why = (*why, "Motors hold the others; what has none must be in balance: ", *listed(passive), ". ")
    cases = shown.equilibria
    result: tuple[Node, ...] = tuple(_together(one) for one in cases if one)
    rows = tuple(equation(context.show(row), Number(0)) for row in found.rows)
    is_new = bool(rows) and [side_by_side(rows)] != [*result]  # not what the result says again
    lines = (Line(("Combined, without factors that are never 0",), rows),) if is_new else ()
    if not cases:
        notes: tuple[Prose, ...] = (("No configuration makes all of them 0: there is no equilibrium.",),)
    elif not cases[0]:
        notes = (("Nothing is left to be 0: every configuration is an equilibrium.",),)
    else:
        notes = (("Coordinates that do not occur are free.",),)
    yield Step(
        id="equilibria",
        stage=STAGE,
        title="Where nothing moves",
        why=why,
        formula=equation(letters.G, Number(0)),
        source=SLOTINE_LI.section("3.1"),
        working=(equation(letters.G, context.form("g")),) if is_small(context.form("g")) else (),
        lines=lines,
        result=result,
        listed=len(result) > 1,
        notes=notes,
        detail=Detail.BRIEF,
    )
    if any(points for points in found.points):
        yield _stability(context, found)


def _stability(context: Context, found: Equilibria) -> Step:
    second = linearization.curvature(context.robot, context.values["g"])
    shown = context.show(second)
    told = [_point(context, point) for points in found.points for point in points]
    return Step(
        id="equilibria_stability",
        stage=STAGE,
        title="How stable they are",
        why=("Where the potential energy has a strict minimum, all second derivatives being positive "
             "together, the equilibrium is stable; where it falls in some direction, it is not.",),
        source=SLOTINE_LI.section("3.4"),
        working=(equation(_DG, shown),) if is_small(shown) else (),
        notes=tuple(told),
        uses=("equilibria",),
    )  # fmt: skip


def _point(context: Context, point: Point) -> Prose:
    """At q₁ = -90°, q₂ = 0: stable."""
    quarters = {(0, 1): Number(0), (1, 0): Degrees(90), (0, -1): Degrees(180), (-1, 0): Negative(Degrees(90))}
    at = [
        equation(Symbol(pair.angle.terms[0][0][0][0]), quarters[sine, cosine])
        for pair, sine, cosine in point.values
    ]
    said = {
        Stability.STABLE: "stable",
        Stability.UNSTABLE: "not stable",
        Stability.UNDECIDED: "second derivatives do not decide for all values of the parameters",
    }[point.stability]
    free = [Symbol(context.robot.coordinates[k].name) for k in point.neutral]
    along: Prose = (", but for ", *listed(free), ", along which nothing changes") if free else ()
    where: Prose = ("At ", side_by_side(at)) if at else ("There",)
    return (*where, f": {said}", *along, ".")


def _together(conditions: tuple[Node, ...]) -> Node:
    """Equations that hold together, in one line."""
    return side_by_side([equation(value, Number(0)) for value in conditions])


# -- nowhere to move -------------------------------------------------------------------------------


def _balance(context: Context) -> Step:
    found, wanted = context.values["balance"], context.robot.questions.model.balanced
    if isinstance(found, Skipped):
        return _skipped("balance", found)
    shown = ConfigurationForms(context.robot, context.values).balance
    goal: Node = Number(0) if wanted is None else context.show(wanted)
    notes: list[Prose] = []
    if not shown:
        notes.append(("Gravity is what it should be for all values of the parameters.",))
    return Step(
        id="balance",
        stage=STAGE,
        title="What balances gravity",
        why=("Multiplied out, ", letters.G, " is a sum of what moves, each with a coefficient of parameters. "
             "It is what it should be in every configuration where all the coefficients are. Those that are "
             "combinations of others, and factors that are not 0, are left out."),
        formula=equation(letters.G, goal),
        source=spong("7.5.3"),
        working=(equation(letters.G, context.form("g")),) if is_small(context.form("g")) else (),
        result=tuple(equation(value, Number(0)) for value in shown),
        listed=len(shown) > 1,
        notes=tuple(notes),
        detail=Detail.BRIEF,
    )  # fmt: skip


# -- near one of them ------------------------------------------------------------------------------


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
