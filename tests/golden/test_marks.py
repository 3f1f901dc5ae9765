"""The marks that a teacher expects of a hand-in: of zeros, of the key, of the key with a slip.

On every robot of the library and of textbooks whose model is short, over the roundings that courses use.
The key is what `dynsolve solve --json` prints; no answer's marks are taken from the program.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import cycle, product
from typing import Any

import pytest
from msgspec.structs import replace

from dynsolve.answers.judge import Checker, Judge
from dynsolve.answers.marks import Policy, mark
from dynsolve.problem import load
from tests.conftest import LARGE
from tests.support import STEMS, TEXTBOOKS, problem_file, solved

ROUNDINGS = tuple(map(Fraction, ("1", "1/2", "1/100")))
OF = Fraction(4)
LONG = {"puma560-first3", "mls-3link", "mls-scara", "spong-five-bar-trick"}
"""What is told of these is long, and no marks are other than of the others."""

BOOKS = [path.stem for path in TEXTBOOKS if path.stem not in LONG]
ROBOTS = sorted(STEMS - LARGE - LONG)  # the answers of large arms go over the bounds of size


@cache
def _key(stem: str) -> dict[str, Any]:
    """The answers of the key, as `dynsolve solve --json` prints them."""
    results = solved(stem).to_json()["results"]
    names = ("Jv", "Jw", "P", "K", "L", "tau", "D", "C", "g")
    transforms = {f"A{i}": matrix for i, matrix in enumerate(results["A"], 1)}
    bodies = {f"K{body['name']}": body["K"] for body in results["bodies"]}
    acting = {name: results[name] for name in ("Ps", "Km", "friction") if name in results}
    return transforms | bodies | acting | {name: results[name] for name in names}


@cache
def _checker(stem: str) -> Checker:
    return Checker(replace(load(problem_file(stem)), marks=dict.fromkeys(_key(stem), OF)))


def _marks(stem: str, answers: dict[str, Any]) -> dict[Fraction, dict[str, Fraction]]:
    """The marks of each answer, for each rounding."""
    checker = _checker(stem)
    lines = (f"  {name}: {str(value).replace(chr(39), '')}\n" for name, value in answers.items())
    judge = Judge(checker, checker.reader(("answers:\n" + "".join(lines)).encode(), "answers.yaml"))
    report = judge.report()
    return {
        step: {m.name: m.marks for m in mark(report.answers, judge.graph.quantities, Policy(rounding=step))}
        for step in ROUNDINGS
    }


def _zeros(value: Any) -> Any:
    return [_zeros(entry) for entry in value] if isinstance(value, list) else "0"


def _is_zero(value: Any) -> bool:
    return value == _zeros(value)


@pytest.mark.parametrize("stem", ROBOTS)
def test_zeros_earn_nothing(stem: str) -> None:
    for marks in _marks(stem, {name: _zeros(value) for name, value in _key(stem).items()}).values():
        assert not any(marks.values())


@pytest.mark.parametrize("stem", ROBOTS)
def test_the_key_earns_all(stem: str) -> None:
    for marks in _marks(stem, _key(stem)).values():
        assert marks == dict.fromkeys(_key(stem), OF)


@pytest.mark.parametrize(
    ("stem", "removed"),
    [
        *product(ROBOTS, ("Jv", "P", "K", "tau", "D", "g")),
        *zip(BOOKS, cycle(("tau", "D", "C", "g", "P"))),
    ],
)
def test_a_line_removed_costs_its_marks_alone(stem: str, removed: str) -> None:
    answers = {name: value for name, value in _key(stem).items() if name != removed}
    whole_of_parts = removed == "K"  # K1, K2, ... are still there, and K is judged by them
    for marks in _marks(stem, answers).values():
        assert marks == dict.fromkeys(_key(stem), OF) | ({} if whole_of_parts else {removed: 0})


@pytest.mark.parametrize(
    ("answers", "earned"),
    [
        ({"g": "[0, 0]"}, OF),  # gravity does no work there: the answer is right, and all that was said
        ({"g": "[0, 0]", "P": "0"}, 0),
        ({"g": "[0, 0]", "D": "[[0, 0], [0, 0]]"}, 0),
        ({"g": "[0, 0]", "D": "[[I1zz + m2*L2^2, 0], [0, m2]]"}, OF),
        ({"g": "[0, 0]", "K": "m1*L1"}, OF),
    ],
)
def test_a_right_zero_earns_beside_more_than_zeros_or_alone(answers: dict[str, str], earned: int) -> None:
    """in3140-rp moves in a horizontal plane, so that g is zero in every entry."""
    for marks in _marks("in3140-rp", answers).values():
        assert marks["g"] == earned


@pytest.mark.parametrize("stem", ROBOTS)
@pytest.mark.parametrize("name", ["D", "g", "tau", "A1"])
def test_a_wrong_entry_costs_its_part(stem: str, name: str) -> None:
    key = _key(stem)
    rows = [row if isinstance(row, list) else [row] for row in key[name]]
    if _is_zero(rows):
        return
    i, j = next((i, j) for i, row in enumerate(rows) for j, entry in enumerate(row) if entry != "0")
    carrying = sum(entry != "0" for row in rows for entry in row)
    # a term more, for an equation without a force is as right after a multiplication
    rows[i] = [f"{entry} + 97/89" if k == j else entry for k, entry in enumerate(rows[i])]
    wrong = rows if isinstance(key[name][0], list) else [row[0] for row in rows]
    exact = OF * (carrying - 1) / carrying
    for step, marks in _marks(stem, {**key, name: wrong}).items():
        assert abs(marks[name] - exact) <= step / 2
        assert all(earned == OF for other, earned in marks.items() if other != name)
