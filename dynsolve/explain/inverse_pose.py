"""Steps of the inverse kinematics of a pose: what is to be reached, the wrist's centre, its rotation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.algebra.matrix import Matrix as Values
from dynsolve.derivation.inverse.solving import FixedPoint, Part, Turn
from dynsolve.derivation.inverse.subproblems import OneLine, Solved
from dynsolve.document import Prose
from dynsolve.explain.citations import craig, spong
from dynsolve.explain.context import Context
from dynsolve.explain.inverse_formulas import InverseFormulas
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import and_joined
from dynsolve.notation.tree import Function, Matrix, Node, Number, Relation, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.INVERSE

_AS_SUBPROBLEMS = (
    " The last joint does not move its own axis: the first two turn that to where it is to be (Paden-Kahan "
    "subproblem 2), and the last turns the hand about it (subproblem 1)."
)

_U = letters.bold("U")
"""The rotation that is left for some joints."""


def pose_task(context: Context) -> Step:
    """The pose that is to be reached."""
    x, y, z, *entries = map(Symbol, context.robot.questions.reached)
    rows = [(*entries[3 * k : 3 * k + 3], p) for k, p in enumerate((x, y, z))]
    last = (Number(0), Number(0), Number(0), Number(1))
    frame = letters.H(context.robot, len(context.robot.joints))
    return Step(
        id="inverse_task",
        stage=STAGE,
        title="What is to be solved",
        why=("The position and the rotation of the last frame are given, and the joint variables that give "
             "them are looked for.",),
        formula=equation(frame, Matrix((*rows, last))),
        source=spong("3.3.1"),
        uses=(f"H{len(context.robot.joints)}",),
        notes=tuple(_few_joints(context.robot.n)),
        is_task=False,
    )  # fmt: skip


def _few_joints(count: int) -> Iterator[Prose]:
    """What an arm with fewer than six joints cannot do."""
    if count < 6:
        yield (
            f"With {count} joint{'s' * (count > 1)} only some poses are reached: the equations give the "
            "joint variables, and the others hold where the pose is one of these.",
        )


def introduction(
    formulas: InverseFormulas, part: Part, number: int, before: Sequence[Solved]
) -> Iterator[Step]:
    """What the steps of a part of the solution start from: a rotation that is left, a point."""
    if part.turn is not None:
        yield _turn(formulas, part.turn, number, before)
    if part.parallel:
        yield _parallel(part.parallel, number)
    if part.point is not None:
        yield _point(formulas, part, part.point, number)


# -- a point ---------------------------------------------------------------------------------------


def _point(formulas: InverseFormulas, part: Part, point: FixedPoint, number: int) -> Step:
    known, values = (_column(formulas, point, named=named) for named in (True, False))
    made = _form(formulas, point.made)
    what = _called(point)
    return Step(
        id=f"inverse_point_{number}",
        stage=STAGE,
        title=what[0].upper() + what[1:],
        why=_why_point(point, what),
        result=(*((equation(known, values),) if point.definitions else ()), equation(known, made)),
        source=spong("3.3.2"),
        detail=Detail.NORMAL,
        uses=("inverse_task", *((f"inverse_turn_{number}",) if part.turn else ())),
    )


def _called(point: FixedPoint) -> str:
    """What a point is called."""
    count = point.last - point.first + 1
    if count == 0:
        return "the origin of the last frame"
    if count == 1:
        return f"a point on the axis of joint {point.first}"
    if count == 3 and not point.from_hand:
        return "the wrist centre"
    return f"the point where the axes of joints {_numbers(point)} meet"


def _why_point(point: FixedPoint, what: str) -> Prose:
    seen = "It is fixed in the hand, and the pose says where it is"
    if point.from_hand:
        seen = "It is fixed in the base, and the pose says where the hand sees it"
    alone = ". Only the other joints move it"
    match point.last - point.first + 1:
        case 0:
            return ("Every joint moves it.",)
        case 1:
            return (f"Joint {point.first} turns about its axis and does not move this point. {seen}{alone}.",)
        case _:
            return (
                f"The axes of joints {_numbers(point)} meet in one point, which these joints do not move. "
                f"{seen}{alone}{_decoupled(point)}",
            )


def _decoupled(point: FixedPoint) -> str:
    """What the centre of a wrist is good for."""
    if point.last - point.first < 2 or point.from_hand:
        return "."
    return " to its place, and the wrist then turns the hand: position and rotation are decoupled."


def _numbers(told: FixedPoint | Turn) -> str:
    return and_joined([str(k) for k in range(told.first, told.last + 1)])


def _column(formulas: InverseFormulas, point: FixedPoint, *, named: bool) -> Node:
    """The coordinates of a point, by name or in what is known."""
    meant = {} if named else {d.name: formulas.form(d.value) for d in point.definitions}
    return Matrix(tuple((_meaning(meant, formulas.form(e)),) for e in point.known.entries))


def _meaning(meant: dict[str, Node], node: Node) -> Node:
    return meant.get(node.name, node) if isinstance(node, Symbol) else node


def _form(formulas: InverseFormulas, values: Values) -> Matrix:
    return Matrix(tuple(tuple(map(formulas.form, row)) for row in values.rows))


def _parallel(joints: tuple[int, ...], number: int) -> Step:
    """What joints with parallel axes leave alone."""
    named = and_joined([str(k) for k in joints])
    return Step(
        id=f"inverse_parallel_{number}",
        stage=STAGE,
        title="Parallel axes",
        why=(
            f"The axes of joints {named} are parallel. In that direction these joints move nothing, and they "
            "turn nothing out of it: what is seen along it holds the others alone, and these come first.",
        ),
        source=craig("4.6"),
        uses=(),
    )


# -- a rotation ------------------------------------------------------------------------------------


def _turn(formulas: InverseFormulas, turn: Turn, number: int, before: Sequence[Solved]) -> Step:
    """The rotation that is left for some joints."""
    made, known = (_form(formulas, m.block(0, 3, 0, 3)) for m in (turn.made, turn.known))
    count = turn.last - turn.first + 1
    joints = f"joint {turn.first}" if count == 1 else f"joints {_numbers(turn)}"
    values = [equation(Symbol(d.name), formulas.form(d.value)) for d in turn.definitions]
    return Step(
        id=f"inverse_turn_{number}",
        stage=STAGE,
        title="The rotation of the wrist" if turn.is_wrist else f"What is left for {joints}",
        why=(
            f"The other joints are known now. Taken off the given pose, they leave to {joints} the rotation ",
            _U,
            ", which is also the product of the rotations of these joints.",
            *((_AS_SUBPROBLEMS,) if turn.is_wrist else ()),
        ),
        working=(equation(_U, known, made),),
        source=spong("3.3.2"),
        concluding=("From the given pose and the joints that are known:",) if values else (),
        result=tuple(values) or (equation(_U, known, made),),
        listed=True,
        uses=("inverse_task", *(f"inverse_{step.coordinate}" for step in before)),
    )


def wrist_notes(formulas: InverseFormulas, turn: Turn, step: Solved) -> Iterator[Prose]:
    """Where a spherical wrist is singular; said with its first angle that has two values."""
    if not isinstance(step, OneLine):
        return
    first, middle, last = map(Symbol, turn.names)
    if len(turn.made[2, 2]) == 1:  # ± the cosine of the angle between the outer axes
        where = equation(Function("sin", middle), Number(0))
    else:
        where = Relation((formulas.form(turn.known[2, 2]), Number(1)), ("= ±",))
    yield (
        "Where ", where, " the first and the last axis of the wrist are one line: the wrist is singular. "
        "Only the sum of ", first, " and ", last, ", or their difference, is given then, and one of them "
        "is free: infinitely many solutions.",
    )  # fmt: skip
