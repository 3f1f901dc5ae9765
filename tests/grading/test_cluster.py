"""The same work on a real Dask scheduler with two workers, one of which is lost on the way."""

from __future__ import annotations

import importlib.util
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.cli.running import ROOT, dynsolve, environment
from tests.grading.generate import course, problem_set

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None and not os.environ.get("CI"),  # CI must have it
    reason="the extra [cluster] is not installed",
)


@contextmanager
def _process(*words: str) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        [sys.executable, "-m", "dask", *words], cwd=ROOT, env=environment(PYTHONPATH=str(ROOT)),
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True,
    )  # fmt: skip
    try:
        yield process
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def _said(process: subprocess.Popen[str], pattern: str) -> str:
    """What a process says of itself when it is ready."""
    assert process.stderr is not None
    for line in process.stderr:
        found = re.search(pattern, line)
        if found:
            return found[0]
    raise AssertionError(f"a process ended without {pattern}")


def test_a_cluster_gives_what_this_machine_gives_and_may_lose_a_worker(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 40)
    words = ("grade", str(tmp_path / "set"), str(tmp_path / "in"))
    assert dynsolve(*words, "-o", str(tmp_path / "here")).code == 0
    with _process("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard") as scheduler:
        address = _said(scheduler, r"tcp://127\.0\.0\.1:\d+")
        options = (address, "--nthreads", "1", "--no-dashboard", "--local-directory", str(tmp_path))
        with _process("worker", *options) as first, _process("worker", *options) as second:
            _said(first, "Registered to")
            _said(second, "Registered to")
            command = [sys.executable, "-m", "dynsolve", *words, "-o", str(tmp_path / "there")]
            with subprocess.Popen([*command, "--cluster", address], cwd=ROOT, stderr=subprocess.PIPE) as run:
                time.sleep(3)
                os.killpg(first.pid, signal.SIGKILL)
                _, err = run.communicate(timeout=120)
    assert run.returncode == 0, err.decode()
    for name in ("grades.csv", "answers.csv", "report.html"):
        assert (tmp_path / "there" / name).read_bytes() == (tmp_path / "here" / name).read_bytes()


def test_an_address_where_nobody_answers_is_said(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 1)
    words = (str(tmp_path / "set"), str(tmp_path / "in"), "-o", str(tmp_path / "out"))
    ran = dynsolve("grade", *words, "--cluster", "tcp://127.0.0.1:9")
    assert ran.code == 2
    assert "no Dask scheduler answers" in ran.err
