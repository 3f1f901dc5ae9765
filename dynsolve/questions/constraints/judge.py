"""Verdicts on equations of motion without multipliers, and on a matrix of the constraint of one's own.

A_c is right where its rows span those of the key's; its rate is that of the student's own A_c, and the
multipliers are right where A_cᵀ λ is, on either side of the equations of motion unless the student's own
have it on one.  What differs from that for every state, and not where h = 0 and A_c q̇ = 0, is right too:
that is held in numbers, at states of a fixed seed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from itertools import islice
from typing import Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.fraction import FractionRows as Rows
from dynsolve.algebra.fraction import RationalExpr, multiply, same, summed
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of, rank_parts
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.sampling import samples
from dynsolve.derivation.elimination import solved
from dynsolve.notation.tree import Matrix as MatrixTree
from dynsolve.notation.tree import Node
from dynsolve.questions.constraints.check import ConstrainedStates, constrained_names
from dynsolve.questions.forward_dynamics.judge import accelerations_in, value_at
from dynsolve.questions.judging import (
    RIGHT,
    Alternatives,
    Case,
    Fault,
    Judged,
    Missed,
    SetKey,
    SetVerdict,
    by_code,
    nodes_of,
    right_as,
)
from dynsolve.questions.rates.check import orthonormal
from dynsolve.questions.statics.check import outside_forces
from dynsolve.robot.model import Robot

SAME_CONSTRAINT = "right in another form of the same constraint"
ON_CONSTRAINT = "right where the constraint holds; that was held in numbers, at several states"
WITHOUT_MULTIPLIERS = "right with the forces of the constraint moved over: here τ + A_cᵀ λ is the right side"
IN_MOTION = "right with the accelerations of the motion put in; that was held in numbers, at several states"
OTHER_SIDE = "right with A_cᵀ λ on the other side: D q̈ + C q̇ + g + A_cᵀ λ = τ"

STATES = 4
"""So many states on the constraint are looked at."""

_EQUATIONS = "D q̈ + C q̇ + g = τ + A_cᵀ λ"
_TRIES, _STEPS, _CLOSE = 60, 40, 1e-7


class ReducedKey(SetKey):
    """The equations of motion without multipliers of one problem."""

    faults = by_code(
        Fault("motion_differs", "an equation of motion",
              "There are motions that the constraints allow in which equation {number} does not hold.",
              "Combine the equations so that every multiplier drops out, with the forces of the motors."),
        Fault("motions_missing", "an equation of motion", "Every equation holds, and some are missing.",
              "With the constraints there are as many equations as coordinates."),
    )  # fmt: skip
    made_of = ("tau", "Ac")

    def __init__(self, judged: Judged, name: str) -> None:
        super().__init__(judged, name)
        self.names = set(self.robot.inputs)

    @property
    def is_skipped(self) -> bool:
        """Whether there are no such equations here, or no state was found that keeps the constraints."""
        return super().is_skipped or not self._states.all

    @cached_property
    def _states(self) -> ConstrainedStates:
        forms = {name: self.forms(name) for name in constrained_names(self.robot)}
        return ConstrainedStates(self.robot, forms, self.judged.numbers)

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether each equation holds, and they are enough."""
        return _verdict(nodes_of(given), self._states)

    def verdict_with(self, given: Alternatives, own: Mapping[str, Any]) -> SetVerdict:
        """The same with equations of motion, or a matrix of the constraints, of the student's own."""
        values = dict(own)
        if "Ac" in own:
            values["Ac_dot"] = own["Ac"].map(own["Ac"].ring.time_derivative)
        forms = {name: self.forms(name) for name in constrained_names(self.robot)}
        for name, value in values.items():
            form = Compactor(value.ring).form
            forms[name] = MatrixTree(tuple(tuple(map(form, row)) for row in value.rows))
        states = ConstrainedStates(self.robot, forms, self.judged.numbers)
        return _verdict(nodes_of(given), states) if states.all else SetVerdict(False, "motion_differs")


def _verdict(theirs: Sequence[Node], states: ConstrainedStates) -> SetVerdict:
    for number, node in enumerate(theirs, 1):
        if not states.hold(node):
            return SetVerdict(False, "motion_differs", number)
    enough = bool(theirs) and states.are_enough(theirs)
    return RIGHT if enough else SetVerdict(False, "motions_missing")


KEYS = {"reduced": ReducedKey}


class OwnConstraint:
    """The constraint, and the matrix that the student writes for it (`rows`); `key` gives the results."""

    def __init__(self, robot: Robot, key: Callable[[str], Any]) -> None:
        self.ring, self.robot, self._value = robot.ring, robot, key
        self.rows: Rows = self._key("Ac")

    def _key(self, name: str) -> Rows:
        value: Matrix | FractionMatrix = self._value(name)
        return tuple(tuple(map(fraction_of, row)) for row in value.rows)

    @property
    def is_other(self) -> bool:
        """Whether the student's matrix is not the key's."""
        return not same(self.rows, self._key("Ac"))

    # -- the three answers -------------------------------------------------------------------------

    def matrix(self, rows: Rows) -> str:
        """Whether the rows span the key's, at every state on the constraint."""
        return SAME_CONSTRAINT if self.keeps(rows) else ""

    def keeps(self, rows: Rows) -> bool:
        """Whether a matrix keeps the same constraint: its rows span the key's at every state on it."""
        key = self._key("Ac")
        for at in self.states:
            mine, theirs = self._numbers(rows, at), self._numbers(key, at)
            if mine is None or theirs is None:
                return False
            rank = len(orthonormal(theirs))
            if len(orthonormal(mine)) != rank or len(orthonormal([*theirs, *mine])) != rank:
                return False
        return bool(self.states)

    def rate(self, rows: Rows) -> str:
        """Whether it is the rate of the student's matrix."""
        return self._agree(rows, tuple(tuple(map(self._rate, row)) for row in self.rows))

    def multipliers(self, written: Mapping[int, RationalExpr], side: int = 1) -> str:
        """Whether multipliers, by their places from 0, belong to A_cᵀ λ of the key, on its side or on -1."""
        turned = RationalExpr(self.ring.constant(side))
        theirs = {k: multiply(one, turned) for k, one in written.items()}
        key = [row[0] for row in self._key("lambda")]
        if len(theirs) < len(key):
            if self.is_other:
                return ""
            mine, wanted = tuple(theirs.values()), tuple(key[k] for k in theirs)
        else:
            mine = self._forces(self.rows, [theirs[k] for k in range(len(key))])
            wanted = self._forces(self._key("Ac"), key)
        if not any(accelerations_in(self.robot, one) for one in written.values()):
            return self._agree((mine,), (wanted,))
        return IN_MOTION if self._close((mine,), (wanted,), self._motions) else ""

    def missed(self, written: Iterable[RationalExpr]) -> Missed | None:
        """The equations of motion, which multipliers with accelerations in them do not satisfy."""
        holds_accelerations = any(accelerations_in(self.robot, one) for one in written)
        return Missed(_EQUATIONS, is_one_of_many=True) if holds_accelerations else None

    def accelerations(self, entries: Sequence[RationalExpr]) -> bool:
        """Whether accelerations that forces make are the key's, for every state or where h = 0."""
        return bool(self._agree(tuple((entry,) for entry in entries), self._key("qdd_forward")))

    def _forces(self, A: Rows, multipliers: Sequence[RationalExpr]) -> tuple[RationalExpr, ...]:
        """A_cᵀ λ"""
        zero = self.ring.zero
        return tuple(summed(map(multiply, column, multipliers), zero) for column in zip(*A, strict=True))

    def _rate(self, entry: RationalExpr) -> RationalExpr:
        """d/dt of a fraction."""
        above, below = entry.numerator, entry.denominator
        rate = self.ring.time_derivative
        if entry.divisor is None:
            return RationalExpr(rate(above))
        return RationalExpr(rate(above) * below - above * rate(below), below * below)

    # -- equality, for every state or on the constraint --------------------------------------------

    def _agree(self, mine: Rows, theirs: Rows) -> str:
        if [len(row) for row in mine] != [len(row) for row in theirs]:
            return ""
        if same(mine, theirs):
            return SAME_CONSTRAINT
        return ON_CONSTRAINT if self._close(mine, theirs, self.states) else ""

    def _close(self, mine: Rows, theirs: Rows, states: Sequence[Mapping[str, float]]) -> bool:
        return bool(states) and all(self._gap(mine, theirs, at) < _CLOSE for at in states)

    def _gap(self, mine: Rows, theirs: Rows, at: Mapping[str, float]) -> float:
        ours, keys = self._numbers(mine, at), self._numbers(theirs, at)
        if ours is None or keys is None:
            return float("inf")
        size = max((1.0, *(abs(x) for row in keys for x in row)))
        return (
            max(
                abs(a - b)
                for row, other in zip(ours, keys, strict=True)
                for a, b in zip(row, other, strict=True)
            )
            / size
        )

    def _numbers(self, rows: Rows, at: Mapping[str, float]) -> list[list[float]] | None:
        try:
            return self._required(rows, at)
        except (ValueError, ZeroDivisionError):
            return None

    # -- states on the constraint ------------------------------------------------------------------

    @cached_property
    def states(self) -> list[dict[str, float]]:
        """States with h = 0 and A_c q̇ = 0."""
        tried = map(self._state, islice(samples(self.ring), _TRIES))
        return list(islice((state for state in tried if state is not None), STATES))

    @cached_property
    def _motions(self) -> list[dict[str, float]]:
        """The same, each with the accelerations that its forces make: D q̈ + C q̇ + g = τ + Q + A_cᵀ λ."""
        return [{**at, **self._accelerations(at)} for at in self.states]

    def _accelerations(self, at: Mapping[str, float]) -> dict[str, float]:
        names = [q.acceleration for q in self.robot.coordinates]
        tau = self._key("tau")

        def moving(name: str = "") -> list[float]:
            still = {**at, **dict.fromkeys(names, 0.0)}
            return [row[0] for row in self._required(tau, still | ({name: 1.0} if name else {}))]

        rest, loads = moving(), outside_forces(self.robot, at)
        motors = [0.0 if k in self.robot.actions.passive else at[x] for k, x in enumerate(self.robot.inputs)]
        forces = self._forces(self._key("Ac"), [row[0] for row in self._key("lambda")])
        columns = [[x - y for x, y in zip(moving(name), rest, strict=True)] for name in names]
        right = [
            value_at(held, at) + motor + load - force
            for held, motor, load, force in zip(forces, motors, loads, rest, strict=True)
        ]
        return dict(zip(names, solved(list(zip(*columns, strict=True)), right), strict=True))

    def _state(self, at: dict[str, float]) -> dict[str, float] | None:
        try:
            if not self._moved_to_zero(at):
                return None
            rates = [at[q.velocity] for q in self.robot.coordinates]
            for row in orthonormal(self._required(self._key("Ac"), at)):
                along = sum(a * b for a, b in zip(row, rates, strict=True))
                rates = [b - along * a for a, b in zip(row, rates, strict=True)]
        except (ValueError, ZeroDivisionError):
            return None
        return {**at, **{q.velocity: rate for q, rate in zip(self.robot.coordinates, rates, strict=True)}}

    def _required(self, rows: Rows, at: Mapping[str, float]) -> list[list[float]]:
        return [[value_at(entry, at) for entry in row] for row in rows]

    def _moved_to_zero(self, at: dict[str, float]) -> bool:
        """Newton's method towards h = 0, by the shortest steps Aᵀ (A Aᵀ)⁻¹ h."""
        holonomic = [i for i, one in enumerate(self.robot.questions.constraints) if not one.in_rates]
        matrix, functions = self._key("Ac"), self._key("hc") if holonomic else ()
        for _ in range(_STEPS):
            h = [row[0] for row in self._required(functions, at)]
            if all(abs(x) < 1e-13 for x in h):
                return True
            A = self._required(tuple(matrix[i] for i in holonomic), at)
            square = [[sum(a * b for a, b in zip(row, other, strict=True)) for other in A] for row in A]
            step = solved(square, h)
            for k, q in enumerate(self.robot.coordinates):
                at[q.name] -= sum(row[k] * x for row, x in zip(A, step, strict=True))
        return False


def _moves_alike(case: Case) -> bool:
    """Whether accelerations differ from the key's only where the constraints do not hold."""
    is_held = bool(case.robot.questions.constraints)
    return is_held and OwnConstraint(case.robot, case.result).accelerations(case.entries)


EQUIVALENCES = (right_as(ON_CONSTRAINT, _moves_alike, "qdd_forward"),)


def _unbalanced(case: Case) -> Missed | None:
    """The equation of multipliers where many satisfy it, of which the key is one."""
    A: Matrix = case.result("Ac")
    has_many = rank_parts(A).rank < len(A.rows)
    return Missed(_EQUATIONS, is_one_of_many=True) if has_many else None


MISSED = {"lambda": _unbalanced}
