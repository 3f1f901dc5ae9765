"""Where results go and in which form: one rule for every form of output.

The suffix of `-o FILE` says the form; `--format`, or `--latex` and its like, says it
where there is none.  Without `-o` results go to standard output.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from dynsolve.cli.common import STDIN
from dynsolve.errors import UsageError
from dynsolve.render.files import check_place, write_whole
from dynsolve.render.formats import SUFFIXES, Format, suffix_of

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


@dataclass(frozen=True, slots=True)
class Output:
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


def chosen(
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
    suffix = SUFFIXES.get(path.suffix.lower()) if path is not None and not is_folder else None
    if path is not None and not asked and suffix is None:
        raise UsageError(
            f"which form is {output} to have? Say it with --format, or by its suffix: {_suffixes()}"
        )
    form = next(iter(asked), None) or suffix or Format.TEXT
    if suffix not in (None, form):
        raise UsageError(f"{output} is named as {suffix}, but {form} is asked for")
    chosen = Output(form, path, is_folder)
    _check(chosen, problems)
    return chosen


def _suffixes() -> str:
    return ", ".join(suffix_of(form) for form in Format)


def _check(output: Output, problems: Sequence[str]) -> None:
    if output.path is None:
        if output.format is Format.PDF and sys.stdout.isatty():
            raise UsageError("PDF is nothing for a terminal: give -o FILE.pdf")
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
            sys.stdout.flush()
            sys.stdout.buffer.write(data)
            sys.stdout.flush()
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
