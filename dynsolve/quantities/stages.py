"""The stages of a solution, in the order of the textbook: the one list of them."""

from __future__ import annotations

from enum import StrEnum
from importlib import import_module
from importlib.util import find_spec
from typing import Any


class Stage(StrEnum):
    """A part of a solution; its value is what commands and files call it.

    The stages of the course belong to every robot; those that are `asked_for` to a robot
    of which a file asks something of theirs.

    >>> Stage.ENERGY, Stage("energy").heading, Stage.ENERGY == "energy"
    (<Stage.ENERGY: 'energy'>, 'Potential and kinetic energy', True)
    """

    heading: str
    """What stands over it in a report."""

    asked_for: bool
    """Whether only a robot has it of which something of it is asked."""

    FRAMES = "frames", "Frames from the drawing", True
    KINEMATICS = "kinematics", "Forward kinematics"
    JACOBIAN = "jacobian", "The Jacobian"
    TASK = "task", "Points and tasks", True
    SINGULAR = "singular", "Singular configurations", True
    INVERSE = "inverse", "Inverse kinematics", True
    RATES = "rates", "Rates and accelerations of the joints", True
    INERTIA = "inertia", "The bodies: mass centres and inertia"
    ENERGY = "energy", "Potential and kinetic energy"
    LAGRANGIAN = "lagrangian", "The Lagrangian"
    TORQUE = "torque", "The Euler-Lagrange equations"
    NEWTON_EULER = "newton_euler", "The Newton-Euler recursions", True
    VECTORIZED = "vectorized", "The matrix form"
    PARAMETERS = "parameters", "Linear in the parameters", True
    CONSTRAINTS = "constraints", "Constraints", True
    EQUILIBRIA = "equilibria", "Equilibria and linearization", True
    FORWARD_DYNAMICS = "forward_dynamics", "Forward dynamics", True
    TASK_INERTIA = "task_inertia", "Inertia as the task meets it", True
    DEFINITE = "definite", "Inertia matrices: symmetric, positive definite", True
    STATICS = "statics", "Statics", True

    def __new__(cls, value: str, heading: str = "", asked_for: bool = False) -> Stage:
        """The member of that value."""
        stage = str.__new__(cls, value)
        stage._value_ = value
        stage.heading = heading
        stage.asked_for = asked_for
        return stage

    def part(self, file: str = "") -> Any:
        """A file of the folder `questions/<value>`, or the folder itself, imported when it is asked for.

        None where there is none.  This is how rooms below and beside the questions reach them: by path, so
        that a question that nobody asks costs nothing, and nobody has a list of them.

        >>> Stage.SINGULAR.part("derive").__name__
        'dynsolve.questions.singular.derive'
        """
        name = ".".join(filter(None, ("dynsolve.questions", self, file)))
        return import_module(name) if self.asked_for and find_spec(name) is not None else None

    @property
    def needs_masses(self) -> bool:
        """Whether it is left out where no body has mass."""
        return self in _OF_MASSES

    @property
    def needs_bodies(self) -> bool:
        """Whether it speaks of bodies, and is left out where a model is given without them."""
        return self is Stage.INERTIA

    @property
    def needs_table(self) -> bool:
        """Whether it speaks of frames and joints, and is left out of a model without a table."""
        return self in _OF_A_TABLE


OF_THE_MODEL = frozenset({Stage.PARAMETERS, Stage.EQUILIBRIA, Stage.FORWARD_DYNAMICS, Stage.TASK_INERTIA})
"""The stages that go on from the equations of motion."""

_OF_MASSES = OF_THE_MODEL | {
    Stage.INERTIA, Stage.ENERGY, Stage.LAGRANGIAN, Stage.TORQUE, Stage.VECTORIZED,
}  # fmt: skip

_OF_A_TABLE = frozenset({
    Stage.FRAMES, Stage.KINEMATICS, Stage.JACOBIAN, Stage.TASK, Stage.SINGULAR, Stage.INVERSE, Stage.RATES,
    Stage.STATICS, Stage.NEWTON_EULER, Stage.TASK_INERTIA,
})  # fmt: skip

COURSE = tuple(stage for stage in Stage if not stage.asked_for)
"""The stages of the course's derivation, which every robot with masses has."""

ASKED_FOR = tuple(stage for stage in Stage if stage.asked_for)
"""The stages that only a robot has of which something of them is asked."""
