"""The parameters a of τ = Y a, which are the student's to choose.

Many pairs (Y, a) have one product: an a of which every coefficient of the forces is a combination is right,
and the Y that belongs to it is the key from then on; where a is absent or wrong, but some a belongs to the
student's Y, that a is the key.  Where parameters depend on each other, many a Y gives one product.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from typing import Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.link_frame import accelerations, velocities
from dynsolve.errors import AlgebraError
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.questions.judging import Case, right_as
from dynsolve.questions.parameters import PARAMETERS, REFERENCE, REGRESSORS
from dynsolve.questions.parameters.derive import missing, parameters_for, reference_forces
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import reference

OF_THE_PRODUCT = "these parameters leave Y open; the product is right"
OF_C = "right with another choice of C than Christoffel's"


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


def own_parameters(
    robot: Robot, rules: Container[str], key: Callable[[str], Any], written: Mapping[str, Matrix]
) -> dict[str, Matrix]:
    """The parameters that a student chose, by name; `written` are the values of what was handed in.

    `key` gives the key's value of what has one of the `rules`.
    """
    found: dict[str, Matrix] = {}
    for Y, a in PARAMETERS.items():
        if not written.keys() & {Y, a} or not is_free(robot, a) or Y not in rules:
            continue
        if isinstance(key(a), Skipped):
            continue
        forces = forces_of(robot, Y, key)
        chosen = _chosen(robot, forces, written.get(Y), written.get(a))
        if chosen is not None:
            found[a] = chosen
    if REFERENCE in written and "a" not in found and REFERENCE in rules and is_free(robot, "a"):
        forces = reference_forces(robot, *map(key, ("D", "C", "g")))
        chosen = _chosen(robot, forces, written[REFERENCE], None)
        return found if chosen is None else {**found, "a": chosen}
    return found


def _chosen(robot: Robot, forces: Matrix, Y: Matrix | None, a: Matrix | None) -> Matrix | None:
    try:
        if a is not None and missing(robot, forces, a) is None:
            return a
    except AlgebraError:  # a parameter moves
        pass
    return parameters_for(robot, forces, Y) if Y is not None and len(Y.rows) == len(forces.rows) else None


def _multiplies(case: Case) -> bool:
    """Whether Y a is right for the student's own a."""
    parameters = case.chosen.get(PARAMETERS[case.node])
    forces = forces_of(case.robot, case.node, case.result)
    Y = case.value(forces)
    return parameters is not None and isinstance(Y, Matrix) and multiplies_to(Y, parameters, forces)


def _refers(case: Case) -> bool:
    """Whether Y_r a = D q̈_r + C q̇_r + g with any C whose C q̇ is right and Ḋ - 2C skew."""
    robot, value, parameters = case.robot, case.result, case.result("a")
    Y = case.value(parameters)
    if not isinstance(Y, Matrix) or Y.shape[1] != len(parameters.rows):
        return False
    forces, ring, D = Y @ parameters, robot.ring, value("D")
    names = [reference(q.name) for q in robot.coordinates]
    C = Matrix.of(ring, ([ring.coefficient(force, name, 1) for name in names] for force in forces.entries))
    skew = D.map(ring.time_derivative) - C - C
    is_skew: bool = (skew + skew.T).is_zero
    is_right: bool = C @ velocities(robot) == value("Cqd")
    return is_skew and is_right and bool(reference_forces(robot, D, C, value("g")) == forces)


EQUIVALENCES = (
    right_as(OF_THE_PRODUCT, _multiplies, *PARAMETERS),
    right_as(OF_C, _refers, REFERENCE),
)
