"""What is given without a table, and what an exercise gives around a model, in words and formulas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import chain

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose
from dynsolve.explain.actions import leads_with_minus
from dynsolve.explain.forms import Forms
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.explain.parameter_meanings import roles
from dynsolve.explain.placed_bodies import turned
from dynsolve.explain.task import with_letters
from dynsolve.explain.writing import and_joined, listed, measured, name_of, side_by_side
from dynsolve.notation.tree import (
    ZERO,
    Letter,
    Negative,
    Node,
    Number,
    Relation,
    Row,
    Symbol,
    Words,
    equation,
)
from dynsolve.notation.walk import mapped
from dynsolve.quantities import letters
from dynsolve.robot import units
from dynsolve.robot.actions import JointFriction, Motor, Spring
from dynsolve.robot.drawing.procedure import Normals
from dynsolve.robot.mechanism import GivenModel
from dynsolve.robot.model import Body, JointType, Robot
from dynsolve.robot.questions import TIP, Load
from dynsolve.robot.shapes import AXES

# -- what stands in the place of a table -----------------------------------------------------------


def of_axes(normals: Normals) -> Iterator[Prose]:
    """The axes of a drawing and its hand."""
    drawing = normals.drawing
    form = Compactor(drawing.ring).form
    for i, axis in enumerate(drawing.axes, 1):
        told: Prose = (f"Joint {i}, with the variable ", Symbol(axis.coordinate))
        told += (", slides along " if axis.slides else ", turns about ", _row(form, axis.line.direction))
        told += (" through ", _row(form, axis.line.point)) if axis.is_placed else ()
        yield (*told, ".")
    yield ("In this pose the hand is at ", _row(form, drawing.hand.at), ".")


def _row(form: Callable[[Expr], Node], vector: algebra.Matrix) -> Node:
    """(0, 0, 1)"""
    return _flat(map(form, vector.entries))


def of_model(forms: Forms) -> Iterator[Prose]:
    """The bodies by their positions, or the energies, the Lagrangian or the inertia matrix."""
    robot = forms.robot
    if robot.given is not None:
        yield from _of_energies(forms, robot.given)
    elif not robot.has_table:
        yield from (_of_position(forms, body) for body in robot.bodies)
    for candidate in robot.questions.candidates:
        if robot.given is None:
            yield (equation(Symbol(candidate.name), forms.of(candidate.matrix)), ".")


def _of_energies(forms: Forms, given: GivenModel) -> Iterator[Prose]:
    energies = ((letters.K, given.K), (letters.P, given.P), (letters.L, given.L))
    for letter, value in ((letters.D, given.D), *energies):
        if value is not None:
            yield (equation(letter, forms.of(value)), ".")


def _of_position(forms: Forms, body: Body) -> Prose:
    """Body 2, a point of mass m, is at (x + l sin θ, l cos θ, 0)."""
    told: Prose = (f"{name_of(body).capitalize()}, ", "a point " if body.is_point else "")
    told += ("of mass ", measured(forms.of(body.mass), "kg"), ", is at ", _row(forms.of, body.center), ".")
    if body.inertia is None:
        return told
    axes: dict[Expr, list[str]] = {}
    for i, axis in enumerate("xyz"):
        if not body.inertia[i, i].is_zero:
            axes.setdefault(body.inertia[i, i], []).append(axis)
    moments: Prose = ()
    for value, alike in axes.items():
        about = f"axis {alike[0]}" if len(alike) == 1 else f"axes {and_joined(alike)}"
        moments += (f" Its moment of inertia about {about} through its mass centre is ",)
        moments += (measured(forms.of(value), "kg m^2"), ".")
    return (*told, " ", *turned(body), *moments)


# -- what is asked around the model ----------------------------------------------------------------


def of_questions(forms: Forms) -> Iterator[Prose]:
    """Constraints, task, target, state, forces from outside, limits and assumptions."""
    questions = forms.robot.questions
    for constraint in questions.constraints:
        yield ("Every motion keeps ", equation(mapped(constraint.entry, with_letters), ZERO), ".")
    if questions.task is not None and questions.task.entries and not questions.task.is_default:
        entries = (mapped(entry, with_letters) for entry in questions.task.entries)
        yield ("The task is ", equation(letters.TASK, _flat(entries)), ".")
    if questions.target is not None:
        yield ("To be reached: ", equation(letters.TASK, _flat(questions.target.values)), ".")
    for letter, value in ((_VELOCITY, questions.velocity), (_ACCELERATION, questions.acceleration)):
        if value is not None:
            yield (equation(letter, _flat(map(forms.of, value.entries))), ".")
    yield from (_of_load(forms, load) for load in questions.loads)
    for limits in questions.limits:
        yield (Relation((limits.low, Symbol(limits.coordinate), limits.high), ("≤", "≤")), ".")
    model = questions.model
    given = (("The state: ", questions.state.values), ("The equilibrium: ", model.linearize))
    for what, values in given:
        shown = [equation(Symbol(name, dots), value) for name, dots, value in values]
        if shown and not questions.state_is_reached:
            yield (what, side_by_side(shown), ".")
    if questions.state_is_reached:
        yield ("The state is the configuration within these limits that reaches it.",)
    assumed = [bound for one in questions.candidates for bound in one.assumed]
    assumed = list(dict.fromkeys((*questions.model.assumed, *assumed)))
    if assumed:
        written = ConfigurationForms(forms.robot, forms.values)
        yield ("Assumed: ", *listed([written.inequality(bound) for bound in assumed]), ".")


_VELOCITY = letters.rate(letters.TASK)
_ACCELERATION = letters.rate(_VELOCITY)


def _flat(entries: Iterable[Node]) -> Node:
    """(v_x, v_y): a column as a line of text can hold it."""
    return Row((Words("("), side_by_side(list(entries)), Words(")")))


def _of_load(forms: Forms, load: Load) -> Prose:
    """A force F acts on link 2 at the tip."""
    where = "the tip" if load.point == TIP else load.point or "a given point"
    along = f" along the axes of frame {load.link} turned as given" if load.axes is not None else ""
    told: list[Prose] = [
        (what, _row(forms.of, value))
        for what, value in (("the force ", load.force), ("the moment ", load.moment))
        if not value.is_zero
    ]
    acting: Prose = tuple(part for each in told for part in (*each, " and "))[:-1]
    return (f"On link {load.link} acts at {where} ", *acting, f"{along}.")


# -- what is given of springs, dampers, friction, rotors and passive coordinates, in words ---------


def of_actions(forms: Forms) -> Iterator[Prose]:
    """A sentence for each thing that acts beside gravity."""
    actions = forms.robot.actions
    yield from (_spring(forms, spring) for spring in actions.springs)
    for damper in actions.dampers:
        yield ("A damper of coefficient ", forms.of(damper.damping), " acts along ", forms.of(damper.of), ".")
    yield from (_friction(forms, friction) for friction in actions.friction)
    yield from (_motor(forms, motor) for motor in actions.motors)
    passive = [_coordinate(forms, k) for k in actions.passive]
    if passive:
        yield ("No motor drives ", *listed(passive), ".")


def _coordinate(forms: Forms, k: int) -> Symbol:
    return Symbol(forms.robot.coordinates[k].name)


def _spring(forms: Forms, spring: Spring) -> Prose:
    """A spring of stiffness k acts along q₁ - q₂ and is at rest where this is 0."""
    if spring.law is None:
        return ("A spring has the potential energy ", forms.of(spring.energy), ".")
    stiffness, along = (forms.of(value) for value in (spring.law.stiffness, spring.law.of))
    at_rest = equation(along, forms.of(spring.law.rest))
    return ("A spring of stiffness ", stiffness, " is at rest at ", at_rest, ".")


def _friction(forms: Forms, friction: JointFriction) -> Prose:
    """On q₁ acts viscous friction of coefficient f_v and Coulomb friction of coefficient f_c."""
    kinds = (("viscous", friction.viscous), ("Coulomb", friction.coulomb))
    there: list[Prose] = [
        (f"{kind} friction of coefficient ", forms.of(value)) for kind, value in kinds if not value.is_zero
    ]
    what = there[0] if len(there) == 1 else (*there[0], " and ", *there[1])
    return ("On ", _coordinate(forms, friction.coordinate), " acts ", *what, ".")


def _motor(forms: Forms, motor: Motor) -> Prose:
    """The rotor that turns q₂ has the moment of inertia I_m2 and the gear ratio k_r2; link 1 carries it."""
    told: Prose = ("The rotor that drives ", _coordinate(forms, motor.turns), " has the moment of inertia ")
    told += (measured(forms.of(motor.inertia), "kg m^2"),)
    if motor.ratio != forms.robot.ring.one:
        told += (" and the gear ratio ", forms.of(motor.ratio))
    if motor.carrier:
        axis = Letter(AXES[motor.axis], Number(motor.carrier), style="bold")
        told += ("; it spins about ", axis, f" and is carried by link {motor.carrier}")
    return (*told, ".")


# -- what an exercise takes for granted and its solution rests on: its joints, gravity, friction, values
# A drawing or the text of an exercise says it; here it is said in the words of the problem file.

_KINDS = {JointType.REVOLUTE: "revolute", JointType.PRISMATIC: "prismatic"}

# -- the joints ------------------------------------------------------------------------------------


def joints(robot: Robot) -> str:
    """with revolute joints; with a revolute and a prismatic joint; nothing of a table without joints."""
    types = [joint.type for joint in robot.joints if joint.type]
    found = [word for kind, word in _KINDS.items() if kind in types]
    if len(types) == len(found):
        return f" with {' and '.join(f'a {word}' for word in found)} joint" if found else ""
    return f" with {' and '.join(found)} joints"


# -- the base --------------------------------------------------------------------------------------


def of_base(forms: Forms) -> Prose:
    """Frame 0 is moved by h₀ along 𝐳_w and turned by 30° about 𝐱_w; nothing where it is the world."""
    robot = forms.robot
    if not letters.has_base(robot):
        return ()
    moves = zip("xyz", robot.base_position.entries, strict=True)
    told: list[tuple[str, Prose]] = [
        ("moved ", ("by ", measured(forms.of(far), "m"), " along ", _of_world(axis)))
        for axis, far in moves
        if not far.is_zero
    ]
    told += [("turned ", ("by ", angle, " about ", _of_world(axis))) for axis, angle in robot.base_turns]
    turned = robot.base_rotation != robot.base_rotation.identity(robot.ring, 3)
    if len(told) > 2 or (turned and not robot.base_turns):
        return ("How frame 0 is placed in the world is given (1.2). ",)
    (first, how), *others = told
    rest: Prose = ()
    for verb, by in others:
        rest += (" and ", *((verb,) if verb != first else ()), *by)
    return ("Frame 0 is ", first, *how, *rest, " in the world w. ")


def _of_world(axis: str) -> Node:
    """𝐳_w"""
    return letters.bold(axis, Words("w"))


# -- what acts -------------------------------------------------------------------------------------


def of_forces(forms: Forms) -> Prose:
    """Gravity g acts along -𝐲₀, and there is no friction; what else the problem gives."""
    told = _gravity(forms)
    if "friction" not in forms.robot.actions.kinds:
        told += (" and no friction." if forms.robot.gravity.is_zero else "; there is no friction.",)
    else:
        told += (".",)
    return tuple(chain(told, *((" ", *each) for each in of_actions(forms))))


def _gravity(forms: Forms) -> Prose:
    robot = forms.robot
    entries = zip("xyz", robot.gravity.entries, strict=True)
    along = [(axis, entry) for axis, entry in entries if not entry.is_zero]
    if not along:
        return ("There is no gravity",)
    if len(along) > 1:
        return (letters.GRAVITY, ", the acceleration of gravity, is along no axis of ", _ground(robot))
    ((axis, entry),) = along
    opposite = leads_with_minus(entry)
    size = -entry if opposite else entry
    unit = _of_world(axis) if letters.has_base(robot) else Letter(axis, Number(0), style="bold")
    named: Prose = (", ", measured(forms.of(size), "m/s²"), ",") if size.is_number else (" ", forms.of(size))
    return ("Gravity", *named, " acts along ", Negative(unit) if opposite else unit)


def _ground(robot: Robot) -> str:
    return "the world" if letters.has_base(robot) else "frame 0"


# -- numbers ---------------------------------------------------------------------------------------


def of_values(robot: Robot, written: Mapping[str, str], own_units: Mapping[str, str]) -> Prose:
    """In numbers: a₂ = 0.4318 m; nothing where the problem has no values."""
    known = {name: unit for name, (_, unit) in roles(robot).items()}
    given: list[Prose] = []
    for name, text in written.items():
        unit = own_units.get(name, known.get(name, ""))
        value = text.replace(" deg", "°").replace("deg", "°")
        measured = (" ", units.node(unit)) if unit and not value.endswith("°") else ()
        given.append((equation(Symbol(name), Words(value)), *measured))
    return (" In numbers: ", *listed(given), ".") if given else ()
