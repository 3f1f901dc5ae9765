"""How a task is solved, as data: the steps in their order, and the names that are given on the way.

The sets of choices that solve the task: every solution is put into r(q), at points that samples reach.

An equation that was squared on the way may have solutions that the task has not.  A branch
is kept where it solves the task wherever it exists; all of them together must hold the
configuration that each point was made from.

Equations between values of the task that hold at every configuration, from what a search has made.

A component that no joint moves has one value; the tip of a single joint is on a circle.  Such relations
are among the equations of the search, and two equations for one angle leave one (c² + s² = 1).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from itertools import chain, islice, product

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import ENOUGH, samples
from dynsolve.derivation.reached import angle_rows, near, same_configuration
from dynsolve.questions.inverse.equations import Equation
from dynsolve.questions.inverse.subproblems import Solved, TwoLines


class Definition(Struct, frozen=True):
    """A name for what is known before the steps of its part: x_c = x - d6 r13."""

    name: str
    value: Expr


class Relation(Struct, frozen=True, dict=True):
    """left = right between values of the task and known coordinates; an angle is meant modulo 2π."""

    left: Expr
    right: Expr
    is_angle: bool = False

    @cached_property
    def expr(self) -> Expr:
        """right - left, which is 0."""
        return self.right - self.left


class Turn(Struct, frozen=True):
    """The pose that is left for joints `first`..`last` (from 1) when the others are taken off.

    `names` are their coordinates, `known` (4×4) the entries of the pose as the steps have them,
    `made` (4×4) the product of the motions of these joints.  `definitions` are those of the entries
    that are needed; `is_wrist` says that these are three joints that turn about axes through one point.
    """

    first: int
    last: int
    names: tuple[str, ...]
    known: Matrix
    made: Matrix
    is_wrist: bool
    definitions: tuple[Definition, ...]


class FixedPoint(Struct, frozen=True):
    """A point on the axes of joints `first`..`last`, which these do not move.

    `known` (3×1) are its coordinates as the steps have them, `made` (3×1) what the other joints
    make of them.  `from_hand` says that it is fixed in the base and seen from the hand; else it is
    fixed in the hand and seen from the base.  Without such joints (`last` before `first`) it is
    the origin of the last frame.
    """

    first: int
    last: int
    known: Matrix
    made: Matrix
    definitions: tuple[Definition, ...]
    from_hand: bool = False


class Part(Struct, frozen=True):
    """Steps that are taken from the same equations, with what is known for them by name.

    `parallel` are joints (numbers from 1) with parallel axes, where the equations are those that do
    not notice them.
    """

    solved: tuple[Solved, ...]
    turn: Turn | None = None
    point: FixedPoint | None = None
    parallel: tuple[int, ...] = ()

    @property
    def definitions(self) -> tuple[Definition, ...]:
        """The names, each behind those that stand in its value."""
        return tuple(d for told in (self.turn, self.point) if told for d in told.definitions)


class Solving(Struct, frozen=True):
    """The unknowns in the order in which they are solved for.

    `ring` is that of the steps; `task` is r(q) as it was given, `values` are the names of its
    components, `angles` those of them that are sums of angles.  `free` coordinates do not
    occur in it.  `components` are those of the task as far as steps give no coordinate by them alone,
    `relations` what holds between values at every configuration, the simplest first; `identities`
    hold for the values of any arm, as between the entries of a rotation.
    """

    ring: Ring
    task: Matrix
    values: tuple[str, ...]
    angles: frozenset[str]
    parts: tuple[Part, ...]
    free: tuple[str, ...]
    components: tuple[Relation, ...] = ()
    relations: tuple[Relation, ...] = ()
    identities: tuple[Relation, ...] = ()

    @property
    def conditions(self) -> int:
        """How many conditions the values of the task must meet that no joint brings about."""
        return len(self.values) - len(self.solved) - len(self.identities)

    @property
    def solved(self) -> tuple[Solved, ...]:
        """The steps of all parts."""
        return tuple(step for part in self.parts for step in part.solved)


# The sets of choices that solve the task

MOST = 8 * ENOUGH
"""So many samples are tried for a branch that exists at few of them, as where a3 > a1 + a2."""

Choice = tuple[int, ...]
"""Of each step of a solving which of its solutions is taken, from 0."""


class Branch(Struct, frozen=True):
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


# Equations between values of the task that hold at every configuration, from what a search has made

MOST_TERMS = 200
"""Longer relations help no reader, and are not looked at."""

MOST_RELATIONS = 100
"""So many are looked at."""

_LARGEST_LINES = 20
"""Two equations with more terms are not squared."""


def relations(steps: Iterable[Solved], equations: Iterable[Equation]) -> tuple[Relation, ...]:
    """What holds between the values of the task at every configuration, the shortest first."""
    found: dict[Expr, Relation] = {}
    made = list(equations)
    first = {e.right: e.left for e in reversed(made)}
    twice = (Relation(e.left, first[e.right]) for e in made if e.left != first[e.right])
    for one in chain((Relation(e.left, e.right) for e in made), twice, _of_lines(steps)):
        is_free = not one.left.ring.depends_on_coordinates(one.expr)
        if is_free and len(one.expr) <= MOST_TERMS and not one.expr.is_zero and -one.expr not in found:
            found.setdefault(one.expr, one)
    return tuple(sorted(found.values(), key=length)[:MOST_RELATIONS])


def length(one: Relation) -> int:
    """What a relation costs its reader."""
    return len(one.left) + len(one.right)


def _of_lines(steps: Iterable[Solved]) -> Iterator[Relation]:
    """c² + s² = 1 of two equations for one angle."""
    for step in steps:
        if isinstance(step, TwoLines) and step.size <= _LARGEST_LINES:
            (a, b, x), (c, d, y) = step.first, step.second
            if step.is_rotation:
                yield Relation(x * x + y * y, a * a + b * b)
            else:
                sine, cosine, below = a * y - c * x, d * x - b * y, step.determinant
                yield Relation(sine * sine + cosine * cosine, below * below)
