"""Verdicts on the branches of the inverse kinematics, whose values of the task are names.

A branch is put into r(q) at values that random configurations reach, of a fixed seed; it is right
where it gives them back, whatever its formula.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.set_verdict import INCOMPLETE, SetVerdict
from dynsolve.answers.submission import Part
from dynsolve.derivation.configuration_check import on_branch, reaches, states_of
from dynsolve.derivation.reached import angle_rows, near, same_configuration
from dynsolve.explain.configurations import ConfigurationForms
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.notation.walk import names_in, with_atan2_exchanged
from dynsolve.robot.model import Robot

Formulas = Mapping[str, Node]
"""A branch: the formula of each coordinate."""


class BranchKey:
    """The branches of one problem; `r` is its task and `task` the formula of that.

    `numbers` are the values that the problem gives.
    """

    def __init__(
        self, robot: Robot, r: Matrix, task: Node, shown: ConfigurationForms, numbers: Mapping[str, float]
    ) -> None:
        self.robot, self.shown, self.numbers = robot, shown, numbers
        self._task, self._angles = compile_trees([task]), angle_rows(r)

    def verdict(self, alternatives: Sequence[Sequence[Part]]) -> SetVerdict:
        """Whether branches are right."""
        given = branches_of(alternatives)
        found = self._compared(given)
        if found.is_right or not self._compared(turned_round(given)).is_right:
            return found
        return SetVerdict(False, "atan2_order")

    @cached_property
    def _names(self) -> frozenset[str]:
        """The coordinates that a branch must give."""
        free = self.shown.solved.solving.free if self.shown.solved is not None else ()
        return frozenset(q.name for q in self.robot.coordinates) - set(free)

    def _compared(self, given: Sequence[Formulas]) -> SetVerdict:
        names = self._names
        for number, branch in enumerate(given, 1):
            if not names <= branch.keys():
                return SetVerdict(False, "branch_lacks_coordinate", number)
        met = [False] * len(given)
        is_incomplete = not given
        for values in self._states():
            reached = reaches(self._task, values)
            at = {name: value for name, value in values.items() if name not in names}
            at |= dict(zip(self.robot.questions.reached, reached, strict=True))
            theirs = [on_branch(in_order(branch), (), at) for branch in given]
            for number, q in enumerate(theirs, 1):
                if q is not None:
                    met[number - 1] = True
                    if not near(reaches(self._task, q), reached, self._angles):
                        return SetVerdict(False, "branch_misses", number)
            branches = zip(self.shown.inverse, self.shown.when, strict=True)
            mine = [q for q in (on_branch(*branch, at) for branch in branches) if q is not None]
            present = [q for q in theirs if q is not None]
            is_incomplete = is_incomplete or not all(
                any(same_configuration(self.robot.ring, q, other) for other in present) for q in mine
            )
        if not all(met):
            return SetVerdict(False, "branch_never_exists", met.index(False) + 1)
        if is_incomplete and (self.robot.questions.all_branches or not given):
            return SetVerdict(False, "branches_missing" if given else "is_reachable")
        return SetVerdict(True, notes=(INCOMPLETE,) if is_incomplete else ())

    def _states(self) -> Iterator[dict[str, float]]:
        return ({**values, **self.numbers} for values in states_of(self.robot))


def branches_of(alternatives: Sequence[Sequence[Part]]) -> list[dict[str, Node]]:
    """The alternatives as formulas by coordinate."""
    return [{part.coordinate: part.node for part in one} for one in alternatives]


def turned_round(given: Sequence[Formulas]) -> list[dict[str, Node]]:
    """The branches with atan2(x, y) for atan2(y, x)."""
    return [{name: with_atan2_exchanged(node) for name, node in branch.items()} for branch in given]


def in_order(branch: Formulas) -> dict[str, Node]:
    """The formulas, each behind those whose coordinates stand in it."""
    ordered: dict[str, Node] = {}
    left = dict(branch)
    while left:
        ready = [name for name, node in left.items() if not (names_in(node) - {name}) & left.keys()]
        for name in ready or list(left):
            ordered[name] = left.pop(name)
    return ordered
