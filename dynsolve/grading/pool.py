"""Workers on this machine, each with bounds on time and memory, behind the interface of futures.

A thread a worker hands it one hand-in after the other.  A worker that goes over a bound
is ended and replaced; the hand-in is `unreadable` with the reason, and the run goes on.
"""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

Data = dict[str, Any]

SERVES = 500
"""After so many hand-ins a worker is replaced, so that nothing it keeps can grow."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """What one hand-in may use: seconds, and bytes of memory."""

    seconds: float = 20.0
    memory: int = 1 << 30


class Worker:
    """One worker process, replaced when it must be."""

    def __init__(self, bounds: Bounds) -> None:
        self.bounds = bounds
        self.process: subprocess.Popen[bytes] | None = None
        self.served = 0
        self.closed = False

    def __call__(self, payload: Data) -> Data:
        """The result of a hand-in: {"result": ...} or {"reason": ...}."""
        line = json.dumps(payload).encode() + b"\n"
        fresh = self.process is None
        said = self._ask(line)
        if (
            said is None and not fresh and not self.closed
        ):  # what is wrong may be left over from another hand-in
            said = self._ask(line)
        if said is None:
            return {
                "reason": f"reading it took more than {_mebibytes(self.bounds.memory)} of memory, or failed"
            }
        return said

    def _ask(self, line: bytes) -> Data | None:
        """The worker's answer, None where it ended without one."""
        if self.process is None:
            self._start()
        process = self.process
        assert process is not None and process.stdin and process.stdout
        late = threading.Event()
        timer = threading.Timer(self.bounds.seconds, _end_late, (process, late))
        timer.daemon = True
        timer.start()
        try:
            process.stdin.write(line)
            process.stdin.flush()
            answer = process.stdout.readline()
        except OSError:
            answer = b""
        finally:
            timer.cancel()
        if not answer.endswith(b"\n"):
            self.end()
            return (
                {"reason": f"reading it took more than {self.bounds.seconds:g} s"} if late.is_set() else None
            )
        self.served += 1
        said: Data = json.loads(answer)
        if said.get("memory"):
            self.end()
            return None
        if "error" in said:
            return {"reason": f"the program failed on it ({said['error']})"}
        if self.served >= SERVES:
            self.end()
        return said

    def _start(self) -> None:
        module = [sys.executable, "-m", "dynsolve.grading.worker"]
        self.process = subprocess.Popen(  # noqa: S603  # this very Python, on this very package
            [*module, str(self.bounds.seconds), str(self.bounds.memory)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self.served = 0

    def end(self) -> None:
        """End the process; the next hand-in starts another."""
        process, self.process = self.process, None
        if process is not None:
            process.kill()
            process.communicate()


class LocalPool:
    """`jobs` workers on this machine."""

    def __init__(self, jobs: int, bounds: Bounds) -> None:
        self.jobs, self.bounds = jobs, bounds
        self._threads = ThreadPoolExecutor(jobs, thread_name_prefix="grading")
        self._own = threading.local()
        self._workers: list[Worker] = []

    def submit(self, payload: Data) -> Future[Data]:
        """A future of {"result": ...} or {"reason": ...}."""
        return self._threads.submit(self._run, payload)

    def _run(self, payload: Data) -> Data:
        worker: Worker | None = getattr(self._own, "worker", None)
        if worker is None:
            worker = self._own.worker = Worker(self.bounds)
            self._workers.append(worker)
        return worker(payload)

    def close(self) -> None:
        """End every worker, also those that are at work."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        for worker in self._workers:
            worker.closed = True
            process = worker.process
            if process is not None:
                process.kill()
        self._threads.shutdown(wait=True)
        for worker in self._workers:
            worker.end()


def _end_late(process: subprocess.Popen[bytes], late: threading.Event) -> None:
    late.set()
    process.kill()


def _mebibytes(memory: int) -> str:
    return f"{memory / (1 << 20):g} MiB"
