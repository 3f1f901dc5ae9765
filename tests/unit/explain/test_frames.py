"""The steps from a drawing to the table: every choice with its reason, and no result in a hint."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Symbol
from dynsolve.quantities.stages import Stage
from tests.unit.problem.test_drawing import FOUR_JOINTS, OFFSET_ARM, PLANAR, RRRP

DRAWN = "zero: drawn\n"


def steps(text: str) -> dict[str, Step]:
    found = dynsolve.solve(text + DRAWN).steps
    return {step.id: step for step in found if step.stage is Stage.FRAMES}


def words(step: Step) -> str:
    return "".join(part if isinstance(part, str) else "_" for part in step.why)


REASONS = [
    (OFFSET_ARM, "frame0", "that of the world"),
    (OFFSET_ARM, "frame1", "meet, so that _ is 0"),
    (OFFSET_ARM, "frame2", "are skew: they have one common normal"),
    (OFFSET_ARM, "frame3", "The hand lies on the axis of joint 3"),
    (PLANAR, "frame1", "are parallel"),
    (PLANAR, "frame2", "The hand lies beside the axis of joint 2"),
    (FOUR_JOINTS, "frame1", "lie on one line"),
    (RRRP, "frame4", "The axis of joint 4 and the z of the hand lie on one line"),
]


@pytest.mark.parametrize(("text", "frame", "reason"), REASONS)
def test_each_frame_says_how_the_axes_lie(text: str, frame: str, reason: str) -> None:
    assert reason in words(steps(text)[frame])


def test_the_last_axis_and_the_z_of_the_hand_meet_at_the_hand() -> None:
    """Not where d is 0, as for two joints: h is the d of the one, and of the other."""
    turn = "{{turn: {}, about: [0, 0, 1], through: {}}}".format
    turns = f"axes: [{turn('A', '[0, 0, 0]')}, {turn('B', '[l, 0, 0]')}]\n"
    for place, told in (
        ("[l, 0, h]", "lie on one line: _ is the hand, and _, which may point anywhere across, is _."),
        ("[l + a, 0, h]", "are parallel: every line across is a common normal. The one through the hand is"),
    ):
        found = steps(f"{turns}tip: {{at: {place}, z: [0, 0, 1]}}\n")
        assert told in words(found["frame2"]) and "The one with _ = 0 is taken" in words(found["frame1"])
        table = found["DH"].table
        assert table is not None and table.rows[1][2] == Symbol("h")


def test_a_slide_without_a_place_is_told() -> None:
    assert "a slide has no place" in words(steps(FOUR_JOINTS)["axes"])
    assert "a slide has no place" not in words(steps(OFFSET_ARM)["axes"])


def test_the_stage_ends_with_the_table() -> None:
    found = steps(OFFSET_ARM)
    assert list(found) == ["axes", "frame0", "frame1", "frame2", "frame3", "DH"]
    table = found["DH"].table
    assert table is not None and len(table.rows) == 3


def test_a_hint_has_no_result() -> None:
    text = str(dynsolve.solve(OFFSET_ARM + DRAWN).hint("frames"))
    assert "Skew axes have one common normal" in text
    assert "Degrees" not in text


def test_a_robot_with_a_table_has_no_such_stage() -> None:
    assert not [step for step in dynsolve.solve("planar-2r").steps if step.stage is Stage.FRAMES]


def test_coordinates_of_the_table_that_are_not_0_as_drawn_are_told() -> None:
    wrist = """
axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: q2, about: [0, 1, 0], through: [b, 0, c]}
  - {slide: q3, along: [1, 0, 0], through: [b, 0, c + e]}
tip: [b + q3, 0, c + e]
convention: modified
"""
    table = {step.id: step for step in dynsolve.solve(wrist).steps}["DH"]
    assert "In the pose that is drawn, _." in words(table)
    assert "pose that is drawn" not in words(steps(wrist)["DH"])
