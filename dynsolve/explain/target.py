"""The configurations that reach a target given in numbers, as formulas.

The branches of the closed form are worked out exactly, as sums of square roots and angles
with such sines and cosines.  Where there is no closed form, or its formulas say nothing at
these numbers, configurations are looked for in numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from math import acos, asin, atan2, floor, pi, sqrt
from typing import TYPE_CHECKING, Any

from dynsolve.algebra.floats import evaluate
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.surd_angles import SurdAngle
from dynsolve.algebra.surd_values import Exact, NoValue, Undetermined, exact_value
from dynsolve.algebra.surds import NotExact
from dynsolve.derivation.configuration_check import Condition, Conditions, holds
from dynsolve.derivation.reached import CLOSE, angle_rows, gap, near, same_configuration
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import ZERO, Negative, Node, Number, Product, Quotient, Sum, Symbol
from dynsolve.notation.tree_values import FUNCTIONS, compile_trees
from dynsolve.notation.walk import mapped, names_in
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Target

if TYPE_CHECKING:
    from dynsolve.derivation.inverse.numeric import Found

_OTHER_PLACES = (1.0, 2.0)
"""Where a coordinate that is free is put to see that it is."""


@dataclass(frozen=True, slots=True)
class Configuration:
    """One configuration: the value of each coordinate, in numbers and as a formula.

    `branches` are the numbers (from 1) of the branches that it comes from.  `free` coordinates may
    have any value: they stand at 0 in `numbers` and have no formula; `outside` are those beyond their
    limits.
    """

    numbers: Mapping[str, float]
    formulas: Mapping[str, Node]
    branches: tuple[int, ...] = ()
    free: tuple[str, ...] = ()
    outside: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Unmet:
    """A branch with a condition that does not hold at these numbers."""

    branch: int
    condition: Condition


@dataclass(frozen=True, slots=True)
class Lost:
    """A branch that is not real at these numbers: the coordinate would be `function` of `argument`."""

    branch: int
    coordinate: str
    function: str
    argument: Node


class TargetForms:
    """What reaches the target of a robot.

    `r` is the task and `task` its formula; `branches` are the formulas of its closed form with their
    conditions, None where it has none.
    """

    def __init__(
        self,
        robot: Robot,
        r: Matrix,
        task: Node,
        branches: Sequence[tuple[Mapping[str, Node], Conditions]] | None,
    ) -> None:
        assert robot.questions.target is not None
        self.robot, self.r, self.task, self.branches = robot, r, task, branches
        self.target: Target = robot.questions.target

    # -- what is given -----------------------------------------------------------------------------

    @cached_property
    def written(self) -> dict[str, Node]:
        """The formulas of the parameters and of the values of the task, by name."""
        return {**dict(self.target.numbers), **dict(self.given)}

    @property
    def given(self) -> Iterator[tuple[str, Node]]:
        """The values of the task by name, as they are written."""
        return zip(self.robot.questions.reached, self.target.values, strict=True)

    @cached_property
    def exact(self) -> dict[str, Exact]:
        """Their exact values, as far as they have any."""
        found: dict[str, Exact] = {}
        for name, node in self.written.items():
            try:
                found[name] = exact_value(node, found)
            except NotExact:
                continue
        return found

    @cached_property
    def numbers(self) -> dict[str, float]:
        """Their values in floating point."""
        found: dict[str, float] = {"pi": pi}
        for name, node in self.written.items():
            found[name] = number_of(name, node, found)
        return found

    @cached_property
    def wanted(self) -> tuple[float, ...]:
        """What r(q) is to be."""
        return tuple(self.numbers[name] for name in self.robot.questions.reached)

    @cached_property
    def angles(self) -> tuple[bool, ...]:
        """Which components of the task are angles."""
        return angle_rows(self.r)

    def reaches(self, q: Mapping[str, float]) -> bool:
        """Whether a configuration gives the task what is wanted."""
        return near(self.task_at(q), self.wanted, self.angles)

    def task_at(self, q: Mapping[str, float]) -> list[float]:
        """r(q), with the numbers of the target for the parameters."""
        at = {**self.numbers, **q}
        return [evaluate(entry, at) for entry in self.r.entries]

    # -- the configurations ------------------------------------------------------------------------

    @cached_property
    def configurations(self) -> tuple[Configuration, ...]:
        """All that are found, each once."""
        found: list[Configuration] = []
        for one in (*self._closed, *self._searched):
            index = next((i for i, other in enumerate(found) if self._is_same(one, other)), None)
            if index is None:
                found.append(replace(one, outside=self._outside(one)))
            else:
                found[index] = replace(found[index], branches=(*found[index].branches, *one.branches))
        return tuple(found)

    def _is_same(self, one: Configuration, other: Configuration) -> bool:
        return one.free == other.free and same_configuration(self.robot.ring, one.numbers, other.numbers)

    @property
    def lost(self) -> tuple[Lost, ...]:
        """The branches that are not real at these numbers."""
        return tuple(one for one in self._at_target if isinstance(one, Lost))

    @property
    def unmet(self) -> tuple[Unmet, ...]:
        """The branches with a condition that does not hold at these numbers."""
        return tuple(one for one in self._at_target if isinstance(one, Unmet))

    @property
    def is_searched(self) -> bool:
        """Whether configurations are looked for in numbers, too."""
        return self.branches is None or None in self._at_target

    @property
    def _closed(self) -> tuple[Configuration, ...]:
        return tuple(one for one in self._at_target if isinstance(one, Configuration))

    @cached_property
    def _at_target(self) -> tuple[Configuration | Lost | Unmet | None, ...]:
        """Each branch at the target; None where its formulas say nothing there."""
        return tuple(self._branch(number, *one) for number, one in enumerate(self.branches or (), 1))

    def _branch(
        self, number: int, branch: Mapping[str, Node], when: Conditions
    ) -> Configuration | Lost | Unmet | None:
        for one in when:
            if names_in(*one.sides).isdisjoint(branch) and not holds(one, self.numbers):
                return Unmet(number, one)
        try:
            found = branch_values(branch, self.numbers, self.exact)
            others = [self._elsewhere(branch, place) for place in _OTHER_PLACES] if found.free else []
        except Unreal as error:
            return Lost(number, error.coordinate, error.function, error.argument)
        except ZeroDivisionError:
            return None
        names = self.robot.ring.names
        unused = {name: 0.0 for name in names if name not in branch}
        for one in when:
            if not holds(one, {**unused, **found.numbers}):
                return Unmet(number, one)
        if not all(self.reaches({**unused, **one.numbers}) for one in (found, *others)):
            return None
        return Configuration(
            numbers={name: found.numbers.get(name, 0.0) for name in names},
            formulas=_constants_first(
                names, {n: self._formula(n, branch, found, others) for n in branch if n not in found.free}
            ),
            branches=(number,),
            free=tuple(name for name in names if name in unused or name in found.free),
        )

    def _elsewhere(self, branch: Mapping[str, Node], place: float) -> BranchValues:
        """The branch with its free coordinates at another place."""
        return branch_values(branch, self.numbers, {**self.exact}, place)

    def _formula(
        self, name: str, branch: Mapping[str, Node], found: BranchValues, others: Sequence[BranchValues]
    ) -> Node:
        """A coordinate as a formula: its exact value, or what it is beside an angle that is free.

        Where a wrist is singular only the sum or the difference of two angles matters: q₆ = q₄ + c.
        """
        kind = dict(self.robot.ring.coordinates)[name]
        moves = [gap(kind, other.numbers[name], found.numbers[name]) for other in others]
        if all(abs(move) < CLOSE for move in moves):
            return shown(name, branch, found, self.written)
        for sign in (1, -1):
            turns = [gap(kind, move, sign * place) for move, place in zip(moves, _OTHER_PLACES, strict=True)]
            if name in found.exact and len(found.free) == 1 and all(abs(turn) < CLOSE for turn in turns):
                first = Symbol(next(iter(found.free)))
                return total([first if sign > 0 else negated(first), found.exact[name].node])
        return shown(name, branch, replace(found, exact={}), self.written)

    @cached_property
    def _found(self) -> Found | None:
        """What is found in numbers, where that is looked for."""
        if not self.is_searched:
            return None
        from dynsolve.derivation.inverse.numeric import search

        return search(self.robot.ring, self.task, self.angles, self.numbers, self.wanted)

    @property
    def _searched(self) -> Iterator[Configuration]:
        """What is found in numbers and stands alone."""
        for q in self._found.isolated if self._found else ():
            yield Configuration(q, {name: decimal(value) for name, value in q.items()})

    @property
    def is_family(self) -> bool:
        """Whether configurations are only known not to stand alone: there may be infinitely many."""
        return self._found is not None and bool(self._found.others) and not self.configurations

    # -- limits ------------------------------------------------------------------------------------

    def _outside(self, one: Configuration) -> tuple[str, ...]:
        """The coordinates beyond their limits; an angle is within where whole turns bring it there."""
        found = []
        kinds = dict(self.robot.ring.coordinates)
        for limits in self.robot.questions.limits:
            name = limits.coordinate
            low, high = (number_of(name, end, self.numbers) for end in (limits.low, limits.high))
            value = one.numbers[name]
            if kinds[name] == "revolute":
                value -= 2 * pi * floor((value - low + CLOSE) / (2 * pi))
            if name not in one.free and not low - CLOSE <= value <= high + CLOSE:
                found.append(name)
        return tuple(found)


def _constants_first(names: Sequence[str], formulas: Mapping[str, Node]) -> dict[str, Node]:
    """The formulas that are numbers, in the order of the coordinates, before those that hold others."""
    constant = [name for name in names if name in formulas and not names_in(formulas[name]) & set(names)]
    return {name: formulas[name] for name in dict.fromkeys((*constant, *formulas))}


# -- one branch of the inverse kinematics at numbers: every coordinate, exactly where it can be ----

DIGITS = 12
"""So many digits has a value that has no formula."""

_ROUNDING = 1e-9
"""What rounding may make of 0, and of what is on the boundary."""


class Unreal(Exception):
    """A coordinate has no real value: `function` was taken of `argument`."""

    def __init__(self, coordinate: str, function: str, argument: Node) -> None:
        super().__init__(coordinate)
        self.coordinate, self.function, self.argument = coordinate, function, argument


@dataclass(slots=True)
class BranchValues:
    """The coordinates of a branch as far as they are known: by number, and exactly as far as they are.

    `free` are angles whose formula says nothing at these numbers; they stand at a place of their own.
    """

    numbers: dict[str, float]
    exact: dict[str, Exact]
    free: dict[str, float] = field(default_factory=dict)

    def put(self, name: str, formula: Node, place: float) -> None:
        """Work out one coordinate; one that is free is put at `place`.

        Raises Unreal where it has no real value, ZeroDivisionError where its formula says nothing.
        """
        try:
            value = exact_value(formula, self.exact)
        except NoValue as error:
            if error.function == "/":
                raise ZeroDivisionError from None
            raise Unreal(name, error.function, error.argument) from None
        except Undetermined:
            self.set_free(name, place)
        except NotExact:
            try:
                self.numbers[name] = number_of(name, formula, self.numbers)
            except _NoDirection:
                self.set_free(name, place)
        else:
            self.exact[name], self.numbers[name] = value, float(value)

    def set_free(self, name: str, place: float) -> None:
        """Put an angle at a place; several at places that differ, lest they be free only together."""
        self.numbers[name] = self.free[name] = place * (1 + len(self.free))
        if not place:
            self.exact[name] = SurdAngle.of_degrees(0)


def branch_values(
    branch: Mapping[str, Node], numbers: Mapping[str, float], exact: Mapping[str, Exact], place: float = 0.0
) -> BranchValues:
    """Every coordinate of a branch; raises as `BranchValues.put` does."""
    found = BranchValues(dict(numbers), dict(exact))
    for name in sorted(names_in(*branch.values()) - {*branch, *numbers}):
        found.set_free(name, place)
    for name, formula in branch.items():
        found.put(name, formula, place)
    return found


def shown(name: str, branch: Mapping[str, Node], found: BranchValues, written: Mapping[str, Node]) -> Node:
    """A coordinate as a formula: its exact value, else its formula with numbers in it."""
    return found.exact[name].node if name in found.exact else with_numbers(branch[name], written, found.exact)


def with_numbers(formula: Node, written: Mapping[str, Node], exact: Mapping[str, Exact]) -> Node:
    """A formula with the given formulas in place of names, each part that has an exact value as that."""

    def put(part: Node) -> Node:
        try:
            return exact_value(part, exact).node
        except AlgebraError:
            return _folded(written.get(part.name, part) if isinstance(part, Symbol) else part)

    return mapped(formula, put)


def _folded(part: Node) -> Node:
    """A sum or product without the 0 and 1 that numbers have left in it."""
    match part:
        case Product(factors):
            return times(1, [(factor, 1) for factor in factors])
        case Sum(terms):
            numbers = [value for term in terms if (value := rational_value(term)) is not None]
            rest = [term for term in terms if rational_value(term) is None]
            return total([*rest, times(sum(numbers, Fraction(0)), [])]) if numbers else total(rest)
        case Negative(argument) if argument == ZERO:
            return ZERO
        case Quotient(numerator, denominator) if numerator == ZERO and denominator != ZERO:
            return ZERO
    return part


def decimal(value: float, digits: int = DIGITS) -> Node:
    """A number in floating point, as a decimal."""
    exact = Fraction(f"{value:.{digits}g}")
    size = Number(abs(exact.numerator), exact.denominator, decimal=True)
    return negated(size) if exact < 0 else size


# -- floating point --------------------------------------------------------------------------------


class _NoDirection(Exception):
    """The direction of a point to itself."""


def number_of(name: str, formula: Node, values: Mapping[str, float]) -> float:
    """The value of a formula; what is beyond a boundary by rounding alone is on it."""

    def within(function: Any, low: float, high: float) -> Any:
        def at(x: float) -> float:
            if not low - _ROUNDING <= x <= high + _ROUNDING:
                raise Unreal(name, labels[function], decimal(x, 4))
            return float(function(min(max(x, low), high)))

        return at

    def direction(both: tuple[float, float]) -> float:
        if max(map(abs, both)) < _ROUNDING:
            raise _NoDirection
        return atan2(*both)

    labels = {acos: "acos", asin: "asin", sqrt: "sqrt"}
    functions = {
        **FUNCTIONS,
        "acos": within(acos, -1, 1),
        "asin": within(asin, -1, 1),
        "sqrt": within(sqrt, 0, float("inf")),
        "atan2": direction,
    }
    return float(compile_trees([formula], functions).run(values)[0])
