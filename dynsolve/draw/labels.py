"""Where labels stand: near what they name, on nothing else, and never on one another.

Every label tries places around its anchor, nearest first; all are placed in turn,
and again once the others are known.

The grid of the places on paper that are occupied, so that labels find free ones.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache
from heapq import heappop, heappush
from itertools import combinations
from random import Random

from msgspec import Struct

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.ring import Expr
from dynsolve.draw.paths import LabelLine, Path, flattened
from dynsolve.draw.vectors import Point, from_to, moved, segment_distance, toward
from dynsolve.notation.tree import Node
from dynsolve.robot.model import Robot


def written(robot: Robot) -> Callable[[Expr], Node]:
    """How a label has a value: with the decimals that the file has, 0.35, and l/2 as in the text."""
    return Compactor(robot.ring, decimal=robot.has_decimals, typed=robot.decimals).form


# The grid of the places on paper that are occupied, so that labels find free ones

CELL = 3.0
"""The side of a cell of the grid."""


class Box(Struct, frozen=True):
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
            self._cells.add(_cell(moved(a, from_to(a, b), k / steps)))

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
        if not (cells := self._cells):
            return 0
        steps, floor, (left, top) = _steps(a, b), math.floor, a
        x, y = (b[0] - left) / steps, (b[1] - top) / steps
        on = [(floor((left + x * k) / CELL), floor((top + y * k) / CELL)) for k in range(steps + 1)]
        return sum(map(cells.__contains__, on))

    def inside(self, box: Box) -> int:
        """How many taken cells a box touches."""
        first, last = math.floor(box.left / CELL), math.floor(box.right / CELL)
        if not self._rows:
            for column, row in sorted(self._cells):
                self._rows.setdefault(row, []).append(column)
        return sum(
            bisect_right(columns, last) - bisect_left(columns, first)
            for row in range(math.floor(box.top / CELL), math.floor(box.bottom / CELL) + 1)
            if (columns := self._rows.get(row))
        )


def _steps(a: Point, b: Point) -> int:
    return max(1, math.ceil(math.dist(a, b) / CELL))


def _cell(point: Point) -> tuple[int, int]:
    return math.floor(point[0] / CELL), math.floor(point[1] / CELL)


_ROUNDS = 4
_ORDERS = 24
_SEED = 1955
_DIRECTIONS = tuple(2 * math.pi * k / 16 for k in range(16))
_DISTANCES = (4.0, 8.0, 13.0, 19.0, 27.0, 36.0, 46.0, 60.0, 76.0, 95.0)
_FAR = 16.0
"""The distance from which a thin line leads from a label to what it names."""

_STRUCK = 80.0
"""What each cell under a label costs that something is drawn on."""

_NEAR, _ROOM = 6.0, 2.5
"""What each cell costs that something is drawn on, and that comes nearer to a label than this room."""

_CLOSE, _BARRED = 5.0, 8.0
"""What each cell costs that bars the way from a label to what it names."""

_OVER = 60.0
"""What each cell costs of another length's line that the line of a label runs over."""

_CLASH = 5000.0
"""What it costs that two labels, or a label and the line of another, do not keep off each other."""

_CROSSING = 2.0
"""What the lines of two labels cross, or nearly so, when they come nearer to each other."""

_PASSING = 1.0
"""The least room between a label and the line of another."""

_BESIDE, _ABOVE = 7.0, 2.0
"""The least room between two labels."""


class Wanted(Struct, frozen=True):
    """A label to be placed beside any of its anchors, best in the direction `toward` from it.

    `radius` is how far around an anchor its own symbol reaches.
    """

    node: Node
    line: LabelLine
    anchors: tuple[Point, ...]
    toward: Point
    colour: str
    kind: str
    radius: float = 0.0


class Label(Struct, frozen=True):
    """A label in its place; `lead` is the line to what it names, where it stands far away."""

    node: Node
    line: LabelLine
    box: Box
    colour: str
    kind: str
    lead: tuple[Point, Point] | None = None


class _Place(Struct, frozen=True, cache_hash=True):
    box: Box
    lead: tuple[Point, Point] | None
    cost: float

    def is_clear_of(self, other: _Place) -> bool:
        """Whether two labels and their lines keep off each other."""
        return not (
            self.box.overlaps(other.box, _BESIDE, _ABOVE)
            or (other.lead and self.box.grown(_PASSING).meets(*other.lead))
            or (self.lead and other.box.grown(_PASSING).meets(*self.lead))
            or (self.lead and other.lead and segment_distance(self.lead, other.lead) < _CROSSING)
        )


def place(wanted: Sequence[Wanted], taken: Taken, lengths: Taken | None = None) -> tuple[Label, ...]:
    """Place labels: in several orders, of which the best is taken; their lines keep off those of lengths."""
    options = [_Options(_cheapest_first(label, taken, lengths or Taken())) for label in wanted]
    clear = cache(_Place.is_clear_of)
    random = Random(_SEED)  # noqa: S311 - the same orders every time are wanted
    order = list(range(len(wanted)))
    tried = []
    for _ in range(_ORDERS):
        chosen = _placed(options, order, clear)
        tried.append((_total(chosen, clear), chosen))
        order = sorted(order, key=lambda _: random.random())
    best = min(tried, key=lambda one: one[0])[1]
    return tuple(
        Label(label.node, label.line, found.box, label.colour, label.kind, found.lead)
        for label, found in zip(wanted, best, strict=True)
    )


class _Options:
    """The places of a label, the cheapest first; each is found when it is first looked at."""

    def __init__(self, places: Iterator[_Place]) -> None:
        self._found: list[_Place] = []
        self._rest = places

    def __iter__(self) -> Iterator[_Place]:
        yield from self._found
        for option in self._rest:
            self._found.append(option)
            yield option


_Clear = Callable[[_Place, _Place], bool]


def _placed(options: Sequence[_Options], order: Sequence[int], clear: _Clear) -> list[_Place]:
    """A place for each label, chosen in an order and again once the others are known."""
    chosen: dict[int, _Place] = {}
    for _ in range(_ROUNDS):
        before = dict(chosen)
        for k in order:
            chosen[k] = _best(options[k], [other for j, other in chosen.items() if j != k], clear)
        if chosen == before:
            break
    return [chosen[k] for k in range(len(options))]


def _total(chosen: Sequence[_Place], clear: _Clear) -> float:
    clashes = sum(not clear(a, b) for a, b in combinations(chosen, 2))
    return round(sum(place.cost for place in chosen) + _CLASH * clashes, 6)


def _best(places: _Options, others: Sequence[_Place], clear: _Clear) -> _Place:
    """The cheapest place that is clear of other labels, else of the most; places come cheapest first."""
    for option in places:
        if all(clear(option, other) for other in others):
            return option
    return min(places, key=lambda option: sum(not clear(option, other) for other in others))


def _cheapest_first(label: Wanted, taken: Taken, lengths: Taken) -> Iterator[_Place]:
    """The places of a label; what lies in the way is looked at only where the distance is not too dear."""
    preferred = math.atan2(label.toward[1], label.toward[0]) if label.toward != (0.0, 0.0) else None
    prices: list[tuple[float, int, Point, float, float]] = []
    for rank, anchor in enumerate(label.anchors):
        for away in _DISTANCES:
            for angle in _DIRECTIONS:
                turn = 0.0 if preferred is None else abs(math.remainder(angle - preferred, 2 * math.pi))
                price = 0.6 * away + 2.2 * turn + 1.5 * rank
                prices.append((price, len(prices), anchor, away, angle))
    waiting: list[tuple[float, int, _Place]] = []
    for price, k, anchor, away, angle in sorted(prices):
        while waiting and waiting[0][0] < round(price, 6):
            yield heappop(waiting)[-1]
        found = _place_at(label, anchor, away, angle, price, taken, lengths)
        heappush(waiting, (found.cost, k, found))
    yield from (found for *_, found in sorted(waiting))


def _place_at(
    label: Wanted, anchor: Point, away: float, angle: float, price: float, taken: Taken, lengths: Taken
) -> _Place:
    """A place with its price and the cost of all that is in the way."""
    box = _beside(anchor, away + label.radius, angle, label.line.width, label.line.height)
    way = _way(anchor, box, label.radius + 3.0)
    barred = taken.cells_on(*way) if away > _CLOSE else 0
    cost = _STRUCK * taken.inside(box) + _NEAR * taken.inside(box.grown(_ROOM)) + _BARRED * barred
    cost += price
    lead = way if away >= _FAR else None
    cost += _OVER * lengths.cells_on(*lead) if lead else 0.0
    return _Place(box, lead, round(cost, 6))


def _beside(anchor: Point, away: float, angle: float, wide: float, high: float) -> Box:
    """A box of this size whose nearest point is that far from its anchor."""
    c, s = math.cos(angle), math.sin(angle)
    return Box.around((anchor[0] + c * (away + wide / 2), anchor[1] + s * (away + high / 2)), wide, high)


def _way(anchor: Point, box: Box, radius: float) -> tuple[Point, Point]:
    """The straight way from an anchor's symbol to a box."""
    end = box.nearest(anchor)
    way = toward(anchor, end)
    start = min(radius, (math.dist(end, anchor) or 1.0) / 2)
    return moved(anchor, way, start), moved(end, way, -2.0)
