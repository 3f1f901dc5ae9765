"""The same work on a Dask scheduler, through the same futures: the extra `[cluster]`.

Each thread of a Dask worker keeps a worker process of its own with the same bounds, so
that a hand-in that exceeds them takes nothing else with it.  A Dask worker that is lost
is Dask's to replace: its hand-ins are computed again elsewhere.
"""

from __future__ import annotations

import threading
from concurrent.futures import Future
from importlib import import_module
from typing import Any

from dynsolve.errors import UsageError
from dynsolve.grading.pool import Bounds, Data, Worker

_own = threading.local()


class ClusterPool:
    """The workers of a Dask scheduler."""

    def __init__(self, address: str, bounds: Bounds) -> None:
        try:
            distributed: Any = import_module("distributed")
        except ImportError:
            message = "--cluster needs Dask: install it with `pip install dynsolve[cluster]`"
            raise UsageError(message) from None
        self.bounds = bounds
        try:
            self._client: Any = distributed.Client(address, timeout="10s", set_as_default=False)
        except (OSError, ValueError) as error:
            raise UsageError(f"no Dask scheduler answers at {address}: {error}") from None
        self._executor: Any = self._client.get_executor(pure=False, retries=3)

    @property
    def jobs(self) -> int:
        """The threads of all workers there are now, at least one."""
        threads: dict[str, int] = self._client.nthreads()
        return max(1, sum(threads.values()))

    def submit(self, payload: Data) -> Future[Data]:
        """A future of {"result": ...} or {"reason": ...}."""
        future: Future[Data] = self._executor.submit(
            run_bounded, payload, self.bounds.seconds, self.bounds.memory
        )
        return future

    def close(self) -> None:
        """Leave the scheduler; what is under way is given up."""
        self._executor.shutdown(wait=False)
        self._client.close()


def run_bounded(payload: Data, seconds: float, memory: int) -> Data:
    """One hand-in, in a worker process of this thread's."""
    bounds = Bounds(seconds, memory)
    worker: Worker | None = getattr(_own, "worker", None)
    if worker is None or worker.bounds != bounds:
        worker = _own.worker = Worker(bounds)
    return worker(payload)
