"""A whole problem file as it was read, before anything is computed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from dynsolve.algebra.angles import Angle
from dynsolve.problem.actions import NO_ACTIONS, ParsedActions
from dynsolve.problem.base import ParsedBase
from dynsolve.problem.bodies import ParsedBody
from dynsolve.problem.cells import Cell
from dynsolve.problem.questions import ParsedQuestions
from dynsolve.problem.rotations import ParsedRotation
from dynsolve.problem.table import DHTable
from dynsolve.quantities.owners import Owners
from dynsolve.quantities.stages import ASKED_FOR
from dynsolve.robot.drawing.procedure import Normals
from dynsolve.robot.model import AxesKind, Convention, Coordinate, JointType

if TYPE_CHECKING:
    from dynsolve.problem.candidates import ParsedCandidates
    from dynsolve.problem.mechanism import ParsedModel


@dataclass(frozen=True, slots=True)
class ParsedFile:
    """The parts of a problem file that make a robot."""

    convention: Convention
    table: DHTable
    gravity: tuple[Cell, ...] | None
    base: ParsedBase
    bodies: tuple[ParsedBody, ...]
    questions: ParsedQuestions
    normals: Normals | None = None
    """Of a drawing, the normals that its table was made from."""
    actions: ParsedActions = NO_ACTIONS
    model: ParsedModel | None = None
    """In the place of a table and its bodies: a mechanism by positions, or given energies."""
    candidates: ParsedCandidates | None = None
    """Matrices to be judged, alone or beside a model, and what is assumed of their parameters."""

    @property
    def has_matrices(self) -> bool:
        """Whether there are matrices to be judged: candidates, or the D of a model."""
        if self.candidates is None:
            return False
        return bool(self.candidates.matrices) or (self.model is not None and self.model.D is not None)

    @property
    def is_of_matrices(self) -> bool:
        """Whether matrices stand in the place of a robot."""
        return self.candidates is not None and self.model is None and not self.table.rows

    @property
    def sound(self) -> bool:
        """Whether nothing of the table, its bodies or the model was reported."""
        if self.candidates is not None and self.candidates.faulty:
            return False
        if self.model is not None or self.is_of_matrices:
            return self.model is None or not self.model.faulty
        return self.table.sound and not any(body.faulty for body in self.bodies)

    @property
    def coordinates(self) -> tuple[Coordinate, ...]:
        """The generalized coordinates in their order."""
        return tuple(
            Coordinate(name, JointType(kind), index)
            for index, (name, kind) in enumerate(self.table.coordinates, 1)
        )

    @property
    def owners(self) -> Owners:
        """What the answers to this problem can belong to, whatever of it is asked for."""
        bodies = self.model.bodies if self.model else self.bodies
        return Owners(
            rows=len(self.table.rows),
            coordinates=self.coordinates,
            bodies=tuple(body.name for body in bodies),
            points=frozenset(body.name for body in bodies if body.is_point),
            named=self.questions.names,
            stages=frozenset(ASKED_FOR),
            is_twist=self.questions.task is not None and self.questions.task.is_twist,
            constraints=len(self.questions.constraints),
            rates=self.questions.rates,
            given=frozenset(
                name
                for name, there in (
                    ("mass", self.bodies or self.model),
                    ("linearize", self.questions.model.linearize),
                    ("references", True),
                )
                if there
            ),
            actions=self.actions.kinds,
            has_matrices=self.has_matrices,
            has_robot=not self.is_of_matrices,
        )

    @property
    def rotations(self) -> Iterator[ParsedRotation]:
        """Every rotation that is given."""
        if self.base.rotation:
            yield self.base.rotation
        for body in self.bodies:
            if body.axes and body.axes.rotation:
                yield body.axes.rotation
        yield from self.questions.rotations

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that may hold coordinates: d, and rotations given from the base."""
        for row in self.table.rows:
            if not row.faulty:
                yield row.cells["d"]
        for body in self.bodies:
            if body.axes and body.axes.kind is AxesKind.BASE and body.axes.rotation:
                yield from body.axes.rotation.entries
        if self.model:
            yield from self.model.moving
        if self.candidates:
            yield from self.candidates.moving
        yield from self.questions.moving
        yield from self.actions.moving

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        for row in self.table.rows:
            if not row.faulty:
                yield row.cells["a"]
        for body in self.bodies:
            yield from body.values
        if self.model:
            yield from self.model.constant
        if self.candidates:
            yield from self.candidates.constant
        yield from self.gravity or ()
        yield from self.base.move or ()
        if self.base.rotation:
            yield from self.base.rotation.entries
        yield from self.questions.constant
        yield from self.actions.constant

    @property
    def angles(self) -> Iterator[tuple[Cell, Angle]]:
        """Every angle that is turned by, with the cell it stands in."""
        for row in self.table.rows:
            if not row.faulty:
                yield from ((row.cells[column], angle) for column, angle in row.angles.items())
        for rotation in self.rotations:
            yield from ((turn.cell, turn.angle) for turn in rotation.turns)
        if self.model:
            yield from ((turn.cell, turn.angle) for turn in self.model.turns)

    @property
    def cells(self) -> Iterator[Cell]:
        """Every cell that was read."""
        for row in self.table.rows:
            yield from row.cells.values()
        for rotation in self.rotations:
            yield from rotation.cells
        for body in self.bodies:
            yield from body.values
        if self.model:
            yield from self.model.cells
        if self.candidates:
            yield from (*self.candidates.moving, *self.candidates.constant)
        yield from self.gravity or ()
        yield from self.base.move or ()
        yield from self.questions.constant
        yield from self.questions.moving
        yield from self.actions.constant
        yield from self.actions.moving
