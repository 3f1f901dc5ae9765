"""A problem: a robot, its exercise, and the place of each part in the file.

A whole problem file as it was read, before anything is computed.

What else counts as an answer DH: `also` and `strict` in a problem file.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import lru_cache
from pathlib import PurePath
from re import compile as pattern
from typing import TYPE_CHECKING

from msgspec import Struct, field

from dynsolve.algebra.angles import Angle
from dynsolve.errors import Finding
from dynsolve.notation.tree import Node
from dynsolve.problem.base import ParsedBase, ParsedRotation
from dynsolve.problem.bodies import is_point
from dynsolve.problem.cells import Cell
from dynsolve.problem.decoder import Record, Stated
from dynsolve.problem.kinds import Fields, describe, items, word
from dynsolve.problem.specification import MAX_ROWS, PROBLEM, STRICT
from dynsolve.problem.table import COLUMNS, DHTable, read_listed_row
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, YamlNode
from dynsolve.quantities.owners import Owners
from dynsolve.quantities.stages import ASKED_FOR
from dynsolve.robot.model import Convention, Coordinate, JointType, Robot

if TYPE_CHECKING:
    from dynsolve.problem.acting import Acting
    from dynsolve.problem.exercise import Remark, Wording
    from dynsolve.problem.mechanism import Candidates, Model
    from dynsolve.problem.questions import ParsedQuestions
    from dynsolve.robot.drawing.normals import Normals


# What else counts as an answer DH: `also` and `strict` in a problem file

Table = tuple[tuple[Node, ...], ...]
"""Rows of θ, d, a, α as they are written."""

_MOST_TABLES = 20
_HELP = PROBLEM["also"].help


class AcceptedTables(Struct, frozen=True):
    """Further tables that count as they stand, and whether coordinates must be counted as the key does."""

    also: tuple[Table, ...] = ()
    strict: bool = False


def read_accepted_tables(faults: Faults, fields: Fields) -> AcceptedTables:
    """What `also` and `strict` say; everything wrong with them is reported."""
    strict = word(faults, fields.get("strict"), STRICT.choices, "strict", PROBLEM["strict"].help)
    nodes = items(faults, fields.get("also"), "also", _HELP)
    if len(nodes) > _MOST_TABLES:
        faults.error(fields.key_span("also"), f"{len(nodes)} tables; at most {_MOST_TABLES} are read", _HELP)
    tables = [_read_table(faults, node, i) for i, node in enumerate(nodes[:_MOST_TABLES], 1)]
    return AcceptedTables(tuple(table for table in tables if table), strict == "true")


def _read_table(faults: Faults, node: YamlNode, number: int) -> Table | None:
    rows = items(faults, node, f"table {number} of also", _HELP)
    if len(rows) > MAX_ROWS:
        faults.error(node.span, f"{len(rows)} rows; at most {MAX_ROWS} are read", _HELP)
    read = [_read_row(faults, row, i) for i, row in enumerate(rows[:MAX_ROWS], 1)]
    return tuple(row for row in read if row) if read and None not in read else None


def _read_row(faults: Faults, node: YamlNode, index: int) -> tuple[Node, ...] | None:
    if isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ListNode):
        message = f"row {index} of this table is [θ, d, a, α], not {describe(node)}"
        faults.error(node.span, message, _HELP)
        return None
    cells = read_listed_row(faults, node, index)
    return tuple(cell.tree for cell in cells.values()) if len(cells) == len(COLUMNS) else None


Path = tuple[str | int, ...]
"""The way to a part of a file: ("masses", 0, "axes"), list items from 0."""

_WORDS = (("title",), ("source",), ("remarks",), ("text",))
"""The parts of a file that are words, whatever numbers stand in them."""

FIND = ("tau", "D", "C", "g")
"""What an exercise asks for unless it says otherwise."""


class FilePlace(Struct, frozen=True):
    """Where a part of a file stands; line and column from 1."""

    line: int
    column: int
    length: int
    excerpt: str


_DECIMAL = pattern(r"(?<![\w.])\d*\.\d+(?![\w.])")


@lru_cache(maxsize=256)
def _stem(file: str) -> str:
    return PurePath(file).stem


class Problem(Struct, frozen=True):
    """One problem file, read and checked.

    `find` and the keys of `marks` are names of answers in their canonical form
    (`D`, never `M`).  `values` are the numbers for numeric results, angles in radians;
    `written` are the same as they stand in the file, which is exact.
    `accepted` is what else counts as a Denavit-Hartenberg table that is handed in.
    `remarks` are its author's words on results, `text` those of an exercise sheet.
    `edition` is that of Spong, Hutchinson, Vidyasagar by which sections are counted.
    `normals` are those of a drawing, where the file has one in the place of a table.
    `places` tells where each part of the file stands; `warnings` are what deserves
    a look and is no error.
    """

    title: str
    source: str
    file: str
    robot: Robot
    convention: Convention
    find: tuple[str, ...] = FIND
    marks: Mapping[str, Fraction] = field(default_factory=dict)
    values: Mapping[str, Fraction] = field(default_factory=dict)
    written: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    remarks: tuple[Remark, ...] = ()
    text: Wording | None = None
    edition: int = 1
    normals: Normals | None = None
    accepted: AcceptedTables = field(default_factory=AcceptedTables)
    places: Mapping[Path, FilePlace] = field(default_factory=dict)
    warnings: tuple[Finding, ...] = ()

    @property
    def stem(self) -> str:
        """The name of its file without folder and ending: what an answer file calls it."""
        return _stem(self.file)

    @property
    def decimals(self) -> frozenset[Fraction]:
        """The decimals that stand in the file, which are exact wherever an answer uses them."""
        lines = {place.excerpt for path, place in self.places.items() if path[:1] not in _WORDS}
        texts = (text for line in lines for text in _DECIMAL.findall(line.partition(" #")[0]))
        return frozenset(Fraction(text) for text in texts) | frozenset(self.values.values())

    def finding(self, path: Path, message: str, help: str = "", code: str = "") -> Finding:
        """A finding at a part of the file, or at the nearest part around it that has a place."""
        while path and path not in self.places:
            path = path[:-1]
        if not path:
            return Finding(message, help, self.file, code=code)
        place = self.places[path]
        return Finding(message, help, self.file, place.line, place.column, place.length, place.excerpt, code)


# A whole problem file as it was read, before anything is computed


class ParsedFile(Struct, frozen=True):
    """The parts of a problem file that make a robot."""

    convention: Convention
    table: DHTable
    gravity: tuple[Cell, ...] | None
    base: ParsedBase
    bodies: tuple[Record, ...]
    questions: ParsedQuestions
    normals: Normals | None = None
    """Of a drawing, the normals that its table was made from."""
    acting: Acting | None = None
    model: Model | None = None
    """In the place of a table and its bodies: a mechanism by positions, or given energies."""
    stated: tuple[Stated, ...] = ()
    """The expressions of the bodies, the model and the candidates."""
    candidates: Candidates | None = None
    """Matrices to be judged, alone or beside a model, and what is assumed of their parameters."""

    @property
    def has_matrices(self) -> bool:
        """Whether there are matrices to be judged: candidates, or the D of a model."""
        if self.candidates is None:
            return False
        return bool(self.candidates.matrices) or (self.model is not None and self.model.D is not None)

    @property
    def is_of_matrices(self) -> bool:
        """Whether matrices stand in the place of a robot."""
        return self.candidates is not None and self.model is None and not self.table.rows

    @property
    def sound(self) -> bool:
        """Whether nothing of the table, its bodies or the model was reported."""
        if self.candidates is not None and self.candidates.faulty:
            return False
        if self.model is not None or self.is_of_matrices:
            return self.model is None or not self.model.faulty
        return self.table.sound and not any(body.faulty for body in self.bodies)

    @property
    def coordinates(self) -> tuple[Coordinate, ...]:
        """The generalized coordinates in their order."""
        return tuple(
            Coordinate(name, JointType(kind), index)
            for index, (name, kind) in enumerate(self.table.coordinates, 1)
        )

    @property
    def owners(self) -> Owners:
        """What the answers to this problem can belong to, whatever of it is asked for."""
        bodies = self.model.bodies if self.model else self.bodies
        return Owners(
            rows=len(self.table.rows),
            coordinates=self.coordinates,
            bodies=tuple(body["name"] for body in bodies),
            points=frozenset(body["name"] for body in bodies if is_point(body)),
            named=self.questions.names,
            stages=frozenset(ASKED_FOR),
            constraints=self.questions.constraints,
            given=self.questions.needed
            | frozenset(
                name
                for name, there in (
                    ("mass", self.bodies or self.model),
                    ("function", self.questions.task is None or not self.questions.task.is_twist),
                    ("references", True),
                )
                if there
            ),
            actions=self.acting.terms if self.acting else frozenset(),
            has_matrices=self.has_matrices,
            has_robot=not self.is_of_matrices,
        )

    @property
    def decoded(self) -> tuple[Stated, ...]:
        """What acts, as it was decoded."""
        return self.acting.stated if self.acting else ()

    @property
    def rotations(self) -> Iterator[ParsedRotation]:
        """The rotations that are given, but for those of bodies."""
        if self.base.rotation:
            yield self.base.rotation
        yield from self.questions.rotations

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that may hold coordinates: d, and rotations given from the base."""
        yield from (row.cells["d"] for row in self.table.rows if not row.faulty)
        yield from (one.cell for one in self.stated if one.moves)
        yield from self.questions.moving
        yield from (one.cell for one in self.decoded if one.moves)

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        yield from (row.cells["a"] for row in self.table.rows if not row.faulty)
        yield from (one.cell for one in self.stated if one.moves is False)
        yield from self.gravity or ()
        yield from self.base.move or ()
        if self.base.rotation:
            yield from self.base.rotation.entries
        yield from self.questions.constant
        yield from (one.cell for one in self.decoded if one.moves is False)

    @property
    def angles(self) -> Iterator[tuple[Cell, Angle]]:
        """Every angle that is turned by, with the cell it stands in."""
        for row in self.table.rows:
            if not row.faulty:
                yield from ((row.cells[column], angle) for column, angle in row.angles.items())
        turns = self.base.rotation.turns if self.base.rotation else ()
        yield from ((turn.cell, turn.angle) for turn in turns)
        yield from ((one.cell, one.angle) for one in self.stated if one.angle is not None)
        yield from ((turn.cell, turn.angle) for given in self.questions.rotations for turn in given.turns)

    @property
    def cells(self) -> Iterator[Cell]:
        """Every cell that was read."""
        for row in self.table.rows:
            yield from row.cells.values()
        for rotation in self.rotations:
            yield from rotation.cells
        yield from (one.cell for one in self.stated)
        yield from self.gravity or ()
        yield from self.base.move or ()
        yield from self.questions.constant
        yield from self.questions.moving
        yield from (one.cell for one in self.decoded)
