"""The robot in a student's own frames: what the answers after a table in other frames are judged by.

With B the student's frame 0 seen from the key's, and q' = ±q + c the student's coordinates,

    H_i(q) = B H'_i(q') X_i

for every link, with X_i constant: where the key's frame of the link is in the student's.  Bodies and
points are moved by X_i, and gravity is seen from the student's frame 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import product
from math import atan2, degrees

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.build import build_ring
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.answers.judging.mechanism.comparison import Agreement
from dynsolve.answers.judging.mechanism.tables import COLUMNS, Table, TableRow, key_table
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem.model import Problem
from dynsolve.robot.geometry import elementary
from dynsolve.robot.model import Axes, AxesKind, Body, Convention, Joint, Robot
from dynsolve.robot.parallel import Turn, absolute_angles

_Step = tuple[Angle, Expr, Expr, Angle]
"""θ, d, a, α of a row whose coordinates are at some place."""

_TOLERANCE = 1e-7
_HALF_TURN = Angle((), Fraction(180))


class NotExact(Exception):
    """How the student's frames lie is no number of degrees, or no sum of lengths of the tables."""


@dataclass(frozen=True, slots=True)
class Displacement:
    """A rigid motion: p -> R p + o."""

    R: Matrix
    o: Matrix

    def __matmul__(self, other: Displacement) -> Displacement:
        return Displacement(self.R @ other.R, self.R @ other.o + self.o)

    @property
    def inverse(self) -> Displacement:
        """The motion back."""
        return Displacement(self.R.T, -(self.R.T @ self.o))


def in_own_frames(
    problem: Problem, table: Table, found: Agreement, letters: Sequence[Mapping[str, float]]
) -> Problem | None:
    """The problem with the student's table; None where its frames are the key's, or lie in no exact way."""
    robot = problem.robot
    if any(body.axes.kind is AxesKind.BASE for body in robot.bodies) or robot.questions.task is not None:
        return None
    if any(len(row.rates) > 1 for row in table) or len(found.coordinates) < robot.n:
        return None
    try:
        own = _Own(robot, table, found, letters).robot()
    except (NotExact, AlgebraError):
        return None
    return replace(problem, robot=own, normals=None)


class _Own:
    """One table, with the key's robot moved into a ring that holds both."""

    def __init__(
        self, robot: Robot, table: Table, found: Agreement, letters: Sequence[Mapping[str, float]]
    ) -> None:
        self.key, self.table, self.found, self.letters = robot, table, found, letters
        self.modified = robot.convention is Convention.MODIFIED
        self.form = Compactor(robot.ring).form
        self.angles = [
            (angle_from_tree(row.constants[0]), angle_from_tree(row.constants[3])) for row in table
        ]
        self.ring = self._ring()

    def robot(self) -> Robot:
        """The robot in the student's frames."""
        base = self._base()
        same = base is None
        joints = tuple(self._joint(i, row) for i, row in enumerate(self.table, 1))
        rotation = self._moved(self.key.base_rotation)
        gravity = self._moved(self.key.gravity)
        position = self._moved(self.key.base_position)
        if base is not None:
            gravity = (rotation @ base.R).T @ gravity
            rotation, position = Matrix.identity(self.ring, 3), Matrix.zero(self.ring, 3, 1)
        start = Displacement(Matrix.identity(self.ring, 3), Matrix.zero(self.ring, 3, 1)) if same else base
        assert start is not None
        changes = self._changes(start)
        points = tuple(
            replace(
                point,
                link=self._own_link(point.link),
                position=_put(changes[point.link], self._moved(point.position)),
            )
            for point in self.key.questions.points
        )
        return replace(
            self.key,
            ring=self.ring,
            joints=joints,
            bodies=tuple(self._body(body, changes[body.link]) for body in self.key.bodies),
            gravity=gravity,
            base_rotation=rotation,
            base_position=position,
            parameters=tuple(name for name in self.ring.parameters if name != "pi"),
            questions=replace(self.key.questions, points=points),
        )

    # -- the ring ----------------------------------------------------------------------------------

    def _ring(self) -> Ring:
        key, names = self.key, [q.name for q in self.key.coordinates]
        coordinates = [(q.name, q.type.value) for q in key.coordinates]
        values: list[Expr] = [
            entry for m in (key.gravity, key.base_rotation, key.base_position) for entry in m.entries
        ]
        for body in key.bodies:
            values += [body.mass, *body.center.entries, *body.axes.rotation.entries]
            values += body.inertia.entries if body.inertia else ()
            values += body.about_point.entries if body.about_point else ()
        for point in key.questions.points:
            values += point.position.entries
        values += [length for joint in key.joints for length in (joint.d, joint.a)]
        trees = [self.form(value) for value in values]
        trees += [cell for row in self.table for cell in row.constants[1:3]]
        turns = [
            Turn(self._theta(i), alpha, row.variable == 0)
            for i, (row, (_, alpha)) in enumerate(zip(self.table, self.angles, strict=True))
        ]
        angles = [angle for joint in key.joints for angle in (joint.theta, joint.alpha)]
        angles += [angle for pair in self.angles for angle in pair]
        angles += [Angle((), Fraction(offset)) for offset in self._offsets()]
        return build_ring(coordinates, trees, angles, absolute_angles(turns, names, self.modified))

    def _offsets(self) -> Iterator[Fraction]:
        """The constant angles that the student's coordinates and frame 0 are turned by, in degrees."""
        yield from (
            _degrees(q.offset) for q in self.found.coordinates if not q.is_length and q.offset is not None
        )
        yield self._turn()

    def _theta(self, i: int) -> Angle:
        row, (theta, _) = self.table[i], self.angles[i]
        if row.variable != 0:
            return theta
        ((k, rate),) = row.rates
        return theta + Angle.of(self.key.coordinates[k].name, rate)

    def _value(self, tree: Node) -> Expr:
        return value_of(self.ring, tree)

    def _moved(self, matrix: Matrix) -> Matrix:
        """A matrix of the key in this ring."""
        return Matrix.of(self.ring, ([self._value(self.form(entry)) for entry in row] for row in matrix.rows))

    # -- the student's frames ----------------------------------------------------------------------

    def _joint(self, index: int, row: TableRow) -> Joint:
        theta, alpha = self._theta(index - 1), self.angles[index - 1][1]
        d, moving = row.constants[1], [] if row.variable is None else [_variable(self.key, row)]
        written = list(row.constants)
        if row.variable is not None:
            written[row.variable] = total([*moving, written[row.variable]])
        trees = (written[0], written[1] if row.variable == 1 else d, written[2], written[3])
        return Joint(
            index=index,
            theta=theta,
            d=self._value(trees[1]),
            a=self._value(trees[2]),
            alpha=alpha,
            variable=None if row.variable is None else COLUMNS[row.variable],
            rates=row.rates,
            written=trees,
        )

    def _turn(self) -> Fraction:
        """By how many degrees frame 0 is turned about the first axis."""
        turns = {round(degrees(atan2(match.base[1][0], match.base[0][0])), 6) for match in self.found.matches}
        if len(turns) != 1:
            raise NotExact
        return _degrees(turns.pop())

    def _base(self) -> Displacement | None:
        """The student's frame 0 seen from the key's; None where they are one."""
        match = self.found.matches[0]
        if self.modified and (self.table[0].constants[2:] != self._first_of_key()):
            raise NotExact
        turn = self._turn()
        R = elementary(self.ring, "z", Angle((), turn))
        if match.base[2][2] < 0:
            R = R @ elementary(self.ring, "x", _HALF_TURN)
        way = [self._length([m.shift[axis] for m in self.found.matches]) for axis in range(3)]
        o = Matrix.column(self.ring, map(self._value, way))
        identity = Matrix.identity(self.ring, 3)
        return None if identity == R and o.is_zero else Displacement(R, o)

    def _first_of_key(self) -> tuple[Node, ...]:
        return tuple(self.key.joints[0].written[2:])

    def _length(self, values: Sequence[float]) -> Node:
        """The sum of lengths of the tables that has these values at the draws of the letters."""
        known: dict[Node, list[float]] = {}
        for cell in self._lengths():
            known.setdefault(cell, [float(evaluate(cell, letters)) for letters in self.letters])
        for (a, mine), (b, theirs) in product([(None, [0.0] * len(values)), *known.items()], repeat=2):
            for m, n in product((1, -1), repeat=2):
                sums = [m * x + n * y for x, y in zip(mine, theirs, strict=True)]
                if all(abs(s - v) < _TOLERANCE for s, v in zip(sums, values, strict=True)):
                    parts = [(m, a), (n, b)]
                    return total([times(sign, [(node, 1)]) for sign, node in parts if node is not None])
        raise NotExact

    def _lengths(self) -> Iterator[Node]:
        for row in (*key_table(self.key), *self.table):
            yield from row.constants[1:3]

    # -- where the key's frames are in the student's -----------------------------------------------

    def _changes(self, base: Displacement) -> dict[int, Displacement]:
        """X_i for each row of the key's table, in the frame of the student's row of the same link."""
        mine = self._poses(
            [(self._theta_there(i), self._d_there(i), self._value(row.constants[2]), self.angles[i][1])
             for i, row in enumerate(self.table)]
        )  # fmt: skip
        return {
            i: (base @ mine[self._own_link(i)]).inverse @ self.keys[i]
            for i in range(1, len(self.key.joints) + 1)
        }

    @cached_property
    def keys(self) -> list[Displacement]:
        """The key's frames at q = 0, seen from its frame 0."""
        return self._poses([self._at_rest(joint) for joint in self.key.joints])

    def _at_rest(self, joint: Joint) -> _Step:
        names = {q.name for q in self.key.coordinates}
        terms = tuple((atom, rate) for atom, rate in joint.theta.terms if not names & {n for n, _ in atom})
        d = self.key.ring.at_rest(joint.d)
        return (
            Angle(terms, joint.theta.degrees),
            self._value(self.form(d)),
            self._value(self.form(joint.a)),
            joint.alpha,
        )

    def _theta_there(self, i: int) -> Angle:
        row, theta = self.table[i], self.angles[i][0]
        if row.variable != 0:
            return theta
        ((k, rate),) = row.rates
        offset = next(q.offset for q in self.found.coordinates if q.name == self.key.coordinates[k].name)
        if offset is None:
            raise NotExact
        return theta + Angle((), _degrees(offset)) * rate

    def _d_there(self, i: int) -> Expr:
        row = self.table[i]
        d = row.constants[1]
        if row.variable == 1:
            moving = [
                j for j, other in enumerate(r for r in self.table if r.variable is not None) if other is row
            ]
            offsets = [match.offsets[moving[0]] for match in self.found.matches]
            d = total([d, self._length(offsets)])
        return self._value(d)

    def _poses(self, rows: Sequence[_Step]) -> list[Displacement]:
        """Frame 0, 1, ... of constant rows, seen from frame 0."""
        ring = self.ring
        poses = [Displacement(Matrix.identity(ring, 3), Matrix.zero(ring, 3, 1))]
        for theta, d, a, alpha in rows:
            about_z = Displacement(
                elementary(ring, "z", theta), Matrix.column(ring, (ring.zero, ring.zero, d))
            )
            about_x = Displacement(
                elementary(ring, "x", alpha), Matrix.column(ring, (a, ring.zero, ring.zero))
            )
            step = about_x @ about_z if self.modified else about_z @ about_x
            poses.append(poses[-1] @ step)
        return poses

    def _own_link(self, row: int) -> int:
        """The student's row of the link that a row of the key belongs to: that of its last joint."""
        joints = sum(joint.variable is not None for joint in self.key.joints[:row])
        if row == len(self.key.joints):
            return len(self.table)
        moving = [i for i, mine in enumerate(self.table, 1) if mine.variable is not None]
        return moving[joints - 1] if joints else 0

    def _body(self, body: Body, change: Displacement) -> Body:
        rotation = self._moved(body.axes.rotation)
        if body.axes.kind is AxesKind.REST:
            rotation = self.keys[body.link].R.T @ rotation
        return replace(
            body,
            link=self._own_link(body.link),
            mass=self._value(self.form(body.mass)),
            center=_put(change, self._moved(body.center)),
            axes=Axes(AxesKind.LINK, change.R @ rotation, body.axes.written),
            inertia=None if body.inertia is None else self._moved(body.inertia),
            about_point=None if body.about_point is None else _put(change, self._moved(body.about_point)),
            shape=None,
        )


def _variable(robot: Robot, row: TableRow) -> Node:
    ((k, rate),) = row.rates
    symbol = Symbol(robot.coordinates[k].name, star=True)
    return symbol if rate == 1 else negated(symbol) if rate == -1 else times(rate, [(symbol, 1)])


def _put(change: Displacement, point: Matrix) -> Matrix:
    return change.R @ point + change.o


def _degrees(value: float | None) -> Fraction:
    """A number of degrees that a table may have."""
    if value is None:
        raise NotExact
    found = Fraction(value).limit_denominator(60)
    if abs(float(found) - value) > 1e-5:
        raise NotExact
    return found
