"""What is found of matrices, as JSON has it: the verdict, its conditions, and why."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from dynsolve.derivation.definite import Definiteness
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Reference, Verbatim
from dynsolve.explain.definite import inequality, reason
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.tree import Relation
from dynsolve.notation.unicode import UnicodePrinter

if TYPE_CHECKING:
    from dynsolve.solution.dynamics import Dynamics


def verdict_results(solution: Dynamics, printer: PythonPrinter, reader: UnicodePrinter) -> dict[str, Any]:
    """`definite`: of the D of a model, or of each candidate by its name."""
    candidates = solution.robot.questions.candidates
    found = {
        candidate.name: _result(solution, one, printer, reader)
        for candidate, one in zip(candidates, solution.values["definite"], strict=True)
    }
    return found["D"] if solution.robot.given is not None else found


def _result(
    solution: Dynamics, found: Definiteness | Skipped, printer: PythonPrinter, reader: UnicodePrinter
) -> dict[str, Any]:
    if isinstance(found, Skipped):
        return {"skipped": found.why}
    why = reason(solution.forms, found)
    said = (p for p in why if not isinstance(p, Reference))
    parts = (p if isinstance(p, str) else p.text if isinstance(p, Verbatim) else reader.text(p) for p in said)
    return {
        "verdict": found.answer.value,
        "conditions": [
            plain_inequality(inequality(solution.forms, bound), printer) for bound in found.conditions
        ],
        "why": "".join(parts),
    }


def plain_inequality(relation: Relation, printer: PythonPrinter) -> str:
    """a1 >= a2"""
    left, right = relation.parts
    sign = {"≥": ">="}.get(relation.signs[0], relation.signs[0])
    return f"{printer.text(left)} {sign} {printer.text(right)}"
