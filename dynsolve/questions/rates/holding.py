"""Under which conditions rates and spaces hold: the rank of the Jacobian, and what may not be 0."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain, combinations
from math import prod

from msgspec import Struct

from dynsolve.algebra.factors import is_never_zero, trig_factors, trig_quotient
from dynsolve.algebra.linear_systems import rank_parts
from dynsolve.algebra.matrix import AtState, Matrix, determinant, minors, work
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.spaces import dependent_where
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.writing import is_small, listed
from dynsolve.notation.tree import ONE, ZERO, Node, Relation, Words
from dynsolve.questions.rates.derive import MOST_PRODUCTS, squared
from dynsolve.questions.set_forms import SetForms, may_vanish


class Holding(Struct, frozen=True):
    """What is so where something holds: nothing of what is so in every configuration.

    The `rank` is 0 where it is always the same; it is what it is where `is_full`, if that can be told.
    The vectors of a space are independent there where `apart` is not 0; words, where that is too long.
    """

    rank: int = 0
    is_full: Relation | None = None
    apart: Node | None = None

    @property
    def prose(self) -> Prose:
        """All this holds where the rank of J is 2 and s₂ ≠ 0."""
        conditions: list[Prose | Node] = []
        if self.is_full is not None:
            conditions.append(self.is_full)
        elif self.rank:
            conditions.append(say("the rank of $𝐉_r$ is {rank}", rank=self.rank))
        if self.apart is not None:
            is_told = not isinstance(self.apart, Words)
            conditions.append(Relation((self.apart, ZERO), ("≠",)) if is_told else self.apart)
        return say("All this holds where {these}.", these=listed(conditions)) if conditions else ()


def of_rates(forms: SetForms) -> Holding:
    """Where q̇, q̈ and a space hold as they are derived: where the rank is that of general values."""
    J = AtState(forms.robot.ring, forms.robot.questions.state.by_symbol).matrix(forms.values["Jr"])
    rank = rank_parts(J).rank
    if rank == 0:
        return Holding()
    if work(squared(J)) > MOST_PRODUCTS:
        return Holding(rank)
    found = list(minors(J, rank))
    if any(map(is_never_zero, found)):
        return Holding()
    shared = prod((factor**times for factor, times in _shared_factors(found)), start=J.ring.one)
    if J.shape == (rank, rank) or _are_never_zero([trig_quotient(minor, shared) for minor in found]):
        if may_vanish(shared) == J.ring.one:
            return Holding()
        is_full = forms.comparison(may_vanish(shared), "≠")
        return Holding(rank, is_full if is_small(is_full) else None)
    is_fixed = any(map(is_never_zero, chain(_sizes(J, rank), _sizes(J.T, rank))))
    return Holding(0 if is_fixed else rank)


def of_space(forms: SetForms, name: str) -> Holding:
    """Where the vectors of a space are a basis of it."""
    found, vectors = of_rates(forms), forms.values[name]
    if not vectors.shape[1]:
        return found
    value = dependent_where(vectors)
    apart = Words("these vectors are independent") if value is None else forms.vanishing(value)
    return found if apart == ONE else Holding(found.rank, found.is_full, apart)


def _shared_factors(values: Sequence[Expr]) -> Iterator[tuple[Expr, int]]:
    """The factors that all of some values have, each as often as all have it."""
    first, *others = (dict(trig_factors(value)) for value in values)
    for factor, times in first.items():
        if often := min([times, *(other.get(factor, 0) for other in others)]):
            yield factor, often


def _are_never_zero(values: Sequence[Expr | None]) -> bool:
    """Whether it is seen that some values are nowhere all 0."""
    known = [value for value in values if value is not None]
    squares = [value * value for value in known if len(value) ** 2 <= MOST_PRODUCTS]
    return any(map(is_never_zero, [*known, sum(squares[1:], start=squares[0])] if squares else known))


def _sizes(J: Matrix, rank: int) -> Iterator[Expr]:
    """det(Mᵀ M) of so many columns M: 0 where they are dependent."""
    for chosen in combinations(J.T.rows, rank):
        columns = Matrix(J.ring, chosen)
        if work(square := columns @ columns.T) <= MOST_PRODUCTS:
            yield determinant(square)
