"""Steps of the vectorized form: D, C and g read off from τ, assembled directly, and compared."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import asdict, replace

from dynsolve.algebra.linear_systems import is_diagonal
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.body_parts import angular_name, linear_name, part_steps, sum_step
from dynsolve.explain.christoffel import (
    CONSTANT,
    NO_CORIOLIS,
    SKEW,
    SLOPES,
    agreement_step,
    christoffel_step,
    skew_step,
)
from dynsolve.explain.context import Context
from dynsolve.explain.named_steps import ending
from dynsolve.explain.placed_bodies import inertia_step
from dynsolve.explain.sanity import sanity_steps
from dynsolve.explain.step import STATED, Detail, Part, Step
from dynsolve.explain.terms import closing_step, driving_side, terms_step
from dynsolve.explain.working.derivatives import coriolis_sums, gravity_rows
from dynsolve.explain.working.identities import Way
from dynsolve.explain.writing import (
    and_joined,
    are_counted,
    counted_sum,
    listed,
    sum_of,
    sum_over_coordinates,
    turns,
)
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Product, Sum, Symbol
from dynsolve.quantities import letters
from dynsolve.robot.questions import Method

LONGEST_IN_PARTS = 150
"""Up to this number of terms in D its parts are shown too."""


def steps(context: Context) -> Iterator[Step]:
    """D, C and g read off; from the energies assembled directly too, and compared."""
    if context.by_energies:
        yield inertia_of_energy(context)
    else:
        yield inertia(context)
        yield rest(context)
    if from_energies(context):
        yield from direct(context)
    yield christoffel_step(context)
    yield coriolis(context)
    if from_energies(context):
        yield gravity(context)
        yield agreement_step(context)
    yield from checked(context)


def checked(context: Context) -> Iterator[Step]:
    """What is checked on the model, and the whole of it."""
    yield skew_step(context)
    yield from terms_step(context)
    yield from sanity_steps(context)
    yield closing_step(context)


def direct(context: Context) -> Iterator[Step]:
    """D as it is assembled without the forces, the whole first; its parts and their sum."""
    given = context.robot.given
    steps = [_inertia_direct(context) if given is None else inertia_step(context, given)]
    if _is_short(context):
        steps += (step for body in context.robot.bodies for step in part_steps(context, body))
    if context.robot.actions:
        from dynsolve.explain.actions import rotor_part_step

        steps += rotor_part_step(context)
    steps += _sum(context)
    yield from (replace(step, detail=Detail.FULL) for step in steps)


def inertia(context: Context) -> Step:
    """D, read off from the forces."""
    robot, n, D = context.robot, context.robot.n, context.values["D"]
    decoupled = n > 1 and is_diagonal(D)
    forces = listed([letters.force(q) for q in robot.coordinates])
    is_force = not robot.actions.passive and driving_side(context) == letters.TAU
    end = ending(context, "D", {"D": (letters.D,)})
    return Step(
        id="D",
        title="The inertia matrix, read off from the forces",
        why=say(
            "Entry $d_ij$ is the factor of the acceleration $q̈_j$ in {force}. "
            "$𝐃$ is symmetric, and may depend on the coordinates, but on no rate.{diagonal}",
            force="the right side of equation i, that of coordinate i"
            if not is_force
            else say("the generalized force $τ_i$")
            if all(map(turns, robot.coordinates))
            else say("the generalized force $τ_i$, entry $i$ of $𝛕$ ({forces})", forces=forces),
            diagonal=" Here it is diagonal: no acceleration enters the force of another coordinate."
            if decoupled
            else "",
        ),
        formula=formula("d_ij = ∂τ_i/∂q̈_j") if is_force else None,
        source=f"from {spong('7.3')}",
        **asdict(end),
        uses=_forces(context),
        entries=letters.entries("d", n),
        detail=Detail.BRIEF,
    )


def inertia_of_energy(context: Context) -> Step:
    """D, read off from the kinetic energy."""
    n = context.robot.n
    entries = say("entry $d_ii$ is twice the factor of $q̇_i²$ in it, and $d_ij$ the factor of $q̇_i q̇_j$")
    if n > 1 and is_diagonal(context.values["D"]):
        entries = say("it has no product of two rates, so $𝐃$ is diagonal, with twice the factor of $q̇_i²$")
    if n == 1:
        entries = say("its entry is twice the factor of the squared rate")
    return Step(
        id="D",
        title="The inertia matrix, read off from the kinetic energy",
        why=say("The kinetic energy is $𝒦 = ½ 𝐪̇ᵀ 𝐃 𝐪̇$ with a symmetric $𝐃$: {entries}.", entries=entries),
        formula=formula("d_ij = ∂/∂q̇_j (∂𝒦/∂q̇_i)"),
        source=f"from {spong('7.2.2')}",
        **asdict(ending(context, "D", {"D": (letters.D,)})),
        uses=("K",),
        entries=letters.entries("d", n),
        detail=Detail.BRIEF,
    )


def from_energies(context: Context) -> bool:
    """Whether the forces come from the Lagrangian, so that D and g follow from the energies too."""
    return context.robot.questions.method is Method.LAGRANGE


def _forces(context: Context) -> tuple[str, ...]:
    return tuple(f"tau{q.index}" for q in context.robot.coordinates)


def rest(context: Context) -> Step:
    """The forces without the terms of accelerations: C q̇ + g."""
    values, of_energies = context.values, from_energies(context)
    has_friction = bool(context.robot.actions.resisting)
    acting = driving_side(context)
    left = [*(acting.terms if isinstance(acting, Sum) else (acting,)), formula("-𝐃 𝐪̈")]
    what_is_left = (
        "What is left of the forces without the accelerations: the terms with rates {are_C}; the others, "
        "which remain when the {machine} is at rest, are $𝐠$.{no_rates}{no_rest}{friction}"
    )
    results = {"Cqd": (formula("𝐂 𝐪̇"),), "g": (letters.G,)}
    end = ending(context, "Cqd", {"g": (letters.G,)} if context.is_in_letters else results)
    in_letters = say(" $𝐂 𝐪̇$ is not written out: the Christoffel symbols below give it.")
    return Step(
        id="Cqd",
        title=f"{and_joined(['Coriolis', 'centrifugal', *context.robot.held])} terms, read off",
        why=say(
            what_is_left + "{in_letters}",
            are_C=say("are $𝐂 𝐪̇$"),
            machine=context.machine,
            no_rates=" No term has rates here." if values["Cqd"].is_zero else "",
            no_rest=" No term remains at rest here." if values["g"].is_zero else "",
            friction=say(" Friction, $𝛕_f$, is taken off.") if has_friction else "",
            in_letters=in_letters if context.is_in_letters else "",
        ),
        formula=formula("𝐂 𝐪̇ + 𝐠 = {left}", left=sum_of([*left, *([formula("-𝛕_f")] * has_friction)])),
        source=spong("7.3"),
        **asdict(end),
        also=()
        if of_energies or context.is_in_letters
        else ("g",),  # from the energies a step of its own gives g
        uses=(*_forces(context), "D"),
        detail=Detail.FULL if of_energies else Detail.NORMAL,
        hint=say(
            what_is_left, are_C="belong to C", machine=context.machine, no_rates="", no_rest="", friction=""
        ),
    )


def _inertia_direct(context: Context) -> Step:
    robot = context.robot
    added = counted_sum(
        formula("(m_i 𝐉_v_iᵀ 𝐉_v_i + 𝐉_ω_iᵀ 𝓘_i 𝐉_ω_i)"),
        Symbol("i"),
        len(robot.bodies),
        {formula("m_i"): context.forms.mass(body) for body in robot.bodies[:1]},
    )
    same = context.values["D"] == context.values["D_direct"]
    names = and_joined([body.name for body in robot.bodies])
    terms: list[Node] = []
    for body in robot.bodies:
        terms += [linear_name(context, body), *(() if body.is_point else (angular_name(context, body),))]
    rotors = (letters.DM,) if robot.actions.rotors else ()
    return Step(
        id="D_direct",
        title="The inertia matrix, assembled from the Jacobians",
        why=say(
            "Without the Lagrangian: with $𝐯_i = 𝐉_v_i 𝐪̇$ and $𝛚_i = 𝐉_ω_i 𝐪̇$ the kinetic energy is "
            "$𝒦 = ½ 𝐪̇ᵀ 𝐃 𝐪̇$, where $𝐃$ is a sum over the bodies{names}.{points}{rotors}{same}",
            names="" if are_counted(robot.bodies) else f" {names}, counted in this order",
            points=" A point mass has no second term." if any(body.is_point for body in robot.bodies) else "",
            rotors=say(" The rotors add $𝐃_m$.") if rotors else "",
            same=""
            if _sum(context)
            else say(
                " The sum is {the} $𝐃${each}.",
                the="the same" if same else "not the same",
                each=", entry by entry" if same else "",
            ),
        ),
        formula=formula("𝐃 = {sum}", sum=sum_of([added, *rotors])),
        source=spong("7.2.2"),
        further=(formula("𝐃 = {sum}", sum=sum_of([*terms, *rotors])),),
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


def _is_short(context: Context) -> bool:
    """Whether D is short enough for its parts to be of use to a reader."""
    return sum(len(entry) for entry in context.values["D"].entries) <= LONGEST_IN_PARTS


# -- C and g ---------------------------------------------------------------------------------------


def coriolis(context: Context, told: tuple[Prose, tuple[Node, ...]] | None = None) -> Step:
    """C, from the Christoffel symbols; of a long model what is `told` of it, and how."""
    rate = formula("q̇_i")
    by_symbols = sum_over_coordinates(formula("c_ijk {rate}", rate=rate), Symbol("i"), context.robot)
    by_slopes = sum_over_coordinates(Product((SLOPES, rate)), Symbol("i"), context.robot)
    n, is_none = context.robot.n, context.values["C"].is_zero
    others = (
        "Other matrices $𝐂$ give the same $𝐂 𝐪̇$, which is all that the equations of motion fix. This choice "
        "makes {skew} skew-symmetric."
    )
    why = say(
        "Row $k$, column $j$. $𝐂 𝐪̇$ holds the centrifugal terms (a rate squared){coriolis}.",
        coriolis=" and the Coriolis terms (a product of two rates)" if n > 1 else "",
    )
    why, result = told or (why, (formula("𝐂 = {C}", C=context.result("C")),))
    sums = formula("c_kj = {symbols} = ½ {slopes}", symbols=by_symbols, slopes=by_slopes)
    return Step(
        id="C",
        title="The Coriolis matrix, from the Christoffel symbols",
        why=CONSTANT if is_none else why,
        said="constant" if is_none else "",
        formula=None if is_none else sums,
        task=sums,
        source=spong("7.3"),
        lines=coriolis_sums(context),
        result=(NO_CORIOLIS,) if is_none else result,
        hint=say(
            "Row $k$, column $j$: a sum over $i$. Multiplied by the rates it must give what you read off "
            "from the forces."
        ),
        entries=() if context.is_in_letters or is_none else letters.entries("c", n),
        notes=() if is_none or n == 1 else (say(others, skew=SKEW),),
        detail=Detail.BRIEF,
    )


def gravity(context: Context, told: tuple[Prose, Way] | None = None) -> Step:
    """g, from the potential energy; of a long model as it is `told`."""
    directly = say("Directly, without $𝛕$: the partial derivatives of the potential energy.")
    if context.by_energies:
        directly = say("The partial derivatives of the potential energy.")
    none = say(" It does not depend on any coordinate, so $𝐠$ is zero.")
    why = (*directly, *none) if context.values["g"].is_zero else directly
    why, way = told or (why, Way(gravity_rows(context)))
    end = ending(context, "g", {"g": (letters.G,)}, way)
    return Step(
        id="g",
        title=f"The {' and '.join(context.robot.held)} terms, from the potential energy",
        why=why,
        formula=formula("g_k = ∂𝒫/∂q_k"),
        source=spong("7.3"),
        **asdict(end),
        normal=STATED | Part.WHY,
        uses=("P",),
        hint=directly,
        entries=letters.entries_of_column("g", context.robot.n),
        detail=Detail.BRIEF,
    )
