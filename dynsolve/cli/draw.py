"""`dynsolve draw`: the picture of a manipulator."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from dynsolve.cli.common import Quiet, read, say
from dynsolve.draw import SUFFIXES, PictureFormat
from dynsolve.errors import UsageError
from dynsolve.render.files import check_place, write_whole


def draw(
    problem: Annotated[
        str,
        typer.Argument(
            metavar="PROBLEM",
            help="A problem file, the stem of a bundled problem, or - for standard input.",
            show_default=False,
        ),
    ],
    output: Annotated[
        str | None,
        typer.Option(
            "--output", "-o", metavar="FILE", help="Write to a file: .svg, .pdf, .png, or .tex to be input."
        ),
    ] = None,
    format: Annotated[
        PictureFormat | None,
        typer.Option("--format", help="The form, where the suffix of -o does not say it; else SVG."),
    ] = None,
    star: Annotated[
        bool, typer.Option("--star/--no-star", help="Mark the joint variables with a star.")
    ] = True,
    quiet: Quiet = False,
) -> None:
    """Draw a manipulator from its Denavit-Hartenberg table.

    Joints, links, frames, lengths, joint variables, mass centres and gravity, at a
    pose where they can be seen; not to scale. SVG goes to standard output.
    """
    path = None if output in (None, "-") else Path(str(output))
    form = _form(path, format)
    if path is not None:
        check_place(path)
    elif form in (PictureFormat.PDF, PictureFormat.PNG) and sys.stdout.isatty():
        raise UsageError(f"{form.upper()} is nothing for a terminal: give -o FILE.{form}")
    from dynsolve.draw import draw as draw_problem

    loaded = read(problem)
    if not quiet:
        say(loaded.warnings, "warning")
    data = draw_problem(loaded, form, star=star)
    if path is not None:
        write_whole(path, data)
        return
    sys.stdout.flush()
    sys.stdout.buffer.write(data)
    sys.stdout.flush()


def _form(path: Path | None, format: PictureFormat | None) -> PictureFormat:
    """The form that the options ask for.  Raises UsageError where they contradict each other."""
    if path is None:
        return format or PictureFormat.SVG
    suffix = SUFFIXES.get(path.suffix.lower())
    if suffix is None and format is None:
        raise UsageError(
            f"which form is {path} to have? Say it with --format, or by its suffix: {', '.join(SUFFIXES)}"
        )
    if suffix is not None and format not in (None, suffix):
        raise UsageError(f"{path} is named as {suffix}, but {format} is asked for")
    return format or suffix or PictureFormat.SVG
