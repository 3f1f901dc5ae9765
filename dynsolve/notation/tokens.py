"""A plain-text formula cut into tokens, each with its place."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import NamedTuple

from dynsolve.errors import ReadError
from dynsolve.notation.characters import SPELLED, SUBSCRIPT_DIGITS, SUPERSCRIPT_DIGITS, character_error
from dynsolve.notation.size import MAX_DIGITS

FUNCTIONS = ("sin", "cos", "tan", "sqrt")
"""The functions of a formula."""

ARCS = ("acos", "asin", "atan", "atan2")
"""The functions that give angles, where a formula may have them."""

_GREEK = "".join(SPELLED)
_NUMBER = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_TOKEN = re.compile(
    rf"""
      (?P<space>[ \t\r\n\u00a0\u2000-\u200a\u202f]+)
    | (?P<degrees>{_NUMBER}\s*(?:°|deg(?![A-Za-z0-9_])))
    | (?P<number>{_NUMBER})
    | (?P<name>[A-Za-z{_GREEK}][A-Za-z0-9_{_GREEK}{SUBSCRIPT_DIGITS}]*)
    | (?P<power>\*\*|\^)
    | (?P<raised>⁻?[{SUPERSCRIPT_DIGITS}]+)
    | (?P<operator>[-+*/(),−–·⋅∙×∗⋆÷∕⁄√])
    """,
    re.VERBOSE,
)
_OPERATORS = {operator: operator for operator in "-+*/(),√"} | {
    "−": "-",
    "–": "-",
    "·": "*",
    "⋅": "*",
    "∙": "*",
    "×": "*",
    "∗": "*",
    "⋆": "*",
    "÷": "/",
    "∕": "/",
    "⁄": "/",
}


class FormulaToken(NamedTuple):
    """A piece of the text: `kind` is number, degrees, name, ^, raised, end or the operator itself."""

    kind: str
    text: str
    start: int
    end: int


def tokens(text: str) -> list[FormulaToken]:
    """The tokens of a formula, an `end` token last; raises ReadError for a character of no formula."""
    result: list[FormulaToken] = []
    offset = 0
    match = _TOKEN.match
    while offset < len(text):
        found = match(text, offset)
        if found is None:
            raise character_error(text[offset], offset)
        kind, end = found.lastgroup or "", found.end()
        if kind != "space":
            piece = found.group()
            kind = _OPERATORS[piece] if kind == "operator" else "^" if kind == "power" else kind
            result.append(FormulaToken(kind, piece, offset, end))
        offset = end
    result.append(FormulaToken("end", "", len(text), len(text)))
    return result


_EXPONENT = re.compile("[eE]")


def rational(token: FormulaToken) -> Fraction:
    """The exact value of a number: `9.81` is 981/100, `1e-3` is 1/1000.

    Raises ReadError for more digits than anyone measures, before they are converted.
    """
    mantissa, _, exponent = _EXPONENT.sub("e", token.text.removesuffix("°").removesuffix("deg")).partition(
        "e"
    )
    whole, _, decimals = mantissa.strip().partition(".")
    power = exponent.strip().lstrip("+-").lstrip("0")
    if len(whole) + len(decimals) > MAX_DIGITS or len(power) > 2 or int(power or 0) > MAX_DIGITS:
        length = token.end - token.start
        raise ReadError(f"a number of more than {MAX_DIGITS} digits", token.start, length, "write it shorter")
    shift = (-int(power or 0) if "-" in exponent else int(power or 0)) - len(decimals)
    digits = int((whole + decimals) or "0")
    return Fraction(digits * 10**shift) if shift >= 0 else Fraction(digits, 10**-shift)
