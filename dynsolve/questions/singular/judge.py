"""Verdicts on sets of singular configurations: whether the Jacobian loses rank there, and nowhere else."""

from __future__ import annotations

from functools import cached_property

from dynsolve.derivation.configurations import rank_of, states_of
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.equation_sets import ANYWHERE, NEVER_HOLDS, EquationSet, turning_in
from dynsolve.questions.judging import Alternatives, Fault, Judged, SetKey, SetVerdict, by_code
from dynsolve.questions.singular.forms import SingularForms


class SingularKey(SetKey):
    """The singular configurations of one problem."""

    faults = NEVER_HOLDS | by_code(
        Fault("configurations_missing", "a case",
              "{where}, the Jacobian loses rank, and no alternative of yours holds.",
              "Write the determinant as a product: each of its factors is a case."),
        Fault("not_singular", "a case",
              "{where}, alternative {number} holds, and the Jacobian has its full rank.",
              "Put such a configuration into the Jacobian."),
    )  # fmt: skip

    def __init__(self, judged: Judged, name: str) -> None:
        super().__init__(judged, name)
        self.vanishing = "det" if "det" in judged.values.rules else ""

    @cached_property
    def _set(self) -> EquationSet:
        judged, shown = self.judged, SingularForms(self.robot, self.judged.values)
        (name,) = judged.values.rules["singular"].inputs
        form, found = self.forms(name), shown.singular_set
        assert found is not None
        jacobian, rank = compile_trees([form]), found.rank
        return EquationSet(
            self.robot,
            [form],
            shown.singular,
            lambda q: rank_of(jacobian.run(q)[0]) < rank,
            [{**values, **judged.numbers} for values in states_of(self.robot, jacobian)],
            "not_singular",
            "configurations_missing",
            turning_in(self.robot),
        )

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether a set is that of the key; none is right only where there is none."""
        found = self._set.verdict(given)
        if found.is_right and self._set.alternatives and not given:
            return SetVerdict(False, self._set.missing, where=ANYWHERE)
        return found


KEYS = {"singular": SingularKey}
