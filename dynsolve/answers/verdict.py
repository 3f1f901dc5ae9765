"""What is said of an answer: data, made in `judge`, shown in `report`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction

from dynsolve.answers.submission import NotRecognized, Place
from dynsolve.errors import Finding
from dynsolve.notation.tree import Node


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


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """A named slip; `code` is one of the table's, `message` says it to the student, `hint` what to look at.

    `kind` is the class of slip in a few words, for a hint that does not say how.
    """

    code: str
    message: str
    kind: str = ""
    look: str = ""


@dataclass(frozen=True, slots=True)
class EntryVerdict:
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


@dataclass(frozen=True, slots=True)
class Occurrence:
    """One place where an answer was given."""

    place: Place
    label: str
    verdict: Verdict


@dataclass(frozen=True, slots=True)
class JudgedAnswer:
    """What is said of one answer; `written` is the tree of what the student wrote.

    What it is worth beside its verdict (`zero`, `empty`, `loss`, `parts`) is explained in
    `marking.substance`.
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
    zero: bool = False
    empty: bool = False
    loss: str = ""
    parts: tuple[JudgedAnswer, ...] = ()


@dataclass(frozen=True, slots=True)
class Report:
    """What is said of a hand-in; `answers` stand in the order of the derivation.

    What is no answer is in `not_recognized`, where some wait for a human, or in `set_aside` (`ledger`).
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
