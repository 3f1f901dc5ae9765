"""The text of a hand-in, whatever its bytes, and where in the file each character stands."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import accumulate

from msgspec import Struct, field

from dynsolve.answers.reading.displays import Display, Locate
from dynsolve.answers.reading.grids import MAX_BYTES
from dynsolve.answers.verdict import Place
from dynsolve.notation.unicode import printable

_LONGEST_EXCERPT = 400

_WIDE = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-*/^=()[]{}|,.:;_"
_SAME = {
    **{chr(ord(sign) + 0xFEE0): sign for sign in _WIDE},
    **{chr(code): str((code - 0x1D7CE) % 10) for code in range(0x1D7CE, 0x1D800)},
    **dict.fromkeys("\u00a0\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200a", " "),
    **dict.fromkeys("\u202f\u205f\u3000", " "),
    **dict.fromkeys("≈≃≅≙≐≡≜≔≝", "="),
    "∶": ":",
    **dict.fromkeys("\u200b\u200c\u200d\u200e\u200f\u2060\ufe0e\ufe0f\ufeff", ""),
}
"""Signs as they are typed: full-width ones, digits of other faces, blanks, equalities; the unseen goes.

A soft hyphen stays, and the line waits: in what is copied from a PDF it may be a minus.
"""

_OTHERS = re.compile(f"[{''.join(_SAME)}]")


class Source(Struct, frozen=True, dict=True):
    """A text; `origins` are (offset, line, column) of its stretches, where the file is another text."""

    text: str
    file: str = ""
    origins: Sequence[tuple[int, int, int]] = field(default=())

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(match.end() for match in re.finditer("\n", self.text))]

    @cached_property
    def _offsets(self) -> list[int]:
        return [origin[0] for origin in self.origins]

    def place(self, offset: int, length: int = 1) -> Place:
        """Where the characters at an offset stand, with their line as it is shown."""
        offset = min(max(offset, 0), len(self.text))
        line = bisect_right(self._starts, offset)
        start = self._starts[line - 1]
        end = self._starts[line] - 1 if line < len(self._starts) else len(self.text)
        column = offset - start + 1
        excerpt = shown(self.text[start:end]) if end - start <= _LONGEST_EXCERPT else ""
        length = max(1, min(length, end - offset))
        if self.origins:
            at = max(bisect_right(self._offsets, offset) - 1, 0)
            first, line, base = self.origins[at]
            between = self.text[first:offset]
            line += between.count("\n")
            column = len(between) - between.rfind("\n") if "\n" in between else base + len(between)
            excerpt = excerpt if len(excerpt) >= column else ""
        return Place(line, column, length, excerpt)

    def behind(self, start: int, last: int = MAX_BYTES) -> Locate:
        """Where the characters of a display are that begins at an offset; none is behind its `last`."""

        def locate(offset: int, length: int) -> Place:
            return self.place(start + min(offset, last), length)

        return locate


def shown(text: str) -> str:
    """A text without the characters that could steer a terminal."""
    return printable(text.replace("\t", " "))


def decoded(content: str | bytes) -> str:
    """The text of a file: UTF-8, UTF-16 with its mark, else what can be read of it."""
    if isinstance(content, bytes):
        if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
            content = content.decode("utf-16", errors="replace")
        else:
            content = content.decode("utf-8", errors="replace")
    return plain_signs(content.replace("\r\n", "\n").replace("\r", "\n"))


def plain_signs(text: str) -> str:
    r"""A text in which what looks the same is the same.

    >>> plain_signs("Ｋ\u200b ≈ ½\u00a0𝟐")
    'K = ½ 2'
    """
    return text if text.isascii() else _OTHERS.sub(lambda sign: _SAME[sign[0]], text)


# A text that is put together from stretches of a file, and still knows where each character stands there

Piece = tuple[str, int]
"""Some characters, and the offset in the file that the first of them stands at."""


class PlacedText(Struct, frozen=True):
    """A text; `starts` are the offsets at which its pieces begin, `origins` those in the file."""

    text: str
    starts: tuple[int, ...]
    origins: tuple[int, ...]

    def origin(self, offset: int) -> int:
        """The offset in the file of a character of this text."""
        at = max(bisect_right(self.starts, offset) - 1, 0)
        return self.origins[at] + offset - self.starts[at]

    def pieces(self) -> Iterator[Piece]:
        """The pieces that it was put together from."""
        ends = (*self.starts[1:], len(self.text))
        for start, end in zip(self.starts, ends, strict=True):
            if start < end:
                yield self.text[start:end], self.origin(start)

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


# Brackets in a text

_LEVELS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}


def levels(text: str) -> list[int]:
    """How many brackets are open behind each character of a text."""
    return list(accumulate(_LEVELS.get(character, 0) for character in text))


def is_balanced(text: str) -> bool:
    """Whether every bracket closes one that is open, and none is left open."""
    found = levels(text)
    return not found or (found[-1] == 0 and min(found) >= 0)


# What is left out of a text, which keeps its length

HIDDEN = "\0"
"""What stands for what is read elsewhere: no line with one is an equation in plain text."""


def blanked(text: str, sign: str = " ") -> str:
    """Blanks, or other signs, for all of it, but for the ends of its lines."""
    return "\n".join(sign * len(line) for line in text.split("\n"))


def hidden(text: str, spans: Iterable[tuple[int, int]], sign: str = " ") -> str:
    """The text with a sign for every character of these stretches."""
    pieces: list[str] = []
    done = 0
    for start, end in sorted(spans):
        if end > done:
            start = max(start, done)
            pieces += [text[done:start], blanked(text[start:end], sign)]
            done = end
    return "".join([*pieces, text[done:]])
