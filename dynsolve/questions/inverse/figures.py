"""Drawings of the steps of inverse kinematics that have one: a projection, a triangle of two lengths.

an angle in a plane     A cos ψ - B sin ψ = X, A sin ψ + B cos ψ = Y: a right angle of A and B,
                        turned by ψ so that it ends at (X, Y); with X unknown, by ψ from the
                        direction in which B is the distance
law of cosines          c² = a² + b² + 2 a b cos ψ, where squares were added
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import cos, pi, sin

from dynsolve.algebra.factors import is_nonnegative
from dynsolve.algebra.ring import Expr
from dynsolve.document.figures import Figure, FigureAngle, FigureLine, LineKind, Place
from dynsolve.notation.build import cost, negated, split_sign, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ZERO, Function, Node, Symbol, names_in
from dynsolve.questions.inverse.equations import Equation, Given, OfPoint, Squared, Turned
from dynsolve.questions.inverse.forms import InverseFormulas
from dynsolve.questions.inverse.subproblems import OneLine, Solved, TwoLines
from dynsolve.robot.model import Convention, Robot

MOST = 6
"""Formulas with more operations are not written on a line of a drawing."""

_TURN = 0.65
"""The angle ψ as it is drawn."""

_LONG, _ACROSS = 2.4, 0.8
"""A and B as they are drawn."""

_BEND = 0.95
"""The angle between two lengths as it is drawn."""

_ORIGIN = (0.0, 0.0)


def figure_of(robot: Robot, formulas: InverseFormulas, step: Solved) -> Figure | None:
    """The drawing of a step; None where it has none."""
    match step:
        case OneLine(equations=(Equation(origin=Squared()),)):
            return _law_of_cosines(robot, formulas, step)
        case OneLine(equations=(Equation(origin=Turned() as turned),)) if (
            turned.coordinate == step.coordinate
        ):
            return _projection(formulas, step, turned)
        case TwoLines(equations=equations) if step.is_rotation and all(map(_is_length, equations)):
            return _turned_vector(formulas, step)
    return None


def _is_length(equation: Equation) -> bool:
    """Whether an equation is one of positions, and not of directions."""
    match equation.origin:
        case Given() | OfPoint():
            return True
        case Turned(first, second):
            return _is_length(first) and _is_length(second)
    return False


# -- an angle in a plane ---------------------------------------------------------------------------


def _projection(formulas: InverseFormulas, step: OneLine, turned: Turned) -> Figure | None:
    """From (x, y) turned back, of which one component is known: what is seen along the axis.

    c x + s y = A, or -s x + c y = B, each perhaps with the opposite sign.
    """
    if not (_is_length(turned.first) and _is_length(turned.second)):
        return None
    x, y = turned.first.left, turned.second.left
    of_cosine, of_sine = (y, -x) if turned.is_second else (x, y)
    if (step.cosine, step.sine) == (of_cosine, of_sine):
        value = step.value
    elif (step.cosine, step.sine) == (-of_cosine, -of_sine):
        value = -step.value
    else:
        return None
    vector = (None, value) if turned.is_second else (value, None)
    return _in_a_plane(formulas, step, (x, y), vector, "Seen along the axis of the joint; not to scale.")


def _turned_vector(formulas: InverseFormulas, step: TwoLines) -> Figure | None:
    """(A, B) turned by the angle is (X, Y)."""
    (a, b, x), (c, d, y) = step.first, step.second
    if d == a and c == -b:  # a c + b s = x, a s - b c = y
        b = -b
    else:
        y = -y
    if a.is_zero and b.is_zero:
        return None
    caption = "The vector of what is known, turned by the joint; not to scale."
    return _in_a_plane(formulas, step, (x, y), (a, b), caption)


def _in_a_plane(
    formulas: InverseFormulas,
    step: Solved,
    point: tuple[Expr, Expr],
    vector: tuple[Expr | None, Expr | None],
    caption: str,
) -> Figure:
    """A right angle of two lengths, the first turned by the angle, and where it ends; None is not known."""
    x, y = map(formulas.form, point)
    along, across = (None if value is None else formulas.form(value) for value in vector)
    foot = _moved(_ORIGIN, _TURN, 0.0 if along == ZERO else _LONG)
    sign, width = (1, None) if across is None else split_sign(across)
    end = _moved(foot, _TURN + pi / 2, 0.0 if width == ZERO else sign * _ACROSS)
    below = (end[0], 0.0)
    lines = [
        FigureLine(_ORIGIN, (3.1, 0.0), LineKind.AXIS),
        FigureLine(_ORIGIN, (0.0, 2.5), LineKind.AXIS),
        FigureLine(below, _ORIGIN, LineKind.HELP, _short(x)),
        FigureLine(end, below, LineKind.HELP, _short(y)),
        FigureLine(foot, _ORIGIN, LineKind.LENGTH, _short(along)),
    ]
    if end != foot:
        lines += [
            FigureLine(end, foot, LineKind.LENGTH, _short(width)),
            FigureLine(_ORIGIN, end, LineKind.HELP),
        ]
    return Figure(
        caption, tuple(lines), (FigureAngle(_ORIGIN, 0.0, _TURN, Symbol(step.coordinate)),), (_ORIGIN, end)
    )


# -- the law of cosines ----------------------------------------------------------------------------


def _law_of_cosines(robot: Robot, formulas: InverseFormulas, step: OneLine) -> Figure | None:
    """The triangle with sides a and b, where c² = a² + b² + 2 a b cos(q - φ); q turns b."""
    (squared,) = step.equations
    sign = 1 if len(squared.left - step.value) <= len(squared.left + step.value) else -1
    constant = squared.left - step.value * sign
    sides = _sides(constant, step.cosine * step.cosine + step.sine * step.sine)
    if sides is None:
        return None
    roots = [_root(formulas, square) for square in sides]
    first, second = _in_order(robot, roots, step.coordinate)
    apart = constant - sides[0] - sides[1]
    distance = Function("sqrt", formulas.form(squared.left - apart))
    bend = _bend(formulas, step, sign)
    elbow = _moved(_ORIGIN, _TURN, 1.7)
    end = _moved(elbow, _TURN + _BEND, 1.4)
    lines = (
        FigureLine(elbow, _ORIGIN, LineKind.LENGTH, first),
        FigureLine(end, elbow, LineKind.LENGTH, second),
        FigureLine(_ORIGIN, end, LineKind.HELP, _short(distance, 2 * MOST)),
        FigureLine(elbow, _moved(elbow, _TURN, 0.9), LineKind.HELP),
    )
    caption = "Two lengths and the distance of their ends: the law of cosines; not to scale."
    angle = FigureAngle(elbow, _TURN, _TURN + _BEND, bend)
    return Figure(caption, lines, (angle,), (_ORIGIN, elbow, end))


def _in_order(robot: Robot, sides: Sequence[Node], coordinate: str) -> list[Node]:
    """The side before a joint, then the one that it turns, by the rows of the table that have their letters.

    A letter of both sides tells nothing; a side without another stands where the joint does.
    """
    turned = {k for k, q in enumerate(robot.coordinates) if q.name == coordinate}
    at = next((joint.index for joint in robot.joints if turned & {k for k, _ in joint.rates}), 0)
    common = set.intersection(*map(names_in, sides))

    def row(side: Node) -> float:
        own = names_in(side) - common
        rows = (joint.index for joint in robot.joints if own & names_in(*joint.written[1:3]))
        return min(rows, default=at + (0.5 if robot.convention is Convention.MODIFIED else -0.5))

    return sorted(sides, key=row)


def _bend(formulas: InverseFormulas, step: OneLine, sign: int) -> Node:
    """q - φ, the angle from one length to the other: A cos q + B sin q is greatest where it is 0."""
    q = Symbol(step.coordinate)
    a, b = step.cosine * sign, step.sine * sign
    if b.is_zero:
        return q if is_nonnegative(a) else formula("{q} - π", q=q)
    if a.is_zero:
        return formula("{q} - π/2" if is_nonnegative(b) else "{q} + π/2", q=q)
    return total([q, negated(formulas.direction(b, a))])


def _sides(constant: Expr, square: Expr) -> tuple[Expr, Expr] | None:
    """(a², b²), sums of terms of `constant`, with 4 a² b² = `square`; None where there are none.

    What is left of the constant is no part of the triangle: a distance across its plane.
    """
    ring = constant.ring
    terms = [Expr(ring, ring.ctx.from_dict({m: c})) for m, c in constant.poly.to_dict().items()]
    if len(terms) > MOST:
        return None
    for shares in product((0, 1, None), repeat=len(terms)):
        sides = [ring.zero, ring.zero]
        for term, share in zip(terms, shares, strict=True):
            if share is not None:
                sides[share] = sides[share] + term
        if sides[0] * sides[1] * 4 == square:
            return sides[1], sides[0]
    return None


def _root(formulas: InverseFormulas, square: Expr) -> Node:
    """The root of a square, l of l²."""
    if len(square) == 1:
        ((exponents, factor),) = square.poly.to_dict().items()
        if factor == 1 and all(e % 2 == 0 for e in exponents):
            ring = square.ring
            half = tuple(int(e) // 2 for e in exponents)
            return formulas.form(Expr(ring, ring.ctx.from_dict({half: 1})))
    return Function("sqrt", formulas.form(square))


# -- pieces ----------------------------------------------------------------------------------------


def _short(name: Node | None, most: int = MOST) -> Node | None:
    """A name that is short enough to stand at a line."""
    return name if name is not None and cost(name) <= most else None


def _moved(start: Place, angle: float, by: float) -> Place:
    return start[0] + by * cos(angle), start[1] + by * sin(angle)
