"""Breaking what is too wide: sums at their signs, prose between its words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.notation.unicode import width

HARD_SPACE = "\u00a0"
"""Stands for a space inside a formula of a sentence, where no line may end."""

_FULL_ENOUGH = 0.45
_NEVER = 99


def break_sum(text: str, first: int, rest: int) -> list[str]:
    """Break a formula before a sign + or -, in as few parentheses as can be.

    The first line may take `first` cells, the others `rest`.  A product that is
    itself too wide is broken between its factors.

    >>> break_sum("a b + c (d - e) + f", 16, 16)
    ['a b + c (d - e)', '+ f']
    """
    lines: list[str] = []
    room = first
    while width(text) > room:
        place = _best_break(text, room)
        if place is None:
            break
        lines.append(text[:place].rstrip())
        text = text[place:].lstrip()
        room = rest
    return [*lines, text]


def _best_break(text: str, room: int) -> int | None:
    """Where the line ends: the last of the shallowest places that leave it full enough."""
    places = list(_breaks(text, room))
    full = [p for p in places if p[2] >= room * _FULL_ENOUGH] or places
    if not full:
        return None
    shallowest = min(depth for depth, _, _ in full)
    return max(place for depth, place, _ in full if depth == shallowest)


def _breaks(text: str, room: int) -> Iterator[tuple[int, int, int]]:
    """(depth, offset, cells before it) of every place within reach; a space of a product is the deepest."""
    depth, cells, met_one = 0, 0, False
    for i, character in enumerate(text):
        if character == "(":
            depth += 1
        elif character == ")":
            depth -= 1
        elif character == " " and i:
            sign = text[i + 1 : i + 3] in ("+ ", "- ", "= ")
            if sign or text[i - 1] not in "+-=":
                yield (depth if sign else depth + _NEVER), i, cells
                met_one = True
        cells += width(character)
        if cells > room and met_one:
            return


def wrap(text: str, first: int, rest: int) -> list[str]:
    """Wrap prose; hard spaces are no places to break, unless the formula alone is too wide."""
    lines: list[str] = []
    line, room = "", first
    for word in text.split():
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
