"""Ways to what is asked of the equations of motion: Y by the parameters of the key, or by the student's."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from dynsolve.algebra.fraction_matrix import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.route import Key, Route
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.errors import AlgebraError


def model_routes(rule: Rule, key: Key) -> Iterator[Route]:
    """The routes to a regressor, from its rule."""
    *forces, parameters = rule.inputs

    def by_key(*values: Any) -> Matrix | FractionMatrix:
        return _found(rule.compute(*values, key(parameters)))

    yield Route(tuple(forces), by_key, linear=False)
    yield Route(rule.inputs, lambda *values: _found(rule.compute(*values)), linear=False)


def _found(value: Matrix | FractionMatrix | Skipped) -> Matrix | FractionMatrix:
    if isinstance(value, Skipped):
        raise AlgebraError(value.why)
    return value
