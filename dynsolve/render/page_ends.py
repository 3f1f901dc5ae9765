"""Where a page may end, in what is set on pages: not at a few lines of a display, or of a document.

Paragraphs stay with the display that they introduce, the first two rows of a display together and its
last ones too.  So many rows at the end of a document are on one page that none is nearly empty.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from dynsolve.document import Block, Equations, Formula, Prose, Table, Text, Uses

LAST_OF_DISPLAY = 3
LAST_OF_DOCUMENT = 8

_FIRST = 2


def runs_of_rows(count: int, last: int = LAST_OF_DISPLAY) -> tuple[int, ...]:
    """The rows of a display, in runs in which no page ends.

    >>> runs_of_rows(7), runs_of_rows(5)
    ((2, 1, 1, 3), (5,))
    """
    if count <= _FIRST + last:
        return (count,)
    return (_FIRST, *[1] * (count - _FIRST - last), last)


def stays(row: int, count: int, last: int = LAST_OF_DISPLAY) -> bool:
    """Whether a row, from 0, of a display stays on the page of the next.

    >>> [stays(row, 7) for row in range(6)]
    [True, False, False, False, True, True]
    """
    return count <= _FIRST + last or row < _FIRST - 1 or row >= count - last


def introduces(block: Block, following: Block | None) -> bool:
    """Whether a block belongs on one page with the one that follows."""
    if isinstance(block, Text):
        leads = isinstance(following, Text) and leads_on(following.parts)
        return leads_on(block.parts) or leads or isinstance(following, Formula | Equations | Table | Uses)
    return isinstance(block, Uses)


def leads_on(parts: Prose) -> bool:
    """Whether a sentence ends with a colon."""
    return bool(parts) and isinstance(parts[-1], str) and parts[-1].rstrip().endswith(":")


def closing(blocks: Iterable[Block], rows: Callable[[Block], int]) -> tuple[Block, ...]:
    """The last blocks, as many as have enough rows for the last page; `rows` is how many a block has."""
    found: list[Block] = []
    total = 0
    for block in reversed(list(blocks)):
        if total >= LAST_OF_DOCUMENT:
            break
        found.append(block)
        total += rows(block)
    return tuple(reversed(found))
