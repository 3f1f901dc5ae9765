"""What the record comes to: the marks of every student, and what is counted for the teacher's page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import groupby

from dynsolve.answers.marking.marks import maximum
from dynsolve.answers.marking.policy import points
from dynsolve.answers.unwritten import BY_PARTS
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Record, RecordedAnswer
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


@dataclass(frozen=True, slots=True)
class ForAHuman:
    """Something for a human to look at."""

    student: str
    problem: str
    what: str
    why: str


@dataclass
class Cohort:
    """What is counted; `marks` has a student's marks by problem, and all."""

    marks: list[tuple[str, dict[str, Fraction], Fraction]] = field(default_factory=list)
    verdicts: dict[tuple[str, str], Counter[str]] = field(default_factory=dict)
    slips: Counter[Slip] = field(default_factory=Counter)
    examples: dict[Slip, SlipExample] = field(default_factory=dict)
    alike: dict[Slip, Alike] = field(default_factory=dict)
    queue: list[ForAHuman] = field(default_factory=list)
    by_hand: list[RecordedAnswer] = field(default_factory=list)
    pages: set[tuple[str, str]] = field(default_factory=set)


OVERTAKEN = "its marks were set by hand for an earlier hand-in"


def to_fill(record: Record) -> Iterator[tuple[RecordedAnswer, str]]:
    """The answers that wait for a human's marks, with the reason: those of the page to fill."""
    unjudged, overtaken = record.unjudged(), record.overtaken()
    for a in record.answers():
        if a.of == "0":
            continue
        if (a.student, a.problem, a.answer) in overtaken:
            yield a, OVERTAKEN
        elif not a.said:
            reason = unjudged.get(a.student, {}).get(a.problem, "") or _for_a_human(a)
            if reason:
                yield a, reason


def counted(problems: ProblemSet, record: Record) -> Cohort:
    """Everything that the teacher's page shows."""
    cohort = Cohort()
    for item in problems.items:
        for name in item.problem.marks:
            cohort.verdicts[item.stem, name] = Counter()
    told: set[tuple[str, str]] = set()
    unjudged: dict[tuple[str, str], str] = {}
    for w in record.waiting():
        cohort.queue.append(ForAHuman(w.student, w.problem, w.file, w.reason))
        told |= {(w.student, stem) for stem in ((w.problem,) if w.problem else problems.stems)}
    for row in record.rows():
        key = (row.student, row.problem)
        if row.html:
            cohort.pages.add(key)
        if row.reason:
            unjudged[key] = row.reason
            if key not in told:
                cohort.queue.append(ForAHuman(*key, ", ".join(row.files), row.reason))
        if row.left:
            left = ", ".join(row.left)
            cohort.queue.append(ForAHuman(row.student, row.problem, left, "left aside: a newer copy counts"))
    for standing in standings(record):
        cohort.marks.append((standing.student, standing.marks, standing.total))
    for student, problem, name in sorted(record.overtaken()):
        cohort.queue.append(ForAHuman(student, problem, name, OVERTAKEN))
    for answer in record.answers():
        _count(cohort, answer, unjudged.get((answer.student, answer.problem), ""))
    return cohort


def _count(cohort: Cohort, a: RecordedAnswer, unjudged: str) -> None:
    """One answer; `unjudged` is why none of its hand-in could be judged, which is told once."""
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
        cohort.pages.add((a.student, a.problem))
        return
    reason = _for_a_human(a)
    if reason and reason != unjudged:
        cohort.queue.append(ForAHuman(a.student, a.problem, f"{a.answer} {a.label}".strip(), reason))


def _for_a_human(a: RecordedAnswer) -> str:
    """Why an answer should be looked at by a human, or an empty text.

    A loss that costs no marks is none, nor is a wrong whole whose parts have a diagnosis.
    """
    if a.verdict == "unreadable":
        return a.fault or "it could not be read"
    if a.loss and a.of != "0":
        return f"{a.verdict}, but {a.loss}"
    if a.verdict == "wrong" and not a.diagnosis and BY_PARTS not in a.note:
        return "it is wrong, and no slip was found that explains it"
    return ""
