"""The parameters a of τ = Y a, which are the student's to choose.

Many pairs (Y, a) have one product.  An a of which every coefficient of the forces is a
combination is right, and the Y that belongs to it is the key from then on; where a is absent or
wrong, but some a belongs to the student's Y, that a is the key.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.answer_values import AnswerValue, as_value
from dynsolve.derivation.energy import accelerations, velocities
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.regressor import missing, parameters_for, reference_forces
from dynsolve.errors import AlgebraError
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities.model_families import PARAMETERS, REFERENCE, REGRESSORS
from dynsolve.robot.model import Robot
from dynsolve.robot.model_questions import reference


def forces_of(robot: Robot, regressor: str, value: Callable[[str], Any]) -> Matrix:
    """What a regressor times its parameters is: τ, D q̈ or g; `value` gives τ, D and g."""
    if regressor == "YM":
        inertia: Matrix = value("D")
        return inertia @ accelerations(robot)
    forces: Matrix = value("g" if regressor == "Yg" else "tau")
    return forces


def is_free(robot: Robot, name: str) -> bool:
    """Whether the entries of a column of parameters are the student's to choose."""
    return name in REGRESSORS and not (name == "a" and robot.questions.model.parameters is not None)


def as_matrix(value: AnswerValue, name: str) -> Matrix | None:
    """What was written for a regressor or its parameters; None of what is no matrix over the ring.

    Parameters may stand in a row as well as in a column.
    """
    if value.rows is None:
        return None
    rows = value.rows
    if name in REGRESSORS and len(rows) == 1:
        rows = tuple((entry,) for entry in rows[0])
    found = as_value(rows, Matrix.of(rows[0][0].ring, ()))
    return found if isinstance(found, Matrix) and (name not in REGRESSORS or found.shape[1] == 1) else None


def wrong_parameters(robot: Robot, forces: Matrix, written: Matrix) -> str:
    """Why no Y belongs to some parameters, in a sentence."""
    try:
        lacking = missing(robot, forces, written)
    except AlgebraError as error:
        return f"{error.message[0].upper()}{error.message[1:]}: {error.help}."
    if lacking is None:
        return "The forces are combinations of these, but the pair is another."
    shown = UnicodePrinter().text(Compactor(robot.ring).form(lacking))
    return f"The forces have {shown}, up to a factor, which is no combination of your parameters."


def covers(robot: Robot, written: Matrix, parameters: Matrix) -> bool:
    """Whether every one of some parameters is a combination of those that were written."""
    try:
        return missing(robot, parameters, written) is None
    except AlgebraError:
        return False


def multiplies_to(regressor: Matrix, parameters: Matrix, forces: Matrix) -> bool:
    """Whether forces = Y a."""
    return regressor.shape[1] == len(parameters.rows) and regressor @ parameters == forces


def own_parameters(answer_ring: AnswerRing, written: Mapping[str, Matrix]) -> dict[str, Matrix]:
    """The parameters that a student chose, by name; `written` are the values of what was handed in."""
    robot = answer_ring.robot
    found: dict[str, Matrix] = {}
    for Y, a in PARAMETERS.items():
        if not written.keys() & {Y, a} or not is_free(robot, a) or Y not in answer_ring.rules:
            continue
        if isinstance(answer_ring.key(a), Skipped):
            continue
        forces = forces_of(robot, Y, answer_ring.key)
        chosen = _chosen(robot, forces, written.get(Y), written.get(a))
        if chosen is not None:
            found[a] = chosen
    if REFERENCE in written and "a" not in found and REFERENCE in answer_ring.rules and is_free(robot, "a"):
        forces = reference_forces(robot, *map(answer_ring.key, ("D", "C", "g")))
        chosen = _chosen(robot, forces, written[REFERENCE], None)
        return found if chosen is None else {**found, "a": chosen}
    return found


def other_references(robot: Robot, forces: Matrix, value: Callable[[str], Any]) -> bool:
    """Whether forces are D q̈_r + C q̇_r + g with any C whose C q̇ is right and Ḋ - 2C skew."""
    ring, D = robot.ring, value("D")
    names = [reference(q.name) for q in robot.coordinates]
    C = Matrix.of(ring, ([ring.coefficient(force, name, 1) for name in names] for force in forces.entries))
    skew = D.map(ring.time_derivative) - C - C
    return (
        reference_forces(robot, D, C, value("g")) == forces
        and C @ velocities(robot) == value("Cqd")
        and (skew + skew.T).is_zero
    )


def _chosen(robot: Robot, forces: Matrix, Y: Matrix | None, a: Matrix | None) -> Matrix | None:
    try:
        if a is not None and missing(robot, forces, a) is None:
            return a
    except AlgebraError:  # a parameter moves
        pass
    return parameters_for(robot, forces, Y) if Y is not None and len(Y.rows) == len(forces.rows) else None
