r"""Formulas that have one reading: names of the problem, numbers, sines and cosines, + - * / ^ and brackets.

    m2*(l1**2 + 2*l1*lc2*cos(q2))          \frac{1}{2} m_{2} (\dot{q}_{1}^{2} + L_{2}^{2} \dot{q}_{2}^{2})

Most of what is handed in is one of these, and none of the ways to read a name, a blank or a bracket that
`grammar` weighs can give it another value.  What a spelling means is asked of `grammar` once for each
problem.  Everything else, and all that cannot be read, is left to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

from dynsolve.answers.reading.answer_list import Member
from dynsolve.answers.reading.grids import Grid, check_size, grid
from dynsolve.answers.reading.left_side import RightSide, has_shape, read_right_side
from dynsolve.answers.reading.lexer import GREEK_COMMANDS, Token
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Function, Negative, Node, Number, Power, Product, Quotient, Sum, Symbol

_INDEX = r"_(?:[A-Za-z0-9]+|\{[^{}]{1,20}(?:\{[^{}]{1,20}\}[^{}]{0,20})?\})"
_LETTER = rf"(?:[A-Za-z]|\\(?:{'|'.join(GREEK_COMMANDS)})(?![A-Za-z]))"
_LAYOUT = re.compile(r"\A(?:\s|\\(?:(?:left|right)(?![A-Za-z.])|[,;:!\ ]))*")
_PIECE = re.compile(
    rf"""{_LAYOUT.pattern[2:]}(?:
      (?P<call>\\?(?:sin|cos|tan)(?:\^(?:\{{[2-9]\}}|[2-9]))?(?:(?:\\left)?\([^()=]{{1,80}}\)
        |(?<=[a-z}}])\s?{_LETTER}{_INDEX}(?!\s*[\w{{^(])))
    | (?P<frac>\\[dt]?frac\{{)
    | (?P<times>\*(?!\*)|\\cdot(?![A-Za-z]))
    | (?P<name>(?:\\d?dot\s?(?:\{{{_LETTER}(?:{_INDEX})?\}}|{_LETTER})(?:{_INDEX})?
        |{_LETTER}{_INDEX}|[A-Za-z][A-Za-z0-9_]*|{_LETTER})(?![\w{{]))
    | (?P<number>[0-9]+(?:\.[0-9]+)?(?![0-9.]|[eE][-+0-9]))
    | (?P<power>(?:\^|\*\*)(?:\{{[2-9]\}}|[2-9](?![0-9.eE])))
    | (?P<sign>[-+/(){{}}])
    )""",
    re.VERBOSE,
)
_ENVIRONMENT = re.compile(
    r"(\[\s*)?\\begin\{([bp]?matrix)\}(?P<rows>.*)\\end\{\2\}(?(1)\s*(?:\\right)?\])", re.DOTALL
)
_LIST = re.compile(r"\[(?P<rows>[^\[\]\\{}\n]*)\]")
_LISTS = re.compile(r"\[\s*\[(?P<rows>[^\\{}\n]*)\]\s*\]")
_BETWEEN_LISTS = re.compile(r"\]\s*,\s*\[")
_BEGINS = frozenset({"name", "call", "number", "frac", "("})
_MOST_NESTED = 12
_LONGEST = 20_000
_MOST_SPELLINGS = 4_000


_MEANINGS = Symbol | Function | Number | Power


class _OtherError(Exception):
    """A formula that is none of these."""


def plain_member(
    vocabulary: Vocabulary, text: str, start: int, index: int, owners: tuple[str, ...]
) -> Member | None:
    """The member from an offset of a text on, if it is one of these and its value has the owner's shape."""
    written = _LAYOUT.sub("", text[start:], 1)
    start = len(text) - len(written)
    written = written.rstrip(" \t\n.,;")
    if len(written) > _LONGEST or not vocabulary.has_no_other_names:
        return None
    try:
        value = _value(vocabulary, written)
        check_size(value.node if isinstance(value, Grid) else value)
    except (_OtherError, ReadError):
        return None
    found = RightSide(value, (), (), (), is_definition=False)
    token = Token("plain", written, start, start + len(written))
    return Member(index, [token], found) if has_shape(vocabulary, found, owners[:1]) else None


def _value(vocabulary: Vocabulary, text: str) -> Node | Grid:
    is_list = False
    if found := _ENVIRONMENT.fullmatch(text):
        rows = [line.split("&") for line in filter(str.strip, found["rows"].split("\\\\"))]
    elif found := _LISTS.fullmatch(text) or _LIST.fullmatch(text):
        rows = [row.split(",") for row in _BETWEEN_LISTS.split(found["rows"])]
        rows = [[row[0] for row in rows]] if all(len(row) == 1 for row in rows) else rows
        is_list = True
    else:
        return _Formula(vocabulary, text).value()
    entries = [[_Formula(vocabulary, entry, is_list).value() for entry in row] for row in rows]
    if [len(row) for row in rows] == [1]:
        return entries[0][0]
    if all(isinstance(entry, Symbol) for row in entries for entry in row):
        raise _OtherError  # names alone may be those of another matrix
    return grid(entries)


class _Formula:
    """One formula, whose pieces are taken from the end of a list; where it `is_listed` a blank is no sign."""

    __slots__ = ("is_listed", "nesting", "pieces", "vocabulary")

    def __init__(self, vocabulary: Vocabulary, text: str, is_listed: bool = False) -> None:
        self.vocabulary, self.is_listed, self.nesting = vocabulary, is_listed, 0
        self.pieces = [("end", ""), *reversed(list(_pieces(text)))]

    def value(self) -> Node:
        found = self.sum()
        self.expect("end")
        return found

    def expect(self, kind: str) -> None:
        if self.pieces.pop()[0] != kind:
            raise _OtherError

    def sum(self) -> Node:
        pieces, terms = self.pieces, list[Node]()
        self.nesting += 1
        sign = pieces.pop()[0] if pieces[-1][0] in ("+", "-") else "+"
        while True:
            term = self.term()
            terms.append(Negative(term) if sign == "-" else term)
            sign = pieces[-1][0]
            if sign != "+" and sign != "-":
                break
            pieces.pop()
        self.nesting -= 1
        return terms[0] if len(terms) == 1 else Sum(tuple(terms))

    def term(self) -> Node:
        pieces, factors = self.pieces, list[Node]()
        before, is_below = "", False
        while True:
            kind, text = pieces.pop()
            factor = self.factor(kind, text, before)
            before = kind
            if pieces[-1][0] == "power":
                if kind == "number":
                    raise _OtherError
                factor = Power(factor, Number(int(pieces.pop()[1].strip("*^{}"))))
            if is_below:
                factors = [Quotient(_product(factors), factor)]
            else:
                factors.append(factor)
            kind = pieces[-1][0]
            is_below = kind == "/"
            if is_below or kind == "times":
                pieces.pop()
                before = ""
            elif kind not in _BEGINS:
                return _product(factors)
            elif self.is_listed or (kind == "number" and before == "number"):
                raise _OtherError

    def factor(self, kind: str, text: str, before: str) -> Node:
        """A name, a number, a function, a fraction or what stands in parentheses behind a `before`."""
        if kind == "name" or kind == "number" or kind == "call":
            return _meaning(self.vocabulary, text)
        if kind == "(" and self.nesting < _MOST_NESTED:
            found = self.sum()
            self.expect(")")
            if isinstance(found, Number) or (before == "name" and not isinstance(found, Sum)):
                raise _OtherError  # an index, the arguments of a matrix or the number of an equation
            return found
        if kind == "frac" and self.nesting < _MOST_NESTED:
            above = self.sum()
            self.expect("}")
            self.expect("{")
            below = self.sum()
            self.expect("}")
            return Quotient(above, below)
        raise _OtherError


def _product(factors: list[Node]) -> Node:
    return factors[0] if len(factors) == 1 else Product(tuple(factors))


def _pieces(text: str) -> Iterator[tuple[str, str]]:
    """The kinds and the texts of the pieces of a formula; the kind of a sign is the sign itself."""
    position, length, match = 0, len(text), _PIECE.match
    while position < length:
        found = match(text, position)
        if found is None:
            if text[position:].isspace():
                return
            raise _OtherError
        kind = str(found.lastgroup)
        piece = found[kind]
        yield piece if kind == "sign" else kind, piece
        position = found.end()


def _meaning(vocabulary: Vocabulary, spelling: str) -> Node:
    """The symbol, number or function that a spelling alone means, and nothing beside it."""
    known = vocabulary.spelled
    if spelling not in known:
        if len(known) > _MOST_SPELLINGS:
            known.clear()
        known[spelling] = _asked(vocabulary, spelling)
    meaning, missed = known[spelling]
    if meaning is None:
        raise _OtherError
    vocabulary.missed.update(missed)
    return meaning


def _asked(vocabulary: Vocabulary, spelling: str) -> tuple[Node | None, Set[str]]:
    """What `grammar` makes of a spelling, and the names that it looked for in vain."""
    nothing: tuple[None, Set[str]] = (None, frozenset())
    if spelling[0] == "d":  # dq_1 may begin a derivative
        return nothing
    names = vocabulary.fresh()
    try:
        found = read_right_side(names, prepared(spelling)[:-1])
    except ReadError:
        return nothing
    if not isinstance(found, RightSide) or names.missed_entries or not isinstance(found.value, _MEANINGS):
        return nothing
    said = found.references or found.notes or found.free or found.is_definition or found.has_letters
    return nothing if said else (found.value, names.missed)
