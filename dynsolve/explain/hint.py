"""Hints: the tasks of a stage, without its results.

A hint is made of the steps of the stage, their reasons and formulas, of what earlier
stages have given, and of the pitfalls that this robot has.  Nothing that the stage or
a later one finds is shown: a step whose reason tells something of its result has a
`hint` to be said instead.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from dynsolve.document import Block, Document, Fold, Formula, Heading, List, Prose, Table, Text
from dynsolve.errors import UsageError
from dynsolve.explain import explain
from dynsolve.explain.citations import by_itself
from dynsolve.explain.context import Context
from dynsolve.explain.pitfalls import pitfalls
from dynsolve.explain.step import Step
from dynsolve.explain.writing import is_small, listed
from dynsolve.notation.tree import Node, equation
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import kinematic_families, letters
from dynsolve.quantities.index import quantities
from dynsolve.quantities.robot_stages import stages_of
from dynsolve.quantities.stages import Stage


@dataclass(slots=True)
class _Task:
    """Steps that are done in the same way."""

    title: str
    why: Prose
    formulas: list[tuple[Node, str]] = field(default_factory=list)
    likewise: list[str] = field(default_factory=list)


def hint_document(title: str, context: Context, stage: str) -> Document:
    """What to do in a stage: what there is, what to do with which formula, what to look out for.

    Raises UsageError for a stage that a robot without masses does not have.
    """
    asked = Stage(stage)
    if asked not in stages_of(context.robot):
        raise UsageError(_why_absent(context, asked))
    return Document((
        Heading(title, 1),
        Heading(f"Hint: {asked.heading[0].lower()}{asked.heading[1:]}"),
        *_given(context, asked),
        *_tasks(context, asked),
        *_look_out(context, asked),
    ))  # fmt: skip


def _why_absent(context: Context, stage: Stage) -> str:
    """Why a problem has no such stage."""
    if stage.asked_for:
        return f"this problem asks for nothing of the stage {stage}"
    if not context.robot.has_table:
        what = "frames" if stage.needs_table else "bodies"
        return f"this model has no {what}, so there is no stage {stage}"
    return f"no body has mass, so there is no stage {stage}: the derivation ends with the Jacobian"


# -- what there is ---------------------------------------------------------------------------------


def _given(context: Context, stage: Stage) -> Iterator[Block]:
    if stage is Stage.FRAMES:
        yield Text(("You have the joint axes as they are drawn:",))
        drawn = next(step.table for step in explain(context, [stage]) if step.table)
        yield Table(drawn.header, drawn.rows)
        return
    if stage is Stage.KINEMATICS:
        yield Text(("You have the Denavit-Hartenberg table:",))
        table = next(step.table for step in explain(context, [Stage.KINEMATICS]) if step.table)
        yield Table(table.header, table.rows)
        return
    yield Text((_at_hand(context, stage),))
    long: list[Node] = []
    for letter, name in _inputs(context, stage):
        form = context.form(name)
        if is_small(form):
            yield Formula(equation(letter, form))
        else:
            long.append(letter)
    if long:
        yield Text((*listed(long), ", too long to be repeated here."))


def _at_hand(context: Context, stage: Stage) -> str:
    """What an earlier stage has given, or the problem."""
    if not context.robot.has_table:
        if stage is Stage.INERTIA:
            return "You have what the problem says of each body: where it is, and how it turns."
        if stage is Stage.ENERGY:
            given = context.robot.given is not None
            return "You have what the problem gives." if given else _OF_PLACED_BODIES
    return _AT_HAND[stage]


_OF_PLACED_BODIES = "You have of each body the position of its mass centre, and its tensor:"

_AT_HAND = {
    Stage.JACOBIAN: "You have the frames of the forward kinematics:",
    Stage.TASK: "You have the frames of the forward kinematics:",
    Stage.SINGULAR: "You have the Jacobian of the task:",
    Stage.INVERSE: "You have what is to be reached as a function of the joint variables:",
    Stage.RATES: "You have the Jacobian of the task:",
    Stage.INERTIA: "You have the frames of the forward kinematics, and what the problem says of each body:",
    Stage.ENERGY: (
        "You have the axes and origins of the joints, and of each body its mass centre and its tensor:"
    ),
    Stage.LAGRANGIAN: "You have the two energies:",
    Stage.TORQUE: "You have the Lagrangian:",
    Stage.NEWTON_EULER: "You have the matrices of the rows of the table:",
    Stage.VECTORIZED: "You have the forces, one for each coordinate:",
    Stage.PARAMETERS: "You have the equations of motion, one for each coordinate:",
    Stage.CONSTRAINTS: "You have the forward kinematics, and the matrices of the model:",
    Stage.EQUILIBRIA: "Of the equations of motion you have:",
    Stage.FORWARD_DYNAMICS: "You have the matrices of the equations of motion:",
    Stage.TASK_INERTIA: "You have the Jacobian of the task and the inertia matrix:",
    Stage.DEFINITE: "You have the matrices, and what is assumed of their parameters.",
    Stage.STATICS: "You have the Jacobian of the end of the arm, and the frames:",
}


def _inputs(context: Context, stage: Stage) -> Iterator[tuple[Node, str]]:
    """The results that the stage starts from, by letter and name."""
    robot = context.robot
    if stage in (Stage.JACOBIAN, Stage.TASK, Stage.INERTIA):
        yield from ((letters.H(robot, joint.index), f"H{joint.index}") for joint in robot.joints)
    elif stage is Stage.SINGULAR:
        yield letters.J_TASK, "Jr"
    elif stage is Stage.INVERSE:
        last = len(robot.joints)
        is_pose = robot.questions.task is not None and robot.questions.task.is_pose
        yield (letters.H(robot, last), f"H{last}") if is_pose else (letters.TASK, "r")
    elif stage is Stage.RATES:
        given = (kinematic_families.JR, kinematic_families.JR_DOT)
        for quantity in quantities(robot).values():
            if quantity.family in given and quantity.name in context.wanted:
                yield quantity.letter(robot), quantity.name
    elif stage is Stage.ENERGY:
        for body in robot.bodies:
            yield letters.rc(body), f"rc{body.name}"
            if not body.is_point:
                yield letters.base_tensor(letters.index_of(body.name)), f"I{body.name}"
    elif stage is Stage.LAGRANGIAN:
        yield from ((letters.K, "K"), (letters.P, "P"))
    elif stage is Stage.TORQUE:
        yield letters.L, "L"
    elif stage is Stage.NEWTON_EULER:
        yield from ((letters.A(joint.index), f"A{joint.index}") for joint in robot.joints)
    elif stage is Stage.CONSTRAINTS:
        yield from ((letters.H(robot, joint.index), f"H{joint.index}") for joint in robot.joints[-1:])
        if not context.wanted.isdisjoint(("lambda", "reduced")):
            yield from ((letters.D, "D"), (letters.C, "C"), (letters.G, "g"))
    elif stage is Stage.EQUILIBRIA:
        is_linear = not context.wanted.isdisjoint(("linear_A", "linear_B"))
        is_moving = bool(robot.questions.model.steady)
        yield from ((letters.D, "D"),) if is_linear or is_moving else ()
        yield from ((letters.C, "C"),) if is_moving else ()
        yield letters.G, "g"
    elif stage is Stage.FORWARD_DYNAMICS:
        yield from ((letters.D, "D"), (letters.C, "C"), (letters.G, "g"))
    elif stage is Stage.TASK_INERTIA:
        yield from ((letters.J_TASK, "Jr"), (letters.D, "D"))
    elif stage is Stage.STATICS:
        yield from ((letters.JV, "Jv"), (letters.JW, "Jw"))
        yield from ((letters.H(robot, joint.index), f"H{joint.index}") for joint in robot.joints)
    elif stage in (Stage.VECTORIZED, Stage.PARAMETERS):
        yield from ((letters.force(q), f"tau{q.index}") for q in robot.coordinates)


# -- what to do ------------------------------------------------------------------------------------


def _tasks(context: Context, stage: Stage) -> Iterator[Block]:
    for number, task in enumerate(_grouped(explain(context, [stage])), start=1):
        blocks: list[Block] = [Text(task.why)] if task.why else []
        blocks += [Formula(node, source) for node, source in task.formulas]
        if task.likewise:
            blocks.append(Text((f"Likewise: {'; '.join(task.likewise)}.",)))
        yield Fold(f"{number}. {task.title}", tuple(blocks))


def _grouped(steps: Iterable[Step]) -> Iterator[_Task]:
    """The steps of a stage, grouped where they are done in the same way."""
    tasks: dict[tuple[str, str], _Task] = {}
    for step in steps:
        if not step.is_task:
            continue
        why, title = step.hint or step.why, step.hint_title or step.title
        words = "".join(part for part in why if isinstance(part, str))
        key = re.sub(r"\d+", "", step.id), re.sub(r"\d+", "", words)
        if key in tasks:
            tasks[key].likewise.append(_lowered(title))
            continue
        tasks[key] = _Task(title, why)
        formula = step.task or step.formula
        if formula is not None and to_unicode(formula) not in map(to_unicode, step.result):
            tasks[key].formulas.append((formula, by_itself(step.source)))
    yield from tasks.values()


def _lowered(title: str) -> str:
    return title[0].lower() + title[1:] if title[1:2].islower() else title


# -- what to look out for --------------------------------------------------------------------------


def _look_out(context: Context, stage: Stage) -> Iterator[Block]:
    items = tuple(pitfalls(context.robot, stage))
    if items:
        yield Text(("Look out:",))
        yield List(items)
