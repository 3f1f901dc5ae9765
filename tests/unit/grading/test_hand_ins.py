"""Whose file it is, which problem it is for, and which copy counts."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

import pytest
from msgspec.structs import replace

from dynsolve.errors import ProblemError
from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.platforms.gradescope import read_metadata
from dynsolve.grading.platforms.registry import FileOwners
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import Uploads, read_extensions
from tests.unit.grading.taken import ANSWER, taken_in


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
