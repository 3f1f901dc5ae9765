"""A hand-in that went over a bound, tried again: what is too much by itself is unreadable.

Every answer is worked on alone in a child process that has a share of the time, measured
on the processor, never on the clock, and the memory that the worker has.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from dynsolve.answers.sandbox import REMEDY, Stopped, limited
from dynsolve.answers.submission import Submission

SHARE = 8
"""One answer may take this part of the time that its hand-in may take."""


def sound(submission: Submission, work: Callable[[Submission], Any], seconds: float) -> Submission:
    """The hand-in with the answers that are too much, or that `work` fails on, unreadable.

    Raises Stopped where trying them takes more than `seconds`.
    """
    limit, start = seconds / SHARE, _spent()
    answers = []
    for answer in submission.answers:
        fault = _fault(replace(submission, answers=(answer,)), work, limit)
        answers.append(replace(answer, node=None, fault=fault, expected=REMEDY) if fault else answer)
        if _spent() - start > seconds:
            raise Stopped
    return replace(submission, answers=tuple(answers))


def _fault(alone: Submission, work: Callable[[Submission], Any], limit: float) -> str:
    """Why a hand-in of one answer cannot be judged, or nothing."""

    def tried() -> str:
        try:
            work(alone)
        except MemoryError:
            raise
        except Exception as error:  # noqa: BLE001  # whatever happens, the others are judged
            return failure(error)
        return ""

    try:
        return limited(tried, limit)
    except Stopped:
        return f"this takes more than {limit:g} s, or more memory than there is, to work out"


def failure(error: Exception) -> str:
    """What is said of a hand-in that the program failed on."""
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    return f"the program failed on it ({type(error).__name__}: {error})"[:300]


def _spent() -> float:
    """The processor time of the children so far."""
    times = os.times()
    return times.children_user + times.children_system
