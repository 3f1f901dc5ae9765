"""Whose file it is, which problem it is for, and which copy counts; groups."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

import pytest
from msgspec.structs import replace

from dynsolve.errors import ProblemError
from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.platforms import canvas, gradescope, moodle
from dynsolve.grading.platforms.gradescope import FileOwner, Person, read_metadata
from dynsolve.grading.platforms.registry import FileOwners, Groups
from dynsolve.grading.platforms.roster import Roster, read_roster
from dynsolve.grading.set_file import Membership, ProblemSet, read_groups
from dynsolve.grading.uploads import Uploads, read_extensions
from tests.unit.grading.taken import ANSWER, taken_in

# -- whose file it is, which problem it is for, and which copy counts --------------------------------


@pytest.mark.parametrize(
    ("name", "student", "id", "late"),
    [
        ("lovelaceada_1234_5678_in3140-rp.yaml", "lovelaceada_1234", "1234", False),
        ("lovelaceada_LATE_1234_5678_hand_in.yaml", "lovelaceada_1234", "1234", True),
        ("lovelaceada_1234_text.html", "lovelaceada_1234", "1234", False),
        ("LATE_anon_77_5678_hw.md", "anon_77", "77", True),
        ("anon_7xQ2z_5678_hw.md", "anon_7xQ2z", "7xQ2z", False),
        ("anon_7xQ2z_text.html", "anon_7xQ2z", "7xQ2z", False),
        ("lovelaceada_LATE_1234_text.html", "lovelaceada_1234", "1234", True),
        ("lovelaceada_1234_link.html", "lovelaceada_1234", "1234", False),
        ("van_der_bergåse_1234_5678_9_10_hw.yaml", "van_der_bergåse_1234", "1234", False),
        ("group1_1234_5678_in3140-rp-1.yaml", "group1_1234", "1234", False),
        ("r2d2_LATE_1234_5678_LATE_1_2_hw.yaml", "r2d2_1234", "1234", True),
        (
            "Åse Ærlig-Øst_43_assignsubmission_file/my home work/in3140-rp.yaml",
            "Åse Ærlig-Øst_43",
            "43",
            False,
        ),
        ("Group A-Ada Lovelace_42_assignsubmission_file/x.yaml", "Group A-Ada Lovelace_42", "42", False),
        ("Participant_42_assignsubmission_onlinetext_onlinetext.html", "Participant_42", "42", False),
        ("A_42_assignsubmission_file_B_43_assignsubmission_file_x.yaml", "A_42", "42", False),
        ("Ada_42_assignsubmission_file/submission_7/x.yaml", "Ada_42", "42", False),
        ("s1/submission_7/x.yaml", "s1", "", False),
        ("Ada Lovelace_42_assignsubmission_file_/in3140-rp.yaml", "Ada Lovelace_42", "42", False),
        ("Ada Lovelace_42_assignsubmission_file/sub/in3140-rp.yaml", "Ada Lovelace_42", "42", False),
        ("Ada Lovelace_42_assignsubmission_onlinetext/onlinetext.html", "Ada Lovelace_42", "42", False),
        ("Ada Lovelace_42_assignsubmission_file_in3140.yaml", "Ada Lovelace_42", "42", False),
        ("submission_9/in3140-rp.yaml", "submission_9", "submission_9", False),
        ("s1/in3140-rp.yaml", "s1", "", False),
        ("s1.yaml", "s1", "", False),
    ],
)
def test_names_of_the_platforms(name: str, student: str, id: str, late: bool) -> None:
    others = [PurePosixPath("x.csv"), PurePosixPath("y/z.yaml")]
    (owner,) = FileOwners([PurePosixPath(name), *others]).of(PurePosixPath(name))
    assert (owner.student, owner.id, owner.late) == (student, id, late)


GRADESCOPE = """\
submission_9:
  :submitters:
  - :name: Ada
    :sid: s1
    :email: a@x
  - :name: Bob
    :sid: ''
    :email: b@x
  :created_at: 2026-04-26 17:34:00.861687000 Z
  :score: 2.0
  :results:
    output: |-
      ====
      Final: 2
  :history: []
submission_10:
  :submitters:
  - :name: Eve
submission_11:
  :submitters:
  - :name: Eve
submission_12.yaml:
  :submitters:
  - :sid: 12
submission_13:
  :submitters: []
"""
OWNERS = {
    "submission_9/a.yaml": ["s1", "b@x"],
    "submission_10/a.yaml": ["Eve (submission_10)"],
    "submission_11/a.yaml": ["Eve (submission_11)"],
    "submission_12.yaml": ["12"],
    "submission_13/a.yaml": ["submission_13"],
    "submission_14/a.yaml": ["submission_14"],
}


@pytest.mark.parametrize("folder", ["", "assignment_1_export/", "my download/"])
def test_gradescope_names_those_who_handed_in(problems: ProblemSet, tmp_path: Path, folder: str) -> None:
    text = "problem: in3140-rp\n" + ANSWER
    files = {f"{folder}{name}": text for name in OWNERS}
    files[f"{folder}submission_metadata.yml"] = GRADESCOPE
    intake = taken_in(problems, tmp_path, files)
    assert sorted(intake.students) == sorted(name for names in OWNERS.values() for name in names)
    assert not intake.waiting


def test_two_exports_of_gradescope_beside_one_another(problems: ProblemSet, tmp_path: Path) -> None:
    files = {}
    for i in (1, 2):
        files[f"assignment_{i}_export/submission_{i}/in3140-rp.yaml"] = ANSWER
        files[f"assignment_{i}_export/submission_metadata.yml"] = (
            f"submission_{i}:\n  :submitters:\n  - :sid: s{i}\n"
        )
    assert list(taken_in(problems, tmp_path, files).students) == ["s1", "s2"]


@pytest.mark.parametrize(
    "place",
    [
        "assignment_1_export/submission_1/",
        "assignment_1_export/submission_1/submission_2/",
    ],
)
def test_a_students_own_list_says_nothing_of_the_others(
    problems: ProblemSet, tmp_path: Path, place: str
) -> None:
    mine = "submission_2:\n  :submitters:\n  - :sid: thief\n"
    good = "submission_1:\n  :submitters:\n  - :sid: s1\nsubmission_2:\n  :submitters:\n  - :sid: s2\n"
    files = {
        f"{place}submission_metadata.yml": mine,
        "assignment_1_export/submission_2/in3140-rp.yaml": ANSWER,
        "assignment_1_export/submission_metadata.yml": good,
    }
    assert list(taken_in(problems, tmp_path, files).students) == ["s1", "s2"]


def test_a_students_own_list_is_no_list_of_another_platform(problems: ProblemSet, tmp_path: Path) -> None:
    files = {
        "A_1_assignsubmission_file/submission_metadata.yml":
            "B_2_assignsubmission_file:\n  :submitters:\n  - :sid: thief\n",
        "B_2_assignsubmission_file/in3140-rp.yaml": ANSWER,
    }  # fmt: skip
    assert list(taken_in(problems, tmp_path, files).students) == ["A_1", "B_2"]


@pytest.mark.parametrize(
    ("names", "students"),
    [
        (["w/a_1_2_in3140-rp.yaml", "w/b_3_4_in3140-rp.yaml", "w/readme.txt"], ["a_1", "b_3", "readme"]),
        (["v/w/a_1_2_in3140-rp.yaml", "v/w/b_3_4_in3140-rp.yaml"], ["a_1", "b_3"]),
        (["w/s1/in3140-rp.yaml", "w/s2/in3140-rp.yaml"], ["s1", "s2"]),
        (["w/s1_in3140-rp.yaml", "w/s2_in3140-rp.yaml"], ["s1_in3140-rp", "s2_in3140-rp"]),
        (["s1/in3140-rp.yaml", "s1/planar-2r.yaml"], ["s1"]),
        (["s1/in3140-rp.yaml", "s1/notes.txt"], ["s1"]),
        (["s1/in3140-rp.yaml"], ["s1"]),
        (["s1/1.png", "s1/2.png", "s1/report.md"], ["s1"]),
        (["w/A B_1_assignsubmission_file/in3140-rp.yaml", "w/x.txt"], ["A B_1", "x"]),
        (["x.csv", "w/A B_1_assignsubmission_file/in3140-rp.yaml"], ["A B_1", "x"]),
        (["x.csv", "v/w/A B_1_assignsubmission_file/in3140-rp.yaml"], ["A B_1", "x"]),
        (["x.csv", "w/a_1_2_in3140-rp.yaml", "w/b_3_4_in3140-rp.yaml"], ["a_1", "b_3", "x"]),
        (["s1/a_1_2_in3140-rp.yaml", "s1/b_2_3_in3140-rp.yaml", "s2/in3140-rp.yaml"], ["s1", "s2"]),
        (["s1/a_1_2_in3140-rp.yaml", "s1/b_2_3_in3140-rp.yaml", "s2.yaml"], ["s1", "s2"]),
        (
            [
                "A_1_assignsubmission_file/B_2_3_in3140-rp.yaml",
                "A_1_assignsubmission_file/C_3_4_in3140-rp.yaml",
                "B_2_assignsubmission_file/in3140-rp.yaml",
            ],
            ["A_1", "B_2"],
        ),
        (["A_1_assignsubmission_file/B_2_assignsubmission_file/in3140-rp.yaml"], ["A_1"]),
        (["s1/B_2_assignsubmission_file/in3140-rp.yaml", "s2/in3140-rp.yaml"], ["s1", "s2"]),
    ],
)
def test_a_folder_around_everything(
    problems: ProblemSet, tmp_path: Path, names: list[str], students: list[str]
) -> None:
    assert list(taken_in(problems, tmp_path, dict.fromkeys(names, ANSWER)).students) == students


def test_late_is_also_who_the_platform_says_elsewhere(problems: ProblemSet, tmp_path: Path) -> None:
    for i in (1, 2):
        place = tmp_path / f"A_{i}_assignsubmission_file"
        place.mkdir()
        (place / "in3140-rp.yaml").write_text(ANSWER)
    intake = take_in(problems, Uploads(tmp_path), {"2": 1})
    assert [(h.student, h.late) for h in intake.hand_ins] == [("A_1", False), ("A_2", True)]


@pytest.mark.parametrize(
    ("row", "late"),
    [("A_2,1,", 2), ("2,3,", 0), ("A,7,in3140-rp", 0), ("A,7,planar-2r", 3), ("B,7,", 3), ("", 3)],
)
def test_an_extension_takes_days_off(problems: ProblemSet, tmp_path: Path, row: str, late: int) -> None:
    (tmp_path / "set").mkdir()
    (tmp_path / "set" / "extensions.csv").write_text(f"student,days,problem\n{row}\n")
    given = read_extensions(tmp_path / "set", problems.stems)
    place = tmp_path / "in" / "A_2_assignsubmission_file"
    place.mkdir(parents=True)
    (place / "in3140-rp.yaml").write_text(ANSWER)
    intake = take_in(replace(problems, extensions=given), Uploads(tmp_path / "in"), {"2": 3})
    assert [hand_in.late for hand_in in intake.hand_ins] == [late]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name,days\nA,1\n", "not the names of the columns"),
        ("student,days\nA,soon\n", "`soon` is no number of days"),
        ("student,days,problem\nA,1,in3140\n", "there is no problem `in3140`"),
        ("student,days\n,1\n", "no student is named"),
    ],
)
def test_a_faulty_list_of_extensions(problems: ProblemSet, tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "extensions.csv").write_text(text)
    with pytest.raises(ProblemError, match=said):
        read_extensions(tmp_path, problems.stems)


def test_one_student_whose_name_two_systems_spell_is_one(problems: ProblemSet, tmp_path: Path) -> None:
    files = {
        "\u00c5se/in3140-rp.yaml": ANSWER,
        "A\u030ase/planar-2r.yaml": ANSWER,
        "x/in3140-rp.yaml": ANSWER,
    }
    assert list(taken_in(problems, tmp_path, files).students) == ["x", "\u00c5se"]


def test_an_address_waits_for_a_human(problems: ProblemSet, tmp_path: Path) -> None:
    (waiting,) = taken_in(problems, tmp_path, {"a_1_link.html": "<a href='http://x'>in3140-rp</a>"}).waiting
    assert waiting.reason == "an address: a human reads it"


@pytest.mark.parametrize(
    "text",
    [
        "x: !!python/object/apply:os.system ['false']\n",
        "x: !ruby/object:X {c: 1}\n",
        "x: &a [*a, *a]\n",
        "x:\n  :submitters: text\n",
        "x:\n  :submitters:\n    :sid: s2\n",
        "x:\n  :results:\n    :submitters:\n    - :sid: s3\n",
        "? [x, {y: z}]\n: 1\n",
    ],
)
def test_metadata_constructs_nothing(text: str) -> None:
    good = "submission_1:\n  :submitters:\n  - :sid: s1\n"
    assert read_metadata((text + good).encode()) == {"submission_1": ({":sid": "s1"},)}


@pytest.mark.parametrize("text", ["[" * 500_000, "{a: " * 500_000, "- " * 500_000, "\0", "a: b: c"])
def test_metadata_that_is_hostile_says_nothing(text: str) -> None:
    assert read_metadata(text.encode()) == {}


# -- groups: whose a group's files are, as `groups.csv` and Moodle's worksheet say -------------------


# How a group's files are called is read from `mod/assign/classes/downloader.php` of moodle/moodle (since
# 4.1), where the group's column stands from `mod/assign/gradingtable.php` (`submissionteam`, after the
# status).


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
