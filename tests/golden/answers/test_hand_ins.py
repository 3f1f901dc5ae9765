"""Small hand-ins as students, books and programs write them: read whole, right, and wrong with a slip.

`hand-ins.txt` has them one after the other: a line `== problem format: the answers that are right`, a
line `-- old => new`, the slip, and the text.  Their notations are those of Spong, Craig, Siciliano,
Murray, Li and Sastry, Lynch and Park, Asada and Slotine, of exams, and of MATLAB, SymPy, Mathematica,
Maple, Maxima, Word and HTML.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import FileReader
from dynsolve.derivation.rules import derive
from dynsolve.problem import read_problem
from dynsolve.solution.solution import load
from tests.unit.answers.finder import lost as unaccounted_for
from tests.unit.answers.reading.test_nothing_lost import lost

HERE = Path(__file__).parent
TEXTBOOKS = HERE.parent / "textbooks"


class HandIn(NamedTuple):
    """One hand-in, the answers in it that are right, and a slip: what is written in the place of what."""

    problem: str
    ending: str
    names: list[str]
    old: str
    new: str
    text: str


def hand_ins() -> Iterator[HandIn]:
    for piece in f"\n{(HERE / 'hand-ins.txt').read_text(encoding='utf-8')}".split("\n== ")[1:]:
        head, slip, text = piece.split("\n", 2)
        what, _, names = head.partition(": ")
        problem, ending = what.split()
        old, _, new = slip.removeprefix("-- ").partition(" => ")
        yield HandIn(problem, ending, names.split(), old, new, text)


HAND_INS = list(hand_ins())


@lru_cache(maxsize=32)
def tools(stem: str) -> tuple[FileReader, Checker]:
    book = TEXTBOOKS / f"{stem}.yaml"
    problem = read_problem(book.read_text(encoding="utf-8"), book.name) if book.exists() else load(stem)
    return FileReader(problem), Checker(problem, derive(problem.robot))


def verdicts(hand_in: HandIn, text: str) -> dict[str, str]:
    reader, check = tools(hand_in.problem)
    read = reader(text, f"a.{hand_in.ending}")
    report = check(read)
    assert not unaccounted_for(check, text, hand_in.ending, read, report)
    return {answer.name: str(answer.verdict.value) for answer in report.answers}


@pytest.mark.parametrize("hand_in", HAND_INS, ids=range(len(HAND_INS)))
def test_a_hand_in_is_read_and_right_and_with_a_slip_it_is_not(hand_in: HandIn) -> None:
    found = verdicts(hand_in, hand_in.text)
    assert {name: found.get(name) for name in hand_in.names} == dict.fromkeys(hand_in.names, "correct")
    assert not {"wrong", "unreadable", "follows"} & set(found.values())
    assert hand_in.text.count(hand_in.old) == 1
    slipped = verdicts(hand_in, hand_in.text.replace(hand_in.old, hand_in.new))
    assert "wrong" in [slipped.get(name) for name in hand_in.names]


def test_nothing_in_them_is_lost() -> None:
    for hand_in in HAND_INS:
        if hand_in.ending in ("md", "txt"):
            reader, _ = tools(hand_in.problem)
            assert not lost(hand_in.text, reader(hand_in.text, f"a.{hand_in.ending}")), hand_in.text
