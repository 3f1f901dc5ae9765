"""What is found of matrices, as JSON has it: the verdict, its conditions, and why."""

from __future__ import annotations

from typing import Any

from dynsolve.derivation.graph import Skipped
from dynsolve.document import Reference, Verbatim
from dynsolve.explain.forms import Forms
from dynsolve.questions.definite.derive import Definiteness
from dynsolve.questions.definite.explain import inequality, reason
from dynsolve.questions.export import Export, plain_inequality


def value(export: Export, name: str) -> Any:
    """`definite`: of the D of a model, or of each candidate by its name."""
    robot = export.general_robot
    verdicts = zip(robot.questions.candidates, export.general_values[name], strict=True)
    found = {
        candidate.name: _result(export, export.forms.in_ring(candidate.matrix.ring), one)
        for candidate, one in verdicts
    }
    return found["D"] if robot.given is not None else found


def _result(export: Export, forms: Forms, found: Definiteness | Skipped) -> dict[str, Any]:
    if isinstance(found, Skipped):
        return {"skipped": found.why}
    why = reason(forms, found)
    said = (p for p in why if not isinstance(p, Reference))
    parts = (
        p if isinstance(p, str) else p.text if isinstance(p, Verbatim) else export.unicode.text(p)
        for p in said
    )
    return {
        "verdict": found.answer.value,
        "conditions": [
            " or ".join(plain_inequality(inequality(forms, bound), export.python) for bound in bounds)
            for bounds in found.conditions
        ],
        "why": "".join(parts),
    }
