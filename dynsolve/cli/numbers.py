"""The options of `solve` that put numbers in: --set, --at, --digits.

Shared by the commands: reading a problem from a path, the library or standard input; showing findings.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from dynsolve.errors import Finding
    from dynsolve.problem import Problem
    from dynsolve.solution.solution import Solution

SET, AT = "--set", "--at"

SetOption = Annotated[
    list[str] | None,
    typer.Option(
        SET,
        metavar="NAME=VALUE",
        help="A number for a parameter, for results in numbers: L1=0.4, m1=3/2. May be given more than once.",
    ),
]

AtOption = Annotated[
    list[str] | None,
    typer.Option(
        AT,
        metavar="STATE",
        help="Every stage at a state: theta1=30deg,L2=0.2,theta1_dot=1. Rates that are not given are 0.",
    ),
]

DigitsOption = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        min=1,
        max=15,
        help="Numbers as decimals of N significant digits, of a model in numbers too (else 4, or exact).",
    ),
]


def with_numbers(
    solution: Solution, values: list[str] | None, state: list[str] | None, digits: int | None
) -> Solution:
    """The solution with the numbers beside it that were asked for, or that the file gives in full."""
    if not (values or state or solution.problem.written):
        if digits is None:
            return solution

        if not solution.robot.is_numeric:
            raise typer.BadParameter("--digits needs numbers: --set, --at, or masses or values: in the file")
    from dynsolve.solution.numbers.given import of_option

    place = None if state is None else tuple(of_option(AT, state))
    return solution.beside(tuple(of_option(SET, values or ())), place, digits)


# Shared by the commands

STDIN = "-"
STDIN_NAME = "<stdin>"


def stems(incomplete: str) -> list[str]:
    """The bundled problems that begin so, for a shell that completes words.

    >>> stems("scara")
    ['scara-rrpr']
    """
    from dynsolve.problem.reader import bundled

    return [stem for stem in bundled() if stem.startswith(incomplete)]


Problems = Annotated[
    list[str],
    typer.Argument(
        metavar="PROBLEM",
        help="Problem files, stems of bundled problems, or - for standard input.",
        show_default=False,
        autocompletion=stems,
    ),
]

Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No warnings and no progress on standard error.")]


def read(name: str) -> Problem:
    """The problem of a path, of the stem of a bundled problem, or of standard input (`-`)."""
    if name == STDIN:
        from dynsolve.problem import read_problem

        return read_problem(standard_input(), STDIN_NAME)
    from dynsolve.problem import load
    from dynsolve.problem.reader import find

    return load(find(name))


def print_json(value: Any) -> None:
    """Print a value as one line of JSON."""
    from json import dump

    dump(value, sys.stdout, ensure_ascii=False)
    sys.stdout.write("\n")


def standard_input() -> bytes:
    """All of standard input."""
    return sys.stdin.buffer.read()


def say(findings: Iterable[Finding], word: str = "") -> None:
    """Print findings on standard error."""
    for finding in findings:
        typer.echo(described(finding, word), err=True)


def described(finding: Finding, word: str = "") -> str:
    """`file:line:column: word: message`, the source line with a caret, and the remedy."""
    from msgspec.structs import replace

    return str(replace(finding, message=f"{word}: {finding.message}") if word else finding)
