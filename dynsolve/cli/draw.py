"""`dynsolve draw`: the picture of a manipulator."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dynsolve.cli.common import Quiet, read, say
from dynsolve.cli.output import format_of, refuse_on_terminal, write_to_standard_output
from dynsolve.draw import SUFFIXES, PictureFormat
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
    """Draw a manipulator from its Denavit-Hartenberg table, or bodies from their positions.

    Joints, links, frames, lengths, joint variables, mass centres and gravity, at a
    pose where they can be seen; not to scale. SVG goes to standard output.
    """
    path = None if output in (None, "-") else Path(str(output))
    if path is not None:
        form = format_of(str(path), path.suffix, SUFFIXES, format)
        check_place(path)
    else:
        form = format or PictureFormat.SVG
        if form in (PictureFormat.PDF, PictureFormat.PNG):
            refuse_on_terminal(form)
    from dynsolve.draw import draw as draw_problem

    loaded = read(problem)
    if not quiet:
        say(loaded.warnings, "warning")
    data = draw_problem(loaded, form, star=star)
    if path is not None:
        write_whole(path, data)
    else:
        write_to_standard_output(data)
