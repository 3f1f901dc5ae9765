"""`dynsolve override` and what a second run says of marks that changed."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.grading import RIGHT, WRONG, set_in, table
from tests.cli.running import dynsolve
from tests.grading.generate import problem_set
from tests.support import record_of, with_files

pytestmark = pytest.mark.slow


def test_regrade_tells_whose_marks_changed_and_why(tmp_path: Path, set_folder: Path) -> None:
    hand_ins = with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT, "b/in3140-rp.yaml": WRONG})
    out = tmp_path / "out"
    words = ("grade", str(set_folder), str(hand_ins), "-o", str(out), "--diff")
    assert "2 hand-ins graded" in dynsolve(*words).err
    again = dynsolve(*words)
    assert "0 hand-ins graded, 2 as before" in again.err and again.out == ""
    with_files(hand_ins, {"b/in3140-rp.yaml": RIGHT})
    changed = dynsolve(*words)
    assert "1 hand-in graded, 1 as before" in changed.err
    assert changed.out == "b in3140-rp K: 0 -> 4 (the hand-in changed; correct: 4 of 4)\n"
    (set_folder / "set.yaml").write_text("title: Assignment 2\nmarks: {in3140-rp: {K: 5, g: 2}}\n")
    remarked = dynsolve(*words)
    assert "0 hand-ins graded, 2 marked anew" in remarked.err
    assert "a in3140-rp K: 4 -> 5 (the marks changed; correct: 5 of 5)" in remarked.out
    dynsolve("override", str(out), "a", "in3140-rp", "g", "--marks", "1", "--why", "copied")
    told = dynsolve(*words)
    assert told.out == "a in3140-rp g: 2 -> 1 (set by the teacher: copied (the program: correct: 2 of 2))\n"
    assert dynsolve(*words).out == ""


def test_an_override_is_kept_and_shown(tmp_path: Path, set_folder: Path) -> None:
    hand_ins = with_files(tmp_path / "in", {"a/in3140-rp.yaml": WRONG, "b/scan.pdf": b"%PDF"})
    out = tmp_path / "out"
    words = ("grade", str(set_folder), str(hand_ins), "-o", str(out))
    dynsolve(*words)
    override = ("override", str(out), "a", "in3140-rp", "K", "--marks", "3", "--why", "<good> idea")
    assert dynsolve(*override).code == 0
    assert (
        dynsolve("override", str(out), "b", "in3140-rp", "g", "--marks", "2", "--why", "on paper").code == 0
    )
    for _ in range(2):
        totals = {row["student"]: row["total"] for row in table(out / "grades.csv")}
        assert totals == {"a": "5", "b": "2"}
        page = (out / "feedback" / "a" / "in3140-rp.html").read_text()
        assert "set by the teacher: &lt;good&gt; idea (the program: wrong: 0 of 4)" in page
        with_files(hand_ins, {"a/in3140-rp.yaml": WRONG + "# again\n"})
        dynsolve(*words)


def test_marks_for_what_was_not_handed_in_are_read_by_the_student(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    hand_ins = with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT})
    out = tmp_path / "out"
    dynsolve("grade", str(tmp_path / "set"), str(hand_ins), "-o", str(out))
    page = out / "feedback" / "a" / "planar-2r.html"
    assert not page.exists()
    words = ("override", str(out), "a", "planar-2r", "K", "--marks", "3", "--why", "shown at the board")
    assert dynsolve(*words).code == 0
    text = page.read_text()
    assert "Marks: 3 of 21" in text and "set by the teacher: shown at the board" in text
    assert "Nothing was handed in here that the program could judge." in text
    assert 'href="feedback/a/planar-2r.html"' in (out / "report.html").read_text()


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The results of a set with one hand-in, for what changes nothing in them."""
    folder = tmp_path_factory.mktemp("graded")
    words = (set_in(folder), with_files(folder / "in", {"a/in3140-rp.yaml": RIGHT}))
    assert dynsolve("grade", *map(str, words), "-o", str(folder / "out")).code == 0
    return folder / "out"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("nobody", "in3140-rp", "K", "--marks", "3"), "there is no student `nobody`"),
        (("A", "in3140-rp", "K", "--marks", "3"), "did you mean `a`?"),
        (("a", "in3140-rp", "Q", "--marks", "3"), "has no answer `Q`"),
        (("a", "in3140-rp", "K", "--marks", "9"), "give it from 0 to 4"),
        (("a", "in3140-rp", "K", "--marks", "x"), "is no number of marks"),
    ],
)
def test_a_wrong_override_is_refused(graded: Path, words: tuple[str, ...], message: str) -> None:
    before = record_of(graded)
    ran = dynsolve("override", str(graded), *words, "--why", "x")
    assert ran.code == 2
    assert message in ran.err
    assert record_of(graded) == before


def test_a_missing_reason_is_asked_for_with_what_to_type(graded: Path) -> None:
    ran = dynsolve("override", str(graded), "a", "in3140-rp", "K", "--marks", "3")
    assert ran.code == 2
    assert f"dynsolve override {graded} a in3140-rp K --marks 3 --why 'right on paper'" in " ".join(
        ran.err.split()
    )
