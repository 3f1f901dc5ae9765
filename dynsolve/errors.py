"""Every error of dynsolve, by what the user must do about it.

An input error is a list of `Finding`s: all faults of a file come at once, each
with its place, what is wrong and what to do.
"""

from __future__ import annotations

import sys
import traceback
import warnings
from collections.abc import Callable, Sequence
from enum import IntEnum
from typing import TypeVar

from msgspec import Struct

T = TypeVar("T")


class ExitCode(IntEnum):
    """What the process ends with."""

    DONE = 0
    FALLS_SHORT = 1
    USAGE = 2
    FAILED = 3
    INTERRUPTED = 130


class DynsolveError(Exception):
    """The base of every error that dynsolve raises on purpose."""

    exit_code = ExitCode.FAILED


class Finding(Struct, frozen=True):
    """One fault of an input file, with its place and its remedy.

    `line` and `column` count from 1; 0 where the fault has no place.  `length`
    is how many characters the caret underlines, `excerpt` the source line.
    """

    message: str
    help: str = ""
    file: str = ""
    line: int = 0
    column: int = 0
    length: int = 1
    excerpt: str = ""
    code: str = ""

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        lines = [f"{place}: {self.message}" if place else self.message]
        if self.excerpt and self.column:
            lines += [f"  {self.excerpt}", "  " + " " * (self.column - 1) + "^" * max(self.length, 1)]
        if self.help:
            lines.append(f"help: {self.help}")
        return "\n".join(lines)


class InputError(DynsolveError):
    """What the user gave cannot be used; `findings` says where and why."""

    exit_code = ExitCode.USAGE

    def __init__(self, findings: Sequence[Finding]) -> None:
        self.findings = tuple(findings)
        super().__init__("\n".join(map(str, self.findings)))

    def __reduce__(self) -> tuple[type[InputError], tuple[tuple[Finding, ...]]]:
        return type(self), (self.findings,)  # as other processes hand it on


class ProblemError(InputError):
    """A problem file is faulty: mend the file."""


class UsageError(DynsolveError):
    """A command or a call was put wrongly: call again, corrected; `help` is how."""

    exit_code = ExitCode.USAGE

    def __init__(self, message: str, help: str = "") -> None:
        super().__init__(f"{message}\nhelp: {help}" if help else message)


class ReadError(DynsolveError):
    """A formula could not be read; `offset` and `length` count characters of its text."""

    exit_code = ExitCode.USAGE

    def __init__(self, message: str, offset: int = 0, length: int = 1, help: str = "") -> None:
        super().__init__(message)
        self.message, self.offset, self.length, self.help = message, offset, length, help


class AlgebraError(DynsolveError):
    """A formula has no exact meaning here (a zero denominator, a pole, a bare number as an angle)."""

    exit_code = ExitCode.USAGE

    def __init__(self, message: str, help: str = "") -> None:
        super().__init__(message)
        self.message, self.help = message, help


class VerificationError(DynsolveError):
    """The results disagree with the independent computation: a fault of dynsolve, never of the user."""


class NoStatesError(VerificationError):
    """No values of the parameters were found for which results can be compared."""


class ExplanationWarning(UserWarning):
    """A part of an explanation failed and is left out: a fault of dynsolve.  The results stand."""


def warn_left_out(what: str, why: str) -> None:
    """Say that a part of an explanation is left out, and ask for a report."""
    told = f"{what} is left out: {why}; the results stand. Please report this, with the problem file"
    warnings.warn(told, ExplanationWarning, stacklevel=2)


def attempted(make: Callable[[], T], otherwise: Callable[[], T], what: str) -> T:
    """What is made; where that fails, the other thing, with a warning: no explanation takes a result away.

    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     attempted(lambda: 1 // 0, lambda: 7, "a name")
    7
    >>> str(told[0].message).split(";")[0].rpartition(" at ")[0]
    'a name is left out: ZeroDivisionError'
    """
    try:
        return make()
    except InputError:
        raise
    except Exception as error:  # noqa: BLE001 - whatever fails in an explanation, the results stand
        place = traceback.extract_tb(sys.exc_info()[2])[-1]
        where = f"{place.filename.rpartition('dynsolve/')[2]}:{place.lineno}"
        warn_left_out(what, f"{type(error).__name__} at {where}")
        return otherwise()
