"""Jupyter notebooks: the Markdown cells as one report, its places those of the .ipynb file.

Code is never run; what it says of an answer is listed, or read where nothing else answers that; a picture
that it shows is listed.
"""

from __future__ import annotations

import json
import re
from typing import Any

from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.reports import read_report
from dynsolve.answers.reading.sources import Source, plain_signs
from dynsolve.answers.reading.unread_text import list_unread, picture
from dynsolve.errors import Finding

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
