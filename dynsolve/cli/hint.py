"""`dynsolve solve --hint STAGE`: what to do next, without the result."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dynsolve.solution import Solution


def print_hint(solution: Solution, stage: str) -> None:
    """The hint for a stage, on standard output."""
    from dynsolve.cli.page import print_document

    print_document(solution.hint(stage), solution.style)
