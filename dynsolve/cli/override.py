"""`dynsolve override`: a teacher's word on the marks of one answer."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.grade import opened
from dynsolve.errors import ExitCode, UsageError

if TYPE_CHECKING:
    from fractions import Fraction

    from dynsolve.grading.record import Record


def override(
    folder: Annotated[Path, typer.Argument(metavar="OUT", help="The folder of `dynsolve grade`.")],
    student: Annotated[str, typer.Argument(metavar="STUDENT", help="As in grades.csv.")],
    problem: Annotated[str, typer.Argument(metavar="PROBLEM", help="As in grades.csv.")],
    answer: Annotated[str, typer.Argument(metavar="ANSWER", help="As in answers.csv.")],
    marks: Annotated[str, typer.Option("--marks", metavar="MARKS", help="The marks: 3, 2.5 or 5/2.")],
    why: Annotated[str, typer.Option("--why", help="The reason, which the student reads.")],
) -> int:
    """Set the marks of one answer by hand; no regrade changes them."""
    from dynsolve.grading.outputs import write_outputs
    from dynsolve.grading.policy import shown
    from dynsolve.grading.stored import stored_set

    with opened(folder, new=False) as record:
        problems = stored_set(record)
        points = _points(record, student, problem, answer, marks)
        if not why.strip():
            raise UsageError("--why says nothing: the student reads it")
        record.override(student, problem, answer, str(points), " ".join(why.split()))
        write_outputs(folder, problems, record)
        record.finish()
    typer.echo(f"{student} {problem} {answer}: {shown(points)}", err=True)
    return ExitCode.DONE


def _points(record: Record, student: str, problem: str, answer: str, marks: str) -> Fraction:
    from fractions import Fraction

    found = {(a.problem, a.answer): a for a in record.answers(student)}
    if not found:
        raise UsageError(f"there is no student `{student}` in grades.csv")
    if (problem, answer) not in found:
        known = ", ".join(f"{p} {a}" for p, a in found)
        raise UsageError(f"{student} has no answer `{answer}` to `{problem}`; there are {known}")
    try:
        points = Fraction(marks)
    except (ValueError, ZeroDivisionError):
        raise UsageError(f"--marks {marks} is no number: write 3, 2.5 or 5/2") from None
    of = Fraction(found[problem, answer].of)
    if not 0 <= points <= of:
        raise UsageError(f"{answer} has {of} marks: --marks is from 0 to {of}")
    return points
