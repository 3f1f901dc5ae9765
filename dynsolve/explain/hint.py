"""Hints: what to do next in a stage, without its results.

A hint is made of the steps of the stage, their reasons and formulas, of what earlier
stages have given, and of the pitfalls that this robot has.  Nothing that the stage or
a later one finds is shown: reasons that tell a result are replaced by `_INSTEAD`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from dynsolve.document import Block, Document, Fold, Formula, Heading, List, Prose, Table, Text
from dynsolve.errors import UsageError
from dynsolve.explain import explain
from dynsolve.explain.course import Course, is_small, listed
from dynsolve.explain.pitfalls import pitfalls
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Node, Product, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

_INSTEAD: Mapping[str, str] = {
    r"Kv\w+": (
        "Half the mass times the square of the speed of the mass centre: add up the squares of the "
        "components of v."
    ),
    r"Kw\w+": ("ω and the tensor, both in base coordinates."),
    r"ddt\d+": (
        "Differentiate the momentum with respect to time. Each rate in it becomes an acceleration, "
        "and each coordinate in it brings its own rate (product and chain rule)."
    ),
    r"dLdq\d+": (
        "Differentiate L with respect to the coordinate alone: the rates are held fixed, and a term "
        "in which the coordinate does not stand drops out."
    ),
    r"Cqd": (
        "What is left of the forces without the accelerations: the terms with rates belong to C, the "
        "others, which remain when the arm is at rest, are g."
    ),
    r"D_direct": (
        "Another way to D, without the Lagrangian: a sum over the bodies. Use it to check what you "
        "read off from the forces."
    ),
    r"christoffel": (
        "They say how D changes as the arm moves: three partial derivatives of entries of D each. The "
        "first two indices may be swapped, so that half of the work is enough."
    ),
    r"C": (
        "Row k, column j: a sum over i. Multiplied by the rates it must give what you read off from "
        "the forces."
    ),
    r"g": ("Directly, without τ: the partial derivatives of the potential energy."),
    r"skew": (
        "A check at the end: with C from the Christoffel symbols, N plus its transpose must come out as zero."
    ),
}
"""What is said in place of a reason that depends on the result, by the id of its step."""

_LEFT_OUT = r"dh|agreement|D_direct.+"
"""Steps that are no work: what the problem gives, and what only compares results."""


@dataclass(slots=True)
class _Task:
    """Steps that are done in the same way."""

    title: str
    why: Prose
    formulas: list[tuple[Node, str]] = field(default_factory=list)
    likewise: list[str] = field(default_factory=list)


def hint_document(title: str, course: Course, stage: str) -> Document:
    """What to do in a stage: what there is, what to do with which formula, what to look out for.

    Raises UsageError for a stage that a robot without masses does not have.
    """
    asked = Stage(stage)
    if not course.robot.bodies and asked.needs_masses:
        raise UsageError(
            f"no body has mass, so there is no stage {stage}: the derivation ends with the Jacobian"
        )
    return Document((
        Heading(title, 1),
        Heading(f"Hint: {asked.heading[0].lower()}{asked.heading[1:]}"),
        *_given(course, asked),
        *_tasks(course, asked),
        *_look_out(course, asked),
    ))  # fmt: skip


# -- what there is ---------------------------------------------------------------------------------


def _given(course: Course, stage: Stage) -> Iterator[Block]:
    if stage is Stage.KINEMATICS:
        yield Text(("You have the Denavit-Hartenberg table:",))
        table = next(step.table for step in explain(course, [Stage.KINEMATICS]) if step.table)
        yield Table(table.header, table.rows)
        return
    yield Text((_AT_HAND[stage],))
    long: list[Node] = []
    for letter, name in _inputs(course, stage):
        form = course.form(name)
        if is_small(form):
            yield Formula(equation(letter, form))
        else:
            long.append(letter)
    if long:
        yield Text((*listed(long), ", too long to be repeated here."))


_AT_HAND = {
    Stage.JACOBIAN: "You have the frames of the forward kinematics:",
    Stage.INERTIA: "You have the frames of the forward kinematics, and what the problem says of each body:",
    Stage.ENERGY: (
        "You have the axes and origins of the joints, and of each body its mass centre and its tensor:"
    ),
    Stage.LAGRANGIAN: "You have the two energies:",
    Stage.TORQUE: "You have the Lagrangian:",
    Stage.VECTORIZED: "You have the forces, one for each coordinate:",
}


def _inputs(course: Course, stage: Stage) -> Iterator[tuple[Node, str]]:
    """What the stage starts from, by letter and name."""
    robot = course.robot
    if stage in (Stage.JACOBIAN, Stage.INERTIA):
        yield from ((letters.H(robot, joint.index), f"H{joint.index}") for joint in robot.joints)
    elif stage is Stage.ENERGY:
        for body in robot.bodies:
            yield letters.rc(body), f"rc{body.name}"
            if not body.is_point:
                yield letters.of_body("I", body, "script"), f"I{body.name}"
    elif stage is Stage.LAGRANGIAN:
        yield from ((letters.K, "K"), (letters.P, "P"))
    elif stage is Stage.TORQUE:
        yield letters.L, "L"
    elif stage is Stage.VECTORIZED:
        yield from ((letters.force(q), f"tau{q.index}") for q in robot.coordinates)


# -- what to do ------------------------------------------------------------------------------------


def _tasks(course: Course, stage: Stage) -> Iterator[Block]:
    for number, task in enumerate(_grouped(course.robot, explain(course, [stage])), start=1):
        blocks: list[Block] = [Text(task.why)] if task.why else []
        blocks += [Formula(node, source) for node, source in task.formulas]
        if task.likewise:
            blocks.append(Text((f"Likewise: {'; '.join(task.likewise)}.",)))
        yield Fold(f"{number}. {task.title}", tuple(blocks), 1)


def _grouped(robot: Robot, steps: Iterable[Step]) -> Iterator[_Task]:
    """The steps of a stage, those that go the same way together."""
    tasks: dict[tuple[str, str], _Task] = {}
    for step in steps:
        if re.fullmatch(_LEFT_OUT, step.id):
            continue
        why = _why(step)
        words = "".join(part for part in why if isinstance(part, str))
        key = re.sub(r"\d+", "", step.id), re.sub(r"\d+", "", words)
        if key in tasks:
            tasks[key].likewise.append(_lowered(step.title))
            continue
        tasks[key] = _Task(step.title, why)
        formula = _formula(robot, step)
        if formula is not None:
            tasks[key].formulas.append((formula, step.source))
    yield from tasks.values()


def _why(step: Step) -> Prose:
    """Why the step is taken, in words that hold whatever comes out."""
    if step.id.startswith("Kw") and step.why and str(step.why[0]).startswith("Skipped"):
        return step.why  # a point mass, which the problem says
    return next(((words,) for ids, words in _INSTEAD.items() if re.fullmatch(ids, step.id)), step.why)


def _formula(robot: Robot, step: Step) -> Node | None:
    """The formula of a step; of a row of the table what is put into it, of a frame the product."""
    if re.fullmatch(r"A\d+", step.id) and step.working:
        return step.working[0]
    found = re.fullmatch(r"H(\d+)", step.id)
    if found and int(found[1]) > 1:
        i = int(found[1])
        return equation(letters.H(robot, i), Product((letters.H(robot, i - 1), letters.A(i))))
    return step.formula


def _lowered(title: str) -> str:
    return title[0].lower() + title[1:] if title[1:2].islower() else title


# -- what to look out for --------------------------------------------------------------------------


def _look_out(course: Course, stage: Stage) -> Iterator[Block]:
    items = tuple(pitfalls(course.robot, stage))
    if items:
        yield Text(("Look out:",))
        yield List(items)
