"""Whose file it is, which problem it is for, and which copy counts."""

from __future__ import annotations

import io
import json
import os
import time
import zipfile
from dataclasses import replace
from pathlib import Path, PurePosixPath

import pytest

from dynsolve.errors import ProblemError
from dynsolve.grading.extensions import read_extensions
from dynsolve.grading.hand_ins import Intake, take_in
from dynsolve.grading.platforms.gradescope import read_metadata
from dynsolve.grading.platforms.owners import FileOwners
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.set_file import load_set
from dynsolve.grading.uploads import MAX_INSIDE, Uploads

ANSWER = "answers:\n  K: m1*g\n"


@pytest.fixture(scope="module")
def problems(tmp_path_factory: pytest.TempPathFactory) -> ProblemSet:
    from dynsolve.problem.library import find

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
    intake = _intake(problems, tmp_path, files)
    assert sorted(intake.students) == sorted(name for names in OWNERS.values() for name in names)
    assert not intake.waiting


def test_two_exports_of_gradescope_beside_one_another(problems: ProblemSet, tmp_path: Path) -> None:
    files = {}
    for i in (1, 2):
        files[f"assignment_{i}_export/submission_{i}/in3140-rp.yaml"] = ANSWER
        files[f"assignment_{i}_export/submission_metadata.yml"] = (
            f"submission_{i}:\n  :submitters:\n  - :sid: s{i}\n"
        )
    assert list(_intake(problems, tmp_path, files).students) == ["s1", "s2"]


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
    assert list(_intake(problems, tmp_path, files).students) == ["s1", "s2"]


def test_a_students_own_list_is_no_list_of_another_platform(problems: ProblemSet, tmp_path: Path) -> None:
    files = {
        "A_1_assignsubmission_file/submission_metadata.yml":
            "B_2_assignsubmission_file:\n  :submitters:\n  - :sid: thief\n",
        "B_2_assignsubmission_file/in3140-rp.yaml": ANSWER,
    }  # fmt: skip
    assert list(_intake(problems, tmp_path, files).students) == ["A_1", "B_2"]


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
    assert list(_intake(problems, tmp_path, dict.fromkeys(names, ANSWER)).students) == students


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
    assert list(_intake(problems, tmp_path, files).students) == ["x", "\u00c5se"]


def test_an_address_waits_for_a_human(problems: ProblemSet, tmp_path: Path) -> None:
    (waiting,) = _intake(problems, tmp_path, {"a_1_link.html": "<a href='http://x'>in3140-rp</a>"}).waiting
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


SAYS = {
    "hw.md": "---\r\nauthor: x\r\nproblem: in3140-rp   # this\r\n---\r\n",
    "html.md": "\ufeff<!--\nproblem: 'In3140 RP'\n-->\n",
    "setext.md": "On the RP manipulator\n=====================\n",
    "deep.md": "#### RP manipulator\n",
    "tagged.html": "<p>x</p><h4 class='a'>\n<b>RP&nbsp;manipulator</b>\n</h4>",
    "section.tex": "\\subsection*{The RP manipulator}\n",
    "cells.ipynb": '{"cells": [{"cell_type": "markdown", "source": ["# RP manipulator\\n", "x"]}]}',
    "front.ipynb": '{"cells": [{"cell_type": "raw", "source": "---\\nproblem: in3140-rp\\n---"}]}',
    "wide.yaml": "\ufeffproblem: in3140-rp.yaml\n".encode("utf-16").decode("latin-1"),
    "quoted.yml": '"problem" : "in3140-rp"\n',
}


@pytest.mark.parametrize("name", SAYS)
def test_a_file_says_which_problem_it_is_for(problems: ProblemSet, tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(SAYS[name].encode("latin-1" if name == "wide.yaml" else "utf-8"))
    intake = take_in(problems, Uploads(tmp_path))
    assert [hand_in.problem for hand_in in intake.hand_ins] == ["in3140-rp"]


def test_a_report_on_two_problems_is_in_parts(problems: ProblemSet, tmp_path: Path) -> None:
    title = problems.item("planar-2r").problem.title
    text = f"# RP manipulator\n\n$$K = 0$$\n\n# {title}\n\n$$K = 0$$\n\n# RP manipulator again\n"
    intake = _intake(problems, tmp_path, {"s1.md": text, "in3140-rp_s2.md": text})
    assert [(h.student, h.problem, len(h.files[0].others)) for h in intake.hand_ins] == [
        ("in3140-rp_s2", "in3140-rp", 0), ("s1", "in3140-rp", 1), ("s1", "planar-2r", 2),
    ]  # fmt: skip
    assert not intake.waiting


def test_a_notebook_on_two_problems_is_in_parts(problems: ProblemSet, tmp_path: Path) -> None:
    cells = [
        {"cell_type": "markdown", "source": ["# Problem 1\n", "\n", "$$K = 0$$\n"]},
        {"cell_type": "code", "source": ["# Problem 9\n"]},
        {"cell_type": "markdown", "source": "# Problem 2\n\n$$P = 0$$"},
    ]
    intake = _intake(problems, tmp_path, {"s1.ipynb": json.dumps({"cells": cells})})
    assert [(h.student, h.problem) for h in intake.hand_ins] == [
        ("s1", stem) for stem in problems.stems[:2]
    ]  # fmt: skip
    assert not intake.waiting


def test_a_refused_file_is_still_its_students(problems: ProblemSet, tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("ada_41_7_bomb.yaml", b"\0" * 10_000_000)
        archive.writestr("bob_42_8_in3140-rp.yaml", ANSWER)
        archive.writestr(zipfile.ZipInfo("../x.yaml"), ANSWER)
        archive.writestr(zipfile.ZipInfo(""), ANSWER)
    intake = take_in(problems, Uploads(path))
    assert intake.students == {"ada_41": "41", "bob_42": "42"}
    assert [(w.student, w.file) for w in intake.waiting] == [
        ("", ""), ("", "../x.yaml"), ("ada_41", "ada_41_7_bomb.yaml"),
    ]  # fmt: skip


HOSTILE = {
    "fences.md": "---\n" + "\n" * 2_000_000,
    "blanks.md": "---\n" + " " * 1_000_000 + "\n---",
    "field.yaml": "problem:" + " \t" * 1_000_000,
    "fields.yaml": "problem: " * 200_000,
    "student.yaml": ("student" + " " * 30 + "\n") * 50_000,
    "tags.html": "<h1" * 600_000,
    "headings.html": "<h1>" * 500_000,
    "attributes.html": ("<h1" + " a" * 100) * 9_000,
    "setext.md": ("x" * 300 + "\n=") * 6_000,
    "titles.tex": "\\title{" * 200_000,
    "hashes.md": "#" * 2_000_000,
    "spaces.md": "# " * 1_000_000,
    "nested.ipynb": "[" * 2_000_000,
    "cells.ipynb": '{"cells": [' + "{}," * 500_000 + "{}]}",
    "sources.ipynb": '{"cells": [{"source": ' + "[" * 900 + "]" * 900 + "}]}",
    "number.ipynb": "9" * 2_000_000,
    "zeros.yaml": "\0" * 2_000_000,
    "comment.html": "<!--" * 500_000,
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_sorted_quickly(problems: ProblemSet, tmp_path: Path, name: str) -> None:
    (tmp_path / "good.yaml").write_text("problem: in3140-rp\n" + ANSWER)
    (tmp_path / name).write_text(HOSTILE[name][:2_000_000])
    start = time.process_time()
    intake = take_in(problems, Uploads(tmp_path))
    assert time.process_time() - start < 0.5
    assert "good" in {hand_in.student for hand_in in intake.hand_ins}


# -- zips that students hand in ----------------------------------------------------------------------


def _zipped(files: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return out.getvalue()


ZIPPED = {
    "in3140-rp.yaml": ANSWER.encode(),
    "work/planar-2r.yaml": b"answers:\n  g2: 0\n",
    "photo.jpg": b"x",
    "more.zip": _zipped({"in3140-rp.yaml": ANSWER.encode()}),
    "__MACOSX/._in3140-rp.yaml": b"x",
}


@pytest.mark.parametrize(
    ("name", "student"),
    [("lovelaceada_41_7_all.zip", "lovelaceada_41"), ("s1/all.zip", "s1"), ("s1.zip", "s1")],
)
def test_a_zip_that_was_handed_in_is_opened(
    problems: ProblemSet, tmp_path: Path, name: str, student: str
) -> None:
    path = tmp_path / name
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(_zipped(ZIPPED))
    (tmp_path / "other_42_8_in3140-rp.yaml").write_text(ANSWER)
    uploads = Uploads(tmp_path)
    intake = take_in(problems, uploads, {})
    found = {
        h.problem: [uploads.read(f.upload) for f in h.files] for h in intake.hand_ins if h.student == student
    }
    assert found == {"in3140-rp": [ZIPPED["in3140-rp.yaml"]], "planar-2r": [ZIPPED["work/planar-2r.yaml"]]}
    assert sorted(PurePosixPath(w.file).name for w in intake.waiting) == ["more.zip", "photo.jpg"]


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"no zip", "an archive: it is damaged, or no zip"),
        (_zipped({}), "an archive without a file in it"),
        (_zipped({"bomb.yaml": bytes(1_900_000)}), "it unpacks to far more than it is (a zip bomb)"),
        (_zipped({"../x.yaml": b"K: 0"}), "its name leads out of the folder"),
    ],
)
def test_a_zip_that_cannot_be_opened_waits(
    problems: ProblemSet, tmp_path: Path, content: bytes, reason: str
) -> None:
    (tmp_path / "ada_41_7_in3140-rp.zip").write_bytes(content)
    intake = take_in(problems, Uploads(tmp_path), {})
    assert [(w.student, w.problem, w.reason) for w in intake.waiting] == [("ada_41", "in3140-rp", reason)]
    assert not intake.hand_ins


def test_a_zip_holds_no_more_than_the_bounds(problems: ProblemSet, tmp_path: Path) -> None:
    files = {f"{i}/in3140-rp.yaml": ANSWER.encode() for i in range(MAX_INSIDE + 3)}
    (tmp_path / "ada_41_7_in3140-rp.zip").write_bytes(_zipped(files))
    intake = take_in(problems, Uploads(tmp_path), {})
    assert [len(h.files) for h in intake.hand_ins] == [MAX_INSIDE]
    assert {w.reason for w in intake.waiting} == {"the zip holds too much"}
