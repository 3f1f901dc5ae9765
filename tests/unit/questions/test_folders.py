"""Every stage that is asked for has its folder, and every record in it is the one that the robot has."""

from __future__ import annotations

import pytest

from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.stages import ASKED_FOR, COURSE, Stage


@pytest.mark.parametrize("stage", ASKED_FOR)
def test_a_question_has_a_chapter_and_the_records_that_a_robot_has(stage: Stage) -> None:
    folder = stage.part()
    assert folder.__name__ == f"dynsolve.questions.{stage}"
    assert stage.part("explain").steps
    assert stage.part("derive") is None or stage.part("check").verify, f"{folder.__path__} has no check.py"
    for family in getattr(folder, "FAMILIES", ()):
        assert any(family is known for known in FAMILIES)
        assert family.stage is stage


def test_a_stage_of_the_course_has_none() -> None:
    assert [stage.part("derive") for stage in COURSE] == [None] * len(COURSE)
