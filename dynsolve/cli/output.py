"""The place and the format of results: one rule for all of them; documents and progress on a terminal.

The suffix of `-o FILE` says the form; `--format`, or `--latex` and its like, says it
where there is none.  Without `-o` results go to standard output: a document laid out to the
terminal, coloured only where there is one.  Progress goes to standard error: a bar where there is
a terminal and it takes longer than a second.
"""

from __future__ import annotations

import os
import shutil
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer
from msgspec import Struct

from dynsolve.cli.numbers import STDIN
from dynsolve.errors import UsageError
from dynsolve.render.files import SUFFIXES, Format, check_place, suffix_of, write_whole

if TYPE_CHECKING:
    from rich.progress import Progress

    from dynsolve.document import Document
    from dynsolve.notation.printing import Style


Form = TypeVar("Form", bound=StrEnum)
"""The forms of a solution, or those of a picture."""

JOINED = (Format.TEXT, Format.JSON)
"""Forms of which one file may hold several."""

FormatOption = Annotated[
    Format | None,
    typer.Option("--format", help="The form, where the suffix of -o does not say it."),
]
OutputOption = Annotated[
    str | None,
    typer.Option(
        "--output",
        "-o",
        metavar="FILE",
        help="Write to a file (.tex, .pdf, .html, .md, .json, .txt), or for each problem into a folder.",
    ),
]


class Output(Struct, frozen=True):
    """A form and a place; no place is standard output."""

    format: Format
    path: Path | None
    is_folder: bool = False

    def place_of(self, problem: str) -> Path | None:
        """Where the report of one problem goes."""
        if self.path is None or not self.is_folder:
            return self.path
        stem = "stdin" if problem == STDIN else Path(problem).stem
        return self.path / f"{stem}{suffix_of(self.format)}"


def chosen_output(
    format: Format | None,
    short: Sequence[Format],
    output: str | None,
    problems: Sequence[str],
    fragment: bool,
) -> Output:
    """The form and the place that the options ask for.

    Raises UsageError where they contradict each other, or the place cannot be written.
    """
    asked = {*short, *([format] if format else [])}
    if fragment:
        asked.add(Format.LATEX)
    if len(asked) > 1:
        raise UsageError(f"one form at a time, not {' and '.join(sorted(asked))}")
    path = None if output in (None, "-") else Path(str(output))
    is_folder = path is not None and (path.is_dir() or str(output).endswith(("/", "\\")))
    suffix = "" if path is None or is_folder else path.suffix
    form = next(iter(asked), None)
    if path is not None:
        form = format_of(str(output), suffix, SUFFIXES, form)
    chosen = Output(form or Format.TEXT, path, is_folder)
    _check(chosen, problems)
    return chosen


def format_of(place: str, suffix: str, suffixes: Mapping[str, Form], asked: Form | None) -> Form:
    """The form of a file: the one that is asked for, or else that its suffix says.

    Raises UsageError where neither says it, or they contradict each other.
    """
    named = suffixes.get(suffix.lower())
    form = asked or named
    if form is None:
        usual: dict[Form, str] = {}
        for known, of in suffixes.items():
            usual.setdefault(of, known)
        listed = ", ".join(usual.values())
        raise UsageError(f"which form is {place} to have? Say it with --format, or by its suffix: {listed}")
    if named not in (None, form):
        raise UsageError(f"{place} is named as {named}, but {form} is asked for")
    return form


def refuse_on_terminal(form: str) -> None:
    """Raise UsageError where a form that is no text would go to a terminal."""
    if sys.stdout.isatty():
        raise UsageError(f"{form.upper()} is nothing for a terminal: give -o FILE.{form}")


def write_to_standard_output(data: bytes) -> None:
    """Write bytes after whatever text was written before."""
    sys.stdout.flush()
    sys.stdout.buffer.write(data)
    sys.stdout.flush()


def _check(output: Output, problems: Sequence[str]) -> None:
    if output.path is None:
        if output.format is Format.PDF:
            refuse_on_terminal(output.format)
        if len(problems) > 1 and output.format not in JOINED:
            raise UsageError(f"one {output.format} report a problem: give a folder, -o FOLDER/")
        return
    if not output.is_folder:
        if len(problems) > 1 and output.format not in JOINED:
            raise UsageError(f"one {output.format} report a problem: give a folder, not {output.path}")
        check_place(output.path)
        return
    try:
        output.path.mkdir(exist_ok=True)
    except OSError as error:
        raise UsageError(f"{output.path} cannot be made: {(error.strerror or str(error)).lower()}") from None
    places = [str(output.place_of(problem)) for problem in problems]
    if len(set(places)) < len(places):
        raise UsageError("two of the problems would be written to one file")


class Writer:
    """Takes reports as they are made, and writes each place once, whole."""

    def __init__(self, output: Output) -> None:
        self.output = output
        self._parts: dict[Path, list[bytes]] = {}

    def write(self, problem: str, data: bytes) -> None:
        """A report of a problem."""
        place = self.output.place_of(problem)
        if place is None:
            write_to_standard_output(data)
        else:
            self._parts.setdefault(place, []).append(data)
            if self.output.is_folder:
                self.close()

    def close(self) -> None:
        """Write what is left."""
        for place, parts in self._parts.items():
            between = b"\n" if self.output.format is Format.TEXT else b""
            write_whole(place, between.join(parts))
        self._parts = {}


_COLOURS = {"title": "bold", "heading": "bold cyan", "step": "bold", "note": "yellow", "source": "dim"}


def print_document(document: Document, style: Style) -> None:
    """Print a document as wide as the terminal, or as COLUMNS says; in a pipe it is plain text."""
    from dynsolve.render.terminal import WIDTH, render

    lines = render(document, shutil.get_terminal_size((WIDTH, 24)).columns, style)
    if not sys.stdout.isatty() or os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        for line in lines:
            sys.stdout.write(line.text + "\n")
        return
    from rich.console import Console
    from rich.text import Text

    console = Console(soft_wrap=True, highlight=False)
    for line in lines:
        console.print(Text(line.text, _COLOURS.get(line.kind, "")))


PATIENCE = 1.0
"""Seconds without a bar."""

EVERY = 10.0
"""Seconds between two lines of progress where there is no terminal."""

Advance = Callable[[int, int], None]
"""advance(done, of)"""


@contextmanager
def progress(title: str, quiet: bool = False) -> Iterator[Advance | None]:
    """Give a function that is told how far the work is, None where nobody would see it."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    start, shown = time.monotonic(), _Bar(title)

    def advance(done: int, of: int) -> None:
        if time.monotonic() - start > PATIENCE:
            shown.update(done, of)

    try:
        yield advance
    finally:
        shown.close()


@contextmanager
def bar_or_lines(title: str, quiet: bool = False) -> Iterator[Advance | None]:
    """A bar on a terminal; elsewhere a line now and then, with an estimate of what is left."""
    if sys.stderr.isatty() or quiet:
        with progress(title, quiet) as advance:
            yield advance
        return
    said = time.monotonic()
    first, since = 0, said  # what was done when it was first told: before it there were preparations

    def line(done: int, of: int) -> None:
        nonlocal said, first, since
        now = time.monotonic()
        if not first:
            first, since = done, now
        elif now - said > EVERY:
            said = now
            left = (now - since) / (done - first) * (of - done)
            typer.echo(f"{done} of {of}, about {left:.0f} s left", err=True)

    yield line


class _Bar:
    """The bar, made when it is first wanted: importing it costs time too."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._bar: Progress | None = None

    def update(self, done: int, of: int) -> None:
        if self._bar is None:
            from rich.console import Console
            from rich.markup import escape
            from rich.progress import Progress

            self._bar = Progress(console=Console(stderr=True), transient=True)
            self._bar.add_task(escape(self._title), total=of)
            self._bar.start()
        self._bar.update(self._bar.task_ids[0], completed=done, total=of)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.stop()
