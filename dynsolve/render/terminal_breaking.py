"""Line breaks for a terminal: sums break at their signs, prose between its words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.notation.unicode import width

HARD_SPACE = "\u00a0"
"""Stands for a space inside a formula of a sentence, where no line may end."""

_FULL_ENOUGH = 0.33
_NEVER = 99


def break_sum(text: str, first: int, rest: int) -> list[str]:
    """Break a formula before a sign + or -, in as few parentheses as can be.

    The first line may take `first` cells, the others `rest`.  A product that is
    itself too wide is broken between its factors.

    >>> break_sum("a b + c (d - e) + f", 16, 16)
    ['a b + c (d - e)', '+ f']
    """
    lines: list[str] = []
    start, room = 0, first
    while (place := _end_of_line(text, start, room)) is not None:
        lines.append(text[start:place].rstrip())
        start, room = place + 1, rest
    return [*lines, text[start:]]


def _end_of_line(text: str, start: int, room: int) -> int | None:
    """Where a line ends that begins at `start`; None where all that is left fits, or cannot be broken.

    It is the last of the shallowest places that leave the line full enough.
    """
    best: tuple[int, int] | None = None
    spare: tuple[int, int] | None = None
    for depth, place, cells in _breaks(text, start, room):
        if place < 0:
            return None
        if cells >= room * _FULL_ENOUGH:
            best = (depth, place) if best is None or depth <= best[0] else best
        else:
            spare = (depth, place) if spare is None or depth <= spare[0] else spare
    found = best or spare
    return found[1] if found else None


def _breaks(text: str, start: int, room: int) -> Iterator[tuple[int, int, int]]:
    """(depth, offset, cells before it) of every place within reach; offset -1 where the end is reached.

    A space between the factors of a product is the deepest place.
    """
    depth, cells, met_one = 0, 0, False
    for i in range(start, len(text)):
        character = text[i]
        if character == "(":
            depth += 1
        elif character == ")":
            depth -= 1
        elif character == " " and i > start:
            sign = text[i + 1 : i + 3] in ("+ ", "- ", "= ", "≈ ")
            if sign or text[i - 1] not in "+-=≈":
                yield (depth if sign else depth + _NEVER), i, cells
                met_one = True
        cells += width(character)
        if cells > room and met_one:
            return
    if cells <= room:
        yield 0, -1, cells


def wrap(text: str, first: int, rest: int) -> list[str]:
    """Wrap prose; hard spaces are no places to break, unless the formula alone is too wide."""
    lines: list[str] = []
    line, room = "", first
    for word in filter(None, text.replace("\n", " ").split(" ")):
        for piece in _fitting(word, rest):
            joined = f"{line} {piece}" if line else piece
            if line and width(joined) > room:
                lines.append(line)
                line, room = piece, rest
            else:
                line = joined
    lines.append(line)
    return [line.replace(HARD_SPACE, " ") for line in lines]


def _fitting(word: str, room: int) -> Sequence[str]:
    if HARD_SPACE not in word or width(word) <= room:
        return (word,)
    return [piece.replace(" ", HARD_SPACE) for piece in break_sum(word.replace(HARD_SPACE, " "), room, room)]
