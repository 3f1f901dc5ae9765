"""What is said of the steps of inverse kinematics is true of this arm, and of what it is said."""

from __future__ import annotations

from unicodedata import normalize

import dynsolve
from dynsolve.render.files import Format
from dynsolve.solution.reports import report


def told(arm: str) -> str:
    """The worked solution in one line."""
    text = report(dynsolve.solve(f"gravity: none\n{arm}\nfind: [inverse]\n"), Format.TEXT).decode()
    return " ".join(normalize("NFC", text).split())


def test_no_angle_is_free_where_its_sine_and_its_cosine_would_be_0() -> None:
    wrist = """
dh: [{theta: q1*, alpha: 45deg, d: d1}, {theta: q2*, alpha: -45deg}, {theta: q3*, d: e}]
task: pose"""
    text = told(wrist)
    assert "q₁ is free" in text and "q₃ is free" not in text
