"""The last frame of a long chain, and the axes of the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import groupby
from operator import itemgetter

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import ZERO, coordinate_column
from dynsolve.explain.kinematics import OUTWARDS
from dynsolve.explain.long_model.halves import halves, product
from dynsolve.explain.long_model.model import Change, LongModel
from dynsolve.explain.long_model.zero_pose import at_zero_angles
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.identities import said
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.writing import column_of, side_by_side
from dynsolve.notation import tree
from dynsolve.notation.build import cost
from dynsolve.notation.tree import Letter, Node, Number, Product, Relation, Symbol, Words, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Joint

LONGEST_ENTRY = 40
"""The operations in an entry of the Jacobian up to which three columns stand on a line or two."""


def changes(model: LongModel) -> dict[str, Change]:
    """The changes by the ids of their steps."""
    last = len(model.context.robot.joints)
    return {
        f"H{last}": partial(last_frame, model),
        "axes": partial(axes, model),
        "J": partial(jacobian, model),
    }


def last_frame(model: LongModel, step: Step) -> Step:
    """The last frame by the matrices of the rows: the products of two halves, and the product of these."""
    context = model.context
    robot = context.robot
    assert isinstance(step.formula, Relation)
    inner, outer = halves(robot)
    end, half = outer[-1].index, inner[-1].index
    names = letters.H(robot, half), replace(letters.H(robot, end), sup=Number(half))
    (first, before), (second, after) = product(context, inner), product(context, outer)
    used = list(dict.fromkeys((*before, *after)))
    told = f"the two halves of the product, the second being frame {end} seen from frame {half}:"
    whole = used_in_product(context, first, second, context.values[f"H{end}"])
    return replace(
        step,
        why=step.why if step.why[: len(OUTWARDS)] == OUTWARDS else (*OUTWARDS, " ", *step.why),
        formula=equation(*step.formula.parts, Product(names)),
        working=(),
        lines=(
            Line(
                ("With ", *said(used), f", {told}") if used else (told.capitalize(),),
                (
                    equation(names[0], _rows(context, inner), context.show(first)),
                    equation(names[1], _rows(context, outer), context.show(second)),
                ),
            ),
        ),
        concluding=("With ", *said(whole), ", their product:") if whole else ("Their product:",),
        notes=(*step.notes, *((check,) if (check := at_zero_angles(context)) else ())),
    )


def _rows(context: Context, rows: Sequence[Joint]) -> Node:
    """A_4 A_5 A_6, from the base on with the frame of the base before them."""
    matrices = [letters.A(row.index) for row in rows]
    if rows[0].parent == 0 and letters.has_base(context.robot):
        matrices = [letters.H(context.robot, 0), *matrices]
    return Product(tuple(matrices))


def axes(model: LongModel, step: Step) -> Step:
    """The frames on the way, which are not shown, by their products."""
    robot = model.context.robot
    if robot.is_tree or letters.has_base(robot):
        return step
    i = Symbol("i")
    frame = replace(letters.H(robot, 1), sub=i)
    product = Product((letters.A(1), Words("…"), Letter("A", i, style="bold")))
    before: Prose = ("Frame i is ", equation(frame, product), ". ")
    return replace(step, why=(*before, *step.why))


def jacobian(model: LongModel, step: Step) -> Step:
    """J_v by its columns, equal neighbours in one chain: all side by side are too wide for a page."""
    context = model.context
    J, last = context.matrix("Jv"), len(context.robot.joints)
    names = [coordinate_column(context, k, last, letters.o(last)) for k in range(model.n)]
    if None in names or max(cost(entry) for row in J.rows for entry in row) > LONGEST_ENTRY:
        return step
    columns = [(column_of(J, k), name[0]) for k, name in enumerate(names) if name]
    shown = []
    for value, equal in groupby(columns, itemgetter(0)):
        is_zero = all(row == (tree.ZERO,) for row in value.rows)
        shown.append(equation(*(name for _, name in equal), ZERO if is_zero else value))
    angular = [part for part in step.result if isinstance(part, Relation) and part.parts[0] == letters.JW]
    return replace(
        step,
        concluding=("The columns of ", letters.JV, " from the first to the last, and ", letters.JW, ":"),
        result=(side_by_side(shown), *angular),
    )
