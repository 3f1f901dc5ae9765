"""`dynsolve check`: verdicts on what a student handed in, the first slip first."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.common import STDIN, Quiet, print_json, read, say, standard_input
from dynsolve.errors import ExitCode, Finding, InputError

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
    from dynsolve.answers.sandbox import check_file

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
    from pathlib import Path

    if answer == STDIN:
        return standard_input(), "<stdin>.yaml"
    try:
        return Path(answer).read_bytes(), answer
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            [Finding(f"the file cannot be read: {reason.lower()}", "check the path", answer)]
        ) from None


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
        from dynsolve.cli.page import print_document

        print_document(document, style)
