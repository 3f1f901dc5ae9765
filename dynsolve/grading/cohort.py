"""What the record comes to: the marks of every student, and what is counted for the teacher's page.

What waits for a human: one list, for the teacher's page, for `queue.csv` and for the terminal.

An entry is an answer that waits for marks, alone or with the others of a file that no program can
judge, or a file that should be looked at.  An answer leaves the list when a teacher has given it marks,
a file beside a hand-in that was judged, or a picture in one, when a teacher has said a word on one of its
answers.

How an answer did in a cohort: its mean, who had it right, and how well it tells strong from weak students.

The last is the corrected item-total correlation: Pearson's r of the marks x of the answer with
what the same students earned for everything else, t - x, where t is all that they earned,

    r_x(t-x) = (r_xt s_t - s_x) / sqrt(s_x^2 + s_t^2 - 2 r_xt s_x s_t),

with the standard deviations s.  It is near 1 where those who have the answer are those who have the
rest, near 0 where it has nothing to do with the rest, and below 0 where something is wrong with the
answer or its key.  (Nunnally and Bernstein, Psychometric Theory, 3rd edition, 1994, chapter 8.)
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence, Set
from fractions import Fraction
from itertools import groupby
from statistics import correlation, fmean

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.answers.marks import Marked, deduction, maximum, points
from dynsolve.answers.unwritten import BY_PARTS
from dynsolve.answers.verdict import PICTURE
from dynsolve.grading.record import Key, Record, RecordedAnswer
from dynsolve.grading.set_file import ProblemSet, stored_policy
from dynsolve.quantities.index import quantities

# How an answer did in a cohort

FEWEST = 3
"""Two students always lie on a line."""


class Item(Struct, dict=True):
    """The marks of one answer, of those whose hand-in does not wait; `totals` are theirs for everything.

    Of whom another hand-in waits for a human there is no total yet: None.
    """

    of: float
    marks: list[float] = field(default_factory=list)
    totals: list[float | None] = field(default_factory=list)
    correct: int = 0

    def add(self, marks: float, total: float | None, correct: bool) -> None:
        """Count one student."""
        self.marks.append(marks)
        self.totals.append(total)
        self.correct += correct

    @property
    def mean(self) -> float | None:
        """The mean of the marks."""
        return fmean(self.marks) if self.marks else None

    @property
    def share_correct(self) -> float | None:
        """The share of the students who had it right."""
        return self.correct / len(self.marks) if self.marks else None

    @property
    def item_rest(self) -> float | None:
        """The corrected item-total correlation of those who have a total."""
        both = [(x, t) for x, t in zip(self.marks, self.totals, strict=True) if t is not None]
        return item_rest([x for x, _ in both], [t for _, t in both])


def item_rest(marks: Sequence[float], totals: Sequence[float]) -> float | None:
    """The correlation of marks with the rest of the totals.

    None for fewer than three students, and where all have the same marks or the same rest.

    >>> item_rest([0, 2, 1], [1, 4, 4]), item_rest([1, 1, 1], [1, 2, 3]), item_rest([0, 1], [0, 2])
    (0.5, None, None)
    """
    rest = [t - x for x, t in zip(marks, totals, strict=True)]
    if len(marks) < FEWEST or _is_flat(marks) or _is_flat(rest):
        return None
    return correlation(marks, rest)


def _is_flat(values: Sequence[float]) -> bool:
    """Whether all are the same, but for what is lost where decimals are taken from each other."""
    return max(values) - min(values) < 1e-9


# What waits for a human

OVERTAKEN = "its marks were set by hand for an earlier hand-in"
LEFT_ASIDE = "left aside: a newer copy counts"


class Entry(Struct, frozen=True):
    """Something for a human: `what` it is, a file or an answer, why, and the answer that waits for marks."""

    student: str
    problem: str
    what: str
    why: str
    answer: RecordedAnswer | None = None


def queue(record: Record, stems: Collection[str]) -> list[Entry]:
    """All that waits, files first; `stems` are the problems of the set."""
    unjudged = {(s, p): why for s, found in record.unjudged().items() for p, why in found.items()}
    judged_by_hand = {(s, p) for s, p, _ in record.overrides()}
    answers, single = _answers(record, unjudged, judged_by_hand)
    hand_ins = [replace(row, html=b"", markdown=b"") for row in record.rows()]
    reasons = {(row.student, row.problem): row.reason for row in hand_ins}
    found: list[Entry] = []
    for w in record.waiting():
        keys = [(w.student, stem) for stem in ((w.problem,) if w.problem else stems)]
        open_ = [key for key in keys if key in unjudged]
        settled = not open_ and any(reasons.get(key) or key in judged_by_hand for key in keys)
        if not settled:
            own = [answer for key in open_ for answer in answers.pop(key, ())]
            found += _each(Entry(w.student, w.problem, w.file, w.reason), own)
    for row in hand_ins:
        key = (row.student, row.problem)
        if key in answers:
            found += _each(Entry(*key, ", ".join(row.files), row.reason), answers[key])
        if row.left and key not in judged_by_hand:
            found.append(Entry(*key, ", ".join(row.left), LEFT_ASIDE))
    return found + single


def _each(entry: Entry, answers: Sequence[RecordedAnswer]) -> list[Entry]:
    """An entry for each of some answers; without any it stands alone."""
    return [replace(entry, problem=a.problem, answer=a) for a in answers] or [entry]


def _answers(
    record: Record, unjudged: Collection[Key], judged_by_hand: Collection[Key]
) -> tuple[dict[Key, list[RecordedAnswer]], list[Entry]]:
    """The answers of the hand-ins that nobody has judged, and the single answers of others that wait."""
    of_unjudged: dict[Key, list[RecordedAnswer]] = {}
    single: list[Entry] = []
    overtaken = record.overtaken()
    for a in record.answers():
        key, what = (a.student, a.problem), f"{a.answer} {a.label}".strip()
        if (*key, a.answer) in overtaken:
            single.append(Entry(*key, what, OVERTAKEN, a))
        elif a.of == "0" or a.said or (a.fault == PICTURE and key in judged_by_hand):
            continue
        elif key in unjudged:
            of_unjudged.setdefault(key, []).append(a)
        elif reason := for_a_human(a):
            single.append(Entry(*key, what, reason, a))
    return of_unjudged, single


def for_a_human(a: RecordedAnswer) -> str:
    """Why an answer that was judged should be looked at by a human, or an empty text.

    A wrong whole whose parts have a diagnosis need not be.
    """
    if a.verdict == "unreadable":
        return a.fault or "it could not be read"
    if a.verdict == "missing" and a.fault:
        return f"no answer was read, but line {a.line} names it: {a.fault}"
    if a.loss:
        return f"{a.verdict}, but {a.loss}"
    if a.verdict == "wrong" and not a.diagnosis and BY_PARTS not in a.note:
        return "it is wrong, and no slip was found that explains it"
    return ""


class Standing(Struct, frozen=True):
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


class SlipExample(Struct, frozen=True):
    """An example of a slip: the student, and the message or the text of the answer."""

    student: str
    text: str


class Alike(Struct, dict=True):
    """Those who wrote the same wrong expression."""

    text: str
    students: list[str]


class Cohort(Struct, dict=True):
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
            is_right = answer.marks == answer.of if answer.said else answer.verdict == "correct"
            found.add(float(points(answer.marks)), totals.get(answer.student), is_right)
    cohort.pages |= {(answer.student, answer.problem) for answer in cohort.by_hand}
    return cohort


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
