"""Groups: whose a group's files are, as `groups.csv` and Moodle's worksheet say.

How a group's files are called is read from `mod/assign/classes/downloader.php` of moodle/moodle (since 4.1),
where the group's column stands from `mod/assign/gradingtable.php` (`submissionteam`, after the status).
"""

from __future__ import annotations

from pathlib import Path

import pytest

from dynsolve.errors import ProblemError
from dynsolve.grading.platforms import canvas, gradescope, moodle
from dynsolve.grading.platforms.gradescope import FileOwner, Person
from dynsolve.grading.platforms.registry import Groups
from dynsolve.grading.platforms.roster import Roster, read_roster
from dynsolve.grading.set_file import Membership, read_groups

WORKSHEET = """\
Identifier,Full name,Email address,Status,Group,Grade,Maximum Grade,Last modified (grade),Feedback comments
Participant 41,Ada Lovelace,ada@x,Submitted for grading - ,Group_1: A,,6.00,-,
Participant 42,Åse Ærlig,ase@x,Submitted for grading - 1 day 2 hours late,Group_1: A,,6.00,-,
Participant 43,Wei 王,wei@x,No submission,Default group,,6.00,-,
"""


def _worksheet(tmp_path: Path, text: str = WORKSHEET) -> Roster:
    (tmp_path / "Grades.csv").write_text(text, encoding="utf-8")
    return read_roster(tmp_path / "Grades.csv")


def _members(groups: Groups, name: str) -> list[tuple[str, str]]:
    owner = moodle.owner((name, "hw.md")) or canvas.owner((name,)) or FileOwner(name, "", "", "hw.md")
    return [(one.student, one.id) for one in groups.of(owner)]


@pytest.mark.parametrize(
    ("folder", "members"),
    [
        ("Group 1 A_77_assignsubmission_file", [("Ada Lovelace_41", "41"), ("Åse Ærlig_42", "42")]),
        ("Group 1 A_77_assignsubmission_onlinetext", [("Ada Lovelace_41", "41"), ("Åse Ærlig_42", "42")]),
        ("Default group_assignsubmission_file", [("Wei 王_43", "43")]),
        ("Group 1 A-Ada Lovelace_41_assignsubmission_file_", [("Group 1 A-Ada Lovelace_41", "41")]),
        ("Group 2_41_assignsubmission_file", [("Group 2_41", "")]),  # 41 is the group's, and no participant's
    ],
)
def test_moodles_worksheet_says_who_the_members_are(
    tmp_path: Path, folder: str, members: list[tuple[str, str]]
) -> None:
    groups = Groups((), moodle.people(_worksheet(tmp_path)))
    assert _members(groups, folder) == members


def test_a_worksheet_with_groups_still_says_who_was_late(tmp_path: Path) -> None:
    assert moodle.late(_worksheet(tmp_path)) == {"42": 2}
    other = WORKSHEET.replace("Status,Group", "Stand,Lag").replace("Default group", "Lag - 3 stykker")
    assert moodle.late(_worksheet(tmp_path, other)) == {"42": 2}


def test_a_worksheet_without_names_is_of_participants(tmp_path: Path) -> None:
    text = "Identifier,Status,Group,Grade,Maximum Grade,Comments\nParticipant 41,-,Group A,,6.00,\n"
    groups = Groups((), moodle.people(_worksheet(tmp_path, text)))
    assert _members(groups, "Group A_77_assignsubmission_file") == [("Participant_41", "41")]


def test_a_list_of_the_teachers_wins(tmp_path: Path) -> None:
    (tmp_path / "groups.csv").write_text(
        "Group;Student\nGroup_1: A;wei@x\nGroup_1: A;42\nteam;Ada Lovelace\n"
    )
    groups = Groups(read_groups(tmp_path), moodle.people(_worksheet(tmp_path)))
    assert _members(groups, "Group 1 A_77_assignsubmission_file") == [
        ("Wei 王_43", "43"),
        ("Åse Ærlig_42", "42"),
    ]
    assert _members(groups, "team") == [("Ada Lovelace_41", "41")]


def test_canvas_writes_a_groups_name_in_small_letters() -> None:
    gradebook = Roster("g.csv", (("Student", "ID", "SIS Login ID"), ("Lovelace, Ada", "101", "ada@x")))
    groups = Groups([Membership("Group 1", "ada@x"), Membership("Group 1", "102")], canvas.people(gradebook))
    assert _members(groups, "group1_105_9007_my answers.yaml") == [("lovelaceada_101", "101"), ("102", "102")]


def test_a_spelling_that_two_groups_share_is_neither_of_theirs() -> None:
    groups = Groups([Membership("Group 1-1", "a"), Membership("Group 11", "b")])
    assert _members(groups, "group11_105_9007_x.yaml") == [("group11_105", "105")]
    assert _members(groups, "Group 1-1") == [("a", "")]


def test_a_name_that_two_students_share_is_neither_of_theirs() -> None:
    people = [Person(f"Ada Lovelace_{id}", id, "Ada Lovelace") for id in ("41", "44")]
    assert _members(Groups([Membership("A", "Ada Lovelace")], people), "A") == [("Ada Lovelace", "")]


def test_gradescopes_list_of_grades_names_its_students() -> None:
    header = ("First Name", "Last Name", "SID", "Email")
    rows = (("Ada", "Lovelace", "s1", "a@x"), ("Wei", "王", "", "w@x"), ("No", "One", "", ""))
    found = gradescope.people(Roster("g.csv", (header, *rows)))
    assert [(person.student, person.name) for person in found] == [("s1", "Ada Lovelace"), ("w@x", "Wei 王")]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("team,student\nA,41\n", 1, "the first line is `team,student`, not the names of the columns"),
        ("group,student\nA,41\n,42\n", 3, "a row names a group and a student"),
    ],
)
def test_a_faulty_list_is_told(tmp_path: Path, text: str, line: int, message: str) -> None:
    (tmp_path / "groups.csv").write_text(text)
    with pytest.raises(ProblemError) as caught:
        read_groups(tmp_path)
    assert [(finding.line, finding.message) for finding in caught.value.findings] == [(line, message)]
