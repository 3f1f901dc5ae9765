"""Names for what becomes known on the way: coordinates of points, entries of rotations.

A wrist centre is (x_c, y_c, z_c), the rotation of a wrist u₁₁ ... u₃₃ (Spong, 2.5.1 and 3.3.2);
what comes later, or would mean something else in the problem, takes the next letters.
"""

from __future__ import annotations

from collections.abc import Iterable
from collections.abc import Set as AbstractSet

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.questions.inverse.solving import Definition

POINTS = ("c", "p", "b", "e", "h", "k", "s", "w", "A", "B", "E", "F")
TURNS = ("u", "v", "w", "b", "e", "h")
MOST_LEVELS = 3
"""So often a part is taken off the arm."""


class Names(Struct, frozen=True):
    """The names that may be given in one part of a solution, and in those after it.

    `points` are the subscripts of a point and of an origin, part after part, `turns` letters of rotations.
    """

    points: tuple[str, ...]
    turns: tuple[str, ...]

    @staticmethod
    def beside(taken: AbstractSet[str]) -> Names:
        """Names that do not mean something already; fewer where the problem has most of them."""
        points = (s for s in POINTS if taken.isdisjoint(_coordinates(s)))
        turns = (letter for letter in TURNS if taken.isdisjoint(_entries(letter)))
        return Names(tuple(points)[: 2 * MOST_LEVELS], tuple(turns)[:MOST_LEVELS])

    @property
    def of_points(self) -> tuple[str, ...]:
        """Every name of a point's coordinate."""
        return tuple(name for subscript in self.points for name in _coordinates(subscript))

    @property
    def of_turns(self) -> tuple[str, ...]:
        """Every name of a rotation's entry."""
        return tuple(name for letter in self.turns for name in _entries(letter))

    @property
    def later(self) -> Names:
        """Those of the next part."""
        return Names(self.points[2:], self.turns[1:])

    def point(self, point: Matrix) -> tuple[Matrix, tuple[Definition, ...]]:
        """The coordinates of a point (3×1) by name, as far as these are shorter, and what they stand for."""
        if all(_is_name(value) for value in point.entries):
            return point, ()
        return _named(point, _coordinates(self.points[0]) if self.points else ())

    def turn(self, H: Matrix) -> tuple[Matrix, tuple[Definition, ...]]:
        """A pose (4×4) by the names of its entries, and what they stand for."""
        origin = _coordinates(self.points[1]) if len(self.points) > 1 else ()
        entries = _entries(self.turns[0]) if self.turns else ()
        rotation, turns = _named(H.block(0, 3, 0, 3), entries)
        position, points = _named(H.block(0, 3, 3, 4), origin)
        rows = [[*row, p] for row, p in zip(rotation.rows, position.entries, strict=True)]
        return Matrix.of(H.ring, [*rows, H.rows[3]]), (*turns, *points)


def _coordinates(subscript: str) -> tuple[str, ...]:
    return tuple(axis + subscript for axis in "xyz")


def _entries(letter: str) -> tuple[str, ...]:
    return tuple(f"{letter}{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))


def _is_name(value: Expr) -> bool:
    """Whether a value is a symbol, perhaps with a minus sign, or a number."""
    return len(value) <= 1 and int(value.poly.total_degree()) <= 1


def _named(values: Matrix, names: Iterable[str]) -> tuple[Matrix, tuple[Definition, ...]]:
    """The values by name, as far as there are names and they are no numbers."""
    ring = values.ring
    shown: dict[str, Expr] = {}
    entries = list(values.entries)
    for k, (value, name) in enumerate(zip(values.entries, names, strict=False)):
        if not value.is_number:
            shown[name] = value
            entries[k] = ring.symbol(name)
    width = values.shape[1]
    rows = (entries[k : k + width] for k in range(0, len(entries), width))
    return Matrix.of(ring, rows), tuple(Definition(name, value) for name, value in shown.items())
