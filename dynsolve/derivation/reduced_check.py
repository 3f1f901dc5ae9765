"""Equations of motion without multipliers, held at states that the constraints and the motors allow.

A state with h = 0 is found by Newton's method, and its rates are put on A_c q̇ = 0.  Accelerations and
multipliers are random but for A_c q̈ + Ȧ_c q̇ = 0 and for the forces of coordinates without a motor, which
are 0; the motors give what D q̈ + C q̇ + g - Q - A_cᵀ λ leaves to them.  Nothing is multiplied by a
nullspace.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

from dynsolve.algebra.sampling import samples
from dynsolve.derivation.configurations import NO_VALUE, rank_of
from dynsolve.derivation.constraints import holonomic
from dynsolve.derivation.elimination import solved
from dynsolve.derivation.equilibrium_check import zero_along
from dynsolve.derivation.reached import CLOSE
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Matrix, Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.model import Robot

STATES, TRIES = 4, 40
_SMALL = 1e-12

State = dict[str, float]


def verify_reduced(robot: Robot, forms: Mapping[str, Node], residuals: Sequence[Node]) -> None:
    """Raises VerificationError where equations, residual = 0, do not hold, or are too few.

    `forms` are those of `constrained_names`.
    """
    states = ConstrainedStates(robot, forms)
    if not states.all:  # with none of the parameters that were tried can the mechanism be put together
        return
    if not all(states.hold(node) for node in residuals) or not states.are_enough(residuals):
        raise VerificationError("the equations without multipliers are wrong; this is a fault of dynsolve")


def constrained_names(robot: Robot) -> tuple[str, ...]:
    """The results that `ConstrainedStates` takes."""
    held = ("hc",) if holonomic(robot) else ()
    return ("Ac", "Ac_dot", "tau", *held, *(("Q",) if robot.questions.loads else ()))


class ConstrainedStates:
    """States with accelerations and forces of motors.

    `forms` are those of `constrained_names`, `numbers` those of the problem; `all` are the states.
    """

    def __init__(
        self, robot: Robot, forms: Mapping[str, Node], numbers: Mapping[str, float] | None = None
    ) -> None:
        self.robot, self.names, self.numbers = robot, list(forms), dict(numbers or {})
        self.program = compile_trees(list(forms.values()))
        h = forms.get("hc")
        self.held = compile_trees([row[0] for row in h.rows]) if isinstance(h, Matrix) else None
        self.all = list(self._found())

    def hold(self, residual: Node) -> bool:
        """Whether an equation, residual = 0, holds at all states."""
        program = compile_trees([residual])
        try:
            return all(abs(program.run(at)[0]) < CLOSE for at in self.all)
        except NO_VALUE:
            return False

    def are_enough(self, residuals: Sequence[Node]) -> bool:
        """Whether with the constraints they determine all that there is: by their derivatives, n in all."""
        program, at = compile_trees(list(residuals)), self.all[0]
        motion = [q.acceleration for q in self.robot.coordinates]
        names = [*motion, *(self.robot.coordinates[k].force for k in self._driven)]
        start = program.run(at)
        columns = [
            [b - a for a, b in zip(start, program.run({**at, name: at[name] + 1.0}), strict=True)]
            for name in names
        ]
        A = self._at(at)["Ac"]
        rows = [[*row, *[0.0] * (len(names) - len(motion))] for row in A]
        return rank_of([*rows, *map(list, zip(*columns, strict=True))]) == self.robot.n

    @property
    def _free(self) -> list[str]:
        """Names, which no parameter has, of accelerations and multipliers before the constraints act."""
        return [f"free {i}" for i in range(self.robot.n + len(self.robot.questions.constraints))]

    @property
    def _driven(self) -> list[int]:
        return [k for k in range(self.robot.n) if k not in self.robot.actions.passive]

    def _at(self, at: Mapping[str, float]) -> dict[str, Any]:
        return dict(zip(self.names, self.program.run(at), strict=True))

    def _found(self) -> Iterator[State]:
        found = 0
        for start in islice(samples(self.robot.ring, self._free), TRIES):
            start |= self.numbers | {q.force: 0.0 for q in self.robot.coordinates}
            names = [q.name for q in self.robot.coordinates]
            at = zero_along(names, self.held, start) if self.held else start
            if at is not None and found < STATES:
                found += 1
                yield self._in_motion(at)

    def _in_motion(self, at: State) -> State:
        """The state with rates, accelerations and forces that the constraints allow."""
        n, coordinates = self.robot.n, self.robot.coordinates
        A = self._at(at)["Ac"]
        rates = _nearest(A, [0.0] * len(A), [at[q.velocity] for q in coordinates])
        at = at | {q.velocity: rate for q, rate in zip(coordinates, rates, strict=True)}
        at |= {q.acceleration: 0.0 for q in coordinates}
        rest = self._forces(at)
        inertia = [self._forces(at | {q.acceleration: 1.0}) for q in coordinates]
        values = self._at(at)
        rows = [[*row, *[0.0] * len(A)] for row in A]
        right = [-sum(a * b for a, b in zip(row, rates, strict=True)) for row in values["Ac_dot"]]
        for k in sorted(self.robot.actions.passive):
            rows.append([*(inertia[i][k] - rest[k] for i in range(n)), *(-row[k] for row in A)])
            right.append(-rest[k])
        chosen = _nearest(rows, right, [at[name] for name in self._free])
        at |= {q.acceleration: x for q, x in zip(coordinates, chosen, strict=False)}
        moved = self._forces(at)
        held = [sum(row[k] * x for row, x in zip(A, chosen[n:], strict=True)) for k in range(n)]
        return at | {coordinates[k].force: moved[k] - held[k] for k in self._driven}

    def _forces(self, at: Mapping[str, float]) -> list[float]:
        """D q̈ + C q̇ + friction + g - Q"""
        values = self._at(at)
        loads = values.get("Q", [[0.0]] * self.robot.n)
        return [row[0] - load[0] for row, load in zip(values["tau"], loads, strict=True)]


def _nearest(rows: Sequence[Sequence[float]], right: Sequence[float], start: Sequence[float]) -> list[float]:
    """The x nearest to `start` with A x = b: x₀ - Aᵀ (A Aᵀ + ε)⁻¹ (A x₀ - b)."""
    gap = [
        sum(a * x for a, x in zip(row, start, strict=True)) - b for row, b in zip(rows, right, strict=True)
    ]
    squares = [
        [
            sum(a * b for a, b in zip(row, other, strict=True)) + _SMALL * (i == j)
            for j, other in enumerate(rows)
        ]
        for i, row in enumerate(rows)
    ]
    along = solved(squares, gap)
    return [x - sum(y * row[k] for y, row in zip(along, rows, strict=True)) for k, x in enumerate(start)]
