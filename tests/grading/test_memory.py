"""What is remembered between hand-ins changes nothing that is said of them."""

from __future__ import annotations

import random

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import FileReader
from dynsolve.problem.reader import find, load
from tests.grading.generate import PROBLEMS, hand_in

OWN_NAMES = """symbols: {q1: theta1, q2: theta2 - 90deg}
let: {h: m2*l1*lc2*sin(theta2)}
answers:
  K1: m1*lc1**2*q1'**2/2 + I1*q1'**2/2
  P2: m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))
  C: [[h*q2', h*(q1' + q2')], [-h*q1', 0]]
"""

SAME_LETTERS = """answers:
  K1: m1*lc1**2*q1'**2/2 + I1*q1'**2/2
  P2: m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))
  C: [[h*q2', h*(q1' + q2')], [-h*q1', 0]]
  D: [[m1*lc1* *2, K1], [P1, m2*lc2*]]
"""

DEEP = "answers:\n  K: " + "(" * 50 + "m1*lc1" + ")" * 50 + " + (((m1*lc1)))\n"


def _files(problem: str, count: int = 24) -> list[tuple[str, str]]:
    chance = random.Random(problem)
    files = [hand_in(problem, f"s{i}", chance) for i in range(count)]
    return [*files, ("own.yaml", OWN_NAMES), ("same.yaml", SAME_LETTERS), ("deep.yaml", DEEP), *files[:4]]


@pytest.mark.parametrize("problem", PROBLEMS)
def test_a_reader_reads_every_file_as_if_it_were_the_first(problem: str) -> None:
    model = load(find(problem))
    shared = FileReader(model)
    for name, text in _files(problem):
        assert shared(text, name) == FileReader(model)(text, name)


@pytest.mark.parametrize("problem", PROBLEMS[:2])
def test_a_checker_judges_every_file_as_if_it_were_the_first(problem: str) -> None:
    model = load(find(problem))
    shared = Checker(model)
    for name, text in _files(problem, 12):
        fresh = Checker(model, shared.key)
        assert shared(shared.reader(text, name)) == fresh(fresh.reader(text, name))


def test_a_memory_that_is_full_is_begun_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    model = load(find("planar-2r"))
    shared = FileReader(model)
    monkeypatch.setattr("dynsolve.answers.reading.files.MOST_PRINTED", 5)
    for name, text in _files("planar-2r", 8):
        assert shared(text, name) == FileReader(model)(text, name)
    full = shared.printer
    shared("answers: {K: m1}", "last.yaml")
    assert full.remembered > 5
    assert shared.printer is not full
