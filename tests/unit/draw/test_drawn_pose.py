"""An arm from a drawing is shown in the pose of the drawing, wherever its joints are counted from."""

from __future__ import annotations

import pytest

from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.scene import as_drawn, scene
from dynsolve.draw.skeleton import numbers, orientation, skeleton
from dynsolve.draw.vectors import dot, facing
from dynsolve.problem import read_problem
from tests.unit.problem.test_drawing import FOUR_JOINTS, OFFSET_ARM, RPR, RRRP

AXES = {  # the directions of the joint axes in the files
    OFFSET_ARM: [(0, 0, 1), (0, 1, 0), (1, 0, 0)],
    FOUR_JOINTS: [(0, 0, 1), (0, 0, 1), (1, 0, 0), (0, 1, 0)],
    RRRP: [(0, 0, 1), (0, -1, 0), (0, -1, 0), (0, 0, -1)],
    RPR: [(0, 0, 1), (0, -1, 0), (1, 0, 0)],
}


@pytest.mark.parametrize("zero", ["drawn", "table"])
@pytest.mark.parametrize(("text", "axes"), AXES.items())
def test_the_axes_point_as_they_are_drawn(text: str, axes: list[tuple[int, int, int]], zero: str) -> None:
    problem = read_problem(f"{text}zero: {zero}\n", "drawn.yaml")
    known = numbers(problem)
    q = as_drawn(problem, known)
    assert q is not None
    frames = skeleton(problem.robot, known, q).frames
    assert [round(dot(frame.z, axis), 9) for frame, axis in zip(frames, axes, strict=False)] == [1] * len(
        axes
    )


def test_a_table_has_no_such_pose() -> None:
    problem = read_problem("dh: [{theta: q1*, a: l1}]\n", "own.yaml")
    assert as_drawn(problem, numbers(problem)) is None


PLANES = {  # the axis of both joints, two directions in its plane, and which of them leads to the right
    (0, 0, 1): ("[1, 0, 0]", "[1, 1, 0]", 0),
    (0, 1, 0): ("[1, 0, 0]", "[1, 0, 1]", 0),
    (1, 0, 0): ("[0, 1, 0]", "[0, 1, 1]", 1),
}


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("axis", PLANES)
def test_a_drawing_in_a_plane_is_not_mirrored(axis: tuple[int, int, int], sign: int) -> None:
    """Whichever way its joints turn, and so whichever way z of frame 0 points."""
    elbow, tip, right = PLANES[axis]
    about = [sign * entry for entry in axis]
    turns = (f"{{turn: q{i}, about: {about}, through: {at}}}" for i, at in ((1, "[0, 0, 0]"), (2, elbow)))
    problem = read_problem(f"axes: [{', '.join(turns)}]\ntip: {tip}\n", "plane.yaml")
    known = numbers(problem)
    world = orientation(problem.robot, known, drawn=True)
    assert world.normal is not None
    view = facing(world.normal, world.up)
    assert view.right[right] == pytest.approx(1.0) and max(view.up) == pytest.approx(1.0)
    pose = best_pose(problem.robot, known, world, as_drawn(problem, known))
    first, last = (
        pose.view.point(frame.origin) for frame in (pose.skeleton.frames[0], pose.skeleton.frames[-1])
    )
    assert scene(problem).paths and last[0] > first[0] and last[1] < first[1]
