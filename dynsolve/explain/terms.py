"""What each term of a force is: inertial, coupling, centrifugal, Coriolis, friction, gravity or spring.

By the rates, so that it is true of every robot (Spong, Hutchinson, Vidyasagar, section 7.3):

    q̈_k in force k     inertial
    q̈_j, j ≠ k         coupling inertia
    q̇_j²               centrifugal
    q̇_i q̇_j            Coriolis
    none               gravity, or a spring
    sgn q̇, f_v q̇      friction
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from enum import StrEnum

from msgspec import Struct

from dynsolve.algebra.ring import Expr
from dynsolve.document import Inline, Prose, Reference, Table
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.christoffel import equal_symbols
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import collected, collected_coriolis_force, pairs
from dynsolve.explain.forms import entry_of
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import agreeing, listed, sum_of
from dynsolve.notation.build import cost, summands, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Negative,
    Node,
    Number,
    Product,
    Relation,
    Sum,
    Symbol,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot import units
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Coordinate, JointType, Robot

LONGEST = 14
"""The operations up to which the values of terms stand beside their names."""


class Kind(StrEnum):
    """What a term of a force is; the value is what stands in the table."""

    INERTIAL = "inertial"
    COUPLING = "coupling inertia"
    CENTRIFUGAL = "centrifugal"
    CORIOLIS = "Coriolis"
    FRICTION = "friction"
    GRAVITY = "gravity"
    SPRING = "spring"
    HELD = "gravity and spring"
    POTENTIAL = "potential"


_MEANINGS: dict[Kind, str] = {
    Kind.INERTIAL: " with the acceleration of its own coordinate is inertial.",
    Kind.COUPLING: "With that of another coordinate it is coupling inertia.",
    Kind.CENTRIFUGAL: "With the square of a rate it is centrifugal: it remains where that coordinate alone "
    "moves.",
    Kind.CORIOLIS: "With the product of two rates it is a Coriolis term: it needs both to move.",
    Kind.FRICTION: "What takes energy away is friction: its sign is that of the rates.",
    Kind.GRAVITY: "Without rates and accelerations it is gravity: what {holds} must hold at rest.",
    Kind.SPRING: "Without rates and accelerations it is a spring: what {holds} must hold at rest.",
    Kind.HELD: "Without rates and accelerations it is what {holds} must hold at rest, against gravity and "
    "springs.",
    Kind.POTENTIAL: "Without rates and accelerations it is of the potential energy: what {holds} must hold "
    "at rest.",
}

_TWICE = " The 2 of a Coriolis term comes from two equal symbols{symbols}: $c_ijk + c_jik = 2 c_ijk$."


class Term(Struct, frozen=True):
    """A term of force k: factor · rates, in letters and in value; `rates` are (place, dots)."""

    kind: Kind
    count: int
    letter: Node
    factor: Expr
    rates: tuple[tuple[int, int], ...] = ()


def terms_of(context: Context, k: int) -> Iterator[Term]:
    """The terms of force k, from 0, that are not zero."""
    return (term for term in _all_terms(context, k) if not term.factor.is_zero)


def _all_terms(context: Context, k: int) -> Iterator[Term]:
    n, values = context.robot.n, context.values
    for j in range(n):
        kind = Kind.INERTIAL if j == k else Kind.COUPLING
        yield Term(kind, 1, letters.entry("d", k + 1, j + 1), values["D"][k, j], ((j, 2),))
    for i, j in pairs(n):
        kind, count = (Kind.CENTRIFUGAL, 1) if i == j else (Kind.CORIOLIS, 2)
        letter = letters.entry("c", i + 1, j + 1, k + 1)
        yield Term(kind, count, letter, values["christoffel"][i, j, k], ((i, 1), (j, 1)))
    if context.robot.actions.resisting:
        yield Term(Kind.FRICTION, 1, letters.friction(k + 1), values["friction"][k, 0])
    yield Term(_held_by(context, k), 1, letters.entry("g", k + 1), values["g"][k, 0])


def _held_by(context: Context, k: int) -> Kind:
    """What a term without rates holds: gravity, a spring, or both."""
    if context.robot.given is not None:
        return Kind.POTENTIAL
    springs = context.robot.actions.stored
    spring = context.robot.ring.diff(context.values["Ps"], k) if springs else None
    if spring is None or spring.is_zero:
        return Kind.GRAVITY
    return Kind.SPRING if context.values["g"][k, 0] == spring else Kind.HELD


def value_of_term(context: Context, term: Term) -> Expr:
    """The exact value of a term."""
    ring = context.robot.ring
    value = term.factor * term.count
    for place, dots in term.rates:
        value = value * ring.symbol(ring.names[place], dots)
    return value


def terms_step(context: Context) -> Iterator[Step]:
    """The table of the terms of every force; none for longer arms, or where the terms are not all of τ."""
    robot = context.robot
    if not context.is_short:
        return
    found = [(q, list(terms_of(context, q.index - 1))) for q in robot.coordinates]
    for q, terms in found:
        total = sum((value_of_term(context, term) for term in terms), start=robot.ring.zero)
        if total != context.values[f"tau{q.index}"]:
            return
    kinds = frozenset(term.kind for _, terms in found for term in terms)
    held = frozenset({Kind.GRAVITY, Kind.SPRING, Kind.HELD})
    told = kinds - held | {Kind.HELD} if len(held & kinds) > 1 else kinds  # both at once
    holds = "the joint" if robot.has_table else "the force of the coordinate"
    each = [term for _, terms in found for term in terms]
    long = {len(term.rates) for term in each if cost(context.show(value_of_term(context, term))) > LONGEST}
    whole = frozenset(len(term.rates) for term in each) - long  # of these all have their values beside
    types = {q.type for q in robot.coordinates}
    names = {JointType.REVOLUTE: "torque", JointType.PRISMATIC: "force"}
    header = ("torque or force" if len(types) > 1 else names[types.pop()], "term", "what it is")
    yield Step(
        id="terms",
        title="What the terms of the forces are",
        why=say(
            "A term{forces}{meanings}{twice}{units}",
            forces=Reference(tuple(f"tau{q.index}" for q in robot.coordinates), " of "),
            meanings=" ".join(_MEANINGS[kind].format(holds=holds) for kind in Kind if kind in told),
            twice=say(_TWICE, symbols=equal_symbols(context)) if Kind.CORIOLIS in kinds else "",
            units=_said_of_units(context, found),
        ),
        source=spong("7.3"),
        table=Table(header, tuple(row for q, terms in found for row in _rows(context, q, terms, whole))),
        detail=Detail.FULL,
        is_task=False,
    )


def _rows(
    context: Context, q: Coordinate, terms: list[Term], whole: frozenset[int]
) -> Iterator[tuple[Inline, ...]]:
    for place, term in enumerate(terms):
        form = times(term.count, [(term.letter, 1), *rates_of(context, term)])  # 2 c_121 q̇_1 q̇_2
        if context.has_named_symbols and term.kind in (Kind.CENTRIFUGAL, Kind.CORIOLIS):
            (i, _), (j, _) = term.rates
            symbol = context.symbol(i, j, q.index - 1)
            form = equation(form, times(term.count, [(symbol, 1), *rates_of(context, term)]))
        elif len(term.rates) in whole and not context.leaves_values_out:
            form = equation(form, context.named(context.show(value_of_term(context, term))))
        yield (letters.force(q) if place == 0 else "", form, str(term.kind))


def rates_of(context: Context, term: Term) -> list[tuple[Node, int]]:
    """The rates of a term, each with its exponent."""
    names = context.robot.ring.names
    rates: list[tuple[Node, int]] = [(Symbol(names[place], dots), 1) for place, dots in term.rates]
    return [(rates[0][0], 2)] if term.kind is Kind.CENTRIFUGAL else rates


# -- units -----------------------------------------------------------------------------------------


def _said_of_units(context: Context, found: list[tuple[Coordinate, list[Term]]]) -> Prose:
    """That every term has the unit of its force, where all units are known."""
    known = Dimensions(context.robot.ring, context.robot)
    of_type = {JointType.REVOLUTE: units.ENERGY, JointType.PRISMATIC: units.FORCE}
    if any(known.of(value_of_term(context, term)) != of_type[q.type] for q, terms in found for term in terms):
        return ()
    written = {
        JointType.REVOLUTE: ("kg m^2/s^2 = N m", " in a torque (an angle is a number)"),
        JointType.PRISMATIC: ("kg m/s^2 = N", " in a force"),
    }
    types = {q.type for q, _ in found}
    said = [(units.node(unit), where) for kind, (unit, where) in written.items() if kind in types]
    return say(" Each term has the unit of its force: {units}.", units=listed(said))


# -- the step that closes a derivation: D q̈ + C q̇ + g = τ, with this robot's matrices where they fit
# Friction stands beside g, forces from outside and of constraint beside τ, where there are any.

ID = "model"
"""The closing step; reports show it in their last section, with what it is made of."""

WIDEST = 84
"""The characters up to which matrices are written out in the equation; wider ones stand by themselves."""

_HELD = formula("𝐀_cᵀ 𝛌")


def closing_step(context: Context) -> Step:
    """D q̈ + C q̇ + g = τ, with friction on the left, Q and A_cᵀ λ on the right where there are any."""
    robot = context.robot
    names = ["D", "C", *robot.actions.resistance, "g"]
    names = [name for name in names if name not in ("C", "g") or not context.values[name].is_zero]
    qd, qdd = (column(*(Symbol(q.name, dots) for q in robot.coordinates)) for dots in (1, 2))
    passive = robot.actions.passive
    forces = column(*(ZERO if k in passive else letters.force(q) for k, q in enumerate(robot.coordinates)))
    result: tuple[Node, ...] = ()
    if (
        context.is_short
        and robot.n > 1
        and all(matrix_width(context, context.matrix(name)) <= WIDEST for name in names)
    ):
        times_rates = {"D": qdd, "C": qd}
        parts = {name: context.result(name) for name in names}
        left = [Product((part, times_rates[n])) if n in times_rates else part for n, part in parts.items()]
        result = (equation(sum_of(left), sum_of([forces, *_beside_motors(context)])),)
    return Step(
        id=ID,
        title="The dynamical model",
        why=_meanings(context),
        formula=equation(moving_side(context, in_full=True), driving_side(context)),
        source=spong("7.3"),
        lines=_shortest_row(context) if context.is_in_letters else _rows_in_names(context),
        result=result,
        detail=Detail.BRIEF,
    )


MOST_TERMS = 30
"""The terms up to which a row of τ of a long model is shown."""


def _shortest_row(context: Context) -> tuple[Line, ...]:
    """The row of τ of the fewest terms, of equally short ones the last."""
    if context.robot.actions.resisting:
        return ()
    rows = [(q, context.result(f"tau{q.index}")) for q in reversed(context.robot.coordinates)]
    q, row = min(rows, key=lambda each: len(summands(each[1])))
    if len(summands(row)) > MOST_TERMS:
        return ()
    by = ("The shortest row as an example", Reference(("D", "christoffel", "g"), ", "), ":")
    return (Line(by, (equation_of_motion(context.robot, q, row),)),)


def _rows_in_names(context: Context) -> tuple[Line, ...]:
    """The rows with h, before which the forces were derived."""
    robot, names = context.robot, context.names
    if names is None or names.single is None:
        return ()
    forces = Reference(tuple(f"tau{q.index}" for q in robot.coordinates), ", ")
    return (Line(("Row by row", forces, ":"), rows_in_names(robot, names, context.form)),)


def rows_in_names(robot: Robot, names: Abbreviated, forms: Callable[[str], Node]) -> tuple[Node, ...]:
    """Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + g_k = τ_k in the names of a model; friction is of the `forms`."""
    coordinates = robot.ring.names
    accelerations = [Symbol(name, 2) for name in coordinates]
    columns = [forms("friction"), names.g] if robot.actions.resisting else [names.g]

    def row(k: int) -> Node:
        inertial = collected(zip(names.D.rows[k], accelerations, strict=True))
        forces = collected_coriolis_force(coordinates, names.symbol, k)
        return total([inertial, forces, *(entry_of(column, (k, 0)) for column in columns)])

    return tuple(equation_of_motion(robot, q, row(k)) for k, q in enumerate(robot.coordinates))


def _beside_motors(context: Context, constrained: bool = True) -> list[Node]:
    """Q and A_cᵀ λ, as far as there are forces from outside and constraints."""
    asked = context.robot.questions
    outside: list[Node] = [letters.Q_FORCES] if asked.loads else []
    return [*outside, _HELD] if constrained and asked.constraints else outside


def driving_side(context: Context, constrained: bool = True) -> Node:
    """τ + Q + A_cᵀ λ, or without the last where that is put elsewhere."""
    return sum_of([letters.TAU, *_beside_motors(context, constrained)])


def equation_of_motion(robot: Robot, q: Coordinate, row: Node) -> Relation:
    """A row of the left side and what it comes to, where no motor drives 0: 0 = m l ÿ + g."""
    return equation(driving_row(robot, q, with_passive=False), row)


def driving_row(robot: Robot, q: Coordinate, *, with_passive: bool = True) -> Node:
    """τ_k + Q_k + (A_cᵀ λ)_k: what a row of the left side comes to; beside others no τ_k that is 0."""
    asked, is_driven = robot.questions, q.index - 1 not in robot.actions.passive
    is_driven |= with_passive and not (asked.loads or asked.constraints)
    motor: list[Node] = [letters.force(q)] if is_driven else []
    outside: list[Node] = [letters.entry("Q", q.index)] if asked.loads else []
    held: list[Node] = [Entry(_HELD, Number(q.index))] if asked.constraints else []
    return sum_of([*motor, *outside, *held])


def moving_side(context: Context, in_full: bool = False) -> Node:
    """D q̈ + C q̇ + g, and friction; without C q̇ and g where these are 0, if not `in_full`."""
    return sum_of([formula("𝐃 𝐪̈"), *_beside_inertia(context, in_full)])


def _beside_inertia(context: Context, in_full: bool = False) -> list[Node]:
    terms = [formula("𝐂 𝐪̇")] if in_full or not context.values["Cqd"].is_zero else []
    rubs = [formula("𝛕_f")] if context.robot.actions.resisting else []
    still = [letters.G] if in_full or not context.values["g"].is_zero else []
    return [*terms, *rubs, *still]


def acting_side(context: Context) -> Node:
    """τ + Q - C q̇ - friction - g: everything that acts but constraints, beside D q̈."""
    driving = driving_side(context, constrained=False)
    acting = driving.terms if isinstance(driving, Sum) else (driving,)
    return sum_of([*acting, *map(Negative, _beside_inertia(context))])


def equations_of_motion(context: Context) -> Relation:
    """D q̈ + C q̇ + g = τ in letters, with everything that acts."""
    return equation(moving_side(context), driving_side(context))


def _meanings(context: Context) -> Prose:
    robot = context.robot
    passive: Prose = ()
    if robot.actions.passive:
        from dynsolve.explain.actions import passive_prose

        passive = passive_prose(context)
    return say(
        "$𝐃 𝐪̈$ are the inertial terms, $𝐂 𝐪̇$ the Coriolis and centrifugal ones, {friction}$𝐠$ those of "
        "{by}.{outside}{held}{passive}",
        friction=say("$𝛕_f$ those of friction, ") if context.robot.actions.resisting else "",
        by=robot.held_by,
        outside=say(" $𝐐$ are the forces from outside.") if robot.questions.loads else "",
        held=say(" $𝐀_cᵀ 𝛌$ are the forces of the constraints.") if robot.questions.constraints else "",
        passive=passive,
    )


def motors_prose(context: Context) -> Prose:
    """Which names stand for what the motors of an arm do, or for what drives a mechanism."""
    robot = context.robot
    forces = [letters.force(q) for k, q in enumerate(robot.coordinates) if k not in robot.actions.passive]
    what = "what the motor|motors does|do" if robot.has_table else "the driving force|forces"
    return say(agreeing(f" {{forces}} is|are {what}.", len(forces)), forces=listed(forces)) if forces else ()


def with_force_letters(robot: Robot) -> Callable[[Node], Node]:
    """The names of generalized forces as the letters that they are printed with elsewhere."""
    forces = dict(zip(robot.inputs, map(letters.force, robot.coordinates), strict=False))
    return lambda part: forces.get(part.name, part) if isinstance(part, Symbol) else part
