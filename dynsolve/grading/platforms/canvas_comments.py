"""The zip of comments for Canvas: the students' pages, named as the files that they handed in.

Canvas finds whose a file is by two numbers in its name, the student's and the file's, and shows it to
the student under the name of the file that was handed in (`generate_comments_from_files` in its
`app/models/abstract_assignment.rb`).  So a page is of the kind that this name promises; a text that was
typed into Canvas, or a PDF, can carry none.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path, PurePosixPath

from dynsolve.answers.reading.files import ENDINGS
from dynsolve.grading.files import folder_name
from dynsolve.grading.platforms.archives import write_archive, zipped
from dynsolve.grading.platforms.canvas_names import CanvasName, canvas_name
from dynsolve.grading.platforms.roster import MOST_NAMED
from dynsolve.grading.record import Key, Record

FILE = "canvas-comments.zip"
_PAGES = (".html", ".htm")
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
        yield f"Canvas cannot give back the pages of who {reason}: {_some(without)}"
    if apart:
        yield f"in Canvas a group reads one page, and those of its members differ: {_some(apart.values())}"


def _some(students: Iterable[str]) -> str:
    names = list(students)
    return "; ".join(names[:MOST_NAMED]) + (" and others" if len(names) > MOST_NAMED else "")


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
    named = (canvas_name(part) for path in paths for part in PurePosixPath(path).parts)
    return [one for one in named if one is not None and one.file and _carries(one.ending)]


def _carries(ending: str) -> bool:
    return ending == ".zip" or (ending in ENDINGS and ending not in _NO_TEXT)


def _content(place: Path, ending: str) -> bytes:
    """The page at a place in the kind of an ending: HTML, a notebook, a zip, else Markdown, which is text."""
    html, markdown = (place.with_name(f"{place.name}{kind}").read_bytes() for kind in (".html", ".md"))
    if ending in _PAGES:
        return html
    if ending == ".ipynb":
        cell = {"cell_type": "markdown", "metadata": {}, "source": markdown.decode()}
        return json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 4}).encode()
    return zipped([(f"{place.name}.html", html)]) if ending == ".zip" else markdown
