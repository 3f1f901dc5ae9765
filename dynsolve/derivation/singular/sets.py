"""The configurations at which some polynomials are all 0, as alternatives of conditions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from itertools import combinations, product
from math import comb

from msgspec import Struct, field

from dynsolve.algebra.factors import at_edge, is_positive, squares, trig_factors, trig_quotient
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix, Place, minors, parts, placed_minors, work
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.existence import conditions, without_ends
from dynsolve.derivation.singular.losses import Loss, loss, lost_everywhere
from dynsolve.derivation.singular.zeros import Condition, can_hold, core, exceptions, follows, obstacles

Alternative = tuple[Condition, ...]
"""Conditions that hold together."""

MOST_CASE_TERMS = 5000
"""So many terms the cases may have together; where they have more nothing is said."""

MOST_TERMS = 1000
"""A Jacobian with more terms is not looked at."""

MOST_CONDITION_TERMS = 80
"""An alternative with more terms could not be read, nor held to be there."""

MOST_WORK = 3000
"""The products of terms that the minors of a Jacobian may come to; of more those of its core are taken."""

MOST_CORE_WORK = 30_000
"""Nor is a core whose minors may come to more."""


MOST_TURNS = 4
"""With more angles at half turns these are not told apart."""

MOST_SPECIAL_TERMS = 8
"""Of special parameters with more terms it is only said that there may be some."""


class TooLong(Exception):
    """There are more cases than are looked at."""


class Special(Struct, dict=True):
    """Polynomials in parameters that are divided out, or multiplied by: where one is 0 nothing is said.

    `factors` are the irreducible ones that may be 0, by `signs`; `is_open` where there may be others.
    `never` has what is not 0 where conditions hold, so that these, which one might choose, are no case.
    """

    signs: ParameterSigns
    factors: dict[Expr, None] = field(default_factory=dict)
    is_open: bool = False
    never: dict[tuple[Alternative, Expr], None] = field(default_factory=dict)

    @property
    def is_empty(self) -> bool:
        """Whether what is said holds for all parameters."""
        return not self.factors and not self.is_open

    def add(self, value: Expr) -> None:
        """What must not be 0."""
        self.factors |= dict.fromkeys(self.signs.open_factors(value))

    def join(self, other: Special) -> None:
        """What another one has, too."""
        self.factors |= other.factors
        self.is_open |= other.is_open

    def add_one_of(self, values: Sequence[Expr]) -> None:
        """Values of which one must not be 0: that with the fewest terms in factors that may be."""
        found = [[*self.signs.open_factors(value)] for value in values]
        if not found:
            self.is_open = True
            return
        for factor in min(found, key=lambda factors: sum(map(len, factors))):
            self.add(factor)


class SingularSet(Struct, frozen=True):
    """Where a matrix of greatest rank `rank` has less: at any of the `alternatives`.

    `minors` are the expressions that vanish there, all in one ring: those of the Jacobian, or, if its rows or
    columns are dependent which are not 0, of its `core`, whose rank is less by `pivots`; `places` are their
    rows and columns.  `losses` are the rank and what is lost at each alternative, `exist` what the
    parameters must satisfy for it to be there.  Where one of the `special` polynomials in parameters is 0
    there may be others, and with `may_be_others` for further special parameters.
    """

    rank: int
    minors: tuple[Expr, ...]
    alternatives: tuple[Alternative, ...]
    losses: tuple[Loss, ...] = ()
    exist: tuple[tuple[Bound, ...], ...] = ()
    pivots: int = 0
    core: Matrix | None = None
    special: tuple[Expr, ...] = ()
    may_be_others: bool = False
    places: tuple[Place, ...] = ()


def singular_set(jacobian: Matrix) -> SingularSet | None:
    """Where a Jacobian loses rank; `jacobian` is in a ring of one angle a coordinate.

    Parameters count as positive: no alternative is a condition on them.  None where the
    Jacobian, its minors or the cases are too long.
    """
    if sum(map(len, jacobian.entries)) > MOST_TERMS:
        return None
    pivots, rest = core(jacobian)
    rank = _rank(rest)
    if rank is None:
        return None
    moving = [sum(any(not e.is_zero for e in line) for line in of.rows) for of in (jacobian, jacobian.T)]
    is_full = pivots + rank == min(moving)
    if is_full and minors_work(jacobian, pivots + rank) <= MOST_WORK:
        shown, placed = None, tuple(placed_minors(jacobian, pivots + rank))
    else:
        shown, placed = rest, tuple(placed_minors(rest, rank)) if rank else ()
    found = tuple(value for _, value in placed)
    special = Special(ParameterSigns())
    try:
        alternatives = common_zeros(found, special) if found else ()
    except TooLong:
        return None
    exist = {one: bounds for one in alternatives if (bounds := existence(one)) is not None}
    everywhere = lost_everywhere(jacobian, pivots + rank) if exist else ()
    nonzero = frozenset(special.factors)
    losses = tuple(loss(jacobian, (pivots, rest), one, pivots + rank, everywhere, nonzero) for one in exist)
    told = tuple(factor for factor in special.factors if len(factor) <= MOST_SPECIAL_TERMS)
    return SingularSet(
        pivots + rank,
        found,
        tuple(exist),
        losses,
        tuple(without_ends(bounds, told, special.signs) for bounds in exist.values()),
        0 if shown is None else pivots,
        shown,
        told,
        special.is_open or len(told) < len(special.factors),
        tuple(place for place, _ in placed),
    )


def _rank(matrix: Matrix) -> int | None:
    """The greatest rank; None where its minors are too long."""
    for size in range(min(matrix.shape), 0, -1):
        if minors_work(matrix, size) > MOST_CORE_WORK:
            return None
        if any(True for _ in minors(matrix, size)):
            return size
    return 0


def existence(alternative: Alternative) -> tuple[Bound, ...] | None:
    """What the parameters must satisfy for an alternative to be there; None where it never is."""
    return conditions([condition.expr for condition in alternative], ParameterSigns())


def common_zeros(
    values: Sequence[Expr], special: Special | None = None, *, keeps_products: bool = False
) -> tuple[Alternative, ...]:
    """Where expressions are all 0: alternatives of as few conditions as say it, none within another.

    Where the parameters are `special` it may be elsewhere.  With `keeps_products` more is taken apart, and
    some of the alternatives may be empty.  Raises TooLong.
    """
    return zeros_of_any([values], special, keeps_products=keeps_products)


def zeros_of_any(
    sets: Iterable[Sequence[Expr]], special: Special | None = None, *, keeps_products: bool = False
) -> tuple[Alternative, ...]:
    """The same where the expressions of any of several sets are all 0."""
    cases = _Cases(special, keeps_products)
    every = (one for values in sets for one in cases.of(tuple(values), ()))
    turned = (turned for one in every for turned in _at_quarter_turns(one))
    found = list(dict.fromkeys(map(cases.without_repeated, turned)))
    if any(sum(len(condition.expr) for condition in one) > MOST_CONDITION_TERMS for one in found):
        raise TooLong
    found = cases.widest(found)
    merged = _merged(found)
    return tuple(found if merged == found else cases.widest(merged))


def lies_in(known: Sequence[Expr], values: Iterable[Expr], special: Special | None = None) -> bool:
    """Whether values are 0 wherever those that are `known` to be 0 are: but for `special` parameters."""
    cases = _Cases(special)
    return all(cases.follows(value, known) for value in values)


class _Cases(Struct, dict=True):
    """The choices of a factor of each expression, and the terms that were looked at."""

    special: Special | None = None
    keeps_products: bool = False
    terms: int = 0

    def of(self, values: tuple[Expr, ...], held: Alternative) -> Iterator[Alternative]:
        """The choices with which all values are 0, where some conditions hold already."""
        self.terms += 1 + sum(map(len, values))
        if self.terms > MOST_CASE_TERMS:
            raise TooLong
        known = [condition.expr for condition in held]
        left = [value for value in dict.fromkeys(values) if not self.follows(value, known)]
        if not left:
            yield from self._settled(held)
            return
        choices = [[factor for factor, _ in trig_factors(value) if _may_vanish(factor)] for value in left]
        chosen = min(choices, key=_effort)
        if not chosen and self.special is not None:
            self.special.never[held, left[choices.index(chosen)]] = None
        self._divided(left[choices.index(chosen)])
        shared = {factor for factor in chosen if all(factor in others for others in choices)}
        alone = [_without(value, shared) for value in left]
        for factor in chosen:
            condition, parts = Condition(factor), squares(factor) or at_edge(factor)
            kept = left if factor in shared else alone
            if len(parts) > 1:
                yield from self.of((*parts, *kept), held)
            elif not held or self._can_hold([*known, factor]):
                rest = tuple(self._reduced(value, condition) for value in kept)
                yield from self.of(rest, tuple(dict.fromkeys((*held, condition))))

    def _settled(self, held: Alternative) -> Iterator[Alternative]:
        """Conditions of which none makes another shorter, or gives it a value of a coordinate."""
        for known in sorted(held, key=lambda one: (not one.fixes_coordinate, one.fixes_length)):
            others = {one: self._reduced(one.expr, known) for one in held if one is not known}
            moved = {one: value for one, value in others.items() if value != one.expr}
            if moved:
                yield from self.of(tuple(moved.values()), tuple(one for one in held if one not in moved))
                return
        yield held

    def without_repeated(self, alternative: Alternative) -> Alternative:
        """An alternative without the conditions that follow from its others, the longest left out first."""
        kept = list(alternative)
        for condition in sorted(alternative, key=lambda one: -len(one.expr)):
            others = [other.expr for other in kept if other is not condition]
            if self.follows(condition.expr, others):
                kept.remove(condition)
        return tuple(kept)

    def widest(self, alternatives: Sequence[Alternative]) -> list[Alternative]:
        """Those that are not within another."""
        found = list(alternatives)
        for one in alternatives:
            if any(other is not one and self.implies(one, other) for other in found):
                found.remove(one)
        return found

    def implies(self, one: Alternative, other: Alternative) -> bool:
        """Whether `other` holds wherever `one` does."""
        known = [condition.expr for condition in one]
        return all(condition in one or self._follows_from_some(condition.expr, known) for condition in other)

    def _follows_from_some(self, value: Expr, known: Sequence[Expr]) -> bool:
        """Whether a value is found to be 0 where all others are, or some two, which are sooner looked at."""
        pairs = combinations(known, 2) if len(known) > 2 else ()
        return self.follows(value, known) or any(self.follows(value, pair) for pair in pairs)

    # -- what holds for general parameters alone ---------------------------------------------------

    def _divided(self, value: Expr) -> None:
        """The factors of parameters that are left out of an expression."""
        if self.special is None:
            return
        for factor, _ in trig_factors(value):
            if not factor.ring.depends_on_coordinates(factor):
                self.special.add(factor)

    def _reduced(self, value: Expr, condition: Condition) -> Expr:
        if self.special is not None:
            self.special.add(condition.multiplier([value]))
        found = condition.reduced(value)
        if self.keeps_products and not (condition.fixes_coordinate or found.is_zero):
            longest = max((len(factor) for factor, _ in trig_factors(value)), default=0)
            return found if len(found) < longest else value
        return found

    def follows(self, value: Expr, others: Sequence[Expr]) -> bool:
        found = follows(value, others)
        if found and self.special is not None:
            self.special.add_one_of(exceptions(value, others))
        return found

    def _can_hold(self, values: Sequence[Expr]) -> bool:
        found = can_hold(values)
        if not found and self.special is not None:
            self.special.add_one_of(obstacles(values))
        return found


def minors_work(matrix: Matrix, size: int) -> int:
    """The products of terms that all minors of a size may come to; of very many minors their number."""
    rows, columns = matrix.shape
    count = comb(rows, size) * comb(columns, size)
    return count if count > MOST_CORE_WORK else sum(map(work, parts(matrix, size)))


def _without(value: Expr, shared: Set[Expr]) -> Expr:
    """What is left of a value where factors are divided out as often as they stand in it."""
    for factor, times in trig_factors(value) if shared else ():
        for _ in range(times if factor in shared else 0):
            left = trig_quotient(value, factor)
            value = value if left is None else left
    return value


def _effort(factors: Sequence[Expr]) -> tuple[int, int]:
    """The fewest cases first; of these what fixes a coordinate, which can be put into the others."""
    return len(factors), sum(not Condition(factor).fixes_coordinate for factor in factors)


def _may_vanish(factor: Expr) -> bool:
    """Whether a factor is 0 at some configuration, as far as its form shows."""
    return factor.ring.depends_on_coordinates(factor) and not is_positive(factor) and not is_positive(-factor)


def _at_quarter_turns(one: Alternative) -> list[Alternative]:
    """sin q = 0 as q = 0 and q = π, of every angle, where that decides about all other conditions."""
    turns = {
        condition: (known, other)
        for condition in one
        for pair in condition.expr.ring.pairs
        for known, other in ((pair.sine, pair.cosine), (pair.cosine, pair.sine))
        if condition.expr == condition.expr.ring.generator(known)
    }
    rest = [condition.expr for condition in one if condition not in turns]
    found = []
    for signs in product((1, -1), repeat=len(turns)) if rest and len(turns) <= MOST_TURNS else ():
        numbers = {known: 0 for known, _ in turns.values()}
        numbers |= {other: sign for (_, other), sign in zip(turns.values(), signs, strict=True)}
        left = [with_numbers(value, numbers) for value in rest]
        if not all(value.is_zero or is_positive(value) or is_positive(-value) for value in left):
            return [one]
        if all(value.is_zero for value in left):
            ends = ((rest[0].ring, other, numbers[other]) for _, other in turns.values())
            found.append(tuple(Condition(ring.generator(k) - ring.one * sign) for ring, k, sign in ends))
    return found or [one]


def with_numbers(value: Expr, numbers: Mapping[int, int]) -> Expr:
    """A value with numbers for some generators, by their places."""
    return value.ring.put(value, {i: value.ring.constant(number).poly for i, number in numbers.items()})


def _merged(alternatives: Sequence[Alternative]) -> list[Alternative]:
    """q = 0 or q = π together as sin q = 0, and the same for the quarter turns."""
    found = list(alternatives)
    for one, other in combinations(alternatives, 2):
        joined = _joined(one, other)
        if joined is not None:
            found[found.index(one)] = joined
            found.remove(other)
            return _merged(found)
    return found


def _joined(one: Alternative, other: Alternative) -> Alternative | None:
    mine, theirs = set(one) - set(other), set(other) - set(one)
    if len(mine) != 1 or len(theirs) != 1:
        return None
    a, b = mine.pop().expr, theirs.pop().expr
    ring = a.ring
    for pair in ring.pairs:
        sine, cosine = ring.generator(pair.sine), ring.generator(pair.cosine)
        for whole, part in ((sine, cosine), (cosine, sine)):
            if {a, b} == {part - ring.one, part + ring.one}:
                return (*(c for c in one if c.expr != a), Condition(whole))
    return None
