"""What the record comes to: the marks of every student, as all reports show them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby

from dynsolve.grading.marking import maximum
from dynsolve.grading.policy import points
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Record


@dataclass(frozen=True, slots=True)
class Standing:
    """A student's marks by problem; a problem that was not handed in is not among them."""

    student: str
    id: str
    marks: dict[str, Fraction]

    @property
    def total(self) -> Fraction:
        """All marks."""
        return sum(self.marks.values(), Fraction(0))


def standings(record: Record) -> Iterator[Standing]:
    """Every student, in the order of their names; one is in memory at a time."""
    found = groupby(record.marks(), key=lambda entry: entry[0][0])
    waiting = next(found, None)
    for student, id in record.students().items():
        marks: dict[str, Fraction] = {}
        if waiting is not None and waiting[0] == student:
            marks = {problem: points(*of_answers) for (_, problem), of_answers in waiting[1]}
            waiting = next(found, None)
        yield Standing(student, id, marks)


def most(problems: ProblemSet) -> dict[str, Fraction]:
    """The most that each problem can earn."""
    return {item.stem: maximum(item.problem.marks.items(), problems.policy) for item in problems.items}
