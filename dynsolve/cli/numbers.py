"""The options of `solve` that put numbers in: --set, --at, --digits.

Shared by the commands: reading a problem from a path, the library or standard input; showing findings.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from enum import StrEnum
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from dynsolve.errors import Finding
    from dynsolve.problem import Problem
    from dynsolve.solution.solution import Solution

Name = TypeVar("Name", bound=StrEnum)


class Names(click.Choice[Name]):
    """The members of an enumeration, typed as their values."""

    def normalize_choice(self, choice: object, ctx: click.Context | None) -> str:
        """As it is typed."""
        return str(choice)

    def get_invalid_choice_message(self, value: Any, ctx: click.Context | None) -> str:
        """What may be typed, and which of these may have been meant."""
        from dynsolve.problem.kinds import did_you_mean

        message = super().get_invalid_choice_message(value, ctx)
        meant = did_you_mean(value, map(str, self.choices))
        return f"{message.rstrip('.')}; {meant}" if meant else message


SET, AT = "--set", "--at"

set_option = click.option(
    SET,
    "set_",
    multiple=True,
    metavar="NAME=VALUE",
    help="A number for a parameter, for results in numbers: L1=0.4, m1=3/2. May be given more than once.",
)
at_option = click.option(
    AT,
    multiple=True,
    metavar="STATE",
    help="Every stage at a state: theta1=30deg,L2=0.2,theta1_dot=1. Rates that are not given are 0.",
)
digits_option = click.option(
    "--digits",
    metavar="N",
    type=click.IntRange(1, 15),
    help="Numbers as decimals of N significant digits, of a model in numbers too (else 4, or exact).",
)


def with_numbers(
    solution: Solution, values: tuple[str, ...], state: tuple[str, ...], digits: int | None
) -> Solution:
    """The solution with the numbers beside it that were asked for, or that the file gives in full."""
    if not (values or state or solution.problem.written):
        if digits is None:
            return solution
        from dynsolve.explain.forms import is_numeric

        if not is_numeric(solution.robot):
            raise click.BadParameter("--digits needs numbers: --set, --at, or masses or values: in the file")
    from dynsolve.solution.numbers.given import of_option

    place = tuple(of_option(AT, state)) if state else None
    return solution.beside(tuple(of_option(SET, values)), place, digits)


# Shared by the commands

STDIN = "-"
STDIN_NAME = "<stdin>"


def stems(context: click.Context, parameter: click.Parameter, incomplete: str) -> list[str]:
    """The bundled problems that begin so, for a shell that completes words."""
    from dynsolve.problem.reader import bundled

    return [stem for stem in bundled() if stem.startswith(incomplete)]


problem_arguments = click.argument(
    "problem",
    nargs=-1,
    required=True,
    help="Problem files, stems of bundled problems, or - for standard input.",
    shell_complete=stems,
)
quiet_option = click.option(
    "--quiet", "-q", is_flag=True, help="No warnings and no progress on standard error."
)


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
        click.echo(described(finding, word), err=True)


def described(finding: Finding, word: str = "") -> str:
    """`file:line:column: word: message`, the source line with a caret, and the remedy."""
    from msgspec.structs import replace

    return str(replace(finding, message=f"{word}: {finding.message}") if word else finding)
