"""Steps of the motion near equilibria: how stable they are, and A and B of the linear model of one."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_node
from dynsolve.algebra.linear_systems import is_diagonal
from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.spaces import nullspace
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Prose
from dynsolve.document.books import GOLDSTEIN, SLOTINE_LI
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import ProductForms
from dynsolve.explain.sanity.definite import is_definite
from dynsolve.explain.sanity.determinant import sign_of
from dynsolve.explain.step import Detail, Line, Step, not_derived
from dynsolve.explain.writing import is_small, listed, scalar, side_by_side
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.questions.equilibria import linearization
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.questions.equilibria.linearization import may_be_held, steady_energy, steady_forces
from dynsolve.questions.equilibria.solving import Equilibria, wanted_rows
from dynsolve.questions.equilibria.stability import Higher, Point, Stability, by_coordinates, turned
from dynsolve.questions.forward_dynamics.derive import outside_names
from dynsolve.questions.shared_divisor import SharedDivisor, shared_divisor
from dynsolve.robot.model import Robot

_SOURCE = SLOTINE_LI.section("3.3")
ZERO = formula("𝟎")
DG = formula("∂𝐠/∂𝐪")
SOURCE = GOLDSTEIN.section("2.7")
FORCES = formula("𝐂 𝐪̇ + 𝐠")


def is_steady(robot: Robot) -> bool:
    """Whether some rates are constant, and not 0."""
    return bool(robot.questions.model.steady)


def forces_of(robot: Robot) -> Node:
    """The letters of the forces in balance: g, or what is left in a steady motion."""
    return FORCES if is_steady(robot) else letters.G


def forces_in_balance(context: Context) -> Matrix:
    """These forces, n×1."""
    still: Matrix = context.values["g"]
    return steady_forces(context.robot, context.values["C"], still) if is_steady(context.robot) else still


def held_by_friction(robot: Robot) -> dict[int, Expr]:
    """The Coulomb friction of each coordinate, from 0, that no motor holds."""
    ring, found = robot.ring, dict[int, Expr]()
    for act in robot.actions.resisting:
        for sign in act.functions(robot):
            (name,) = (name for name in ring.names if Symbol(name, 1) == sign.argument)
            k, (place,) = ring.names.index(name), ring.function(sign).used
            slides = {place: ring.one.poly, ring.symbol_indices[name, 1]: ring.zero.poly}
            if k in wanted_rows(robot):
                found[k] = found.get(k, ring.zero) + ring.put(act.force(robot)[k, 0], slides)
    return found


# -- how stable they are ---------------------------------------------------------------------------

_CONSTANT = "All this is with motors whose forces stay as they are."
_DEFINITE = "All this is where $𝐃$ is positive definite."
_NOT_HELD = "All this is without Coulomb friction{held}."
_CAN_HOLD = ", which can hold what is not stable"


def stability(context: Context, shown: EquilibriaForms, found: Equilibria) -> Step:
    """At which of the equilibria that are told the motion stays near, and why."""
    robot = context.robot
    steady = is_steady(robot)
    forces = forces_in_balance(context)
    curved = linearization.curvature(robot, forces)
    flat = _flat(robot, found, curved)
    why: Prose = say(_ENERGY, of="potential energy", flat=flat)
    if robot.questions.model.inputs_given:
        of = say(f"energy $𝒫 - 𝛕ᵀ 𝐪$, the forces of the motors staying as they are{'' if flat else ','}")
        why = say(_ENERGY, of=of, flat=flat)
    working: tuple[Node, ...] = ()
    if steady:
        why = _energy_of_motion(context, say("Where the matrix of its second derivatives{flat}", flat=flat))
        working = (_shown_energy(context),)
    told = [
        (point, _place(shown, point, case, shown.relations(one, case), is_among))
        for one, case, every in zip(found.alternatives, shown.equilibria, found.points, strict=True)
        for points in [_widest(every)]
        for is_among in [len(points) > 1 and any(not point.values for point in points)]
        for point in points
    ]
    more: Prose = ()
    lines: tuple[Line, ...] = ()
    if robot.questions.constraints:
        told, more = _of_constrained(told, all(found.points))
        more = (_INDIFFERENT,) if more and not told and _is_level(context) else more
        meeting = [point.is_crossing for point, _ in told]
        along = say(_ALONG_FREE, what="it" if steady else "the energy", curved=_curved(robot))
        why = _energy_of_motion(context, along) if steady else (*along, _CONSTRAINED_ENERGY)
        why = why if not all(meeting) else ()
        working = working if told else ()
        why += (f"{' ' * bool(why)}{_MEETING}",) if any(meeting) else ()
        lines = tuple(line for point, place in told for line in _along(shown, point, place))
    else:
        curvature = context.show(curved)
        second = formula("∂{forces}/∂𝐪", forces=forces_of(robot))
        working = (*working, *([equation(second, curvature)] if is_small(curvature) else []))
    sentences = [*(_verdict(context, shown, found, *one) for one in told), *([more] if more else [])]
    if robot.questions.model.inputs_given and any(point.is_told for point, _ in told):
        sentences.append((_CONSTANT,))
    if any(point.is_told for point, _ in told) and not is_definite(context):
        sentences.append(say(_DEFINITE))
    slid = held_by_friction(robot)
    falls = any(point.stability is not Stability.STABLE for point, _ in told)
    if slid and told and (falls or any(not forces[k, 0].is_zero for k in slid)):
        holds = falls and not robot.questions.constraints and _can_hold(context, curved, slid)
        sentences.append(say(_NOT_HELD, held=_CAN_HOLD if holds else ""))
    return Step(
        id="equilibria_stability",
        title="How stable they are",
        why=why,
        source=(SOURCE if steady else SLOTINE_LI.section("3.4")) if told else "",
        working=working,
        lines=lines,
        concluding=tuple(part for sentence in sentences for part in (*sentence, " ")),
        uses=("equilibria",),
    )


def _widest(points: Sequence[Point]) -> list[Point]:
    """Those of one case without what is told of more poses, too: q₁ = 90°, q₂ = 0 beside q₁ = 90° alone."""
    return [
        one
        for one in points
        if not any(
            {*other.values} < {*one.values} and replace(one, values=other.values) == other for other in points
        )
    ]


_ENERGY = (
    "Where the matrix of the second derivatives of the {of}{flat} is positive definite, the equilibrium is "
    "stable; where the energy falls in some direction, it is not."
)


def _flat(robot: Robot, found: Equilibria, curved: Matrix) -> Prose:
    """Of which coordinates rows and columns are left out, as these are 0 wherever stability is told.

    Where the rest depends on some of them, it must be what it is to be for every value.
    """
    told = [point for points in found.points for point in points if point.is_told]
    places = [set[int]() if point.drifts else {*point.neutral} for point in told]
    names = [robot.coordinates[k].name for k in sorted(set.intersection(*places))] if places else []
    if not names:
        return ()
    rows = "row and column" if len(names) == 1 else "rows and columns"
    inside = [
        Symbol(name)
        for name in names
        if any(not robot.ring.diff(entry, robot.ring.names.index(name)).is_zero for entry in curved.entries)
    ]
    return say(
        f", without the {rows} of {{names}}, which are 0 there,{{ever}}",
        names=listed([*map(Symbol, names)]),
        ever=say(" for every {inside}", inside=listed(inside)) if inside else "",
    )


def _of_constrained(
    told: list[tuple[Point, Prose]], are_points: bool
) -> tuple[list[tuple[Point, Prose]], Prose]:
    """What is known of equilibria that constraints hold, and that of others nothing is, if there are any."""
    known = [(point, sentence) for point, sentence in told if point.is_told]
    if len(known) == len(told) and are_points:
        return known, ()
    return known, (f"How stable {'the others' if known else 'they'} are is not told here.",)


_INDIFFERENT = (
    "The potential energy does not change along what the constraints leave free: every configuration that "
    "they allow is an equilibrium, and all are indifferent."
)


def _is_level(context: Context) -> bool:
    """Whether no motion that the constraints allow changes the potential energy, Zᵀ g = 0 everywhere."""
    robot = context.robot
    if is_steady(robot) or len(wanted_rows(robot)) < robot.n:
        return False
    return (nullspace(context.values["Ac"]).T @ forces_in_balance(context)).is_zero


_ALONG_FREE = (
    "Along what the constraints leave free, the columns of $𝐙$ with $𝐀_c 𝐙 = 𝟎$, {what} is curved as "
    "{curved} is, with the $𝛌$ of the equilibrium. Where that"
)
_CONSTRAINED_ENERGY = (
    " is positive definite, the equilibrium is stable; where the energy falls in some direction, it is not."
)
_MEETING = (
    "Smooth sets of configurations, each with a factor of the constraints that is 0, meet at such a point. "
    "Where the energy is curved upwards along each of them, the equilibrium is stable; where it falls along "
    "one, it is not."
)


def _curved(robot: Robot) -> Node:
    """How the energy is curved between the columns of Z."""
    return formula("𝐙ᵀ (∂({forces} - 𝐀_cᵀ 𝛌)/∂𝐪) 𝐙", forces=forces_of(robot))


def _along(shown: EquilibriaForms, point: Point, place: Prose) -> Iterator[Line]:
    """Z, λ and the matrix between Z at an equilibrium, where they can be read."""
    if point.along is None:
        return
    found = point.along
    products = ProductForms(shown.compactor(found.free.ring))
    free, held, second = map(products.of, (found.free, found.multipliers, found.second))
    if is_small(free, held, second):
        told = (
            formula("𝐙 = {free}", free=free),
            equation(letters.LAMBDA, scalar(held)),
            equation(_curved(shown.robot), scalar(second)),
        )
        yield Line(say("{place}:", place=place), told, is_kept=True)


def _place(
    shown: EquilibriaForms, point: Point, case: tuple[Node, ...], told: Sequence[Node], is_among: bool
) -> Prose:
    """At q₁ = -90°, q₂ = 0; in a case what is `told` of it is not told once more.

    It `is_among` others of its case that are told together: what holds in all of these holds there, too.
    """
    names = [q.name for q in shown.robot.coordinates]
    cases, at, alone = shown.equilibria, [], set[Angle]()
    for angle, degrees in turned(point.values):
        moving, fixed = by_coordinates(angle, names)
        alone |= {moving} if len(moving.terms) == 1 else set()
        at.append(equation(angle_node(moving, names), angle_node(fixed + Angle(degrees=degrees))))
    if at and (len(at) == len(case) or len(alone) == len(names)):
        return ("In the equilibrium " if is_among and len(cases) == 1 else "At ", side_by_side(at))
    if not case:
        return ("In every configuration",)
    at = [one for one in at if one not in told]
    one = "In every equilibrium" if is_among and not at else "In equilibrium"
    among = one if len(cases) == 1 else f"In case {cases.index(case) + 1}"
    return (among, " at ", side_by_side(at)) if at else (among,)


def _verdict(
    context: Context, shown: EquilibriaForms, found: Equilibria, point: Point, place: Prose
) -> Prose:
    """At q₁ = -90°, q₂ = 0: stable."""
    said = _VERDICTS[point.stability]
    needed = [*map(shown.inequality, point.conditions), *(shown.comparison(f, "≠") for f in point.nonzero)]
    if point.is_open and not point.falls:
        here = next(points for points in found.points if point in points)
        is_beside = any(other.is_told for other in here if other is not point)
        if is_beside and len(found.points) == 1:
            return ("How stable the others are is not told here.",)
        return say(f"{{place}} the stability{' of the others' * is_beside} is not told here.", place=place)
    if needed and not point.is_open:
        verdict: Prose = said if point.stability is Stability.UNSTABLE else ("stable",)
        said = say("{verdict} where {all}", verdict=verdict, all=listed(needed))
    if point.falls:
        fails = [shown.comparison(bound.value, "<") for bound in point.conditions]
        one: Prose = ("one of these inequalities is reversed",) if len(fails) > 1 else (fails[0],)
        said = say(
            "{stable}, not stable where {one}{root}", stable=said, one=one, root=_root(shown, found, point)
        )
        if point.is_open:
            said = say("not stable where {fails}", fails=listed(fails, "or"))
    robot = context.robot
    steady = dict(robot.questions.model.steady)
    names = [robot.coordinates[k].name for k in point.neutral]
    free = listed([Symbol(name) for name in names if name not in steady])
    slopes = (
        robot.ring.diff(force, k) for force in forces_in_balance(context).entries for k in point.neutral
    )
    changes = any(not slope.is_zero for slope in slopes)
    if point.inside:
        inside = listed([*map(shown.inequality, point.inside)])
        place = say("{place}, where {inside}", place=place, inside=inside)
    is_held = point.is_told and not point.is_open and point.stability is not Stability.UNSTABLE
    along = say(", but for {free}, {why}", free=free, why=_AT_ANY[changes]) if free and is_held else ""
    if point.drifts:
        along = (", but for motions along the equilibria, in which nothing changes",)
    higher = tuple(part for one in point.higher for part in _higher(shown, one))
    return say("{place}: {said}{along}.{higher}", place=place, said=said, along=along, higher=higher)


def _higher(shown: EquilibriaForms, one: Higher) -> Prose:
    """The first derivative by x that is not 0 there is the fourth, 24c: its sign decides."""
    by = say("along $𝐙$")
    if one.coordinate is not None:
        by = say("by {name}", name=Symbol(shown.robot.coordinates[one.coordinate].name))
    value = say(", {value}", value=shown.compactor(one.value.ring).form(one.value)) if one.is_exact else ()
    decides = ": beside it the energy falls on one side" if one.order % 2 else ", and its sign decides"
    text = " The first derivative of the energy {by} that is not 0 there is the {order}{value}{decides}."
    return say(text, by=by, order=_ORDINALS[one.order], value=value, decides=decides)


def _root(shown: EquilibriaForms, found: Equilibria, point: Point) -> str:
    """At which root of a quadratic the only condition of a point holds."""
    cases = (case for case, points in zip(found.alternatives, found.points, strict=True) if point in points)
    values = [bound.value for bound in point.conditions]
    for one in (one for case in cases for one in case if len(values) == 1):
        if sign := shown.positive_root(one, values[0]):
            return f", in this order with {'+ and -' if sign > 0 else '- and +'}"
    return ""


_ORDINALS = {3: "third", 4: "fourth", 5: "fifth", 6: "sixth", 7: "seventh", 8: "eighth"}
_AT_ANY = ("along which nothing changes", "with any value of which it is an equilibrium")

_VERDICTS: dict[Stability, Prose] = {
    Stability.STABLE: ("stable",),
    Stability.UNSTABLE: ("not stable",),
    Stability.UNDECIDED: ("second derivatives alone do not decide",),
}


def _can_hold(context: Context, curvature: Matrix, slid: Collection[int]) -> bool:
    """Whether what has no Coulomb friction is stable by itself, in every pose."""
    free = [k for k in range(context.robot.n) if k not in slid]
    alone = all(curvature[i, j].is_zero for i in free for j in free if i != j)
    return alone and all(sign_of(context, curvature[k, k]) > 0 for k in free)


def _shown_energy(context: Context) -> Node:
    """The energy whose derivatives these forces are."""
    value = context.show(steady_energy(context.robot, context.values["P"], context.values["K"]))
    return equation(letters.STEADY_ENERGY, formula("𝒫 - 𝒦"), value)


def _energy_of_motion(context: Context, where: Prose) -> Prose:
    """What the stability follows from: `where` something is positive definite."""
    elsewhere = "; where {V} falls in some direction, it is not. "
    if may_be_held(context.robot, context.values["D"]):
        elsewhere = (
            ". Elsewhere nothing is said: what {V} alone lets fall may be held by forces of first order in "
            "the rates, or by a rate that is free to change. "
        )
    return say(
        "These forces are the derivatives of {V}, the potential energy less the kinetic energy of the "
        "motion. {where} is positive definite, the motion is stable" + elsewhere,
        V=letters.STEADY_ENERGY,
        where=where,
    )


# -- near one of them ------------------------------------------------------------------------------


_NOT_STEADY = "The equilibrium is one at rest, all rates being 0, and none of the motion above. "
_SECOND_ORDER = (
    "$𝐂 𝐪̇$ is of second order in the rates and falls away; so does every change of $𝐃$, which stands beside "
    "an acceleration. "
)


def linear_divisor(context: Context) -> SharedDivisor | None:
    """det D in the equilibrium, or what is left of it, where many entries of A and B are over that."""
    found = [context.values[name] for name in ("linear_A", "linear_B") if name in context.wanted]
    matrices = [one for one in found if not isinstance(one, Skipped)]
    if not matrices:
        return None
    size = determinant(linearization.at_equilibrium(context.robot).matrix(context.values["D"]))
    shared = shared_divisor(context.forms.products, matrices, size)
    is_taken = "qdd_forward" in context.wanted  # where Δ is det D in every configuration
    return replace(shared, letter=letters.DIVISOR_THERE) if shared and is_taken else shared


def _linear_form(context: Context, name: str, shared: SharedDivisor | None) -> Node:
    return context.form(name) if shared is None else shared.form(context.values[name])


def state_matrix(context: Context, shared: SharedDivisor | None) -> Step:
    """A = [0, E; -D⁻¹ ∂g/∂q, -D⁻¹ F], 2n×2n."""
    robot, value = context.robot, context.values["linear_A"]
    if isinstance(value, Skipped):
        return not_derived("linear_A", "The matrix A of the linear model", value.why)
    has_friction = robot.actions.resisting
    passive = [Symbol(robot.coordinates[k].name) for k in robot.actions.passive]
    by = f"{robot.held_by} {'do' if 'spring' in robot.held else 'does'}"
    balanced = f"No motor drives {{passive}}: in the equilibrium {by} not move {{which}}. "
    rests = [
        equation(Symbol(name, dots), value)
        for (name, dots), value in robot.questions.model.equilibrium.items()
    ]
    at = linearization.at_equilibrium(robot)
    outside = next((context.values[name] for name in outside_names(robot)), None)
    still, of_still = context.values["g"], DG
    if outside is not None:
        still, of_still = still - outside, formula("∂(𝐠 - 𝐐)/∂𝐪")
    D, g = at.matrix(context.values["D"]), linearization.stiffness(robot, still)
    working: list[Node] = [equation(letters.D, context.show(D)), equation(of_still, context.show(g))]
    if has_friction:
        F = linearization.damping(robot, context.values["friction"])
        working.append(equation(letters.bold("F"), context.show(F)))
    if shared is None and not is_diagonal(D):
        working.append(equation(letters.DET_D, context.show(determinant(D))))
    jumps = "Coulomb friction jumps where a rate changes its sign: it has no part in a linear model."
    return Step(
        id="linear_A",
        title="The motion near the equilibrium",
        why=say(
            "The state is how far the coordinates are from the equilibrium, $𝐪 - 𝐪_e$, and their rates; the "
            "inputs are counted from the forces that hold it. {at_rest}{balanced}{moving}The matrices are "
            "taken at {rests}. $𝐄$ is the identity matrix{friction}.",
            at_rest=_NOT_STEADY if "equilibria" in context.wanted and robot.questions.model.steady else "",
            moving=say(_SECOND_ORDER)
            if any(map(robot.ring.depends_on_coordinates, context.values["D"].entries))
            else "",
            friction=say(", $𝐅$ the factors of the rates in the friction") if has_friction else "",
            balanced=say(balanced, passive=listed(passive, "or"), which="it" if len(passive) == 1 else "them")
            if passive
            else "",
            rests=side_by_side(rests),
        ),
        formula=equation(
            letters.LINEAR_A,
            formula(
                "[𝟎, 𝐄; -𝐃⁻¹ {still}, {F}]", still=of_still, F=formula("-𝐃⁻¹ 𝐅") if has_friction else ZERO
            ),
        ),
        source=_SOURCE,
        working=tuple(working),
        lines=() if shared is None else (shared.line,),
        result=(equation(letters.LINEAR_A, _linear_form(context, "linear_A", shared)),),
        defines=() if shared is None else (shared.meaning,),
        notes=((jumps,),) if any(act.functions(robot) for act in has_friction) else (),
        detail=Detail.BRIEF,
    )


def input_matrix(context: Context, shared: SharedDivisor | None) -> Step:
    """B = [0; D⁻¹ S], 2n×m."""
    robot, value = context.robot, context.values["linear_B"]
    if isinstance(value, Skipped):
        return not_derived("linear_B", "The matrix B of the linear model", value.why)
    inputs: list[Node] = [letters.force(robot.coordinates[k]) for k in linearization.driven(robot)]
    column = "A column for each input" if len(inputs) > 1 else "One column, of the only input"
    ones = "has a 1 in the row of each, a column each" if len(inputs) > 1 else "has a 1 in its row"
    if len(inputs) == robot.n:
        ones = "is the identity matrix"
    return Step(
        id="linear_B",
        title="What the inputs do to it",
        why=say("{column}: {inputs}. $𝐒$ {ones}.", column=column, inputs=listed(inputs), ones=ones),
        formula=equation(letters.LINEAR_B, formula("[𝟎; 𝐃⁻¹ 𝐒]")),
        source=_SOURCE,
        result=(equation(letters.LINEAR_B, _linear_form(context, "linear_B", shared)),),
        defines=() if shared is None else (shared.meaning,),
        detail=Detail.BRIEF,
    )
