"""The last frame of a long chain, by the products of two halves; where its origin is at zero angles."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_value
from dynsolve.derivation.kinematics import base_transform, dh_matrix, origin
from dynsolve.document import Prose
from dynsolve.document.sentences import opened, say
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.poses import turning_in
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import Identity, said, used_in_product
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import Negative, Node, Number, Product, Symbol, equation, mapped, number
from dynsolve.quantities import letters
from dynsolve.robot.model import Joint, Robot


def halves(robot: Robot) -> tuple[tuple[Joint, ...], tuple[Joint, ...]]:
    """The rows up to the last frame in two halves: of six joints, the arm and its wrist."""
    rows = robot.path(len(robot.joints))
    return rows[: len(rows) // 2], rows[len(rows) // 2 :]


def product_of_rows(context: Context, rows: Sequence[Joint]) -> tuple[Matrix, list[Identity]]:
    """The matrices of rows multiplied from the left, 4×4, and the identities that are used on the way.

    From the base on, with the frame of the base before them.
    """
    robot = context.robot
    matrices = [dh_matrix(robot, row) for row in rows]
    if rows[0].parent == 0:
        matrices = [base_transform(robot), *matrices]
    used: dict[Identity, None] = {}
    made = matrices[0]
    for A in matrices[1:]:
        before, made = made, made @ A
        used |= dict.fromkeys(used_in_product(context, before, A, made))
    return made, list(used)


class ByHalves(Struct, frozen=True):
    """The last frame as the product of two halves: in letters, its lines, what leads to it, and a check."""

    formula: Node
    lines: tuple[Line, ...]
    concluding: Prose
    notes: tuple[Prose, ...]


def by_halves(context: Context) -> ByHalves:
    """The products of two halves, and the product of these."""
    robot = context.robot
    inner, outer = halves(robot)
    end, half = outer[-1].index, inner[-1].index
    names = letters.H(robot, half), replace(letters.H(robot, end), sup=Number(half))
    (first, before), (second, after) = product_of_rows(context, inner), product_of_rows(context, outer)
    used = list(dict.fromkeys((*before, *after)))
    told = f"the two halves of the product, the second being frame {end} seen from frame {half}:"
    whole = used_in_product(context, first, second, context.values[f"H{end}"])
    check = at_zero_angles(context)
    return ByHalves(
        Product(names),
        (
            Line(
                ("With ", *said(used), f", {told}") if used else (opened(told),),
                (
                    equation(names[0], _rows_of_frame(context, inner), context.show(first)),
                    equation(names[1], _rows_of_frame(context, outer), context.show(second)),
                ),
            ),
        ),
        ("With ", *said(whole), ", their product:") if whole else ("Their product:",),
        (check,) if check else (),
    )


def _rows_of_frame(context: Context, rows: Sequence[Joint]) -> Node:
    """A_4 A_5 A_6, from the base on with the frame of the base before them."""
    matrices = [letters.A(row.index) for row in rows]
    if rows[0].parent == 0 and letters.has_base(context.robot):
        matrices = [letters.H(context.robot, 0), *matrices]
    return Product(tuple(matrices))


# -- a check of the last frame: where the end of the arm is with all joint angles 0, and in numbers


def at_zero_angles(context: Context) -> Prose:
    """To check: with all joint angles 0 the entries of o_6 are a₂ + a₃ = 0.4521, -d₃ = -0.15005 and so on.

    Nothing where an angle has no sine and cosine of its own.
    """
    ring, last = context.robot.ring, len(context.robot.joints)
    end = origin(context.values[f"H{last}"])
    turning = turning_in(context.robot, *end.entries)
    if not turning:
        return ()
    place = [context.show(ring.at_pose(entry, dict.fromkeys(turning, 0))) for entry in end.entries]
    values = [_in_numbers(context, entry) for entry in place]
    known = [value for value in values if value is not None]
    entries: list[Node] = place
    if len(known) == len(place):
        pairs = zip(place, map(_decimal, known), strict=True)
        entries = [entry if entry == value else equation(entry, value) for entry, value in pairs]
    return say(
        "To check: with all joint angles 0 the entries of {end} are {entries}{unit}.",
        end=letters.o(last),
        entries=listed(entries),
        unit=" (in m)" if len(known) == len(place) else "",
    )


def _in_numbers(context: Context, place: Node) -> Fraction | None:
    """The number that a length is; None where the problem has none, or an angle in degrees, for a letter."""
    lengths: dict[Node, Node] = {}
    for name, text in context.lengths.items():
        try:
            lengths[Symbol(name)] = number(Fraction(text))
        except ValueError:
            continue
    return rational_value(mapped(place, lambda node: lengths.get(node, node)))


def _decimal(value: Fraction) -> Node:
    size = Number(abs(value.numerator), value.denominator, decimal=value.denominator > 1)
    return Negative(size) if value < 0 else size
