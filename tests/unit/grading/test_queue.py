"""What waits for a human, and marks that a human gives."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from urllib.parse import unquote

import pytest

import dynsolve
from dynsolve.errors import InputError
from dynsolve.grading.public import Grades, override_all
from dynsolve.problem.reader import find
from tests.support import with_files

# -- what waits for a human: one list, the same on the page, in `queue.csv` and for a Python user ----


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


# -- A human's marks in bulk: what a CSV sets, what it cannot, and what a resubmission overtakes -----


INERTIA = "answers:\n  D: [[I1zz + m2*L2^2, 0], [0, m2]]\n"


@pytest.fixture
def out(tmp_path: Path) -> Path:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "anna.yaml").write_text(INERTIA)
    (tmp_path / "in" / "bob.pdf").write_bytes(b"%PDF")
    _totals_of(tmp_path)
    return tmp_path / "out"


def _totals_of(tmp_path: Path) -> dict[str, str]:
    dynsolve.grade("in3140-rp", tmp_path / "in", tmp_path / "out", jobs=1)
    return _all_totals(tmp_path / "out")


def _all_totals(out: Path) -> dict[str, str]:
    return {row["student"]: row["total"] for row in _rows(out / "grades.csv")}


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as stream:
        return list(csv.DictReader(stream))


def _csv(tmp_path: Path, *rows: str) -> Path:
    path = tmp_path / "marks.csv"
    path.write_text("\n".join(["student,problem,answer,marks,comment", *rows]) + "\n")
    return path


def test_the_page_from_the_queue_is_filled_and_taken_back(tmp_path: Path, out: Path) -> None:
    rows = _rows(out / "queue.csv")
    assert [(row["student"], row["answer"], row["of"]) for row in rows] == [
        ("bob", name, "1") for name in ("tau", "D", "C", "g")
    ]
    assert all("a PDF" in row["reason"] for row in rows)
    assert [row["in3140-rp"] for row in _rows(out / "grades.csv")] == ["1", ""]
    path = tmp_path / "filled.csv"
    with path.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0])
        writer.writeheader()
        writer.writerows({**row, "marks": "1/2", "comment": "on paper"} for row in rows)
    assert override_all(out, path) == 4
    assert _all_totals(out) == {"anna": "1", "bob": "2"}
    assert not _rows(out / "queue.csv")
    assert "on paper" in (out / "feedback" / "bob" / "in3140-rp.md").read_text()


def test_a_comment_changes_no_marks(tmp_path: Path, out: Path) -> None:
    assert override_all(out, _csv(tmp_path, "anna,in3140-rp,D,,well done", "anna,in3140-rp,tau,,")) == 1
    assert _all_totals(out)["anna"] == "1"
    assert "the teacher: well done" in (out / "feedback" / "anna" / "in3140-rp.md").read_text()


def test_a_comment_on_what_nobody_has_judged_is_shown_and_it_still_waits(tmp_path: Path, out: Path) -> None:
    override_all(out, _csv(tmp_path, "bob,in3140-rp,D,,hand in a file that can be read"))
    page = (out / "feedback" / "bob" / "in3140-rp.md").read_text()
    assert page.count("the teacher: hand in a file that can be read") == 1 and "| tau |" not in page
    assert [row["in3140-rp"] for row in _rows(out / "grades.csv")] == ["1", ""]
    assert [row["answer"] for row in _rows(out / "queue.csv")] == ["tau", "D", "C", "g"]


def test_a_fault_changes_nothing_and_names_its_line(tmp_path: Path, out: Path) -> None:
    path = _csv(tmp_path, "anna,in3140-rp,tau,1,fine", "eve,in3140-rp,tau,1,", "anna,in3140-rp,D,7,")
    with pytest.raises(InputError) as caught:
        override_all(out, path)
    assert [finding.line for finding in caught.value.findings] == [3, 4]
    assert _all_totals(out)["anna"] == "1"


def test_marks_that_a_resubmission_has_overtaken_are_in_the_queue(tmp_path: Path, out: Path) -> None:
    override_all(out, _csv(tmp_path, "anna,in3140-rp,tau,1,at the board"))
    assert _totals_of(tmp_path)["anna"] == "2"
    assert not [row for row in _rows(out / "queue.csv") if row["student"] == "anna"]
    (tmp_path / "in" / "anna.yaml").write_text(INERTIA + "  g: [0, 0]\n")
    assert _totals_of(tmp_path)["anna"] == "3"  # the teacher's marks stand until the teacher says otherwise
    (waiting,) = [row for row in _rows(out / "queue.csv") if row["student"] == "anna"]
    assert (waiting["answer"], waiting["reason"]) == (
        "tau",
        "tau: its marks were set by hand for an earlier hand-in",
    )
    assert "set by hand for an earlier hand-in" in (out / "report.html").read_text()
    override_all(out, _csv(tmp_path, "anna,in3140-rp,tau,1,still"))
    assert not [row for row in _rows(out / "queue.csv") if row["student"] == "anna"]
