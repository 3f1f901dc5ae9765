"""A configuration in round numbers, as an example of what is said of a set of configurations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from math import degrees, radians

from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.notation.walk import names_in
from dynsolve.robot.model import JointType, Robot

_STEP = 15
"""Angles are told in multiples of so many degrees, lengths in whole numbers."""


def example_point(
    robot: Robot,
    formulas: Iterable[Node],
    points: Iterable[Mapping[str, float]],
    holds: Callable[[Mapping[str, float]], bool],
    fails: Callable[[Mapping[str, float]], bool],
) -> str:
    """`At q₁ = 0°, q₂ = 90°`: the first point at which, in round numbers, one still holds, the other not.

    It has the coordinates that stand in some formulas; where there is no such point, it is not told.
    """
    names = names_in(*formulas)
    told = [q for q in robot.coordinates if q.name in names]
    for point in points:
        at, words = dict(point), []
        for q in told:
            value = point[q.name]
            if q.type is JointType.REVOLUTE:
                rounded = round(degrees(value) / _STEP) * _STEP % 360
                at[q.name] = radians(rounded)
            else:
                rounded = round(value)
                at[q.name] = float(rounded)
            words.append(
                f"{to_unicode(Symbol(q.name), PLAIN)} = {rounded}{'°' * (q.type is JointType.REVOLUTE)}"
            )
        if words and holds(at) and not fails(at):
            return f"At {', '.join(words)}"
    return "At some configurations"
