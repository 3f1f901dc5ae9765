"""Equations of motion without multipliers, held at states that the constraints and the motors allow.

A state with h = 0 is found by Newton's method, and its rates are put on A_c q̇ = 0.  Accelerations and
multipliers are random but for A_c q̈ + Ȧ_c q̇ = 0 and for the forces of coordinates without a motor, which
are 0; the motors give what D q̈ + C q̇ + g - Q - A_cᵀ λ leaves to them.  Nothing is multiplied by a
nullspace.  The functions h, A_c and its rate are held to the motion as a task is, and the multipliers to
those that elimination on numbers finds from the equations of motion and the constraint together.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.sampling import samples
from dynsolve.derivation.arm_values import arms
from dynsolve.derivation.configurations import NO_VALUE, rank_of
from dynsolve.derivation.elimination import solved
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.reached import CLOSE
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Matrix as MatrixTree
from dynsolve.notation.tree import Negative, Node, Sum
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.constraints.derive import holonomic
from dynsolve.questions.constraints.forms import ReducedForms
from dynsolve.questions.equilibria.check import zero_along
from dynsolve.questions.held import Held
from dynsolve.questions.rates.check import TOLERANCE
from dynsolve.questions.statics.check import outside_forces
from dynsolve.questions.task.check import verify_kinematics
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Task

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
    return ("Ac", "Ac_dot", "tau", *held)


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
        self.held = compile_trees([row[0] for row in h.rows]) if isinstance(h, MatrixTree) else None
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
        names = [*motion, *(self.robot.inputs[k] for k in self._driven)]
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
            start |= self.numbers | dict.fromkeys(self.robot.inputs, 0.0)
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
        return at | {self.robot.inputs[k]: moved[k] - held[k] for k in self._driven}

    def _forces(self, at: Mapping[str, float]) -> list[float]:
        """D q̈ + C q̇ + friction + g - Q"""
        loads = outside_forces(self.robot, at)
        return [row[0] - load for row, load in zip(self._at(at)["tau"], loads, strict=True)]


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


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    robot = held.robot
    acting = ("D", *ACTING) if held.wanted & {"lambda", "qdd_forward"} else ()
    kept = ("hc", "Ac", "Ac_dot", "lambda", "qdd_forward", *acting)
    held.hold(verify_constraints, (name for name in kept if name in held.wanted))
    if "reduced" in held.wanted and not isinstance(held.values["reduced"], Skipped):
        forms = ReducedForms(robot, held.values)
        for equations in filter(None, (forms.reduced, forms.closed)):
            residuals = [Sum((left, Negative(right))) for left, right in equations]
            verify_reduced(robot, {name: held.forms(name) for name in constrained_names(robot)}, residuals)


ACTING = ("Cqd", "g", "friction")
"""What stands beside D q̈, τ, Q and A_cᵀ λ in the equations of motion."""


def verify_constraints(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of `hc`, `Ac`, `Ac_dot`, `lambda` and `qdd_forward` with computations on numbers.

    With the last two come `D` and those of `ACTING` that there are.  Raises VerificationError where one is
    wrong.
    """
    _verify_functions(robot, results, states)
    _verify_rates(robot, results, states)
    if results.keys() & {"lambda", "qdd_forward"}:
        _verify_motion(robot, results, states)


def _verify_functions(robot: Robot, results: Mapping[str, Node], states: int) -> None:
    """h, and the rows of A_c and its rate that belong to it, as a task and its Jacobian."""
    if not holonomic(robot):
        return
    asked = robot.questions
    task = Task(tuple(one.entry for one in holonomic(robot)))
    places = [i for i, one in enumerate(asked.constraints) if not one.in_rates]
    held = {"r": results["hc"]}
    for mine, name in (("Jr", "Ac"), ("Jr_dot", "Ac_dot")):
        form = results.get(name)
        if isinstance(form, MatrixTree):
            held[mine] = MatrixTree(tuple(form.rows[i] for i in places))
    verify_kinematics(replace(robot, questions=replace(asked, task=task)), held, states)


def _verify_rates(robot: Robot, results: Mapping[str, Node], states: int) -> None:
    """A_c q̇ is what a constraint on the rates says is 0."""
    places = [i for i, one in enumerate(robot.questions.constraints) if one.in_rates]
    if not places:
        return
    program = compile_trees([results["Ac"], *(robot.questions.constraints[i].entry for i in places)])
    for values, _ in islice(arms(robot), states):
        A, *wanted = program.run(values)
        rates = [values[q.velocity] for q in robot.coordinates]
        for i, theirs in zip(places, wanted, strict=True):
            mine = _dot(A[i], rates)
            if not abs(mine - theirs) <= TOLERANCE * max(1.0, abs(theirs)):
                raise VerificationError("Ac differs from the constraint; this is a fault of dynsolve")


def _verify_motion(robot: Robot, results: Mapping[str, Node], states: int) -> None:
    program = compile_trees(list(results.values()))
    for values, _ in islice(arms(robot), states):
        ours = dict(zip(results, program.run(values), strict=True))
        A, rates = ours["Ac"], [values[q.velocity] for q in robot.coordinates]
        rows = [[*row, *(-one[k] for one in A)] for k, row in enumerate(ours["D"])]
        rows += [[*row, *[0.0] * len(A)] for row in A]
        along = [-_dot(row, rates) for row in ours["Ac_dot"]]
        theirs = solved(rows, [*_forces(robot, values, ours), *along])
        for name, known in (("qdd_forward", theirs[: robot.n]), ("lambda", theirs[robot.n :])):
            gaps = [abs(mine - x) for (mine,), x in zip(ours.get(name, ()), known, strict=False)]
            if not max(gaps, default=0.0) <= TOLERANCE * max((1.0, *map(abs, theirs))):
                raise VerificationError(f"{name} does not keep the constraint; this is a fault of dynsolve")


def _forces(robot: Robot, values: Mapping[str, float], ours: Mapping[str, Any]) -> list[float]:
    """τ + Q - C q̇ - friction - g"""
    found = []
    loads = outside_forces(robot, values)
    for k in range(robot.n):
        total = loads[k] + (0.0 if k in robot.actions.passive else values[robot.inputs[k]])
        found.append(total - sum(ours[name][k][0] for name in ACTING if name in ours))
    return found


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
