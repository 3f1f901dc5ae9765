"""A problem: a robot, its exercise, and the place of each part in the file.

What else counts as an answer DH: `also` and `strict` in a problem file.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from pathlib import PurePath
from re import compile as pattern
from typing import TYPE_CHECKING

from msgspec import Struct, field

from dynsolve.errors import Finding
from dynsolve.notation.tree import Node
from dynsolve.problem.kinds import Fields, describe, items, word
from dynsolve.problem.specification import MAX_ROWS, PROBLEM, STRICT
from dynsolve.problem.table import COLUMNS, read_listed_row
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, YamlNode
from dynsolve.robot.model import Convention, Robot

if TYPE_CHECKING:
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


class Remark(Struct, frozen=True):
    """What an author says of a result: its name, as an answer and as the file has it, and the words."""

    name: str
    key: str
    texts: tuple[str, ...]


class Wording(Struct, frozen=True):
    """An author's words on a sheet: before what is given, in its place, and in the place of what is asked.

    Formulas stand between dollar signs, in the syntax of the file.
    """

    before: str = ""
    given: str = ""
    asked: Mapping[str, str] = field(default_factory=dict)


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
