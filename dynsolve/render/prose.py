"""Text that is safe in any document: its visible characters, with mathematics as formulas.

Words come from two sides: from the explanations, which write A₁, θ and q̇ in Unicode,
and from problem files, where a title may hold anything.  Control characters and
marks of direction are left out, for no notation may be steered by a title.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator
from functools import cache, lru_cache

from msgspec.structs import replace

from dynsolve.notation.characters import GREEK, SUBSCRIPT_DIGITS, SUPERSCRIPT_DIGITS
from dynsolve.notation.tree import (
    ONE,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Product,
    Row,
    Sum,
    Symbol,
    Words,
)

_LESS = Words("-")
_SPELLED = {letter: name for name, letter in GREEK.items()}
_SUBSCRIPTS = dict(zip(SUBSCRIPT_DIGITS + "ᵢⱼₖₙ₋", "0123456789ijkn-", strict=True))
_SUPERSCRIPTS = dict(zip(SUPERSCRIPT_DIGITS + "ⁱⁿᵀ", "0123456789inT", strict=True))
_DOTS = {"\u0307": 1, "\u0308": 2}
_SCRIPTS = {"ℒ": ("L", "script"), "𝒦": ("K", "script"), "𝒫": ("P", "script"), "𝓘": ("I", "bold script")}
"""Letters of a script alphabet: the letter, and its style."""
_BOLD_LETTERS = {"𝐂": "C", "𝐃": "D", "𝐨": "o", "𝐱": "x", "𝐲": "y", "𝐳": "z"}
"""Letters that are bold wherever they stand: matrices, the origin and the axes of a frame."""
_DOTTED = {"Ḋ": "D", "ẋ": "x", "ẏ": "y", "ż": "z"}
_BOLD = {True: frozenset("AH"), False: frozenset({"q", "D", "tau", "omega"})}
"""The vectors and matrices that the explanations name in words: A₁ with an index, q̇ and ω without one."""

_GREEK_LETTERS = "".join(_SPELLED)

_FORMULA = re.compile(
    rf"(?P<base>[A-Za-z{_GREEK_LETTERS}{''.join((*_SCRIPTS, *_BOLD_LETTERS, *_DOTTED))}])"
    rf"(?P<dots>[{''.join(_DOTS)}]?)"
    rf"(?P<sub>[{''.join(_SUBSCRIPTS)}]*)"
    rf"(?P<sup>[{''.join(_SUPERSCRIPTS)}]*)"
)
_FACTOR = re.sub(r"\?P<\w+>", "?:", _FORMULA.pattern)
_MARKED = rf"(?:{_FACTOR})*[{''.join((*_DOTS, *_SUBSCRIPTS))}][{''.join(_SUPERSCRIPTS)}]*(?:{_FACTOR})*"
_PRODUCT = rf"(?:(?P<function>sin|cos)\()?(?P<product>\d+{_MARKED})(?(function)\))"
"""A number and letters close beside it, one with an index or a dot: 2m₂L₂θ̇₁, sin(2θ₁); 2D is none."""

_COUNTED = "[Bb]ody|[Cc]olumn|coordinate|entry|force|[Ff]rame|[Jj]oint|[Ll]ink|matrix|motor|[Rr]ow|turn"
_COUNT = rf"(?P<counted>\b(?:{_COUNTED}) )(?P<count>[ijkn])(?P<less>-1)?(?!\w)"
"""What is counted by a letter: frame i-1."""

_AXIS = (
    r"(?<!\w)(?P<axis>[xyz])"
    r"(?:(?<=ax[ei]s .)|(?<=axes [xy] and .)|(?<=axes x, .)|(?<=axes x, y and .)|(?<=about .)|(?<=along .)"
    r"|(?<=along -.)|(?<=along the body's .)|(?<=along its .)|(?<=along its -.)|(?<=coordinate .)"
    r"|(?<=coordinates .)|(?<=coordinates [xy] and .)|(?<=coordinates x, .)|(?<=coordinates x, y and .)"
    r"|(?=-axis))(?!\w|\.\w)"
)
"""An axis, where the words say that it is one: about its axis z, the x-axis; `z:` may be a key of a file."""

_LETTER = r"(?:(?<=Spong writes )|(?<=superscript ))(?P<letter>[A-Za-z])(?!\w)"
"""A letter, where the words say that it is one."""

_AMONG_WORDS = re.compile(
    rf"{_COUNT}|{_AXIS}|{_LETTER}|(?<![^\W_])(?:{_PRODUCT}|{_FORMULA.pattern})(?![^\W_])"
)

_AFTER_UNIT = re.compile(r"(?:\b(?:kg|N|J|rad|m)[ ·]|/)$")
"""What stands before m² or s² where that is a unit: kg m², m/s²."""

_APOSTROPHE = re.compile(r"(?<=[^\W\d_])'(?=s\b)|(?<=[a-z]s)'(?= [a-z])")


def visible(text: str) -> str:
    r"""The text without characters that are not seen: controls, marks of direction, strays.

    >>> visible("RP\u202e\tarm")
    'RP arm'
    """
    if not text.isascii():
        text = unicodedata.normalize("NFC", text)
    if text.isprintable():
        return text
    return "".join(filter(None, map(_seen, text)))


def _seen(character: str) -> str:
    if character.isprintable():
        return character
    kind = unicodedata.category(character)
    if kind == "Cf":
        return ""
    return " " if kind[0] in "ZC" and kind not in ("Cs", "Cn", "Co") else "\ufffd"


def typographic(text: str) -> str:
    r"""The text with the apostrophe of printed text in words.

    >>> typographic("the body's frame, the bodies' masses, 'quoted'")
    "the body’s frame, the bodies’ masses, 'quoted'"
    """
    return _APOSTROPHE.sub("’", text) if "'" in text else text


def with_formulas(text: str) -> Iterator[str | Node]:
    """Words of an explanation, the mathematics in them as formulas: A₁, θ, q̇, the i of frame i, an axis z.

    >>> list(with_formulas("Row 1: A₁"))
    ['Row 1: ', Letter(base='A', sub=Number(...), sup=None, style='bold', dots=0)]
    """
    place = 0
    for found in _AMONG_WORDS.finditer(text):
        if found["counted"]:
            yield text[place : found.end("counted")]
            yield _counting(found["count"], bool(found["less"]))
            place = found.end()
            continue
        if letter := found["axis"] or found["letter"]:
            yield from (text[place : found.start()], Symbol(letter))
            place = found.end()
            continue
        if found["product"]:
            yield from (text[place : found.start()], _product(found["product"], found["function"]))
            place = found.end()
            continue
        if found["base"].isascii() and not (found["dots"] or found["sub"] or found["sup"]):
            continue
        if place < found.start():
            yield text[place : found.start()]
        yield _unit_or_formula(found)
        place = found.end()
    if place < len(text):
        yield text[place:]


def _product(text: str, function: str | None) -> Node:
    """2m₂L₂ as a product, the argument of a function where one is named."""
    number = re.match(r"\d+", text)
    assert number is not None
    letters = _FORMULA.finditer(text, number.end())
    formulas = (_formula(*found.group("base", "dots", "sub", "sup")) for found in letters)
    product = Product((Number(int(number[0])), *formulas))
    return Function(function, product) if function else product


def _unit_or_formula(found: re.Match[str]) -> Node:
    """A letter with what is raised or lowered beside it; of a unit upright."""
    formula = _formula(*found.group("base", "dots", "sub", "sup"))
    is_raised = found["base"] in "ms" and found["sup"] and not (found["dots"] or found["sub"])
    if is_raised and _AFTER_UNIT.search(found.string[: found.start()]):
        return replace(formula, style="upright")
    return formula


class ProseWriter:
    """Writes words in one notation: `plain` writes text, `formula` the mathematics among it.

    A letter is written once, however often it occurs.
    """

    def __init__(self, plain: Callable[[str], str], formula: Callable[[Node], str]) -> None:
        self.plain, self._formula = plain, cache(formula)

    def __call__(self, text: str) -> str:
        """The text in the notation."""
        parts = _parts(visible(text))
        return "".join(self.plain(part) if isinstance(part, str) else self._formula(part) for part in parts)


@lru_cache(maxsize=512)
def _parts(text: str) -> tuple[str | Node, ...]:
    """`with_formulas` of a text, remembered: one text is often written in several formats."""
    return tuple(with_formulas(text))


@lru_cache(maxsize=2048)
def _formula(base: str, dots: str, sub: str, sup: str) -> Letter:
    if base in _SCRIPTS:
        letter, style = _SCRIPTS[base]
    elif base in _BOLD_LETTERS:
        letter, style = _BOLD_LETTERS[base], "bold"
    else:
        letter = _DOTTED.get(base) or _SPELLED.get(base) or base
        style = "bold" if letter in _BOLD[bool(sub)] else "italic"
    count = _DOTS.get(dots, 1 if base in _DOTTED else 0)
    return Letter(letter, _index(sub, _SUBSCRIPTS), _index(sup, _SUPERSCRIPTS), style, count)


def _counting(letter: str, less: bool) -> Node:
    return Sum((Symbol(letter), Negative(ONE))) if less else Symbol(letter)


def _index(text: str, table: dict[str, str]) -> Node | None:
    if not text:
        return None
    runs = re.findall(r"\d+|\D", "".join(table[character] for character in text))
    parts = [_run(run) for run in runs]
    if len(parts) == 3 and parts[1] == _LESS:
        return Sum((parts[0], Negative(parts[2])))
    return parts[0] if len(parts) == 1 else Row(tuple(parts))


def _run(run: str) -> Node:
    if run.isdecimal():
        return Number(int(run))
    return _LESS if run == "-" else Symbol(run)
