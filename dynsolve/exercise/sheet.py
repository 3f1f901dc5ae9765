r"""The exercise on a sheet, without its solution: title, picture, what is given, what is asked, with points.

A sheet is a document for each exercise, each in the style of its own robot, behind one that has the title.
With a key the solutions stand behind them.  What is to be found is not told: where the table is asked for
neither it nor the frames are shown.

In LaTeX a sheet is a document, a part for `\input`, or a document of the class `exam`.
"""

from __future__ import annotations

import re
import subprocess
from base64 import b64decode, b64encode
from collections.abc import Iterator, Sequence
from enum import StrEnum
from fractions import Fraction
from string import ascii_lowercase

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.answers.marks import shown
from dynsolve.answers.reading.files import EXTRA, pandoc
from dynsolve.derivation.rules import derive
from dynsolve.document import Block, Document, Heading, Inline, Prose, Text, Verbatim
from dynsolve.draw import is_drawn, picture
from dynsolve.draw.figure import to_png
from dynsolve.errors import UsageError
from dynsolve.exercise.asked import Part, parts, worded
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.given import statement
from dynsolve.explain.kinematics import table_of
from dynsolve.explain.signs import report_style
from dynsolve.explain.step import Detail
from dynsolve.grading.set_file import Item, ProblemSet
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.problem.model import Problem, Wording
from dynsolve.render.markdown import PICTURE_DATA
from dynsolve.solution.documents import solution_document
from dynsolve.solution.solution import solve

Styled = tuple[Document, Style]
"""A document, and how its formulas look."""


class SheetFormat(StrEnum):
    """The forms of a sheet."""

    TEXT = "text"
    LATEX = "latex"
    PDF = "pdf"
    HTML = "html"
    MARKDOWN = "markdown"
    DOCX = "docx"


SUFFIXES = {
    ".txt": SheetFormat.TEXT,
    ".tex": SheetFormat.LATEX,
    ".pdf": SheetFormat.PDF,
    ".html": SheetFormat.HTML,
    ".htm": SheetFormat.HTML,
    ".md": SheetFormat.MARKDOWN,
    ".docx": SheetFormat.DOCX,
}
"""What the suffix of a file says."""


class Exercise(Struct, frozen=True):
    """One exercise of a sheet: its problem, its title, what is given, and what is asked."""

    problem: Problem
    title: str
    given: tuple[Block, ...]
    parts: tuple[Part, ...]

    @property
    def points(self) -> Fraction:
        """All points of it."""
        return sum((part.points for part in self.parts), Fraction(0))

    @property
    def style(self) -> Style:
        """How its formulas look: sines and cosines are written out, as nothing introduces a shorthand."""
        return replace(report_style(self.problem.robot), shorthand={})


def exercise_of(item: Item, number: int = 0, *, pictured: bool = True) -> Exercise:
    """What is given and asked, with the marks of its set; with a number it is one of several."""
    problem = item.problem
    title = f"Exercise {number}: {problem.title}" if number else problem.title
    return Exercise(
        problem, title, tuple(_given(problem, pictured)), tuple(parts(problem, dict(problem.marks)))
    )


def _given(problem: Problem, pictured: bool) -> Iterator[Block]:
    """The picture, the table, and what is given in words."""
    robot = problem.robot
    is_sought = "DH" in problem.find or "DH" in problem.marks
    if pictured and is_drawn(robot):
        yield picture(problem, star=False, frames=not is_sought)
    forms, own_words = Forms(robot, derive(robot)), problem.text or Wording()
    if own_words.before:
        yield Text(worded(own_words.before))
    if own_words.given:
        yield Text(worded(own_words.given))
    else:
        yield from statement(forms, problem, frames=not is_sought)
    if robot.has_table and problem.normals is None and not is_sought:
        yield table_of(Context(robot, forms.values, forms))


# -- as documents ----------------------------------------------------------------------------------


def sheet_documents(problems: ProblemSet, date: str = "", *, pictured: bool = True) -> list[Styled]:
    """The title, the exercises, and how to hand in."""
    is_one = len(problems.items) == 1
    numbered = enumerate(problems.items, 1)
    exercises = [exercise_of(item, 0 if is_one else k, pictured=pictured) for k, item in numbered]
    total = sum((exercise.points for exercise in exercises), Fraction(0))
    under = ", ".join(filter(None, (date, _points(total))))
    found: list[Styled] = [(Document((Heading(problems.title, 1), Text((under,)))), PLAIN)]
    for exercise in exercises:
        heading = [] if is_one else [Heading(f"{exercise.title} ({_points(exercise.points)})")]
        found.append((Document((*heading, *exercise.given, *_asked(exercise))), exercise.style))
    found.append((Document(tuple(_handing_in(exercises))), PLAIN))
    return found


def key_documents(problems: ProblemSet, detail: Detail) -> list[Styled]:
    """The solutions at a depth, each under the title of its problem."""
    found = []
    for item in problems.items:
        solution = solve(item.problem)
        document = solution_document(solution, detail)
        titled = Heading(f"Key: {item.problem.title}", 1)
        found.append((Document((titled, *document.blocks[1:])), solution.style))
    return found


def _points(points: Fraction) -> str:
    return f"{shown(points)} point{'' if points == 1 else 's'}"


def _asked(exercise: Exercise) -> Iterator[Block]:
    """What is to be found: a), b), c), each with its points, and how its answer is called."""
    for letter, part in zip(_letters(), exercise.parts, strict=False):
        points = f" ({_points(part.points)})" if part.points else ""
        yield Text((f"{letter}) ", *_told(part), points))


def _told(part: Part) -> Prose:
    """What is asked, and what it is counted by."""
    return (*part.words, " ", *part.convention) if part.convention else part.words


def _letters() -> Iterator[str]:
    """a, b, ..., z, aa, ab, ..."""
    yield from ascii_lowercase
    yield from (first + second for first in ascii_lowercase for second in ascii_lowercase)


def _handing_in(exercises: Sequence[Exercise]) -> Iterator[Block]:
    """The names under which the answers are handed in."""
    yield Heading("Handing in", 3)
    yield Text((
        "Hand in one file for each exercise: YAML, Markdown, LaTeX, a notebook or a Word document. Each "
        "answer has a line of its own: its name, an equals sign, the result. The answers are called",
    ))  # fmt: skip
    for exercise in exercises:
        names = [name for part in exercise.parts for name in part.names]
        told: list[Inline] = [Verbatim(exercise.problem.stem), ": "]
        for k, name in enumerate(names):
            told += [", "] if k else []
            told.append(Verbatim(name))
        yield Text((*told, "."))


# -- as files --------------------------------------------------------------------------------------


def sheet(
    problems: ProblemSet,
    format: SheetFormat,
    *,
    date: str = "",
    key: Detail | None = None,
    fragment: bool = False,
) -> bytes:
    """A sheet in a form, with a `key` at that depth; `fragment` gives LaTeX for another document."""
    keys = [] if key is None else key_documents(problems, key)
    pictured = format is not SheetFormat.TEXT
    return written([*sheet_documents(problems, date, pictured=pictured), *keys], format, fragment)


def written(documents: Sequence[Styled], format: SheetFormat, fragment: bool = False) -> bytes:
    """Documents one behind the other in a form."""
    (first, style), *further = documents
    match format:
        case SheetFormat.LATEX:
            from dynsolve.render import latex

            write = latex.render_fragment if fragment else latex.render
            return write(first, style, *further).encode()
        case SheetFormat.PDF:
            from dynsolve.render import typst

            return typst.render(first, style, *further)
        case SheetFormat.HTML:
            from dynsolve.render import html

            return html.render(first, style, further=further).encode()
        case SheetFormat.MARKDOWN:
            return _markdown(documents).encode()
        case SheetFormat.DOCX:
            return to_docx(_markdown(documents))
    from dynsolve.render import terminal

    lines = (line for each, its in documents for line in terminal.render(each, style=its))
    return "".join(f"{line.text}\n" for line in lines).encode()


def exam_source(problems: ProblemSet, date: str = "") -> str:
    r"""LaTeX of the class `exam`: a \question each exercise, a \part what is asked, with points."""
    from dynsolve.render import latex

    lines = [rf"{{\Large\bfseries {latex.latex_text(problems.title)}}}\par"]
    lines += [rf"{latex.latex_text(date)}\par"] if date else []
    lines.append(r"\begin{questions}")
    for item in problems.items:
        exercise = exercise_of(item)
        lines.append(rf"\question \textbf{{{latex.latex_text(exercise.title)}}}\par")
        lines.append(latex.render_blocks(Document(exercise.given), exercise.style))
        lines.append(r"\begin{parts}")
        for part in exercise.parts:
            text = latex.render_blocks(Document((Text(_told(part)),)), exercise.style)
            lines.append(
                rf"\part[{shown(part.points)}] {text.strip()}" if part.points else rf"\part {text.strip()}"
            )
        lines.append(r"\end{parts}")
    lines.append(r"\end{questions}")
    return latex.of_class("exam", "\n".join(lines))


def _markdown(documents: Sequence[Styled]) -> str:
    from dynsolve.render import markdown

    return "\n".join(markdown.render(each, its) for each, its in documents)


_PICTURE = re.compile(rf"!\[\]\({re.escape(PICTURE_DATA)}([A-Za-z0-9+/=]+)\)")
_WIDTH = "60%"


def to_docx(page: str) -> bytes:
    """A Word document of a page in Markdown, its pictures as PNG; raises UsageError without pandoc."""
    program = pandoc()
    if program is None:
        raise UsageError("a Word document is written by pandoc, which is not installed", EXTRA)

    def as_png(found: re.Match[str]) -> str:
        data = b64encode(to_png(b64decode(found[1]).decode())).decode()
        return f"![](data:image/png;base64,{data}){{width={_WIDTH}}}"

    arguments = [str(program), "--sandbox", "-f", "markdown-yaml_metadata_block", "-t", "docx", "-o", "-"]
    done = subprocess.run(  # noqa: S603  a binary of our own, arguments of our own
        arguments, input=_PICTURE.sub(as_png, page).encode(), capture_output=True, check=False
    )
    if done.returncode:
        raise UsageError("pandoc could not write the Word document")
    return done.stdout
