"""Equilibria: the configurations at which gravity and springs move nothing, g(q) = 0.

The rows are combined first, as linear equations in what moves, with factors of parameters: what
stands in one of them alone is left.  Then each is taken apart into its factors, and every choice
of one factor of each is a case (as for singular configurations).  A case in which the cosine of an
angle would have to be more than 1 for all parameters is none.

What is divided out or multiplied by on the way may be 0 for special parameters, as m₁ l₁ - m₂ l₂
is: these are told, with the remainders of the forces on division by it, which are the forces there.

Where rates are held constant, g is the sum of forces in that motion (`linearization`).

With constraints g = A_cᵀ λ and h = 0 (`multipliers`).

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.2 (1994).

Slotine, Li, Applied Nonlinear Control, section 3.1 (1991).

How stable equilibria are, by the second derivatives of the potential energy.

An equilibrium is stable where the potential energy has a strict minimum, the matrix of its second
derivatives being positive definite (Lagrange and Dirichlet): where all its leading minors are
positive (Sylvester).  It is unstable where the matrix has a negative direction, which it has where
any principal minor is negative.  Parameters count as positive; a leading minor whose sign they leave
open is a condition for stability: where it is negative the equilibrium is unstable, and only where
it is 0 the second derivatives do not decide.

Where rates are held constant the energy is that of steady motion, and forces across the motion, which
do no work, may hold what would fall: then nothing is called unstable.

Slotine, Li, Applied Nonlinear Control, section 3.4 (1991).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import StrEnum
from fractions import Fraction
from functools import partial
from itertools import combinations, product
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound, independent
from dynsolve.algebra.linear_systems import part, rank_parts
from dynsolve.algebra.matrix import Matrix, determinant, work
from dynsolve.algebra.parameter_span import Generators, expression, primitive
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.elimination import ParameterSigns, Turn, turn_of
from dynsolve.derivation.existence import DEGREES, conditions, is_seen, without_ends
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.search_ring import search_ring
from dynsolve.derivation.singular.sets import Alternative, Special, TooLong, common_zeros, with_numbers
from dynsolve.derivation.singular.zeros import Condition
from dynsolve.questions.equilibria.multipliers import Along, Multipliers, Settled, remainder
from dynsolve.questions.parameters.derive import generators
from dynsolve.robot.model import Robot

# How stable equilibria are, by the second derivatives of the potential energy

MOST_POINTS = 16
"""With more points in a case their stability is not told one by one."""

MOST_TURNING = 6
"""With more sines and cosines the least value of an expression is not looked for."""

MOST_PRODUCTS = 50_000
"""Second derivatives whose determinant may come to more products of terms are not looked at."""

Values = tuple[tuple[Pair, int, int], ...]
"""(angle, sine, cosine): quarter turns."""


def turned(values: Values) -> list[tuple[Angle, Fraction]]:
    """The angles that are turned, each with how far in degrees; q/2 by 90° is q by 180°."""
    found = []
    for pair, sine, cosine in values:
        angle, degrees = pair.angle, Fraction(DEGREES[sine, cosine])
        if degrees > 180:
            degrees -= 360
        rates = {rate for _, rate in angle.terms}
        if len(rates) == 1 and (count := 1 / rates.pop()).denominator == 1:
            angle, degrees = angle * count, degrees * count
        found.append((angle, degrees))
    return found


Here = Callable[[Matrix], Matrix]
"""What a matrix is where something is known."""


class Stability(StrEnum):
    """What second derivatives say of an equilibrium."""

    STABLE = "stable"
    UNSTABLE = "unstable"
    UNDECIDED = "undecided"


class Point(Struct, frozen=True):
    """Quarter turns of angles in a case, and how stable the arm is there.

    `neutral` are the coordinates, from 0, along which nothing changes; where the arm `drifts`, nothing does
    in any motion along the equilibria, in which the others follow these.  Where the stability is
    undecided, and there are `conditions` on the parameters, it is stable where these hold; where one of
    them fails the energy has no minimum, so that, if `falls`, the equilibrium is unstable.  Where its two
    sides are equal nothing is said, nor where one of `nonzero` is 0.  Coordinates stand in conditions
    where their values are not known; `is_open` says that these are too long to be told.  All this is so
    where the case is there and none of its bounds, `inside`, is an equality.  `along` is what constraints
    leave of the second derivatives.
    """

    values: Values
    stability: Stability
    neutral: tuple[int, ...] = ()
    conditions: tuple[Bound, ...] = ()
    nonzero: tuple[Expr, ...] = ()
    falls: bool = False
    is_open: bool = False
    drifts: bool = False
    inside: tuple[Bound, ...] = ()
    along: Along | None = None

    @property
    def is_told(self) -> bool:
        """Whether something is known."""
        return bool(self.conditions or self.nonzero) or self.stability is not Stability.UNDECIDED


class Curvature(Struct, frozen=True):
    """The second derivatives of the energy, n×n, and the signs of what stands in them.

    `may_be_held` says that forces which do no work act, too; with multipliers the energy is looked at along
    what the constraints leave free.
    """

    second: Matrix
    signs: ParameterSigns
    may_be_held: bool
    held: Multipliers | None = None

    def points(self, alternative: Alternative, exists: Sequence[Bound]) -> Iterator[Point]:
        """The quarter turns that a case allows, each with its stability where the case `exists`."""
        inside = [Bound(bound.value) for bound in exists]
        known = {point.values: point for point in self._possible(alternative, inside)}
        for point in self._possible(alternative, exists):
            told = known.get(point.values, point)
            if told == point or not told.is_told:
                yield point
            elif told.stability is Stability.STABLE:  # where a bound is an equality nothing is known
                yield replace(point, conditions=tuple(inside), nonzero=(), falls=False, is_open=False)
            else:
                yield replace(told, inside=tuple(inside))

    def _possible(self, alternative: Alternative, exists: Sequence[Bound]) -> Iterator[Point]:
        """Points without factors that are 0 nowhere in the case; stable where nothing else is asked."""
        for point in self._points(alternative, exists):
            nonzero = tuple(factor for factor in point.nonzero if self._may_vanish(factor, alternative))
            is_stable = point.nonzero and not (nonzero or point.conditions)
            stability = Stability.STABLE if is_stable else point.stability
            yield replace(point, nonzero=nonzero, stability=stability)

    def _may_vanish(self, factor: Expr, alternative: Alternative) -> bool:
        values = [condition.expr for condition in alternative]
        return not factor.ring.depends_on_coordinates(factor) or _may_be_zero([*values, factor], self.signs)

    def _points(self, alternative: Alternative, exists: Sequence[Bound]) -> Iterator[Point]:
        if 2 ** len(alternative) > MOST_POINTS:
            return
        turns = [found for one in alternative if (found := quarter_turns(one))]
        others = [one for one in alternative if not quarter_turns(one)]
        known = [turn for one in others if (turn := turn_of(one.expr)) is not None and turn.is_one_sided]
        nonzero = [f for turn in known for f in self.signs.open_factors(turn.cosine + turn.sine)]
        signs = self.signs.beside(*exists, nonzero=nonzero)
        ring = self.second.ring
        free = [
            k
            for k in range(len(ring.names))
            if all(ring.diff(condition.expr, k).is_zero for condition in alternative)
        ]
        for values in product(*turns):
            left = _put(Matrix.column(ring, [other.expr for other in others]), values).entries
            if conditions(left, signs) is None:
                continue
            here = partial(_there, values=values, zeros=left)
            if self.held is not None:
                along = self.held.along(self.second, here)
                point = Point(values, Stability.UNDECIDED)
                yield point if along is None else self._held_point(values, along, signs, here)
                continue
            at = here(self.second)
            drifting = self._drifting(values, at, signs, len(alternative))
            yield drifting or self._point(values, at, signs, free, here)

    def _held_point(self, values: Values, along: Along, signs: ParameterSigns, here: Here) -> Point:
        """The stability along what constraints leave free, where their rows are independent."""
        apart = signs.beside(nonzero=signs.open_factors(along.divisor))
        point = replace(self._point(values, along.without_fractions, apart, (), here), along=along)
        dependent = tuple(signs.open_factors(along.size))
        if not dependent or not point.is_told or point.stability is Stability.UNSTABLE:
            return point
        nonzero = tuple(dict.fromkeys((*point.nonzero, *dependent)))
        return replace(point, stability=Stability.UNDECIDED, nonzero=nonzero)

    def _drifting(self, values: Values, second: Matrix, signs: ParameterSigns, held: int) -> Point | None:
        """The stability where equilibria, of which `held` conditions are asked, are all that is flat.

        None where the coordinates that are not flat are all others, or a sign is not seen.
        """
        n = len(second.rows)
        if self.may_be_held or work(second) > MOST_PRODUCTS:
            return None
        rows = rank_parts(second).rows
        others = [k for k in range(n) if k not in rows]
        flat = all(second[k, j].is_zero for k in others for j in range(n))
        if flat or len(rows) != held:
            return None
        leading = (determinant(part(second, rows[:k], rows[:k])) for k in range(1, held + 1))
        is_stable = all(map(signs.is_positive, leading))
        return Point(values, Stability.STABLE, tuple(others), drifts=True) if is_stable else None

    def _point(
        self, values: Values, second: Matrix, signs: ParameterSigns, free: Sequence[int], here: Here
    ) -> Point:
        """The stability at quarter turns where `free` coordinates may have any value.

        `here` puts in what is known there, up to a positive factor.
        """

        def minor(chosen: tuple[int, ...]) -> Expr:
            return here(Matrix.of(second.ring, [[determinant(part(second, chosen, chosen))]]))[0, 0]

        neutral = tuple(k for k in free if all(entry.is_zero for entry in second.rows[k]))
        rest = tuple(k for k in range(len(second.rows)) if k not in neutral)
        if not rest or work(part(second, rest, rest)) > MOST_PRODUCTS:
            return Point(values, Stability.UNDECIDED, neutral, is_open=bool(rest))
        if not self.may_be_held and _falls(minor, rest, signs):
            return Point(values, Stability.UNSTABLE, neutral)
        leading = [minor(rest[:k]) for k in range(1, len(rest) + 1)]
        nonzero = tuple(dict.fromkeys(factor for one in leading for factor in signs.even_factors(one)))
        signs = signs.beside(nonzero=nonzero)
        left: list[Expr] = []
        for one in leading:
            sign = signs.beside(*(Bound(before) for before in left if not before.is_number)).open_part(one)
            if not (sign.is_number and sign.number > 0) and not _is_positive_throughout(sign, signs):
                left.append(sign)
        if not left and not nonzero:
            return Point(values, Stability.STABLE, neutral)
        moves = any(sign.ring.depends_on_coordinates(sign) for sign in (*left, *nonzero))
        if any(sign.is_number for sign in left):
            return Point(values, Stability.UNDECIDED, neutral, is_open=not _never_falls(minor, rest, signs))
        if moves and max(map(len, (*left, *nonzero))) > MOST_SHOWN_TERMS:
            return Point(values, Stability.UNDECIDED, neutral, is_open=True)
        conditions = tuple(map(Bound, dict.fromkeys(left)))
        if not moves:
            conditions = independent([Bound(sign) for sign in _least(left, signs)], signs.assumed)
        falls = bool(conditions) and not self.may_be_held
        inside = self.signs.beside(*conditions)
        apart = tuple(factor for factor in nonzero if any(inside.open_factors(factor)))
        return Point(values, Stability.UNDECIDED, neutral, conditions, apart, falls)


Minor = Callable[[tuple[int, ...]], Expr]
"""The principal minor of some rows."""


def _falls(minor: Minor, rest: Sequence[int], signs: ParameterSigns) -> bool:
    """Whether the energy surely falls in some direction: a principal minor is negative."""
    return any(signs.is_positive(-minor(chosen)) for chosen in _principal(rest))


def _never_falls(minor: Minor, rest: Sequence[int], signs: ParameterSigns) -> bool:
    """Whether it surely falls in none, to second order: no principal minor is negative anywhere."""
    minors = map(minor, _principal(rest))
    return all(one.is_zero or signs.is_positive(signs.open_part(one)) for one in minors)


def _principal(rest: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """The rows of the principal minors."""
    return (chosen for size in range(1, len(rest) + 1) for chosen in combinations(rest, size))


def _is_positive_throughout(value: Expr, signs: ParameterSigns) -> bool:
    """Whether k - m g l cos q > 0 for all q: what is linear in each sine and cosine is least at ±1."""
    ring, degrees = value.ring, value.poly.degrees()
    turning = [i for pair in ring.pairs for i in (pair.sine, pair.cosine) if degrees[i] > 0]
    if not turning or len(turning) > MOST_TURNING or any(degrees[index] > 1 for index in turning):
        return False
    return all(
        signs.is_positive(with_numbers(value, dict(zip(turning, ends, strict=True))))
        for ends in product((1, -1), repeat=len(turning))
    )


def _least(values: Sequence[Expr], signs: ParameterSigns) -> list[Expr]:
    """The values without those that are another one and something positive."""
    return [
        value
        for value in values
        if not any(signs.is_positive(value - other) for other in values if other != value)
    ]


def _there(matrix: Matrix, values: Values, zeros: Sequence[Expr]) -> Matrix:
    """A matrix at quarter turns where further expressions are 0, up to a positive factor."""
    matrix = _put(matrix, values)
    for zero in zeros:
        if zero.is_zero:
            continue
        turn = turn_of(zero)
        if turn is not None and turn.is_one_sided:
            matrix = _at_turn(matrix, turn)
        else:
            size = matrix.shape[1]
            flat = Condition(zero).reduced_together(matrix.entries)
            matrix = Matrix.of(matrix.ring, (flat[i : i + size] for i in range(0, len(flat), size)))
    return matrix


def _at_turn(second: Matrix, turn: Turn) -> Matrix:
    """The matrix where A x + C = 0 for the sine or the cosine x of an angle, times A to an even power."""
    ring, pair = second.ring, turn.pair
    known, other = (pair.cosine, pair.sine) if turn.sine.is_zero else (pair.sine, pair.cosine)
    factor, rest = turn.cosine + turn.sine, turn.rest
    degrees = (int(e[known]) + int(e[other]) for entry in second.entries for e in entry.poly.monoms())
    most = max(degrees, default=0)
    highest, y = most + most % 2, ring.generator(other)

    def put(expr: Expr) -> Expr:
        total = ring.zero
        for exponents, number in expr.poly.to_dict().items():
            i, j = int(exponents[known]), int(exponents[other])
            plain = tuple(0 if k in (known, other) else e for k, e in enumerate(exponents))
            squares = (factor * factor - rest * rest) ** (j // 2)  # A² y² = A² - C²
            power = highest - i - 2 * (j // 2)
            own = Expr(ring, ring.ctx.from_dict({plain: number}))
            total += own * (-rest) ** i * squares * factor**power * y ** (j % 2)
        return total

    return second.map(put)


def quarter_turns(condition: Condition) -> list[tuple[Pair, int, int]]:
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
    numbers = {pair.sine: sine for pair, sine, _ in values} | {
        pair.cosine: cosine for pair, _, cosine in values
    }
    return matrix.map(lambda entry: with_numbers(entry, numbers))


MOST_TERMS = 200
"""Forces with more terms are not taken apart."""

MOST_SPECIAL = 4
"""So many factors that may be 0 are told."""

MOST_SHOWN_TERMS = 12
"""Factors with more terms are not told."""

TOO_LONG = "gravity and springs are too long to be taken apart into factors"


class SpecialCase(Struct, frozen=True):
    """A factor of parameters alone, and the expressions that must be 0 in an equilibrium where it is 0.

    `exist` is what the parameters must satisfy for that; without forces it is not known what is one.  Where
    only the rank of A_c is another, the equilibria are those for all parameters without the sets that are
    `excluded`, if these are known.
    """

    factor: Expr
    forces: tuple[Expr, ...] | None
    exist: tuple[Bound, ...] = ()
    is_of_rank: bool = False
    excluded: tuple[Alternative, ...] = ()

    @property
    def is_known(self) -> bool:
        """Whether all that is excluded for other parameters is excluded here, too."""
        return self.is_of_rank and bool(self.excluded)


class Equilibria(Struct, frozen=True):
    """Where all of `rows` are 0: at any of the alternatives, with the points of each.

    `exist` is what the parameters must satisfy for each to be there.  All this is so where none of the
    `special` is; where there `may_be_others`, that are not told, for general parameters.  With constraints
    each is without the sets that are `excluded`, and further sets on which there are no multipliers are left
    out if not `is_whole`; where the rows of A_c `may_be_dependent` nothing is known.  `never` has conditions
    that are no case, and what is not 0 where they hold.  Of what `is_seen` the inequalities are all.
    """

    rows: tuple[Expr, ...]
    alternatives: tuple[Alternative, ...]
    points: tuple[tuple[Point, ...], ...]
    exist: tuple[tuple[Bound, ...], ...]
    special: tuple[SpecialCase, ...] = ()
    may_be_others: bool = False
    excluded: tuple[tuple[Alternative, ...], ...] = ()
    is_whole: bool = True
    may_be_dependent: bool = False
    never: tuple[tuple[Alternative, Expr], ...] = ()
    is_seen: tuple[bool, ...] = ()


def _kept_turning(robot: Robot) -> set[int]:
    """The coordinates, from 0, whose rates motors keep in a steady motion."""
    steady = dict(robot.questions.model.steady)
    return {k for k, q in enumerate(robot.coordinates) if q.name in steady and k not in robot.actions.passive}


def wanted_rows(robot: Robot) -> list[int]:
    """The coordinates, from 0, whose forces must be 0: those that no motor holds, or keeps at its rate."""
    passive, model = robot.actions.passive, robot.questions.model
    steady = dict(model.steady)
    return [
        k
        for k, q in enumerate(robot.coordinates)
        if k in passive or not (model.inputs_given or q.name in steady)
    ]


def multipliers(robot: Robot, forces: Matrix, A: Matrix, h: Matrix) -> Multipliers:
    """What constraints may hold, in the columns that belong to the coordinates that no motor holds."""
    return Multipliers.of(robot, wanted_rows(robot), forces, A, h)


def constrained_equilibria(robot: Robot, forces: Matrix, A: Matrix, h: Matrix) -> Equilibria | Skipped:
    """The configurations in which multipliers hold the forces, and h is 0."""
    return equilibria(robot, forces, multipliers(robot, forces, A, h))


def equilibria(
    robot: Robot, forces: Matrix, held: Multipliers | None = None, may_be_held: bool = False
) -> Equilibria | Skipped:
    """The configurations where the forces (n×1) are 0 in every row that no motor holds.

    The forces are derivatives of an energy: g(q), or those of steady motion; `may_be_held` is that of
    `Curvature`.  Where constraints act, they are `held` by these multipliers.
    """
    wanted = [forces[k, 0] for k in wanted_rows(robot)] if held is None else [*held.zeros(held.rank)]
    if sum(map(len, wanted)) > MOST_TERMS:
        return Skipped(TOO_LONG)
    ring = search_ring(robot.ring, (), {})
    there = Transfer(robot.ring, ring)
    signs = assumed_signs(robot, there)
    special = Special(signs)
    left = tuple(combined(robot, wanted, lambda factor: special.add(there(factor))))
    try:
        rows = [there(row) for row in left]
        constrained = held.moved(there) if held else None
        alternatives = constrained.found(rows, special) if constrained else common_zeros(rows, special)
    except TooLong:
        return Skipped(TOO_LONG)
    settled: Settled | None = Settled(alternatives, tuple(() for _ in alternatives), True)
    of_rank = Special(signs)
    if constrained:
        try:
            settled = constrained.settled(alternatives, constrained.rank, of_rank)
        except TooLong:
            settled = None
    if settled is None or settled.alternatives != alternatives:
        special.join(of_rank)
        of_rank = Special(signs)
        alternatives = settled.alternatives if settled else alternatives
    excluded = dict(settled.pairs) if settled else {}
    found = {
        one: exist
        for one in alternatives
        if (exist := conditions([condition.expr for condition in one], signs)) is not None
    }
    points: tuple[tuple[Point, ...], ...] = tuple(() for _ in found)
    if constrained is None or constrained.is_of_energy(robot.n):
        kept = _kept_turning(robot)
        slopes = (
            [ring.zero if {i, k} & kept else there(robot.ring.diff(g, k)) for k in range(robot.n)]
            for i, g in enumerate(forces.entries)
        )
        second = Matrix.of(ring, slopes)
        for condition in (condition for one in found for condition in one):
            special.add(condition.multiplier(second.entries))
        nonzero = (*special.factors, *of_rank.factors)
        curvature = Curvature(second, signs.beside(nonzero=nonzero), may_be_held, constrained)
        points = tuple(tuple(curvature.points(one, exist)) for one, exist in found.items())
    short = [factor for factor in special.factors if len(factor) <= MOST_SHOWN_TERMS][:MOST_SPECIAL]
    cases = [_special_case(factor, [*map(there, wanted)], constrained, signs) for factor in short]
    if settled and constrained:
        moved = (factor for factor in of_rank.factors if factor not in special.factors)
        cases += filter(None, (_of_rank(factor, constrained, settled, signs) for factor in moved))
    return Equilibria(
        left,
        tuple(found),
        points,
        tuple(without_ends(exist, short, signs) for exist in found.values()),
        tuple(cases),
        special.is_open or of_rank.is_open or len(short) < len(special.factors),
        tuple(excluded.get(one, ()) for one in found),
        settled is None or settled.is_whole,
        settled is None,
        (*special.never, *(_never(one, signs) for one in alternatives if one not in found)),
        tuple(_is_seen(one, signs) for one in found),
    )


def _is_seen(alternative: Alternative, signs: ParameterSigns) -> bool:
    """Whether `conditions` are all that parameters need; a length that is given by others is there."""
    if not any(map(_has_parameter, alternative)):
        return True
    open_values = [one.expr for one in alternative if not one.fixes_length and not one.is_at_zero]
    return is_seen(open_values, signs)


def _has_parameter(condition: Condition) -> bool:
    ring, degrees = condition.expr.ring, condition.expr.poly.degrees()
    return any(
        degrees[g.index] > 0 for g in ring.generators if g.kind == "symbol" and g.name in ring.parameters
    )


def _never(alternative: Alternative, signs: ParameterSigns) -> tuple[Alternative, Expr]:
    """What is not 0 in an alternative where its other conditions hold."""
    value = next((one for one in alternative if conditions([one.expr], signs) is None), alternative[-1])
    return tuple(one for one in alternative if one is not value), value.expr


def assumed_signs(robot: Robot, there: Transfer) -> ParameterSigns:
    """What the problem assumes of the parameters, in another ring."""
    assumed = robot.questions.model.assumed
    return ParameterSigns(tuple(Bound(there(bound.value), bound.is_strict) for bound in assumed))


def _special_case(
    factor: Expr, zeros: Sequence[Expr], held: Multipliers | None, signs: ParameterSigns
) -> SpecialCase:
    """What is known where a factor is 0; nothing where with this the rows of A_c may be dependent."""
    if held and not held.where_zero(factor).holds_everywhere(held.rank, signs):
        return SpecialCase(factor, None)
    left = _modulo(factor, zeros)
    exist = conditions(left, signs)
    return SpecialCase(factor, (factor.ring.one,)) if exist is None else SpecialCase(factor, left, exist)


def _of_rank(factor: Expr, held: Multipliers, settled: Settled, signs: ParameterSigns) -> SpecialCase | None:
    """What has no multipliers where a factor is 0, beside what never has; None where that is nothing."""
    special = Special(signs)
    conditions = (tuple(one.expr for one in case) for case in settled.alternatives)
    case = [tuple(Condition(remainder(value, factor)) for value in values) for values in conditions]
    try:
        found = held.where_zero(factor).settled(case, held.rank, special)
    except TooLong:
        return SpecialCase(factor, None, is_of_rank=True)
    is_less = any(
        not {*known}.issubset(without)
        for without, known in zip(found.excluded, settled.excluded, strict=True)
    )
    if found.alternatives != tuple(case) or is_less or not special.is_empty:
        return SpecialCase(factor, None, is_of_rank=True)
    more = [
        one
        for without, known in zip(found.excluded, settled.excluded, strict=True)
        for one in without
        if one not in known
    ]
    return SpecialCase(factor, None, (), True, tuple(dict.fromkeys(more))) if more else None


def _modulo(factor: Expr, forces: Iterable[Expr]) -> tuple[Expr, ...]:
    """What is left of forces where a factor is 0, without those that are 0, too."""
    rests = (remainder(force, factor) for force in forces)
    return tuple(dict.fromkeys(rest for rest in rests if not rest.is_zero))


def _may_be_zero(values: Sequence[Expr], signs: ParameterSigns) -> bool:
    """Whether expressions are 0 together somewhere, as far as is found, for some parameters."""
    exactly = Special(signs)
    try:
        sets = common_zeros(values, exactly)
    except TooLong:
        return True
    there = any(conditions([one.expr for one in case], signs) is not None for case in sets)
    return there or not exactly.is_empty


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
