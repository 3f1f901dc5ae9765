"""Canvas: the names of its files, and the gradebook with one assignment, as Grades > Import takes it.

Canvas finds students by `ID` and an assignment by the number in parentheses after its
title.  Only the columns about the student and this one assignment are written, so that
an import changes nothing else; who handed in nothing, and who is excused, keeps what
stands there.

The zip of comments for Canvas: the students' pages, named as the files that they handed in.

Canvas finds whose a file is by two numbers in its name, the student's and the file's, and shows it to
the student under the name of the file that was handed in (`generate_comments_from_files` in its
`app/models/abstract_assignment.rb`).  So a page is of the kind that this name promises; a text that was
typed into Canvas, or a PDF, can carry none.

The names that Canvas gives to the files of a download (its `lib/content_zipper.rb`).
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path, PurePosixPath

from msgspec import Struct

from dynsolve.answers.reading.files import ENDINGS
from dynsolve.grading.cohort import Standing, most, standings
from dynsolve.grading.files import decimal, folder_name
from dynsolve.grading.platforms.gradescope import FileOwner, Person
from dynsolve.grading.platforms.moodle import write_archive, zipped
from dynsolve.grading.platforms.roster import Cells, Roster, named, not_judged, number, unmatched
from dynsolve.grading.record import Key, Record
from dynsolve.grading.set_file import ProblemSet

# The names that Canvas gives to the files of a download (its `lib/content_zipper.rb`)

_NAMED = re.compile(
    r"(?P<who>[^/]+?)_(?P<late>LATE_)?(?P<user>\d+)_(?:(?P<file>\d+)_(?P<name>.+)|(?P<page>text|link)\.html)"
)
_ANONYMOUS = re.compile(
    r"(?P<late>LATE_)?(?P<who>anon)_(?P<user>[^_]+)_"
    r"(?:(?P<file>\d+)_(?P<name>.+)|(?P<page>text|link)\.html)"
)


class CanvasName(Struct, frozen=True):
    """The parts of a name: whose, the number of the student, that of the file, and the file's own name.

    A text or an address that was entered has a `page` and no file.
    """

    text: str
    who: str
    user: str
    late: bool
    file: str
    name: str
    page: str

    @property
    def ending(self) -> str:
        """The ending of the file's own name."""
        return PurePosixPath(self.name).suffix.lower()

    def with_name(self, name: str) -> str:
        """The whole name with another name for the file itself."""
        return self.text.removesuffix(self.name) + name


def canvas_name(text: str) -> CanvasName | None:
    """The parts of a name, None where it is none of Canvas's.

    Canvas takes `_<digits>_` out of names, so that the first such number is the user's.

    >>> found = canvas_name("lovelaceada_LATE_101_9001_rp.yaml")
    >>> found.user, found.file, found.late, found.with_name("elbow_rp.yaml")
    ('101', '9001', True, 'lovelaceada_LATE_101_9001_elbow_rp.yaml')
    """
    found = _ANONYMOUS.fullmatch(text) or _NAMED.fullmatch(text)
    if found is None:
        return None
    who, user, late = found["who"], found["user"], bool(found["late"])
    return CanvasName(text, who, user, late, found["file"] or "", found["name"] or "", found["page"] or "")


# The zip of comments for Canvas

FILE = "canvas-comments.zip"
_CANVAS_COMMENTS_PAGES = (".html", ".htm")
_NO_TEXT = (".docx", ".odt")


def write_comments(folder: Path, record: Record) -> Iterator[str]:
    """Write `canvas-comments.zip`, giving warnings on who cannot get a page by it."""
    entries: dict[str, bytes] = {}
    without: dict[str, None] = {}
    apart: dict[str, str] = {}
    for (student, problem), carrier, shared in _carriers(folder, record):
        if carrier is None:
            without[student] = None
            continue
        name = carrier.with_name(f"{problem}_{carrier.name}") if shared else carrier.text
        content = _content(_place(folder, (student, problem)), carrier.ending)
        if entries.setdefault(name, content) != content:
            apart[student] = name
    write_archive(folder / FILE, sorted((n, c) for n, c in entries.items() if n not in apart.values()))
    if without:
        reason = "handed in no file that can carry them"
        yield f"Canvas cannot give back the pages of who {reason}: {named([*without])}"
    if apart:
        yield f"in Canvas a group reads one page, and those of its members differ: {named([*apart.values()])}"


def _carriers(folder: Path, record: Record) -> Iterator[tuple[Key, CanvasName | None, bool]]:
    """For each page the file whose name it gets, and whether another page of the student gets it too."""
    files: dict[Key, list[str]] = {key: list(paths) for key, paths in record.uploads().items()}
    for entry in record.waiting():
        files.setdefault((entry.student, entry.problem), []).append(entry.file)
    of_student: dict[str, list[CanvasName]] = {}
    for (student, _), paths in files.items():
        of_student.setdefault(student, []).extend(_usable(paths))
    chosen: dict[Key, CanvasName | None] = {}
    for row in record.rows():
        key = (row.student, row.problem)
        if not _place(folder, key).with_name(f"{row.problem}.html").is_file():
            continue  # nothing was handed in
        own = _usable(files.get(key) or files.get((row.student, ""), [])) or of_student.get(row.student, [])
        chosen[key] = own[0] if own else None
    pages = Counter((student, carrier) for (student, _), carrier in chosen.items() if carrier is not None)
    for key, carrier in chosen.items():
        yield key, carrier, carrier is not None and pages[key[0], carrier] > 1


def _place(folder: Path, key: Key) -> Path:
    """Where a student's page for a problem lies, but for its ending."""
    student, problem = key
    return folder / "feedback" / folder_name(student) / problem


def _usable(paths: Iterable[str]) -> list[CanvasName]:
    """The files of Canvas among these that can carry a page."""
    found = (canvas_name(part) for path in paths for part in PurePosixPath(path).parts)
    carriers = {".zip", *ENDINGS} - {*_NO_TEXT}
    return [one for one in found if one is not None and one.file and one.ending in carriers]


def _content(place: Path, ending: str) -> bytes:
    """The page at a place in the kind of an ending: HTML, a notebook, a zip, else Markdown, which is text."""
    html, markdown = (place.with_name(f"{place.name}{kind}").read_bytes() for kind in (".html", ".md"))
    if ending in _CANVAS_COMMENTS_PAGES:
        return html
    if ending == ".ipynb":
        cell = {"cell_type": "markdown", "metadata": {}, "source": markdown.decode()}
        return json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 4}).encode()
    return zipped([(f"{place.name}.html", html)]) if ending == ".zip" else markdown


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
    exact = [place for place, name in enumerate(roster.header) if name == title]
    bare = [re.sub(r" \(\d+\)$", "", name).strip() for name in roster.header]
    titled = [place for place, name in enumerate(bare) if name == title]
    if not exact and len(titled) > 1:
        which = " or ".join(f"`{roster.header[place]}`" for place in titled)
        message = f"{len(titled)} assignments are called `{title}`"
        raise roster.fault(message, f"write one of them as the title in set.yaml: {which}")
    return next(iter(exact or titled), None)


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
