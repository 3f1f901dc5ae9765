"""When a branch gives r(q) = r back, where the task has more components than there are joints to move them.

Relations between the values are conditions, as many as there are directions in which no joint moves the
values, found from derivatives at points that are reached.  Where these do not bring about a component
of r(q) = r, that is a condition too, with the coordinates of the branch in it: seen at points where another
solution is the right one, and at values that no configuration was taken for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import pi

from dynsolve.algebra.floats import evaluate
from dynsolve.algebra.sampling import ENOUGH, Sample, numbered, samples
from dynsolve.derivation.elimination import rank, shortest_step
from dynsolve.derivation.inverse.branches import MOST, Branch, configuration, reach_of, solves_task
from dynsolve.derivation.inverse.solving import Relation, Solving
from dynsolve.derivation.reached import CLOSE

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


@dataclass(frozen=True, slots=True)
class _Conditions:
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
