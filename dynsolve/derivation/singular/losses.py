"""What is lost at singular configurations: the rank there, and the directions w with wᵀ J = 0.

    wᵀ J = 0   ⇒   wᵀ J q̇ = 0 for every q̇,   τ = Jᵀ w = 0

There is no motion along w, and a force along w needs no torque of the joints (Spong, sections
4.9 and 4.10).  Of k + 1 rows and k columns the minors that leave out one row are, with alternating
signs, a w of these columns; it is one of J where the rank is k.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, combinations

from msgspec import Struct

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.factors import parameters, trig_factors, trig_quotient
from dynsolve.algebra.linear_systems import content
from dynsolve.algebra.matrix import Matrix, determinant, minors, work
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.spaces import nullspace
from dynsolve.derivation.singular.zeros import Condition, core, follows, never_hold

Direction = tuple[Expr, ...]
"""w, a component for each row of J."""

LONGEST = 40
"""A direction with more terms is not shown."""

MOST_SEARCHED = 4
"""Of a Jacobian with more rows not every direction is looked at."""

MOST_WORK = 2_500
"""The products of terms that a direction of such a Jacobian may take."""


class Loss(Struct, frozen=True):
    """The rank where some conditions hold, and the w with wᵀ J = 0 there; none where they are long.

    Of the `directions` the last `everywhere` are those of every configuration, `impossible` in number, in the
    limit; those `here` are orthogonal to these, and so are motions that are possible in other configurations.
    If they cannot be parted, or only by sums of lengths and angles, `everywhere` is 0.

    `jacobian` is the matrix there, up to a factor that is never 0.  With `rank_holds` the rank is that
    wherever the conditions hold, and with `are_independent` those `here` are independent there; else both
    are so almost everywhere, but for the `lesser` ranks of whole parts, where a coordinate has some degrees.
    """

    rank: int
    directions: tuple[Direction, ...]
    jacobian: Matrix
    rank_holds: bool
    are_independent: bool
    impossible: int = 0
    everywhere: int = 0
    lesser: tuple[tuple[str, int, int], ...] = ()

    @property
    def here(self) -> tuple[Direction, ...]:
        """The directions that are lost there and not everywhere."""
        return self.directions[: len(self.directions) - self.everywhere]


def lost_everywhere(jacobian: Matrix, rank: int) -> tuple[Direction, ...]:
    """A basis of the w with wᵀ J = 0 in every configuration, of a Jacobian of this rank; () where it is long.

    Where the rank is less it may be one still, as its vectors are independent wherever they can be.
    """
    square = Matrix.of(jacobian.ring, (row[:rank] for row in jacobian.rows[:rank]))
    is_long = work(square) > MOST_WORK
    return () if rank == len(jacobian.rows) or is_long else nullspace(jacobian.T).T.rows


def loss(
    jacobian: Matrix,
    core_of_it: tuple[int, Matrix],
    conditions: Sequence[Condition],
    greatest: int,
    everywhere: Sequence[Direction] = (),
    nonzero: frozenset[Expr] = frozenset(),
) -> Loss:
    """What a Jacobian of greatest rank `greatest` loses where conditions hold, beside what is lost anyhow.

    `nonzero` are polynomials in parameters that are taken not to be 0.
    """
    there, left, rank = _rank(core_of_it, conditions, greatest - 1)
    holds = not left or _has_rank_everywhere(there, left, conditions, nonzero)
    held = _held(jacobian, conditions)

    def are_independent(directions: Sequence[Direction]) -> bool:
        size = len(directions)
        return not size or _has_rank_everywhere(
            Matrix.of(jacobian.ring, directions), size, conditions, nonzero
        )

    limit = _limit(everywhere, conditions)
    found = _readable(_directions(_beside(held, limit), rank + len(limit), conditions)) if limit else ()
    if not found:
        limit = ()
        found = _short(_directions(held, rank, conditions))
    if not (independent := are_independent(found)):
        across = _readable(_orthogonal(held, rank, limit, conditions))
        if across and are_independent(across):
            found, independent = across, True
    return Loss(
        rank,
        (*found, *limit),
        held,
        rank_holds=holds,
        are_independent=independent,
        impossible=len(jacobian.rows) - greatest,
        everywhere=len(limit),
        lesser=() if holds else tuple(_lesser(core_of_it, conditions, rank)),
    )


def _rank(
    core_of_it: tuple[int, Matrix], conditions: Sequence[Condition], most: int
) -> tuple[Matrix, int, int]:
    """What is left of a matrix where conditions hold, the rank of that and that of all, at `most` so much."""
    pivots, rest = core_of_it
    more, there = core(_held(rest, conditions))
    pivots += more
    sizes = range(min(most - pivots, *there.shape), 0, -1)
    left = next((k for k in sizes if _has_rank(there, k, conditions)), 0)
    return there, left, pivots + left


def _lesser(
    core_of_it: tuple[int, Matrix], conditions: Sequence[Condition], rank: int
) -> Iterator[tuple[str, int, int]]:
    """At which of the two angles with sin q = 0, or cos q = 0, the rank is less: (q, degrees, that rank)."""
    for condition in conditions:
        ring = condition.expr.ring
        others = [one for one in conditions if one is not condition]
        for pair in ring.pairs:
            ends = ((pair.sine, pair.cosine, {1: 0, -1: 180}), (pair.cosine, pair.sine, {1: 90, -1: -90}))
            for known, other, degrees in ends:
                for sign in degrees if condition.expr == ring.generator(known) else ():
                    at = Condition(ring.generator(other) - ring.one * sign)
                    _, _, found = _rank(core_of_it, [*others, at], rank)
                    if found < rank:
                        (name,) = names_of(pair.angle)
                        yield name, degrees[sign], found


def _short(directions: Iterable[Direction]) -> tuple[Direction, ...]:
    """The directions, if none is long."""
    found = tuple(directions)
    return found if all(sum(map(len, direction)) <= LONGEST for direction in found) else ()


def _readable(directions: Iterable[Direction]) -> tuple[Direction, ...]:
    """The same of orthogonal ones, if none adds lengths to angles."""
    found = _short(directions)
    return found if all(map(_has_one_unit, chain(*found))) else ()


def _has_one_unit(value: Expr) -> bool:
    """Whether the terms of a component have the same unit: a length each parameter, and what slides."""
    ring = value.ring
    slides = {ring.symbol_indices[name, 0] for name, kind in ring.coordinates if kind == "prismatic"}
    lengths = slides | set(parameters(value))
    return len({sum(term[i] for i in lengths) for term in value.poly.monoms()}) <= 1


def _limit(everywhere: Sequence[Direction], conditions: Sequence[Condition]) -> tuple[Direction, ...]:
    """What the directions of every configuration span where conditions hold; () where they are dependent."""
    there = [_reduced(one, conditions) for one in everywhere]
    if not there or any(all(value.is_zero for value in one) for one in there):
        return ()
    kept = _short(_without_shared(one, conditions) for one in there)
    return kept if kept and _has_rank(Matrix.of(kept[0][0].ring, kept), len(kept), conditions) else ()


def _beside(matrix: Matrix, vectors: Sequence[Direction]) -> Matrix:
    """A matrix with vectors as further columns: what is orthogonal to all is so to these, too."""
    return Matrix.of(matrix.ring, (*matrix.T.rows, *vectors)).T


def _orthogonal(
    matrix: Matrix, rank: int, others: Sequence[Direction], conditions: Sequence[Condition]
) -> Iterator[Direction]:
    """All w with wᵀ J = 0 that are orthogonal to others, each orthogonal to those before it."""
    before = list(others)
    while rank + len(before) < len(matrix.rows):
        known = _beside(matrix, before)
        one = next(_directions(known, rank + len(before), conditions), None)
        if one is None:
            return
        before.append(one)
        yield one


def _held(matrix: Matrix, conditions: Sequence[Condition]) -> Matrix:
    """A matrix where the conditions hold, up to a factor."""
    flat, columns = _reduced(matrix.entries, conditions), matrix.shape[1]
    return Matrix.of(matrix.ring, (flat[i : i + columns] for i in range(0, len(flat), columns or 1)))


def _has_rank(matrix: Matrix, k: int, conditions: Sequence[Condition]) -> bool:
    known = [condition.expr for condition in conditions]
    return any(not follows(minor, known) for minor in minors(matrix, k))


def _has_rank_everywhere(
    matrix: Matrix, k: int, conditions: Sequence[Condition], nonzero: frozenset[Expr]
) -> bool:
    """Whether some minor of size k is not 0, wherever the conditions hold, whatever the parameters are."""
    values = [*(condition.expr for condition in conditions), *minors(matrix, k)]
    return never_hold(values, nonzero)


def _directions(matrix: Matrix, rank: int, conditions: Sequence[Condition]) -> Iterator[Direction]:
    """Directions that together are all that is lost: one for each row beyond the rank."""
    size = len(matrix.rows)
    for base in combinations(range(size), rank):
        found = [_direction(matrix, base, i, conditions) for i in range(size) if i not in base]
        if all(found):
            yield from (direction for direction in found if direction is not None)
            return


def _direction(
    matrix: Matrix, base: Sequence[int], row: int, conditions: Sequence[Condition]
) -> Direction | None:
    """The shortest w in which the rows of a base and one more stand, that one with a factor that is not 0.

    Of a matrix with many rows it is the one that is found with the least work.
    """
    rows = sorted((*base, row))
    choices = [_Minors(matrix, rows, columns) for columns in combinations(range(matrix.shape[1]), len(base))]
    is_large = len(matrix.rows) > MOST_SEARCHED
    if is_large:
        choices = sorted((m for m in choices if m.work <= MOST_WORK), key=lambda minors: minors.work)
    known = [condition.expr for condition in conditions]
    found: list[Direction] = []
    for choice in choices:
        values = dict(zip(rows, _reduced(choice.cofactors(), conditions), strict=True))
        if not follows(values[row], known):
            zero = matrix.ring.zero
            direction = tuple(values.get(i, zero) for i in range(len(matrix.rows)))
            direction = _without_shared(direction, conditions)
            if all(follows(matrix.ring.dot(direction, column), known) for column in matrix.T.rows):
                found.append(direction)
                if is_large:
                    break
    return min(found, key=lambda direction: sum(map(len, direction)), default=None)


class _Minors(Struct, frozen=True):
    """The minors of k + 1 rows and k columns that leave out one row each."""

    matrix: Matrix
    rows: Sequence[int]
    columns: Sequence[int]

    def _without(self, left_out: int) -> Matrix:
        kept = (i for i in self.rows if i != left_out)
        return Matrix.of(self.matrix.ring, ([self.matrix[i, j] for j in self.columns] for i in kept))

    @property
    def work(self) -> int:
        """The products of terms that they may come to."""
        return sum(work(self._without(row)) for row in self.rows)

    def cofactors(self) -> list[Expr]:
        """The minors with alternating signs, by the row that is left out."""
        minors = [determinant(self._without(row)) for row in self.rows]
        return [minor if k % 2 == 0 else -minor for k, minor in enumerate(minors)]


def _reduced(values: Sequence[Expr], conditions: Sequence[Condition]) -> tuple[Expr, ...]:
    """Expressions where the conditions hold, up to a factor that they share."""
    for condition in conditions:
        values = condition.reduced_together(values)
    return tuple(values)


def _without_shared(direction: Direction, conditions: Sequence[Condition]) -> Direction:
    """w without the factors that all of its components have, and with few minus signs."""
    values = [value for value in direction if not value.is_zero]
    for factor, times in trig_factors(min(values, key=len)):
        for _ in range(times):
            left = [_divided(value, factor, conditions) for value in direction]
            if any(value is None for value in left):
                break
            direction = tuple(value for value in left if value is not None)
    factors = [factor for value in direction for factor in value.poly.coeffs()]
    sign = -1 if 2 * sum(factor < 0 for factor in factors) > len(factors) else 1
    return tuple(value * (sign / content(direction)) for value in direction)


def _divided(value: Expr, factor: Expr, conditions: Sequence[Condition]) -> Expr | None:
    """value / factor where conditions hold, also times a cosine that is 1 or -1; None where not seen."""
    if (found := trig_quotient(value, factor)) is not None:
        return found
    for one in conditions:
        for unit in one.units:
            if (found := trig_quotient(one.reduced(value * unit), factor)) is not None:
                return one.reduced(found * unit)
    return None
