"""Where a page may end, in what is set on pages: not at a few lines of a display, or of a document.

Paragraphs stay with the display that they introduce, a long one not with a table, a formula of the
textbook with the display it leads to, a short one with its result, but not with a matrix, a note with what
it is about, the last of several results with the one before.  The rows of an equation stay together, of a
long one the first two and the last ones, as do those of a display.  So many rows at the end of a
document are on one page that none is nearly empty.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import accumulate

from dynsolve.document import Block, Equations, Formula, Heading, Note, Prose, Table, Text, Uses
from dynsolve.render.matrices import holds_matrix

LAST_OF_DISPLAY = 3
LAST_OF_DOCUMENT = 8
_ENOUGH = 5
"""The rows of a last page to which no matrices are added, which would leave a gap on the page before."""

_FIRST = 2
_LONG = 350
"""A paragraph of more letters need not stay with a table."""


def runs_of_rows(count: int, last: int = LAST_OF_DISPLAY) -> tuple[int, ...]:
    """The rows of a display, in runs in which no page ends.

    >>> runs_of_rows(7), runs_of_rows(5)
    ((2, 1, 1, 3), (2, 3))
    """
    if count < _FIRST + last:
        return (count,)
    return (_FIRST, *[1] * (count - _FIRST - last), last)


def runs_of_equations(begins: Sequence[bool], last: int = LAST_OF_DISPLAY) -> tuple[int, ...]:
    """The same for a display of several equations; `begins` says with which rows one begins.

    >>> runs_of_equations([True] * 3 + [False] + [True] * 4)
    (2, 2, 1, 1, 2)
    >>> runs_of_equations([True] + [False] * 6)
    (2, 1, 1, 3)
    """
    starts = [row for row, begun in enumerate(begins) if begun or not row]
    sizes = [end - start for start, end in zip(starts, [*starts[1:], len(begins)], strict=True)]
    runs = [run for size in sizes for run in runs_of_rows(size, last)]
    while len(runs) > 1 and runs[0] < _FIRST:
        runs[:2] = [runs[0] + runs[1]]
    fewest = last if last > LAST_OF_DISPLAY else _FIRST
    while len(runs) > 1 and runs[-1] < fewest:
        runs[-2:] = [runs[-2] + runs[-1]]
    return tuple(runs)


def stay(begins: Sequence[bool], last: int = LAST_OF_DISPLAY) -> list[bool]:
    """Which rows of a display stay on the page of the next.

    >>> stay([True] + [False] * 6)
    [True, False, False, False, True, True, False]
    """
    ends = set(accumulate(runs_of_equations(begins, last)))
    return [row not in ends for row in range(1, len(begins) + 1)]


def introduces(block: Block, following: Block | None, closes: bool = False) -> bool:
    """Whether a block belongs on one page with the one that follows; it `closes` where it is the last one."""
    if isinstance(block, Text):
        leads = isinstance(following, Text) and leads_on(following.parts)
        table = isinstance(following, Table) and not _is_long(block.parts)
        return leads_on(block.parts) or leads or table or isinstance(following, Formula | Equations | Uses)
    if isinstance(following, Note):
        return isinstance(block, Formula | Equations | Table)
    if isinstance(block, Formula):
        if block.label:
            return closes and isinstance(following, Formula)
        if block.source:
            return isinstance(following, Formula | Equations | Uses)
        if isinstance(following, Formula) and (not following.label or holds_matrix(following.node)):
            return False
        return not holds_matrix(block.node) and isinstance(following, Formula | Equations | Uses)
    return isinstance(block, Uses)


def _is_long(parts: Prose) -> bool:
    return sum(len(part) for part in parts if isinstance(part, str)) > _LONG


def leads_on(parts: Prose) -> bool:
    """Whether a sentence ends with a colon."""
    return bool(parts) and isinstance(parts[-1], str) and parts[-1].rstrip().endswith(":")


def before_closing(blocks: Sequence[Block]) -> tuple[Sequence[Block], Sequence[Block]]:
    """The blocks before a heading that is closing, and those from it on."""
    places = (k for k, block in enumerate(blocks) if isinstance(block, Heading) and block.closing)
    first = next(places, len(blocks))
    return blocks[:first], blocks[first:]


def closing(blocks: Iterable[Block], rows: Callable[[Block], int]) -> tuple[Block, ...]:
    """The last blocks, as many as have enough rows for the last page; `rows` is how many a block has."""
    found: list[Block] = []
    total = 0
    for block in reversed(list(blocks)):
        matrices = isinstance(block, Formula) and holds_matrix(block.node)
        if total >= (_ENOUGH if matrices else LAST_OF_DOCUMENT):
            break
        found.append(block)
        total += rows(block)
    return tuple(reversed(found))
