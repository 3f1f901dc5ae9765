"""How students spell the names of quantities and coordinates."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import product

from dynsolve.notation.names import split
from dynsolve.robot.model import Coordinate, JointType

_STRIP = re.compile(r"[_{}, ]")


def key(name: str) -> str:
    """The letters and digits of a name, by which it is looked up.

    >>> key("I_{1,zz}"), key("theta_1")
    ('I1zz', 'theta1')
    """
    return name if name.isalnum() else _STRIP.sub("", name)


def subscripts(coordinates: tuple[Coordinate, ...]) -> dict[str, Coordinate]:
    """Coordinates by the subscript of their name; by their place where names have none, or share one."""
    found: dict[str, Coordinate] = {}
    for q in coordinates:
        index = "".join(split(q.name)[1])
        if not index.isdigit() or index in found:
            return {str(q.index): q for q in coordinates}
        found[index] = q
    return found


def other_names(q: Coordinate, subscript: str) -> tuple[str, ...]:
    """What a coordinate is called: its own name first, q by its place, θ or d by its subscript."""
    letter = "theta" if q.type is JointType.REVOLUTE else "d"
    return tuple(dict.fromkeys((key(q.name), f"q{q.index}", f"{letter}{subscript}")))


def open_index(name: str) -> str:
    """A name with `#` for each digit of its index: P# of `P3`, d## of `d13`; empty without an index."""
    stem = name.rstrip("0123456789")
    return stem + "#" * (len(name) - len(stem)) if stem != name else ""


def each(*pieces: str | Iterable[str]) -> tuple[str, ...]:
    """Templates of spellings: every choice of one of each piece, joined.

    >>> each("K T", "v w", "{b}")
    ('Kv{b}', 'Kw{b}', 'Tv{b}', 'Tw{b}')
    """
    choices = [piece.split(" ") if isinstance(piece, str) else piece for piece in pieces]
    return tuple("".join(choice) for choice in product(*choices))
