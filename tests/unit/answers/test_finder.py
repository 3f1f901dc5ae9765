"""Every left side that an independent finder sees in a hand-in is in exactly one outcome of its report."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest
from msgspec.structs import replace

from dynsolve.answers.judge import Checker
from dynsolve.problem import Problem, read_problem
from dynsolve.quantities.index import quantities
from dynsolve.solution.solution import load
from tests.golden.answers.test_hand_ins import TEXTBOOKS
from tests.golden.answers.test_notation import RIGHT
from tests.grading.generate import hand_in
from tests.unit.answers.finder import LeftSide, asked, left_sides, unaccounted

GOLDEN = Path(__file__).parents[2] / "golden"
ASKED = ("K", "P", "L", "tau", "D", "C", "g", "H1", "H2", "Jv1", "Jv2", "singular", "inverse", "equilibria")


def of_everything(problem: Problem) -> Checker:
    """A checker of a problem that asks for much."""
    names = {*problem.find, *(name for name in ASKED if name in quantities(problem.robot))}
    return Checker(replace(problem, marks=dict.fromkeys(sorted(names), Fraction(1))))


@cache
def checker(stem: str) -> Checker:
    book = TEXTBOOKS / f"{stem}.yaml"
    if "\n" in stem:
        return of_everything(read_problem(stem, "own.yaml"))
    return of_everything(read_problem(book.read_text("utf-8"), book.name) if book.exists() else load(stem))


def all_of(check: Checker) -> set[str]:
    return asked(check, check(check.reader("", "a.md")))


HandIn = tuple[Checker, str, str]
"""What judges a hand-in, its text, and its ending."""


def of_notations() -> Iterator[HandIn]:
    for stem, ending, text, _ in RIGHT:
        yield checker(stem), text, ending


def of_the_course() -> Iterator[HandIn]:
    yield checker("in3140-rp"), (GOLDEN / "answers" / "dynamics-overview.md").read_text("utf-8"), "md"
    chance = random.Random(26)
    for stem in ("in3140-rp", "planar-2r") * 2:
        name, text = hand_in(stem, "s1", chance)
        yield checker(stem), text, name.rpartition(".")[2]


@pytest.mark.parametrize(("hand_ins", "least"), [(of_notations, 120), (of_the_course, 40)])
def test_every_left_side_has_one_outcome(hand_ins: Callable[[], Iterator[HandIn]], least: int) -> None:
    count = 0
    for check, text, ending in hand_ins():
        read = check.reader(text, f"a.{ending}")
        sides = list(left_sides(text, ending, all_of(check)))
        if sides:
            assert not unaccounted(read, check(read), sides), text
        count += len(sides)
    assert count >= least


LOST = r"""# Report

The energy is $K = {K}$, and $P = 0$ since it lies flat. If $g = 0$ it floats.

- D: $D = M(q) X_7$
* **C:** see the appendix, C(q, qd) = [[0, 0], [0, 0]] and $m_1$

| $\tau_1$ | $\tau_1 = F_v$ |

```
L = K - P
D = [d11 0; 0 d22]
```

\begin{{align}}
K_1 &= \frac{{d}}{{dt}} X \\
\tau_{{2}} &= m_2 Z
\end{{align}}

Above, $P = X_3$ says the same.
""".format(K=r"\frac{1}{2} m_2 \dot L_2^2")
FOUND = [
    (3, "K"), (3, "P"), (3, "g"), (5, "D"), (6, "C"),
    (8, "tau"), (11, "L"), (12, "D"), (16, "K"), (17, "tau"), (20, "P"),
]  # fmt: skip


def test_the_finder_finds_what_is_planted_and_nothing_else() -> None:
    found = left_sides(LOST, "md", all_of(checker("in3140-rp")))
    assert sorted((side.line, side.family) for side in found) == sorted(FOUND)
    others = "$$a + K = 3$$ $$2 K = 3$$ $$K == 3$$ $$h = K$$ $$\\dot D - 2 C = N$$ ~~$$K = 3$$~~"
    assert not list(left_sides(others, "md", all_of(checker("in3140-rp"))))


@pytest.mark.parametrize(
    ("ending", "text", "line"),
    [
        ("yaml", "answers:\n  K: 3\n", 2),
        ("yaml", "let: {g: 3}\nanswers: {'K': 3}\n", 2),
        ("tex", "\\[ E_{kin} = 3 \\]", 1),
        ("tex", "% K = 3\n\\(\\mathbf{K} = 3\\)", 2),
        ("ipynb", '{"cells": [{"cell_type": "code", "source":\n["K = 3\\n"]}]}', 2),
        ("txt", "1) K = 3", 1),
    ],
)
def test_it_finds_them_in_every_format(ending: str, text: str, line: int) -> None:
    found = list(left_sides(text, ending, {"K"}))
    assert found == [LeftSide(line, "K")]


def test_every_planted_one_has_an_outcome_and_none_without_its_record() -> None:
    check = checker("in3140-rp")
    read = check.reader(LOST, "a.md")
    report = check(read)
    sides = list(left_sides(LOST, "md", all_of(check)))
    assert not unaccounted(read, report, sides)
    nothing = replace(report, not_recognized=(), set_aside=(), answers=())
    assert len(unaccounted(read, nothing, sides)) == len(sides)
    for name in ("not_recognized", "set_aside"):
        records = getattr(report, name)
        assert records
        for dropped in (one for one in records if one.waits or (name == "set_aside" and one.answers)):
            rest = replace(report, **{name: tuple(one for one in records if one is not dropped)})
            lost = {side.line for side, _ in unaccounted(read, rest, sides)}
            assert lost == {dropped.place.line}, dropped


def test_no_missing_answer_is_without_the_line_that_names_it() -> None:
    check = checker("in3140-rp")
    for line in LOST.split("\n"):
        report = check(check.reader(line, "a.md"))
        named = {side.family for side in left_sides(line, "md", all_of(check))}
        for answer in report.answers:
            if answer.name in named and answer.verdict == "missing":
                assert answer.fault and answer.place, line
