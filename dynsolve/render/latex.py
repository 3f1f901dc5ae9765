r"""Documents -> LaTeX: a complete document, or a fragment to \input; amsmath and nothing else.

What stands before a text in LaTeX: the page and its lengths, and the macros of what amsmath lacks.

Any text as LaTeX text that pdflatex sets with its own fonts.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import chain, groupby, pairwise, zip_longest

from dynsolve.document import (
    Block,
    Document,
    Equations,
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
)
from dynsolve.notation.characters import GREEK
from dynsolve.notation.extent import FLAT
from dynsolve.notation.markup import ESCAPES, SIGNS, LatexPrinter
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node, Row, Words
from dynsolve.render.latex_displays import DisplayRow, aligned, gathered, in_columns
from dynsolve.render.line_breaking import (
    HEIGHTS,
    FormulaSplitter,
    Notation,
    height_around,
    is_long,
    numbered,
    running_title,
    sections,
    slug,
    together,
)
from dynsolve.render.page import PART, SHORT, TypesetPage, before_closing, introduces, prose_columns
from dynsolve.render.prose import visible

# What stands before a text in LaTeX

PREAMBLE = r"""\documentclass[a4paper]{article}
\usepackage{amsmath}
\setlength{\textwidth}{469pt}
\setlength{\oddsidemargin}{-8pt}
\setlength{\evensidemargin}{-8pt}
\setlength{\topmargin}{-60pt}
\setlength{\textheight}{757pt}
\setlength{\parindent}{0pt}
\setlength{\parskip}{3pt plus 1pt minus 1pt}
\setlength{\emergencystretch}{6em}
\binoppenalty=9999  % in a sentence a line hardly ends after a sign of a formula
\setlength{\jot}{2pt}
\delimitershortfall=3pt % of brackets around a column of fractions
\setcounter{MaxMatrixCols}{30}
\renewcommand{\arraystretch}{1.12}
\clubpenalty=10000 \widowpenalty=10000
\AtBeginDocument{\setlength{\abovedisplayskip}{3pt plus 2pt minus 2pt}\belowdisplayskip=\abovedisplayskip
  \abovedisplayshortskip=\abovedisplayskip \belowdisplayshortskip=\belowdisplayskip}
\makeatletter
\renewcommand\section{\@startsection{section}{1}{0pt}{-12pt plus -4pt minus -4pt}{4pt}{\Large\bfseries}}
\renewcommand\subsection{\@startsection{subsection}{2}{0pt}{-8pt plus -3pt minus -3pt}{2pt}%
  {\normalsize\bfseries}}
\def\@listi{\leftmargin\leftmargini \topsep=3pt plus 2pt minus 2pt \parsep=0pt \itemsep=0pt}\let\@listI\@listi
\newcommand\contentsrow[2]{\@dottedtocline{1}{0pt}{1.6em}{#1}{\pageref{#2}}}
% A reference that the first run does not know is as wide as the last number: pages stay where they are.
\def\@setref#1#2#3{\ifx#1\relax\G@refundefinedtrue\theequation\@latex@warning{Reference `#3' undefined}%
  \else\expandafter#2#1\null\fi}
\makeatother
\pagestyle{myheadings}
"""

# The source of a formula; equations in columns: a row moved in, a cell of a width with its name and the rest;
# rows of a table that goes on, under its header where they begin a page;
# what closes a document, on a page of its own where it fills enough of that and little is left of one.
MACROS = r"""\providecommand{\formulasource}[1]{\footnotesize #1}
\providecommand{\equationrow}[2]{\par\noindent\strut\hspace*{#1\dimexpr\linewidth-3.4em\relax}#2}
\providecommand{\equationcell}[4]{\makebox[#1\dimexpr\linewidth-3.4em\relax][l]{%
  \makebox[#2em][r]{$\displaystyle #3$}$\displaystyle {}#4$}}
\providecommand{\equationnumber}[1]{\hfill\refstepcounter{equation}(\theequation)#1}
\ifdefined\tablerows\else\newsavebox\tablerows\fi
\providecommand{\tablepart}[3]{{\parskip=0pt\lineskip=0pt
  \setbox\tablerows=\hbox{\begin{tabular}{#1}#3\end{tabular}}%
  \ifdim\dimexpr\ht\tablerows+\dp\tablerows>\dimexpr\pagegoal-\pagetotal\relax \ifinner\else
  \ifdim\dimexpr\pagetotal-\pageshrink\relax>\pagegoal\else  % else what stands above goes there by itself
  \newpage\setbox\tablerows=\hbox{\begin{tabular}{#1}#2#3\end{tabular}}\fi\fi\fi
  {\centering\usebox\tablerows\par}}}
\ifdefined\closingpage\else\newsavebox\closingpage\fi
\providecommand{\putclosingpage}{\penalty0 \ifdim\ht\closingpage>\textheight\else
  \ifdim\ht\closingpage>.25\textheight
  \ifdim\ht\closingpage>\dimexpr\pagegoal-\pagetotal\relax
  \ifdim\dimexpr\pagegoal-\pagetotal\relax<.35\textheight\newpage\fi\fi\fi\fi\unvbox\closingpage}
"""


NEEDS = r"""% Needs \usepackage{amsmath}, and where a matrix has more than ten columns
% \setcounter{MaxMatrixCols}{30}.
"""


# Any text as LaTeX text that pdflatex sets with its own fonts

_ESCAPES = {
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"\textquotedblright{}",
    "`": r"\textasciigrave{}",
    "'": r"{'}",
    "[": "{[}",
    "]": "{]}",
    "!": "{!}",
    "?": "{?}",
    "–": r"\textendash{}",
    "—": r"\textemdash{}",
    "−": "$-$",
    "“": r"\textquotedblleft{}",
    "”": r"\textquotedblright{}",
    "„": ",,",
    "‘": r"\textquoteleft{}",
    "’": r"\textquoteright{}",
    "…": r"\textellipsis{}",
    "°": r"$^\circ$",
    "·": r"$\cdot$",
    "•": r"$\bullet$",
    "×": r"$\times$",
    "÷": r"$\div$",
    "±": r"$\pm$",
    "½": r"$\tfrac12$",
    "¼": r"$\tfrac14$",
    "¾": r"$\tfrac34$",
    "²": "$^2$",
    "³": "$^3$",
    "¹": "$^1$",
    "≤": r"$\leq$",
    "≥": r"$\geq$",
    "≠": r"$\neq$",
    "≈": r"$\approx$",
    "→": r"$\rightarrow$",
    "⇒": r"$\Rightarrow$",
    "∂": r"$\partial$",
    "√": r"$\surd$",
    "Σ": r"$\Sigma$",
    "⋆": r"$\star$",
    "©": r"\textcopyright{}",
    "§": r"$\S$",
    "€": r"\texteuro{}",
    "£": r"\pounds{}",
    "ß": r"\ss{}",
    "æ": r"\ae{}",
    "Æ": r"\AE{}",
    "œ": r"\oe{}",
    "Œ": r"\OE{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "å": r"\aa{}",
    "Å": r"\AA{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
    "ı": r"\i{}",
    "\u00a0": "~",
}
_ESCAPES |= ESCAPES | {letter: rf"$\{name}$" for name, letter in GREEK.items()}

_ACCENTS = {
    "\u0300": r"\`",
    "\u0301": r"\'",
    "\u0302": r"\^",
    "\u0303": r"\~",
    "\u0304": r"\=",
    "\u0306": r"\u",
    "\u0307": r"\.",
    "\u0308": r"\"",
    "\u030a": r"\r",
    "\u030b": r"\H",
    "\u030c": r"\v",
    "\u0323": r"\d",
    "\u0327": r"\c",
    "\u0331": r"\b",
}


def latex_text(text: str) -> str:
    r"""Any text as LaTeX text; a letter that the fonts lack stands as its code point.

    >>> print(latex_text(r"Ü_1 \input{x} 中"))
    \"{U}\_1 \textbackslash{}input\{x\} {[}U+4E2D{]}
    """
    text = visible(text)
    pieces: list[str] = []
    for character in text:
        if character in _ESCAPES:
            pieces.append(_ESCAPES[character])
        elif character.isascii():
            pieces.append(character)
        elif unicodedata.combining(character) and character in _ACCENTS and pieces:
            pieces.append(f"{_ACCENTS[character]}{{{pieces.pop()}}}")
        else:
            pieces.append(_foreign(character))
    return "".join(pieces).replace("--", "-{}-").replace("--", "-{}-")


def _foreign(character: str) -> str:
    parts = unicodedata.normalize("NFD", character)
    if len(parts) == 2 and parts[0].isascii() and parts[1] in _ACCENTS:
        base = (
            {"i": r"\i", "j": r"\j"}.get(parts[0], parts[0]) if parts[1] not in "\u0323\u0327" else parts[0]
        )
        return f"{_ACCENTS[parts[1]]}{{{base}}}"
    plain = unicodedata.normalize("NFKD", character)
    if plain != character and plain.isascii() and plain.isalnum():
        return plain
    return f"{{[}}U+{ord(character):04X}{{]}}"


# Documents -> LaTeX: a complete document, or a fragment to \input; amsmath and nothing else

PAGE = 46.9
"""The width of our own page, in em of its letters of ten points."""

FRAGMENT_PAGE = 32.8
"""The narrowest page of the standard classes, which a fragment must fit."""

_NUMBER = 3.4
_MOST_ROWS = 18
_ROWS_TOGETHER = 3  # of a longer table
_COLUMN_SPACE = 1.3  # around a column of a table, in em
_NARROWEST = 7.0
_MARGIN = 0.8
_QUAD = 0.9  # what a comma between formulas takes more in LaTeX
_RAGGED = r"\rightskip=0pt plus 4em\relax "
"""Words in a narrow column are not stretched; \raggedright would take the ends of the rows away."""

_STRUTS = ((FLAT, ""), (2.6, r"\rule[-2.5ex]{0pt}{6.3ex}"), (99.0, r"\rule[-2.7ex]{0pt}{7.7ex}"))
"""What makes a row of a table as high as its formulas, each up to a height in em."""
_FENCES = ((FLAT, ""), (HEIGHTS[1], "big"), (1.8, "Big"), (2.4, "bigg"))
"""The sizes of parentheses, each up to a height in em."""
_ROW_SPACES = ((r"\left", r"\\[12pt]"), (r"\dfrac", r"\\[9pt]"))
"""How a row of a matrix ends that holds high parentheses, or fractions; counted from the foot of a line."""
_NUMBERED = re.compile(r"(\d+(?:\.\d+)*)\.? (.*)", re.DOTALL)


def render(document: Document, style: Style = PLAIN, *further: tuple[Document, Style]) -> str:
    """A complete document, and `further` ones behind it, each in its own style."""
    page = _Page(style, PAGE, document, contents=is_long(document))
    title = next((block.text for block in document.blocks if isinstance(block, Heading)), "")
    below = [block for block in document.blocks if not (isinstance(block, Heading) and block.level == 1)]
    body = "\n".join((*page.all(below), *(render_blocks(*each) for each in further)))
    words = page.words(title)
    return (
        f"{PREAMBLE}{MACROS}\\begin{{document}}\n\\markright{{{page.words(running_title(title))}}}\\thispagestyle{{plain}}\n"
        f"{{\\LARGE\\bfseries\\raggedright {words}\\par}}\n\\medskip\n{body}\n\\end{{document}}\n"
    )


def render_blocks(document: Document, style: Style) -> str:
    """The blocks of a document alone, after which others follow; one that has a title begins a page."""
    page = _Page(style, FRAGMENT_PAGE, document)
    page.closing = ()
    begin = ["\\newpage"] if document.is_titled else []
    return "\n".join((*begin, *page.all(document.blocks)))


def render_fragment(document: Document, style: Style = PLAIN, *further: tuple[Document, Style]) -> str:
    r"""A fragment for \input into another document; it needs amsmath."""
    page = _Page(style, FRAGMENT_PAGE, document)
    body = "\n".join((*page.all(document.blocks), *(render_blocks(*each) for each in further)))
    begin = "\\begingroup\\emergencystretch=6em\\renewcommand{\\arraystretch}{1.12}"
    return f"{NEEDS}{MACROS}{begin}\n{body}\n\\par\\endgroup\n"


def of_class(name: str, body: str) -> str:
    """A complete document of another class, whose page and headings it has."""
    return (
        f"\\documentclass[a4paper]{{{name}}}\n\\usepackage{{amsmath}}\n\\setcounter{{MaxMatrixCols}}{{30}}\n"
        f"{MACROS}\\begin{{document}}\n{body}\n\\end{{document}}\n"
    )


def _fence(sign: str, height: float) -> str:
    """A parenthesis of a height in em."""
    size = next((size for most, size in _FENCES if height <= most), "Bigg")
    return f"\\{size}{'l' if sign == '(' else 'r'}{sign}" if size else sign


def latex_notation(printer: LatexPrinter) -> Notation:
    """The signs of a formula in LaTeX."""
    return Notation(
        text=printer.text,
        plus="{} +",
        minus="{} -",
        lead="-",
        times=r"{} \cdot",
        relation=lambda sign: "{} " + SIGNS.get(sign, sign),
        fence=_fence,
        raised=lambda sign, exponent: f"{sign}^{{{exponent}}}",
        joined=" ".join,
    )


class _Printer(LatexPrinter):
    """LaTeX for a page: what stands side by side has room, fractions in a matrix are as large as others.

    Rows of a matrix with fractions or high parentheses do not touch the rows beside them.
    """

    def parenthesized(self, text: str) -> str:
        """The text in parentheses, which are larger than those in it."""
        whole = super().parenthesized(text)
        height = height_around(text, _fence)
        if height == FLAT or whole[0] != "(":
            return whole
        return f"{_fence('(', height)}{text}{_fence(')', height)}"

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        lines = [" & ".join(row).replace(r"\frac", r"\dfrac") for row in rows]
        ends = []
        for rows_of in pairwise(lines):  # room between two rows where one of them is high
            high = (f" {end} " for sign, end in _ROW_SPACES if any(sign in line for line in rows_of))
            ends.append(next(high, r" \\ "))
        body = "".join(chain.from_iterable(zip(lines, [*ends, ""], strict=True)))
        return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"

    def _words(self, node: Words) -> str:
        if node.text == ", ":
            return r",\quad"
        return "," if node.text == "," else super()._words(node)


class _Page(TypesetPage):
    """Turns blocks into LaTeX."""

    def __init__(self, style: Style, width: float, document: Document, contents: bool = False) -> None:
        printer = _Printer(style)
        super().__init__(printer, latex_notation(printer), numbered(document), width, _NUMBER)
        self.prefix = slug(document)
        self.sections = sections(document) if contents else ()
        self.contents_are_due = contents
        self.close(document)
        self.end_is_due = True

    def all(self, blocks: Sequence[Block]) -> Iterator[str]:
        """The blocks of a document, the closing ones on one page where they fit one."""
        before, end = before_closing(blocks)
        yield from self.blocks(before)
        if end:
            yield "\\par\\setbox\\closingpage=\\vbox\\bgroup"
            yield from self.blocks(end)
            yield "\\par\\egroup\\putclosingpage"

    def blocks(self, blocks: Iterable[Block]) -> Iterator[str]:
        """The blocks one after the other, formulas that follow each other in one display.

        A paragraph stays with the display after it, and the last rows of the document on one page; above a
        display that follows a list, a note or a table TeX would leave a line empty.
        """
        in_text, is_closed = False, False
        listed = list(blocks)
        pairs = zip_longest(listed, listed[1:])
        kinds = groupby(pairs, lambda pair: (isinstance(pair[0], Formula), self.closes(pair[0])))
        for (are_formulas, close), run in kinds:
            if close and self.end_is_due:
                self.end_is_due = False
                yield "\\samepage"
            if are_formulas:
                shown = list(run)
                yield from ["\\noindent"] if is_closed else []
                formulas = [block for block, _ in shown if isinstance(block, Formula)]
                yield from self.formulas(formulas, shown[-1][1])
                in_text, is_closed = True, False
                continue
            for block, following in run:
                if isinstance(block, Equations):
                    yield from ["\\noindent"] if is_closed else []
                elif in_text:
                    yield ""
                yield from self.block(block)
                in_text, is_closed = isinstance(block, Text | Uses), isinstance(block, List | Note | Table)
                if in_text and (close or introduces(block, following)):
                    yield "\\nopagebreak"

    def heading(self, heading: Heading) -> Iterator[str]:
        """A heading keeps the number that it has in the whole derivation."""
        command = ("section", "section", "subsection")[heading.level - 1]
        words = self.numbered_words(heading)
        if heading.level == 2 and self.contents_are_due:
            self.contents_are_due = False
            yield from self.contents()
        label = f"\\label{{{self.page_of(heading)}}}" if heading in self.sections else ""
        yield f"\\{command}*{{{words}}}{label}"

    def contents(self) -> Iterator[str]:
        """The sections with their pages; as tall when TeX does not know these yet, so two runs are enough."""
        yield "{\\medskip\\parskip=0pt"
        for heading in self.sections:
            yield f"\\contentsrow{{{self.numbered_words(heading)}}}{{{self.page_of(heading)}}}"
        yield "\\par}"

    def page_of(self, section: Heading) -> str:
        """The label of a section."""
        return f"{self.prefix}:section-{self.sections.index(section) + 1}"

    def numbered_words(self, heading: Heading) -> str:
        """The words of a heading after its number, where it has one."""
        found = _NUMBERED.fullmatch(heading.text)
        return f"{found[1]}\\quad {self.words(found[2])}" if found else self.words(heading.text)

    def text(self, text: Text) -> Iterator[str]:
        yield self.prose(text.parts)

    def formula(self, formula: Formula) -> Iterator[str]:
        yield from self.formulas([formula])

    def formulas(self, formulas: Sequence[Formula], after: Block | None = None) -> Iterator[str]:
        """Displays: formulas of one line together, level where they are results, one that is broken alone."""
        rows: list[DisplayRow] = []
        for formula, following in pairwise([*formulas, after]):
            assert isinstance(formula, Formula)
            last = self.kept(formula)
            stays = self.closes(formula) or introduces(
                formula, following, following is formulas[-1] and self.is_lost(following)
            )
            columns = self.columns(formula)
            lines = [] if columns else self.lines_of(formula)
            label = self.label(formula)
            if len(lines) == 1:
                line = self.level_result(formula)
                rows.append(DisplayRow(line or lines[0], label, line is not None, stays))
                continue
            yield from gathered(rows)
            rows = []
            if columns:
                yield from in_columns(columns, label, last)
            elif lines:
                yield from aligned(lines, label, last, stays)
        yield from gathered(rows)

    def label(self, display: Formula | Equations) -> str:
        """What stands beside a display: its number, or its source."""
        if display.label in self.labels:
            return f"\\label{{{self.prefix}:{display.label}}}"
        source = display.source if isinstance(display, Formula) else ""
        return f"\\tag*{{\\formulasource{{{self.words(source)}}}}}" if source else ""

    def equations(self, equations: Equations) -> Iterator[str]:
        columns = self.columns(equations)
        if columns is not None:
            yield from in_columns(columns, self.label(equations), self.kept(equations))
        else:
            yield from aligned(self.lines_of(equations), self.label(equations), self.kept(equations))

    def whole_or_pieces(self, node: Node) -> str:
        """A formula that is not broken, or pieces between which it may be, outside its parentheses."""
        narrow = self.width / 4
        if self.ruler.width(node) <= min(SHORT, 1.5 * narrow):
            return f"${{{self.printer.text(node)}}}$"
        parts = FormulaSplitter(self.notation, self.ruler).pieces(node)
        pieces = together(parts, min(PART, narrow), " ".join)
        return r"\allowbreak{}".join(f"${{{piece.text}}}$" for piece in pieces)

    def reference(self, label: str, number: int) -> str:
        return f"\\eqref{{{self.prefix}:{label}}}"

    def uses(self, sentence: str) -> Iterator[str]:
        yield sentence

    def list(self, items: Sequence[Prose]) -> Iterator[str]:
        yield "\\begin{itemize}\\itemsep=0pt\\parskip=0pt"
        yield from (f"\\item {self.prose(item)}" for item in items)
        yield "\\end{itemize}"

    def note(self, parts: Prose) -> Iterator[str]:
        yield f"\\begin{{quote}}\\small\\textbf{{Note.}} {self.prose(parts)}\\end{{quote}}"

    def table(self, table: Table) -> Iterator[str]:
        """A tabular, which stays on one page; a long one in several, each page of it with the header."""
        prose = prose_columns(table)
        head, *body = [self.row(row, prose) for row in (table.header, *table.rows)]
        is_long = len(body) > _MOST_ROWS
        columns = self.column_kinds(table, is_long)
        size = _ROWS_TOGETHER if is_long else len(body)
        yield "\\par\\medskip"
        for start in range(0, len(body) or 1, size or 1):
            rows = "\n".join(body[start : start + size])
            above = f"{head} \\hline\\rule{{0pt}}{{2.6ex}}%\n"
            if start:
                yield f"\\tablepart{{{columns}}}{{{above}}}{{%\n{rows}}}"
                continue
            tabular = f"\\begin{{tabular}}{{{columns}}}\n{above}{rows}\n\\end{{tabular}}"
            yield f"{{\\parskip=0pt\\lineskip=0pt\\centering{tabular}\\par}}"
        yield "\\nopagebreak\\medskip" if self.closes(table) else "\\medskip"

    def row(self, cells: Sequence[Inline], prose: Collection[int]) -> str:
        """A row of a tabular; around fractions there is room to the rows beside it."""
        height = max((self.ruler.height(cell) for cell in cells if isinstance(cell, Node)), default=FLAT)
        tall = height > FLAT
        texts = [
            f"$\\displaystyle {self.printer.text(cell)}$"
            if tall and isinstance(cell, Node)
            else f"{_RAGGED * (k in prose)}{self.part(cell)}"
            for k, cell in enumerate(cells)
        ]
        strut = next(strut for most, strut in _STRUTS if height <= most)
        return strut + " & ".join(texts) + r" \\"

    def column_kinds(self, table: Table, fixed: bool) -> str:
        """The columns of a tabular, of `fixed` widths or as wide as they are.

        Of a table that is wider than the page the widest column has broken lines.
        """
        columns = zip(*(table.header, *table.rows), strict=True)
        widths = [max(map(self.cell_width, column)) + _COLUMN_SPACE for column in columns]
        if prose := prose_columns(table):
            widths = [width + _MARGIN for width in widths]
            others = sum(width for k, width in enumerate(widths) if k not in prose)
            room = self.room_of_prose(others, len(prose))
            own = [f"p{{{width - _COLUMN_SPACE:.1f}em}}" if fixed else "l" for width in widths]
            return "".join(f"p{{{room:.1f}em}}" if k in prose else kind for k, kind in enumerate(own))
        kinds = ["c"] * len(widths)
        if sum(widths) > self.width:
            widest = widths.index(max(widths))
            room = self.width - sum(widths) + widths[widest] - _COLUMN_SPACE
            kinds[widest] = f"p{{{max(room, _NARROWEST):.1f}em}}"
        return "".join(kinds)

    def room_of_prose(self, others: float, columns: int) -> float:
        """The width of a column of words, beside columns that are so wide together."""
        return min((self.width - others) / columns - _COLUMN_SPACE, self.width / 2)

    def cell_width(self, cell: Inline) -> float:
        """The width of a cell of a table, in em."""
        if not isinstance(cell, Node):
            return 0.5 * len(str(cell))
        commas = sum(part == Words(", ") for part in cell.parts) if isinstance(cell, Row) else 0
        return self.ruler.width(cell) + _QUAD * commas

    def picture(self, picture: Picture) -> Iterator[str]:
        if picture.latex:
            caption = self.words(picture.caption)
            yield f"\\begin{{center}}\n{picture.latex}\n\n\\nopagebreak\\small {caption}\n\\end{{center}}"

    def escaped(self, text: str) -> str:
        return latex_text(text)

    def verbatim(self, text: str) -> str:
        return f"\\texttt{{{latex_text(text)}}}"
