"""What is said of a table: how its coordinates are counted, and what a wrong cell does instead."""

from __future__ import annotations

from math import degrees

from dynsolve.answers.judging.mechanism.comparison import NO_VALUE, OwnCoordinate, TableComparer
from dynsolve.answers.judging.mechanism.matching import Mismatch
from dynsolve.answers.judging.mechanism.repairs import Repair
from dynsolve.answers.judging.mechanism.tables import Table
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import to_unicode

THETA, D, A, ALPHA = range(4)


def written(node: Node) -> str:
    """A cell as it is shown."""
    return to_unicode(node)


def counted(q: OwnCoordinate) -> str:
    """How a student counts a coordinate: `your θ₂ is -θ₂ + 90° of the robot's`."""
    name = to_unicode(Symbol(q.name))
    if q.offset == 0:
        return f"{name} is counted the other way"
    own = f"-{name}" if q.sense < 0 else name
    if q.offset is None or q.is_length:
        return f"{name} is counted from elsewhere" + (" and the other way" if q.sense < 0 else "")
    sign = "-" if q.offset < 0 else "+"
    return f"{name} is counted otherwise: yours is {own} {sign} {abs(q.offset):g}° in the robot's"


def parting(found: Mismatch, joints: int) -> str:
    """Where a table leaves the robot's mechanism."""
    what = "the hand" if found.joint >= joints else f"the axis of joint {found.joint + 1}"
    return f"{what} has another direction" if found.reason == "direction" else f"{what} lies elsewhere"


def effect(comparer: TableComparer, table: Table, repair: Repair) -> str:
    """What the row does with the cell as it is."""
    before, after = _joints(comparer, table, repair.row)
    yours, needed = written(repair.yours), written(repair.needed)
    match repair.column:
        case column if column == ALPHA:
            angles = [_acute(comparer, node) for node in (repair.yours, repair.needed)]
            if angles[0] == angles[1]:
                return f"With yours {after} points the opposite way."
            now, then = map(_lie, angles)
            return f"α is the angle from {before} to {after}: with yours they are {now}, and they are {then}."
        case column if column == A:
            return (
                f"a is the distance from {before} to {after}: with yours it is {yours}, and it is {needed}."
            )
        case column if column == D:
            return f"d is the way along {before}: with yours {after} is reached after {yours}, not {needed}."
    return f"θ turns x about {before}: with yours all that follows is turned by {yours}, not {needed}."


def _joints(comparer: TableComparer, table: Table, row: int) -> tuple[str, str]:
    """The axes that a row leads from and to."""
    moving = sum(other.variable is not None for other in table[: row + 1])
    is_fixed = table[row].variable is None
    n = len(comparer.joints)

    def named(k: int) -> str:
        return (
            f"the axis of joint {k}" if 1 <= k <= n else "the z of the hand" if k > n else "the z of frame 0"
        )

    if comparer.modified:
        return (named(moving), named(moving + 1)) if is_fixed else (named(moving - 1), named(moving))
    return named(moving), named(moving + 1)


def _acute(comparer: TableComparer, node: Node) -> float | None:
    """An angle between lines in degrees, 0 to 180, without its sign; None where it has no value."""
    try:
        value = degrees(float(evaluate(node, comparer.letters[0])))
    except NO_VALUE:
        return None
    return round(abs((value + 180) % 360 - 180), 6)


def _lie(angle: float | None) -> str:
    if angle is None:
        return "at an angle that is not known"
    return {0.0: "parallel", 90.0: "perpendicular", 180.0: "opposite"}.get(angle, f"at {angle:g}°")
