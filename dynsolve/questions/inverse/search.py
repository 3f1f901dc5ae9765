"""Which unknown is solved for next, and from which equations.

When a branch gives r(q) = r back, where the task has more components than there are joints to move them.

Relations between the values are conditions, as many as there are directions in which no joint moves the
values, found from derivatives at points that are reached.  Where these do not bring about a component
of r(q) = r, that is a condition too, with the coordinates of the branch in it: seen at points where another
solution is the right one, and at values that no configuration was taken for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain, islice
from math import pi

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import ENOUGH, Sample, Transfer, numbered, samples
from dynsolve.derivation.elimination import rank, shortest_step
from dynsolve.derivation.reached import CLOSE
from dynsolve.derivation.search_ring import search_ring
from dynsolve.questions.inverse.equations import (
    Equation,
    Given,
    System,
    Unknowns,
    arranged,
    parted_systems,
    squared_sums,
    turned_systems,
    turns,
)
from dynsolve.questions.inverse.solving import (
    MOST,
    Branch,
    Part,
    Relation,
    Solving,
    configuration,
    reach_of,
    relations,
    solves_task,
)
from dynsolve.questions.inverse.subproblems import Length, Remainder, Solved, TwoLines, recognized

MOST_SYSTEMS = 40
"""So many systems are kept; those that come later are turned more often."""

MOST_TERMS = 400
"""Equations with more terms are not looked at."""


def solve_task(task: Matrix, values: Sequence[str]) -> Solving | None:
    """How r(q) = values is solved for q; None where the known forms do not lead to an end.

    `task` is r(q), m×1; coordinates that do not occur in it are free.
    """
    given, sums = _angle_sums(task, values)
    angles = {name: one.angle_of(name) for name, one in given.items()}
    ring = search_ring(task.ring, values, angles)
    carry = Transfer(task.ring, ring, angles)
    r = tuple(carry(entry) for entry in task.entries)
    names = [name for name in ring.names if name not in given]
    unknowns = Unknowns(ring, tuple(names), tuple(values))
    occurring = {name for k, e in enumerate(r) if k not in sums for name in unknowns.within(e)}
    free = tuple(name for name in names if name not in occurring)
    for name in free:
        unknowns = unknowns.without(name)
    rest = tuple(
        Equation(ring.symbol(value), entry, Given(k))
        for k, (entry, value) in enumerate(zip(r, values, strict=True))
        if k not in sums
    )
    seen: list[Equation] = []
    steps = search([rest], unknowns, seen)
    if {step.coordinate for step in steps} != set(unknowns.names):
        return None
    last = [one.remainder(name, carry) for name, one in given.items()]
    bound = tuple(one.relation(values[k], carry) for k, one in sums.items() if not one.rates)
    return Solving(
        ring,
        task,
        tuple(values),
        frozenset(values[k] for k in sums),
        (Part((*steps, *last)),),
        free,
        (*bound, *(Relation(e.left, e.right) for e in rest)),
        (*bound, *relations(steps, (*rest, *seen))),
    )


def search(
    given: Sequence[System], unknowns: Unknowns, seen: list[Equation] | None = None
) -> tuple[Solved, ...]:
    """The steps from some systems to the unknowns, each the simplest there is, as far as they lead.

    The equations that are made on the way are added to `seen`.
    """
    systems = list(given)
    sums: list[Equation] = []
    steps: list[Solved] = []
    while unknowns.names:
        systems = _grown([tuple(arranged(e, unknowns) for e in s) for s in systems], unknowns)
        added = [tuple(_sums(system)) for system in systems]
        if seen is not None:
            seen += chain.from_iterable((*systems, *added))
        best = min(_solvable(systems, added, sums, unknowns), key=_effort, default=None)
        if best is None:
            if len(grown := _grown([*systems], unknowns, parted_systems)) == len(systems):
                break
            systems = grown
            continue
        steps.append(best)
        unknowns = unknowns.without(best.coordinate)
        # what is known from now on may make them longer: they are kept as they are
        sums = [e for e in (*sums, *chain.from_iterable(added)) if len(unknowns.within(e.expr)) == 1]
    return tuple(steps)


def _effort(solved: Solved) -> tuple[int, bool, int]:
    """What a step costs its reader; a turned equation counts as two terms more.

    What is always given comes before what is free somewhere.
    """
    may_be_free = isinstance(solved, TwoLines | Length) and solved.may_be_free
    return solved.rank, may_be_free, solved.size + 2 * sum(turns(e.origin) for e in solved.equations)


def _grown(
    systems: list[System],
    unknowns: Unknowns,
    others: Callable[[System, Unknowns], Iterator[System]] = turned_systems,
) -> list[System]:
    """The systems with all that are made of them, as by turning them."""
    known = {_mark(system) for system in systems}
    for system in systems:  # grows while it is read
        for made in others(system, unknowns):
            mark = _mark(made)
            if mark not in known and len(systems) < MOST_SYSTEMS:
                known.add(mark)
                systems.append(made)
    return systems


def _mark(system: System) -> frozenset[str]:
    return frozenset(f"{equation.left.poly} = {equation.right.poly}" for equation in system)


def _sums(system: System) -> Iterator[Equation]:
    return (e for e in squared_sums(system) if len(e.left) + len(e.right) <= MOST_TERMS)


def _solvable(
    systems: Sequence[System], sums: Sequence[System], earlier: Sequence[Equation], unknowns: Unknowns
) -> Iterator[Solved]:
    """What the equations of some systems, with their sums of squares, and earlier such sums give."""
    for equation in earlier:
        yield from recognized([equation], unknowns)
    for system, squared in zip(systems, sums, strict=True):
        yield from recognized([*system, *squared], unknowns)
    if len(systems) > 1:
        yield from recognized(tuple({e.expr: e for e in chain.from_iterable(systems)}.values()), unknowns)


# -- sums of angles in the task --------------------------------------------------------------------


class _Sum(Struct, frozen=True):
    """Σ given = Σ rate·q + rest, between values of the task and angles."""

    given: Mapping[str, Fraction]
    rates: Mapping[str, Fraction]
    rest: Expr

    def without(self, name: str, other: _Sum) -> _Sum:
        """The sum after a coordinate is taken from another one."""
        if name not in self.rates:
            return self
        factor = self.rates[name] / other.rates[name]
        return _Sum(
            _combined(self.given, other.given, factor),
            _combined(self.rates, other.rates, factor),
            self.rest - other.rest * factor,
        )

    def angle_of(self, name: str) -> Angle:
        """A coordinate as an angle of the values and of the others."""
        parts = [Angle.of(value, rate) for value, rate in self.given.items()]
        parts += [Angle.of(other, -rate) for other, rate in self.rates.items() if other != name]
        constant = _constant_angle(self.rest)
        assert constant is not None
        return sum(parts, -constant) * (1 / self.rates[name])

    def remainder(self, name: str, carry: Transfer) -> Remainder:
        """The coordinate from the values and from the others, in the ring of the search."""
        others = tuple((other, rate) for other, rate in self.rates.items() if other != name)
        return Remainder(name, self.rates[name], tuple(self.given.items()), others, carry(self.rest))

    def relation(self, value: str, carry: Transfer) -> Relation:
        """What a value must be, where no coordinate is left."""
        ring = carry.target
        others = (ring.symbol(name) * rate for name, rate in self.given.items() if name != value)
        return Relation(ring.symbol(value), sum((-e for e in others), carry(self.rest)), is_angle=True)


def _combined(
    one: Mapping[str, Fraction], other: Mapping[str, Fraction], factor: Fraction
) -> dict[str, Fraction]:
    found = {
        name: one.get(name, Fraction(0)) - factor * other.get(name, Fraction(0)) for name in {**one, **other}
    }
    return {name: rate for name, rate in found.items() if rate}


def _angle_sums(task: Matrix, values: Sequence[str]) -> tuple[dict[str, _Sum], dict[int, _Sum]]:
    """(the sum that gives each coordinate, none of the others in it; the components that are sums)

    A component whose coordinates all stand in others is left without any.
    """
    solved: dict[str, _Sum] = {}
    found: dict[int, _Sum] = {}
    for k, (entry, value) in enumerate(zip(task.entries, values, strict=True)):
        one = _angle_sum(entry, value)
        if one is None:
            continue
        for name, other in solved.items():
            one = one.without(name, other)
        found[k] = one
        within = [name for name in task.ring.names if name in one.rates]
        for last in sorted(within, key=lambda name: abs(one.rates[name]) == 1)[-1:]:  # not half an angle
            solved = {name: other.without(last, one) for name, other in solved.items()} | {last: one}
    return solved, found


def _angle_sum(entry: Expr, value: str) -> _Sum | None:
    """A component Σ rate·q + rest, the rest without coordinates."""
    ring = entry.ring
    rates: dict[str, Fraction] = {}
    rest = entry
    for name, kind in ring.coordinates:
        if kind != "revolute":
            continue
        rate = ring.coefficient(entry, name)
        if rate.is_zero:
            continue
        if not rate.is_number:
            return None
        rates[name] = rate.number
        rest = rest - ring.symbol(name) * rate
    if not rates or ring.depends_on_coordinates(rest) or _constant_angle(rest) is None:
        return None
    return _Sum({value: Fraction(1)}, rates, rest)


def _constant_angle(rest: Expr) -> Angle | None:
    """A sum of symbols as an angle; None for anything else."""
    found = Angle()
    for exponents, factor in rest.poly.to_dict().items():
        places = [k for k, exponent in enumerate(exponents) if exponent]
        generator = rest.ring.generators[places[0]] if len(places) == 1 else None
        if generator is None or generator.kind != "symbol" or sum(map(int, exponents)) > 1:
            return None
        rate = Fraction(int(factor.p), int(factor.q))
        found = found + (Angle((), 180 * rate) if generator.name == "pi" else Angle.of(generator.name, rate))
    return found


# When a branch gives r(q) = r back, where the task has more components than there are joints to move them

Values = Mapping[str, float]

_AWAY = 0.7
"""So far from values that are reached, or from their mirror images, others are taken; all are about 1."""

_AWAY_FROM_ROTATION = 0.15
"""The same for the entries of a rotation, of which others are then made."""

_STEP = 1e-5
_NEWTON_STEPS = 20
_ACCURATE = 1e-9


def with_conditions(solving: Solving, branches: Sequence[Branch]) -> tuple[Branch, ...]:
    """The branches, each with its conditions."""
    return tuple(replace(branch, when=_Conditions(solving, branch).found()) for branch in branches)


class _Conditions(Struct, frozen=True):
    """The conditions of one branch."""

    solving: Solving
    branch: Branch

    def found(self) -> tuple[Relation, ...]:
        """The simplest relations without coordinates, and the components that these do not bring about."""
        points = list(islice(self._points(), ENOUGH))
        solved = [at for at in points if self._solves(at)]
        chosen = self._independent(solved)
        places = [*points, *self._elsewhere((*self.solving.identities, *chosen), solved)]
        moving = self.solving.ring.depends_on_coordinates
        for has_coordinates in (False, True):
            missed = [
                one
                for one in self.solving.components
                if moving(one.right) == has_coordinates and not all(self._holds([one], at) for at in places)
            ]
            chosen += missed
            places = [at for at in places if self._holds(missed, at)]
        return tuple(chosen)

    def _points(self) -> Iterator[dict[str, float]]:
        """Values of the task and of the parameters, of samples, where the branch exists."""
        for state in islice(samples(self.solving.ring), MOST):
            given = {**state, **reach_of(self.solving, state)}
            if configuration(self.solving, self.branch, given) is not None:
                yield given

    def _solves(self, given: Values) -> bool:
        q = configuration(self.solving, self.branch, given)
        return q is not None and solves_task(self.solving, q, given)

    def _independent(self, points: Sequence[Values]) -> list[Relation]:
        """As many relations as there are conditions, of which each says what those before it do not."""
        chosen: list[Relation] = []
        taken = list(self.solving.identities)
        for one in self.solving.relations if points else ():
            if len(chosen) < self.solving.conditions and all(self._holds([one], at) for at in points):
                rows = self._gradients([*taken, one], points[0])
                if rank(rows, _STEP, scale=1.0) > rank(rows[:-1], _STEP, scale=1.0):
                    chosen.append(one)
                    taken.append(one)
        return chosen

    def _elsewhere(self, chosen: Sequence[Relation], points: Sequence[Values]) -> Iterator[Values]:
        """Values that no configuration was taken for, at which the branch exists and relations hold."""
        for at, sample in zip(points, numbered(), strict=False):
            for signs in ([1] * len(self.solving.values), self._signs(sample)):
                moved = {
                    name: sign * at[name] + sample.random.uniform(-self._away, self._away)
                    for name, sign in zip(self.solving.values, signs, strict=True)
                }
                found = self._met(chosen, {**at, **moved})
                if found is not None:
                    yield found

    @property
    def _away(self) -> float:
        return _AWAY_FROM_ROTATION if self.solving.identities else _AWAY

    def _signs(self, sample: Sample) -> list[int]:
        """Signs of the values of a mirror image; a rotation is turned by half turns, and stays one."""
        if not self.solving.identities:
            return [sample.side() for _ in self.solving.values]
        position = [sample.side() for _ in range(3)]
        rows, columns = ((a, b, a * b) for a, b in ((sample.side(), sample.side()) for _ in range(2)))
        return [*position, *(a * b for a in rows for b in columns)]

    def _met(self, chosen: Sequence[Relation], start: Values) -> Values | None:
        """Values at which relations between values hold, by Newton's method; None where it leads to none."""
        at = dict(start)
        for _ in range(_NEWTON_STEPS):
            off = _off(chosen, at)
            if max(map(abs, off), default=0.0) < _ACCURATE:
                break
            rows = self._gradients(chosen, at)
            for name, step in zip(self.solving.values, shortest_step(off, rows), strict=True):
                at[name] += step
        return at if self._holds(chosen, at) else None

    def _holds(self, chosen: Sequence[Relation], given: Values) -> bool:
        """Whether relations hold on the branch, which exists."""
        q = configuration(self.solving, self.branch, given)
        return q is not None and all(abs(value) < CLOSE for value in _off(chosen, q))

    def _gradients(self, chosen: Sequence[Relation], given: Values) -> list[list[float]]:
        """The derivatives of relations without coordinates by the values, a row for each relation."""
        columns = []
        for name in self.solving.values:
            ends = (_off(chosen, {**given, name: given[name] + step}) for step in (_STEP, -_STEP))
            columns.append([(a - b) / (2 * _STEP) for a, b in zip(*ends, strict=True)])
        return [list(row) for row in zip(*columns, strict=True)]


def _off(chosen: Sequence[Relation], values: Values) -> list[float]:
    """right - left of relations, of angles the shortest way round."""
    off = [evaluate(one.expr, values) for one in chosen]
    turns = [one.is_angle for one in chosen]
    return [(x + pi) % (2 * pi) - pi if turn else x for x, turn in zip(off, turns, strict=True)]
