"""`dynsolve grade`: a whole course, as it comes out of the learning platform."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.common import Quiet
from dynsolve.errors import ExitCode, UsageError

if TYPE_CHECKING:
    from dynsolve.grading.run import Done, Pool

EVERY = 10.0
"""Seconds between two lines of progress where there is no terminal."""


class Platform(StrEnum):
    """The learning platforms whose files are written."""

    CANVAS = "canvas"
    MOODLE = "moodle"
    GRADESCOPE = "gradescope"


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
            help="The download of Canvas, Moodle or Gradescope, a folder or its zip; "
            "or a folder with a file or folder a student.",
        ),
    ],
    output: Annotated[
        Path,
        typer.Option("-o", "--output", metavar="OUT", help="The folder that the results go to."),
    ],
    jobs: Annotated[
        int, typer.Option("--jobs", "-j", min=0, help="Processes on this machine; 0 for one a core.")
    ] = 0,
    cluster: Annotated[
        str, typer.Option("--cluster", metavar="ADDRESS", help="A Dask scheduler, tcp://host:8786.")
    ] = "",
    lms: Annotated[
        Platform | None, typer.Option("--lms", help="Write the file that this platform imports, too.")
    ] = None,
    roster: Annotated[
        Path | None,
        typer.Option("--roster", metavar="CSV", help="The gradebook or worksheet that the platform exports."),
    ] = None,
    diff: Annotated[
        bool, typer.Option("--diff", help="List whose marks are not those of the last run, and why.")
    ] = False,
    timeout: Annotated[
        float, typer.Option("--timeout", min=0.1, help="Seconds of processor time that one hand-in may take.")
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

    bounds = Bounds(timeout, memory << 20)

    def pool() -> Pool:
        if cluster:
            from dynsolve.grading.cluster import ClusterPool

            return ClusterPool(cluster, bounds)
        return LocalPool(jobs or os.cpu_count() or 1, bounds)

    if lms in (Platform.CANVAS, Platform.MOODLE) and roster is None:
        raise UsageError(f"--lms {lms} needs --roster, the CSV that {str(lms).capitalize()} exports")
    return _run(problems, submissions, output, pool, lms, roster, diff, quiet)


def _run(
    name: str,
    submissions: Path,
    folder: Path,
    make_pool: Callable[[], Pool],
    lms: Platform | None,
    roster: Path | None,
    diff: bool,
    quiet: bool,
) -> int:
    from dynsolve.grading.changes import changes
    from dynsolve.grading.exports import export, read_roster
    from dynsolve.grading.hand_ins import take_in
    from dynsolve.grading.outputs import write_outputs
    from dynsolve.grading.problem_set import load_set
    from dynsolve.grading.run import grade_all
    from dynsolve.grading.stored import store_set
    from dynsolve.grading.uploads import Uploads

    problems = load_set(name)
    if roster is not None and lms is not None:
        read_roster(roster, lms)
    uploads = Uploads(submissions)
    with opened(folder) as record:
        pool = make_pool()
        try:
            intake = take_in(problems, uploads)
            store_set(record, problems)
            with _progress(quiet) as advance:
                done = grade_all(problems, uploads, intake, record, pool, advance)
        except KeyboardInterrupt:
            typer.echo(f"stopped: what is done is kept in {folder}; the same command goes on", err=True)
            raise
        finally:
            pool.close()
            uploads.close()
        write_outputs(folder, problems, record)
        warnings = export(lms, folder, problems, record, roster) if lms is not None else ()
        if diff:
            for line in changes(record):
                typer.echo(line)
        record.finish()
        if not quiet:
            for refused in uploads.refused:
                typer.echo(f"refused: {refused.name}: {refused.reason}", err=True)
            for warning in warnings:
                typer.echo(f"warning: {warning}", err=True)
            _say(folder, done, len(intake.waiting))
    return ExitCode.DONE


@contextmanager
def opened(folder: Path, new: bool = True) -> Iterator[Record]:
    """The record of a folder; a full disk and the like become a message that says how to go on."""
    import sqlite3

    from dynsolve.grading.record import FILE, Record

    if not new and not (folder / FILE).is_file():
        raise UsageError(f"there is no {FILE} in {folder}: `dynsolve grade` makes it")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        record = Record(folder)
        try:
            yield record
        finally:
            record.close()
    except (sqlite3.Error, OSError) as error:
        said = getattr(error, "strerror", None) or str(error)
        file = getattr(error, "filename", None)
        what = f"writing to {folder} failed: {said.lower()}" + (f" ({file})" if file else "")
        raise UsageError(f"{what}; what is done is kept, and the same command goes on") from error


@contextmanager
def _progress(quiet: bool) -> Iterator[Callable[[int, int], None] | None]:
    """A bar on a terminal; elsewhere a line now and then, with an estimate of what is left."""
    import sys

    from dynsolve.cli.progress import progress

    if sys.stderr.isatty() or quiet:
        with progress("grading", quiet) as advance:
            yield advance
        return
    start = said = time.monotonic()

    def line(done: int, of: int) -> None:
        nonlocal said
        now = time.monotonic()
        if now - said > EVERY:
            said = now
            left = (now - start) / done * (of - done)
            typer.echo(f"{done} of {of}, about {left:.0f} s left", err=True)

    yield line


def _say(folder: Path, done: Done, waiting: int) -> None:
    same = done.hand_ins - done.computed
    parts = [f"{done.computed} hand-in{'s' if done.computed != 1 else ''} graded"]
    parts += [f"{same} as before"] if same else []
    parts += [f"{waiting} files wait for a human"] if waiting else []
    typer.echo(f"{', '.join(parts)}: see {folder / 'report.html'}", err=True)


if TYPE_CHECKING:
    from dynsolve.grading.record import Record
