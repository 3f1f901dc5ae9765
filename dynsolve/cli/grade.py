"""`dynsolve grade`: a whole course, as it comes out of the learning platform."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.common import Quiet
from dynsolve.errors import ExitCode

if TYPE_CHECKING:
    from dynsolve.grading.run import Done, Pool


def grade(
    problems: Annotated[
        str,
        typer.Argument(
            metavar="PROBLEMS",
            help="A problem file, the stem of a bundled one, or a folder of problem files with a set.yaml.",
        ),
    ],
    submissions: Annotated[
        Path,
        typer.Argument(
            metavar="SUBMISSIONS",
            help="The download of Canvas, Moodle or Gradescope, a folder or its zip; or a file or folder a student.",
        ),
    ],
    output: Annotated[
        Path,
        typer.Option("-o", "--output", metavar="OUT", help="The folder that the results go to."),
    ],
    jobs: Annotated[
        int, typer.Option("--jobs", "-j", min=0, help="Processes on this machine; 0 for one a core.")
    ] = 0,
    timeout: Annotated[
        float, typer.Option("--timeout", min=0.1, help="Seconds that one hand-in may take.")
    ] = 20.0,
    memory: Annotated[
        int, typer.Option("--memory", min=64, help="MiB of memory that one hand-in may take.")
    ] = 1024,
    quiet: Quiet = False,
) -> int:
    """Grade everything that was handed in: marks, feedback for each student, a report for the teacher.

    Run again, after a stop or a change, the same command goes on: what is in OUT already
    and has not changed is not computed again.
    """
    import os

    from dynsolve.grading.pool import Bounds, LocalPool

    pool = LocalPool(jobs or os.cpu_count() or 1, Bounds(timeout, memory << 20))
    return _run(problems, submissions, output, pool, quiet)


def _run(name: str, submissions: Path, folder: Path, pool: Pool, quiet: bool) -> int:
    from dynsolve.grading.hand_ins import take_in
    from dynsolve.grading.outputs import write_outputs
    from dynsolve.grading.problem_set import load_set
    from dynsolve.grading.record import Record
    from dynsolve.grading.run import grade_all
    from dynsolve.grading.uploads import Uploads

    problems = load_set(name)
    uploads = Uploads(submissions)
    folder.mkdir(parents=True, exist_ok=True)
    record = Record(folder)
    try:
        intake = take_in(problems, uploads)
        done = grade_all(problems, uploads, intake, record, pool)
        write_outputs(folder, problems, record)
        record.finish()
    finally:
        pool.close()
        record.close()
        uploads.close()
    if not quiet:
        _say(folder, done)
    return ExitCode.DONE


def _say(folder: Path, done: Done) -> None:
    same = done.hand_ins - done.computed
    kept = f", {same} as before" if same else ""
    typer.echo(f"{done.computed} hand-ins graded{kept}: see {folder / 'report.html'}", err=True)
