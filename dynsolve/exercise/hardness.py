"""How much work a result is: what is counted of its derivation, and which variants are equally hard.

    steps        the results that it is derived from, itself among them
    terms        of the result, all products multiplied out; of a set its equations
    operations   of the result as it is printed
    identities   of sine and cosine that its derivation uses
    slips        that would change it, of those that run through a derivation

A variant is as hard as the others of its family where each count is near the family's median: within a
share of it, or 1, whichever is more; and no count is 0 for one and not for another.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable, Mapping, Sequence
from fractions import Fraction
from hashlib import sha256
from statistics import median
from typing import Any, TypeVar

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.own_steps import DerivationSlips
from dynsolve.answers.judge import Checker, Judge
from dynsolve.answers.verdict import Submission
from dynsolve.derivation.graph import Skipped
from dynsolve.notation import tree
from dynsolve.notation.build import cost
from dynsolve.notation.tree import ZERO, Node, Relation
from dynsolve.problem.model import Problem
from dynsolve.quantities.families import DH
from dynsolve.quantities.family import FORMED
from dynsolve.quantities.index import quantities
from dynsolve.robot.model import Robot
from dynsolve.solution.solution import solve

COUNTS = ("steps", "terms", "operations", "identities", "slips")


class Hardness(Struct, frozen=True):
    """The counts of one result; `result` is the same where it is the same, `names` are those in it."""

    steps: int
    terms: int
    operations: int
    identities: int
    slips: int
    result: str = ""
    names: frozenset[str] = frozenset()

    @property
    def counts(self) -> tuple[int, ...]:
        """In the order of `COUNTS`."""
        return (self.steps, self.terms, self.operations, self.identities, self.slips)


def hardness(problem: Problem, names: Iterable[str]) -> dict[str, Hardness]:
    """The counts of asked results, by their names; raises VerificationError for a key that is not right."""
    solution = solve(problem)
    slips = DerivationSlips(Judge(Checker(problem), Submission("", "", "", ())).graph)
    steps = list(solution.explain())
    found = {}
    for name in names:
        quantity = quantities(problem.robot)[name]
        if quantity.family is DH:
            found[name] = _of_table(problem.robot)
            continue
        value = solution.values[quantity.rule]
        if isinstance(value, Skipped):
            found[name] = NO_RESULT
            continue
        leading = solution.values.leading_to([quantity.rule])
        identities = sum(
            any(isinstance(part, Relation) for part in line.by)
            for step in steps
            if step.id in leading or step.id == name
            for line in step.lines
        )
        shown = solution.forms(quantity.rule) if quantity.family.kind in FORMED else None
        found[name] = Hardness(
            steps=len(leading),
            terms=_terms(value),
            operations=_terms(value) if shown is None else _operations(shown),
            identities=identities,
            slips=_slips(slips, quantity.rule, value),
            **_identity(value),
        )
    return found


NO_RESULT = Hardness(0, 0, 0, 0, 0)
"""What is counted where an asked result is not there, as for a state that is no equilibrium."""

_ADDRESS = re.compile(r" at 0x[0-9a-f]+")
_NAME = re.compile(r"[^\W\d]\w*?(?=(?:_d?dot)?\b)")


def _of_table(robot: Robot) -> Hardness:
    """A table is read off the figure: its rows, and the cells that are not 0."""
    cells = [cell for joint in robot.joints for cell in joint.written if cell != ZERO]
    return Hardness(len(robot.joints), len(cells), len(cells), 0, 0, **_identity(cells))


def _identity(value: Any) -> dict[str, Any]:
    text = _ADDRESS.sub("", repr(value))
    return {"result": sha256(text.encode()).hexdigest(), "names": frozenset(_NAME.findall(text))}


def _terms(value: Any) -> int:
    """The terms of an expression, of all entries of a matrix; of a set its alternatives."""
    if isinstance(value, Matrix):
        return sum(map(_terms, value.entries))
    numerator = getattr(value, "numerator", None)
    if numerator is not None:
        return len(numerator)
    try:
        return len(value)
    except TypeError:
        return 1


def _operations(shown: Node) -> int:
    """The operations of a formula, of all entries of a matrix."""
    if isinstance(shown, tree.Matrix):
        return sum(cost(entry) for row in shown.rows for entry in row)
    return cost(shown)


def _slips(slips: DerivationSlips, rule: str, value: Any) -> int:
    """The kinds of slips that would change a result, each at each place where it can be made."""
    return sum(1 for wrong, _, _ in slips.values(rule) if wrong != value)


Variant = TypeVar("Variant", bound=Hashable)


def equally_hard(
    found: Mapping[Variant, Mapping[str, Hardness]], within: Fraction
) -> dict[Variant, Mapping[str, Hardness]]:
    """The largest family of variants that are as hard as each other; the first of several that are as large.

    A family is sought around each variant, among those near it: in a wider one whoever is drawn may have
    a median that others are far from.

    >>> easy, hard = Hardness(4, 9, 12, 0, 30), Hardness(4, 15, 22, 0, 33)
    >>> sorted(equally_hard({1: {"D": easy}, 2: {"D": hard}, 3: {"D": hard}}, Fraction(1, 10)))
    [2, 3]
    """
    families: dict[tuple[Variant, ...], dict[Variant, Mapping[str, Hardness]]] = {}
    for each in found.values():
        middle = {name: own.counts for name, own in each.items()}
        begun = {variant: own for variant, own in found.items() if _is_near(own, middle, within)}
        family = _around_its_median(begun, within)
        families[tuple(family)] = family
    return max(families.values(), key=len, default={})


def _around_its_median(
    family: dict[Variant, Mapping[str, Hardness]], within: Fraction
) -> dict[Variant, Mapping[str, Hardness]]:
    """The variants that are near the median of those that are left, until none has to go."""
    while family:
        middle = {
            name: [median(each[name].counts[k] for each in family.values()) for k in range(len(COUNTS))]
            for name in next(iter(family.values()))
        }
        near = {variant: each for variant, each in family.items() if _is_near(each, middle, within)}
        if len(near) == len(family):
            break
        family = near
    return family


def _is_near(own: Mapping[str, Hardness], middle: Mapping[str, Sequence[float]], within: Fraction) -> bool:
    return all(
        abs(count - of) <= max(float(within) * of, 1.0) and (count == 0) == (of == 0)
        for name, each in own.items()
        for count, of in zip(each.counts, middle[name], strict=True)
    )
