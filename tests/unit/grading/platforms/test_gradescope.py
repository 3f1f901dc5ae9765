"""Gradescope gets `results.json`, as its "Autograder Specifications" describe it."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema

from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from tests.unit.grading.platforms.marked import RESULTS, exported, graded


def test_gradescope_gets_one_result_a_submission(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, {"s7": ("submission_7", "4", "2"), "s8": ("submission_7", "4", "2"), "x": ("", "0", "1")})
    assert exported(tmp_path, problems, record, "gradescope") == ()
    places = sorted(path.parent.name for path in tmp_path.glob("gradescope/*/results.json"))
    assert places == ["submission_7", "x"]
    for path in tmp_path.glob("gradescope/*/results.json"):
        results = json.loads(path.read_text())
        jsonschema.validate(results, RESULTS)
        assert results["score"] == sum(test["score"] for test in results["tests"])
    results = json.loads((tmp_path / "gradescope" / "submission_7" / "results.json").read_text())
    told = [(test["number"], test["name"], test["score"], test["max_score"]) for test in results["tests"]]
    assert told == [("1.1", "K", 4, 4), ("1.2", "g", 2, 2)]
    graded(record, {"s7": ("submission_7", "4", "2"), "s8": ("submission_7", "4", "1")})
    (tmp_path / "grades.sqlite").touch()
    warnings = exported(tmp_path, problems, record, "gradescope")
    assert warnings == ("s8 and s7 share submission_7, and their marks differ",)


def test_what_is_left_of_a_student_who_is_gone_is_removed(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    old = tmp_path / "gradescope" / "submission_1" / "results.json"
    old.parent.mkdir(parents=True)
    old.write_text("{}")
    graded(record, {"s7": ("submission_7", "4", "2")})
    exported(tmp_path, problems, record, "gradescope")
    assert sorted(path.name for path in (tmp_path / "gradescope").iterdir()) == ["submission_7"]
