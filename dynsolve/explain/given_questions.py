"""What is given without a table, and what an exercise gives around a model, in words and formulas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose
from dynsolve.explain.configurations import ConfigurationForms
from dynsolve.explain.forms import Forms
from dynsolve.explain.placed_bodies import turned
from dynsolve.explain.task import with_letters
from dynsolve.explain.writing import and_joined, listed, measured, name_of, side_by_side
from dynsolve.notation.tree import (
    ZERO,
    Node,
    Relation,
    Row,
    Symbol,
    Words,
    equation,
)
from dynsolve.notation.walk import mapped
from dynsolve.quantities import letters
from dynsolve.robot.drawing.procedure import Normals
from dynsolve.robot.mechanism import GivenModel
from dynsolve.robot.model import Body
from dynsolve.robot.questions import TIP, Load

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
