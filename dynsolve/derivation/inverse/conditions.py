"""When a branch gives r(q) = r back, where the task has more components than there are joints to move them.

Of the relations between the values so many are conditions as there are directions in which no joint
moves the values, found from derivatives at points that are reached.  They are put to the test
at points where another solution is the right one, and at values that no configuration was taken for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi
from random import Random

from dynsolve.algebra.floats import evaluate
from dynsolve.derivation.elimination import rank, shortest_step
from dynsolve.derivation.inverse.branches import (
    Branch,
    configuration,
    random_state,
    reach_of,
    solves_task,
)
from dynsolve.derivation.inverse.solving import Relation, Solving
from dynsolve.derivation.reached import CLOSE

Values = Mapping[str, float]

POINTS = 48
"""So many random configurations are tried."""

_AWAY = 0.7
"""So far from values that are reached, or from their mirror images, others are taken; all are about 1."""

_STEP = 1e-5
_NEWTON_STEPS = 20
_ACCURATE = 1e-9


def with_conditions(solving: Solving, branches: Sequence[Branch]) -> tuple[Branch, ...] | None:
    """The branches, each with its conditions; None where none are found that are enough."""
    found = [_Conditions(solving, branch).found() for branch in branches]
    if any(when is None for when in found):
        return None
    return tuple(replace(b, when=when) for b, when in zip(branches, found, strict=True) if when is not None)


@dataclass(frozen=True, slots=True)
class _Conditions:
    """The conditions of one branch."""

    solving: Solving
    branch: Branch

    def found(self) -> tuple[Relation, ...] | None:
        """The simplest that are enough; None where there are none."""
        points = list(self._points())
        solved = [at for at in points if self._solves(at)]
        known = [one for one in self.solving.relations if all(self._holds([one], at) for at in solved)]
        chosen = self._independent(known, solved)
        if chosen is None:
            return None
        identities = self.solving.identities
        while (missed := self._missed((*identities, *chosen), points)) is not None:
            other = next((one for one in known if not self._holds([one], missed)), None)
            if other is None:
                return None
            chosen.append(other)
        return tuple(chosen)

    def _points(self) -> Iterator[dict[str, float]]:
        """Values of the task and of the parameters, of random configurations, where the branch exists."""
        random = Random(1981)  # noqa: S311  (test points, the same in every run)
        for _ in range(POINTS):
            state = random_state(self.solving, random)
            given = {**state, **reach_of(self.solving, state)}
            if configuration(self.solving, self.branch, given) is not None:
                yield given

    def _solves(self, given: Values) -> bool:
        q = configuration(self.solving, self.branch, given)
        return q is not None and solves_task(self.solving, q, given)

    def _independent(self, known: Sequence[Relation], points: Sequence[Values]) -> list[Relation] | None:
        """As many relations as there are conditions, each of which says what those before it do not."""
        chosen: list[Relation] = []
        taken = list(self.solving.identities)
        at = next((at for at in points if self._gradients(known, at) is not None), None)
        if at is None:
            return None
        for one in known:
            if len(chosen) == self.solving.conditions:
                break
            rows = self._gradients([*taken, one], at)
            if rows is not None and rank(rows, _STEP, scale=1.0) > len(taken):
                chosen.append(one)
                taken.append(one)
        return chosen if len(chosen) == self.solving.conditions else None

    def _missed(self, chosen: Sequence[Relation], points: Sequence[Values]) -> Values | None:
        """Values at which the conditions hold, and the branch is no solution; None where there are none."""
        random = Random(1977)  # noqa: S311  (test points, the same in every run)
        for at in points:
            away, across = (
                {name: sign() * at[name] + random.uniform(-_AWAY, _AWAY) for name in self.solving.values}
                for sign in (lambda: 1, lambda: random.choice((1, -1)))
            )
            for values in (at, self._met(chosen, {**at, **away}), self._met(chosen, {**at, **across})):
                if values is not None and self._holds(chosen, values) and not self._solves(values):
                    return values
        return None

    def _met(self, chosen: Sequence[Relation], start: Values) -> Values | None:
        """Values at which conditions hold, by Newton's method; None where it leads to none."""
        at = dict(start)
        for _ in range(_NEWTON_STEPS):
            off = self._off(chosen, at)
            if off is None or max(map(abs, off), default=0.0) < _ACCURATE:
                break
            rows = self._gradients(chosen, at)
            if rows is None:
                return None
            for name, step in zip(self.solving.values, shortest_step(off, rows), strict=True):
                at[name] += step
        return at if self._holds(chosen, at) else None

    def _holds(self, chosen: Sequence[Relation], given: Values) -> bool:
        off = self._off(chosen, given)
        return off is not None and all(abs(value) < CLOSE for value in off)

    def _off(self, chosen: Sequence[Relation], given: Values) -> list[float] | None:
        """right - left of relations on the branch; None where it does not exist."""
        q = configuration(self.solving, self.branch, given)
        if q is None:
            return None
        off = [evaluate(one.expr, q) for one in chosen]
        turns = [one.is_angle for one in chosen]
        return [(x + pi) % (2 * pi) - pi if turn else x for x, turn in zip(off, turns, strict=True)]

    def _gradients(self, chosen: Sequence[Relation], given: Values) -> list[list[float]] | None:
        """The derivatives of relations by the values of the task, a row for each relation."""
        columns = []
        for name in self.solving.values:
            ends = [self._off(chosen, {**given, name: given[name] + step}) for step in (_STEP, -_STEP)]
            if ends[0] is None or ends[1] is None:
                return None
            columns.append([(a - b) / (2 * _STEP) for a, b in zip(*ends, strict=True)])
        return [list(row) for row in zip(*columns, strict=True)]
