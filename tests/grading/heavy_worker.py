"""A worker on which some answers are too much: P1 takes without end, P2 all memory, K1 fails, K2 crashes.

`python -m tests.grading.heavy_worker SECONDS BYTES`, in the place of `dynsolve.grading.pool`.
"""

from __future__ import annotations

import os
import sys

from dynsolve.answers.judge import Checker, Judge
from dynsolve.answers.verdict import Submission
from dynsolve.grading.pool import main

real = Judge.__init__


def heavy(self: Judge, checker: Checker, submission: Submission) -> None:
    """Judge a hand-in, slowly."""
    names = {answer.name for answer in submission.answers if answer.node is not None}
    while "P1" in names:
        pass
    if "P2" in names:
        bytearray(1 << 40)
    if "K1" in names:
        raise ZeroDivisionError("no such thing")
    if "K2" in names:
        os.abort()
    real(self, checker, submission)


if __name__ == "__main__":
    Judge.__init__ = heavy  # type: ignore[method-assign]
    main(float(sys.argv[1]), int(sys.argv[2]))
