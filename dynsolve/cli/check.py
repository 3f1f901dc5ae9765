"""`dynsolve check`: verdicts on what a student handed in, the first slip first.

`dynsolve override`: a teacher's word on the marks of answers.

`dynsolve autograder`: the zip that makes Gradescope run dynsolve.

`dynsolve draw`: the picture of a manipulator.
"""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.grade import ProblemsArgument
from dynsolve.cli.numbers import STDIN, Quiet, print_json, read, say, standard_input
from dynsolve.cli.output import format_of, refuse_on_terminal, write_to_standard_output
from dynsolve.draw import SUFFIXES, PictureFormat
from dynsolve.errors import ExitCode, Finding, InputError, UsageError
from dynsolve.render.files import check_place, write_whole

if TYPE_CHECKING:
    from dynsolve.answers.feedback import FeedbackView
    from dynsolve.answers.verdict import Report
    from dynsolve.problem import Problem


def check(
    problem: Annotated[
        str, typer.Argument(metavar="PROBLEM", help="A problem file, or the stem of a bundled one.")
    ],
    answer: Annotated[
        str,
        typer.Argument(
            metavar="ANSWER",
            help="An answer file (.yaml, .json) or report (.md, .tex, .ipynb, .html); - for standard input.",
        ),
    ],
    json: Annotated[bool, typer.Option("--json", help="JSON with everything.")] = False,
    html: Annotated[bool, typer.Option("--html", help="The report as an HTML page.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="The report in Markdown.")] = False,
    hints: Annotated[
        int,
        typer.Option(min=1, max=3, help="How much a student is told: 1 where, 2 what kind of slip, 3 how."),
    ] = 3,
    teacher: Annotated[bool, typer.Option("--teacher", help="Everything, with the differences.")] = False,
    show_reading: Annotated[
        bool, typer.Option("--show-reading", help="Show how every answer was read, correct ones too.")
    ] = False,
    quiet: Quiet = False,
) -> int:
    """Check a hand-in: correct, following from an earlier slip, or wrong, and which slip it is.

    Ends with 0 where every answer is correct, with 1 otherwise, with 2 where there
    is nothing to read.
    """
    from dynsolve.answers.judge import Checker
    from dynsolve.answers.limits import check_file

    stated = read(problem)
    if not quiet:
        say(stated.warnings, "warning")
    source, file = _source(answer)
    report = check_file(Checker(stated), source, file)
    if not quiet:
        say(report.faults)
    if json:
        from dynsolve.answers.report import to_json

        print_json(to_json(report, level=hints, teacher=teacher))
    else:
        from dynsolve.answers.feedback import FeedbackView

        _print_report(report, stated, FeedbackView(hints, teacher, show_reading), html, markdown)
    if not quiet:
        from dynsolve.answers.feedback import findings

        say(findings(report))
    if report.none_read:
        return ExitCode.USAGE
    return ExitCode.DONE if report.all_correct else ExitCode.FALLS_SHORT


def _source(answer: str) -> tuple[bytes, str]:
    """The bytes of an answer and the name that says how it is read."""
    if answer == STDIN:
        return standard_input(), "<stdin>.yaml"
    try:
        return Path(answer).read_bytes(), answer
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        message = f"the file cannot be read: {reason.lower()}"
        raise InputError([Finding(message, "check the path", answer)]) from None


def _print_report(report: Report, problem: Problem, view: FeedbackView, html: bool, markdown: bool) -> None:
    from dynsolve.answers.feedback import feedback
    from dynsolve.explain.context import style_of

    document = feedback(report, f"{problem.title}: {report.student or report.file or 'answers'}", view)
    style = style_of(problem.robot)
    if html:
        from dynsolve.render.html import render as render_html

        typer.echo(render_html(document, style))
    elif markdown:
        from dynsolve.render.markdown import render as render_markdown

        typer.echo(render_markdown(document, style))
    else:
        from dynsolve.cli.output import print_document

        print_document(document, style)


# `dynsolve override`: a teacher's word on the marks of answers


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


# `dynsolve autograder`: the zip that makes Gradescope run dynsolve


def autograder(
    problems: ProblemsArgument,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="ZIP", help="The zip that is written.")
    ] = Path("autograder.zip"),
) -> int:
    """Make an autograder for Gradescope, which marks every submission when it is handed in.

    Upload the zip in the assignment's Configure Autograder. Python 3.11 or newer is installed there
    where it is missing.
    """
    from dynsolve.grading.autograder import write_autograder

    write_autograder(problems, output)
    typer.echo(f"{output}: upload it to the programming assignment, under Configure Autograder", err=True)
    return ExitCode.DONE


# `dynsolve draw`: the picture of a manipulator


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
