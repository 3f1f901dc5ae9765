"""How wide and how tall a formula is when it is set in Computer Modern, in em, without setting it.

The widths are those of the font's metrics, taken a little too large where sizes
differ, so that what is said to fit does fit.  One ruler serves every notation that
is set in type: LaTeX, Typst, MathML.
"""

from __future__ import annotations

from dynsolve.notation.characters import GREEK, split
from dynsolve.notation.printing import PLAIN, Style, decimal_text, shorthand
from dynsolve.notation.tree import (
    Arguments,
    BigSum,
    Cross,
    Degrees,
    Derivative,
    Entry,
    Function,
    Integral,
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
    Slashed,
    Sum,
    Symbol,
    Transpose,
    Words,
    children,
)


def _widths(letters: str, hundredths: str) -> dict[str, int]:
    """Advance width and italic correction, in hundredths of an em."""
    return dict(zip(letters, map(int, hundredths.split()), strict=True))


_ITALIC = _widths(
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ",
    "53 43 43 52 47 60 51 58 34 47 55 32 88 60 48 50 48 48 47 36 57 52 74 57 53 51 "
    "75 81 79 86 80 78 79 91 52 65 92 68 108 91 79 78 79 77 67 72 79 81 108 91 80 75",
)
_UPRIGHT = _widths(
    "abcdefghijklmnopqrstuvwxyz .,()+-=",
    "50 56 44 56 44 38 51 56 28 31 53 28 83 56 50 56 53 39 39 39 56 54 74 53 54 44 "
    "33 28 44 39 39 122 122 133",
)
_DIGIT, _WIDE_LETTER, _GREEK_LETTER = 0.50, 0.80, 0.66
_BOLD = 1.19
_SCRIPT = (1.0, 0.82, 0.68)  # of an index, and of an index of it: small sizes are cut wider
_SCRIPT_SPACE = 0.05

BINARY = 1.23
RELATION = 1.34
PARENTHESIS = 0.46
TALL_PARENTHESIS = 0.80
_BUILT_PARENTHESIS = 0.88  # put together of pieces
BRACKETS = 1.35
COLUMN_SPACE = 1.0
_FRACTION_SPACE = 0.24
_THIN = 0.17
_ROOT = 0.9
_STROKE = 1.7  # with the signs of a differential above and below
_SUM_SIGN = 1.45
_DOT = 0.73

_LINE = 1.0
FLAT = 1.3
_LARGEST = 3.0  # the height of the largest parenthesis of one piece
"""Brackets around what is no taller have the size of letters."""
_BAR = 0.3
_EXPONENT, _RAISED = 0.2, 0.6  # above a letter, above brackets that are taller
_SUM_HEIGHT = 3.0
_ROW_SPACE = 0.45


class Ruler:
    """Measures trees; the width of each sub-tree is computed once and kept.

    >>> from dynsolve.notation.tree import Symbol, Product
    >>> round(Ruler().width(Product((Symbol("m1"), Symbol("g")))), 2)
    1.85
    """

    def __init__(self, style: Style = PLAIN) -> None:
        self.style = style
        self._memory: dict[int, tuple[Node, float]] = {}
        self._names: dict[tuple[str, int], float] = {}
        self._heights: dict[int, tuple[Node, float]] = {}

    def height(self, node: Node) -> float:
        """How tall brackets around a displayed formula are, in em; never less than any in it.

        >>> from dynsolve.notation.text import read
        >>> [round(Ruler().height(read(text).tree), 1) for text in ("m1*q1^2", "m1/2", "(a + m1/2)^2 + b")]
        [1.2, 2.3, 2.9]
        """
        known = self._heights.get(id(node))
        if known is None:
            known = self._heights[id(node)] = (node, self._raised(node))
        return known[1]

    def _raised(self, node: Node) -> float:
        match node:
            case Quotient(numerator, denominator):
                return 2 * max(self.height(numerator), self.height(denominator)) + _BAR
            case Number() if node.q != 1 and self.style.number(node) is None:
                return 2 * _LINE + _BAR
            case Derivative(of):
                return 2 * (_LINE if of is None else self.height(of)) + _BAR
            case Power(base):
                tall = self.height(base)
                return tall + (_RAISED if tall > FLAT else _EXPONENT)
            case Matrix(rows):
                return sum(max(map(self.height, row)) + _ROW_SPACE for row in rows)
            case BigSum(body):
                return max(self.height(body), _SUM_HEIGHT)
            case Letter() | Words() | Slashed():
                return _LINE
        return max(map(self.height, children(node)), default=_LINE)

    def width(self, node: Node) -> float:
        """The width of a tree in em."""
        known = self._memory.get(id(node))
        if known is not None:
            return known[1]
        found = self._measured(node)
        self._memory[id(node)] = (node, found)
        return found

    def _measured(self, node: Node) -> float:
        match node:
            case Symbol():
                return self.name(node.name) + (0.5 if self.style.starred(node) else 0)
            case Number() | Degrees():
                return self._number(node)
            case Product(factors):
                return sum(map(self._factor, factors))
            case Sum(terms):
                lead = 0.78 if terms and type(terms[0]) is Negative else 0.0
                bare = (term.argument if type(term) is Negative else term for term in terms)
                return lead + sum(map(self.width, bare)) + BINARY * max(len(terms) - 1, 0)
            case Negative(argument):
                return 0.78 + self._factor(argument)
            case Quotient(numerator, denominator):
                return max(self.width(numerator), self.width(denominator)) + _FRACTION_SPACE
            case Power(base, exponent):
                enclosed = 2 * TALL_PARENTHESIS if type(base) in (Product, Quotient, Power) else 0.0
                return self._factor(base) + enclosed + self.index(exponent)
            case Function():
                return self._function(node)
            case Arguments(parts):
                return sum(map(self.width, parts)) + BINARY * (len(parts) - 1)
            case Matrix(rows):
                return self.matrix(rows)
            case _:
                return self._textbook(node)

    def _textbook(self, node: Node) -> float:
        match node:
            case Letter():
                return self._letter(node)
            case Entry(of, index):
                return self.width(of) + 2 * PARENTHESIS + self.index(index)
            case Row(parts):
                return sum(map(self.width, parts))
            case Words(text):
                return words_width(text)
            case Reference():
                return words_width(str(node))
            case Transpose(argument):
                return self._factor(argument) + 0.6
            case Cross(left, right):
                return self._factor(left) + BINARY + self._factor(right)
            case Derivative(of, by):
                below = self.width(by) + 0.6
                above = 0.6 if of is None else self.width(of) + 0.6 + 2 * TALL_PARENTHESIS
                return below + above
            case BigSum(body, index, lower, upper):
                under = max(self.index(index) + self.index(lower) + 0.7, self.index(upper), _SUM_SIGN)
                return under + _THIN + self._factor(body)
            case Integral(body, variable, lower, upper):
                bounds = max(self.index(lower), self.index(upper))
                return _SUM_SIGN + bounds + self._factor(body) + 2 * _THIN + 0.6 + self.width(variable)
            case Parenthesized(argument):
                tall = self.height(argument) > _LARGEST
                return self.width(argument) + 2 * (_BUILT_PARENTHESIS if tall else TALL_PARENTHESIS)
            case Slashed(fraction):
                return sum(map(self._factor, children(fraction))) + _STROKE
            case Relation(parts):
                return sum(map(self.width, parts)) + RELATION * (len(parts) - 1)
        raise TypeError(f"{type(node).__name__} has no width")

    def matrix(self, rows: tuple[tuple[Node, ...], ...]) -> float:
        """The width of a matrix between brackets."""
        columns = zip(*rows, strict=True)
        widths = [max(self.width(entry) for entry in column) for column in columns]
        return sum(widths) + COLUMN_SPACE * (len(widths) - 1) + BRACKETS

    def name(self, name: str, level: int = 0) -> float:
        """The width of a named quantity with its indices."""
        known = self._names.get((name, level))
        if known is None:
            base, groups = split(name)
            known = _letters(base) * _SCRIPT[level]
            if groups:
                known += _letters(",".join(groups)) * _SCRIPT[min(level + 1, 2)] + _SCRIPT_SPACE
            self._names[name, level] = known
        return known

    def index(self, node: Node) -> float:
        """The width of a tree as an index or an exponent."""
        return self.width(node) * _SCRIPT[1] + _SCRIPT_SPACE

    def _number(self, node: Number | Degrees) -> float:
        if type(node) is Number:
            text = str(node.p) if node.q == 1 else (self.style.number(node) or "")
        else:
            text = decimal_text(node.p, node.q) or ""
        if type(node) is Degrees:
            return _DIGIT * max(len(text), 4) + 0.5
        if text:
            return _DIGIT * len(text)
        return _DIGIT * max(len(str(node.p)), len(str(node.q))) + _FRACTION_SPACE

    def _factor(self, node: Node) -> float:
        width = self.width(node)
        if type(node) in (Sum, Negative, Cross, Relation, BigSum):
            return width + 2 * TALL_PARENTHESIS
        return width + (_DOT if type(node) is Number else 0)

    def _function(self, node: Function) -> float:
        if short := shorthand(node, self.style):
            return _letters(short[0]) + _letters(short[1]) * _SCRIPT[1] + _SCRIPT_SPACE
        argument = self.width(node.argument)
        if node.name == "sqrt":
            return _ROOT + argument
        return words_width(node.name) + argument + 2 * TALL_PARENTHESIS + _THIN

    def _letter(self, node: Letter) -> float:
        factor = _BOLD if node.style == "bold" else 1.0
        indices = [self.index(part) for part in (node.sub, node.sup) if part is not None]
        letter = self.style.base(node)
        base = words_width(letter) if node.style == "upright" else _letters(letter)
        return base * factor + max(indices, default=0.0)


def _letters(text: str) -> float:
    """A base or indices in italics; a spelled-out Greek letter is one letter."""
    if text in GREEK:
        return _GREEK_LETTER
    return sum(_ITALIC.get(character, 50) for character in text) / 100


def words_width(text: str) -> float:
    """The width of upright words in em."""
    return sum(_UPRIGHT.get(character, 100 * _WIDE_LETTER) for character in text) / 100
