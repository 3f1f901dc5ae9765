"""The same work on a real Dask scheduler with two workers, one of which is lost on the way."""

from __future__ import annotations

import importlib.util
import logging
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from dynsolve.errors import UsageError
from dynsolve.grading import pool
from dynsolve.grading.pool import PATIENCE, Bounds, ClusterPool, Data, _is_ours, _quiet, run_bounded
from tests.cli.running import dynsolve, environment
from tests.grading.generate import course, problem_set
from tests.support import ROOT

pytestmark = [
    pytest.mark.cluster,
    pytest.mark.skipif(
        importlib.util.find_spec("distributed") is None and not os.environ.get("CI"),  # CI must have it
        reason="the extra [cluster] is not installed",
    ),
]


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


@contextmanager
def _cluster(folder: Path, workers: int = 2) -> Iterator[tuple[str, list[int]]]:
    """The address of a scheduler, and the process groups of it and of its workers."""
    with ExitStack() as stack:
        words = ("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
        scheduler = stack.enter_context(_process(*words))
        address = _said(scheduler, r"tcp://127\.0\.0\.1:\d+")
        options = (address, "--nthreads", "1", "--no-dashboard", "--local-directory", str(folder))
        found = [stack.enter_context(_process("worker", *options)) for _ in range(workers)]
        for worker in found:
            _said(worker, "Registered to")
        yield address, [scheduler.pid, *(worker.pid for worker in found)]


DRIVER = """
import os, signal, sys
import dynsolve
from dynsolve.errors import DynsolveError
from dynsolve.grading import pool

pool.ANSWERS_WITHIN = "4s"
problems, hand_ins, out, address, group, at = sys.argv[1:]

def progress(done, of):
    if done == int(at):
        os.killpg(int(group), signal.SIGKILL)

try:
    dynsolve.grade(problems, hand_ins, out, cluster=address, progress=progress)
except DynsolveError as error:
    sys.exit(str(error))
"""
"""Grades on a cluster, and ends a group of processes when so many hand-ins are done."""


def _graded(tmp_path: Path, out: str, address: str, group: int, at: int) -> subprocess.CompletedProcess[str]:
    words = (str(tmp_path / "set"), str(tmp_path / "in"), str(tmp_path / out), address, str(group), str(at))
    return subprocess.run(
        [sys.executable, "-c", DRIVER, *words], cwd=ROOT, env=environment(PYTHONPATH=str(ROOT)),
        capture_output=True, text=True, timeout=200,
    )  # fmt: skip


def _is_the_same(tmp_path: Path) -> None:
    for name in ("grades.csv", "answers.csv", "report.html"):
        assert (tmp_path / "there" / name).read_bytes() == (tmp_path / "here" / name).read_bytes()


def test_a_cluster_gives_what_this_machine_gives_and_may_lose_a_worker(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 60)
    words = ("grade", str(tmp_path / "set"), str(tmp_path / "in"))
    assert dynsolve(*words, "-o", str(tmp_path / "here")).code == 0
    with _cluster(tmp_path) as (address, groups):
        ran = _graded(tmp_path, "there", address, groups[1], at=10)
    assert ran.returncode == 0, ran.stderr
    _is_the_same(tmp_path)


def test_a_scheduler_that_is_lost_is_said_and_the_same_command_goes_on(tmp_path: Path) -> None:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 60)
    words = ("grade", str(tmp_path / "set"), str(tmp_path / "in"))
    assert dynsolve(*words, "-o", str(tmp_path / "here")).code == 0
    with _cluster(tmp_path) as (address, groups):
        ran = _graded(tmp_path, "there", address, groups[0], at=10)
    assert ran.returncode == 1
    assert "is gone; what is done is kept, and the same command goes on" in ran.stderr
    assert "Traceback" not in ran.stderr
    again = dynsolve(*words, "-o", str(tmp_path / "there"))
    assert again.code == 0 and " as before" in again.err
    _is_the_same(tmp_path)


def test_the_bounds_hold_on_a_cluster_too(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    heavy = "answers:\n" + "  P: (m1 + m2 + L1 + g + I1zz)^18*L2\n" * 2000
    (tmp_path / "in" / "heavy.yaml").write_text(heavy)
    (tmp_path / "in" / "good.yaml").write_text("answers:\n  g: [0, 0]\n")
    words = ("grade", "in3140-rp", str(tmp_path / "in"), "--timeout", "0.3")
    assert dynsolve(*words, "-o", str(tmp_path / "here"), workers=True).code == 0  # which alone can be ended
    with _cluster(tmp_path, workers=1) as (address, _):
        ran = dynsolve(*words, "-o", str(tmp_path / "there"), "--cluster", address)
    assert ran.code == 0, ran.err
    _is_the_same(tmp_path)
    assert "more than 0.3 s" in (tmp_path / "there" / "report.html").read_text()


def test_workers_of_another_version_are_refused() -> None:
    assert run_bounded({}, 1, 1 << 30, "another") == {"stranger": True}
    cluster, done, future = object.__new__(ClusterPool), Future[Data](), Future[Data]()
    done.set_result({"stranger": True})
    cluster._pass_on(done, future)
    with pytest.raises(UsageError, match="another version of dynsolve"):
        future.result()


def test_a_cluster_without_workers_is_given_up() -> None:
    class Client:
        def nthreads(self) -> dict[str, int]:
            return {}

    cluster = object.__new__(ClusterPool)
    cluster.address, cluster._alone, cluster._client = "tcp://x:1", 0, Client()
    with pytest.raises(UsageError, match="has no workers; what is done is kept"):
        for _ in range(PATIENCE):
            cluster.check()


def test_a_connection_that_is_lost_is_no_page_of_traceback(caplog: pytest.LogCaptureFixture) -> None:
    from distributed.client import FutureCancelledError
    from distributed.comm import CommClosedError

    _quiet()
    lost = (CommClosedError("in: closed"), FutureCancelledError("run", "scheduler-connection-lost"))
    for error in (*lost, ValueError("another")):
        for name in ("asyncio", "tornado.application"):
            logging.getLogger(name).error("Task exception was never retrieved", exc_info=error)
    assert [record.exc_info[0] for record in caplog.records if record.exc_info] == 2 * [ValueError]


def test_without_the_extra_the_remedy_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(UsageError, match=r"pip install dynsolve\[cluster\]"):
        ClusterPool("tcp://127.0.0.1:9", Bounds())


def test_an_address_where_nobody_answers_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pool, "ANSWERS_WITHIN", "0.5s")
    with pytest.raises(UsageError, match="no Dask scheduler answers"):
        ClusterPool("tcp://127.0.0.1:9", Bounds())


@pytest.mark.parametrize(("kind", "is_told"), [("CommClosedError", False), ("ValueError", True)])
def test_a_lost_connection_is_not_logged_whatever_it_ends_as(kind: str, is_told: bool) -> None:
    """An attempt to connect again ends after a time as an OSError, whose cause is the closed connection."""
    try:
        try:
            raise type(kind, (Exception,), {})
        except Exception as lost:
            raise OSError("timed out") from lost
    except OSError as error:
        told = (type(error), error, error.__traceback__)
    record = logging.LogRecord("tornado.application", logging.ERROR, "", 0, "", (), told)
    assert _is_ours(record) is is_told
