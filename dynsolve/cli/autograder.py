"""`dynsolve autograder`: the zip that makes Gradescope run dynsolve."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dynsolve.errors import ExitCode


def autograder(
    problems: Annotated[
        str,
        typer.Argument(
            metavar="PROBLEMS",
            help="A problem file, the stem of a bundled one, or a folder of problem files with a set.yaml.",
            show_default=False,
        ),
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="ZIP", help="The zip that is written.")
    ] = Path("autograder.zip"),
) -> int:
    """Make an autograder for Gradescope, which marks every submission when it is handed in.

    Upload the zip in the assignment's Configure Autograder. Python 3.11 or newer is installed there
    where it is missing.
    """
    from dynsolve.grading.autograder.package import write_autograder

    write_autograder(problems, output)
    typer.echo(f"{output}: upload it to the programming assignment, under Configure Autograder", err=True)
    return ExitCode.DONE
