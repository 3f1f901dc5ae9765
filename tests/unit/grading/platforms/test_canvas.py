"""Canvas gets its gradebook back, and pages under the names that it looks for."""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from dynsolve.errors import InputError
from dynsolve.grading.platforms.canvas import write_comments
from dynsolve.grading.record import Record, Waiting
from dynsolve.grading.set_file import ProblemSet
from tests.unit.grading.platforms.marked import STUDENTS, exported, graded

# -- canvas gets its gradebook back, from samples of what it hands out -------------------------------


# The facts are read from `lib/gradebook_exporter.rb` and `lib/gradebook_importer.rb` of
# instructure/canvas-lms: the header, the row of manually posted assignments, four spaces
# before Points Possible, the number in parentheses, `EX`, `N/A`, semicolons and a byte
# order mark as a user's settings have them.


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


def test_canvas_gets_its_gradebook_back_with_one_assignment(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, STUDENTS)
    warnings = exported(tmp_path, problems, record, "canvas", CANVAS)
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
    graded(record, STUDENTS)
    text = (
        "\ufeffStudent;ID;SIS Login ID;Section;Assignment 2 (555)\n    Points Possible;;;;6,00\n"
        "Babbage, Charles;102;charles;A;1,50\nLovelace, Ada;101;ada;A;\n"
    )
    for data in (text.encode(), text.encode("utf-16-le")):  # the second as a spreadsheet saves it
        exported(tmp_path, problems, record, "canvas", data)
        assert (tmp_path / "canvas.csv").read_bytes().decode() == (
            "\ufeffStudent;ID;SIS Login ID;Section;Assignment 2 (555)\n    Points Possible;;;;6,00\n"
            "Babbage, Charles;102;charles;A;2,5\nLovelace, Ada;101;ada;A;6\n"
        )


def test_a_number_of_the_registry_is_not_taken_for_one_of_canvas(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    """Bob's registry number is Ada's number in Canvas."""
    graded(record, {"lovelaceada_101": ("101", "4", "2")})
    text = 'Student,ID,SIS User ID,SIS Login ID,Section,Assignment 2 (555)\n"B, Bob",205,101,bob,A,\n'
    warnings = exported(tmp_path, problems, record, "canvas", text)
    assert (tmp_path / "canvas.csv").read_text().splitlines()[-1] == '"B, Bob",205,101,bob,A,'
    assert warnings[0] == "1 student is not in roster.csv: lovelaceada_101"


def test_students_of_another_kind_of_download_are_found_by_what_the_registry_calls_them(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, {"s101": ("", "4", "2"), "charles@uni.example": ("submission_7", "0", "1")})
    exported(tmp_path, problems, record, "canvas", CANVAS)
    lines = (tmp_path / "canvas.csv").read_text().splitlines()
    assert lines[3].endswith(",6") and lines[4].endswith(",1")


def test_canvas_by_last_and_first_name(tmp_path: Path, problems: ProblemSet, record: Record) -> None:
    graded(record, STUDENTS)
    text = "LastName,FirstName,ID,SIS Login ID,Section,Assignment 2 (555)\nLovelace,Ada,101,ada,A,\n"
    exported(tmp_path, problems, record, "canvas", text)
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
    graded(record, STUDENTS)
    warnings = exported(tmp_path, problems, record, "canvas", CANVAS.replace(old, new))
    assert any(warning in line for line in warnings)


def test_two_assignments_of_one_name_are_asked_about(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    text = CANVAS.replace("Assignment 1 (554)", "Assignment 2 (554)")
    with pytest.raises(InputError, match=r"`Assignment 2 \(554\)` or `Assignment 2 \(555\)`"):
        exported(tmp_path, problems, record, "canvas", text)


def test_of_many_that_are_not_in_the_roster_a_few_are_named(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, {f"s{i}_{i}": (str(i), "4", "2") for i in range(1, 9)})
    warnings = exported(tmp_path, problems, record, "canvas", CANVAS)
    assert warnings[0] == "8 students are not in roster.csv: s1_1; s2_2; s3_3; s4_4; s5_5 and others"
    assert warnings[1].startswith("5 students of roster.csv handed in nothing")


def test_names_run_nothing_in_a_spreadsheet(tmp_path: Path, problems: ProblemSet, record: Record) -> None:
    graded(record, STUDENTS)
    exported(tmp_path, problems, record, "canvas", CANVAS.replace('"Lovelace, Ada"', "\"=cmd|'/C calc'!A0\""))
    assert "\n'=cmd|'/C calc'!A0,101," in (tmp_path / "canvas.csv").read_text()


# -- the pages under the names that Canvas looks for, read as Canvas reads them ----------------------


# `infer_comment_context_from_filename` of instructure/canvas-lms, `app/models/abstract_assignment.rb`:
# without `LATE`, the first two parts that are digits alone are the student's number and the file's; of an
# anonymous name the two parts after `anon`.


@pytest.fixture
def record(tmp_path: Path) -> Iterator[Record]:
    opened = Record(tmp_path)
    yield opened
    opened.close()


def _seen_by_canvas(name: str) -> tuple[str, str]:
    parts = [part for part in name.split("_") if part != "LATE"]
    if parts[0] == "anon":
        return parts[1], parts[2]
    user, file = [part for part in parts if re.fullmatch("[0-9]+", part)][:2]
    return user, file


def _written(
    tmp_path: Path,
    record: Record,
    uploads: dict[tuple[str, str], tuple[str, ...]],
    waiting: tuple[Waiting, ...] = (),
) -> tuple[dict[str, bytes], list[str]]:
    """The files of the zip, and the warnings, for pages that say whose they are."""
    keys = {*uploads, *((w.student, w.problem) for w in waiting)}
    record.set_intake({student: "" for student, _ in keys}, waiting)
    record.set_uploads(uploads)
    empty = {
        "answers": [],
        "files": [],
        "left": [],
        "late": 0,
        "reason": "",
        "notes": [],
        "html": "",
        "markdown": "",
    }
    for student, problem in keys:
        record.write((student, problem), "", "{}", empty)
        place = tmp_path / "feedback" / student
        place.mkdir(parents=True, exist_ok=True)
        (place / f"{problem}.html").write_text(f"<p>{problem} of {student.partition('-')[0]}</p>")
        (place / f"{problem}.md").write_text(f"{problem} of {student.partition('-')[0]}")
    warnings = list(write_comments(tmp_path, record))
    with zipfile.ZipFile(tmp_path / "canvas-comments.zip") as packed:
        return {name: packed.read(name) for name in packed.namelist()}, warnings


@pytest.mark.parametrize(
    ("path", "user", "file"),
    [
        ("lovelaceada_101_9001_rp.yaml", "101", "9001"),
        ("download/van_der_bergåse_LATE_103_9003_2_rp.md", "103", "9003"),
        ("anon_xY3aB_9001_rp.tex", "xY3aB", "9001"),
    ],
)
def test_canvas_finds_whose_each_page_is(
    tmp_path: Path, record: Record, path: str, user: str, file: str
) -> None:
    both = {("s", "rp"): (path,), ("s", "elbow"): (path,)}
    found, warnings = _written(tmp_path, record, both)
    assert [_seen_by_canvas(name) for name in found] == [(user, file)] * 2 and not warnings
    assert {content.decode() for content in found.values()} == {"rp of s", "elbow of s"}


def test_a_page_is_what_its_name_promises(tmp_path: Path, record: Record) -> None:
    names = ("a_1_11_x.html", "b_2_12_x.ipynb", "c_3_13_x.zip/rp.yaml", "d_4_14_x.tex")
    found, warnings = _written(tmp_path, record, {(name[0], "rp"): (name,) for name in names})
    assert list(found) == ["a_1_11_x.html", "b_2_12_x.ipynb", "c_3_13_x.zip", "d_4_14_x.tex"] and not warnings
    html, notebook, packed, text = found.values()
    assert html == b"<p>rp of a</p>" and text == b"rp of d"
    assert json.loads(notebook)["cells"][0]["source"] == "rp of b"
    with zipfile.ZipFile(io.BytesIO(packed)) as inner:
        assert inner.read("rp.html") == b"<p>rp of c</p>"


def test_what_cannot_carry_a_page_is_named(tmp_path: Path, record: Record) -> None:
    waits = (Waiting("c", "rp", "c_3_13_scan.pdf", "a PDF"), Waiting("d", "rp", "d_4_14_scan.pdf", "a PDF"))
    uploads = {
        ("a", "rp"): ("a_1_text.html",),
        ("b", "rp"): ("b_2_12_x.docx",),
        ("c", "elbow"): ("c_3_15_x.md",),
    }
    found, warnings = _written(tmp_path, record, uploads, waits)
    assert list(found) == ["c_3_15_elbow_x.md", "c_3_15_rp_x.md"]  # the PDF's page goes with the other file
    assert warnings == [
        "Canvas cannot give back the pages of who handed in no file that can carry them: a; b; d"
    ]


def test_the_members_of_a_group_share_a_page(tmp_path: Path, record: Record) -> None:
    path = ("group1_1_11_rp.yaml",)
    found, warnings = _written(tmp_path, record, {("g-1", "rp"): path, ("g-2", "rp"): path})
    assert found == {"group1_1_11_rp.yaml": b"rp of g"} and not warnings
    found, warnings = _written(tmp_path, record, {("g-1", "rp"): path, ("h-3", "rp"): path})
    assert not found
    differ = "in Canvas a group reads one page, and those of its members differ: group1_1_11_rp.yaml"
    assert warnings[-1] == differ
