r"""Trees -> LaTeX (with amsmath): \dot{\theta}_{1}, s_{12}, \frac{1}{2} I_{1,zz}."""

from __future__ import annotations

import re

from dynsolve.notation.characters import GREEK
from dynsolve.notation.names import split
from dynsolve.notation.printing import (
    PLAIN,
    FormulaPrinter,
    Style,
    decimal_text,
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

_DOTS = ("", r"\dot", r"\ddot", r"\dddot")
_STAR = r"\star"
_STYLES = {"bold": r"\mathbf", "script": r"\mathcal", "upright": r"\mathrm"}
_SIGNS = {
    "≈": r"\approx",
    "≠": r"\neq",
    "≡": r"\equiv",
    "≤": r"\leq",
    "≥": r"\geq",
    "→": r"\rightarrow",
    "⇒": r"\Rightarrow",
    "⇔": r"\Leftrightarrow",
}
_ESCAPES = {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
} | {character: "\\" + character for character in "{}$&#%_"}
_RUN = re.compile(r"[A-Za-z]+|[^A-Za-z]+")
_TALL = (r"\frac", r"\begin", r"\sum", r"\left")
_BARE_BASES = frozenset({Symbol, Parenthesized})
_ABBREVIATION = 3


def to_latex(node: Node, style: Style = PLAIN) -> str:
    r"""The tree as LaTeX, without dollar signs.

    >>> print(to_latex(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2))))))
    \frac{1}{2} m_{1} \dot{\theta}_{1}^{2}
    """
    return LatexPrinter(style).text(node)


def escaped(text: str) -> str:
    """Any text as LaTeX text."""
    text = "".join(_ESCAPES.get(character, character) for character in text)
    return text if text.isprintable() else "".join(c if c.isprintable() else " " for c in text)


def _letter(base: str) -> str:
    """A base or an index: a Greek letter, a letter in italics, a word upright."""
    if base in GREEK:
        return "\\" + base
    return base if len(base) == 1 else rf"\mathrm{{{base}}}"


def _group(index: str) -> str:
    """A group of indices: `c1` as it is, `max` upright, `omega1` as a Greek letter."""
    pieces = [
        _letter(run) if run in GREEK or (run.isalpha() and len(run) >= _ABBREVIATION) else run
        for run in _RUN.findall(index)
    ]
    return " ".join(pieces) if len(pieces) > 1 and pieces[0].startswith("\\") else "".join(pieces)


class LatexPrinter(FormulaPrinter):
    """LaTeX with amsmath; parentheses grow only where what they hold is tall."""

    notation = "LaTeX"

    def __init__(self, style: Style = PLAIN) -> None:
        super().__init__(style)
        self._symbols: dict[tuple[str, int], str] = {}

    def parenthesized(self, text: str) -> str:
        """The text in parentheses, which grow where it is tall."""
        if any(mark in text for mark in _TALL):
            return rf"\left( {text} \right)"
        return f"({text})"

    # Numbers and names

    def _number(self, node: Number) -> str:
        if node.q == 1:
            return str(node.p)
        if (self.style.decimal or node.decimal) and (decimal := decimal_text(node.p, node.q)):
            return decimal
        return ("-" if node.p < 0 else "") + rf"\frac{{{abs(node.p)}}}{{{node.q}}}"

    def _degrees(self, node: Degrees) -> str:
        text = decimal_text(node.p, node.q)
        return rf"{text}^{{\circ}}" if text else rf"\left( \frac{{{node.p}}}{{{node.q}}} \right)^{{\circ}}"

    def _symbol(self, node: Symbol) -> str:
        text = self._unmarked(node)
        return rf"{text}^{{{_STAR}}}" if self.style.starred(node) else text

    def _unmarked(self, node: Symbol) -> str:
        """A symbol without its star."""
        key = (node.name, node.dots)
        text = self._symbols.get(key)
        if text is None:
            base, groups = split(node.name)
            text = _dotted(_letter(base), node.dots)
            if groups:
                text += f"_{{{','.join(map(_group, groups))}}}"
            self._symbols[key] = text
        return text

    def _letter(self, node: Letter) -> str:
        if node.base in GREEK:
            base = "\\" + node.base
            base = rf"\boldsymbol{{{base}}}" if node.style == "bold" else base
        elif node.style == "italic":
            base = node.base if len(node.base) == 1 else rf"\mathit{{{escaped(node.base)}}}"
        else:
            base = f"{_STYLES[node.style]}{{{escaped(node.base)}}}"
        text = _dotted(base, node.dots)
        if node.sub is not None:
            text += f"_{{{self.text(node.sub)}}}"
        if node.sup is not None:
            text += f"^{{{self.text(node.sup)}}}"
        return text

    def _words(self, node: Words) -> str:
        return rf"\text{{{escaped(node.text)}}}"

    # Arithmetic

    def _product(self, node: Product) -> str:
        if not node.factors:
            return "1"
        pieces: list[str] = []
        last = len(node.factors) - 1
        for position, factor in enumerate(node.factors):
            text = self.text(factor)
            joined = type(factor) in (Sum, Cross, Relation) or (type(factor) is BigSum and position < last)
            if joined or (pieces and text.startswith("-")):
                text = self.parenthesized(text)
            elif pieces and (is_numeric(factor) or text[:1].isdecimal()):
                text = r"\cdot " + text
            pieces.append(text)
        return " ".join(pieces)

    def _quotient(self, node: Quotient) -> str:
        return rf"\frac{{{self.text(node.numerator)}}}{{{self.text(node.denominator)}}}"

    def _power(self, node: Power) -> str:
        base, exponent = node.base, self.text(node.exponent)
        if type(base) is Symbol and self.style.starred(base):
            return rf"{self._unmarked(base)}^{{{_STAR} {exponent}}}"
        if type(base) is Function and base.name != "sqrt":
            if shorthand(base, self.style) is None and is_whole(node.exponent):
                return rf"\{base.name}^{{{exponent}}}{self.parenthesized(self.text(base.argument))}"
            return f"{self.text(base)}^{{{exponent}}}"
        text = self.text(base)
        bare = type(base) in _BARE_BASES or is_whole(base) or (type(base) is Letter and base.sup is None)
        return f"{text if bare else self.parenthesized(text)}^{{{exponent}}}"

    def _function(self, node: Function) -> str:
        if short := shorthand(node, self.style):
            return f"{short[0]}_{{{','.join(map(_group, short[1].split(',')))}}}"
        argument = self.text(node.argument)
        if node.name == "sqrt":
            return rf"\sqrt{{{argument}}}"
        return rf"\{node.name}{self.parenthesized(argument)}"

    # Formulas of the textbook

    def _matrix(self, node: Matrix) -> str:
        rows = r" \\ ".join(" & ".join(map(self.text, row)) for row in node.rows)
        return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"

    def _transpose(self, node: Transpose) -> str:
        argument = node.argument
        text = self.text(argument)
        bare = type(argument) in (Symbol, Parenthesized, Matrix)
        bare = bare or (type(argument) is Letter and argument.sup is None)
        return f"{text if bare else self.parenthesized(text)}^{{T}}"

    def _cross(self, node: Cross) -> str:
        return rf"{self._operand(node.left)} \times {self._operand(node.right)}"

    def _derivative(self, node: Derivative) -> str:
        by = self.text(node.by)
        d = "d" if node.total else r"\partial"
        below = f"d{by}" if node.total and by[:1].isalpha() else f"{d} {by}"
        if node.of is None:
            return rf"\frac{{{d}}}{{{below}}}"
        of = self.text(node.of)
        if type(node.of) in (Symbol, Letter):
            above = f"d{of}" if node.total and of[:1].isalpha() else f"{d} {of}"
            return rf"\frac{{{above}}}{{{below}}}"
        inner = of if type(node.of) is Parenthesized else self.parenthesized(of)
        return rf"\frac{{{d}}}{{{below}}} {inner}"

    def _sign(self, sign: str) -> str:
        return f" {_SIGNS.get(sign, sign)} "

    def _big_sum(self, node: BigSum) -> str:
        bounds = f"_{{{self.text(node.index)}={self.text(node.lower)}}}^{{{self.text(node.upper)}}}"
        return rf"\sum{bounds} {self._summand(node.body)}"


def _dotted(base: str, dots: int) -> str:
    return f"{_DOTS[dots]}{{{base}}}" if dots else base
