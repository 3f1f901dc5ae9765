"""How a notebook shows a solution: its results first, the worked solution folded away behind them."""

from __future__ import annotations

from dynsolve.document import Document, Equations, Formula
from dynsolve.explain.step import Detail
from dynsolve.notation.latex import LatexPrinter
from dynsolve.render import html, markdown
from dynsolve.solution.documents import solution_documents
from dynsolve.solution.dynamics import Dynamics

_FOLDED = "Worked solution"


def _documents(solution: Dynamics) -> tuple[Document, Document]:
    """The results, and the worked solution."""
    results, worked = solution_documents(solution, (Detail.RESULTS, Detail.NORMAL))
    return results, worked


def as_html(solution: Dynamics) -> str:
    """A part of a page."""
    results, worked = _documents(solution)
    return html.render_folded(results, worked, _FOLDED, solution.style)


def as_markdown(solution: Dynamics) -> str:
    """Markdown, the worked solution in a fold of HTML."""
    results, worked = (markdown.render(each, solution.style) for each in _documents(solution))
    return f"{results}\n<details><summary>{_FOLDED}</summary>\n\n{worked}\n</details>\n"


def as_latex(solution: Dynamics) -> str:
    """The results alone, each a displayed formula, as MathJax sets them."""
    printer = LatexPrinter(solution.style)
    results, _ = _documents(solution)
    shown = [
        node
        for block in results.blocks
        if isinstance(block, Formula | Equations)
        for node in ((block.node,) if isinstance(block, Formula) else block.nodes)
    ]
    return "\n".join(f"$${printer.text(node)}$$" for node in shown)
