"""Hints: the tasks of a stage, without its results.

A hint is made of the steps of the stage, their reasons and formulas, of what earlier
stages have given, and of the pitfalls that this robot has.  Nothing that the stage or
a later one finds is shown: a step whose reason tells something of its result has a
`hint` to be said instead.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from dynsolve.document import Block, Document, Fold, Formula, Heading, List, Prose, Table, Text
from dynsolve.errors import UsageError
from dynsolve.explain import explain
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import and_joined, by_itself, is_small, listed
from dynsolve.notation.tree import Function, Negative, Node, Number, Power, Product, Sum, Symbol, equation
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import kinematic_families, letters
from dynsolve.quantities.index import quantities
from dynsolve.quantities.robot_stages import stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import AxesKind, Body, Convention, JointType, Robot


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


# -- the most frequent mistakes of a stage that can be made with this robot ------------------------
# To add a pitfall, yield it in the function of its stage, under the condition on the
# robot that makes it one.


def pitfalls(robot: Robot, stage: Stage) -> Iterator[Prose]:
    """The pitfalls of a stage that this robot has."""
    yield from _PITFALLS[stage](robot)


def _kinematics(robot: Robot) -> Iterator[Prose]:
    for joint in robot.joints:
        if joint.variable == "theta" and joint.theta.degrees % 360:
            yield (
                f"The angle of row {joint.index} is ", joint.written[0],
                ": its sine and cosine are those of the whole angle, not of the variable alone.",
            )  # fmt: skip
            break
    if robot.convention is Convention.MODIFIED:
        yield (
            "The table is in Craig's convention: α and a of a row come first, then θ and d. Do not take the "
            "general matrix of the standard convention.",
        )
    fixed = [str(joint.index) for joint in robot.joints if joint.type is None]
    if fixed:
        rows = "Row " if len(fixed) == 1 else "Rows "
        yield (f"{rows}{', '.join(fixed)}: a frame without a variable still is a matrix in the product.",)
    if len(robot.joints) > 1:
        yield ("The matrices do not commute: A₁ stands on the left.",)


def _jacobian(robot: Robot) -> Iterator[Prose]:
    if robot.convention is Convention.STANDARD:
        yield ("Joint i moves about or along the axis of the frame before it, ", letters.z(0),
               " for the first one: take the third column of H with index i-1, not i.")  # fmt: skip
    else:
        yield ("In Craig's convention joint i moves about or along the axis of its own frame: take the third "
               "column of H with index i.",)  # fmt: skip
    sliding = _of_type(robot, JointType.PRISMATIC)
    if sliding:
        what = " is a length: its column has" if len(sliding) == 1 else " are lengths: their columns have"
        yield (*listed(sliding), f"{what} no cross product, and zero in the angular part.")
    if _of_type(robot, JointType.REVOLUTE):
        yield ("The cross product is not symmetric: the axis comes first, the vector from it second.",)
    if any(len(joint.rates) > 1 or any(rate != 1 for _, rate in joint.rates) for joint in robot.joints):
        yield (
            "Not every joint variable here is a coordinate itself: the column of a joint counts for each "
            "coordinate in it, times the factor with which that stands in the table.",
        )
    fixed = [joint for joint in robot.joints if joint.type is None]
    if fixed:
        yield ("A fixed row has no column of its own.",)


def _task(robot: Robot) -> Iterator[Prose]:
    asked = robot.questions
    last = max((joint.index for joint in robot.joints if joint.type), default=0)
    inner = [point.name for point in asked.points if point.link < last]
    if inner:
        yield (
            "Joints after its link do not move a point: their columns are zero, for ",
            and_joined(inner),
            ".",
        )
    if asked.task is not None and asked.task.rows != robot.n:
        rows, columns = asked.task.rows, robot.n
        yield (letters.J_TASK, f" has a row a component and a column a coordinate: {rows}×{columns} here.")
    if any(name.endswith("_dot") for name in asked.asked):
        yield (
            "In the time derivative every joint variable of an entry moves: one term for each, with its "
            "rate.",
        )


def _rates(robot: Robot) -> Iterator[Prose]:
    yield ("Where the Jacobian is singular it has no inverse: look at its rank at this state first.",)
    if robot.questions.acceleration is not None:
        yield ("The acceleration of the task is not ", Product((letters.J_TASK, letters.QDD)),
               " alone: what the joints' rates bring is taken off before anything is solved.")  # fmt: skip


def _inertia(robot: Robot) -> Iterator[Prose]:
    off = [body for body in robot.bodies if not body.center.is_zero and robot.has_table]
    if off:
        yield ("The mass centre is not the origin of the frame: that holds for ", *_bodies(off), ".")
    points = [body for body in robot.bodies if body.is_point]
    if points:
        yield ("No tensor and no R are needed of ", *_bodies(points), ": a point has no extent.")
    extended = [body for body in robot.bodies if not body.is_point]
    moved = [b for b in extended if b.about_point is not None and b.about_point != b.center]
    if moved:
        yield (
            "The tensor of ",
            *_bodies(moved),
            " is not given about the mass centre. On the way there the parallel-axis term is subtracted.",
        )
    if robot.has_table and any(body.axes.kind is AxesKind.LINK for body in extended):
        standard = robot.convention is Convention.STANDARD
        own, other = ("after", "before") if standard else ("before", "after")
        yield (
            f"The frame of a body is the one {own} it, which is fixed in the same link, not the one {other}.",
        )
    if extended:
        yield ("In R I Rᵀ the transpose stands on the right: R turns the body's axes into the base's.",)


def _energy(robot: Robot) -> Iterator[Prose]:
    if robot.gravity.is_zero:
        yield ("There is no gravity in this problem.",)
    else:
        in_world = letters.has_base(robot) or not robot.has_table
        yield ("Heights are those of the mass centres, from the origin of the ",
               "world." if in_world else "base, against gravity.")  # fmt: skip
    last = max((joint.index for joint in robot.joints), default=0)
    inner = [body for body in robot.bodies if body.link < last]
    if inner:
        yield ("Joints after its link do not move a body: their columns are zero, for ", *_bodies(inner), ".")
    if robot.has_table and any(not body.center.is_zero for body in robot.bodies):
        yield ("The Jacobian of a body is taken at its mass centre, not at the origin of its frame.",)
    turning = _of_type(robot, JointType.REVOLUTE)
    if turning:
        squares = tuple(Power(Function(name, turning[0]), Number(2)) for name in ("sin", "cos"))
        yield (
            "Sum of squares: ",
            equation(Sum(squares), Number(1)),
            ". The difference, ",
            Sum((squares[1], Negative(squares[0]))),
            ", is something else: the cosine of twice the angle.",
        )
    points = [body for body in robot.bodies if body.is_point]
    if points:
        yield ("A point has no tensor, and so no rotational energy: that holds for ", *_bodies(points), ".")
    if len(points) < len(robot.bodies):
        yield (letters.bold("omega"), " and the tensor must be in the same frame.")
    if any(spring.law for spring in robot.actions.springs):
        yield ("The energy of a spring has a ½, and the stretch is squared as a whole, with its rest.",)
    if any(motor.ratio != robot.ring.one for motor in robot.actions.motors):
        yield ("The ratio of a gear is squared with the rate: the rotor turns that much faster.",)
    if any(motor.carrier for motor in robot.actions.motors):
        yield ("A rotor that rides on a link turns with the link, too: add the rates before you square.",)


def _lagrangian(robot: Robot) -> Iterator[Prose]:
    yield (
        "The difference of the energies, not their sum: every term of the potential energy changes its sign.",
    )


def _torque(robot: Robot) -> Iterator[Prose]:
    yield ("One equation for each coordinate, not for each mass.",)
    yield ("With respect to time everything that moves is differentiated: ",
           *listed([Symbol(q.name) for q in robot.coordinates]), " and their rates.",
           " Masses and constant lengths stay as they are.")  # fmt: skip
    yield ("In the partial derivatives a coordinate and its rate are different variables.",)
    turning, sliding = _of_type(robot, JointType.REVOLUTE), _of_type(robot, JointType.PRISMATIC)
    if turning and sliding:
        yield ("What drives ", *listed(turning), " is a torque; what drives ", *listed(sliding), " a force.")
    if turning:
        yield ("The derivative of a sine or cosine of an angle that moves brings its rate: the chain rule.",)
    if "friction" in robot.actions.kinds:
        yield ("Friction does not follow from ℒ: add it to each equation, with a plus.",)


def _vectorized(robot: Robot) -> Iterator[Prose]:
    if robot.n > 1:
        yield (
            letters.D,
            " is symmetric. If yours is not, look for the slip in the forces.",
        )
        yield ("The rates stay inside C: each of its terms holds one rate, each term of ",
               Product((letters.C, letters.QD)), " two.")  # fmt: skip
        yield (
            "A product of two different rates comes from two entries of C: half of its factor goes to each.",
        )
    yield ("Do not forget the ½ of the Christoffel symbols.",)
    if not robot.gravity.is_zero:
        yield (
            letters.G,
            " holds no rates and no accelerations, and its sign is that of the derivatives of ",
            letters.P,
            ".",
        )


def _singular(robot: Robot) -> Iterator[Prose]:
    yield ("Write the determinant as a product before you look for its zeros: each factor is a case.",)
    if not robot.questions.task or robot.questions.task.is_default:
        yield ("The first joint moves the whole arm and changes no rank: it appears in no condition.",)


def _inverse(robot: Robot) -> Iterator[Prose]:
    if _of_type(robot, JointType.REVOLUTE):
        yield ("A cosine or a sine alone leaves two angles, and each is a branch of its own.",)
        yield ("atan2 takes y first, and knows all four quadrants; arctan(y/x) knows two.",)
    yield (
        "Put each solution into ",
        letters.TASK_OF_Q,
        ": what was squared on the way may have brought one too many.",
    )


def _parameters(robot: Robot) -> Iterator[Prose]:
    yield (
        "Multiply the forces out first: what stands beside one function of the motion is one coefficient.",
    )
    yield ("Coefficients that are sums of others need no entry of their own.",)
    yield ("Y contains no parameter that is unknown, and a nothing that moves.",)


def _equilibria(robot: Robot) -> Iterator[Prose]:
    asked = robot.questions.asked
    if "equilibria" in asked:
        yield ("A product is 0 where any of its factors is: every choice is a case of its own.",)
        if _of_type(robot, JointType.REVOLUTE):
            yield ("A sine or a cosine has each of its values at two angles of a turn, but 1 and -1.",)
        if robot.questions.model.steady:
            yield ("The rates that are constant stay in the equations of the others.",)
    if asked.isdisjoint(("linear_A", "linear_B")):
        return
    yield ("Differentiate first, then put the equilibrium in.",)
    yield (
        "The inverse of ",
        letters.D,
        " stands before the derivatives of ",
        letters.G,
        ", with a minus sign.",
    )
    if robot.actions.passive:
        yield ("What no motor drives has no column in B, but its row stays.",)


def _forward_dynamics(robot: Robot) -> Iterator[Prose]:
    yield (
        "The inverse of ",
        letters.D,
        " stands before the whole sum of forces, from the left.",
    )
    yield ("What stands beside the inertial forces, on their side, goes over with a minus sign.",)
    if robot.actions.passive:
        yield ("What no motor drives is accelerated, too: its force is 0, and its row stays.",)


def _task_inertia(robot: Robot) -> Iterator[Prose]:
    yield ("Where the Jacobian is not square only the whole product has an inverse.",)
    yield (
        "Where the Jacobian is square its inverse stands on the right, the transpose of that on the left.",
    )


def _statics(robot: Robot) -> Iterator[Prose]:
    yield (
        "The Jacobian is that of the point at which the force acts, and its transpose stands before the "
        "force.",
    )
    loads = robot.questions.loads
    if any(not load.moment.is_zero for load in loads):
        yield ("A moment goes to the joints by the angular part of the Jacobian.",)
    if any(load.by_robot for load in loads):
        yield ("What the robot exerts acts on it with the opposite sign.",)
    if "tau_static" in robot.questions.asked:
        yield ("The torques that hold a force are the opposite of what the force does to the joints.",)


def _definite(robot: Robot) -> Iterator[Prose]:
    yield ("A positive determinant alone is not enough: every leading minor must be positive.",)
    yield ("Take each minor where it is smallest: its sines and cosines may be 0, 1 and -1 there.",)


def _of_type(robot: Robot, kind: JointType) -> list[Node]:
    return [Symbol(q.name) for q in robot.coordinates if q.type is kind]


def _bodies(bodies: Sequence[Body]) -> Prose:
    names = [body.name for body in bodies]
    return (("body " if len(names) == 1 else "bodies ") + and_joined(names),)


def _frames(robot: Robot) -> Iterator[Prose]:
    yield ("d is measured along z, the axis of a joint, and a across it, along x.",)
    yield ("Every angle has a sense: θ is seen against z, α against x, counterclockwise.",)
    if any(joint.variable == "d" for joint in robot.joints):
        yield ("The axis of a sliding joint has a direction and no place: lay it where lengths vanish.",)
    yield ("A z may also point the other way, and frame 0 be anywhere on the first axis.",)


def _newton_euler(robot: Robot) -> Iterator[Prose]:
    yield ("Every vector has its components along the axes of its own link: what comes from another link is "
           "turned first, outwards by the transpose of the rotation, inwards by the rotation.",)  # fmt: skip
    if robot.convention is Convention.STANDARD:
        yield ("The axis of joint i is that of frame i-1, turned into frame i: it is the third row of the "
               "rotation, and not (0, 0, 1).",)  # fmt: skip
        yield ("The moment is about the origin before the link: the lever of the mass centre starts there.",)
    if _of_type(robot, JointType.PRISMATIC):
        yield ("A joint that slides on a turning link adds twice ω × the velocity, besides its own "
               "acceleration.",)  # fmt: skip


def _constraints(robot: Robot) -> Iterator[Prose]:
    yield ("The matrix moves: the constraint, differentiated twice, has a term with its rate, too.",)
    yield ("Neither the coordinates nor the rates are free: results may be written otherwise with the "
           "constraint put in.",)  # fmt: skip


_PITFALLS: Mapping[Stage, Callable[[Robot], Iterator[Prose]]] = {
    Stage.FRAMES: _frames,
    Stage.KINEMATICS: _kinematics,
    Stage.JACOBIAN: _jacobian,
    Stage.TASK: _task,
    Stage.SINGULAR: _singular,
    Stage.INVERSE: _inverse,
    Stage.RATES: _rates,
    Stage.INERTIA: _inertia,
    Stage.ENERGY: _energy,
    Stage.LAGRANGIAN: _lagrangian,
    Stage.TORQUE: _torque,
    Stage.NEWTON_EULER: _newton_euler,
    Stage.VECTORIZED: _vectorized,
    Stage.PARAMETERS: _parameters,
    Stage.CONSTRAINTS: _constraints,
    Stage.EQUILIBRIA: _equilibria,
    Stage.FORWARD_DYNAMICS: _forward_dynamics,
    Stage.TASK_INERTIA: _task_inertia,
    Stage.STATICS: _statics,
    Stage.DEFINITE: _definite,
}
