"""Whether equations can hold together, and what follows from them, by Buchberger's algorithm.

Each parameter is a number of a fixed seed here: what is found holds for general values of them.
Equations without a solution, not even in complex numbers, have a Gröbner basis with a number in it.
An expression f is 0 wherever others are, if these and t f = 1 have no solution (Rabinowitsch).

An equation f(q) = 0 that is a factor of something, and what expressions become where it holds.

What decides about the rank of a matrix: what is left of it when everything simple is taken away.

Rows may be turned among each other by an angle, and multiples of rows and columns added to others: the
rank stays what it is, everywhere.  A Jacobian so gets the axes of the frame in which it is shortest.
Where an entry is a number or a length, its row and its column can be cleared and left out: the rank of
the matrix is 1 more than that of the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import permutations
from math import lcm
from random import Random
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec
from msgspec import Struct

from dynsolve.algebra.angles import Angle, names_of
from dynsolve.algebra.factors import is_positive, trig_quotient
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.derivation.elimination import ParameterSigns, turn_of
from dynsolve.derivation.existence import DEGREES, quarter_turn
from dynsolve.errors import AlgebraError

LIMITS = (40, 150, 400)
"""Of a basis: its polynomials, the terms of one, and the binary digits of its coefficients."""

SEED = 7

Terms = dict[tuple[int, ...], fmpq]


def can_hold(values: Sequence[Expr]) -> bool:
    """Whether expressions may be 0 together; what goes over the limits counts so."""
    return not values or not _has_number([_specialized(value) for value in values], values[0].ring)


def follows(value: Expr, others: Sequence[Expr]) -> bool:
    """Whether an expression is found to be 0 wherever the others are."""
    if value.is_zero or not others:
        return value.is_zero
    inverted = _inverted(_specialized(value), value.ring)
    return _has_number([*map(_specialized, others), inverted], value.ring)


def never_together(values: Sequence[Expr], nonzero: Expr) -> bool:
    """Whether expressions are found to be 0 together for no parameters with which another one is not 0."""
    polys = [_exact_terms(value.ring, value.poly) for value in values]
    other = _inverted(_exact_terms(nonzero.ring, nonzero.poly), nonzero.ring)
    _, basis = _basis([*polys, other], nonzero.ring, _exact_terms, Ordering.degrevlex, ())
    return any(poly.is_constant() and poly for poly in basis)


def _inverted(terms: Terms, ring: Ring) -> Terms:
    """t f - 1, with t behind the generators."""
    inverted = {(*key, 1): number for key, number in terms.items()}
    inverted[(0,) * (len(ring.generators) + 1)] = fmpq(-1)
    return inverted


def obstacles(values: Sequence[Expr]) -> list[Expr]:
    """Polynomials in parameters alone that are found to be 0 wherever expressions are 0 together.

    Where one of them is not 0 the expressions cannot hold together, whatever numbers the parameters are.
    """
    return _still([_exact_terms(value.ring, value.poly) for value in values], values[0].ring)


def never_hold(values: Sequence[Expr], nonzero: frozenset[Expr] = frozenset()) -> bool:
    """Whether expressions are found to be 0 together for no positive parameters, `nonzero` factors not 0."""
    return not can_hold(values) and any(
        nonzero.issuperset(ParameterSigns().open_factors(one)) for one in obstacles(values)
    )


def exceptions(value: Expr, others: Sequence[Expr]) -> list[Expr]:
    """Polynomials in parameters alone: where one is not 0, `value` is 0 wherever the others are."""
    ring = value.ring
    if value.is_zero:
        return [ring.one]
    polys = [_exact_terms(ring, other.poly) for other in others]
    return _still([*polys, _inverted(_exact_terms(ring, value.poly), ring)], ring)


def _still(polys: Sequence[Terms], ring: Ring) -> list[Expr]:
    """What a basis has that holds no coordinate, in one of two orders."""
    still = [g.index for g in ring.generators if not ring.depends_on_coordinates(ring.generator(g.index))]
    found: list[Expr] = []
    for ordering in (Ordering.degrevlex, Ordering.lex):
        used, basis = _basis(polys, ring, _exact_terms, ordering, still)
        for poly in basis:
            terms = [(dict(zip(used, key, strict=False)), number) for key, number in poly.to_dict().items()]
            if all(i in still for powers, _ in terms for i, e in powers.items() if e):
                plain = {tuple(powers.get(g.index, 0) for g in ring.generators): n for powers, n in terms}
                found.append(Expr(ring, ring.reduce(ring.ctx.from_dict(plain))))
        found = [value for value in found if not value.is_zero]
        if found:
            break
    return found


def _has_number(polys: Sequence[Terms], ring: Ring) -> bool:
    """Whether the Gröbner basis of polynomials and of the ring's relations is 1."""
    _, basis = _basis(polys, ring, _with_numbers, Ordering.degrevlex, ())
    return any(poly.is_constant() and poly for poly in basis)


def _basis(
    polys: Sequence[Terms],
    ring: Ring,
    terms_of: Callable[[Ring, fmpq_mpoly], Terms],
    ordering: Ordering,
    last: Sequence[int],
) -> tuple[list[int], Any]:
    """The generators that occur, those of `last` behind the others, and a basis in them."""
    places = {i for terms in polys for key in terms for i, e in enumerate(key) if e}
    for poly in ring.relations(places):
        terms = terms_of(ring, poly)
        places |= {i for key in terms for i, e in enumerate(key) if e}
        polys = [*polys, terms]
    used = sorted(places, key=lambda i: (i in last, i))
    ctx = fmpz_mpoly_ctx.get(("z", max(len(used), 1)), ordering)
    basis = fmpz_mpoly_vec([_whole(ctx, used, terms) for terms in polys if terms], ctx)
    return used, basis.buchberger_naive(limits=LIMITS)[0]


def _whole(ctx: Any, used: Sequence[int], terms: Terms) -> Any:
    scale = lcm(*(int(number.q) for number in terms.values()))
    return ctx.from_dict({
        tuple(key[i] if i < len(key) else 0 for i in used) or (0,): int((number * scale).p)
        for key, number in terms.items()
    })  # fmt: skip


def _specialized(value: Expr) -> Terms:
    return _with_numbers(value.ring, value.poly)


def _exact_terms(_: Ring, poly: fmpq_mpoly) -> Terms:
    """A polynomial as it is."""
    return {tuple(int(e) for e in exponents): number for exponents, number in poly.to_dict().items()}


def _with_numbers(ring: Ring, poly: fmpq_mpoly) -> Terms:
    """A polynomial with numbers for parameters, and for sines and cosines of constant angles."""
    numbers, terms = _numbers(ring), Terms()
    for exponents, coefficient in poly.to_dict().items():
        number, key = coefficient, [int(e) for e in exponents]
        for i, value in numbers.items():
            if key[i]:
                number, key[i] = number * value ** key[i], 0
        terms[tuple(key)] = terms.get(tuple(key), 0) + number
    return {key: number for key, number in terms.items() if number}


@lru_cache(maxsize=4)
def _numbers(ring: Ring) -> Mapping[int, fmpq]:
    """The numbers, by the generators that they stand for."""
    return dict(_drawn(ring))


def _drawn(ring: Ring) -> Iterator[tuple[int, fmpq]]:
    draw = Random(SEED)  # noqa: S311 - the same numbers every time are wanted
    for g in ring.generators:
        if g.kind == "symbol" and g.name in ring.parameters:
            yield g.index, fmpq(draw.randint(2, 99), draw.randint(2, 99))
    for pair in ring.pairs:
        if not ring.depends_on_coordinates(ring.generator(pair.sine)):
            t = fmpq(draw.randint(2, 49), 50)
            yield pair.sine, 2 * t / (1 + t * t)
            yield pair.cosine, (1 - t * t) / (1 + t * t)


# An equation f(q) = 0 that is a factor of something, and what expressions become where it holds


class Condition(Struct, frozen=True, dict=True):
    """f = 0, with f irreducible in a ring of one angle a coordinate."""

    expr: Expr

    def reduced(self, other: Expr) -> Expr:
        """Another expression where this holds, up to a factor that is never 0.

        An angle's sine, cosine or both are put in, also where the angle itself is 0, as springs have it, or
        is given by others, as gears have it, or as sin(q₁ + q₂/2) = 0 has it if both its turns come to the
        same; a length that stands linearly is replaced;
        of any other condition it is only seen whether the expression has it as a factor.
        """
        (value,) = self.reduced_together((other,))
        return value

    def reduced_together(self, others: Sequence[Expr]) -> tuple[Expr, ...]:
        """Several expressions where this holds, up to a positive factor that all of them share."""
        for pair, sine, cosine in self._turn:
            return tuple(_at_angle(other, pair, sine, cosine) for other in others)
        for images in self._given:
            return tuple(other.ring.put(other, images) for other in others)
        for index, factor, rest in self._length:
            highest = max(
                (int(other.poly.degrees()[index]) for other in others if not other.is_zero), default=0
            )
            even = highest + highest % 2
            return tuple(with_quotient(other, index, factor, rest, even) for other in others)
        for turns in self._sums:
            there = {tuple(other.ring.put(other, images) for other in others) for images in turns}
            if len(there) == 1:
                return there.pop()
        return tuple(other.ring.zero if self._divides(other) else self._remainder(other) for other in others)

    def multiplier(self, others: Sequence[Expr]) -> Expr:
        """What `reduced_together` multiplies by: the factor of a length that stands in one of the others.

        A multiple of this is 0 whatever the factor is.
        """
        for index, factor, _ in self._length:
            left = (other for other in others if not (other.is_zero or self._divides(other)))
            if any(other.poly.degrees()[index] > 0 for other in left):
                return factor
        return self.expr.ring.one

    def _remainder(self, other: Expr) -> Expr:
        """Another expression less a multiple of this one, where that is shorter."""
        rest = Expr(other.ring, other.ring.reduce(divmod(other.poly, self.expr.poly)[1]))
        shortest = min((*self._less_terms(other), rest), key=len)
        return shortest if len(shortest) < len(other) else other

    def _less_terms(self, other: Expr) -> Iterator[Expr]:
        """Another expression less multiples of this one, in each of which a term is gone."""
        ring = other.ring
        mine = [
            ([(i, int(e)) for i, e in enumerate(own) if e], own, divisor)
            for own, divisor in self.expr.poly.to_dict().items()
        ]
        for key, factor in other.poly.to_dict().items():
            for places, own, divisor in mine:
                if all(key[i] >= e for i, e in places):
                    powers = tuple(int(a) - int(b) for a, b in zip(key, own, strict=True))
                    yield other - Expr(ring, ring.ctx.from_dict({powers: factor / divisor})) * self.expr

    def _divides(self, other: Expr) -> bool:
        return trig_quotient(other, self.expr) is not None

    @property
    def fixes_coordinate(self) -> bool:
        """Whether an angle has few values, or a length one, where this holds."""
        return bool(self._turn or self._given or self._length)

    @property
    def units(self) -> tuple[Expr, ...]:
        """The sine or the cosine that is 1 or -1 where this holds."""
        ends = ((pair.sine, sine, pair.cosine, cosine) for pair, sine, cosine in self._turn)
        found = (end for s, sine, c, cosine in ends for end, at in ((s, sine), (c, cosine)) if at is None)
        return tuple(map(self.expr.ring.generator, found))

    @property
    def fixes_length(self) -> bool:
        """Whether it is a length that has few values."""
        return bool(self._length)

    @property
    def gives_angle(self) -> bool:
        """Whether it is q = 0 of an angle, or gives it by others, as q₁ - q₂ = π does."""
        return bool(self._given)

    @property
    def keeps_values(self) -> bool:
        """Whether expressions that are reduced keep their values, and get no factor."""
        return not self._length or self._length[0][1] == self.expr.ring.one

    @property
    def linear(self) -> tuple[Expr, Expr, Expr] | None:
        """(m, x, n) where the condition is m x + n = 0, with x a length, or the one sine or cosine in it."""
        ring, turn = self.expr.ring, turn_of(self.expr)
        for index, factor, rest in self._length:
            return factor, ring.generator(index), rest
        if turn is None or not turn.is_one_sided:
            return None
        x = ring.generator(turn.pair.cosine if turn.sine.is_zero else turn.pair.sine)
        return turn.cosine + turn.sine, x, turn.rest

    @cached_property
    def _turn(self) -> list[tuple[Pair, int | None, int | None]]:
        """(pair, sine, cosine) where the condition fixes an angle up to a sign; None is ±1."""
        ring = self.expr.ring
        for pair in ring.pairs:
            s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
            known = ((s, 0, None), (c, None, 0), (c - ring.one, 0, 1), (c + ring.one, 0, -1),
                     (s - ring.one, 1, 0), (s + ring.one, -1, 0))  # fmt: skip
            for form, sine, cosine in known:
                if self.expr == form or self.expr == -form:
                    return [(pair, sine, cosine)]
        return []

    @cached_property
    def _given(self) -> list[dict[int, fmpq_mpoly]]:
        """What generators are where the condition gives an angle by others: of the last one of these."""
        ring = self.expr.ring
        relation = _linear_in_angles(self.expr)
        for name in reversed([name for name, kind in ring.coordinates if kind == "revolute"]):
            rate = dict(relation.terms).get(((name, 1),)) if relation else None
            if relation and rate:
                rest = Angle.of(name) - relation * (Fraction(1) / rate)
                with suppress(AlgebraError):  # the ring has not every part of an angle
                    return [_angle_put(ring, self.expr, name, rest)]
        return []

    @cached_property
    def _sums(self) -> list[list[dict[int, fmpq_mpoly]]]:
        """What the sine and the cosine of an angle are at each turn of a sum that the condition fixes.

        One for each angle that the others give, the last one first.
        """
        ring, found = self.expr.ring, quarter_turn(self.expr)
        if found is None:
            return []
        angle, turns = found
        ends = [Angle((), Fraction(DEGREES[turn])) for turn in turns]
        given = (
            (pair, [(end - angle + pair.angle * sign) * sign for end in ends])
            for pair in reversed(ring.pairs)
            for sign in (1, -1)
            if not {*names_of(angle - pair.angle * sign)} & {*names_of(pair.angle)}
        )
        return [
            [{pair.sine: ring.sin(one).poly, pair.cosine: ring.cos(one).poly} for one in ways]
            for pair, ways in given
        ]

    @cached_property
    def _length(self) -> list[tuple[int, Expr, Expr]]:
        """(generator d, m, n) where the condition is m d + n = 0 with m free of coordinates."""
        ring = self.expr.ring
        for name, kind in ring.coordinates:
            if kind != "prismatic":
                continue
            index = ring.symbol_indices[(name, 0)]
            factor = ring.coefficient(self.expr, name)
            if not factor.is_zero and not ring.depends_on_coordinates(factor):
                return [(index, factor, self.expr - factor * ring.generator(index))]
        return []


def _at_angle(expr: Expr, pair: Pair, sine: int | None, cosine: int | None) -> Expr:
    """An expression where sin and cos of an angle have these values; where one is 0 the other is ±1."""
    ring = expr.ring
    terms: dict[tuple[int, ...], Any] = {}
    for exponents, factor in expr.poly.to_dict().items():
        powers = list(exponents)
        for place, value in ((pair.sine, sine), (pair.cosine, cosine)):
            power = int(powers[place])
            if value is None:
                powers[place] = power % 2
            else:
                factor = factor * value**power
                powers[place] = 0
        if factor:
            key = tuple(powers)
            terms[key] = terms.get(key, 0) + factor
    return Expr(ring, ring.ctx.from_dict({key: value for key, value in terms.items() if value}))


def _linear_in_angles(expr: Expr) -> Angle | None:
    """An expression that is an angle of revolute coordinates and parts of π; None of any other."""
    ring, found = expr.ring, Angle.zero()
    angles = {name for name, kind in ring.coordinates if kind == "revolute"}
    for exponents, number in expr.poly.to_dict().items():
        used = [(ring.generators[i], int(e)) for i, e in enumerate(exponents) if e]
        if len(used) != 1 or used[0][1] != 1 or used[0][0].kind != "symbol" or used[0][0].dots:
            return None
        name, rate = used[0][0].name, Fraction(int(number.p), int(number.q))
        if name != "pi" and name not in angles:
            return None
        found += Angle((), rate * 180) if name == "pi" else Angle.of(name, rate)
    return found


def _angle_put(ring: Ring, relation: Expr, name: str, rest: Angle) -> dict[int, fmpq_mpoly]:
    """The generators of an angle as it is by others; `relation` is 0 there."""
    own = ring.coefficient(relation, name)
    found = {ring.symbol_indices[name, 0]: (ring.symbol(name) - relation / own.number).poly}
    for pair in ring.pairs:
        rate = dict(pair.angle.terms).get(((name, 1),))
        if rate:
            turned = pair.angle + (rest - Angle.of(name)) * rate
            found |= {pair.sine: ring.sin(turned).poly, pair.cosine: ring.cos(turned).poly}
    return found


def with_quotient(expr: Expr, index: int, factor: Expr, rest: Expr, highest: int) -> Expr:
    """Σ aₖ dᵏ with d = -n/m, times m to the highest power t: Σ aₖ (-n)ᵏ mᵗ⁻ᵏ."""
    ring = expr.ring
    by_power: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, value in expr.poly.to_dict().items():
        key = (*exponents[:index], 0, *exponents[index + 1 :])
        by_power.setdefault(int(exponents[index]), {})[key] = value
    total = ring.zero
    for power, terms in by_power.items():
        total += Expr(ring, ring.ctx.from_dict(terms)) * (-rest) ** power * factor ** (highest - power)
    return total


# What decides about the rank of a matrix

Rows = tuple[tuple[Expr, ...], ...]


def core(matrix: Matrix) -> tuple[int, Matrix]:
    """(k, rest): everywhere the rank of the matrix is k more than that of the rest."""
    rows, pivots = _without_zeros(matrix.rows), 0
    while rows:
        if (place := _pivot(rows)) is not None:
            rows, pivots = _without_zeros(_cleared(rows, *place)), pivots + 1
        elif (shorter := _shorter(matrix, rows)) is not None:
            rows = shorter
        else:
            break
    return pivots, Matrix(matrix.ring, rows)


def _without_zeros(rows: Rows) -> Rows:
    """Without the rows and columns that are 0."""
    kept = [row for row in rows if not all(entry.is_zero for entry in row)]
    return _turned_over(column for column in zip(*kept, strict=True) if not all(e.is_zero for e in column))


def _turned_over(lines: Iterator[tuple[Expr, ...]] | Rows) -> Rows:
    return tuple(zip(*lines, strict=True))


def _pivot(rows: Rows) -> tuple[int, int] | None:
    """The place of an entry that is never 0: a number first, and where least is to be cleared."""
    places = [
        (not entry.is_number, _size((row,)) * _size((tuple(other[j] for other in rows),)), i, j)
        for i, row in enumerate(rows)
        for j, entry in enumerate(row)
        if _is_never_zero(entry)
    ]
    return min(places)[2:] if places else None


def _is_never_zero(entry: Expr) -> bool:
    ring = entry.ring
    return len(entry) == 1 and not ring.depends_on_coordinates(entry) and (
        is_positive(entry) or is_positive(-entry)
    )  # fmt: skip


def _cleared(rows: Rows, i: int, j: int) -> Rows:
    """The rows without row i and column j, from which multiples of row i were taken so that column j is 0."""
    pivot = rows[i][j]

    def entry(row: tuple[Expr, ...], k: int) -> Expr:
        if row[j].is_zero:
            return row[k]
        across = row[j] * rows[i][k]
        return row[k] - across / pivot.number if pivot.is_number else row[k] * pivot - across

    columns = [k for k in range(len(rows[i])) if k != j]
    return tuple(tuple(entry(row, k) for k in columns) for row in (*rows[:i], *rows[i + 1 :]))


def _shorter(matrix: Matrix, rows: Rows) -> Rows | None:
    """The shortest that two rows turned, or a row or column added to another, make of the matrix, or None."""
    columns = _turned_over(rows)
    found = [(_size(new) - _size(rows), k, new) for k, new in enumerate(_with_turns(matrix, rows))]
    for lines, back in ((rows, tuple), (columns, _turned_over)):
        found += [
            (_size(new) - _size(rows), len(found) + k, back(new)) for k, new in enumerate(_with_sums(lines))
        ]
    gain, _, best = min(found, key=lambda one: one[:2], default=(0, 0, rows))
    return best if gain < 0 else None


def _with_turns(matrix: Matrix, rows: Rows) -> Iterator[Rows]:
    ring = matrix.ring
    for pair in ring.pairs:
        s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
        for i, j in permutations(range(len(rows)), 2):
            mine, other = rows[i], rows[j]
            turned = tuple(c * a + s * b for a, b in zip(mine, other, strict=True))
            across = tuple(c * b - s * a for a, b in zip(mine, other, strict=True))
            yield _replaced(rows, {i: turned, j: across})


def _with_sums(lines: Rows) -> Iterator[Rows]:
    """Less a multiple of another line, by which a term of an entry is gone."""
    for i, j in permutations(range(len(lines)), 2):
        ring = lines[i][0].ring
        pairs = [both for both in zip(lines[i], lines[j], strict=True) if not any(e.is_zero for e in both)]
        for times in dict.fromkeys(Expr(ring, divmod(a.poly, b.poly)[0]) for a, b in pairs):
            if not times.is_zero:
                yield _replaced(
                    lines, {i: tuple(a - times * b for a, b in zip(lines[i], lines[j], strict=True))}
                )


def _replaced(lines: Rows, new: dict[int, tuple[Expr, ...]]) -> Rows:
    return tuple(new.get(k, line) for k, line in enumerate(lines))


def _size(lines: Rows) -> int:
    return sum(len(entry) for line in lines for entry in line)
