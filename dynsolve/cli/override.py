"""`dynsolve override`: a teacher's word on the marks of answers."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import typer

from dynsolve.errors import ExitCode, UsageError


def override(
    folder: Annotated[Path, typer.Argument(metavar="OUT", help="The folder of `dynsolve grade`.")],
    student: Annotated[str, typer.Argument(metavar="STUDENT", help="As in grades.csv, or a full name.")] = "",
    problem: Annotated[str, typer.Argument(metavar="PROBLEM", help="As in grades.csv.")] = "",
    answer: Annotated[str, typer.Argument(metavar="ANSWER", help="As in answers.csv.")] = "",
    marks: Annotated[
        str, typer.Option("--marks", metavar="MARKS", help="The marks: 3, 2.5 or 5/2; without, a comment.")
    ] = "",
    why: Annotated[str, typer.Option("--why", help="The reason, which the student reads.")] = "",
    from_: Annotated[
        Path | None,
        typer.Option(
            "--from",
            metavar="CSV",
            help="Many at once: student,problem,answer,marks,comment; OUT/queue.csv is such a page to fill.",
        ),
    ] = None,
) -> int:
    """Set the marks of answers by hand; no regrade changes them."""
    from dynsolve.grading.public import override as override_marks
    from dynsolve.grading.public import override_all

    if from_ is not None:
        if student or marks or why:
            raise UsageError("--from has the students and their marks: give nothing else but OUT")
        count = override_all(folder, from_)
        typer.echo(f"{count} answer{'' if count == 1 else 's'} set by hand", err=True)
        return ExitCode.DONE
    if not (student and problem and answer):
        raise UsageError("name STUDENT, PROBLEM and ANSWER, and say --why; or give a CSV with --from")
    if not why:
        given = ("dynsolve", "override", str(folder), student, problem, answer)
        typed = shlex.join((*given, *(("--marks", marks) if marks else ()), "--why", "right on paper"))
        raise UsageError(f"--why is missing, the reason that the student reads: {typed}")
    override_marks(folder, student, problem, answer, marks=marks or None, why=why)
    typer.echo(f"{student} {problem} {answer}: {marks or 'a comment'}", err=True)
    return ExitCode.DONE
