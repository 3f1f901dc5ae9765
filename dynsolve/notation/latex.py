r"""Trees -> LaTeX (with amsmath): \dot{\theta}_{1}, s_{12}, \frac{1}{2} I_{1,zz}."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.notation.characters import GREEK
from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.printing import PLAIN, Style, decimal_text
from dynsolve.notation.tree import BigSum, Degrees, Integral, Node, Words

_DOTS = ("", r"\dot", r"\ddot", r"\dddot")
_STYLES = {"bold": r"\mathbf", "script": r"\mathcal", "upright": r"\mathrm"}
SIGNS = {
    "×": r"\times",
    "≈": r"\approx",
    "≠": r"\neq",
    "≡": r"\equiv",
    "≤": r"\leq",
    "≥": r"\geq",
    "→": r"\rightarrow",
    "⇒": r"\Rightarrow",
    "⇔": r"\Leftrightarrow",
    "±": r"\pm",
    "= ±": r"= \pm",
}
"""Sign of a relation, or of a cross product -> LaTeX."""

_ESCAPES = {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
} | {character: "\\" + character for character in "{}$&#%_"}
_COMMANDS = frozenset({"sin", "cos", "tan", "arcsin", "arccos", "arctan"})
_TALL = (r"\frac", r"\begin", r"\sum", r"\left")


def to_latex(node: Node, style: Style = PLAIN) -> str:
    r"""The tree as LaTeX, without dollar signs.

    >>> from dynsolve.notation.tree import Number, Power, Product, Symbol
    >>> print(to_latex(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2))))))
    \frac{1}{2} m_{1} \dot{\theta}_{1}^{2}
    """
    return LatexPrinter(style).text(node)


def escaped(text: str) -> str:
    """Any text as LaTeX text."""
    text = "".join(_ESCAPES.get(character, character) for character in text)
    return text if text.isprintable() else "".join(c if c.isprintable() else " " for c in text)


class LatexPrinter(FormulaPrinter):
    """LaTeX with amsmath; parentheses grow only where what they hold is tall."""

    notation = "LaTeX"
    star = r"\star"
    dot = r"\cdot "
    cross = r" \times "
    differentials = (r"\partial", "d")
    row_end = r" \\ "

    def parenthesized(self, text: str) -> str:
        """The text in parentheses, which grow where it is tall."""
        if any(mark in text for mark in _TALL):
            return rf"\left( {text} \right)"
        return f"({text})"

    def _base(self, base: str) -> str:
        if base in GREEK:
            return "\\" + base
        return base if len(base) == 1 else rf"\mathrm{{{base}}}"

    def _styled(self, base: str, style: str) -> str:
        if base in GREEK:
            return rf"\boldsymbol{{\{base}}}" if style == "bold" else "\\" + base
        if style == "italic":
            return base if len(base) == 1 else rf"\mathit{{{escaped(base)}}}"
        if style == "bold script":
            return rf"\boldsymbol{{\mathcal{{{escaped(base)}}}}}"
        return f"{_STYLES[style]}{{{escaped(base)}}}"

    def _dotted(self, base: str, dots: int) -> str:
        return f"{_DOTS[dots]}{{{base}}}"

    def _indices(self, groups: Sequence[str]) -> str:
        return ",".join(map(self._group, groups))

    def _side_by_side(self, pieces: Sequence[str]) -> str:
        """The runs of an index: a command ends at a blank."""
        return " ".join(pieces) if pieces[0].startswith("\\") and pieces[0][-1].isalpha() else "".join(pieces)

    def _scripted(self, base: str, sub: str, sup: str) -> str:
        if sub:
            base = f"{base}_{{{sub}}}"
        return f"{base}^{{{sup}}}" if sup else base

    def _fraction(self, above: str, below: str) -> str:
        return rf"\frac{{{above}}}{{{below}}}"

    def _root(self, argument: Node) -> str:
        return rf"\sqrt{{{self.text(argument)}}}"

    def _applied(self, name: str, argument: str, exponent: str = "") -> str:
        command = f"\\{name}" if name in _COMMANDS else rf"\operatorname{{{name}}}"
        return self._scripted(command, "", exponent) + self.parenthesized(argument)

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        body = self.row_end.join(" & ".join(row) for row in rows)
        return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"

    def _differential(self, d: str, of: Node) -> str:
        text = self.text(of)
        return d + text if d == "d" and text[:1].isalpha() else f"{d} {text}"

    def _relation_sign(self, sign: str) -> str:
        return f" {SIGNS.get(sign, sign)} "

    def _degrees(self, node: Degrees) -> str:
        text = decimal_text(node.p, node.q)
        return rf"{text}^{{\circ}}" if text else rf"\left( \frac{{{node.p}}}{{{node.q}}} \right)^{{\circ}}"

    def _behind_words(self, text: str) -> str:
        return f"{{{text}}}"

    def _words(self, node: Words) -> str:
        return rf"\text{{{escaped(node.text)}}}"

    def _integral(self, node: Integral) -> str:
        sign = self._scripted(r"\int", self.text(node.lower), self.text(node.upper))
        return rf"{sign} {self._summand(node.body)} \, \mathrm{{d}} {self.text(node.variable)}"

    def _big_sum(self, node: BigSum) -> str:
        below = f"{self.text(node.index)}={self.text(node.lower)}"
        bounds = self._scripted(r"\sum", below, self.text(node.upper))
        return f"{bounds} {self._summand(node.body)}"
