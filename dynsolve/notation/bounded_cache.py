"""What is remembered within bounds, so that nothing a process keeps grows without end."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

_K = TypeVar("_K")
_V = TypeVar("_V")


def recalled(memory: dict[_K, _V], key: _K, make: Callable[[], _V], most: int) -> _V:
    """What a memory of at most so many entries holds under a key, made where it holds nothing yet.

    >>> squares: dict[int, int] = {}
    >>> recalled(squares, 3, lambda: 9, most=10), squares
    (9, {3: 9})
    """
    try:
        return memory[key]
    except KeyError:
        return keep(memory, key, make(), most)


def keep(memory: dict[_K, _V], key: _K, value: _V, most: int) -> _V:
    """Put a value into a memory; one that is full is begun anew."""
    if len(memory) >= most:
        memory.clear()
    memory[key] = value
    return value
