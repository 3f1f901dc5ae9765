"""Which problem a file, or a part of a report, is for."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import pytest

import dynsolve
from dynsolve.answers.reading.files import FORMATS, pandoc
from dynsolve.answers.reading.sources import hidden
from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import Uploads
from dynsolve.grading.which_problem import parts
from dynsolve.problem import load
from dynsolve.problem.reader import find
from tests.unit.grading.taken import ANSWER, taken_in

# -- which problem a hand-in is for, and which of several files counts -------------------------------


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


# -- reports on several problems: which part is for which --------------------------------------------


STEMS = ("in3140-rp", "planar-2r")


def named(title: str) -> str:
    return next((stem for stem, word in zip(STEMS, ("rp manip", "planar"), strict=True) if word in title), "")


def told(text: str) -> dict[str, str]:
    found = parts(text, named, STEMS)
    return {stem: " ".join(hidden(text, others).split()) for stem, others in found.items()}


RP, PLANAR = "K = 1", "K = 2"
REPORTS = [
    f"# rp manip\n{RP}\n# planar\n{PLANAR}\n",
    f"## planar\n{PLANAR}\n### energies\n## rp manip\n{RP}\n",
    f"# Problem 1\n{RP}\n# Problem 2\n{PLANAR}\n",
    f"# Oppgave 2: kinematics\n{PLANAR}\n# Oppgave 1\n{RP}\n",
    f"# Problem 1: rp manip\n{RP}\n# Problem 2\n{PLANAR}\n",
    f"\\section*{{Exercise 1}}\n{RP}\n\\section*{{Exercise 2}}\n{PLANAR}\n",
    f"<h2>rp manip</h2>{RP}\n<h2 class='x'><b>planar</b></h2>{PLANAR}\n",
    f"**Problem 1**\n{RP}\n**Problem 2**\n{PLANAR}\n",
    f"Problem 1\n{RP}\nProblem 2:\n{PLANAR}\n",
    f"rp manip\n========\n{RP}\nplanar\n======\n{PLANAR}\n",
]


@pytest.mark.parametrize("text", REPORTS)
def test_the_parts_of_a_report(text: str) -> None:
    for before in ("", "\\newcommand{\\x}{y}\n"):
        found = told(before + text)
        assert RP in found["in3140-rp"]
        assert PLANAR not in found["in3140-rp"]
        assert PLANAR in found["planar-2r"]
        assert RP not in found["planar-2r"]
        assert all(before.strip() in part for part in found.values())


@pytest.mark.parametrize(
    "text",
    [
        f"# rp manip\n{RP}\n# energies\n{PLANAR}\n",
        f"# rp manip\n## Task 1\n{RP}\n## Task 2\n{PLANAR}\n",
        f"# rp manip\n## Problem 2\n{RP}\n",
        f"# Problem 1\n{RP}\n# Problem 7\n{PLANAR}\n",
        "no heading\n",
        "",
    ],
)
def test_a_report_on_one_problem_is_whole(text: str) -> None:
    assert told(text) == {}


def test_lines_keep_their_numbers() -> None:
    text = REPORTS[0]
    for others in parts(text, named, STEMS).values():
        assert len(hidden(text, others)) == len(text)
        assert hidden(text, others).count("\n") == text.count("\n")


MARKDOWN = """The energies of both.

# RP manipulator

$$g = \\begin{bmatrix} 0 \\\\ 0 \\end{bmatrix}$$

# Planar two-link arm

$$g_2 = m_2 g l_{c2} \\cos(q_1 + q_2)$$
"""


@pytest.mark.parametrize("ending", [".md", *FORMATS])
def test_each_part_earns_its_own_marks(tmp_path: Path, ending: str) -> None:
    folder, handed = tmp_path / "set", tmp_path / "handed"
    folder.mkdir()
    handed.mkdir()
    for stem in STEMS:
        (folder / f"{stem}.yaml").write_text(find(stem).read_text())
    title = load(find("planar-2r")).title
    content = MARKDOWN.replace("Planar two-link arm", title).encode()
    if ending != ".md":
        if pandoc() is None:
            pytest.skip("the extra `office` is not installed")
        program = [pandoc(), "-f", "markdown", "-t", FORMATS[ending], "-o", "-"]
        content = subprocess.run(program, input=content, capture_output=True, check=True).stdout
    (handed / f"ada{ending}").write_bytes(content)
    out = tmp_path / "out"
    dynsolve.grade(folder, handed, out, jobs=1)
    rows = [line.split(",")[:4] for line in (out / "answers.csv").read_text().splitlines()]
    assert ["ada", "in3140-rp", "g", "correct"] in rows
    assert [row for row in rows if row[2] == "g2"] == [["ada", "planar-2r", "g2", "correct"]]
