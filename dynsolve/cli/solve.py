"""`dynsolve solve`: the whole derivation, in a terminal, as a report, or as JSON."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.common import Problems, Quiet, read, say
from dynsolve.cli.hint import print_hint
from dynsolve.cli.numbers import AtOption, DigitsOption, SetOption, with_numbers
from dynsolve.cli.output import FormatOption, Output, OutputOption, Writer
from dynsolve.cli.output import chosen as chosen_output
from dynsolve.errors import ExitCode, ProblemError
from dynsolve.render.formats import Format

if TYPE_CHECKING:
    from dynsolve.solution import Solution


class DetailName(StrEnum):
    """How much is shown."""

    BRIEF = "brief"
    NORMAL = "normal"
    FULL = "full"


class StageName(StrEnum):
    """A part of the derivation."""

    KINEMATICS = "kinematics"
    JACOBIAN = "jacobian"
    INERTIA = "inertia"
    ENERGY = "energy"
    LAGRANGIAN = "lagrangian"
    TORQUE = "torque"
    VECTORIZED = "vectorized"


class AbbreviateName(StrEnum):
    """Whether long results are written in names."""

    AUTO = "auto"
    NEVER = "never"
    ALWAYS = "always"


def solve(
    problem: Problems,
    json: Annotated[bool, typer.Option("--json", help="JSON with everything, one object a line.")] = False,
    stage: Annotated[
        list[StageName] | None,
        typer.Option(metavar="STAGE", help="Show this stage alone; may be given more than once."),
    ] = None,
    first: Annotated[
        StageName | None, typer.Option("--from", metavar="STAGE", help="Show from this stage on.")
    ] = None,
    last: Annotated[
        StageName | None, typer.Option("--to", metavar="STAGE", help="Show up to this stage.")
    ] = None,
    detail: Annotated[DetailName, typer.Option(help="How much is shown.")] = DetailName.NORMAL,
    output: OutputOption = None,
    format: FormatOption = None,
    latex: Annotated[bool, typer.Option("--latex", help="A LaTeX document.")] = False,
    fragment: Annotated[
        bool, typer.Option("--fragment", help="LaTeX for another document's \\input.")
    ] = False,
    pdf: Annotated[bool, typer.Option("--pdf", help="PDF, without TeX; needs the extra [pdf].")] = False,
    html: Annotated[bool, typer.Option("--html", help="One HTML file that needs no network.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Markdown for GitHub and Jupyter.")] = False,
    star: Annotated[
        bool, typer.Option("--star", help="Mark joint variables with a star everywhere.")
    ] = False,
    abbreviate: Annotated[
        AbbreviateName, typer.Option(help="Write long results in names, which are defined first.")
    ] = AbbreviateName.AUTO,
    set_: SetOption = None,
    at: AtOption = None,
    digits: DigitsOption = None,
    hint: Annotated[
        StageName | None,
        typer.Option(metavar="STAGE", help="What to do in this stage, without its result or a later one."),
    ] = None,
    quiet: Quiet = False,
) -> int:
    """Derive a robot's dynamics step by step, verified.

    The stages, in order: kinematics, jacobian, inertia, energy, lagrangian, torque,
    vectorized. A robot without masses ends with the Jacobian.
    """
    stages = _chosen(stage, first, last)
    short = {
        Format.JSON: json,
        Format.LATEX: latex,
        Format.PDF: pdf,
        Format.HTML: html,
        Format.MARKDOWN: markdown,
    }
    asked = [form for form, is_asked in short.items() if is_asked]
    place_and_form = chosen_output(format, asked, output, problem, fragment)
    writer = Writer(place_and_form)
    code = ExitCode.DONE
    for place, name in enumerate(problem):
        try:
            solution = with_numbers(_solved(name, quiet), set_, at, digits)
        except ProblemError as error:
            if len(problem) == 1:
                raise
            say(error.findings)
            code = ExitCode.USAGE
            continue
        if not quiet:
            say(solution.warnings, "warning")
            say(solution.numbers.warnings if solution.numbers else (), "warning")
        if hint:
            print_hint(solution, hint.value)
        elif place_and_form == Output(Format.TEXT, None):
            _print_document(solution, detail, stages, star, abbreviate, place > 0)
        elif place_and_form == Output(Format.JSON, None):
            _print_json(solution, abbreviate)
        else:
            writer.write(name, _report(solution, place_and_form, detail, stages, star, abbreviate, fragment))
    writer.close()
    return code


def _chosen(
    stage: list[StageName] | None, first: StageName | None, last: StageName | None
) -> list[str] | None:
    """The stages that are shown, None for all."""
    order = list(StageName)
    if stage and (first or last):
        raise typer.BadParameter("--stage names stages one by one; it does not go with --from or --to")
    if stage:
        return [name.value for name in stage]
    if not first and not last:
        return None
    start, end = order.index(first or order[0]), order.index(last or order[-1])
    if start > end:
        raise typer.BadParameter(f"--from {order[start].value} comes after --to {order[end].value}")
    return [name.value for name in order[start : end + 1]]


def _solved(name: str, quiet: bool) -> Solution:
    from dynsolve.cli.progress import progress
    from dynsolve.solution import solve as solve_problem

    problem = read(name)
    with progress(problem.title, quiet) as advance:
        return solve_problem(problem, progress=advance)


def _print_json(solution: Solution, abbreviate: AbbreviateName) -> None:
    import sys
    from json import dump

    dump(solution.to_json(abbreviate.value), sys.stdout, ensure_ascii=False)
    sys.stdout.write("\n")


def _report(
    solution: Solution,
    output: Output,
    detail: DetailName,
    stages: list[str] | None,
    star: bool,
    abbreviate: AbbreviateName,
    fragment: bool,
) -> bytes:
    from dynsolve.explain.step import Detail
    from dynsolve.reports import report

    level = Detail[detail.name]
    return report(
        solution,
        output.format,
        detail=level,
        stages=stages,
        star=star,
        fragment=fragment,
        abbreviate=abbreviate.value,
    )


def _print_document(
    solution: Solution,
    detail: DetailName,
    stages: list[str] | None,
    star: bool,
    abbreviate: AbbreviateName,
    follows_another: bool,
) -> None:
    from dynsolve.cli.page import print_document
    from dynsolve.explain.abbreviations import Abbreviate
    from dynsolve.explain.documents import solution_document
    from dynsolve.explain.step import Detail
    from dynsolve.reports import style_of

    if follows_another:
        typer.echo()
    document = solution_document(solution, Detail[detail.name], stages, Abbreviate(abbreviate.value))
    print_document(document, style_of(solution, star))
