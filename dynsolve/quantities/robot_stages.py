"""The stages of one robot: those of the course that belong to it, and those of which something is asked."""

from __future__ import annotations

from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Method, Questions

_OF_LAGRANGE = frozenset({Stage.JACOBIAN, Stage.INERTIA, Stage.ENERGY, Stage.LAGRANGIAN, Stage.TORQUE})
"""The stages that lead from the mass centres to τ by the Lagrangian; the recursions need none of them."""

_OF_THE_TASK = {Stage.SINGULAR, Stage.INVERSE, Stage.RATES, Stage.TASK_INERTIA}
"""The stages that go on from the task."""


_PARTS = {
    "equilibria": "equilibria",
    "balance": "balance",
    "linear_A": "linearization",
    "linear_B": "linearization",
}
"""What the stage of equilibria finds, by what is asked for."""


def heading_of(stage: Stage, robot: Robot) -> str:
    """The heading of a stage in the solution of a robot: of some what is asked of them."""

    def asks(name: str) -> bool:
        return any(asked.startswith(name) for asked in robot.questions.asked)

    if stage is Stage.STATICS and not asks("tau_static"):
        return "Forces from outside"
    if stage is Stage.RATES and robot.questions.acceleration is None and not asks("qdd"):
        return "Rates of the joints"
    asked = [part for name, part in _PARTS.items() if name in robot.questions.asked]
    if stage is not Stage.EQUILIBRIA or not asked:
        return stage.heading
    return " and ".join(dict.fromkeys(asked)).capitalize()


def given_rates(questions: Questions) -> frozenset[str]:
    """Which rates of the task an exercise gives."""
    given = {"velocity": questions.velocity, "acceleration": questions.acceleration}
    return frozenset(name for name, value in given.items() if value is not None)


def asked_stages(questions: Questions) -> frozenset[Stage]:
    """The stages of which an exercise asks something."""
    asked_for = [family for family in FAMILIES if family.stage.asked_for] if questions.asked else ()
    found = {family.stage for family in asked_for if any(map(family.names, questions.asked))}
    if given_rates(questions):
        found.add(Stage.RATES)
    if questions.points or questions.task or found & _OF_THE_TASK:
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
