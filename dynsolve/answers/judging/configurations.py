"""Verdicts on sets of configurations: singular ones, and the branches of the inverse kinematics.

They are held in numbers, at points of a fixed seed.  A branch is put into r(q) at values that
configurations of samples reach; it is right where it gives them back, whatever its formula.  Of a set
of equations, points on each alternative are found by Newton's method: at every point of the key
the student's set must hold, and at every point of the student's the Jacobian must lose rank.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.floats import evaluate
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.sampling import WIDEST
from dynsolve.answers.judging.branches import BranchKey
from dynsolve.answers.judging.equilibria import EquilibriumKey
from dynsolve.answers.judging.example_point import example_point
from dynsolve.answers.judging.held_equations import held_equations
from dynsolve.answers.judging.set_verdict import RIGHT, SetVerdict
from dynsolve.answers.submission import ConfigurationAnswer, Part
from dynsolve.derivation.balance_check import balanced_points, is_balanced
from dynsolve.derivation.configuration_check import (
    rank_of,
    states_of,
    with_half_turns,
    zero_near,
)
from dynsolve.derivation.equilibrium_check import balanced_forces, in_balance
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.reached import CLOSE
from dynsolve.explain.forms import Forms
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.notation.walk import names_in
from dynsolve.robot.model import JointType, Robot

if TYPE_CHECKING:
    from dynsolve.answers.judging.target_branches import TargetKey
    from dynsolve.derivation.reduced_check import ConstrainedStates


SETS = ("singular", "equilibria", "balance", "reduced")
"""The sets of equations."""


class ConfigurationKey:
    """The key's sets of one problem, in numbers; `values` are those that the problem gives.

    `exact` are the decimals that stand in its file.
    """

    def __init__(
        self,
        robot: Robot,
        derivation: Derivation,
        values: Mapping[str, Fraction],
        exact: frozenset[Fraction] = frozenset(),
    ) -> None:
        self.robot, self.values, self.exact = robot, derivation, exact
        self.numbers = {name: float(value) for name, value in values.items()}
        self.forms = Forms(robot, derivation)
        self.shown = ConfigurationForms(robot, derivation)

    def verdict(self, answer: ConfigurationAnswer) -> SetVerdict:
        """Whether a set is that of the key."""
        if not self._known(answer):
            return SetVerdict(False, "foreign_name")
        if answer.name == "inverse":
            return self._branches.verdict(answer.alternatives)
        if answer.name == "equilibria":
            return self._equilibria.verdict(answer.alternatives)
        if answer.name == "balance":
            return self._balance(answer.alternatives)
        if answer.name == "reduced":
            return self._reduced(answer.alternatives)
        return self._equations(answer.alternatives)

    def vanishing(self, name: str) -> str:
        """What is 0 on a set: the determinant, or the forces; empty for any other set."""
        found = {"singular": "det", "equilibria": balanced_forces(self.robot)}.get(name, "")
        return found if found in self.values.rules else ""

    def is_where_zero(self, answer: ConfigurationAnswer, value: Any) -> bool:
        """Whether a set is where a value is 0: a determinant, or forces, that are not the key's."""
        if not isinstance(value, Expr | Matrix) or not self._known(answer):
            return False
        compactor = Compactor(value.ring)
        zeros = (
            [compactor.form(value)]
            if isinstance(value, Expr)
            else in_balance(self.robot, compactor.matrix(value))
        )
        if not names_in(*zeros) <= self._names:
            return False
        return EquilibriumKey(self.robot, zeros, [zeros], self.numbers).verdict(answer.alternatives).is_right

    def is_skipped(self, name: str) -> bool:
        """Whether the key has no set of that name, because it would be too long."""
        if name == "inverse" and self.robot.questions.target is not None:
            return self.shown.target is None
        if isinstance(self.values[name], Skipped):
            return name in SETS
        return name == "reduced" and not self._constrained.all

    @cached_property
    def _branches(self) -> BranchKey | TargetKey:
        if self.shown.target is not None:
            from dynsolve.answers.judging.target_branches import TargetKey

            return TargetKey(self.shown.target, self.exact, self.robot.questions.all_branches)
        (task,) = self.values.rules["inverse"].inputs
        form = self.forms(task)
        states = [*map(self._limited, self._states(compile_trees([form])))]
        return BranchKey(self.robot, self.values[task], form, self.shown, states)

    @cached_property
    def _equilibria(self) -> EquilibriumKey:
        forces = in_balance(self.robot, self.forms(balanced_forces(self.robot)))
        alternatives = self.shown.equilibria
        if any(self._is_special(one.factor) for one in self.values["equilibria"].special):
            alternatives = (tuple(forces),)
        return EquilibriumKey(self.robot, forces, alternatives, self.numbers)

    def _is_special(self, factor: Expr) -> bool:
        """Whether a factor is 0 for the numbers of the problem, for which the equilibria are others."""
        held = names_in(self.shown.comparison(factor, "="))
        return held <= self.numbers.keys() and abs(evaluate(factor, self.numbers)) < CLOSE

    def _balance(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        """Conditions that all hold: whether gravity is balanced where they do, and they do where it is."""
        theirs = [part.node for one in given for part in one]
        gravity = self.forms("g")
        points = list(balanced_points(self.robot, theirs))
        if not points:
            return SetVerdict(False, "balance_never_holds")
        if not all(is_balanced(self.robot, gravity, at) for at in points):
            return SetVerdict(False, "not_balanced")
        for number, node in enumerate(theirs, 1):
            condition = held_equations([node], (), ())
            if not all(condition.hold(at) for at in balanced_points(self.robot, self.shown.balance)):
                return SetVerdict(False, "condition_too_much", number)
        return RIGHT

    def _reduced(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        """Equations of motion without multipliers: whether each holds, and they are enough."""
        theirs = [part.node for one in given for part in one]
        for number, node in enumerate(theirs, 1):
            if not self._constrained.hold(node):
                return SetVerdict(False, "motion_differs", number)
        enough = bool(theirs) and self._constrained.are_enough(theirs)
        return RIGHT if enough else SetVerdict(False, "motions_missing")

    @cached_property
    def _constrained(self) -> ConstrainedStates:
        from dynsolve.derivation.reduced_check import ConstrainedStates, constrained_names

        forms = {name: self.forms(name) for name in constrained_names(self.robot)}
        return ConstrainedStates(self.robot, forms, self.numbers)

    def _known(self, answer: ConfigurationAnswer) -> bool:
        """Whether every name in an answer has a value here."""
        names = self._names
        if answer.name == "reduced":
            names = names | {q.force for q in self.robot.coordinates}
        if answer.name == "inverse":
            names = names | set(self.robot.questions.reached)
        return names_in(*(part.node for one in answer.alternatives for part in one)) <= names

    @cached_property
    def _names(self) -> Set[str]:
        """What stands in sets of every kind."""
        return {"pi", *self.robot.ring.parameters, *(q.name for q in self.robot.coordinates)}

    def _states(self, program: Program) -> list[dict[str, float]]:
        return [{**values, **self.numbers} for values in states_of(self.robot, program)]

    def _limited(self, values: Mapping[str, float]) -> dict[str, float]:
        """The configuration, moved into the limits of the joints in proportion."""
        limited = dict(values)
        for one in self.robot.questions.limits:
            low, high = compile_trees([one.low, one.high]).run(values)
            widest = pi if one.coordinate in self._turning else WIDEST
            limited[one.coordinate] = low + (high - low) * (values[one.coordinate] + widest) / (2 * widest)
        return limited

    # -- equations ---------------------------------------------------------------------------------

    def _equations(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        names, turning = [q.name for q in self.robot.coordinates], self._turning
        theirs = [held_equations((part.node for part in one), names, turning) for one in given]
        formulas = [self._jacobian_form, *(part.node for one in given for part in one)]
        for number, one in enumerate(theirs, 1):
            points = list(self._points(one.program))
            if not points:
                return SetVerdict(False, "condition_never_holds", number)
            if not all(map(self._is_singular, points)):
                where = example_point(self.robot, formulas, points, one.hold, self._is_singular)
                return SetVerdict(False, "not_singular", number, where=where)

        def is_met(q: Mapping[str, float]) -> bool:
            return any(one.hold(q) for one in theirs)

        alternatives = map(compile_trees, self.shown.singular)
        missed = [q for one in alternatives for q in self._points(one) if not is_met(q)]
        if not missed and (theirs or not self.shown.singular):
            return RIGHT
        shown = missed if theirs else []
        where = example_point(self.robot, formulas, shown, self._is_singular, is_met)
        return SetVerdict(False, "configurations_missing", where=where)

    def _is_singular(self, q: Mapping[str, float]) -> bool:
        assert self.shown.singular_set is not None
        return rank_of(self._jacobian.run(q)[0]) < self.shown.singular_set.rank

    @cached_property
    def _jacobian_form(self) -> Node:
        (name,) = self.values.rules["singular"].inputs
        return self.forms(name)

    @cached_property
    def _jacobian(self) -> Program:
        return compile_trees([self._jacobian_form])

    @cached_property
    def _turning(self) -> tuple[str, ...]:
        return tuple(q.name for q in self.robot.coordinates if q.type is JointType.REVOLUTE)

    @cached_property
    def _starts(self) -> list[dict[str, float]]:
        return self._states(self._jacobian)

    def _points(self, zeros: Program) -> Iterator[dict[str, float]]:
        """Configurations at which everything is 0, looked for from all quadrants."""
        found = (zero_near(self.robot, zeros, start) for start in self._starts)
        return with_half_turns(self.robot, zeros, (q for q in found if q is not None))
