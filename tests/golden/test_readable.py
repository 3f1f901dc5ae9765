"""Printed results are no longer than a textbook's, or shorter than what any other program prints."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.counting import operations
from tests.support import ROOT, solve_json

PUBLISHED = json.loads((Path(__file__).parent / "published.json").read_text(encoding="utf-8"))
BOOK = {
    "planar-2r": "spong-planar-elbow",
    "cartesian-pp": "spong-cartesian",
    "planar-2r-remote": "spong-elbow-remote",
}


@pytest.mark.parametrize(("ours", "theirs"), BOOK.items())
def test_no_longer_than_the_book(ours: str, theirs: str) -> None:
    results = solve_json(ROOT / "problems" / f"{ours}.yaml")["results"]
    for case in PUBLISHED:
        if case["problem"] == theirs:
            count = operations(results[case["quantity"]], inside_functions=False)
            book = operations(case["value"], inside_functions=False)
            assert count <= book, f"{case['quantity']}: {results[case['quantity']]}"


@pytest.mark.parametrize(
    ("problem", "most_in_D", "most_in_C"),
    [("elbow-3r", 67, 160), ("puma560-first3", 260, 380), ("puma560", 13_000, 60_000)],
)
def test_shorter_than_any_program_prints(problem: str, most_in_D: int, most_in_C: int) -> None:
    results = solve_json(ROOT / "problems" / f"{problem}.yaml")["results"]
    assert operations(results["D"]) <= most_in_D
    assert operations(results["C"]) <= most_in_C
