"""How a robot's formulas look: the shorthands s_1 and c_12, decimal numbers."""

from __future__ import annotations

from collections import Counter

from dynsolve.algebra.rationals import fraction
from dynsolve.notation.names import split
from dynsolve.notation.printing import Style, decimal_text
from dynsolve.robot.model import JointType, Robot


def style_of(robot: Robot) -> Style:
    """The style of a robot: s_1 for sin θ_1 unless something else is called like one of these."""
    subscripts = {
        q.name: ",".join(split(q.name)[1]) for q in robot.coordinates if q.type is JointType.REVOLUTE
    }
    counts = Counter(subscripts.values())
    taken = set(robot.parameters) | {q.name for q in robot.coordinates}
    shorthand = {name: s for name, s in subscripts.items() if s and counts[s] == 1}
    if any({f"s{s}", f"c{s}"} & taken for s in shorthand.values()):
        shorthand = {}  # no cos(q_1) beside c_3
    numeric = bool(robot.bodies) and all(body.mass.is_number for body in robot.bodies)
    return Style(shorthand=shorthand, star=True, decimal=numeric)


DIGITS = 4
"""The significant digits of numbers that are no exact decimals, unless the problem gives more."""


def shown_digits(robot: Robot) -> int:
    """The digits with which numbers are shown: as many as the longest number of the problem has.

    >>> from dynsolve.problem import load
    >>> from dynsolve.problem.library import find
    >>> shown_digits(load(find("numeric-2r")).robot)
    4
    """
    given = [*(e for joint in robot.joints for e in (joint.d, joint.a)), *robot.gravity.entries]
    given += [e for body in robot.bodies for e in (body.mass, *body.center.entries)]
    numbers = (fraction(factor) for expr in given for factor in expr.poly.to_dict().values())
    texts = (decimal_text(number.numerator, number.denominator) or "" for number in numbers)
    return max([DIGITS, *(len(text.replace(".", "").lstrip("-0")) for text in texts)])
