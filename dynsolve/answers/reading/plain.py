r"""Formulas that have one reading: names of the problem, numbers, sines and cosines, + - * / ^ and brackets.

    m2*(l1**2 + 2*l1*lc2*cos(q2))          \frac{1}{2} m_{2} (\dot{q}_{1}^{2} + L_{2}^{2} \dot{q}_{2}^{2})

Most of what is handed in is one of these, and none of the ways to read a name, a blank or a bracket that
`grammar` weighs can give it another value.  What a spelling means is asked of `grammar` once for each
problem; a sum in parentheses, which stands in many answers, is read once too.  Everything else, and all
that cannot be read, is left to `grammar`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set
from math import comb

from msgspec import Struct

from dynsolve.answers.reading.answer_list import Member
from dynsolve.answers.reading.grammar.scripts import RAISED
from dynsolve.answers.reading.grids import MAX_DEGREE, MAX_TERMS, Grid, check_size, grid
from dynsolve.answers.reading.left_side import RightSide, has_shape, read_right_side
from dynsolve.answers.reading.lexer import GREEK_COMMANDS, Token
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.characters import SUBSCRIPT_DIGITS, SUPERSCRIPT_DIGITS
from dynsolve.notation.tree import Function, Negative, Node, Number, Power, Product, Quotient, Sum, Symbol

_INDEX = r"_(?:[A-Za-z0-9]+|\{[^{}]{1,20}(?:\{[^{}]{1,20}\}[^{}]{0,20})?\})"
_SIGN = "[A-Za-zα-ωΑ-Ω][\u0307\u0308]?"
_LETTER = rf"(?:{_SIGN}|\\(?:{'|'.join(GREEK_COMMANDS)})(?![A-Za-z]))"
_POWER = rf"(?:[{SUPERSCRIPT_DIGITS[2:]}]|(?:\^|\*\*)(?:\{{[2-9]\}}|[2-9](?![0-9.eE])))"
_LAYOUT = re.compile(r"(?:\s|\\(?:(?:left|right)(?![A-Za-z.])|[,;:!\ ]))*+")
_PIECE = re.compile(
    rf"""{_LAYOUT.pattern}(?:
      (?P<call>\\?(?:sin|cos|tan){_POWER}?(?:(?:\\left)?\([^()=]{{1,80}}\)
        |(?<=[a-z}}2-9])\s?(?:{_LETTER}(?:{_INDEX})?|{_SIGN}[A-Za-z0-9_]+)(?![\w{{])(?!\s*[{{^(_'²\[])))
    | (?P<frac>\\[dt]?frac\{{)
    | (?P<times>\*(?!\*)|[·⋅]|\\cdot(?![A-Za-z]))
    | (?P<name>(?:\\d?dot\s?(?:\{{{_LETTER}(?:{_INDEX})?\}}|{_LETTER})(?:{_INDEX})?
        |{_LETTER}{_INDEX}|{_SIGN}[A-Za-z0-9_{SUBSCRIPT_DIGITS}]*'{{0,2}}|{_LETTER})(?:(?![\w'{{])|(?=[²³])){_POWER}?)
    | (?P<number>[0-9]+(?:\.[0-9]+)?(?![0-9.]|[eE][-+0-9]))
    | (?P<power>{_POWER})
    | (?P<group>\((?:[^()]|(?<=sin|cos|tan)\([^()]*\)|(?<=(?:sin|cos|tan)\^\{{[2-9]\}})\([^()]*\)){{1,99}}+\))
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
_BEGINS = frozenset({"name", "call", "number", "group", "frac", "("})
_MOST_NESTED = 12
_LONGEST = 20_000
_MOST_SPELLINGS = 4_000


class _OtherError(Exception):
    """A formula that is none of these."""


class Spelled(Struct, frozen=True):
    """What a spelling means, bounds on its terms and their degree, and what was looked for in vain."""

    node: Node
    terms: int
    degree: int
    missed: Set[str]


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
    except (_OtherError, ReadError):
        return None
    found = RightSide(value, (), (), (), is_definition=False)
    token = Token("plain", written, start, start + len(written))
    return Member(index, [token], found) if has_shape(vocabulary, found, owners[:1]) else None


def _value(vocabulary: Vocabulary, text: str) -> Node | Grid:
    if found := _ENVIRONMENT.fullmatch(text):
        rows = [line.split("&") for line in filter(str.strip, found["rows"].split("\\\\"))]
    elif found := _LISTS.fullmatch(text) or _LIST.fullmatch(text):
        rows = [row.split(",") for row in _BETWEEN_LISTS.split(found["rows"])]
        rows = [[row[0] for row in rows]] if all(len(row) == 1 for row in rows) else rows
    else:
        return _Formula(vocabulary, text).value()
    entries = [[_Formula(vocabulary, entry).value() for entry in row] for row in rows]
    if [len(row) for row in rows] == [1]:
        return entries[0][0]
    if all(isinstance(entry, Symbol) for row in entries for entry in row):
        raise _OtherError  # names alone may be those of another matrix
    return grid(entries)


class _Formula:
    """One formula, whose pieces are taken from the end of a list.

    `terms` and `degree` are bounds on those of the part that was read last, multiplied out.
    """

    __slots__ = ("degree", "nesting", "pieces", "terms", "vocabulary")

    def __init__(self, vocabulary: Vocabulary, text: str) -> None:
        self.vocabulary, self.nesting = vocabulary, 0
        self.terms = self.degree = 1
        self.pieces = [("end", ""), *reversed(list(_pieces(text)))]

    def value(self) -> Node:
        found = self.sum()
        self.expect("end")
        return found

    def expect(self, kind: str) -> None:
        if self.pieces.pop()[0] != kind:
            raise _OtherError

    def sum(self) -> Node:
        pieces, found = self.pieces, list[Node]()
        terms = degree = 0
        self.nesting += 1
        sign = pieces.pop()[0] if pieces[-1][0] in ("+", "-") else "+"
        while True:
            term = self.term()
            terms += self.terms
            degree = max(degree, self.degree)
            found.append(Negative(term) if sign == "-" else term)
            sign = pieces[-1][0]
            if sign != "+" and sign != "-":
                break
            pieces.pop()
        self.nesting -= 1
        self.terms, self.degree = terms, degree
        return found[0] if len(found) == 1 else Sum(tuple(found))

    def term(self) -> Node:
        pieces, factors = self.pieces, list[Node]()
        before, is_below, terms, degree = "", False, 1, 0
        while True:
            kind, text = pieces.pop()
            factor = self.factor(kind, text, before)
            before = kind
            if pieces[-1][0] == "power":
                if kind == "number":
                    raise _OtherError
                count = int(pieces.pop()[1].strip("*^{}").translate(RAISED))
                factor = Power(factor, Number(count))
                self.terms, self.degree = comb(self.terms + count - 1, count), count * self.degree
            if is_below:
                factors = [Quotient(_product(factors), factor)]
                terms, degree = terms + self.terms, max(degree, self.degree)
            else:
                factors.append(factor)
                terms, degree = terms * self.terms, degree + self.degree
            if terms > MAX_TERMS or degree > MAX_DEGREE:
                raise _OtherError
            kind = pieces[-1][0]
            is_below = kind == "/"
            if is_below or kind == "times":
                pieces.pop()
                before = ""
            elif kind not in _BEGINS:
                self.terms, self.degree = terms, degree
                return _product(factors)
            elif kind == before == "number":
                raise _OtherError

    def factor(self, kind: str, text: str, before: str) -> Node:
        """A name, a number, a function, a fraction or what stands in parentheses behind a `before`."""
        if kind in _SPELLED:
            found = self.spelled(kind, text)
        elif kind == "(" and self.nesting < _MOST_NESTED:
            found = self.sum()
            self.expect(")")
        elif kind == "frac" and self.nesting < _MOST_NESTED:
            above = self.sum()
            terms, degree = self.terms, self.degree
            self.expect("}")
            self.expect("{")
            found = Quotient(above, self.sum())
            self.terms, self.degree = terms + self.terms, max(degree, self.degree)
            self.expect("}")
        else:
            raise _OtherError
        if kind in _PARENTHESES and (
            isinstance(found, Number) or (before == "name" and not isinstance(found, Sum))
        ):
            raise _OtherError  # an index, the arguments of a matrix or the number of an equation
        return found

    def spelled(self, kind: str, text: str) -> Node:
        """The symbol, number or function that a spelling alone means, or a sum in parentheses."""
        known = self.vocabulary.spelled
        if text not in known:
            if len(known) > _MOST_SPELLINGS:
                known.clear()
            known[text] = (_summed if kind == "group" else _asked)(self.vocabulary.fresh(), text)
        found: Spelled | None = known[text]
        if found is None:
            raise _OtherError
        self.terms, self.degree = found.terms, found.degree
        if found.missed:
            self.vocabulary.missed |= found.missed
        return found.node


_PARENTHESES = ("group", "(")
_SPELLED = frozenset({"name", "number", "call", "group"})


def _product(factors: list[Node]) -> Node:
    return factors[0] if len(factors) == 1 else Product(tuple(factors))


def _pieces(text: str) -> Iterator[tuple[str, str]]:
    """The kinds and the texts of the pieces of a formula; the kind of a sign is the sign itself."""
    position, length, match = 0, len(text), _PIECE.match
    while position < length:
        found = match(text, position)
        if found is None:
            if _LAYOUT.fullmatch(text, position):
                return
            raise _OtherError
        kind = str(found.lastgroup)
        piece = found[kind]
        yield piece if kind == "sign" else kind, piece
        position = found.end()


def _summed(names: Vocabulary, text: str) -> Spelled | None:
    """What stands in parentheses."""
    try:
        formula = _Formula(names, text[1:-1])
        return Spelled(formula.value(), formula.terms, formula.degree, names.missed)
    except _OtherError:
        return None


def _asked(names: Vocabulary, spelling: str) -> Spelled | None:
    """What `grammar` makes of a spelling; None where it is no symbol, number or function alone."""
    if spelling[0] == "d":  # dq_1 may begin a derivative
        return None
    try:
        found = read_right_side(names, prepared(spelling)[:-1])
    except ReadError:
        return None
    if not isinstance(found, RightSide) or names.missed_entries or not isinstance(found.value, _MEANINGS):
        return None
    if found.references or found.notes or found.free or found.is_definition or found.has_letters:
        return None
    size = check_size(found.value)
    return Spelled(found.value, size.terms, size.degree, names.missed)


_MEANINGS = Symbol | Function | Number | Power
