"""The last link of a modified table, which ends at no origin: it is drawn from o_n past its mass centre."""

from __future__ import annotations

from itertools import pairwise

from dynsolve.draw.skeleton import MassCenter, Skeleton, is_open
from dynsolve.draw.vectors import NEAR, Vector, along, distance, dot, subtract, unit
from dynsolve.robot.model import Robot

_ALIKE = 1 - 1e-6
"""The cosine from which two directions are one."""


def last_links(robot: Robot, pose: Skeleton, beyond: float) -> tuple[tuple[Vector, Vector], ...]:
    """From the last origin of a chain to the mass centre on an axis there, and `beyond` it, but for a point.

    A body with a shape is drawn itself, and a centre off all axes does not say which way the link runs.
    """
    shaped = {body.name for body in robot.bodies if body.shape is not None}
    found = []
    for mass in pose.masses:
        origin = pose.frames[mass.link].origin
        if is_open(robot, mass.link) and _is_beside(mass, origin, pose):
            way = unit(subtract(mass.center, origin))
            end = mass.center if mass.is_point or mass.name in shaped else along(mass.center, way, beyond)
            found.append((origin, end))
    return tuple(found)


def _is_beside(mass: MassCenter, origin: Vector, pose: Skeleton) -> bool:
    """Whether a mass centre is on an axis of its frame, away from its origin, where no link is yet."""
    if distance(mass.center, origin) < NEAR:
        return False
    way = unit(subtract(mass.center, origin))
    links = (b if distance(a, origin) < NEAR else a for a, b in pairwise(pose.path) if _touches(a, b, origin))
    return any(abs(dot(way, axis)) > _ALIKE for axis in pose.frames[mass.link].axes) and all(
        dot(way, unit(subtract(other, origin))) < _ALIKE for other in links
    )


def _touches(a: Vector, b: Vector, point: Vector) -> bool:
    """Whether a way begins or ends at a point."""
    return distance(a, point) < NEAR or distance(b, point) < NEAR
