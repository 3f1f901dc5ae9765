"""Documents on standard output: laid out to the terminal, coloured only where there is one."""

from __future__ import annotations

import os
import shutil
import sys

from dynsolve.document import Document
from dynsolve.notation.printing import Style
from dynsolve.render.terminal import WIDTH, render

_COLOURS = {"title": "bold", "heading": "bold cyan", "step": "bold", "note": "yellow", "source": "dim"}


def print_document(document: Document, style: Style) -> None:
    """Print a document; in a pipe it is plain text."""
    columns = _columns()
    if not _coloured():
        for line in render(document, columns, style):
            sys.stdout.write(line.text + "\n")
        return
    from rich.console import Console
    from rich.text import Text

    console = Console(soft_wrap=True, highlight=False)
    for line in render(document, columns, style):
        console.print(Text(line.text, _COLOURS.get(line.kind, "")))


def _columns() -> int:
    """The terminal's width; in a pipe COLUMNS, or else a width of our own."""
    return shutil.get_terminal_size((WIDTH, 24)).columns


def _coloured() -> bool:
    return sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
