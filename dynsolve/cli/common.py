"""Shared by the commands: reading a problem from a path, the library or standard input; showing findings."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from dynsolve.errors import Finding
    from dynsolve.problem import Problem

STDIN = "-"
STDIN_NAME = "<stdin>"

Problems = Annotated[
    list[str],
    typer.Argument(
        metavar="PROBLEM",
        help="Problem files, stems of bundled problems, or - for standard input.",
        show_default=False,
    ),
]

Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No warnings and no progress on standard error.")]


def read(name: str) -> Problem:
    """The problem of a path, of the stem of a bundled problem, or of standard input (`-`)."""
    if name == STDIN:
        from dynsolve.problem import read_problem

        return read_problem(standard_input(), STDIN_NAME)
    from dynsolve.problem import load
    from dynsolve.problem.library import find

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
    from dataclasses import replace

    return str(replace(finding, message=f"{word}: {finding.message}") if word else finding)
