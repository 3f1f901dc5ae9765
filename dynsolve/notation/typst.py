"""Trees -> Typst's mathematics: dot(theta)_(1), frac(1, 2), mat(...)."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.notation.characters import GREEK
from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.printing import PLAIN, Style, decimal_text
from dynsolve.notation.tree import (
    BigSum,
    Degrees,
    Function,
    Integral,
    Node,
    Parenthesized,
    Words,
)

_DOTS = ("", "dot", "dot.double", "dot.triple")
_TALL = ("frac(", "mat(", "sum_")
_STYLES = {
    "bold": "upright(bold({}))",
    "script": "cal({})",
    "bold script": "bold(cal({}))",
    "upright": "upright({})",
    "italic": "{}",
}

_OPERATORS = frozenset({"sin", "cos", "tan", "arcsin", "arccos", "arctan"})


def to_typst(node: Node, style: Style = PLAIN) -> str:
    """The tree as Typst's mathematics, without dollar signs.

    >>> from dynsolve.notation.tree import Number, Power, Product, Symbol
    >>> to_typst(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2)))))
    'frac(1, 2) m_(1) accent(θ, dot)_(1)^(2)'
    """
    return TypstPrinter(style).text(node)


def quoted(text: str) -> str:
    """Any text as a string of Typst."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


class TypstPrinter(FormulaPrinter):
    """Typst's mathematics; parentheses grow only where what they hold is tall."""

    notation = "Typst"
    star = "star.op"
    dot = "dot.op "
    cross = " times "
    argument_separator = r"\, "
    differentials = ("partial", "d")
    bare_bases = frozenset({Function, Parenthesized})

    def parenthesized(self, text: str) -> str:
        """The text in parentheses; escaped ones do not grow, over a dot on a letter for one."""
        return f"({text})" if any(mark in text for mark in _TALL) else rf"\( {text} \)"

    def _base(self, base: str) -> str:
        if base in GREEK:
            return GREEK[base]
        return base if len(base) == 1 and base.isalnum() else quoted(base)

    def _styled(self, base: str, style: str) -> str:
        return _STYLES[style].format(self._base(base))

    def _dotted(self, base: str, dots: int) -> str:
        return f"accent({base}, {_DOTS[dots]})"

    def _indices(self, groups: Sequence[str]) -> str:
        return r" \, ".join(map(self._group, groups))

    def _run(self, text: str) -> str:
        return " ".join(text) if text.isalpha() else text

    def _side_by_side(self, pieces: Sequence[str]) -> str:
        return " ".join(pieces)

    def _scripted(self, base: str, sub: str, sup: str) -> str:
        if sub:
            base = f"{base}_({sub})"
        return f"{base}^({sup})" if sup else base

    def _fraction(self, above: str, below: str) -> str:
        return f"frac({above}, {below})"

    def _stroke(self, above: str, below: str) -> str:
        return rf"{above}\/{below}"

    def _root(self, argument: Node) -> str:
        return f"sqrt({self.text(argument)})"

    def _applied(self, name: str, argument: str, exponent: str = "") -> str:
        operator = name if name in _OPERATORS else f'op("{name}")'
        return f"{self._scripted(operator, '', exponent)} {self.parenthesized(argument)}"

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        return f"mat({'; '.join(map(', '.join, rows))})"

    def _degrees(self, node: Degrees) -> str:
        text = decimal_text(node.p, node.q)
        return f"{text}°" if text else f"(frac({node.p}, {node.q}))°"

    def _behind_words(self, text: str) -> str:
        return f'class("unary", {self.minus}) {text.removeprefix(self.minus)}'

    def _words(self, node: Words) -> str:
        """Upright words; a comma that separates formulas is punctuation."""
        if node.text.strip() == ",":
            return r"\, quad" if node.text.endswith(" ") else r"\,"
        return quoted(node.text)

    def _joined(self, texts: Sequence[str]) -> str:
        """Parts side by side; beside a string a space would be seen."""
        text = ""
        for part in texts:
            text += part if not text or '"' in (text[-1], part[0]) else " " + part
        return text

    def _integral(self, node: Integral) -> str:
        sign = self._scripted("integral", self.text(node.lower), self.text(node.upper))
        return f"{sign} {self._summand(node.body)} dif {self.text(node.variable)}"

    def _big_sum(self, node: BigSum) -> str:
        below = f"{self.text(node.index)} = {self.text(node.lower)}"
        return f"{self._scripted('sum', below, self.text(node.upper))} {self._summand(node.body)}"
