"""`dynsolve sheet`: the exercise without its solution, or with the key behind it.

`dynsolve template`: the hand-in with empty answers.

`dynsolve vary`: a variant for each student.
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

import click

from dynsolve.cli.grade import folder_option, jobs_option, problems_argument
from dynsolve.cli.numbers import Names, quiet_option, read
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


@click.command()
@click.argument(
    "problem",
    nargs=-1,
    required=True,
    help="Problem files, bundled stems, or a folder with its set.yaml.",
)
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    default="-",
    help="The file: .pdf, .tex, .html, .md, .docx or .txt.",
)
@click.option("--key", is_flag=True, help="The solutions behind the exercises.")
@click.option("--detail", type=Names(DetailName), default="normal", help="The depth of these.")
@click.option("--title", default="", show_default=False, help="Default: that of the set, or of the problem.")
@click.option("--date", default="", show_default=False, help="Words under the title.")
@click.option("--fragment", is_flag=True, help="LaTeX for another document's \\input.")
@click.option("--exam", is_flag=True, help="LaTeX of the class `exam`.")
def sheet(
    problem: tuple[str, ...],
    output: str,
    key: bool,
    detail: DetailName,
    title: str,
    date: str,
    fragment: bool,
    exam: bool,
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


def _together(names: tuple[str, ...], title: str) -> ProblemSet:
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


@click.command()
@click.argument("problem", help="A problem file, or a bundled stem.")
@click.option(
    "-o", "--output", metavar="FILE", required=True, help="The file: .yaml, .md, .tex, .ipynb or .docx."
)
def template(problem: str, output: str) -> int:
    """Write the hand-in with empty answers: their names, the letters, how results are typed."""
    from dynsolve.exercise.template import SUFFIXES
    from dynsolve.exercise.template import template as made

    place = Path(output)
    form = format_of(output, place.suffix, SUFFIXES, None)
    check_place(place)
    write_whole(place, made(read(problem), form))
    return ExitCode.DONE


@click.command()
@problems_argument
@click.option(
    "--roster",
    metavar="CSV",
    type=click.Path(path_type=Path),
    required=True,
    help="A column `student`, or the list of a platform.",
)
@click.option("--seed", required=True, help="Another seed draws other variants.")
@folder_option
@click.option("--format", type=Names(VariedFormat), default="html", help="The form of sheets and keys.")
@click.option("--template", type=Names(TemplateName), default="yaml", help="The form of the templates.")
@click.option("--detail", type=Names(DetailName), default="results", help="The depth of the keys.")
@jobs_option
@quiet_option
def vary(
    problems: str,
    roster: Path,
    seed: str,
    output: Path,
    format: VariedFormat,
    template: TemplateName,
    detail: DetailName,
    jobs: int,
    quiet: bool,
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
            click.echo(f"{family.item.stem}: {variants} of {structures}", err=True)
            for left in family.left_out:
                click.echo(f"  {left}: in no variant, as it would not be as hard as the others", err=True)
            for path in family.idle:
                click.echo(f"  {path}: changes no answer", err=True)
        told = agreeing(f"{len(students)} student|students", len(students))
        click.echo(f"{told}: see {output / 'variants.csv'}", err=True)
    return ExitCode.DONE
