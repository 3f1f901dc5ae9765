"""A human's marks in bulk: what a CSV sets, what it cannot, and what a resubmission overtakes."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

import dynsolve
from dynsolve.errors import InputError
from dynsolve.grading.public import override_all

D = "answers:\n  D: [[I1zz + m2*L2^2, 0], [0, m2]]\n"


@pytest.fixture
def out(tmp_path: Path) -> Path:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "anna.yaml").write_text(D)
    (tmp_path / "in" / "bob.pdf").write_bytes(b"%PDF")
    _grade(tmp_path)
    return tmp_path / "out"


def _grade(tmp_path: Path) -> dict[str, str]:
    dynsolve.grade("in3140-rp", tmp_path / "in", tmp_path / "out", jobs=1)
    return _totals(tmp_path / "out")


def _totals(out: Path) -> dict[str, str]:
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
    assert _totals(out) == {"anna": "1", "bob": "2"}
    assert not _rows(out / "queue.csv")
    assert "on paper" in (out / "feedback" / "bob" / "in3140-rp.md").read_text()


def test_a_comment_changes_no_marks(tmp_path: Path, out: Path) -> None:
    assert override_all(out, _csv(tmp_path, "anna,in3140-rp,D,,well done", "anna,in3140-rp,tau,,")) == 1
    assert _totals(out)["anna"] == "1"
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
    assert _totals(out)["anna"] == "1"


def test_marks_that_a_resubmission_has_overtaken_are_in_the_queue(tmp_path: Path, out: Path) -> None:
    override_all(out, _csv(tmp_path, "anna,in3140-rp,tau,1,at the board"))
    assert _grade(tmp_path)["anna"] == "2"
    assert not [row for row in _rows(out / "queue.csv") if row["student"] == "anna"]
    (tmp_path / "in" / "anna.yaml").write_text(D + "  g: [0, 0]\n")
    assert _grade(tmp_path)["anna"] == "3"  # the teacher's marks stand until the teacher says otherwise
    (waiting,) = [row for row in _rows(out / "queue.csv") if row["student"] == "anna"]
    assert (waiting["answer"], waiting["reason"]) == (
        "tau",
        "tau: its marks were set by hand for an earlier hand-in",
    )
    assert "set by hand for an earlier hand-in" in (out / "report.html").read_text()
    override_all(out, _csv(tmp_path, "anna,in3140-rp,tau,1,still"))
    assert not [row for row in _rows(out / "queue.csv") if row["student"] == "anna"]
