"""`dynsolve grade`: a whole course, as it comes out of the learning platform."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

import click

from dynsolve.cli.numbers import Names, quiet_option
from dynsolve.errors import ExitCode

if TYPE_CHECKING:
    from dynsolve.grading.public import Grades

MOST_REFUSED = 20
"""So many files that are not taken are named on the terminal; the report names them all."""


class PlatformName(StrEnum):
    """The learning platforms whose files are written."""

    CANVAS = "canvas"
    MOODLE = "moodle"
    GRADESCOPE = "gradescope"


problems_argument = click.argument(
    "problems",
    help="A problem file, the stem of a bundled one, or a folder of problem files with a set.yaml.",
)
folder_option = click.option(
    "-o",
    "--output",
    metavar="OUT",
    type=click.Path(path_type=Path),
    required=True,
    help="The folder that the results go to.",
)
jobs_option = click.option(
    "-j",
    "--jobs",
    type=click.IntRange(0),
    default=0,
    help="Processes on this machine; 0 for one a core.",
)


@click.command()
@problems_argument
@click.argument(
    "submissions",
    type=click.Path(path_type=Path),
    help="The download of Canvas, Moodle or Gradescope, a folder or its zip; "
    "or a folder with a file or folder a student.",
)
@folder_option
@jobs_option
@click.option(
    "--cluster",
    metavar="ADDRESS",
    default="",
    show_default=False,
    help="A Dask scheduler, tcp://host:8786.",
)
@click.option(
    "--lms",
    type=Names(PlatformName),
    help="Write the file that this platform imports, too; kept for later runs.",
)
@click.option(
    "--roster",
    metavar="CSV",
    type=click.Path(path_type=Path),
    help="The gradebook, worksheet or list of grades that the platform exports; "
    "those of Moodle and Gradescope say who was late, too.",
)
@click.option("--diff", is_flag=True, help="List whose marks are not those of the last run, and why.")
@click.option(
    "--variants",
    metavar="FOLDER",
    type=click.Path(path_type=Path),
    help="What `vary` wrote: each student by his own variant.",
)
@click.option(
    "--timeout",
    type=click.FloatRange(0.1),
    default=20.0,
    help="Seconds of processor time that one hand-in may take.",
)
@click.option(
    "--memory", type=click.IntRange(64), default=1024, help="MiB of memory that one hand-in may take."
)
@quiet_option
def grade(
    problems: str,
    submissions: Path,
    output: Path,
    jobs: int,
    cluster: str,
    lms: PlatformName | None,
    roster: Path | None,
    diff: bool,
    variants: Path | None,
    timeout: float,
    memory: int,
    quiet: bool,
) -> int:
    """Grade everything that was handed in: marks, feedback for each student, a report for the teacher.

    Run again, after a stop or a change, the same command goes on: what is in OUT already
    and has not changed is not computed again.
    """
    from dynsolve.cli.output import bar_or_lines
    from dynsolve.grading.public import grade as grade_all

    try:
        with bar_or_lines("grading", quiet) as advance:
            grades = grade_all(
                problems, submissions, output,
                lms=str(lms) if lms else None, roster=roster, diff=diff,
                jobs=jobs, cluster=cluster, timeout=timeout, memory=memory, progress=advance,
                variants=variants, warn=None if quiet else _warn,
            )  # fmt: skip
    except KeyboardInterrupt:
        click.echo(f"stopped: what is done is kept in {output}; the same command goes on", err=True)
        raise
    for line in grades.changes:
        click.echo(line)
    if not quiet:
        _say(grades)
    return ExitCode.DONE


def _warn(said: str) -> None:
    click.echo(f"warning: {said}", err=True)


def _say(grades: Grades) -> None:
    for refused in grades.refused[:MOST_REFUSED]:
        click.echo(f"refused: {refused.name}: {refused.reason}", err=True)
    if len(grades.refused) > MOST_REFUSED:
        click.echo(f"refused: {len(grades.refused) - MOST_REFUSED} more, which the report names", err=True)
    for warning in grades.warnings:
        _warn(warning)
    done, anew, waiting = grades.computed, grades.remarked, len(grades.queue)
    same = grades.hand_ins - done - anew
    parts = [f"{done} hand-in{'s' if done != 1 else ''} graded"]
    parts += [f"{anew} marked anew"] if anew else []
    parts += [f"{same} as before"] if same else []
    parts += [f"{waiting} {'entry waits' if waiting == 1 else 'entries wait'} for a human"] if waiting else []
    click.echo(f"{', '.join(parts)}: see {grades.folder / 'report.html'}", err=True)
