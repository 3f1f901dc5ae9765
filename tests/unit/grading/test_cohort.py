"""What waits for a human: what a human has something to say to."""

from __future__ import annotations

from pathlib import Path

import dynsolve
from dynsolve.grading.cohort import queue
from dynsolve.grading.record import Record
from dynsolve.problem.reader import find

HALF_K2 = """answers:
  K1: I1zz*theta1'^2/2
  K2: m2*(L2'^2 + L2^2*theta1'^2)/4
  tau1: 0
"""
BODY_LOST = """answers:
  K: I1zz*theta1'^2/2
  dLdqd1: I1zz*theta1'
  tau1: I1zz*theta1''
"""


def test_a_whole_waits_in_its_parts_and_a_loss_where_it_costs_marks(tmp_path: Path) -> None:
    """K is wrong in its part K2, whose slip is told; dLdqd1 and tau1 lost a body, tau1 alone has marks."""
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "parts.yaml").write_text(HALF_K2)
    (tmp_path / "in" / "lost.yaml").write_text(BODY_LOST)
    (tmp_path / "set").mkdir()
    (tmp_path / "set" / "in3140-rp.yaml").write_text(find("in3140-rp").read_text())
    (tmp_path / "set" / "set.yaml").write_text("marks: {in3140-rp: {K: 4, tau1: 2}}\n")
    dynsolve.grade(tmp_path / "set", tmp_path / "in", tmp_path / "out", jobs=1)
    record = Record(tmp_path / "out")
    waits = queue(record, ("in3140-rp",))
    record.close()
    assert [(w.student, w.what, w.why) for w in waits] == [
        ("lost", "tau1", "follows, but body 2 is lost on the way")
    ]
