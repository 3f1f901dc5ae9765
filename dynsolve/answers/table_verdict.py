"""The verdict of an answer DH: a table is right if it describes the robot's mechanism.

Whatever frames the student has chosen, every cell is right where the table moves the hand as the
robot's does; what the student counts otherwise is a note, or wrong where the problem is `strict`.
A wrong table is told by the cell that is to blame, and by what it does instead.

Which cell of a wrong table is to blame: the one with which, put right, the table is the mechanism.

Tried are d and a exchanged, and cell by cell the key's own cell, the cell with the other sign, 0,
quarter turns, and the other lengths and angles of both tables.  The change after which the student's
coordinates are the key's is preferred, then one near the joint at which the student's chain parts
from the key's.

What is said of a table: how its coordinates are counted, and what a wrong cell does instead.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import islice
from math import degrees

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.judging.mechanism.matching import Mismatch
from dynsolve.answers.judging.mechanism.own_frames import in_own_frames
from dynsolve.answers.judging.mechanism.tables import (
    ANGLES,
    LETTERS,
    NO_VALUE,
    Agreement,
    OwnCoordinate,
    Table,
    TableComparer,
    TableError,
    TableRow,
    read_table,
)
from dynsolve.answers.verdict import (
    Answer,
    Diagnosis,
    EntryVerdict,
    JudgedAnswer,
    Occurrence,
    Verdict,
    unjudged,
)
from dynsolve.notation import tree
from dynsolve.notation.build import negated
from dynsolve.notation.tree import ZERO, Degrees, Node, Symbol
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem.model import Problem
from dynsolve.robot.model import Convention

# Which cell of a wrong table is to blame

# Which cell of a wrong table is to blame

_ANGLES = (ZERO, Degrees(90), negated(Degrees(90)), Degrees(180))
_MOST_TRIED = 400
_MOST_STEPS = 120


class Repair(Struct, frozen=True):
    """The constant part that a cell needs; row from 0, column from 0."""

    row: int
    column: int
    yours: Node
    needed: Node

    @property
    def cells(self) -> tuple[tuple[int, int], ...]:
        """The cell."""
        return ((self.row, self.column),)


class Exchange(Struct, frozen=True):
    """Two cells of a row that have to change places."""

    row: int
    columns: tuple[int, int]

    @property
    def cells(self) -> tuple[tuple[int, int], ...]:
        """The two cells."""
        return tuple((self.row, column) for column in self.columns)


def repairs_of(
    comparer: TableComparer, table: Table, found: Mismatch, most: int = 3
) -> tuple[Repair | Exchange, ...]:
    """The changes that make a table right: a single one, or a few of which each takes it further."""
    single = repair_of(comparer, table, found)
    if single is not None:
        return (single,)
    step = _furthest(comparer, table, found) if most > 1 else None
    if step is None:
        return ()
    change, changed, parting = step
    others = repairs_of(comparer, changed, parting, most - 1)
    return (change, *others) if others else ()


def _furthest(
    comparer: TableComparer, table: Table, found: Mismatch
) -> tuple[Repair | Exchange, Table, Mismatch] | None:
    """The first change after which a table parts from the key's at the latest joint, later than it does."""
    best: tuple[Repair | Exchange, Table, Mismatch] | None = None
    for change, changed in islice(_changes(comparer, table, _culprit(comparer, table, found)), _MOST_STEPS):
        parting = comparer(changed)
        if isinstance(parting, Mismatch) and parting.depth > (best[2] if best else found).depth:
            best = change, changed, parting
    return best


def repair_of(comparer: TableComparer, table: Table, found: Mismatch) -> Repair | Exchange | None:
    """The smallest change that makes a table right; None where no single one does."""
    best: tuple[tuple[int, int], Repair | Exchange] | None = None
    culprit = _culprit(comparer, table, found)
    for place, (change, changed) in enumerate(_changes(comparer, table, culprit)):
        if place >= _MOST_TRIED:
            break
        others = comparer.agrees(changed)
        if others is not None and (best is None or (others, place) < best[0]):
            best = (others, place), change
            if not others:
                break
    return best[1] if best else None


def _culprit(comparer: TableComparer, table: Table, found: Mismatch) -> int:
    """The row (from 0) that takes the chain to the joint where it parts from the key's."""
    moving = [i for i, row in enumerate(table) if row.variable is not None]
    if found.joint >= len(moving):
        return len(table) - 1
    return moving[found.joint] - (0 if comparer.modified else 1)


def _changes(
    comparer: TableComparer, table: Table, culprit: int
) -> Iterator[tuple[Repair | Exchange, Table]]:
    rows = sorted(range(len(table)), key=lambda i: abs(i - culprit))
    for i in rows:
        constants = table[i].constants
        if constants[1] != constants[2]:
            exchanged = table[i].changed(1, constants[2]).changed(2, constants[1])
            yield Exchange(i, (1, 2)), _with(table, i, exchanged)
    keys = comparer.key
    if len(keys) == len(table):
        for i in rows:
            for column in range(4):
                yield from _changed(table, i, column, (keys[i].constants[column],))
    for i in rows:
        for column in range(4):
            yield from _changed(table, i, column, (negated(table[i].constants[column]), ZERO))
    for i in rows:
        for column in range(4):
            yield from _changed(table, i, column, tuple(_candidates(comparer, table, column)))


def _candidates(comparer: TableComparer, table: Table, column: int) -> Iterator[Node]:
    """What may belong into a column: what stands in columns of its kind in either table."""
    if column in ANGLES:
        yield from _ANGLES
    kind = ANGLES if column in ANGLES else (1, 2)
    for row in (*comparer.key, *table):
        for other in kind:
            yield row.constants[other]
            yield negated(row.constants[other])


def _changed(table: Table, i: int, column: int, nodes: tuple[Node, ...]) -> Iterator[tuple[Repair, Table]]:
    yours = table[i].constants[column]
    for node in dict.fromkeys(nodes):
        if node != yours:
            yield Repair(i, column, yours, node), _with(table, i, table[i].changed(column, node))


def _with(table: Table, i: int, row: TableRow) -> Table:
    return (*table[:i], row, *table[i + 1 :])


# What is said of a table

THETA, D, A, ALPHA = range(4)


def written(node: Node) -> str:
    """A cell as it is shown."""
    return to_unicode(node)


def counted(q: OwnCoordinate) -> str:
    """How a student counts a coordinate: `your θ₂ is -θ₂ + 90° of the robot's`."""
    name = to_unicode(Symbol(q.name))
    if q.offset == 0:
        return f"{name} is counted the other way"
    own = f"-{name}" if q.sense < 0 else name
    if q.offset is None or q.is_length:
        return f"{name} is counted from elsewhere" + (" and the other way" if q.sense < 0 else "")
    sign = "-" if q.offset < 0 else "+"
    return f"{name} is counted otherwise: yours is {own} {sign} {abs(q.offset):g}° in the robot's"


def parting(found: Mismatch, joints: int) -> str:
    """Where a table leaves the robot's mechanism."""
    what = "the hand" if found.joint >= joints else f"the axis of joint {found.joint + 1}"
    return f"{what} has another direction" if found.reason == "direction" else f"{what} lies elsewhere"


def effect(comparer: TableComparer, table: Table, repair: Repair) -> str:
    """What the row does with the cell as it is."""
    before, after = _joints(comparer, table, repair.row)
    yours, needed = written(repair.yours), written(repair.needed)
    match repair.column:
        case column if column == ALPHA:
            angles = [_acute(comparer, node) for node in (repair.yours, repair.needed)]
            if angles[0] == angles[1]:
                return f"With yours {after} points the opposite way."
            now, then = map(_lie, angles)
            return f"α is the angle from {before} to {after}: with yours they are {now}, and they are {then}."
        case column if column == A:
            return (
                f"a is the distance from {before} to {after}: with yours it is {yours}, and it is {needed}."
            )
        case column if column == D:
            return f"d is the way along {before}: with yours {after} is reached after {yours}, not {needed}."
    return f"θ turns x about {before}: with yours all that follows is turned by {yours}, not {needed}."


def _joints(comparer: TableComparer, table: Table, row: int) -> tuple[str, str]:
    moving = sum(other.variable is not None for other in table[: row + 1])
    is_fixed = table[row].variable is None
    n = len(comparer.joints)

    def named(k: int) -> str:
        return (
            f"the axis of joint {k}" if 1 <= k <= n else "the z of the hand" if k > n else "the z of frame 0"
        )

    if comparer.modified:
        return (named(moving), named(moving + 1)) if is_fixed else (named(moving - 1), named(moving))
    return named(moving), named(moving + 1)


def _acute(comparer: TableComparer, node: Node) -> float | None:
    """An angle between lines in degrees, 0 to 180, without its sign; None where it has no value."""
    try:
        value = degrees(float(evaluate(node, comparer.letters[0])))
    except NO_VALUE:
        return None
    return round(abs((value + 180) % 360 - 180), 6)


def _lie(angle: float | None) -> str:
    if angle is None:
        return "at an angle that is not known"
    return {0.0: "parallel", 90.0: "perpendicular", 180.0: "opposite"}.get(angle, f"at {angle:g}°")


# The verdict

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
        base = unjudged(answer, NAME, Fraction(self.problem.marks.get(NAME, 0)))
        if not isinstance(answer.node, tree.Matrix):
            return replace(base, fault=answer.fault or "this is no table", expected=answer.expected)
        rows = answer.node.rows
        if self.problem.robot.is_tree:
            fault = "the links of this robot branch, which a table handed in does not say"
            return replace(base, fault=fault, expected="a person has to look at this")
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
