"""What a robot's quantities belong to, and which families of them it has.

The stages of one robot: those of the course that belong to it, and those of which something is asked.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import product

from msgspec import Struct

from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.family import Family, Owner, Size
from dynsolve.quantities.stages import OF_A_TASK, Stage
from dynsolve.robot.model import Coordinate, Robot
from dynsolve.robot.questions import Method, Questions, component_names

# The stages of one robot

_OF_LAGRANGE = frozenset({Stage.JACOBIAN, Stage.INERTIA, Stage.ENERGY, Stage.LAGRANGIAN, Stage.TORQUE})
"""The stages that lead from the mass centres to τ by the Lagrangian; the recursions need none of them."""


def heading_of(stage: Stage, robot: Robot) -> str:
    """The heading of a stage in the solution of a robot: that of a question may say what is asked of it."""
    own = getattr(stage.part(), "heading", None)
    return own(robot.questions) if own else stage.heading


def asked_stages(questions: Questions) -> frozenset[Stage]:
    """The stages of which an exercise asks something."""
    found = set(_stages_of_names(questions.asked))
    if questions.given & {"velocity", "acceleration"}:
        found.add(Stage.RATES)
    if questions.points or questions.task or any(OF_A_TASK in stage.needs for stage in found):
        found.add(Stage.TASK)
    if questions.is_drawn:
        found.add(Stage.FRAMES)
    if questions.constraints:
        found.add(Stage.CONSTRAINTS)
    if questions.loads:
        found.add(Stage.STATICS)
    if questions.method is Method.NEWTON_EULER:
        found.add(Stage.NEWTON_EULER)
    return frozenset(found)


@lru_cache(maxsize=64)
def _stages_of_names(asked: frozenset[str]) -> frozenset[Stage]:
    """The stages, beside those of the course, that these quantities are derived in."""
    return frozenset(
        family.stage for family in FAMILIES if family.stage.asked_for and any(map(family.names, asked))
    )


def stages_of(robot: Robot) -> tuple[Stage, ...]:
    """The stages of a robot's solution that are told, in their order."""
    passed_over = _OF_LAGRANGE if robot.questions.method is Method.NEWTON_EULER else frozenset()
    return tuple(stage for stage in derived_stages(robot) if stage not in passed_over)


def derived_stages(robot: Robot) -> tuple[Stage, ...]:
    """The stages that a robot's results belong to, also those that another method passes over."""
    asked = asked_stages(robot.questions)
    return tuple(stage for stage in Stage if (stage in asked if stage.asked_for else _belongs(stage, robot)))


def _belongs(stage: Stage, robot: Robot) -> bool:
    """Whether a stage of the course belongs to a robot: to one without masses or a table not all do."""
    if stage.needs_table:
        return robot.has_table
    return bool(robot.bodies) if stage.needs_bodies else robot.has_dynamics


MOST_INDEXED = 9
"""Entries have names up to this index: d_111 could be two of them."""


class Owners(Struct, frozen=True):
    """The owners of a robot's quantities: rows of its table, coordinates, bodies and points by name, forces.

    `points` are the bodies without inertia, `named` the points that the exercise names.
    `stages` are those of which something is asked, `task_rows` the components of the task, and
    `task_names` what else each of them is called where the task is a function r(q), which a twist is
    not.  `given` is what families may need (`Family.needs`): `mass`, a task that is a `function` r(q), its
    `velocity` or `acceleration`, an equilibrium to `linearize` at, `references`; `actions` what acts beside
    gravity, by its results `Ps`, `Km` and `friction`.  `has_matrices` says that there are matrices to be
    judged, and without `has_robot` there is nothing else.
    """

    rows: int
    coordinates: tuple[Coordinate, ...]
    bodies: tuple[str, ...]
    points: frozenset[str] = frozenset()
    named: tuple[str, ...] = ()
    stages: frozenset[Stage] = frozenset()
    loads: int = 0
    task_rows: int = 0
    task_names: tuple[tuple[str, ...], ...] = ()
    constraints: int = 0
    given: frozenset[str] = frozenset()
    actions: frozenset[str] = frozenset()
    has_matrices: bool = False
    has_robot: bool = True

    @staticmethod
    def of(robot: Robot) -> Owners:
        """Those of a robot."""
        bodies = tuple(body.name for body in robot.bodies)
        points = frozenset(body.name for body in robot.bodies if body.is_point)
        asked = robot.questions
        return Owners(
            rows=len(robot.joints),
            coordinates=robot.coordinates,
            bodies=bodies,
            points=points,
            named=tuple(point.name for point in asked.points),
            stages=asked_stages(asked),
            loads=len(asked.loads),
            task_rows=asked.task.rows if asked.task else 0,
            task_names=component_names(asked),
            constraints=len(asked.constraints),
            given=asked.given
            | frozenset(
                name
                for name, there in (
                    ("function", asked.task is None or not asked.task.is_twist),
                    ("mass", robot.has_dynamics),
                    ("references", robot.ring.plan.references),
                )
                if there
            ),
            actions=robot.actions.terms,
            has_matrices=bool(asked.candidates),
            has_robot=robot.has_table or robot.has_dynamics,
        )

    def has(self, family: Family) -> bool:
        """Whether there are quantities of a family: those of the course, and of what is asked."""
        if family.stage is Stage.CONSTRAINTS and not self.constraints:
            return False
        if family.brought_by and family.brought_by not in self.actions:
            return False
        if family.stage.asked_for and family.stage.needs_masses and "mass" not in self.given:
            return False
        if family.needs and family.needs not in self.given:
            return False
        if not self.rows and family.stage.needs_table:
            return False
        if not (self.has_matrices if family.stage is Stage.DEFINITE else self.has_robot):
            return False
        return not family.stage.asked_for or family.stage in self.stages

    def size(self, size: Size) -> int:
        """Rows or columns in numbers."""
        sizes = {"n": len(self.coordinates), "m": self.task_rows, "c": self.constraints, "any": 0}
        return sizes[size] if isinstance(size, str) else size

    def indices(self, owner: Owner) -> Iterator[tuple[int, ...]]:
        """The index of every owner of a kind, from 1."""
        count = {
            Owner.ROW: self.rows,
            Owner.BODY: len(self.bodies),
            Owner.COORDINATE: len(self.coordinates),
            Owner.POINT: len(self.named),
            Owner.LOAD: self.loads,
            Owner.TASK: len(self.task_names),
            Owner.CONSTRAINT: self.constraints,
        }
        if owner in count:
            return ((i,) for i in range(1, count[owner] + 1))
        repeat = {Owner.ROBOT: 0, Owner.PAIR: 2, Owner.TRIPLE: 3}[owner]
        return product(range(1, min(len(self.coordinates), MOST_INDEXED) + 1), repeat=repeat)

    def template_values(self, owner: Owner, index: tuple[int, ...]) -> dict[str, str]:
        """The values of the fields in a family's templates; see `dynsolve.quantities.family`."""
        match owner:
            case Owner.ROW | Owner.LOAD | Owner.TASK | Owner.CONSTRAINT:
                return {"i": str(index[0])}
            case Owner.BODY:
                return {"b": self.bodies[index[0] - 1]}
            case Owner.POINT:
                return {"p": self.named[index[0] - 1]}
            case Owner.COORDINATE:
                q = self.coordinates[index[0] - 1]
                return {"i": str(q.index), "force": q.force}
        return dict(zip("ijk", map(str, index), strict=False))
