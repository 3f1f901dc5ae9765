"""Formulas as runs of letters: italics, bold vectors, upright digits, indices below, the star above the line.

Widths are those of a book face, on the generous side, so that whatever face shows
the picture, a label stays within its box.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from dynsolve.notation.characters import GREEK
from dynsolve.notation.names import describes, runs, split
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Letter, Node, Number, Symbol, Words
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.notation.walk import walk

SIZE = 17.0
"""The size of a label's letters in picture units."""

INDEX = 0.7
"""The size of an index, as a part of that."""

_DROP, _RISE = 0.24, 0.36
_DOWN, _UP, _BACK = "\ue000", "\ue001", "\ue002"
_BOLD, _UPRIGHT, _SLANTED = "\ue003", "\ue004", "\ue005"
_FACES = frozenset((_BOLD, _UPRIGHT, _SLANTED))
_MARKS = frozenset((_DOWN, _UP, _BACK)) | _FACES
_STAR = "∗"
_SPACE = 0.25
_PRINTED = {"-": "−", " ": "\u00a0"}

_NARROW = "fijlrtι.,:;'|()/°\u00a0"
_WIDE = "mwMWGHKNOQDUAωφψΦΨΩΘ"


@dataclass(frozen=True, slots=True)
class Run:
    """Letters of one look, in picture units.

    `shift` is how far below the line they stand, `gap` the space before them: programs
    disagree about a blank at the beginning of a piece of text.
    """

    text: str
    italic: bool
    size: float
    shift: float
    gap: float = 0.0
    bold: bool = False


@dataclass(frozen=True, slots=True)
class LabelLine:
    """A label as it is set: its runs, its width and its height."""

    runs: tuple[Run, ...]
    width: float
    height: float = SIZE * 1.12


class _MarkedPrinter(UnicodePrinter):
    """Unicode with marks where indices and bold letters begin and end."""

    def _symbol(self, node: Symbol) -> str:
        base, groups = split(node.name)
        text = GREEK.get(base, base)
        if groups:
            text += _DOWN + ",".join(_index(group) for group in groups) + _BACK
        return text + (_UP + _STAR + _BACK if self.style.starred(node) else "")

    def _letter(self, node: Letter) -> str:
        """A vector of the textbook: bold, with its index."""
        index = "" if node.sub is None else _DOWN + "".join(map(_leaf, walk(node.sub))) + _BACK
        return _BOLD + node.base + _SLANTED + index


def _leaf(node: Node) -> str:
    """What stands in an index: numbers, words and names."""
    match node:
        case Number(p):
            return str(p)
        case Words(text):
            return _UPRIGHT + text + _SLANTED
        case Symbol(name):
            return _index(name)
    return ""


def _index(group: str) -> str:
    """A group of indices, what only describes upright: the c of l_c1."""
    return "".join(
        _UPRIGHT + run + _SLANTED if describes(run) else GREEK.get(run, run) for run in runs(group)
    )


def typeset(node: Node, style: Style) -> LabelLine:
    """A formula on one line."""
    runs = tuple(_spaced(_runs(_MarkedPrinter(style).text(node))))
    return LabelLine(runs, sum(map(_width, runs)))


def _runs(marked: str) -> Iterator[Run]:
    """The pieces between marks, upright and slanted ones apart."""
    size, shift, text, italic, face = SIZE, 0.0, "", False, _SLANTED
    for character in marked + _BACK:
        slanted = character.isalpha() and face == _SLANTED
        if character in _MARKS or slanted != italic:
            if text:
                yield Run(text, italic, round(size, 2), round(shift, 2), bold=face == _BOLD)
            text, italic = "", slanted
        if character in _FACES:
            face = character
        elif character == _DOWN:
            size, shift = SIZE * INDEX, SIZE * _DROP
        elif character == _UP:
            size, shift = SIZE * INDEX, -SIZE * _RISE
        elif character == _BACK:
            size, shift = SIZE, 0.0
        else:
            text += _PRINTED.get(character, character)


def _spaced(runs: Iterable[Run]) -> Iterator[Run]:
    """The runs with the blanks at their ends turned into gaps."""
    owed = 0.0
    for run in runs:
        letters = run.text.strip()
        before = len(run.text) - len(run.text.lstrip())
        gap = owed + before * _SPACE * run.size
        owed = (len(run.text) - before - len(letters)) * _SPACE * run.size
        if letters:
            yield replace(run, text=letters, gap=round(gap, 2))
        else:
            owed += gap


def _width(run: Run) -> float:
    return run.gap + run.size * sum(map(_letter_width, run.text))


def _letter_width(character: str) -> float:
    if character in _NARROW:
        return 0.36
    if character in _WIDE:
        return 0.82
    if character.isupper():
        return 0.70
    return 0.56
