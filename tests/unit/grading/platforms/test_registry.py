"""What all platforms share: exports, who was late; Gradescope."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import jsonschema
import pytest

import dynsolve
from dynsolve.grading.platforms.registry import chosen_roster, keep_platform, late
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from tests.support import with_files
from tests.unit.grading.platforms.marked import BLANK, ENGLISH, MARKS, RESULTS, TEXT, exported, graded

# -- what holds of every platform: what nobody has judged stays as it is, and a download goes back ---


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


# -- what the platforms' lists say of who was late ---------------------------------------------------


def test_moodles_status_says_who_was_late(tmp_path: Path, problems: ProblemSet, record: Record) -> None:
    """As `col_status` of moodle/moodle, `mod/assign/gradingtable.php`, puts it together for a download."""
    status = {
        1: "Submitted for grading - ",
        2: "Submitted for grading - 1 day 2 hours late - Graded",
        3: "No submission - Assignment is overdue by: 3 days late",
        4: "Draft (not submitted) - 5 mins late",
        5: "Submitted for grading - Extension granted until: Friday, 1 May 2026, 12:00 PM",
    }
    rows = [f"Participant {i},Ada,a@x,{said},,6.00,Yes,-,-," for i, said in status.items()]
    header = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    header += "Last modified (submission),Last modified (grade),Feedback comments"
    assert _late(tmp_path, problems, record, "moodle", [header, *rows]) == {"2": 2, "4": 1}


@pytest.mark.parametrize(
    ("said", "days"),
    [
        ("Zur Bewertung abgegeben - 1 Tag 5 Stunden verspätet", 2),
        ("Levert for vurdering - 2 dager for sent", 2),
        ("Inlämnat för bedömning - 3 timmar 5 minuter försenad", 1),
        ("Remis pour évaluation - 2 jours 4 heures de retard", 3),
        ("Enviado para calificar - 1 día 1 hora después", 2),
        ("Odesláno k hodnocení - 2 dny po termínu", 2),
        ("Ответы для оценки - Срок выполнения закончился 3 дн. назад", 3),
        ("評定のために提出済み - 2 日 3 時間 遅く提出", 3),
        ("Zur Bewertung abgegeben - Verlängerung bis Montag, 3. Mai 2027, 23:59", 0),
        ("Levert for vurdering", 0),
    ],
)
def test_moodle_says_so_in_every_language(
    tmp_path: Path, problems: ProblemSet, record: Record, said: str, days: int
) -> None:
    """The strings `submittedlateshort` of Moodle's language packs; the column is known by its place."""
    header = "ID,Name,E-Mail,Stand,Punkte,Höchste,Änderbar,Zuletzt (Abgabe),Zuletzt (Bewertung),Kommentar"
    rows = [f'Teilnehmer/in {i},Ada,a@x,"{said}",,6.00,Ja,-,-,' for i in (7, 8)]
    found = _late(tmp_path, problems, record, "moodle", [header, *rows])
    assert found == ({"7": days, "8": days} if days else {})


def test_gradescopes_list_of_grades_says_who_was_late(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    """The header is that of Download Grades, in the review of an assignment's grades."""
    header = "First Name,Last Name,SID,Email,Sections,Total Score,Max Points,Status,Submission ID,"
    header += "Submission Time,Lateness (H:M:S),View Count,Submission Count"
    rows = [
        "Ada,L,s1,a@x,,,6,Ungraded,7,2026-05-01 11:59:00 +0200,00:00:00,0,1",
        "Bob,B,s2,b@x,,,6,Ungraded,8,2026-05-03 12:00:10 +0200,48:00:10,0,1",
        "Eve,E,s3,e@x,,,6,Missing,,,,,",
    ]
    assert _late(tmp_path, problems, record, "gradescope", [header, *rows]) == {"submission_8": 3}


def test_without_a_roster_nothing_says_who_was_late(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    assert late(record) is None
    keep_platform(record, "gradescope", chosen_roster(problems, "gradescope", None))
    assert late(record) is None
    assert _late(tmp_path, problems, record, "gradescope", ["Name", "8"]) is None


def _late(
    tmp_path: Path, problems: ProblemSet, record: Record, platform: str, lines: list[str]
) -> dict[str, int] | None:
    path = tmp_path / "roster.csv"
    path.write_text("\n".join(lines) + "\n")
    keep_platform(record, platform, chosen_roster(problems, platform, path))
    return late(record)


# -- gradescope gets `results.json`, as its "Autograder Specifications" describe it ------------------


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
