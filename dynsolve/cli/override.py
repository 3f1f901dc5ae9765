"""`dynsolve override`: a teacher's word on the marks of one answer."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dynsolve.errors import ExitCode


def override(
    folder: Annotated[Path, typer.Argument(metavar="OUT", help="The folder of `dynsolve grade`.")],
    student: Annotated[str, typer.Argument(metavar="STUDENT", help="As in grades.csv.")],
    problem: Annotated[str, typer.Argument(metavar="PROBLEM", help="As in grades.csv.")],
    answer: Annotated[str, typer.Argument(metavar="ANSWER", help="As in answers.csv.")],
    marks: Annotated[str, typer.Option("--marks", metavar="MARKS", help="The marks: 3, 2.5 or 5/2.")],
    why: Annotated[str, typer.Option("--why", help="The reason, which the student reads.")],
) -> int:
    """Set the marks of one answer by hand; no regrade changes them."""
    from dynsolve.grading.public import override as override_marks

    override_marks(folder, student, problem, answer, marks=marks, why=why)
    typer.echo(f"{student} {problem} {answer}: {marks}", err=True)
    return ExitCode.DONE
