"""Y a, held against the forces as they are printed; the length of a, against their rank in numbers.

The product Y a must be the forces, which recursive Newton-Euler has verified.  The length of a is held
against the rank of a table of these forces, with a row for each of many motions and a column for each of
many choices of the unknown parameters: no factorization with fewer columns gives that table.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.elimination import rank
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.held import Held
from dynsolve.questions.parameters import PARAMETERS
from dynsolve.questions.parameters.derive import known_names
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import reference

TOLERANCE = 1e-8
"""The largest error of Y a, relative to its largest terms."""


NEGLIGIBLE = 1e-10
"""A pivot of elimination that is smaller, relative to the first, is rounding."""


MOST_RANK = 40
"""The length of a longer a is not compared: its smallest pivots would come near to rounding."""


_MARGIN = 4
"""So many motions and choices of parameters more than the rank needs."""


FORCES = {"Y": "tau", "YM": "D", "Yg": "g"}
"""What each regressor is one of; of D it is D q̈."""


def model_names(wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are compared, with what they are compared with."""
    found: list[str] = []
    for Y, a in PARAMETERS.items():
        if a in wanted:
            found += [name for name in (Y, a, FORCES[Y]) if name in wanted]
    return tuple(dict.fromkeys(found))


def verify_references(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare Y_r a with D q̈_r + C q̇_r + g, as they are printed, for reference rates of their own.

    Raises VerificationError where they differ.
    """
    program = compile_trees([results[name] for name in ("Yr", "a", "D", "C", "g")])
    names = [reference(q.name) for q in robot.coordinates]
    rates = [f"{name}_{dots}" for name in names for dots in ("dot", "ddot")]
    for own, (Y, a, D, C, g) in islice(states_with(robot.ring, program.run, rates), states):
        forces = [
            sum(
                d * own[f"{name}_ddot"] + c * own[f"{name}_dot"]
                for d, c, name in zip(*rows, names, strict=True)
            )
            + weight
            for *rows, (weight,) in zip(D, C, g, strict=True)
        ]
        if not _is_product(Y, a, forces):
            raise VerificationError("Yr a differs from D q̈_r + C q̇_r + g; this is a fault of dynsolve")


def verify_model(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms with the forces (see `model_names`).

    Raises VerificationError where a product differs from the forces, or a is not of minimal length.
    """
    program = compile_trees(list(results.values()))
    for values, found in islice(states_with(robot.ring, program.run), states if results else 0):
        here = dict(zip(results, found, strict=True))
        for Y in FORCES:
            if Y in here and not _is_product(here[Y], here[PARAMETERS[Y]], _force(robot, Y, here, values)):
                raise VerificationError(f"{Y} a differs from the forces; this is a fault of dynsolve")
    given = robot.questions.model.parameters is not None
    for Y, a in PARAMETERS.items():
        if a in results and not (given and a == "a"):
            length = len(next(iter(compile_trees([results[a]]).run(values))))
            if length <= MOST_RANK and rank_of_forces(robot, Y, results[FORCES[Y]], length) != length:
                raise VerificationError(f"{a} is not of minimal length; this is a fault of dynsolve")


def _force(robot: Robot, Y: str, ours: Mapping[str, Any], values: Mapping[str, float]) -> list[float]:
    """The forces that Y a must be."""
    found = ours[FORCES[Y]]
    if Y != "YM":
        return [row[0] for row in found]
    rates = [values[q.acceleration] for q in robot.coordinates]
    return [sum(d * x for d, x in zip(row, rates, strict=True)) for row in found]


def _is_product(Y: Sequence[Sequence[float]], a: Sequence[Sequence[float]], forces: Sequence[float]) -> bool:
    for row, force in zip(Y, forces, strict=True):
        terms = [y * x for y, (x,) in zip(row, a, strict=True)]
        if not abs(sum(terms) - force) <= TOLERANCE * max((1.0, *map(abs, terms))):
            return False
    return True


def rank_of_forces(robot: Robot, Y: str, forces: Node, expected: int) -> int:
    """The rank of the forces over motions and unknown parameters, looked for a little beyond `expected`."""
    program = compile_trees([forces])
    motions = [at for at, _ in islice(states_with(robot.ring, program.run), expected + _MARGIN)]
    known, names = known_names(robot), robot.ring.parameters
    choices = [{name: (motions[0] if name in known else at)[name] for name in names} for at in motions]

    def forces_at(choice: Mapping[str, float], motion: Mapping[str, float]) -> list[float]:
        at = {**motion, **choice}
        return _force(robot, Y, {FORCES[Y]: program.run(at)[0]}, at)

    motions = motions[: -(-len(motions) // robot.n) + 1]
    rows = [[force for motion in motions for force in forces_at(choice, motion)] for choice in choices]
    return rank(rows, NEGLIGIBLE)


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    held.hold(verify_model, model_names(held.wanted))
    if "Yr" in held.wanted:
        held.hold(verify_references, ("Yr", "a", "D", "C", "g"))
