"""A text that is put together from stretches of a file, and still knows where each character stands there."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass

from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.submission import Place

Piece = tuple[str, int]
"""Some characters, and the offset in the file that the first of them stands at."""


@dataclass(frozen=True, slots=True)
class PlacedText:
    """A text; `starts` are the offsets at which its pieces begin, `origins` those in the file."""

    text: str
    starts: tuple[int, ...]
    origins: tuple[int, ...]

    def origin(self, offset: int) -> int:
        """The offset in the file of a character of this text."""
        at = max(bisect_right(self.starts, offset) - 1, 0)
        return self.origins[at] + offset - self.starts[at]

    def part(self, start: int, end: int) -> PlacedText:
        """The text between two offsets."""
        starts = tuple(max(at - start, 0) for at in self.starts)
        origins = tuple(
            origin + max(start - at, 0) for at, origin in zip(self.starts, self.origins, strict=True)
        )
        return PlacedText(self.text[start:end], starts, origins)

    def within(self, outer: PlacedText) -> PlacedText:
        """This text, whose origins are offsets in another, with those of the other."""
        return PlacedText(self.text, self.starts, tuple(map(outer.origin, self.origins)))

    def display(self, source: Source) -> Display:
        """The text as the value of an answer."""

        def locate(offset: int, length: int) -> Place:
            return source.place(self.origin(min(offset, max(len(self.text) - 1, 0))), length)

        return Display(self.text, "", locate, plain=True)


def placed(pieces: Iterable[Piece]) -> PlacedText:
    """The text of these pieces, one after the other."""
    kept = [piece for piece in pieces if piece[0]] or [("", 0)]
    starts, length = [], 0
    for text, _ in kept:
        starts.append(length)
        length += len(text)
    return PlacedText("".join(text for text, _ in kept), tuple(starts), tuple(at for _, at in kept))
