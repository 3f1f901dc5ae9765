"""The key's sets of configurations and of equations, each judged in the folder of its question."""

from __future__ import annotations

from collections.abc import Mapping, Set
from fractions import Fraction
from functools import cached_property
from typing import Any

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.verdict import ConfigurationAnswer
from dynsolve.derivation.graph import Derivation
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import names_in
from dynsolve.quantities.index import quantities
from dynsolve.questions.equation_sets import vanishing_set
from dynsolve.questions.judging import Fault, Judged, SetKey, SetVerdict, by_code, nodes_of
from dynsolve.robot.model import Robot

_FOREIGN = by_code(
    Fault("foreign_name", "a name", "A name stands in it that has no meaning here.",
          "Write it in the coordinates and parameters of the problem."),
)  # fmt: skip


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
        self.robot, self.values = robot, derivation
        numbers = {name: float(value) for name, value in values.items()}
        self._judged = Judged(robot, derivation, Forms(robot, derivation), numbers, exact)
        self._keys: dict[str, SetKey] = {}

    def __getitem__(self, name: str) -> SetKey:
        """The key of a set."""
        if name not in self._keys:
            judge = quantities(self.robot)[name].family.stage.part("judge")
            self._keys[name] = judge.KEYS[name](self._judged, name)
        return self._keys[name]

    def verdict(self, answer: ConfigurationAnswer) -> SetVerdict:
        """Whether a set is that of the key."""
        if not self._is_known(answer):
            return SetVerdict(False, "foreign_name")
        return self[answer.name].verdict(answer.alternatives)

    def fault(self, name: str, code: str) -> Fault:
        """What is said of a set that is wrong."""
        return _FOREIGN.get(code) or self[name].faults[code]

    def is_where_zero(self, answer: ConfigurationAnswer, value: Any) -> bool:
        """Whether a set is where a value is 0: a determinant, or forces, that are not the key's."""
        if not isinstance(value, Expr | Matrix) or not self._is_known(answer):
            return False
        zeros = self[answer.name].zeros(value)
        if not names_in(*zeros) <= self._names:
            return False
        return (
            vanishing_set(self.robot, zeros, [zeros], self._judged.numbers)
            .verdict(answer.alternatives)
            .is_right
        )

    def _is_known(self, answer: ConfigurationAnswer) -> bool:
        """Whether every name in an answer has a value here."""
        return names_in(*nodes_of(answer.alternatives)) <= self._names | self[answer.name].names

    @cached_property
    def _names(self) -> Set[str]:
        """What stands in sets of every kind."""
        return {"pi", *self.robot.ring.parameters, *(q.name for q in self.robot.coordinates)}
