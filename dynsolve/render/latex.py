r"""Documents -> LaTeX: a complete document, or a fragment to \input; amsmath and nothing else."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from dynsolve.document import (
    Block,
    Document,
    Fold,
    Formula,
    Heading,
    List,
    Note,
    Picture,
    Prose,
    Table,
    Text,
    Uses,
)
from dynsolve.notation.extent import Ruler
from dynsolve.notation.latex import LatexPrinter
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node
from dynsolve.render.flow import Notation
from dynsolve.render.latex_text import latex_text
from dynsolve.render.references import numbered, slug
from dynsolve.render.setting import Line, Setter
from dynsolve.render.words import spoken

PAGE = 42.8
"""The width of our own page, in em."""

FRAGMENT_PAGE = 32.8
"""The narrowest page of the standard classes, which a fragment must fit."""

_NUMBER = 3.4
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
\allowdisplaybreaks[1]
"""


def to_latex_document(document: Document, style: Style = PLAIN) -> str:
    """A complete document."""
    page = _Page(style, PAGE, document)
    title = next((block.text for block in document.blocks if isinstance(block, Heading)), "")
    body = "\n".join(page.blocks(b for b in document.blocks if not _is_title(b)))
    return (
        f"{_PREAMBLE}\\title{{{page.words(title)}}}\n\\author{{}}\n\\date{{}}\n\\begin{{document}}\n"
        f"\\maketitle\n\\thispagestyle{{plain}}\n{body}\n\\end{{document}}\n"
    )


def to_latex_fragment(document: Document, style: Style = PLAIN) -> str:
    r"""What a document of the reader's own takes in with \input; it needs amsmath."""
    page = _Page(style, FRAGMENT_PAGE, document)
    needs = r"% Needs \usepackage{amsmath}; for matrices of more than ten columns also \setcounter{MaxMatrixCols}{30}"
    return f"{needs}\n" + "\n".join(page.blocks(document.blocks)) + "\n"


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


class _Page:
    """Turns blocks into LaTeX; knows the page's width and the numbers of the equations."""

    def __init__(self, style: Style, width: float, document: Document) -> None:
        self.printer = LatexPrinter(style)
        ruler, notation = Ruler(style), latex_notation(self.printer)
        self.plain = Setter(notation, ruler, width)
        self.with_number = Setter(notation, ruler, width - _NUMBER)
        self.labels = numbered(document)
        self.prefix = slug(document)

    def blocks(self, blocks: Iterator[Block] | Sequence[Block]) -> Iterator[str]:
        """The blocks one after the other."""
        for block in blocks:
            yield from self.block(block)

    def block(self, block: Block) -> Iterator[str]:
        match block:
            case Heading(text, level):
                yield self.heading(text, level)
            case Text(parts):
                yield f"{self.prose(parts)}\n"
            case Formula():
                yield from self.formula(block)
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
                yield from self.blocks(blocks)

    def heading(self, text: str, level: int) -> str:
        """A heading keeps the number that it has in the whole derivation."""
        command = ("section", "section", "subsection")[level - 1]
        found = _NUMBERED.fullmatch(text)
        words = f"{found[1]}\\quad {self.words(found[2])}" if found else self.words(text)
        return f"\\{command}*{{{words}}}"

    def words(self, text: str) -> str:
        """Words, with the mathematics in them."""
        parts = (latex_text(p) if isinstance(p, str) else f"${self.printer.text(p)}$" for p in spoken(text))
        return "".join(parts)

    def prose(self, parts: Prose) -> str:
        """A sentence with its formulas."""
        return "".join(
            self.words(part) if isinstance(part, str) else f"${self.printer.text(part)}$" for part in parts
        )

    def uses(self, labels: Sequence[str]) -> Iterator[str]:
        known = [label for label in labels if label in self.labels]
        if known:
            references = [f"\\eqref{{{self.prefix}:{label}}}" for label in known]
            listed = ", ".join(references[:-1]) + " and " * (len(references) > 1) + references[-1]
            yield f"With {listed}:"

    def formula(self, formula: Formula) -> Iterator[str]:
        is_numbered = formula.label in self.labels
        lines = (self.with_number if is_numbered else self.plain).set(formula)
        if not lines:
            return
        if formula.source:
            yield f"\\mbox{{}}\\hfill{{\\footnotesize {self.words(formula.source)}}}\\nopagebreak"
        label = f"\\label{{{self.prefix}:{formula.label}}}" if is_numbered else ""
        yield _display(lines, label)

    def table(self, table: Table) -> str:
        rows = [" & ".join(map(self.cell, row)) for row in (table.header, *table.rows)]
        head, *body = rows
        columns = "c" * len(table.header)
        return (
            f"\\begin{{center}}\n\\begin{{tabular}}{{{columns}}}\n{head} \\\\ \\hline\n"
            + " \\\\\n".join(body)
            + " \\\\\n\\end{tabular}\n\\end{center}"
        )

    def cell(self, cell: str | Node) -> str:
        return self.words(cell) if isinstance(cell, str) else f"${self.printer.text(cell)}$"


def _display(lines: Sequence[Line], label: str) -> str:
    """Lines as a displayed equation, the number beside the last one."""
    star = "" if label else "*"
    if len(lines) == 1:
        text = (lines[0].left + " " + lines[0].right).strip()
        return f"\\begin{{equation{star}}}{label}\n{text}\n\\end{{equation{star}}}"
    last = len(lines) - 1
    rows = []
    for place, line in enumerate(lines):
        indent = "\\qquad " if line.indented else ""
        number = (label if place == last else r" \notag") if label else ""
        rows.append(f"{line.left} & {indent}{line.right}{number}")
    body = " \\\\\n".join(rows)
    return f"\\begin{{align{star}}}\n{body}\n\\end{{align{star}}}"
