"""What leads from one line of a step to the next, as it is read."""

from __future__ import annotations

from unicodedata import normalize

import dynsolve
from dynsolve.explain.step import Detail
from dynsolve.render.files import Format
from dynsolve.solution.reports import report


def page(problem: str, detail: Detail = Detail.NORMAL) -> str:
    """The worked solution as it stands on a terminal."""
    text = report(dynsolve.solve(problem), Format.TEXT, detail=detail).decode()
    return normalize("NFC", text)


def test_what_columns_of_the_jacobian_use_is_told_before_the_jacobian() -> None:
    _, *led = page("elbow-3r").split("With s₁² + c₁² = 1:\n\n")
    displays = [part.split("\n\n")[0] for part in led]
    assert any("𝐉_v =" in each for each in displays)
    assert not any("𝐨₃ - 𝐨₂" in each for each in displays)
