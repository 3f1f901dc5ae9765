"""`dynsolve grade` as a teacher meets it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.grading import RIGHT, table
from tests.cli.running import dynsolve, environment
from tests.support import ROOT, with_files

pytestmark = pytest.mark.slow


def test_a_faulty_roster_is_told_before_anything_is_graded(tmp_path: Path, set_folder: Path) -> None:
    with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT})
    roster = tmp_path / "gradebook.csv"
    roster.write_text("Name,Mark\nAda,3\n")
    words = (str(set_folder), str(tmp_path / "in"), "-o", str(tmp_path / "out"))
    ran = dynsolve("grade", *words, "--lms", "canvas", "--roster", str(roster))
    assert ran.code == 2
    assert "gradebook.csv:1:1: this is no gradebook of Canvas" in ran.err
    assert not (tmp_path / "out").exists()


def test_of_many_refused_files_the_report_names_the_rest(tmp_path: Path, set_folder: Path) -> None:
    hand_ins = with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT})
    for i in range(23):
        (hand_ins / f"link{i:02}.yaml").symlink_to("/etc/passwd")
    ran = dynsolve("grade", str(set_folder), str(hand_ins), "-o", str(tmp_path / "out"))
    assert ran.err.count("refused: link") == 20
    assert "refused: 3 more, which the report names" in ran.err
    assert (tmp_path / "out" / "report.html").read_text().count(".yaml</td><td>a link") == 46  # K and g


def test_a_bound_that_is_passed_is_unreadable_with_the_reason(tmp_path: Path, set_folder: Path) -> None:
    long = "problem: in3140-rp\nanswers:\n" + "  P: (m1 + m2 + L1 + g + I1zz)^18*L2\n" * 2000
    hand_ins = with_files(tmp_path / "in", {"a/in3140-rp.yaml": long, "b/in3140-rp.yaml": RIGHT})
    out = tmp_path / "out"
    ran = dynsolve("grade", str(set_folder), str(hand_ins), "-o", str(out), "--timeout", "0.3", workers=True)
    assert ran.code == 0, ran.err
    verdicts = [(row["student"], row["verdict"]) for row in table(out / "answers.csv")]
    assert verdicts == [("a", "unreadable")] * 2 + [("b", "correct")] * 2
    assert "more than 0.3 s" in (out / "report.html").read_text()


def test_modules_among_the_hand_ins_are_never_imported(tmp_path: Path, set_folder: Path) -> None:
    """The program is started as its script starts it, in the folder that a teacher has unpacked."""
    hand_ins = with_files(tmp_path / "in", {"s1_in3140-rp.yaml": RIGHT})
    for name in ("json", "base64", "resource", "flint", "yaml", "dynsolve", "sitecustomize"):
        with_files(hand_ins, {f"{name}.py": f"open({str(tmp_path / 'hacked')!r}, 'w')\n"})
    script = "import sys; from dynsolve.cli.main import main; sys.argv[0] = 'dynsolve'; main()"
    words = ("grade", str(set_folder), ".", "-o", str(tmp_path / "out"), "--jobs", "1")
    ran = subprocess.run(
        [sys.executable, "-P", "-c", script, *words],
        cwd=hand_ins, env=environment(PYTHONPATH=str(ROOT)), capture_output=True, text=True,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    assert not (tmp_path / "hacked").exists()
    totals = {row["student"]: row["total"] for row in table(tmp_path / "out" / "grades.csv")}
    assert totals["s1_in3140-rp"] == "6"


def test_a_hand_in_without_answers_is_unreadable_and_says_why(tmp_path: Path, set_folder: Path) -> None:
    hand_ins = with_files(
        tmp_path / "in", {
            "a/in3140-rp.ipynb": "{",
            "b/in3140-rp.md": "I could not do it.\n",
            "c/in3140-rp.md": "$$2 Q_5 = m_1$$\n",
            "d/in3140-rp.yaml": "",
            "good/in3140-rp.yaml": RIGHT,
        }
    )  # fmt: skip
    out = tmp_path / "out"
    ran = dynsolve("grade", str(set_folder), str(hand_ins), "-o", str(out))
    assert ran.code == 0, ran.err
    verdicts = {row["student"]: row["verdict"] for row in table(out / "answers.csv") if row["answer"] == "K"}
    assert verdicts == {**dict.fromkeys("abcd", "unreadable"), "good": "correct"}
    report = (out / "report.html").read_text()
    for reason in (
        "this is no notebook: its JSON cannot be read",
        "no answer was found in it",
        "not recognized: line 1: 2 Q_5 = m_1",
        "there are no answers in this file",
    ):
        assert reason in report
    assert "this is no notebook" in (out / "feedback" / "a" / "in3140-rp.html").read_text()


def test_a_file_in_place_of_the_folder_is_said(tmp_path: Path, set_folder: Path) -> None:
    where = with_files(tmp_path / "in", {"ada.yaml": RIGHT}), with_files(tmp_path, {"out": "notes"}) / "out"
    run = dynsolve("grade", str(set_folder), str(where[0]), "-o", str(where[1]))
    assert (run.code, where[1].read_text()) == (2, "notes")
    assert "is a file; name a folder" in run.err and "goes on" not in run.err


def test_a_roster_without_its_platform_says_what_is_needed(tmp_path: Path, set_folder: Path) -> None:
    with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT})
    words = (str(set_folder), str(tmp_path / "in"), "-o", str(tmp_path / "out"), "--roster", "gradebook.csv")
    ran = dynsolve("grade", *words)
    assert ran.code == 2
    assert "--roster needs --lms, the platform that it is of: canvas, moodle, gradescope" in ran.err


def test_a_platform_without_its_roster_says_what_is_needed(tmp_path: Path, set_folder: Path) -> None:
    with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT})
    words = (str(set_folder), str(tmp_path / "in"), "-o", str(tmp_path / "out"), "--lms", "canvas")
    ran = dynsolve("grade", *words)
    assert ran.code == 2
    assert "needs --roster, the CSV that Canvas exports" in ran.err
