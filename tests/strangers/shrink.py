"""The smallest mechanism with a fault: keys, rows, bodies and entries are left out while it stays."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from copy import deepcopy
from typing import Any

Place = tuple[str | int, ...]


def shrunk(problem: dict[str, Any], fails: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
    """A file of which nothing more can be left out without `fails` becoming false.

    >>> shrunk({"dh": [1, 2, 3], "values": {"a": 1, "b": 2}}, lambda file: 2 in file.get("dh", []))
    {'dh': [2]}
    """
    while True:
        smaller = next((one for one in _smaller(problem) if fails(one)), None)
        if smaller is None:
            return problem
        problem = smaller


def _smaller(problem: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The file without one part, larger parts first."""
    for place in sorted(_places(problem), key=len):
        copy = deepcopy(problem)
        holder: Any = copy
        for key in place[:-1]:
            holder = holder[key]
        del holder[place[-1]]
        if holder:
            yield copy


def _places(part: Any, before: Place = ()) -> Iterator[Place]:
    inside = part.items() if isinstance(part, dict) else enumerate(part) if isinstance(part, list) else ()
    for key, value in inside:
        yield (*before, key)
        yield from _places(value, (*before, key))
