"""Linkages that a table with branches opens: an end of one branch that stays at one place of another's link.

The table of a five-bar linkage with a parallelogram says nothing of the joint between its links 3 and 4;
it is found because o_3 keeps its coordinates in frame 4, whatever the angles and the lengths are.
"""

from __future__ import annotations

from dynsolve.draw.drawn_lengths import generic_numbers
from dynsolve.draw.skeleton import DrawnFrame, Skeleton, skeleton
from dynsolve.draw.vectors import NEAR, Vector, distance, into, subtract
from dynsolve.robot.model import Robot, path_to

_PROBES = (0.3, 1.1, -0.7)


def closing_links(robot: Robot, pose: Skeleton) -> tuple[tuple[Vector, Vector], ...]:
    """What closes the loops of a linkage: from the start of a link to the end of a branch that it holds."""
    if all(joint.parent == joint.index - 1 for joint in robot.joints):
        return ()
    lengths = generic_numbers(robot)
    probes = [
        skeleton(robot, lengths, [start * (1.0 + 0.61 * k) for k in range(robot.n)]).frames
        for start in _PROBES
    ]
    on_the_way = {joint.parent for joint in robot.joints}
    ends = [joint.index for joint in robot.joints if joint.index not in on_the_way]
    return tuple(
        (pose.legs[link - 1].start, pose.frames[end].origin)
        for end in ends
        for link in range(1, len(robot.joints) + 1)
        if _are_apart(robot, end, link) and _stays(probes, end, link)
    )


def _are_apart(robot: Robot, end: int, link: int) -> bool:
    """Whether a link is not on the way from the base to an end."""
    return all(joint.index != link for joint in path_to(robot.joints, end))


def _stays(probes: list[tuple[DrawnFrame, ...]], end: int, link: int) -> bool:
    """Whether the origin of one frame has the same coordinates in another frame in all poses."""
    first, *others = (
        into(frames[link].axes, subtract(frames[end].origin, frames[link].origin)) for frames in probes
    )
    return all(distance(first, other) < NEAR for other in others)
