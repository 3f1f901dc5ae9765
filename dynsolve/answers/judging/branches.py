"""Verdicts on the branches of the inverse kinematics, whose values of the task are names.

A branch is put into r(q) at values that configurations in all quadrants reach, within the limits of the
joints where there are any; it is right where it gives them back, whatever its formula.

What is found of a set of configurations.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.verdict import Part
from dynsolve.derivation.configurations import reaches, solution_of
from dynsolve.derivation.reached import angle_rows, near, same_configuration
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.text import ARCS
from dynsolve.notation.tree import Function, Node, Symbol, names_in, walk, with_atan2_exchanged
from dynsolve.notation.tree_values import compile_trees
from dynsolve.notation.unicode import to_unicode
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.robot.model import Robot

# What is found of a set of configurations


class SetVerdict(Struct, frozen=True):
    """Whether a set is right, else the `code` of what is said of alternative `number`, and `where`.

    `notes` are what is said of one that is right.
    """

    is_right: bool
    code: str = ""
    number: int = 0
    notes: tuple[str, ...] = ()
    where: str = ""


RIGHT = SetVerdict(True)

INCOMPLETE = "incomplete"
"""The note of an answer that has some of the branches, all right."""

Formulas = Mapping[str, Node]
"""A branch: the formula of each coordinate."""


class _Place(Struct, frozen=True):
    """Values of the task that are reached, by name too, with the key's branches that are right there.

    The others are there, but their conditions do not hold.
    """

    at: Mapping[str, float]
    reached: Sequence[float]
    right: Sequence[Mapping[str, float]]
    others: Sequence[Mapping[str, float]]


class BranchKey:
    """The branches of one problem; `r` is its task and `task` the formula of that.

    `states` are configurations with values for the parameters.
    """

    def __init__(
        self,
        robot: Robot,
        r: Matrix,
        task: Node,
        shown: InverseForms,
        states: Sequence[Mapping[str, float]],
    ) -> None:
        self.robot, self.shown, self.states = robot, shown, states
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

    @cached_property
    def _places(self) -> list[_Place]:
        """What is to be reached at each state, and what the key has there."""
        solutions = [solution_of(branch) for branch in self.shown.inverse]
        found = []
        for values in self.states:
            reached = reaches(self._task, values)
            at = {name: value for name, value in values.items() if name not in self._names}
            at |= dict(zip(self.robot.questions.reached, reached, strict=True))
            sides: dict[bool, list[Mapping[str, float]]] = {True: [], False: []}
            for q in (solution(at) for solution in solutions):
                if q is not None:
                    sides[self._reaches(q, reached)].append(q)
            found.append(_Place(at, reached, sides[True], sides[False]))
        return found

    def _reaches(self, q: Mapping[str, float], reached: Sequence[float]) -> bool:
        return near(reaches(self._task, q), reached, self._angles)

    def _is_among(self, q: Mapping[str, float], others: Iterable[Mapping[str, float]]) -> bool:
        return any(same_configuration(self.robot.ring, q, other) for other in others)

    def _compared(self, given: Sequence[Formulas]) -> SetVerdict:
        for number, branch in enumerate(given, 1):
            if not self._names <= branch.keys():
                return lacking(number, self._names - branch.keys())
        theirs = [solution_of(in_order(branch)) for branch in given]
        met: list[set[bool]] = [set() for _ in given]
        is_incomplete = not given
        for place in self._places:
            present = []
            for solution, seen in zip(theirs, met, strict=True):
                q = solution(place.at)
                if q is not None and not self._is_among(q, place.others):
                    present.append(q)
                    seen.add(self._reaches(q, place.reached))
            is_incomplete = is_incomplete or not all(self._is_among(q, present) for q in place.right)
        for number, (branch, seen) in enumerate(zip(given, met, strict=True), 1):
            if seen == {True, False}:
                is_half = _has_half_a_turn(branch)
                return SetVerdict(False, "quadrant_lost" if is_half else "branch_sometimes_misses", number)
            if seen != {True}:
                return SetVerdict(False, "branch_misses" if seen else "branch_never_exists", number)
        if is_incomplete and (self.robot.questions.all_branches or not given):
            most = max(len(place.right) for place in self._places)
            return SetVerdict(False, "branches_missing" if given else "is_reachable", where=f"{most}")
        return SetVerdict(True, notes=(INCOMPLETE,) if is_incomplete else ())


def lacking(number: int, names: Iterable[str]) -> SetVerdict:
    """What is said of a branch without formulas for some coordinates."""
    told = " and no ".join(to_unicode(Symbol(name), PLAIN) for name in sorted(names))
    return SetVerdict(False, "branch_lacks_coordinate", number, where=told)


def _has_half_a_turn(branch: Formulas) -> bool:
    """Whether an angle comes from a function whose values go half way round."""
    parts = (part for node in branch.values() for part in walk(node))
    return any(isinstance(part, Function) and part.name in {*ARCS} - {"atan2"} for part in parts)


def branches_of(alternatives: Sequence[Sequence[Part]]) -> list[dict[str, Node]]:
    """The alternatives as formulas by coordinate; what is given once, behind ±, belongs to all of them."""
    counts = Counter(part.coordinate for one in alternatives for part in one)
    once = {
        part.coordinate: part.node for one in alternatives for part in one if counts[part.coordinate] == 1
    }
    return [once | {part.coordinate: part.node for part in one} for one in alternatives]


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
