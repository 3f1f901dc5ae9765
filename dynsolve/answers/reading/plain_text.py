"""Equations in plain text: lines `tau1 = ...`, as they are typed and as MATLAB and Python print them.

Formulas in two dimensions, as SymPy prints them, and matrices drawn in plain text -> one line.

Exponents stand on the line above, fractions over a line of dashes, brackets go over several lines:

          2 ⎛  2        ⎞
        θ̇₁ ⋅⎝L₂ ⋅m₂ + I₁⎠
    K = ─────────────────
                2

A formula is read from left to right along its base line, which is that of what stands leftmost.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator

from msgspec import Struct, field

from dynsolve.answers.reading.grids import MAX_NESTING
from dynsolve.answers.reading.left_side import LeftSide, NamedAnswers, UnknownSide, side_of
from dynsolve.answers.reading.matrix_parts import rest_is_zero
from dynsolve.answers.reading.printed_rows import printed_matrix
from dynsolve.answers.reading.report_text import is_of_one_case
from dynsolve.answers.reading.set_text import AND, SO
from dynsolve.answers.reading.sources import HIDDEN, levels
from dynsolve.answers.reading.vocabulary import Vocabulary

_BRACKETS = {"[": ("[", "]"), "(": ("(", ")"), **dict.fromkeys("/\\|", ("/\\|", "/\\|"))}
_BRACKETS |= dict.fromkeys("⎛⎜⎝⎡⎢⎣", ("⎛⎜⎝⎡⎢⎣", "⎞⎟⎠⎤⎥⎦"))
"""What a bracket over several lines may go on with, and what closes it."""

_OF_MATRIX = frozenset("⎡[(|")
_BARS = frozenset("─-")
_CELL = re.compile("[^\u0307\u0308][\u0307\u0308]*")
_BESIDE = re.compile(r"[ \t0-9/\\|]+")
"""A line with exponents alone, or with brackets beside them."""

_HEAD = re.compile(r"[ \t]*([^\s=:][^=:\n]{0,40}?)[ \t]*(?::=|[=:])[ \t]*$", re.MULTILINE)
_ROW = re.compile(r"(?:\[\[|[|\[⎡⎢⎣])([^\]|⎤⎥⎦=]*)(?:\]\]|[|\]⎤⎥⎦]),?")
_BETWEEN_CELLS = re.compile(r",[ \t]*(?![^()]*\))|[ \t]{2,}(?![^()]*\))")
_BESIDE_MATRIX = re.compile(r"(?<=\])[ ]{2,}(?=[^\s=\[\]]{1,40}[ ]*=)")
_PROMPT = re.compile(r"\(%[io][0-9]{1,4}\)")
_DERIVATIVE = re.compile(r"[d∂](?:\^\d)?")
_LONGEST, _MOST_LINES = 20_000, 100


class _NoFormulaError(Exception):
    """What was drawn is no formula of this kind."""


class _Box(Struct, frozen=True):
    """A part of what was drawn: rows from `top` to before `bottom`, columns from `left` to before `right`."""

    top: int
    bottom: int
    left: int
    right: int


def one_line(paragraph: str, names_answer: Callable[[str], bool]) -> str:
    """The equation that a paragraph draws over several lines, in one line; empty where it draws none."""
    if "\n" not in paragraph or len(paragraph) > _LONGEST or not _is_drawn(paragraph):
        return ""
    paragraph = _PROMPT.sub(lambda found: " " * len(found[0]), paragraph)
    head = _HEAD.match(paragraph)
    drawn = paragraph[head.end() :].strip("\n") if head else paragraph
    if drawn.count("\n") > _MOST_LINES:
        return ""
    picture = _Picture([_CELL.findall(line.expandtabs()) for line in drawn.split("\n")])
    try:
        text = _BESIDE_MATRIX.sub("; ", picture.text())
    except (_NoFormulaError, RecursionError):
        text = ""
    text = f"{head[1]} = {text}" if head and text else text or _row_by_row(paragraph)
    name, sign, _ = text.partition("=")
    return text if sign and names_answer(name.strip()) else ""


def _row_by_row(paragraph: str) -> str:
    """The matrices whose rows stand on one line each, side by side and not aligned; empty for others."""
    heads: dict[int, str] = {}
    matrices: dict[int, list[str]] = {}
    for line in paragraph.split("\n"):
        end = 0
        for place, found in enumerate(_ROW.finditer(line)):
            if name := line[end : found.start()].strip():
                if place in heads:
                    return ""
                heads[place] = name
            if row := found[1].strip():
                matrices.setdefault(place, []).append(", ".join(_BETWEEN_CELLS.split(row)))
            end = found.end()
        if (rest := line[end:].strip(" \t,;")) and (end or heads):
            return ""
        heads |= {0: rest} if rest else {}
    if heads.keys() != matrices.keys() or not all(map(_HEAD.fullmatch, heads.values())):
        return ""
    return "; ".join(f"{heads[place]} [[{'], ['.join(rows)}]]" for place, rows in sorted(matrices.items()))


def _is_drawn(paragraph: str) -> bool:
    """Whether brackets over lines, a line of dashes or one of exponents stand in a paragraph."""
    lines = paragraph.split("\n")
    ends = [line.rstrip()[-1:] for line in lines]
    is_matrix = any(end and end in "|])" and end == below for end, below in itertools.pairwise(ends))
    has_signs = any(sign in paragraph for sign in ("⎛", "⎡", "─", "--"))
    return has_signs or is_matrix or any(line.strip() and _BESIDE.fullmatch(line) for line in lines)


class _Picture(Struct):
    """Lines cut into cells, a letter with its dots being one; `read` are those that were read."""

    lines: list[list[str]]
    read: set[tuple[int, int]] = field(default_factory=set)
    depth: int = 0

    def text(self) -> str:
        """All of it as one line."""
        whole = _Box(0, len(self.lines), 0, max(map(len, self.lines)))
        found = self._formula(whole)
        cells = ((row, column) for row, line in enumerate(self.lines) for column in range(len(line)))
        if any(self._at(*cell) != " " and cell not in self.read for cell in cells):
            raise _NoFormulaError
        return found

    def _at(self, row: int, column: int) -> str:
        line = self.lines[row] if 0 <= row < len(self.lines) else []
        return line[column] if 0 <= column < len(line) else " "

    def _take(self, row: int, column: int) -> str:
        self.read.add((row, column))
        return self._at(row, column)

    def _is_blank(self, box: _Box) -> bool:
        return all(
            self._at(row, column) == " "
            for row in range(box.top, box.bottom)
            for column in range(box.left, box.right)
        )

    def _formula(self, box: _Box, base: int = -1) -> str:
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise _NoFormulaError
        base = self._base_line(box) if base < 0 else base
        out: list[str] = []
        column = box.left
        while column < box.right:
            sign = self._at(base, column)
            above = _Box(box.top, base, column, column + 1)
            if sign == " " and not self._is_blank(above) and out:
                column = self._exponent(box, base, column, out)
            elif sign in _BARS and self._is_fraction(box, base, column):
                column = self._fraction(box, base, column, out)
            elif (rows := self._bracket(box, base, column)) is not None:
                column = self._bracketed(rows, base, column, out)
            else:
                out.append(self._take(base, column))
                column += 1
        self.depth -= 1
        return "".join(out).strip()

    def _base_line(self, box: _Box) -> int:
        """The line of what stands leftmost: of several signs there a line of dashes, the longest."""
        if box.bottom - box.top == 1:
            return box.top
        for column in range(box.left, box.right):
            rows = [row for row in range(box.top, box.bottom) if self._at(row, column) != " "]
            if not rows:
                continue
            bars = [row for row in rows if self._is_fraction(box, row, column)]
            if bars:
                return max(bars, key=lambda row: self._bar_end(box, row, column))
            if len(rows) == 1:
                return rows[0]
            inside = self._bracket(box, rows[0], column)
            if inside is None:
                raise _NoFormulaError
            if self._at(rows[0], column) in _OF_MATRIX:
                return rows[len(rows) // 2]
            return self._base_line(_Box(inside.top, inside.bottom, inside.left + 1, inside.right))
        raise _NoFormulaError

    def _bar_end(self, box: _Box, row: int, column: int) -> int:
        end = column
        while end < box.right and self._at(row, end) == self._at(row, column):
            end += 1
        return end

    def _is_fraction(self, box: _Box, row: int, column: int) -> bool:
        """Whether a line of dashes begins there, with something above and below."""
        sign = self._at(row, column)
        begins = column == box.left or self._at(row, column - 1) != sign
        if sign not in _BARS or not begins or not box.top < row < box.bottom - 1:
            return False
        end = self._bar_end(box, row, column)
        above, below = _Box(row - 1, row, column, end), _Box(row + 1, row + 2, column, end)
        return not self._is_blank(above) and not self._is_blank(below)

    def _fraction(self, box: _Box, base: int, column: int, out: list[str]) -> int:
        end = self._bar_end(box, base, column)
        for place in range(column, end):
            self._take(base, place)
        above = self._formula(_Box(box.top, base, column, end))
        below = self._formula(_Box(base + 1, box.bottom, column, end))
        is_derivative = _DERIVATIVE.fullmatch(above) and below[:1] == above[:1]
        out.append(f"{above}/{below}" if is_derivative else f"(({above})/({below}))")
        return end

    def _exponent(self, box: _Box, base: int, column: int, out: list[str]) -> int:
        """What stands higher, where the base line is blank."""
        end = column
        while end < box.right and self._at(base, end) == " ":
            if self._is_blank(_Box(box.top, base, end, end + 1)):
                break
            end += 1
        power = self._formula(_Box(box.top, base, column, end))
        if out[-1] == " ":
            raise _NoFormulaError
        out.append(f"^{power}" if power.isdigit() else f"^({power})")
        return end

    def _bracket(self, box: _Box, row: int, column: int) -> _Box | None:
        """The rows and columns between a bracket over several lines and the one that closes it."""
        sign = self._at(row, column)
        signs, closing = _BRACKETS.get(sign, ("", ""))
        if not signs:
            return None
        top, bottom = row, row + 1
        while top > box.top and self._at(top - 1, column) in signs:
            top -= 1
        while bottom < box.bottom and self._at(bottom, column) in signs:
            bottom += 1
        if bottom - top < 2:
            return None
        is_matrix = self._at(top, column) in _OF_MATRIX
        level = 0
        for end in range(column, box.right):
            heights = [self._at(r, end) for r in range(top, bottom)]
            opens = all(s in signs for s in heights) and (sign not in "/\\|" or self._opens(heights))
            closes = all(s in closing for s in heights) and (sign not in "/\\|" or not self._opens(heights))
            if set(heights) == {"|"} and sign in "/\\|":
                opens, closes = level == 0, level > 0
            level += opens - closes
            if closes and level == 0 and (not is_matrix or end > column):
                return _Box(top, bottom, column, end)
        return None

    @staticmethod
    def _opens(signs: list[str]) -> bool:
        return signs[0] == "/" and signs[-1] == "\\"

    def _bracketed(self, rows: _Box, base: int, column: int, out: list[str]) -> int:
        for row in range(rows.top, rows.bottom):
            self.read |= {(row, rows.left), (row, rows.right)}
        inside = _Box(rows.top, rows.bottom, rows.left + 1, rows.right)
        if self._at(rows.top, column) in _OF_MATRIX:
            out.append(self._matrix(inside))
        else:
            out.append(f"({self._formula(inside, base)})")
        return rows.right + 1

    def _matrix(self, box: _Box) -> str:
        rows = [[self._formula(cell).rstrip(",") for cell in row] for row in self._cells(box)]
        if len({len(row) for row in rows}) != 1:
            raise _NoFormulaError
        return "[" + ", ".join(f"[{', '.join(row)}]" for row in rows) + "]"

    def _cells(self, box: _Box) -> list[list[_Box]]:
        """The entries: bands of lines between blank ones, cut where no line has a sign."""
        bands: list[list[int]] = [[]]
        for row in range(box.top, box.bottom):
            if self._is_blank(_Box(row, row + 1, box.left, box.right)):
                bands.append([])
            else:
                bands[-1].append(row)
        bands = [band for band in bands if band]
        if len(bands) == 1:
            bands = self._lines(box, bands[0])
        spans = [self._spans(_Box(band[0], band[-1] + 1, box.left, box.right)) for band in bands]
        if len({len(row) for row in spans}) > 1:
            spans = [self._spans(box)] * len(bands)
        return [
            [_Box(band[0], band[-1] + 1, *span) for span in row]
            for band, row in zip(bands, spans, strict=True)
        ]

    def _lines(self, box: _Box, band: list[int]) -> list[list[int]]:
        """The lines of a matrix without blank ones between its rows: one of exponents belongs to the next."""
        found: list[list[int]] = [[]]
        for row in band:
            found[-1].append(row)
            text = "".join(self._at(row, column) for column in range(box.left, box.right))
            if not re.fullmatch(r"[0-9 ]*[ ]{2}[0-9 ]*", text) or row == band[-1]:
                found.append([])
        return [rows for rows in found if rows]

    def _spans(self, box: _Box) -> list[tuple[int, int]]:
        """The stretches of columns between two or more blank ones."""
        spans: list[tuple[int, int]] = []
        blanks = 2
        for column in range(box.left, box.right):
            if self._is_blank(_Box(box.top, box.bottom, column, column + 1)):
                blanks += 1
                continue
            if blanks > 1:
                spans.append((column, column + 1))
            spans[-1] = (spans[-1][0], column + 1)
            blanks = 0
        return spans


# Equations in plain text

_LINE_HEAD = r"[ \t]*[^\s=:][^=:\n]{0,40}[ \t]*(?::=|[=:])[ \t]*"
_COUNTED = r"(?:[0-9]{1,2}(?:\.[0-9]{1,2}){0,2}[a-z]?|[A-Za-z](?:\.[0-9]{1,2})?|[ivx]{2,4})"
_LEAD = re.compile(
    r"[ \t]*(?:\(%[io][0-9]{1,4}\)[ \t]*|[-=>]{0,2}>[ \t]+|[-*+•][ \t]+)?"
    rf"(?:\({_COUNTED}\.?\)[ \t]+|\([0-9.]{{1,6}}\)|(?:{_COUNTED}|[A-Za-z]{{1,2}}[0-9])[.)][ \t]+"
    r"|[0-9]{1,2}\.[0-9]{1,2}[ \t]+(?=[A-Za-z\\]))?"
    r"(?:(?:[Ll]et|[Ss]ei|[Ll]a|[Ww]here|[Ww]ith|[Ww]obei|[Mm]it|[Mm]ed|[Dd]er|[Hh]vor)[ \t]+"
    r"(?=[^\s=]{1,20}[ \t]*=))?"
)
"""What stands before an equation in its line: a prompt, the mark of a list, its number."""

_EQUATION = re.compile(r"[^\n=]{1,5000}=")
_CALLED = re.compile(r"[ \t]*(?:>>>[ \t]+)?Eq\((?P<sides>[^\n=]{3,9999})\)[ \t]*\Z")
"""SymPy's `Eq(a, b)` of a whole line."""

_ITEM = re.compile(r"[-=>]{0,2}>[ \t]|[-*+][ \t]+[^=]{1,60}=|[-*+][ \t]+[^\s:]{1,40}:[ \t]")
"""The next item of a list, or what an arrow leads to: no term of the equation above."""

_NAMED = re.compile(r"([^\s:=|$]{1,40})[ \t]?:[ \t]+(?=\S)")
_TERMINATOR = re.compile(r"\$[ \t]*\Z")
"""The sign that ends a line of Maxima without showing its value."""

_SAID = re.compile(r"[^\n=$]{1,150}:[ \t]+(?=[^\n=]{1,5000}=)")
"""A label before an equation, in which no colon can stand: `Energy: K = ...`, `For r: m r'' + ... = 0`."""

_WORDS = re.compile(
    rf"(?:[^\W\d_]{{2,30}}[,.]?[ \t]+){{1,20}}(?:{_COUNTED}[.)][ \t]+)?(?=[^\s:=]{{1,40}}[ \t]*=)"
)
"""The words of a sentence before an equation: `The potential energy P = ...`."""

_NAME_ALONE = re.compile(r"[^\s:=]{1,40}[ \t]*=")
_LEADS = re.compile(rf"(?:{SO}|{AND})[,:]?[ \t]+", re.IGNORECASE)
_A_WORD = re.compile(r"[^\W\d_]{2,30}[,:]?[ \t]+")
_FORMULA = re.compile(r"(?![=*/^,;:)])[^\n=]*?[-+*/^('\u0307\u0308][^\n=]*=")
"""How an equation goes on whose left side is more than a name: not with a sign that joins it to a word."""

_SPOKEN = re.compile(
    r"(?:(?:the|total|die|gesamte|den|totale?)[ \t]+)*(?:"
    r"(?P<K>kinetic energy|kinetische energie|kinetiske? energi(?:en)?)"
    r"|(?P<P>potential energy|poten[tz]ielle energie|potensielle? energi(?:en)?)"
    r"|(?P<L>lagrangian|lagrange[- ]?fun(?:ktion|ksjon(?:en)?))"
    r"|(?P<D>(?:inertia|mass) matrix|(?:massen|tr[äa]gheits)matrix|(?:masse|treghets)matrisen?)"
    r"|(?P<g>gravity vector|gravita(?:tions|sjons)vektor(?:en)?)"
    r")[ \t]*(?P<sign>:?=|:(?=[^=\n]*[*^])(?![^\n]*=))",
    re.IGNORECASE,
)
"""The name of an answer in words, before a formula: `Kinetic energy = ...`, `Potensiell energi: ...`."""

_SIGN = re.compile("[=:]")
_SIGN_BELOW = re.compile(r"\n[ \t]*=(?![=>])")
"""The next line begins with the sign of the equation: `K1` stands alone on this one."""

_AND = re.compile(
    r"[ \t](?:and|og|und|et|y|with|where|mit|wobei|med|hvor|der)[ \t](?=[ \t]{0,9}[^\s:=]{1,40}[ \t]*=)"
)
_REMARK = re.compile(r"(?:(?<=\s)|(?<=[;)\]]))(?:#|//|%(?!pi\b))[^\n]*")
_SAID_BEHIND = re.compile(r"[ \t]+(?:for|für)[ \t]+(?:all|alle|any|every)[ \t][^\n]*\Z")
"""Where a value holds, said behind it."""

_SPOKEN_WORDS = r"[^\W\d_]{4,30}(?:[ \t][^\W\d_]{1,30}){0,6}"
_REMARK_BEHIND = re.compile(rf"(?<=\S)[ \t]{{2,9}}(?:\({_SPOKEN_WORDS}\)|\[{_SPOKEN_WORDS}\])[ \t]*\Z")
"""Words in brackets, apart from the value: `   [Coriolis]`."""

_DOTS = re.compile(r"\.\.\.[ \t]*(?=\n)")
_ROW_END = re.compile(r"(?<=[^\s=+\-*/,;(\[{&\\.])[ \t]*\n[ \t]*(?=[^\s=+\-*/),;\]])")
"""The end of a line where no sign says that it goes on: within brackets, as in MATLAB, that of a row."""

_PARAGRAPH = re.compile(
    rf"(?:{_LINE_HEAD}\n(?:[ \t]*\n)?)?(?:(?!{_LINE_HEAD}(?:\n|\Z))[^\n]*[^\s][^\n]*(?:\n|\Z))+", re.MULTILINE
)
"""Lines below each other, which may draw one formula; a name and its sign may stand above them alone."""

_MOST_HEADS = 2_000
"""So many different beginnings of lines are looked at."""

_POWERS = re.compile(r"[ \t]{2,}[0-9][0-9 \t]*")
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_TRAILING = frozenset("=+-*/,([{&\\")
_LEADING = frozenset("=+-*/)][")


class AnswerNames:
    """Says of the beginning of a line whether it names an answer."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._coordinates = {q.name for q in vocabulary.coordinates}
        self._heads = set[str]()

    def __call__(self, head: str) -> bool:
        """Whether it is the name of an answer, and no coordinate."""
        return isinstance(self._side(head), NamedAnswers) and head not in self._coordinates

    def shapes(self, line: str) -> set[tuple[int, int]]:
        """The shapes of the matrices that a line begins with the name of: of an unknown one a vector's."""
        head, sign, _ = line.partition("=")
        side = self._side(head.rstrip(" \t:")) if sign else None
        if isinstance(side, UnknownSide):
            return {(rows, 1) for rows in range(2, 7)} if side.is_name_alone else set()
        shapes = [self._vocabulary.shape(name) for name in side.candidates] if side else []
        return set() if None in shapes else {shape for shape in shapes if shape is not None}

    def is_unknown(self, word: str) -> bool:
        """Whether a word is no name of the problem."""
        return isinstance(self._side(word), UnknownSide)

    def _side(self, head: str) -> LeftSide:
        self._heads.add(head)
        return side_of(self._vocabulary, head) if len(self._heads) <= _MOST_HEADS else None


def plain_lines(text: str, start: int, end: int, names_answer: AnswerNames) -> Iterator[tuple[int, str]]:
    """The equations between two offsets: each with its own, and its text, which has the length it had."""
    position, begins = start, True
    while position < end:
        stop = text.find("\n", position, end)
        stop = end if stop < 0 else stop
        has_sign = _SIGN.search(text, position, stop) or _SIGN_BELOW.match(text, stop)
        first = _begins(text, position, stop, names_answer) if has_sign else -1
        if first >= 0 and (
            printed := printed_matrix(text, first, end, names_answer.shapes(text[first:stop]))
        ):
            yield first, printed
            position = first + len(printed)
            continue
        drawn = _PARAGRAPH.match(text, position, end) if begins else None
        if drawn is not None and (equation := one_line(drawn[0], names_answer)):
            yield position, equation
            position = drawn.end()
            continue
        begins = not text[position:stop].strip()
        if called := _CALLED.match(text, position, stop):
            yield called.start("sides"), _with_sign(called["sides"])
        if first >= 0:
            stop = _whole(text, first, stop, end)
            yield first, _formula(_with_powers(text, first, stop), names_answer)
        position = stop + 1


def _with_sign(sides: str) -> str:
    """Both sides of an equation with a sign for the comma between them."""
    at = next((at for at, level in enumerate(levels(sides)) if level == 0 and sides[at] == ","), len(sides))
    return f"{sides[:at]}={sides[at + 1 :]}"


def _begins(text: str, start: int, stop: int, names_answer: AnswerNames) -> int:
    """Where the equation of a line begins, behind a list's mark or `Potential energy: `; -1 without one."""
    if text.find(HIDDEN, start, stop) >= 0:
        return -1
    lead = _LEAD.match(text, start, stop)
    first = lead.end() if lead else start
    if (spoken := _SPOKEN.match(text, first, stop)) is not None and names_answer(_letter(spoken)):
        return first
    if (named := _NAMED.match(text, first, stop)) is not None and names_answer(named[1]):
        return first
    if not _EQUATION.match(text, first, stop):
        return first if _SIGN_BELOW.match(text, stop) and names_answer(text[first:stop].strip()) else -1
    said = _SAID.match(text, first, stop)
    if said and (_NAME_ALONE.match(text, said.end(), stop) or not is_of_one_case(said[0])):
        first = said.end()
    words = _WORDS.match(text, first, stop)
    heads = [text[at : text.index("=", at)].strip() for at in (first, words.end() if words else first)]
    if words is not None and names_answer(heads[1]) and not names_answer(heads[0]):  # `det J = ...`
        return words.end()
    return _behind_words(text, first, stop, names_answer.is_unknown)


def _behind_words(text: str, start: int, stop: int, is_unknown: Callable[[str], bool]) -> int:
    """Where a formula begins behind words that cannot: `Hence (M + m) x'' = F`, `We get (M + m) x'' = F`."""
    leads = _LEADS.match(text, start, stop)
    first, words = (leads.end(), 2) if leads else (start, 0)
    while (word := _A_WORD.match(text, first, stop)) and is_unknown(word[0].strip(" \t,:")):
        first, words = word.end(), words + 1
    is_led = words > 1 and _FORMULA.match(text, first, stop) and not is_of_one_case(text[start:first])
    return first if is_led else start


def _letter(spoken: re.Match[str]) -> str:
    """The name of the answer that words call."""
    return next(name for name in "KPLDg" if spoken[name])


def _with_powers(text: str, first: int, stop: int) -> str:
    """The line with the powers that stand above it, as SymPy's pprint and MATLAB's pretty print them."""
    line = text[first:stop]
    begin = text.rfind("\n", 0, first) + 1
    above = text[text.rfind("\n", 0, max(begin - 1, 0)) + 1 : max(begin - 1, 0)]
    if not _POWERS.fullmatch(above) or "\n" in line:
        return line
    signs = list(line.ljust(len(above) - (first - begin)))
    for found in re.finditer("[0-9]", above):
        at = found.start() - (first - begin)
        at -= at > 1 and signs[at - 1] == " " != signs[at - 2]  # one blank too far to the right
        if at < 1 or signs[at] != " " or signs[at - 1] == " ":
            return line
        signs[at] = _RAISED[int(found[0])]
    return "".join(signs)


def _with_rows(piece: str) -> str:
    """The equation with a semicolon where a line within brackets ends a row."""
    parts, done, depth = list[str](), 0, 0
    for found in _ROW_END.finditer(piece):
        part = piece[done : found.start()]
        depth += part.count("[") - part.count("]")
        parts += [part, f";{found[0][1:]}" if depth > 0 else found[0]]
        done = found.end()
    return "".join(parts) + piece[done:]


def _formula(piece: str, names_answer: Callable[[str], bool]) -> str:
    """The equation without remarks and the dots of lines that go on; `K1: ...` as `K1= ...`."""
    piece = _REMARK.sub(lambda found: " " * len(found[0]), piece)
    piece = _DOTS.sub(lambda found: " " * len(found[0]), _with_rows(piece))
    if (rest := next(rest_is_zero(piece), None)) is not None:
        piece = re.sub(r"[\s,;]{1,9}(?:(?:and|und|og)[ \t]{1,9})?\Z", "", piece[: rest.start()])
    piece = _REMARK_BEHIND.sub("", _SAID_BEHIND.sub("", _TERMINATOR.sub("", piece)))
    piece = _AND.sub(lambda found: ";" + " " * (len(found[0]) - 1), piece)
    if (spoken := _SPOKEN.match(piece)) is not None:
        piece = f"{_letter(spoken):<{spoken.end() - 1}}={piece[spoken.end() :]}"
    named = _NAMED.match(piece)
    if named is not None and names_answer(named[1]):
        at = piece.index(":", named.end(1))
        piece = f"{piece[:at]}={piece[at + 1 :]}"
    return piece


def _whole(text: str, start: int, stop: int, end: int) -> int:
    """Where an equation ends that goes on in the lines below."""
    level, seen = 0, start
    for _ in range(100):
        line = _REMARK.sub("", text[seen:stop]).rstrip()
        goes_on = line.endswith("...")
        line = line.removesuffix("...").rstrip()
        level += sum(map(line.count, "([{")) - sum(map(line.count, ")]}"))
        if line.endswith("=") and seen == start:
            stop = _skip_blank_lines(text, stop, end)
        below = text.find("\n", stop + 1, end)
        below = end if below < 0 else below
        following = text[stop + 1 : below].strip()
        pending = level > 0 or goes_on or line[-1:] in _TRAILING
        leads = following[:1] in _LEADING and not _ITEM.match(following)
        if stop >= end or not following or not (pending or leads):
            break
        seen, stop = stop, below
    return stop


def _skip_blank_lines(text: str, stop: int, end: int) -> int:
    """The end of the last blank line below, as MATLAB prints one between `K1 =` and the value."""
    last = stop
    for _ in range(3):
        below = text.find("\n", last + 1, end)
        if below < 0 or text[last + 1 : below].strip():
            break
        last = below
    return last
