r"""Words in formulas: `\text{...}`, units, the names of modules, dots that stand behind a name."""

from __future__ import annotations

import re

from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.errors import ReadError

_FUNCTIONS = frozenset("sin cos tan sqrt cot sec csc sgn sign".split())
_SYMMETRIC = frozenset({"sym", "symm", "symmetric"})
_WORD_AS_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:_\{?[A-Za-z0-9,]+\}?)?")
_WORDS = frozenset("and og where hvor der with med so such or eller for für alle all då da".split())
_UNITS = frozenset({"J", "N", "Nm", "rad", "kg"})
_MODULES = frozenset("sp sym sympy smp np numpy math".split())
_OF_MODULES = frozenset(
    "sin cos tan sqrt pi Matrix array matrix Rational Derivative diff Integer transpose"
    " simplify expand trigsimp factor nsimplify".split()
)


def token_of_word(token: Token, out: list[Token]) -> Token | None:
    r"""`\text{...}`: an index, a function, a word between equations, or nothing."""
    word = token.text
    if word.strip(". ").lower() in _SYMMETRIC and out and out[-1].kind in ("&", "\\\\", "begin"):
        return token._replace(kind="name", text="sym")
    if (
        out
        and not word.isdecimal()
        and (out[-1].kind in ("_", "^") or (out[-1].kind in ("{", ",", "name") and _in_script(out)))
    ):
        word = "".join(character for character in word if character.isalnum())
        return token._replace(kind="name", text=word) if word.isascii() and word[:1].isalpha() else None
    if word in _FUNCTIONS:
        return token._replace(kind="name")
    if word.isdecimal() and word.isascii():
        return token._replace(kind="number")
    if out and out[-1].kind in ("+", "-"):
        word = word.rstrip(".")
        token = token._replace(text=word)
    if _WORD_AS_NAME.fullmatch(word) and word.lower() not in _WORDS:
        return token
    if any(part.strip(",.:;").lower() in _WORDS for part in word.split()):
        return token._replace(kind="separator")
    return None


def _in_script(out: list[Token]) -> bool:
    back = next((i for i in range(len(out) - 1, max(len(out) - 8, -1), -1) if out[i].kind == "{"), -1)
    return back > 0 and out[back - 1].kind in ("_", "^")


def is_unit(out: list[Token], after: Token) -> bool:
    r"""Whether the bracket that closes here holds a unit alone: `[\text{J}]`, or `[J]` at the end."""
    if len(out) < 3 or out[-2].kind != "[":
        return False
    at_end = after.kind in ("end", "\\\\", ",", ".", ";", "tag", "}", "&")
    return out[-1].kind == "text" or (at_end and out[-1].kind == "name" and out[-1].text in _UNITS)


def is_qualified(module: Token, tokens: list[Token], position: int) -> bool:
    """Whether a function follows the name of its module: `sp.sin(q1)`."""
    if module.text not in _MODULES:
        return False
    dot, name = tokens[position], tokens[min(position + 1, len(tokens) - 1)]
    return dot.kind == "." and name.text in _OF_MODULES and dot.end == name.start


def accent(accent: Token, out: list[Token]) -> None:
    """The dots that Word writes behind what they stand over: `(θ_1 ) ̇`, `q ̇_1`."""
    dots = 1 if accent.text == "\u0307" else 2
    last = len(out) - 1
    if out[last].kind == ")" and last > 1 and out[last - 2].kind == "(":
        del out[last], out[last - 2]
        last -= 2
    if out[last].kind in ("name", "letter"):
        out[last] = out[last]._replace(kind="name", dots=out[last].dots + dots, end=accent.end)
    else:
        raise ReadError("these dots stand over no name", accent.start, 1, "write \\dot{q}_1")
