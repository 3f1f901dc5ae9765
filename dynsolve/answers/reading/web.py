"""Web pages: the text of an HTML file, its formulas as they were written in LaTeX.

Code is never run; what it says of an answer is listed, or read where nothing else answers that; a picture
that it shows is listed.
"""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from typing import Any

from dynsolve.answers.reading.asides import list_unread, picture
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.reports import read_report
from dynsolve.answers.reading.sources import Source, blanked, plain_signs
from dynsolve.errors import Finding

_SILENT = frozenset({"style", "head", "template", "noscript", "title", "del", "s", "strike"})
_SCRIPTS = {"sub": "_{", "sup": "^{"}
"""The tags of indices and powers, as LaTeX opens them."""

_BLOCKS = frozenset("p div br li h1 h2 h3 h4 h5 h6 pre table ul ol section article blockquote hr".split())
_TABLE = {"tr": "\n", "td": " | ", "th": " | "}
"""The tags of a table, as Markdown sets rows and cells apart."""

_BETWEEN_ROWS = frozenset({"table", "thead", "tbody", "tfoot"})
"""Inside which, outside a row, a line's end is none of the text."""

_VOID = frozenset("area base br col embed hr img input link meta source track wbr".split())
_PICTURES = {"equation_image": ("data-equation-content", "alt"), "texrender": ("alt",)}
"""The classes of pictures that Canvas and Moodle make of formulas, and where their LaTeX stands."""

_LONGEST_TAG_STACK = 5_000
_MOST_OPEN = 1_000


def read_page(reader: EquationReader, source: Source) -> None:
    """Read the displayed equations of a web page."""
    page = _WebPage()
    page.feed(_closed(_without_comments(source.text)))
    page.close()
    read_report(reader, Source("".join(page.pieces), source.file, tuple(page.origins) or ((0, 1, 1),)))


def _without_comments(text: str) -> str:
    """The text with blanks for comments; one that never closes ends it."""
    pieces: list[str] = []
    position = 0
    while (start := text.find("<!--", position)) >= 0:
        end = text.find("-->", start)
        pieces.append(text[position:start])
        if end < 0:
            return "".join(pieces)
        pieces.append(blanked(text[start : end + 3]))
        position = end + 3
    return "".join([*pieces, text[position:]])


def _closed(text: str) -> str:
    """The text with blanks for what opens tags that never close: a parser would look for their ends.

    Where more are open than anybody writes, what follows is no text.
    """
    last = text.rfind(">") + 1
    rest = text[last:]
    return text[:last] + ("" if rest.count("<") > _MOST_OPEN else rest.replace("<", " "))


class _WebPage(HTMLParser):
    """Gathers text with its places; what MathJax and KaTeX render is taken from its LaTeX source."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.pieces: list[str] = []
        self.origins: list[tuple[int, int, int]] = []
        self.length = 0
        self.open: list[tuple[str, str]] = []
        self.display = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        classes = given.get("class", "").split()
        kind = ""
        if tag in _SILENT or "katex-html" in classes or tag.startswith("mjx-") or "MathJax" in classes:
            kind = "silent"
        elif tag in ("script", "math"):
            is_tex = tag == "script" and "math/tex" in given.get("type", "")
            kind = "display" if is_tex and "display" in given["type"] else "silent"
        elif tag == "annotation" and given.get("encoding") == "application/x-tex":
            kind = "display" if self.display else "inline"
        if "katex-display" in classes:
            self.display = len(self.open) + 1
        if tag not in _VOID and len(self.open) < _LONGEST_TAG_STACK:
            self.open.append((tag, kind))
        if tag in _BLOCKS:
            self._add(" " if self._in_row else "\n")
        if tag in _TABLE:
            self._add(_TABLE[tag])
        if kind == "display":
            self._add("\n$$")
        if tag in _SCRIPTS and not self._hidden:
            self._add(_SCRIPTS[tag])
        if tag == "img":
            self._picture(classes, given)

    def _picture(self, classes: list[str], given: dict[str, str]) -> None:
        """A formula that an editor has made a picture of: an answer where it stands alone on its line."""
        for place in (place for name in classes for place in _PICTURES.get(name, ())):
            latex = given.get(place, "").removeprefix("LaTeX:").strip()
            if latex:
                self._add(f"\\({latex}\\)")
                return
        if not self._hidden:
            self._add(" ![](picture) ")

    def handle_endtag(self, tag: str) -> None:
        if tag in _SCRIPTS and not self._hidden and any(name == tag for name, _ in self.open[-20:]):
            self._add("}")
        while self.open and any(name == tag for name, _ in self.open[-20:]):
            name, kind = self.open.pop()
            if kind == "display":
                self._add("$$\n")
            if len(self.open) < self.display:
                self.display = 0
            if name == tag:
                break
        if tag in _BLOCKS:
            self._add(" " if self._in_row else "\n")
        elif tag == "tr":
            self._add(" |")

    @property
    def _hidden(self) -> bool:
        """Whether what stands here is not shown, or shown from another source."""
        kinds = [kind for _, kind in self.open if kind]
        return bool(kinds) and kinds[-1] in ("silent", "inline")

    @property
    def _in_row(self) -> bool:
        return any(name == "tr" for name, _ in self.open[-20:])

    @property
    def _in_table(self) -> bool:
        """Whether text here is in a row, or between the rows of a table."""
        return self._in_row or (bool(self.open) and self.open[-1][0] in _BETWEEN_ROWS)

    def handle_data(self, data: str) -> None:
        if not self._hidden:
            self._add(data.replace("\n", " ") if self._in_table else data)

    def _add(self, text: str) -> None:
        line, column = self.getpos()
        self.origins.append((self.length, line, column + 1))
        self.pieces.append(text)
        self.length += len(text)


# Jupyter notebooks: the Markdown cells as one report, its places those of the .ipynb file

MAX_CELLS = 2_000
MAX_LOST = 50
"""After so many lines that are not found in the file as they are no place is looked for."""


def read_notebook(reader: EquationReader, source: Source) -> list[Finding]:
    """Read the Markdown cells of a notebook; gives what is wrong with the file."""
    try:
        content = json.loads(source.text)
    except (ValueError, RecursionError):
        return [
            Finding("this is no notebook: its JSON cannot be read", "save the notebook anew", source.file)
        ]
    read_report(reader, _cells(source, content, "markdown"))
    code = _cells(source, content, "code")
    list_unread(reader, code, code.text, "it stands in code, which is not read", is_code=True)
    if shown := re.search(r'"image/(?:png|jpeg|svg\+xml)"', source.text):
        reader.found.not_recognized.append(picture(reader, shown[0], source.place(shown.start())))
    return []


def _cells(source: Source, content: Any, kind: str) -> Source:
    """The lines of all cells of a kind, each at its place in the file."""
    lines: list[str] = []
    origins: list[tuple[int, int, int]] = []
    offset, position, line = 0, 0, 1
    lost = 0
    for text in _lines(content, kind):
        if text.strip() and lost < MAX_LOST:
            found = source.text.find(json.dumps(text.rstrip("\n"), ensure_ascii=False)[1:-1], position)
            if found < 0:
                found = source.text.find(json.dumps(text.rstrip("\n"))[1:-1], position)
            lost += found < 0
            if found >= 0:
                line += source.text.count("\n", position, found)
                position = found
        column = position - source.text.rfind("\n", 0, position)
        origins.append((offset, line, column))
        lines.append(text)
        offset += len(text)
    return Source("".join(lines), source.file, tuple(origins) or ((0, 1, 1),))


def markdown(text: str) -> str:
    """The Markdown cells of a notebook as one text; nothing of what is no notebook."""
    try:
        return "".join(_lines(json.loads(text), "markdown"))
    except (ValueError, RecursionError):
        return ""


def _lines(content: Any, kind: str) -> list[str]:
    """The lines of all cells of a kind, a blank one between cells."""
    cells = content.get("cells") if isinstance(content, dict) else None
    lines: list[str] = []
    for cell in cells[:MAX_CELLS] if isinstance(cells, list) else ():
        if not isinstance(cell, dict) or cell.get("cell_type") != kind:
            continue
        text = cell.get("source", "")
        if isinstance(text, list):
            text = "".join(part for part in text if isinstance(part, str))
        if isinstance(text, str):
            lines += [*(f"{part}\n" for part in plain_signs(text).split("\n")), "\n"]
    return lines
