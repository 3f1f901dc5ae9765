"""Numbers in JSON: the sections `values` and `at` beside what `dynsolve-solution/1` has.

Entries are text that Python evaluates, as everywhere in it: exact where no decimal
goes in, else decimals of 15 digits, or as many as were asked for.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from dynsolve.notation.tree import Node
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers import quantities
from dynsolve.solution.numbers.beside import Numbers
from dynsolve.solution.numbers.given import GivenValue
from dynsolve.solution.numbers.rounding import DIGITS

_DIGITS = 15

Results = Callable[[Callable[[str], Node]], dict[str, Any]]
"""Lays trees out as `results`."""


def sections(numbers: Numbers, results: Results) -> dict[str, Any]:
    """`values` with what was given, and the results with it; `at` with the state, and the results there."""
    found: dict[str, Any] = {}
    entries = numbers.given.entries
    if entries:
        values: dict[str, Any] = {"given": {name: _entry(entry) for (name, _), entry in entries.items()}}
        valued = numbers.valued
        if valued is not None:
            digits = _digits(valued.digits)
            values["results"] = results(lambda name: valued.shown(name, digits))
        found["values"] = values
    state = numbers.state
    if state is not None:
        digits = _digits(state.digits)
        given = {
            name + ("", "_dot", "_ddot")[dots]: _entry(entry)
            for (name, dots), entry in state.given.entries.items()
        }
        found["at"] = {
            "given": given,
            "results": results(lambda name: state.shown(name, digits)),
        }
    if found:
        found["units"] = {q: _plain(unit) for q, unit in _units(numbers.robot)}
    return found


def _digits(asked: int) -> int:
    return asked if asked != DIGITS else _DIGITS


def _entry(entry: GivenValue) -> dict[str, str]:
    return {"value": entry.text, "unit": entry.unit or "rad"}


def _units(robot: Robot) -> list[tuple[str, str | quantities.Units]]:
    names = ["P", "K", "L", "tau", "D", "C", "g"] if robot.bodies else []
    return [(name, quantities.of_result(robot, name)) for name in names]


def _plain(unit: str | quantities.Units) -> Any:
    if isinstance(unit, str):
        return unit
    rows = [list(row) for row in unit]
    return [entry for (entry,) in rows] if all(len(row) == 1 for row in rows) else rows
