"""Printed formulas read back: from text as a terminal shows it, and from LaTeX, to numbers.

The reader knows how each single sign is printed, and nothing else of the printers: sums, signs, products,
fractions, powers and brackets are read from the characters, as a person reads them.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping
from fractions import Fraction

SUPERSCRIPTS = {c: str(i) for i, c in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}
VULGAR = {c: unicodedata.numeric(c) for c in "½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"}
FUNCTIONS = {"atan2": math.atan2, "acos": math.acos, "asin": math.asin, "atan": math.atan,
             "arccos": math.acos, "arcsin": math.asin, "arctan": math.atan,
             "sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt, "√": math.sqrt,
             "sgn": lambda x: math.copysign(1.0, x)}  # fmt: skip
"""What each function is called; a name that begins another comes behind it."""

_NUMBER = re.compile(r"\d+(?:\.\d+)?")


class Unreadable(Exception):
    """A text that is no formula of these signs."""


def value_of_text(text: str, signs: Mapping[str, float]) -> float:
    """The number that a line of text stands for; `signs` are the values of names as they are printed.

    >>> value_of_text("-½ m₁ (l₁² - 2a/3)", {"m₁": 2.0, "l₁": 3.0, "a": 1.5})
    -8.0
    """
    return _Reader(text, signs).whole()


def value_of_latex(text: str, signs: Mapping[str, float]) -> float:
    r"""The same of LaTeX, its spaces and sizes of brackets taken off first.

    >>> value_of_latex(r"-\frac{1}{2} \, m_{1} \left(l_{1}^{2} - a\right)", {"m_{1}": 2, "l_{1}": 3, "a": 1})
    -8.0
    """
    return _Reader(_plain(text), {_plain(sign): value for sign, value in signs.items()}).whole()


def _plain(text: str) -> str:
    """LaTeX without sizes of brackets and fractions, and without its spaces."""
    plain = re.sub(r"\\(?:left|right|bigl|bigr|Bigl|Bigr|biggl|biggr|Biggl|Biggr|[dt](?=frac))", "", text)
    plain = plain.replace("\\dfrac", "\\frac").replace("\\tfrac", "\\frac").replace("dfrac", "frac")
    return re.sub(r"\\[,;:!]|\{\}|~", " ", plain)


class _Reader:
    """Recursive descent over the characters; of signs the longest that fits is taken."""

    def __init__(self, text: str, signs: Mapping[str, float]) -> None:
        self.text = text
        self.at = 0
        self.signs = signs
        self.longest = sorted((sign for sign in signs if sign), key=len, reverse=True)

    def whole(self) -> float:
        value = self.sum()
        self.skip()
        if self.at < len(self.text):
            raise Unreadable(f"{self.text[self.at : self.at + 20]!r} is left of {self.text!r}")
        return value

    def skip(self) -> None:
        while self.at < len(self.text) and self.text[self.at].isspace():
            self.at += 1

    def take(self, *words: str) -> str:
        self.skip()
        for word in words:
            if self.text.startswith(word, self.at):
                self.at += len(word)
                return word
        return ""

    def need(self, word: str) -> None:
        if not self.take(word):
            raise Unreadable(f"{word} is missing at {self.text[self.at : self.at + 20]!r} of {self.text!r}")

    def sum(self) -> float:
        total = -self.product() if self.take("-", "−") else self.product()
        while sign := self.take("+", "-", "−"):
            total += self.product() if sign == "+" else -self.product()
        return total

    def product(self) -> float:
        """Factors side by side; a stroke divides all before it by the one factor behind it."""
        value = self.factor()
        if value is None:
            raise Unreadable(f"no factor at {self.text[self.at : self.at + 20]!r} of {self.text!r}")
        while True:
            if self.take("/"):
                below = self.factor()
                if below is None:
                    raise Unreadable(f"nothing below the stroke in {self.text!r}")
                value /= below
                continue
            self.take("·", "\\cdot", "⋅")
            more = self.factor()
            if more is None:
                return value
            value *= more

    def factor(self) -> float | None:
        base = self.base()
        return None if base is None else base ** self.exponent()

    def exponent(self) -> float:
        digits = ""
        while self.at < len(self.text) and self.text[self.at] in SUPERSCRIPTS:
            digits += SUPERSCRIPTS[self.text[self.at]]
            self.at += 1
        if digits:
            return float(digits)
        if self.text.startswith("^{", self.at):
            self.at += 2
            value = self.sum()
            self.need("}")
            return value
        return 1.0

    def base(self) -> float | None:
        self.skip()
        sign = next((sign for sign in self.longest if self.text.startswith(sign, self.at)), "")
        if sign and not any(
            self.text.startswith(name, self.at) and len(name) > len(sign) for name in FUNCTIONS
        ):
            self.at += len(sign)
            return self.signs[sign]
        if found := _NUMBER.match(self.text, self.at):
            self.at = found.end()
            return (
                math.radians(float(found[0]))
                if self.take("°", "^{\\circ}", "^\\circ")
                else float(Fraction(found[0]))
            )
        if self.text[self.at : self.at + 1] in VULGAR:
            self.at += 1
            return VULGAR[self.text[self.at - 1]]
        if opened := self.take("(", "[", "\\{", "{"):
            value = self.sum()
            self.need({"(": ")", "[": "]", "\\{": "\\}", "{": "}"}[opened])
            return value
        if self.take("\\frac"):
            above, below = self.group(), self.group()
            return above / below
        return self.function()

    def group(self) -> float:
        if self.take("{"):
            value = self.sum()
            self.need("}")
            return value
        raise Unreadable(f"no group at {self.text[self.at : self.at + 20]!r} of {self.text!r}")

    def function(self) -> float | None:
        for name, of in FUNCTIONS.items():
            if self.take(f"\\{name}", f"\\operatorname{{{name}}}", name):
                power = self.exponent()
                arguments = self.pair() if name == "atan2" else [self.factor()]
                if None in arguments:
                    raise Unreadable(f"{name} of nothing in {self.text!r}")
                return float(of(*arguments)) ** power
        return None

    def pair(self) -> list[float | None]:
        """(y, x)"""
        self.need("(")
        first = self.sum()
        self.need(",")
        second = self.sum()
        self.need(")")
        return [first, second]
