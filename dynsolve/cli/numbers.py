"""The options of `solve` that put numbers in: --set, --at, --digits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
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
        from dynsolve.explain.forms import is_numeric

        if not is_numeric(solution.robot):
            raise typer.BadParameter("--digits needs numbers: --set, --at, or masses or values: in the file")
    from dynsolve.solution.numbers.assignments import of_option

    place = None if state is None else tuple(of_option(AT, state))
    return solution.beside(tuple(of_option(SET, values or ())), place, digits)
