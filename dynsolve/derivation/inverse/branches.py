"""The sets of choices that solve the task: every solution is put into r(q), at points that samples reach.

An equation that was squared on the way may have solutions that the task has not.  A branch
is kept where it solves the task wherever it exists; all of them together must hold the
configuration that each point was made from.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice, product

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.floats import evaluate
from dynsolve.algebra.sampling import ENOUGH, samples
from dynsolve.derivation.inverse.solving import Relation, Solving
from dynsolve.derivation.reached import angle_rows, near, same_configuration

MOST = 8 * ENOUGH
"""So many samples are tried for a branch that exists at few of them, as where a3 > a1 + a2."""

Choice = tuple[int, ...]
"""Of each step of a solving which of its solutions is taken, from 0."""


@dataclass(frozen=True, slots=True)
class Branch:
    """One solution: `choice` says which value each step takes, `when` under which conditions it is one."""

    choice: Choice
    when: tuple[Relation, ...] = ()


def branches(solving: Solving) -> tuple[Branch, ...] | None:
    """The branches that solve the task; None where one is not found, or some solve it at some points only.

    Where there are conditions on the values, these may tell at which.
    """
    candidates = [Branch(choice) for choice in product(*(range(step.count) for step in solving.solved))]
    verdicts: dict[Branch, set[bool]] = {branch: set() for branch in candidates}
    enough = 3 * ENOUGH if solving.conditions > 0 else ENOUGH
    for number, state in enumerate(islice(samples(solving.ring), MOST)):
        if number >= enough and all(verdicts.values()):
            break
        reached = reach_of(solving, state)
        found = False
        for branch in candidates:
            q = configuration(solving, branch, {**state, **reached})
            if q is not None:
                solves = solves_task(solving, q, reached)
                verdicts[branch].add(solves)
                found = found or (solves and same_configuration(solving.ring, q, state))
        if not found:
            return None
    if solving.conditions <= 0 and any(len(seen) > 1 for seen in verdicts.values()):
        return None
    return tuple(branch for branch, seen in verdicts.items() if True in seen)


def reach_of(solving: Solving, state: Mapping[str, float]) -> dict[str, float]:
    """r(q) by the names of its values."""
    return {name: evaluate(e, state) for name, e in zip(solving.values, solving.task.entries, strict=True)}


def configuration(solving: Solving, branch: Branch, given: Mapping[str, float]) -> dict[str, float] | None:
    """q on a branch, with the parameters, at the `given` values of the task; None where it does not exist."""
    values = dict(given)

    def at(expr: Expr) -> float:
        return evaluate(expr, values)

    choice = iter(branch.choice)
    for part in solving.parts:
        for definition in part.definitions:
            values[definition.name] = at(definition.value)
        for step, index in zip(part.solved, choice, strict=False):
            found = step.values(at)
            if not found:
                return None
            values[step.coordinate] = found[index]
    return values


def solves_task(solving: Solving, q: Mapping[str, float], reached: Mapping[str, float]) -> bool:
    """Whether r(q) is what was asked for; angles modulo 2π."""
    mine = [evaluate(entry, q) for entry in solving.task.entries]
    return near(mine, [reached[name] for name in solving.values], angle_rows(solving.task))
