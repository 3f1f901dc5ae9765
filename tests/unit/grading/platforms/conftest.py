"""What the files of the platforms are made from: a set of one problem, and a record."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from dynsolve.grading.record import Record
from dynsolve.grading.set_file import Item, ProblemSet
from dynsolve.problem.reader import read_problem
from tests.unit.grading.platforms.marked import MARKS, TEXT


@pytest.fixture
def record(tmp_path: Path) -> Iterator[Record]:
    opened = Record(tmp_path)
    yield opened
    opened.close()


@pytest.fixture
def problems() -> ProblemSet:
    from msgspec.structs import replace

    problem = replace(read_problem(TEXT, "in3140-rp.yaml"), marks=MARKS)
    return ProblemSet("Assignment 2", (Item(problem, TEXT),))
