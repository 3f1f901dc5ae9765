"""Where gravity is balanced if a joint slides up and down: nowhere, or at one length of two poses.

A joint along the vertical has to carry what it moves in every pose.  Where a joint turns the axis
along which another slides, gravity has no part along that axis if it is level; the moments about
the joint that turns it are then balanced at one length d, and that is a saddle point of P: with
g_d = ∂P/∂d free of d, the determinant of the second derivatives is -(∂g_d/∂θ)² < 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm

from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.at_rest import assumed, at_rest, free, in_no_others, told
from dynsolve.explain.sanity.cases import solved
from dynsolve.explain.sanity.curvature import slope
from dynsolve.explain.sanity.pose import Pose, at, degrees, turning_in, written
from dynsolve.explain.sanity.sign import is_positive, sign_of, with_lengths
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.kinetic import without_signs
from dynsolve.explain.writing import sum_of
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import (
    ZERO,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Quotient,
    Relation,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import JointType


def nowhere(context: Context) -> Step | None:
    """An entry of g that is 0 in no pose; None where there is none."""
    g = context.values["g"]
    k, sign = next(((k, sign) for k in range(context.robot.n) if (sign := sign_of(context, g[k, 0]))), (0, 0))
    if not sign:
        return None
    value = Relation(
        (letters.entry("g", k + 1), context.show(g[k, 0]), ZERO), ("=", ">" if sign > 0 else "<")
    )
    why: Prose = (*at_rest(context), *assumed(context), "But ", value, Reference(("g",), " in "))
    outcome = ("Gravity is balanced in no pose: ", value, " in each.")
    return told((*why, " in every pose, so gravity is balanced in none."), outcome=outcome)


def at_one_length(context: Context) -> Step | None:
    """The two poses in which the axis of sliding is level, each with the length that balances the moments."""
    robot, g = context.robot, context.values["g"]
    loaded = [k for k in range(robot.n) if not g[k, 0].is_zero]
    slides = [k for k in loaded if robot.coordinates[k].type is JointType.PRISMATIC]
    angles = turning_in(robot, *g.entries)
    if len(loaded) != 2 or len(slides) != 1 or angles is None or len(angles) != 1:
        return None
    (turned,) = (k for k in loaded if k not in slides)
    (slid,), (angle,) = slides, angles
    level = solved(context, g[slid, 0], angle)
    if level is None or robot.ring.depends_on_coordinates(robot.ring.diff(g[slid, 0], slid)):
        return None
    said, values = level
    poses = [_moment(context, turned, slid, {angle: value}) for value in values]
    lengths = {pose.length for pose in poses if pose is not None}
    if None in poses or len(lengths) != 1:
        return None
    either = equation(Symbol(angle), Row((degrees(values[0]), Words(" or "), degrees(values[1]))))
    zero = equation(letters.entry("g", slid + 1), context.show(g[slid, 0]), ZERO)
    rows = (Row((zero, Words(", so "), said, Words(", "), either)), *(pose.zero for pose in poses if pose))
    name = robot.coordinates[slid].name
    why = (*at_rest(context), *assumed(context), "The rows of ", letters.G, Reference(("g",), " in "))
    why += ("; what ", equation(letters.entry("g", slid + 1), ZERO), " says is put into the other:")
    balanced = equation(Symbol(name), *lengths)
    only = in_no_others("this pose" if len(values) == 1 else "these poses")
    concluding: Prose = ("So ", balanced, " in both. ", only)
    concluding += (*free(context, (angle, name)), ". ", *_saddles(context, slid, turned))
    concluding += _not_extended(context, name, *lengths)
    outcome = (
        "Gravity is balanced in two poses, with ",
        balanced,
        ": saddle points of the potential energy.",
    )
    return told(why, (Line((), rows),), concluding, outcome=outcome)


@dataclass(frozen=True, slots=True)
class _Moment:
    """The moment of gravity in a pose, as an equation that it is 0, and the length at which it is."""

    zero: Node
    length: Node


def _moment(context: Context, row: int, slid: int, pose: Pose) -> _Moment | None:
    """θ = 180°: g_2 = -g (m_2 l_c2 + m_3 d_3) = 0, and -m_2 l_c2/m_3"""
    ring, d = context.robot.ring, Symbol(context.robot.coordinates[slid].name)
    value = at(ring, context.values["g"][row, 0], pose)
    by_d = ring.diff(value, slid)
    rest = value - by_d * ring.symbol(d.name)
    if not sign_of(context, by_d) or ring.depends_on_coordinates(rest):
        return None
    common, factor, constant = _parts(context, by_d, rest)
    linear = total([times(1, [(context.show(factor), 1), (d, 1)]), context.show(constant)])
    shown, collected = context.show(value), times(1, [(context.show(common), 1), (linear, 1)])
    members = (shown,) if are_alike(shown, collected) else (shown, collected)
    zero = Row((*written(pose), Words(": "), equation(letters.entry("g", row + 1), *members, ZERO)))
    return _Moment(zero, _length(context, factor, constant))


def _parts(context: Context, by_d: Expr, rest: Expr) -> tuple[Expr, Expr, Expr]:
    """p, a, b of by_d = p a and rest = p b; a is positive, a and b have no fraction and no common factor."""
    ring, sign = rest.ring, sign_of(context, by_d)
    common = rest.poly.gcd(by_d.poly)
    a, b = (Expr(ring, each.poly / common) * sign for each in (by_d, rest))
    whole = lcm(*(int(each.poly.factor()[0].q) for each in (a, b) if not each.is_zero))
    return Expr(ring, common) * sign / whole, a * whole, b * whole


def _length(context: Context, a: Expr, b: Expr) -> Node:
    """Where a d + b = 0: d = -b/a"""
    if a.is_number or b.is_zero:
        return context.show(-b / a.number) if a.is_number else ZERO
    if sign_of(context, b) > 0:
        return Negative(Quotient(context.show(b), context.show(a)))
    return Quotient(context.show(-b), context.show(a))


def _saddles(context: Context, slid: int, turned: int) -> Prose:
    """Why P has a saddle point there: g_d does not depend on d, but on the angle it does."""
    names = [context.robot.coordinates[k].name for k in (slid, turned)]
    by_d, by_angle = (slope(context, names[0], name) for name in names)
    ring, place = context.robot.ring, context.robot.ring.names.index(names[1])
    rate = context.show(ring.diff(context.values["g"][slid, 0], place))
    det, value = (Negative(Power(x, Number(2))) for x in (Parenthesized(by_angle), without_signs(rate)))
    why: Prose = ("In both ", letters.P, " has a saddle point: as ", equation(by_d, ZERO))
    why += (", the determinant of the symmetric matrix of its second derivatives with respect to ",)
    why += (
        Symbol(names[1]),
        " and ",
        Symbol(names[0]),
        " is ",
        equation(det, value),
        ", which is negative there. So they are unstable.",
    )
    return why


def _not_extended(context: Context, name: str, length: Node) -> Prose:
    """That the length is on the other side of 0, where it is seen to be."""
    positive, constant = with_lengths(context.robot), frozenset(context.robot.ring.parameters)
    if isinstance(length, Quotient) and isinstance(length.numerator, Sum):
        return _where_extended(name, length.numerator.terms)
    if not isinstance(length, Negative) or not is_positive(length.argument, positive, constant):
        return ()
    return (" With ", Relation((Symbol(name), ZERO), (">",)), " no pose is balanced.")


def _where_extended(name: str, terms: Sequence[Node]) -> Prose:
    """Where the length is on the side of 0 that it should be: its positive terms are the larger ones."""
    positive = [term for term in terms if not isinstance(term, Negative)]
    negative = [term.argument for term in terms if isinstance(term, Negative)]
    if not (positive and negative):
        return ()
    where = Relation((sum_of(negative), sum_of(positive)), ("<",))
    return (" Here ", Relation((Symbol(name), ZERO), (">",)), " only if ", where, ".")
