"""What a file says of itself: whose it is, and which problem of the set it is for.

Its front matter or its keys say it, else its name, else its heading; a report on several problems is
told apart by its headings.

One report on several problems: which part of it is for which, told by its headings.

A part begins with a heading that names a problem, by its file's stem or its title, or else by its number in
the set (`Problem 2`, `Oppgave 2`), and ends where the next one begins.  What stands before the first
of them, names and macros say, belongs to all.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from html import unescape
from pathlib import PurePosixPath

from dynsolve.answers.reading.answer_file import parsed
from dynsolve.answers.reading.files import EXTRA, FORMATS, as_report, pandoc
from dynsolve.answers.reading.sources import decoded
from dynsolve.errors import ReadError
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import printable

# One report on several problems: which part of it is for which, told by its headings

HEADING = re.compile(
    r"(?m)^#{1,6}[ \t]+(.{1,300})$|^([^\n]{1,300})\n={3,}[ \t]*$"
    r"|\\(?:title|section|chapter|subsection)\*?\{([^}\n]{1,300})\}|<h[1-6][^>]{0,300}>((?s:.{1,300}?))</h"
)
"""A heading in Markdown, LaTeX and HTML."""

_SET_OFF = re.compile(r"(?m)^(?:\*\*|__)([^*_\n$=]{1,100})(?:\*\*|__)[ \t]*$|^([^\n$=:]{1,30}):?[ \t]*$")
"""A line in bold, or a short one of words alone, as it stands over a part in plain text."""

_NUMBER = re.compile(
    r"\W{0,9}(?:problem|exercise|task|question|oppgave|oppg|opgave|uppgift|aufgabe|exercice|ejercicio"
    r"|esercizio|tehtävä)\W{1,3}([0-9]{1,2})\b",
    re.IGNORECASE,
)
_TAG = re.compile(r"<[^>]{0,300}>")

Span = tuple[int, int]


def titles(text: str) -> list[tuple[int, str]]:
    """The headings of a text with their offsets."""
    return [
        (found.start(), unescape(_TAG.sub(" ", next(filter(None, found.groups())))))
        for found in HEADING.finditer(text)
    ]


def parts(text: str, named: Callable[[str], str], stems: Sequence[str]) -> dict[str, tuple[Span, ...]]:
    """What a report holds for each problem: the spans that are of others; of one problem alone nothing.

    `named` gives the stem of the problem that a heading names, or nothing; `stems` are all, in their order.
    """
    begins = _begins(text, named, stems)
    if len({stem for _, stem in begins}) < 2:
        return {}
    ends = [*(at for at, _ in begins[1:]), len(text)]
    spans = [(at, end, stem) for (at, stem), end in zip(begins, ends, strict=True)]
    return {
        stem: tuple((at, end) for at, end, other in spans if other != stem)
        for stem in dict.fromkeys(stem for _, stem in begins)
    }


def _begins(text: str, named: Callable[[str], str], stems: Sequence[str]) -> list[tuple[int, str]]:
    """Where a part begins, and for which problem."""
    headings = titles(text)
    by_name = [(at, stem) for at, title in headings if (stem := named(title))]
    by_number = [(at, stem) for at, title in headings if (stem := _numbered(title, stems))]
    if not by_name:
        return by_number or [
            (found.start(), stem)
            for found in _SET_OFF.finditer(text)
            if (stem := _numbered(found[1] or found[2], stems))
        ]
    both = dict(by_name)
    agree = [both[at] == stem for at, stem in by_number if at in both]
    if agree and all(agree):
        return sorted({**dict(by_number), **both}.items())
    return by_name


def _numbered(title: str, stems: Sequence[str]) -> str:
    found = _NUMBER.match(title)
    number = int(found[1]) if found else 0
    return stems[number - 1] if 1 <= number <= len(stems) else ""


_HEAD = 20_000
CONVERTED = (".ipynb", *FORMATS)
"""The endings of files of which a report in Markdown is made before their parts are told apart."""

_IN_PARTS = (".md", ".markdown", ".tex", ".txt", ".html", ".htm", *CONVERTED)
_ANSWER_FILES = (".yaml", ".yml", ".json")
_FIELD = r"(?m)^[ \t]{{0,3}}[\"']?{}[\"']?[ \t]{{0,9}}:[ \t]{{0,99}}(\S.{{0,300}}?)[ \t]*(?:#.*)?$"
_STUDENT, _PROBLEM = (re.compile(_FIELD.format(key)) for key in ("student", "problem"))
_FRONT, _BACK = ("---", "<!--"), ("---", "...", "-->")
"""The lines that front matter stands between."""


def beginning(content: bytes, ending: str) -> tuple[str, str]:
    """The text that a file begins with, that of a notebook's first cells; or why a human has to read it."""
    if ending in FORMATS:
        return _document(content, ending)
    text = decoded(content if ending == ".ipynb" else content[:_HEAD])
    if ending == ".ipynb":
        with suppress(ValueError, RecursionError):
            book = json.loads(text)
            cells = book.get("cells", ()) if isinstance(book, dict) else ()
            sources = [cell.get("source") for cell in cells if isinstance(cell, dict)][:20]
            text = "\n\n".join("".join(map(str, s)) if isinstance(s, list) else str(s) for s in sources)
    return text[:_HEAD], ""


def _document(content: bytes, ending: str) -> tuple[str, str]:
    if pandoc() is None:
        return "", f"a human reads it, or dynsolve after `{EXTRA}`"
    try:
        text, _ = as_report(content, ending)
    except ReadError as error:
        return "", f"a human reads it ({error.message})"
    return text[:_HEAD], "" if "=" in text else "no formula stands in it, so a human reads it"


def _front(text: str, ending: str) -> str:
    """Where a file may say whose it is: an answer file's own keys, a report's front matter."""
    if ending in _ANSWER_FILES:
        return text
    first, *lines = text.lstrip().split("\n")
    last = next((i for i, line in enumerate(lines) if line.strip().startswith(_BACK)), None)
    return "\n".join(lines[:last]) if first.strip() in _FRONT and last is not None else ""


def _said(pattern: re.Pattern[str], text: str, ending: str) -> str:
    if ending in _ANSWER_FILES and text.lstrip().startswith("{"):
        file = parsed(text)
        return printable(file.problem if pattern is _PROBLEM else file.student)
    found = pattern.search(_front(text, ending))
    return printable(found[1].strip("\"', ")[:200]) if found else ""


def said_student(text: str, ending: str) -> str:
    """The student that a file names, or nothing."""
    return _said(_STUDENT, text, ending)


def problem_of(problems: ProblemSet, text: str, name: str, ending: str) -> tuple[str, str]:
    """The problem that a file is for, or why none can be named."""
    said = _said(_PROBLEM, text, ending)
    if said:
        found = folded(said, problems)
        if found:
            return found, ""
        return "", f"it says that it is for `{said[:60]}`, which is no problem of this set"
    named = by_name(problems, name)
    if named:
        return named, ""
    for found in _headed(problems, text):
        return found, ""
    for found in parts(text, lambda title: within(title, problems), problems.stems):
        return found, ""
    if len(problems.items) == 1:
        return problems.items[0].stem, ""
    return "", "neither its front matter, its name nor its heading says which problem it is for"


def _headed(problems: ProblemSet, text: str) -> Iterator[str]:
    for _, title in titles(text):
        found = within(title, problems)
        if found:
            yield found


def parts_of(problems: ProblemSet, content: bytes, name: str, text: str) -> dict[str, tuple[Span, ...]]:
    """The problems that a report is on, where they are several, each with what is for the others."""
    ending = PurePosixPath(name).suffix.lower()
    if ending not in _IN_PARTS or _said(_PROBLEM, text, ending) or by_name(problems, name):
        return {}
    return parts(as_text(content, ending), lambda title: within(title, problems), problems.stems)


def as_text(content: bytes, ending: str) -> str:
    """The text of a report whose parts are told apart; raises ReadError."""
    if ending == ".ipynb":
        from dynsolve.answers.reading.web import markdown

        return markdown(decoded(content))
    return as_report(content, ending)[0] if ending in FORMATS else decoded(content)


def also_named(problems: ProblemSet, text: str, name: str, ending: str) -> list[str]:
    """The further problems of a file whose problem is that of its first heading."""
    if _said(_PROBLEM, text, ending) or by_name(problems, name):
        return []
    return list(dict.fromkeys(_headed(problems, text)))[1:]


def by_name(problems: ProblemSet, name: str) -> str:
    """The problem that a file's name names, or the only one."""
    return within(name, problems) or (problems.items[0].stem if len(problems.items) == 1 else "")


def _fold(text: str) -> str:
    return re.sub(r"[\W_]+", " ", text.casefold()).strip()


def folded(said: str, problems: ProblemSet) -> str:
    """The problem of exactly this name, however it is spelled."""
    said = PurePosixPath(said).stem if said.endswith((".yaml", ".yml")) else said
    names = {_fold(name): item.stem for item in problems.items for name in (item.problem.title, item.stem)}
    return names.get(_fold(said), "")


def within(text: str, problems: ProblemSet) -> str:
    """The problem whose name or title occurs in a text, the longest where several do."""
    folded = f" {_fold(text)} "
    names = [(_fold(n), item.stem) for item in problems.items for n in (item.stem, item.problem.title)]
    hits = sorted((name for name in names if f" {name[0]} " in folded), key=lambda n: -len(n[0]))
    return hits[0][1] if hits else ""
