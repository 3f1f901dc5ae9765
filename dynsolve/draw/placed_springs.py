"""Springs and dampers of bodies that are given by their positions.

One that acts on the distance of two points is drawn between them, one that acts on an angle at that angle.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.draw import paths
from dynsolve.draw.paths import Path
from dynsolve.draw.placed_pose import Place, PlacedPose, Turning
from dynsolve.draw.poses import Notes, draw_spring, spiral, zigzag
from dynsolve.draw.vectors import NEAR, Point, cross, length, moved, unit
from dynsolve.notation.tree import Node

SPRINGS = "A zigzag or a spiral is a spring."
DAMPERS = "A cup with a piston is a damper."
NOT_DRAWN = "Not drawn are springs and dampers on other than an angle or the distance of two points."

_BESIDE = (0.0, 20.0, -20.0, 40.0, -40.0)
_CUP, _HALF = 16.0, 6.0
"""Of a damper: the length of its cup, and half its width."""


def placed_springs(pose: PlacedPose, turning: Sequence[Turning], edge: float, notes: Notes) -> list[str]:
    """Every spring with its stiffness and every damper with its damping; what is to be said of them."""
    actions, compactor = pose.robot.actions, Compactor(pose.robot.ring, decimal=True)
    said = []
    for spring in actions.springs:
        law = spring.law
        name = None if law is None else compactor.form(law.stiffness)
        drawn = law is not None and name is not None and _draw(law.of, name, pose, turning, edge, notes)
        said.append(SPRINGS if drawn else NOT_DRAWN)
    for damper in actions.dampers:
        ends = _ends(damper.of, pose)
        if ends is not None:
            _dashpot(*_apart(*ends, pose, edge, notes), compactor.form(damper.damping), notes)
        said.append(DAMPERS if ends else NOT_DRAWN)
    return list(dict.fromkeys(said))


def _draw(
    of: Expr, name: Node, pose: PlacedPose, turning: Sequence[Turning], edge: float, notes: Notes
) -> bool:
    """Draw a spring where what it is stretched by is seen; whether there is such a place."""
    ends = _ends(of, pose)
    if ends is not None:
        draw_spring(zigzag(*_apart(*ends, pose, edge, notes)), name, notes)
        return True
    ring = pose.robot.ring
    for turned in turning:
        if not ring.has_symbol(turned.name) or not (of * of - ring.symbol(turned.name) ** 2).is_zero:
            continue
        axis = cross(turned.directions[0], turned.directions[-1])
        if length(axis) > NEAR:
            draw_spring(spiral(turned.vertex, unit(axis), pose.view, 1.5 * edge), name, notes)
            return True
    return False


def _ends(of: Expr, pose: PlacedPose) -> tuple[Place, Place] | None:
    """Two points whose distance is `of`, of the origin, the centres and the ends of pieces."""
    ring = pose.robot.ring
    centers = [pieces[-1].end for pieces in pose.ways if pieces]
    places = [*centers, (ring.zero,) * 3, *(piece.end for piece in pose.pieces)]
    for a, b in combinations(dict.fromkeys(places), 2):
        apart = (a[0] - b[0], a[1] - b[1], a[2] - b[2])
        if ring.dot(apart, apart) == of * of:
            return a, b
    return None


def _apart(
    first: Place, second: Place, pose: PlacedPose, edge: float, notes: Notes
) -> tuple[Point, Point, float]:
    """The ends on paper, at the edge of a body, and how far beside their line there is room."""
    a, b = pose.point(first), pose.point(second)
    reach = math.dist(a, b) or 1.0
    way = (b[0] - a[0]) / reach, (b[1] - a[1]) / reach
    centers = {pieces[-1].end for pieces in pose.ways if pieces}
    a, b = (
        moved(a, way, edge if first in centers else 0.0),
        moved(b, way, -edge if second in centers else 0.0),
    )

    def crowded(beside: float) -> float:
        p, q = (moved(moved(end, way, off), (-way[1], way[0]), beside) for end, off in ((a, 5.0), (b, -5.0)))
        return notes.solid.on_line(p, q) + abs(beside) / 1000

    beside = min(_BESIDE, key=crowded)
    notes.solid.add([Path(paths.line(*zigzag(a, b, beside)))])
    return a, b, beside


def _dashpot(a: Point, b: Point, beside: float, name: Node, notes: Notes) -> None:
    """A cup that opens to the second end, and the piston in it."""
    reach = math.dist(a, b) or 1.0
    way = (b[0] - a[0]) / reach, (b[1] - a[1]) / reach
    across = -way[1], way[0]

    def at(along: float, aside: float) -> Point:
        return moved(moved(a, way, along), across, beside + aside)

    middle = reach / 2
    back, front = middle - _CUP / 2, middle + _CUP / 2
    lines = (
        paths.line(a, at(0.0, 0.0), at(back, 0.0)),
        paths.line(at(front, _HALF), at(back, _HALF), at(back, -_HALF), at(front, -_HALF)),
        paths.line(at(middle, _HALF - 2), at(middle, 2 - _HALF)),
        paths.line(at(middle, 0.0), at(reach, 0.0), b),
    )
    notes.draw(*(Path(line, paths.BLACK, 1.4) for line in lines))
    notes.label(name, [at(middle, _HALF), at(middle, -_HALF)], (0.0, 0.0), paths.BLACK, "damper")
