"""Caches of bounded size, so that the memory of a long process does not grow without end."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

_K = TypeVar("_K")
_V = TypeVar("_V")


def recalled(memory: dict[_K, _V], key: _K, make: Callable[[], _V], most: int) -> _V:
    """The value under a key of a cache of at most `most` entries; made and kept if there is none.

    >>> squares: dict[int, int] = {}
    >>> recalled(squares, 3, lambda: 9, most=10), squares
    (9, {3: 9})
    """
    try:
        return memory[key]
    except KeyError:
        return keep(memory, key, make(), most)


def keep(memory: dict[_K, _V], key: _K, value: _V, most: int) -> _V:
    """Put a value into a cache and return it; a full cache is emptied first."""
    if len(memory) >= most:
        memory.clear()
    memory[key] = value
    return value
