"""How stable equilibria are, by the second derivatives of the potential energy.

An equilibrium is stable where the potential energy has a strict minimum, the matrix of its second
derivatives being positive definite (Lagrange and Dirichlet): where all its leading minors are
positive (Sylvester).  It is unstable where the matrix has a negative direction, which it has where
any principal minor is negative.  Parameters count as positive; a leading minor whose sign they leave
open is a condition for stability: where it is negative the equilibrium is unstable, and only where
it is 0 the second derivatives do not decide.

Where the energy is a function of one coordinate and one of the others, or one coordinate is all that
constraints leave free, and the second derivative is 0, the first that is not decides: the energy has a
minimum there if it is of even order and positive.

Where rates are held constant the energy is that of steady motion, and forces across the motion, which
do no work, may hold what would fall: then nothing is called unstable.

Slotine, Li, Applied Nonlinear Control, section 3.4 (1991).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import StrEnum
from fractions import Fraction
from functools import cache, partial
from itertools import combinations, permutations, product
from math import lcm
from typing import Any

from flint import fmpq_mat
from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, name_alone
from dynsolve.algebra.factors import is_positive, trig_quotient
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound, independent
from dynsolve.algebra.linear_systems import part, rank_parts
from dynsolve.algebra.matrix import Matrix, determinant, work
from dynsolve.algebra.rationals import fraction, rational
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.spaces import nullspace
from dynsolve.derivation.elimination import ParameterSigns, Turn, is_more, turn_of
from dynsolve.derivation.existence import DEGREES, Pose, conditions, rests, square_of
from dynsolve.derivation.singular.sets import Alternative, Special, TooLong, common_zeros, with_numbers
from dynsolve.derivation.singular.zeros import Condition
from dynsolve.questions.equilibria.multipliers import Along, Here, Multipliers

MOST_ADDED = 200
"""Minors with more terms are not added to others, to see whether one of two is negative."""

MOST_SHOWN_TERMS = 12
"""Factors with more terms are not told."""

MOST_POINTS = 16
"""With more points in a case their stability is not told one by one."""

MOST_TURNING = 6
"""With more sines and cosines the least value of an expression is not looked for."""

MOST_ORDER = 8
"""No derivatives of higher order are looked at,"""

MOST_DERIVED_TERMS = 200
"""nor those of expressions with more terms."""

MOST_PRODUCTS = 50_000
"""Second derivatives whose determinant may come to more products of terms are not looked at."""

Values = tuple[tuple[Pair, int, int], ...]
"""(angle, sine, cosine): quarter turns."""


def turned(values: Values) -> list[tuple[Angle, Fraction]]:
    """The angles that are turned, each with how far in degrees; q/2 by 90° is q by 180°.

    Where sums of angles fix each coordinate, these are told: q₁ = -90° and q₂ = 0.
    """
    found = []
    for pair, sine, cosine in values:
        angle, degrees = pair.angle.linear, DEGREES[sine, cosine] - pair.angle.degrees
        degrees = 180 - (180 - degrees) % 360
        rates = {rate for _, rate in angle.terms}
        if len(rates) == 1 and (count := 1 / rates.pop()).denominator == 1:
            angle, degrees = angle * count, degrees * count
        found.append((angle, degrees))
    atoms = [*dict.fromkeys(atom for angle, _ in found for atom, _ in angle.terms)]
    is_of_sums = any(len(angle.terms) > 1 for angle, _ in found)
    if not is_of_sums or len(atoms) != len(found):
        return found
    matrix = [[rational(dict(angle.terms).get(atom, 0)) for atom in atoms] for angle, _ in found]
    each = fmpq_mat(matrix).solve(fmpq_mat([[rational(degrees)] for _, degrees in found])).entries()
    return [
        (Angle(((atom, Fraction(1)),)), 180 - (180 - fraction(own)) % 360)
        for atom, own in zip(atoms, each, strict=True)
    ]


def by_coordinates(angle: Angle, names: Iterable[str]) -> tuple[Angle, Angle]:
    """What of an angle is of coordinates, and what the rest is on the other side: q₁ and a of q₁ - a."""
    fixed = Angle(tuple((atom, rate) for atom, rate in angle.terms if not {*dict(atom)} & {*names}))
    return angle - fixed, -fixed


class Stability(StrEnum):
    """What second derivatives say of an equilibrium."""

    STABLE = "stable"
    UNSTABLE = "unstable"
    UNDECIDED = "undecided"


class Higher(Struct, frozen=True):
    """The first derivative of the energy that is not 0, above the second, up to a positive factor.

    It is that by a `coordinate`, from 0, or where there is none along what constraints leave free.
    """

    coordinate: int | None
    order: int
    value: Expr
    is_exact: bool

    @property
    def curvature(self) -> Expr:
        """What has the sign of a second derivative instead: negative where the energy falls to one side."""
        return -self.value * self.value if self.order % 2 else self.value


class Point(Struct, frozen=True):
    """Quarter turns of angles in a case, and how stable the arm is there.

    `neutral` are the coordinates, from 0, along which nothing changes; where the arm `drifts`, nothing does
    in any motion along the equilibria, in which the others follow these.  Where the stability is
    undecided, and there are `conditions` on the parameters, it is stable where these hold; where one of
    them fails the energy has no minimum, so that, if `falls`, the equilibrium is unstable.  Where its two
    sides are equal nothing is said, nor, of what is unstable too, where one of `nonzero` is 0.  Coordinates
    stand in conditions where their values are not known; `is_open` says that it is not told where it is
    stable.  All this is so
    where the case is there and none of its bounds, `inside`, is an equality.  `along` is what constraints
    leave of the second derivatives, and `higher` are those looked at where some of these are 0.  At a
    point that `is_crossing` what constraints leave is several smooth sets.
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
    higher: tuple[Higher, ...] = ()
    is_crossing: bool = False

    @property
    def is_told(self) -> bool:
        """Whether something is known."""
        return bool(self.conditions or self.nonzero) or self.stability is not Stability.UNDECIDED

    def told_at_pose(self) -> tuple[Any, ...]:
        """What is alike of points between which coordinates make whole turns, q/2 = ±90°.

        These are fixed, or do not stand in what is told.
        """
        rates = [dict(pair.angle.terms) for pair, _, _ in self.values]
        turns = [Fraction(DEGREES[sine, cosine], 360) for _, sine, cosine in self.values]
        atoms = dict.fromkeys(atom for one in rates for atom in one)
        told = (*(bound.value for bound in (*self.conditions, *self.inside)), *self.nonzero)
        open_names = {
            name
            for value in told
            for k, name in enumerate(value.ring.names)
            if not value.ring.diff(value, k).is_zero
        }
        periods = {
            atom: lcm(*(one[atom].denominator for one in rates if atom in one))
            for atom in atoms
            if len(rates) == len(atoms) or name_alone(atom) not in open_names or [atom] in map(list, rates)
        }
        poses = (
            tuple(
                (turn + sum(one.get(atom, 0) * whole for atom, whole in zip(periods, times, strict=True))) % 1
                for turn, one in zip(turns, rates, strict=True)
            )
            for times in product(*map(range, periods.values()))
        )
        pairs = tuple(pair.angle for pair, _, _ in self.values)
        return pairs, min(poses), replace(self, values=(), along=None, higher=())

    def put(self, exprs: Sequence[Expr]) -> list[Expr]:
        """What expressions are at its quarter turns."""
        return list(_put(Matrix.column(exprs[0].ring, exprs), self.values).entries) if exprs else []


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
            apart = (*(inside if told != point else ()), *told.inside)
            if not (apart and told.is_told):
                yield replace(point, inside=())
            elif told.stability is Stability.STABLE:  # where a bound is an equality nothing is known
                undecided = replace(point, stability=Stability.UNDECIDED, falls=False, is_open=False)
                yield replace(undecided, conditions=apart, inside=(), nonzero=())
            else:
                yield replace(told, inside=apart)

    def _possible(self, alternative: Alternative, exists: Sequence[Bound]) -> Iterator[Point]:
        """Points without what always holds in the case; stable where nothing else is asked."""
        for point in self._points(alternative, exists):
            nonzero = tuple(factor for factor in point.nonzero if self._may_vanish(factor, alternative))
            left = tuple(b for b in point.conditions if not self._always_holds(b.value, alternative))
            if point.falls and any(self._always_holds(-bound.value, alternative) for bound in left):
                point = replace(point, stability=Stability.UNSTABLE, falls=False, is_open=False)
                nonzero = left = ()
            elif (
                point.stability is Stability.UNDECIDED
                and (point.nonzero or point.conditions)
                and not (nonzero or left or point.is_open)
            ):
                point = replace(point, stability=Stability.STABLE, falls=False)
            yield replace(point, nonzero=nonzero, conditions=left)

    def _always_holds(self, value: Expr, alternative: Alternative) -> bool:
        """Whether a value is positive wherever the case is, as far as squares show."""
        there = value
        for condition in alternative:
            if (square := square_of(condition.expr)) is not None:
                there = _at_square(Matrix.column(there.ring, [there]), *square)[0, 0]
        if there != value and self.signs.is_positive(there):
            return True
        return _is_of_squares(value) and not self._may_vanish(value, alternative)

    def _may_vanish(self, factor: Expr, alternative: Alternative) -> bool:
        values = [condition.expr for condition in alternative]
        return not factor.ring.depends_on_coordinates(factor) or _may_be_zero([*values, factor], self.signs)

    def _points(self, alternative: Alternative, exists: Sequence[Bound]) -> Iterator[Point]:
        """The points, each with its bounds beside those of the case, where none is an equality."""
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
        at_rest = [
            _turned(ring, pose) for pose in rests([one.expr for one in others if not one.fixes_length])
        ]

        def whole(values: Values, second: Matrix, here: Here, signs: ParameterSigns) -> Point:
            drifting = self._drifting(values, second, signs, len(alternative))
            return drifting or self._point(values, second, signs, free, here)

        def point_at(values: Values) -> Point | None:
            left = _put(Matrix.column(ring, [other.expr for other in others]), values).entries
            needed = conditions(left, signs)
            if needed is None:
                return None
            own = tuple(
                Bound(one.value) for one in needed if one.value not in [other.value for other in exists]
            )
            return replace(judged(values, left, signs.beside(*own)), inside=own)

        def judged(values: Values, left: Sequence[Expr], signs: ParameterSigns) -> Point:
            here = partial(_there, values=values, zeros=left)
            if self.held is not None:
                along = self.held.along(self.second, here, signs)
                if along is None:
                    return self._where_curves_meet(values, signs, here)
                return self._held_point(values, along, signs, here)
            point = whole(values, here(self.second), here, signs)
            if point.stability is not Stability.UNDECIDED or not (higher := tuple(self._apart(here))):
                return point
            at, instead = here(self.second), {one.coordinate: one.curvature for one in higher}
            rows = [[*row[:k], instead.get(k, row[k]), *row[k + 1 :]] for k, row in enumerate(at.rows)]
            return replace(whole(values, Matrix.of(ring, rows), here, signs), higher=higher)

        for values in product(*turns):
            point = point_at(values)
            is_open = point is not None and (point.is_open or point.stability is Stability.UNDECIDED)
            if is_open or (point is not None and not all(one.fixes_coordinate for one in others)):
                together = (dict.fromkeys((*values, *more)) for more in at_rest)
                agreeing = (one for one in together if len({pair for pair, _, _ in one}) == len(one))
                yield from filter(None, (point_at(tuple(one)) for one in agreeing))
            if point is not None:
                yield point

    def _held_point(self, values: Values, along: Along, signs: ParameterSigns, here: Here) -> Point:
        """The stability along what constraints leave free, where their rows are independent."""
        apart = signs.beside(nonzero=signs.open_factors(along.divisor))
        second, higher = along.without_fractions, self._on_curve(along, here)
        if higher is not None:
            second = Matrix.of(second.ring, [[higher.curvature]])
        point = replace(self._point(values, second, apart, (), here), along=along)
        if higher is not None:
            point = replace(point, higher=(higher,))
        inside = signs.beside(*point.conditions)
        dependent = tuple(inside.open_factors(along.size))
        if not dependent or not point.is_told:
            return point
        nonzero = tuple(dict.fromkeys((*point.nonzero, *dependent)))
        is_unstable = point.stability is Stability.UNSTABLE
        stability = Stability.UNSTABLE if is_unstable else Stability.UNDECIDED
        return replace(point, stability=stability, nonzero=nonzero)

    def _where_curves_meet(self, values: Values, signs: ParameterSigns, here: Here) -> Point:
        """The stability where the rows of A_c are dependent, if smooth sets of h = 0 meet there.

        The energy is least there if it is along each of these; along one of them it may fall.
        """
        undecided, found = Point(values, Stability.UNDECIDED), set[Stability]()
        for branch in self.held.branches(here) if self.held is not None else ():
            along = None if branch is None else branch.along(self.second, here, signs)
            if branch is None or along is None:
                return undecided
            point = replace(self, held=branch)._held_point(values, along, signs, here)
            is_told = not (point.conditions or point.nonzero or point.is_open)
            found.add(point.stability if is_told else Stability.UNDECIDED)
        if Stability.UNSTABLE in found or found == {Stability.STABLE}:
            stability = Stability.UNSTABLE if Stability.UNSTABLE in found else Stability.STABLE
            return replace(undecided, stability=stability, is_crossing=True)
        return undecided

    def _apart(self, here: Here) -> Iterator[Higher]:
        """The coordinates of which the energy has a summand of its own, whose second derivative is 0."""
        second, n = self.second, len(self.second.rows)
        flat = here(second)
        for k in range(n):
            is_apart = all(second[k, j].is_zero for j in range(n) if j != k)
            if is_apart and flat[k, k].is_zero:
                found = _first_derivative(second[k, k], 2, partial(second.ring.diff, k=k), here)
                yield from [replace(found, coordinate=k)] if found else []

    def _on_curve(self, along: Along, here: Here) -> Higher | None:
        """Where one coordinate is free and the second derivative along Z is 0."""
        if self.held is None or along.free.shape[1] > 1 or not along.without_fractions.is_zero:
            return None
        ring, Z, columns = self.second.ring, nullspace(self.held.A), self.held.columns
        if (at := here(Z)).is_zero:
            return None

        def slope(value: Expr) -> Expr:
            return ring.dot(Z.entries, [ring.diff(value, k) for k in columns])

        found = _first_derivative(ring.dot(Z.entries, self.held.g.entries), 1, slope, here)
        return replace(found, is_exact=found.is_exact and at == along.free) if found else None

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

        @cache
        def minor(chosen: tuple[int, ...]) -> Expr:
            plain = Matrix.of(second.ring, [[determinant(part(second, chosen, chosen))]])
            apart, found = _put(plain, values)[0, 0], here(plain)[0, 0]
            factors, left = ([*signs.open_factors(one)] for one in (apart, found))
            is_clearer = len(factors) > len(left) and any(map(plain.ring.depends_on_coordinates, left))
            return apart if is_clearer else found  # the sign of a product is that of its factors

        neutral = tuple(k for k in free if all(entry.is_zero for entry in second.rows[k]))
        rest = tuple(k for k in range(len(second.rows)) if k not in neutral)
        if not rest or work(part(second, rest, rest)) > MOST_PRODUCTS:
            return Point(values, Stability.UNDECIDED, neutral, is_open=bool(rest))
        if not self.may_be_held and _falls(minor, rest, signs):
            return Point(values, Stability.UNSTABLE, neutral)
        rest = tuple(sorted(rest, key=lambda k: not signs.is_positive(signs.open_part(minor((k,))))))
        leading = [minor(rest[:k]) for k in range(1, len(rest) + 1)]
        nonzero = tuple(dict.fromkeys(factor for one in leading for factor in signs.even_factors(one)))
        signs = signs.beside(nonzero=nonzero)
        if nonzero and not self.may_be_held and _falls(minor, rest, signs):
            return Point(values, Stability.UNSTABLE, neutral, nonzero=nonzero)
        left: list[Expr] = []
        for one in leading:
            sign = signs.beside(*(Bound(before) for before in left if not before.is_number)).open_part(one)
            if not (sign.is_number and sign.number > 0) and not is_positive_throughout(sign, signs):
                left.append(sign)
        if not left and not nonzero:
            return Point(values, Stability.STABLE, neutral)
        moves = any(sign.ring.depends_on_coordinates(sign) for sign in (*left, *nonzero))
        if any(sign.is_number for sign in left):
            return Point(values, Stability.UNDECIDED, neutral, is_open=not _never_falls(minor, rest, signs))
        if moves and max(map(len, (*left, *nonzero))) > MOST_SHOWN_TERMS:
            return Point(values, Stability.UNDECIDED, neutral, is_open=True)
        conditions = tuple(map(Bound, _simplest(left, signs)))
        if not moves:
            conditions = independent(conditions, signs.assumed)
        falls = bool(conditions) and not self.may_be_held
        inside = self.signs.beside(*conditions)
        apart = tuple(factor for factor in nonzero if any(inside.open_factors(factor)))
        ring = second.ring
        if any(not ring.diff(sign, k).is_zero for sign in (*left, *nonzero) for k in neutral):
            told = conditions if falls else ()  # along what is neutral it comes to where they do not hold
            return Point(values, Stability.UNDECIDED, neutral, told, (), falls, is_open=True)
        return Point(values, Stability.UNDECIDED, neutral, conditions, apart, falls)


def _simplest(left: Sequence[Expr], signs: ParameterSigns) -> list[Expr]:
    """What is to be positive: x and y where x y is and they are not both negative, as a x + b y is positive.

    And nothing that is another and more.
    """
    found = list(dict.fromkeys(left))
    if 0 < len(found) < 3 and len(factors := [*signs.open_factors(found[-1])]) == 2:
        *mixed, product = found
        signed = permutations([*factors, *(-factor for factor in factors)], 2)
        pairs = ([x, y] for x, y in signed if _are_positive_with(x, y, mixed, product, signs))
        found = next(pairs, found)
    return [
        one for one in found if not any(signs.is_positive(one - other) for other in found if other != one)
    ]


def _are_positive_with(x: Expr, y: Expr, mixed: Sequence[Expr], product: Expr, signs: ParameterSigns) -> bool:
    """Whether `mixed`, a x + b y with a, b > 0, and x y are positive where x and y are, and nowhere else.

    Without it, whether y = c - a x with c > 0.
    """
    a, rest = (Expr(x.ring, part) for part in divmod((*mixed, y)[0].poly, x.poly))
    weights = (a, trig_quotient(rest, y)) if mixed else (-a, rest)
    parts = (*weights, trig_quotient(product, x * y))
    return all(part is not None and signs.is_positive(part) for part in parts)


def _first_derivative(value: Expr, order: int, slope: Callable[[Expr], Expr], here: Here) -> Higher | None:
    """The first derivative of a derivative of some order, with `slope` each time, that is not 0 here."""
    for following in range(order + 1, MOST_ORDER + 1):
        if value.is_zero or len(value) > MOST_DERIVED_TERMS:
            return None
        value = slope(value)
        at, unit = here(Matrix.column(value.ring, [value, value.ring.one])).entries
        if not at.is_zero:
            return Higher(None, following, at, unit == value.ring.one)
    return None


Minor = Callable[[tuple[int, ...]], Expr]
"""The principal minor of some rows."""


def _falls(minor: Minor, rest: Sequence[int], signs: ParameterSigns) -> bool:
    """Whether the energy surely falls in some direction: one of two principal minors is negative."""
    minors = [signs.open_part(minor(chosen)) for chosen in _principal(rest)]
    if any(signs.is_positive(-one) for one in minors):
        return True
    signed = [one for one in minors if not one.is_zero]
    if any(is_more(-one, Bound(other)) for one, other in permutations(signed, 2)):
        return True
    short = (one for one in minors if len(one) <= MOST_ADDED)
    return any(signs.is_positive(-(one + other)) for one, other in combinations(short, 2))


def _never_falls(minor: Minor, rest: Sequence[int], signs: ParameterSigns) -> bool:
    """Whether it surely falls in none, to second order: no principal minor is negative anywhere."""
    minors = map(minor, _principal(rest))
    return all(one.is_zero or signs.is_positive(signs.open_part(one)) for one in minors)


def _principal(rest: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """The rows of the principal minors."""
    return (chosen for size in range(1, len(rest) + 1) for chosen in combinations(rest, size))


def is_positive_throughout(value: Expr, signs: ParameterSigns) -> bool:
    """Whether k - m g l cos q > 0 for all q."""
    found = ends(value)
    return bool(found) and all(map(signs.is_positive, found))


def ends(value: Expr) -> list[Expr]:
    """k ± m g l of k - m g l cos q, of which one is the least: of what is linear in sines and cosines x.

    It is least where x is 1 or -1; or of what is so in x², where that is 1 or 0.  None of anything else.
    """
    ring, monomials = value.ring, value.poly.monoms()
    turning = [i for pair in ring.pairs for i in (pair.sine, pair.cosine) if any(m[i] for m in monomials)]
    powers = [{int(m[i]) for m in monomials} for i in turning]
    if (
        not turning
        or len(turning) > MOST_TURNING
        or not all(each <= {0, 1} or each <= {0, 2} for each in powers)
    ):
        return []
    at = [(1, -1) if 1 in each else (1, 0) for each in powers]
    return [with_numbers(value, dict(zip(turning, numbers, strict=True))) for numbers in product(*at)]


def _is_of_squares(value: Expr) -> bool:
    """Whether a value is a sum of squares, with positive parameters as factors."""
    ring = value.ring
    signed = [g.index for g in ring.generators if g.kind != "symbol" or g.name not in ring.parameters]
    return all(factor > 0 for factor in value.poly.coeffs()) and not any(
        exponents[k] % 2 for exponents in value.poly.monoms() for k in signed
    )


def _there(matrix: Matrix, values: Values, zeros: Sequence[Expr]) -> Matrix:
    """A matrix at quarter turns where further expressions are 0, up to a positive factor."""
    matrix, left = _put(matrix, values), list(zeros)
    while left:
        turns = {zero: turn for zero in left if (turn := turn_of(zero)) is not None}
        zero = next((zero for zero, turn in turns.items() if turn.is_one_sided), left[0])
        turn = turns.get(zero)
        left.remove(zero)
        if turn is not None and turn.is_one_sided:
            matrix = _at_turn(matrix, turn)
            left = [_at_turn(Matrix.column(one.ring, [one]), turn)[0, 0] for one in left]
        elif zero.is_zero:
            continue
        elif turn is not None and (line := _along_line(turn)) is not None:
            matrix = _at_line(matrix, *line)
        elif (square := square_of(zero)) is not None:
            matrix = _at_square(matrix, *square)
        else:
            size = matrix.shape[1]
            flat = Condition(zero).reduced_together(matrix.entries)
            matrix = Matrix.of(matrix.ring, (flat[i : i + size] for i in range(0, len(flat), size)))
    return matrix


def _at_square(matrix: Matrix, index: int, factor: Expr, rest: Expr) -> Matrix:
    """The matrix where m d² + n = 0, times m to an even power."""
    ring = matrix.ring
    most = max((int(e[index]) // 2 for entry in matrix.entries for e in entry.poly.monoms()), default=0)
    highest = most + most % 2

    def put(expr: Expr) -> Expr:
        total = ring.zero
        for exponents, number in expr.poly.to_dict().items():
            power = int(exponents[index]) // 2
            plain = tuple(int(e) % 2 if k == index else e for k, e in enumerate(exponents))
            own = Expr(ring, ring.ctx.from_dict({plain: number}))
            total += own * (-rest) ** power * factor ** (highest - power)
        return total

    return matrix.map(put)


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


def _along_line(turn: Turn) -> tuple[tuple[int, Expr], tuple[int, Expr]] | None:
    """(x, a) and (y, b) of a y + b x = 0, sine and cosine in either order; None where a may be 0."""
    both = (turn.pair.cosine, turn.sine), (turn.pair.sine, turn.cosine)
    for one, other in (both, both[::-1]):
        if turn.rest.is_zero and (is_positive(one[1]) or is_positive(-one[1])):
            return one, other
    return None


def _at_line(matrix: Matrix, one: tuple[int, Expr], other: tuple[int, Expr]) -> Matrix:
    """The matrix where a y + b x = 0 for the sine and the cosine of an angle, times an even power of a.

    With x² = a²/(a² + b²), and times a power of a² + b².
    """
    ring, (x, a), (y, b) = matrix.ring, one, other
    powers = [(int(e[x]), int(e[y])) for entry in matrix.entries for e in entry.poly.monoms()]
    most = max((j for _, j in powers), default=0)
    even, squares, size = most + most % 2, max((sum(both) // 2 for both in powers), default=0), a * a + b * b

    def put(expr: Expr) -> Expr:
        total = ring.zero
        for exponents, number in expr.poly.to_dict().items():
            i, j = int(exponents[x]), int(exponents[y])
            plain = tuple((i + j) % 2 if k == x else 0 if k == y else e for k, e in enumerate(exponents))
            own = Expr(ring, ring.ctx.from_dict({plain: number}))
            twice = (i + j) // 2
            total += own * (-b) ** j * a ** (even - j + 2 * twice) * size ** (squares - twice)
        return total

    return matrix.map(put)


def _turned(ring: Ring, pose: Pose) -> Values:
    """The angles of a pose at quarter turns."""
    found = []
    for pair in ring.pairs:
        sine, cosine = (ring.at_pose(ring.generator(place), pose) for place in (pair.sine, pair.cosine))
        if sine.is_zero or cosine.is_zero:
            found.append((pair, int(sine.number), int(cosine.number)))
    return tuple(found)


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


def _may_be_zero(values: Sequence[Expr], signs: ParameterSigns) -> bool:
    """Whether expressions are 0 together somewhere, as far as is found, for some parameters."""
    exactly = Special(signs)
    try:
        sets = common_zeros(values, exactly)
    except TooLong:
        return True
    there = any(conditions([one.expr for one in case], signs) is not None for case in sets)
    return there or not exactly.is_empty
