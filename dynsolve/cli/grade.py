"""`dynsolve grade`: a whole course, as it comes out of the learning platform."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.numbers import Quiet
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


ProblemsArgument = Annotated[
    str,
    typer.Argument(
        metavar="PROBLEMS",
        help="A problem file, the stem of a bundled one, or a folder of problem files with a set.yaml.",
        show_default=False,
    ),
]
SubmissionsArgument = Annotated[
    Path,
    typer.Argument(
        metavar="SUBMISSIONS",
        help="The download of Canvas, Moodle or Gradescope, a folder or its zip; "
        "or a folder with a file or folder a student.",
        show_default=False,
    ),
]
FolderOption = Annotated[
    Path,
    typer.Option(
        "-o", "--output", metavar="OUT", help="The folder that the results go to.", show_default=False
    ),
]
JobsOption = Annotated[
    int, typer.Option("--jobs", "-j", min=0, help="Processes on this machine; 0 for one a core.")
]
ClusterOption = Annotated[
    str, typer.Option("--cluster", metavar="ADDRESS", help="A Dask scheduler, tcp://host:8786.")
]
PlatformOption = Annotated[
    PlatformName | None,
    typer.Option("--lms", help="Write the file that this platform imports, too; kept for later runs."),
]
RosterOption = Annotated[
    Path | None,
    typer.Option(
        "--roster",
        metavar="CSV",
        help="The gradebook, worksheet or list of grades that the platform exports; "
        "those of Moodle and Gradescope say who was late, too.",
    ),
]
DiffOption = Annotated[
    bool, typer.Option("--diff", help="List whose marks are not those of the last run, and why.")
]
VariantsOption = Annotated[
    Path | None,
    typer.Option("--variants", metavar="FOLDER", help="What `vary` wrote: each student by his own variant."),
]
TimeoutOption = Annotated[
    float, typer.Option("--timeout", min=0.1, help="Seconds of processor time that one hand-in may take.")
]
MemoryOption = Annotated[
    int, typer.Option("--memory", min=64, help="MiB of memory that one hand-in may take.")
]


def grade(
    problems: ProblemsArgument,
    submissions: SubmissionsArgument,
    output: FolderOption,
    jobs: JobsOption = 0,
    cluster: ClusterOption = "",
    lms: PlatformOption = None,
    roster: RosterOption = None,
    diff: DiffOption = False,
    variants: VariantsOption = None,
    timeout: TimeoutOption = 20.0,
    memory: MemoryOption = 1024,
    quiet: Quiet = False,
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
        typer.echo(f"stopped: what is done is kept in {output}; the same command goes on", err=True)
        raise
    for line in grades.changes:
        typer.echo(line)
    if not quiet:
        _say(grades)
    return ExitCode.DONE


def _warn(said: str) -> None:
    typer.echo(f"warning: {said}", err=True)


def _say(grades: Grades) -> None:
    for refused in grades.refused[:MOST_REFUSED]:
        typer.echo(f"refused: {refused.name}: {refused.reason}", err=True)
    if len(grades.refused) > MOST_REFUSED:
        typer.echo(f"refused: {len(grades.refused) - MOST_REFUSED} more, which the report names", err=True)
    for warning in grades.warnings:
        _warn(warning)
    done, anew, waiting = grades.computed, grades.remarked, len(grades.queue)
    same = grades.hand_ins - done - anew
    parts = [f"{done} hand-in{'s' if done != 1 else ''} graded"]
    parts += [f"{anew} marked anew"] if anew else []
    parts += [f"{same} as before"] if same else []
    parts += [f"{waiting} {'entry waits' if waiting == 1 else 'entries wait'} for a human"] if waiting else []
    typer.echo(f"{', '.join(parts)}: see {grades.folder / 'report.html'}", err=True)
