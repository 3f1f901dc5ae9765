"""The kinetic energy of each body of a long model: the columns of its Jacobians, worked out for one body."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from operator import itemgetter

from dynsolve.derivation.jacobian import linear_jacobian
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import ZERO, coordinate_column
from dynsolve.explain.long_model.halves import halves
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import column_of, side_by_side, spong
from dynsolve.notation import tree
from dynsolve.notation.build import cost
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
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, JointType

LONGEST_ENTRY = 30
"""The operations in an entry of a body's Jacobian up to which its columns are worked out."""

_I, _J = Symbol("i"), Symbol("j")
_CENTER = Letter("r", Row((Words("c"), _I)), style="bold")
_JV, _JW = (letters.bold("J", Letter(base, _I)) for base in ("v", "omega"))


def kinetic_step(context: Context) -> Step:
    """v_i = J_vi q̇ and ω_i = J_ωi q̇, what the columns are, and K_i."""
    v, w = (Letter(base, _I, style="bold") for base in ("v", "omega"))
    velocities = [equation(v, Product((_JV, letters.QD))), equation(w, Product((_JW, letters.QD)))]
    linear = Product((letters.HALF, Letter("m", _I), letters.transposed_product(v)))
    rotational = Product((letters.HALF, letters.transposed_product(w, letters.base_tensor(_I))))
    example = tuple(_example(context))
    return Step(
        id="kinetics",
        stage=Stage.ENERGY,
        title="Kinetic energy of each body",
        why=_on_columns(context),
        formula=side_by_side(velocities),
        source=spong("7.2.2"),
        lines=example,
        concluding=("The kinetic energy of a body:",) if example else (),
        result=(equation(Letter("K", _I), Sum((linear, rotational))),),
        detail=Detail.BRIEF,
        uses=(),
    )


def _on_columns(context: Context) -> Prose:
    """What the columns of a body's Jacobians are, by the kinds of joints that there are."""
    which = Sum((_J, Negative(Number(1)))) if context.standard else _J
    z, o = letters.bold("z", which), letters.bold("o", which)
    turning = (Cross(z, Parenthesized(Sum((_CENTER, Negative(o))))), z)
    kinds = {joint.type for joint in context.robot.joints}
    words: Prose = (
        f"The Jacobians of a mass centre are like those of the arm, with its place instead of {context.end}: "
        "for each joint j up to the body's link, column ",
        *(_J, " of ", _JV, " is ", turning[0], " and that of ", _JW, " is ", turning[1]),
    )
    if JointType.PRISMATIC in kinds:
        words += (" where the joint is revolute, ", z, " and ", ZERO, " where it is prismatic")
    return (*words, ". The columns of the joints after it are zero.")


def _example(context: Context) -> Iterator[Line]:
    """J_v of the body half-way along the arm: where its mass centre is, and the columns."""
    robot = context.robot
    link = halves(robot)[0][-1].index
    body = next((body for body in robot.bodies if body.link == link), None)
    if robot.is_tree or body is None or not robot.moves_each_joint_alone:
        return
    columns = _columns(context, body)
    if max(cost(entry) for _, value in columns for row in value.rows for entry in row) > LONGEST_ENTRY:
        return
    center = equation(letters.rc(body), context.form(f"rc{body.name}"))
    shown = []
    for value, equal in groupby(columns, itemgetter(1)):
        is_zero = all(row == (tree.ZERO,) for row in value.rows)
        shown.append(equation(*(name for name, _ in equal), ZERO if is_zero else value))
    yield Line(
        (
            "For example, the columns of ",
            letters.jv(body),
            f" that are not zero, with the mass centre of body {body.name}:",
        ),
        (center, *shown),
    )


def _columns(context: Context, body: Body) -> list[tuple[Node, Matrix]]:
    """z × (r_c - o) or z of each coordinate up to the body's link, in letters and worked out."""
    robot = context.robot
    frames = [context.values[f"H{i}"] for i in range(body.link + 1)]
    J = context.show(linear_jacobian(robot, frames, context.values[f"rc{body.name}"], body.link))
    assert isinstance(J, Matrix)
    named = [coordinate_column(context, k, body.link, letters.rc(body)) for k in range(robot.n)]
    return [(name[0], column_of(J, k)) for k, name in enumerate(named) if name is not None]
