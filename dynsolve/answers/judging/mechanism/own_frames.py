"""The robot in a student's own frames: what the answers after a table in other frames are judged by.

With B the student's frame 0 seen from the key's, and q' = ±q + c the student's coordinates,

    H_i(q) = B H'_i(q') X_i

for every link, with X_i constant: where the key's frame of the link is in the student's.  Bodies and
points are moved by X_i, gravity and forces are seen from the student's frame 0, and what is asked is put into
the student's coordinates.

Where the frames of a student's table are, seen from the key's: exactly, in a ring that holds both.

Numbers say where (`matching`); here each angle becomes a number of degrees, and each length a sum of
lengths of the two tables.

Formulas of an exercise in a student's coordinates: q = ±(q' - c) where the student counts q' = ±q + c.

A state is the other way round: where q has a value, q' has ± that value plus c.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import islice, product
from math import degrees, pi, remainder

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.matrix import Matrix, needed_angles
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, value_of, with_references
from dynsolve.answers.judging.mechanism.tables import (
    COLUMNS,
    Agreement,
    OwnCoordinate,
    Table,
    TableRow,
    key_table,
)
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Function,
    Negative,
    Node,
    Reference,
    Symbol,
    mapped,
    names_in,
)
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem.model import Problem
from dynsolve.problem.questions import default_task
from dynsolve.robot.geometry import Turn, absolute_angles, elementary
from dynsolve.robot.model import Axes, AxesKind, Body, Convention, Joint, JointType, Robot
from dynsolve.robot.questions import Load, NamedPoint, Questions, State

# Where the frames are

# Formulas of an exercise in a student's coordinates


class Count(Struct, frozen=True):
    """How a student counts a coordinate: q' = sense·q + shift."""

    sense: int
    shift: Node

    def of(self, value: Node) -> Node:
        """The student's coordinate where the key's has a value."""
        kept = value if self.sense > 0 else negated(value)
        return kept if self.shift == ZERO else total([kept, self.shift])

    def keys(self, own: Node) -> Node:
        """The key's coordinate in the student's."""
        moved = own if self.shift == ZERO else total([own, negated(self.shift)])
        return moved if self.sense > 0 else negated(moved)


Counts = Mapping[str, Count]
"""By the names of the coordinates, which both have; none of a coordinate that is the key's own."""


def restated(tree: Node, counts: Counts) -> Node:
    """A formula in the key's coordinates and rates, in the student's."""

    def change(node: Node) -> Node:
        if not isinstance(node, Symbol) or node.name not in counts:
            return node
        count = counts[node.name]
        if node.dots:
            return node if count.sense > 0 else negated(node)
        return count.keys(node)

    return mapped(tree, change) if counts else tree


def restated_state(state: State, counts: Counts) -> State:
    """The same state in the student's coordinates."""
    return State(tuple((name, dots, _value(counts, name, dots, v)) for name, dots, v in state.values))


def _value(counts: Counts, name: str, dots: int, value: Node) -> Node:
    count = counts.get(name)
    if count is None:
        return value
    return count.of(value) if not dots else Count(count.sense, ZERO).of(value)


def speaks_of_coordinates(questions: Questions, counts: Counts) -> bool:
    """Whether what is asked names coordinates that the student counts otherwise."""
    task = questions.task.entries if questions.task else ()
    return bool(names_in(*task) & counts.keys()) or bool(
        {name for name, _, _ in questions.state.values} & counts.keys()
    )


_Step = tuple[Angle, Expr, Expr, Angle]
"""θ, d, a, α of a row whose coordinates are at some place."""

_TOLERANCE = 1e-7
_HALF_TURN = Angle((), Fraction(180))


class NotExact(Exception):
    """How the student's frames lie is no number of degrees, or no sum of lengths of the tables."""


class Displacement(Struct, frozen=True):
    """A rigid motion: p -> R p + o."""

    R: Matrix
    o: Matrix

    def __matmul__(self, other: Displacement) -> Displacement:
        return Displacement(self.R @ other.R, self.R @ other.o + self.o)

    @property
    def inverse(self) -> Displacement:
        """The motion back."""
        return Displacement(self.R.T, -(self.R.T @ self.o))


class OwnPlaces:
    """How the frames of one table lie to those of the key's robot, and the ring that holds both."""

    def __init__(
        self, robot: Robot, table: Table, found: Agreement, letters: Sequence[Mapping[str, float]]
    ) -> None:
        self.key, self.table, self.found, self.letters = robot, table, found, letters
        self.modified = robot.convention is Convention.MODIFIED
        self.form = Compactor(robot.ring).form
        self.angles = [
            (angle_from_tree(row.constants[0]), angle_from_tree(row.constants[3])) for row in table
        ]
        self.moving = [i for i, row in enumerate(table) if row.variable is not None]
        self.counts = {q.name: self._count(q) for q in found.coordinates if not q.is_the_keys}
        self.ring = self._ring()

    # -- the ring ----------------------------------------------------------------------------------

    def _ring(self) -> Ring:
        key, names = self.key, [q.name for q in self.key.coordinates]
        coordinates = [(q.name, q.type.value) for q in key.coordinates]
        trees = [restated(self.form(value), self.counts) for value in self._key_values()]
        trees += [cell for row in self.table for cell in row.constants[1:3]]
        trees += [function for act in key.actions.acts for function in act.functions(key)]
        trees += [*map(Symbol, key.inputs), *self._asked_trees({}), *self._asked_trees(self.counts)]
        turns = [
            Turn(self.theta(i), alpha, row.variable == 0)
            for i, (row, (_, alpha)) in enumerate(zip(self.table, self.angles, strict=True))
        ]
        angles = [angle for joint in key.joints for angle in (joint.theta, joint.alpha)]
        angles += [angle for pair in self.angles for angle in pair]
        angles += [Angle((), Fraction(offset)) for offset in self._offsets()]
        preferred = absolute_angles(turns, names, self.modified)
        ring = build_ring(coordinates, trees, angles, preferred)
        states = [restated_state(key.questions.state, counts).by_symbol for counts in ({}, self.counts)]
        needed = [angle for state in states for angle in needed_angles(ring, state)]
        ring = build_ring(coordinates, trees, [*angles, *needed], preferred) if needed else ring
        references = key.ring.plan.references
        return with_references(ring, references) if references else ring

    def _key_values(self) -> Iterator[Expr]:
        """Everything of the key that the ring must hold, but the task."""
        key, asked = self.key, self.key.questions
        matrices = [key.gravity, key.base_rotation, key.base_position]
        for body in key.bodies:
            yield body.mass
            matrices += [body.center, body.axes.rotation]
            matrices += [m for m in (body.inertia, body.about_point) if m is not None]
        matrices += [point.position for point in asked.points]
        for load in asked.loads:
            matrices += [load.position, load.force, load.moment]
            matrices += [load.axes] if load.axes is not None else []
        matrices += [m for m in (asked.velocity, asked.acceleration) if m is not None]
        for matrix in matrices:
            yield from matrix.entries
        yield from (value for act in key.actions.acts for value in act.values)
        yield from (length for joint in key.joints for length in (joint.d, joint.a))

    def _asked_trees(self, counts: Counts) -> list[Node]:
        asked = self.key.questions
        entries = asked.task.entries if asked.task is not None else ()
        trees = [restated(entry, counts) for entry in entries]
        turning = {q.name for q in self.key.coordinates if q.type is JointType.REVOLUTE}
        for name, dots, value in restated_state(asked.state, counts).values:
            turns = name in turning
            trees.append(Function("cos", value) if turns and not dots else value)
        # what the ring holds in any case, the coordinates of points, is 0 here
        return [mapped(tree, lambda part: ZERO if isinstance(part, Reference) else part) for tree in trees]

    def _count(self, q: OwnCoordinate) -> Count:
        if q.is_length:
            return Count(q.sense, self._length(q.shifts))
        return Count(q.sense, _degrees_node(_degrees(q.offset)))

    def _offsets(self) -> Iterator[Fraction]:
        """The constant angles that the student's joints and frame 0 are turned by, in degrees."""
        yield from (self._turned(i) for i in self.moving if self.table[i].variable == 0)
        yield self._turn()

    def _turned(self, i: int) -> Fraction:
        """The student's θ in a row where the key's is 0, less what is constant in it, in degrees."""
        j = self.moving.index(i)
        found = {round(degrees(remainder(match.offsets[j], 2 * pi)), 6) for match in self.found.matches}
        if len({value % 360 for value in found}) != 1:
            raise NotExact
        return _degrees(found.pop())

    def theta(self, i: int) -> Angle:
        """θ of a row of the student's, from 0, in the student's coordinates."""
        row, (theta, _) = self.table[i], self.angles[i]
        if row.variable == 0:
            for k, rate in row.rates:
                theta = theta + Angle.of(self.key.coordinates[k].name, rate)
        return theta

    def value(self, tree: Node) -> Expr:
        """The value of a formula in this ring."""
        return value_of(self.ring, tree)

    def moved_value(self, value: Expr) -> Expr:
        """A value of the key in this ring, in the student's coordinates."""
        return self.value(restated(self.form(value), self.counts))

    def moved(self, matrix: Matrix) -> Matrix:
        """A matrix of the key in this ring, in the student's coordinates."""
        rows = ([restated(self.form(entry), self.counts) for entry in row] for row in matrix.rows)
        return Matrix.of(self.ring, ([self.value(tree) for tree in row] for row in rows))

    # -- the student's frames ----------------------------------------------------------------------

    def _turn(self) -> Fraction:
        """By how many degrees frame 0 is turned about the first axis."""
        turns = {round(degrees(match.turn), 6) for match in self.found.matches}
        if len(turns) != 1:
            raise NotExact
        return _degrees(turns.pop())

    @cached_property
    def base(self) -> Displacement | None:
        """The student's frame 0 seen from the key's; None where they are one."""
        match = self.found.matches[0]
        if self.modified and self.table[0].constants[2] != self.key.joints[0].written[2]:
            raise NotExact
        if any(abs(abs(m.base[2][2]) - 1) > _TOLERANCE for m in self.found.matches):
            raise NotExact  # z_0 is neither along the key's nor against it
        R = elementary(self.ring, "z", Angle((), self._turn()))
        if match.is_turned_over:
            R = R @ elementary(self.ring, "x", _HALF_TURN)
        way = [self._length([m.shift[axis] for m in self.found.matches]) for axis in range(3)]
        o = Matrix.column(self.ring, map(self.value, way))
        identity = Matrix.identity(self.ring, 3)
        return None if identity == R and o.is_zero else Displacement(R, o)

    @property
    def start(self) -> Displacement:
        """The student's frame 0 seen from the key's."""
        return self.base or Displacement(Matrix.identity(self.ring, 3), Matrix.zero(self.ring, 3, 1))

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

    @cached_property
    def changes(self) -> dict[int, Displacement]:
        """X_i for each row of the key's table, in the frame of the student's row of the same link."""
        mine = self._poses(
            [(self._theta_there(i), self._d_there(i), self.value(row.constants[2]), self.angles[i][1])
             for i, row in enumerate(self.table)]
        )  # fmt: skip
        return {
            i: (self.start @ mine[self.own_link(i)]).inverse @ self.keys[i]
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
            self.value(self.form(d)),
            self.value(self.form(joint.a)),
            joint.alpha,
        )

    def _theta_there(self, i: int) -> Angle:
        theta = self.angles[i][0]
        return theta + Angle((), self._turned(i)) if self.table[i].variable == 0 else theta

    def _d_there(self, i: int) -> Expr:
        d = self.table[i].constants[1]
        if self.table[i].variable == 1:
            j = self.moving.index(i)
            d = total([d, self._length([match.offsets[j] for match in self.found.matches])])
        return self.value(d)

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

    def own_link(self, row: int) -> int:
        """The student's row of the link that a row of the key belongs to: that of its last joint."""
        joints = sum(joint.variable is not None for joint in self.key.joints[:row])
        if row == len(self.key.joints):
            return len(self.table)
        moving = [i for i, mine in enumerate(self.table, 1) if mine.variable is not None]
        return moving[joints - 1] if joints else 0


def _degrees(value: float | None) -> Fraction:
    if value is None:
        raise NotExact
    found = Fraction(value).limit_denominator(60)
    if abs(float(found) - value) > 1e-5:
        raise NotExact
    return found


def _degrees_node(value: Fraction) -> Node:
    if not value:
        return ZERO
    node = Degrees(abs(value).numerator, value.denominator)
    return Negative(node) if value < 0 else node


# The robot in a student's own frames

MOST_SENSES = 6
"""In so many senses a hand-in is judged that is right in none."""


class Sense(Struct, frozen=True):
    """How an exercise is meant by who has other frames.

    `keeps_world`: positions are still seen from the exercise's world, not from the student's frame 0;
    `is_literal`: a task in q1 speaks of the student's own q1.
    """

    keeps_world: bool
    is_literal: bool


def in_own_frames(
    problem: Problem, table: Table, found: Agreement, letters: Sequence[Mapping[str, float]]
) -> Iterator[Problem]:
    """The problem with the student's table, in every sense; none where its frames lie in no exact way."""
    every = (own for way in (found, *found.others) for own in _in_one_way(problem, table, way, letters))
    yield from islice(every, MOST_SENSES)


def _in_one_way(
    problem: Problem, table: Table, found: Agreement, letters: Sequence[Mapping[str, float]]
) -> Iterator[Problem]:
    if len(found.coordinates) < problem.robot.n:
        return
    try:
        own = _Own(OwnPlaces(problem.robot, table, found, letters))
        for sense in own.senses():
            yield replace(problem, robot=own.robot(sense), normals=None)
    except (NotExact, AlgebraError):
        return


class _Own:
    """The key's robot in the frames of one table."""

    def __init__(self, places: OwnPlaces) -> None:
        self.places, self.key, self.ring = places, places.key, places.ring

    def senses(self) -> Iterator[Sense]:
        """The senses in which the exercise differs, the likeliest first."""
        has_base = self.places.base is not None
        names = speaks_of_coordinates(self.key.questions, self.places.counts)
        for is_literal in (False, True)[: 1 + names]:
            for keeps_world in (False, True)[: 1 + has_base]:
                yield Sense(keeps_world, is_literal)

    def robot(self, sense: Sense) -> Robot:
        """The robot in the student's frames."""
        key, start = self.key, self.places.start
        if any(rotor.carrier for rotor in key.actions.rotors):
            raise NotExact  # the axis of the rotor is one of the key's frame
        place = Displacement(self.places.moved(key.base_rotation), self.places.moved(key.base_position))
        world = Displacement(Matrix.identity(self.ring, 3), Matrix.zero(self.ring, 3, 1))
        gravity = self.places.moved(key.gravity)
        seen = world.R
        if sense.keeps_world or self.places.base is None:
            world = place @ start
        else:
            seen = (place @ start).R.T
        moved = self.places.moved_value
        own = replace(
            key,
            ring=self.ring,
            joints=tuple(self._joint(i, row) for i, row in enumerate(self.places.table, 1)),
            bodies=tuple(self._body(body, self.places.changes[body.link]) for body in key.bodies),
            gravity=seen @ gravity,
            actions=replace(key.actions, acts=tuple(act.with_values(moved) for act in key.actions.acts)),
            base_rotation=world.R,
            base_position=world.o,
            parameters=tuple(name for name in self.ring.parameters if name not in ("pi", *self.key.inputs)),
        )
        return replace(
            own, questions=self._questions(own, seen, {} if sense.is_literal else self.places.counts)
        )

    def _questions(self, own: Robot, seen: Matrix, counts: Counts) -> Questions:
        """What is asked, of the robot in the student's frames; `seen` turns the exercise's world to it."""
        asked = self.key.questions
        task = asked.task
        if task is not None:
            entries = tuple(restated(entry, counts) for entry in task.entries)
            task = default_task(own) if task.is_default else replace(task, entries=entries)
        return replace(
            asked,
            points=tuple(self._point(point) for point in asked.points),
            task=task,
            loads=tuple(self._load(load, seen) for load in asked.loads),
            state=restated_state(asked.state, counts),
            velocity=None if asked.velocity is None else self.places.moved(asked.velocity),
            acceleration=None if asked.acceleration is None else self.places.moved(asked.acceleration),
        )

    def _point(self, point: NamedPoint) -> NamedPoint:
        place = _put(self.places.changes[point.link], self.places.moved(point.position))
        axes = None if point.axes is None else self.places.own_link(point.axes)
        return replace(point, link=self.places.own_link(point.link), position=place, axes=axes)

    def _load(self, load: Load, seen: Matrix) -> Load:
        change = self.places.changes[load.link]
        force, moment, axes = self.places.moved(load.force), self.places.moved(load.moment), load.axes
        if axes is None:
            force, moment = seen @ force, seen @ moment
        return replace(
            load,
            link=self.places.own_link(load.link),
            position=_put(change, self.places.moved(load.position)),
            force=force,
            moment=moment,
            axes=None if axes is None else change.R @ self.places.moved(axes),
        )

    def _joint(self, index: int, row: TableRow) -> Joint:
        theta, alpha = self.places.theta(index - 1), self.places.angles[index - 1][1]
        d, moving = row.constants[1], [] if row.variable is None else [_variable(self.key, row)]
        written = list(row.constants)
        if row.variable is not None:
            written[row.variable] = total([*moving, written[row.variable]])
        trees = (written[0], written[1] if row.variable == 1 else d, written[2], written[3])
        return Joint(
            index=index,
            theta=theta,
            d=self.places.value(trees[1]),
            a=self.places.value(trees[2]),
            alpha=alpha,
            variable=None if row.variable is None else COLUMNS[row.variable],
            rates=row.rates,
            written=trees,
        )

    def _body(self, body: Body, change: Displacement) -> Body:
        rotation, kind = self.places.moved(body.axes.rotation), AxesKind.LINK
        if body.axes.kind is AxesKind.REST:
            rotation = self.places.keys[body.link].R.T @ rotation
        if body.axes.kind is AxesKind.BASE:
            rotation, kind = self.places.start.R.T @ rotation, AxesKind.BASE
        else:
            rotation = change.R @ rotation
        return replace(
            body,
            link=self.places.own_link(body.link),
            mass=self.places.value(self.places.form(body.mass)),
            center=_put(change, self.places.moved(body.center)),
            axes=Axes(kind, rotation, body.axes.written),
            inertia=None if body.inertia is None else self.places.moved(body.inertia),
            about_point=None
            if body.about_point is None
            else _put(change, self.places.moved(body.about_point)),
            shape=None,
        )


def _variable(robot: Robot, row: TableRow) -> Node:
    """What moves in a row: its coordinates, starred, with their rates."""
    return total([times(rate, [(Symbol(robot.coordinates[k].name, star=True), 1)]) for k, rate in row.rates])


def _put(change: Displacement, point: Matrix) -> Matrix:
    return change.R @ point + change.o
