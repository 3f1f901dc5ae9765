"""One way in which an answer may be come to from others."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Key = Callable[[str], Any]
"""The key's value of a node, by its name."""


@dataclass(frozen=True, slots=True)
class Route:
    """value = compute(*inputs); compute gives None where these inputs lead nowhere.

    `linear`: sums and derivatives alone, whose work grows with the inputs and not with their products.
    """

    inputs: tuple[str, ...]
    compute: Callable[..., Any]
    linear: bool = True
