r"""Formulas of the textbook, written in the source as a terminal shows them, with values put in.

    formula("𝐃 = Σ_(i=1)^{n} (m_i 𝐉_v_iᵀ 𝐉_v_i + 𝐉_ω_iᵀ 𝓘_i 𝐉_ω_i)", n=3)

The signs (sentences with such formulas in them are made by `document.sentences`):

    m  θ  𝐃  ℒ  𝓘      a symbol; bold and script letters are the Unicode ones
    q̇_j  q̈_j          one or two dots over a letter
    d_ij  r_c1          indices: digits, letters and values; letters that only describe, as c does, are
                        upright, and so are words: τ_static
    v_i in J_v_i        an index that has an index
    o_(i-1)  d_(i,j)    an index that is a formula, or several with commas
    H_i^0               a raised index
    x²  x³  x⁻¹  xᵀ     powers, the transpose
    a b  a/b  ½ m       products and quotients
    z × (o - p)         the cross product, brackets
    r(q)  atan2(y, x)   brackets without a space before them are an argument
    ∂ℒ/∂q̇_j  d/dt ℒ    derivatives
    Σ_(i=1)^n x         a sum, of what follows up to the next + or -
    [a, b; c, d]        a matrix, row by row
    det 'the rank'      upright words: names of several letters, and what stands in quotation marks
    {name}              a value: a tree, a whole number, words
    a = b ≤ c           relations; a = b ⇒ c = d; a = b ± c; a, b  several formulas on one line
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple
from unicodedata import normalize

from dynsolve.notation.characters import GREEK, bold_letter, bold_script_letter, describes, script_letter
from dynsolve.notation.tree import (
    Arguments,
    BigSum,
    Cross,
    Degrees,
    Derivative,
    Function,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    mapped,
)

Value = Node | str | int
"""What is put in for a name in braces."""

_CAPITALS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
_LATIN = _CAPITALS + _CAPITALS.lower()
_SPELLED = {sign: name for name, sign in GREEK.items()}
_LETTERS: dict[str, tuple[str, str]] = {
    **{letter: (letter, "italic") for letter in _LATIN},
    **{sign: (name, "italic") for sign, name in _SPELLED.items()},
    **{bold_letter(letter): (letter, "bold") for letter in _LATIN},
    **{bold_letter(sign): (name, "bold") for sign, name in _SPELLED.items()},
    bold_letter("0"): ("0", "bold"),
    **{script_letter(letter): (letter, "script") for letter in _CAPITALS},
    **{bold_script_letter(letter): (letter, "bold script") for letter in _CAPITALS},
}
"""A letter as it is printed -> its name and its style."""

_FRACTIONS = {"½": (1, 2), "⅓": (1, 3), "⅔": (2, 3), "¼": (1, 4), "¾": (3, 4), "⅛": (1, 8)}
_POWERS = {"²": Number(2), "³": Number(3), "⁴": Number(4), "⁻¹": Negative(Number(1))}
_BEGINNINGS = frozenset("([∂Σ") | _FRACTIONS.keys()
_FUNCTIONS = frozenset({"sin", "cos", "tan", "sqrt", "sgn", "acos", "asin", "atan", "atan2", "exp"})
_RELATIONS = frozenset("=≠<>≤≥≈±∈→⟂∥")
_TOKEN = re.compile(
    r"""(?P<space>\s+) | (?P<value>\{\w+\}) | '(?P<quoted>[^']*)' | (?P<total>d/dt) | (?P<number>[0-9]+)
    | (?P<word>[A-Za-z]{2,}\d*) | (?P<power>⁻¹|[²³⁴]) | (?P<mark>[ᵀΣ_½⅓⅔¼¾⅛])
    | (?P<letter>\w[\u0307\u0308\u20db]?) | (?P<sign>.)""",
    re.VERBOSE,
)
_DOTS = {"\u0307": 1, "\u0308": 2, "\u20db": 3}


class _Token(NamedTuple):
    kind: str
    text: str
    spaced: bool
    """Whether a space stands before it."""


class _Value(Symbol, frozen=True):
    """The place of a value, by its name."""


def formula(text: str, /, **values: Value) -> Node:
    """A formula, from how it is printed, with its values put in.

    >>> formula("K = ½ m_{i} v²", i=2).parts[1].factors[1]
    Letter(base='m', sub=Number(p=2, q=1, decimal=False, rounded=False), sup=None, style='italic', dots=0)
    >>> formula("\N{LATIN SMALL LETTER D WITH DOT ABOVE}")
    Symbol(name='d', dots=1, star=False)
    """
    tree, has_values = _read(text)
    return _filled(tree, values) if has_values else tree


@lru_cache(maxsize=4096)
def _read(text: str) -> tuple[Node, bool]:
    """The tree of a text, and whether values go into it."""
    reader = _Reader(text)
    tree = reader.line()
    return tree, reader.has_values


def _filled(tree: Node, values: Mapping[str, Value]) -> Node:
    def put(node: Node) -> Node:
        if not isinstance(node, _Value):
            return node
        match values[node.name]:
            case int(value):
                return Negative(Number(-value)) if value < 0 else Number(value)
            case str(value):
                return Words(value)
            case value:
                return value

    return mapped(tree, put)


def _tokens(text: str) -> Iterator[_Token]:
    spaced = False
    apart = "".join(normalize("NFD", sign) if sign.isalpha() else sign for sign in text)  # ḋ is d and its dot
    for match in _TOKEN.finditer(apart.replace("−", "-")):
        kind = match.lastgroup or ""
        if kind == "space":
            spaced = True
            continue
        yield _Token(kind, match[kind], spaced)
        spaced = False
    yield _Token("end", "", spaced)


class _Reader:
    """A recursive descent over the tokens of a formula."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = list(_tokens(text))
        self.place = 0
        self.has_values = False

    @property
    def token(self) -> _Token:
        return self.tokens[self.place]

    def take(self) -> _Token:
        token = self.token
        self.place += token.kind != "end"
        return token

    def taken(self, text: str) -> bool:
        """Whether a sign stands here; it is taken."""
        found = self.token.kind in ("sign", "mark") and self.token.text == text
        self.place += found
        return found

    def expect(self, text: str) -> None:
        if not self.taken(text):
            raise self.error(f"`{text}` is expected")

    def error(self, message: str) -> ValueError:
        return ValueError(f"{self.text}: {message} at `{self.token.text}`")

    def line(self) -> Node:
        """Formulas with commas between them, up to the end."""
        parts = [self.relation()]
        while self.taken(","):
            parts += [Words(", "), self.relation()]
        if self.token.kind != "end":
            raise self.error("nothing is expected")
        return parts[0] if len(parts) == 1 else Row(tuple(parts))

    def relation(self) -> Node:
        parts, signs = [self.sum()], []
        while self.token.kind == "sign" and self.token.text in _RELATIONS:
            signs.append(self.take().text)
            parts.append(self.sum())
        found = Relation(tuple(parts), tuple(signs)) if signs else parts[0]
        return Relation((found, self.relation()), ("⇒",)) if self.taken("⇒") else found

    def sum(self) -> Node:
        terms: list[Node] = [Negative(self.term()) if self.taken("-") else self.term()]
        while self.token.kind == "sign" and self.token.text in "+-":
            sign = self.take().text
            terms.append(Negative(self.term()) if sign == "-" else self.term())
        return terms[0] if len(terms) == 1 else Sum(tuple(terms))

    def term(self) -> Node:
        factors = [self.factor()]
        while True:
            if self.taken("/"):
                above = factors[0] if len(factors) == 1 else Product(tuple(factors))
                factors = [Quotient(above, self.factor())]
            elif self.taken("×"):
                left = factors[0] if len(factors) == 1 else Product(tuple(factors))
                factors = [Cross(left, self.term())]
            elif self.begins_factor():
                factors.append(self.factor())
            else:
                break
        return factors[0] if len(factors) == 1 else Product(tuple(factors))

    def begins_factor(self) -> bool:
        kind, text, _ = self.token
        return kind not in ("end", "sign", "mark") or text in _BEGINNINGS

    def factor(self) -> Node:
        node = self.atom()
        while True:
            if self.token.kind == "power":
                node = Power(node, _POWERS[self.take().text])
            elif self.taken("ᵀ"):
                node = Transpose(node)
            else:
                return node

    def atom(self) -> Node:
        token = self.take()
        match token.kind:
            case "number":
                return Degrees(int(token.text)) if self.taken("°") else Number(int(token.text))
            case "value":
                self.has_values = True
                return self.called(_Value(token.text[1:-1]))
            case "quoted":
                return Words(token.text)
            case "word":
                return self.word(token.text)
            case "total":
                return Derivative(self.factor(), Symbol("t"), total=True)
            case "letter":
                return self.called(self.letter(token))
            case "sign" | "mark":
                return self.signed(token)
        raise self.error("a factor is expected before")

    def signed(self, token: _Token) -> Node:
        match token.text:
            case "(":
                return self.bracket()
            case "[":
                return self.matrix()
            case "Σ":
                return self.big_sum()
            case "∂":
                of = None if self.token.text == "/" else self.factor()
                self.expect("/")
                self.expect("∂")
                return Derivative(of, self.factor())
        if token.text in _FRACTIONS:
            return Quotient(*map(Number, _FRACTIONS[token.text]))
        raise self.error(f"`{token.text}` begins nothing, before")

    def bracket(self) -> Node:
        parts = [self.relation()]
        while self.taken(","):
            parts.append(self.relation())
        self.expect(")")
        return Parenthesized(parts[0] if len(parts) == 1 else Arguments(tuple(parts)))

    def called(self, node: Node) -> Node:
        """A letter, and its argument if it has one: r(q)."""
        if self.token == _Token("sign", "(", False):
            self.take()
            inner = self.relation()
            self.expect(")")
            return Row((node, Parenthesized(inner)))
        return node

    def word(self, text: str) -> Node:
        if text not in _FUNCTIONS:
            return Row((Words(f"{text} "), self.factor())) if self.begins_factor() else Words(text)
        power = _POWERS[self.take().text] if self.token.kind == "power" else None
        node = Function(text, _bare(self.factor()))
        return node if power is None else Power(node, power)

    def big_sum(self) -> Node:
        self.expect("_")
        self.expect("(")
        index = self.factor()
        self.expect("=")
        lower = self.sum()
        self.expect(")")
        self.expect("^")
        upper = self.index()
        return BigSum(self.term(), index, lower, upper)

    def matrix(self) -> Node:
        rows = [self.row()]
        while self.taken(";"):
            rows.append(self.row())
        self.expect("]")
        return Matrix(tuple(rows))

    def row(self) -> tuple[Node, ...]:
        entries = [self.sum()]
        while self.taken(","):
            entries.append(self.sum())
        return tuple(entries)

    def letter(self, token: _Token) -> Node:
        """A letter with its dots and indices: a `Letter`, or a `Symbol` where it is plain."""
        sign, dots = token.text[0], sum(_DOTS[dot] for dot in token.text[1:])
        if sign not in _LETTERS:
            raise self.error(f"`{sign}` is no letter, before")
        base, style = _LETTERS[sign]
        sub = self.index() if self.taken("_") else None
        sup = self.index() if self.taken("^") else None
        if style == "italic" and sub is None and sup is None:
            return Symbol(base, dots)
        return Letter(base, sub, sup, style, dots)

    def index(self) -> Node:
        """What stands lowered or raised: signs, values and words side by side, or a formula in brackets."""
        if self.taken("("):
            parts: list[Node] = [self.sum()]
            while self.taken(","):
                parts += [Words(","), self.sum()]
            self.expect(")")
        else:
            parts = [*self.index_parts()]
            while not self.token.spaced and self.token.kind in ("number", "letter", "word", "value"):
                parts += self.index_parts()
        return parts[0] if len(parts) == 1 else Row(tuple(parts))

    def index_parts(self) -> Iterator[Node]:
        token = self.take()
        match token.kind:
            case "number":
                yield from (Number(int(digit)) for digit in token.text)
            case "value":
                self.has_values = True
                yield _Value(token.text[1:-1])
            case "letter":
                base, style = _LETTERS[token.text]
                if self.taken("_"):
                    yield Letter(base, self.index(), None, style)
                elif style != "italic":
                    yield Letter(base, style=style)
                else:
                    yield Words(base) if describes(base) else Symbol(base)
            case "word":
                yield from _index_word(token.text)
            case _:
                raise self.error("an index is expected before")


def _index_word(text: str) -> Iterator[Node]:
    """ij are two indices, c1 the upright c and 1, static is a word."""
    word = text.rstrip("0123456789")
    first, rest = (word[:1], word[1:]) if describes(word[:1]) else ("", word)
    if any(map(describes, rest)):
        yield Words(word)
    else:
        yield from (Words(letter) for letter in first)
        yield from map(Symbol, rest)
    yield from (Number(int(digit)) for digit in text[len(word) :])


def _bare(node: Node) -> Node:
    return node.argument if isinstance(node, Parenthesized) else node
