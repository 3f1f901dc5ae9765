"""The record of one hand-in: its answers with their places, before anything is judged.

`answers.reading` makes these records, `answers.judging` and `answers.diagnosis` use
them; they are data and compute nothing.  The trees are made of the problem's own
symbols: coordinates (`Symbol(name, dots)`), parameters, sines and cosines.  An argument
of a sine may be anything that a student writes.
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.errors import Finding
from dynsolve.notation.tree import Matrix, Node

PICTURE = "a picture stands here; pictures are not read"
"""Why what may stand in a picture waits."""


@dataclass(frozen=True, slots=True)
class Place:
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


@dataclass(frozen=True, slots=True)
class Answer:
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


@dataclass(frozen=True, slots=True)
class Part:
    """One formula of an alternative: that of a coordinate, or without a name what is 0."""

    coordinate: str
    node: Node


@dataclass(frozen=True, slots=True)
class ConfigurationAnswer:
    """A set that was given for one quantity: singular configurations, branches of the inverse kinematics.

    `fault` says why it could not be read, `expected` what to write.
    """

    name: str
    place: Place
    text: str
    alternatives: tuple[tuple[Part, ...], ...] = ()
    fault: str = ""
    expected: str = ""


@dataclass(frozen=True, slots=True)
class VerdictAnswer:
    """What was said of matrices: (name, `yes`, `no` or `if`) of each, without a name of the only one.

    `fault` says why it could not be read, `expected` what to write.
    """

    name: str
    place: Place
    text: str
    words: tuple[tuple[str, str], ...] = ()
    fault: str = ""
    expected: str = ""


@dataclass(frozen=True, slots=True)
class NotRecognized:
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


@dataclass(frozen=True, slots=True)
class Submission:
    """One file that was handed in, for one problem; `student` and `problem` as the file says, or empty.

    What is no answer is `not_recognized`, or `left_alone`: definitions, general formulas, and what a
    sentence says.  So every equation of the file is in one of the three; see `ledger`.
    `general` has the formulas of names alone once more, as what they would answer (`general_formulas`).
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
