"""What the record comes to: the marks of every student, and what is counted for the teacher's page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import groupby

from dynsolve.answers.marking.marks import Marked, deduction, maximum
from dynsolve.answers.marking.policy import points
from dynsolve.grading.item_analysis import Item
from dynsolve.grading.problem_set import ProblemSet, stored_policy
from dynsolve.grading.queue import Entry
from dynsolve.grading.record import Key, Record, RecordedAnswer
from dynsolve.quantities.index import quantities


@dataclass(frozen=True, slots=True)
class Standing:
    """A student's marks by problem; a problem that was not handed in is not among them.

    `unjudged` are the problems that wait for a human, with the reasons: they have no marks yet.
    `late` are the lines that have deducted from the marks of late hand-ins.
    """

    student: str
    id: str
    marks: dict[str, Fraction]
    unjudged: Mapping[str, str] = field(default_factory=dict)
    late: Mapping[str, Marked] = field(default_factory=dict)

    @property
    def total(self) -> Fraction:
        """All marks."""
        return sum(self.marks.values(), Fraction(0))

    @property
    def deducted(self) -> Fraction:
        """What was deducted for being late, 0 or less."""
        return sum((line.marks for line in self.late.values()), Fraction(0))


def standings(record: Record) -> Iterator[Standing]:
    """Every student, in the order of their names; one is in memory at a time."""
    found = groupby(record.marks(), key=lambda entry: entry[0][0])
    waiting, unjudged = next(found, None), record.unjudged()
    days, policy = record.late(), stored_policy(record)
    for student, id in record.students().items():
        marks: dict[str, Fraction] = {}
        lines: dict[str, Marked] = {}
        if waiting is not None and waiting[0] == student:
            for key, of_answers in waiting[1]:
                earned = points(*of_answers)
                line = deduction(earned, days.get(key, 0), policy)
                marks[key[1]] = earned + line.marks if line else earned
                lines |= {key[1]: line} if line else {}
            waiting = next(found, None)
        yield Standing(student, id, marks, unjudged.get(student, {}), lines)


def most(problems: ProblemSet) -> dict[str, Fraction]:
    """The most that each problem can earn."""
    return {
        item.stem: maximum(item.problem.marks.items(), quantities(item.problem.robot), problems.policy)
        for item in problems.items
    }


# -- the cohort at a glance --------------------------------------------------------------------------

VERDICTS = ("correct", "follows", "wrong", "unreadable", "missing")
WAITS = "waits"

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
    """What is counted: nothing of a hand-in that waits for a human, but that it waits.

    `items` are the answers with marks, `names` what students are called, `pages` are the hand-ins with
    a page for the student, `judged` those of which nothing waits, `waiting` those in the `queue`,
    `uploads` where their files lay.
    """

    standings: list[Standing] = field(default_factory=list)
    verdicts: dict[tuple[str, str], Counter[str]] = field(default_factory=dict)
    items: dict[tuple[str, str], Item] = field(default_factory=dict)
    slips: Counter[Slip] = field(default_factory=Counter)
    examples: dict[Slip, SlipExample] = field(default_factory=dict)
    alike: dict[Slip, Alike] = field(default_factory=dict)
    queue: Sequence[Entry] = ()
    by_hand: list[RecordedAnswer] = field(default_factory=list)
    pages: set[Key] = field(default_factory=set)
    judged: Set[Key] = frozenset()
    waiting: Set[Key] = frozenset()
    uploads: Mapping[Key, tuple[str, ...]] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)

    @property
    def settled(self) -> list[Standing]:
        """The students of whom nothing waits."""
        wait = {student for student, _ in self.waiting}
        return [standing for standing in self.standings if standing.student not in wait]


def counted(problems: ProblemSet, record: Record, waits: Sequence[Entry], names: Mapping[str, str]) -> Cohort:
    """Everything that the teacher's page shows; `waits` is what waits for a human."""
    cohort = Cohort(queue=waits, uploads=record.uploads(), names=names)
    for item in problems.items:
        for name in item.problem.marks:
            cohort.verdicts[item.stem, name] = Counter()
    cohort.pages = {(row.student, row.problem) for row in record.rows() if row.html}
    cohort.waiting = {
        (entry.student, stem)
        for entry in waits
        for stem in ((entry.problem,) if entry.problem else problems.stems)
    }
    cohort.judged = cohort.pages - cohort.waiting
    cohort.standings = list(standings(record))
    totals = {s.student: float(s.total - s.deducted) for s in cohort.settled}
    for answer in record.answers():
        _count(cohort, answer)
        key = (answer.student, answer.problem)
        if answer.of != "0" and (key in cohort.judged or (answer.said and key not in cohort.waiting)):
            which = (answer.problem, answer.answer)
            found = cohort.items.setdefault(which, Item(float(points(answer.of))))
            found.add(float(points(answer.marks)), totals.get(answer.student), _is_right(answer))
    cohort.pages |= {(answer.student, answer.problem) for answer in cohort.by_hand}
    return cohort


def _is_right(a: RecordedAnswer) -> bool:
    return a.marks == a.of if a.said else a.verdict == "correct"


def _count(cohort: Cohort, a: RecordedAnswer) -> None:
    found = WAITS if (a.student, a.problem) in cohort.waiting else a.verdict
    cohort.verdicts.setdefault((a.problem, a.answer), Counter())[found] += 1
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
