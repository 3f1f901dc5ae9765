"""Word, LibreOffice, typst, Org and reStructuredText, read by pandoc as a report.

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
from pathlib import Path
from typing import Any

from dynsolve.answers.reading.dh_heads import order_of
from dynsolve.answers.reading.dh_tables import MOST_ROWS
from dynsolve.answers.reading.limits import MAX_BYTES
from dynsolve.errors import ReadError

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
        if kind == "Space":
            return " "
        if kind in ("SoftBreak", "LineBreak"):
            return "\n"
        if kind == "Math":
            sign = "$$" if content[0]["t"] == "DisplayMath" else "$"
            return f"{sign}{_ACCENT.sub(_accented, content[1]).strip()}{sign}"
        if kind in ("Code", "RawInline"):
            return str(content[1])
        if kind in ("Subscript", "Superscript"):
            return ("_" if kind == "Subscript" else "^") + "{" + self.inlines(content, depth) + "}"
        if kind == "Image":
            self.pictures += 1
        if kind in ("Strikeout", "Image", "Note"):
            return ""
        if kind == "Quoted":
            sign = "'" if content[0]["t"] == "SingleQuote" else '"'
            return sign + self.inlines(content[1], depth) + sign
        inside = content[1] if kind in ("Cite", "Link", "Span") else content
        return self.inlines(inside, depth) if isinstance(inside, list) else ""


def _accented(found: re.Match[str]) -> str:
    return "\\dot" if found[1] in _ONE_DOT else "\\ddot"


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


_BLOCKS = frozenset(
    "Para Plain Header LineBlock CodeBlock RawBlock BulletList OrderedList DefinitionList Table Div "
    "BlockQuote Figure HorizontalRule".split()
)
_INLINES = frozenset(
    "Str Space SoftBreak LineBreak Math Code RawInline Subscript Superscript Image Strikeout Note Quoted "
    "Cite Link Span Emph Strong Underline SmallCaps".split()
)
