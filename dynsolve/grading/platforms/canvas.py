"""Canvas: the names of its files, and the gradebook with one assignment, as Grades > Import takes it.

Canvas finds students by `ID` and an assignment by the number in parentheses after its
title.  Only the columns about the student and this one assignment are written, so that
an import changes nothing else; who handed in nothing, and who is excused, keeps what
stands there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

from dynsolve.grading.cohort import Standing, most, standings
from dynsolve.grading.files import decimal
from dynsolve.grading.platforms.canvas_comments import write_comments
from dynsolve.grading.platforms.canvas_names import canvas_name
from dynsolve.grading.platforms.owner import FileOwner, Person
from dynsolve.grading.platforms.roster import Cells, Roster, not_judged, number, unmatched
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Record

_PAGES = {"text": "text.html", "link": "link.url"}
"""A text that was entered is read as a page; what is behind an address is not fetched."""

_ABOUT_STUDENTS = (
    "Student", "LastName", "FirstName", "ID", "SIS User ID", "SIS Login ID", "Integration ID",
    "Root Account", "Section",
)  # fmt: skip
_NAMES = ("SIS User ID", "SIS Login ID", "Integration ID")
_POINTS = "Points Possible"


def owner(parts: tuple[str, ...]) -> FileOwner | None:
    """`<lastfirst>[_LATE]_<user id>_<attachment id>_<name>`, `..._text.html`, `[LATE_]anon_<id>_...`."""
    found = canvas_name(parts[0]) if len(parts) == 1 else None
    if found is None:
        return None
    name, order = found.name or _PAGES[found.page], int((found.file or "0")[:18])
    delivery = "late" if found.late else ""
    late = int(found.late)  # Canvas does not say by how much
    return FileOwner(f"{found.who}_{found.user}", found.user, delivery, name, late, order)


def people(roster: Roster) -> Iterator[Person]:
    """The students of a gradebook, as Canvas names their files: the letters of the name, then the number."""
    header = roster.header
    if "ID" not in header:
        return
    id, also = header.index("ID"), [place for place, name in enumerate(header) if name in _NAMES]
    for row in roster.rows[1:]:
        if len(row) <= id or not row[id].strip().isdigit():
            continue
        name = row[0] if header[0] == "Student" else ", ".join(row[:2])
        student = re.sub(r"\W", "", f"{name.casefold()}_{row[id].strip()}")
        yield Person(student, row[id].strip(), name, also=tuple(row[place] for place in also if row[place:]))


def check(problems: ProblemSet, roster: Roster) -> int | None:
    """The assignment's column, None where Canvas will make one; raises InputError for no gradebook."""
    header = roster.header
    if "ID" not in header or not {"Student", "LastName"} & set(header[:1]):
        raise roster.fault("this is no gradebook of Canvas", "in Canvas: Grades > Export")
    return _assignment(roster, problems.title)


def write(folder: Path, problems: ProblemSet, record: Record, roster: Roster) -> Iterator[str]:
    """Write `canvas.csv` and `canvas-comments.zip`."""
    header, column = roster.header, check(problems, roster)
    kept = [place for place, name in enumerate(header) if name in _ABOUT_STUDENTS]
    students = _Students(header, standings(record))
    of = sum(most(problems).values(), Fraction(0))
    title = header[column] if column is not None else problems.title
    out: list[Cells] = [(*(header[place] for place in kept), title)]
    seen: set[str] = set()
    without: list[str] = []
    points = ""
    for row in roster.rows[1:]:
        row = row + ("",) * (len(header) - len(row))
        stands = row[column].strip() if column is not None else ""
        if row[0].strip() == _POINTS:
            points = stands
            stands = stands or roster.marks(of)
        elif not _is_remark(row):
            found = students.of(row)
            if found is None:
                without.append(row[0])
            else:
                seen.add(found.student)
                kept_as_it_is = found.unjudged or stands.upper() == "EX"
                stands = stands if kept_as_it_is else roster.marks(found.total)
        out.append((*(row[place] for place in kept), stands))
    if not any(row[0].strip() == _POINTS for row in out):
        out.insert(1, (f"    {_POINTS}", *("" for _ in kept[1:]), roster.marks(of)))
    roster.write(folder / "canvas.csv", out)
    if column is None:
        yield f"{roster.file} has no assignment `{problems.title}`: Canvas will make a new one"
    yield from _of_points(points, of)
    yield from not_judged(students.all)
    yield from unmatched(students.all, seen, without, roster)
    yield from write_comments(folder, record)


def _of_points(points: str, of: Fraction) -> Iterator[str]:
    if "read only" in points:
        yield "the assignment is read only in this gradebook: Canvas will not import its marks"
    elif points and number(points) != of:
        yield f"the assignment has {points} points in Canvas, the problem set {decimal(of)}"


def _assignment(roster: Roster, title: str) -> int | None:
    """The assignment's column: of exactly this name, or of this title before the number in parentheses."""
    named = [place for place, name in enumerate(roster.header) if name == title]
    titled = [
        place for place, name in enumerate(roster.header) if re.sub(r" \(\d+\)$", "", name).strip() == title
    ]
    if not named and len(titled) > 1:
        which = " or ".join(f"`{roster.header[place]}`" for place in titled)
        message = f"{len(titled)} assignments are called `{title}`"
        raise roster.fault(message, f"write one of them as the title in set.yaml: {which}")
    return next(iter(named or titled), None)


def _is_remark(row: Cells) -> bool:
    """Whether a row is about the assignments, such as the one that names those posted by hand."""
    return all(re.fullmatch(r"\s*(muted|manual posting.*)?\s*", cell, re.IGNORECASE) for cell in row)


class _Students:
    """Whose row it is: by Canvas's number where the hand-in has one, else by the names of the registry."""

    def __init__(self, header: Cells, found: Iterator[Standing]) -> None:
        self.all = list(found)
        self._id = header.index("ID")
        self._names = [place for place, name in enumerate(header) if name in _NAMES]
        self._by_id = {s.id: s for s in self.all if s.id}
        self._by_name = {s.student: s for s in self.all if not s.id.isdigit()}

    def of(self, row: Cells) -> Standing | None:
        """The standing of a row's student."""
        found = self._by_id.get(row[self._id].strip()) or self._by_name.get(row[self._id].strip())
        names = (self._by_name[row[place]] for place in self._names if row[place] in self._by_name)
        return found or next(names, None)
