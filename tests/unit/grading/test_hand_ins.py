"""Whose file it is, which problem it is for, and which copy counts."""

from __future__ import annotations

import os
from pathlib import Path, PurePosixPath

import pytest

from dynsolve.grading.hand_ins import Intake, take_in
from dynsolve.grading.platforms import Owners, read_metadata
from dynsolve.grading.problem_set import ProblemSet, load_set
from dynsolve.grading.uploads import Uploads

ANSWER = "answers:\n  K: m1*g\n"


@pytest.fixture(scope="module")
def problems(tmp_path_factory: pytest.TempPathFactory) -> ProblemSet:
    from dynsolve.library import find

    folder = tmp_path_factory.mktemp("set")
    for name in ("in3140-rp", "planar-2r"):
        (folder / f"{name}.yaml").write_text(find(name).read_text())
    return load_set(str(folder))


def _intake(problems: ProblemSet, folder: Path, files: dict[str, str]) -> Intake:
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
    return take_in(problems, Uploads(folder))


@pytest.mark.parametrize(
    ("name", "student", "id", "late"),
    [
        ("lovelaceada_1234_5678_in3140-rp.yaml", "lovelaceada_1234", "1234", False),
        ("lovelaceada_LATE_1234_5678_hand_in.yaml", "lovelaceada_1234", "1234", True),
        ("lovelaceada_1234_text.html", "lovelaceada_1234", "1234", False),
        ("LATE_anon_77_5678_hw.md", "anon_77", "77", True),
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
    others = [PurePosixPath("x.yaml"), PurePosixPath("y/z.yaml")]
    (owner,) = Owners([PurePosixPath(name), *others]).of(PurePosixPath(name))
    assert (owner.student, owner.id, owner.late) == (student, id, late)


def test_gradescope_names_the_members_of_a_group() -> None:
    metadata = read_metadata(
        b"submission_9:\n  :submitters:\n  - :name: Ada\n    :sid: s1\n  - :name: Bob\n    :email: b@x\n"
    )
    path = PurePosixPath("assignment_1_export/submission_9/a.yaml")
    assert [owner.student for owner in Owners([path], metadata).of(path)] == ["s1", "b@x"]


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


def test_the_problem_comes_from_front_matter_then_name_then_heading(
    problems: ProblemSet, tmp_path: Path
) -> None:
    files = {
        "a/planar-2r.yaml": "problem: in3140-rp\n" + ANSWER,
        "b/my planar 2R.yaml": ANSWER,
        "c/hw.md": "# On the RP manipulator\n\n$$K = 0$$\n",
        "d/hw.md": "# Homework\n",
        "e/hw.yaml": "problem: scara\n" + ANSWER,
        "f/scan.pdf": "%PDF",
    }
    intake = _intake(problems, tmp_path, files)
    assert {h.student: h.problem for h in intake.hand_ins} == {
        "a": "in3140-rp", "b": "planar-2r", "c": "in3140-rp",
    }  # fmt: skip
    reasons = {w.student: w.reason for w in intake.waiting}
    assert reasons["d"].startswith("neither its front matter")
    assert "`scara`, which is no problem of this set" in reasons["e"]
    assert reasons["f"] == "a PDF: a human reads it"
    assert list(intake.students) == ["a", "b", "c", "d", "e", "f"]


def test_the_platforms_student_wins(problems: ProblemSet, tmp_path: Path) -> None:
    text = "problem: in3140-rp\nstudent: s9\n" + ANSWER
    intake = _intake(problems, tmp_path, {"ada_1_2_hw.yaml": text, "bob.yaml": text, "eve/a.yaml": text})
    assert [h.student for h in intake.hand_ins] == ["ada_1", "eve", "s9"]


def test_the_newest_copy_counts_and_the_other_is_named(problems: ProblemSet, tmp_path: Path) -> None:
    text = "problem: in3140-rp\nstudent: s9\n" + ANSWER
    files = {"first.yaml": text, "second.yaml": text}
    intake = _intake(problems, tmp_path, files)
    os.utime(tmp_path / "first.yaml", (2_000_000_000, 2_000_000_000))
    intake = take_in(problems, Uploads(tmp_path))
    (hand_in,) = intake.hand_ins
    assert ([f.name for f in hand_in.files], hand_in.left) == (["first.yaml"], ("second.yaml",))


def test_a_late_copy_is_another_copy(problems: ProblemSet, tmp_path: Path) -> None:
    files = {"ada_1_20_in3140-rp.yaml": ANSWER, "ada_LATE_1_30_in3140-rp.yaml": ANSWER}
    (hand_in,) = _intake(problems, tmp_path, files).hand_ins
    assert hand_in.late
    assert hand_in.left == ("ada_1_20_in3140-rp.yaml",)


def test_files_of_one_delivery_belong_together(problems: ProblemSet, tmp_path: Path) -> None:
    files = {"ada_1_20_in3140-rp-a.yaml": ANSWER, "ada_1_21_in3140-rp-b.yaml": ANSWER, "bob.txt": "x"}
    hand_in = _intake(problems, tmp_path, files).hand_ins[0]
    assert [f.name for f in hand_in.files] == ["in3140-rp-a.yaml", "in3140-rp-b.yaml"]
