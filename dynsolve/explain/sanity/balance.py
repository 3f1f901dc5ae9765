"""How g = 0 is solved: a row that one sine or cosine makes 0 says where, and is put into the others."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.ring import Ring
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis
from dynsolve.document import Prose, Table
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.definite import determinant
from dynsolve.explain.sanity.determinant import sign_of
from dynsolve.explain.sanity.poses import Pose, at
from dynsolve.explain.step import Line, Step
from dynsolve.explain.terms import driving_side
from dynsolve.explain.working.squares import without_signs
from dynsolve.explain.writing import listed, spong, turns
from dynsolve.notation.build import times
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
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
from dynsolve.robot.model import Coordinate


@dataclass(frozen=True, slots=True)
class Zero:
    """Row `row` of g, from 0, is `value` once the zeros before it are put in: 0 where a sine or cosine is."""

    row: int
    value: Expr
    factor: Generator


def zeros(context: Context) -> tuple[Zero, ...] | None:
    """The rows of g one after the other, from the last on; None where one does not say where it is 0."""
    left = [k for k in reversed(range(context.robot.n)) if not context.values["g"][k, 0].is_zero]
    found: list[Zero] = []
    while left:
        told = next((zero for k in left if (zero := _zero(context, k, found)) is not None), None)
        if told is None:
            return None
        found.append(told)
        left.remove(told.row)
    return tuple(found)


def _zero(context: Context, k: int, known: Sequence[Zero]) -> Zero | None:
    """Row k, where a sine or cosine times what surely has a sign is left of it."""
    value = at_zeros(context.values["g"][k, 0], known)
    ring = value.ring
    degrees = value.poly.degrees()
    turning = [g for g in ring.generators if g.kind in ("sin", "cos") and degrees[g.index] > 0]
    if len(turning) != 1:
        return None
    (factor,) = turning
    beside = _put(value, {factor.index: 1})
    if value != beside * ring.generator(factor.index) or not sign_of(context, beside):
        return None
    return Zero(k, value, factor)


def at_zeros(value: Expr, known: Sequence[Zero]) -> Expr:
    """A value where the rows of g are 0."""
    return _put(value, {zero.factor.index: 0 for zero in known})


def _put(value: Expr, images: Mapping[int, int]) -> Expr:
    """A value with numbers for some generators."""
    ring = value.ring
    point = [
        (ring.constant(images[g.index]) if g.index in images else ring.generator(g.index)).poly
        for g in ring.generators
    ]
    return Expr(ring, ring.reduce(value.poly.compose(*point, ctx=ring.ctx)))


def written_zero(context: Context, zero: Zero) -> Node:
    """g_3 = m_3 g l_c3 c_23 = 0, so c_23 = 0, θ_2 + θ_3 = ±90°"""
    ring = context.robot.ring
    row = equation(letters.entry("g", zero.row + 1), context.show(zero.value), ZERO)
    factor = equation(context.show(ring.generator(zero.factor.index)), ZERO)
    return Row((row, Words(", so "), factor, Words(", "), _angle(ring, zero.factor)))


def _angle(ring: Ring, factor: Generator) -> Node:
    """Where a sine or a cosine is 0."""
    is_sine = factor.kind == "sin"
    one, other = (ZERO, Degrees(180)) if is_sine else (Degrees(90), Negative(Degrees(90)))
    return Row((equation(angle_node(factor.angle, ring.names), one), Words(" or "), other))


# -- what is said of every equilibrium: the step itself, what is assumed, which coordinates are free


def told(
    why: Prose,
    lines: Sequence[Line] = (),
    concluding: Prose = (),
    table: Table | None = None,
    outcome: Prose = (),
) -> Step:
    """The step, by what is said before its lines and after them; its `outcome` may be what it says itself."""
    return Step(
        id="equilibrium",
        stage=Stage.VECTORIZED,
        title="Check: where gravity is balanced",
        why=why,
        source=spong("7.2.3"),
        lines=tuple(lines),
        concluding=concluding,
        table=table,
        table_last=bool(lines),
        outcome=outcome or concluding or why,
        is_task=False,
    )


def at_rest(context: Context) -> Prose:
    """What an equilibrium is."""
    without_force = equation(driving_side(context), letters.bold("0"))
    zero = equation(letters.G, letters.bold("0"))
    return (
        f"In an equilibrium the {context.machine} stays at rest with ",
        without_force,
        ", so ",
        zero,
        ". ",
    )


def assumed(context: Context) -> Prose:
    """That lengths and masses are positive, where there are any in letters."""
    return ("Let all parameters be positive. ",) if context.robot.parameters else ()


def in_no_others(poses: str) -> str:
    """That there are no other poses than those: `this pose`, `the poses of the table`."""
    return f"Gravity is balanced in {poses} alone (up to full turns)"


def free(context: Context, names: Collection[str]) -> Prose:
    """The coordinates but those that are named, which may have any value."""
    others = [Symbol(q.name) for q in context.robot.coordinates if q.name not in names]
    return (", whatever ", *listed(others), " is" if len(others) == 1 else " are") if others else ()


# -- what P has where g = 0, by the signs of the minors of its second derivatives, ∂²P/∂q_i∂q_j = ∂g_i/∂q_j
# The minors are those of the last coordinate, the last two, ... (Sylvester's criterion): all of them
# are positive at a minimum; those of odd size alone are negative at a maximum; where the determinant
# is not 0, and it is neither, P rises in one direction and falls in another.

DET = Words("det")
"""The determinant of the second derivatives."""

MOST_SHOWN = 2
"""Of up to so many angles the minors are shown with the derivatives that they are made of."""


class Kind(StrEnum):
    """What P has where its first derivatives are 0."""

    MINIMUM = "minimum"
    MAXIMUM = "maximum"
    SADDLE = "saddle point"


def leading_minors(context: Context, names: Sequence[str], known: Sequence[Zero] = ()) -> list[Expr]:
    """The minors of ∂g/∂q of the last angle, the last two, ..., where rows of g are 0."""
    second = _second(context, names, known)
    sizes = range(1, len(names) + 1)
    return [determinant([row[-size:] for row in second[-size:]]) for size in sizes]


def _second(context: Context, names: Sequence[str], known: Sequence[Zero]) -> list[list[Expr]]:
    ring, g = context.robot.ring, context.values["g"]
    places = [ring.names.index(name) for name in names]
    return [[at_zeros(ring.diff(g[i, 0], j), known) for j in places] for i in places]


def signs_of(context: Context, found: Sequence[Expr], pose: Pose) -> list[int]:
    """The sign of each minor in a pose: 1, -1, or 0 where it is not seen."""
    return [sign_of(context, at(context.robot.ring, minor, pose)) for minor in found]


def kind_of(signs: Sequence[int]) -> Kind | None:
    """What P has by the signs of the minors; None where they do not tell.

    >>> [kind_of(signs) for signs in ([1, 1], [-1, 1], [1, -1], [0, -1], [1, 0])]
    [<Kind.MINIMUM: 'minimum'>, <Kind.MAXIMUM: 'maximum'>, <Kind.SADDLE: 'saddle point'>, \
<Kind.SADDLE: 'saddle point'>, None]
    """
    at_maximum = [(-1) ** size for size in range(1, len(signs) + 1)]
    if all(sign == 1 for sign in signs):
        return Kind.MINIMUM
    if list(signs) == at_maximum:
        return Kind.MAXIMUM
    rules_out_both = -1 in signs and any(a == -b for a, b in zip(signs, at_maximum, strict=True) if a)
    return Kind.SADDLE if rules_out_both and signs[-1] else None


def shown(context: Context, names: Sequence[str], known: Sequence[Zero] | None) -> Iterator[Node]:
    """The second derivatives and the determinant of two, with its value where rows of g are 0."""
    second = _second(context, names, known or ())
    for value, slopes in _by_value(context, names, second):
        yield equation(*slopes, context.show(value))
    if len(names) == 1:
        return
    letters_of = [[slope(context, i, j) for j in names] for i in names]
    values = [] if known is None else [_put_in(context, second), context.show(determinant(second))]
    yield equation(DET, _determinant(letters_of), *dict.fromkeys(values))


def how_multiplied(context: Context, names: Sequence[str], known: Sequence[Zero] | None) -> Prose:
    """That the determinant of two is multiplied out, and whether the square in it cancels."""
    if len(names) != 2 or known is None:
        return ()
    second = _second(context, names, known)
    form = _put_in(context, second)
    if not isinstance(form, Sum) or form == context.show(determinant(second)):
        return ()
    square = (second[0][1] * second[0][1]).poly.to_dict()
    left = determinant(second).poly.to_dict()
    return (", multiplied out (the square cancels)",) if not square.keys() & left else (", multiplied out",)


def _put_in(context: Context, second: Sequence[Sequence[Expr]]) -> Node:
    """a c - b² with the entries of the matrix."""
    (a, b), (_, c) = ([context.show(entry) for entry in row] for row in second)
    product = times(1, [(a, 1), (c, 1)])
    return product if b == ZERO else Sum((product, Negative(Power(without_signs(b), Number(2)))))


def _by_value(
    context: Context, names: Sequence[str], second: Sequence[Sequence[Expr]]
) -> Iterator[tuple[Expr, list[Node]]]:
    """The values of the second derivatives, each with all derivatives that have it."""
    found: list[tuple[Expr, list[Node]]] = []
    for name, row in zip(names, second, strict=True):
        for by, value in zip(names, row, strict=True):
            slopes = next((slopes for known, slopes in found if known == value), None)
            if slopes is None:
                slopes = []
                found.append((value, slopes))
            slopes.append(slope(context, name, by))
    yield from found


def slope_of_last(context: Context, names: Sequence[str]) -> Node:
    """∂g_n/∂q_n"""
    return slope(context, names[-1], names[-1])


def slope(context: Context, row: str, by: str) -> Node:
    """∂g_i/∂q_j, by the names of the coordinates."""
    place = context.robot.ring.names.index(row) + 1
    return letters.partial_derivative(letters.entry("g", place), Symbol(by))


def _determinant(rows: Sequence[Sequence[Node]]) -> Node:
    """a c - b² of a symmetric matrix"""
    (a, b), (_, c) = rows
    return Sum((Product((a, c)), Negative(Power(b, Number(2)))))


# -- joints that gravity does not load: their axes are vertical, or they slide level ---------------


def unloaded_step(context: Context) -> Step | None:
    """The entries of g that must be zero, by the axes of the joints alone."""
    robot = context.robot
    if not robot.has_table or robot.gravity.is_zero or robot.actions.springs or robot.given is not None:
        return None
    free = [q for q in robot.coordinates if _is_level(context, q)]
    turning, sliding = [q for q in free if turns(q)], [q for q in free if not turns(q)]
    if not free or any(not context.values["g"][q.index - 1, 0].is_zero for q in free):
        return None
    why: Prose = ()
    for group, reason in (
        (turning, "turning about a vertical axis changes no height. "),
        (sliding, "sliding along a level axis changes no height. "),
    ):
        if group:
            why += (*listed([_vanishing(q) for q in group]), f": {reason}")
    return Step(
        id="unloaded",
        stage=Stage.VECTORIZED,
        title=f"Check: {'a joint' if len(free) == 1 else 'joints'} that gravity does not load",
        why=why,
        source=spong("7.2.3"),
        outcome=why,
        is_task=False,
    )


def _vanishing(q: Coordinate) -> Node:
    """g_k = 0"""
    return equation(letters.entry("g", q.index), Number(0))


def _is_level(context: Context, q: Coordinate) -> bool:
    """Whether a coordinate moves joints that turn about vertical axes, or slide along level ones, alone."""
    down = context.robot.gravity
    axes = [
        axis(context.values[f"H{joint_frame(context.robot, joint)}"])
        for joint, _ in context.robot.joints_of(q)
    ]
    if turns(q):
        return bool(axes) and all(algebra.cross(z, down).is_zero for z in axes)
    return bool(axes) and all((z.T @ down).is_zero for z in axes)
