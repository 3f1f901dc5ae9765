"""What is said of an answer: data, made in `judge`, shown in `report`.

`answers.reading` makes these records, `answers.judging` and `answers.diagnosis` use
them; they are data and compute nothing.  The trees are made of the problem's own
symbols: coordinates (`Symbol(name, dots)`), parameters, sines and cosines.  An argument
of a sine may be anything that a student writes.

What becomes of the equations of a hand-in that were not judged: they wait for a human, or are set aside.

An equation whose left side names what is asked for waits where nothing else answers that, so that no
mark is lost to what was not read; else it is set aside, with its reason.  A picture waits for all that is
missing.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import StrEnum
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.errors import Finding
from dynsolve.notation.tree import Matrix, Node
from dynsolve.quantities.index import Quantities
from dynsolve.questions.judging import Part

# The record of one hand-in: its answers with their places, before anything is judged

PICTURE = "a picture stands here; pictures are not read"
"""Why what may stand in a picture waits."""


class Place(Struct, frozen=True):
    """Where something stands in its file: line and column from 1; `excerpt` is that line.

    `file` is its name where several were handed in together.
    """

    line: int
    column: int
    length: int = 1
    excerpt: str = ""
    file: str = ""

    def __str__(self) -> str:
        return f"line {self.line} of {self.file}" if self.file else f"line {self.line}"


class Answer(Struct, frozen=True):
    """One value given for one quantity.

    `name` is the canonical name of the quantity (K, tau1, d12, Cqd, I_body1);
    `alternatives` are further canonical names that the notation allows (a bare I_1 is
    I_body1 or I1).  `node` is a scalar tree or a `Matrix` of scalar trees, None where the
    text could not be read: `fault` then says why, `expected` what to write, `place` where.

    `references` are the answers that occur inside the value: a scalar one as
    `Reference("K1")`, a matrix one entry by entry as `Reference("I1", 1, 3)`.  `free` are
    the names of symbols that are no symbol of the problem (h0, a zero level of height).
    `turned` are the coordinates that it counts the other way than the problem does.
    `whole` is the matrix that it was written in, where another entry of this could not be read.
    `partial` is a matrix of which the entries at `unread`, from 0, could not be read, with 0 in their places.
    `is_equation` says that it is one side of `... = 0`, which may be multiplied by a factor.
    `doubt` says why it may be meant of one case alone, and so waits where it is not right.
    `occurrence` is (chain, member): which equation of the file, and which member of
    `a = b = c` from 0; answers stand in the order of the file.
    """

    name: str
    label: str
    node: Node | None
    place: Place
    text: str
    read_as: str = ""
    notes: tuple[str, ...] = ()
    fault: str = ""
    expected: str = ""
    alternatives: tuple[str, ...] = ()
    references: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    turned: tuple[str, ...] = ()
    is_equation: bool = False
    whole: str = ""
    doubt: str = ""
    partial: Matrix | None = None
    unread: tuple[tuple[int, int], ...] = ()
    occurrence: tuple[int, int] = (0, 0)


class ConfigurationAnswer(Struct, frozen=True):
    """A set that was given for one quantity: singular configurations, branches of the inverse kinematics.

    `fault` says why it could not be read, `expected` what to write.
    """

    name: str
    place: Place
    text: str
    alternatives: tuple[tuple[Part, ...], ...] = ()
    fault: str = ""
    expected: str = ""


class VerdictAnswer(Struct, frozen=True):
    """What was said of matrices: (name, `yes`, `no` or `if`) of each, without a name of the only one.

    `fault` says why it could not be read, `expected` what to write.
    """

    name: str
    place: Place
    text: str
    words: tuple[tuple[str, str], ...] = ()
    fault: str = ""
    expected: str = ""


class NotRecognized(Struct, frozen=True):
    """An equation that is no answer; `why` says what kept it from being one.

    `answers` are what its sides name; one of names alone would answer them if what it `needs` were
    given.  Where nothing else answers what is asked for, the answers of `waits`, a human has to look at it.
    """

    text: str
    label: str
    place: Place
    why: str = ""
    answers: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    waits: tuple[str, ...] = ()


class Submission(Struct, frozen=True):
    """One file that was handed in, for one problem; `student` and `problem` as the file says, or empty.

    What is no answer is `not_recognized`, or `left_alone`: definitions, general formulas, and what a
    sentence says.  So every equation of the file is in one of the three; see `Ledger`.
    `general` has the formulas of names alone once more, as what they would answer (`answers.judge`).
    """

    problem: str
    student: str
    file: str
    answers: tuple[Answer, ...]
    not_recognized: tuple[NotRecognized, ...] = ()
    faults: tuple[Finding, ...] = ()
    left_alone: tuple[NotRecognized, ...] = ()
    general: tuple[Answer, ...] = ()
    configurations: tuple[ConfigurationAnswer, ...] = ()
    verdicts: tuple[VerdictAnswer, ...] = ()


class Verdict(StrEnum):
    """The verdicts, the worst first in the order in which a whole takes them from its parts."""

    WRONG = "wrong"
    UNREADABLE = "unreadable"
    MISSING = "missing"
    FOLLOWS = "follows"
    CORRECT = "correct"


ORDER = tuple(Verdict)


def worst(verdicts: list[Verdict]) -> Verdict:
    """The verdict of a whole from those of its parts."""
    return min(verdicts, key=ORDER.index)


class Diagnosis(Struct, frozen=True):
    """A named slip; `code` is one of the table's, `message` says it to the student, `hint` what to look at.

    `kind` is the class of slip in a few words, for a hint that does not say how.
    """

    code: str
    message: str
    kind: str = ""
    look: str = ""


class EntryVerdict(Struct, frozen=True):
    """What is said of one entry of a matrix, or of one row of C; `index` counts from 1.

    `zero` tells that the key is 0 there for every q, `empty` that it earns nothing by itself:
    it is 0 where the key is not, or follows from what is empty.
    """

    index: tuple[int, ...]
    verdict: Verdict
    diagnosis: tuple[Diagnosis, ...] = ()
    follows_from: tuple[str, ...] = ()
    difference: Node | None = None
    zero: bool = False
    empty: bool = False


class Occurrence(Struct, frozen=True):
    """One place where an answer was given."""

    place: Place
    label: str
    verdict: Verdict


class JudgedAnswer(Struct, frozen=True):
    """What is said of one answer; `written` is the tree of what the student wrote.

    `waits`: it was read and is not the key's, and a human has to judge it.
    What it is worth beside its verdict (`zero`, `empty`, `loss`, `parts`) is explained in
    `marks`.
    """

    name: str
    verdict: Verdict
    label: str = ""
    place: Place | None = None
    read_as: str = ""
    notes: tuple[str, ...] = ()
    follows_from: tuple[str, ...] = ()
    occurrences: tuple[Occurrence, ...] = ()
    entries: tuple[EntryVerdict, ...] = ()
    diagnosis: tuple[Diagnosis, ...] = ()
    fault: str = ""
    expected: str = ""
    marks: Fraction = Fraction(0)
    of: Fraction = Fraction(0)
    difference: Node | None = None
    key: Node | None = None
    given: bool = True
    written: Node | None = None
    waits: bool = False
    zero: bool = False
    empty: bool = False
    loss: str = ""
    parts: tuple[JudgedAnswer, ...] = ()


def unjudged(answer: Answer, name: str, of: Fraction) -> JudgedAnswer:
    """The record of an answer before anything is said of it; `of` are its marks."""
    return JudgedAnswer(
        name, Verdict.UNREADABLE, answer.label, answer.place, answer.read_as, answer.notes,
        of=of, written=answer.node,
    )  # fmt: skip


class Report(Struct, frozen=True):
    """What is said of a hand-in; `answers` stand in the order of the derivation.

    What is no answer is in `not_recognized`, where some wait for a human, or in `set_aside` (`Ledger`).
    """

    problem: str
    student: str
    file: str
    answers: tuple[JudgedAnswer, ...]
    not_recognized: tuple[NotRecognized, ...] = ()
    first_wrong: str = ""
    faults: tuple[Finding, ...] = ()
    set_aside: tuple[NotRecognized, ...] = ()

    @property
    def marks(self) -> Fraction:
        """The marks of all answers."""
        return sum((a.marks for a in self.answers), Fraction(0))

    @property
    def of(self) -> Fraction:
        """The marks that there are."""
        return sum((a.of for a in self.answers), Fraction(0))

    @property
    def all_correct(self) -> bool:
        """Whether nothing falls short."""
        return all(a.verdict is Verdict.CORRECT for a in self.answers)

    @property
    def none_read(self) -> bool:
        """Whether nothing is there to be read: no answer, and no equation."""
        return not (any(a.given for a in self.answers) or self.not_recognized or self.set_aside)


# What becomes of the equations of a hand-in that were not judged


class Ledger:
    """The equations that were not judged: `not_recognized`, some of which wait, and `set_aside`.

    `refused` could not be read as answers, `explained` are definitions, quotations and what a sentence says.
    """

    def __init__(
        self,
        quantities: Quantities,
        answers: Mapping[str, JudgedAnswer],
        refused: Iterable[NotRecognized],
        explained: Iterable[NotRecognized],
    ) -> None:
        self.quantities = quantities
        given = {name for name, answer in answers.items() if answer.verdict is not Verdict.MISSING}
        asked = {name: {quantities.entry_of(name)[0], *quantities.within(name)} for name in answers}
        absent = {name: names - given for name, names in asked.items() if name not in given}
        known = frozenset[str]().union(*asked.values())
        self.not_recognized = list[NotRecognized]()
        self.set_aside = list[NotRecognized]()
        for one, is_known in (*((r, False) for r in refused), *((e, True) for e in explained)):
            waits = tuple(sorted(n for n, names in absent.items() if not names.isdisjoint(one.answers)))
            of_others = bool(one.answers) and known.isdisjoint(one.answers)
            if one.why == PICTURE:
                self.not_recognized += [replace(one, answers=waits, waits=waits)] if waits else []
            elif waits or not (is_known or of_others or given & set(one.answers)):
                self.not_recognized.append(replace(one, waits=waits))
            else:
                self.set_aside.append(replace(one, answers=tuple(n for n in one.answers if n in known)))

    def waiting(self, answers: Mapping[str, JudgedAnswer]) -> dict[str, JudgedAnswer]:
        """The answers, the missing ones with the last equation, or part, that a human has to look at."""
        found = dict(answers)
        for name, answer in answers.items():
            parts = [answers[p] for p in self.quantities.within(name) if p in answers]
            unread = [part for part in parts if part.verdict is Verdict.UNREADABLE]
            if answer.verdict is Verdict.MISSING and unread:
                fault = f"{unread[0].name}: {unread[0].fault}"
                found[name] = replace(answer, place=unread[0].place, notes=(fault,), fault=fault)
        for one in self.not_recognized:
            for name in one.waits:
                if one.why == PICTURE and found[name].fault:
                    continue
                found[name] = replace(
                    found[name], label=one.label, place=one.place, notes=(one.why,), fault=one.why
                )
        return found
