"""Links: tubes cut into short pieces, so that each can be sorted by depth, and put together again."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.draw import paths
from dynsolve.draw.bodies import DrawnBody
from dynsolve.draw.body_solids import covers
from dynsolve.draw.parts import TUBE, Parts, is_inside
from dynsolve.draw.paths import Path
from dynsolve.draw.primitives import Solid
from dynsolve.draw.vectors import Point, Vector, between, distance
from dynsolve.draw.view import View

_PIECE = 5.0
"""How long the pieces are that a link is cut into."""


def link_pieces(parts: Parts, view: View, bodies: Sequence[DrawnBody] = ()) -> Iterator[Solid]:
    """The tubes between the parts in pieces, and the elbows between the tubes; nothing inside a body."""
    sink = 0.5 if view.flat else 0.0
    tube = 0
    for number, way in enumerate(parts.links):
        for k, point in enumerate(way):
            if (number or k) and not _hidden(point, parts, view, bodies):
                elbow = Path(paths.circle(view.point(point), TUBE), fill=paths.LINK)
                yield Solid(view.depth(point) - 1e-3 - sink, (elbow,))
            if k:
                tube += 1
                for piece in _tube(way[k - 1], point, view, sink, tube):
                    if not _hidden(between(way[k - 1], point, piece[0]), parts, view, bodies):
                        yield piece[1]


def _hidden(point: Vector, parts: Parts, view: View, bodies: Sequence[DrawnBody]) -> bool:
    """Whether a point of a link is inside a joint or a body."""
    return is_inside(point, parts, view) or covers(bodies, point, view)


def _tube(a: Vector, b: Vector, view: View, sink: float, tube: int) -> Iterator[tuple[float, Solid]]:
    """A straight tube in short pieces, each with the part of the way at which its middle is."""
    if math.dist(view.point(a), view.point(b)) < 0.5:
        return
    pieces = max(1, math.ceil(distance(a, b) * view.size / _PIECE))
    for k in range(pieces):
        part = (k + 0.5) / pieces
        ends = view.point(between(a, b, k / pieces)), view.point(between(a, b, (k + 1) / pieces))
        yield part, Solid(view.depth(between(a, b, part)) - sink, _drawn(*ends), tube, k, k, ends)


def _drawn(a: Point, b: Point) -> tuple[Path, ...]:
    """A straight tube on paper: its area and its two sides."""
    reach = math.dist(a, b)
    x, y = (b[0] - a[0]) / reach, (b[1] - a[1]) / reach
    sides = [
        ((a[0] - s * y * TUBE, a[1] + s * x * TUBE), (b[0] - s * y * TUBE, b[1] + s * x * TUBE))
        for s in (1.0, -1.0)
    ]
    area = paths.polygon([*sides[0], *reversed(sides[1])])
    return (Path(area, None, fill=paths.LINK), *(Path(paths.line(*side)) for side in sides))


def joined(solids: Sequence[Solid]) -> list[Solid]:
    """Solids in order, with the pieces of a tube put together where nothing comes between them."""
    done: list[Solid] = []
    for solid in solids:
        place = _before(done, solid)
        if place is None:
            done.append(solid)
        else:
            done[place] = _merged(done[place], solid)
    return done


def _before(done: Sequence[Solid], solid: Solid) -> int | None:
    """Where the neighbouring piece of a tube stands, if what was drawn since leaves this one free."""
    if solid.tube < 0:
        return None
    box = solid.box
    for place in range(len(done) - 1, -1, -1):
        other = done[place]
        if other.tube == solid.tube and solid.first in (other.first - 1, other.last + 1):
            return place
        if other.tube != solid.tube and box.overlaps(other.box):
            return None
    return None


def _merged(a: Solid, b: Solid) -> Solid:
    if b.first < a.first:
        a, b = b, a
    ends = a.ends[0], b.ends[1]
    return replace(a, paths=_drawn(*ends), last=b.last, ends=ends)
