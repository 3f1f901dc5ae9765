"""What is given, a line for each symbol with its unit, and what is to be found: the exercise."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from dynsolve.document import Block, Inline, List, Prose, Text
from dynsolve.explain import given_bodies, hypotheses
from dynsolve.explain.forms import Forms
from dynsolve.explain.given_actions import of_actions
from dynsolve.explain.given_questions import of_axes, of_model, of_questions
from dynsolve.explain.notation_list import problem_names
from dynsolve.explain.textbook_letters import Line
from dynsolve.explain.writing import listed, machine
from dynsolve.notation.tree import Node
from dynsolve.problem.model import Problem
from dynsolve.quantities.index import quantities
from dynsolve.robot.units import node as unit_node

MOST_BODIES = 4
"""Up to this number of bodies each is named."""

_COUNTS = {2: "two", 3: "three", 4: "four"}

CALLED = {
    "K": "the kinetic energy",
    "P": "the potential energy",
    "L": "the Lagrangian",
    "tau": "the generalized forces",
    "D": "the inertia matrix",
    "C": "the matrix of Coriolis and centrifugal terms",
    "g": "the gravity terms",
    "Ps": "the potential energy of the springs",
    "Km": "the kinetic energy of the rotors",
    "friction": "the friction",
    "DH": "the Denavit-Hartenberg parameters",
    "J": "the Jacobian",
    "r": "the task vector",
    "Jr": "the Jacobian of the task",
    "det": "the determinant",
    "singular": "the singular configurations",
    "inverse": "the inverse kinematics",
    "qd": "the rates of the coordinates",
    "qdd": "the accelerations of the coordinates",
    "Y": "the regressor",
    "a": "the dynamic parameters",
    "equilibria": "the equilibria",
    "balance": "the conditions for balance",
    "Ac": "the matrix of the constraints",
    "Ac_dot": "its rate",
    "lambda": "the multipliers",
    "reduced": "the equations without multipliers",
    "Lambda": "the inertia matrix of the task",
    "definite": "which of the matrices can be inertia matrices",
}
"""What whole answers are called; others are told by their letters."""


def statement(forms: Forms, problem: Problem, sines: Iterable[Line] = ()) -> Iterator[Block]:
    """Given: the arm or the mechanism, what acts on it, what is asked of it; its symbols; To be found."""
    given = [sentence for sentence in _sentences(forms, problem) if sentence]
    if given:
        yield Text(("Given: ", *sentences(given)))
    names = [*map(_introduced, problem_names(forms.robot)), *((line.words,) for line in sines)]
    if names:
        yield List(tuple(names))
    found = [called for name in problem.find if (called := _called(forms, name)) is not None]
    if found:
        yield Text(("To be found: ", *listed(found), "."))


def sentences(parts: Sequence[Prose]) -> Iterator[Inline]:
    """Sentences with a blank between them."""
    for place, sentence in enumerate(parts):
        *before, last = sentence
        yield from (" ", *before) if place else before
        yield last.rstrip() if isinstance(last, str) else last


def _sentences(forms: Forms, problem: Problem) -> Iterator[Prose]:
    """What is given, sentence by sentence."""
    robot = forms.robot
    if problem.normals is not None:
        yield ("the axes of the arm as they are drawn.",)
        yield from of_axes(problem.normals)
    elif robot.has_table:
        yield (*_given(forms), ".")
    else:
        yield from of_model(forms)
    if robot.has_table and 0 < len(robot.bodies) <= MOST_BODIES:
        yield given_bodies.of_tensors(forms)
    yield hypotheses.of_base(forms)
    if robot.has_dynamics and robot.given is None:
        yield hypotheses.of_forces(forms)
    elif robot.has_dynamics:
        yield from of_actions(forms)
    yield from of_questions(forms)
    yield hypotheses.of_values(robot, problem.written, problem.units)


def _introduced(line: Line) -> Prose:
    """l₁, l₂: length of link i (m)"""
    unit: Prose = (" (", unit_node(line.unit), ")") if line.unit else ()
    return (line.sign, f": {line.meaning}", *unit)


def _given(forms: Forms) -> Prose:
    """The table, and what has mass."""
    robot = forms.robot
    what = f"the table of the {machine(robot)}{hypotheses.joints(robot)}"
    if not robot.bodies:
        return (what,)
    if len(robot.bodies) > MOST_BODIES:
        return (f"{what}, and mass, mass centre and inertia tensor of {len(robot.bodies)} rigid bodies",)
    told = [given_bodies.of_body(forms, body) for body in robot.bodies]
    count = "one rigid body" if len(told) == 1 else f"{_COUNTS[len(told)]} rigid bodies"
    parts: Prose = told[0]
    for each in told[1:]:
        parts += ("; ", *each)
    return (f"{what} and {count}: ", *parts)


def _called(forms: Forms, name: str) -> Prose | None:
    """the inertia matrix D; None for what has neither words nor a letter"""
    words = CALLED.get(name, "")
    letter = None if name == "DH" else _letter(forms, name)
    if not words and letter is None:
        return None
    both: list[Node | str] = [words] if words else []
    if letter is not None:
        both += [" ", letter] if words else [letter]
    return tuple(both)


def _letter(forms: Forms, name: str) -> Node | None:
    try:
        return quantities(forms.robot)[name].letter(forms.robot)
    except LookupError:
        return None
