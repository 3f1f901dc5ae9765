"""What the printers share: the style, the walk over the tree, numbers and shorthands.

A printer has a method for each type of node that returns its text.  To add one, derive
from `FormulaPrinter` (or from `Printer`, for a notation of expressions alone), and write
its function beside the others.  A printer never changes what the tree says; it only decides on parentheses.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

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
    Reference,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
)


@dataclass(frozen=True, slots=True)
class Style:
    """How a formula is to look.

    `shorthand` maps the name of a coordinate to its subscript in s_1 and c_12,
    `star` shows the mark of joint variables, and `stars` puts it on every symbol of
    these names; `decimal` writes 981/100 as 9.81 where that is exact.
    """

    shorthand: Mapping[str, str] = field(default_factory=dict)
    star: bool = False
    decimal: bool = False
    stars: frozenset[str] = frozenset()

    def starred(self, node: Symbol) -> bool:
        """Whether a symbol is printed with the mark of a joint variable."""
        return (node.star and self.star) or node.name in self.stars


PLAIN = Style()

Rules = Mapping[type[Node], Callable[[Any, Any], str]]

_METHODS: Mapping[type[Node], str] = {
    Symbol: "_symbol",
    Number: "_number",
    Product: "_product",
    Sum: "_sum",
    Power: "_power",
    Negative: "_negative",
    Quotient: "_quotient",
    Function: "_function",
    Degrees: "_degrees",
    Matrix: "_matrix",
    Letter: "_letter",
    Row: "_row",
    Words: "_words",
    Transpose: "_transpose",
    Cross: "_cross",
    Derivative: "_derivative",
    BigSum: "_big_sum",
    Parenthesized: "_in_parentheses",
    Relation: "_relation",
    Reference: "_reference",
}

# Sub-trees that are shared come as these; leaves and short nodes cost less than their entry.
_REMEMBERED = frozenset({Sum, Product, Quotient, Power, Function, Letter})


class Printer:
    """Prints trees in one notation, and remembers sub-trees by identity.

    Keep a printer as long as its trees share parts: `text` of a part that was
    printed before, as the same object, is looked up.  The printer keeps such
    parts alive.
    """

    rules: ClassVar[Rules] = {}
    notation: ClassVar[str] = ""

    def __init_subclass__(cls) -> None:
        """Make the table that is looked up for every node."""
        cls.rules = {kind: getattr(cls, name) for kind, name in _METHODS.items() if hasattr(cls, name)}

    def __init__(self, style: Style = PLAIN) -> None:
        self.style = style
        self._memory: dict[int, tuple[Node, str]] = {}

    def text(self, node: Node) -> str:
        """The text of a tree; TypeError for a node that the notation has no words for."""
        known = self._memory.get(id(node))
        if known is not None:
            return known[1]
        kind = type(node)
        try:
            rule = self.rules[kind]
        except KeyError:
            raise TypeError(f"{kind.__name__} cannot be written in {self.notation}") from None
        text = rule(self, node)
        if kind in _REMEMBERED:
            self._memory[id(node)] = (node, text)
        return text

    @property
    def remembered(self) -> int:
        """How many parts are remembered."""
        return len(self._memory)

    def parenthesized(self, text: str) -> str:
        """The text in parentheses as the notation writes them."""
        return f"({text})"

    def _sum(self, node: Sum) -> str:
        """Terms with their signs between them: a minus that leads a term becomes the sign."""
        if not node.terms:
            return "0"
        pieces: list[str] = []
        for term in node.terms:
            text = self.text(term)
            pieces += (" - ", text[1:]) if text.startswith("-") else (" + ", text)
        pieces[0] = "" if pieces[0] == " + " else "-"
        return "".join(pieces)

    def _negative(self, node: Negative) -> str:
        text = self.text(node.argument)
        if type(node.argument) is Sum or text.startswith("-"):
            text = self.parenthesized(text)
        return "-" + text

    def _in_parentheses(self, node: Parenthesized) -> str:
        return self.parenthesized(self.text(node.argument))


class FormulaPrinter(Printer):
    """A printer of whole formulas: what the textbook's formulas have in common in every notation."""

    between: ClassVar[str] = " "
    """What stands between parts side by side."""

    minus: ClassVar[str] = "-"
    """What a negative begins with."""

    compound: ClassVar[frozenset[type[Node]]] = frozenset({Sum, Product, Cross, BigSum, Derivative, Relation})
    """What needs parentheses beside the sign of a cross product."""

    def _row(self, node: Row) -> str:
        return self.between.join(map(self.text, node.parts))

    def _reference(self, node: Reference) -> str:
        return self.text(Words(str(node)))

    def _operand(self, node: Node) -> str:
        text = self.text(node)
        needed = type(node) in self.compound or text.startswith(self.minus)
        return self.parenthesized(text) if needed else text

    def _summand(self, node: Node) -> str:
        """What a running sum adds up."""
        text = self.text(node)
        needed = type(node) in (Sum, Relation) or text.startswith(self.minus)
        return self.parenthesized(text) if needed else text

    def _relation(self, node: Relation) -> str:
        text = self.text(node.parts[0]) if node.parts else ""
        for sign, part in zip(node.signs, node.parts[1:], strict=True):
            text += self._sign(sign) + self.text(part)
        return text

    def _sign(self, sign: str) -> str:
        """The sign of a relation with the blanks around it."""
        return f" {sign} "


def decimal_text(p: int, q: int) -> str | None:
    """p/q with a decimal point, None where that does not come to an end.

    >>> decimal_text(981, 100), decimal_text(1, 3)
    ('9.81', None)
    """
    places, rest = 0, q
    for prime in (2, 5):
        count = 0
        while rest % prime == 0:
            rest //= prime
            count += 1
        places = max(places, count)
    if rest != 1:
        return None
    sign, digits = "-" if p < 0 else "", str(abs(p) * 10**places // q).zfill(places + 1)
    return f"{sign}{digits[:-places]}.{digits[-places:]}" if places else sign + digits


def is_whole(node: Node) -> bool:
    """Whether the node is a number 0, 1, 2, ..."""
    return type(node) is Number and node.q == 1 and node.p >= 0


def is_numeric(node: Node) -> bool:
    """Whether the node is a number or a fraction of two."""
    return type(node) is Number or (
        type(node) is Quotient and type(node.numerator) is Number and type(node.denominator) is Number
    )


def shorthand(node: Function, style: Style) -> tuple[str, str] | None:
    """("s", "12") for sin(θ1 + θ2) where the style has subscripts for all of its coordinates."""
    if not style.shorthand or node.name not in ("sin", "cos"):
        return None
    argument = node.argument
    terms = argument.terms if type(argument) is Sum else (argument,)
    subscripts: list[str] = []
    for term in terms:
        if type(term) is not Symbol or term.dots or term.name not in style.shorthand:
            return None
        subscripts.append(style.shorthand[term.name])
    if not subscripts or len(set(subscripts)) != len(subscripts):
        return None
    separator = "" if all(len(subscript) == 1 for subscript in subscripts) else ","
    return node.name[0], separator.join(subscripts)


def flat_factors(node: Product) -> tuple[Node, ...]:
    """The factors of a product, those of products in it put in their place."""
    if not any(type(factor) is Product for factor in node.factors):
        return node.factors
    factors: list[Node] = []
    for factor in node.factors:
        factors.extend(flat_factors(factor) if type(factor) is Product else (factor,))
    return tuple(factors)
