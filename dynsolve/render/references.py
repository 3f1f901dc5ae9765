"""Numbers of equations: every named result of a document, in order."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import zip_longest
from textwrap import shorten

from dynsolve.document import Block, Document, Equations, Fold, Formula, Heading, Prose, Text, Uses


def numbered(document: Document) -> dict[str, int]:
    """The number of each labelled display, from 1."""
    displays = (b for b in unfolded(document.blocks) if isinstance(b, Formula | Equations))
    numbers: dict[str, int] = {}
    for number, display in enumerate((d for d in displays if d.label and d.label not in numbers), start=1):
        numbers |= dict.fromkeys((display.label, *display.also), number)
    return numbers


_MANY_STEPS = 40
_LONGEST_HEADER = 60


def is_long(document: Document) -> bool:
    """Whether a document wants a table of contents: from forty steps on."""
    return _steps(document.blocks) >= _MANY_STEPS


def _steps(blocks: Iterable[Block]) -> int:
    return sum(1 + _steps(block.blocks) for block in blocks if isinstance(block, Fold))


def sections(document: Document) -> tuple[Heading, ...]:
    """The headings of the sections of a document."""
    return tuple(block for block in document.blocks if isinstance(block, Heading) and block.level == 2)


def running_title(title: str) -> str:
    """A title as it stands above every page: in one line.

    >>> running_title("RP manipulator")
    'RP manipulator'
    """
    return shorten(title, _LONGEST_HEADER, placeholder="…") if len(title) > _LONGEST_HEADER else title


def runs(labels: Iterable[str], numbers: Mapping[str, int]) -> list[list[str]]:
    """Labels in the order of their numbers, one of each, three or more that follow each other together.

    >>> runs(["c", "a", "b", "e"], {"a": 1, "b": 2, "c": 3, "d": 4, "e": 5})
    [['a', 'b', 'c'], ['e']]
    """
    first = {number: label for label, number in reversed([*numbers.items()])}
    found: list[list[str]] = []
    for label in map(first.__getitem__, sorted({numbers[label] for label in labels if label in numbers})):
        if found and numbers[label] == numbers[found[-1][-1]] + 1:
            found[-1].append(label)
        else:
            found.append([label])
    return [part for run in found for part in ([run] if len(run) > 2 else [[label] for label in run])]


def formulas(blocks: Iterable[Block]) -> Iterator[Formula]:
    """The displayed formulas, those in folds too."""
    return (block for block in unfolded(blocks) if isinstance(block, Formula))


def unfolded(blocks: Iterable[Block]) -> Iterator[Block]:
    """The blocks, in place of a fold those in it."""
    for block in blocks:
        yield from unfolded(block.blocks) if isinstance(block, Fold) else (block,)


def after_references(parts: Prose) -> Prose:
    """How a lead-in goes on after "With (3)".

    >>> after_references(("Term by term:",)), after_references(("With s = 0:",))
    ((', term by term:',), (' and with s = 0:',))
    """
    first, *rest = parts
    if not isinstance(first, str):
        return (", ", *parts)
    joint = " and " if first.startswith("With ") else ", "
    return (joint + first[:1].lower() + first[1:], *rest)


def with_results(blocks: Sequence[Block]) -> list[Block]:
    """The blocks, without each `Uses` that says nothing else and that no formula follows."""
    return [
        block
        for block, after in zip_longest(blocks, blocks[1:])
        if not isinstance(block, Uses) or block.parts or isinstance(after, Formula | Equations)
    ]


def with_sources(blocks: Sequence[Block]) -> Iterator[Block]:
    """The same blocks, the source of a formula beside the paragraph that introduces it."""
    blocks = with_results(blocks)
    for block, following in zip_longest(blocks, blocks[1:]):
        if isinstance(block, Text) and isinstance(following, Formula) and not block.source:
            yield replace(block, source=following.source)
        else:
            yield block


def slug(document: Document) -> str:
    """A short name of a document, of letters, digits and `-`, for labels and anchors.

    >>> slug(Document((Heading("RP manipulator, 2nd", 1),)))
    'rp-manipulator-2nd'
    """
    titles = (block.text for block in document.blocks if isinstance(block, Heading))
    words = re.findall(r"[a-z0-9]+", next(titles, "").lower())
    return "-".join(words)[:40].strip("-") or "robot"
