"""How large parentheses are around others: larger than those, as a reader finds pairs by their size."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.notation.extent import FLAT

HEIGHTS = (FLAT, 1.35, 1.8)
"""In em: around what has no parentheses, around what has some, and around some with others in them."""


def height_around(text: str, signs: Sequence[str]) -> float:
    """The height of parentheses around a text that is not tall; `signs` are those of each height.

    >>> signs = ("(", "big(", "Big(")
    >>> [height_around(text, signs) for text in ("a + b", "a + c(b + d)", "a + big(e + c(b + d)big)")]
    [1.3, 1.35, 1.8]
    """
    inside = [place for place, sign in enumerate(signs, 1) if sign in text]
    return HEIGHTS[min(max(inside, default=0), len(HEIGHTS) - 1)]
