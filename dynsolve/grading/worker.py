"""A worker: `python -m dynsolve.grading.worker SECONDS BYTES` judges one hand-in a line, JSON in, JSON out.

It bounds its own memory, and ends itself should it be left alone with work that does
not end: nothing that it computes outlives the run.
"""

from __future__ import annotations

import gc
import json
import os
import signal
import sys
from typing import IO, Any

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
    from dynsolve.answers.sandbox import Stopped
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
