"""Equilibria: the configurations at which gravity and springs move nothing, g(q) = 0.

The rows are combined first, as linear equations in what moves, with factors of parameters: what
stands in one of them alone is left.  Then each is taken apart into its factors, and every choice
of one factor of each is a case (as for singular configurations).  A case in which the cosine of an
angle would have to be more than 1 for all parameters is none.

Where rates are held constant, g is the sum of forces in that motion (`steady`).

Slotine, Li, Applied Nonlinear Control, section 3.1 (1991).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.parameter_span import Generators, expression, primitive
from dynsolve.algebra.transfer import Transfer
from dynsolve.derivation.existence import conditions
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.inverse.unknowns import search_ring
from dynsolve.derivation.parameter_signs import ParameterSigns
from dynsolve.derivation.regressor import generators
from dynsolve.derivation.singular.sets import Alternative, TooLong, common_zeros
from dynsolve.derivation.stability import Curvature, Point
from dynsolve.robot.model import Robot

MOST_TERMS = 200
"""Forces with more terms are not taken apart."""

TOO_LONG = "gravity and springs are too long to be taken apart into factors"


@dataclass(frozen=True, slots=True)
class Equilibria:
    """Where all of `rows` are 0: at any of the alternatives, with the points of each.

    `exist` is what the parameters must satisfy for each to be there.
    """

    rows: tuple[Expr, ...]
    alternatives: tuple[Alternative, ...]
    points: tuple[tuple[Point, ...], ...]
    exist: tuple[tuple[Bound, ...], ...]


def wanted_rows(robot: Robot) -> list[int]:
    """The coordinates, from 0, whose forces must be 0: those that no motor holds, or keeps at its rate."""
    passive, model = robot.actions.passive, robot.questions.model
    steady = dict(model.steady)
    return [
        k
        for k, q in enumerate(robot.coordinates)
        if k in passive or not (model.inputs_given or q.name in steady)
    ]


def equilibria(robot: Robot, forces: Matrix, may_be_held: bool = False) -> Equilibria | Skipped:
    """The configurations where the forces (n×1) are 0 in every row that no motor holds.

    The forces are derivatives of an energy: g(q), or those of `steady`; `may_be_held` is that of
    `stability.Curvature`.
    """
    wanted = [forces[k, 0] for k in wanted_rows(robot)]
    if sum(map(len, wanted)) > MOST_TERMS:
        return Skipped(TOO_LONG)
    ring = search_ring(robot.ring, (), {})
    there = Transfer(robot.ring, ring)
    rows = tuple(combined(robot, wanted))
    assumed = robot.questions.model.assumed
    signs = ParameterSigns(tuple(Bound(there(bound.value), bound.is_strict) for bound in assumed))
    try:
        alternatives = common_zeros([there(row) for row in rows])
    except TooLong:
        return Skipped(TOO_LONG)
    found = {
        one: exist
        for one in alternatives
        if (exist := conditions([condition.expr for condition in one], signs)) is not None
    }
    second = Matrix.of(ring, ([there(robot.ring.diff(g, k)) for k in range(robot.n)] for g in forces.entries))
    curvature = Curvature(second, signs, may_be_held)
    points = tuple(tuple(curvature.points(one, exist)) for one, exist in found.items())
    return Equilibria(rows, tuple(found), points, tuple(found.values()))


def combined(robot: Robot, forces: Sequence[Expr]) -> Iterator[Expr]:
    """Combinations of forces that are 0 where these are: each without what the others begin with."""
    kinds = generators(robot.ring, frozenset())
    left = [row for row in map(_row(robot, kinds), forces) if row]
    done: list[dict[Any, Expr]] = []
    while left:
        lead = max(key for row in left for key in row)
        chosen = min((row for row in left if lead in row), key=lambda row: (len(row), _size(row)))
        others = [row for row in left if row is not chosen]
        left = [row for row in (_without(other, chosen, lead) for other in others) if row]
        done = [_without(row, chosen, lead) for row in done]
        done.append(chosen)
    yield from (expression(robot.ring, primitive(row)) for row in done)


def _row(robot: Robot, kinds: Generators) -> Any:
    """A force as a vector: polynomials in the parameters by the product of what moves."""

    def row(force: Expr) -> dict[Any, Expr]:
        moving = Generators(frozenset(range(len(robot.ring.generators))) - kinds.moving, kinds.moving)
        found: dict[Any, Expr] = {}
        for factor, vector in moving.split(force):
            for key, number in vector.items():
                value = factor * number
                found[key] = found[key] + value if key in found else value
        return {key: value for key, value in found.items() if not value.is_zero}

    return row


def _without(row: dict[Any, Expr], chosen: dict[Any, Expr], lead: Any) -> dict[Any, Expr]:
    """A row less so much of another that `lead` is gone; it is multiplied by a parameter for that."""
    if lead not in row:
        return row
    mine, theirs = row[lead], chosen[lead]
    found = {key: value * theirs for key, value in row.items()}
    for key, value in chosen.items():
        found[key] = found[key] - value * mine if key in found else -(value * mine)
    return primitive({key: value for key, value in found.items() if not value.is_zero})


def _size(row: dict[Any, Expr]) -> int:
    return sum(map(len, row.values()))
