"""Under which conditions rates and spaces hold: the rank of the Jacobian, and what may not be 0."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import chain, combinations
from math import prod

from msgspec import Struct

from dynsolve.algebra.factors import is_never_zero, trig_factors, trig_quotient
from dynsolve.algebra.linear_systems import rank_parts
from dynsolve.algebra.matrix import AtState, Matrix, determinant, minors, work
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.algebra.spaces import dependent_where
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.existence import coordinates_in
from dynsolve.derivation.search_ring import search_ring
from dynsolve.derivation.singular.sets import Special, TooLong, common_zeros, existence
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.writing import is_small, listed
from dynsolve.notation.tree import ONE, ZERO, Node, Relation, Words
from dynsolve.questions.rates.derive import MOST_PRODUCTS, squared
from dynsolve.questions.set_forms import SetForms, may_vanish

MOST_TERMS = 200
"""Minors with more terms together are not taken apart."""


class Holding(Struct, frozen=True):
    """What is so where something holds: nothing of what is so in every configuration.

    The `rank` is 0 where it is always the same; it is what it is where one of `is_full` holds, if that can be
    told.
    The vectors of a space are independent there where `apart` is not 0; words, where that is too long.
    """

    rank: int = 0
    is_full: tuple[Relation, ...] = ()
    apart: Node | None = None

    @property
    def prose(self) -> Prose:
        """All this holds where the rank of J is 2 and s₂ ≠ 0."""
        conditions: list[Prose | Node | str] = []
        if self.is_full and (len(self.is_full) == 1 or self.apart is None):
            conditions.append(listed(self.is_full, "or"))
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
        return Holding(rank, (is_full,) if is_small(is_full) else ())
    is_fixed = any(map(is_never_zero, chain(_sizes(J, rank), _sizes(J.T, rank))))
    one_of = () if is_fixed else _one_of(forms, found)
    return Holding() if is_fixed or one_of is None else Holding(rank, one_of)


def _one_of(forms: SetForms, values: Sequence[Expr]) -> tuple[Relation, ...] | None:
    """What is not 0, one or the other, where not all values are, if few tell it; None if it is always so."""
    if sum(map(len, values)) > MOST_TERMS:
        return ()
    there, special = (
        Transfer(forms.robot.ring, search_ring(forms.robot.ring, (), {})),
        Special(ParameterSigns()),
    )
    with suppress(TooLong):
        cases = [one for one in common_zeros([*map(there, values)], special) if existence(one) is not None]
        if not cases and special.is_empty:
            return None
        if len(cases) == 1 and special.is_empty:
            names = there.target.names
            case = sorted(cases[0], key=lambda one: [*map(names.index, coordinates_in(one.expr))])
            found = tuple(Relation((forms.condition(one), ZERO), ("≠",)) for one in case)
            return found if is_small(*found) else ()
    return ()


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
