"""The head of a student's page, and what being late deducts: one line, the same wherever marks are told."""

from __future__ import annotations

import csv
import html
import re
from pathlib import Path

import pytest

import dynsolve
from dynsolve.problem.reader import find, read_problem
from tests.support import with_files

WORKSHEET = """\
Identifier,Full name,Email address,Status,Grade,Maximum Grade,Last modified (grade),Feedback comments
Participant 41,Ada <i>Lovelace,ada@x,Submitted for grading - ,,6.00,-,
Participant 42,Åse Ærlig,ase@x,Submitted for grading - 1 day 2 hours late,,6.00,-,
Participant 43,Wei 王,wei@x,Submitted for grading - 2 hours late,,6.00,-,
"""
HAND_IN = "answers:\n  K: I1zz*theta1'^2/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n  g: [0, 0]\n"
POLICY = "title: Assignment 2\nmarks: {in3140-rp: {K: 4, g: 1}}\npolicy: {late: [0.9, 0.5]}\n"
ADA, ÅSE, WEI = "Ada Lovelace_41", "Åse Ærlig_42", "Wei 王_43"


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("course")
    with_files(
        folder / "set", {"in3140-rp.yaml": find("in3140-rp").read_bytes(), "set.yaml": POLICY.encode()}
    )
    names = [f"{who}_assignsubmission_file/in3140-rp.yaml" for who in (ADA, ÅSE)]
    with_files(folder / "in", dict.fromkeys(names, HAND_IN))
    with_files(folder / "in", {f"{WEI}_assignsubmission_file/scan.pdf": b"%PDF"})
    (folder / "worksheet.csv").write_text(WORKSHEET)
    dynsolve.grade(
        folder / "set", folder / "in", folder / "out", lms="moodle", roster=folder / "worksheet.csv", jobs=1
    )
    return folder


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as stream:
        return list(csv.DictReader(stream))


def _page(course: Path, student: str, ending: str) -> str:
    return (course / "out" / "feedback" / student / f"in3140-rp.{ending}").read_text()


def test_each_answer_has_its_full_marks_and_one_line_deducts(course: Path) -> None:
    answers = [(row["student"], row["answer"], row["marks"]) for row in _rows(course / "out" / "answers.csv")]
    assert answers[:2] == [(ADA, "K", "4"), (ADA, "g", "1")]
    assert answers[-2:] == [(ÅSE, "K", "4"), (ÅSE, "g", "1")]
    totals = {
        row["student"]: (row["in3140-rp"], row["total"]) for row in _rows(course / "out" / "grades.csv")
    }
    assert totals == {ADA: ("5", "5"), ÅSE: ("2.5", "2.5"), WEI: ("", "0")}
    page = _page(course, ÅSE, "md")
    assert "**Marks: 2.5 of 5**" in page and page.count("| late ") == 1
    assert "| K | 4 of 4 | correct: 4 of 4 |\n| g | 1 of 1 | correct: 1 of 1 |\n" in page
    assert "| late | −2.5 | 50 % of 5 is 2.5 |" in page
    assert "late" not in _page(course, ADA, "html").partition("</style>")[2]
    cells = re.findall("<td>([^<]*)</td>", _page(course, ÅSE, "html"))
    assert cells[-3:] == ["late", "−2.5", "50 % of 5 is 2.5"]
    exported = {row["Identifier"]: row for row in _rows(course / "out" / "moodle.csv")}
    assert exported["Participant 42"]["Grade"] == "2.50" or exported["Participant 42"]["Grade"] == "2.5"
    assert exported["Participant 42"]["Feedback comments"] == "in3140-rp: 2.5 (late: -2.5)"
    report = (course / "out" / "report.html").read_text()
    assert "<td>2.5</td><td>-2.5</td>" in report


@pytest.mark.parametrize("ending", ["html", "md"])
def test_the_name_and_the_assignment_head_the_page_and_the_marks_come_first(
    course: Path, ending: str
) -> None:
    title = read_problem(find("in3140-rp").read_text(), "in3140-rp.yaml").title
    page = _page(course, ADA, ending)
    if ending == "html":
        assert f"<title>{html.escape(title)}: Ada &lt;i&gt;Lovelace</title>" in page
        page = page.partition("</style>")[2]
    assert page.index("Lovelace") < page.index("Assignment 2") < page.index("Marks: 5 of 5")
    assert page.index("correct: 1 of 1") < page.index("All 2 answers are correct.")
    assert "<i>" not in page


def test_what_a_teacher_sets_for_an_answer_is_of_the_answer_and_late_deducts_from_all(course: Path) -> None:
    dynsolve.override(course / "out", ÅSE, "in3140-rp", "K", marks=2, why="half")
    totals = {row["student"]: row["total"] for row in _rows(course / "out" / "grades.csv")}
    assert totals == {ADA: "5", ÅSE: "1.5", WEI: "0"}
    words = (course / "set", course / "in", course / "out")
    told = dynsolve.grade(*words, lms="moodle", roster=course / "worksheet.csv", diff=True).changes
    assert [line.partition(" (")[0] for line in told] == [
        f"{ÅSE} in3140-rp K: 4 -> 2",
        f"{ÅSE} in3140-rp late: -2.5 -> -1.5",
    ]


def test_what_a_human_reads_is_late_like_what_the_program_reads(course: Path) -> None:
    for answer, marks in (("K", 4), ("g", 1)):
        dynsolve.override(course / "out", "王 Wei", "in3140-rp", answer, marks=marks, why="on paper")
    (wei,) = (row for row in _rows(course / "out" / "grades.csv") if row["student"] == WEI)
    assert wei["total"] == "4.5"
    assert "| late | −0.5 | 90 % of 5 is 4.5 |" in _page(course, WEI, "md")
