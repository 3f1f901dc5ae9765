"""The same work on a Dask scheduler, through the same futures: the extra `[cluster]`.

Each thread of a Dask worker keeps a worker process of its own with the same bounds, so
that a hand-in that exceeds them takes nothing else with it.  A Dask worker that is lost
is Dask's to replace: its hand-ins are computed again elsewhere.
"""

from __future__ import annotations

import logging
import threading
from concurrent.futures import CancelledError, Future
from importlib import import_module
from typing import Any

from dynsolve.errors import UsageError
from dynsolve.grading.pool import Bounds, Data, Worker

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
            self._client: Any = distributed.Client(address, timeout="10s", set_as_default=False)
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
            work = self._executor.submit(run_bounded, payload, *bounds, _program())
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
    kind = record.exc_info[0] if record.exc_info else None
    return kind is None or kind.__name__ not in _LOST


def run_bounded(payload: Data, seconds: float, memory: int, version: str) -> Data:
    """One hand-in, in a worker process of this thread's, by the same program as there."""
    if version != _program():
        return {"stranger": True}
    bounds = Bounds(seconds, memory)
    worker: Worker | None = getattr(_own, "worker", None)
    if worker is None or worker.bounds != bounds:
        worker = _own.worker = Worker(bounds)
    return worker(payload)


def _program() -> str:
    """What identifies the program; the run knows it."""
    from dynsolve.grading.fingerprints import program

    return program()
