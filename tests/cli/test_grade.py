"""`dynsolve grade` and `dynsolve override` as a teacher meets them."""

from __future__ import annotations

import contextlib
import csv
import io
import os
import random
import shlex
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pytest

from tests.cli.running import dynsolve, environment, started
from tests.grading.generate import course, problem_set
from tests.support import ROOT, record_of, with_files

pytestmark = pytest.mark.slow

RIGHT = "problem: in3140-rp\nanswers:\n  K: (I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n  g: [0, 0]\n"
WRONG = RIGHT.replace("L2^2*theta1'^2)", "L2*theta1'^2)")


@pytest.fixture
def set_folder(tmp_path: Path) -> Path:
    return _set_in(tmp_path)


def _set_in(place: Path) -> Path:
    folder = place / "set"
    folder.mkdir()
    (folder / "in3140-rp.yaml").write_text((ROOT / "problems" / "in3140-rp.yaml").read_text())
    (folder / "set.yaml").write_text("title: Assignment 2\nmarks: {in3140-rp: {K: 4, g: 2}}\n")
    return folder


def _csv(path: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(path.read_text())))


def _contents(folder: Path) -> dict[str, bytes]:
    """Every file but the record."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not path.name.startswith("grades.sqlite")
    }


def _grade(problems: Path, hand_ins: Path, out: Path, *words: str) -> subprocess.Popen[bytes]:
    return started("grade", str(problems), str(hand_ins), "-o", str(out), *words)


CANVAS = {
    "lovelaceada_101_9001_in3140-rp.yaml": RIGHT,
    "babbagecharles_LATE_102_9002_in3140-rp.yaml": WRONG,
    "hoppergrace_103_9003_scan.pdf": b"%PDF-1.7",
}
GRADEBOOK = (
    "Student,ID,SIS User ID,SIS Login ID,Section,Assignment 2 (555),Quiz (556)\n"
    "    Points Possible,,,,,6,3\n"
    '"Lovelace, Ada",101,s101,ada,A,,2\n"Babbage, Charles",102,s102,charles,A,,\n'
    '"Hopper, Grace",103,s103,grace,A,EX,\n'
)


def test_a_canvas_download_comes_in_and_goes_out(tmp_path: Path, set_folder: Path) -> None:
    archive = tmp_path / "submissions.zip"
    with zipfile.ZipFile(archive, "w") as packed:
        for name, content in CANVAS.items():
            packed.writestr(name, content)
    roster = tmp_path / "gradebook.csv"
    roster.write_text(GRADEBOOK)
    out = tmp_path / "out"
    words = ("grade", str(set_folder), str(archive), "-o", str(out))
    ran = dynsolve(*words, "--lms", "canvas", "--roster", str(roster))
    assert ran.code == 0, ran.err
    grades = {row["student"]: row["total"] for row in _csv(out / "grades.csv")}
    assert grades == {"babbagecharles_102": "2", "hoppergrace_103": "0", "lovelaceada_101": "6"}
    answers = {(row["student"], row["answer"]): row["verdict"] for row in _csv(out / "answers.csv")}
    assert answers["babbagecharles_102", "K"] == "wrong"
    assert answers["hoppergrace_103", "K"] == "unreadable"
    imported = {row["ID"]: row["Assignment 2 (555)"] for row in _csv(out / "canvas.csv")}
    assert imported == {"": "6", "101": "6", "102": "2", "103": "EX"}
    page = (out / "feedback" / "babbagecharles_102" / "in3140-rp.html").read_text()
    assert "Marks: 2 of 6" in page and "It was handed in late." in page
    report = (out / "report.html").read_text()
    assert "a PDF: a human reads it" in report and "http" not in report.replace("http-equiv", "")
    override = ("override", str(out), "babbagecharles_102", "in3140-rp", "K", "--marks", "1", "--why", "idea")
    assert dynsolve(*override).code == 0
    assert ",charles,A,3" in (out / "canvas.csv").read_text()
    dynsolve(*words)
    assert ",charles,A,3" in (out / "canvas.csv").read_text()


def test_a_faulty_roster_is_told_before_anything_is_graded(tmp_path: Path, set_folder: Path) -> None:
    with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT})
    roster = tmp_path / "gradebook.csv"
    roster.write_text("Name,Mark\nAda,3\n")
    words = (str(set_folder), str(tmp_path / "in"), "-o", str(tmp_path / "out"))
    ran = dynsolve("grade", *words, "--lms", "canvas", "--roster", str(roster))
    assert ran.code == 2
    assert "gradebook.csv:1:1: this is no gradebook of Canvas" in ran.err
    assert not (tmp_path / "out").exists()


def test_hostile_files_leave_the_good_ones_their_marks(tmp_path: Path, set_folder: Path) -> None:
    hand_ins = with_files(
        tmp_path / "in", {
            "good/in3140-rp.yaml": RIGHT,
            "deep/in3140-rp.yaml": "answers:\n  K: " + "(" * 100_000 + "\n",
            "power/in3140-rp.yaml": "answers:\n  K: 9^9^9^9\n",
            "bytes/in3140-rp.yaml": os.urandom(5000),
            "empty/in3140-rp.yaml": "",
            "script/in3140-rp.md": "# <script>alert(1)</script>\n\n$$K = <img src=x onerror=alert(1)>$$\n",
            "=cmd(1)/in3140-rp.yaml": RIGHT,
        }
    )  # fmt: skip
    (hand_ins / "link.yaml").symlink_to("/etc/passwd")
    out = tmp_path / "out"
    ran = dynsolve("grade", str(set_folder), str(hand_ins), "-o", str(out))
    assert ran.code == 0, ran.err
    totals = {row["student"]: row["total"] for row in _csv(out / "grades.csv")}
    assert totals["good"] == "6"
    assert totals["'=cmd(1)"] == "6"
    assert set(totals) == {"good", "deep", "power", "bytes", "empty", "script", "link", "'=cmd(1)"}
    assert "refused: link.yaml: a link" in ran.err
    pages = "".join(path.read_text() for path in out.rglob("*.html"))
    assert "<img src=x" not in pages and "<script>alert" not in pages


def test_of_many_refused_files_the_report_names_the_rest(tmp_path: Path, set_folder: Path) -> None:
    hand_ins = with_files(tmp_path / "in", {"a/in3140-rp.yaml": RIGHT})
    for i in range(23):
        (hand_ins / f"link{i:02}.yaml").symlink_to("/etc/passwd")
    ran = dynsolve("grade", str(set_folder), str(hand_ins), "-o", str(tmp_path / "out"))
    assert ran.err.count("refused: link") == 20
    assert "refused: 3 more, which the report names" in ran.err
    assert (tmp_path / "out" / "report.html").read_text().count(".yaml</td><td>a link") == 23


def test_a_bound_that_is_passed_is_unreadable_with_the_reason(tmp_path: Path, set_folder: Path) -> None:
    long = "problem: in3140-rp\nanswers:\n" + "  P: (m1 + m2 + L1 + g + I1zz)^18*L2\n" * 100
    hand_ins = with_files(tmp_path / "in", {"a/in3140-rp.yaml": long, "b/in3140-rp.yaml": RIGHT})
    out = tmp_path / "out"
    ran = dynsolve("grade", str(set_folder), str(hand_ins), "-o", str(out), "--timeout", "0.3")
    assert ran.code == 0, ran.err
    verdicts = [(row["student"], row["verdict"]) for row in _csv(out / "answers.csv")]
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
    totals = {row["student"]: row["total"] for row in _csv(tmp_path / "out" / "grades.csv")}
    assert totals["s1_in3140-rp"] == "6"


def test_a_hand_in_without_answers_is_unreadable_and_says_why(tmp_path: Path, set_folder: Path) -> None:
    hand_ins = with_files(
        tmp_path / "in", {
            "a/in3140-rp.ipynb": "{",
            "b/in3140-rp.md": "I could not do it.\n",
            "c/in3140-rp.md": "$$Q_5 = m_1$$\n",
            "d/in3140-rp.yaml": "",
            "good/in3140-rp.yaml": RIGHT,
        }
    )  # fmt: skip
    out = tmp_path / "out"
    ran = dynsolve("grade", str(set_folder), str(hand_ins), "-o", str(out))
    assert ran.code == 0, ran.err
    verdicts = {row["student"]: row["verdict"] for row in _csv(out / "answers.csv") if row["answer"] == "K"}
    assert verdicts == {**dict.fromkeys("abcd", "unreadable"), "good": "correct"}
    report = (out / "report.html").read_text()
    for reason in (
        "this is no notebook: its JSON cannot be read",
        "no answer was found in it",
        "not recognized: line 1: Q_5 = m_1",
        "there are no answers in this file",
    ):
        assert reason in report
    assert "this is no notebook" in (out / "feedback" / "a" / "in3140-rp.html").read_text()


def test_a_second_run_on_one_folder_says_so_and_stops(tmp_path: Path) -> None:
    from dynsolve.grading.record import Record

    problem_set(tmp_path / "set")
    course(tmp_path / "in", 2)
    out = tmp_path / "out"
    out.mkdir()
    record = Record(out)
    ran = dynsolve("grade", str(tmp_path / "set"), str(tmp_path / "in"), "-o", str(out))
    record.close()
    assert ran.code == 2
    assert "another run is at work on" in ran.err


def _parents() -> dict[int, int]:
    """The processes that are there, each with the one that started it."""
    found = {}
    for status in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            state, parent = status.read_text().rpartition(")")[2].split()[:2]
            if state != "Z":
                found[int(status.parent.name)] = int(parent)
    return found


def _at_work(run: subprocess.Popen[bytes]) -> list[int]:
    """The workers of a run, as soon as there are some."""
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline and run.poll() is None:
        found = [process for process, parent in _parents().items() if parent == run.pid]
        if found:
            return found
        time.sleep(0.02)
    return []


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, float]:
    """A folder with a set, hand-ins and what an undisturbed run makes of them; how long its workers took."""
    folder = tmp_path_factory.mktemp("whole")
    problem_set(folder / "set")
    course(folder / "in", 60)
    with _grade(folder / "set", folder / "in", folder / "out") as run:
        _at_work(run)
        start = time.monotonic()
        assert run.wait() == 0
    return folder, time.monotonic() - start


def _is_whole(folder: Path, whole: Path) -> None:
    assert _contents(folder) == _contents(whole / "out")
    assert record_of(folder) == record_of(whole / "out")


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_a_run_that_is_killed_goes_on_to_the_same_bytes(tmp_path: Path, whole: tuple[Path, float]) -> None:
    folder, took = whole
    words = (folder / "set", folder / "in", tmp_path / "killed")
    chance = random.Random(5)
    for _ in range(6):
        with _grade(*words) as run:
            _at_work(run)  # before that, there is nothing that a kill could spoil
            time.sleep(chance.uniform(0, took / 3))
            run.send_signal(signal.SIGKILL)
    with _grade(*words) as run:
        assert run.wait() == 0
    _is_whole(tmp_path / "killed", folder)


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_a_run_whose_workers_are_killed_comes_to_the_same_bytes(
    tmp_path: Path, whole: tuple[Path, float]
) -> None:
    folder, _ = whole
    killed = 0
    with _grade(folder / "set", folder / "in", tmp_path / "killed", "--jobs", "1") as run:
        while run.poll() is None and killed < 4:
            for worker in _at_work(run):
                time.sleep(0.3)
                with contextlib.suppress(ProcessLookupError):
                    os.kill(worker, signal.SIGKILL)
                    killed += 1
        assert run.wait() == 0
    assert killed
    _is_whole(tmp_path / "killed", folder)


def test_a_full_disk_is_said_and_the_same_command_goes_on(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 12)
    words = ("grade", str(tmp_path / "set"), str(tmp_path / "in"), "-o", str(tmp_path / "out"))
    limited = f"ulimit -f 150; exec {shlex.join([sys.executable, '-m', 'dynsolve', *words])}"
    full = subprocess.run(
        ["bash", "-c", limited], cwd=ROOT, env=environment(), capture_output=True, text=True
    )
    assert full.returncode == 2
    assert "what is done is kept, and the same command goes on" in full.stderr
    assert dynsolve(*words).code == 0
    assert len(_csv(tmp_path / "out" / "grades.csv")) == 12


def test_a_file_in_place_of_the_folder_is_said(tmp_path: Path, set_folder: Path) -> None:
    where = with_files(tmp_path / "in", {"ada.yaml": RIGHT}), with_files(tmp_path, {"out": "notes"}) / "out"
    run = dynsolve("grade", str(set_folder), str(where[0]), "-o", str(where[1]))
    assert (run.code, where[1].read_text()) == (2, "notes")
    assert "is a file; name a folder" in run.err and "goes on" not in run.err


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_ctrl_c_ends_cleanly_leaves_no_process_and_says_how_to_go_on(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 200)
    with _grade(tmp_path / "set", tmp_path / "in", tmp_path / "out") as run:
        workers = _at_work(run)
        time.sleep(0.5)
        run.send_signal(signal.SIGINT)
        _, err = run.communicate()
    assert run.returncode == 130
    assert b"the same command goes on" in err and b"Traceback" not in err
    assert workers and not _parents().keys() & set(workers)


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_workers_do_not_outlive_a_run_that_is_killed(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 60)
    with _grade(tmp_path / "set", tmp_path / "in", tmp_path / "out") as run:
        workers = _at_work(run)
        run.send_signal(signal.SIGKILL)
    deadline = time.monotonic() + 30
    while _parents().keys() & set(workers):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert workers


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
        totals = {row["student"]: row["total"] for row in _csv(out / "grades.csv")}
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
    words = (_set_in(folder), with_files(folder / "in", {"a/in3140-rp.yaml": RIGHT}))
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
