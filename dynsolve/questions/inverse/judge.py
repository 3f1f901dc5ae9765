"""Verdicts on the branches of the inverse kinematics, and on configurations that are to reach numbers.

Where the values of the task are names, a branch is put into r(q) at values that configurations in all
quadrants reach, within the limits of the joints where there are any; it is right where it gives them back,
whatever its formula.

Where they are numbers, each configuration is compared with those of the key; one that is none of these is
right where r(q) gives the target.  A decimal that may have been rounded stands for its interval, so that a
coordinate may be off by what all decimals of its branch do to it together.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING

from msgspec import Struct

from dynsolve.algebra.rationals import half_unit
from dynsolve.algebra.sampling import WIDEST
from dynsolve.derivation.configurations import on_branch, reaches, solution_of, states_of
from dynsolve.derivation.reached import CLOSE, angle_rows, gap, near, same_configuration
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.text import ARCS
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Symbol,
    mapped,
    names_in,
    walk,
    with_atan2_exchanged,
)
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.notation.unicode import to_unicode
from dynsolve.questions.equation_sets import turning_in
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.judging import Alternatives, Fault, Judged, SetKey, SetVerdict, by_code

if TYPE_CHECKING:
    from dynsolve.questions.inverse.target import Configuration, TargetForms

INCOMPLETE = "incomplete"
"""The note of an answer that has some of the branches, all right."""

Formulas = Mapping[str, Node]
"""A branch: the formula of each coordinate."""


class InverseKey(SetKey):
    """What is right of one problem; `shown` are the formulas of its branches."""

    faults = by_code(
        Fault("atan2_order", "the order of atan2", "The arguments of atan2 are exchanged: it takes y first.",
              "atan2(y, x) is the angle of the point (x, y)."),
        Fault("quadrant_lost", "a quadrant",
              "Branch {number} gives the values of the task in some quadrants only.",
              "arctan(y/x), arcsin and arccos go half way round; atan2(y, x) looks at both signs."),
        Fault("branch_misses", "a branch", "Branch {number} does not give the values of the task.",
              "Put the branch into r(q), at values for which you know a configuration."),
        Fault("branch_sometimes_misses", "a branch",
              "Branch {number} gives the values of the task at some configurations only.",
              "Put the branch into r(q), at values for which you know a configuration."),
        Fault("branch_never_exists", "a branch",
              "Branch {number} gives no configuration at values that the arm reaches.",
              "Look at the arguments of roots, arccos and arcsin, and at what each formula needs."),
        Fault("branch_not_real", "a branch", "Branch {number} gives no real configuration for these numbers.",
              "Look at the arguments of roots, arccos and arcsin."),
        Fault("target_missed", "a branch", "Branch {number} does not reach the target.",
              "Put it into r(q), and compare with the numbers that were given."),
        Fault("out_of_reach", "a branch",
              "No configuration reaches these numbers, and branch {number} does not.",
              "Compare the distance of the target with the longest and the shortest that the arm can make."),
        Fault("is_reachable", "a branch", "There are configurations that reach these values.",
              "Compare the distance of the target with the longest and the shortest that the arm can make."),
        Fault("branch_lacks_coordinate", "a branch", "Branch {number} gives no {where}.",
              "A branch is a formula for each coordinate."),
        Fault("branches_missing", "a branch",
              "Your branches are right, and some are missing: "
              "up to {where} configurations give the same values.",
              "A root, an arccos and an arcsin leave two values each."),
    )  # fmt: skip

    def __init__(self, judged: Judged, name: str, shown: InverseForms) -> None:
        super().__init__(judged, name)
        self.names = set(self.robot.questions.reached)
        self.shown = shown


# Branches whose values of the task are names


class _Place(Struct, frozen=True):
    """Values of the task that are reached, by name too, with the key's branches that are right there.

    The others are there, but their conditions do not hold.
    """

    at: Mapping[str, float]
    reached: Sequence[float]
    right: Sequence[Mapping[str, float]]
    others: Sequence[Mapping[str, float]]


class BranchKey(InverseKey):
    """The branches of one problem."""

    is_skipped = False

    @cached_property
    def _task(self) -> Program:
        return compile_trees([self.forms(self.shown.task)])

    @cached_property
    def _angles(self) -> Sequence[bool]:
        return angle_rows(self.judged.values[self.shown.task])

    def _limited(self, values: Mapping[str, float]) -> dict[str, float]:
        """The configuration, moved into the limits of the joints in proportion."""
        limited = dict(values)
        for one in self.robot.questions.limits:
            low, high = compile_trees([one.low, one.high]).run(values)
            widest = pi if one.coordinate in turning_in(self.robot) else WIDEST
            limited[one.coordinate] = low + (high - low) * (values[one.coordinate] + widest) / (2 * widest)
        return limited

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether branches are right."""
        branches = branches_of(given)
        found = self._compared(branches)
        if found.is_right or not self._compared(turned_round(branches)).is_right:
            return found
        return SetVerdict(False, "atan2_order")

    @cached_property
    def _names(self) -> frozenset[str]:
        free = self.shown.solved.solving.free if self.shown.solved is not None else ()
        return frozenset(q.name for q in self.robot.coordinates) - set(free)

    @cached_property
    def _places(self) -> list[_Place]:
        """What is to be reached at each state, and what the key has there."""
        solutions = [solution_of(branch) for branch in self.shown.inverse]
        found = []
        for found_at in states_of(self.robot, self._task):
            values = self._limited({**found_at, **self.judged.numbers})
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

    def _is_there(self, q: Mapping[str, float], reached: Sequence[float]) -> bool | None:
        """Whether a configuration gives what is asked.

        None where lengths have the other sign: where more is asked than joints can do, one root is right.
        """
        found = reaches(self._task, q)
        if near(found, reached, self._angles):
            return True

        def size(values: Sequence[float]) -> list[float]:
            pairs = zip(values, self._angles, strict=True)
            return [value if is_angle else abs(value) for value, is_angle in pairs]

        has_more = len(found) > len(self.robot.coordinates)
        return None if has_more and near(size(found), size(reached), self._angles) else False

    def _is_among(self, q: Mapping[str, float], others: Iterable[Mapping[str, float]]) -> bool:
        return any(same_configuration(self.robot.ring, q, other) for other in others)

    def _compared(self, given: Sequence[Formulas]) -> SetVerdict:
        for number, branch in enumerate(given, 1):
            if not self._names <= branch.keys():
                return lacking(number, self._names - branch.keys())
        theirs = [solution_of(in_order(branch)) for branch in given]
        met: list[set[bool | None]] = [set() for _ in given]
        is_incomplete = not given
        for place in self._places:
            present = []
            for solution, seen in zip(theirs, met, strict=True):
                q = solution(place.at)
                if q is not None and not self._is_among(q, place.others):
                    present.append(q)
                    seen.add(self._is_there(q, place.reached))
            is_incomplete = is_incomplete or not all(self._is_among(q, present) for q in place.right)
        for number, (branch, seen) in enumerate(zip(given, met, strict=True), 1):
            seen = seen - {None} if True in seen else {bool(one) for one in seen}
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


def branches_of(alternatives: Alternatives) -> list[dict[str, Node]]:
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


# Configurations that are to reach a target in numbers

IN_DEGREES = "in_degrees"
"""The note of an answer whose bare numbers are right as degrees."""


class _Given(Struct, frozen=True):
    """A configuration of the student's, with what its decimals may bring the coordinates and r(q) off."""

    values: Mapping[str, float]
    slack: Mapping[str, float]
    task: Sequence[float]
    task_slack: Sequence[float]

    @property
    def is_rounded(self) -> bool:
        """Whether any decimal of it may have been rounded."""
        return any(self.slack.values())


class TargetKey(InverseKey):
    """What reaches the target of one problem."""

    @property
    def is_skipped(self) -> bool:
        """Whether nothing is known that reaches it."""
        return self.shown.target is None

    @cached_property
    def target(self) -> TargetForms:
        """The configurations that reach it."""
        assert self.shown.target is not None
        return self.shown.target

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether configurations are right."""
        branches = branches_of(given)
        found = self._compared(branches)
        if found.is_right:
            return found
        if self._compared(turned_round(branches)).is_right:
            return SetVerdict(False, "atan2_order")
        in_degrees = self._compared([self._in_degrees(branch) for branch in branches])
        if in_degrees.is_right:
            return SetVerdict(True, notes=(IN_DEGREES, *in_degrees.notes))
        return found

    def _compared(self, given: Sequence[Formulas]) -> SetVerdict:
        keys = self.target.configurations
        if not given and (keys or self.target.is_family):
            return SetVerdict(False, "is_reachable")
        free = {name for key in keys for name in key.free}
        met: set[int] = set()
        is_rounded = False
        for number, branch in enumerate(given, 1):
            missing = {name for name, _ in self._coordinates} - free - branch.keys()
            if missing:
                return lacking(number, missing)
            one = self._given(branch)
            if one is None:
                return SetVerdict(False, "branch_not_real", number)
            place = next((i for i, key in enumerate(keys) if self._is(one, key)), None)
            if place is None and not self._reaches(one):
                is_near = bool(keys) or self.target.is_family
                return SetVerdict(False, "target_missed" if is_near else "out_of_reach", number)
            is_rounded = is_rounded or one.is_rounded
            met |= set() if place is None else {place}
        is_incomplete = len(met) < len(keys)
        if is_incomplete and self.robot.questions.all_branches:
            return SetVerdict(False, "branches_missing", where=f"{len(keys)}")
        notes = ((INCOMPLETE, is_incomplete), ("rounded", is_rounded))
        return SetVerdict(True, notes=tuple(note for note, is_so in notes if is_so))

    @property
    def _coordinates(self) -> tuple[tuple[str, str], ...]:
        return self.robot.ring.coordinates

    def _given(self, branch: Formulas) -> _Given | None:
        """The values of a branch, None where it has none."""
        unknown = {name: 0.0 for name, _ in self._coordinates if name not in branch}
        at = {**self.target.numbers, **unknown}
        values = on_branch(in_order(branch), at)
        if values is None:
            return None
        slack, task = dict.fromkeys(values, 0.0), self.target.task_at(values)
        task_slack = [0.0] * len(task)
        for moved in _moved(branch, self.judged.exact):
            there = on_branch(in_order(moved), at)
            if there is None:
                continue
            for name, kind in self._coordinates:
                slack[name] += abs(gap(kind, there[name], values[name]))
            off = zip(task_slack, self.target.task_at(there), task, strict=True)
            task_slack = [total + abs(a - b) for total, a, b in off]
        return _Given(values, slack, task, task_slack)

    def _reaches(self, one: _Given) -> bool:
        """Whether r(q) is the target; where configurations do not stand alone, as near as decimals say."""
        if not self.target.is_family:
            return self.target.reaches(one.values)
        rows = zip(one.task, self.target.wanted, one.task_slack, self.target.angles, strict=True)
        return all(
            abs(gap("revolute" if is_angle else "", a, b)) <= slack * (1 + CLOSE) + CLOSE
            for a, b, slack, is_angle in rows
        )

    def _is(self, one: _Given, key: Configuration) -> bool:
        free = {name: one.values[name] for name in key.free}
        mine = on_branch(key.formulas, {**self.target.numbers, **free}) if free else key.numbers
        return mine is not None and all(
            abs(gap(kind, one.values[name], mine[name])) <= one.slack[name] * (1 + CLOSE) + CLOSE
            for name, kind in self._coordinates
            if name not in key.free
        )

    def _in_degrees(self, branch: Formulas) -> dict[str, Node]:
        """The branch with degrees for the bare numbers that stand as angles."""
        turning = {name for name, kind in self._coordinates if kind == "revolute"}
        return {name: _degrees(node) if name in turning else node for name, node in branch.items()}


def _degrees(node: Node) -> Node:
    match node:
        case Number(p, q):
            return Degrees(p, q)
        case Negative(Number(p, q)):
            return Negative(Degrees(p, q))
    return node


def _moved(branch: Formulas, exact: frozenset[Fraction]) -> list[dict[str, Node]]:
    """The branch once for each decimal that may have been rounded, moved by half a unit of its last place."""
    decimals = {part for node in branch.values() for part in walk(node) if isinstance(part, Number | Degrees)}
    found = []
    for part in sorted(decimals, key=repr):
        half = half_unit(Fraction(part.p, part.q), exact)
        if half is not None:
            put = _putting(part, Fraction(part.p, part.q) + half)
            found.append({name: mapped(node, put) for name, node in branch.items()})
    return found


def _putting(old: Number | Degrees, value: Fraction) -> Callable[[Node], Node]:
    new = type(old)(value.numerator, value.denominator)
    return lambda part: new if part == old else part


def _key(judged: Judged, name: str) -> InverseKey:
    """Numbers are reached where the problem gives them."""
    kind = BranchKey if judged.robot.questions.target is None else TargetKey
    return kind(judged, name, InverseForms(judged.robot, judged.values))


KEYS = {"inverse": _key}
