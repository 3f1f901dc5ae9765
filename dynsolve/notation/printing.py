"""The base class of all printers: the style, the walk over the tree, the signs of sums.

A printer has a method for each class of nodes that it writes, called after the class:
`_big_sum` writes a `BigSum`.  A printer of expressions alone (Python) derives from `Printer`;
one of whole formulas derives from `FormulaPrinter` in `notation.formulas`, which says how.  A
printer never changes what the tree says; it only decides on parentheses.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, ClassVar

from msgspec import Struct, field

from dynsolve.notation.build import QUARTERS, split_sign
from dynsolve.notation.tree import (
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Row,
    Sum,
    Symbol,
    Words,
)

Sign = tuple[str, str, int]
"""A kind of letters of the textbook: base, style and number of lower indices; c_121 is ("c", "italic", 3)."""


def lower_indices(node: Letter) -> int:
    """The number of lower indices of a letter.

    >>> from dynsolve.notation.tree import Row
    >>> lower_indices(Letter("c")), lower_indices(Letter("c", Row((Number(1), Number(2)))))
    (0, 2)
    """
    if node.sub is None:
        return 0
    if isinstance(node.sub, Row):
        return sum(not isinstance(part, Words) for part in node.sub.parts)
    return 1


class Style(Struct, frozen=True):
    """How a formula is to look.

    `shorthand` maps the name of a coordinate to its subscript in s_1 and c_12,
    `star` shows the mark of joint variables, and `stars` puts it on every symbol of
    these names; `decimal` writes 981/100 as 9.81 where that is exact, and with `digits` every number
    as a decimal of up to so many significant digits, save with `fractions` a short one that comes to
    no end: m/3.

    Letters of the textbook that would be taken for something else are set otherwise:
    `letters` maps their base, style and number of lower indices to another base; with `bold`
    vectors and matrices are bold in a terminal too, as they always are on paper.
    """

    shorthand: Mapping[str, str] = field(default_factory=dict)
    star: bool = False
    decimal: bool = False
    stars: frozenset[str] = frozenset()
    digits: int = 0
    fractions: bool = False
    letters: Mapping[Sign, str] = field(default_factory=dict)
    bold: bool = False

    def number(self, node: Number) -> str | None:
        """A number with a decimal point, where the style wants that and a fraction is not as good."""
        if not (self.decimal or node.decimal):
            return None
        if self.digits and self.rounds(node):
            return rounded_text(Fraction(node.p, node.q), self.digits)
        return decimal_text(node.p, node.q)

    def is_digits(self, node: Node) -> bool:
        """Whether a node is written in digits alone: 2 or 0.15."""
        return type(node) is Number and node.p >= 0 and (node.q == 1 or self.number(node) is not None)

    def rounds(self, node: Number) -> bool:
        """Whether a number is shown rounded, or was rounded before."""
        if node.rounded:
            return True
        if not self.digits or not (self.decimal or node.decimal):
            return False
        text = decimal_text(node.p, node.q)
        if text is None and self.fractions and max(abs(node.p), node.q) < SHORT:
            return False
        return text is None or len(text.replace(".", "").lstrip("-0")) > self.digits

    def base(self, node: Letter) -> str:
        """The base that a letter of the textbook is set with."""
        if not self.letters:
            return node.base
        return self.letters.get((node.base, node.style, lower_indices(node)), node.base)

    def starred(self, node: Symbol) -> bool:
        """Whether a symbol is printed with the mark of a joint variable."""
        return (node.star and self.star) or node.name in self.stars


SHORT = 1000
"""A fraction of whole numbers below this one is as easily read as a decimal."""

PLAIN = Style()

# Sub-trees that are shared come as these; leaves and short nodes cost less than their entry.
_REMEMBERED = frozenset({Sum, Product, Quotient, Power, Function, Letter})
_CAPITAL = re.compile(r"(?<!^)(?=[A-Z])")


def _in_quarters(term: Node) -> Node:
    """A term with a half, quarters or eighths in front as a fraction; 2.5 and 1.5 stay what they are."""
    sign, inner = split_sign(term)
    match inner:
        case Number(p, q) if p < q and q in QUARTERS:
            inner = Quotient(Number(p), Number(q))
        case Product((Number(p, q), *others)) if p < q and q in QUARTERS:
            above = others if p == 1 else [Number(p), *others]
            inner = Quotient(above[0] if len(above) == 1 else Product(tuple(above)), Number(q))
    return inner if sign > 0 else Negative(inner)


class _Methods(dict[type[Node], Callable[[Any, Any], str]]):
    """The method of a printer for each class of nodes, looked up by the name of the class once."""

    def __init__(self, printer: type[Printer]) -> None:
        self.printer = printer

    def __missing__(self, kind: type[Node]) -> Callable[[Any, Any], str]:
        name = "_" + _CAPITAL.sub("_", kind.__name__).lower()
        if not hasattr(self.printer, name):
            raise TypeError(f"{kind.__name__} cannot be written in {self.printer.notation}")
        method: Callable[[Any, Any], str] = getattr(self.printer, name)
        self[kind] = method
        return method


class Printer:
    """Prints trees in one notation, and remembers sub-trees by identity.

    Keep a printer as long as its trees share parts: `text` of a part that was
    printed before, as the same object, is looked up.  The printer keeps such
    parts alive.
    """

    notation: ClassVar[str] = ""
    """The notation's name, for error messages."""

    minus: ClassVar[str] = "-"
    """What a negative begins with."""

    signs: ClassVar[tuple[str, str]] = (" + ", " - ")
    """Plus and minus between two terms."""

    _methods: ClassVar[_Methods]

    def __init_subclass__(cls) -> None:
        """Give every printer its own table of methods."""
        cls._methods = _Methods(cls)

    def __init__(self, style: Style = PLAIN) -> None:
        self.style = style
        self._memory: dict[int, tuple[Node, str]] = {}

    def text(self, node: Node) -> str:
        """The text of a tree; TypeError for a node that the notation has no words for."""
        known = self._memory.get(id(node))
        if known is not None:
            return known[1]
        kind = type(node)
        text = self._methods[kind](self, node)
        if kind in _REMEMBERED:
            self._memory[id(node)] = (node, text)
        return text

    @property
    def remembered(self) -> int:
        """The number of sub-trees whose text is kept."""
        return len(self._memory)

    def parenthesized(self, text: str) -> str:
        """The text in parentheses as the notation writes them."""
        return f"({text})"

    def _over(self, factors: Sequence[Node]) -> Quotient | None:
        """A product over the denominator of its number, 7 l²/3: of one that is no decimal that ends."""
        first, *others = factors
        is_open = type(first) is Number and first.decimal and self.style.number(first) is None
        if not (is_open and others and isinstance(first, Number)):
            return None
        above = others if first.p == 1 else [Number(first.p), *others]
        return Quotient(above[0] if len(above) == 1 else Product(tuple(above)), Number(first.q))

    def _digits(self, text: str) -> str:
        """A whole number or a decimal as the notation writes it."""
        return text

    def _sum(self, node: Sum) -> str:
        """Terms with their signs between them: a minus that leads a term becomes the sign."""
        if not node.terms:
            return self._digits("0")
        plus, minus = self.signs
        lead = self.minus
        pieces: list[str] = []
        has_fraction = self.style.decimal and any(map(self._is_fraction, node.terms))
        for term in map(_in_quarters, node.terms) if has_fraction else node.terms:
            text = self.text(term)
            pieces += (minus, text[len(lead) :]) if text.startswith(lead) else (plus, text)
        pieces[0] = "" if pieces[0] == plus else lead
        return "".join(pieces)

    def _is_fraction(self, term: Node) -> bool:
        """Whether a number in front of a term is no decimal: m l²/24."""
        match split_sign(term)[1]:
            case (Number() as number) | Product((Number() as number, *_)):
                return number.q != 1 and self.style.number(number) is None
            case Quotient(_, Number()):
                return True
        return False

    def _negative(self, node: Negative) -> str:
        text = self.text(node.argument)
        if type(node.argument) is Sum or text.startswith(self.minus):
            text = self.parenthesized(text)
        return self.minus + text

    def _parenthesized(self, node: Parenthesized) -> str:
        return self.parenthesized(self.text(node.argument))


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


def significant(value: Fraction, digits: int) -> Fraction:
    """A number rounded to significant digits, a half away from 0; the digits before the point are all kept.

    >>> significant(Fraction(2, 3), 4), significant(Fraction(123456), 4), significant(Fraction("0.15625"), 4)
    (Fraction(6667, 10000), Fraction(123456, 1), Fraction(1563, 10000))
    """
    unit = 10 ** _places(value, digits)
    size = Fraction(int(abs(value) * unit + Fraction(1, 2)), unit)
    return -size if value < 0 else size


def rounded_text(value: Fraction, digits: int) -> str:
    """A number rounded to significant digits, the last of which are written where they are 0.

    >>> rounded_text(Fraction("15.696"), 4), rounded_text(Fraction("0.99996"), 4)
    ('15.70', '1.000')
    """
    shown = significant(value, digits)
    places = _places(shown, digits)
    whole, rest = divmod(int(abs(shown) * 10**places), 10**places)
    sign = "-" if shown < 0 else ""
    return f"{sign}{whole}.{rest:0{places}}" if places else f"{sign}{whole}"


def _places(value: Fraction, digits: int) -> int:
    """How many decimals make so many significant digits."""
    size = abs(value)
    if not size:
        return 0
    return max(digits - (len(str(int(size))) if size >= 1 else -_zeros(size)), 0)


def _zeros(size: Fraction) -> int:
    """How many zeros follow the point: 0.0042 -> 2."""
    count = 0
    while size * 10 < 1:
        size, count = size * 10, count + 1
    return count


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


def flat_factors(node: Node) -> tuple[Node, ...]:
    """The factors of a product, those of products in it put in their place; of anything else itself."""
    if not isinstance(node, Product):
        return (node,)
    if not any(type(factor) is Product for factor in node.factors):
        return node.factors
    factors: list[Node] = []
    for factor in node.factors:
        factors.extend(flat_factors(factor))
    return tuple(factors)
