r"""Documents -> LaTeX: a complete document, or a fragment to \input; amsmath and nothing else."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, groupby

from dynsolve.document import (
    Block,
    Document,
    Formula,
    Heading,
    Picture,
    Prose,
    Table,
    Text,
    Uses,
)
from dynsolve.notation.latex import SIGNS, LatexPrinter
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node, Words
from dynsolve.render.latex_text import latex_text
from dynsolve.render.line_breaking import Notation
from dynsolve.render.page import TypesetPage
from dynsolve.render.references import numbered, slug
from dynsolve.render.typesetting import Line

PAGE = 42.8
"""The width of our own page, in em."""

FRAGMENT_PAGE = 32.8
"""The narrowest page of the standard classes, which a fragment must fit."""

_NUMBER = 3.4
_MOST_LINES = 60  # what TeX holds in memory at once is bounded
_TALL = (r"\frac", r"\sum", r"\begin")
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
    r"""A fragment for \input into another document; it needs amsmath."""
    page = _Page(style, FRAGMENT_PAGE, document)
    body = "\n".join(page.blocks(document.blocks))
    begin = "\\begingroup\\allowdisplaybreaks[3]\\emergencystretch=4em"
    return f"{_NEEDS}{_MACROS}{begin}\n{body}\n\\par\\endgroup\n"


def _is_title(block: Block) -> bool:
    return isinstance(block, Heading) and block.level == 1


def latex_notation(printer: LatexPrinter) -> Notation:
    """The signs of a formula in LaTeX."""

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
        relation=lambda sign: "{} " + SIGNS.get(sign, sign),
        opened=opened,
        closed=closed,
        joined=" ".join,
    )


class _Printer(LatexPrinter):
    """LaTeX for a page: rows with fractions in them stand further apart, formulas side by side too."""

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        lines = [" & ".join(row) for row in rows]
        ends = [r" \\[3pt] " if r"\frac" in line else r" \\ " for line in lines[:-1]]
        body = "".join(chain.from_iterable(zip(lines, [*ends, ""], strict=True)))
        return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"

    def _words(self, node: Words) -> str:
        if node.text == ", ":
            return r",\quad"
        return "," if node.text == "," else super()._words(node)


class _Page(TypesetPage):
    """Turns blocks into LaTeX."""

    def __init__(self, style: Style, width: float, document: Document) -> None:
        printer = _Printer(style)
        super().__init__(printer, latex_notation(printer), numbered(document), width, _NUMBER)
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

    def heading(self, heading: Heading) -> Iterator[str]:
        """A heading keeps the number that it has in the whole derivation."""
        command = ("section", "section", "subsection")[heading.level - 1]
        found = _NUMBERED.fullmatch(heading.text)
        words = f"{found[1]}\\quad {self.words(found[2])}" if found else self.words(heading.text)
        yield f"\\{command}*{{{words}}}"

    def text(self, text: Text) -> Iterator[str]:
        source = f"\\formulasource{{{self.words(text.source)}}}" if text.source else ""
        yield self.prose(text.parts) + source

    def formula(self, formula: Formula) -> Iterator[str]:
        yield from self.formulas([formula])

    def formulas(self, formulas: Iterable[Formula]) -> Iterator[str]:
        """Displays: formulas of one line together, one that is broken alone."""
        rows: list[tuple[Line, str]] = []
        for formula in formulas:
            lines = self.typesetter(formula).set(formula)
            is_numbered = formula.label in self.labels
            label = f"\\label{{{self.prefix}:{formula.label}}}" if is_numbered else ""
            if len(lines) == 1:
                rows.append((lines[0], label))
            elif lines:
                yield from _gathered(rows)
                rows = []
                yield from _aligned(lines, label)
        yield from _gathered(rows)

    def equations(self, nodes: Sequence[Node]) -> Iterator[str]:
        yield from _aligned(self.unnumbered.equations(nodes), "")

    def reference(self, label: str) -> str:
        return f"\\eqref{{{self.prefix}:{label}}}"

    def uses(self, sentence: str) -> Iterator[str]:
        yield sentence

    def list(self, items: Sequence[Prose]) -> Iterator[str]:
        yield "\\begin{itemize}"
        yield from (f"\\item {self.prose(item)}" for item in items)
        yield "\\end{itemize}"

    def note(self, parts: Prose) -> Iterator[str]:
        yield f"\\begin{{quote}}\\small\\textbf{{Note.}} {self.prose(parts)}\\end{{quote}}"

    def table(self, table: Table) -> Iterator[str]:
        rows = [" & ".join(map(self.part, row)) for row in (table.header, *table.rows)]
        head, *body = rows
        columns = "c" * len(table.header)
        yield (
            f"\\begin{{center}}\n\\begin{{tabular}}{{{columns}}}\n{head} \\\\ \\hline\\rule{{0pt}}{{2.6ex}}"
            + " \\\\\n".join(body)
            + " \\\\\n\\end{tabular}\n\\end{center}"
        )

    def picture(self, picture: Picture) -> Iterator[str]:
        if picture.latex:
            caption = self.words(picture.caption)
            yield f"\\begin{{center}}\n{picture.latex}\n\n\\small {caption}\n\\end{{center}}"

    def escaped(self, text: str) -> str:
        return latex_text(text)

    def verbatim(self, text: str) -> str:
        return f"\\texttt{{{latex_text(text)}}}"


def _gathered(rows: Sequence[tuple[Line, str]]) -> Iterator[str]:
    """Formulas of one line each, one under the other."""
    if not rows:
        return
    texts = [line.alone for line, _ in rows]
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
            tag = (number if place == last else r" \notag") if number else ""
            rows.append(line.aligned("\\qquad ") + tag)
        star = "" if number else "*"
        body = " \\\\\n".join(rows)
        yield f"\\begin{{align{star}}}\n{body}\n\\end{{align{star}}}"
