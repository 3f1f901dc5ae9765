"""The configurations that reach a target given in numbers, as formulas, and the steps that tell of them.

The branches of the closed form are worked out exactly, as sums of square roots and angles
with such sines and cosines.  Where there is no closed form, or its formulas say nothing at
these numbers, configurations are looked for in numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cached_property
from itertools import groupby
from math import degrees, floor, pi
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.algebra.factors import is_positive
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring_values import build_ring, evaluate, value_of
from dynsolve.algebra.surds import (
    DIGITS,
    Exact,
    NotExact,
    NoValue,
    SurdAngle,
    Undetermined,
    decimal,
    exact_value,
    number_of,
)
from dynsolve.derivation.configurations import Condition, Conditions, holds
from dynsolve.derivation.reached import CLOSE, angle_rows, gap, near, same_configuration
from dynsolve.document import Prose, Table
from dynsolve.document.sentences import say
from dynsolve.errors import AlgebraError
from dynsolve.explain.step import NOTED, Detail, Group, Step
from dynsolve.explain.writing import agreeing, listed
from dynsolve.notation.build import cost, negated, split_sign, times, total
from dynsolve.notation.tree import (
    ZERO,
    Arguments,
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Product,
    Quotient,
    Relation,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
    mapped,
    names_in,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Target

if TYPE_CHECKING:
    from dynsolve.questions.inverse.numeric import Found

_OTHER_PLACES = (1.0, 2.0)
"""Where a coordinate that is free is put to see that it is."""


class Configuration(Struct, frozen=True):
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


class Unmet(Struct, frozen=True):
    """A branch with a condition that does not hold at these numbers."""

    branch: int
    condition: Condition


class Lost(Struct, frozen=True):
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
            found[name] = number_of(node, found)
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
        closed = [one for one in self._at_target if isinstance(one, Configuration)]
        for one in (*closed, *self._searched):
            for i, other in enumerate(found):
                if one.free == other.free and same_configuration(self.robot.ring, one.numbers, other.numbers):
                    found[i] = replace(other, branches=(*other.branches, *one.branches))
                    break
            else:
                found.append(replace(one, outside=self._outside(one)))
        return tuple(found)

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
        found = self._values(number, branch)
        if not isinstance(found, BranchValues):
            return found
        others = []
        for place in _OTHER_PLACES if found.free else ():
            other = self._values(number, branch, place)
            if not isinstance(other, BranchValues):
                return other
            others.append(other)
        names = self.robot.ring.names
        unused = {name: 0.0 for name in names if name not in branch}
        for one in when:
            if not holds(one, {**unused, **found.numbers}):
                return Unmet(number, one)
        if not all(self.reaches({**unused, **one.numbers}) for one in (found, *others)):
            return None
        formulas = {n: self._formula(n, branch, found, others) for n in branch if n not in found.free}
        constant = [n for n in names if n in formulas and not names_in(formulas[n]) & set(names)]
        return Configuration(
            numbers={name: found.numbers.get(name, 0.0) for name in names},
            formulas={name: formulas[name] for name in dict.fromkeys((*constant, *formulas))},
            branches=(number,),
            free=tuple(name for name in names if name in unused or name in found.free),
        )

    def _values(
        self, number: int, branch: Mapping[str, Node], place: float = 0.0
    ) -> BranchValues | Lost | None:
        """Every coordinate of a branch, what is free at `place`; None where a formula says nothing."""
        found = BranchValues(dict(self.numbers), dict(self.exact))
        for name in sorted(names_in(*branch.values()) - {*branch, *self.numbers}):
            found.set_free(name, place)
        for name, formula in branch.items():
            try:
                found.put(name, formula, self.written)
            except Undetermined:
                found.set_free(name, place)
            except NoValue as error:
                return None if error.function == "/" else Lost(number, name, error.function, error.argument)
        return found

    def _formula(
        self, name: str, branch: Mapping[str, Node], found: BranchValues, others: Sequence[BranchValues]
    ) -> Node:
        """A coordinate as a formula: its exact value, or what it is beside an angle that is free.

        Where a wrist is singular only the sum or the difference of two angles matters: q₆ = q₄ + c.
        """
        kind = dict(self.robot.ring.coordinates)[name]
        moves = [gap(kind, other.numbers[name], found.numbers[name]) for other in others]
        if all(abs(move) < CLOSE for move in moves):
            if name in found.exact:
                return found.exact[name].node
            return with_numbers(branch[name], self.written, found.exact)
        for sign in (1, -1):
            turns = [gap(kind, move, sign * place) for move, place in zip(moves, _OTHER_PLACES, strict=True)]
            if name in found.exact and len(found.free) == 1 and all(abs(turn) < CLOSE for turn in turns):
                first = Symbol(next(iter(found.free)))
                return total([first if sign > 0 else negated(first), found.exact[name].node])
        return with_numbers(branch[name], self.written, {})

    @cached_property
    def _found(self) -> Found | None:
        """What is found in numbers, where that is looked for."""
        if not self.is_searched:
            return None
        from dynsolve.questions.inverse.numeric import search

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

    def _outside(self, one: Configuration) -> tuple[str, ...]:
        """The coordinates beyond their limits; an angle is within where whole turns bring it there."""
        found = []
        for limits in self.robot.questions.limits:
            name = limits.coordinate
            low, high = (number_of(end, self.numbers) for end in (limits.low, limits.high))
            value = one.numbers[name]
            if self.turns(name):
                value -= 2 * pi * floor((value - low + CLOSE) / (2 * pi))
            if name not in one.free and not low - CLOSE <= value <= high + CLOSE:
                found.append(name)
        return tuple(found)

    def turns(self, name: str) -> bool:
        """Whether a coordinate is an angle."""
        return dict(self.robot.ring.coordinates)[name] == "revolute"


# -- one branch of the inverse kinematics at numbers: every coordinate, exactly where it can be ----


class BranchValues(Struct):
    """The coordinates of a branch as far as they are known: by number, and exactly as far as they are.

    `free` are angles whose formula says nothing at these numbers; they stand at a place of their own.
    """

    numbers: dict[str, float]
    exact: dict[str, Exact]
    free: dict[str, float] = field(default_factory=dict)

    def put(self, name: str, formula: Node, written: Mapping[str, Node]) -> None:
        """Work out one coordinate, exactly where that goes."""
        try:
            value = exact_value(formula, self.exact)
        except NotExact:
            self.numbers[name] = number_of(formula, self.numbers)
            with suppress(AlgebraError):
                self.exact[name] = exact_value(with_numbers(formula, written, self.exact), self.exact)
        else:
            self.exact[name], self.numbers[name] = value, float(value)

    def set_free(self, name: str, place: float) -> None:
        """Put an angle at a place; several at places that differ, lest they be free only together."""
        self.numbers[name] = self.free[name] = place * (1 + len(self.free))
        if not place:
            self.exact[name] = SurdAngle.of_degrees(0)


def with_numbers(formula: Node, written: Mapping[str, Node], exact: Mapping[str, Exact]) -> Node:
    """A formula with the given formulas in place of names, each part that has an exact value as that."""

    def put(part: Node) -> Node:
        try:
            return exact_value(part, exact).node
        except AlgebraError:
            part = _folded(written.get(part.name, part) if isinstance(part, Symbol) else part)
            return part if names_in(part) else _of_constants(part)

    return mapped(formula, put)


def _of_constants(part: Node) -> Node:
    """A sum in sines and cosines of 20° as its number, the direction of a point with such as that angle."""
    turned = [one for one in walk(part) if isinstance(one, Function) and one.name in ("sin", "cos")]
    with suppress(AlgebraError):
        match part:
            case Sum() if turned:
                value = value_of(build_ring([], [part]), part)
                return Number(value.number.numerator, value.number.denominator) if value.is_number else part
            case Function("atan2", Arguments((y, x))):
                for angle in dict.fromkeys(one.argument for one in turned):
                    both = [Function(name, angle) for name in ("sin", "cos")]
                    ring = build_ring([], [y, x, *both])
                    above, along, sine, cosine = (value_of(ring, one) for one in (y, x, *both))
                    length = along * cosine + above * sine
                    if above * cosine == along * sine and is_positive(length):
                        return angle
    return part


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


# -- steps of it: each configuration that reaches the numbers, or why there is none ----------------

_DIGITS = 4

LONGEST = 60
"""A formula with more operations is no help to a reader; its value stands alone."""

_REAL = {
    "acos": "no angle has a cosine beyond -1 and 1",
    "asin": "no angle has a sine beyond -1 and 1",
    "sqrt": "a negative number has no real root",
}


def target_steps(forms: TargetForms) -> Iterator[Step]:
    """A step for each configuration, and the table of all."""
    whole = _all(forms)
    group = Group("inverse", whole.title)
    for number, one in enumerate(forms.configurations, 1):
        origin = "Branch|Branches {branches} with these numbers{boundary}."
        if not one.branches:
            origin = "Found in numbers, and put into $𝐫(𝐪)$."
        several = ": they are one" + ("" if one.free else ", for the target is on their boundary")
        remarks = (
            (one.free, "{q} is|are free here: infinitely many solutions."),
            (one.outside, "{q} is|are beyond the limits."),
        )
        yield Step(
            id=f"inverse_{number}",
            title=f"Configuration {number}",
            why=say(
                agreeing(origin, len(one.branches)),
                branches=listed([str(branch) for branch in one.branches]),
                boundary=several if len(one.branches) > 1 else "",
            ),
            result=tuple(_value(forms, one, name) for name in _in_order(forms, one)),
            notes=tuple(
                say(agreeing(text, len(names)), q=listed([*map(Symbol, names)]))
                for names, text in remarks
                if names
            ),
            listed=True,
            uses=("inverse_branches",) if one.branches else (),
            is_task=False,
            group=group,
            normal=NOTED,
        )
    yield replace(whole, group=group, normal=NOTED)


def _branch(forms: TargetForms, one: Configuration) -> Mapping[str, Node]:
    """The formulas in letters that a configuration comes from; none where it was found in numbers."""
    return forms.branches[one.branches[0] - 1][0] if forms.branches and one.branches else {}


def _in_order(forms: TargetForms, one: Configuration) -> Iterator[str]:
    """The coordinates that have a formula, as they are solved for: one that stands in another before it."""
    names = [*_branch(forms, one), *one.formulas]
    yield from (name for name in dict.fromkeys(names) if name in one.formulas)


def _value(forms: TargetForms, one: Configuration, name: str) -> Node:
    """q = its formula in letters = that in numbers ≈ its value"""
    found, in_letters = _in_numbers(forms, one, name), _branch(forms, one).get(name)
    if in_letters is None or cost(in_letters) > LONGEST or in_letters in found.parts:
        return found
    q, *members = found.parts
    return Relation((q, in_letters, *members), ("=", *found.signs))


def _in_numbers(forms: TargetForms, one: Configuration, name: str) -> Relation:
    """q = its formula ≈ its value"""
    formula, value = one.formulas[name], one.numbers[name]
    if rational_value(formula) == 0 or _depends(one, name):
        return equation(Symbol(name), formula)
    number, exact = _number(forms, formula, value)
    if cost(formula) > LONGEST:
        formula = decimal(value)
    is_decimal = _is_decimal(formula)
    shown = [number if is_decimal else formula]
    if rational_value(formula) is None:
        shown.append(number)
    if forms.turns(name):
        if _is_of_pi(formula):
            return Relation((Symbol(name), formula, _in_degrees(value)), ("=", "="))
        shown.append(_in_degrees(value))
    return Relation(
        (Symbol(name), *shown), ("≈" if is_decimal and not exact else "=", *["≈"] * (len(shown) - 1))
    )


def _number(forms: TargetForms, formula: Node, value: float) -> tuple[Node, bool]:
    """A value as a decimal, and whether that is the value; of a model in numbers the page rounds it."""
    whole, digits = rational_value(formula), DIGITS if forms.robot.has_decimals else _DIGITS
    places = Fraction(str(round(value, digits)))
    if whole is not None and whole == places:
        return Number(whole.numerator, whole.denominator, decimal=True), True
    return decimal(value, digits), False


def _is_of_pi(formula: Node) -> bool:
    """Whether a formula is a part of π or a number that is not rounded."""
    is_plain = not any(isinstance(part, Function) for part in walk(formula))
    is_rounded = _is_decimal(formula) and rational_value(formula) != 0
    return is_plain and not is_rounded and names_in(formula) <= {"pi"}


def _depends(one: Configuration, name: str) -> bool:
    """Whether a coordinate is given by one that is free."""
    return name in one.formulas and bool(names_in(one.formulas[name]) & set(one.free))


def _is_decimal(node: Node) -> bool:
    inner = split_sign(node)[1]
    return isinstance(inner, Number) and inner.decimal


def _in_degrees(value: float) -> Node:
    hundredths = Fraction(round(abs(degrees(value)) * 100), 100)
    size = Degrees(hundredths.numerator, hundredths.denominator)
    return Negative(size) if value < 0 and hundredths else size


def _all(forms: TargetForms) -> Step:
    """The configurations in a table; where there are none, why."""
    found = forms.configurations
    title = "Infinitely many configurations" if forms.is_family else "Out of reach"
    if found:
        several = f"The {len(found)} configurations that reach it"
        title = "The configuration that reaches it" if len(found) == 1 else several
    return Step(
        id="inverse",
        title=title,
        why=told(forms),
        table=_table(forms) if found else None,
        notes=tuple(_lost(forms)),
        detail=Detail.BRIEF,
        uses=tuple(f"inverse_{number}" for number in range(1, len(found) + 1)),
        hint=(
            "Put the numbers into every branch. Look at the arguments of roots, of arccos and arcsin: is the "
            "branch real, is it one with another? And at atan2: are both its arguments 0?",
        ),
        hint_title="The configurations that reach it",
    )


def task_of(robot: Robot) -> Node:
    """What the coordinates are put into: r(q), or of a pose H(q)."""
    task = robot.questions.task
    return letters.FRAME_OF_Q if task is not None and task.is_pose else letters.TASK_OF_Q


def told(forms: TargetForms) -> Prose:
    """How the configurations were found, and how they are known to be right; or why there are none."""
    task = task_of(forms.robot)
    if forms.configurations and forms.is_searched:
        return say(
            "Newton's method from 200 configurations led to these, each put into {task} to ten digits. That "
            "there are no others is not proved.",
            task=task,
        )
    if forms.configurations:
        each = "Each" if len(forms.configurations) > 1 else "It"
        return say(f"{each} is put into {{task}} to see that it gives the task.", task=task)
    if forms.is_family:
        return say("The configurations that reach this do not stand alone: there are infinitely many.")
    if forms.unmet:
        return say("No configuration reaches this: no joint gives {task} these values.", task=task)
    if forms.lost:
        return say("No configuration reaches this: no branch is real.")
    return say("No configuration that reaches this was found: Newton's method from 200 of them led to none.")


def _table(forms: TargetForms) -> Table:
    names = [q.name for q in forms.robot.coordinates]
    limited = bool(forms.robot.questions.limits)
    rows = []
    for number, one in enumerate(forms.configurations, 1):
        row: list[Node | str] = [str(number)]
        for name in names:
            value = one.numbers[name]
            if name in one.free:
                row.append("free")
            elif _depends(one, name):
                row.append(one.formulas[name])
            else:
                cell, exact = _number(forms, one.formulas[name], value)
                if forms.turns(name):
                    cell, exact = _in_degrees(value), _is_of_pi(one.formulas[name])
                is_marked = exact or _is_decimal(cell)  # a rounded number gets its sign where it is printed
                row.append(cell if is_marked else Row((Words("≈ "), cell)))
        if limited:
            row.append("beyond" if one.outside else "within")
        rows.append(tuple(row))
    return Table(("", *map(Symbol, names), *(("Limits",) if limited else ())), tuple(rows))


def _lost(forms: TargetForms) -> Iterator[Prose]:
    """Why branches are not real or no solutions, those with one reason together."""
    for condition, unmet in groupby(forms.unmet, key=lambda one: one.condition):
        numbers = [str(one.branch) for one in unmet]
        text = agreeing(
            "Branch|Branches {numbers} needs|need {condition}, which does not hold here.", len(numbers)
        )
        yield say(text, numbers=listed(numbers), condition=equation(*condition.sides))

    def why(lost: Lost) -> tuple[str, str, str]:
        return lost.coordinate, lost.function, repr(lost.argument)

    for _, together in groupby(sorted(forms.lost, key=why), key=why):
        one, *others = together
        text = "Branch|Branches {numbers} is|are not real: {q} needs {value}, and {why}."
        yield say(
            agreeing(text, 1 + len(others)),
            numbers=listed([str(each.branch) for each in (one, *others)]),
            q=Symbol(one.coordinate),
            value=Function(one.function, one.argument),
            why=_REAL[one.function],
        )
