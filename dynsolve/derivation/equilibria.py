"""Equilibria: the configurations at which gravity and springs move nothing, g(q) = 0.

The rows are combined first, as linear equations in what moves, with factors of parameters: what
stands in one of them alone is left.  Then each is taken apart into its factors, and every choice
of one factor of each is a case (as for singular configurations).

At rest an equilibrium is stable where the potential energy has a strict minimum, the matrix of
its second derivatives ∂g/∂q being positive definite (Lagrange and Dirichlet), and unstable where
this matrix has a negative direction.

Slotine, Li, Applied Nonlinear Control, sections 3.1 and 3.4 (1991).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import combinations, product
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant
from dynsolve.algebra.parameter_span import Generators, expression, primitive
from dynsolve.algebra.positivity import is_positive
from dynsolve.algebra.pseudoinverse import part
from dynsolve.algebra.transfer import Transfer
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.inverse.unknowns import search_ring
from dynsolve.derivation.regressor import generators
from dynsolve.derivation.singular.conditions import Condition
from dynsolve.derivation.singular.sets import Alternative, common_zeros
from dynsolve.robot.model import Robot

MOST_TERMS = 200
"""Forces with more terms are not taken apart."""

MOST_POINTS = 16
"""With more points in a case their stability is not told one by one."""

MOST_MINORS = 6
"""The stability of robots with more coordinates is not decided."""

TOO_LONG = "gravity and springs are too long to be taken apart into factors"

Values = tuple[tuple[Pair, int, int], ...]
"""(angle, sine, cosine): quarter turns."""


class Stability(StrEnum):
    """What second derivatives say of an equilibrium."""

    STABLE = "stable"
    UNSTABLE = "unstable"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True)
class Point:
    """Quarter turns of angles in a case, and how stable the arm is there.

    `neutral` are the coordinates, from 0, along which nothing changes.
    """

    values: Values
    stability: Stability
    neutral: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Equilibria:
    """Where all of `rows` are 0: at any of the alternatives, with the points of each."""

    rows: tuple[Expr, ...]
    alternatives: tuple[Alternative, ...]
    points: tuple[tuple[Point, ...], ...]


def equilibria(robot: Robot, gravity: Matrix) -> Equilibria | Skipped:
    """The configurations with g(q) = 0 in every row, or with `inputs: given` in those without a motor."""
    wanted = robot.actions.passive if robot.questions.model.inputs_given else range(robot.n)
    forces = [gravity[k, 0] for k in wanted]
    if sum(map(len, forces)) > MOST_TERMS:
        return Skipped(TOO_LONG)
    ring = search_ring(robot.ring, (), {})
    there = Transfer(robot.ring, ring)
    rows = tuple(combined(robot, forces))
    alternatives = common_zeros([there(row) for row in rows])
    second = Matrix.of(
        ring, ([there(robot.ring.diff(g, k)) for k in range(robot.n)] for g in gravity.entries)
    )
    return Equilibria(rows, alternatives, tuple(tuple(_points(second, one)) for one in alternatives))


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


# -- stability -------------------------------------------------------------------------------------


def _points(second: Matrix, alternative: Alternative) -> Iterator[Point]:
    """The quarter turns that a case allows, each with the second derivatives of the energy there."""
    if 2 ** len(alternative) > MOST_POINTS:
        return
    turns = [found for one in alternative if (found := _quarter_turns(one))]
    others = [one for one in alternative if not _quarter_turns(one)]
    for values in product(*turns):
        at = _put(second, values)
        rest = [_put(Matrix.column(second.ring, [one.expr]), values).entries[0] for one in others]
        for left in rest:
            if not left.is_zero:
                size = at.shape[1]
                flat = Condition(left).reduced_together(at.entries)
                at = Matrix.of(second.ring, (flat[i : i + size] for i in range(0, len(flat), size)))
        yield Point(values, *_stability(at))


def _quarter_turns(condition: Condition) -> list[tuple[Pair, int, int]]:
    """The quarter turns at which sin q, cos q, or one of these less ±1, is 0; none of other conditions."""
    ring = condition.expr.ring
    quarters = ((0, 1), (1, 0), (0, -1), (-1, 0))
    for pair in ring.pairs:
        used = {i for i, degree in enumerate(condition.expr.poly.degrees()) if degree > 0}
        if used and used <= {pair.sine, pair.cosine}:
            column = Matrix.column(ring, [condition.expr])
            return [(pair, s, c) for s, c in quarters if _put(column, ((pair, s, c),)).is_zero]
    return []


def _put(matrix: Matrix, values: Values) -> Matrix:
    """The matrix at quarter turns."""
    ring = matrix.ring
    images = [ring.generator(g.index).poly for g in ring.generators]
    for pair, sine, cosine in values:
        images[pair.sine], images[pair.cosine] = ring.constant(sine).poly, ring.constant(cosine).poly
    return matrix.map(lambda entry: Expr(ring, ring.reduce(entry.poly.compose(*images, ctx=ring.ctx))))


def _stability(second: Matrix) -> tuple[Stability, tuple[int, ...]]:
    """(what the second derivatives say, the coordinates along which nothing changes)"""
    size = len(second.rows)
    neutral = tuple(k for k in range(size) if all(entry.is_zero for entry in second.rows[k]))
    rest = tuple(k for k in range(size) if k not in neutral)
    if not rest or len(rest) > MOST_MINORS:
        return Stability.UNDECIDED, neutral
    minors = {
        k: [determinant(part(second, c, c)) for c in combinations(rest, k)] for k in range(1, len(rest) + 1)
    }
    if any(is_positive(-value) for k in (1, 2) for value in minors.get(k, ())):
        return Stability.UNSTABLE, neutral
    leading = [determinant(part(second, rest[:k], rest[:k])) for k in range(1, len(rest) + 1)]
    if all(map(is_positive, leading)):
        return Stability.STABLE, neutral
    return Stability.UNDECIDED, neutral
