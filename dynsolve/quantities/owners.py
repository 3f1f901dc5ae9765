"""What a robot's quantities belong to, and which families of them it has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from dynsolve.quantities import constraint_families, kinematic_families, model_families
from dynsolve.quantities.family import Family, Owner, Size
from dynsolve.quantities.robot_stages import asked_stages, given_rates
from dynsolve.quantities.stages import OF_THE_MODEL, Stage
from dynsolve.robot.model import Coordinate, Robot
from dynsolve.robot.questions import component_names

MOST_INDEXED = 9
"""Entries have names up to this index: d_111 could be two of them."""


_FROM_RATES = {kinematic_families.QD: "velocity", kinematic_families.QDD: "acceleration"}
"""What is asked of the joints, and the rate of the task that it belongs to."""

_FROM_GIVEN = {
    model_families.LINEAR_A: "linearize",
    model_families.LINEAR_B: "linearize",
    model_families.Y_REFERENCE: "references",
    constraint_families.REDUCED: "mass",
}
"""What is asked of the model, and what must be given for it: an equilibrium, reference rates."""


@dataclass(frozen=True, slots=True)
class Owners:
    """The owners of a robot's quantities: rows of its table, coordinates, bodies and points by name, forces.

    `points` are the bodies without inertia, `named` the points that the exercise names.
    `stages` are those of which something is asked, `task_rows` the components of the task, and
    `task_names` what else each of them is called where the task is a function r(q), which a twist is
    not.  `rates` says whether its velocity, and its acceleration, is given; `given` whether there is
    `mass`, and what of `_FROM_GIVEN` there is; `actions` what acts beside gravity: friction, springs,
    motors.  `has_matrices` says that there are matrices to be judged, and without `has_robot` there is
    nothing else.
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
    is_twist: bool = False
    constraints: int = 0
    rates: frozenset[str] = frozenset()
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
            task_names=component_names(asked.task) if asked.task else (),
            is_twist=asked.task is not None and asked.task.is_twist,
            constraints=len(asked.constraints),
            rates=given_rates(asked),
            given=frozenset(
                name
                for name, there in (
                    ("mass", robot.has_dynamics),
                    ("linearize", asked.model.linearize),
                    ("references", robot.ring.plan.references),
                )
                if there
            ),
            actions=robot.actions.kinds,
            has_matrices=bool(asked.candidates),
            has_robot=robot.has_table or robot.has_dynamics,
        )

    def has(self, family: Family) -> bool:
        """Whether there are quantities of a family: those of the course, and of what is asked."""
        if family.stage is Stage.CONSTRAINTS and not self.constraints:
            return False
        if self.is_twist and family in (kinematic_families.R, kinematic_families.R_ENTRY):
            return False
        if family.brought_by and family.brought_by not in self.actions:
            return False
        if family in _FROM_RATES and _FROM_RATES[family] not in self.rates:
            return False
        if family.stage in OF_THE_MODEL and "mass" not in self.given:
            return False
        if family in _FROM_GIVEN and _FROM_GIVEN[family] not in self.given:
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
