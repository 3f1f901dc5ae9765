"""Equilibria: the configurations at which gravity and springs move nothing, g(q) = 0.

The rows are combined first, as linear equations in what moves, with factors of parameters: what
stands in one of them alone is left.  Then each is taken apart into its factors, and every choice
of one factor of each is a case (as for singular configurations).  A case in which the cosine of an
angle would have to be more than 1 for all parameters is none.

What is divided out or multiplied by on the way may be 0 for special parameters, as m₁ l₁ - m₂ l₂
is: these are told, with the remainders of the forces on division by it, which are the forces there.

Where rates are held constant, g is the sum of forces in that motion (`steady`).

Slotine, Li, Applied Nonlinear Control, section 3.1 (1991).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
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
from dynsolve.derivation.singular.sets import Alternative, Special, TooLong, common_zeros
from dynsolve.derivation.stability import Curvature, Point
from dynsolve.robot.model import Robot

MOST_TERMS = 200
"""Forces with more terms are not taken apart."""

MOST_SPECIAL = 4
"""So many factors that may be 0 are told."""

MOST_SHOWN_TERMS = 12
"""Factors with more terms are not told."""

TOO_LONG = "gravity and springs are too long to be taken apart into factors"


@dataclass(frozen=True, slots=True)
class SpecialCase:
    """A factor of parameters alone, and the expressions that must be 0 in an equilibrium where it is 0."""

    factor: Expr
    forces: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Equilibria:
    """Where all of `rows` are 0: at any of the alternatives, with the points of each.

    `exist` is what the parameters must satisfy for each to be there.  All this is so where none of the
    `special` is; where there `may_be_others`, that are not told, for general parameters.
    """

    rows: tuple[Expr, ...]
    alternatives: tuple[Alternative, ...]
    points: tuple[tuple[Point, ...], ...]
    exist: tuple[tuple[Bound, ...], ...]
    special: tuple[SpecialCase, ...] = ()
    may_be_others: bool = False


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
    assumed = robot.questions.model.assumed
    signs = ParameterSigns(tuple(Bound(there(bound.value), bound.is_strict) for bound in assumed))
    special = Special(signs)
    rows = tuple(combined(robot, wanted, lambda factor: special.add(there(factor))))
    try:
        alternatives = common_zeros([there(row) for row in rows], special)
    except TooLong:
        return Skipped(TOO_LONG)
    found = {
        one: exist
        for one in alternatives
        if (exist := conditions([condition.expr for condition in one], signs)) is not None
    }
    second = Matrix.of(ring, ([there(robot.ring.diff(g, k)) for k in range(robot.n)] for g in forces.entries))
    for condition in (condition for one in found for condition in one):
        special.add(condition.multiplier(second.entries))
    curvature = Curvature(second, signs.beside(nonzero=special.factors), may_be_held)
    points = tuple(tuple(curvature.points(one, exist)) for one, exist in found.items())
    short = [factor for factor in special.factors if len(factor) <= MOST_SHOWN_TERMS][:MOST_SPECIAL]
    return Equilibria(
        rows,
        tuple(found),
        points,
        tuple(found.values()),
        tuple(SpecialCase(factor, _modulo(factor, map(there, wanted))) for factor in short),
        special.is_open or len(short) < len(special.factors),
    )


def _modulo(factor: Expr, forces: Iterable[Expr]) -> tuple[Expr, ...]:
    """What is left of forces where a factor is 0, without those that are 0, too."""
    ring = factor.ring
    rests = (Expr(ring, ring.reduce(divmod(force.poly, factor.poly)[1])) for force in forces)
    return tuple(dict.fromkeys(rest for rest in rests if not rest.is_zero))


def combined(robot: Robot, forces: Sequence[Expr], use: Callable[[Expr], None]) -> Iterator[Expr]:
    """Combinations of forces that are 0 where these are: each without what the others begin with.

    `use` is told what must not be 0 for that: factors that are multiplied by or divided out.
    """
    kinds = generators(robot.ring, frozenset())
    left = [row for row in map(_row(robot, kinds), forces) if row]
    done: list[dict[Any, Expr]] = []
    while left:
        lead = max(key for row in left for key in row)
        chosen = min((row for row in left if lead in row), key=lambda row: (len(row), _size(row)))
        others = [row for row in left if row is not chosen]
        left = [row for row in (_without(other, chosen, lead, use) for other in others) if row]
        done = [_without(row, chosen, lead, use) for row in done]
        done.append(chosen)
    yield from (expression(robot.ring, _primitive(row, use)) for row in done)


def _primitive(row: dict[Any, Expr], use: Callable[[Expr], None]) -> dict[Any, Expr]:
    """A row without what all its entries share."""
    found = primitive(row)
    for key in list(found)[:1]:
        use(_quotient(row[key], found[key]))
    return found


def _quotient(value: Expr, divisor: Expr) -> Expr:
    """A value divided by one of its factors."""
    return Expr(value.ring, divmod(value.poly, divisor.poly)[0])


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


def _without(
    row: dict[Any, Expr], chosen: dict[Any, Expr], lead: Any, use: Callable[[Expr], None]
) -> dict[Any, Expr]:
    """A row less so much of another that `lead` is gone; it is multiplied by a parameter for that."""
    if lead not in row:
        return row
    shared = Expr(row[lead].ring, row[lead].poly.gcd(chosen[lead].poly))
    mine, theirs = _quotient(row[lead], shared), _quotient(chosen[lead], shared)
    use(theirs)
    found = {key: value * theirs for key, value in row.items()}
    for key, value in chosen.items():
        found[key] = found[key] - value * mine if key in found else -(value * mine)
    return _primitive({key: value for key, value in found.items() if not value.is_zero}, use)


def _size(row: dict[Any, Expr]) -> int:
    return sum(map(len, row.values()))
