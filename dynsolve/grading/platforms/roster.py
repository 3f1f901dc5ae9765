"""The table of students that a platform exports, and writing one like it."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Sequence
from fractions import Fraction
from pathlib import Path

from msgspec import Struct

from dynsolve.errors import Finding, InputError
from dynsolve.grading.cohort import Standing
from dynsolve.grading.files import decimal, table
from dynsolve.render.files import write_changed

SEPARATORS = (",", ";", "\t")
MOST_NAMED = 5

Cells = tuple[str, ...]


class Roster(Struct, frozen=True):
    """The rows of a CSV, the header first, and how it was written.

    `mark` tells whether it began with a byte order mark, `comma` whether its numbers
    have a decimal comma.
    """

    file: str
    rows: tuple[Cells, ...]
    separator: str = ","
    mark: bool = False
    comma: bool = False

    @property
    def header(self) -> Cells:
        """The names of the columns, nothing where there are none."""
        return self.rows[0] if self.rows else ()

    def write(self, path: Path, rows: Iterable[Cells], trusted: int | None = None) -> None:
        """Write rows as this CSV is written, every cell safe but those of the column `trusted`."""
        text = ("\ufeff" if self.mark else "") + table(rows, self.separator, trusted)
        write_changed(path, text.encode("utf-8", errors="replace"))

    def marks(self, marks: Fraction) -> str:
        """Marks as this CSV writes numbers."""
        text = decimal(marks)
        return text.replace(".", ",") if self.comma else text

    def fault(self, message: str, help: str) -> InputError:
        """What is wrong with the file, at its first line."""
        return InputError([Finding(message, help, self.file, 1, 1)])


def read_roster(path: Path) -> Roster:
    """The CSV of a path: its encoding, separator and numbers are found out.

    Raises InputError where it cannot be read.
    """
    try:
        data = path.read_bytes()
        wide = data.startswith((b"\xff\xfe", b"\xfe\xff"))
        text = data.decode("utf-16" if wide else "utf-8-sig")
        first = text.partition("\n")[0]
        separator = max(SEPARATORS, key=first.count)
        rows = _rows(text, separator)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        message = f"the roster cannot be read: {reason.lower()}"
        raise InputError([Finding(message, "export it as CSV, in UTF-8", str(path))]) from None
    numbers = [cell for row in rows for cell in row if _is_decimal(cell)]
    comma = any("," in cell for cell in numbers) and not any("." in cell for cell in numbers)
    return Roster(str(path), rows, separator, wide or data.startswith(b"\xef\xbb\xbf"), comma)


def _rows(text: str, separator: str) -> tuple[Cells, ...]:
    before = csv.field_size_limit(len(text) + 1)  # a text that a student typed online may be long
    try:
        lines = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
        return tuple(tuple(row) for row in lines if any(row))
    finally:
        csv.field_size_limit(before)


def _is_decimal(cell: str) -> bool:
    whole, _, rest = cell.strip().replace(",", ".").partition(".")
    return whole.isdigit() and rest.isdigit()


def to_text(roster: Roster) -> str:
    """A roster as the record keeps it."""
    fields = (roster.file, roster.rows, roster.separator, roster.mark, roster.comma)
    return json.dumps(fields, ensure_ascii=False)


def from_text(text: str) -> Roster:
    """The roster that `to_text` wrote.

    >>> from_text(to_text(Roster("a.csv", (("Student", "ID"),)))).header
    ('Student', 'ID')
    """
    file, rows, *rest = json.loads(text)
    return Roster(file, tuple(tuple(row) for row in rows), *rest)


def number(text: str) -> Fraction | None:
    """A number with a point or a comma, None for anything else.

    >>> number("6,50"), number(" 6.00 "), number("-")
    (Fraction(13, 2), Fraction(6, 1), None)
    """
    try:
        return Fraction(text.strip().replace(",", "."))
    except (ValueError, ZeroDivisionError):
        return None


def unmatched(standings: Iterable[Standing], seen: set[str], without: list[str], roster: Roster) -> list[str]:
    """Warnings on who is only in the hand-ins, or only in the roster."""
    lost = [standing.student for standing in standings if standing.student not in seen]
    found = []
    if lost:
        found.append(
            f"{_count(lost)} {'is' if len(lost) == 1 else 'are'} not in {roster.file}: {named(lost)}"
        )
    if without:
        nothing = "handed in nothing, and what stands there is kept"
        found.append(f"{_count(without)} of {roster.file} {nothing}: {named(without)}")
    return found


def not_judged(standings: Iterable[Standing]) -> list[str]:
    """A warning on whose hand-ins wait for a human: they get no marks before."""
    waiting = [
        f"{standing.student} ({', '.join(standing.unjudged)})" for standing in standings if standing.unjudged
    ]
    wait = "waits for a human and keeps" if len(waiting) == 1 else "wait for a human and keep"
    return [f"{_count(waiting)} {wait} what stands there: {named(waiting)}"] if waiting else []


def _count(students: list[str]) -> str:
    return "1 student" if len(students) == 1 else f"{len(students)} students"


def named(students: Sequence[str]) -> str:
    """The first of some students, and whether there are others."""
    return "; ".join(students[:MOST_NAMED]) + (" and others" if len(students) > MOST_NAMED else "")
