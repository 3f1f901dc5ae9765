"""How a robot's formulas look: the shorthands s_1 and c_12, decimal numbers."""

from __future__ import annotations

from collections import Counter

from dynsolve.notation.names import split
from dynsolve.notation.printing import Style
from dynsolve.robot.model import JointType, Robot


def style_of(robot: Robot) -> Style:
    """The style of a robot: s_1 for sin θ_1 unless something else is called that."""
    subscripts = {
        q.name: ",".join(split(q.name)[1]) for q in robot.coordinates if q.type is JointType.REVOLUTE
    }
    counts = Counter(subscripts.values())
    taken = set(robot.parameters) | {q.name for q in robot.coordinates}
    shorthand = {
        name: subscript
        for name, subscript in subscripts.items()
        if subscript and counts[subscript] == 1 and not {f"s{subscript}", f"c{subscript}"} & taken
    }
    numeric = bool(robot.bodies) and all(body.mass.is_number for body in robot.bodies)
    return Style(shorthand=shorthand, star=True, decimal=numeric)
