"""Trees -> MathML Core, which browsers show without help: dots as accents, fractions, matrices.

Text is a row of elements, to be put into `<math>`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

from dynsolve.notation.characters import GREEK, bold_script_letter, script_letter
from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.printing import PLAIN, Style, decimal_text
from dynsolve.notation.tree import BigSum, Degrees, Function, Integral, Node, Number, Words

MINUS = '<mo form="prefix">\u2212</mo>'
"""The minus of a negative; between two terms it is another."""

_DOTS = ("", "\u02d9", "\u00a8", "\u20db")
_APPLY = "<mo>\u2061</mo>"
_CAPITAL = re.compile("<mi>[B-KM-Z]</mi>")
_COMMA = "<mo separator='true'>,</mo>"
_FACTOR = re.compile(r"([\d.]+)·")
"""Words that are a factor of a power of ten."""
_OPERATOR = re.compile(r"(sin|cos|det)?(?:(?<=[a-z])( )|([()]))?")
"""Words that are signs of the formula: the name of a function, and the parentheses of what it is of."""
_OPERATOR_PARTS = (
    "<mi>{}</mi>".format,
    '<mspace width="0.17em"/>'.format,
    '<mo stretchy="false">{}</mo>'.format,
)
_TALL = ("<mfrac>", "<mtable>", "<munderover>")


def to_mathml(node: Node, style: Style = PLAIN) -> str:
    """The tree as a MathML row.

    >>> from dynsolve.notation.tree import Number, Product, Symbol
    >>> to_mathml(Product((Number(2), Symbol("m1"))))
    '<mn>2</mn><msub><mi>m</mi><mn>1</mn></msub>'
    """
    return MathMLPrinter(style).text(node)


def row(text: str) -> str:
    """Elements as one element."""
    return f"<mrow>{text}</mrow>"


class MathMLPrinter(FormulaPrinter):
    """MathML Core; parentheses grow only where what they hold is tall."""

    notation = "MathML"
    between = ""
    after_operator = ""
    minus = MINUS
    argument_separator = "<mo>,</mo>"
    signs = ("<mo>+</mo>", "<mo>\u2212</mo>")
    star = "<mo>\u22c6</mo>"
    dot = "<mo>\u22c5</mo>"
    cross = "<mo>×</mo>"
    transposition = "<mi>T</mi>"
    differentials = ('<mo lspace="0" rspace="0">∂</mo>', "<mi>d</mi>")

    def parenthesized(self, text: str) -> str:
        """The text in parentheses."""
        if any(mark in text for mark in _TALL):
            return row(f"<mo>(</mo>{text}<mo>)</mo>")
        return f'<mo stretchy="false">(</mo>{text}<mo stretchy="false">)</mo>'

    def _one(self, text: str) -> str:
        """Text as one element: a row unless it is one already."""
        return text if re.fullmatch(r"<(mi|mn|mo)>[^<]*</\1>", text) else row(text)

    def _digits(self, text: str) -> str:
        return f"{MINUS}<mn>{text[1:]}</mn>" if text.startswith("-") else f"<mn>{text}</mn>"

    def _base(self, base: str) -> str:
        return f"<mi>{escape(GREEK.get(base, base))}</mi>"

    def _styled(self, base: str, style: str) -> str:
        base = escape(GREEK.get(base, base))
        match style:
            case "bold":
                return f'<mi mathvariant="normal" class="v">{base}</mi>'
            case "upright":
                return f'<mi mathvariant="normal">{base}</mi>'
            case "script":
                return f"<mi>{script_letter(base)}</mi>"
            case "bold script":
                return f"<mi>{bold_script_letter(base)}</mi>"
        return f"<mi>{base}</mi>"

    def _dotted(self, base: str, dots: int) -> str:
        return f'<mover accent="true">{base}<mo>{_DOTS[dots]}</mo></mover>'

    def _indices(self, groups: Sequence[str]) -> str:
        return self._one(_COMMA.join(map(self._group, groups)))

    def _run(self, text: str) -> str:
        if text.isalpha():
            return "".join(f"<mi>{character}</mi>" for character in text)
        return f"<mn>{escape(text)}</mn>"

    def _scripted(self, base: str, sub: str, sup: str) -> str:
        if sup and _CAPITAL.fullmatch(base):  # it leans to the right, and browsers leave no room for that
            base = base.replace("<mi>", '<mi class="slanted">')
        if sub and sup:
            return f"<msubsup>{base}{sub}{sup}</msubsup>"
        if sub:
            return f"<msub>{base}{sub}</msub>"
        return f"<msup>{base}{sup}</msup>" if sup else base

    def _raised(self, text: str, exponent: str) -> str:
        return f"<msup>{row(text)}{exponent}</msup>"

    def _fraction(self, above: str, below: str) -> str:
        return f"<mfrac>{above}{below}</mfrac>"

    def _stroke(self, above: str, below: str) -> str:
        return row(f'{above}<mo form="infix" lspace="0" rspace="0">/</mo>{below}')

    def _root(self, argument: Node) -> str:
        return f"<msqrt>{self.text(argument)}</msqrt>"

    def _applied(self, name: str, argument: str, exponent: str = "") -> str:
        return self._scripted(f"<mi>{name}</mi>", "", exponent) + _APPLY + self.parenthesized(argument)

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        cells = ("".join(f"<mtd>{entry}</mtd>" for entry in cells) for cells in rows)
        body = "".join(f"<mtr>{row}</mtr>" for row in cells)
        return row(f"<mo>[</mo><mtable>{body}</mtable><mo>]</mo>")

    def _differential(self, d: str, of: Node) -> str:
        return row(d + self.text(of))

    def _factor_sign(self, factor: Node, text: str) -> str:
        """A dot before a number, a thin space between a letter and a function."""
        if text.startswith("<mn>") or super()._factor_sign(factor, text):
            return self.dot
        return '<mspace width="0.17em"/>' if type(factor) is Function and text.startswith("<mi>") else ""

    def _relation_sign(self, sign: str) -> str:
        return f"<mo>{escape(sign)}</mo>"

    def _degrees(self, node: Degrees) -> str:
        if text := decimal_text(node.p, node.q):
            return self._digits(text + "°")
        return f"<msup>{row(self.parenthesized(self._number(Number(node.p, node.q))))}<mo>°</mo></msup>"

    def _words(self, node: Words) -> str:
        if sign := _OPERATOR.fullmatch(node.text):
            return "".join(f(part) for f, part in zip(_OPERATOR_PARTS, sign.groups(), strict=True) if part)
        if node.text == ",":
            return _COMMA
        if number := _FACTOR.fullmatch(node.text):
            return f"<mn>{number[1]}</mn>{self.dot}"
        text = escape(node.text).replace(" ", "\u00a0")
        return f"<mtext>{text}</mtext>"

    def _integral(self, node: Integral) -> str:
        bounds = self._one(self.text(node.lower)) + self._one(self.text(node.upper))
        variable = f'<mspace width="0.17em"/><mi mathvariant="normal">d</mi>{self.text(node.variable)}'
        return f"<msubsup><mo>∫</mo>{bounds}</msubsup>{self._summand(node.body)}{variable}"

    def _big_sum(self, node: BigSum) -> str:
        under = row(f"{self.text(node.index)}<mo>=</mo>{self.text(node.lower)}")
        sign = f"<munderover><mo>∑</mo>{under}{self._one(self.text(node.upper))}</munderover>"
        return sign + self._summand(node.body)
