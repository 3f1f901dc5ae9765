"""`dynsolve solve`: the whole derivation, in a terminal, as a report, or as JSON."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer
from msgspec import Struct
from msgspec.structs import replace

from dynsolve.cli.numbers import (
    AtOption,
    DigitsOption,
    Problems,
    Quiet,
    SetOption,
    print_json,
    read,
    say,
    with_numbers,
)
from dynsolve.cli.output import FormatOption, Output, OutputOption, Writer, chosen_output
from dynsolve.errors import ExitCode, ExplanationWarning, ProblemError, UsageError
from dynsolve.quantities.stages import Stage
from dynsolve.render.files import Format

if TYPE_CHECKING:
    from dynsolve.solution.solution import Solution


class DetailName(StrEnum):
    """How much is shown: the names of `explain.step.Detail`, which `--help` need not import."""

    RESULTS = "results"
    BRIEF = "brief"
    NORMAL = "normal"
    FULL = "full"


class AbbreviateName(StrEnum):
    """Whether long results are written in names: `explain.abbreviations.Abbreviate`, not imported either."""

    AUTO = "auto"
    NEVER = "never"
    ALWAYS = "always"


class MethodName(StrEnum):
    """The way to the forces: the names of `robot.questions.Method`, not imported either."""

    LAGRANGE = "lagrange"
    NEWTON_EULER = "newton-euler"


JsonOption = Annotated[bool, typer.Option("--json", help="JSON with everything, one object a line.")]
StageOption = Annotated[
    list[Stage] | None,
    typer.Option(metavar="STAGE", help="Show this stage alone; may be given more than once."),
]
FromOption = Annotated[Stage | None, typer.Option("--from", metavar="STAGE", help="Show from this stage on.")]
ToOption = Annotated[Stage | None, typer.Option("--to", metavar="STAGE", help="Show up to this stage.")]
DetailOption = Annotated[DetailName, typer.Option(help="How much is shown.")]
LatexOption = Annotated[bool, typer.Option("--latex", help="A LaTeX document.")]
FragmentOption = Annotated[bool, typer.Option("--fragment", help="LaTeX for another document's \\input.")]
PdfOption = Annotated[bool, typer.Option("--pdf", help="PDF, without TeX; needs the extra [pdf].")]
HtmlOption = Annotated[bool, typer.Option("--html", help="One HTML file that needs no network.")]
MarkdownOption = Annotated[bool, typer.Option("--markdown", help="Markdown for GitHub and Jupyter.")]
StarOption = Annotated[bool, typer.Option("--star", help="Mark joint variables with a star everywhere.")]
AbbreviateOption = Annotated[
    AbbreviateName, typer.Option(help="Write long results in names, which are defined first.")
]
HintOption = Annotated[
    Stage | None,
    typer.Option(metavar="STAGE", help="What to do in this stage, without its result or a later one."),
]
EditionOption = Annotated[
    int | None, typer.Option(min=1, max=2, help="The edition of Spong's book whose sections are named.")
]
MethodOption = Annotated[
    MethodName,
    typer.Option(help="The way to the forces: energies, or link by link Newton's and Euler's laws."),
]


class _View(Struct, frozen=True):
    """The part of a solution that is shown, and its form; a `hint` is shown instead of it."""

    stages: list[str] | None
    detail: DetailName
    star: bool
    abbreviate: AbbreviateName
    fragment: bool
    hint: Stage | None = None


def solve(
    problem: Problems,
    json: JsonOption = False,
    stage: StageOption = None,
    first: FromOption = None,
    last: ToOption = None,
    detail: DetailOption = DetailName.NORMAL,
    output: OutputOption = None,
    format: FormatOption = None,
    latex: LatexOption = False,
    fragment: FragmentOption = False,
    pdf: PdfOption = False,
    html: HtmlOption = False,
    markdown: MarkdownOption = False,
    star: StarOption = False,
    abbreviate: AbbreviateOption = AbbreviateName.AUTO,
    set_: SetOption = None,
    at: AtOption = None,
    digits: DigitsOption = None,
    hint: HintOption = None,
    edition: EditionOption = None,
    method: MethodOption = MethodName.LAGRANGE,
    quiet: Quiet = False,
) -> int:
    """Derive a robot's dynamics step by step, verified.

    The stages, in order: kinematics, jacobian, inertia, energy, lagrangian, torque, vectorized; a
    robot without masses has the first two. A question of the file has a stage of its own, of its
    name, where it belongs. With --method newton-euler one stage, newton_euler, leads from the
    kinematics to the forces.
    """
    view = _View(_stages(stage, first, last), detail, star, abbreviate, fragment, hint)
    options = {"json": json, "latex": latex, "pdf": pdf, "html": html, "markdown": markdown}
    asked = [Format(name) for name, is_asked in options.items() if is_asked]
    place = chosen_output(format, asked, output, problem, fragment)
    if hint and (view.stages or place.format is Format.JSON):
        what = "--json" if place.format is Format.JSON else "--stage, --from or --to"
        raise UsageError(f"--hint is a text on one stage; it does not go with {what}")

    def solved(name: str) -> Solution:
        return with_numbers(_solved(name, method, edition, quiet), set_, at, digits)

    return _solve_all(problem, place, view, solved, quiet)


def _solve_all(
    names: list[str], output: Output, view: _View, solved: Callable[[str], Solution], quiet: bool
) -> int:
    """Solve and show one problem after the other; of several a faulty one is told and passed over."""
    writer = Writer(output)
    code = ExitCode.DONE
    if quiet:
        warnings.filterwarnings("ignore", category=ExplanationWarning)
    for place, name in enumerate(names):
        try:
            solution = solved(name)
        except ProblemError as error:
            if len(names) == 1:
                raise
            say(error.findings)
            code = ExitCode.USAGE
            continue
        if not quiet:
            say(solution.warnings, "warning")
            say(solution.numbers.warnings if solution.numbers else (), "warning")
        if output == Output(Format.TEXT, None):
            _print_document(solution, view, place > 0)
        elif output == Output(Format.JSON, None):
            print_json(solution.to_json(view.abbreviate))
        else:
            writer.write(name, _report(solution, output, view))
    writer.close()
    return code


def _stages(stage: list[Stage] | None, first: Stage | None, last: Stage | None) -> list[str] | None:
    """The stages that are shown, None for all."""
    order = list(Stage)
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


def _solved(name: str, method: MethodName, edition: int | None, quiet: bool) -> Solution:
    from dynsolve.cli.output import progress
    from dynsolve.solution.solution import solve as solve_problem

    problem = read(name)
    if edition:
        problem = replace(problem, edition=edition)
    with progress(problem.title, quiet) as advance:
        return solve_problem(problem, method=method.value, progress=advance)


def _report(solution: Solution, output: Output, view: _View) -> bytes:
    from dynsolve.explain.step import Detail
    from dynsolve.solution.reports import rendered, report

    if view.hint:
        style = solution.starred(view.star)
        return rendered(solution.hint(view.hint), style, output.format, view.fragment)
    return report(
        solution,
        output.format,
        detail=Detail[view.detail.name],
        stages=view.stages,
        star=view.star,
        fragment=view.fragment,
        abbreviate=view.abbreviate,
    )


def _print_document(solution: Solution, view: _View, follows_another: bool) -> None:
    from dynsolve.cli.output import print_document
    from dynsolve.explain.abbreviations import Abbreviate
    from dynsolve.explain.step import Detail
    from dynsolve.solution.documents import solution_document

    if follows_another:
        typer.echo()
    if view.hint:
        document = solution.hint(view.hint)
    else:
        detail = Detail[view.detail.name]
        document = solution_document(solution, detail, view.stages, Abbreviate(view.abbreviate))
    print_document(document, solution.starred(view.star))
