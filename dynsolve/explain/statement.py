"""What is given, a line for each symbol with its unit, and what is to be found: the exercise."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.document import Block, List, Prose, Text
from dynsolve.explain import given_bodies, hypotheses
from dynsolve.explain.forms import Forms
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

_CALLED = {
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


def statement(forms: Forms, problem: Problem) -> Iterator[Block]:
    """Given: ...; To be found: ..., of an arm with a table; of others what is to be found."""
    if forms.robot.has_table and forms.robot.bodies:
        values = hypotheses.of_values(forms.robot, problem.written, problem.units)
        yield Text((
            "Given: ",
            *_given(forms),
            ". ",
            *(given_bodies.of_tensors(forms) if len(forms.robot.bodies) <= MOST_BODIES else ()),
            *hypotheses.of_base(forms),
            *hypotheses.of_forces(forms),
            *values,
        ))  # fmt: skip
    names = list(problem_names(forms.robot))
    if names:
        yield List(tuple(_introduced(line) for line in names))
    found = [told for name in problem.find if (told := _called(forms, name)) is not None]
    if found:
        yield Text(("To be found: ", *listed(found), "."))


def _introduced(line: Line) -> Prose:
    """l₁, l₂: length of link i (m)"""
    unit: Prose = (" (", unit_node(line.unit), ")") if line.unit else ()
    return (line.sign, f": {line.meaning}", *unit)


def _given(forms: Forms) -> Prose:
    """The table, and what has mass."""
    robot = forms.robot
    what = f"the table of the {machine(robot)}{hypotheses.joints(robot)} (section 1.1)"
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
    words = _CALLED.get(name, "")
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
