"""How the files of OUT are written: their names, whole or not at all, and CSV.

The CSV files open in a spreadsheet without running anything.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from hashlib import sha256
from html import escape
from pathlib import Path

from dynsolve.answers.marks import shown
from dynsolve.render.files import temporary_of, write_changed
from dynsolve.render.prose import visible


def write(path: Path, text: str, *, durable: bool = True) -> None:
    """Write a text atomically, and only where it differs from what is there."""
    write_changed(path, text.encode("utf-8", errors="replace"), durable=durable)


def folder_name(student: str) -> str:
    """The name of a student's folder: safe on every system, and of no two students the same.

    >>> folder_name("s123456"), folder_name("Ada Lovelace_12")
    ('s123456', 'Ada Lovelace_12')
    """
    plain = re.sub(r"[^\w .@+-]|^\.+|[. ]+$", "_", student)[:80]
    reserved = re.fullmatch(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\..*)?", plain)
    if plain == student and plain and not reserved:
        return plain
    return f"{plain or '_'}-{sha256(student.encode('utf-8', errors='replace')).hexdigest()[:8]}"


def remove_others(folder: Path, kept: set[Path], endings: tuple[str, ...]) -> None:
    """Remove the files of students who are no longer there, and temporary files of a killed run."""
    own = (*endings, temporary_of(folder).suffix)
    for path in sorted(folder.glob("*/*")):
        if path not in kept and path.suffix in own:
            path.unlink()
    for place in sorted(folder.glob("*/")):
        if place.is_dir() and not any(place.iterdir()):
            place.rmdir()


def text(of_student: object) -> str:
    """Text that a student may have written, in HTML."""
    return escape(visible(str(of_student)))


def called(student: str, names: Mapping[str, str]) -> str:
    """A student with the name that people use, where that is another."""
    name = names.get(student, "")
    return f"{name} ({student})" if name and name not in student else student


# -- CSV ---------------------------------------------------------------------------------------------

_RUNS = ("=", "+", "-", "@", "\t", "\r", "\n", "|", "%")


def safe(cell: str) -> str:
    """A cell that no spreadsheet takes for a formula: an apostrophe before what would begin one.

    >>> safe("=1+1"), safe("-m1*g"), safe("K"), safe(" @x"), safe("-2.5")
    ("'=1+1", "'-m1*g", 'K', "' @x", '-2.5')
    """
    if cell == "-":
        return cell
    begun = cell.lstrip(" \u00a0\u3000\u200b\ufeff")
    if begun.startswith(_RUNS) or begun[:1] in ("＝", "＋", "－", "＠"):  # the full-width ones run as well
        return cell if _is_number(cell) else f"'{cell}"
    return cell


def _is_number(cell: str) -> bool:
    digits = cell.removeprefix("-").replace(".", "", 1)
    return digits.isascii() and digits.isdigit()


def table(rows: Iterable[Sequence[str]], separator: str = ",", trusted: int | None = None) -> str:
    """Rows as CSV, every cell safe; in the column `trusted` a teacher's words stay as they are."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n", delimiter=separator)
    writer.writerows(
        [cell if place == trusted else safe(cell) for place, cell in enumerate(row)] for row in rows
    )
    return out.getvalue()


@lru_cache(maxsize=4096)
def decimal(marks: Fraction) -> str:
    """Marks in a cell: a number that every spreadsheet reads.

    >>> decimal(Fraction(5, 2)), decimal(Fraction(1, 3))
    ('2.5', '0.3333')
    """
    exact = shown(marks)
    return f"{float(marks):.4f}" if "/" in exact else exact
