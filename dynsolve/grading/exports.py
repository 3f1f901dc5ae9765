"""The files that the learning platforms import, made from those that they hand out.

To add a platform, write its function and put it into `EXPORTS`.
"""

from __future__ import annotations

import csv
import io
import json
import re
import zipfile
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path

from dynsolve.errors import Finding, InputError, UsageError
from dynsolve.grading.ledger import Standing, most, standings
from dynsolve.grading.outputs import folder_name, write, write_bytes
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Record
from dynsolve.grading.tables import decimal, table

Rows = list[list[str]]
Warnings = list[str]

_CANVAS_OWN = (
    "Student", "ID", "SIS User ID", "SIS Login ID", "Integration ID", "Root Account", "Section",
)  # fmt: skip
_POINTS = "    Points Possible"


def export(
    platform: str, folder: Path, problems: ProblemSet, record: Record, roster: Path | None
) -> tuple[str, ...]:
    """Write the files that `platform` imports; gives what deserves a look.

    Raises UsageError where the platform's own export is needed, InputError where it is faulty.
    """
    return tuple(EXPORTS[platform](folder, problems, record, roster))


def read_roster(path: Path | None, platform: str) -> Rows:
    """The rows of a platform's CSV."""
    if path is None:
        raise UsageError(f"--lms {platform} needs --roster, the CSV that {platform.capitalize()} exports")
    try:
        text = path.read_bytes().decode("utf-8-sig")
        return [row for row in csv.reader(io.StringIO(text, newline="")) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        message = f"the roster cannot be read: {str(error).lower()}"
        raise InputError([Finding(message, "export it as CSV, in UTF-8", str(path))]) from None


# -- Canvas ------------------------------------------------------------------------------------------


def _canvas(folder: Path, problems: ProblemSet, record: Record, roster: Path | None) -> Iterator[str]:
    """`canvas.csv`: the gradebook with one assignment; who handed in nothing keeps what stands there."""
    rows = read_roster(roster, "canvas")
    header = rows[0]
    if "Student" not in header[0] or "ID" not in header[1:2]:
        raise InputError([Finding("this is no gradebook of Canvas", "Grades > Export", str(roster), 1, 1)])
    column = _assignment(header, problems.title)
    title = header[column] if column is not None else problems.title
    kept = [place for place, name in enumerate(header) if name in _CANVAS_OWN]
    of = sum(most(problems).values(), Fraction(0))
    by_id = _by_id(record)
    seen: set[str] = set()
    out: Rows = [[*(header[place] for place in kept), title]]
    points = next((row for row in rows[1:4] if row[0].strip() == "Points Possible"), None)
    out.append([*((_POINTS if place == 0 else "") for place in kept), decimal(of)])
    for row in rows[1:]:
        if row is points or row[0].strip() in ("Points Possible", "Manual Posting") or len(row) < len(kept):
            continue
        old = row[column] if column is not None and column < len(row) else ""
        found = _matching(
            by_id, [row[place] for place in kept if header[place] not in ("Student", "Section")]
        )
        if found is not None:
            seen.add(found.student)
        new = old if found is None or old == "EX" else decimal(found.total)
        out.append([*(row[place] for place in kept), new])
    write(folder / "canvas.csv", table(out))
    stands = points[column].strip() if points is not None and column is not None else ""
    if stands and _number(stands) != of:
        yield f"the assignment has {stands} points in Canvas, the problem set {decimal(of)}"
    yield from _unmatched(by_id, seen, roster)


def _assignment(header: list[str], title: str) -> int | None:
    """The assignment's column: by the title before the id in parentheses, or the exact title."""
    for place, name in enumerate(header):
        if name == title or re.sub(r" \(\d+\)$", "", name) == title:
            return place
    return None


def _by_id(record: Record) -> dict[str, Standing]:
    found = {}
    for standing in standings(record):
        found[standing.student] = standing
        if standing.id:
            found[standing.id] = standing
    return found


def _matching(by_id: dict[str, Standing], cells: list[str]) -> Standing | None:
    return next((by_id[cell] for cell in cells if cell and cell in by_id), None)


def _unmatched(by_id: dict[str, Standing], seen: set[str], roster: Path | None) -> Iterator[str]:
    for student in sorted({standing.student for standing in by_id.values()} - seen):
        yield f"{student} is not in {roster}"


def _number(text: str) -> Fraction | None:
    try:
        return Fraction(text.strip().replace(",", "."))
    except (ValueError, ZeroDivisionError):
        return None


# -- Moodle ------------------------------------------------------------------------------------------


def _moodle(folder: Path, problems: ProblemSet, record: Record, roster: Path | None) -> Iterator[str]:
    """`moodle.csv`, the worksheet with its grades, and `moodle-feedback.zip`."""
    rows = read_roster(roster, "moodle")
    header = rows[0]
    grade, comments = _moodle_columns(header, roster)
    of = sum(most(problems).values(), Fraction(0))
    by_id = _by_id(record)
    seen: set[str] = set()
    out: Rows = [header]
    for row in rows[1:]:
        number = re.search(r"(\d+)\s*$", row[0])
        found = by_id.get(number[1]) if number else None
        row = row + [""] * (len(header) - len(row))
        if found is not None:
            seen.add(found.student)
            row[grade] = decimal(found.total)
            row[comments] = _comment(found, problems)
            if len(out) == 1 and _number(row[grade + 1]) not in (None, of):
                yield f"the maximum grade in Moodle is {row[grade + 1]}, the problem set has {decimal(of)}"
        out.append(row)
    write(folder / "moodle.csv", table(out))
    write_bytes(folder / "moodle-feedback.zip", _feedback_zip(folder, record))
    yield from _unmatched(by_id, seen, roster)


def _moodle_columns(header: list[str], roster: Path | None) -> tuple[int, int]:
    """The columns of the grade and of the comments: by name, else by place (the header is translated)."""
    if len(header) >= 8:
        grade = header.index("Grade") if "Grade" in header else 4
        last = len(header) - 1
        return grade, header.index("Feedback comments") if "Feedback comments" in header else last
    message = "this is no grading worksheet of Moodle"
    raise InputError([Finding(message, "Download grading worksheet, in the assignment", str(roster), 1, 1)])


def _comment(standing: Standing, problems: ProblemSet) -> str:
    parts = [f"{stem}: {decimal(standing.marks.get(stem, Fraction(0)))}" for stem in problems.stems]
    return "; ".join(parts)


def _feedback_zip(folder: Path, record: Record) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for student, id in record.students().items():
            pages = sorted((folder / "feedback" / folder_name(student)).glob("*.html"))
            for page in pages if id else ():
                name = "feedback.html" if len(pages) == 1 else page.name
                safe = re.sub(r"[/\\:*?\"<>|]", "_", student)
                entry = zipfile.ZipInfo(f"{safe}_assignfeedback_file/{name}")  # dated 1980: the same bytes
                entry.external_attr = 0o644 << 16
                entry.compress_type = zipfile.ZIP_DEFLATED
                archive.writestr(entry, page.read_bytes())
    return out.getvalue()


# -- Gradescope --------------------------------------------------------------------------------------


def _gradescope(folder: Path, problems: ProblemSet, record: Record, roster: Path | None) -> Iterator[str]:
    """`gradescope/<student>/results.json`, as an autograder writes it."""
    for standing in standings(record):
        place = folder / "gradescope" / folder_name(standing.student)
        tests = [
            {
                "score": float(Fraction(a.marks)),
                "max_score": float(Fraction(a.of)),
                "status": "passed" if a.verdict in ("correct", "follows") else "failed",
                "name": a.answer if len(problems.items) == 1 else f"{a.problem}: {a.answer}",
                "number": f"{problems.stems.index(a.problem) + 1}.{number}",
                "output": a.why,
                "visibility": "visible",
            }
            for number, a in enumerate((a for a in standing.answers if a.of != "0"), 1)
        ]
        results = {
            "score": float(standing.total),
            "visibility": "visible",
            "stdout_visibility": "hidden",
            "tests": tests,
        }
        write(place / "results.json", json.dumps(results, indent=1, ensure_ascii=False) + "\n")
    yield from ()


EXPORTS: dict[str, Callable[[Path, ProblemSet, Record, Path | None], Iterator[str]]] = {
    "canvas": _canvas,
    "moodle": _moodle,
    "gradescope": _gradescope,
}
