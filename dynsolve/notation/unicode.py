"""Trees -> one line of Unicode, as a textbook looks in a terminal: m₂ L₂² θ̇₁, s₁₂, ½ I_1zz.

Letters that Unicode has no subscript of stand after an underscore (l_c1), in
braces where the subscript has more than letters and digits (I_{xx,1}).
"""

from __future__ import annotations

import re

from dynsolve.notation.characters import GREEK, SUBSCRIPT_DIGITS, SUPERSCRIPT_DIGITS
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
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
)

_DOTS = ("", "\u0307", "\u0308", "\u20db")
_STAR = "⋆"
_SUBSCRIPTS = dict(zip("0123456789ijkn+-=()", SUBSCRIPT_DIGITS + "ᵢⱼₖₙ₊₋₌₍₎", strict=True))
_SUPERSCRIPTS = dict(zip("0123456789inT+-()", SUPERSCRIPT_DIGITS + "ⁱⁿᵀ⁺⁻⁽⁾", strict=True))
_FRACTIONS = {
    (1, 2): "½",
    (1, 3): "⅓",
    (2, 3): "⅔",
    (1, 4): "¼",
    (3, 4): "¾",
    (1, 6): "⅙",
    (5, 6): "⅚",
    (1, 8): "⅛",
    (3, 8): "⅜",
    (5, 8): "⅝",
    (7, 8): "⅞",
}
_FRACTION_SIGNS = frozenset(_FRACTIONS.values())
_SCRIPT = {"I": "𝓘", "L": "𝓛", "B": "ℬ", "E": "ℰ", "F": "ℱ", "H": "ℋ", "M": "ℳ", "R": "ℛ"}
_RUN = re.compile(r"[A-Za-z]+|[^A-Za-z]+")
_BARE_BASES = frozenset({Symbol, Parenthesized})
_BARE_DENOMINATORS = frozenset({Symbol, Function, Power, Letter, Parenthesized})
_BARE_TRANSPOSED = frozenset({Symbol, Parenthesized, Matrix})


def to_unicode(node: Node, style: Style = PLAIN) -> str:
    """The tree on one line.

    >>> to_unicode(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2)))))
    '½ m₁ θ̇₁²'
    """
    return UnicodePrinter(style).text(node)


def width(text: str) -> int:
    """How many columns of a terminal a text takes: dots over letters take none.

    >>> width("θ̇₁")
    2
    """
    if text.isascii():
        return len(text)
    return sum(map(_columns, text))


def _columns(character: str) -> int:
    if character < "\u0300":
        return 1
    import unicodedata

    if unicodedata.category(character) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1


def printable(text: str) -> str:
    """The text without the characters that could steer a terminal."""
    if text.isprintable():
        return text
    return "".join(character if character.isprintable() else "\ufffd" for character in text)


def lowered(index: str) -> str:
    """An index as a subscript: `12` is ₁₂, `c1` is _c1, `1,2` is _{1,2}."""
    return _shifted(index, _SUBSCRIPTS, "_")


def raised(index: str) -> str:
    """An index as a superscript: `0` is ⁰, `T` is ᵀ, `a` is ^a."""
    return _shifted(index, _SUPERSCRIPTS, "^")


def _shifted(index: str, table: dict[str, str], sign: str) -> str:
    if all(character in table for character in index):
        return "".join(table[character] for character in index)
    return sign + (index if index.isalnum() else f"{{{index}}}")


def _accented(base: str, dots: int) -> str:
    return GREEK.get(base, base) + _DOTS[dots]


def _with_greek(index: str) -> str:
    """`omega1` -> `ω1`: Greek letters that are spelled out in an index."""
    return "".join(GREEK.get(run, run) for run in _RUN.findall(index))


def _joined(groups: tuple[str, ...]) -> str:
    """Groups of indices; a comma only where the next would not be seen to begin."""
    text = ""
    for group in map(_with_greek, groups):
        text += "," + group if text and not (text[-1].isdecimal() and group[0].isalpha()) else group
    return text


class UnicodePrinter(FormulaPrinter):
    """One line of Unicode; products have no sign where none is needed."""

    notation = "Unicode"
    between = ""
    compound = FormulaPrinter.compound | {Quotient}

    def __init__(self, style: Style = PLAIN) -> None:
        super().__init__(style)
        self._symbols: dict[tuple[str, int], str] = {}

    # Numbers and names

    def _number(self, node: Number) -> str:
        if node.q == 1:
            return str(node.p)
        if (self.style.decimal or node.decimal) and (decimal := decimal_text(node.p, node.q)):
            return decimal
        return _FRACTIONS.get((node.p, node.q)) or f"{node.p}/{node.q}"

    def _degrees(self, node: Degrees) -> str:
        text = decimal_text(node.p, node.q)
        return f"{text}°" if text else f"({node.p}/{node.q})°"

    def _symbol(self, node: Symbol) -> str:
        key = (node.name, node.dots)
        text = self._symbols.get(key)
        if text is None:
            base, groups = split(node.name)
            text = self._symbols[key] = _accented(base, node.dots) + (
                lowered(_joined(groups)) if groups else ""
            )
        return text + _STAR if self.style.starred(node) else text

    def _letter(self, node: Letter) -> str:
        base = printable(node.base)
        if node.style == "script" and len(base) == 1 and "A" <= base <= "Z":
            base = _SCRIPT.get(base) or chr(0x1D49C + ord(base) - ord("A"))
        text = _accented(base, node.dots)
        if node.sub is not None:
            text += lowered(self._index(node.sub))
        if node.sup is not None:
            text += raised(self._index(node.sup))
        return text

    def _index(self, node: Node) -> str:
        """What stands in a subscript, on one level: v_1 is `v1`."""
        match node:
            case Symbol():
                base, groups = split(node.name)
                return _accented(base, node.dots) + _joined(groups)
            case Letter():
                parts = [part for part in (node.sub, node.sup) if part is not None]
                return _accented(printable(node.base), node.dots) + "".join(map(self._index, parts))
            case Row():
                return "".join(map(self._index, node.parts))
            case Product():
                return "".join(map(self._index, node.factors))
            case Words():
                return printable(node.text)
        return self.text(node).replace(" ", "")

    def _words(self, node: Words) -> str:
        return printable(node.text)

    # Arithmetic

    def _product(self, node: Product) -> str:
        factors = flat_factors(node)
        if not factors:
            return "1"
        last = len(factors) - 1
        text = before = self._factor(factors[0], True, last == 0)
        for position in range(1, last + 1):
            factor = factors[position]
            piece = self._factor(factor, False, position == last)
            text += _between(before, piece) + piece
            before = piece
        return text

    def _factor(self, node: Node, first: bool, last: bool) -> str:
        """A factor, in parentheses where it would run into its neighbours."""
        kind = type(node)
        if kind is Symbol:
            return self._symbol(node)  # type: ignore[arg-type]
        if kind is Negative and first:
            return "-" + self._factor(node.argument, False, last)  # type: ignore[attr-defined]
        text = self.text(node)
        if kind is Sum or kind is Cross or kind is Relation or text.startswith("-"):
            return f"({text})"
        if is_numeric(node):
            return f"({text})" if "/" in text and not (first and last) else text
        open_ended = kind is Quotient or kind is BigSum or kind is Product or _is_applied(node)
        return f"({text})" if open_ended and not last else text

    def _quotient(self, node: Quotient) -> str:
        if is_numeric(node) and (sign := _fraction_sign(node)):
            return sign
        numerator = self._numerator(node.numerator)
        denominator = self.text(node.denominator)
        is_number = denominator.replace(".", "", 1).isdecimal()
        if not (is_number or type(node.denominator) in _BARE_DENOMINATORS):
            denominator = f"({denominator})"
        return f"{numerator}/{denominator}"

    def _numerator(self, node: Node) -> str:
        if type(node) is Negative:
            text = self._numerator(node.argument)
            return f"-({text})" if text.startswith("-") else "-" + text
        text = self.text(node)
        end = (flat_factors(node) or (node,))[-1] if type(node) is Product else node
        runs_on = type(end) in (Sum, Quotient, BigSum, Cross, Relation) and end is node
        runs_on = runs_on or type(end) in (Quotient, BigSum) or _is_applied(end)
        if runs_on or text.startswith("-") or (type(node) is Number and "/" in text):
            return f"({text})"
        return text

    def _power(self, node: Power) -> str:
        exponent = self._exponent(node.exponent)
        base = node.base
        if type(base) is Function and base.name != "sqrt":
            if shorthand(base, self.style) is None and is_whole(node.exponent):
                return f"{base.name}{exponent}({self.text(base.argument)})"
            return self.text(base) + exponent
        text = self.text(base)
        bare = type(base) in _BARE_BASES or is_whole(base) or (type(base) is Letter and base.sup is None)
        return (text if bare else f"({text})") + exponent

    def _exponent(self, node: Node) -> str:
        text = self.text(node)
        if all(character in _SUPERSCRIPTS for character in text):
            return raised(text)
        return f"^{text}" if type(node) is Symbol else f"^({text})"

    def _function(self, node: Function) -> str:
        if short := shorthand(node, self.style):
            return short[0] + lowered(short[1])
        argument = self.text(node.argument)
        if node.name == "sqrt":
            bare = type(node.argument) in _BARE_BASES or is_whole(node.argument)
            return f"√{argument}" if bare else f"√({argument})"
        return f"{node.name}({argument})"

    # Formulas of the textbook

    def _matrix(self, node: Matrix) -> str:
        rows = (f"[{', '.join(map(self.text, row))}]" for row in node.rows)
        return f"[{', '.join(rows)}]"

    def _transpose(self, node: Transpose) -> str:
        argument = node.argument
        text = self.text(argument)
        bare = type(argument) in _BARE_TRANSPOSED or (type(argument) is Letter and argument.sup is None)
        return (text if bare else f"({text})") + "ᵀ"

    def _cross(self, node: Cross) -> str:
        return f"{self._operand(node.left)} × {self._operand(node.right)}"

    def _derivative(self, node: Derivative) -> str:
        d = "d" if node.total else "∂"
        by = self._operand(node.by)
        if node.of is None:
            return f"{d}/{d}{by}"
        of = self.text(node.of)
        if type(node.of) in (Symbol, Letter):
            return f"{d}{of}/{d}{by}"
        return f"{d}/{d}{by} {of if type(node.of) is Parenthesized else f'({of})'}"

    def _big_sum(self, node: BigSum) -> str:
        below = f"{self._index(node.index)}={self._index(node.lower)}"
        return f"Σ{lowered(below)}{raised(self._index(node.upper))} {self._summand(node.body)}"


def _fraction_sign(node: Quotient) -> str | None:
    """The one character of 1/2 and its like, where both numbers are whole."""
    p, q = node.numerator, node.denominator
    if isinstance(p, Number) and isinstance(q, Number) and p.q == q.q == 1:
        return _FRACTIONS.get((p.p, q.p))
    return None


def _is_applied(node: Node) -> bool:
    """Whether the node is a derivative of something, which what follows would seem to belong to."""
    return type(node) is Derivative and node.of is not None


def _between(before: str, after: str) -> str:
    """What separates two factors: a dot before a number, nothing after one, else a space."""
    lead = after[:1]
    if lead.isdecimal() or lead in _FRACTION_SIGNS:
        return "·"
    if before.lstrip("-").isdecimal() or (lead == "(" and before[:1] == "(" and before[-1:] == ")"):
        return ""
    return " "
