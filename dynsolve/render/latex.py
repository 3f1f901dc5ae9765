r"""Documents -> LaTeX: a complete document, or a fragment to \input; amsmath and nothing else."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, groupby

from dynsolve.document import (
    Block,
    Document,
    Equations,
    Fold,
    Formula,
    Heading,
    Inline,
    List,
    Note,
    Picture,
    Prose,
    Table,
    Text,
    Uses,
    Verbatim,
)
from dynsolve.notation.extent import Ruler
from dynsolve.notation.latex import LatexPrinter
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Matrix, Node, Words
from dynsolve.render.flow import Notation
from dynsolve.render.latex_text import latex_text
from dynsolve.render.references import numbered, slug, with_sources
from dynsolve.render.typesetting import Line, Setter
from dynsolve.render.words import Speech

PAGE = 42.8
"""The width of our own page, in em."""

FRAGMENT_PAGE = 32.8
"""The narrowest page of the standard classes, which a fragment must fit."""

_NUMBER = 3.4
_MOST_LINES = 60  # what TeX holds in memory at once is bounded
_TALL = (r"\frac", r"\sum", r"\begin")
_SIGNS = {"≈": r"\approx", "≠": r"\neq", "≤": r"\leq", "≥": r"\geq", "⇒": r"\Rightarrow", "×": r"\times"}
_NUMBERED = re.compile(r"(\d+(?:\.\d+)*)\.? (.*)", re.DOTALL)

_PREAMBLE = r"""\documentclass[a4paper,11pt]{article}
\usepackage{amsmath}
\setlength{\textwidth}{469pt}
\setlength{\oddsidemargin}{-8pt}
\setlength{\evensidemargin}{-8pt}
\setlength{\topmargin}{-30pt}
\setlength{\textheight}{680pt}
\setlength{\parindent}{0pt}
\setlength{\parskip}{5pt plus 2pt}
\setlength{\emergencystretch}{4em}
\setcounter{tocdepth}{1}
\setcounter{MaxMatrixCols}{30}
\allowdisplaybreaks[3]
\AtBeginDocument{\setlength{\abovedisplayskip}{7pt plus 3pt}\setlength{\belowdisplayskip}{7pt plus 3pt}}
"""

# A source stands at the end of its line, or of the next where it does not fit.
_MACROS = r"""\providecommand{\formulasource}[1]{\unskip\nobreak
  \hfill\penalty50\hskip1em\hbox{}\nobreak\hfill\mbox{\footnotesize #1}}
"""


_NEEDS = r"""% Needs \usepackage{amsmath}, and where a matrix has more than ten columns
% \setcounter{MaxMatrixCols}{30}.
"""


def render(document: Document, style: Style = PLAIN) -> str:
    """A complete document."""
    page = _Page(style, PAGE, document)
    title = next((block.text for block in document.blocks if isinstance(block, Heading)), "")
    body = "\n".join(page.blocks(b for b in document.blocks if not _is_title(b)))
    return (
        f"{_PREAMBLE}{_MACROS}\\begin{{document}}\n"
        f"{{\\LARGE\\bfseries\\raggedright {page.words(title)}\\par}}\n\\bigskip\n{body}\n\\end{{document}}\n"
    )


def render_fragment(document: Document, style: Style = PLAIN) -> str:
    r"""What a document of the reader's own takes in with \input; it needs amsmath."""
    page = _Page(style, FRAGMENT_PAGE, document)
    body = "\n".join(page.blocks(document.blocks))
    begin = "\\begingroup\\allowdisplaybreaks[3]\\emergencystretch=4em"
    return f"{_NEEDS}{_MACROS}{begin}\n{body}\n\\par\\endgroup\n"


def _is_title(block: Block) -> bool:
    return isinstance(block, Heading) and block.level == 1


def latex_notation(printer: LatexPrinter) -> Notation:
    """How LaTeX writes what a formula is made of."""

    def opened(inner: str) -> str:
        return r"\Bigl(" if any(mark in inner for mark in _TALL) else "("

    def closed(inner: str, exponent: Node | None) -> str:
        text = r"\Bigr)" if any(mark in inner for mark in _TALL) else ")"
        return text if exponent is None else f"{text}^{{{printer.text(exponent)}}}"

    return Notation(
        text=printer.text,
        plus="{} +",
        minus="{} -",
        lead="-",
        relation=lambda sign: "{} " + _SIGNS.get(sign, sign),
        opened=opened,
        closed=closed,
        joined=" ".join,
    )


class _Printer(LatexPrinter):
    """LaTeX for a page: rows with fractions in them stand further apart, formulas side by side too."""

    def _matrix(self, node: Matrix) -> str:
        rows = [" & ".join(map(self.text, row)) for row in node.rows]
        ends = [r" \\[3pt] " if r"\frac" in row else r" \\ " for row in rows[:-1]]
        body = "".join(chain.from_iterable(zip(rows, [*ends, ""], strict=True)))
        return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"

    def _words(self, node: Words) -> str:
        if node.text == ", ":
            return r",\quad"
        return "," if node.text == "," else super()._words(node)


class _Page:
    """Turns blocks into LaTeX; knows the page's width and the numbers of the equations."""

    def __init__(self, style: Style, width: float, document: Document) -> None:
        self.printer = _Printer(style)
        self.words = Speech(latex_text, self.inline)
        ruler, notation = Ruler(style), latex_notation(self.printer)
        self.plain = Setter(notation, ruler, width)
        self.with_number = Setter(notation, ruler, width - _NUMBER)
        self.labels = numbered(document)
        self.prefix = slug(document)

    def blocks(self, blocks: Iterable[Block]) -> Iterator[str]:
        """The blocks one after the other, formulas that follow each other in one display."""
        in_text = False
        for is_formula, run in groupby(blocks, lambda block: isinstance(block, Formula)):
            if is_formula:
                yield from self.formulas(block for block in run if isinstance(block, Formula))
                in_text = True
                continue
            for block in run:
                if in_text:
                    yield ""
                yield from self.block(block)
                in_text = isinstance(block, Text | Uses)

    def block(self, block: Block) -> Iterator[str]:
        match block:
            case Heading(text, level):
                yield self.heading(text, level)
            case Text(parts, source):
                beside = f"\\formulasource{{{self.words(source)}}}" if source else ""
                yield f"{self.prose(parts)}{beside}"
            case Equations(nodes):
                yield from _aligned(self.plain.equations(nodes), "")
            case Uses(labels):
                yield from self.uses(labels)
            case List(items):
                yield "\\begin{itemize}"
                yield from (f"\\item {self.prose(item)}" for item in items)
                yield "\\end{itemize}"
            case Note(parts):
                yield f"\\begin{{quote}}\\small\\textbf{{Note.}} {self.prose(parts)}\\end{{quote}}"
            case Table():
                yield self.table(block)
            case Picture(_, caption, latex):
                if latex:
                    yield f"\\begin{{center}}\n{latex}\n\n\\small {self.words(caption)}\n\\end{{center}}"
            case Fold(title, blocks):
                yield self.heading(title, 3)
                yield from self.blocks(with_sources(blocks))

    def heading(self, text: str, level: int) -> str:
        """A heading keeps the number that it has in the whole derivation."""
        command = ("section", "section", "subsection")[level - 1]
        found = _NUMBERED.fullmatch(text)
        words = f"{found[1]}\\quad {self.words(found[2])}" if found else self.words(text)
        return f"\\{command}*{{{words}}}"

    def prose(self, parts: Prose) -> str:
        """A sentence with its formulas."""
        return "".join(map(self.part, parts))

    def part(self, part: Inline) -> str:
        """A piece of a sentence, or a cell of a table."""
        match part:
            case str():
                return self.words(part)
            case Verbatim(text):
                return f"\\texttt{{{latex_text(text)}}}"
        return self.inline(part)

    def inline(self, node: Node) -> str:
        """A formula in a sentence."""
        return f"${self.printer.text(node)}$"

    def uses(self, labels: Sequence[str]) -> Iterator[str]:
        known = [label for label in labels if label in self.labels]
        if known:
            references = [f"\\eqref{{{self.prefix}:{label}}}" for label in known]
            listed = ", ".join(references[:-1]) + " and " * (len(references) > 1) + references[-1]
            yield f"With {listed}:"

    def formulas(self, formulas: Iterable[Formula]) -> Iterator[str]:
        """Displays: formulas of one line together, one that is broken alone."""
        rows: list[tuple[list[Line], str]] = []
        for formula in formulas:
            is_numbered = formula.label in self.labels
            lines = (self.with_number if is_numbered else self.plain).set(formula)
            label = f"\\label{{{self.prefix}:{formula.label}}}" if is_numbered else ""
            if len(lines) == 1:
                rows.append((lines, label))
            elif lines:
                yield from _gathered(rows)
                rows = []
                yield from _aligned(lines, label)
        yield from _gathered(rows)

    def table(self, table: Table) -> str:
        rows = [" & ".join(map(self.part, row)) for row in (table.header, *table.rows)]
        head, *body = rows
        columns = "c" * len(table.header)
        return (
            f"\\begin{{center}}\n\\begin{{tabular}}{{{columns}}}\n{head} \\\\ \\hline\\rule{{0pt}}{{2.6ex}}"
            + " \\\\\n".join(body)
            + " \\\\\n\\end{tabular}\n\\end{center}"
        )


def _gathered(rows: Sequence[tuple[list[Line], str]]) -> Iterator[str]:
    """Formulas of one line each, one under the other."""
    if not rows:
        return
    texts = [f"{line.left} {line.right}".strip() for (line,), _ in rows]
    if len(rows) == 1:
        label = rows[0][1]
        star = "" if label else "*"
        yield f"\\begin{{equation{star}}}{label}\n{texts[0]}\n\\end{{equation{star}}}"
        return
    body = " \\\\\n".join(text + (label or r" \notag") for text, (_, label) in zip(texts, rows, strict=True))
    yield f"\\begin{{gather}}\n{body}\n\\end{{gather}}"


def _aligned(lines: Sequence[Line], label: str) -> Iterator[str]:
    """One formula on several lines, the number beside the last; a very long one in several displays."""
    for start in range(0, len(lines), _MOST_LINES):
        part = lines[start : start + _MOST_LINES]
        number = label if start + _MOST_LINES >= len(lines) else ""
        last = len(part) - 1
        rows = []
        for place, line in enumerate(part):
            indent = "\\qquad " if line.indented else ""
            tag = (number if place == last else r" \notag") if number else ""
            rows.append(f"{line.left} & {indent}{line.right}{tag}")
        star = "" if number else "*"
        body = " \\\\\n".join(rows)
        yield f"\\begin{{align{star}}}\n{body}\n\\end{{align{star}}}"
