"""The columns of Jacobians: z × (p - o) in letters, and with the axes and levers of a robot put in."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.expr import Expr
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis, origin
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.working import squares
from dynsolve.explain.working.identities import Identity, said, used_in_product
from dynsolve.explain.writing import block_of, column_of, is_small
from dynsolve.notation.build import total
from dynsolve.notation.tree import (
    Cross,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Row,
    Sum,
    Transpose,
    Words,
    equation,
    number,
)
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Joint, JointType

ZERO = Letter("0", style="bold")
"""The zero vector."""


BESIDE = 2
"""Up to this number of columns J_v and J_ω, and v and ω, stand on one line."""


def frame_parts(context: Context, i: int) -> tuple[Matrix, Matrix]:
    """(z_i, o_i) as trees."""
    H = context.matrix(f"H{i}")
    return block_of(H, 3, 2, 3), block_of(H, 3, 3, 4)


def column_letters(context: Context, joint: Joint, point: Node) -> tuple[Node, Node]:
    """(J_v, J_ω) of one joint in letters: z × (p - o) and z, or z and 0."""
    i = joint_frame(context.robot, joint)
    if joint.type is JointType.REVOLUTE:
        arm = Parenthesized(Sum((point, Negative(letters.o(i)))))
        return Cross(letters.z(i), arm), letters.z(i)
    return letters.z(i), ZERO


def coordinate_column(context: Context, k: int, link: int, point: Node) -> tuple[Node, Node] | None:
    """(J_v, J_ω) of coordinate k (from 0) in letters, None where no joint up to `link` moves with it."""
    terms = [
        (rate, column_letters(context, joint, point))
        for joint in context.robot.path(link)
        for i, rate in joint.rates
        if i == k
    ]
    if not terms:
        return None
    return (
        _total([(rate, linear) for rate, (linear, _) in terms]),
        _total([(rate, angular) for rate, (_, angular) in terms if angular != ZERO]),
    )


def _total(terms: Sequence[tuple[Fraction, Node]]) -> Node:
    """Σ rate·part"""
    if not terms:
        return ZERO
    rated = tuple(_rated(rate, part) for rate, part in terms)
    return rated[0] if len(rated) == 1 else Sum(rated)


def _rated(rate: Fraction, node: Node) -> Node:
    if rate == 1:
        return node
    if rate == -1:
        return Negative(node)
    return Product((number(rate), node))


def crosses(
    context: Context, link: int, name: Node, point: algebra.Matrix, J: Matrix
) -> tuple[tuple[Node, ...], Prose]:
    """The columns z × (p - o) of a point p of a link that are more than a look, and their identities.

    The product is a look where z is an axis of the base and o a fixed point: two coordinates of p - o
    change places.
    """
    if not context.is_short:
        return (), ()
    shown: list[Node] = []
    for k in range(context.robot.n):
        moved = joints_moved(context, k, link)
        turning = [joint for _, joint in moved if joint.type is JointType.REVOLUTE]
        if all(_is_fixed(context, joint) for joint in turning):
            continue
        in_letters = coordinate_column(context, k, link, name)
        assert in_letters is not None
        shown += column_shown(context, moved, point, in_letters[0], column_of(J, k))
    used = _used_in_crosses(context, link, point)
    words = "With " if shown else "The cross products, with "
    return tuple(shown), (words, *said(used), ":") if used else ()


def read_off(context: Context, link: int, point: algebra.Matrix) -> Joint | None:
    """The first joint whose column is a look; None without any."""
    for joint in context.robot.path(link):
        lever = _lever(context, joint, point)
        if joint.type is JointType.REVOLUTE and _is_fixed(context, joint):
            z = axis(context.values[f"H{joint_frame(context.robot, joint)}"])
            if not algebra.cross(z, lever).is_zero:
                return joint
    return None


def how_read_off(context: Context, joint: Joint) -> Prose:
    """z₀ × (u₁, u₂, u₃)ᵀ = (-u₂, u₁, 0)ᵀ, by which a column of this joint is a look."""
    i = joint_frame(context.robot, joint)
    u = [letters.any_vector(context.robot, Number(k)) for k in (1, 2, 3)]
    rows = algebra.skew(axis(context.values[f"H{i}"])).rows
    turned = [
        total(
            [
                e if sign.number > 0 else Negative(e)
                for sign, e in zip(row, u, strict=True)
                if not sign.is_zero
            ]
        )
        for row in rows
    ]
    return (equation(Cross(letters.z(i), _in_a_row(u)), _in_a_row(turned)), " for any vector")


def _in_a_row(entries: Sequence[Node]) -> Node:
    """(a, b, c)ᵀ, a column within a sentence."""
    a, b, c = entries
    comma = Words(",")
    return Transpose(Parenthesized(Row((a, comma, b, comma, c))))


def parallel(context: Context, link: int, name: Node, point: algebra.Matrix) -> Prose:
    """Why a column z × (p - o) that is a look is zero: p is on the axis; nothing of others."""
    for joint in context.robot.path(link):
        lever = _lever(context, joint, point)
        if joint.type is not JointType.REVOLUTE or not _is_fixed(context, joint) or lever.is_zero:
            continue
        i = joint_frame(context.robot, joint)
        if algebra.cross(axis(context.values[f"H{i}"]), lever).is_zero:
            between = Sum((name, Negative(letters.o(i))))
            return (" ", between, " is parallel to ", letters.z(i), ", so their cross product is zero.")
    return ()


def joints_moved(context: Context, k: int, link: int) -> list[tuple[Fraction, Joint]]:
    """The joints up to a link that coordinate k (from 0) moves, each with its rate."""
    return [(rate, joint) for joint in context.robot.path(link) for i, rate in joint.rates if i == k]


def _is_fixed(context: Context, joint: Joint) -> bool:
    """Whether the axis of a joint is one of those of the base, through a point that does not move."""
    H = context.values[f"H{joint_frame(context.robot, joint)}"]
    moves = any(map(context.robot.ring.depends_on_coordinates, origin(H).entries))
    return sum(not entry.is_zero for entry in axis(H).entries) == 1 and not moves


def used_in_cross(context: Context, joint: Joint, point: algebra.Matrix) -> list[Identity]:
    """The identities by which z × (p - o) of a joint becomes what is printed."""
    z, lever = axis(context.values[f"H{joint_frame(context.robot, joint)}"]), _lever(context, joint, point)
    return used_in_product(context, algebra.skew(z), lever, algebra.cross(z, lever))


def _used_in_crosses(context: Context, link: int, point: algebra.Matrix) -> list[Identity]:
    """Those of all columns up to a link, each once."""
    turning = [joint for joint in context.robot.path(link) if joint.type is JointType.REVOLUTE]
    return list(dict.fromkeys(each for joint in turning for each in used_in_cross(context, joint, point)))


def column_shown(
    context: Context,
    moved: Sequence[tuple[Fraction, Joint]],
    point: algebra.Matrix,
    in_letters: Node,
    linear: Matrix,
) -> tuple[Node, ...]:
    """A column of J_v with this robot's axes and levers put in, where there is anything to work out.

    Its value stands at the end, behind the products where terms of them add up; where an identity leads
    to it, the product as it is multiplied out.
    """
    robot = context.robot
    if all(joint.type is JointType.PRISMATIC for _, joint in moved):
        return ()
    if len(moved) == 1 and _lever(context, moved[0][1], point).is_zero:
        between = next(part.argument for part in walk(in_letters) if isinstance(part, Parenthesized))
        return (equation(between, ZERO),)
    parts: list[tuple[Fraction, Node]] = []
    small: list[Node] = []
    for rate, joint in moved:
        z = frame_parts(context, joint_frame(robot, joint))[0]
        if joint.type is JointType.REVOLUTE:
            lever = context.show(_lever(context, joint, point))
            small += [z, lever]
            parts.append((rate, Cross(z, lever)))
        else:
            small.append(z)
            parts.append((rate, z))
    values: list[Node] = [linear]
    if any(used_in_cross(context, joint, point) for _, joint in moved if joint.type is JointType.REVOLUTE):
        values = [_multiplied_out(context, moved[0][1], point)] if len(moved) == 1 else []
    elif len(moved) == 1 and any(map(_adds_up, _products(context, moved[0][1], point))):
        values.insert(0, _multiplied_out(context, moved[0][1], point))
    if not is_small(*small):
        return ()
    difference = _difference(context, moved[0][1], point, in_letters) if len(moved) == 1 else ()
    return (*difference, equation(in_letters, _total(parts), *values))


def _difference(context: Context, joint: Joint, point: algebra.Matrix, in_letters: Node) -> tuple[Node, ...]:
    """p - o with both put in, where it is more than leaving out the terms of o."""
    start = frame_parts(context, joint_frame(context.robot, joint))[1]
    end, lever = context.show(point), context.show(_lever(context, joint, point))
    assert isinstance(end, Matrix) and isinstance(lever, Matrix)
    rows = zip(end.rows, start.rows, lever.rows, strict=True)
    if all(set(_terms(p)) == {*_terms(o), *_terms(rest)} for (p,), (o,), (rest,) in rows):
        return ()
    between = next(part.argument for part in walk(in_letters) if isinstance(part, Parenthesized))
    assert isinstance(between, Sum)
    if (before := _same_origin(context, joint)) is not None:
        return (equation(between, Sum((between.terms[0], Negative(letters.o(before))))),)
    both = (Sum((end, Negative(start))),) if is_small(end, start) else ()
    return (equation(between, *both, lever),)


def _same_origin(context: Context, joint: Joint) -> int | None:
    """The frame of an earlier joint whose axis meets this one's in one origin, and whose p - o is shown."""
    own = origin(context.values[f"H{joint_frame(context.robot, joint)}"])
    for before in context.robot.path(joint.index - 1):
        i = joint_frame(context.robot, before)
        turns = before.type is JointType.REVOLUTE and not _is_fixed(context, before)
        if turns and origin(context.values[f"H{i}"]) == own:
            return i
    return None


def _terms(node: Node) -> tuple[Node, ...]:
    """The terms of a sum; of 0 none."""
    if node == number(0):
        return ()
    return node.terms if isinstance(node, Sum) else (node,)


_Factors = list[tuple[Expr, Expr]]
"""What an entry of a cross product is the sum of: products of an entry of z and one of the lever, none 0."""


def _products(context: Context, joint: Joint, point: algebra.Matrix) -> list[_Factors]:
    """Of each entry of z × (p - o) the products that it is the sum of."""
    z, lever = axis(context.values[f"H{joint_frame(context.robot, joint)}"]), _lever(context, joint, point)
    rows = algebra.skew(z).rows
    pairs = [list(zip(row, lever.entries, strict=True)) for row in rows]
    return [[(a, b) for a, b in row if not (a.is_zero or b.is_zero)] for row in pairs]


def _adds_up(factors: _Factors) -> bool:
    """Whether terms of several products are alike, so that their numbers are added: ¼ and ¾."""
    products = [a * b for a, b in factors]
    return bool(products) and sum(map(len, products)) > len(sum(products[1:], start=products[0]))


def _multiplied_out(context: Context, joint: Joint, point: algebra.Matrix) -> Matrix:
    """z × (p - o) of a joint before s² + c² = 1 is used, and before the numbers of like terms are added."""
    ring = context.robot.ring
    entries: list[tuple[Node]] = []
    for factors in _products(context, joint, point):
        poly = ring.reduce_roots(sum((a.poly * b.poly for a, b in factors), start=ring.zero.poly))
        value = Expr(ring, ring.reduce(poly))
        if value.poly != poly:
            entries.append((squares.factored(context.forms, poly),))
        elif _adds_up(factors):
            entries.append((_in_factors(context, factors),))
        else:
            entries.append((context.show(value),))
    return Matrix(tuple(entries))


def _in_factors(context: Context, factors: _Factors) -> Node:
    """The sum of products, each as it stands."""
    collector = context.forms.compactor.collector
    products = (Product((context.show(a), context.show(b))) for a, b in factors)
    return total([collector.product(*collector.decompose(each), ()) for each in products])


def _lever(context: Context, joint: Joint, point: algebra.Matrix) -> algebra.Matrix:
    """p - o, from the joint's axis to a point."""
    return point - origin(context.values[f"H{joint_frame(context.robot, joint)}"])


def end_of(context: Context) -> algebra.Matrix:
    """o_n, the end of the arm."""
    return origin(context.values[f"H{len(context.robot.joints)}"])
