"""What waits for a human: one list, the same on the page, in `queue.csv` and for a Python user."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from urllib.parse import unquote

import pytest

import dynsolve
from dynsolve.grading.public import Grades
from dynsolve.problem.reader import find
from tests.support import with_files

D = "answers:\n  D: [[I1zz + m2*L2^2, 0], [0, m2]]\n  tau: [0, 0\n"
FILES: dict[str, str | bytes] = {
    "ann/in3140-rp.yaml": D,
    "ann/in3140-rp notes.pdf": b"%PDF",  # beside what was judged
    "bob/in3140-rp.pdf": b"%PDF",
    "cat/work.pdf": b"%PDF",  # of no problem that is known
    "dan/in3140-rp.yaml": "no answer here",
}


@pytest.fixture
def course(tmp_path: Path) -> Path:
    for name in ("in3140-rp", "planar-2r"):
        with_files(tmp_path / "set", {f"{name}.yaml": find(name).read_bytes()})
    (tmp_path / "set" / "set.yaml").write_text("marks: {in3140-rp: {D: 4, tau: 2}, planar-2r: {g: 1}}\n")
    with_files(tmp_path / "in", FILES)
    return tmp_path


def _grade(course: Path) -> Grades:
    return dynsolve.grade(course / "set", course / "in", course / "out", jobs=1)


def _queue(course: Path) -> list[dict[str, str]]:
    with (course / "out" / "queue.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


def _number(course: Path) -> int:
    page = (course / "out" / "report.html").read_text()
    (said,) = re.findall('<p class="waits">([0-9]+|No) entr(?:y|ies) wait', page)
    assert page.count(f"<caption>{said} entr") == 1
    return int(said)


def test_the_page_the_file_and_the_run_agree(course: Path) -> None:
    grades = _grade(course)
    rows = _queue(course)
    assert [(row["student"], row["problem"], row["answer"]) for row in rows] == [
        ("ann", "in3140-rp", ""),
        ("bob", "in3140-rp", "D"), ("bob", "in3140-rp", "tau"),
        ("cat", "in3140-rp", "D"), ("cat", "in3140-rp", "tau"), ("cat", "planar-2r", "g"),
        ("dan", "in3140-rp", "D"), ("dan", "in3140-rp", "tau"),
        ("ann", "in3140-rp", "tau"),
    ]  # fmt: skip
    assert rows[0]["reason"] == "ann/in3140-rp notes.pdf: a PDF: a human reads it"
    assert len(grades.queue) == _number(course) == len(rows)


def test_what_a_teacher_has_marked_waits_no_more(course: Path) -> None:
    _grade(course)
    for student, answers in (("bob", ("D", "tau")), ("ann", ("tau",))):
        for answer in answers:
            dynsolve.override(course / "out", student, "in3140-rp", answer, marks=1, why="on paper")
    assert {row["student"] for row in _queue(course)} == {"cat", "dan"}
    assert _number(course) == len(_grade(course).queue) == len(_queue(course)) == 5


def test_who_waits_is_counted_nowhere_but_there(course: Path) -> None:
    """Of nine students three have a file for the queue, and cat one of no problem, which may be for any."""
    settled = {f"s{i}/{stem}.yaml": f"answers:\n  D: [[{i}*m2, 0], [0, m2]]\n  g: [0, 0]\n"
               for i in range(5) for stem in ("in3140-rp", "planar-2r")}  # fmt: skip
    with_files(course / "in", settled | {"s4/planar-2r.yaml": "answers:\n  g: [0, (\n"})
    _grade(course)
    waiting = {(row["student"], row["problem"]) for row in _queue(course)}
    page = (course / "out" / "report.html").read_text()
    with (course / "out" / "grades.csv").open(newline="") as stream:
        marks = {row["student"]: float(row["total"]) for row in csv.DictReader(stream)}
    counted = [marks[student] for student in marks if student not in {student for student, _ in waiting}]
    assert 0 < len(counted) < len(marks)
    mean = sum(counted) / len(counted)
    assert f"{len(marks)} students, of whom {len(marks) - len(counted)} wait and are not counted; " in page
    assert f"the mean is {mean:.2f}," in page
    assert f"All problems: {len(counted)} students, mean {mean:.2f} of 7<" in page
    for stem in ("in3140-rp", "planar-2r"):
        judged = [name for name in ("ann", *(f"s{i}" for i in range(5))) if (name, stem) not in waiting]
        handed_in = [name for name in judged if name != "ann" or stem == "in3140-rp"]
        assert f"{stem}: {len(handed_in)} students, mean" in page
    (g,) = re.findall(r'<tr><td>planar-2r</td><td>g</td>(<td class="number">.*?)</tr>', page)
    counts = [int(text) for text in re.findall(r'<td class="heat \w+"[^>]*>(\d+)</td>', g)]
    assert counts[-1] == sum(stem == "planar-2r" for _, stem in waiting) and sum(counts) == len(marks)


def test_every_hand_in_is_a_link_away_as_text_or_as_what_a_browser_shows(course: Path) -> None:
    _grade(course)
    page = (course / "out" / "report.html").read_text()
    links = set(re.findall('href="(hand-ins/[^"]+)"', page))
    names = {path.name for path in (course / "out" / "hand-ins").iterdir()}
    assert {unquote(link.removeprefix("hand-ins/")) for link in links} == names
    endings = sorted(name.partition("-")[2] for name in names)
    assert endings == ["in3140-rp notes.pdf", "in3140-rp.pdf", *2 * ["in3140-rp.yaml.txt"], "work.pdf"]
    (course / "in" / "ann" / "in3140-rp notes.pdf").unlink()
    _grade(course)
    assert len(list((course / "out" / "hand-ins").iterdir())) == 4


def test_nothing_that_a_student_wrote_runs_when_a_teacher_opens_it(course: Path) -> None:
    with_files(
        course / "in", {"eve/in3140-rp.html": "<script>1</script>", "eve/x.svg": "<svg/>", "eve/odd": "<p>"}
    )
    _grade(course)
    names = [path.name for path in (course / "out" / "hand-ins").iterdir()]
    assert {name.rpartition(".")[2] for name in names} == {"txt", "pdf"}


def test_an_answer_that_only_a_line_names_waits_with_that_line(tmp_path: Path) -> None:
    with_files(tmp_path / "set", {"in3140-rp.yaml": find("in3140-rp").read_bytes()})
    (tmp_path / "set" / "set.yaml").write_text("marks: {in3140-rp: {D: 4, C: 2, g: 1}}\n")
    text = "$$g = [0, 0]^T$$\n\nIf $D = X_7$, as said before, we get the rest.\n"
    with_files(tmp_path / "in", {"ann/in3140-rp.md": text.encode()})
    grades = _grade(tmp_path)
    (row,) = _queue(tmp_path)
    assert (row["answer"], _number(tmp_path)) == ("D", len(grades.queue))
    assert "line 3" in row["reason"] and "X_7" in row["reason"]
    assert "X_7" in (tmp_path / "out" / "feedback" / "ann" / "in3140-rp.html").read_text()
