"""Paths with their colours: the elements of a picture on paper, the same for every format.

Formulas as runs of letters: italics, bold vectors, upright digits, indices below, the star above the line.

Widths are those of a book face, on the generous side, so that whatever face shows
the picture, a label stays within its box.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.draw.vectors import Point
from dynsolve.notation.characters import GREEK, describes, runs, split
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Letter, Node, Number, Symbol, Words, walk
from dynsolve.notation.unicode import UnicodePrinter

Command = tuple[str, tuple[Point, ...]]
"""A letter and its points: M and L with one, C (a Bézier curve) with three, Z with none."""

Commands = tuple[Command, ...]

BLACK = "#1a1a1a"
GREY = "#8a929c"
WHITE = "#ffffff"
SIDE = "#cfd8e3"
CAP = "#edf2f8"
DARK_SIDE = "#b3c0d0"
LINK = "#e3e7ec"
FRAME = "#1f5fa8"
VARIABLE = "#b3321c"


class Path(Struct, frozen=True):
    """A line, an area or both; a colour is `#rrggbb`, None for none."""

    commands: Commands
    stroke: str | None = BLACK
    width: float = 1.1
    fill: str | None = None
    dashed: bool = False


def line(*points: Point) -> Commands:
    """A line through points."""
    return (("M", (points[0],)), *(("L", (point,)) for point in points[1:]))


def polygon(points: Sequence[Point]) -> Commands:
    """A closed line through points."""
    return (*line(*points), ("Z", ()))


def arc(center: Point, first: Point, second: Point, start: float, end: float, move: bool = True) -> Commands:
    """The part of the ellipse center + first·cos t + second·sin t from t = start to end, in radians."""
    steps = max(1, math.ceil(abs(end - start) / (math.pi / 2) - 1e-9))
    step = (end - start) / steps
    pull = 4.0 / 3.0 * math.tan(step / 4.0)
    commands: list[Command] = []
    for k in range(steps):
        a, b = start + k * step, start + (k + 1) * step
        p, q = on_ellipse(center, first, second, a), on_ellipse(center, first, second, b)
        p_rate, q_rate = _rate(first, second, a), _rate(first, second, b)
        if k == 0:
            commands.append(("M" if move else "L", (p,)))
        commands.append(
            (
                "C",
                (
                    (p[0] + pull * p_rate[0], p[1] + pull * p_rate[1]),
                    (q[0] - pull * q_rate[0], q[1] - pull * q_rate[1]),
                    q,
                ),
            )
        )
    return tuple(commands)


def on_ellipse(center: Point, first: Point, second: Point, t: float) -> Point:
    """center + first·cos t + second·sin t"""
    c, s = math.cos(t), math.sin(t)
    return center[0] + first[0] * c + second[0] * s, center[1] + first[1] * c + second[1] * s


def _rate(first: Point, second: Point, t: float) -> Point:
    c, s = math.cos(t), math.sin(t)
    return second[0] * c - first[0] * s, second[1] * c - first[1] * s


def ellipse(center: Point, first: Point, second: Point) -> Commands:
    """The whole ellipse center + first·cos t + second·sin t."""
    return (*arc(center, first, second, 0.0, 2 * math.pi), ("Z", ()))


def circle(center: Point, radius: float) -> Commands:
    """A circle."""
    return ellipse(center, (radius, 0.0), (0.0, radius))


def head(tip: Point, direction: Point, size: float = 9.0) -> Commands:
    """The head of an arrow that points along `direction`."""
    reach = math.hypot(*direction) or 1.0
    x, y = direction[0] / reach, direction[1] / reach
    back = (tip[0] - x * size, tip[1] - y * size)
    half = size * 0.34
    return polygon([tip, (back[0] - y * half, back[1] + x * half), (back[0] + y * half, back[1] - x * half)])


def arrow(
    start: Point,
    back: Point,
    tip: Point,
    direction: Point,
    colour: str,
    width: float,
    halo: float = 0.0,
    size: float = 9.0,
) -> tuple[Path, ...]:
    """A line from `start` to `back` and a head at the tip, last; with a white edge that is `halo` wide."""
    shaft = line(start, back)
    edge = (Path(shaft, WHITE, halo),) if halo else ()
    return (*edge, Path(shaft, colour, width), Path(head(tip, direction, size), None, fill=colour))


def flattened(commands: Commands) -> Iterator[tuple[Point, Point]]:
    """The straight pieces that a path is near to."""
    start = here = (0.0, 0.0)
    for letter, points in commands:
        if letter == "M":
            start = here = points[0]
        elif letter == "Z":
            yield here, start
            here = start
        elif letter == "L":
            yield here, points[0]
            here = points[0]
        else:
            curve = [_bezier(here, points, k / 6) for k in range(7)]
            yield from pairwise(curve)
            here = points[2]


def _bezier(a: Point, points: tuple[Point, ...], t: float) -> Point:
    b, c, d = points
    s = 1.0 - t
    k0, k1, k2, k3 = s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t
    return (
        k0 * a[0] + k1 * b[0] + k2 * c[0] + k3 * d[0],
        k0 * a[1] + k1 * b[1] + k2 * c[1] + k3 * d[1],
    )


# Formulas as runs of letters

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


class Run(Struct, frozen=True):
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


class LabelLine(Struct, frozen=True):
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

    def _applied(self, name: str, argument: str, exponent: str = "") -> str:
        """A function of the textbook: its name upright."""
        return _UPRIGHT + super()._applied(name + _SLANTED, argument, exponent)


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
