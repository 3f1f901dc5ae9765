"""Moodle gets its grading worksheet back, and each student a page.

The facts are read from `mod/assign/feedback/offline/importgradeslib.php` of moodle/moodle:
columns are found by their headers in the site's language, a participant by the digits at
the end.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from dynsolve.errors import InputError
from dynsolve.grading.platforms.moodle import people
from dynsolve.grading.platforms.roster import read_roster
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from tests.support import with_files
from tests.unit.grading.platforms.marked import ENGLISH, exported, graded

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

    graded(record, PARTICIPANTS)
    rows = _worksheet(header, word, grade, maximum)
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    warnings = exported(tmp_path, problems, record, "moodle", "\ufeff" + out.getvalue())
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
    graded(record, PARTICIPANTS)
    text = (
        f"{ENGLISH}\nParticipant 41,A,a@x,S,,6.00,Yes,1 May,-,- come and see me\n"
        "Participant 42,G,g@x,S,1.00,6.00,Yes,1 May,-,<p>in3140-rp: 1</p>\n"
    )
    exported(tmp_path, problems, record, "moodle", text)
    lines = (tmp_path / "moodle.csv").read_text().splitlines()
    assert lines[1].endswith(",-,- come and see me")
    assert lines[2].endswith(",-,in3140-rp: 2.5")


def test_a_long_text_that_was_typed_online_is_no_obstacle(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, PARTICIPANTS)
    long = '"' + "x, y\n" * 40_000 + '"'
    text = f"{WITH_GROUPS}\nParticipant 41,=A,1,a@x,S,G,,6.00,Yes,1 May,{long},-,\n"
    exported(tmp_path, problems, record, "moodle", text)
    written = (tmp_path / "moodle.csv").read_text()
    assert written.startswith(f"{WITH_GROUPS}\nParticipant 41,'=A,1,a@x,S,G,6,6.00,Yes,1 May,")
    assert written.endswith(f"{long},-,in3140-rp: 6\n")


def test_a_worksheet_without_comments_loses_no_date(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, PARTICIPANTS)
    text = "ID,Navn,Karakter,Maks,Kan endres,Sist endret\nDeltaker 41,A,,6.00,Ja,-\n"
    warnings = exported(tmp_path, problems, record, "moodle", text)
    assert (tmp_path / "moodle.csv").read_text().splitlines()[1] == "Deltaker 41,A,6,6.00,Ja,-"
    assert warnings[0].startswith("the worksheet has no column for comments")


def test_a_worksheet_whose_grade_is_not_found_is_refused(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    """A scale in a language that is not known."""
    text = "ID,Navn,Karakter,Skala,Sist endret\nDeltaker 41,A,,ikke bestått bestått,-\n"
    with pytest.raises(InputError, match="set your language in Moodle to English"):
        exported(tmp_path, problems, record, "moodle", text)


def test_feedback_goes_to_each_participants_folder(
    tmp_path: Path, problems: ProblemSet, record: Record
) -> None:
    graded(record, {"Ada Lovelace_41": ("41", "4", "2"), "loose": ("", "4", "2")})
    for student in ("Ada Lovelace_41", "loose"):
        page = tmp_path / "feedback" / student / "in3140-rp.html"
        page.parent.mkdir(parents=True)
        page.write_text("page")
    exported(tmp_path, problems, record, "moodle", f"{ENGLISH}\nParticipant 41,A,a,S,,6,Yes,-,-,\n")
    with zipfile.ZipFile(tmp_path / "moodle-feedback.zip") as packed:
        assert packed.namelist() == ["Ada Lovelace_41_assignfeedback_file/feedback.html"]


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
    graded(record, {"a_1": ("1", "4", "2")})
    header = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    header += "Last modified (submission),Last modified (grade),Feedback comments"
    row = f"Participant 1,Ada,a@x,Submitted,,{maximum},Yes,-,-,"
    assert said in exported(tmp_path, problems, record, "moodle", f"{header}\n{row}\n")


def test_people_are_called_as_moodle_calls_their_files(tmp_path: Path) -> None:
    table = "Identifier,Full name,Status,Grade\nParticipant 7,Ida O'Neil: A_B,,\n"
    (person,) = people(read_roster(with_files(tmp_path, {"worksheet.csv": table}) / "worksheet.csv"))
    assert (person.student, person.name) == ("Ida ONeil A B_7", "Ida O'Neil: A_B")
