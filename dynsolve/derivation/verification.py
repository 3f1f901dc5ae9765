"""The results compared with an independent computation: recursive Newton-Euler at random states.

The trees that are printed are evaluated and compared with `dynsolve.derivation.newton_euler`, which
shares no formula with the rest of the derivation.  First the robot is put in numbers (an `Arm`, by
`arm_values`),
then each result is compared: H and J of the last frame, D, C q̇, g, τ, K and P.

What acts beside gravity, on numbers, for the independent check.

No derivative of the ring is taken: the force of what is stored is the slope of its energy by central
differences.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import islice

from msgspec import Struct

from dynsolve.derivation.arm_values import arms
from dynsolve.derivation.newton_euler import (
    ZERO,
    Arm,
    Mass,
    applied,
    dot,
    energies,
    inverse_dynamics,
    outwards,
    plus,
)
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.model import Robot, Stored

# What acts beside gravity, on numbers

_STEP = 0.02
_WEIGHTS = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
"""Central differences of the eighth order: what is left is of the order of rounding."""


class ActingForces(Struct, frozen=True):
    """The generalized forces of what is stored (a part of g) and of friction at a state, and the energy."""

    stored: tuple[float, ...]
    friction: tuple[float, ...]
    energy: float = 0.0


def acting_forces(robot: Robot, values: Mapping[str, float]) -> ActingForces:
    """Those of a robot at a state; zeros where nothing acts."""
    none, acting = [0.0] * robot.n, robot.actions
    slopes = ([_slope(act, values, q.name) for q in robot.coordinates] for act in acting.stored)
    resisting = (act.force_at(robot, values) for act in acting.resisting)
    return ActingForces(
        tuple(map(sum, zip(none, *slopes, strict=True))),
        tuple(map(sum, zip(none, *resisting, strict=True))),
        sum(act.energy_at(values) for act in acting.stored),
    )


def _slope(act: Stored, values: Mapping[str, float], name: str) -> float:
    total = 0.0
    for times, weight in enumerate(_WEIGHTS, 1):
        beyond, before = ({**values, name: values[name] + sign * times * _STEP} for sign in (1, -1))
        total += weight * (act.energy_at(beyond) - act.energy_at(before))
    return total / _STEP


TOLERANCE = 1e-9
"""The largest relative error of a result that counts as rounding."""

METHOD = "recursive Newton-Euler"

ON_NUMBERS = "elimination on numbers"
"""What is held of matrices that stand in the place of a robot."""

_NEGLIGIBLE = 1e-4
"""The part of what moves freely below which a result is rounding."""


class Verification(Struct, frozen=True):
    """How far the results differ from the independent computation.

    `max_relative_error` is the largest over all quantities and states, relative
    to the largest entry of D, C q̇, g and τ at that state.
    """

    method: str
    states: int
    max_relative_error: float


def verify(robot: Robot, results: Mapping[str, Node], states: int = 5) -> Verification:
    """Compare printed forms with recursive Newton-Euler at random states.

    `results` are trees by name: `tau`, `D`, `C`, `g`, `friction`, `K`, `P`, or, of a robot
    without masses, the last `H` and `J`; those that are absent are passed over.
    Raises VerificationError where one is off by more than `TOLERANCE`.
    """
    names = [name for name in ("H", "J", "D", "C", "g", "friction", "tau", "K", "P") if name in results]
    program = compile_trees([results[name] for name in names])
    worst = 0.0
    way = _way(robot)
    for values, errors in islice(way.errors(robot), states):
        ours = dict(zip(names, program.run(values), strict=True))
        for name, error in errors(ours):
            if not error <= TOLERANCE:
                raise VerificationError(
                    f"{name} differs from {way.method} by {error:.1e} of its size; "
                    "this is a fault of dynsolve"
                )
            worst = max(worst, error)
    return Verification(way.method, states, worst)


Results = Mapping[str, list[list[float]]]
Errors = Callable[[Results], Iterator[tuple[str, float]]]
"""(name, relative error) of each result."""


class _Way(Struct, frozen=True):
    """An independent computation: what it is called; states, and the errors of results there."""

    method: str
    errors: Callable[[Robot], Iterator[tuple[Mapping[str, float], Errors]]]


def _way(robot: Robot) -> _Way:
    """The computation that suits a robot: the recursion for an arm, another for a model without a table."""
    if robot.has_table:
        return _Way(METHOD, _of_arm)
    if not robot.has_dynamics:
        return _Way(ON_NUMBERS, _of_mechanism)
    from dynsolve.derivation.mechanism_check import BY_BODIES, BY_ENERGIES

    return _Way(BY_BODIES if robot.given is None else BY_ENERGIES, _of_mechanism)


def _of_arm(robot: Robot) -> Iterator[tuple[Mapping[str, float], Errors]]:
    for values, arm in arms(robot):
        yield values, partial(_errors, arm, acting_forces(robot, values))


def _of_mechanism(robot: Robot) -> Iterator[tuple[Mapping[str, float], Errors]]:
    from dynsolve.derivation.mechanism_check import mechanisms

    for values, mechanism in mechanisms(robot):
        independent = _Independent(
            mechanism.qd,
            mechanism.qdd,
            mechanism.forces,
            mechanism.energies(),
            _NEGLIGIBLE * mechanism.size,
            acting_forces(robot, values),
        )
        yield values, partial(_dynamic_errors, independent)


# -- the comparison --------------------------------------------------------------------------------


class _Independent(Struct, frozen=True):
    """A robot at a state by the independent computation.

    `forces(q̇, q̈, has_gravity)` are the generalized forces of masses and rotors, `energies` their K and P;
    `acting` is what springs and friction add.  Below `negligible` results count as 0.
    """

    qd: Sequence[float]
    qdd: Sequence[float]
    forces: Callable[[Sequence[float], Sequence[float], bool], list[float]]
    energies: tuple[float, float]
    negligible: float
    acting: ActingForces


def _errors(arm: Arm, acting: ActingForces, ours: Results) -> Iterator[tuple[str, float]]:
    """(name, relative error) of each result of an arm."""
    yield from _kinematic_errors(arm, ours)

    def forces(qd: Sequence[float], qdd: Sequence[float], has_gravity: bool) -> list[float]:
        return inverse_dynamics(arm, qd, qdd, arm.gravity if has_gravity else ZERO)

    state = _Independent(arm.qd, arm.qdd, forces, energies(arm), _negligible(arm), acting)
    yield from _dynamic_errors(state, ours)


def _dynamic_errors(state: _Independent, ours: Results) -> Iterator[tuple[str, float]]:
    """The errors of D, C q̇, friction, g, τ and the energies, where there are any."""
    if "D" not in ours:
        return
    acting = state.acting
    n = len(state.qd)
    still = [0.0] * n
    units = [[float(i == k) for i in range(n)] for k in range(n)]
    columns = [state.forces(still, unit, False) for unit in units]
    theirs = {
        "D": [[columns[j][i] for j in range(n)] for i in range(n)],
        "Cqd": [[x] for x in state.forces(state.qd, still, False)],
        "g": _column(state.forces(still, still, True), acting.stored),
        "friction": _column(acting.friction),
        "tau": _column(state.forces(state.qd, state.qdd, True), acting.stored, acting.friction),
    }
    size = max((state.negligible, *(_size(matrix) for matrix in theirs.values()))) or 1.0
    mine = {**ours, "Cqd": [[sum(c * x for c, x in zip(row, state.qd, strict=True))] for row in ours["C"]]}
    for name, matrix in theirs.items():
        if name in mine:
            yield name, _distance(mine[name], matrix) / size
    K, P = state.energies
    for name, value in (("K", K), ("P", P + acting.energy)):
        if name in ours:
            yield name, _distance([[ours[name]]], [[value]]) / max(size, abs(value))  # type: ignore[list-item]


def _column(*parts: Sequence[float]) -> list[list[float]]:
    """The sum of forces, as a column."""
    return [[sum(entries)] for entries in zip(*parts, strict=True)]


def _negligible(arm: Arm) -> float:
    """The size below which results count as 0: a body that no joint can move leaves only rounding."""
    frames, axes = outwards(arm, arm.qd, arm.qdd, ZERO)
    slides = any(not axis.motion.turns for row in axes for axis in row)
    weight = math.sqrt(dot(arm.gravity, arm.gravity))

    def largest(mass: Mass) -> float:
        frame = frames[mass.link]
        center = plus(frame.o, applied(frame.R, mass.center))
        reach = math.sqrt(max(dot(center, center), *(dot(frame.o, frame.o) for frame in frames)))
        return max(_size(mass.inertia), mass.mass * max(reach * reach, reach * weight, float(slides)))

    return _NEGLIGIBLE * max(map(largest, arm.masses), default=0.0)


def _kinematic_errors(arm: Arm, ours: Results) -> Iterator[tuple[str, float]]:
    """The errors of the last frame: of its position, and of its motion J q̇."""
    if "H" not in ours or "J" not in ours:
        return
    frames, _ = outwards(arm, arm.qd, arm.qdd, ZERO)
    last = frames[-1]
    H = [[*row, x] for row, x in zip(last.R, last.o, strict=True)] + [[0.0, 0.0, 0.0, 1.0]]
    yield "H", _distance(ours["H"], H) / max(1.0, _size(H))
    moves = [[x] for x in (*last.v, *last.w)]
    mine = [[sum(c * x for c, x in zip(row, arm.qd, strict=True))] for row in ours["J"]]
    yield "J", _distance(mine, moves) / max(1.0, _size(moves))


def _size(matrix: Sequence[Sequence[float]]) -> float:
    return max((abs(entry) for row in matrix for entry in row), default=0.0)


def _distance(ours: Sequence[Sequence[float]], theirs: Sequence[Sequence[float]]) -> float:
    if [len(row) for row in ours] != [len(row) for row in theirs]:
        return math.inf
    gaps = (
        abs(a - b) for row, other in zip(ours, theirs, strict=True) for a, b in zip(row, other, strict=True)
    )
    return max((gap if gap == gap else math.inf for gap in gaps), default=0.0)
