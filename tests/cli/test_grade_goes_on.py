"""`dynsolve grade` that is stopped: by signals, by a full disk, by another run."""

from __future__ import annotations

import contextlib
import os
import random
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.cli.grading import table
from tests.cli.running import dynsolve, environment, started
from tests.grading.generate import course, problem_set
from tests.support import ROOT, record_of

pytestmark = pytest.mark.slow


def _contents(folder: Path) -> dict[str, bytes]:
    """Every file but the record."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not path.name.startswith("grades.sqlite")
    }


def _grade(problems: Path, hand_ins: Path, out: Path, *words: str) -> subprocess.Popen[bytes]:
    return started("grade", str(problems), str(hand_ins), "-o", str(out), *words)


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
    course(folder / "in", 12)
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
    for _ in range(2):
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
        while run.poll() is None and killed < 2:
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
    assert dynsolve(*words, workers=True).code == 0
    assert len(table(tmp_path / "out" / "grades.csv")) == 12


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
    course(tmp_path / "in", 12)
    with _grade(tmp_path / "set", tmp_path / "in", tmp_path / "out") as run:
        workers = _at_work(run)
        run.send_signal(signal.SIGKILL)
    deadline = time.monotonic() + 30
    while _parents().keys() & set(workers):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert workers
