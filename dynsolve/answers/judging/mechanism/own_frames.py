"""The robot in a student's own frames: what the answers after a table in other frames are judged by.

With B the student's frame 0 seen from the key's, and q' = ±q + c the student's coordinates,

    H_i(q) = B H'_i(q') X_i

for every link, with X_i constant: where the key's frame of the link is in the student's.  Bodies and
points are moved by X_i, gravity and forces are seen from the student's frame 0, and what is asked is put into
the student's coordinates.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.mechanism.own_places import (
    Counts,
    Displacement,
    NotExact,
    OwnPlaces,
    restated,
    restated_state,
    speaks_of_coordinates,
)
from dynsolve.answers.judging.mechanism.tables import COLUMNS, Agreement, Table, TableRow
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import Node, Symbol
from dynsolve.problem.model import Problem
from dynsolve.problem.questions_build import default_task
from dynsolve.robot.actions import with_values
from dynsolve.robot.model import Axes, AxesKind, Body, Joint, Robot
from dynsolve.robot.questions import Load, NamedPoint, Questions

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
        if any(motor.carrier for motor in key.actions.motors):
            raise NotExact  # the axis of the rotor is one of the key's frame
        place = Displacement(self.places.moved(key.base_rotation), self.places.moved(key.base_position))
        world = Displacement(Matrix.identity(self.ring, 3), Matrix.zero(self.ring, 3, 1))
        gravity = self.places.moved(key.gravity)
        seen = world.R
        if sense.keeps_world or self.places.base is None:
            world = place @ start
        else:
            seen = (place @ start).R.T
        own = replace(
            key,
            ring=self.ring,
            joints=tuple(self._joint(i, row) for i, row in enumerate(self.places.table, 1)),
            bodies=tuple(self._body(body, self.places.changes[body.link]) for body in key.bodies),
            gravity=seen @ gravity,
            actions=with_values(key.actions, self.places.moved_value),
            base_rotation=world.R,
            base_position=world.o,
            parameters=tuple(name for name in self.ring.parameters if name != "pi"),
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
