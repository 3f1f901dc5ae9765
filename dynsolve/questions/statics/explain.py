"""Steps of the forces from outside: Q of each, their sum, and the torques that hold them."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import frame_names
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import Value, opened, say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.given import vector
from dynsolve.explain.kinematics import turned
from dynsolve.explain.step import NOTED, Detail, Group, Step
from dynsolve.explain.writing import agreeing, flat, is_small, listed, sum_of
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Negative, Node, Number, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.questions.rates.explain import state_prose
from dynsolve.questions.statics import derive as statics
from dynsolve.questions.statics.derive import jacobians
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, Load

HELD = Group("Q", "The sum, and what holds it")


_FORCES = spong("4.10")


def given(forms: Forms) -> Iterator[Prose]:
    """What acts from outside."""
    return (_acting(forms, load) for load in forms.robot.questions.loads)


def _acting(forms: Forms, load: Load) -> Prose:
    """The force (F, 0, 0) and the moment (0, 0, M) act on link 2 at the tip; or link 2 exerts them."""
    kinds = (("the force ", load.force, "N"), ("the moment ", load.moment, "N m"))
    acting = [(what, vector(forms, value.entries, unit)) for what, value, unit in kinds if not value.is_zero]
    at: Prose = (" at the tip",) if load.point == TIP else (" at ", load.point)
    if load.force.is_zero:
        at = ()
    elif not load.point and load.position.is_zero:
        at = (" at ", letters.o(load.link))
    elif not load.point:
        at = (" at ", flat(map(forms.of, load.position.entries)), f" in frame {load.link}")
    told = listed(acting)
    if load.by_robot:
        return (f"Link {load.link} exerts ", *told, *at, *_along(forms, load), ".")
    first, *others = told
    act = "act" if len(acting) > 1 else "acts"
    return (opened(str(first)), *others, f" {act} on link {load.link}", *at, *_along(forms, load), ".")


def _along(forms: Forms, load: Load) -> Prose:
    """Along the axes of which frame a force is given, and by what these are turned; nothing of the world."""
    if load.axes is None:
        return ()
    if load.turns:
        return (f", along the axes of frame {load.link} turned by ", turned(load.turns))
    if load.axes == Matrix.identity(load.axes.ring, 3):
        return (f", along the axes of frame {load.link}",)
    columns = [flat(map(forms.of, column)) for column in load.axes.T.rows]
    return (f", along axes that, seen from frame {load.link}, are ", *listed(columns))


def steps(context: Context) -> Iterator[Step]:
    """Force by force what it does to the joints, the sum, and what holds it at rest."""
    wanted = context.wanted
    for index, load in enumerate(context.robot.questions.loads, 1):
        if f"load{index}" in wanted:
            yield _load(context, index, load)
    questions = context.robot.questions
    if "Q" in wanted and (questions.loads or "Q" in questions.asked):
        yield replace(_total(context), group=HELD)
    if "tau_static" in wanted:
        yield replace(_holding(context), group=HELD if questions.loads else None)


def _load(context: Context, index: int, load: Load) -> Step:
    """Q_F = J_vᵀ F + J_ωᵀ M, of which one may be absent, from the power Fᵀ v + Mᵀ ω."""
    frames = tuple(context.values[name] for name in frame_names(load.link))
    wrench, of_point = statics.wrench(load, frames[load.link]), jacobians(context.robot, load, frames)
    parts = []
    for letter, velocity, value, jacobian in zip("FM", ("v", "omega"), wrench, of_point, strict=True):
        J = letters.JV if velocity == "v" else letters.JW
        if load.point != TIP:
            J = letters.j_of_point(velocity, load.point or f"F{index}")
        parts.append((letters.bold(letter, Number(index)), letters.bold(velocity), J, value, jacobian))
    if load.moment.is_zero:
        del parts[1]
    elif load.force.is_zero:
        del parts[0]
    Q, working, put_in = letters.of_load(index), list[Node](), list[Node]()
    for F, _, J, value, jacobian in parts:
        if not value.is_zero:
            put_in += [context.show(jacobian), context.show(value)]
            working += [equation(F, put_in[-1]), *([] if load.point else [equation(J, put_in[-2])])]
    if put_in and is_small(*put_in):
        pairs = zip(put_in[::2], put_in[1::2], strict=True)
        working.append(equation(Q, sum_of([formula("{J}ᵀ {F}", J=J, F=F) for J, F in pairs])))
    where = "the tip" if load.point == TIP else load.point or "its point"
    if load.force.is_zero:
        where = f"the angular velocity of link {load.link}"
    notes: tuple[Prose, ...] = ()
    if load.by_robot:
        notes = (("The robot exerts it, so what acts on the robot is its opposite.",),)
    if load.axes is not None:
        notes += (("It is given along axes of its link, and turned into the world.",),)
    return Step(
        id=f"load{index}",
        title=f"What {'moment' if load.force.is_zero else 'force'} {index} does to the joints",
        why=say(
            "In every motion its power is {power}, and that of its generalized forces ${Q}ᵀ 𝐪̇$: so the "
            "transpose of the Jacobian of {where} gives its effect on the joints.",
            power=sum_of([formula("{F}ᵀ {v}", F=F, v=v) for F, v, *_ in parts]),
            Q=Q,
            where=where,
        ),
        formula=equation(Q, sum_of([formula("{J}ᵀ {F}", J=J, F=F) for F, _, J, *_ in parts])),
        source=_FORCES,
        working=tuple(working),
        result=(equation(Q, context.form(f"load{index}")),),
        notes=notes,
        normal=NOTED,
    )


_COUNTED = ("No force acts from outside. ", "There is only one force. ", "The sum over the forces. ")


def _total(context: Context) -> Step:
    numbers = range(1, len(context.robot.questions.loads) + 1)
    general = statics.total(context.robot, tuple(context.values[f"load{i}"] for i in numbers))
    at, several = state_prose(context, with_rates=False), len(numbers) > 1
    return Step(
        id="Q",
        title="The generalized forces from outside",
        why=(_COUNTED[min(len(numbers), 2)], *at),
        formula=equation(letters.Q_FORCES, sum_of([*map(letters.of_load, numbers)])),
        source=_FORCES,
        working=(equation(letters.Q_FORCES, context.show(general)),) if at and several else (),
        result=(equation(letters.Q_FORCES, context.form("Q")),),
        detail=Detail.BRIEF,
    )


def _holding(context: Context) -> Step:
    robot, g = context.robot, context.form("g") if context.robot.bodies else None
    terms: list[Node] = []
    if g is not None and not context.values["g"].is_zero:
        terms.append(letters.G)
    if robot.questions.loads:
        terms.append(Negative(letters.Q_FORCES))
    passive = [q for q in robot.coordinates if q.index - 1 in robot.actions.passive]
    beside = ", beside the forces of the constraints" if robot.questions.constraints else ""
    return Step(
        id="tau_static",
        title="What holds it at rest",
        why=say(
            "At rest this is left of the equations of motion{beside}.{passive} {at}",
            beside=beside,
            passive=say(
                agreeing(" No motor drives {q}: its|their entry|entries must be 0.", len(passive)),
                q=listed([Symbol(q.name) for q in passive], "or"),
            )
            if passive and not beside
            else "",
            at="" if robot.questions.loads else state_prose(context, with_rates=False),
        ),
        formula=equation(letters.TAU_STATIC, sum_of(terms) if terms else Number(0)),
        source=_FORCES,
        working=(equation(letters.G, g),) if letters.G in terms and g is not None and is_small(g) else (),
        result=(equation(letters.TAU_STATIC, context.form("tau_static")),),
        detail=Detail.BRIEF,
    )


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the Jacobian of the last frame, and the frames:"

PITFALLS = """
    The Jacobian is that of the point at which the force acts, and its transpose stands before the force.
    moments? A moment goes to the joints by the angular part of the Jacobian.
    by_robot? What the robot exerts acts on it with the opposite sign.
    holds? The torques that hold a force are the opposite of what the force does to the joints.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    frames = [(letters.H(context.robot, joint.index), f"H{joint.index}") for joint in context.robot.joints]
    return [(letters.JV, "Jv"), (letters.JW, "Jw"), *frames]


def facts(robot: Robot) -> dict[str, Value]:
    """What its pitfalls are about."""
    loads = robot.questions.loads
    return {
        "moments": any(not load.moment.is_zero for load in loads),
        "by_robot": any(load.by_robot for load in loads),
        "holds": "tau_static" in robot.questions.asked,
    }
