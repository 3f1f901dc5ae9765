"""What holds of every platform: what nobody has judged stays as it is, and a download goes back."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import jsonschema
import pytest

import dynsolve
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from tests.support import with_files
from tests.unit.grading.platforms.marked import BLANK, ENGLISH, MARKS, RESULTS, TEXT, exported, graded


def _waiting(record: Record, student: str, id: str) -> None:
    """A student whose PDF waits for a human."""
    record.set_intake({**record.students(), student: id}, ())
    unread = {"verdict": "unreadable", "marks": "0", "line": 0, "diagnosis": [], "why": "unreadable"}
    answers = [{**BLANK, **unread, "name": name, "of": str(of)} for name, of in MARKS.items()]
    row = {
        "answers": answers,
        "files": [],
        "left": [],
        "late": 0,
        "reason": "a PDF: a human reads it",
        "notes": [],
    }
    record.write((student, "in3140-rp"), "", "{}", {**row, "html": "", "markdown": ""})


def test_what_nobody_has_judged_keeps_what_stands_there(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, {"a_1": ("1", "4", "2")})
    _waiting(record, "b_2", "2")
    header = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    header += "Last modified (submission),Last modified (grade),Feedback comments"
    rows = [f"Participant {i},Ada,a@x,Submitted,{old},6.00,Yes,-,-," for i, old in ((1, ""), (2, "3.50"))]
    warnings = exported(tmp_path, problems, record, "moodle", "\n".join([header, *rows]) + "\n")
    written = (tmp_path / "moodle.csv").read_text().splitlines()
    assert [line.split(",")[4] for line in written[1:]] == ["6", "3.50"]
    assert "1 student waits for a human and keeps what stands there: b_2 (in3140-rp)" in warnings
    canvas = "Student,ID,Section,Assignment 2 (9)\n    Points Possible,,,6.00\nA,1,,\nB,2,,\n"
    warnings = exported(tmp_path, problems, record, "canvas", canvas)
    assert [line.split(",")[-1] for line in (tmp_path / "canvas.csv").read_text().splitlines()[2:]] == [
        "6",
        "",
    ]
    assert any("b_2" in warning for warning in warnings)
    exported(tmp_path, problems, record, "gradescope")
    assert [path.name for path in (tmp_path / "gradescope").iterdir()] == ["1"]
    for answer in MARKS:
        record.override("b_2", "in3140-rp", answer, "1", "on paper")
    exported(tmp_path, problems, record, "moodle", "\n".join([header, *rows]) + "\n")
    written = (tmp_path / "moodle.csv").read_text().splitlines()
    assert [line.split(",")[4] for line in written[1:]] == ["6", "2"]


RIGHT = "answers:\n  K: (I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n  g: [0, 0]\n"


@pytest.fixture
def set_folder(tmp_path: Path) -> Path:
    folder = tmp_path / "set"
    folder.mkdir()
    (folder / "in3140-rp.yaml").write_text(TEXT)
    (folder / "set.yaml").write_text("title: Assignment 2\nmarks: {in3140-rp: {K: 4, g: 2}}\n")
    return folder


@pytest.mark.slow
def test_a_moodle_download_goes_back_as_a_worksheet_and_pages(tmp_path: Path, set_folder: Path) -> None:
    names = {41: "Ada Lovelace", 42: "Grace Hopper"}
    files = {f"{name}_{id}_assignsubmission_file/hw.yaml": RIGHT for id, name in names.items()}
    roster = tmp_path / "Grades-IN3140-Assignment 2-1234.csv"
    lines = [f"Participant {id},{name},x@y,Submitted,,6.00,Yes,1 May,-," for id, name in names.items()]
    roster.write_text("\n".join([ENGLISH, *lines]) + "\n")
    hand_ins = with_files(tmp_path / "in", files)
    dynsolve.grade(set_folder, hand_ins, tmp_path / "out", lms="moodle", roster=roster)
    dynsolve.override(tmp_path / "out", "Ada Lovelace_41", "in3140-rp", "K", marks=3, why="late idea")
    written = (tmp_path / "out" / "moodle.csv").read_text().splitlines()
    assert [line.split(",")[4] for line in written] == ["Grade", "5", "6"]
    with zipfile.ZipFile(tmp_path / "out" / "moodle-feedback.zip") as packed:
        pages = {name: packed.read(name).decode() for name in packed.namelist()}
    assert list(pages) == [f"{name}_{id}_assignfeedback_file/feedback.html" for id, name in names.items()]
    assert "set by the teacher: late idea" in pages["Ada Lovelace_41_assignfeedback_file/feedback.html"]


@pytest.mark.slow
def test_a_gradescope_export_goes_out_as_results(tmp_path: Path, set_folder: Path) -> None:
    people = "submission_7:\n  :submitters:\n  - :name: Ada\n    :sid: s7\n  - :name: Grace\n    :sid: s8\n"
    files = {
        "assignment_1_export/submission_7/in3140-rp.yaml": RIGHT,
        "assignment_1_export/submission_metadata.yml": people,
    }
    hand_ins = with_files(tmp_path / "in", files)
    grades = dynsolve.grade(set_folder, hand_ins, tmp_path / "out", lms="gradescope")
    assert grades.totals == {"s7": 6, "s8": 6} and grades.warnings == ()
    paths = list((tmp_path / "out" / "gradescope").rglob("results.json"))
    assert [path.parent.name for path in paths] == ["submission_7"]
    results = json.loads(paths[0].read_text())
    jsonschema.validate(results, RESULTS)
    assert results["score"] == 6
