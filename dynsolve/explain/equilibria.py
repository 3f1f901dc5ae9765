"""Steps of equilibria: where nothing moves, how stable that is, the motion near one of them, linear."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant
from dynsolve.derivation import linearization
from dynsolve.derivation.equilibria import Equilibria, SpecialCase
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.stability import Point, Stability
from dynsolve.derivation.steady import may_be_held, steady_energy, steady_forces
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.inverse_formulas import ConfigurationForms, vanishing
from dynsolve.explain.step import NOTED, Detail, Group, Line, Step
from dynsolve.explain.writing import GOLDSTEIN, SLOTINE_LI, is_small, listed, side_by_side, spong
from dynsolve.notation import tree
from dynsolve.notation.tree import (
    Degrees,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.notation.walk import names_in, walk
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

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
        group = Group("equilibria", "Where nothing moves, and how stable that is")
        yield from (replace(step, group=group, normal=NOTED) for step in _equilibria(context))
    if "balance" in wanted:
        yield replace(_balance(context), normal=NOTED)
    if "linear_A" in wanted:
        yield replace(_state_matrix(context), normal=NOTED)
    if "linear_B" in wanted:
        yield _input_matrix(context)


# -- where nothing moves ---------------------------------------------------------------------------


def _equilibria(context: Context) -> Iterator[Step]:
    robot, found = context.robot, context.values["equilibria"]
    if isinstance(found, Skipped):
        yield _skipped("equilibria", found)
        return
    shown = ConfigurationForms(robot, context.values)
    cases = shown.equilibria
    result: tuple[Node, ...] = tuple(vanishing(one) for one in cases if one)
    rows = tuple(equation(context.show(row), Number(0)) for row in found.rows)
    said = {part for one in result for part in walk(one) if isinstance(part, Relation)}
    is_new = not said >= set(rows)  # not what the result says again
    of_free: list[Prose] = []
    special = [shown.comparison(one.factor, "≠") for one in found.special]
    where = say(" where {special}", special=listed(special)) if special else ""
    factors = say("that are not 0{where}" if special else "that are never 0", where=where)
    heading = say(
        "Combined, without factors {which}:", which="of the parameters" if found.may_be_others else factors
    )
    lines = (Line(heading, rows),) if is_new else ()
    if not cases:
        notes = [say("No configuration makes all of them 0{where}: there is no equilibrium.", where=where)]
    elif not cases[0]:
        notes = [say("Nothing is left to be 0{where}: every configuration is an equilibrium.", where=where)]
    else:
        names = [q.name for q in robot.coordinates if q.name not in dict(robot.questions.model.steady)]
        free = [Symbol(name) for name in names if any(name not in names_in(*one) for one in cases)]
        some = " where it does not occur" if len(cases) > 1 else ""
        of_free = [say("{free} may have any value{some}.", free=listed(free), some=some)] if free else []
        notes = [*shown.existence("equilibria", found.exist)]
        notes += [say("These are the equilibria{where}.", where=where)] if special else []
    notes += [_special(shown, one) for one in found.special]
    if found.may_be_others:
        notes.append(("For special values of the parameters there may be others.",))
    steady = bool(robot.questions.model.steady)
    forces: Node = FORCES if steady else letters.G
    task = equation(forces, Number(0))
    values = working(context) if steady else _at_rest(context)
    yield Step(
        id="equilibria",
        stage=STAGE,
        title="Where nothing else moves" if steady else "Where nothing moves",
        why=(
            *(why(context) if steady else _nothing_moves(robot)),
            *_held(context),
            *_assumed(context, shown),
        ),
        formula=equation(forces, *values, Number(0)),
        task=task,
        source=SOURCE if steady else SLOTINE_LI.section("3.1"),
        lines=lines,
        result=result,
        listed=len(result) > 1,
        notes=(*of_free, *notes),
        outcome=tuple(part for k, note in enumerate(notes) for part in ([" "] * (k > 0) + [*note])),
        detail=Detail.BRIEF,
    )
    if any(points for points in found.points):
        yield _stability(context, shown, found)


def _nothing_moves(robot: Robot) -> Prose:
    """What is 0 in an equilibrium, and what is left."""
    idle = "" if robot.questions.model.inputs_given else ", and no motor drives"
    told = f"In an equilibrium rates and accelerations are 0{idle}: of the equations of motion "
    return (told, letters.G, " is left. ")


def _special(shown: ConfigurationForms, case: SpecialCase) -> Prose:
    """What is an equilibrium for parameters of which a factor is 0."""
    forces = shown.special_forces(case)
    where = shown.comparison(case.factor, "=")
    if forces is None:
        return say("Where {where}, there is no equilibrium.", where=where)
    if not forces:
        return say("Where {where}, every configuration is an equilibrium.", where=where)
    return say("Where {where}, the equilibria are where {zero}.", where=where, zero=vanishing(forces))


def _at_rest(context: Context) -> tuple[Node, ...]:
    """The entries of g, where they are not too long."""
    shown = context.form("g")
    return (shown,) if is_small(shown) else ()


def _held(context: Context) -> Prose:
    """Which coordinates must be in balance, where motors hold the others."""
    robot = context.robot
    if not robot.questions.model.inputs_given:
        return ()
    passive = [Symbol(robot.coordinates[k].name) for k in robot.actions.passive]
    return ("Motors hold the others; what has none must be in balance: ", *listed(passive), ". ")


def _assumed(context: Context, shown: ConfigurationForms) -> Prose:
    """What the problem says of its parameters."""
    assumed = context.robot.questions.model.assumed
    if not assumed:
        return ()
    return ("Of the parameters it is given that ", side_by_side([*map(shown.inequality, assumed)]), ". ")


def _stability(context: Context, shown: ConfigurationForms, found: Equilibria) -> Step:
    robot = context.robot
    steady = bool(robot.questions.model.steady)
    forces = context.values["g"]
    why: Prose = (
        "Where the matrix of the second derivatives of the potential energy is positive definite, the "
        "equilibrium is stable; where the energy falls in some direction, it is not.",
    )
    working: tuple[Node, ...] = ()
    second: Node = _DG
    if steady:
        why, energy = energy_of_motion(context)
        forces, working = forces_of_motion(context), (energy,)
        second = SECOND
    curvature = context.show(linearization.curvature(robot, forces))
    if is_small(curvature):
        working = (*working, equation(second, curvature))
    told = [
        _point(context, shown, point, case)
        for case, points in zip(shown.equilibria, found.points, strict=True)
        for point in points
    ]
    return Step(
        id="equilibria_stability",
        stage=STAGE,
        title="How stable they are",
        why=why,
        source=SOURCE if steady else SLOTINE_LI.section("3.4"),
        working=working,
        concluding=tuple(part for sentence in told for part in (*sentence, " ")),
        uses=("equilibria",),
    )


def _point(context: Context, shown: ConfigurationForms, point: Point, case: tuple[Node, ...]) -> Prose:
    """At q₁ = -90°, q₂ = 0: stable."""
    quarters = {(0, 1): Number(0), (1, 0): Degrees(90), (0, -1): Degrees(180), (-1, 0): Negative(Degrees(90))}
    at = [
        equation(Symbol(pair.angle.terms[0][0][0][0]), quarters[sine, cosine])
        for pair, sine, cosine in point.values
    ]
    said: Prose = ({
        Stability.STABLE: "stable",
        Stability.UNSTABLE: "not stable",
        Stability.UNDECIDED: "second derivatives alone do not decide",
    }[point.stability],)  # fmt: skip
    if point.conditions:
        said = say("stable where {all}", all=listed([*map(shown.inequality, point.conditions)]))
    if point.falls:
        fails = [shown.comparison(bound.value, "<") for bound in point.conditions]
        said = say("{stable}, not stable where {fails}", stable=said, fails=listed(fails, "or"))
    steady = dict(context.robot.questions.model.steady)
    names = [context.robot.coordinates[k].name for k in point.neutral]
    free = [Symbol(name) for name in names if name not in steady]
    is_told = point.conditions or point.stability is not Stability.UNDECIDED
    along: Prose = (", but for ", *listed(free), ", along which nothing changes") if free and is_told else ()
    where: Prose = ("In every configuration",)
    if at:
        where = ("At ", side_by_side(at))
    elif case:
        where = ("Where ", vanishing(case))
    return (*where, ": ", *said, *along, ".")


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
             "combinations of others are left out, and so are factors that are positive, as masses and "
             "lengths of the table are."),
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
    blocks = tree.Matrix(((_ZERO, _ONE), (Negative(Product((_INVERSE, _DG))), damped)))
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
    working = [equation(letters.D, context.show(D)), equation(_DG, context.show(g))]
    if has_friction:
        working.append(equation(_F, context.show(linearization.damping(robot, context.values["friction"]))))
    working.append(equation(Row((Words("det "), letters.D)), context.show(determinant(D))))
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
    column = tree.Matrix(((_ZERO,), (Product((_INVERSE, _S)),)))
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


# -- what the step of equilibria says of a steady motion, in which some rates are constant ---------

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


def forces_of_motion(context: Context) -> Matrix:
    """C q̇ + g in this motion, n×1."""
    return steady_forces(context.robot, context.values["C"], context.values["g"])


def working(context: Context) -> tuple[Node, ...]:
    """The values of these forces, where they are not too long."""
    shown = context.show(forces_of_motion(context))
    return (shown,) if is_small(shown) else ()


def energy_of_motion(context: Context) -> tuple[Prose, Node]:
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
