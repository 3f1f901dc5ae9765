"""The page of the queue: what waits for a human beside its key, to be decided in a browser without a server.

It is one file that fetches nothing, and runs no script but its own, which the policy names by its hash.
What is filled in is kept in the browser; saving gives `queue.csv` as `dynsolve override --from` reads it.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache, partial
from hashlib import sha256
from html import escape
from importlib.resources import files
from itertools import groupby
from pathlib import Path, PurePosixPath
from urllib.parse import quote

from msgspec import Struct, field

from dynsolve.answers.marks import points, shown
from dynsolve.answers.reading.files import ENDINGS, FORMATS
from dynsolve.answers.reading.sources import decoded
from dynsolve.errors import ReadError
from dynsolve.grading.cohort import Entry
from dynsolve.grading.files import called, decimal, folder_name, safe
from dynsolve.grading.files import text as _text
from dynsolve.grading.record import Key, Record, RecordedAnswer
from dynsolve.grading.run import kept_keys
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import FOLDER, PICTURES, copy_name
from dynsolve.grading.which_problem import as_text
from dynsolve.render.html import stylesheet, whole_page

FILE = "queue.html"

_AROUND = 15
"""So many lines before and after the one that is meant are shown, and of what has none twice as many."""

_LONGEST_LINE = 2000
_LINE = re.compile(r"\bline (\d+)(?: of (.+?))?(?:$|;)")


class _Course(Struct, frozen=True, dict=True):
    """What an entry is written from."""

    folder: Path
    lines: Callable[[str], list[str]]
    names: Mapping[str, str]
    uploads: Mapping[Key, tuple[str, ...]]
    files: Mapping[Key, tuple[str, ...]]
    answers: Mapping[Key, list[RecordedAnswer]]
    keys: dict[tuple[str, str], str] = field(default_factory=dict)


def queue_page(
    folder: Path, problems: ProblemSet, record: Record, waits: Sequence[Entry], names: Mapping[str, str]
) -> str:
    """The page; `waits` is what waits, `names` are what students are called."""
    stems = [stem for stem in problems.stems if any(entry.problem in (stem, "") for entry in waits)]
    keys = {(stem, answer): key for stem in stems for answer, key in kept_keys(record, stem).items()}
    beside = {(entry.student, entry.problem) for entry in waits if not entry.answer}
    answers = {key: [a for a in record.answers(key[0]) if a.problem == key[1]] for key in beside}
    handed_in = {(row.student, row.problem): row.files for row in record.rows()}
    lines = lru_cache(maxsize=16)(partial(_lines, folder))
    course = _Course(folder, lines, names, record.uploads(), handed_in, answers, keys)
    groups = groupby(waits, key=lambda e: (e.student, e.problem, e.what, e.why))
    body = "".join(_entry(course, list(entries)) for _, entries in groups)
    templates = "".join(
        f'<template id="{_key_id(*which)}">{key}</template>\n' for which, key in sorted(keys.items())
    )
    script = (files("dynsolve.grading") / "queue.js").read_text(encoding="utf-8")
    digest = base64.b64encode(sha256(f"\n{script}".encode()).digest()).decode()
    style = stylesheet() + (files("dynsolve.grading") / "queue.css").read_text(encoding="utf-8")
    title = f"{_text(problems.title)}: what waits for a human"
    main = f"<h1>{title}</h1>\n{_bar(stems, waits)}{body or '<p>Nothing waits.</p>'}"
    whole = f"<main>\n{main}</main>\n{templates}<script>\n{script}</script>"
    return whole_page(title, f"script-src 'sha256-{digest}'; img-src 'self' data:", style, whole)


def _bar(stems: Sequence[str], waits: Sequence[Entry]) -> str:
    """The filters, what is done, and how it is saved."""
    answers = dict.fromkeys(entry.answer.answer for entry in waits if entry.answer)
    return (
        '<div id="bar"><form id="filters" role="search">\n'
        '<label>Student or text <input name="text" type="search"></label>\n'
        f"<label>Problem {_select('problem', stems)}</label>\n"
        f"<label>Answer {_select('answer', answers)}</label>\n"
        '<label><input name="open" type="checkbox"> only what is not filled in</label>\n'
        '<button type="button" id="save">Save queue.csv</button>\n'
        '<span id="status" role="status"></span></form>\n'
        "<p>Then <code>dynsolve override OUT --from queue.csv</code> sets the marks. Alt+↓ and Alt+↑ (or j "
        "and k) go to the next entry and back, Ctrl+S saves. A comment alone changes no marks.</p></div>\n"
    )


def _select(name: str, values: Iterable[str]) -> str:
    options = "".join(f'<option value="{_text(v)}">{_text(v)}</option>' for v in values)
    return f'<select name="{name}"><option value="">all</option>{options}</select>'


# -- an entry ----------------------------------------------------------------------------------------


def _entry(course: _Course, entries: list[Entry]) -> str:
    entry = entries[0]
    waiting = [e.answer for e in entries if e.answer]
    others = [] if waiting else course.answers.get((entry.student, entry.problem), [])
    heading = " · ".join(filter(None, (called(entry.student, course.names), entry.problem, entry.what)))
    reason = f"{entry.what}: {entry.why}"
    rows = "".join(_answer(course, a, reason, "") for a in waiting)
    rows += "".join(_answer(course, a, "", " data-extra") for a in others if a.of != "0")
    alone = "" if waiting else _alone(entry, reason, rows)
    return (
        f'<article data-problem="{_text(entry.problem)}">\n<h2 dir="auto">{_text(heading)}</h2>\n'
        f'<p>{_text(entry.why)}</p>\n<div class="sides">\n{_hand_in(course, entry)}<section>{alone}{rows}'
        "</section>\n</div></article>\n"
    )


def _alone(entry: Entry, reason: str, rows: str) -> str:
    """What is said of a file that waits beside answers that do not; its row is kept as it is."""
    cells = (entry.student, entry.problem, "", "", reason)
    said = "Marks, or a comment, for any of these answers settle it." if rows else "It is nobody's answer."
    return f'<p data-row="{_cells(cells)}">{said}</p>\n'


def _cells(cells: Iterable[str]) -> str:
    return escape(json.dumps([safe(cell) for cell in cells]))


def _answer(course: _Course, a: RecordedAnswer, reason: str, extra: str) -> str:
    """The key, what the student wrote as it was read, and the fields for marks and a comment."""
    of = decimal(points(a.of))
    row = _cells((a.student, a.problem, a.answer, of, reason))
    name = _text(f"{a.answer} {a.label}".strip())
    key = _key_id(a.problem, a.answer)
    known = (a.problem, a.answer) in course.keys
    path, line = _place(course, Entry(a.student, a.problem, "", "", a))
    written = "".join(course.lines(path)[line - 1 : line]) if line else ""
    told = [] if a.verdict == "unreadable" else [a.why, *a.message]
    parts = (
        ("Key", f'<div class="key" data-key="{key}"></div>' if known else "see the solution of the problem"),
        (f"Line {line}", _code(written)),
        ("Read as", _code(a.read_as)),
        ("The program", "<br>".join(map(_text, filter(None, told)))),
    )
    listed = "".join(f"<dt>{term}</dt><dd>{said}</dd>\n" for term, said in parts if said)
    buttons = "".join(
        f'<button type="button" data-marks="{n}" aria-label="{n} marks for {name}">{n}</button>\n'
        for n in dict.fromkeys(("0", *(shown(points(marks)) for marks in (a.marks, a.of))))
    )
    return (
        f'<fieldset id="a{_digest(row, a.read_as, written)}" data-row="{row}" data-of="{of}" '
        f'data-answer="{_text(a.answer)}"{extra}>\n<legend>{name}</legend>\n<dl>{listed}</dl>\n'
        f'<div class="said"><label>Marks <input size="6" inputmode="decimal" autocomplete="off"> of '
        f"{_text(shown(points(a.of)))}</label>\n{buttons}"
        '<label class="comment">Comment, which the student reads <textarea rows="2"></textarea></label>'
        "</div></fieldset>\n"
    )


def _key_id(problem: str, answer: str) -> str:
    return f"k{_digest(problem, answer)}"


def _digest(*parts: object) -> str:
    return sha256(json.dumps([str(part) for part in parts]).encode()).hexdigest()[:16]


# -- what was handed in ------------------------------------------------------------------------------


def _hand_in(course: _Course, entry: Entry) -> str:
    """The links to the files, and the text around the line that is meant."""
    paths = course.uploads.get((entry.student, entry.problem), ())
    every = dict.fromkeys((*([entry.what] if entry.what not in paths else []), *paths))
    copied = ((PurePosixPath(path).name, _copy(course.folder, path)) for path in every)
    links = " ".join(
        f'<a href="{copy}" target="_blank" rel="noopener noreferrer">{_text(name)}</a>'
        for name, copy in copied
        if copy
    )
    page = f"feedback/{folder_name(entry.student)}/{entry.problem}.html"
    if (course.folder / page).is_file():
        links += f' · <a href="{quote(page)}" target="_blank">what the student reads</a>'
    path, line = _place(course, entry)
    lines = "".join(_window(course.lines(path), line))
    text = f'<pre tabindex="0" aria-label="What was handed in" dir="auto">{lines}</pre>' if lines else ""
    pictures = [path for path in every if PurePosixPath(path).suffix.lower() in PICTURES]
    copies = filter(None, (_copy(course.folder, path) for path in pictures))
    text += "".join(f'<img src="{copy}" alt="What was handed in" loading="lazy">' for copy in copies)
    return f'<section class="hand-in"><h3>Handed in: {links}</h3>\n{text}</section>\n'


def _place(course: _Course, entry: Entry) -> tuple[str, int]:
    """The path of the file that is meant, and the line in it, 0 where none is."""
    key, a = (entry.student, entry.problem), entry.answer
    paths = course.uploads.get(key, ())
    found = _LINE.search(a.note if a else entry.what)
    line = a.line if a else int(found[1]) if found else 0
    named = dict(zip(course.files.get(key, ()), paths, strict=False))
    meant = named.get((found[2] or "") if found else "", entry.what)
    return meant if course.lines(meant) else next(iter(paths), ""), line


def _copy(folder: Path, path: str) -> str:
    """Where the copy of a file lies, nothing where there is none."""
    copy = copy_name(path)
    return f"{FOLDER}/{quote(copy)}" if (folder / FOLDER / copy).is_file() else ""


def _lines(folder: Path, path: str) -> list[str]:
    """The lines of a file that was handed in; nothing where it has none."""
    ending = PurePosixPath(path).suffix.lower()
    copy = folder / FOLDER / copy_name(path)
    if ending not in ENDINGS or not copy.is_file():
        return []
    try:
        content = copy.read_bytes()
        return (as_text(content, ending) if ending in FORMATS else decoded(content)).split("\n")
    except (OSError, ReadError):
        return []


def _window(lines: Sequence[str], line: int) -> Iterator[str]:
    """The lines around one, which is marked; from the first where none is meant."""
    first = max(line - _AROUND, 1)
    for number in range(first, min(first + 2 * _AROUND, len(lines)) + 1):
        tag = "mark" if number == line else "span"
        yield f'<{tag} data-line="{number}">{_text(lines[number - 1][:_LONGEST_LINE])}</{tag}>'


def _code(text: str) -> str:
    return f'<code class="read" dir="auto">{_text(text[:_LONGEST_LINE])}</code>' if text else ""
