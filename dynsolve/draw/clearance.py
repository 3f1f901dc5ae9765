"""How clear of all else the mark of a mass centre is on paper, and the line that leads to it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from dynsolve.draw.parts import RADIUS
from dynsolve.draw.pose import AXIS, Pose
from dynsolve.draw.skeleton import MassCenter
from dynsolve.draw.vectors import NEAR, Point, distance, point_to_segment

_MARK = 12.0
"""How much farther two marks are to be apart than a mark and a line."""

_GROUND = 50.0
"""The radius of the place where the base stands."""

_RING = 0.5 * RADIUS
"""By how much the arrow around a joint reaches beyond its body, nearly."""


def clearance(pose: Pose, mass: MassCenter, others: Sequence[MassCenter]) -> float:
    """The least distance on paper to axes, links, joints and other marks, in picture units.

    The line from the origin of the link is to keep off the tips of the axes there, too.
    """
    view = pose.view
    center = view.point(mass.center)
    found = [math.dist(center, view.point(other.center)) - _MARK for other in others]
    found += [math.dist(center, view.point(joint.center)) - RADIUS - _RING for joint in pose.parts.joints]
    found += [point_to_segment(center, *segment) for segment in _links(pose)]
    found.append(math.dist(center, view.point(pose.parts.ground)) - _GROUND)
    frame = pose.skeleton.frames[mass.link]
    origin = view.point(frame.origin)
    for start, tip in _axes(pose):
        found.append(point_to_segment(center, start, tip))
        if math.dist(start, origin) < NEAR:
            found.append(point_to_segment(tip, origin, center))
    return min(found)


def _axes(pose: Pose) -> Iterator[tuple[Point, Point]]:
    for frame in pose.skeleton.frames:
        start = pose.view.point(frame.origin)
        for axis in (frame.x, frame.z):
            x, y = pose.view.direction(axis)
            yield start, (start[0] + x * AXIS, start[1] + y * AXIS)


def _links(pose: Pose) -> Iterator[tuple[Point, Point]]:
    for way in ((leg.foot, leg.head, leg.end) for leg in pose.skeleton.legs):
        for a, b in pairwise(way):
            if distance(a, b) > NEAR:
                yield pose.view.point(a), pose.view.point(b)
