"""What a run makes of files that change, of bounds that are passed, and of folders within one another."""

from __future__ import annotations

import csv
import os
from fractions import Fraction
from math import floor
from pathlib import Path

import pytest
from msgspec.structs import replace

import dynsolve
from dynsolve.answers.marks import Policy
from dynsolve.errors import UsageError
from dynsolve.grading import pool as pool_module
from dynsolve.grading import public
from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.record import Record
from dynsolve.grading.run import Done, grade_all
from dynsolve.grading.set_file import ProblemSet, load_set
from dynsolve.grading.uploads import Uploads
from tests.grading.generate import PROBLEMS, course, problem_set
from tests.grading.here import Here
from tests.support import ROOT

pytestmark = pytest.mark.slow

RIGHT = "answers:\n  K: (I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n"
WRONG = "answers:\n  K: 0\n"


@pytest.fixture
def problems(tmp_path: Path) -> ProblemSet:
    folder = tmp_path / "set"
    folder.mkdir()
    (folder / "in3140-rp.yaml").write_text((ROOT / "problems" / "in3140-rp.yaml").read_text())
    (folder / "set.yaml").write_text("marks: {in3140-rp: {K: 4}}\n")
    return load_set(str(folder))


def _run(problems: ProblemSet, record: Record, folder: Path, between: str = "") -> tuple[Done, list[str]]:
    """One run; `between` is what the file becomes after it was listed."""
    uploads = Uploads(folder)
    intake = take_in(problems, uploads)
    if between:
        (folder / "s1" / "a.yaml").write_text(between)
    done = grade_all(problems, uploads, intake, record, Here())
    return done, [f"{a.verdict} {a.fault}".strip() for a in record.answers("s1")]


def test_a_file_that_changes_during_a_run_is_graded_by_the_next(tmp_path: Path, problems: ProblemSet) -> None:
    folder = tmp_path / "in"
    (folder / "s1").mkdir(parents=True)
    (folder / "s1" / "a.yaml").write_text(RIGHT)
    record = Record(tmp_path)
    said = ["unreadable it was changed while it was graded: grade again"]
    assert _run(problems, record, folder, between=WRONG)[1] == said
    (folder / "s1" / "a.yaml").write_text(RIGHT)
    problems = replace(problems, policy=Policy(follow=Fraction(1, 2)))
    assert _run(problems, record, folder) == (Done(1, 1, 0), ["correct"])
    assert _run(problems, record, folder) == (Done(1, 0, 0), ["correct"])
    record.close()


def test_what_went_over_a_bound_is_tried_again_when_that_is_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(public, "LocalPool", pool_module.LocalPool)
    monkeypatch.setattr(pool_module, "MODULE", "tests.grading.heavy_worker")
    monkeypatch.setenv("PYTHONPATH", str(ROOT), prepend=os.pathsep)
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "s1.yaml").write_text(RIGHT + "  P1: 0\n")
    (tmp_path / "in" / "s2.yaml").write_text(RIGHT)
    words = ("in3140-rp", tmp_path / "in", tmp_path / "out")
    assert dynsolve.grade(*words, jobs=1, timeout=1).computed == 2
    rows = csv.DictReader((tmp_path / "out" / "answers.csv").read_text().splitlines())
    found = {(row["student"], row["answer"]): row["verdict"] for row in rows}
    assert (found["s1", "P1"], found["s1", "K"], found["s2", "K"]) == ("unreadable", "correct", "correct")
    assert dynsolve.grade(*words, jobs=1, timeout=1).computed == 0
    monkeypatch.undo()
    again = dynsolve.grade(*words, jobs=1, timeout=2, diff=True)
    assert again.computed == 1


def test_results_among_the_hand_ins_are_not_handed_in(tmp_path: Path) -> None:
    (tmp_path / "s1.yaml").write_text(RIGHT)
    for _ in range(2):
        assert set(dynsolve.grade("in3140-rp", tmp_path, tmp_path / "results", jobs=1).totals) == {"s1"}
    with pytest.raises(UsageError, match="is the folder of the hand-ins"):
        dynsolve.grade("in3140-rp", tmp_path, tmp_path / "results" / "..", jobs=1)


def test_nothing_handed_in_is_no_fault(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    grades = dynsolve.grade("in3140-rp", tmp_path / "in", tmp_path / "out", jobs=1)
    assert (grades.hand_ins, grades.totals) == (0, {})
    assert (tmp_path / "out" / "grades.csv").read_text() == "student,in3140-rp,total,of\n"


def test_of_very_many_files_a_few_are_named(tmp_path: Path) -> None:
    (tmp_path / "in" / "s1").mkdir(parents=True)
    for i in range(300):
        (tmp_path / "in" / "s1" / f"{i:03d}.png").touch()
    grades = dynsolve.grade("in3140-rp", tmp_path / "in", tmp_path / "out", jobs=1)
    assert len(grades.waiting) == 300
    page = (tmp_path / "out" / "feedback" / "s1" / "in3140-rp.md").read_text()
    assert "002.png" in page and "and 297 more" in page and "003.png" not in page


def test_results_that_cannot_be_written_are_said(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "out").write_text("a file")
    with pytest.raises(UsageError, match="out is a file; name a folder for the results"):
        dynsolve.grade("in3140-rp", tmp_path / "in", tmp_path / "out", jobs=1)


def test_the_marks_of_answers_are_the_grades(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    text = (
        (tmp_path / "set" / "set.yaml")
        .read_text()
        .replace(
            "policy: {follow: 1/2, hints: 2}",
            "policy: {follow: 1/3, rounding: 0.25, late: 0.8, caps: {energy: 5, vectorized: 7/2}}",
        )
    )
    (tmp_path / "set" / "set.yaml").write_text(text)
    course(tmp_path / "in", 12, seed=3)
    for i in range(0, 12, 4):  # as Canvas names them
        for path in (tmp_path / "in" / f"s{i:05d}").iterdir():
            path.rename(tmp_path / "in" / f"s{i}_LATE_{i}_7_{path.name.partition('_')[2]}")
            path.parent.rmdir()
    (tmp_path / "in" / "pdf").mkdir()
    (tmp_path / "in" / "pdf" / "planar-2r.pdf").write_bytes(b"%PDF")
    grades = dynsolve.grade(tmp_path / "set", tmp_path / "in", tmp_path / "out", jobs=2)
    assert grades.computed == 12
    rows = list(csv.DictReader((tmp_path / "out" / "grades.csv").read_text().splitlines()))
    answers = list(csv.DictReader((tmp_path / "out" / "answers.csv").read_text().splitlines()))
    assert {row["student"] for row in rows} == {row["student"] for row in answers}
    for row in rows:
        mine = [answer for answer in answers if answer["student"] == row["student"]]
        for stem in PROBLEMS:
            earned = sum(Fraction(a["marks"]) for a in mine if a["problem"] == stem)
            if row["student"] in ("s0_0", "s4_4", "s8_8"):  # late, which keeps 80 %
                earned = Fraction(floor(earned * Fraction(4, 5) * 4 + Fraction(1, 2)), 4)
            assert earned == Fraction(row[stem] or 0)  # what nobody has judged is left open
        assert sum(Fraction(row[stem] or 0) for stem in PROBLEMS) == Fraction(row["total"] or 0)
        assert (row["student"] == "pdf") == (not row["planar-2r"])
        assert sum(Fraction(answer["of"]) for answer in mine) == Fraction(row["of"])
        assert all(0 <= Fraction(answer["marks"]) <= Fraction(answer["of"]) for answer in mine)
    assert any("LATE" not in row["student"] and "." in row["total"] for row in rows)
