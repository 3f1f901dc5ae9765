"""Which student `override` means: one by a whole name, else those who may be meant are listed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from dynsolve.errors import UsageError
from dynsolve.grading.platforms.registry import keep_names, keep_platform
from dynsolve.grading.platforms.roster import Roster
from dynsolve.grading.public import meant_student
from dynsolve.grading.record import Record

GRADEBOOK = (
    ("Student", "ID", "SIS Login ID"),
    ("Lovelace, Ada", "101", "ada@x"),
    ("Ærlig, Åse", "102", "ase@x"),
    ("King, Ada", "103", "king@x"),
    ("Smith, Jo", "104", "jo@x"),
    ("Smith, Jo", "105", "jo2@x"),
)
STUDENTS = {
    "lovelaceada_101": "101", "ærligåse_102": "102", "kingada_103": "103",
    "smithjo_104": "104", "smithjo_105": "105", "late comer": "",
}  # fmt: skip


@pytest.fixture
def record(tmp_path: Path) -> Iterator[Record]:
    record = Record(tmp_path)
    record.set_intake(STUDENTS, ())
    keep_platform(record, "canvas", Roster("gradebook.csv", GRADEBOOK))
    keep_names(record, {"late comer": "Grace Hopper"})
    yield record
    record.close()


@pytest.mark.parametrize(
    ("said", "student"),
    [
        ("lovelaceada_101", "lovelaceada_101"),
        ("Lovelace, Ada", "lovelaceada_101"),
        ("ada lovelace", "lovelaceada_101"),
        ("A\u030ase Ærlig", "ærligåse_102"),
        ("103", "kingada_103"),
        ("jo2@x", "smithjo_105"),
        ("Hopper, Grace", "late comer"),
    ],
)
def test_a_whole_name_of_one_student_is_that_students(record: Record, said: str, student: str) -> None:
    assert meant_student(record, said) == student


@pytest.mark.parametrize(
    ("said", "message"),
    [
        (
            "Jo Smith",
            "2 students are called `Jo Smith`: name one as `smithjo_104` (Smith, Jo) or `smithjo_105`",
        ),
        ("Ada", "did you mean `kingada_103` (King, Ada) or `lovelaceada_101` (Lovelace, Ada)?"),
        ("Ada Lovelase", "there is no student `Ada Lovelase` in grades.csv"),
        ("", "there is no student `` in grades.csv"),
    ],
)
def test_what_may_be_several_or_nobody_is_told(record: Record, said: str, message: str) -> None:
    with pytest.raises(UsageError) as caught:
        meant_student(record, said)
    assert message in str(caught.value)
