"""`dynsolve sheet`: the exercise without its solution, or with the key behind it.

`dynsolve template`: the hand-in with empty answers.

`dynsolve vary`: a variant for each student.
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dynsolve.cli.grade import FolderOption, JobsOption
from dynsolve.cli.grade import ProblemsArgument as SetArgument
from dynsolve.cli.numbers import Quiet, read
from dynsolve.cli.output import bar_or_lines, format_of, refuse_on_terminal, write_to_standard_output
from dynsolve.cli.solve import DetailName
from dynsolve.errors import ExitCode, UsageError
from dynsolve.render.files import check_place, write_whole

if TYPE_CHECKING:
    from dynsolve.grading.set_file import ProblemSet


class VariedFormat(StrEnum):
    """The forms of sheets that `vary` writes: some of `exercise.sheet.SheetFormat`."""

    HTML = "html"
    PDF = "pdf"
    LATEX = "latex"
    MARKDOWN = "markdown"
    DOCX = "docx"


class TemplateName(StrEnum):
    """The forms of templates: the names of `exercise.template.TemplateFormat`."""

    YAML = "yaml"
    MARKDOWN = "markdown"
    LATEX = "latex"
    NOTEBOOK = "notebook"
    DOCX = "docx"


ProblemsArgument = Annotated[
    list[str],
    typer.Argument(metavar="PROBLEM...", help="Problem files, bundled stems, or a folder with its set.yaml."),
]


def sheet(
    problem: ProblemsArgument,
    output: Annotated[
        str,
        typer.Option(
            "--output", "-o", metavar="FILE", help="The file: .pdf, .tex, .html, .md, .docx or .txt."
        ),
    ] = "-",
    key: Annotated[bool, typer.Option("--key", help="The solutions behind the exercises.")] = False,
    detail: Annotated[DetailName, typer.Option(help="The depth of these.")] = DetailName.NORMAL,
    title: Annotated[str, typer.Option(help="Default: that of the set, or of the problem.")] = "",
    date: Annotated[str, typer.Option(help="Words under the title.")] = "",
    fragment: Annotated[
        bool, typer.Option("--fragment", help="LaTeX for another document's \\input.")
    ] = False,
    exam: Annotated[bool, typer.Option("--exam", help="LaTeX of the class `exam`.")] = False,
) -> int:
    """Write the exercise without its solution: a picture, what is given, what is asked, with points."""
    from dynsolve.exercise.sheet import SUFFIXES, SheetFormat, exam_source
    from dynsolve.exercise.sheet import sheet as made
    from dynsolve.explain.step import Detail

    place = None if output == "-" else Path(output)
    asked = SheetFormat.LATEX if fragment or exam else None if place else SheetFormat.TEXT
    form = asked or SheetFormat.TEXT if place is None else format_of(output, place.suffix, SUFFIXES, asked)
    if place is not None:
        check_place(place)
    elif form in (SheetFormat.PDF, SheetFormat.DOCX):
        refuse_on_terminal(form)
    problems = _together(problem, title)
    depth = Detail[detail.name] if key else None
    if exam and (key or fragment):
        raise UsageError("--exam is a document without a key", "leave out --key and --fragment")
    if exam:
        data = exam_source(problems, date).encode()
    else:
        data = made(problems, form, date=date, key=depth, fragment=fragment)
    if place is None:
        write_to_standard_output(data)
    else:
        write_whole(place, data)
    return ExitCode.DONE


def _together(names: list[str], title: str) -> ProblemSet:
    """The problems of a folder, or those that are named one by one, as one set."""
    from msgspec.structs import replace

    from dynsolve.grading.set_file import load_set

    sets = [load_set(name) for name in names]
    items = tuple(item for each in sets for item in each.items)
    stems = [item.stem for item in items]
    twice = next((stem for stem in stems if stems.count(stem) > 1), None)
    if twice:
        raise UsageError(f"{twice} is named twice")
    usual = sets[0].title if len(sets) == 1 else "Exercises"
    return replace(sets[0], title=title or usual, items=items)


def template(
    problem: Annotated[str, typer.Argument(metavar="PROBLEM", help="A problem file, or a bundled stem.")],
    output: Annotated[
        str,
        typer.Option("--output", "-o", metavar="FILE", help="The file: .yaml, .md, .tex, .ipynb or .docx."),
    ],
) -> int:
    """Write the hand-in with empty answers: their names, the letters, how results are typed."""
    from dynsolve.exercise.template import SUFFIXES
    from dynsolve.exercise.template import template as made

    place = Path(output)
    form = format_of(output, place.suffix, SUFFIXES, None)
    check_place(place)
    write_whole(place, made(read(problem), form))
    return ExitCode.DONE


def vary(
    problems: SetArgument,
    roster: Annotated[
        Path,
        typer.Option("--roster", metavar="CSV", help="A column `student`, or the list of a platform."),
    ],
    seed: Annotated[str, typer.Option(help="Another seed draws other variants.")],
    output: FolderOption,
    format: Annotated[VariedFormat, typer.Option(help="The form of sheets and keys.")] = VariedFormat.HTML,
    template: Annotated[TemplateName, typer.Option(help="The form of the templates.")] = TemplateName.YAML,
    detail: Annotated[DetailName, typer.Option(help="The depth of the keys.")] = DetailName.RESULTS,
    jobs: JobsOption = 0,
    quiet: Quiet = False,
) -> int:
    """Draw a variant of each problem for every student: sheet, template and key, equally hard."""
    from dynsolve.exercise.sheet import SheetFormat
    from dynsolve.exercise.template import TemplateFormat
    from dynsolve.exercise.variants import Forms, students_of
    from dynsolve.exercise.variants import vary as made
    from dynsolve.explain.step import Detail
    from dynsolve.explain.writing import agreeing
    from dynsolve.grading.set_file import load_set

    chosen, students = load_set(problems), students_of(roster)
    if output.is_file():
        raise UsageError(f"{output} is a file", "give a folder")
    forms = Forms(SheetFormat(format), TemplateFormat(template), Detail[detail.name])
    with bar_or_lines("drawing", quiet) as advance:
        families = made(chosen, students, seed, output, forms, jobs, advance)
    if not quiet:
        for family in families:
            variants = agreeing(f"{family.size} variant|variants", family.size)
            structures = agreeing(f"{len(family.structures)} structure|structures", len(family.structures))
            typer.echo(f"{family.item.stem}: {variants} of {structures}", err=True)
            for left in family.left_out:
                typer.echo(f"  {left}: in no variant, as it would not be as hard as the others", err=True)
            for path in family.idle:
                typer.echo(f"  {path}: changes no answer", err=True)
        told = agreeing(f"{len(students)} student|students", len(students))
        typer.echo(f"{told}: see {output / 'variants.csv'}", err=True)
    return ExitCode.DONE
