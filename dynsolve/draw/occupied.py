"""The grid of the places on paper that are occupied, so that labels find free ones."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from dataclasses import dataclass

from dynsolve.draw.paths import Path, flattened
from dynsolve.draw.vectors import Point

CELL = 3.0
"""The side of a cell of the grid."""


@dataclass(frozen=True, slots=True)
class Box:
    """An upright rectangle on paper."""

    left: float
    top: float
    right: float
    bottom: float

    @staticmethod
    def around(center: Point, width: float, height: float) -> Box:
        """The box with this centre and size."""
        x, y = center
        return Box(x - width / 2, y - height / 2, x + width / 2, y + height / 2)

    @property
    def center(self) -> Point:
        """Its middle."""
        return (self.left + self.right) / 2, (self.top + self.bottom) / 2

    def grown(self, room: float) -> Box:
        """The box with room around it."""
        return Box(self.left - room, self.top - room, self.right + room, self.bottom + room)

    def holding(self, point: Point) -> Box:
        """The least box that holds this one and a point."""
        x, y = point
        return Box(min(self.left, x), min(self.top, y), max(self.right, x), max(self.bottom, y))

    def overlaps(self, other: Box, beside: float = 0.0, above: float = 0.0) -> bool:
        """Whether two boxes come nearer to each other than this, beside or above one another."""
        return (
            self.left < other.right + beside
            and other.left < self.right + beside
            and self.top < other.bottom + above
            and other.top < self.bottom + above
        )

    def meets(self, a: Point, b: Point) -> bool:
        """Whether a line has a point in it."""
        low, high = 0.0, 1.0
        for start, end, least, most in (
            (a[0], b[0], self.left, self.right),
            (a[1], b[1], self.top, self.bottom),
        ):
            if start == end:
                if not least <= start <= most:
                    return False
                continue
            near, far = sorted(((least - start) / (end - start), (most - start) / (end - start)))
            low, high = max(low, near), min(high, far)
        return low <= high

    def nearest(self, point: Point) -> Point:
        """Its point that is nearest to another."""
        return min(max(point[0], self.left), self.right), min(max(point[1], self.top), self.bottom)


def bounds(paths: Iterable[Path]) -> Box:
    """The box around paths."""
    points = [point for path in paths for piece in flattened(path.commands) for point in piece]
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return Box(min(xs), min(ys), max(xs), max(ys))


class Taken:
    """The cells that lines and areas cover."""

    def __init__(self) -> None:
        self._cells: set[tuple[int, int]] = set()
        self._rows: dict[int, list[int]] = {}
        """The columns of each row, in order: made when cells in a box are counted, until more are taken."""

    def add(self, paths: Iterable[Path]) -> None:
        """Take the cells under the lines of paths, and inside their areas."""
        for path in paths:
            pieces = list(flattened(path.commands))
            for a, b in pieces:
                self.add_line(a, b)
            if path.fill is not None:
                self._fill(pieces)

    def add_line(self, a: Point, b: Point) -> None:
        """Take the cells under a line."""
        self._rows = {}
        steps = max(1, math.ceil(math.dist(a, b) / (CELL * 0.7)))
        for k in range(steps + 1):
            t = k / steps
            self._cells.add(_cell((a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t)))

    def _fill(self, pieces: list[tuple[Point, Point]]) -> None:
        """Take the cells whose middle is inside, by counting the edges to its left."""
        self._rows = {}
        heights = [y for piece in pieces for _, y in piece]
        for row in range(math.floor(min(heights) / CELL), math.floor(max(heights) / CELL) + 1):
            y = (row + 0.5) * CELL
            crossings = sorted(
                a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
                for a, b in pieces
                if (a[1] > y) != (b[1] > y)
            )
            for left, right in zip(crossings[::2], crossings[1::2], strict=False):
                for column in range(math.floor(left / CELL), math.floor(right / CELL) + 1):
                    self._cells.add((column, row))

    def on_line(self, a: Point, b: Point) -> float:
        """The part of a line that runs over what is taken."""
        return self.cells_on(a, b) / (_steps(a, b) + 1)

    def cells_on(self, a: Point, b: Point) -> int:
        """How many of the steps of a line, a cell long, are on what is taken."""
        steps = _steps(a, b)
        x, y = (b[0] - a[0]) / steps, (b[1] - a[1]) / steps
        return sum(_cell((a[0] + x * k, a[1] + y * k)) in self._cells for k in range(steps + 1))

    def inside(self, box: Box) -> int:
        """How many taken cells a box touches."""
        first, last = math.floor(box.left / CELL), math.floor(box.right / CELL)
        rows = self._in_rows()
        return sum(
            bisect_right(columns, last) - bisect_left(columns, first)
            for row in range(math.floor(box.top / CELL), math.floor(box.bottom / CELL) + 1)
            if (columns := rows.get(row))
        )

    def _in_rows(self) -> dict[int, list[int]]:
        if not self._rows:
            for column, row in sorted(self._cells):
                self._rows.setdefault(row, []).append(column)
        return self._rows


def _steps(a: Point, b: Point) -> int:
    return max(1, math.ceil(math.dist(a, b) / CELL))


def _cell(point: Point) -> tuple[int, int]:
    return math.floor(point[0] / CELL), math.floor(point[1] / CELL)
