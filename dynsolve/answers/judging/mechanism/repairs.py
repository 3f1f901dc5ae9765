"""Which cell of a wrong table is to blame: the one with which, put right, the table is the mechanism.

Tried are d and a exchanged, and cell by cell the key's own cell, the cell with the other sign, 0,
quarter turns, and the other lengths and angles of both tables.  The change after which the student's
coordinates are the key's is preferred, then one near the joint at which the student's chain parts
from the key's.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

from dynsolve.answers.judging.mechanism.comparison import TableComparer
from dynsolve.answers.judging.mechanism.matching import Mismatch
from dynsolve.answers.judging.mechanism.tables import ANGLES, Table, TableRow
from dynsolve.notation.build import negated
from dynsolve.notation.tree import ZERO, Degrees, Node

_ANGLES = (ZERO, Degrees(90), negated(Degrees(90)), Degrees(180))
_MOST_TRIED = 400
_MOST_STEPS = 120


@dataclass(frozen=True, slots=True)
class Repair:
    """The constant part that a cell needs; row from 0, column from 0."""

    row: int
    column: int
    yours: Node
    needed: Node

    @property
    def cells(self) -> tuple[tuple[int, int], ...]:
        """The cell."""
        return ((self.row, self.column),)


@dataclass(frozen=True, slots=True)
class Exchange:
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
