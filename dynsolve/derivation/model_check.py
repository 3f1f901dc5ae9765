"""What is asked of the equations of motion, compared with numbers.

The product Y a is held against the forces as they are printed, which recursive Newton-Euler has
verified.  The length of a is held against the rank of a table of these forces, with a row for
each of many motions and a column for each of many choices of the unknown parameters: no
factorization with fewer columns gives that table.

Whether matrices are positive definite, held at random values of parameters and coordinates.

Symmetric elimination on numbers: a matrix is positive definite exactly if every pivot is positive.
It shares nothing with the minors and their smallest values.

The Newton-Euler recursions, as printed, compared with recursive Newton-Euler on numbers.

There every vector lies along the axes of the world, moments are about its origin, and a row of the
table is four elementary motions; here the results are turned into the links' frames.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from random import Random
from typing import Any

from msgspec import Struct

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.arm_values import RobotValues, arms, states_with
from dynsolve.derivation.definite import Answer, Definiteness, Refusal
from dynsolve.derivation.elimination import is_positive_definite, rank
from dynsolve.derivation.newton_euler import (
    ZERO,
    Arm,
    MovingFrame,
    Vector,
    applied,
    cross,
    held_by_joints,
    minus,
    outwards,
    plus,
    scaled,
    transposed,
)
from dynsolve.derivation.regressor import known_names
from dynsolve.derivation.verification import TOLERANCE as VERIFICATION_TOLERANCE
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.quantities import action_families as families
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import quantities
from dynsolve.quantities.model_families import PARAMETERS
from dynsolve.robot.actions import Candidate
from dynsolve.robot.model import Convention, JointType, Robot
from dynsolve.robot.questions import reference

# What is asked of the equations of motion, compared with numbers

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


# Whether matrices are positive definite, held at random values of parameters and coordinates

SEED = 20_190_429
DRAWS = 20_000
"""So many values are drawn in the search for some that satisfy what is assumed."""

POSES = 200


def verify_definite(robot: Robot, candidate: Candidate, found: Definiteness, states: int) -> None:
    """Hold a verdict at random values; raises VerificationError where it is wrong."""
    random = Random(SEED)  # noqa: S311 - the same values every time are wanted
    bounds = (*candidate.assumed, *found.conditions)
    if found.refusal not in (None, Refusal.INDEFINITE):
        return
    for parameters in _parameters(candidate, bounds, random, states):
        every = all(_is_definite(candidate, values) for values in _poses(robot, parameters, random))
        if every != (found.answer is not Answer.NO):
            raise VerificationError(
                f"whether {candidate.name} is positive definite comes out otherwise on numbers; "
                "this is a fault of dynsolve"
            )


def _parameters(
    candidate: Candidate, bounds: Sequence[Bound], random: Random, states: int
) -> Iterator[dict[str, float]]:
    """Values of the parameters that satisfy inequalities."""
    ring, count = candidate.matrix.ring, 0
    for _ in range(DRAWS):
        values = {
            name: random.choice((random.uniform(-2, 2), random.uniform(0.1, 3))) for name in ring.parameters
        }
        if all(evaluate(b.value, values) > 1e-3 * b.is_strict for b in bounds):
            count += 1
            yield values
            if count == states:
                return


def _poses(robot: Robot, parameters: Mapping[str, float], random: Random) -> Iterator[dict[str, float]]:
    """Values of the coordinates: right angles first, and lengths of every size."""
    for k in range(POSES):
        values = dict(parameters)
        for q in robot.coordinates:
            if q.type is JointType.PRISMATIC:
                values[q.name] = random.choice((0.0, random.uniform(-3, 3), random.uniform(-100, 100)))
            elif k % 2:
                values[q.name] = random.choice((0, 1, 2, 3)) * math.pi / 2
            else:
                values[q.name] = random.uniform(-math.pi, math.pi)
        yield values


def _is_definite(candidate: Candidate, values: Mapping[str, float]) -> bool:
    rows = [[evaluate(entry, values) for entry in row] for row in candidate.matrix.rows]
    return is_positive_definite(rows, 1e-12)


# The Newton-Euler recursions, as printed, compared with recursive Newton-Euler on numbers


def recursion_names(robot: Robot, wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are of the recursions."""
    every = quantities(robot).values()
    return tuple(q.name for q in every if q.family in families.FAMILIES and q.name in wanted)


def verify_recursions(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of the recursions with the motions and forces of the arm in numbers.

    `results` are trees by name (see `recursion_names`).  Raises VerificationError where one is off by more
    than rounding.
    """
    program = compile_trees(list(results.values()))
    for values, arm in islice(arms(robot), states if results else 0):
        links = _Links(robot, values, arm)
        for name, mine in zip(results, program.run(values), strict=True):
            theirs = links.value(name)
            size = max((1.0, *map(abs, theirs)))
            if not _gap(mine, theirs) <= VERIFICATION_TOLERANCE * size:
                raise VerificationError(
                    f"{name} differs from the motion of the arm; this is a fault of dynsolve"
                )


class _Links(Struct, dict=True):
    """What the recursions give, from an arm at a state."""

    robot: Robot
    values: Mapping[str, float]
    arm: Arm

    def __post_init__(self) -> None:
        self._lifted = outwards(self.arm, self.arm.qd, self.arm.qdd, scaled(self.arm.gravity, -1.0))[0]
        self._held = held_by_joints(self.arm, self._lifted, self.arm.qd, self.arm.qdd)
        modified = self.robot.convention is Convention.MODIFIED
        joints = self.robot.joints
        at_rest = outwards(self.arm, self.arm.qd, self.arm.qdd, ZERO)[0]
        self._frames = self._lifted if modified else at_rest
        self._about = [joint.index if modified else joint.parent for joint in joints]
        """The frame, for each link, whose origin its moment is about."""

    def value(self, name: str) -> Vector:
        """A result along the axes of its link's frame."""
        quantity = quantities(self.robot)[name]
        place = quantity.index[0]
        link = self.robot.bodies[place - 1].link if quantity.family is families.ACL else place
        frame = self._frames[link]
        return applied(transposed(frame.R), self._in_world(quantity.family, place, link, frame))

    def _in_world(self, family: Family, place: int, link: int, frame: MovingFrame) -> Vector:
        if family is families.WL:
            return frame.w
        if family is families.WDL:
            return frame.dw
        if family is families.AL:
            return frame.dv
        if family is families.ACL:
            numbers = RobotValues(self.robot, self.values)
            arm = applied(frame.R, numbers.vector(self.robot.bodies[place - 1].center))
            return plus(frame.dv, plus(cross(frame.dw, arm), cross(frame.w, cross(frame.w, arm))))
        force, moment = self._held[link - 1]
        if family is families.FL:
            return force
        return minus(moment, cross(self._frames[self._about[link - 1]].o, force))


def _gap(mine: Any, theirs: Sequence[float]) -> float:
    gaps = [abs(a - b) for (a,), b in zip(mine, theirs, strict=True)]
    return max((gap if gap == gap else float("inf") for gap in gaps), default=0.0)
