"""Which problem a hand-in is for, and which of several files counts."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import Uploads
from tests.unit.grading.taken import ANSWER, taken_in


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
    intake = taken_in(problems, tmp_path, files)
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
    intake = taken_in(problems, tmp_path, {"ada_1_2_hw.yaml": text, "bob.yaml": text, "eve/a.yaml": text})
    assert [h.student for h in intake.hand_ins] == ["ada_1", "eve", "s9"]


def test_the_newest_copy_counts_and_the_other_is_named(problems: ProblemSet, tmp_path: Path) -> None:
    text = "problem: in3140-rp\nstudent: s9\n" + ANSWER
    files = {"first.yaml": text, "second.yaml": text}
    intake = taken_in(problems, tmp_path, files)
    os.utime(tmp_path / "first.yaml", (2_000_000_000, 2_000_000_000))
    intake = take_in(problems, Uploads(tmp_path))
    (hand_in,) = intake.hand_ins
    assert ([f.name for f in hand_in.files], hand_in.left) == (["first.yaml"], ("second.yaml",))


def test_a_late_copy_is_another_copy(problems: ProblemSet, tmp_path: Path) -> None:
    files = {"ada_1_20_in3140-rp.yaml": ANSWER, "ada_LATE_1_30_in3140-rp.yaml": ANSWER}
    (hand_in,) = taken_in(problems, tmp_path, files).hand_ins
    assert hand_in.late
    assert hand_in.left == ("ada_1_20_in3140-rp.yaml",)


def test_files_of_one_delivery_belong_together(problems: ProblemSet, tmp_path: Path) -> None:
    files = {"ada_1_20_in3140-rp-a.yaml": ANSWER, "ada_1_21_in3140-rp-b.yaml": ANSWER, "bob.txt": "x"}
    hand_in = taken_in(problems, tmp_path, files).hand_ins[0]
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
    intake = taken_in(problems, tmp_path, {"s1.md": text, "in3140-rp_s2.md": text})
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
    intake = taken_in(problems, tmp_path, {"s1.ipynb": json.dumps({"cells": cells})})
    assert [(h.student, h.problem) for h in intake.hand_ins] == [
        ("s1", stem) for stem in problems.stems[:2]
    ]  # fmt: skip
    assert not intake.waiting
