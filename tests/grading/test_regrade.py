"""What a change makes the next run do: only what is affected, and what a run from nothing would give."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import dynsolve
from dynsolve.grading.public import Grades
from tests.grading.generate import PROBLEMS, course, problem_set
from tests.support import record_of

pytestmark = pytest.mark.slow

COUNT = 12
STUDENTS = COUNT // len(PROBLEMS)


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a set, hand-ins and what came out of them.

    One more than `COUNT` holds no answer: it has no verdicts that could be marked anew.
    """
    folder = tmp_path_factory.mktemp("course")
    problem_set(folder / "set")
    course(folder / "in", COUNT, seed=3)
    slip = "problem: in3140-rp\nanswers:\n  K: I1zz*theta1'^2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n"
    follows = "  tau: [(2*I1zz + m2*L2^2)*theta1'' + 2*m2*L2*L2'*theta1', m2*L2'' - m2*L2*theta1'^2]\n"
    parts = "  d11: I1zz\n  d12: 0\n  d21: 0\n  d22: m2\n  P1: m1*g*L1/2\n  P2: m2*g*L1\n"
    (folder / "in" / "s00000" / "in3140-rp.yaml").unlink(missing_ok=True)
    for old in (folder / "in" / "s00000").iterdir():
        old.unlink()
    (folder / "in" / "s00000" / "in3140-rp.yaml").write_text(slip + follows + parts)
    (folder / "in" / "s00001" / "elbow-3r.yaml").write_text("answers: {}\n")
    dynsolve.grade(folder / "set", folder / "in", folder / "out")
    return folder


def _copied(folder: Path, to: Path) -> Path:
    import shutil

    shutil.copytree(folder, to / "course")
    return to / "course"


def _set(old: str, new: str) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        text = (folder / "set" / "set.yaml").read_text()
        assert old in text
        (folder / "set" / "set.yaml").write_text(text.replace(old, new))

    return change


def _problem(folder: Path) -> None:
    path = folder / "set" / "planar-2r.yaml"
    path.write_text(path.read_text() + "# another word\n")


def _hand_in(folder: Path) -> None:
    next((folder / "in" / "s00004").iterdir()).write_text("problem: planar-2r\nanswers:\n  K: 0\n")


def _graded(folder: Path, out: str) -> Grades:
    """By one worker: what two of them come to is the same, and takes two starts."""
    return dynsolve.grade(folder / "set", folder / "in", folder / out, jobs=1)


@pytest.mark.parametrize(
    ("change", "computed", "remarked"),
    [
        (lambda folder: None, 0, 0),
        (_hand_in, 1, 0),
        (_problem, STUDENTS, 0),
        (_set("in3140-rp: {P: 2, K: 4,", "in3140-rp: {P: 2, K: 5,"), 0, STUDENTS),
        (_set("in3140-rp: {P: 2, K: 4,", "in3140-rp: {K: 4,"), STUDENTS, 0),
        (_set("follow: 1/2", "follow: 1/3, rounding: 1/4, late: 0.5, caps: {energy: 5}"), 1, COUNT),
        (_set("hints: 2", "hints: 1"), COUNT + 1, 0),
        (_set("title: Three robots", "title: Another name"), 0, 0),
    ],
    ids=["nothing", "hand-in", "problem", "points", "answers", "policy", "hints", "title"],
)
def test_only_what_is_affected_is_computed(
    graded: Path, tmp_path: Path, change: Callable[[Path], None], computed: int, remarked: int
) -> None:
    folder = _copied(graded, tmp_path)
    change(folder)
    again = _graded(folder, "out")
    assert (again.computed, again.remarked) == (computed, remarked)
    assert again.hand_ins == COUNT + 1
    fresh = _graded(folder, "fresh")
    assert fresh.computed == COUNT + 1
    assert record_of(folder / "out") == record_of(folder / "fresh")
    names = sorted(p.relative_to(folder / "fresh") for p in (folder / "fresh").rglob("*") if p.is_file())
    for name in names:
        if not name.name.startswith("grades.sqlite"):
            assert (folder / "out" / name).read_bytes() == (folder / "fresh" / name).read_bytes(), name


def test_a_run_that_changes_nothing_rewrites_nothing(graded: Path, tmp_path: Path) -> None:
    folder = _copied(graded, tmp_path)
    _graded(folder, "out")

    def stamps() -> dict[Path, int]:
        files = [p for p in (folder / "out").rglob("*") if p.is_file() and "sqlite" not in p.name]
        return {path: path.stat().st_mtime_ns for path in files}

    before = stamps()
    _graded(folder, "out")
    assert stamps() == before and len(before) > COUNT


def test_a_students_old_pages_go_with_the_student(graded: Path, tmp_path: Path) -> None:
    import shutil

    folder = _copied(graded, tmp_path)
    shutil.rmtree(folder / "in" / "s00003")
    (folder / "out" / "feedback" / "s00004" / ".planar-2r.html.new").write_text("half")
    _graded(folder, "out")
    assert not (folder / "out" / "feedback" / "s00003").exists()
    assert not list((folder / "out" / "feedback").rglob(".*"))
