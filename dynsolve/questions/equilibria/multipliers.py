"""Where constraints hold the forces: g = A_cᵀ λ, also where the rows of A_c are dependent.

g is a combination of the rows of A_c where these have some rank k, and with gᵀ no more: the minors of
order k + 1 of both together are 0, and not all those of order k of A_c.  So the sets are found rank by
rank; at each the sets of less rank are looked at apart.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set
from contextlib import suppress
from fractions import Fraction
from itertools import chain, combinations, product
from math import prod

from msgspec import Struct

from dynsolve.algebra.angles import Angle, name_alone
from dynsolve.algebra.factors import halves, is_positive
from dynsolve.algebra.fraction import RationalExpr, cancelled, multiply
from dynsolve.algebra.linear_systems import (
    FractionMatrix,
    adjugate,
    fraction_of,
    part,
    quotient,
)
from dynsolve.algebra.matrix import Matrix, determinant, minors
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.sampling import Transfer
from dynsolve.algebra.spaces import nullspace
from dynsolve.derivation.allowed import Allowed, where_allowed
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.existence import DEGREES, only_ends, quarter_turn
from dynsolve.derivation.search_ring import search_ring
from dynsolve.derivation.singular.sets import (
    Alternative,
    Special,
    TooLong,
    common_zeros,
    lies_in,
    zeros_of_any,
)
from dynsolve.derivation.singular.zeros import Condition, never_together
from dynsolve.robot.model import Robot

MOST_SETS = 8
"""So many choices of factors in half angles are looked at."""


class Unsolved(Exception):
    """Conditions are left that fix no coordinate."""


Here = Callable[[Matrix], Matrix]
"""What a matrix is at a configuration."""


class Settled(Struct, frozen=True):
    """Alternatives, and of each the sets within it at which there are no multipliers.

    `is_whole` says that nothing was taken away.
    """

    alternatives: tuple[Alternative, ...]
    excluded: tuple[tuple[Alternative, ...], ...]
    is_whole: bool = False

    @property
    def pairs(self) -> Iterator[tuple[Alternative, tuple[Alternative, ...]]]:
        """Each with what is excluded."""
        return zip(self.alternatives, self.excluded, strict=True)


class Along(Struct, frozen=True):
    """Along what constraints leave free: Z, λ, and the second derivatives between the columns of Z.

    Where `size` is 0 the rows of A_c are dependent.
    """

    free: Matrix
    multipliers: Matrix | FractionMatrix
    second: Matrix | FractionMatrix
    size: Expr

    @property
    def divisor(self) -> Expr:
        """What the second derivatives are fractions of."""
        divisors = {fraction_of(entry).denominator for entry in self.second.entries}
        return prod(divisors, start=self.free.ring.one)

    @property
    def without_fractions(self) -> Matrix:
        """The second derivatives times the square of the divisor."""
        square = RationalExpr(self.divisor * self.divisor)
        entries = (cancelled(multiply(fraction_of(entry), square)) for entry in self.second.entries)
        width = self.second.shape[1]
        flat = [entry.numerator for entry in entries]
        return Matrix.of(self.free.ring, (flat[i : i + width] for i in range(0, len(flat), width)))


def _over(matrix: Matrix, divisor: Expr, at: Here) -> Matrix | FractionMatrix:
    """A matrix over a divisor, both at a configuration."""
    ring = matrix.ring
    rows = at(Matrix.of(ring, [*matrix.rows, [divisor] * matrix.shape[1]])).rows
    return quotient(Matrix(ring, rows[:-1]), rows[-1][0])


class Multipliers(Struct, frozen=True):
    """A_c and the forces in the `columns`, from 0, that no motor holds, gᵀ as a row, and the h that are 0.

    What is `allowed` tells the rank that A_c has almost everywhere where h is 0.
    """

    A: Matrix
    g: Matrix
    h: tuple[Expr, ...]
    allowed: Allowed
    columns: tuple[int, ...]

    @staticmethod
    def of(robot: Robot, columns: Sequence[int], forces: Matrix, A: Matrix, h: Matrix) -> Multipliers:
        """Those of the columns, from 0."""
        row = Matrix.of(robot.ring, [[forces[k, 0] for k in columns]])
        own = part(A, tuple(range(A.shape[0])), tuple(columns))
        return Multipliers(own, row, h.entries, where_allowed(robot, own, h), tuple(columns))

    def moved(self, there: Transfer) -> Multipliers:
        """The same in another ring."""
        A, g = (Matrix.of(there.target, (map(there, row) for row in one.rows)) for one in (self.A, self.g))
        return Multipliers(A, g, tuple(map(there, self.h)), self.allowed, self.columns)

    def where_zero(self, factor: Expr) -> Multipliers:
        """The same for parameters of which a factor is 0."""

        def rest(value: Expr) -> Expr:
            return remainder(value, factor)

        h = tuple(map(rest, self.h))
        return Multipliers(self.A.map(rest), self.g.map(rest), h, self.allowed, self.columns)

    @property
    def rank(self) -> int:
        """That of A_c."""
        return self.allowed.rank

    def is_of_energy(self, n: int) -> bool:
        """Whether an energy decides on stability: all n coordinates are its, all constraints functions."""
        return len(self.A.rows) == len(self.h) and self.A.shape[1] == n

    def along(self, second: Matrix, at: Here, signs: ParameterSigns) -> Along | None:
        """The second derivatives of P - λᵀ h along what A_c leaves free, `at` a configuration.

        None where the rows of A_c are dependent, or nothing is free.  `second` are those of P by all
        coordinates; `at` may
        bring a factor, the same in all that it is given at once.  The λ follow from columns of A_c of which
        the determinant is never 0, by the `signs`, if there are such.
        """
        ring, (count, n) = self.A.ring, self.A.shape
        of_h = [[ring.diff(ring.diff(h, i), j) for j in self.columns] for h in self.h for i in self.columns]
        own = part(second, self.columns, self.columns)
        rows = at(Matrix.of(ring, [*self.A.rows, *self.g.rows, *own.rows, *of_h, [ring.one] * n])).rows
        A, g, of_P = (
            Matrix(ring, lines) for lines in (rows[:count], rows[count : count + 1], rows[count + 1 :])
        )
        every = {columns: part(A, tuple(range(count)), columns) for columns in combinations(range(n), count)}
        sizes = {columns: size for columns, one in every.items() if not (size := determinant(one)).is_zero}
        if self.rank < count or not sizes or count == n:
            return None
        columns = min(sizes, key=lambda one: len([*signs.open_factors(sizes[one])]))
        size = sizes[columns]
        multipliers = part(g, (0,), columns) @ adjugate(every[columns])  # λᵀ times the determinant
        total = of_P.block(0, n, 0, n).scale(size)
        for k in range(count):
            bent = of_P.block(n * (k + 1), n * (k + 2), 0, n)
            total = total - bent.scale(multipliers[0, k])
        Z = nullspace(A)
        scaled = Z.T @ total.scale(size) @ Z
        curved = _over(scaled, size * size * rows[-1][0], at)
        return Along(Z, _over(multipliers.T, size, at), curved, at(Matrix.of(ring, [[size * size]]))[0, 0])

    def branches(self, at: Here) -> Iterator[Multipliers | None]:
        """The same of each smooth set through a configuration of which h = 0 consists; None of any other.

        Of the equations of a factor in half angles one whose derivatives are not 0 there is enough.
        """
        ring = self.A.ring
        for choice in product(*map(halves, self.h)):
            zeros = [factor for one in choice for factor in at(Matrix.column(ring, one)).entries]
            if any(zero.is_number and not zero.is_zero for zero in zeros):
                continue
            slopes = [[(f, [ring.diff(f, k) for k in self.columns]) for f in one] for one in choice]
            moving = [[own for own in one if not at(Matrix.of(ring, [own[1]])).is_zero] for one in slopes]
            if all(zero.is_zero for zero in zeros) and all(moving):
                h, A = zip(*(own[0] for own in moving), strict=True)
                yield Multipliers(Matrix.of(ring, A), self.g, h, Allowed(len(h)), self.columns)
            else:
                yield None

    def zeros(self, rank: int) -> tuple[Expr, ...]:
        """What is 0 where the forces are held and A_c has this rank."""
        together = Matrix(self.A.ring, (*self.A.rows, *self.g.rows))
        return (*minors(together, rank + 1), *self.h)

    def found(self, rows: Sequence[Expr], special: Special) -> tuple[Alternative, ...]:
        """Where the rows are 0, which stand for `zeros`: solved by half angles where that leaves nothing."""
        choices = list(product(*map(halves, self.h)))
        if 1 < len(choices) <= MOST_SETS:
            by_halves = Special(special.signs)
            with suppress(TooLong, Unsolved):
                sets = [one for choice in choices for one in _solved(rows, choice, by_halves)]
                special.join(by_halves)
                return zeros_of_any(sets)
        return common_zeros(rows, special, keeps_products=True)

    def settled(self, found: Sequence[Alternative], rank: int, special: Special) -> Settled:
        """The `found` sets, on which `zeros(rank)` are 0, where there are multipliers.

        Sets on which A_c has less rank everywhere are left out, and those found that are in balance there.
        """
        whole = Settled(tuple(found), tuple(() for _ in found), True)
        if not rank or self._holds_where_dependent(rank, special):
            return whole
        dependent = tuple(minors(self.A, rank))
        full = [one for one in found if not lies_in(_values(one), dependent, special)]
        least = common_zeros((*dependent, *self.h), special)
        lost = [_within(least, _values(one), special) for one in full]
        if len(full) == len(found) and not any(lost):
            return whole
        less = _within(least, self.zeros(rank - 1), special)
        rest = self.settled(less, rank - 1, special)
        covered = [_values(one) for one, but in rest.pairs if not but]
        excluded = [
            tuple(one for one in within if not any(lies_in(_values(one), held, special) for held in covered))
            for within in lost
        ]
        open_sets = [_values(one) for one, but in zip(full, excluded, strict=True) if not but]
        new = [
            (one, but)
            for one, but in rest.pairs
            if not any(lies_in(_values(one), held, special) for held in open_sets)
        ]
        return Settled((*full, *(one for one, _ in new)), (*excluded, *(but for _, but in new)))

    def holds_where_zero(self, factor: Expr, signs: ParameterSigns) -> bool:
        """Whether, where a factor is 0, there are multipliers wherever `zeros` are, as far as is found."""
        special = Special(signs)
        with suppress(TooLong):
            holds = self.where_zero(factor)._holds_where_dependent(self.rank, special) and not special.is_open
            return holds and all(never_together((one, factor), factor.ring.one) for one in special.factors)
        return False

    def at_ends(self, factor: Expr, signs: ParameterSigns) -> tuple[Expr, ...]:
        """What is 0 in equilibrium where a factor is, and with it h at ends alone, at which A_c is 0, too.

        So it is of a tip on a wall that it just reaches; none of any other.
        """
        there = self.where_zero(factor)
        ends = tuple(chain(*(only_ends(h, signs) for h in there.h)))
        return (*ends, *there.h, *there.g.entries) if ends and lies_in(ends, there.A.entries) else ()

    def leaves_least_energy(self, signs: ParameterSigns) -> bool:
        """Whether the energy is least somewhere, if h is 0 anywhere: it is so within bounds alone."""
        ring = self.A.ring
        turning = [ring.symbol_indices[name, 0] for name, kind in ring.coordinates if kind == "revolute"]
        used = {index for value in (*self.h, *self.g.entries) for index in value.used}
        left = {ring.symbol_indices[name, 0] for name, kind in ring.coordinates if kind == "prismatic"}
        while left:
            bounded = {index for h in self.h for index in _bounded(h, left & {*h.used}, signs)}
            if not bounded:
                return False
            left -= bounded
        return self.rank == len(self.h) and used.isdisjoint(turning)

    def _holds_where_dependent(self, rank: int, special: Special) -> bool:
        """Whether forces are held wherever the rows of A_c, of this rank elsewhere, are dependent."""
        dependent, exactly = (*minors(self.A, rank), *self.h), Special(special.signs)
        holds = rank == 1 and lies_in(dependent, self.zeros(rank - 1), exactly)
        return (holds and exactly.is_empty) or not common_zeros(dependent, special)


def _bounded(h: Expr, lengths: Set[int], signs: ParameterSigns) -> Set[int]:
    """The lengths, of some generators, if h = 0 leaves them no room: x² + y² - l², or x - l cos φ."""
    ring, parts = h.ring, dict[tuple[int, ...], Expr]()
    places = sorted(lengths)
    for exponents, number in h.poly.to_dict().items():
        powers = tuple(int(exponents[k]) for k in places)
        plain = tuple(0 if k in lengths else e for k, e in enumerate(exponents))
        parts[powers] = parts.get(powers, ring.zero) + Expr(ring, ring.ctx.from_dict({plain: number}))
    most = max(map(sum, parts))
    highest = {powers: part for powers, part in parts.items() if sum(powers) == most}
    is_alone = len(places) == most == 1 or (most == 2 and all(max(powers) == 2 for powers in highest))
    has_sign = any(all(signs.is_positive(part * sign) for part in highest.values()) for sign in (1, -1))
    is_free = not any(map(ring.depends_on_coordinates, highest.values()))
    return lengths if is_alone and len(highest) == len(places) and has_sign and is_free else frozenset()


def remainder(value: Expr, factor: Expr) -> Expr:
    """What is left of a value where a factor is 0; with sin α = 0 also sin² α, as cos² α = 1."""
    condition = Condition(factor)
    if condition.fixes_coordinate:
        return condition.reduced(value)
    return Expr(value.ring, value.ring.reduce(divmod(value.poly, factor.poly)[1]))


def _values(alternative: Alternative) -> tuple[Expr, ...]:
    return tuple(condition.expr for condition in alternative)


def _within(sets: Sequence[Alternative], values: Sequence[Expr], special: Special) -> tuple[Alternative, ...]:
    """Where in the sets values are 0."""
    found = []
    for one in sets:
        left, known = values, _values(one)
        for condition in one:
            left = [condition.reduced(value) for value in left]
        exactly = Special(special.signs)
        if lies_in(known, values, exactly) and exactly.is_empty:
            found.append(known)
        elif not any(is_positive(sign * value) for value in left for sign in (1, -1)):
            found.append((*known, *values))
    return zeros_of_any(found, special)


# Equations with half angles: where one gives an angle by others, that is put in


def _solved(
    rows: Sequence[Expr], choice: Sequence[Sequence[Expr]], special: Special
) -> Iterator[tuple[Expr, ...]]:
    """Where rows and a choice of factors in half angles are 0; raises Unsolved where that is not seen."""
    zeros = (*rows, *chain(*choice))
    found = common_zeros(zeros, special)
    if not all(condition.fixes_coordinate for one in found for condition in one):
        ring = rows[0].ring
        relation = next(filter(None, map(_angle_given, choice)), None)
        if relation is None:
            raise Unsolved
        name, angle = relation
        smaller = search_ring(ring, (), {name: angle})
        there, back = Transfer(ring, smaller, {name: angle}), Transfer(smaller, ring)
        apart = Special(ParameterSigns())
        for one in common_zeros([there(zero) for zero in zeros], apart):
            yield from (_at_points(ring, turns, name, angle) for turns in product(*map(_turns, one)))
        for factor in apart.factors:
            special.add(back(factor))
        special.is_open |= apart.is_open
    else:
        yield from map(_values, found)


def _angle_given(factor: Sequence[Expr]) -> tuple[str, Angle] | None:
    """The angle that is given by others where a factor in half angles is 0: q₂ = 180° - 2q₁."""
    found = quarter_turn(sum((part * part for part in factor), start=factor[0].ring.zero))
    if found is None or len(found[1]) != 1:
        return None
    angle, ((sine, cosine),) = found
    for atom, rate in angle.terms:
        if abs(rate) == 1 and (name := name_alone(atom)):
            rest = Angle((), Fraction(DEGREES[sine, cosine])) - angle + Angle.of(name, rate)
            return name, rest * rate
    return None


def _turns(condition: Condition) -> list[tuple[str, Fraction]]:
    """The angles in degrees that a condition on one coordinate leaves; raises Unsolved of any other."""
    found = quarter_turn(condition.expr)
    if found is None or len(found[0].terms) != 1 or found[0].terms[0][1] != 1:
        raise Unsolved
    name = name_alone(found[0].terms[0][0])
    if not name:
        raise Unsolved
    return [(name, Fraction(DEGREES[turn])) for turn in found[1]]


def _at_points(
    ring: Ring, turns: Sequence[tuple[str, Fraction]], name: str, angle: Angle
) -> tuple[Expr, ...]:
    """What is 0 where angles are at quarter turns, and one more is given by these."""
    at = dict(turns)
    total = angle.degrees
    for atom, rate in angle.terms:
        if name_alone(atom) not in at:
            raise Unsolved
        total += rate * at[name_alone(atom)]
    if total % 90:
        raise Unsolved
    return tuple(_at_turn(ring, one, degrees) for one, degrees in (*at.items(), (name, total)))


def _at_turn(ring: Ring, name: str, degrees: Fraction) -> Expr:
    angle = Angle.of(name)
    kind, sign = {0: (ring.cos, 1), 90: (ring.sin, 1), 180: (ring.cos, -1), 270: (ring.sin, -1)}[
        int(degrees % 360)
    ]
    return kind(angle) - ring.one * sign
