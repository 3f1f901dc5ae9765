"""The files that the platforms import, from samples of what they hand out.

The facts are read from the platforms' own sources: `lib/gradebook_exporter.rb` and
`lib/gradebook_importer.rb` of instructure/canvas-lms (the header, the row of manually
posted assignments, four spaces before Points Possible, the number in parentheses,
`EX`, `N/A`, semicolons and a byte order mark as a user's settings have them),
`mod/assign/feedback/offline/importgradeslib.php` of moodle/moodle (columns are found by
their headers in the site's language, a participant by the digits at the end), and
Gradescope's "Autograder Specifications" (`results.json`).
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import jsonschema
import pytest

import dynsolve
from dynsolve.errors import InputError
from dynsolve.grading.hand_ins import Intake
from dynsolve.grading.platforms.registry import chosen_roster, export, keep_platform, late
from dynsolve.grading.problem_set import Item, ProblemSet
from dynsolve.grading.record import Record
from dynsolve.problem.reader import read_problem
from tests.support import ROOT, with_files

TEXT = (ROOT / "problems" / "in3140-rp.yaml").read_text(encoding="utf-8")
MARKS = {"K": Fraction(4), "g": Fraction(2)}
BLANK = dict.fromkeys(("label", "message", "read_as", "note", "loss", "form", "basis", "fault"), "")


@pytest.fixture
def record(tmp_path: Path) -> Iterator[Record]:
    opened = Record(tmp_path)
    yield opened
    opened.close()


@pytest.fixture
def problems() -> ProblemSet:
    from dataclasses import replace

    problem = replace(read_problem(TEXT, "in3140-rp.yaml"), marks=MARKS)
    return ProblemSet("Assignment 2", (Item(problem, TEXT),))


def _graded(record: Record, students: dict[str, tuple[str, str, str]]) -> None:
    """Students by name, each with the platform's id and the marks for K and g."""
    intake = Intake({name: id for name, (id, *_) in students.items()}, (), ())
    record.set_intake(intake.students, intake.waiting)
    for name, (_, *marks) in students.items():
        answers = [
            {
                **BLANK, "name": answer, "verdict": "correct" if given == str(of) else "wrong",
                "marks": given, "of": str(of), "line": 1, "diagnosis": [], "why": f"{given} of {of}",
            }
            for (answer, of), given in zip(MARKS.items(), marks, strict=True)
        ]  # fmt: skip
        row = {"answers": answers, "files": [], "left": [], "late": False, "reason": "", "notes": []}
        record.write((name, "in3140-rp"), "", "{}", {**row, "html": "", "markdown": ""})


def _exported(
    tmp_path: Path, problems: ProblemSet, record: Record, platform: str, text: str | bytes = ""
) -> tuple[str, ...]:
    """Write what `platform` imports from the CSV that it gave; the warnings."""
    path = tmp_path / "roster.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    keep_platform(record, platform, chosen_roster(problems, platform, path))
    return tuple(line.replace(str(path), path.name) for line in export(tmp_path, problems, record))


# -- Canvas ------------------------------------------------------------------------------------------

CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Integration ID,Section,Notes,\
Assignment 1 (554),Assignment 2 (555),Current Score
,,,,,,,Manual Posting,Manual Posting,
    Points Possible,,,,,,,10.00,6.00,(read only)
"Lovelace, Ada",101,s101,ada@uni.example,,"IN3140 and IN4140",,9.00,,90.00
"Babbage, Charles",102,s102,charles@uni.example,,IN3140,late again,8.00,1.50,80.00
"Hopper, Grace",103,s103,grace@uni.example,,IN3140,,EX,EX,
"Else, Somebody",104,s104,else@uni.example,,IN3140,,N/A,N/A,
"Student, Test",199,,0123456789abcdef,,IN3140,,,,
"""
STUDENTS = {
    "lovelaceada_101": ("101", "4", "2"),
    "babbagecharles_102": ("102", "0", "5/2"),
    "hoppergrace_103": ("103", "4", "2"),
}


def test_canvas_gets_its_gradebook_back_with_one_assignment(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, STUDENTS)
    warnings = _exported(tmp_path, problems, record, "canvas", CANVAS)
    assert (tmp_path / "canvas.csv").read_text() == (
        "Student,ID,SIS User ID,SIS Login ID,Integration ID,Section,Assignment 2 (555)\n"
        ",,,,,,Manual Posting\n"
        "    Points Possible,,,,,,6.00\n"
        '"Lovelace, Ada",101,s101,ada@uni.example,,IN3140 and IN4140,6\n'
        '"Babbage, Charles",102,s102,charles@uni.example,,IN3140,2.5\n'
        '"Hopper, Grace",103,s103,grace@uni.example,,IN3140,EX\n'
        '"Else, Somebody",104,s104,else@uni.example,,IN3140,N/A\n'
        '"Student, Test",199,,0123456789abcdef,,IN3140,\n'
    )
    handed_in_nothing = "2 students of roster.csv handed in nothing, and what stands there is kept"
    assert warnings == (f"{handed_in_nothing}: Else, Somebody; Student, Test",)


def test_semicolons_and_a_byte_order_mark_are_kept_as_canvas_has_them(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    """What Canvas writes where a user's language has a decimal comma."""
    _graded(record, STUDENTS)
    text = (
        "\ufeffStudent;ID;SIS Login ID;Section;Assignment 2 (555)\n    Points Possible;;;;6,00\n"
        "Babbage, Charles;102;charles;A;1,50\nLovelace, Ada;101;ada;A;\n"
    )
    for data in (text.encode(), text.encode("utf-16-le")):  # the second as a spreadsheet saves it
        _exported(tmp_path, problems, record, "canvas", data)
        assert (tmp_path / "canvas.csv").read_bytes().decode() == (
            "\ufeffStudent;ID;SIS Login ID;Section;Assignment 2 (555)\n    Points Possible;;;;6,00\n"
            "Babbage, Charles;102;charles;A;2,5\nLovelace, Ada;101;ada;A;6\n"
        )


def test_a_number_of_the_registry_is_not_taken_for_one_of_canvas(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    """Bob's registry number is Ada's number in Canvas."""
    _graded(record, {"lovelaceada_101": ("101", "4", "2")})
    text = 'Student,ID,SIS User ID,SIS Login ID,Section,Assignment 2 (555)\n"B, Bob",205,101,bob,A,\n'
    warnings = _exported(tmp_path, problems, record, "canvas", text)
    assert (tmp_path / "canvas.csv").read_text().splitlines()[-1] == '"B, Bob",205,101,bob,A,'
    assert warnings[0] == "1 student is not in roster.csv: lovelaceada_101"


def test_students_of_another_kind_of_download_are_found_by_what_the_registry_calls_them(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, {"s101": ("", "4", "2"), "charles@uni.example": ("submission_7", "0", "1")})
    _exported(tmp_path, problems, record, "canvas", CANVAS)
    lines = (tmp_path / "canvas.csv").read_text().splitlines()
    assert lines[3].endswith(",6") and lines[4].endswith(",1")


def test_canvas_by_last_and_first_name(tmp_path: Path, problems: ProblemSet, record: Record) -> None:
    _graded(record, STUDENTS)
    text = "LastName,FirstName,ID,SIS Login ID,Section,Assignment 2 (555)\nLovelace,Ada,101,ada,A,\n"
    _exported(tmp_path, problems, record, "canvas", text)
    assert (tmp_path / "canvas.csv").read_text() == (
        "LastName,FirstName,ID,SIS Login ID,Section,Assignment 2 (555)\n    Points Possible,,,,,6\n"
        "Lovelace,Ada,101,ada,A,6\n"
    )


@pytest.mark.parametrize(
    ("old", "new", "warning"),
    [
        ("Assignment 2 (555)", "Essay (9)", "has no assignment `Assignment 2`: Canvas will make a new one"),
        (",6.00,", ",8.00,", "the assignment has 8.00 points in Canvas, the problem set 6"),
        (",6.00,", ",6.00 (read only),", "Canvas will not import its marks"),
    ],
)
def test_what_canvas_would_do_is_said(
    tmp_path: Path, problems: ProblemSet, record: Record, old: str, new: str, warning: str
) -> None:
    _graded(record, STUDENTS)
    warnings = _exported(tmp_path, problems, record, "canvas", CANVAS.replace(old, new))
    assert any(warning in line for line in warnings)


def test_two_assignments_of_one_name_are_asked_about(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    text = CANVAS.replace("Assignment 1 (554)", "Assignment 2 (554)")
    with pytest.raises(InputError, match=r"`Assignment 2 \(554\)` or `Assignment 2 \(555\)`"):
        _exported(tmp_path, problems, record, "canvas", text)


def test_of_many_that_are_not_in_the_roster_a_few_are_named(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, {f"s{i}_{i}": (str(i), "4", "2") for i in range(1, 9)})
    warnings = _exported(tmp_path, problems, record, "canvas", CANVAS)
    assert warnings[0] == "8 students are not in roster.csv: s1_1; s2_2; s3_3; s4_4; s5_5 and others"
    assert warnings[1].startswith("5 students of roster.csv handed in nothing")


def test_names_run_nothing_in_a_spreadsheet(tmp_path: Path, problems: ProblemSet, record: Record) -> None:
    _graded(record, STUDENTS)
    _exported(
        tmp_path, problems, record, "canvas", CANVAS.replace('"Lovelace, Ada"', "\"=cmd|'/C calc'!A0\"")
    )
    assert "\n'=cmd|'/C calc'!A0,101," in (tmp_path / "canvas.csv").read_text()


# -- Moodle ------------------------------------------------------------------------------------------

ENGLISH = (
    "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    "Last modified (submission),Last modified (grade),Feedback comments"
)
WITH_GROUPS = (
    "Identifier,Full name,ID number,Email address,Status,Group,Grade,Maximum Grade,"
    "Grade can be changed,Last modified (submission),Online text,Last modified (grade),Feedback comments"
)
GERMAN = (
    "ID,Vollständiger Name,E-Mail-Adresse,Status,Gruppe,Bewertung,Bestwertung,"
    "Bewertung kann geändert werden,Zuletzt geändert (Abgabe),Zuletzt geändert (Bewertung),"
    "Feedback als Kommentar"
)
NORWEGIAN = (  # no language that is known: not the words of Moodle's own translation
    "Identifikator,Fullt navn,ID-nummer,E-postadresse,Status,Gruppe,Karakter,Maksimal karakter,"
    "Karakteren kan endres,Sist endret (innlevering),Sist endret (karakter),Kommentarer"
)
PARTICIPANTS = {
    "Ada Lovelace_41": ("41", "4", "2"),
    "Grace Hopper_42": ("42", "0", "5/2"),
    "Not Listed_44": ("44", "4", "2"),
}


def _worksheet(header: str, word: str, grade: str, maximum: str) -> list[list[str]]:
    """Three participants; the cell before the grade's maximum is the second one's grade."""
    names = header.split(",")
    place = next(i for i, name in enumerate(names) if name.lower().startswith(("max", "best", "maks")))
    rows = [names]
    for number, who, stands in (("41", "Ada Lovelace", ""), ("42", "Grace Hopper", grade), ("43", "N O", "")):
        cells = ["" for _ in names]
        cells[0], cells[1], cells[place - 1], cells[place] = f"{word}{number}", who, stands, maximum
        cells[names.index("Status")] = "Submitted for grading - late"
        cells[-2] = "-"
        rows.append(cells)
    return rows


@pytest.mark.parametrize(
    ("header", "word", "grade", "maximum", "marks"),
    [
        (ENGLISH, "Participant ", "1.00", "6.00", ("6", "2.5")),
        (WITH_GROUPS, "Participant ", "", "6.00", ("6", "2.5")),
        (GERMAN, "Teilnehmer/in", "1,00", "6,00", ("6", "2,5")),
        (NORWEGIAN, "Deltaker ", "1,00", "6,00", ("6", "2,5")),
    ],
    ids=["english", "groups", "german", "norwegian"],
)
def test_moodle_gets_its_worksheet_back_in_any_language(
    tmp_path: Path,
    problems: ProblemSet,
    record: Record,
    header: str,
    word: str,
    grade: str,
    maximum: str,
    marks: tuple[str, str],
) -> None:
    import csv
    import io

    _graded(record, PARTICIPANTS)
    rows = _worksheet(header, word, grade, maximum)
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    warnings = _exported(tmp_path, problems, record, "moodle", "\ufeff" + out.getvalue())
    written = (tmp_path / "moodle.csv").read_bytes().decode()
    assert written.startswith("\ufeff" + rows[0][0])
    back = list(csv.reader(io.StringIO(written.removeprefix("\ufeff"))))
    place = next(i for i, cell in enumerate(rows[1]) if cell == maximum) - 1
    expected = [list(row) for row in rows]
    for row, given in zip(expected[1:3], marks, strict=True):
        row[place], row[-1] = given, f"in3140-rp: {given.replace(',', '.')}"
    assert back == expected
    assert warnings == (
        "1 student is not in roster.csv: Not Listed_44",
        f"1 student of roster.csv handed in nothing, and what stands there is kept: {word}43",
    )


def test_a_teachers_comment_in_moodle_is_kept_and_ours_is_replaced(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, PARTICIPANTS)
    text = (
        f"{ENGLISH}\nParticipant 41,A,a@x,S,,6.00,Yes,1 May,-,- come and see me\n"
        "Participant 42,G,g@x,S,1.00,6.00,Yes,1 May,-,<p>in3140-rp: 1</p>\n"
    )
    _exported(tmp_path, problems, record, "moodle", text)
    lines = (tmp_path / "moodle.csv").read_text().splitlines()
    assert lines[1].endswith(",-,- come and see me")
    assert lines[2].endswith(",-,in3140-rp: 2.5")


def test_a_long_text_that_was_typed_online_is_no_obstacle(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, PARTICIPANTS)
    long = '"' + "x, y\n" * 40_000 + '"'
    text = f"{WITH_GROUPS}\nParticipant 41,=A,1,a@x,S,G,,6.00,Yes,1 May,{long},-,\n"
    _exported(tmp_path, problems, record, "moodle", text)
    written = (tmp_path / "moodle.csv").read_text()
    assert written.startswith(f"{WITH_GROUPS}\nParticipant 41,'=A,1,a@x,S,G,6,6.00,Yes,1 May,")
    assert written.endswith(f"{long},-,in3140-rp: 6\n")


def test_a_worksheet_without_comments_loses_no_date(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, PARTICIPANTS)
    text = "ID,Navn,Karakter,Maks,Kan endres,Sist endret\nDeltaker 41,A,,6.00,Ja,-\n"
    warnings = _exported(tmp_path, problems, record, "moodle", text)
    assert (tmp_path / "moodle.csv").read_text().splitlines()[1] == "Deltaker 41,A,6,6.00,Ja,-"
    assert warnings[0].startswith("the worksheet has no column for comments")


def test_a_worksheet_whose_grade_is_not_found_is_refused(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    """A scale in a language that is not known."""
    text = "ID,Navn,Karakter,Skala,Sist endret\nDeltaker 41,A,,ikke bestått bestått,-\n"
    with pytest.raises(InputError, match="set your language in Moodle to English"):
        _exported(tmp_path, problems, record, "moodle", text)


def test_feedback_goes_to_each_participants_folder(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, {"Ada Lovelace_41": ("41", "4", "2"), "loose": ("", "4", "2")})
    for student in ("Ada Lovelace_41", "loose"):
        page = tmp_path / "feedback" / student / "in3140-rp.html"
        page.parent.mkdir(parents=True)
        page.write_text("page")
    _exported(tmp_path, problems, record, "moodle", f"{ENGLISH}\nParticipant 41,A,a,S,,6,Yes,-,-,\n")
    with zipfile.ZipFile(tmp_path / "moodle-feedback.zip") as packed:
        assert packed.namelist() == ["Ada Lovelace_41_assignfeedback_file/feedback.html"]


# -- Gradescope --------------------------------------------------------------------------------------

_FORMATS = {"enum": ["text", "html", "simple_format", "md", "ansi"]}
_SEEN = {"enum": ["hidden", "after_due_date", "after_published", "visible"]}
RESULTS = {
    "type": "object",
    "required": ["score"],
    "additionalProperties": False,
    "properties": {
        "score": {"type": "number"},
        "execution_time": {"type": "number"},
        "output": {"type": "string"},
        "output_format": _FORMATS,
        "test_output_format": _FORMATS,
        "test_name_format": _FORMATS,
        "visibility": _SEEN,
        "stdout_visibility": _SEEN,
        "extra_data": {"type": "object"},
        "leaderboard": {"type": "array"},
        "tests": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "score": {"type": "number"},
                    "max_score": {"type": "number"},
                    "status": {"enum": ["passed", "failed"]},
                    "name": {"type": "string"},
                    "name_format": _FORMATS,
                    "number": {"type": "string"},
                    "output": {"type": "string"},
                    "output_format": _FORMATS,
                    "tags": {"type": "array", "items": {"type": "string"}},
                    "visibility": _SEEN,
                    "extra_data": {"type": "object"},
                },
            },
        },
    },
}
"""The documented fields, and no others."""


def test_gradescope_gets_one_result_a_submission(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    _graded(record, {"s7": ("submission_7", "4", "2"), "s8": ("submission_7", "4", "2"), "x": ("", "0", "1")})
    assert _exported(tmp_path, problems, record, "gradescope") == ()
    places = sorted(path.parent.name for path in tmp_path.glob("gradescope/*/results.json"))
    assert places == ["submission_7", "x"]
    for path in tmp_path.glob("gradescope/*/results.json"):
        results = json.loads(path.read_text())
        jsonschema.validate(results, RESULTS)
        assert results["score"] == sum(test["score"] for test in results["tests"])
    results = json.loads((tmp_path / "gradescope" / "submission_7" / "results.json").read_text())
    told = [(test["number"], test["name"], test["score"], test["max_score"]) for test in results["tests"]]
    assert told == [("1.1", "K", 4, 4), ("1.2", "g", 2, 2)]
    _graded(record, {"s7": ("submission_7", "4", "2"), "s8": ("submission_7", "4", "1")})
    (tmp_path / "grades.sqlite").touch()
    warnings = _exported(tmp_path, problems, record, "gradescope")
    assert warnings == ("s8 and s7 share submission_7, and their marks differ",)


def test_what_is_left_of_a_student_who_is_gone_is_removed(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    old = tmp_path / "gradescope" / "submission_1" / "results.json"
    old.parent.mkdir(parents=True)
    old.write_text("{}")
    _graded(record, {"s7": ("submission_7", "4", "2")})
    _exported(tmp_path, problems, record, "gradescope")
    assert sorted(path.name for path in (tmp_path / "gradescope").iterdir()) == ["submission_7"]


@pytest.mark.parametrize(
    ("maximum", "said"),
    [
        ("5.00", "over the maximum of 5, which Moodle refuses: a_1"),
        ("Pass", "the assignment is graded with a scale: Moodle takes its words, not marks"),
    ],
)
def test_moodle_is_not_given_what_it_refuses_without_a_word(
    tmp_path: Path, problems: ProblemSet, record: Record, maximum: str, said: str
) -> None:
    _graded(record, {"a_1": ("1", "4", "2")})
    header = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    header += "Last modified (submission),Last modified (grade),Feedback comments"
    row = f"Participant 1,Ada,a@x,Submitted,,{maximum},Yes,-,-,"
    assert said in _exported(tmp_path, problems, record, "moodle", f"{header}\n{row}\n")


# -- what nobody has judged --------------------------------------------------------------------------


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
    _graded(record, {"a_1": ("1", "4", "2")})
    _waiting(record, "b_2", "2")
    header = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    header += "Last modified (submission),Last modified (grade),Feedback comments"
    rows = [f"Participant {i},Ada,a@x,Submitted,{old},6.00,Yes,-,-," for i, old in ((1, ""), (2, "3.50"))]
    warnings = _exported(tmp_path, problems, record, "moodle", "\n".join([header, *rows]) + "\n")
    written = (tmp_path / "moodle.csv").read_text().splitlines()
    assert [line.split(",")[4] for line in written[1:]] == ["6", "3.50"]
    assert "1 student waits for a human and keeps what stands there: b_2 (in3140-rp)" in warnings
    canvas = "Student,ID,Section,Assignment 2 (9)\n    Points Possible,,,6.00\nA,1,,\nB,2,,\n"
    warnings = _exported(tmp_path, problems, record, "canvas", canvas)
    assert [line.split(",")[-1] for line in (tmp_path / "canvas.csv").read_text().splitlines()[2:]] == [
        "6",
        "",
    ]
    assert any("b_2" in warning for warning in warnings)
    _exported(tmp_path, problems, record, "gradescope")
    assert [path.name for path in (tmp_path / "gradescope").iterdir()] == ["1"]
    for answer in MARKS:
        record.override("b_2", "in3140-rp", answer, "1", "on paper")
    _exported(tmp_path, problems, record, "moodle", "\n".join([header, *rows]) + "\n")
    written = (tmp_path / "moodle.csv").read_text().splitlines()
    assert [line.split(",")[4] for line in written[1:]] == ["6", "2"]


# -- who was late ------------------------------------------------------------------------------------


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


# -- from the download to the import -----------------------------------------------------------------

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
