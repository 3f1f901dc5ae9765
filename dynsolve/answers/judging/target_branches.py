"""Verdicts on configurations that are to reach a target in numbers.

Each is compared with those of the key; one that is none of these is right where r(q) gives the
target.  A decimal that may have been rounded stands for its interval, so that a coordinate
may be off by what all decimals of its branch do to it together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

from msgspec import Struct

from dynsolve.answers.judging.branches import (
    INCOMPLETE,
    Formulas,
    SetVerdict,
    branches_of,
    in_order,
    lacking,
    turned_round,
)
from dynsolve.answers.judging.entry_comparison import ROUNDED, half_unit
from dynsolve.answers.verdict import Part
from dynsolve.derivation.configurations import on_branch
from dynsolve.derivation.reached import CLOSE, gap
from dynsolve.notation.tree import Degrees, Negative, Node, Number, mapped, walk
from dynsolve.questions.inverse.target import Configuration, TargetForms

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


class TargetKey(Struct, frozen=True, dict=True):
    """What reaches the target of one problem; `exact` are the decimals that stand in its file."""

    target: TargetForms
    exact: frozenset[Fraction]
    all_branches: bool

    def verdict(self, alternatives: Sequence[Sequence[Part]]) -> SetVerdict:
        """Whether configurations are right."""
        given = branches_of(alternatives)
        found = self._compared(given)
        if found.is_right:
            return found
        if self._compared(turned_round(given)).is_right:
            return SetVerdict(False, "atan2_order")
        in_degrees = self._compared([self._in_degrees(branch) for branch in given])
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
        if is_incomplete and self.all_branches:
            return SetVerdict(False, "branches_missing", where=f"{len(keys)}")
        notes = ((INCOMPLETE, is_incomplete), (ROUNDED, is_rounded))
        return SetVerdict(True, notes=tuple(note for note, is_so in notes if is_so))

    @property
    def _coordinates(self) -> tuple[tuple[str, str], ...]:
        return self.target.robot.ring.coordinates

    def _given(self, branch: Formulas) -> _Given | None:
        """The values of a branch, None where it has none."""
        unknown = {name: 0.0 for name, _ in self._coordinates if name not in branch}
        at = {**self.target.numbers, **unknown}
        values = on_branch(in_order(branch), at)
        if values is None:
            return None
        slack, task = dict.fromkeys(values, 0.0), self.target.task_at(values)
        task_slack = [0.0] * len(task)
        for moved in _moved(branch, self.exact):
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
