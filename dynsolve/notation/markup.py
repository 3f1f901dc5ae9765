r"""Trees -> what other programs set: LaTeX (with amsmath), Typst, MathML Core.

\dot{\theta}_{1} and \frac{1}{2}; accent(θ, dot)_(1) and frac(1, 2); <mfrac>, a row of elements to be put
into `<math>`, which browsers show without help.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

from dynsolve.notation.characters import GREEK, bold_script_letter, script_letter
from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.printing import PLAIN, Style, decimal_text
from dynsolve.notation.tree import BigSum, Degrees, Function, Integral, Node, Number, Parenthesized, Words

# LaTeX

_LATEX_DOTS = ("", r"\dot", r"\ddot", r"\dddot")
_LATEX_STYLES = {"bold": r"\mathbf", "script": r"\mathcal", "upright": r"\mathrm"}
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

ESCAPES = {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
} | {character: "\\" + character for character in "{}$&#%_"}
"""Signs that mean something in LaTeX, as text."""

_COMMANDS = frozenset({"sin", "cos", "tan", "arcsin", "arccos", "arctan"})
_LATEX_TALL = (r"\frac", r"\begin", r"\sum", r"\left")


def to_latex(node: Node, style: Style = PLAIN) -> str:
    r"""The tree as LaTeX, without dollar signs.

    >>> from dynsolve.notation.tree import Number, Power, Product, Symbol
    >>> print(to_latex(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2))))))
    \frac{1}{2} m_{1} \dot{\theta}_{1}^{2}
    """
    return LatexPrinter(style).text(node)


def escaped(text: str) -> str:
    """Any text as LaTeX text."""
    text = "".join(ESCAPES.get(character, character) for character in text)
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
        if any(mark in text for mark in _LATEX_TALL):
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
        return f"{_LATEX_STYLES[style]}{{{escaped(base)}}}"

    def _dotted(self, base: str, dots: int) -> str:
        return f"{_LATEX_DOTS[dots]}{{{base}}}"

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
        return SIGNS.get(node.text.strip()) or rf"\text{{{escaped(node.text)}}}"

    def _integral(self, node: Integral) -> str:
        sign = self._scripted(r"\int", self.text(node.lower), self.text(node.upper))
        return rf"{sign} {self._summand(node.body)} \, \mathrm{{d}} {self.text(node.variable)}"

    def _big_sum(self, node: BigSum) -> str:
        below = f"{self.text(node.index)}={self.text(node.lower)}"
        bounds = self._scripted(r"\sum", below, self.text(node.upper))
        return f"{bounds} {self._summand(node.body)}"


# Typst

_TYPST_DOTS = ("", "dot", "dot.double", "dot.triple")
_TYPST_TALL = ("frac(", "mat(", "sum_")
_TYPST_STYLES = {
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
        return f"({text})" if any(mark in text for mark in _TYPST_TALL) else rf"\( {text} \)"

    def _base(self, base: str) -> str:
        if base in GREEK:
            return GREEK[base]
        return base if len(base) == 1 and base.isalnum() else quoted(base)

    def _styled(self, base: str, style: str) -> str:
        return _TYPST_STYLES[style].format(self._base(base))

    def _dotted(self, base: str, dots: int) -> str:
        return f"accent({base}, {_TYPST_DOTS[dots]})"

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


# MathML

MINUS = '<mo form="prefix">\u2212</mo>'
"""The minus of a negative; between two terms it is another."""

_MATHML_DOTS = ("", "\u02d9", "\u00a8", "\u20db")
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
_MATHML_TALL = ("<mfrac>", "<mtable>", "<munderover>")


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
        if any(mark in text for mark in _MATHML_TALL):
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
        return f'<mover accent="true">{base}<mo>{_MATHML_DOTS[dots]}</mo></mover>'

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
