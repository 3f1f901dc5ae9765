"""Trees -> MathML Core, which browsers show without help: dots as accents, fractions, matrices.

Text is a row of elements, to be put into `<math>`.
"""

from __future__ import annotations

import re
from html import escape

from dynsolve.notation.characters import GREEK
from dynsolve.notation.names import split
from dynsolve.notation.printing import (
    PLAIN,
    FormulaPrinter,
    Style,
    decimal_text,
    flat_factors,
    is_numeric,
    is_whole,
    shorthand,
)
from dynsolve.notation.tree import (
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
    Sum,
    Symbol,
    Transpose,
    Words,
)

_DOTS = ("", "\u02d9", "\u00a8", "\u20db")
_STAR = "<mo>\u22c6</mo>"
MINUS = '<mo form="prefix">\u2212</mo>'
"""The minus of a negative; between two terms it is another."""

_MINUS = "<mo>\u2212</mo>"
_PLUS = "<mo>+</mo>"
_APPLY = "\u2061"
_RUN = re.compile(r"[A-Za-z]+|[^A-Za-z]+")
_SCRIPT = {"I": "𝓘", "L": "𝓛", "B": "ℬ", "E": "ℰ", "F": "ℱ", "H": "ℋ", "M": "ℳ", "R": "ℛ"}
_TALL = ("<mfrac>", "<mtable>", "<munderover>")
_BARE_BASES = frozenset({Symbol, Parenthesized})
_ABBREVIATION = 3


def to_mathml(node: Node, style: Style = PLAIN) -> str:
    """The tree as a MathML row.

    >>> to_mathml(Product((Number(2), Symbol("m1"))))
    '<mn>2</mn><msub><mi>m</mi><mn>1</mn></msub>'
    """
    return MathMLPrinter(style).text(node)


def row(text: str) -> str:
    """Elements as one element."""
    return f"<mrow>{text}</mrow>"


def _letter(base: str) -> str:
    """A base: a letter or a Greek letter in italics, a word upright."""
    return f"<mi>{escape(GREEK.get(base, base))}</mi>"


def _group(index: str) -> str:
    """A group of indices: `c1` is c and 1, `omega1` ω and 1, `max` upright."""
    pieces = []
    for run in _RUN.findall(index):
        if run in GREEK or (run.isalpha() and len(run) >= _ABBREVIATION):
            pieces.append(_letter(run))
        elif run.isalpha():
            pieces += [f"<mi>{character}</mi>" for character in run]
        else:
            pieces.append(f"<mn>{escape(run)}</mn>")
    return "".join(pieces)


def _indices(groups: tuple[str, ...]) -> str:
    return _one("<mo separator='true'>,</mo>".join(map(_group, groups)))


def _one(text: str) -> str:
    """Text as one element: a row unless it is one already."""
    return text if re.fullmatch(r"<(mi|mn|mo)>[^<]*</\1>", text) else row(text)


def dotted(base: str, dots: int) -> str:
    """A base with dots over it."""
    return f'<mover accent="true">{base}<mo>{_DOTS[dots]}</mo></mover>' if dots else base


def indexed(base: str, sub: str, sup: str) -> str:
    """A base with what stands below and above it, either may be empty."""
    if sub and sup:
        return f"<msubsup>{base}{sub}{sup}</msubsup>"
    if sub:
        return f"<msub>{base}{sub}</msub>"
    return f"<msup>{base}{sup}</msup>" if sup else base


class MathMLPrinter(FormulaPrinter):
    """MathML Core; parentheses grow only where what they hold is tall."""

    notation = "MathML"
    between = ""
    minus = MINUS

    def _sign(self, sign: str) -> str:
        return f"<mo>{escape(sign)}</mo>"

    def __init__(self, style: Style = PLAIN) -> None:
        super().__init__(style)
        self._symbols: dict[tuple[str, int], tuple[str, str]] = {}

    def parenthesized(self, text: str) -> str:
        """The text in parentheses."""
        if any(mark in text for mark in _TALL):
            return row(f"<mo>(</mo>{text}<mo>)</mo>")
        return f'<mo stretchy="false">(</mo>{text}<mo stretchy="false">)</mo>'

    # Numbers and names

    def _number(self, node: Number) -> str:
        if node.q == 1:
            return (MINUS if node.p < 0 else "") + f"<mn>{abs(node.p)}</mn>"
        if (self.style.decimal or node.decimal) and (decimal := decimal_text(node.p, node.q)):
            return (MINUS if node.p < 0 else "") + f"<mn>{decimal.lstrip('-')}</mn>"
        return (MINUS if node.p < 0 else "") + _fraction(f"<mn>{abs(node.p)}</mn>", f"<mn>{node.q}</mn>")

    def _degrees(self, node: Degrees) -> str:
        text = decimal_text(node.p, node.q)
        if text:
            return (MINUS if node.p < 0 else "") + f"<mn>{text.lstrip('-')}°</mn>"
        return f"<msup>{row(self.parenthesized(self._number(Number(node.p, node.q))))}<mo>°</mo></msup>"

    def _parts(self, node: Symbol) -> tuple[str, str]:
        """The base of a symbol with its dots, and its subscript."""
        key = (node.name, node.dots)
        parts = self._symbols.get(key)
        if parts is None:
            base, groups = split(node.name)
            parts = self._symbols[key] = (
                dotted(_letter(base), node.dots),
                _indices(groups) if groups else "",
            )
        return parts

    def _symbol(self, node: Symbol) -> str:
        return indexed(*self._parts(node), _STAR if self.style.starred(node) else "")

    def _letter(self, node: Letter) -> str:
        base = escape(GREEK.get(node.base, node.base))
        if node.style == "bold":
            text = f'<mi mathvariant="normal" class="v">{base}</mi>'
        elif node.style == "script" and len(base) == 1 and "A" <= base <= "Z":
            text = f"<mi>{_SCRIPT.get(base) or chr(0x1D49C + ord(base) - ord('A'))}</mi>"
        else:
            upright = ' mathvariant="normal"' if node.style == "upright" else ""
            text = f"<mi{upright}>{base}</mi>"
        sub = "" if node.sub is None else _one(self.text(node.sub))
        sup = "" if node.sup is None else _one(self.text(node.sup))
        return indexed(dotted(text, node.dots), sub, sup)

    def _words(self, node: Words) -> str:
        text = escape(node.text)
        lead = text.replace(" ", "\u00a0")
        return f"<mtext>{lead}</mtext>"

    # Arithmetic

    def _sum(self, node: Sum) -> str:
        if not node.terms:
            return "<mn>0</mn>"
        pieces: list[str] = []
        for term in node.terms:
            text = self.text(term)
            if text.startswith(MINUS):
                pieces.append(_MINUS + text[len(MINUS) :] if pieces else text)
            else:
                pieces.append(_PLUS + text if pieces else text)
        return "".join(pieces)

    def _negative(self, node: Negative) -> str:
        text = self.text(node.argument)
        if type(node.argument) is Sum or text.startswith(MINUS):
            text = self.parenthesized(text)
        return MINUS + text

    def _product(self, node: Product) -> str:
        factors = flat_factors(node)
        if not factors:
            return "<mn>1</mn>"
        pieces: list[str] = []
        last = len(factors) - 1
        for position, factor in enumerate(factors):
            text = self.text(factor)
            joined = type(factor) in (Sum, Cross, Relation) or (type(factor) is BigSum and position < last)
            if joined or (pieces and text.startswith(MINUS)):
                text = self.parenthesized(text)
            elif pieces and (is_numeric(factor) or text.startswith("<mn>")):
                text = "<mo>\u22c5</mo>" + text
            elif type(factor) is Function and pieces and text.startswith("<mi>"):
                text = '<mspace width="0.17em"/>' + text
            pieces.append(text)
        return "".join(pieces)

    def _quotient(self, node: Quotient) -> str:
        return _fraction(_one(self.text(node.numerator)), _one(self.text(node.denominator)))

    def _power(self, node: Power) -> str:
        base, exponent = node.base, _one(self.text(node.exponent))
        if type(base) is Symbol:
            if self.style.starred(base):
                exponent = row(_STAR + exponent)
            return indexed(*self._parts(base), exponent)
        if type(base) is Function and base.name != "sqrt":
            if short := shorthand(base, self.style):
                return indexed(f"<mi>{short[0]}</mi>", _shorthand_index(short[1]), exponent)
            if is_whole(node.exponent):
                name = f"<msup><mi>{base.name}</mi>{exponent}</msup><mo>{_APPLY}</mo>"
                return name + self.parenthesized(self.text(base.argument))
            return f"<msup>{row(self.text(base))}{exponent}</msup>"
        if type(base) is Letter and base.sup is None:
            sub = "" if base.sub is None else _one(self.text(base.sub))
            return indexed(self._letter(Letter(base.base, None, None, base.style, base.dots)), sub, exponent)
        text = self.text(base)
        bare = type(base) in _BARE_BASES or is_whole(base)
        return f"<msup>{row(text if bare else self.parenthesized(text))}{exponent}</msup>"

    def _function(self, node: Function) -> str:
        if short := shorthand(node, self.style):
            return indexed(f"<mi>{short[0]}</mi>", _shorthand_index(short[1]), "")
        argument = self.text(node.argument)
        if node.name == "sqrt":
            return f"<msqrt>{argument}</msqrt>"
        return f"<mi>{node.name}</mi><mo>{_APPLY}</mo>{self.parenthesized(argument)}"

    # Formulas of the textbook

    def _matrix(self, node: Matrix) -> str:
        rows = "".join(
            f"<mtr>{''.join(f'<mtd>{self.text(entry)}</mtd>' for entry in cells)}</mtr>"
            for cells in node.rows
        )
        return row(f"<mo>[</mo><mtable>{rows}</mtable><mo>]</mo>")

    def _transpose(self, node: Transpose) -> str:
        argument = node.argument
        up = '<mi mathvariant="normal">T</mi>'
        if type(argument) is Letter and argument.sup is None:
            sub = "" if argument.sub is None else _one(self.text(argument.sub))
            bare = Letter(argument.base, None, None, argument.style, argument.dots)
            return indexed(self._letter(bare), sub, up)
        text = self.text(argument)
        if type(argument) not in (Symbol, Parenthesized, Matrix):
            text = self.parenthesized(text)
        return f"<msup>{row(text)}{up}</msup>"

    def _cross(self, node: Cross) -> str:
        return f"{self._operand(node.left)}<mo>×</mo>{self._operand(node.right)}"

    def _derivative(self, node: Derivative) -> str:
        d = "<mi>d</mi>" if node.total else "<mo>∂</mo>"
        below = row(d + self.text(node.by))
        if node.of is None:
            return _fraction(d, below)
        of = self.text(node.of)
        if type(node.of) in (Symbol, Letter):
            return _fraction(row(d + of), below)
        inner = of if type(node.of) is Parenthesized else self.parenthesized(of)
        return _fraction(d, below) + inner

    def _big_sum(self, node: BigSum) -> str:
        under = row(f"{self.text(node.index)}<mo>=</mo>{self.text(node.lower)}")
        sign = f"<munderover><mo>∑</mo>{under}{_one(self.text(node.upper))}</munderover>"
        return sign + self._summand(node.body)


def _fraction(above: str, below: str) -> str:
    return f"<mfrac>{above}{below}</mfrac>"


def _shorthand_index(subscript: str) -> str:
    return _indices(tuple(subscript.split(",")))
