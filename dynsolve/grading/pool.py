"""Workers on this machine, each with bounds on time and memory, behind the interface of futures.

A thread a worker hands it one hand-in after the other.  A worker that goes over a bound
is ended and replaced, and the hand-in is tried once more, answer by answer: those that
are too much are `unreadable` with the reason.  Where that goes over the bound too, all of
the hand-in is, and the run goes on.

A worker: `python -m dynsolve.grading.pool SECONDS BYTES` judges one hand-in a line, JSON in, JSON out.
It bounds its own memory, and ends itself should it be left alone with work that does
not end: nothing that it computes outlives the run.

The same work on a Dask scheduler, through the same futures: the extra `[cluster]`.  Each thread of a Dask
worker keeps a worker process of its own with the same bounds, so
that a hand-in that exceeds them takes nothing else with it.  A Dask worker that is lost
is Dask's to replace: its hand-ins are computed again elsewhere.
"""

from __future__ import annotations

import gc
import json
import logging
import os
import signal
import subprocess
import sys
import threading
from collections import deque
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from contextlib import suppress
from functools import lru_cache
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from typing import IO, Any

from msgspec import Struct

import dynsolve
from dynsolve.errors import UsageError

# A worker

SLACK = 5
"""Seconds after which a worker that nobody ends ends itself."""


YOUNG = 10_000
"""So many new objects before the garbage collector looks: a worker remembers many, and few are garbage."""


def patience(seconds: float) -> float:
    """How long by the clock to wait for work that may take so many seconds of the processor.

    On a busy machine it takes much longer; this is for what hangs, and for systems that
    do not tell the processor's time.
    """
    return 10 * seconds + 60 if hasattr(signal, "setitimer") else seconds


def main(seconds: float, memory: int) -> None:
    """Judge what comes in until there is no more."""
    if hasattr(signal, "SIGINT"):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the run to handle
    bound_memory(memory)
    lines = os.fdopen(os.dup(0), "rb")
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints must not stand among the answers
    serve(lines, out, seconds)


def bound_memory(memory: int) -> None:
    """Limit the memory of this process, where the system can."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def serve(lines: IO[bytes], out: IO[bytes], seconds: float) -> None:
    """Answer every line."""
    import dynsolve.grading.work  # noqa: F401  # while the run gets ready to send the first one

    gc.set_threshold(YOUNG)
    for line in lines:
        out.write(json.dumps(_answered(json.loads(line), seconds)).encode() + b"\n")
        out.flush()


def _answered(payload: dict[str, Any], seconds: float) -> dict[str, Any]:
    from dynsolve.answers.limits import Stopped
    from dynsolve.grading.work import checker_of, failure, grade_one

    try:
        checker_of(payload)  # the time that the key takes is not the hand-in's
        _bound_time(seconds)
        return {"result": grade_one(payload, seconds if payload["answer_by_answer"] else 0.0)}
    except MemoryError:
        return {"stopped": "memory"}
    except Stopped:
        return {"stopped": "time"}
    except Exception as error:  # noqa: BLE001  # whatever happens, the run goes on
        return {"reason": failure(error)}
    finally:
        _bound_time(0)


def _bound_time(seconds: float) -> None:
    """Limit the processor time from now on, where the system can; 0 for no limit."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, seconds)
        signal.alarm(int(patience(seconds)) + SLACK if seconds else 0)


if __name__ == "__main__":
    main(float(sys.argv[1]), int(sys.argv[2]))

Data = dict[str, Any]

SERVES = 4000
"""After so many hand-ins a worker is replaced, so that nothing it keeps can grow."""

TRIES = 3
"""So often a hand-in is tried again whose worker was killed: by a system short of memory, say."""

MODULE = "dynsolve.grading.pool"

_OUT_OF_TIME = getattr(signal, "SIGPROF", 0)
"""What ends a worker that has used up its time."""

_KILLED = getattr(signal, "SIGKILL", 0)


class Bounds(Struct, frozen=True):
    """What one hand-in may use: seconds of the processor, and bytes of memory."""

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
        """The result of a hand-in: {"result": ...} or {"reason": ...}.

        Where there is none, a fresh worker tries its answers one by one: so one that is too
        much spoils no other, nor does what another hand-in has left behind.
        """
        said = self._tried({**payload, "answer_by_answer": False})
        if "result" in said or self.closed:
            return said
        self.end()
        return self._tried({**payload, "answer_by_answer": True})

    def _tried(self, payload: Data) -> Data:
        """The answer to a payload, tried again where something else than its limits killed the worker."""
        said = self._ask(payload)
        for _ in range(TRIES):
            if not said.get("killed") or self.closed:
                break
            said = self._ask(payload)
        said.pop("killed", None)
        return said

    def _ask(self, payload: Data) -> Data:
        """What the worker answers, or the reason why there is no answer."""
        if self.process is None:
            self.start()
        process = self.process
        assert process is not None and process.stdin and process.stdout
        wait = patience(self.bounds.seconds)
        late = threading.Event()
        timer = threading.Timer(wait, _end_late, (process, late))
        timer.daemon = True
        timer.start()
        try:
            process.stdin.write(json.dumps(payload).encode() + b"\n")
            process.stdin.flush()
            answer = process.stdout.readline()
        except OSError:
            answer = b""
        finally:
            timer.cancel()
        said: Data = json.loads(answer) if answer.endswith(b"\n") else {"stopped": "ended"}
        self.served += 1
        if "stopped" not in said:
            if self.served >= SERVES:
                self.end()
            return said
        self.end()
        if late.is_set():
            return {"reason": f"reading it did not end within {wait:g} s"}
        if said["stopped"] == "time" or process.returncode == -_OUT_OF_TIME:
            return {"reason": f"reading it took more than {self.bounds.seconds:g} s"}
        memory = f"{self.bounds.memory / (1 << 20):g} MiB"
        killed = said["stopped"] == "ended" and process.returncode == -_KILLED
        return {"reason": f"reading it took more than {memory} of memory, or failed", "killed": killed}

    def start(self) -> None:
        """Start the process; raises UsageError where the system has no room for it."""
        try:
            self.process = subprocess.Popen(  # noqa: S603  # this very Python, on this very package
                [sys.executable, "-P", "-m", MODULE, str(self.bounds.seconds), str(self.bounds.memory)],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=_environment(),
                start_new_session=True,  # so that its children end with it
            )  # fmt: skip
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            message = f"a worker cannot be started: {reason}; with fewer `--jobs` it may"
            raise UsageError(message) from None
        self.served = 0

    def end(self) -> None:
        """End the process; the next hand-in starts another."""
        process, self.process = self.process, None
        if process is not None:
            _kill(process)
            process.communicate()


class LocalPool:
    """`jobs` workers on this machine."""

    def __init__(self, jobs: int, bounds: Bounds) -> None:
        self.jobs, self.bounds = jobs, bounds
        self._threads = ThreadPoolExecutor(jobs, thread_name_prefix="grading")
        self._own = threading.local()
        self._workers: list[Worker] = []
        self._ready: deque[Worker] = deque()

    def prepare(self, count: int) -> None:
        """Start as many workers as so many hand-ins need: they import while the run gets ready."""
        for _ in range(len(self._workers), min(self.jobs, count)):
            worker = self._another()
            worker.start()
            self._ready.append(worker)

    def submit(self, payload: Data) -> Future[Data]:
        """A future of {"result": ...} or {"reason": ...}."""
        return self._threads.submit(self._run, payload)

    def check(self) -> None:
        """Nothing: the workers of this machine end by themselves."""

    def _run(self, payload: Data) -> Data:
        worker: Worker | None = getattr(self._own, "worker", None)
        if worker is None:
            worker = self._own.worker = self._ready.popleft() if self._ready else self._another()
        return worker(payload)

    def _another(self) -> Worker:
        worker = Worker(self.bounds)
        self._workers.append(worker)
        return worker

    def close(self) -> None:
        """End every worker, also those that are at work."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        for worker in self._workers:
            worker.closed = True
            process = worker.process
            if process is not None:
                _kill(process)
        self._threads.shutdown(wait=True)
        for worker in self._workers:
            worker.end()


def _environment() -> dict[str, str]:
    """A worker finds this very package, and never a module in the folder that it is started in.

    That may hold what was handed in.
    """
    own = str(Path(dynsolve.__file__).parent.parent)
    others = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, (own, *others)))}


def _end_late(process: subprocess.Popen[bytes], late: threading.Event) -> None:
    late.set()
    _kill(process)


def _kill(process: subprocess.Popen[bytes]) -> None:
    if process.returncode is None and hasattr(os, "killpg"):
        with suppress(OSError):
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()


ANSWERS_WITHIN = "10s"
"""So long a Dask scheduler is waited for, also one that is lost on the way."""

GOES_ON = "what is done is kept, and the same command goes on"
PATIENCE = 6
"""So often in a row a cluster without workers is looked at before it is given up."""

_own = threading.local()


class ClusterPool:
    """The workers of a Dask scheduler; raises UsageError where the connection to it is lost."""

    def __init__(self, address: str, bounds: Bounds) -> None:
        try:
            distributed: Any = import_module("distributed")
        except ImportError:
            message = "--cluster needs Dask: install it with `pip install dynsolve[cluster]`"
            raise UsageError(message) from None
        _quiet()
        self.bounds = bounds
        self.address = address
        self._alone = 0
        try:
            import_module("distributed.comm").get_address_host_port(
                address
            )  # a Client that fails here is noisy
            self._client: Any = distributed.Client(address, timeout=ANSWERS_WITHIN, set_as_default=False)
        except Exception as error:  # noqa: BLE001  # theirs, of many kinds: an address of nonsense is any of them
            said = " ".join(str(error).split()) or type(error).__name__
            message = f"no Dask scheduler answers at {address[:80]}: {said[:200]}"
            raise UsageError(f"{message}; write tcp://host:8786") from None
        self._executor: Any = self._client.get_executor(pure=False, retries=3)

    @property
    def jobs(self) -> int:
        """How many threads all workers have now, at least one."""
        return max(1, self._threads())

    def _threads(self) -> int:
        try:
            threads: dict[str, int] = self._client.nthreads()
        except (OSError, RuntimeError, CancelledError):
            raise self._gone() from None
        return sum(threads.values())

    def prepare(self, count: int) -> None:
        """Nothing: the workers of a cluster are there."""

    def check(self) -> None:
        """Called where nothing is done for a while; raises UsageError where nobody is there to do it."""
        self._alone = 0 if self._threads() else self._alone + 1
        if self._alone >= PATIENCE:
            raise UsageError(f"the Dask scheduler at {self.address} has no workers; {GOES_ON}")

    def submit(self, payload: Data) -> Future[Data]:
        """A future of {"result": ...} or {"reason": ...}."""
        future: Future[Data] = Future()
        bounds = (self.bounds.seconds, self.bounds.memory)
        try:
            work = self._executor.submit(run_bounded, payload, *bounds, program())
        except (OSError, RuntimeError):
            raise self._gone() from None
        work.add_done_callback(lambda done: self._pass_on(done, future))
        return future

    def _pass_on(self, done: Future[Data], future: Future[Data]) -> None:
        """Set the future's result, or the exception that ends the run."""
        try:
            said = done.result()
        except CancelledError:
            future.set_exception(self._gone())
        except Exception as error:  # noqa: BLE001  # theirs, of many kinds
            if type(error).__name__ == "KilledWorker":
                future.set_result({"reason": "every worker of the cluster that had it ended"})
            else:
                message = f"the cluster's workers failed: {type(error).__name__}: {error}"
                future.set_exception(UsageError(f"{message}; {GOES_ON}"))
        else:
            if said.pop("stranger", False):
                message = "the cluster's workers have another version of dynsolve: install this one there"
                future.set_exception(UsageError(message))
            else:
                future.set_result(said)

    def _gone(self) -> UsageError:
        return UsageError(f"the Dask scheduler at {self.address} is gone; {GOES_ON}")

    def close(self) -> None:
        """Leave the scheduler; what is under way is given up."""
        self._executor.shutdown(wait=False)
        self._client.close()


_LOST = ("CommClosedError", "FutureCancelledError")
"""What is raised where a connection is lost: by what waits on it, and by what was computed there."""


def _quiet() -> None:
    """Silence Dask's own logging: faults of a cluster are reported as one line by this module."""
    for name in [name for name in logging.root.manager.loggerDict if name.startswith("distributed")]:
        logging.getLogger(name).setLevel(logging.CRITICAL)
    for name in ("asyncio", "tornado.application"):
        logging.getLogger(name).addFilter(_is_ours)


def _is_ours(record: logging.LogRecord) -> bool:
    """Whether a log record is about something else than a lost connection of Dask."""
    error = record.exc_info[1] if record.exc_info else None
    while error is not None:  # a connection that times out is an OSError because of a closed one
        if type(error).__name__ in _LOST:
            return False
        error = error.__cause__ or error.__context__
    return True


def run_bounded(payload: Data, seconds: float, memory: int, version: str) -> Data:
    """One hand-in, in a worker process of this thread's, by the same program as there."""
    if version != program():
        return {"stranger": True}
    bounds = Bounds(seconds, memory)
    worker: Worker | None = getattr(_own, "worker", None)
    if worker is None or worker.bounds != bounds:
        worker = _own.worker = Worker(bounds)
    return worker(payload)


@lru_cache(maxsize=1)
def program() -> str:
    """What identifies the program: every source file that a result depends on."""
    root = Path(dynsolve.__file__).parent
    found = sha256()
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root).as_posix()
        if not name.startswith(("cli/", "draw/")):
            with suppress(FileNotFoundError):  # the program is changed just now
                found.update(name.encode() + b"\0" + path.read_bytes())
    return found.hexdigest()[:16]
