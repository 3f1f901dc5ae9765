"""Verdicts on equilibria, and on conditions under which gravity is balanced."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.reached import CLOSE
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Matrix, Node, names_in
from dynsolve.notation.unicode import to_unicode
from dynsolve.questions.equation_sets import NEVER_HOLDS, EquationSet, held_equations, vanishing_set
from dynsolve.questions.equilibria.check import (
    balanced_forces,
    balanced_points,
    holding,
    in_balance,
    is_balanced,
)
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.questions.judging import (
    RIGHT,
    Alternatives,
    Fault,
    Judged,
    SetKey,
    SetVerdict,
    by_code,
    nodes_of,
)


class EquilibriaKey(SetKey):
    """The equilibria of one problem."""

    faults = NEVER_HOLDS | by_code(
        Fault("equilibria_missing", "a case",
              "{where}, there is an equilibrium, and no alternative of yours holds.",
              "Look for every solution: where what must be 0 is a product, each of its factors may be 0."),
        Fault("no_equilibrium", "a case",
              "{where}, alternative {number} holds, and the forces are not in balance.",
              "Put such a configuration into {what}, row by row."),
        Fault("off_constraint", "a case",
              "{where}, alternative {number} holds, and the constraint {what} = 0 does not.",
              "Every constraint belongs to the conditions, beside g(q) = A_cᵀ λ."),
    )  # fmt: skip

    def __init__(self, judged: Judged, name: str) -> None:
        super().__init__(judged, name)
        forces = balanced_forces(self.robot)
        self.vanishing = forces if forces in judged.values.rules else ""
        self._shown = EquilibriaForms(self.robot, judged.values)

    @cached_property
    def _set(self) -> EquationSet:
        balanced = self.forms(balanced_forces(self.robot))
        forces = in_balance(self.forms, balanced)
        alternatives = self._shown.equilibria
        if any(self._is_special(one.factor) for one in self.judged.values["equilibria"].special):
            alternatives = (tuple(forces),)
        holds = holding(self.forms, balanced)
        codes = "no_equilibrium", "equilibria_missing"
        return vanishing_set(self.robot, forces, alternatives, self.judged.numbers, holds, *codes)

    def _is_special(self, factor: Expr) -> bool:
        """Whether a factor is 0 for the numbers of the problem, for which the equilibria are others."""
        held, numbers = names_in(self._shown.comparison(factor, "=")), self.judged.numbers
        return held <= numbers.keys() and abs(evaluate(factor, numbers)) < CLOSE

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether a set is that of the key; of one that is not, first whether it keeps the constraints."""
        found = self._set.verdict(given)
        if found.code != "no_equilibrium" or not self.robot.questions.constraints:
            forces = "τ, with constant rates" if self.robot.questions.model.steady else "g(q)"
            return replace(found, what=forces)
        constraints = self.forms("hc")
        assert isinstance(constraints, Matrix)
        for (h,) in constraints.rows:
            kept = vanishing_set(self.robot, [h], (), self.judged.numbers, wrong="off_constraint")
            off = kept.verdict(given)
            if off.code == "off_constraint":
                return replace(off, what=to_unicode(h, PLAIN))
        return replace(found, what="g(q) = A_cᵀ λ")

    def zeros(self, value: Any) -> Sequence[Node]:
        """What is 0 where forces are: those of what no motor holds."""
        return in_balance(self.forms, Compactor(value.ring).matrix(value))


class BalanceKey(SetKey):
    """The conditions under which gravity is balanced, which all hold."""

    faults = by_code(
        Fault("not_balanced", "a condition", "Where your equations hold, gravity is not what it should be.",
              "Every coefficient of a sine, a cosine or a coordinate in g must be 0."),
        Fault("balance_never_holds", "a condition",
              "No values were found for which your equations hold together.",
              "Every coefficient of a sine, a cosine or a coordinate in g must be 0."),
        Fault("condition_too_much", "a condition",
              "Gravity is balanced also where equation {number} does not hold.",
              "Look for the coefficients of g, and ask for no more than that these are 0."),
    )  # fmt: skip

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether gravity is balanced where they hold, and they hold where it is."""
        theirs, gravity = nodes_of(given), self.forms("g")
        key = EquilibriaForms(self.robot, self.judged.values).balance
        points = list(balanced_points(self.robot, theirs))
        if not points:
            return SetVerdict(False, "balance_never_holds")
        if not all(is_balanced(self.robot, gravity, at) for at in points):
            return SetVerdict(False, "not_balanced")
        for number, node in enumerate(theirs, 1):
            condition = held_equations([node], (), ())
            if not all(condition.hold(at) for at in balanced_points(self.robot, key)):
                return SetVerdict(False, "condition_too_much", number)
        return RIGHT


KEYS = {"equilibria": EquilibriaKey, "balance": BalanceKey}
