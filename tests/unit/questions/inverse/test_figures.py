"""The drawings beside the steps of inverse kinematics."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.document.figures import Figure, LineKind
from dynsolve.notation.unicode import to_unicode

ELBOWS = {
    "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]": ["l₁", "l₂"],
    "dh: [{theta: q1*, a: b}, {theta: q2*, a: a}]": ["b", "a"],
    "convention: modified\ndh: [{theta: q1*}, {theta: q2*, a: b}, {a: a}]": ["b", "a"],
    "dh: [{theta: q1*, a: l, alpha: 90deg}, {theta: q2*, a: l}, {theta: q3*, a: h}]": ["l", "h"],
}


@pytest.mark.parametrize("arm", ELBOWS)
def test_the_length_before_the_elbow_comes_first_in_the_law_of_cosines(arm: str) -> None:
    solution = dynsolve.solve(f"gravity: none\n{arm}\nfind: [inverse]\n")
    (figure,) = (
        figure
        for step in solution.steps
        if isinstance(figure := step.figure, Figure) and "law of cosines" in figure.caption
    )
    lengths = [line for line in figure.lines if line.kind is LineKind.LENGTH]
    assert [to_unicode(line.name) for line in lengths if line.name] == ELBOWS[arm]
    assert lengths[0].end == (0.0, 0.0) and lengths[0].start == lengths[1].end == figure.angles[0].at
