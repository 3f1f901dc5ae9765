"""A human's marks in bulk: a CSV with the columns student, problem, answer, marks, comment.

`queue.csv` of OUT is such a page, with what waits for a human; rows that are not filled in are
left out, and further columns are not read.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from dynsolve.errors import Finding, InputError
from dynsolve.grading.files import safe

COLUMNS = ("student", "problem", "answer", "marks", "comment")


@dataclass(frozen=True, slots=True)
class ByHand:
    """Marks, a comment or both for one answer; `line` is where they stand."""

    student: str
    problem: str
    answer: str
    marks: str
    comment: str
    line: int


def read_by_hand(path: Path) -> Iterator[ByHand]:
    """The rows of a CSV that say something; raises InputError where it is none."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise InputError([Finding(f"cannot be read: {reason}", "give a CSV in UTF-8", str(path))]) from None
    first = text.partition("\n")[0]
    rows = csv.DictReader(io.StringIO(text, newline=""), delimiter=max(",;\t", key=first.count))
    rows.fieldnames = [name.strip().casefold() for name in rows.fieldnames or ()]
    if not set(COLUMNS) <= set(rows.fieldnames):
        message = f"the first line is `{first[:60].strip()}`, not the names of the columns"
        raise InputError([Finding(message, f"write {','.join(COLUMNS)}", str(path), 1, 1)])
    for row in rows:
        student, problem, answer, marks, comment = (_plain(row.get(name) or "") for name in COLUMNS)
        if marks or comment:
            yield ByHand(student, problem, answer, marks, comment, rows.line_num)


def _plain(cell: str) -> str:
    """A cell without the apostrophe that keeps a spreadsheet from running it."""
    cell = cell.strip()
    return cell[1:] if cell[:1] == "'" and safe(cell[1:]) == cell else cell
