"""A Denavit-Hartenberg table as it is written: its cells as trees, its joint variables, its numbers.

In a student's table a coordinate is a joint variable with or without its star, and a bare number
stands for degrees where an angle belongs, unless it is one in radians.

A student's table against the key's, by the mechanism: at values of its letters in either order.

An equality of two tables is an equality of polynomials in sines, cosines and lengths; what holds at
several such points to nine digits holds.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import islice
from math import degrees, pi, remainder

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.sampling import numbered
from dynsolve.answers.judging.mechanism.matching import (
    Chain,
    Match,
    Matching,
    Mismatch,
    NumberRow,
    chain_of,
    is_seen,
)
from dynsolve.notation.build import total
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Negative,
    Node,
    Number,
    Parenthesized,
    Sum,
    Symbol,
    mapped,
    names_in,
    walk,
)
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem.model import Problem
from dynsolve.problem.table import NotLinear, linear_rates
from dynsolve.robot.model import Convention, Coordinate, JointType, Robot

COLUMNS = ("theta", "d", "a", "alpha")
ANGLES = (0, 3)
LETTERS = ("θ", "d", "a", "α")
_AS_RADIANS = 0.01
"""So near to a multiple of 15° in radians a bare number stands for that."""


class TableError(Exception):
    """A table that describes no chain of joints; `row` and `column` (from 1) say where, 0 where nowhere."""

    def __init__(self, message: str, row: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.message, self.row, self.column = message, row, column


class TableRow(Struct, frozen=True):
    """A row of a table: the constant parts of θ, d, a, α as trees.

    `variable` is the place of the column that holds the joint variable (0 for θ, 1 for d), None for a
    fixed frame; `rates` are (index of the coordinate from 0, rate).
    """

    constants: tuple[Node, ...]
    variable: int | None = None
    rates: tuple[tuple[int, Fraction], ...] = ()

    def changed(self, column: int, constant: Node) -> TableRow:
        """The row with another constant part in a column (from 0)."""
        constants = list(self.constants)
        constants[column] = constant
        return replace(self, constants=tuple(constants))

    def numbers(self, values: Mapping[str, float]) -> NumberRow:
        """The row at values of the letters."""
        theta, d, a, alpha = (float(evaluate(cell, values)) for cell in self.constants)
        variable = None if self.variable is None else COLUMNS[self.variable]
        return NumberRow(theta, d, a, alpha, variable, tuple((k, float(rate)) for k, rate in self.rates))


Table = tuple[TableRow, ...]


def key_table(robot: Robot) -> Table:
    """The robot's own table."""
    names = [q.name for q in robot.coordinates]
    return tuple(
        TableRow(
            tuple(_without(cell, names) for cell in joint.written),
            None if joint.variable is None else COLUMNS.index(joint.variable),
            joint.rates,
        )
        for joint in robot.joints
    )


def read_table(rows: Sequence[Sequence[Node]], coordinates: Sequence[Coordinate]) -> Table:
    """The table of an answer.

    Raises TableError for a row that has not four columns, for a joint variable where none can be.
    """
    numbered = [Number(i) for i in range(1, len(rows) + 1)]
    if all(len(row) == 5 for row in rows) and [row[0] for row in rows] == numbered:
        rows = [row[1:] for row in rows]
    return tuple(_read_row(i, row, coordinates) for i, row in enumerate(rows, 1))


def _read_row(index: int, cells: Sequence[Node], coordinates: Sequence[Coordinate]) -> TableRow:
    if len(cells) != len(COLUMNS):
        raise TableError(f"row {index} has {len(cells)} columns; they are θ, d, a, α", index)
    names = [q.name for q in coordinates]
    moving = [column for column, cell in enumerate(cells) if names_in(cell) & set(names)]
    for column in moving:
        _check_place(index, column, cells[column], coordinates)
    if len(moving) > 1:
        raise TableError(f"row {index} has a joint variable in θ and in d: these are two joints", index, 2)
    constants = [_constant(i, cell, names) for i, cell in enumerate(cells)]
    if not moving:
        return TableRow(tuple(constants))
    (column,) = moving
    try:
        rates = linear_rates(cells[column], names)
    except NotLinear as error:
        raise TableError(f"row {index}, {LETTERS[column]}: {error.message}", index, column + 1) from error
    order = tuple(sorted((names.index(name), rate) for name, rate in rates.items()))
    return TableRow(tuple(constants), column, order)


def _check_place(index: int, column: int, cell: Node, coordinates: Sequence[Coordinate]) -> None:
    """Raise TableError for an angle in a column of lengths, or the other way round, or a constant column."""
    for q in coordinates:
        if q.name not in names_in(cell):
            continue
        turns = q.type is JointType.REVOLUTE
        if column != (0 if turns else 1):
            what = "turns, and belongs to θ" if turns else "slides, and belongs to d"
            raise TableError(
                f"row {index}: {q.name} {what}; here it stands in {LETTERS[column]}", index, column + 1
            )


def _constant(column: int, cell: Node, names: Sequence[str]) -> Node:
    constant = _without(cell, names)
    if column not in ANGLES:
        return constant
    terms = constant.terms if isinstance(constant, Sum) else (constant,)
    return total([_angle(term) for term in terms])


def _angle(term: Node) -> Node:
    """A term of an angle; a bare number counts degrees, or is a multiple of 15° in radians."""
    value = rational_value(term)
    if not value:
        return term
    steps = float(value) * 12 / pi
    if abs(value) < 10 and steps and abs(steps - round(steps)) < _AS_RADIANS * 12 / pi and round(steps):
        value = Fraction(15 * round(steps))
    degrees = Degrees(abs(value).numerator, value.denominator)
    return Negative(degrees) if value < 0 else degrees


def _without(cell: Node, names: Sequence[str]) -> Node:
    """A cell without its joint variable: the variable 0 where it is, and no term of 0 left."""
    found = mapped(cell, lambda node: ZERO if isinstance(node, Symbol) and node.name in names else node)
    while isinstance(found, Parenthesized):
        found = found.argument
    terms = found.terms if isinstance(found, Sum) else (found,)
    kept = [term for term in terms if rational_value(term) != 0]
    return total(kept) if kept else Number(0)


# A student's table against the key's, by the mechanism

TOLERANCE = 1e-9
ROUNDED = 2e-3
"""How far a table may be off that holds decimals."""
NO_VALUE = (ArithmeticError, ValueError, KeyError, TypeError)
"""What a cell raises that has no value: a root of -1, a name that the problem does not have."""

_DRAWS = 3
_TRIES = 200


class OwnCoordinate(Struct, frozen=True):
    """A student's coordinate in the key's: q' = sense·q + offset, the same at every draw or None.

    The offset is in degrees for an angle, a number for a length; `shifts` are those at each draw of
    the letters, in radians.
    """

    name: str
    sense: int
    offset: float | None
    is_length: bool = False
    shifts: tuple[float, ...] = ()

    @property
    def is_the_keys(self) -> bool:
        """Whether it is the key's own."""
        return self.sense == 1 and self.offset == 0


class Agreement(Struct, frozen=True):
    """A table that is the key's mechanism: how it counts the coordinates, how it lies on the key's.

    `others` are further ways in which it does: frame 0 turned by 90° and joint 1 counted from 90° on
    are one table.
    """

    coordinates: tuple[OwnCoordinate, ...]
    matches: tuple[Match, ...]
    is_rounded: bool = False
    others: tuple[Agreement, ...] = ()

    @property
    def is_strict(self) -> bool:
        """Whether every coordinate is the key's own."""
        return all(q.is_the_keys for q in self.coordinates)


class TableComparer:
    """Compares tables with a problem's; `read_as` is their convention where that is another."""

    def __init__(self, problem: Problem, read_as: Convention | None = None) -> None:
        self.robot = problem.robot
        self.key = key_table(problem.robot)
        self.modified = (read_as or problem.robot.convention) is Convention.MODIFIED
        normals = problem.normals
        self.base_is_free = normals is not None and not normals.drawing.axes[0].is_placed
        self.letters = tuple(_draws(problem, self.key))
        keys_are_modified = problem.robot.convention is Convention.MODIFIED
        self._keys = tuple(_chain(self.key, letters, keys_are_modified) for letters in self.letters)
        self.joints = self._keys[0].joints

    def chain(self, table: Table, letters: Mapping[str, float]) -> Chain:
        """The chain of a student's table at values of the letters."""
        return _chain(table, letters, self.modified)

    def __call__(self, table: Table) -> Agreement | Mismatch:
        """Whether a table describes the same mechanism, or where it parts from it.

        Raises TableError where its joint variables are not those of the robot.
        """
        self._check_joints(table)
        tolerance = ROUNDED if _holds_decimals(table) else TOLERANCE
        ways: list[tuple[Match, ...]] = []
        for letters, key in zip(self.letters, self._keys, strict=True):
            try:
                student = self.chain(table, letters)
            except NO_VALUE:
                return Mismatch(0, "place")
            found = Matching(key, student, self.base_is_free, tolerance).found()
            if isinstance(found, Mismatch):
                return found
            ways.append(found)
        agreements = list(self._agreements(table, ways))
        if not agreements:
            return Mismatch(len(self.joints), "place")
        exact = tolerance == TOLERANCE or self._is_exact(table)
        return replace(agreements[0], is_rounded=not exact, others=tuple(agreements[1:]))

    def _agreements(self, table: Table, ways: Sequence[Sequence[Match]]) -> Iterator[Agreement]:
        """Every way in which the chains lie on each other alike at all draws of the letters.

        z_0 is turned over only where the way with the fewest changes has it so.
        """
        seen: list[Match] = []
        for first in ways[0]:
            if first.is_turned_over != ways[0][0].is_turned_over:
                continue
            found = [next((m for m in draw if m.lies_like(first)), None) for draw in ways]
            matches = [match for match in found if match is not None]
            if len(matches) < len(ways) or any(map(first.lies_like, seen)):
                continue
            seen.append(first)
            readings = [matches]
            if self._may_be_unturned and any(is_seen(match.turn, turns=True) for match in matches):
                readings.append([match.unturned() for match in matches])
            for reading in readings:
                coordinates = self._coordinates(table, reading)
                if coordinates is not None:
                    yield Agreement(coordinates, tuple(reading))

    @property
    def _may_be_unturned(self) -> bool:
        """Whether a turn of frame 0 about its z is one of the first joint."""
        first = self.joints[0]
        return first.turns and abs(abs(first.direction[2]) - 1) < TOLERANCE

    def agrees(self, table: Table) -> int | None:
        """How many coordinates a right table counts otherwise than the key; None of a wrong one."""
        found = self(table)
        if isinstance(found, Mismatch):
            return None
        return sum(not q.is_the_keys for q in found.coordinates)

    def is_one_of(self, table: Table, accepted: Sequence[Sequence[Sequence[Node]]]) -> bool:
        """Whether a table is one of those that count as they stand, cell by cell."""
        return any(self._is_same(table, read_table(other, self.robot.coordinates)) for other in accepted)

    def is_the_keys(self, table: Table) -> bool:
        """Whether a table is the key's own, cell by cell."""
        return len(table) == len(self.key) and self._is_same(table, self.key)

    def _is_same(self, table: Table, other: Table) -> bool:
        if [(row.variable, row.rates) for row in table] != [(row.variable, row.rates) for row in other]:
            return False
        rows = list(zip(table, other, strict=True))
        try:
            return all(_near(a.numbers(v), b.numbers(v)) for v in self.letters for a, b in rows)
        except NO_VALUE:
            return False

    def _is_exact(self, table: Table) -> bool:
        student = self.chain(table, self.letters[0])
        return isinstance(Matching(self._keys[0], student, self.base_is_free, TOLERANCE).found(), tuple)

    def _check_joints(self, table: Table) -> None:
        moving = [(i, row) for i, row in enumerate(table, 1) if row.variable is not None]
        keys = [row for row in self.key if row.variable is not None]
        if len(moving) != len(keys):
            raise TableError(f"the table has {len(moving)} joint variables, and the robot {len(keys)} joints")
        names = [q.name for q in self.robot.coordinates]
        for (i, mine), theirs in zip(moving, keys, strict=True):
            if [k for k, _ in mine.rates] != [k for k, _ in theirs.rates] or not _proportional(mine, theirs):
                here, there = (" and ".join(names[k] for k, _ in row.rates) for row in (mine, theirs))
                column = (mine.variable or 0) + 1
                raise TableError(
                    f"row {i} moves with {here}, where the robot's joint moves with {there}", i, column
                )

    def _coordinates(self, table: Table, matches: Sequence[Match]) -> tuple[OwnCoordinate, ...] | None:
        """How the student counts the coordinates; none where it mixes them, None where no count is possible.

        With R q the key's joint variables, and R' q' the student's, R' q' = S R q + o at every q.
        """
        import numpy as np

        robot = self.robot
        theirs, mine = (
            np.array([_rates(row, robot.n) for row in rows if row.variable is not None])
            for rows in (self.key, table)
        )
        senses = np.diag(matches[0].senses)
        ways = np.linalg.lstsq(mine, senses @ theirs, rcond=None)[0]
        shifts = [np.linalg.lstsq(mine, np.array(match.offsets), rcond=None)[0] for match in matches]
        turns = [row.variable == 0 for row in table if row.variable is not None]
        for match, shift in zip(matches, shifts, strict=True):
            left = mine @ shift - np.array(match.offsets)
            if any(is_seen(value, turn) for value, turn in zip(left, turns, strict=True)):
                return None
        if np.abs(mine @ ways - senses @ theirs).max(initial=0) > TOLERANCE:
            return None
        if np.abs(np.abs(ways) - np.eye(robot.n)).max(initial=0) > TOLERANCE:
            return ()
        return tuple(
            self._counted(k, round(ways[k][k]), tuple(float(shift[k]) for shift in shifts))
            for k in range(robot.n)
        )

    def _counted(self, k: int, sense: int, shifts: tuple[float, ...]) -> OwnCoordinate:
        q = self.robot.coordinates[k]
        offsets = {self._offset(shift, q.type) for shift in shifts}
        offset = offsets.pop() if len(offsets) == 1 else None
        return OwnCoordinate(q.name, sense, offset, q.type is JointType.PRISMATIC, shifts)

    @staticmethod
    def _offset(value: float, kind: JointType) -> float:
        """An offset, of an angle in degrees in (-180, 180], rounded."""
        if kind is JointType.REVOLUTE:
            value = -((-degrees(value) + 180) % 360 - 180)
            return 180.0 if round(value, 6) == -180 else round(value, 6) + 0.0
        return round(value, 8) + 0.0


def _chain(table: Table, letters: Mapping[str, float], modified: bool) -> Chain:
    return chain_of((row.numbers(letters) for row in table), modified)


def _near(mine: NumberRow, theirs: NumberRow) -> bool:
    angles = ((mine.theta, theirs.theta), (mine.alpha, theirs.alpha))
    turned = max(abs(remainder(a - b, 2 * pi)) for a, b in angles)
    return max(turned, abs(mine.d - theirs.d), abs(mine.a - theirs.a)) < TOLERANCE


def _rates(row: TableRow, n: int) -> list[float]:
    found = dict(row.rates)
    return [float(found.get(k, 0)) for k in range(n)]


def _proportional(mine: TableRow, theirs: TableRow) -> bool:
    ratios = {a / b for (_, a), (_, b) in zip(mine.rates, theirs.rates, strict=True)}
    return ratios <= {Fraction(1)} or ratios <= {Fraction(-1)}


def _draws(problem: Problem, key: Table) -> Iterator[dict[str, float]]:
    """Values of the letters at which the key has one: rising, falling, and as they are drawn."""
    names = (*problem.robot.ring.parameters, *sorted(names_in(*(c for row in key for c in row.constants))))
    names, found = tuple(dict.fromkeys(names)), 0
    for sample in islice(numbered(), _TRIES):
        drawn = [sample.positive() for _ in names]
        values = (sorted(drawn), sorted(drawn, reverse=True), drawn)[sample.k % 3]
        letters = dict(zip(names, values, strict=True)) | {"pi": pi}
        try:
            for row in key:
                row.numbers(letters)
        except (ArithmeticError, ValueError):
            continue
        yield letters
        found += 1
        if found == _DRAWS:
            return


def _holds_decimals(table: Table) -> bool:
    cells = (cell for row in table for cell in row.constants)
    return any(isinstance(node, Number) and node.q >= 100 for node in walk(*cells))
