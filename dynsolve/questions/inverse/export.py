"""The branches of the inverse kinematics in the JSON of a solution."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from dynsolve.algebra.surds import PI
from dynsolve.notation.build import times
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.tree import Degrees, Node, Number, mapped
from dynsolve.questions.export import Export, skipped
from dynsolve.questions.inverse.derive import NO_CLOSED_FORM
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.inverse.target import TargetForms, told


def value(export: Export, name: str) -> Any:
    """The branches in the names of the task's values; with numbers the configurations that reach these."""
    if export.has_numbers and (found := targeted(export)) is not None:
        return found
    forms = InverseForms(export.robot, export.values)
    if (why := skipped(export.values, name)) is not None:
        return why
    return {"skipped": NO_CLOSED_FORM} if forms.solved is None else branch_results(forms, export.python)


def targeted(export: Export) -> list[dict[str, str]] | None:
    """The configurations that reach the numbers of `reach`; None where it has none."""
    target = InverseForms(export.general_robot, export.general_values).target
    return None if target is None else configuration_results(target, export.python)


def beside(export: Export) -> Iterator[tuple[str, Any]]:
    """What stands beside `inverse` where the target is given in numbers.

    `inverse_decimals` are the same configurations in numbers (angles in radians), without the coordinates
    that are free, which `inverse_free` names for each; `inverse_outside` names those beyond their
    limits, where there are any limits; `inverse_why` says why there is none, or that they were found
    in numbers.
    """
    target = None if export.has_numbers else InverseForms(export.robot, export.values).target
    if target is None:
        return
    found = target.configurations
    yield (
        "inverse_decimals",
        [{name: float(f"{one.numbers[name]:.{_DIGITS}g}") for name in one.formulas} for one in found],
    )
    if any(one.free for one in found):
        yield "inverse_free", [list(one.free) for one in found]
    if export.robot.questions.limits:
        yield "inverse_outside", [list(one.outside) for one in found]
    yield "inverse_why", export.prose(told(target))


_DIGITS = 15


def branch_results(forms: InverseForms, python: PythonPrinter) -> list[dict[str, Any]]:
    """The branches in the names of the values of the task, each with the conditions under which it is one."""
    found: list[dict[str, Any]] = []
    for branch, when in zip(forms.inverse, forms.when, strict=True):
        found.append({name: _text(python, value) for name, value in branch.items()})
        if when:
            found[-1]["when"] = [" = ".join(_text(python, side) for side in one.sides) for one in when]
    return found


def configuration_results(target: TargetForms, python: PythonPrinter) -> list[dict[str, str]]:
    """The configurations that reach given numbers, their formulas exact where they come from a branch."""
    return [
        {name: _text(python, _exact(f) if one.branches else f) for name, f in one.formulas.items()}
        for one in target.configurations
    ]


def _exact(formula: Node) -> Node:
    """A formula with fractions for decimals."""
    return mapped(formula, lambda part: Number(part.p, part.q) if isinstance(part, Number) else part)


def _text(python: PythonPrinter, formula: Node) -> str:
    """A formula as text, its degrees as parts of π, so that no rounded number stands in it."""
    return python.text(mapped(formula, _in_radians))


def _in_radians(part: Node) -> Node:
    return times(Fraction(part.p, 180 * part.q), [(PI, 1)]) if isinstance(part, Degrees) else part
