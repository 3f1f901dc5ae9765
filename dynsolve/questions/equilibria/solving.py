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
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from itertools import chain, permutations, product
from math import atan2, degrees, isclose, prod
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, names_of
from dynsolve.algebra.factors import in_numbers, trig_factors
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.parameter_span import Generators, expression, primitive
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import ring_of
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.allowed import NOT_SHOWN
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.existence import (
    conditions,
    coordinates_in,
    has_least_energy,
    is_seen,
    not_negative,
    quarter_turn,
    radians,
    without_ends,
    zeros_at_quarters,
)
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.search_ring import search_ring
from dynsolve.derivation.singular.sets import (
    Alternative,
    Special,
    TooLong,
    common_zeros,
    lies_in,
    zeros_of_any,
)
from dynsolve.derivation.singular.zeros import Condition, never_together, with_quotient
from dynsolve.errors import AlgebraError
from dynsolve.questions.equilibria.multipliers import Multipliers, Settled, remainder
from dynsolve.questions.equilibria.stability import (
    MOST_SHOWN_TERMS,
    Curvature,
    Point,
    by_coordinates,
    ends,
    is_positive_throughout,
    quarter_turns,
)
from dynsolve.questions.parameters.derive import generators
from dynsolve.robot.model import Robot

MOST_TERMS = 200
"""Forces with more terms are not taken apart."""

MOST_SPECIAL = 4
"""So many factors that may be 0 are told."""

MOST_PARTS = 10
"""Constant angles are looked for in such parts of a degree."""

TOO_LONG = "gravity and springs are too long to be taken apart into factors"


class SpecialCase(Struct, frozen=True):
    """A factor of parameters alone, and the alternatives of what is 0 in an equilibrium where it is 0.

    `needs` are expressions of parameters alone that must be 0 for there to be one, `exist` inequalities that
    must hold; without `cases` it is not known what is one.  Where
    only the rank of A_c is another, the equilibria are those for all parameters without the sets that are
    `excluded`, if these are known.
    """

    factor: Expr
    cases: tuple[Alternative, ...] | None
    exist: tuple[Bound, ...] = ()
    is_of_rank: bool = False
    excluded: tuple[Alternative, ...] = ()
    needs: tuple[Expr, ...] = ()

    @property
    def is_known(self) -> bool:
        """Whether all that is excluded for other parameters is excluded here, too."""
        return self.is_of_rank and bool(self.excluded)


class Equilibria(Struct, frozen=True):
    """Where all of `rows` are 0: at any of the alternatives, with the points of each.

    `exist` is what the parameters must satisfy for each to be there.  All this is so where none of the
    `special` is; where there `may_be_others`, that are not told, for general parameters.  With constraints
    each is without the sets that are `excluded`, and further sets on which there are no multipliers are left
    out if not `is_whole`; where the rows of A_c `may_be_dependent` nothing is known.  Of an energy that
    `is_convex` there is one at most; one that `has_least` is least somewhere, and the only case always there.
    `never` has conditions that are no case, and what is not 0 where they hold.  Of what `is_seen` the
    inequalities are all.  Of the `singular` it is not known whether they are equilibria: coordinates, from 0,
    that they fix move no body.
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
    singular: tuple[tuple[Alternative, tuple[int, ...]], ...] = ()
    only: tuple[tuple[Expr, Expr, tuple[Bound, ...]], ...] = ()
    is_convex: bool = False
    has_least: bool = False


def held_elsewhere(found: Equilibria, number: int, without: Alternative) -> list[int]:
    """The cases, from 0, that have equilibria in a set that another one, of this number, is without."""
    meeting = []
    for k, case in enumerate(found.alternatives):
        both = [one.expr for one in (*without, *case)]
        with suppress(TooLong):
            is_out = any(lies_in(both, [one.expr for one in other]) for other in found.excluded[k])
            if k != number and common_zeros(both) and not is_out:
                meeting.append(k)
    return meeting


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


def equilibria(
    robot: Robot, forces: Matrix, inertia: Matrix, *constraints: Matrix, may_be_held: bool = False
) -> Equilibria | Skipped:
    """The configurations where the forces (n×1) are 0 in every row that no motor holds.

    The forces are derivatives of an energy: g(q), or those of steady motion; `may_be_held` is that of
    `Curvature`.  Where `constraints` act, A_c and h, multipliers hold them, and h is 0.  Coordinates
    may move no body somewhere, by D, the `inertia`: r = 0 of a mass that falls has g = 0, too.
    """
    held = multipliers(robot, forces, *constraints) if constraints else None
    if held is not None and not held.allowed.is_whole:
        return Skipped(NOT_SHOWN)
    wanted = [forces[k, 0] for k in wanted_rows(robot)] if held is None else [*held.zeros(held.rank)]
    if sum(map(len, wanted)) > MOST_TERMS:
        return Skipped(TOO_LONG)
    try:
        return _Search(robot, wanted, held).found(forces, inertia, may_be_held)
    except TooLong:
        return Skipped(TOO_LONG)


class _Search:
    """Where what is `wanted` is 0, looked for in a ring of its own.

    On the way it is noted which factors of parameters may be 0: `special` are those of the zeros, `of_rank`
    those of the rank of A_c alone.
    """

    def __init__(self, robot: Robot, wanted: Sequence[Expr], held: Multipliers | None) -> None:
        self.robot = robot
        ring = search_ring(robot.ring, (), {}) if held else _search_ring(robot.ring, wanted)
        ring = _splitting(robot.ring, wanted, ring)
        self.there = Transfer(robot.ring, ring)
        self.signs = assumed_signs(robot, self.there)
        self.special, self.of_rank = Special(self.signs), Special(self.signs)
        self.held = held.moved(self.there) if held else None
        self.has_energy = held is None or held.is_of_energy(robot.n - len(_kept_turning(robot)))
        self.wanted = [*map(self.there, wanted)]
        self.only: list[tuple[Expr, Expr, tuple[Bound, ...]]] = []
        self.left = tuple(combined(robot.ring, wanted, lambda factor: self.special.add(self.there(factor))))

    def found(self, forces: Matrix, inertia: Matrix, may_be_held: bool) -> Equilibria:
        """The equilibria; raises TooLong."""
        rest = None if self.held else self._only_rest(forces)
        alternatives, settled = (rest, None) if rest else self._alternatives()
        if self.held is None:
            alternatives = tuple(dict.fromkeys(one for case in alternatives for one in self._narrowed(case)))
        for factor in self.of_rank.factors:
            if self.held and self.held.at_ends(factor, self.signs):
                self.special.add(factor)
        excluded = dict(settled.pairs) if settled else {}
        possible = {
            one: bounds
            for one in alternatives
            if (bounds := conditions([condition.expr for condition in one], self.signs)) is not None
        }
        singular = self._singular(possible, forces, inertia)
        exist = {one: bounds for one, bounds in possible.items() if one not in singular}
        for condition in (condition for one in exist for condition in one):
            if condition.fixes_length and condition.linear:  # where the factor of the length is 0, it is free
                self.special.add(condition.linear[0])
        special = self.special
        special.factors = {
            factor: None for factor in special.factors if not self._is_ordinary(factor, [*exist])
        }
        points = self._points(exist, forces, may_be_held)
        short = [factor for factor in special.factors if len(factor) <= MOST_SHOWN_TERMS][:MOST_SPECIAL]
        never = (_never(one, self.signs) for one in alternatives if one not in possible)
        seen = [_is_seen(one, self.signs) for one in exist]
        is_only = len(exist) == 1 and not singular
        if is_only and settled is not None and self._is_always(settled, *exist.values()):
            seen = [True]
        has_least = is_only and not all(seen) and self._has_least(forces)
        if has_least:
            exist, seen = dict.fromkeys(exist, ()), [True]
        inside = {one: without_ends(bounds, short, self.signs) for one, bounds in exist.items()}
        return Equilibria(
            rows=self.left,
            alternatives=tuple(exist),
            points=points,
            exist=tuple(inside.values()),
            special=tuple(
                case
                for case in self._special_cases(short, settled, bool(singular))
                if case.cases != () or not self._is_left_out(case.factor, inside.values())
            ),
            may_be_others=special.is_open or self.of_rank.is_open or len(short) < len(special.factors),
            excluded=tuple(excluded.get(one, ()) for one in exist),
            is_whole=settled is None or settled.is_whole,
            may_be_dependent=self.held is not None and settled is None,
            never=(*special.never, *never),
            is_seen=tuple(seen),
            singular=tuple(singular.items()),
            only=tuple(dict.fromkeys(self.only)),
            is_convex=rest is not None,
            has_least=has_least,
        )

    def _only_rest(self, forces: Matrix) -> tuple[Alternative, ...] | None:
        """Where the forces are 0 at quarter turns, if they can be so once: springs that are stiff enough."""
        ring, signs = self.robot.ring, ParameterSigns(self.robot.questions.model.assumed)
        places = range(len(ring.names))
        second = [[ring.diff(force, k) for k in places] for force in forces.entries]
        is_linear = not any(ring.depends_on_coordinates(entry) for row in second for entry in row)
        if is_linear or len(places) == 1 or len(wanted_rows(self.robot)) < len(places):
            return None
        for k, row in enumerate(second):
            ways = product(*({entry, -entry} for entry in (*row[:k], *row[k + 1 :])))
            for least in (sum(way, start=row[k]) for way in ways):
                if not signs.is_positive(least) and not is_positive_throughout(least, signs):
                    return None
        for pose in zeros_at_quarters(forces.entries):
            each = [(ring.symbol(name), radians(ring, pose.get(name, 0))) for name in ring.names]
            zeros = [self.there(q - at) for q, at in each if at is not None]
            return common_zeros(zeros) if len(zeros) == len(each) else None
        return None

    def _has_least(self, forces: Matrix) -> bool:
        """Whether nothing holds the energy back from where it is least, and that is somewhere."""
        are_all = self.held is None and len(wanted_rows(self.robot)) == self.robot.n
        return are_all and has_least_energy(
            forces.entries, ParameterSigns(self.robot.questions.model.assumed)
        )

    def _narrowed(self, case: Alternative) -> tuple[Alternative, ...]:
        """A case with q = 0 for an equation in q that is 0 there alone, as it grows with q everywhere."""
        found = {one: _only_zero(one.expr, self.signs) for one in case}
        self.only += filter(None, found.values())
        zeros = [only[1] if only and not only[2] else one.expr for one, only in found.items()]
        is_moved = zeros != [one.expr for one in case]
        return common_zeros(zeros, self.special, keeps_products=True) if is_moved else (case,)

    def _alternatives(self) -> tuple[tuple[Alternative, ...], Settled | None]:
        """The cases, and what is known of their multipliers: None where the rows of A_c may be dependent."""
        rows = [*map(self.there, self.left)]
        if self.held is None:
            alternatives = common_zeros(rows, self.special, keeps_products=True)
            return alternatives, Settled(alternatives, tuple(() for _ in alternatives), True)
        alternatives = self.held.found(rows, self.special)
        try:
            settled = self.held.settled(alternatives, self.held.rank, self.of_rank)
        except TooLong:
            settled = None
        if settled is None or settled.alternatives != alternatives:
            self.special.join(self.of_rank)
            self.of_rank = Special(self.signs)
        return settled.alternatives if settled else alternatives, settled

    def _is_always(self, settled: Settled, bounds: Sequence[Bound]) -> bool:
        """Whether these bounds are enough for the only case: the energy is least somewhere where h is 0."""
        held = self.held
        if held is None or any(settled.excluded) or self.of_rank.factors.keys() - self.special.factors.keys():
            return False
        reached = conditions(held.h, self.signs)
        return (
            settled.is_whole
            and not self.of_rank.is_open
            and self.has_energy
            and held.leaves_least_energy(self.signs)
            and is_seen(held.h, self.signs)
            and reached is not None
            and {*reached}.issubset(bounds)
        )

    def _is_left_out(self, factor: Expr, exist: Collection[tuple[Bound, ...]]) -> bool:
        """Whether in each case, by what the parameters must satisfy for it, a factor is not 0."""
        return bool(exist) and not any(any(self.signs.beside(*one).open_factors(factor)) for one in exist)

    def _is_ordinary(self, factor: Expr, cases: Sequence[Alternative]) -> bool:
        """Whether the equations of the only case, too, say what the forces do where a factor is 0."""
        if self.special.never or _is_unknown(factor, self.held, self.signs):
            return False
        divided = Special(self.signs)
        if len(cases) > 1 and self.held is None:
            return _are_all_where_zero(cases, factor, self.wanted, self.signs)
        if len(cases) != 1:
            return False

        def rows(zeros: Iterable[Expr]) -> list[Expr]:
            return [*combined(factor.ring, _rests(factor, zeros), divided.add, factor)]

        own, theirs = rows(condition.expr for condition in cases[0]), rows(self.wanted)
        return len(own) == len(theirs) == len(rows([*own, *theirs])) and divided.is_empty

    def _singular(
        self, cases: Iterable[Alternative], forces: Matrix, inertia: Matrix
    ) -> dict[Alternative, tuple[int, ...]]:
        """Cases in which coordinates describe nothing, and these."""
        free, kept = wanted_rows(self.robot), _kept_turning(self.robot)
        pulls = [self.there(force) for k, force in enumerate(forces.entries) if k not in kept]
        self.idle = partial(_idle, inertia.map(self.there), pulls, free)
        return {one: idle for one in cases if (idle := self.idle(one))}

    def _points(
        self, exist: Mapping[Alternative, tuple[Bound, ...]], forces: Matrix, may_be_held: bool
    ) -> tuple[tuple[Point, ...], ...]:
        """The points of each case, with their stability; none where what is held has no energy."""
        robot, ring = self.robot, self.there.target
        if not self.has_energy:
            return tuple(() for _ in exist)
        kept = _kept_turning(robot)
        slopes = (
            [ring.zero if {i, k} & kept else self.there(robot.ring.diff(g, k)) for k in range(robot.n)]
            for i, g in enumerate(forces.entries)
        )
        second = Matrix.of(ring, slopes)
        for condition in (condition for one in exist for condition in one):
            self.special.add(condition.multiplier(second.entries))
        nonzero = (*self.special.factors, *self.of_rank.factors)
        signs, found = self.signs.beside(nonzero=nonzero), []
        is_periodic = self._is_periodic()
        for one, bounds in exist.items():
            there = Transfer(ring, _ring_of_sums(ring, one))
            own, *cases = (tuple(Condition(there(c.expr)) for c in case) for case in (one, *exist))
            held = self.held.moved(there) if self.held else None
            curvature = Curvature(second.map(there), signs.moved(there), may_be_held, held)
            points = curvature.points(own, [Bound(there(bound.value), bound.is_strict) for bound in bounds])
            told = [point for point in points if not _is_told_of_more(point, own, cases)]
            if is_periodic:  # q₃/2 = -90° is q₃ = -180°, the pose of q₃ = 180°
                told = list({point.told_at_pose(): point for point in reversed(told)}.values())[::-1]
            found.append(tuple(told))
        return tuple(found)

    def _is_periodic(self) -> bool:
        """Whether a whole turn of an angle is no other configuration, as it is where a spring is wound up."""
        ring = self.robot.ring
        turning = [ring.symbol_indices[name, 0] for name, kind in ring.coordinates if kind == "revolute"]
        is_wound = any(row.poly.degrees()[place] > 0 for row in self.left for place in turning)
        rates = (rate for pair in ring.pairs for _, rate in pair.angle.terms)
        return not is_wound and all(rate.denominator == 1 for rate in rates)

    def _special_cases(
        self, factors: Iterable[Expr], settled: Settled | None, has_singular: bool
    ) -> Iterator[SpecialCase]:
        """What is known where one of these factors is 0, and where one of the rank of A_c alone is.

        That something is singular is told for them, too, if the case `has_singular` configurations.
        """
        for factor in factors:
            case = _special_case(factor, self.wanted, self.held, self.signs)
            for forces in case.cases or ():
                case = self._taken_apart(case, forces, has_singular)
            yield case
        if settled and self.held:
            moved = (factor for factor in self.of_rank.factors if factor not in self.special.factors)
            yield from filter(None, (_of_rank(factor, self.held, settled, self.signs) for factor in moved))

    def _taken_apart(self, case: SpecialCase, forces: Alternative, has_singular: bool) -> SpecialCase:
        """The same with alternatives for what is 0, if these are so for all such parameters."""
        special, zeros = Special(self.signs), [one.expr for one in forces]
        try:
            found = common_zeros(zeros, special, keeps_products=True)
        except TooLong:
            return case
        heavy = tuple(one for one in found if not self.idle(one))
        exist = {one: conditions([own.expr for own in one], self.signs) for one in heavy}
        there = {one: bounds for one, bounds in exist.items() if bounds is not None}
        is_known = not special.is_open and all(
            never_together((one, case.factor), case.factor.ring.one) for one in special.factors
        )
        is_told = len(heavy) == len(found) or has_singular
        if not is_known or not is_told or (len(there) > 1 and any(there.values())):
            return case
        return replace(case, cases=tuple(there), exist=tuple(chain(*there.values())))


def _only_zero(value: Expr, signs: ParameterSigns) -> tuple[Expr, Expr, tuple[Bound, ...]] | None:
    """±k φ ∓ m g l sin φ, φ, which is 0 where it is, and where it grows with φ everywhere: k ≥ m g l.

    None of any other.
    """
    names = coordinates_in(value)
    if len(names) != 1 or Condition(value).fixes_coordinate:
        return None
    ring, (name,) = value.ring, names
    slope = ring.diff(value, ring.names.index(name))
    for sign, pose in product((1, -1), zeros_at_quarters([value])):
        at, least = radians(ring, pose.get(name, 0)), ends(slope * sign)
        is_known = least and not any(map(ring.depends_on_coordinates, least))
        growing = not_negative(least, signs) if is_known else None
        if at is not None and growing is not None:
            return value * sign, ring.symbol(name) - at, growing
    return None


def _search_ring(ring: Ring, wanted: Sequence[Expr]) -> Ring:
    """The ring to search in, with q - a as an angle of it where that is shorter: a is a slope, or 30°."""
    found = search_ring(ring, (), {})
    found = _shortest(ring, wanted, [found, _as_given(ring, found)])
    places = range(len(found.plan.turning))
    fixed = [pair.angle for pair in found.pairs if not {*names_of(pair.angle)} & {*found.names}]
    for slope in (angle for angle in fixed if angle.terms):
        found = _shortest(
            ring, wanted, [found, *(_ahead(found, *one) for one in product(places, (slope, -slope)))]
        )
    for _ in places:
        rows = [*map(Transfer(ring, found), wanted)]
        ahead = ((k, angle) for k in places for angle in _constants_ahead(found.pairs[k], rows))
        with suppress(AlgebraError):  # the ring has not every constant angle
            found = _shortest(ring, wanted, [found, *(_ahead(found, *one) for one in ahead)])
    return found


def _as_given(ring: Ring, found: Ring) -> Ring:
    """The ring with what is added to each coordinate: 45° and 15° of q₁ + 45° and q₁ + q₂ + 60°."""
    turning = [*found.plan.turning]
    places = {i: k for k, (unit, _) in enumerate(turning) for i, rate in enumerate(unit) if rate}
    for vector, offset in ring.plan.turning:
        *others, last = (i for i, rate in enumerate(vector) if rate)
        for i in others:
            unit, own = turning[places[i]]
            offset -= own * (vector[i] / unit[i])
        unit, _ = turning[places[last]]
        offset *= unit[last] / vector[last]
        turning[places[last]] = unit, offset if offset.degrees % 90 else offset - Angle((), offset.degrees)
    return ring_of(ring.coordinates, replace(found.plan, turning=tuple(turning)))


def _shortest(ring: Ring, wanted: Sequence[Expr], rings: Sequence[Ring]) -> Ring:
    """The ring in which what is wanted has the fewest terms."""
    return min(rings, key=lambda other: sum(len(one) for one in map(Transfer(ring, other), wanted)))


def _ahead(ring: Ring, place: int, angle: Angle) -> Ring:
    """The ring with an angle that is ahead of one of its own."""
    turning = [*ring.plan.turning]
    vector, offset = turning[place]
    turning[place] = (vector, offset + angle)
    return ring_of(ring.coordinates, replace(ring.plan, turning=tuple(turning)))


def _constants_ahead(pair: Pair, values: Iterable[Expr]) -> list[Angle]:
    """Each a, up to quarter turns, of A sin(q + a) where A cos a sin q + A sin a cos q stands."""
    parts: dict[Any, list[float]] = {}
    turning = pair.sine, pair.cosine
    for number, value in enumerate(values):
        for exponents, size in in_numbers(value).items():
            if sum(exponents[k] for k in turning) == 1:
                key = tuple(0 if k in turning else e for k, e in enumerate(exponents))
                parts.setdefault((number, key), [0.0, 0.0])[exponents[pair.cosine]] = size
    found = [degrees(atan2(b, a)) % 90 for a, b in parts.values()]
    exact = {Fraction(ahead).limit_denominator(MOST_PARTS): ahead for ahead in sorted(found)}
    ways = [angle for angle, ahead in exact.items() if 0 < angle < 90 and isclose(angle, ahead)]
    return [Angle((), angle - 90 * (angle > 45)) for angle in ways]


def _splitting(ring: Ring, wanted: Sequence[Expr], found: Ring) -> Ring:
    """The ring with half of a coordinate as an angle where that takes a sum apart: s₁ + s₁₂."""
    there = Transfer(ring, found)
    mixed = [
        factor
        for one in wanted
        for factor, _ in trig_factors(there(one))
        if sum(not found.diff(factor, k).is_zero for k in range(len(found.coordinates))) > 1
    ]
    for place, (vector, offset) in enumerate(found.plan.turning):
        turning = [*found.plan.turning]
        turning[place] = (tuple(rate / 2 for rate in vector), offset * Fraction(1, 2))
        finer = ring_of(found.coordinates, replace(found.plan, turning=tuple(turning)))
        if any(len(trig_factors(one)) > 1 for one in map(Transfer(found, finer), mixed)):
            return finer
    return found


def _ring_of_sums(ring: Ring, case: Alternative) -> Ring:
    """The ring with each angle that a case has at quarter turns, as q₁ + q₂, in place of a coordinate."""
    turning = [*ring.plan.turning]
    for condition in case:
        fixed = None if quarter_turns(condition) else quarter_turn(condition.expr)
        if fixed is None:
            continue
        moving, rest = by_coordinates(fixed[0], ring.names)
        rest -= Angle((), moving.degrees)
        vector = tuple(Fraction(dict(moving.terms).get(((name, 1),), 0)) for name in ring.names)
        for place, (own, _) in reversed([*enumerate(turning)]):
            (rate, other), *more = ((a, abs(b)) for a, b in zip(own, vector, strict=True) if a)
            if not more and rate == other:
                turning[place] = (vector, -rest)
                break
    found = ring_of(ring.coordinates, replace(ring.plan, turning=tuple(turning)))
    with suppress(AlgebraError):  # it has not every part of an angle
        if turning != [*ring.plan.turning] and all(found.sin(pair.angle).poly for pair in ring.pairs):
            return found
    return ring


def _idle(inertia: Matrix, pulls: Sequence[Expr], free: Sequence[int], case: Alternative) -> tuple[int, ...]:
    """Those of the `free` coordinates that move no body in a case, as an angle at r = 0.

    But for those that it leaves free, where all that pulls is 0: this is so in whatever direction the bodies
    move.  Across a rod of length 0 no motor and no constraint along the rod holds.
    """
    known = [condition.expr for condition in case]
    heavy = (k for k in free if not inertia[k, k].is_zero)
    still = (k for k in heavy if lies_in(known, [inertia[k, k]]))
    pulled = not lies_in(known, pulls)
    return tuple(k for k in still if pulled or any(not inertia.ring.diff(one, k).is_zero for one in known))


def _is_told_of_more(point: Point, own: Alternative, cases: Iterable[Alternative]) -> bool:
    """Whether a point of a case lies in one with fewer conditions, of which the same is told."""
    known = point.put([condition.expr for condition in own])
    return any(
        len(case) < len(own) and lies_in(known, point.put([condition.expr for condition in case]))
        for case in cases
    )


def _is_seen(alternative: Alternative, signs: ParameterSigns) -> bool:
    """Whether `conditions` are all that parameters need; a length that is given by others is there."""
    if not any(map(_has_parameter, alternative)):
        return True
    open_values = [one.expr for one in alternative if not one.fixes_length and not one.gives_angle]
    return is_seen(open_values, signs)


def _has_parameter(condition: Condition) -> bool:
    ring, degrees = condition.expr.ring, condition.expr.poly.degrees()
    return any(
        degrees[g.index] > 0
        for g in ring.generators
        if g.kind == "symbol" and g.name in ring.parameters and g.name != "pi"
    )


def _never(alternative: Alternative, signs: ParameterSigns) -> tuple[Alternative, Expr]:
    """What is not 0 in an alternative where its other conditions hold."""
    value = next((one for one in alternative if conditions([one.expr], signs) is None), alternative[-1])
    return tuple(one for one in alternative if one is not value), value.expr


def assumed_signs(robot: Robot, there: Transfer) -> ParameterSigns:
    """What the problem assumes of the parameters, in another ring."""
    assumed = robot.questions.model.assumed
    return ParameterSigns(tuple(Bound(there(bound.value), bound.is_strict) for bound in assumed))


def _are_all_where_zero(
    cases: Iterable[Alternative], factor: Expr, zeros: Iterable[Expr], signs: ParameterSigns
) -> bool:
    """Whether cases are where all is 0 also where a factor is, which gives a parameter: a = b²/c."""
    ring, special = factor.ring, Special(signs)
    indices = [g.index for g in ring.generators if g.kind == "symbol" and g.name in ring.parameters]
    slopes = ((k, Expr(ring, factor.poly.derivative(k))) for k in indices)
    given = ((k, m) for k, m in slopes if k not in m.used and (signs.is_positive(m) or signs.is_positive(-m)))
    for k, m in given:
        rest = factor - m * ring.generator(k)

        def put(value: Expr, k: int = k, m: Expr = m, rest: Expr = rest) -> Expr:
            return with_quotient(value, k, m, rest, int(value.poly.degrees()[k]))

        with suppress(TooLong):
            own = zeros_of_any([[put(one.expr) for one in case] for case in cases], special)
            theirs = common_zeros([*map(put, zeros)], special)
            sets = [[[one.expr for one in case] for case in found] for found in (own, theirs)]
            return special.is_empty and all(
                any(lies_in(one, other) for other in others)
                for mine, others in permutations(sets)
                for one in mine
            )
    return False


def _is_unknown(factor: Expr, held: Multipliers | None, signs: ParameterSigns) -> bool:
    """Whether where a factor is 0 the rows of A_c may be dependent."""
    return held is not None and not held.holds_where_zero(factor, signs)


def _special_case(
    factor: Expr, zeros: Sequence[Expr], held: Multipliers | None, signs: ParameterSigns
) -> SpecialCase:
    """What is 0 where a factor is; nothing is known where with this the rows of A_c may be dependent."""
    ends = held.at_ends(factor, signs) if held else ()
    if not ends and _is_unknown(factor, held, signs):
        return SpecialCase(factor, None)
    left = [_where_zero(row, factor) for row in _modulo(factor, ends or zeros, signs)]
    ring = factor.ring
    forces = tuple(row for row in left if ring.depends_on_coordinates(row))
    needs = dict.fromkeys(prod(signs.open_factors(row), start=ring.one) for row in left if row not in forces)
    exist = conditions(forces, signs)
    if exist is None or ring.one in needs:
        return SpecialCase(factor, ())
    return SpecialCase(factor, (tuple(map(Condition, forces)),), exist, needs=tuple(needs))


def _of_rank(factor: Expr, held: Multipliers, settled: Settled, signs: ParameterSigns) -> SpecialCase | None:
    """What has no multipliers where a factor is 0, beside what never has; None where that is nothing."""
    special = Special(signs)
    conditions = (tuple(one.expr for one in case) for case in settled.alternatives)
    case = [tuple(Condition(remainder(value, factor)) for value in values) for values in conditions]
    try:
        found = held.where_zero(factor).settled(case, held.rank, special)
    except TooLong:
        return SpecialCase(factor, None, is_of_rank=True)
    unknown = SpecialCase(factor, None, is_of_rank=True)
    if found.alternatives != tuple(case) or not special.is_empty:
        return unknown
    pairs = list(zip(found.excluded, settled.excluded, strict=True))
    if any(not {*known}.issubset(without) for without, known in pairs):
        return unknown
    more = [one for without, known in pairs for one in without if one not in known]
    return SpecialCase(factor, None, (), True, tuple(dict.fromkeys(more))) if more else None


def _modulo(factor: Expr, zeros: Iterable[Expr], signs: ParameterSigns) -> tuple[Expr, ...]:
    """What is left of `zeros` where a factor is 0, combined where that divides by nothing that may be 0."""
    rests = _rests(factor, zeros)
    divided = Special(signs)
    rows = tuple(combined(factor.ring, rests, divided.add, factor))
    return rows if divided.is_empty else tuple(dict.fromkeys(rests))


def _rests(factor: Expr, zeros: Iterable[Expr]) -> list[Expr]:
    """What is left of each, without those that are 0."""
    return [rest for zero in zeros if not (rest := remainder(zero, factor)).is_zero]


def _where_zero(rest: Expr, factor: Expr) -> Expr:
    """The factors of what is left that may be 0 where another one is; 1 where there are none."""
    ring = rest.ring
    kept = (
        own**times
        for own, times in trig_factors(rest)
        if ring.depends_on_coordinates(own) or not never_together((own, factor), ring.one)
    )
    return prod(kept, start=ring.one)


def combined(
    ring: Ring, forces: Sequence[Expr], use: Callable[[Expr], None], zero: Expr | None = None
) -> Iterator[Expr]:
    """Combinations of forces that are 0 where these are: each without what the others begin with.

    `use` is told what must not be 0 for that: factors that are multiplied by or divided out.  Where a factor
    of parameters is `zero`, what holds no coordinate is left as it is.
    """
    kinds = generators(ring, frozenset())
    left = [row for row in map(_row(ring, kinds), forces) if row]
    done: list[dict[Any, Expr]] = []
    while left:
        lead = max(key for row in left for key in row)
        if zero is not None and not any(lead):
            break
        leading = [row for row in left if lead in row]
        if zero is not None:  # what is divided by should not be 0, as a product of parameters is not
            leading = [row for row in leading if len(row[lead]) == 1] or leading
        chosen = min(leading, key=lambda row: (len(row), _size(row)))
        others = [row for row in left if row is not chosen]
        left = [row for row in (_without(other, chosen, lead, use, zero) for other in others) if row]
        done = [_without(row, chosen, lead, use, zero) for row in done]
        done.append(chosen)
    yield from (expression(ring, _primitive(row, use)) for row in done)
    yield from (expression(ring, row) for row in left)


def _primitive(row: dict[Any, Expr], use: Callable[[Expr], None]) -> dict[Any, Expr]:
    """A row without what all its entries share."""
    found = primitive(row)
    for key in list(found)[:1]:
        use(_quotient(row[key], found[key]))
    return found


def _quotient(value: Expr, divisor: Expr) -> Expr:
    """A value divided by one of its factors."""
    return Expr(value.ring, divmod(value.poly, divisor.poly)[0])


def _row(ring: Ring, kinds: Generators) -> Any:
    """A force as a vector: polynomials in the parameters by the product of what moves."""

    def row(force: Expr) -> dict[Any, Expr]:
        moving = Generators(frozenset(range(len(ring.generators))) - kinds.moving, kinds.moving)
        found: dict[Any, Expr] = {}
        for factor, vector in moving.split(force):
            for key, number in vector.items():
                value = factor * number
                found[key] = found[key] + value if key in found else value
        return {key: value for key, value in found.items() if not value.is_zero}

    return row


def _without(
    row: dict[Any, Expr], chosen: dict[Any, Expr], lead: Any, use: Callable[[Expr], None], zero: Expr | None
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
    if zero is not None:
        found = {key: remainder(value, zero) for key, value in found.items()}
    found = {key: value for key, value in found.items() if not value.is_zero}
    return found if zero is not None and not any(map(any, found)) else _primitive(found, use)


def _size(row: dict[Any, Expr]) -> int:
    return sum(map(len, row.values()))
