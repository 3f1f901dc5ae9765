"""Steps of the vectorized form: D, C and g read off from τ, assembled directly, and compared."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.body_parts import angular_name, linear_name, part_steps, sum_step
from dynsolve.explain.christoffel import SKEW, SLOPES, agreement_step, christoffel_step, skew_step
from dynsolve.explain.context import Context
from dynsolve.explain.matrix_factors import with_factors_in_front
from dynsolve.explain.placed_bodies import inertia_step
from dynsolve.explain.sanity import sanity_steps
from dynsolve.explain.step import STATED, Detail, Part, Step
from dynsolve.explain.terms import closing_step, driving_side, terms_step
from dynsolve.explain.working.derivatives import coriolis_rows, coriolis_sums, gravity_rows
from dynsolve.explain.writing import (
    and_joined,
    are_counted,
    counted_sum,
    listed,
    spong,
    sum_of,
    sum_over_coordinates,
    turns,
)
from dynsolve.notation.tree import (
    Letter,
    Negative,
    Node,
    Parenthesized,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Method

STAGE = Stage.VECTORIZED

LONGEST_IN_PARTS = 150
"""Up to this number of terms in D its parts are shown too."""

_I, _J, _K = (Symbol(name) for name in "ijk")


def steps(context: Context) -> Iterator[Step]:
    """D, c_ijk, C and g; then the comparisons, and the whole model."""
    from_energies = _from_energies(context)
    yield _inertia(context)
    yield _rest(context)
    if from_energies:
        given = context.robot.given
        direct = [_inertia_direct(context) if given is None else inertia_step(context, given)]
        if _is_short(context):
            parts = (step for body in context.robot.bodies for step in part_steps(context, body))
            direct += with_factors_in_front(parts, context)
        if context.robot.actions:
            from dynsolve.explain.actions import rotor_part_step

            direct += rotor_part_step(context)
        direct += _sum(context)
        yield from (replace(step, detail=Detail.FULL) for step in direct)
    yield christoffel_step(context)
    yield _coriolis(context)
    if from_energies:
        yield _gravity(context)
        yield agreement_step(context)
    yield skew_step(context)
    yield from terms_step(context)
    yield from sanity_steps(context)
    yield closing_step(context)


def _names(context: Context, letter: str) -> tuple[tuple[Node, ...], ...]:
    return letters.entries(letter, context.robot.n)


def _inertia(context: Context) -> Step:
    return Step(
        id="D",
        stage=STAGE,
        title="The inertia matrix, read off from the forces",
        why=(
            "Entry ",
            _d(_I, _J),
            " is the factor of the acceleration ",
            Letter("q", _J, dots=2),
            " in the generalized force ",
            Letter("tau", _I),
            *_entries_of_forces(context.robot),
            ". ",
            letters.D,
            " is symmetric, and may depend on the coordinates, but on no rate.",
            " Here it is diagonal: no acceleration enters the force of another coordinate."
            if _is_diagonal(context)
            else "",
        ),
        formula=equation(_d(_I, _J), letters.partial_derivative(Letter("tau", _I), Letter("q", _J, dots=2))),
        source=f"from {spong('7.3')}",
        result=(equation(letters.D, context.form("D")),),
        uses=_forces(context),
        entries=_names(context, "d"),
        detail=Detail.BRIEF,
    )


def _is_diagonal(context: Context) -> bool:
    """Whether several coordinates move, none of which is coupled with another."""
    n, D = context.robot.n, context.values["D"]
    return n > 1 and all(D[i, j].is_zero for i in range(n) for j in range(n) if i != j)


def _entries_of_forces(robot: Robot) -> Prose:
    """What τ_i is where some generalized forces are called f_i."""
    if all(turns(q) for q in robot.coordinates):
        return ()
    named = listed([letters.force(q) for q in robot.coordinates])
    return (", entry ", _I, " of ", letters.TAU, " (", *named, ")")


def _from_energies(context: Context) -> bool:
    """Whether the forces come from the Lagrangian, so that D and g follow from the energies too."""
    return context.robot.questions.method is Method.LAGRANGE


def _forces(context: Context) -> tuple[str, ...]:
    """The steps of the forces, by name."""
    return tuple(f"tau{q.index}" for q in context.robot.coordinates)


def _rest(context: Context) -> Step:
    """The forces without the terms of accelerations: C q̇ + g."""
    values = context.values
    Cqd = Product((letters.C, letters.QD))
    why: Prose = ("What is left of the forces without the accelerations: the terms with rates are ",)
    why += (Cqd, f"; the others, which remain when the {context.machine} is at rest, are ", letters.G, ".")
    if values["Cqd"].is_zero:
        why += (" No term has rates here.",)
    if values["g"].is_zero:
        why += (" No term remains at rest here.",)
    acting = driving_side(context)
    left: list[Node] = [*(acting.terms if isinstance(acting, Sum) else (acting,))]
    left.append(Negative(Product((letters.D, letters.QDD))))
    if "friction" in values.rules:
        why += (" Friction, ", letters.FRICTION, ", is taken off.")
        left.append(Negative(letters.FRICTION))
    return Step(
        id="Cqd",
        stage=STAGE,
        title="Coriolis, centrifugal and gravity terms, read off",
        why=why,
        formula=equation(Sum((Cqd, letters.G)), Sum(tuple(left))),
        source=spong("7.3"),
        result=(equation(Cqd, context.form("Cqd")), equation(letters.G, context.form("g"))),
        also=() if _from_energies(context) else ("g",),  # from the energies a step of its own gives g
        uses=(*_forces(context), "D"),
        detail=Detail.FULL if _from_energies(context) else Detail.NORMAL,
        hint=(
            "What is left of the forces without the accelerations: the terms with rates belong to C, the "
            f"others, which remain when the {context.machine} is at rest, are ",
            letters.G,
            ".",
        ),
    )


def _d(*indices: Node) -> Letter:
    return Letter("d", Row(indices))


def _inertia_direct(context: Context) -> Step:
    robot = context.robot
    i = Symbol("i")
    jv, jw = (letters.bold("J", Letter(part, i)) for part in ("v", "omega"))
    linear = Product((Letter("m", i), Transpose(jv), jv))
    angular = Product((Transpose(jw), letters.base_tensor(i), jw))
    total = Parenthesized(Sum((linear, angular)))
    added = counted_sum(
        total, i, len(robot.bodies), {Letter("m", i): context.mass(body) for body in robot.bodies[:1]}
    )
    same = context.values["D"] == context.values["D_direct"]
    terms: list[Node] = []
    for body in robot.bodies:
        terms += [linear_name(context, body), *(() if body.is_point else (angular_name(body),))]
    rotors = (letters.DM,) if robot.actions.motors else ()
    working = equation(letters.D, sum_of([*terms, *rotors]))
    return Step(
        id="D_direct",
        stage=STAGE,
        title="The inertia matrix, assembled from the Jacobians",
        why=(
            "Without the Lagrangian: with ",
            *listed([_of_velocities("v"), _of_velocities("omega")]),
            " the kinetic energy is ",
            equation(letters.K, Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))),
            ", where ",
            letters.D,
            f" is a sum over the bodies{_named_otherwise(robot)}.",
            " A point mass has no second term." if any(body.is_point for body in robot.bodies) else "",
            *((" The rotors add ", letters.DM, ".") if rotors else ()),
            *(
                ()
                if _sum(context)
                else (
                    " The sum is the same " if same else " The sum is not the same ",
                    letters.D,
                    ", entry by entry." if same else ".",
                )
            ),
        ),
        formula=equation(letters.D, sum_of([added, *rotors])),
        source=spong("7.2.2"),
        further=(working,),
        hint=(
            "Another way to D, without the Lagrangian: a sum over the bodies. Use it to check what you "
            "read off from the forces.",
        ),
    )


def _sum(context: Context) -> tuple[Step, ...]:
    """The sum of the parts of D, of short arms whose parts are shown."""
    if context.robot.given is not None or not context.is_short or not _is_short(context):
        return ()
    step = sum_step(context)
    return () if step is None else (step,)


def _of_velocities(part: str) -> Node:
    """v_i = J_{v_i} q̇, or ω_i = J_{ω_i} q̇."""
    i = Symbol("i")
    return equation(letters.bold(part, i), Product((letters.bold("J", Letter(part, i)), letters.QD)))


def _named_otherwise(robot: Robot) -> str:
    """Which bodies there are, where they are not called 1, 2, ..., as a sum counts them."""
    names = [body.name for body in robot.bodies]
    return "" if are_counted(robot.bodies) else f" {and_joined(names)}, counted in this order"


def _is_short(context: Context) -> bool:
    """Whether D is short enough for its parts to be of use to a reader."""
    return sum(len(entry) for entry in context.values["D"].entries) <= LONGEST_IN_PARTS


# -- C and g ---------------------------------------------------------------------------------------


def _coriolis(context: Context) -> Step:
    entry, rate = Letter("c", Row((_K, _J))), Letter("q", _I, dots=1)
    by_symbols = sum_over_coordinates(Product((Letter("c", Row((_I, _J, _K))), rate)), _I, context.robot)
    by_slopes = Product((letters.HALF, sum_over_coordinates(Product((SLOPES, rate)), _I, context.robot)))
    Cqd = Product((letters.C, letters.QD))
    none = context.values["C"].is_zero
    why: Prose = ("Row ", _K, ", column ", _J, ". ", Cqd, " holds the centrifugal terms (a rate squared)")
    why += (" and the Coriolis terms (a product of two rates)",) if context.robot.n > 1 else ()
    compared = _from_energies(context) and coriolis_rows(context)  # row by row, in a step of its own
    same = "." if compared else ". Multiplied out, it is the one read off above."
    why += (". There are none here.",) if none else (same,)
    return Step(
        id="C",
        stage=STAGE,
        title="The Coriolis matrix, from the Christoffel symbols",
        why=why,
        formula=equation(entry, by_symbols, by_slopes),
        source=spong("7.3"),
        lines=coriolis_sums(context),
        result=(equation(letters.C, context.form("C")),),
        hint=(
            "Row ",
            _K,
            ", column ",
            _J,
            ": a sum over ",
            _I,
            ". Multiplied by the rates it must give what you read off from the forces.",
        ),
        entries=_names(context, "c"),
        notes=()
        if none or context.robot.n == 1
        else (
            (
                "Other matrices ",
                letters.C,
                " give the same ",
                Cqd,
                ", which is all that the equations of motion fix. This choice makes ",
                SKEW,
                " skew-symmetric.",
            ),
        ),
        detail=Detail.BRIEF,
    )


def _gravity(context: Context) -> Step:
    still, springs = context.values["g"].is_zero, bool(context.robot.actions.springs)
    why: Prose = (
        "Directly, without ",
        letters.TAU,
        ": the partial derivatives of the potential energy.",
    )
    if springs and not still:
        why += (" The forces of the springs are part of it.",)
    if still:
        why += (" It does not depend on any coordinate, so ", letters.G, " is zero.")
    return Step(
        id="g",
        stage=STAGE,
        title=f"The {'gravity and spring' if springs else 'gravity'} terms, from the potential energy",
        why=why,
        formula=equation(Letter("g", _K), letters.partial_derivative(letters.P, Letter("q", _K))),
        source=spong("7.3"),
        lines=gravity_rows(context),
        result=(equation(letters.G, context.form("g")),),
        normal=STATED | Part.WHY,
        uses=("P",),
        hint=(
            "Directly, without ",
            letters.TAU,
            ": the partial derivatives of the potential energy.",
        ),
        entries=letters.entries_of_column("g", context.robot.n),
        detail=Detail.BRIEF,
    )
