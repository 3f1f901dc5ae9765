"""What P has where g = 0, by the signs of the minors of its second derivatives, ∂²P/∂q_i∂q_j = ∂g_i/∂q_j.

The minors are those of the last coordinate, the last two, ... (Sylvester's criterion): all of them
are positive at a minimum; those of odd size alone are negative at a maximum; where the determinant
is not 0, and it is neither, P rises in one direction and falls in another.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import StrEnum

from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.balance import Zero, at_zeros
from dynsolve.explain.sanity.definite import determinant
from dynsolve.explain.sanity.pose import Pose, at
from dynsolve.explain.sanity.sign import sign_of
from dynsolve.explain.working.kinetic import without_signs
from dynsolve.notation.build import times
from dynsolve.notation.tree import (
    ZERO,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters

DET = Words("det")
"""The determinant of the second derivatives."""

MOST_SHOWN = 2
"""Of up to so many angles the minors are shown with the derivatives that they are made of."""


class Kind(StrEnum):
    """What P has where its first derivatives are 0."""

    MINIMUM = "minimum"
    MAXIMUM = "maximum"
    SADDLE = "saddle point"


def minors(context: Context, names: Sequence[str], known: Sequence[Zero] = ()) -> list[Expr]:
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
