"""What a Python user grades with: whom `override` means, and lateness that nobody knows."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import dynsolve
from dynsolve.errors import UsageError
from dynsolve.grading.platforms import moodle
from dynsolve.grading.platforms.registry import keep_names, keep_platform
from dynsolve.grading.platforms.roster import Roster, read_roster
from dynsolve.grading.public import meant_student
from dynsolve.grading.record import Record
from dynsolve.problem.reader import find
from tests.support import with_files

# -- which student `override` means: one by a whole name, else those who may be meant are listed -----


GRADEBOOK = (
    ("Student", "ID", "SIS Login ID"),
    ("Lovelace, Ada", "101", "ada@x"),
    ("Ærlig, Åse", "102", "ase@x"),
    ("King, Ada", "103", "king@x"),
    ("Smith, Jo", "104", "jo@x"),
    ("Smith, Jo", "105", "jo2@x"),
)
STUDENTS = {
    "lovelaceada_101": "101", "ærligåse_102": "102", "kingada_103": "103",
    "smithjo_104": "104", "smithjo_105": "105", "late comer": "",
}  # fmt: skip


@pytest.fixture
def record(tmp_path: Path) -> Iterator[Record]:
    record = Record(tmp_path)
    record.set_intake(STUDENTS, ())
    keep_platform(record, "canvas", Roster("gradebook.csv", GRADEBOOK))
    keep_names(record, {"late comer": "Grace Hopper"})
    yield record
    record.close()


@pytest.mark.parametrize(
    ("said", "student"),
    [
        ("lovelaceada_101", "lovelaceada_101"),
        ("Lovelace, Ada", "lovelaceada_101"),
        ("ada lovelace", "lovelaceada_101"),
        ("A\u030ase Ærlig", "ærligåse_102"),
        ("103", "kingada_103"),
        ("jo2@x", "smithjo_105"),
        ("Hopper, Grace", "late comer"),
    ],
)
def test_a_whole_name_of_one_student_is_that_students(record: Record, said: str, student: str) -> None:
    assert meant_student(record, said) == student


@pytest.mark.parametrize(
    ("said", "message"),
    [
        (
            "Jo Smith",
            "2 students are called `Jo Smith`: name one as `smithjo_104` (Smith, Jo) or `smithjo_105`",
        ),
        ("Ada", "did you mean `kingada_103` (King, Ada) or `lovelaceada_101` (Lovelace, Ada)?"),
        ("Ada Lovelase", "there is no student `Ada Lovelase` in grades.csv"),
        ("", "there is no student `` in grades.csv"),
    ],
)
def test_what_may_be_several_or_nobody_is_told(record: Record, said: str, message: str) -> None:
    with pytest.raises(UsageError) as caught:
        meant_student(record, said)
    assert message in str(caught.value)


# -- Where being late costs marks and nothing says who was: told before the run and after it, and only then


G = "answers:\n  g: [0, 0]\n"
SAID = (
    "the policy takes marks for being late, and nothing says who was late: nobody loses any; "
    "give the platform's list with --lms and --roster"
)
HEADERS = {
    "english": "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Last modified,Comments",
    "german": "ID,Vollständiger Name,E-Mail-Adresse,Status,Bewertung,Bestwertung,Zuletzt geändert,Feedback",
    "norwegian": "Identifikator,Fullt navn,E-postadresse,Status,Karakter,Maksimum,Sist endret,Kommentarer",
    "french": "Identifiant,Nom complet,Adresse,Statut,Note,Note maximale,Dernière modification,Feedback",
    "spanish": "Identificador,Nombre,Dirección,Estado,Calificación,Máximo,Modificado,Comentarios",
    "finnish": "Tunniste,Koko nimi,Sähköpostiosoite,Tila,Arvosana,Maksimiarvosana,Muokattu,Palaute",
    "japanese": "ID,フルネーム,メールアドレス,ステータス,評点,最大評点,最終更新日時,フィードバックコメント",
    "unknown": "a,b,c,d,e,f,g,h",
}
WITHOUT = "Identifier,Full name,Email,Grade,Maximum Grade,Comments\nParticipant 41,Ada,a@x,,2.00,\n"
FILE = "Ada Lovelace_41_assignsubmission_file/in3140-rp.yaml"


def _grade(tmp_path: Path, name: str, late: str = "1/2", **roster: object) -> tuple[list[str], list[str]]:
    """What is said before the run, and after it."""
    with_files(tmp_path / "set", {"in3140-rp.yaml": find("in3140-rp").read_bytes()})
    (tmp_path / "set" / "set.yaml").write_text(f"marks: {{in3140-rp: {{g: 2}}}}\npolicy: {{late: {late}}}\n")
    with_files(tmp_path / "in", {name: G})
    before: list[str] = []
    grades = dynsolve.grade(
        tmp_path / "set", tmp_path / "in", tmp_path / "out", jobs=1, warn=before.append, **roster
    )  # type: ignore[arg-type]
    return before, [line for line in grades.warnings if "late" in line]


def test_it_is_told_before_and_after(tmp_path: Path) -> None:
    assert _grade(tmp_path, "ada/in3140-rp.yaml") == ([SAID], [SAID])
    assert _grade(tmp_path, "ada/in3140-rp.yaml", late="1") == ([], [])


def test_canvas_says_it_in_the_names_of_files(tmp_path: Path) -> None:
    assert _grade(tmp_path, "lovelaceada_LATE_101_9001_in3140-rp.yaml") == ([], [])


def test_a_download_of_moodle_alone_does_not_say_it(tmp_path: Path) -> None:
    assert _grade(tmp_path, FILE) == ([SAID], [SAID])


@pytest.mark.parametrize("language", HEADERS)
def test_moodles_worksheet_says_it_in_every_language(tmp_path: Path, language: str) -> None:
    roster = tmp_path / "Grades.csv"
    row = "Participant 41,Ada Lovelace,ada@x,Levert - 2 dager 1 time for sent,,2.00,-,"
    roster.write_text(f"{HEADERS[language]}\n{row}\n", encoding="utf-8")
    assert moodle.late(read_roster(roster)) == {"41": 3}


def test_with_the_worksheet_nothing_is_said_unless_it_has_no_status(tmp_path: Path) -> None:
    roster = tmp_path / "Grades.csv"
    row = "Participant 41,Ada Lovelace,ada@x,Levert - 2 dager 1 time for sent,,2.00,-,"
    roster.write_text(f"{HEADERS['norwegian']}\n{row}\n", encoding="utf-8")
    assert _grade(tmp_path, FILE, lms="moodle", roster=roster) == ([], [])
    assert (tmp_path / "out" / "grades.csv").read_text().splitlines()[1] == "Ada Lovelace_41,1,1,2"
    roster.write_text(WITHOUT)
    assert _grade(tmp_path, FILE, lms="moodle", roster=roster) == ([SAID], [SAID])
