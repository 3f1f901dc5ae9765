"""The verdict of an answer DH: a table is right if it describes the robot's mechanism.

Whatever frames the student has chosen, every cell is right where the table moves the hand as the
robot's does; what the student counts otherwise is a note, or wrong where the problem is `strict`.
A wrong table is told by the cell that is to blame, and by what it does instead.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from msgspec.structs import replace

from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.judging.mechanism.matching import Mismatch
from dynsolve.answers.judging.mechanism.own_frames import in_own_frames
from dynsolve.answers.judging.mechanism.repairs import (
    Exchange,
    Repair,
    counted,
    effect,
    parting,
    repairs_of,
    written,
)
from dynsolve.answers.judging.mechanism.tables import (
    LETTERS,
    Agreement,
    Table,
    TableComparer,
    TableError,
    read_table,
)
from dynsolve.answers.verdict import Answer, Diagnosis, EntryVerdict, JudgedAnswer, Occurrence, Verdict
from dynsolve.notation import tree
from dynsolve.problem.model import Problem
from dynsolve.robot.model import Convention

NAME = "DH"
Rows = tuple[tuple[tree.Node, ...], ...]
Cell = tuple[int, int]
"""Row and column, from 0."""
ROUNDED = "rounded"
HELD = "compared as a mechanism, in numbers at several values of its letters"
"""What is said of a right table that is not the key's cell by cell: equality is not proved term by term."""


class TableJudge:
    """Judges the tables that are handed in for one problem."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.comparer = TableComparer(problem)

    def __call__(self, answers: Sequence[Answer]) -> JudgedAnswer:
        """What is said of the table that counts, the last one."""
        judged = [self._judged(answer) for answer in answers]
        if len(judged) < 2:
            return judged[0]
        told = (Occurrence(a.place, a.label, j.verdict) for a, j in zip(answers, judged, strict=True))
        return replace(judged[-1], occurrences=tuple(told))

    def own_problems(self, answer: Answer) -> Iterator[Problem]:
        """The problem in the frames of a right table, in every sense; none where they are the key's."""
        if not isinstance(answer.node, tree.Matrix):
            return
        try:
            table = read_table(answer.node.rows, self.problem.robot.coordinates)
            found = self.comparer(table)
        except TableError:
            return
        if isinstance(found, Agreement) and not self.comparer.is_the_keys(table):
            yield from in_own_frames(self.problem, table, found, self.comparer.letters)

    def _judged(self, answer: Answer) -> JudgedAnswer:
        base = JudgedAnswer(
            NAME,
            Verdict.UNREADABLE,
            answer.label,
            answer.place,
            answer.read_as,
            answer.notes,
            of=Fraction(self.problem.marks.get(NAME, 0)),
            written=answer.node,
        )
        if not isinstance(answer.node, tree.Matrix):
            return replace(base, fault=answer.fault or "this is no table", expected=answer.expected)
        rows = answer.node.rows
        if self.problem.robot.is_tree:
            fault, help = (
                "the links of this robot branch, which a table handed in does not say",
                "a person has to look at this",
            )
            return replace(base, fault=fault, expected=help)
        try:
            table = read_table(rows, self.problem.robot.coordinates)
            found = self.comparer(table)
        except TableError as error:
            diagnosis = slip("dh_joints", yours=error.message)
            blamed = {(error.row - 1, error.column - 1): diagnosis} if error.column else {}
            return _wrong(base, rows, blamed, diagnosis)
        if self.comparer.is_one_of(table, self.problem.accepted.also):
            return replace(base, verdict=Verdict.CORRECT, entries=tuple(_entries(rows, {})))
        if isinstance(found, Mismatch):
            return self._mismatched(base, rows, table, found)
        return self._agreed(base, rows, table, found)

    def _agreed(self, base: JudgedAnswer, rows: Rows, table: Table, found: Agreement) -> JudgedAnswer:
        notes = [counted(q) for q in found.coordinates if not q.is_the_keys]
        if self.problem.accepted.strict and notes:
            return _wrong(base, rows, {}, slip("dh_sense", yours="; ".join(notes)))
        notes += [ROUNDED] * found.is_rounded
        notes += [HELD] * (not self.comparer.is_the_keys(table))
        entries = tuple(_entries(rows, {}))
        return replace(base, verdict=Verdict.CORRECT, notes=(*base.notes, *notes), entries=entries)

    # -- wrong -------------------------------------------------------------------------------------

    def _mismatched(self, base: JudgedAnswer, rows: Rows, table: Table, found: Mismatch) -> JudgedAnswer:
        repairs = repairs_of(self.comparer, table, found)
        convention = self._other_convention(table) if len(repairs) != 1 else None
        if convention is not None:
            return _wrong(base, rows, {}, convention)
        blamed = {cell: self._told(table, repair) for repair in repairs for cell in repair.cells}
        where = parting(found, len(self.comparer.joints))
        return _wrong(base, rows, blamed, slip("dh_mechanism", part=where))

    def _told(self, table: Table, repair: Repair | Exchange) -> Diagnosis:
        if isinstance(repair, Exchange):
            return slip("dh_exchanged", part=str(repair.row + 1))
        return slip(
            "dh_cell",
            part=f"{repair.row + 1}, {LETTERS[repair.column]}",
            yours=written(repair.yours),
            other=written(repair.needed),
            term=effect(self.comparer, table, repair),
        )

    def _other_convention(self, table: Table) -> Diagnosis | None:
        """The slip of rows that are the mechanism in the other convention, at least up to the last joint."""
        n = self.problem.robot.n
        if n < 2:
            return None
        is_modified = self.comparer.modified
        turned = Convention.STANDARD if is_modified else Convention.MODIFIED
        found = TableComparer(self.problem, read_as=turned)(table)
        mine, other = ("modified", "standard") if is_modified else ("standard", "modified")
        if isinstance(found, Agreement):
            return slip("dh_convention", part=mine, other=other)
        if found.joint < n:
            return None
        return slip("dh_shifted", part=mine, other=other, yours="high" if is_modified else "low")


def _wrong(
    base: JudgedAnswer, rows: Rows, blamed: Mapping[Cell, Diagnosis], whole: Diagnosis | None = None
) -> JudgedAnswer:
    """A wrong table; `blamed` are the cells (from 0) that are, none where the whole of it is."""
    entries = tuple(_entries(rows, blamed)) if blamed else ()
    told = tuple(dict.fromkeys(blamed[cell] for cell in sorted(blamed))) or ((whole,) if whole else ())
    return replace(base, verdict=Verdict.WRONG, entries=entries, diagnosis=told)


def _entries(rows: Rows, blamed: Mapping[Cell, Diagnosis]) -> Iterator[EntryVerdict]:
    for i, row in enumerate(rows):
        for j in range(len(row)):
            told = (blamed[i, j],) if (i, j) in blamed else ()
            yield EntryVerdict((i + 1, j + 1), Verdict.WRONG if told else Verdict.CORRECT, told)
