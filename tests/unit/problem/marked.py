"""Texts of problem files in which «...» marks the characters that an error underlines."""

from __future__ import annotations

import re
from textwrap import dedent

from dynsolve.errors import Finding, ProblemError
from dynsolve.problem import read_problem

PLANAR = """
dh:
  - {theta: theta1*, d: 0, a: l1, alpha: 0}
  - {theta: theta2*, d: 0, a: l2, alpha: 0}
"""
RP = """
dh:
  - {theta: theta1* + 90deg, d: L1, a: 0, alpha: 90deg}
  - {theta: 0, d: L2*, a: 0, alpha: 0}
"""


def unmarked(marked: str) -> tuple[str, list[tuple[int, int, int]]]:
    """The text without its marks, and (line, column, length) of what they enclosed."""
    text, places = "", []
    for piece in re.split("([«»])", dedent(marked)):
        if piece == "«":
            line = text.count("\n") + 1
            places.append([line, len(text) - text.rfind("\n"), len(text)])
        elif piece == "»":
            places[-1][2] = len(text) - places[-1][2]
        else:
            text += piece
    return text, [(line, column, length) for line, column, length in places]


def errors(text: str) -> tuple[Finding, ...]:
    """The errors of a text; none where it is sound."""
    try:
        read_problem(text, "robot.yaml")
    except ProblemError as error:
        return error.findings
    return ()


def places(findings: tuple[Finding, ...]) -> list[tuple[int, int, int]]:
    """(line, column, length) of each finding."""
    return [(f.line, f.column, f.length) for f in findings]
