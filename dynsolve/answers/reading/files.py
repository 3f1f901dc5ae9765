"""A file that was handed in -> a `Submission`, by its ending.

Pandoc comes with the extra `office` (PyPI's `pypandoc_binary` is its binary in a wheel) and runs as a process
of its own, without access to files and with limits of memory and time.  It gives its tree of the document
as JSON; here that becomes a report in Markdown, the formulas in LaTeX.  What is struck through is
left out.  One more format that pandoc reads is one more row in `FORMATS`.
"""

from __future__ import annotations

import io
import json
import os
import re
import subprocess
import zipfile
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import Path, PurePath
from typing import Any

from dynsolve.answers.reading.dh_tables import MOST_ROWS, order_of
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grids import MAX_BYTES
from dynsolve.answers.reading.name_splitting import with_own_coordinates
from dynsolve.answers.reading.reports import read_report
from dynsolve.answers.reading.sources import Source, decoded, plain_signs
from dynsolve.answers.reading.vocabulary import counted_from_zero, vocabulary
from dynsolve.answers.verdict import Submission
from dynsolve.errors import Finding, ReadError
from dynsolve.explain.context import style_of
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.problem.model import Problem

# Word, LibreOffice, typst, Org and reStructuredText, read by pandoc as a report

FORMATS = {".docx": "docx", ".odt": "odt", ".typ": "typst", ".org": "org", ".rst": "rst"}
"""What pandoc calls the files of each ending."""

EXTRA = "pip install 'dynsolve[office]'"
SECONDS = 10
"""Processor time for one document."""

_MEMORY = "512M"
_MAX_DEPTH = 60
_MAX_UNPACKED = 100_000_000
_ONE_DOT = "˙\u0307."
_ACCENT = re.compile(rf"\\overset\{{([{_ONE_DOT}¨\u0308]|\.\.)\}}")
"""The dots of a derivative as Word and LibreOffice may have them: as a sign that stands above."""

_OBJECT = re.compile(rb'(xlink:href="(?:\./)?[^"/]{1,200})/"')


@cache
def pandoc() -> Path | None:
    """The binary, None without the extra."""
    spec = find_spec("pypandoc")
    places = spec.submodule_search_locations if spec else None
    found = [Path(place) / "files" / "pandoc" for place in places or ()]
    return next((path for path in found if path.is_file()), None)


def as_report(content: bytes, ending: str) -> tuple[str, int]:
    """The document as a report in Markdown, and how many pictures are in it; raises ReadError."""
    program = pandoc()
    if program is None:
        raise ReadError("pandoc, which reads such files, is not installed", help=EXTRA)
    if ending == ".odt":
        content = _mended(content)
    arguments = ["+RTS", f"-M{_MEMORY}", "-RTS", "--sandbox", "-f", FORMATS[ending], "-t", "json", "-"]
    done = subprocess.run(  # noqa: S603  a binary of our own, arguments of our own
        [program, *arguments],
        input=content,
        capture_output=True,
        check=False,
        preexec_fn=_limit if hasattr(os, "fork") else None,
    )
    if done.returncode or len(done.stdout) > 5 * MAX_BYTES:
        raise ReadError("pandoc cannot read this file", help="save it anew, or hand in Markdown or LaTeX")
    try:
        walker = _Walker()
        blocks = json.loads(done.stdout)["blocks"]
        return "\n\n".join(walker.blocks(blocks, 0)) + "\n", walker.pictures
    except (ValueError, KeyError, TypeError, IndexError, RecursionError):
        raise ReadError("this document is nested too deeply", help="hand in Markdown or LaTeX") from None


def _limit() -> None:
    import resource

    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _mended(content: bytes) -> bytes:
    """The text and the formulas of an .odt; names of formulas without the slash that pandoc trips over."""
    try:
        out = io.BytesIO()
        with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(out, "w") as new:
            left = _MAX_UNPACKED
            for entry in old.infolist():
                if not entry.filename.endswith((".xml", "mimetype")):
                    continue
                left -= entry.file_size
                if left < 0:
                    raise ReadError("this document is too large", help="hand in the text alone")
                new.writestr(entry.filename, _OBJECT.sub(rb'\1"', old.read(entry)))
        return out.getvalue()
    except (zipfile.BadZipFile, NotImplementedError, EOFError, RuntimeError, OSError, ValueError):
        raise ReadError("this is no .odt file", help="save it anew") from None


class _Walker:
    """From pandoc's tree to lines of Markdown; `pictures` counts what is not read."""

    def __init__(self) -> None:
        self.pictures = 0

    def blocks(self, blocks: list[Any], depth: int) -> Iterator[str]:
        """The paragraphs of some blocks."""
        if depth > _MAX_DEPTH:
            raise RecursionError
        for block in blocks:
            kind, content = block["t"], block.get("c")
            if kind in ("Para", "Plain"):
                yield self.inlines(content, depth)
            elif kind == "Header":
                yield "#" * content[0] + " " + self.inlines(content[2], depth)
            elif kind == "LineBlock":
                yield "\n".join(self.inlines(line, depth) for line in content)
            elif kind == "CodeBlock":
                yield f"```\n{content[1]}\n```"
            elif kind == "RawBlock":
                yield str(content[1])
            elif kind == "Table" and (table := self._drawn(content, depth)):
                yield table
            else:
                for inside in _blocks_inside(content, 0):
                    yield from self.blocks(inside, depth + 1)

    def _drawn(self, content: Any, depth: int) -> str:
        """A table of Denavit-Hartenberg parameters as one of Markdown; empty of another."""
        rows = [[self._cell(cell, depth) for cell in row] for row in _rows_of(content)]
        if not any(order_of(line) for line in (*rows[:2], [row[0] for row in rows if row])):
            return ""
        return "\n".join(f"| {' | '.join(row)} |" for row in rows)

    def _cell(self, cell: list[Any], depth: int) -> str:
        text = " ".join(self.blocks(cell, depth + 1))
        return text.replace("\n", " ").replace("|", "\\|")

    def inlines(self, inlines: list[Any], depth: int) -> str:
        """The text of one paragraph."""
        if depth > _MAX_DEPTH:
            raise RecursionError
        return "".join(self._inline(inline, depth + 1) for inline in inlines)

    def _inline(self, inline: Any, depth: int) -> str:
        kind, content = inline["t"], inline.get("c")
        if kind == "Str":
            return str(content)
        if kind in _BETWEEN:
            return _BETWEEN[kind]
        if kind == "Math":
            sign = "$$" if content[0]["t"] == "DisplayMath" else "$"
            latex = _ACCENT.sub(lambda dots: "\\dot" if dots[1] in _ONE_DOT else "\\ddot", content[1])
            return f"{sign}{latex.strip()}{sign}"
        if kind in ("Code", "RawInline"):
            return str(content[1])
        if kind in ("Subscript", "Superscript"):
            return ("_" if kind == "Subscript" else "^") + "{" + self.inlines(content, depth) + "}"
        if kind == "Image":
            self.pictures += 1
            return ""
        if kind == "Quoted":
            sign = "'" if content[0]["t"] == "SingleQuote" else '"'
            return sign + self.inlines(content[1], depth) + sign
        inside = content[1] if kind in ("Cite", "Link", "Span") else content
        return self.inlines(inside, depth) if isinstance(inside, list) else ""


def _blocks_inside(content: Any, depth: int) -> Iterator[list[Any]]:
    """The lists of blocks in a list, a table, a quotation; paragraphs of a definition's term too."""
    if depth > _MAX_DEPTH:
        raise RecursionError
    if not isinstance(content, list):
        return
    if content and all(isinstance(part, dict) and "t" in part for part in content):
        if content[0]["t"] in _INLINES:
            yield [{"t": "Para", "c": content}]
        elif content[0]["t"] in _BLOCKS:
            yield content
        return
    for part in content:
        yield from _blocks_inside(part, depth + 1)


def _rows_of(table: list[Any]) -> Iterator[list[list[Any]]]:
    """The rows of a table of pandoc's tree, each a list of the blocks of its cells."""
    head, bodies, foot = table[3:6]
    rows = [*head[1], *(row for body in bodies for part in body[2:4] for row in part), *foot[1]]
    for row in rows[:MOST_ROWS]:
        yield [cell[4] for cell in row[1]]


_BETWEEN = {"Space": " ", "SoftBreak": "\n", "LineBreak": "\n", "Strikeout": "", "Note": ""}
_BLOCKS = frozenset(
    "Para Plain Header LineBlock CodeBlock RawBlock BulletList OrderedList DefinitionList Table Div "
    "BlockQuote Figure HorizontalRule".split()
)
_INLINES = frozenset(
    "Str Space SoftBreak LineBreak Math Code RawInline Subscript Superscript Image Strikeout Note Quoted "
    "Cite Link Span Emph Strong Underline SmallCaps".split()
)

ENDINGS = (".yaml", ".yml", ".json", ".md", ".markdown", ".tex", ".txt", ".ipynb", ".html", ".htm", *FORMATS)
"""The endings of files that are read."""


_REPORTS = (".md", ".markdown", ".tex", ".txt")
_ANSWERS = re.compile(r"""(?m)^[ \t]{0,9}\{?[ \t]{0,9}["']?answers["']?[ \t]*:|\A\s{0,99}\{\s{0,99}["']""")
_ANSWER_FILES = (".yaml", ".yml", ".json")

MOST_PRINTED = 8_000
"""So many parts of trees a printer remembers before it is begun anew."""


def _is_report(text: str) -> bool:
    """Whether a text without a telling name, from standard input say, is a report."""
    has_displays = any(sign in text for sign in ("$$", "\\[", "\\begin{"))
    return has_displays and _ANSWERS.search(text) is None


class FileReader:
    """Reads what is handed in for one problem; what all hand-ins share is made once."""

    def __init__(self, problem: Problem) -> None:
        self.vocabulary = vocabulary(problem)
        self.style = style_of(problem.robot)
        self.printer = UnicodePrinter(self.style)

    def __call__(self, content: bytes | str, file: str) -> Submission:
        """Read one file; what is wrong with it as a whole is in `faults`."""
        if len(content) > MAX_BYTES:
            message = f"the file is larger than {MAX_BYTES // 1_000_000} MB"
            return Submission("", "", file, (), (), (Finding(message, "hand in the text alone", file),))
        if self.printer.remembered > MOST_PRINTED:
            self.printer = UnicodePrinter(self.style)
        names = self.vocabulary.fresh()
        text = content if isinstance(content, str) else content.decode(errors="ignore")
        if file.endswith(".ipynb"):
            text = text.replace("\\n", "\n")  # the ends of lines within the strings of its JSON
        names.from_zero = counted_from_zero(text, len(names.coordinates))
        reader = EquationReader(names, self.printer)
        problem, student, faults = _read(reader, content, file)
        reader.found.settle()
        coordinates = [q.name for q in self.vocabulary.coordinates]
        answers = tuple(with_own_coordinates(reader.found.answers, reader.coordinates, coordinates))
        refused = tuple(reader.found.not_recognized)
        return Submission(
            problem,
            student,
            file,
            answers,
            refused,
            tuple(faults),
            tuple(reader.found.left_alone),
            tuple(reader.found.general),
            tuple(reader.found.configurations),
            tuple(reader.found.verdicts),
        )


def read_submission(problem: Problem, source: bytes | str, file: str) -> Submission:
    """Read what a student handed in: an answer file (.yaml, .json), or a report (.md, .tex, .ipynb, ...).

    The ending of `file` says which; nothing that stands in `source` raises.  For many
    files of one problem keep a `FileReader`.
    """
    return FileReader(problem)(source, file)


def _read(reader: EquationReader, content: bytes | str, file: str) -> tuple[str, str, list[Finding]]:
    """Read a file by its ending; gives the problem and the student that it names, and its faults."""
    ending = PurePath(file.replace("\0", "")).suffix.lower()
    if ending in FORMATS and isinstance(content, bytes):
        return "", "", _read_document(reader, content, file, ending)
    source = Source(decoded(content), file)
    if ending == ".ipynb":
        from dynsolve.answers.reading.web import read_notebook

        return "", "", read_notebook(reader, source)
    if ending in (".html", ".htm"):
        from dynsolve.answers.reading.web import read_page

        read_page(reader, source)
    elif ending in _REPORTS or (ending not in _ANSWER_FILES and _is_report(source.text)):
        read_report(reader, source, latex=ending == ".tex")
    else:
        from dynsolve.answers.reading.answer_file import read_answer_file

        (problem, student), faults = read_answer_file(reader, source)
        return problem, student, faults
    return "", "", []


def _read_document(reader: EquationReader, content: bytes, file: str, ending: str) -> list[Finding]:
    """Read what pandoc makes a report of; gives its faults."""
    try:
        text, pictures = as_report(content, ending)
    except ReadError as error:
        return [Finding(error.message, error.help, file)]
    read_report(reader, Source(plain_signs(text), file))
    if pictures and not reader.found.answers:
        message = "no formula stands in this document, only pictures, which a human has to read"
        return [Finding(message, "write formulas with the editor for formulas", file)]
    return []
