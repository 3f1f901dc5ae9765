"""Trees -> Typst's mathematics: dot(theta)_(1), frac(1, 2), mat(...)."""

from __future__ import annotations

import re

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
)

_DOTS = ("", "dot", "dot.double", "dot.triple")
_STAR = "star.op"
_RUN = re.compile(r"[A-Za-z]+|[^A-Za-z]+")
_BARE_BASES = frozenset({Symbol, Parenthesized, Function})
_ABBREVIATION = 3


def to_typst(node: Node, style: Style = PLAIN) -> str:
    """The tree as Typst's mathematics, without dollar signs.

    >>> to_typst(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2)))))
    'frac(1, 2) m_(1) accent(θ, dot)_(1)^(2)'
    """
    return TypstPrinter(style).text(node)


def quoted(text: str) -> str:
    """Any text as a string of Typst."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def _letter(base: str) -> str:
    """A base or an index: a Greek letter, a letter in italics, a word upright."""
    if base in GREEK:
        return GREEK[base]
    return base if len(base) == 1 and base.isalnum() else quoted(base)


def _group(index: str) -> str:
    """A group of indices: `c1` is c and 1, `max` upright, `omega1` ω and 1."""
    pieces = []
    for run in _RUN.findall(index):
        if run in GREEK or (run.isalpha() and len(run) >= _ABBREVIATION):
            pieces.append(_letter(run))
        else:
            pieces.append(" ".join(run) if run.isalpha() else run)
    return " ".join(pieces)


def _indices(groups: tuple[str, ...]) -> str:
    return r" \, ".join(map(_group, groups))


def _dotted(base: str, dots: int) -> str:
    return f"accent({base}, {_DOTS[dots]})" if dots else base


class TypstPrinter(FormulaPrinter):
    """Typst's mathematics; parentheses that match grow by themselves."""

    notation = "Typst"

    def __init__(self, style: Style = PLAIN) -> None:
        super().__init__(style)
        self._symbols: dict[tuple[str, int], str] = {}

    # Numbers and names

    def _number(self, node: Number) -> str:
        if node.q == 1:
            return str(node.p)
        if (self.style.decimal or node.decimal) and (decimal := decimal_text(node.p, node.q)):
            return decimal
        return ("-" if node.p < 0 else "") + f"frac({abs(node.p)}, {node.q})"

    def _degrees(self, node: Degrees) -> str:
        text = decimal_text(node.p, node.q)
        return f"{text}°" if text else f"(frac({node.p}, {node.q}))°"

    def _symbol(self, node: Symbol) -> str:
        text = self._unmarked(node)
        return f"{text}^({_STAR})" if self.style.starred(node) else text

    def _unmarked(self, node: Symbol) -> str:
        """A symbol without its star."""
        key = (node.name, node.dots)
        text = self._symbols.get(key)
        if text is None:
            base, groups = split(node.name)
            text = _dotted(_letter(base), node.dots)
            if groups:
                text += f"_({_indices(groups)})"
            self._symbols[key] = text
        return text

    def _letter(self, node: Letter) -> str:
        base = _letter(node.base)
        if node.style == "bold":
            base = f"upright(bold({base}))"
        elif node.style == "script":
            base = f"cal({base})"
        elif node.style == "upright":
            base = f"upright({base})"
        text = _dotted(base, node.dots)
        if node.sub is not None:
            text += f"_({self.text(node.sub)})"
        if node.sup is not None:
            text += f"^({self.text(node.sup)})"
        return text

    def _words(self, node: Words) -> str:
        """Upright words; a comma that separates formulas is punctuation."""
        if node.text.strip() == ",":
            return r"\, quad" if node.text.endswith(" ") else r"\,"
        return quoted(node.text)

    # Arithmetic

    def _product(self, node: Product) -> str:
        factors = flat_factors(node)
        if not factors:
            return "1"
        pieces: list[str] = []
        last = len(factors) - 1
        for position, factor in enumerate(factors):
            text = self.text(factor)
            joined = type(factor) in (Sum, Cross, Relation) or (type(factor) is BigSum and position < last)
            if joined or (pieces and text.startswith("-")):
                text = self.parenthesized(text)
            elif pieces and (is_numeric(factor) or text[:1].isdecimal()):
                text = "dot.op " + text
            pieces.append(text)
        return " ".join(pieces)

    def _quotient(self, node: Quotient) -> str:
        return f"frac({self.text(node.numerator)}, {self.text(node.denominator)})"

    def _power(self, node: Power) -> str:
        base, exponent = node.base, self.text(node.exponent)
        if type(base) is Symbol and self.style.starred(base):
            return f"{self._unmarked(base)}^({_STAR} {exponent})"
        if type(base) is Function and base.name != "sqrt":
            if shorthand(base, self.style) is None and is_whole(node.exponent):
                return f"{base.name}^({exponent}) {self.parenthesized(self.text(base.argument))}"
            return f"{self.text(base)}^({exponent})"
        text = self.text(base)
        bare = type(base) in _BARE_BASES or is_whole(base) or (type(base) is Letter and base.sup is None)
        return f"{text if bare else self.parenthesized(text)}^({exponent})"

    def _function(self, node: Function) -> str:
        if short := shorthand(node, self.style):
            return f"{short[0]}_({_indices(tuple(short[1].split(',')))})"
        argument = self.text(node.argument)
        if node.name == "sqrt":
            return f"sqrt({argument})"
        return f"{node.name} {self.parenthesized(argument)}"

    # Formulas of the textbook

    def _matrix(self, node: Matrix) -> str:
        rows = "; ".join(", ".join(map(self.text, cells)) for cells in node.rows)
        return f"mat({rows})"

    def _row(self, node: Row) -> str:
        """Parts side by side; beside a string a space would be seen."""
        text = ""
        for part in map(self.text, node.parts):
            text += part if not text or '"' in (text[-1], part[0]) else " " + part
        return text

    def _transpose(self, node: Transpose) -> str:
        argument = node.argument
        text = self.text(argument)
        bare = type(argument) in (Symbol, Parenthesized, Matrix)
        bare = bare or (type(argument) is Letter and argument.sup is None)
        return f"{text if bare else self.parenthesized(text)}^(T)"

    def _cross(self, node: Cross) -> str:
        return f"{self._operand(node.left)} times {self._operand(node.right)}"

    def _derivative(self, node: Derivative) -> str:
        d = "d" if node.total else "partial"
        below = f"{d} {self.text(node.by)}"
        if node.of is None:
            return f"frac({d}, {below})"
        of = self.text(node.of)
        if type(node.of) in (Symbol, Letter):
            return f"frac({d} {of}, {below})"
        inner = of if type(node.of) is Parenthesized else self.parenthesized(of)
        return f"frac({d}, {below}) {inner}"

    def _big_sum(self, node: BigSum) -> str:
        bounds = f"_({self.text(node.index)} = {self.text(node.lower)})^({self.text(node.upper)})"
        return f"sum{bounds} {self._summand(node.body)}"
