"""How a task is solved, as data: the steps in their order, and the names that are given on the way."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.derivation.inverse.subproblems import Solved


@dataclass(frozen=True, slots=True)
class Definition:
    """A name for what is known before the steps of its part: x_c = x - d6 r13."""

    name: str
    value: Expr


@dataclass(frozen=True, slots=True)
class Relation:
    """left = right between values of the task and known coordinates; an angle is meant modulo 2π."""

    left: Expr
    right: Expr
    is_angle: bool = False

    @property
    def expr(self) -> Expr:
        """right - left, which is 0."""
        return self.right - self.left


@dataclass(frozen=True, slots=True)
class Turn:
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


@dataclass(frozen=True, slots=True)
class FixedPoint:
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


@dataclass(frozen=True, slots=True)
class Part:
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


@dataclass(frozen=True, slots=True)
class Solving:
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
