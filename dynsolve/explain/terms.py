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

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum

from dynsolve.algebra.expr import Expr
from dynsolve.document import Inline, Prose, Reference, Table
from dynsolve.explain.christoffel import equal_symbols
from dynsolve.explain.context import Context
from dynsolve.explain.forms import ChristoffelSymbols, collected_coriolis_force, pairs
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import listed, spong, sum_of
from dynsolve.notation.build import cost, times, total
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Letter,
    Negative,
    Node,
    Number,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
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
}


@dataclass(frozen=True, slots=True)
class Term:
    """A term of force k: factor · rates, in letters and in value; `rates` are (place, dots)."""

    kind: Kind
    count: int
    letter: Node
    factor: Expr
    rates: tuple[tuple[int, int], ...] = ()


def terms_of(context: Context, k: int) -> Iterator[Term]:
    """The terms of force k, from 0, that are not zero."""
    n, values = context.robot.n, context.values
    for j in range(n):
        kind = Kind.INERTIAL if j == k else Kind.COUPLING
        letter = letters.entry("d", k + 1, j + 1)
        yield from _unless_zero(Term(kind, 1, letter, values["D"][k, j], ((j, 2),)))
    for i, j in pairs(n):
        kind = Kind.CENTRIFUGAL if i == j else Kind.CORIOLIS
        letter = letters.entry("c", i + 1, j + 1, k + 1)
        symbol = values["christoffel"][i, j, k]
        yield from _unless_zero(Term(kind, 1 if i == j else 2, letter, symbol, ((i, 1), (j, 1))))
    if "friction" in values.rules:
        friction = values["friction"][k, 0]
        yield from _unless_zero(Term(Kind.FRICTION, 1, letters.friction(k + 1), friction))
    held = Term(_held_by(context, k), 1, letters.entry("g", k + 1), values["g"][k, 0])
    yield from _unless_zero(held)


def _held_by(context: Context, k: int) -> Kind:
    """What a term without rates holds: gravity, a spring, or both."""
    if not context.robot.actions.springs:
        return Kind.GRAVITY
    spring = context.robot.ring.diff(context.values["Ps"], k)
    if spring.is_zero:
        return Kind.GRAVITY
    return Kind.SPRING if context.values["g"][k, 0] == spring else Kind.HELD


def _unless_zero(term: Term) -> Iterator[Term]:
    if not term.factor.is_zero:
        yield term


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
    kinds = dict.fromkeys(term.kind for _, terms in found for term in terms)
    whole = _written_whole(context, [term for _, terms in found for term in terms])
    holds = "the joint" if context.robot.has_table else "the force of the coordinate"
    forces = Reference(tuple(f"tau{q.index}" for q in robot.coordinates), " of ")
    why = [_MEANINGS[kind].format(holds=holds) for kind in Kind if kind in _told(kinds)]
    checked = _said_of_units(robot.coordinates) if _units_fit(context, found) else ()
    header = (_named(robot), "term", "what it is")
    rows = [row for q, terms in found for row in _rows(context, q, terms, whole)]
    yield Step(
        id="terms",
        stage=Stage.VECTORIZED,
        title="What the terms of the forces are",
        why=("A term", forces, " ".join(why), *(_twice(context) if Kind.CORIOLIS in kinds else ()), *checked),
        source=spong("7.3"),
        table=Table(header, tuple(rows)),
        detail=Detail.FULL,
        is_task=False,
    )


def _named(robot: Robot) -> str:
    """What the forces are called together."""
    kinds = {q.type for q in robot.coordinates}
    if len(kinds) > 1:
        return "torque or force"
    return "torque" if JointType.REVOLUTE in kinds else "force"


def _told(kinds: Iterable[Kind]) -> frozenset[Kind]:
    """The kinds whose meaning is told: of gravity and springs, where there are both, once."""
    held = frozenset({Kind.GRAVITY, Kind.SPRING, Kind.HELD})
    several = len(held.intersection(kinds)) > 1
    return frozenset(kinds) - held | {Kind.HELD} if several else frozenset(kinds)


def _twice(context: Context) -> Prose:
    """Where the 2 of a Coriolis term comes from."""
    i, j, k = map(Symbol, "ijk")
    one, other = (Letter("c", Row(indices)) for indices in ((i, j, k), (j, i, k)))
    both = equation(Sum((one, other)), Product((Number(2), one)))
    return (" The 2 of a Coriolis term comes from two equal symbols", equal_symbols(context), ": ", both, ".")


def _rows(
    context: Context, q: Coordinate, terms: list[Term], whole: frozenset[int]
) -> Iterator[tuple[Inline, ...]]:
    for place, term in enumerate(terms):
        name = name_of_term(context, term)
        form = equation(name, context.show(value_of_term(context, term))) if _order(term) in whole else name
        yield (letters.force(q) if place == 0 else "", form, str(term.kind))


def rates_of(context: Context, term: Term) -> list[tuple[Node, int]]:
    """The rates of a term, each with its exponent."""
    names = context.robot.ring.names
    rates: list[tuple[Node, int]] = [(Symbol(names[place], dots), 1) for place, dots in term.rates]
    return [(rates[0][0], 2)] if term.kind is Kind.CENTRIFUGAL else rates


def name_of_term(context: Context, term: Term) -> Node:
    """The term by its letter and its rates: 2 c_121 q̇_1 q̇_2."""
    return times(term.count, [(term.letter, 1), *rates_of(context, term)])


def _written_whole(context: Context, terms: Iterable[Term]) -> frozenset[int]:
    """Terms of which order in the rates have their values beside their names: of an order all, or none."""
    orders, long = set[int](), set[int]()
    for term in terms:
        orders.add(_order(term))
        if cost(context.show(value_of_term(context, term))) > LONGEST:
            long.add(_order(term))
    return frozenset(orders - long)


def _order(term: Term) -> int:
    """1 of a term with an acceleration, 2 of one with two rates, 0 without."""
    return len(term.rates)


# -- units -----------------------------------------------------------------------------------------


def _units_fit(context: Context, found: list[tuple[Coordinate, list[Term]]]) -> bool:
    """Whether every term is known to have the unit of its force."""
    known = Dimensions(context.robot.ring, context.robot)
    for q, terms in found:
        wanted = units.ENERGY if q.type is JointType.REVOLUTE else units.FORCE
        if any(known.of(value_of_term(context, term)) != wanted for term in terms):
            return False
    return True


def _said_of_units(coordinates: tuple[Coordinate, ...]) -> Prose:
    kinds = {q.type for q in coordinates}
    said: list[Prose] = []
    if JointType.REVOLUTE in kinds:
        said.append((units.node("kg m^2/s^2 = N m"), " in a torque (an angle is a number)"))
    if JointType.PRISMATIC in kinds:
        said.append((units.node("kg m/s^2 = N"), " in a force"))
    return (" Each term has the unit of its force: ", *listed(said), ".")


# -- the step that closes a derivation: D q̈ + C q̇ + g = τ, with this robot's matrices where they fit
# Friction stands beside g, forces from outside and of constraint beside τ, where there are any.

ID = "model"
"""The closing step; reports show it in their last section, with what it is made of."""


WIDEST = 84
"""The characters up to which matrices are written out in the equation; wider ones stand by themselves."""


def closing_step(context: Context) -> Step:
    """D q̈ + C q̇ + g = τ, with friction on the left, Q and A_cᵀ λ on the right where there are any."""
    robot, rubs = context.robot, has_friction(context)
    parts = [context.matrix(name) for name in ("D", "C", *(("friction",) if rubs else ()), "g")]
    qd = column(*(Symbol(q.name, 1) for q in robot.coordinates))
    qdd = column(*(Symbol(q.name, 2) for q in robot.coordinates))
    passive = robot.actions.passive
    forces = column(*(ZERO if k in passive else letters.force(q) for k, q in enumerate(robot.coordinates)))
    result: tuple[Node, ...] = ()
    if context.is_short and all(matrix_width(context, part) <= WIDEST for part in parts):
        left = Sum((Product((parts[0], qdd)), Product((parts[1], qd)), *parts[2:]))
        result = (equation(left, sum_of([forces, *_beside_motors(context)])),)
    return Step(
        id=ID,
        stage=Stage.VECTORIZED,
        title="The dynamical model",
        why=_meanings(context),
        formula=equations_of_motion(context),
        source=spong("7.3"),
        result=result,
        detail=Detail.BRIEF,
    )


def rows_in_names(context: Context, symbol: ChristoffelSymbols) -> Line:
    """Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + g_k = τ_k with this robot's D and g, its symbols in names."""
    robot, (D, g) = context.robot, (context.matrix(name) for name in ("D", "g"))
    names = robot.ring.names
    friction = context.matrix("friction") if has_friction(context) else None

    def row(k: int) -> Node:
        entries = zip(D.rows[k], names, strict=True)
        inertial = [times(1, [(d, 1), (Symbol(name, 2), 1)]) for d, name in entries if d != ZERO]
        rubbing = () if friction is None else (friction.rows[k][0],)
        heights = [part for part in (g.rows[k][0],) if part != ZERO]
        return total([*inertial, collected_coriolis_force(names, symbol, k), *rubbing, *heights])

    rows = (equation(driving_row(context, q), row(k)) for k, q in enumerate(robot.coordinates))
    forces = Reference(tuple(f"tau{q.index}" for q in robot.coordinates), ", ")
    return Line(("Row by row", forces, ":"), tuple(rows))


def has_friction(context: Context) -> bool:
    """Whether friction is a term of its own."""
    return "friction" in context.values.rules


def _beside_motors(context: Context) -> list[Node]:
    """Q and A_cᵀ λ, as far as there are forces from outside and constraints."""
    asked = context.robot.questions
    outside: list[Node] = [letters.Q_FORCES] if asked.loads else []
    held: list[Node] = [Product((Transpose(letters.A_C), letters.LAMBDA))] if asked.constraints else []
    return [*outside, *held]


def driving_side(context: Context, constrained: bool = True) -> Node:
    """τ + Q + A_cᵀ λ, or without the last where that is put elsewhere."""
    beside = _beside_motors(context)
    if not constrained and context.robot.questions.constraints:
        beside.pop()
    return sum_of([letters.TAU, *beside])


def driving_row(context: Context, q: Coordinate) -> Node:
    """τ_k + Q_k + (A_cᵀ λ)_k: what a row of the left side comes to, with everything that acts."""
    k, asked = Number(q.index), context.robot.questions
    outside: list[Node] = [letters.entry("Q", q.index)] if asked.loads else []
    held: list[Node] = []
    if asked.constraints:
        held = [Entry(Product((Transpose(letters.A_C), letters.LAMBDA)), k)]
    return sum_of([letters.force(q), *outside, *held])


def moving_side(context: Context) -> Sum:
    """D q̈ + C q̇ + g, and friction."""
    rubs = (letters.FRICTION,) if has_friction(context) else ()
    inertial, coriolis = Product((letters.D, letters.QDD)), Product((letters.C, letters.QD))
    return Sum((inertial, coriolis, *rubs, letters.G))


def acting_side(context: Context) -> Node:
    """τ + Q - C q̇ - friction - g: everything that acts but constraints, beside D q̈."""
    _, *rest = moving_side(context).terms
    driving = driving_side(context, constrained=False)
    return sum_of([*(driving.terms if isinstance(driving, Sum) else (driving,)), *map(Negative, rest)])


def equations_of_motion(context: Context) -> Relation:
    """D q̈ + C q̇ + g = τ in letters, with everything that acts."""
    return equation(moving_side(context), driving_side(context))


def _meanings(context: Context) -> Prose:
    """What the terms of the equation are."""
    asked = context.robot.questions
    why: Prose = (Product((letters.D, letters.QDD)), " are the inertial terms, ")
    why += (Product((letters.C, letters.QD)), " the Coriolis and centrifugal ones, ")
    why += (letters.FRICTION, " those of friction, ") if has_friction(context) else ()
    why += (letters.G, " those of gravity", " and springs." if context.robot.actions.springs else ".")
    why += (" ", letters.Q_FORCES, " are the forces from outside.") if asked.loads else ()
    if asked.constraints:
        why += (" ", Product((Transpose(letters.A_C), letters.LAMBDA)), " are the forces of the constraints.")
    if context.robot.actions.passive:
        from dynsolve.explain.actions import passive_prose

        why += passive_prose(context)
    return why


def motors_prose(context: Context) -> Prose:
    """Which names stand for what the motors do."""
    robot = context.robot
    forces = [letters.force(q) for k, q in enumerate(robot.coordinates) if k not in robot.actions.passive]
    if not forces:
        return ()
    return (
        " ",
        *listed(forces),
        " is what the motor does." if len(forces) == 1 else " are what the motors do.",
    )


def with_force_letters(robot: Robot) -> Callable[[Node], Node]:
    """The names of generalized forces as the letters that they are printed with elsewhere."""
    forces = {q.force: letters.force(q) for q in robot.coordinates if q.force in robot.inputs}
    return lambda part: forces.get(part.name, part) if isinstance(part, Symbol) else part
