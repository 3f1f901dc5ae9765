"""Uniform bodies as solids: what of them lies inside a joint is left out."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby

from dynsolve.draw.bodies import DrawnBody, Form
from dynsolve.draw.parts import Parts, is_inside
from dynsolve.draw.primitives import BODY, Solid, ball, block, drum, nearer
from dynsolve.draw.vectors import Vector, along, dot, subtract
from dynsolve.draw.view import View

_STEP = 2.0
"""How finely a body is looked through for joints, in picture units."""

_SHORTEST = 6.0
"""What is left of a body between two joints, and is shorter, is not drawn."""


def body_solids(bodies: Sequence[DrawnBody], parts: Parts, view: View, up: Vector) -> Iterator[Solid]:
    """Every body, in as many pieces as joints and thicker bodies leave of it."""
    sink = 0.4 if view.flat else 0.0  # in a plane joints lie on bodies, and bodies on links
    for body in bodies:
        halves = list(body.on_paper(view.size))
        if body.form is Form.BALL:
            yield ball(body.center, halves[0], view, up, BODY)
            continue
        lengthwise = max(range(3), key=lambda k: halves[k])
        thicker = [other for other in bodies if _thickness(other, view) > _thickness(body, view)]
        for start, end in _pieces(body, lengthwise, halves[lengthwise], parts, thicker, view):
            center = along(body.center, body.axes[lengthwise], view.space((start + end) / 2))
            halves[lengthwise] = (end - start) / 2
            yield nearer(_piece(body, center, halves, view, up), -sink)


def _piece(body: DrawnBody, center: Vector, halves: Sequence[float], view: View, up: Vector) -> Solid:
    if body.form is Form.BOX:
        return block(center, body.axes, halves, view, up, BODY)
    across = halves[(body.main + 1) % 3]
    return drum(center, body.axes[body.main], across, halves[body.main], view, BODY)


def _pieces(
    body: DrawnBody,
    lengthwise: int,
    half: float,
    parts: Parts,
    thicker: Sequence[DrawnBody],
    view: View,
) -> Iterator[tuple[float, float]]:
    """From where to where a body is outside of joints and thicker ones, along its longest side, on paper."""
    steps = max(1, math.ceil(2 * half / _STEP))
    width = 2 * half / steps

    def hidden(k: int) -> bool:
        middle = along(body.center, body.axes[lengthwise], view.space(-half + (k + 0.5) * width))
        return is_inside(middle, parts, view) or covers(thicker, middle, view)

    for inside, run in groupby(range(steps), hidden):
        places = list(run)
        if not inside and (len(places) * width >= _SHORTEST or len(places) == steps):
            yield -half + places[0] * width, -half + (places[-1] + 1) * width


def _thickness(body: DrawnBody, view: View) -> float:
    """The second of its three sides on paper, by size: how thick a long body is."""
    return sorted(body.on_paper(view.size))[1]


def covers(bodies: Sequence[DrawnBody], point: Vector, view: View) -> bool:
    """Whether a point lies in a body."""
    for body in bodies:
        offset = subtract(point, body.center)
        halves = body.on_paper(view.size)
        if all(
            abs(dot(offset, axis)) * view.size < half - 0.5
            for axis, half in zip(body.axes, halves, strict=True)
        ):
            return True
    return False
