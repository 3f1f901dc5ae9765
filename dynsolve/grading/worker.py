"""A worker: `python -m dynsolve.grading.worker SECONDS BYTES` judges one hand-in a line, JSON in, JSON out.

It bounds its own memory, and ends itself should it be left alone with work that does
not end: nothing that it computes outlives the run.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from typing import IO, Any

SLACK = 5
"""Seconds after which a worker that nobody ends ends itself."""


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
    """No more than so many bytes for this process, where the system can hold it to that."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def serve(lines: IO[bytes], out: IO[bytes], seconds: float) -> None:
    """Answer every line."""
    from dynsolve.grading.work import grade_one

    for line in lines:
        if hasattr(signal, "alarm"):
            signal.alarm(int(seconds) + SLACK)
        out.write(_answered(grade_one, line) + b"\n")
        out.flush()


def _answered(grade_one: Any, line: bytes) -> bytes:
    try:
        return json.dumps({"result": grade_one(json.loads(line))}).encode()
    except MemoryError:
        return b'{"memory": true}'
    except RecursionError:
        return b'{"error": "it is nested too deeply"}'
    except Exception as error:  # noqa: BLE001  # whatever happens, the run goes on
        return json.dumps({"error": f"{type(error).__name__}: {error}"[:300]}).encode()


if __name__ == "__main__":
    main(float(sys.argv[1]), int(sys.argv[2]))
