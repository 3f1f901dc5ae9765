"""The Denavit-Hartenberg table as JSON has it: rows of texts, with the marks of joint variables."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from dynsolve.notation.build import times
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.tree import Degrees, Node, Symbol
from dynsolve.notation.walk import mapped
from dynsolve.quantities import families, letters
from dynsolve.solution.dynamics import Dynamics


def table_results(solution: Dynamics, printer: PythonPrinter) -> Iterator[tuple[str, Any]]:
    """`DH` where it is asked for; of a drawing always, and `base` where frame 0 is not the world."""
    problem = solution.problem
    name = families.DH.name
    if problem.normals is None and name not in problem.find and name not in problem.marks:
        return
    joints = solution.robot.joints
    yield name, [[printer.text(_starred(cell)) for cell in joint.written] for joint in joints]
    if problem.normals is not None and letters.has_base(solution.robot):
        base = solution.forms("H0")
        yield "base", [[printer.text(entry) for entry in row] for row in base.rows]  # type: ignore[attr-defined]


def _starred(cell: Node) -> Node:
    """A cell with the stars in the names, and with degrees as parts of π."""

    def change(node: Node) -> Node:
        match node:
            case Symbol(name, 0, True):
                return Symbol(f"{name}*")
            case Degrees(p, q):
                return times(Fraction(p, 180 * q), [(Symbol("pi"), 1)])
        return node

    return mapped(cell, change)
