"""An arm from a drawing is shown in the pose of the drawing, wherever its joints are counted from."""

from __future__ import annotations

import pytest

from dynsolve.draw.drawn_lengths import numbers
from dynsolve.draw.scene import as_drawn
from dynsolve.draw.skeleton import skeleton
from dynsolve.draw.vectors import dot
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
