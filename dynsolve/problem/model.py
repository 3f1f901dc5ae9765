"""A problem: a robot, its exercise, and the place of each part in the file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from pathlib import PurePath
from re import compile as pattern

from dynsolve.errors import Finding
from dynsolve.problem.accepted_tables import AcceptedTables
from dynsolve.problem.remarks import Remark
from dynsolve.robot.drawing.procedure import Normals
from dynsolve.robot.model import Convention, Robot

Path = tuple[str | int, ...]
"""The way to a part of a file: ("masses", 0, "axes"), list items from 0."""

_WORDS = (("title",), ("source",), ("remarks",))
"""The parts of a file that are words, whatever numbers stand in them."""

FIND = ("tau", "D", "C", "g")
"""What an exercise asks for unless it says otherwise."""


@dataclass(frozen=True, slots=True)
class FilePlace:
    """Where a part of a file stands; line and column from 1."""

    line: int
    column: int
    length: int
    excerpt: str


_DECIMAL = pattern(r"(?<![\w.])\d*\.\d+(?![\w.])")


@lru_cache(maxsize=256)
def _stem(file: str) -> str:
    return PurePath(file).stem


@dataclass(frozen=True, slots=True)
class Problem:
    """One problem file, read and checked.

    `find` and the keys of `marks` are names of answers in their canonical form
    (`D`, never `M`).  `values` are the numbers for numeric results, angles in radians;
    `written` are the same as they stand in the file, which is exact.
    `accepted` is what else counts as a Denavit-Hartenberg table that is handed in.
    `remarks` are its author's words on results.
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
