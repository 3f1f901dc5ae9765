"""Reports on several problems: which part is for which."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import dynsolve
from dynsolve.answers.reading.files import FORMATS, pandoc
from dynsolve.grading.which_problem import parts, without
from dynsolve.problem import load
from dynsolve.problem.reader import find

STEMS = ("in3140-rp", "planar-2r")


def named(title: str) -> str:
    return next((stem for stem, word in zip(STEMS, ("rp manip", "planar"), strict=True) if word in title), "")


def told(text: str) -> dict[str, str]:
    found = parts(text, named, STEMS)
    return {stem: " ".join(without(text, others).split()) for stem, others in found.items()}


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
        assert len(without(text, others)) == len(text)
        assert without(text, others).count("\n") == text.count("\n")


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
