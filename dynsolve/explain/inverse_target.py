"""Steps of the inverse kinematics at numbers: each configuration that reaches them, or why there is none."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import groupby
from math import degrees

from dynsolve.algebra.rationals import rational_value
from dynsolve.derivation.inverse.solving import FixedPoint, Part, Turn
from dynsolve.derivation.inverse.subproblems import OneLine, Solved
from dynsolve.document import Prose, Table
from dynsolve.explain.context import Context
from dynsolve.explain.inverse_formulas import InverseFormulas
from dynsolve.explain.step import NOTED, Detail, Group, Step
from dynsolve.explain.target import Configuration, Lost, TargetForms, decimal
from dynsolve.explain.writing import and_joined, craig, listed, spong
from dynsolve.notation.build import cost
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Relation,
    Symbol,
    equation,
)
from dynsolve.notation.walk import names_in, walk
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

_DIGITS = 4
_LIMITS = "Limits"

LONGEST = 60
"""A formula with more operations is no help to a reader; its value stands alone."""

_TITLE = "The configurations that reach it"
_HINT = (
    "Put the numbers into every branch. Look at the arguments of roots, of arccos and arcsin: is the branch "
    "real, is it one with another? And at atan2: are both its arguments 0?",
)
"""What a hint says of them, however many there are."""

_REAL = {
    "acos": "no angle has a cosine beyond -1 and 1",
    "asin": "no angle has a sine beyond -1 and 1",
    "sqrt": "a negative number has no real root",
}


def target_steps(forms: TargetForms) -> Iterator[Step]:
    """A step for each configuration, and the table of all."""
    whole = _all(forms)
    group = Group("inverse", whole.title)
    for number, one in enumerate(forms.configurations, 1):
        yield replace(_configuration(forms, one, number), group=group, normal=NOTED)
    yield replace(whole, group=group, normal=NOTED)


def given_numbers(forms: TargetForms) -> tuple[Node, ...]:
    """What the values of the task are."""
    return tuple(equation(Symbol(name), value) for name, value in forms.given)


# -- one configuration -----------------------------------------------------------------------------


def _configuration(forms: TargetForms, one: Configuration, number: int) -> Step:
    return Step(
        id=f"inverse_{number}",
        stage=Stage.INVERSE,
        title=f"Configuration {number}",
        why=_where_from(one),
        result=tuple(_value(forms, one, name) for name in one.formulas),
        notes=tuple(_remarks(one)),
        listed=True,
        uses=("inverse_branches",) if one.branches else (),
        is_task=False,
    )


def _where_from(one: Configuration) -> Prose:
    match one.branches:
        case ():
            return ("Found in numbers, and put into ", letters.TASK_OF_Q, ".")
        case (branch,):
            return (f"Branch {branch} with these numbers.",)
    numbers = listed([str(branch) for branch in one.branches])
    return ("Branches ", *numbers, " with these numbers: they are one, for the target is on their boundary.")


def _value(forms: TargetForms, one: Configuration, name: str) -> Node:
    """q = its formula ≈ its value"""
    formula, value = one.formulas[name], one.numbers[name]
    if rational_value(formula) == 0 or _depends(one, name):
        return equation(Symbol(name), formula)
    if cost(formula) > LONGEST:
        formula = decimal(value)
    shown = [node for node in (formula, decimal(value, _DIGITS)) if not _is_decimal(node) or node != formula]
    if rational_value(formula) is not None:
        shown = [decimal(value, _DIGITS)] if _is_decimal(formula) else [formula]
    if _turns(forms, name):
        if names_in(formula) <= {"pi"} and not _has_function(formula) and not _is_decimal(formula):
            return Relation((Symbol(name), formula, _in_degrees(value)), ("=", "="))
        shown.append(_in_degrees(value))
    return Relation((Symbol(name), *shown), ("≈" if _is_decimal(formula) else "=", *["≈"] * (len(shown) - 1)))


def _depends(one: Configuration, name: str) -> bool:
    """Whether a coordinate is given by one that is free."""
    return name in one.formulas and bool(names_in(one.formulas[name]) & set(one.free))


def _has_function(node: Node) -> bool:
    return any(isinstance(part, Function) for part in walk(node))


def _is_decimal(node: Node) -> bool:
    inner = node.argument if isinstance(node, Negative) else node
    return isinstance(inner, Number) and inner.decimal


def _turns(forms: TargetForms, name: str) -> bool:
    return dict(forms.robot.ring.coordinates)[name] == "revolute"


def _in_degrees(value: float) -> Node:
    hundredths = Fraction(round(abs(degrees(value)) * 100), 100)
    size = Degrees(hundredths.numerator, hundredths.denominator)
    return Negative(size) if value < 0 and hundredths else size


def _remarks(one: Configuration) -> Iterator[Prose]:
    if one.free:
        verb = " is" if len(one.free) == 1 else " are"
        names = listed([Symbol(name) for name in one.free])
        yield (*names, verb, " free here: infinitely many solutions.")
    if one.outside:
        verb = " is" if len(one.outside) == 1 else " are"
        yield (*listed([Symbol(name) for name in one.outside]), verb, " beyond the limits.")


# -- all of them -----------------------------------------------------------------------------------


def _all(forms: TargetForms) -> Step:
    found = forms.configurations
    if not found:
        return _none(forms)
    one = len(found) == 1
    return Step(
        id="inverse",
        stage=Stage.INVERSE,
        title="The configuration that reaches it"
        if one
        else f"The {len(found)} configurations that reach it",
        why=told(forms),
        table=_table(forms),
        notes=tuple(_lost(forms)),
        detail=Detail.BRIEF,
        uses=tuple(f"inverse_{number}" for number in range(1, len(found) + 1)),
        hint=_HINT,
        hint_title=_TITLE,
    )


def told(forms: TargetForms) -> Prose:
    """How the configurations were found, and how they are known to be right."""
    if forms.is_searched:
        return (
            "Newton's method from 200 configurations led to these, each put into ",
            letters.TASK_OF_Q,
            " to ten digits. That there are no others is not proved.",
        )
    return ("Each is put into ", letters.TASK_OF_Q, " to see that it gives the task.")


def _table(forms: TargetForms) -> Table:
    names = [q.name for q in forms.robot.coordinates]
    limited = bool(forms.robot.questions.limits)
    head = ("", *map(Symbol, names), *((_LIMITS,) if limited else ()))
    rows = []
    for number, one in enumerate(forms.configurations, 1):
        cells = [_cell(forms, one, name) for name in names]
        mark = ("beyond" if one.outside else "within",) if limited else ()
        rows.append((str(number), *cells, *mark))
    return Table(head, tuple(rows))


def _cell(forms: TargetForms, one: Configuration, name: str) -> Node | str:
    if name in one.free:
        return "free"
    if _depends(one, name):
        return one.formulas[name]
    value = one.numbers[name]
    return _in_degrees(value) if _turns(forms, name) else decimal(value, _DIGITS)


def _none(forms: TargetForms) -> Step:
    return Step(
        id="inverse",
        stage=Stage.INVERSE,
        title="Infinitely many configurations" if forms.is_family else "Out of reach",
        why=reason(forms),
        notes=tuple(_lost(forms)),
        detail=Detail.BRIEF,
        uses=(),
        hint=_HINT,
        hint_title=_TITLE,
    )


def reason(forms: TargetForms) -> Prose:
    """Why there is no configuration, or none that stands alone; nothing where there are some."""
    if forms.configurations:
        return ()
    if forms.is_family:
        return ("The configurations that reach this do not stand alone: there are infinitely many.",)
    if forms.unmet:
        return ("No configuration reaches this: no joint gives ", letters.TASK_OF_Q, " these values.")
    if forms.lost:
        return ("No configuration reaches this: no branch is real.",)
    return ("No configuration that reaches this was found: Newton's method from 200 of them led to none.",)


def _lost(forms: TargetForms) -> Iterator[Prose]:
    """Why branches are not real or no solutions, those with one reason together."""
    for condition, unmet in groupby(forms.unmet, key=lambda one: one.condition):
        numbers = listed([str(one.branch) for one in unmet])
        which = "Branch " if len(numbers) == 1 else "Branches "
        needs = " needs " if len(numbers) == 1 else " need "
        yield which, *numbers, needs, equation(*condition.sides), ", which does not hold here."

    def why(lost: Lost) -> tuple[str, str, str]:
        return lost.coordinate, lost.function, repr(lost.argument)

    for _, together in groupby(sorted(forms.lost, key=why), key=why):
        lost = list(together)
        numbers = listed([str(one.branch) for one in lost])
        one = lost[0]
        yield (
            "Branch " if len(lost) == 1 else "Branches ", *numbers,
            f" {'is' if len(lost) == 1 else 'are'} not real: ", Symbol(one.coordinate), " needs ",
            Function(one.function, one.argument), f", and {_REAL[one.function]}.",
        )  # fmt: skip


# -- steps of the inverse kinematics of a pose: what is to be reached, the wrist's centre, its rotation

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
    made = formulas.matrix(point.made)
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
    made, known = (formulas.matrix(m.block(0, 3, 0, 3)) for m in (turn.made, turn.known))
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
