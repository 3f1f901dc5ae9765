"""What the platforms' lists say of who was late."""

from __future__ import annotations

from pathlib import Path

import pytest

from dynsolve.grading.platforms.registry import chosen_roster, keep_platform, late
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet


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
