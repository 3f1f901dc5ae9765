"""The kinds of what acts on a manipulator beside gravity, and the way to the folder of each.

What acts is one of three terms, the classes of `robot.model`; of which kinds they are is in `dynsolve.acts`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any, NamedTuple

from dynsolve.algebra.ring import Expr
from dynsolve.robot.units import Dimension

Values = Mapping[str, float]
"""Numbers of parameters, coordinates and rates by their names."""

KINDS = ("friction", "springs", "dampers", "motors")
"""The one list of the kinds: each is a key of the problem file, and a folder of `dynsolve.acts`."""


def part(kind: str, file: str = "") -> Any:
    """A file of the folder `acts/<kind>`, or the folder itself, imported when it is asked for.

    This is how rooms below `acts` reach a kind, by its path: none of them names one.

    >>> part("springs").KEY.name
    'springs'
    """
    return import_module(".".join(filter(None, ("dynsolve.acts", kind, file))))


def keys_of_kinds() -> Iterator[Any]:
    """The key of every kind."""
    return (part(kind).KEY for kind in KINDS)


class Parameter(NamedTuple):
    """A value that an act has: what it is, for one and for several, and what it is measured in.

    `unit` is what is said of the dimension: a stiffness is in N m/rad, and not in N m.  `is_whole` says that
    the words are those of a symbol that is the value, else of every symbol in it.
    """

    value: Expr
    words: str = ""
    dimension: Dimension | None = None
    unit: str = ""
    is_whole: bool = True
