"""Pages of students and of the course."""

from __future__ import annotations

import base64
import csv
import html
import re
from pathlib import Path

import pytest

import dynsolve
from dynsolve.grading.teacher import HEAD_HERE, unpack
from dynsolve.grading.work import grade_one
from dynsolve.problem.reader import find, read_problem
from tests.support import ROOT, with_files

# -- what a student reads: true, no more than the policy allows, and nothing of the student's is markup


TEXT = (ROOT / "problems" / "in3140-rp.yaml").read_text(encoding="utf-8")
MARKS = {"P": "2", "K": "4", "tau": "6", "D": "4"}
RIGHT = {
    "P": "m1*g*L1/2 + m2*g*L1",
    "K": "I1zz*theta1'^2/2 + m2*(L2'^2 + L2^2*theta1'^2)/2",
    "tau": "[(I1zz + m2*L2^2)*theta1'' + 2*m2*L2*L2'*theta1', m2*L2'' - m2*L2*theta1'^2]",
    "D": "[[I1zz + m2*L2^2, 0], [0, m2]]",
}


def _page(answers: dict[str, str], hints: int = 3, kind: str = "markdown", name: str = "a.yaml") -> str:
    lines = "".join(f"  {key}: {value}\n" for key, value in answers.items())
    return _of_text(f"answers:\n{lines}", hints, kind, name)


def _of_text(text: str, hints: int = 3, kind: str = "markdown", name: str = "a.yaml") -> str:
    policy = {"follow": "1", "caps": {}, "rounding": "1/100", "late": "1", "hints": hints}
    file = {"name": name, "content": base64.b64encode(text.encode()).decode()}
    payload = {
        "problem": {"file": "in3140-rp.yaml", "text": TEXT}, "marks": MARKS, "policy": policy,
        "files": [file],
    }  # fmt: skip
    return unpack(base64.b64decode(grade_one(payload)[kind]))


def test_the_first_slip_comes_first_with_what_was_written_set_beside() -> None:
    page = _page({**RIGHT, "K": "I1zz*theta1'^2/2 + m2*(L2'^2 + L2*theta1'^2)/2"})
    first = page.index("It first went wrong at K (line 3).")
    slip = page.index("### K: wrong")
    assert page.index(HEAD_HERE) < first < slip < page.index("## How the answers were read")
    assert r"K = \frac{I_{1,zz} \dot{\theta}_{1}^{2}}{2}" in page[slip:]
    assert "the $L_{2}$ should be squared" in page[slip:]
    assert "tau (line 4), correct (right, though your own earlier answers lead elsewhere):" in page
    assert "D (line 5), correct: `[[I_1zz + m₂ L₂², 0], [0, m₂]]`" in page


def test_what_is_said_of_everything_is_said_of_the_entry_that_it_holds_for() -> None:
    page = _page({"D": "[[-I1zz - m2*L2^2, 0], [0, m2]]"})
    assert "- Entry (1, 1) has the wrong sign." in page
    page = _page(
        {"tau": "[2*(I1zz + m2*L2^2)*theta1'' + 4*m2*L2*L2'*theta1', 2*m2*L2'' - 2*m2*L2*theta1'^2]"}
    )
    assert "- Your answer is 2 times what it should be." in page


def test_an_answer_that_follows_says_from_what() -> None:
    slipped = {"K": "I1zz*theta1'^2 + m2*(L2'^2 + L2^2*theta1'^2)/2"}
    follows = {"tau": "[(2*I1zz + m2*L2^2)*theta1'' + 2*m2*L2*L2'*theta1', m2*L2'' - m2*L2*theta1'^2]"}
    page = _page({"P": RIGHT["P"], **slipped, **follows})
    assert "1 later answer follows from earlier slips." in page
    assert "tau (line 4), follows from your earlier answers (from K):" in page


@pytest.mark.parametrize("hints", [1, 2, 3])
def test_who_writes_nothing_of_it_is_not_told_the_answer(hints: int) -> None:
    page = _page(dict.fromkeys(RIGHT, "0") | {"tau": "[0, 0]", "D": "[[0, 0], [0, 0]]"}, hints)
    told = re.sub(r"(?s)\$\$.*?\$\$|`[^`]*`", "", page)  # what the student wrote stands there, set
    assert not re.search(r"m_\{|L_\{|theta|I_", told), told


def test_a_right_term_is_not_said_to_be_wrong_because_an_earlier_answer_is() -> None:
    page = _page({"K": "0", "tau": RIGHT["tau"].replace("2*m2", "m2")})
    assert "does not belong" not in page
    assert "has 1 in front where 2 belongs" in page


def test_each_level_tells_where_what_kind_and_how() -> None:
    answers = {**RIGHT, "tau": RIGHT["tau"].replace("2*m2", "m2")}
    where, kind, how = (_page(answers, hints) for hints in (1, 2, 3))
    for page in (where, kind, how):
        assert "It first went wrong at tau (line 4)." in page
        assert "Wrong in entry 1; the others are right or follow." in page
    assert "kind of slip" not in where and "in front" not in where
    assert "What kind of slip: a factor such as ½." in kind and "in front" not in kind
    assert "has 1 in front where 2 belongs" in how


def test_each_slip_of_a_matrix_says_in_which_entry_it_is() -> None:
    slipped = {**RIGHT, "D": "[[I1zz + m2*L2^2 + m1*L2^2, 0], [0, 2*m2]]"}
    page = _page(slipped)
    assert "Wrong in entries (1, 1), (2, 2); the others are right or follow." in page
    assert "- Entry (1, 1): The term $m_{1}$ $L_{2}^{2}$ does not belong here." in page
    assert "- Entry (2, 2) is 2 times what it should be." in page


def test_without_answers_it_says_how_they_are_written() -> None:
    assert "No answer was found in it. The name stands before the value: `K = ...`, and" in _of_text(
        "answers: {}\n"
    )


def test_what_could_not_be_read_is_shown_as_it_was_typed() -> None:
    page = _page({"K": "m2*(L2'^2 +", "P": "m_1 # <b>*x*</b> `q`"})
    assert "Line 2: the formula ends here too early." in page
    assert "`K: m2*(L2'^2  ▸+◂`" in page
    assert "<b>" not in re.sub(r"``.*?``", "", page)


HOSTILE = (
    "---\nproblem: in3140-rp\n---\n# <script>alert(1)</script>\n\n"
    "$$<img src=x onerror=alert(1)> = 1$$\n\n$$Q_{\\text{[x](javascript:alert(1))}} = `</code><b>`$$\n\n"
    "$$K = \\text{</p><script>alert(2)</script>}$$\n\n$$P = m_1 \u202e g$$\n"
)


def test_nothing_that_a_student_writes_is_markup() -> None:
    html = _of_text(HOSTILE, kind="html", name="<script>.md")
    for sign in ("<script", "<img", "<b>", 'javascript:alert(1))"'):
        assert sign not in html.replace("&lt;", "")
    assert "\u202e" not in html
    plain = re.sub(r"(?s)(`+).*?\1", "", _of_text(HOSTILE))
    assert "<script" not in plain and "<img" not in plain and "](javascript" not in plain


# -- The head of a student's page, and what being late deducts: one line, the same wherever marks are told


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


def _page_of(course: Path, student: str, ending: str) -> str:
    return (course / "out" / "feedback" / student / f"in3140-rp.{ending}").read_text()


def test_each_answer_has_its_full_marks_and_one_line_deducts(course: Path) -> None:
    answers = [(row["student"], row["answer"], row["marks"]) for row in _rows(course / "out" / "answers.csv")]
    assert answers[:2] == [(ADA, "K", "4"), (ADA, "g", "1")]
    assert answers[-2:] == [(ÅSE, "K", "4"), (ÅSE, "g", "1")]
    totals = {
        row["student"]: (row["in3140-rp"], row["total"]) for row in _rows(course / "out" / "grades.csv")
    }
    assert totals == {ADA: ("5", "5"), ÅSE: ("2.5", "2.5"), WEI: ("", "0")}
    page = _page_of(course, ÅSE, "md")
    assert "**Marks: 2.5 of 5**" in page and page.count("| late ") == 1
    assert "| K | 4 of 4 | correct: 4 of 4 |\n| g | 1 of 1 | correct: 1 of 1 |\n" in page
    assert "| late | −2.5 | 50 % of 5 is 2.5 |" in page
    assert "late" not in _page_of(course, ADA, "html").partition("</style>")[2]
    cells = re.findall("<td>([^<]*)</td>", _page_of(course, ÅSE, "html"))
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
    page = _page_of(course, ADA, ending)
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
    assert "| late | −0.5 | 90 % of 5 is 4.5 |" in _page_of(course, WEI, "md")
