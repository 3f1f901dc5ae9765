"""A line of Unicode read as a person reads it, for the exact value that it says."""

from __future__ import annotations

import re
from fractions import Fraction

from dynsolve.notation.tree import Symbol
from dynsolve.notation.unicode import to_unicode
from tests.unit.notation.trees import NAMES, function_value, python_identifier, symbol_value

_FRACTIONS = {"½": "1/2", "⅓": "1/3", "⅔": "2/3", "¼": "1/4", "¾": "3/4", "⅙": "1/6", "⅚": "5/6"}
_FRACTIONS |= {"⅛": "1/8", "⅜": "3/8", "⅝": "5/8", "⅞": "7/8"}
_SYMBOLS = [Symbol(name, dots) for name in NAMES for dots in range(3)]
_VALUES = {to_unicode(symbol): symbol_value(python_identifier(symbol)) for symbol in _SYMBOLS}
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_PIECES = [r"\d+\.\d+|\d+", "[½⅓⅔¼¾⅙⅚⅛⅜⅝⅞]", "[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", "sin|cos|tan|√", r"[-+/·()°]"]
_PIECE = re.compile("|".join(_PIECES + sorted(map(re.escape, _VALUES), key=len, reverse=True)))


class Eye:
    """The value a person reads from a line.

    Some read a/b c as (a/b) c, some (`tight`) as a/(b c): a good line says the same to both.
    """

    def __init__(self, text, tight):
        self.tight = tight
        self.pieces = _PIECE.findall(text)
        assert "".join(self.pieces) == text.replace(" ", "")

    def next_is(self, *pieces):
        return bool(self.pieces) and self.pieces[0] in pieces

    def take(self):
        return self.pieces.pop(0)

    def sum(self):
        value = self.product()
        while self.next_is("+", "-"):
            value += self.product() if self.take() == "+" else -self.product()
        return value

    def product(self):
        if self.next_is("-"):
            self.take()
            return -self.product()
        value = self.factors()
        while self.pieces and not self.next_is("+", "-", ")"):
            if self.next_is("/"):
                self.take()
                value /= self.factors()
            else:
                value *= self.factor()
        return value

    def factors(self):
        """What stands on one side of a `/`."""
        value = self.factor()
        while self.tight and self.pieces and not self.next_is("+", "-", ")", "/"):
            value *= self.factor()
        return value

    def factor(self):
        if self.next_is("·"):
            self.take()
        return self.power()

    def power(self):
        value = self.atom()
        if self.next_is("°"):
            self.take()
            value *= symbol_value("pi") / 180
        return value ** self.raised()

    def raised(self):
        is_raised = self.pieces and self.pieces[0][0] in "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
        return int(self.take().translate(_RAISED)) if is_raised else 1

    def atom(self):
        piece = self.take()
        if piece == "(":
            value = self.sum()
            assert self.take() == ")"
            return value
        if piece in ("sin", "cos", "tan", "√"):
            exponent = self.raised()
            return function_value("sqrt" if piece == "√" else piece, self.atom()) ** exponent
        return _VALUES[piece] if piece in _VALUES else Fraction(_FRACTIONS.get(piece, piece))
