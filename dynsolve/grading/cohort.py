"""What the record comes to: the marks of every student, and what is counted for the teacher's page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import groupby

from dynsolve.answers.marking.marks import maximum
from dynsolve.answers.marking.policy import points
from dynsolve.grading.item_analysis import Item
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.queue import Entry
from dynsolve.grading.record import Key, Record, RecordedAnswer
from dynsolve.quantities.index import quantities


@dataclass(frozen=True, slots=True)
class Standing:
    """A student's marks by problem; a problem that was not handed in is not among them.

    `unjudged` are the problems that wait for a human, with the reasons: they have no marks yet.
    """

    student: str
    id: str
    marks: dict[str, Fraction]
    unjudged: Mapping[str, str] = field(default_factory=dict)

    @property
    def total(self) -> Fraction:
        """All marks."""
        return sum(self.marks.values(), Fraction(0))


def standings(record: Record) -> Iterator[Standing]:
    """Every student, in the order of their names; one is in memory at a time."""
    found = groupby(record.marks(), key=lambda entry: entry[0][0])
    waiting, unjudged = next(found, None), record.unjudged()
    for student, id in record.students().items():
        marks: dict[str, Fraction] = {}
        if waiting is not None and waiting[0] == student:
            marks = {problem: points(*of_answers) for (_, problem), of_answers in waiting[1]}
            waiting = next(found, None)
        yield Standing(student, id, marks, unjudged.get(student, {}))


def most(problems: ProblemSet) -> dict[str, Fraction]:
    """The most that each problem can earn."""
    return {
        item.stem: maximum(item.problem.marks.items(), quantities(item.problem.robot), problems.policy)
        for item in problems.items
    }


# -- the cohort at a glance --------------------------------------------------------------------------

VERDICTS = ("correct", "follows", "wrong", "unreadable", "missing")

Slip = tuple[str, str, str]
"""The problem, the answer and the code of a slip."""


@dataclass(frozen=True, slots=True)
class SlipExample:
    """An example of a slip: the student, and the message or the text of the answer."""

    student: str
    text: str


@dataclass
class Alike:
    """Those who wrote the same wrong expression."""

    text: str
    students: list[str]


@dataclass
class Cohort:
    """What is counted; `marks` has a student's marks by problem, and all.

    `items` are the answers with marks, `names` what students are called where that is not their name
    here, `pages` are the hand-ins with a page for the student, `judged` those that were, by whomever,
    `uploads` where their files lay.
    """

    marks: list[tuple[str, dict[str, Fraction], Fraction]] = field(default_factory=list)
    verdicts: dict[tuple[str, str], Counter[str]] = field(default_factory=dict)
    items: dict[tuple[str, str], Item] = field(default_factory=dict)
    slips: Counter[Slip] = field(default_factory=Counter)
    examples: dict[Slip, SlipExample] = field(default_factory=dict)
    alike: dict[Slip, Alike] = field(default_factory=dict)
    queue: Sequence[Entry] = ()
    by_hand: list[RecordedAnswer] = field(default_factory=list)
    pages: set[Key] = field(default_factory=set)
    judged: Set[Key] = frozenset()
    uploads: Mapping[Key, tuple[str, ...]] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)


def counted(problems: ProblemSet, record: Record, waits: Sequence[Entry], names: Mapping[str, str]) -> Cohort:
    """Everything that the teacher's page shows; `waits` is what waits for a human."""
    cohort = Cohort(queue=waits, uploads=record.uploads(), names=names)
    for item in problems.items:
        for name in item.problem.marks:
            cohort.verdicts[item.stem, name] = Counter()
    cohort.pages = {(row.student, row.problem) for row in record.rows() if row.html}
    totals: dict[str, float | None] = {}
    unjudged: set[Key] = set()
    for standing in standings(record):
        cohort.marks.append((standing.student, standing.marks, standing.total))
        totals[standing.student] = None if standing.unjudged else float(standing.total)
        unjudged |= {(standing.student, stem) for stem in standing.unjudged}
    cohort.judged = frozenset(cohort.pages - unjudged)
    for answer in record.answers():
        _count(cohort, answer)
        if answer.of != "0" and ((answer.student, answer.problem) in cohort.judged or answer.said):
            which = (answer.problem, answer.answer)
            found = cohort.items.setdefault(which, Item(float(points(answer.of))))
            found.add(float(points(answer.marks)), totals.get(answer.student), _is_right(answer))
    cohort.pages |= {(answer.student, answer.problem) for answer in cohort.by_hand}
    return cohort


def _is_right(a: RecordedAnswer) -> bool:
    return a.marks == a.of if a.said else a.verdict == "correct"


def _count(cohort: Cohort, a: RecordedAnswer) -> None:
    cohort.verdicts.setdefault((a.problem, a.answer), Counter())[a.verdict] += 1
    if a.verdict == "wrong":
        for code, message in zip(a.diagnosis, a.message, strict=False):
            slip = (a.problem, a.answer, code)
            cohort.slips[slip] += 1
            cohort.examples.setdefault(slip, SlipExample(a.student, message or a.read_as))
    if a.form:
        cohort.alike.setdefault((a.problem, a.answer, a.form), Alike(a.read_as, [])).students.append(
            a.student
        )
    if a.said:
        cohort.by_hand.append(a)
