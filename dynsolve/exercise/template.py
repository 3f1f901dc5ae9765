r"""The hand-in with empty answers: every asked answer by name, the letters and how they are typed.

What is left empty is missing; what is filled in is read as in any other hand-in.  A name is set with the
letter of the sheet where this is read as that name alone, else as it is typed.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from enum import StrEnum

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.answers.reading.left_side import NamedAnswers, read_left_side
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.vocabulary import Vocabulary, vocabulary
from dynsolve.document import Prose
from dynsolve.errors import ReadError
from dynsolve.exercise.asked import parts
from dynsolve.exercise.sheet import to_docx
from dynsolve.explain.notation_list import problem_names
from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Node, Symbol, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem.model import Problem
from dynsolve.quantities.family import Kind
from dynsolve.quantities.index import quantities


class TemplateFormat(StrEnum):
    """The forms of a hand-in."""

    YAML = "yaml"
    MARKDOWN = "markdown"
    LATEX = "latex"
    NOTEBOOK = "notebook"
    DOCX = "docx"


SUFFIXES = {
    ".yaml": TemplateFormat.YAML,
    ".md": TemplateFormat.MARKDOWN,
    ".tex": TemplateFormat.LATEX,
    ".ipynb": TemplateFormat.NOTEBOOK,
    ".docx": TemplateFormat.DOCX,
}
"""What the suffix of a file says."""

NOTATION = (
    ("a rate", "{q}_dot, or {rate} in LaTeX"),
    ("an acceleration", "{q}_ddot, or {acceleration} in LaTeX"),
    ("a matrix", "[[a, b], [c, d]], or \\begin{{bmatrix}} a & b \\\\ c & d \\end{{bmatrix}} in LaTeX"),
    ("a vector", "[a, b], or a matrix of one column"),
)
"""How results are typed; {q} is the first coordinate, {rate} and {acceleration} its own in LaTeX."""

OF_SETS = ("a set", "a list of equations, those that hold together joined by and")


class Blank(Struct, frozen=True):
    """An answer that is asked for: its name, what it is in words, how it is set, and its kind."""

    name: str
    words: str
    letter: str
    kind: Kind


class Letter(Struct, frozen=True):
    """Names of the problem: as they are typed, their meaning and unit."""

    typed: str
    meaning: str
    unit: str


class Template(Struct, frozen=True):
    """What a template says, in whatever form."""

    problem: Problem
    letters: tuple[Letter, ...]
    notation: tuple[tuple[str, str], ...]
    blanks: tuple[Blank, ...]
    student: str = ""

    @property
    def whose(self) -> str:
        """The line that says whose it is."""
        return f"student: {self.student}".rstrip()


def template_of(problem: Problem) -> Template:
    """The answers that a problem asks for, its letters, and how results are typed."""
    blanks = tuple(_blanks(problem))
    first, printer = problem.robot.coordinates[0].name, LatexPrinter(PLAIN)
    rate, acceleration = (printer.text(Symbol(first, dots)) for dots in (1, 2))
    told = [(what, how.format(q=first, rate=rate, acceleration=acceleration)) for what, how in NOTATION]
    asked = parts(problem, dict(problem.marks))
    told += [(_typed(part.convention), ", ".join(part.names)) for part in asked if part.convention]
    has_sets = any(blank.kind in (Kind.EQUATIONS, Kind.CONDITIONS) for blank in blanks)
    return Template(problem, tuple(_letters(problem)), (*told, *([OF_SETS] if has_sets else [])), blanks)


def _letters(problem: Problem) -> Iterator[Letter]:
    sought = "DH" in (*problem.find, *problem.marks)
    for line in problem_names(problem.robot, frames=not sought):
        names = [node.name for sign in line.signs for node in walk(sign) if isinstance(node, Symbol)]
        meaning = line.words if isinstance(line.words, str) else to_unicode(line.words)
        yield Letter(", ".join(names), meaning, line.unit)
    questions = problem.robot.questions
    if "inverse" in questions.asked and questions.target is None:
        yield Letter(", ".join(questions.reached), "values of the task that are to be reached", "")


def _blanks(problem: Problem) -> Iterator[Blank]:
    known, names = quantities(problem.robot), vocabulary(problem)
    for part in parts(problem, dict(problem.marks)):
        for name in part.names:
            family = known[name].family
            letter = known[name].letter(problem.robot) if family.has_letter else None
            yield Blank(name, _typed(part.words), _set(names, name, letter), family.kind)


def _typed(prose: Prose) -> str:
    return "".join(to_unicode(part) if isinstance(part, Node) else str(part) for part in prose)


def _set(names: Vocabulary, name: str, letter: Node | None) -> str:
    """The letter in LaTeX if it is read as this answer and no other; else the name."""
    written = LatexPrinter(PLAIN).text(letter) if letter is not None else name
    try:
        side = read_left_side(names.fresh(), prepared(written)[:-1])
    except ReadError:
        return name
    return written if isinstance(side, NamedAnswers) and side.candidates == (name,) else name


# -- as files --------------------------------------------------------------------------------------


def template(problem: Problem, format: TemplateFormat, student: str = "") -> bytes:
    """The template in a form, of a student; raises UsageError for a Word document without pandoc."""
    made = replace(template_of(problem), student=student)
    match format:
        case TemplateFormat.YAML:
            return _yaml(made).encode()
        case TemplateFormat.MARKDOWN:
            return "\n".join(_markdown(made)).encode()
        case TemplateFormat.LATEX:
            return _latex(made).encode()
        case TemplateFormat.NOTEBOOK:
            return _notebook(made).encode()
    return to_docx("\n".join(_markdown(made)))


def _comments(made: Template) -> Iterator[str]:
    """The letters and the notation as lines."""
    yield "The letters, as they are typed:"
    for letter in made.letters:
        unit = f" ({letter.unit})" if letter.unit else ""
        yield f"  {letter.meaning}{unit}: {letter.typed}"
    yield "How results are typed:"
    yield from (f"  {what}: {how}" for what, how in made.notation)


def _yaml(made: Template) -> str:
    lines = [f"# {made.problem.title}"]
    lines += [f"# {line}" for line in _comments(made)]
    lines += [f"problem: {made.problem.stem}", made.whose, "answers:"]
    for blank in made.blanks:
        lines += [f"  # {blank.words}", f"  {blank.name}:"]
    return "\n".join(lines) + "\n"


def _markdown(made: Template) -> Iterator[str]:
    yield f"# {made.problem.title}\n"
    yield f"problem: {made.problem.stem}\n"
    yield f"{made.whose}\n"
    yield from _tables(made)
    for blank in made.blanks:
        yield f"## {blank.words}\n"
        yield from _space(made.problem, blank)


def _tables(made: Template) -> Iterator[str]:
    """The letters and the notation as tables, in which what is typed is code."""
    yield "| meaning | unit | typed |\n| --- | --- | --- |"
    for letter in made.letters:
        yield f"| {letter.meaning} | {letter.unit} | `{letter.typed}` |"
    yield "\n| what | how it is typed |\n| --- | --- |"
    for what, how in made.notation:
        yield f"| {what} | `{how}` |"
    yield ""


def _space(problem: Problem, blank: Blank) -> Iterator[str]:
    """The place for an answer in Markdown: a display, a line for a set or a verdict, an empty table."""
    if blank.name == "DH":
        rows = [f"| {joint.index} |  |  |  |  |" for joint in problem.robot.joints]
        yield "\n".join(("| i | θ | d | a | α |", "| --- | --- | --- | --- | --- |", *rows, ""))
    elif blank.kind is Kind.VERDICTS:
        names = [one.name for one in problem.robot.questions.candidates] or [blank.name]
        yield from (f"{name}:\n" for name in names)
    elif blank.kind in (Kind.EQUATIONS, Kind.CONDITIONS):
        yield f"{blank.name}:\n"
    elif blank.kind is Kind.BRANCHES:
        printer = LatexPrinter(PLAIN)
        yield from (f"$$\n{printer.text(Symbol(q.name))} =\n$$\n" for q in problem.robot.coordinates)
    else:
        yield f"$$\n{blank.letter} =\n$$\n"


def _latex(made: Template) -> str:
    from dynsolve.render.latex import latex_text

    lines = [r"\documentclass{article}", r"\usepackage{amsmath}", r"\begin{document}"]
    lines += [rf"\section*{{{latex_text(made.problem.title)}}}", f"% problem: {made.problem.stem}"]
    lines += [made.whose, *(f"% {line}" for line in _comments(made))]
    for blank in made.blanks:
        lines += ["", rf"\subsection*{{{latex_text(blank.words)}}}"]
        lines += [_as_latex(text) for text in _space(made.problem, blank)]
    return "\n".join([*lines, r"\end{document}"]) + "\n"


def _as_latex(text: str) -> str:
    """A space of Markdown in LaTeX."""
    if text.startswith("|"):
        head, _, *rows = text.replace("θ", r"$\theta$").replace("α", r"$\alpha$").splitlines()
        cells = " \\\\\n".join(row[1:-1].replace("|", "&") for row in (head, *rows))
        return f"\\begin{{tabular}}{{ccccc}}\n{cells}\n\\end{{tabular}}"
    return text.replace("$$\n", "\\[\n", 1).replace("\n$$", "\n\\]").rstrip("\n")


def _notebook(made: Template) -> str:
    head, *spaces = "\n".join(_markdown(made)).split("\n## ")
    cells = [
        {"cell_type": "markdown", "id": f"cell-{k}", "metadata": {}, "source": text.splitlines(keepends=True)}
        for k, text in enumerate((head, *(f"## {space}" for space in spaces)))
    ]
    notebook = {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(notebook, ensure_ascii=False, indent=1) + "\n"
