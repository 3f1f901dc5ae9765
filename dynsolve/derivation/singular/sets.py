"""The configurations at which some polynomials are all 0, as alternatives of conditions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import minors
from dynsolve.algebra.positivity import is_positive
from dynsolve.algebra.trig_factor import trig_factors
from dynsolve.derivation.singular.conditions import Condition
from dynsolve.derivation.singular.losses import Loss, loss

Alternative = tuple[Condition, ...]
"""Conditions that hold together."""

MOST_ALTERNATIVES = 64
"""So many alternatives are looked at."""

MOST_TERMS = 200
"""A Jacobian with more terms is not looked at."""

MOST_MINOR_TERMS = 1500
"""Nor are minors with more terms together."""


@dataclass(frozen=True, slots=True)
class SingularSet:
    """Where a matrix of greatest rank `rank` has less: at any of the `alternatives`.

    `minors` are the expressions that vanish there, all in one ring.  `losses` are the rank and
    what is lost at each alternative.
    """

    rank: int
    minors: tuple[Expr, ...]
    alternatives: tuple[Alternative, ...]
    losses: tuple[Loss, ...] = ()


def singular_set(jacobian: Matrix) -> SingularSet | None:
    """Where a Jacobian loses rank; `jacobian` is in a ring of one angle a coordinate.

    Parameters count as positive: no alternative is a condition on them.  None where the
    Jacobian or its minors are too long.
    """
    if sum(map(len, jacobian.entries)) > MOST_TERMS:
        return None
    for rank in range(min(jacobian.shape), 0, -1):
        found = tuple(minors(jacobian, rank))
        if found:
            if sum(map(len, found)) > MOST_MINOR_TERMS:
                return None
            alternatives = common_zeros(found)
            losses = tuple(loss(jacobian, conditions, rank) for conditions in alternatives)
            return SingularSet(rank, found, alternatives, losses)
    return SingularSet(0, (), ())


def common_zeros(values: Sequence[Expr]) -> tuple[Alternative, ...]:
    """Where expressions are all 0, the alternatives with the fewest conditions alone."""
    found: list[Alternative] = []
    for alternative in _alternatives(tuple(values), ()):
        if not any(set(known) <= set(alternative) for known in found):
            found = [known for known in found if not set(alternative) <= set(known)]
            found.append(alternative)
        if len(found) >= MOST_ALTERNATIVES:
            break
    found = [one for one in found if not any(other is not one and _implies(one, other) for other in found)]
    return tuple(_merged(found))


def _alternatives(values: tuple[Expr, ...], held: Alternative) -> Iterator[Alternative]:
    left = [value for value in dict.fromkeys(values) if not value.is_zero]
    if not left:
        yield held
        return
    choices = [[factor for factor, _ in trig_factors(value) if _may_vanish(factor, held)] for value in left]
    for factor in min(choices, key=_effort):
        condition = Condition(factor)
        rest = tuple(condition.reduced(value) for value in left)
        yield from _alternatives(rest, (*held, condition))


def _effort(factors: Sequence[Expr]) -> tuple[int, int]:
    """The fewest cases first; of these what fixes a coordinate, which can be put into the others."""
    return len(factors), sum(not Condition(factor).fixes_coordinate for factor in factors)


def _may_vanish(factor: Expr, held: Alternative) -> bool:
    """Whether a factor is 0 at some configuration where the conditions hold, as far as its form shows.

    Where sin q = 0, cos q is ±1, and its square shows that it is not 0.
    """
    if not factor.ring.depends_on_coordinates(factor):
        return False
    square = factor * factor
    for condition in held:
        square = condition.reduced(square)
    return not is_positive(square) and not is_positive(factor) and not is_positive(-factor)


def _implies(one: Alternative, other: Alternative) -> bool:
    """Whether `other` holds wherever `one` does."""
    for wanted in other:
        value = wanted.expr
        for condition in one:
            value = condition.reduced(value)
        if not value.is_zero:
            return False
    return not all(condition in one for condition in other) or len(other) < len(one)


def _merged(alternatives: list[Alternative]) -> Iterator[Alternative]:
    """q = 0 or q = π together as sin q = 0, and the same for the quarter turns."""
    left = list(alternatives)
    while left:
        one = left.pop(0)
        for other in left:
            joined = _joined(one, other)
            if joined is not None:
                left.remove(other)
                left.insert(0, joined)
                break
        else:
            yield one


def _joined(one: Alternative, other: Alternative) -> Alternative | None:
    mine, theirs = set(one) - set(other), set(other) - set(one)
    if len(mine) != 1 or len(theirs) != 1:
        return None
    a, b = mine.pop().expr, theirs.pop().expr
    ring = a.ring
    for name, kind in ring.coordinates:
        if kind == "revolute":
            for whole, part in ((ring.sin, ring.cos), (ring.cos, ring.sin)):
                unit = part(Angle.of(name))
                values = {unit - ring.one, unit + ring.one}
                if {a, b} == values:
                    kept = [c for c in one if c.expr != a]
                    return (*kept, Condition(whole(Angle.of(name))))
    return None
