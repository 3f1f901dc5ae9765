"""Two angles of which only the sum or the difference matters: the wrist whose outer axes are one line.

Spong, Hutchinson, Vidyasagar, section 3.3.5 (2006): there are infinitely many solutions, one angle
may be chosen and gives the other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import atan2, cos, degrees, pi, sin

from dynsolve.algebra.surd_angles import SurdAngle
from dynsolve.derivation.reached import CLOSE, gap
from dynsolve.explain.branch_values import decimal
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import Node, Symbol

Task = Callable[[Mapping[str, float]], Sequence[float]]
"""r(q)"""

_EVERY = 15
"""A constant that is a multiple of so many degrees is written as one."""


def linked(
    task: Task, wanted: Sequence[float], q: Mapping[str, float], first: str, second: str
) -> tuple[float, Node] | None:
    """`second` where `first` is 0, and its formula ±first + c; None where there is no such.

    In r(q) the sine and the cosine of `second` stand to the first power alone; all else is as in `q`.
    """
    at = [_angle(task, wanted, {**q, first: place}, second) for place in (0.0, 1.0)]
    for sign in (1, -1):
        if abs(gap("revolute", at[1] - at[0], sign)) < CLOSE:
            own = Symbol(first) if sign > 0 else negated(Symbol(first))
            return at[0], total([own, _constant(at[0])])
    return None


def _angle(task: Task, wanted: Sequence[float], q: Mapping[str, float], name: str) -> float:
    """The angle with which r(q) = u + v cos + w sin comes nearest to what is wanted."""
    ahead, across, behind = (task({**q, name: place}) for place in (0.0, pi / 2, pi))
    u = [(a + b) / 2 for a, b in zip(ahead, behind, strict=True)]
    v = [(a - b) / 2 for a, b in zip(ahead, behind, strict=True)]
    w = [a - b for a, b in zip(across, u, strict=True)]
    left = [a - b for a, b in zip(wanted, u, strict=True)]
    vv, vw, ww, lv, lw = (_dot(a, b) for a, b in ((v, v), (v, w), (w, w), (left, v), (left, w)))
    return atan2(vv * lw - vw * lv, ww * lv - vw * lw)


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _constant(value: float) -> Node:
    steps = round(degrees(value) / _EVERY)
    there = abs(cos(value) - cos(steps * _EVERY * pi / 180)) + abs(
        sin(value) - sin(steps * _EVERY * pi / 180)
    )
    return SurdAngle.of_degrees(steps * _EVERY).node if there < CLOSE else decimal(value)
