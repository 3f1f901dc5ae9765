"""Hand-ins are read and judged in a child process with limits of time and memory.

The reader and the ring bound their work before it is done; still, a library in C cannot
be interrupted, and aborts its process where memory ends.  The limit of time is on the
processor, not on the clock, so that no verdict depends on how busy the machine is.
Where a child is stopped, the answers are tried one by one, and what stops its child is
unreadable.
"""

from __future__ import annotations

import os
import pickle
import signal
import traceback
from collections.abc import Callable
from typing import Any, TypeVar

from msgspec.structs import replace

from dynsolve.answers.judge import Checker
from dynsolve.answers.verdict import Report, Submission
from dynsolve.errors import Finding

SECONDS = 2
"""Processor time for one answer."""

MEMORY = 1 << 30
"""Bytes that a child may take beyond what it starts with."""

TOO_MUCH = "this takes more than 2 s or 1 GiB to work out"
REMEDY = "multiply out less, or name parts of it with `let`"


_T = TypeVar("_T")


class Stopped(Exception):
    """A child was stopped by its limits."""


def check_file(checker: Checker, source: bytes | str, file: str) -> Report:
    """Read a hand-in and judge it, within limits; nothing in `source` raises."""
    try:
        submission = limited(lambda: checker.reader(source, file), 5 * SECONDS)
    except Stopped:
        fault = Finding("the file takes too much time or memory to read", "hand in a smaller file", file)
        submission = Submission("", "", file, (), faults=(fault,))
    return check_within(checker, submission)


def check_within(checker: Checker, submission: Submission) -> Report:
    """Judge what was read, within limits; what the key costs is not counted."""
    checker.work_out(submission)
    allowed = SECONDS * (len(submission.answers) + 1)
    try:
        return limited(lambda: checker(submission), allowed)
    except Stopped:
        sound = replace(submission, answers=_sound(checker, submission))
    try:
        return limited(lambda: checker(sound), allowed)
    except Stopped:
        refused = tuple(
            replace(a, node=None, fault=a.fault or TOO_MUCH, expected=REMEDY) for a in sound.answers
        )
        return checker(replace(sound, answers=refused))


def _sound(checker: Checker, submission: Submission) -> tuple[Any, ...]:
    """The answers, with those that go over the limits by themselves unreadable."""
    answers = []
    for answer in submission.answers:
        alone = replace(submission, answers=(answer,))
        try:
            limited(lambda alone=alone: checker(alone), SECONDS)  # type: ignore[misc]
            answers.append(answer)
        except Stopped:
            answers.append(replace(answer, node=None, fault=TOO_MUCH, expected=REMEDY))
    return tuple(answers)


def limited(work: Callable[[], _T], seconds: float) -> _T:
    """What `work` gives, made in a child process with limits.

    Raises Stopped where the child was stopped, and whatever `work` raises.  Where
    processes cannot be forked the work is done here.
    """
    if not hasattr(os, "fork"):
        return work()
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        _run(work, writing, seconds)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        data = pipe.read()
    _, status = os.waitpid(child, 0)
    if status or not data:
        raise Stopped
    good, value = pickle.loads(data)  # noqa: S301  written by our own child
    if not good:
        raise value
    result: _T = value
    return result


def _run(work: Callable[[], Any], writing: int, seconds: float) -> None:
    """The child: limits, work, result, end."""
    code = 1
    try:
        _limit(seconds)
        try:
            data = pickle.dumps((True, work()))
        except MemoryError:
            os._exit(1)
        except Exception as error:  # noqa: BLE001  told to the parent, who raises it
            error.add_note(traceback.format_exc())
            data = pickle.dumps((False, error))
        with os.fdopen(writing, "wb") as pipe:
            pipe.write(data)
        code = 0
    finally:
        os._exit(code)


def _limit(seconds: float) -> None:
    import resource

    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_PROF, seconds)  # of the processor, not of the clock
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    size = _size() + MEMORY
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    if hard == resource.RLIM_INFINITY or size < hard:
        resource.setrlimit(resource.RLIMIT_AS, (size, hard))


def _size() -> int:
    """The address space of this process, in bytes; a guess where it cannot be seen."""
    try:
        with open("/proc/self/statm", "rb") as file:  # noqa: PTH123  a path object costs an import
            return int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError):
        return MEMORY
