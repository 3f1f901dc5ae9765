"""Hints: the tasks of a stage, without its results.

A hint is made of the steps of the stage, their reasons and formulas, of what earlier
stages have given, and of the pitfalls that this robot has.  Nothing that the stage or
a later one finds is shown: a step whose reason tells something of its result has a
`hint` to be said instead.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from textwrap import dedent

from dynsolve.document import Block, Document, Fold, Formula, Heading, List, Prose, Table, Text
from dynsolve.document.books import by_itself
from dynsolve.document.sentences import Value, say
from dynsolve.errors import UsageError
from dynsolve.explain import explain
from dynsolve.explain.actions import said_of_laws
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import and_joined, is_small, listed
from dynsolve.notation.tree import Node, Symbol, equation
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from dynsolve.quantities.owners import heading_of, stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import AxesKind, Body, Convention, JointType, Robot


def hint_document(title: str, context: Context, stage: str) -> Document:
    """What to do in a stage: what there is, what to do with which formula, what to look out for.

    Raises UsageError for a stage that a robot without masses does not have.
    """
    asked = Stage(stage)
    if asked not in stages_of(context.robot):
        raise UsageError(_why_absent(context, asked))
    heading, mistakes = heading_of(asked, context.robot), tuple(pitfalls(context.robot, asked))
    return Document((
        Heading(title, 1),
        Heading(f"Hint: {heading[0].lower()}{heading[1:]}"),
        *_given(context, asked),
        *_tasks(context, asked),
        *((Text(("Look out:",)), List(mistakes)) if mistakes else ()),
    ))  # fmt: skip


def _why_absent(context: Context, stage: Stage) -> str:
    if stage.asked_for:
        return f"this problem asks for nothing of the stage {stage}"
    if not context.robot.has_table:
        what = "frames" if stage.needs_table else "bodies"
        return f"this model has no {what}, so there is no stage {stage}"
    return f"no body has mass, so there is no stage {stage}: the derivation ends with the Jacobian"


# -- what there is ---------------------------------------------------------------------------------


def _given(context: Context, stage: Stage) -> Iterator[Block]:
    yield Text((_at_hand(context, stage),))
    if stage in (Stage.FRAMES, Stage.KINEMATICS):
        table = next(step.table for step in explain(context, [stage]) if step.table)
        yield Table(table.header, table.rows)
        return
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
        if stage is Stage.ENERGY and context.robot.given is not None:
            return "You have what the problem gives."
        if stage is Stage.ENERGY:
            return "You have of each body the position of its mass centre, and its tensor:"
    question = stage.part("explain")
    return question.AT_HAND if question else _AT_HAND[stage]


_AT_HAND = {
    Stage.KINEMATICS: "You have the Denavit-Hartenberg table:",
    Stage.JACOBIAN: "You have the frames of the forward kinematics:",
    Stage.INERTIA: "You have the frames of the forward kinematics, and what the problem says of each body:",
    Stage.ENERGY: (
        "You have the axes and origins of the joints, and of each body its mass centre and its tensor:"
    ),
    Stage.LAGRANGIAN: "You have the two energies:",
    Stage.TORQUE: "You have the Lagrangian:",
    Stage.VECTORIZED: "You have the forces, one for each coordinate:",
}


def _inputs(context: Context, stage: Stage) -> Iterable[tuple[Node, str]]:
    """The results that the stage starts from, by letter and name."""
    robot = context.robot
    match stage:
        case Stage.JACOBIAN | Stage.INERTIA:
            return [(letters.H(robot, joint.index), f"H{joint.index}") for joint in robot.joints]
        case Stage.ENERGY:
            return _of_bodies(robot)
        case Stage.LAGRANGIAN:
            return [(letters.K, "K"), (letters.P, "P")]
        case Stage.TORQUE:
            return [(letters.L, "L")]
        case Stage.VECTORIZED:
            return [(letters.force(q), f"tau{q.index}") for q in robot.coordinates]
    question = stage.part("explain")
    return question.inputs(context) if hasattr(question, "inputs") else []


def _of_bodies(robot: Robot) -> Iterator[tuple[Node, str]]:
    for body in robot.bodies:
        yield letters.rc(body), f"rc{body.name}"
        if not body.is_point:
            yield letters.base_tensor(letters.index_of(body.name)), f"I{body.name}"


# -- what to do ------------------------------------------------------------------------------------


def _tasks(context: Context, stage: Stage) -> Iterator[Block]:
    """The steps of a stage, those that are done in the same way as one."""
    alike: dict[tuple[str, str], list[Step]] = {}
    for step in explain(context, [stage]):
        if step.is_task:
            words = "".join(part for part in step.hint or step.why if isinstance(part, str))
            key = re.sub(r"\d+", "", step.id), re.sub(r"\d+", "", words)
            alike.setdefault(key, []).append(step)
    for number, (step, *others) in enumerate(alike.values(), start=1):
        why, formula = step.hint or step.why, step.task or step.formula
        blocks: list[Block] = [Text(why)] if why else []
        if formula is not None and to_unicode(formula) not in map(to_unicode, step.result):
            blocks.append(Formula(formula, by_itself(step.source)))
        if others:
            titles = [_title(other) for other in others]
            lowered = (title[0].lower() + title[1:] if title[1:2].islower() else title for title in titles)
            blocks.append(Text((f"Likewise: {'; '.join(lowered)}.",)))
        yield Fold(f"{number}. {_title(step)}", tuple(blocks))


def _title(step: Step) -> str:
    return step.hint_title or step.title


# -- the most frequent mistakes of a stage that can be made with this robot ------------------------

PITFALLS = {
    Stage.KINEMATICS: """
        The angle of row {row} is {angle}: its sine and cosine are those of the whole angle, not of the
            variable alone.
        modified? The table is in Craig's convention: α and a of a row come first, then θ and d. Do not take
            the general matrix of the standard convention.
        {fixed}: a frame without a variable still is a matrix in the product.
        chain? The matrices do not commute: A₁ stands on the left.
    """,
    Stage.JACOBIAN: """
        standard? Joint i moves about or along the axis of the frame before it, $𝐳_0$ for the first one:
            take the third column of H with index i-1, not i.
        modified? In Craig's convention joint i moves about or along the axis of its own frame: take the
            third column of H with index i.
        {lengths} no cross product, and zero in the angular part.
        turning? The cross product is not symmetric: the axis comes first, the vector from it second.
        coupled? Not every joint variable here is a coordinate itself: the column of a joint counts for each
            coordinate in it, times the factor with which that stands in the table.
        fixed? A fixed row has no column of its own.
    """,
    Stage.INERTIA: """
        The mass centre is not the origin of the frame: that holds for {off}.
        No tensor and no R are needed of {points}: a point has no extent.
        The tensor of {moved} is not given about the mass centre. On the way there the parallel-axis term is
            subtracted.
        The frame of a body is the one {own} it, which is fixed in the same link, not the one {other}.
        extended? In R I Rᵀ the transpose stands on the right: R turns the body's axes into the base's.
    """,
    Stage.ENERGY: """
        weightless? There is no gravity in this problem.
        weighs? Heights are those of the mass centres, from the origin of the {ground}.
        Joints after its link do not move a body: their columns are zero, for {inner}.
        off? The Jacobian of a body is taken at its mass centre, not at the origin of its frame.
        Sum of squares: $sin² {angle_1} + cos² {angle_1} = 1$. The difference, $cos² {angle_1} -
            sin² {angle_1}$, is something else: the cosine of twice the angle.
        A point has no tensor, and so no rotational energy: that holds for {points}.
        extended? $𝛚$ and the tensor must be in the same frame.
        {of_stored}
        geared? The ratio of a gear is squared with the rate: the rotor turns that much faster.
        carried? A rotor that rides on a link turns with the link, too: add the rates before you square.
    """,
    Stage.LAGRANGIAN: """
        The difference of the energies, not their sum: every term of the potential energy changes its sign.
    """,
    Stage.TORQUE: """
        One equation for each coordinate, not for each mass.
        With respect to time everything that moves is differentiated: {coordinates} and their rates. Masses
            and constant lengths stay as they are.
        In the partial derivatives a coordinate and its rate are different variables.
        What drives {turning} is a torque; what drives {sliding} a force.
        turning? The derivative of a sine or cosine of an angle that moves brings its rate: the chain rule.
        friction? Friction does not follow from ℒ: add it to each equation, with a plus.
    """,
    Stage.VECTORIZED: """
        several? $𝐃$ is symmetric. If yours is not, look for the slip in the forces.
        several? The rates stay inside C: each of its terms holds one rate, each term of $𝐂 𝐪̇$ two.
        several? A product of two different rates comes from two entries of C: half of its factor goes to
            each.
        Do not forget the ½ of the Christoffel symbols.
        weighs? $𝐠$ holds no rates and no accelerations, and its sign is that of the derivatives of $𝒫$.
    """,
}
"""What goes wrong most often.  One that begins with `name?` holds where the robot has that, and one with
values in braces where it has these (`_facts`)."""


def pitfalls(robot: Robot, stage: Stage) -> Iterator[Prose]:
    """The pitfalls of a stage that this robot has."""
    question = stage.part("explain")
    told = getattr(question, "PITFALLS", "") if question else PITFALLS[stage]
    facts = _facts(robot) | (question.facts(robot) if hasattr(question, "facts") else {})
    for line in re.sub(r"\n {4}", " ", dedent(told)).strip().splitlines():
        text = re.sub(r"^(\w+\? )?", "", line)
        if all(facts[name] for name in re.findall(r"(\w+)(?=\? |\})", line)):
            yield say(text, **facts)


def _facts(robot: Robot) -> dict[str, Value]:
    """What pitfalls are about: sentences and conditions; what is empty the robot does not have."""
    return {**_of_joints(robot), **_of_masses(robot)}


def _of_joints(robot: Robot) -> dict[str, Value]:
    joints, standard = robot.joints, robot.convention is Convention.STANDARD
    turning, sliding = (
        [Symbol(q.name) for q in robot.coordinates if q.type is kind]
        for kind in (JointType.REVOLUTE, JointType.PRISMATIC)
    )
    shifted = [joint for joint in joints if joint.variable == "theta" and joint.theta.degrees % 360][:1]
    fixed = [str(joint.index) for joint in joints if joint.type is None]
    are_lengths = " is a length: its column has" if len(sliding) == 1 else " are lengths: their columns have"
    return {
        "slides": any(joint.variable == "d" for joint in joints),
        "row": "".join(str(joint.index) for joint in shifted),
        "angle": tuple(joint.written[0] for joint in shifted),
        "standard": standard,
        "modified": not standard,
        "fixed": f"{'Row' if len(fixed) == 1 else 'Rows'} {', '.join(fixed)}" if fixed else "",
        "chain": len(joints) > 1,
        "turning": listed(turning),
        "angle_1": turning[0] if turning else "",
        "sliding": listed(sliding),
        "lengths": (*listed(sliding), are_lengths) if sliding else (),
        "coordinates": listed([Symbol(q.name) for q in robot.coordinates]),
        "several": robot.n > 1,
        "coupled": any(len(joint.rates) > 1 or any(rate != 1 for _, rate in joint.rates) for joint in joints),
    }


def _of_masses(robot: Robot) -> dict[str, Value]:
    bodies, actions = robot.bodies, robot.actions
    points = [body for body in bodies if body.is_point]
    extended = [body for body in bodies if not body.is_point]
    last = max((joint.index for joint in robot.joints), default=0)
    in_world = letters.has_base(robot) or not robot.has_table
    own, other = ("after", "before") if robot.convention is Convention.STANDARD else ("before", "after")
    has_own_frames = robot.has_table and any(body.axes.kind is AxesKind.LINK for body in extended)
    return {
        "off": _called(body for body in bodies if not body.center.is_zero and robot.has_table),
        "points": _called(points),
        "extended": _called(extended),
        "moved": _called(b for b in extended if b.about_point is not None and b.about_point != b.center),
        "inner": _called(body for body in bodies if body.link < last),
        "own": has_own_frames and own,
        "other": other,
        "weightless": robot.gravity.is_zero,
        "weighs": not robot.gravity.is_zero,
        "ground": "world" if in_world else "base, against gravity",
        "of_stored": said_of_laws(robot, "PITFALL"),
        "geared": any(rotor.ratio != robot.ring.one for rotor in actions.rotors),
        "carried": any(rotor.carrier for rotor in actions.rotors),
        "friction": bool(actions.resisting),
        "passive": bool(actions.passive),
    }


def _called(bodies: Iterable[Body]) -> str:
    """bodies 1 and 2; nothing of none"""
    names = [body.name for body in bodies]
    return f"{'body' if len(names) == 1 else 'bodies'} {and_joined(names)}" if names else ""
