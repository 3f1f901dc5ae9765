r"""Numbers as they are written: decimals, and degrees as `90°`, `90 deg` or `90^\circ`."""

from __future__ import annotations

from fractions import Fraction

from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grids import Value
from dynsolve.notation import tokens as plain
from dynsolve.notation.tree import Degrees, Number

_BEFORE_DEGREES = frozenset({"°", "name", "^"})
"""The tokens that the sign of degrees may begin with."""


def read(reader: Reader) -> Value:
    """A number, with its degrees."""
    token = reader.take()
    if token.text == "0" and reader.token.kind == "_":  # 0_{2×2}
        reader.take(), reader.group()
    if len(token.text) == 1 and reader.token.kind not in _BEFORE_DEGREES:  # as most numbers are
        return reader.scripted(Number(int(token.text)))
    value = plain.rational(plain.FormulaToken("number", token.text, token.start, token.end))
    if reader.token.kind == "°" or (reader.token.kind == "name" and reader.token.text == "deg"):
        reader.take()
        return Degrees(value.numerator, value.denominator)
    if reader.token.kind == "^" and _circle(reader):
        return Degrees(value.numerator, value.denominator)
    return reader.scripted(_written(value, token.text))


def _circle(reader: Reader) -> bool:
    r"""Take `^\circ`, if that is what stands here."""
    ahead = [reader.peek(1), reader.peek(2), reader.peek(3)]
    if ahead[0].text == "circ":
        reader.take(), reader.take()
        return True
    if ahead[0].kind == "{" and ahead[1].text == "circ" and ahead[2].kind == "}":
        reader.take(), reader.take(), reader.take(), reader.take()
        return True
    return False


def _written(value: Fraction, text: str) -> Number:
    """A number with as many decimals as were written: 0.10 is 10/100, which rounds more than 0.1 does."""
    _, point, decimals = text.partition(".")
    scale = 10 ** len(decimals) if point and decimals.isdigit() and value else value.denominator
    return Number(int(value * scale), scale, scale != 1)
