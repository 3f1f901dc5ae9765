"""Solutions in the form their reader uses: text, JSON, LaTeX, PDF, HTML, Markdown, a notebook.

What a further format needs, and where, is listed in `.github/CONTRIBUTING.md` under "How to add".
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from msgspec.structs import replace

from dynsolve.errors import attempted
from dynsolve.quantities.stages import Stage
from dynsolve.render.files import Format

if TYPE_CHECKING:
    from dynsolve.document import Document, Picture
    from dynsolve.document.figures import ArmFigure, Figure
    from dynsolve.explain.abbreviations import Abbreviate
    from dynsolve.explain.step import Detail
    from dynsolve.notation.printing import Style
    from dynsolve.notation.tree import Node
    from dynsolve.problem.model import Problem
    from dynsolve.solution.depths import Drawn
    from dynsolve.solution.dynamics import Dynamics


def report(
    solution: Dynamics,
    format: Format,
    *,
    detail: Detail | None = None,
    stages: Iterable[str] | None = None,
    star: bool = False,
    fragment: bool = False,
    abbreviate: Abbreviate | str = "auto",
) -> bytes:
    r"""A solution in a form.

    `stages` are those that are shown, or all; `star` puts the mark of a joint variable
    on every coordinate; `fragment` gives LaTeX that another document takes in;
    `abbreviate` says whether long results are written in names: `auto`, `never`, `always`.

    >>> import dynsolve
    >>> page = report(dynsolve.solve("planar-2r"), Format.LATEX)
    >>> page.decode().splitlines()[0]
    '\\documentclass[a4paper]{article}'
    """
    from dynsolve.draw import is_drawn
    from dynsolve.explain.abbreviations import Abbreviate
    from dynsolve.explain.step import Detail
    from dynsolve.solution.documents import solution_documents

    detail = detail or Detail.NORMAL
    if format is Format.JSON:
        from json import dumps

        from dynsolve.solution.json_export import to_json

        return (dumps(to_json(solution, abbreviate), ensure_ascii=False) + "\n").encode()
    style = solution.starred(star)
    details = tuple(Detail) if format is Format.HTML else (detail,)
    drawn = _drawn(solution.problem, style) if format in PICTURED else None
    documents = solution_documents(solution, details, stages, Abbreviate(abbreviate), drawn)
    if is_drawn(solution.robot) and format in PICTURED and (stages is None or _SHOWN_IN & set(stages)):
        plain = documents
        documents = attempted(lambda: _with_picture(plain, solution, star), lambda: plain, "the picture")
    if format is Format.HTML:
        from dynsolve.render import html

        named = dict(zip((each.name.lower() for each in details), documents, strict=True))
        return html.render_choice(named, style, detail.name.lower()).encode()
    return rendered(documents[0], style, format, fragment)


_SHOWN_IN = {Stage.FRAMES, Stage.KINEMATICS}
"""The stages that show frames."""

PICTURED = (Format.LATEX, Format.PDF, Format.HTML)
"""The forms that can show the manipulator."""


def _drawn(problem: Problem, style: Style) -> Drawn:
    """What makes a picture of a step's drawing."""

    def picture(figure: Figure | ArmFigure) -> Picture | None:
        from dynsolve.document.figures import ArmFigure
        from dynsolve.draw.figure import drawn, drawn_arm

        return drawn_arm(figure, problem, style) if isinstance(figure, ArmFigure) else drawn(figure, style)

    return picture


def _with_picture(documents: Iterable[Document], solution: Dynamics, star: bool) -> tuple[Document, ...]:
    """The documents with the manipulator drawn before the first section."""
    from dynsolve.document import Heading

    picture = solution.picture(star)

    def pictured(document: Document) -> Document:
        blocks = document.blocks
        sections = (k for k, block in enumerate(blocks) if isinstance(block, Heading) and block.level > 1)
        place = next(sections, len(blocks))
        return replace(document, blocks=(*blocks[:place], picture, *blocks[place:]))

    return tuple(map(pictured, documents))


def rendered(document: Document, style: Style, format: Format, fragment: bool) -> bytes:
    """A document in a form other than JSON."""
    match format:
        case Format.LATEX:
            from dynsolve.render import latex

            return (latex.render_fragment if fragment else latex.render)(document, style).encode()
        case Format.PDF:
            from dynsolve.render import typst

            return typst.render(document, style)
        case Format.HTML:
            from dynsolve.render import html

            return html.render(document, style).encode()
        case Format.MARKDOWN:
            from dynsolve.render import markdown

            return markdown.render(document, style).encode()
    from dynsolve.render import terminal

    return "".join(f"{line.text}\n" for line in terminal.render(document, style=style)).encode()


# How a notebook shows a solution: its results first, the worked solution folded away behind them

_FOLDED = "Worked solution"


def _results_and_worked(solution: Dynamics) -> tuple[Document, Document]:
    from dynsolve.explain.step import Detail
    from dynsolve.solution.documents import solution_documents

    results, worked = solution_documents(solution, (Detail.RESULTS, Detail.NORMAL))
    return results, worked


def notebook_html(solution: Dynamics) -> str:
    """A part of a page."""
    from dynsolve.render import html

    return html.render_folded(*_results_and_worked(solution), _FOLDED, solution.style)


def notebook_markdown(solution: Dynamics) -> str:
    """Markdown, the worked solution in a fold of HTML."""
    from dynsolve.render import markdown

    results, worked = (markdown.render(each, solution.style) for each in _results_and_worked(solution))
    return f"{results}\n<details><summary>{_FOLDED}</summary>\n\n{worked}\n</details>\n"


def notebook_latex(solution: Dynamics) -> str:
    """The results alone, each a displayed formula, as MathJax sets them."""
    from dynsolve.document import Equations, Formula
    from dynsolve.notation.markup import LatexPrinter

    printer = LatexPrinter(solution.style)
    shown: list[Node] = []
    for block in _results_and_worked(solution)[0].blocks:
        if isinstance(block, Formula):
            shown.append(block.node)
        elif isinstance(block, Equations):
            shown += block.nodes
    return "\n".join(f"$${printer.text(node)}$$" for node in shown)
