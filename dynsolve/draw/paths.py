"""Paths with their colours: the elements of a picture on paper, the same for every format."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from dynsolve.draw.vectors import Point

Command = tuple[str, tuple[Point, ...]]
"""A letter and its points: M and L with one, C (a Bézier curve) with three, Z with none."""

Commands = tuple[Command, ...]

BLACK = "#1a1a1a"
GREY = "#8a929c"
WHITE = "#ffffff"
SIDE = "#cfd8e3"
CAP = "#edf2f8"
DARK_SIDE = "#b3c0d0"
LINK = "#e3e7ec"
FRAME = "#1f5fa8"
VARIABLE = "#b3321c"


@dataclass(frozen=True, slots=True)
class Path:
    """A line, an area or both; a colour is `#rrggbb`, None for none."""

    commands: Commands
    stroke: str | None = BLACK
    width: float = 1.1
    fill: str | None = None
    dashed: bool = False


def line(*points: Point) -> Commands:
    """A line through points."""
    return (("M", (points[0],)), *(("L", (point,)) for point in points[1:]))


def polygon(points: Sequence[Point]) -> Commands:
    """A closed line through points."""
    return (*line(*points), ("Z", ()))


def arc(center: Point, first: Point, second: Point, start: float, end: float, move: bool = True) -> Commands:
    """The part of the ellipse center + first·cos t + second·sin t from t = start to end, in radians."""
    steps = max(1, math.ceil(abs(end - start) / (math.pi / 2) - 1e-9))
    step = (end - start) / steps
    pull = 4.0 / 3.0 * math.tan(step / 4.0)
    commands: list[Command] = []
    for k in range(steps):
        a, b = start + k * step, start + (k + 1) * step
        p, q = on_ellipse(center, first, second, a), on_ellipse(center, first, second, b)
        p_rate, q_rate = _rate(first, second, a), _rate(first, second, b)
        if k == 0:
            commands.append(("M" if move else "L", (p,)))
        commands.append(
            (
                "C",
                (
                    (p[0] + pull * p_rate[0], p[1] + pull * p_rate[1]),
                    (q[0] - pull * q_rate[0], q[1] - pull * q_rate[1]),
                    q,
                ),
            )
        )
    return tuple(commands)


def on_ellipse(center: Point, first: Point, second: Point, t: float) -> Point:
    """center + first·cos t + second·sin t"""
    c, s = math.cos(t), math.sin(t)
    return center[0] + first[0] * c + second[0] * s, center[1] + first[1] * c + second[1] * s


def _rate(first: Point, second: Point, t: float) -> Point:
    c, s = math.cos(t), math.sin(t)
    return second[0] * c - first[0] * s, second[1] * c - first[1] * s


def ellipse(center: Point, first: Point, second: Point) -> Commands:
    """The whole ellipse center + first·cos t + second·sin t."""
    return (*arc(center, first, second, 0.0, 2 * math.pi), ("Z", ()))


def circle(center: Point, radius: float) -> Commands:
    """A circle."""
    return ellipse(center, (radius, 0.0), (0.0, radius))


def head(tip: Point, direction: Point, size: float = 9.0) -> Commands:
    """The head of an arrow that points along `direction`."""
    reach = math.hypot(*direction) or 1.0
    x, y = direction[0] / reach, direction[1] / reach
    back = (tip[0] - x * size, tip[1] - y * size)
    half = size * 0.34
    return polygon([tip, (back[0] - y * half, back[1] + x * half), (back[0] + y * half, back[1] - x * half)])


def flattened(commands: Commands) -> Iterator[tuple[Point, Point]]:
    """The straight pieces that a path is near to."""
    start = here = (0.0, 0.0)
    for letter, points in commands:
        if letter == "M":
            start = here = points[0]
        elif letter == "Z":
            yield here, start
            here = start
        elif letter == "L":
            yield here, points[0]
            here = points[0]
        else:
            curve = [_bezier(here, points, k / 6) for k in range(7)]
            yield from pairwise(curve)
            here = points[2]


def _bezier(a: Point, points: tuple[Point, ...], t: float) -> Point:
    b, c, d = points
    s = 1.0 - t
    k0, k1, k2, k3 = s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t
    return (
        k0 * a[0] + k1 * b[0] + k2 * c[0] + k3 * d[0],
        k0 * a[1] + k1 * b[1] + k2 * c[1] + k3 * d[1],
    )
