"""How g = 0 is solved where a row has two factors: each is 0 in a case of its own, and leaves one angle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator, Pair
from dynsolve.errors import AlgebraError
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.pose import Pose, at, degrees, written
from dynsolve.explain.sanity.sign import sign_of
from dynsolve.explain.step import Line
from dynsolve.notation.tree import ZERO, Function, Node, Row, Symbol, Words, equation
from dynsolve.quantities import letters

_WITH_KNOWN_TANGENT = (30, 45, 60, -30, -45, -60)
"""The angles in degrees, between -90 and 90, that have a tangent without cosines of further angles."""


@dataclass(frozen=True, slots=True)
class Cases:
    """Where g = 0 of two angles: the lines that lead there, and all poses up to full turns."""

    lines: tuple[Line, ...]
    poses: tuple[Pose, ...]


def cases(context: Context, names: Sequence[str]) -> Cases | None:
    """The cases of the first row, from the last on, that has two factors; None where there is none."""
    g = context.values["g"]
    rows = [k for k in reversed(range(context.robot.n)) if not g[k, 0].is_zero]
    found = next(((k, factors) for k in rows if (factors := _factors(context, g[k, 0]))), None)
    if found is None or len(names) != 2 or len(rows) != 2:
        return None
    row, factors = found
    other = next(k for k in rows if k != row)
    by_factor = [_branch(context, factor, other, names) for factor in factors]
    if any(each is None for each in by_factor):
        return None
    either = [equation(_shown(context, factor), ZERO) for factor in factors]
    value = equation(letters.entry("g", row + 1), context.show(g[row, 0]), ZERO)
    lines = [Line((), (Row((value, Words(", so "), either[0], Words(" or "), either[1])),))]
    poses: dict[tuple[int, ...], Pose] = {}
    for zero, branch in zip(either, by_factor, strict=True):
        assert branch is not None
        lines.append(Line(("Where ", zero, ":"), branch.formulas))
        poses |= {tuple(pose[name] for name in names): pose for pose in branch.poses}
    return Cases(tuple(lines), tuple({name: pose[name] for name in names} for pose in poses.values()))


@dataclass(frozen=True, slots=True)
class _Branch:
    formulas: tuple[Node, ...]
    poses: tuple[Pose, ...]


def _factors(context: Context, row: Expr) -> tuple[Generator, Generator] | None:
    """The sines or cosines of two angles whose product, times what surely has a sign, is a row of g."""
    ring, used = row.ring, row.poly.degrees()
    turning = [g for g in ring.generators if g.kind in ("sin", "cos") and used[g.index] > 0]
    if len(turning) != 2 or turning[0].angle == turning[1].angle:
        return None
    first, second = turning
    beside = Expr(ring, row.poly.derivative(first.index).derivative(second.index))
    product = beside * ring.generator(first.index) * ring.generator(second.index)
    is_whole = product == row and sign_of(context, beside) and all(_name(g.angle) for g in turning)
    return (first, second) if is_whole else None


def _branch(context: Context, factor: Generator, row: int, names: Sequence[str]) -> _Branch | None:
    """What a row says of the other angle where a factor is 0; None where it does not say it."""
    name = _name(factor.angle)
    left = next(each for each in names if each != name)
    formulas: list[Node] = []
    poses: list[Pose] = []
    for angle in (0, 180) if factor.kind == "sin" else (90, -90):
        here = {name: angle}
        value = at(context.robot.ring, context.values["g"][row, 0], here)
        found = solved(context, value, left)
        if found is None:
            return None
        said, angles = found
        both = Row((degrees(angles[0]), Words(" or "), degrees(angles[1])))
        zero = equation(letters.entry("g", row + 1), context.show(value), ZERO)
        where = (*written(here), Words(": "), zero, Words(", so "), said, Words(", "))
        formulas.append(Row((*where, equation(Symbol(left), both))))
        poses += [{**here, left: other} for other in angles]
    return _Branch(tuple(formulas), tuple(poses))


def solved(context: Context, value: Expr, name: str) -> tuple[Node, tuple[int, int]] | None:
    """The angle where a s + b c is 0: what follows for s, c or its tangent, and the two angles."""
    ring, q = context.robot.ring, Symbol(name)
    pair = next((pair for pair in ring.pairs if _name(pair.angle) == name), None)
    if pair is None:
        return None
    for index, zeros in ((pair.sine, (0, 180)), (pair.cosine, (90, -90))):
        beside = Expr(ring, value.poly.derivative(index))
        if value == beside * ring.generator(index) and sign_of(context, beside):
            return equation(context.show(ring.generator(index)), ZERO), zeros
    if not (_is_linear(value, pair) and sign_of(context, Expr(ring, value.poly.derivative(pair.sine)))):
        return None
    for angle, tangent in _tangents(context):
        if at(ring, value, {name: angle}).is_zero:
            opposite = angle - 180 if angle > 0 else angle + 180
            return equation(Function("tan", q), tangent), (angle, opposite)
    return None


def _tangents(context: Context) -> Iterator[tuple[int, Node]]:
    """The angles with a known tangent in the ring of a robot, and what it is."""
    ring = context.robot.ring
    for angle in _WITH_KNOWN_TANGENT:
        try:
            s, c = ring.sin(Angle((), Fraction(angle))), ring.cos(Angle((), Fraction(angle)))
        except AlgebraError:
            continue
        yield angle, context.show(s * ring.inverse(c))


def _is_linear(value: Expr, pair: Pair) -> bool:
    """Whether a value is a s + b c with constant a and b."""
    ring = value.ring
    parts = [Expr(ring, value.poly.derivative(index)) for index in (pair.sine, pair.cosine)]
    total = parts[0] * ring.generator(pair.sine) + parts[1] * ring.generator(pair.cosine)
    return value == total and not any(map(ring.depends_on_coordinates, parts))


def _name(angle: Angle) -> str:
    """The coordinate that an angle is; "" where it is a sum, a multiple or a constant more."""
    if angle.degrees or len(angle.terms) != 1:
        return ""
    ((atom, rate),) = angle.terms
    return atom[0][0] if rate == 1 and len(atom) == 1 else ""


def _shown(context: Context, factor: Generator) -> Node:
    return context.show(context.robot.ring.generator(factor.index))
