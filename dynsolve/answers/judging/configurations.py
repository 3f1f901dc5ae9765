"""Verdicts on sets of configurations: singular ones, and the branches of the inverse kinematics.

They are held in numbers, at points of a fixed seed.  A branch is put into r(q) at values that
random configurations reach; it is right where it gives them back, whatever its formula.  Of a set
of equations, points on each alternative are found by Newton's method: at every point of the key
the student's set must hold, and at every point of the student's the Jacobian must lose rank.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import pi

from dynsolve.answers.submission import ConfigurationAnswer, Part
from dynsolve.derivation.configuration_check import (
    CLOSE,
    NO_VALUE,
    near,
    on_branch,
    rank_of,
    reaches,
    same_configuration,
    states_of,
    zero_near,
)
from dynsolve.derivation.graph import Derivation
from dynsolve.explain.configurations import ConfigurationForms
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Arguments, Function, Node
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.notation.walk import mapped, names_in
from dynsolve.robot.model import JointType, Robot


@dataclass(frozen=True, slots=True)
class SetVerdict:
    """Whether a set is right, else the `code` of what is said; `is_incomplete`: right, but not all of it."""

    is_right: bool
    code: str = ""
    number: int = 0
    is_incomplete: bool = False


RIGHT = SetVerdict(True)


class ConfigurationKey:
    """The key's sets of one problem, in numbers; `numbers` are the values that the problem gives."""

    def __init__(self, robot: Robot, values: Derivation, numbers: Mapping[str, float]) -> None:
        self.robot, self.values, self.numbers = robot, values, numbers
        self.forms = Forms(robot, values)
        self.shown = ConfigurationForms(robot, values)

    def verdict(self, answer: ConfigurationAnswer) -> SetVerdict:
        """Whether a set is that of the key."""
        if not self._known(answer):
            return SetVerdict(False, "foreign_name")
        if answer.name == "inverse":
            return self._branches(answer.alternatives)
        return self._equations(answer.alternatives)

    def is_skipped(self, name: str) -> bool:
        """Whether the key has no set of that name, because it would be too long."""
        return name == "singular" and self.shown.singular_set is None

    def _known(self, answer: ConfigurationAnswer) -> bool:
        """Whether every name in an answer has a value here."""
        names = {"pi", *self.robot.ring.parameters, *(q.name for q in self.robot.coordinates)}
        if answer.name == "inverse":
            names |= set(self.robot.questions.reached)
        return names_in(*(part.node for one in answer.alternatives for part in one)) <= names

    def _states(self) -> Iterator[dict[str, float]]:
        return ({**values, **self.numbers} for values in states_of(self.robot))

    # -- branches ----------------------------------------------------------------------------------

    def _branches(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        found = self._compared([{part.coordinate: part.node for part in one} for one in given])
        if found.is_right:
            return found
        other = [{part.coordinate: mapped(part.node, _turned_round) for part in one} for one in given]
        return SetVerdict(False, "atan2_order") if self._compared(other).is_right else found

    def _compared(self, given: Sequence[Mapping[str, Node]]) -> SetVerdict:
        free = self.shown.solved.solving.free if self.shown.solved is not None else ()
        names = {q.name for q in self.robot.coordinates} - set(free)
        for number, branch in enumerate(given, 1):
            if not names <= branch.keys():
                return SetVerdict(False, "branch_lacks_coordinate", number)
        met = [False] * len(given)
        is_incomplete = False
        for values in self._states():
            reached = reaches(self._task, values)
            at = {name: value for name, value in values.items() if name not in names}
            at |= dict(zip(self.robot.questions.reached, reached, strict=True))
            theirs = [on_branch(_in_order(branch), at) for branch in given]
            for number, q in enumerate(theirs, 1):
                if q is not None:
                    met[number - 1] = True
                    if not near(reaches(self._task, q), reached):
                        return SetVerdict(False, "branch_misses", number)
            mine = [q for q in (on_branch(branch, at) for branch in self.shown.inverse) if q is not None]
            present = [q for q in theirs if q is not None]
            is_incomplete = is_incomplete or not all(
                any(same_configuration(self.robot, q, other) for other in present) for q in mine
            )
        if not all(met):
            return SetVerdict(False, "branch_never_exists", met.index(False) + 1)
        if is_incomplete and self.robot.questions.all_branches:
            return SetVerdict(False, "branches_missing")
        return SetVerdict(True, is_incomplete=is_incomplete)

    @cached_property
    def _task(self) -> Program:
        (task,) = self.values.rules["inverse"].inputs
        return compile_trees([self.forms(task)])

    # -- equations ---------------------------------------------------------------------------------

    def _equations(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        theirs = [compile_trees([part.node for part in one]) for one in given]
        for conditions in self.shown.singular:
            for q in self._points(compile_trees(conditions)):
                if not any(_holds(program, q) for program in theirs):
                    return SetVerdict(False, "configurations_missing")
        assert self.shown.singular_set is not None
        rank = self.shown.singular_set.rank
        for number, program in enumerate(theirs, 1):
            points = list(self._points(program))
            if not points:
                return SetVerdict(False, "condition_never_holds", number)
            if any(rank_of(self._jacobian.run(q)[0]) >= rank for q in points):
                return SetVerdict(False, "not_singular", number)
        return RIGHT if theirs or not self.shown.singular else SetVerdict(False, "configurations_missing")

    @cached_property
    def _jacobian(self) -> Program:
        (name,) = self.values.rules["singular"].inputs
        return compile_trees([self.forms(name)])

    def _points(self, zeros: Program) -> Iterator[dict[str, float]]:
        """Configurations at which everything is 0, looked for all around the circle."""
        turning = [q.name for q in self.robot.coordinates if q.type is JointType.REVOLUTE]
        for values in self._states():
            turned = {name: values[name] + pi for name in turning}
            for start in (values, {**values, **turned}):
                found = zero_near(self.robot, zeros, start)
                if found is not None:
                    yield found


def _holds(program: Program, q: Mapping[str, float]) -> bool:
    try:
        return all(abs(value) < CLOSE for value in program.run(q))
    except NO_VALUE:
        return False


def _in_order(branch: Mapping[str, Node]) -> dict[str, Node]:
    """The formulas, each behind those whose coordinates stand in it."""
    ordered: dict[str, Node] = {}
    left = dict(branch)
    while left:
        ready = [name for name, node in left.items() if not (names_in(node) - {name}) & left.keys()]
        for name in ready or list(left):
            ordered[name] = left.pop(name)
    return ordered


def _turned_round(part: Node) -> Node:
    """atan2(x, y) for atan2(y, x)."""
    if isinstance(part, Function) and isinstance(part.argument, Arguments) and part.name == "atan2":
        y, x = part.argument.parts
        return Function("atan2", Arguments((x, y)))
    return part
