"""The stages: in the order of the textbook, each called by one word, and listed so for students."""

from __future__ import annotations

import re

import pytest

from dynsolve.quantities.stages import COURSE, Stage
from tests.support import ROOT


def test_the_page_for_students_lists_them_in_their_order() -> None:
    page = " ".join((ROOT / "problems/students.md").read_text(encoding="utf-8").split())
    (listed,) = re.findall(r"One stage alone, or a range of them \(([^)]*)\)", page)
    assert listed.split(", ") == [str(stage) for stage in Stage]


@pytest.mark.parametrize("stage", Stage)
def test_a_stage_is_its_word_and_has_a_heading(stage: Stage) -> None:
    assert Stage(str(stage)) is stage
    assert stage.heading and stage.heading[0].isupper()


def test_what_a_robot_without_masses_has() -> None:
    assert [stage for stage in COURSE if not stage.needs_masses] == ["kinematics", "jacobian"]
