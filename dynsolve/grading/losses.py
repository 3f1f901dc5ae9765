"""What an answer that follows has lost on the way: following is easy where little is left."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judge import Judge
from dynsolve.answers.verdict import Report, Verdict


def losses(judge: Judge, report: Report) -> dict[str, str]:
    """What is lost, compared with the key, in each answer that follows or has entries that do.

    What is not written has lost what the matrix has that it is an entry of, or its parts.
    """
    found: dict[str, str] = {}
    quantities = judge.graph.quantities
    for answer in report.answers:
        compared = judge.hand_in.comparisons.get(answer.name)
        following = answer.verdict is Verdict.FOLLOWS or any(
            entry.verdict is Verdict.FOLLOWS for entry in answer.entries
        )
        if compared is not None and compared.rows and following:
            loss = _loss(judge, compared)
            if loss:
                found[answer.name] = loss
    for answer in report.answers:
        if not answer.given:
            sources = (quantities.entry_of(answer.name)[0], *quantities.parts(answer.name))
            loss = next((found[name] for name in sources if name in found), "")
            if loss:
                found[answer.name] = loss
    return found


def _loss(judge: Judge, compared: Any) -> str:
    key = compared.target.of(judge.graph.key(compared.target.node))
    expected = list(key.entries) if isinstance(key, Matrix) else [key]
    written = [
        part
        for row in compared.rows
        for entry in row
        for part in (entry.value.numerator, entry.value.denominator)
    ]
    before, after = _names(expected), _names(written)
    for body in judge.problem.robot.bodies:
        mass = _names([body.mass])
        own = mass | (_names(list(body.inertia.entries)) if body.inertia is not None else set())
        if mass & before and not own & after:
            return f"body {body.name} is lost on the way"
    for coordinate in judge.problem.robot.coordinates:
        if coordinate.name in before and coordinate.name not in after:
            return f"{coordinate.name} is lost on the way"
    kept = sum(len(entry.value.numerator) for row in compared.rows for entry in row)
    wanted = sum(len(expr) for expr in expected)
    return f"it keeps {kept} of {wanted} terms" if 2 * kept < wanted else ""


def _names(values: list[Expr]) -> set[str]:
    return {name for value in values for name in _names_of(value)}


def _names_of(value: Any) -> Iterator[str]:
    """The symbols, and the coordinates of the angles, that a value holds."""
    ring = value.ring
    degrees = value.poly.degrees() if value.poly else ()
    for generator, degree in zip(ring.generators, degrees, strict=False):
        if degree and generator.kind == "symbol":
            yield generator.name
        elif degree and generator.kind in ("sin", "cos"):
            for atom, _ in generator.angle.terms:
                yield from (name for name, _ in atom)
