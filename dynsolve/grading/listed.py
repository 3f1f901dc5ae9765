"""The lists that a teacher lays beside the `set.yaml`: CSV with the names of its columns first."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Collection, Iterator
from pathlib import Path
from typing import TypeVar

from dynsolve.errors import Finding, ProblemError

Fault = tuple[str, str]
"""What is wrong with a row, and what to do."""

Entry = TypeVar("Entry")


def read_list(
    path: Path,
    columns: tuple[str, ...],
    needed: Collection[str],
    read: Callable[[dict[str, str]], Entry | Fault],
) -> tuple[Entry, ...]:
    """What `read` makes of each row of a file, nothing where there is no such file.

    The separator is a comma, a semicolon or a tab.  Raises ProblemError with every faulty row.
    """
    if not path.is_file():
        return ()
    found: list[Entry] = []
    findings: list[Finding] = []
    for line, cells in _rows(path, columns, needed):
        entry = read(cells)
        if isinstance(entry, tuple):
            findings.append(Finding(entry[0], entry[1], str(path), line, 1))
        else:
            found.append(entry)
    if findings:
        raise ProblemError(findings)
    return tuple(found)


def _rows(
    path: Path, columns: tuple[str, ...], needed: Collection[str]
) -> Iterator[tuple[int, dict[str, str]]]:
    """Each row with its line, its cells by their columns."""
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    first = text.partition("\n")[0]
    rows = csv.DictReader(io.StringIO(text, newline=""), delimiter=max(",;\t", key=first.count))
    header = [name.strip().casefold() for name in rows.fieldnames or ()]
    if not set(needed) <= set(header) or not set(header) <= set(columns):
        message = f"the first line is `{first[:60].strip()}`, not the names of the columns"
        raise ProblemError([Finding(message, f"write {','.join(columns)}", str(path), 1, 1)])
    rows.fieldnames = header
    for row in rows:
        yield rows.line_num, {key: (row.get(key) or "").strip() for key in columns}
