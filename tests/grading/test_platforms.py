"""Downloads of the three platforms, whole: they come in as they are, and what is imported goes out.

The trees are made as the platforms make them: `lib/content_zipper.rb` and
`app/views/assignments/text_entry_page.html.erb` of instructure/canvas-lms, `mod/assign/locallib.php`,
`mod/assign/gradingtable.php` and `mod/assign/submission/onlinetext/locallib.php` of moodle/moodle,
and the exports and grade lists of Gradescope, with names, numbers and texts that are invented.
"""

from __future__ import annotations

import csv
import json
import re
import zipfile
from pathlib import Path

import pytest

import dynsolve
from dynsolve.grading.public import Grades
from tests.support import ROOT

pytestmark = pytest.mark.slow

K = "(I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2"
RIGHT = f"answers:\n  K: {K}\n  g: [0, 0]\n"
WRONG = RIGHT.replace("L2^2*theta1'^2)", "L2*theta1'^2)")
PLANAR = "answers:\n  g2: m2*g*lc2*cos(q1 + q2)\n"
LATEX_K = r"K = \frac{1}{2} I_{1zz} \dot{\theta}_1^2 + \frac{1}{2} m_2 (\dot{L}_2^2 + L_2^2 \dot{\theta}_1^2)"

CANVAS_PAGE = """\
<!DOCTYPE html PUBLIC "-//W3C//DTD XHTML 1.0 Transitional//EN"
        "http://www.w3.org/TR/xhtml1/DTD/xhtml1-transitional.dtd">
<html xmlns="http://www.w3.org/1999/xhtml">
<head>
  <meta http-equiv="Content-Type" content="text/html;charset=utf-8" />
  <title>Assignment 2, in3140-rp: Åse Ærlig</title>
</head>
<body>
<h1>Assignment 2, in3140-rp: Åse Ærlig</h1>
<div style="width: 600px; margin: 20px auto; border: 1px solid #888; padding: 20px;">
  {body}
</div>
</body>
</html>
"""
CANVAS_EQUATION = (
    '<p><img class="equation_image" title="x" src="/equation_images/K?scale=1" alt="LaTeX: {latex}" '
    'data-equation-content="{latex}" data-ignore-a11y-check=""></p>'
)
MOODLE_PAGE = '<!DOCTYPE html><html><head><meta charset="UTF-8"></head><body>{body}</body></html>'


@pytest.fixture
def problems(tmp_path: Path) -> Path:
    folder = tmp_path / "set"
    folder.mkdir()
    for name in ("in3140-rp", "planar-2r"):
        (folder / f"{name}.yaml").write_text((ROOT / "problems" / f"{name}.yaml").read_text())
    (folder / "set.yaml").write_text(
        "title: Assignment 2\nmarks: {in3140-rp: {K: 4, g: 2}, planar-2r: {g2: 1}}\npolicy: {late: 1/2}\n"
    )
    return folder


def _zip(path: Path, files: dict[str, str | bytes]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def _rows(path: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines()))


def _totals(out: Path) -> dict[str, str]:
    return {row["student"]: row["total"] for row in _rows(out / "grades.csv")}


def _waiting(grades: Grades) -> dict[str, str]:
    return {waiting.file.rpartition("_")[2]: waiting.reason for waiting in grades.waiting}


CANVAS: dict[str, str | bytes] = {
    "lovelaceada_101_9001_in3140-rp.yaml": RIGHT,
    "lovelaceada_101_9002_planar-2r-1.yaml": PLANAR,
    "babbagecharles_LATE_102_9003_in3140-rp.yaml": RIGHT,
    "van_der_bergåse_103_text.html": CANVAS_PAGE.format(body=CANVAS_EQUATION.format(latex=LATEX_K)),
    "hoppergrace_104_9004_Scan 1.pdf": b"%PDF-1.7",
    "hoppergrace_104_9005_report.docx": b"PK",
    "hoppergrace_104_9006_IMG_2041.HEIC": b"",
    "group1_105_9007_my answers.yaml": "problem: in3140-rp\n" + WRONG,
    "noetheremmy_106_link.html": "<a href='http://example.org'>in3140-rp</a>",
    "noetheremmy_107_9008_in3140-rp.md": f"# On the RP manipulator\r\n\r\n$$\r\n{LATEX_K}\r\n$$\r\n",
    "curiemarie_108_9009_hw.tex": "\\section{RP manipulator}\n\\[ g_1 = 0 \\]\n\\[ g_2 = 0 \\]\n",
    "curiemarie_108_9010_other.txt": "K = 0\n",
}


def test_a_download_of_canvas(tmp_path: Path, problems: Path) -> None:
    archive = _zip(tmp_path / "submissions.zip", CANVAS)
    roster = tmp_path / "grades.csv"
    names = {101: "Lovelace, Ada", 102: "Babbage, Charles", 103: "van_der Berg, Åse", 109: "No, One"}
    lines = ["Student,ID,SIS User ID,SIS Login ID,Section,Assignment 2 (55)", "    Points Possible,,,,,7"]
    lines += [f'"{name}",{id},s{id},u{id},A,' for id, name in names.items()]
    roster.write_text("\n".join(lines) + "\n")
    out = tmp_path / "out"
    grades = dynsolve.grade(problems, archive, out, lms="canvas", roster=roster, jobs=2)
    assert _totals(out) == {
        "lovelaceada_101": "7", "babbagecharles_102": "3", "van_der_bergåse_103": "4",
        "hoppergrace_104": "0", "group1_105": "2", "noetheremmy_106": "0", "noetheremmy_107": "4",
        "curiemarie_108": "2",
    }  # fmt: skip
    waiting = {name: re.sub(r"(a human reads it).*", r"\1", why) for name, why in _waiting(grades).items()}
    assert waiting == {
        "Scan 1.pdf": "a PDF: a human reads it",
        "report.docx": "a Word file: a human reads it",
        "2041.HEIC": "a picture: a human reads it",
        "link.html": "an address: a human reads it",
        "other.txt": "neither its front matter, its name nor its heading says which problem it is for",
    }
    assert {row["ID"]: row["Assignment 2 (55)"] for row in _rows(out / "canvas.csv") if row["ID"]} == {
        "101": "7", "102": "3", "103": "4", "109": "",
    }  # fmt: skip
    report = (out / "report.html").read_text()
    assert "Lovelace, Ada (lovelaceada_101)" in report and ">noetheremmy_107<" in report
    with zipfile.ZipFile(out / "canvas-comments.zip") as packed:
        comments = {name: packed.read(name).decode() for name in packed.namelist()}
    assert sorted(comments) == [
        "babbagecharles_LATE_102_9003_in3140-rp.yaml", "curiemarie_108_9009_hw.tex",
        "curiemarie_108_9010_other.txt",
        "group1_105_9007_my answers.yaml", "lovelaceada_101_9001_in3140-rp.yaml",
        "lovelaceada_101_9002_planar-2r-1.yaml", "noetheremmy_107_9008_in3140-rp.md",
    ]  # fmt: skip
    assert "**Marks: 1 of 1**" in comments["lovelaceada_101_9002_planar-2r-1.yaml"]
    cannot = "Canvas cannot give back the pages of who handed in no file that can carry them: "
    assert f"{cannot}hoppergrace_104; noetheremmy_106; van_der_bergåse_103" in grades.warnings
    page = (out / "feedback" / "babbagecharles_102" / "in3140-rp.html").read_text()
    assert "It was handed in late." in page


def test_an_anonymous_download_of_canvas(tmp_path: Path, problems: Path) -> None:
    files: dict[str, str | bytes] = {
        "anon_xY3aB_9001_in3140-rp.yaml": RIGHT,
        "LATE_anon_Q7c2d_9002_in3140-rp.yaml": RIGHT,
        "anon_9Zk1m_text.html": CANVAS_PAGE.format(body=f"<p>\\({LATEX_K}\\)</p>"),
    }
    dynsolve.grade(problems, _zip(tmp_path / "a.zip", files), tmp_path / "out", jobs=1)
    assert _totals(tmp_path / "out") == {"anon_xY3aB": "6", "anon_Q7c2d": "3", "anon_9Zk1m": "4"}


STATUS = {
    41: ("Ada Lovelace", "Submitted for grading"),
    42: ("Åse Ærlig-Øst", "Submitted for grading - 1 hour 5 mins late"),
    43: ("Wei 王", "Submitted for grading"),
    44: ("Ada Lovelace", "Submitted for grading"),
    45: ("No One", "No submission - Assignment is overdue by: 3 days"),
}
HEADER = (
    "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    "Last modified (submission),Last modified (grade),Feedback comments"
)
MOODLE = {
    "in folders": {
        "Ada Lovelace_41_assignsubmission_file/in3140-rp.yaml": RIGHT,
        "Ada Lovelace_41_assignsubmission_file/extra/planar-2r.yaml": PLANAR,
        "Åse Ærlig-Øst_42_assignsubmission_file/in3140-rp.yaml": RIGHT,
        "Wei 王_43_assignsubmission_onlinetext/onlinetext.html":
            MOODLE_PAGE.format(body=f"<h4>RP manipulator</h4><p>\\({LATEX_K}\\)<br></p>"),
        "Ada Lovelace_44_assignsubmission_file/in3140-rp.yaml": WRONG,
    },
    "of an old site": {
        "Ada Lovelace_41_assignsubmission_file_/in3140-rp.yaml": RIGHT,
        "Ada Lovelace_41_assignsubmission_file_/planar-2r.yaml": PLANAR,
        "Åse Ærlig-Øst_42_assignsubmission_file_/in3140-rp.yaml": RIGHT,
        "Wei 王_43_assignsubmission_onlinetext_/onlinetext.html":
            MOODLE_PAGE.format(body=f"<h4>RP manipulator</h4><p>$$ {LATEX_K} $$</p>"),
        "Ada Lovelace_44_assignsubmission_file_/in3140-rp.yaml": WRONG,
    },
    "without folders": {
        "Ada Lovelace_41_assignsubmission_file_in3140-rp.yaml": RIGHT,
        "Ada Lovelace_41_assignsubmission_file_planar-2r.yaml": PLANAR,
        "Åse Ærlig-Øst_42_assignsubmission_file_in3140-rp.yaml": RIGHT,
        "Wei 王_43_assignsubmission_onlinetext_onlinetext.html":
            MOODLE_PAGE.format(body=f'<h4>RP manipulator</h4><p><img class="texrender" alt="{LATEX_K}"></p>'),
        "Ada Lovelace_44_assignsubmission_file_in3140-rp.yaml": WRONG,
    },
}  # fmt: skip


@pytest.mark.parametrize("kind", MOODLE)
@pytest.mark.parametrize("around", ["", "IN3140-Assignment 2-55/"])
def test_a_download_of_moodle(tmp_path: Path, problems: Path, kind: str, around: str) -> None:
    files: dict[str, str | bytes] = {f"{around}{name}": text for name, text in MOODLE[kind].items()}
    files |= {f"__MACOSX/{around}._{name}": b"\0\5" for name in MOODLE[kind]}
    archive = _zip(tmp_path / "a.zip", files)
    roster = tmp_path / "Grades.csv"
    rows = [f"Participant {i},{name},a@x,{said},,7.00,Yes,-,-," for i, (name, said) in STATUS.items()]
    roster.write_text("\ufeff" + "\n".join([HEADER, *rows]) + "\n")
    out = tmp_path / "out"
    dynsolve.grade(problems, archive, out, lms="moodle", roster=roster, jobs=2)
    assert _totals(out) == {
        "Ada Lovelace_41": "7", "Ada Lovelace_44": "2", "Wei 王_43": "4", "Åse Ærlig-Øst_42": "3",
    }  # fmt: skip
    assert [row["Grade"] for row in _rows(out / "moodle.csv")] == ["7", "3", "4", "2", ""]
    with zipfile.ZipFile(out / "moodle-feedback.zip") as packed:
        assert {name.partition("/")[0] for name in packed.namelist()} == {
            f"{name}_{i}_assignfeedback_file" for i, (name, _) in STATUS.items() if i != 45
        }
    again = dynsolve.grade(problems, archive, out, jobs=2)  # the roster is kept, and who was late with it
    assert (again.computed, _totals(out)["Åse Ærlig-Øst_42"]) == (0, "3")


GROUPS = """\
Identifier,Full name,Email address,Status,Group,Grade,Maximum Grade,Last modified (grade),Feedback comments
Participant 41,Ada Lovelace,a@x,Submitted for grading,Group A,,7.00,-,
Participant 42,Åse Ærlig,b@x,Submitted for grading - 1 hour late,Group B,,7.00,-,
Participant 43,Wei 王,c@x,Submitted for grading,Group A,,7.00,-,
"""


def test_what_a_group_handed_in_reaches_its_members(tmp_path: Path, problems: Path) -> None:
    files: dict[str, str | bytes] = {
        "Group A_77_assignsubmission_file/in3140-rp.yaml": RIGHT,
        "Group A_77_assignsubmission_onlinetext/onlinetext.html":
            MOODLE_PAGE.format(body="<h4>planar-2r</h4><p>\\(g_2 = m_2 g l_{c2} \\cos(q_1 + q_2)\\)</p>"),
        "Group B_42_assignsubmission_file/in3140-rp.yaml": RIGHT,
    }  # fmt: skip
    roster, out = tmp_path / "Grades.csv", tmp_path / "out"
    roster.write_text(GROUPS, encoding="utf-8")
    archive = _zip(tmp_path / "a.zip", files)
    grades = dynsolve.grade(problems, archive, out, lms="moodle", roster=roster, jobs=1)
    assert _totals(out) == {"Ada Lovelace_41": "7", "Wei 王_43": "7", "Åse Ærlig_42": "3"}
    assert [row["Grade"] for row in _rows(out / "moodle.csv")] == ["7", "3", "7"] and grades.warnings == ()
    with zipfile.ZipFile(out / "moodle-feedback.zip") as packed:
        folders = {name.partition("/")[0] for name in packed.namelist()}
    assert folders == {"Group A_77_assignfeedback_file", "Group B_42_assignfeedback_file"}
    page = (out / "feedback" / "Wei 王_43" / "in3140-rp.html").read_text()
    assert "RP manipulator: Group A_77" in page
    dynsolve.override(out, "Wei 王_43", "in3140-rp", "K", marks=1, why="did not take part")
    with zipfile.ZipFile(out / "moodle-feedback.zip") as packed:  # a group's files reach all its members
        assert {name.partition("/")[0] for name in packed.namelist()} == {"Group B_42_assignfeedback_file"}


def test_an_export_of_gradescope(tmp_path: Path, problems: Path) -> None:
    metadata = (
        "submission_7:\n  :submitters:\n  - :name: Ada Lovelace\n    :sid: '0041'\n    :email: ada@x\n"
        "  - :name: Åse Ærlig\n    :sid: '0042'\n    :email: ase@x\n"
        "  :created_at: 2026-04-26 17:34:00.861687000 Z\n  :score: 0.0\n  :results:\n    output: |-\n"
        "      :submitters:\n      - :sid: thief\n  :history: []\n"
        "submission_8:\n  :submitters:\n  - :name: Wei 王\n    :sid:\n    :email: wei@x\n"
    )
    top = "assignment_555_export"
    files: dict[str, str | bytes] = {
        f"{top}/submission_7/in3140-rp.yaml": RIGHT,
        f"{top}/submission_7/figures/plot.png": b"",
        f"{top}/submission_8/src/in3140-rp.yaml": RIGHT,
        f"{top}/submission_metadata.yml": metadata,
    }
    roster = tmp_path / "scores.csv"
    roster.write_text(
        "First Name,Last Name,SID,Email,Sections,Total Score,Max Points,Status,Submission ID,"
        "Submission Time,Lateness (H:M:S),View Count,Submission Count\n"
        "Ada,Lovelace,0041,ada@x,,,7,Ungraded,7,2026-04-26 10:34:00 -0700,00:00:00,0,1\n"
        "Wei,王,,wei@x,,,7,Ungraded,8,2026-04-27 10:34:00 -0700,24:00:00,0,1\n"
    )
    out = tmp_path / "out"
    archive = _zip(tmp_path / "a.zip", files)
    grades = dynsolve.grade(problems, archive, out, lms="gradescope", roster=roster, jobs=1)
    assert _totals(out) == {"0041": "6", "0042": "6", "wei@x": "3"}
    assert {waiting.student for waiting in grades.waiting} == {"0041", "0042"}
    scores = {
        path.parent.name: json.loads(path.read_text())["score"]
        for path in out.glob("gradescope/*/results.json")
    }
    assert scores == {"submission_7": 6, "submission_8": 3}
