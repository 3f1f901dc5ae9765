"""Trees -> one line of Unicode, as a textbook looks in a terminal: m₂ L₂² θ̇₁, s₁₂, ½ I_1zz.

Letters that Unicode has no subscript of stand after an underscore (l_c1), in
braces where the subscript has more than letters and digits (I_{xx,1}).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache

from msgspec.structs import replace

from dynsolve.notation.characters import (
    GREEK,
    SUBSCRIPT_DIGITS,
    SUPERSCRIPT_DIGITS,
    bold_letter,
    bold_script_letter,
    script_letter,
)
from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.printing import (
    PLAIN,
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
    Integral,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Slashed,
    Sum,
    Symbol,
    Words,
    children,
)

_DOTS = ("", "\u0307", "\u0308", "\u20db")
_SUBSCRIPTS = dict(zip("0123456789ijkn+-=()", SUBSCRIPT_DIGITS + "ᵢⱼₖₙ₊₋₌₍₎", strict=True))
_SUPERSCRIPTS = dict(zip("0123456789inT+-()⋆", SUPERSCRIPT_DIGITS + "ⁱⁿᵀ⁺⁻⁽⁾⋆", strict=True))
_FRACTIONS = {
    ("1", "2"): "½", ("1", "3"): "⅓", ("2", "3"): "⅔", ("1", "4"): "¼", ("3", "4"): "¾", ("1", "6"): "⅙",
    ("5", "6"): "⅚", ("1", "8"): "⅛", ("3", "8"): "⅜", ("5", "8"): "⅝", ("7", "8"): "⅞",
}  # fmt: skip
_FRACTION_SIGNS = frozenset(_FRACTIONS.values())
_RUN = re.compile(r"[A-Za-z]+|[^A-Za-z]+")
_BARE_BASES = frozenset({Symbol, Parenthesized})
_BARE_DENOMINATORS = frozenset({Symbol, Function, Power, Letter, Parenthesized})


def to_unicode(node: Node, style: Style = PLAIN) -> str:
    """The tree on one line.

    >>> to_unicode(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2)))))
    '½ m₁ θ̇₁²'
    """
    return UnicodePrinter(style).text(node)


def width(text: str) -> int:
    """The width of a text in columns of a terminal: dots over letters take none.

    >>> width("θ̇₁")
    2
    """
    if text.isascii():
        return len(text)
    return sum(map(_columns, text))


@lru_cache(maxsize=1024)
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


class UnicodePrinter(FormulaPrinter):
    """One line of Unicode; products have no sign where none is needed."""

    notation = "Unicode"
    between = ""
    star = "⋆"
    compound = FormulaPrinter.compound | {Quotient}

    def _base(self, base: str) -> str:
        return GREEK.get(base, base)

    def _styled(self, base: str, style: str) -> str:
        base = self._base(printable(base))
        if style == "bold" and self.style.bold:
            return bold_letter(base)
        if style == "bold script":
            return bold_script_letter(base)
        return script_letter(base) if style == "script" else base

    def _dotted(self, base: str, dots: int) -> str:
        return base + _DOTS[dots]

    def _indices(self, groups: Sequence[str]) -> str:
        """Groups of indices; a comma only where two would run together."""
        text = ""
        for runs_of in map(_RUN.findall, groups):
            group = "".join(GREEK.get(run, run) for run in runs_of)
            text += "," + group if text and not (text[-1].isdecimal() and group[0].isalpha()) else group
        return text

    def _shorthand_parts(self, short: tuple[str, str]) -> tuple[str, str]:
        return short[0], short[1]  # c_{h1,h2} is the cosine of two angles, which c_h1h2 would not show

    def _index(self, node: Node) -> str:
        """The text of a subscript, on one level: v_1 is `v1`."""
        match node:
            case Symbol():
                return "".join(self._symbol_parts(node))
            case Letter():
                base, sub = self._letter_parts(replace(node, style="italic"))
                return base + sub + ("" if node.sup is None else self._index(node.sup))
            case Row(parts) if any(isinstance(part, Words) and part.text == "," for part in parts):
                return "".join(map(self._index_in_braces, parts))
            case Row() | Product():
                return "".join(map(self._index, children(node)))
            case Words():
                return printable(node.text)
        return self.text(node).replace(" ", "")

    def _index_in_braces(self, node: Node) -> str:
        """A part of {z,θᵢ}, which has room for an index of its own."""
        if isinstance(node, Letter) and node.sup is None:
            base, sub = self._letter_parts(replace(node, style="italic"))
            return base + lowered(sub) if sub else base
        return self._index(node)

    def _scripted(self, base: str, sub: str, sup: str) -> str:
        if sub:
            base += lowered(sub)
        return base + raised(sup) if sup else base

    def _fraction(self, above: str, below: str) -> str:
        return _FRACTIONS.get((above, below)) or f"{above}/{below}"

    def _root(self, argument: Node) -> str:
        text = self.text(argument)
        return f"√{text}" if type(argument) in _BARE_BASES or is_whole(argument) else f"√({text})"

    def _applied(self, name: str, argument: str, exponent: str = "") -> str:
        return f"{name}{exponent}({argument})"

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        lines = (f"[{', '.join(row)}]" for row in rows)
        return f"[{', '.join(lines)}]"

    def _differential(self, d: str, of: Node) -> str:
        return d + self._operand(of)

    def _degrees(self, node: Degrees) -> str:
        text = decimal_text(node.p, node.q)
        return f"{text}°" if text else f"({node.p}/{node.q})°"

    def _words(self, node: Words) -> str:
        return printable(node.text.replace("\N{NO-BREAK SPACE}", " "))

    def _integral(self, node: Integral) -> str:
        sign = self._scripted("∫", self._index(node.lower), self._index(node.upper))
        return f"{sign} {self._summand(node.body)} d{self.text(node.variable)}"

    def _big_sum(self, node: BigSum) -> str:
        below = f"{self._index(node.index)}={self._index(node.lower)}"
        return f"{self._scripted('Σ', below, self._index(node.upper))} {self._summand(node.body)}"

    def _slashed(self, node: Slashed) -> str:
        return self.text(node.fraction)

    # -- Parentheses on one line -------------------------------------------------------------------------

    def _product(self, node: Product) -> str:
        factors = flat_factors(node)
        if not factors:
            return "1"
        if (over := self._over(factors)) is not None:
            return self._quotient(over)
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
        numerator = self._numerator(node.numerator)
        denominator = self.text(node.denominator)
        is_number = denominator.replace(".", "", 1).isdecimal()
        if not (is_number or type(node.denominator) in _BARE_DENOMINATORS):
            denominator = f"({denominator})"
        return self._fraction(numerator, denominator)

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
                return self._applied(base.name, self.text(base.argument), exponent)
            return self.text(base) + exponent
        text = self.text(base)
        bare = type(base) in _BARE_BASES or self.style.is_digits(base)
        bare = bare or (type(base) is Letter and base.sup is None)
        return (text if bare else f"({text})") + exponent

    def _exponent(self, node: Node) -> str:
        text = self.text(node)
        if all(character in _SUPERSCRIPTS for character in text):
            return raised(text)
        return f"^{text}" if type(node) is Symbol else f"^({text})"


def _is_applied(node: Node) -> bool:
    """Whether the node is a derivative of something: the next factor would seem to belong to it."""
    return type(node) is Derivative and node.of is not None


def _between(before: str, after: str) -> str:
    """The separator of two factors: a dot before a number, nothing after one, else a space."""
    lead = after[:1]
    if lead.isdecimal() or lead in _FRACTION_SIGNS:
        return "·"
    if before.lstrip("-").isdecimal() or (lead == "(" and before[:1] == "(" and before[-1:] == ")"):
        return ""
    return " "
