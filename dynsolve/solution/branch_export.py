"""The branches of the inverse kinematics in the JSON of a solution."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from dynsolve.algebra.surd_angles import PI
from dynsolve.notation.build import times
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.tree import Degrees, Node, Number
from dynsolve.notation.walk import mapped

if TYPE_CHECKING:
    from dynsolve.document import Prose
    from dynsolve.explain.inverse_formulas import ConfigurationForms
    from dynsolve.explain.target import TargetForms

_DIGITS = 15


def branch_results(forms: ConfigurationForms, python: PythonPrinter) -> list[dict[str, Any]]:
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


def beside_branches(forms: ConfigurationForms, write: Callable[[Prose], str]) -> Iterator[tuple[str, Any]]:
    """What stands beside `inverse` where the target is given in numbers.

    `inverse_decimals` are the same configurations in numbers (angles in radians), without the coordinates
    that are free, which `inverse_free` names for each; `inverse_outside` names those beyond their
    limits, where there are any limits; `inverse_why` says why there is none, or that they were found
    in numbers. `write` writes prose as text.
    """
    if forms.target is None:
        return
    from dynsolve.explain.target import told

    found = forms.target.configurations
    yield (
        "inverse_decimals",
        [{name: float(f"{one.numbers[name]:.{_DIGITS}g}") for name in one.formulas} for one in found],
    )
    if any(one.free for one in found):
        yield "inverse_free", [list(one.free) for one in found]
    if forms.robot.questions.limits:
        yield "inverse_outside", [list(one.outside) for one in found]
    yield "inverse_why", write(told(forms.target))
