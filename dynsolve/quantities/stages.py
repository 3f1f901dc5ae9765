"""The stages of a solution, in the order of the textbook: the one list of them."""

from __future__ import annotations

from enum import StrEnum
from importlib import import_module
from importlib.util import find_spec
from typing import Any

ASKED, OF_MASSES, OF_A_TABLE, OF_A_TASK = "asked", "masses", "table", "task"
"""What a stage needs: to be asked for, bodies with mass, a table of frames and joints, the task before it."""


class Stage(StrEnum):
    """A part of a solution; its value is what commands and files call it, then its heading and what it needs.

    The stages of the course belong to every robot; those that are `asked_for` to a robot
    of which a file asks something of theirs.

    >>> Stage.ENERGY, Stage("energy").heading, Stage.ENERGY == "energy"
    (<Stage.ENERGY: 'energy'>, 'Potential and kinetic energy', True)
    """

    heading: str
    """What stands over it in a report."""

    needs: frozenset[str]
    """What it is left out without."""

    FRAMES = "frames", "Frames from the drawing", ASKED, OF_A_TABLE
    KINEMATICS = "kinematics", "Forward kinematics", OF_A_TABLE
    JACOBIAN = "jacobian", "The Jacobian", OF_A_TABLE
    TASK = "task", "Points and tasks", ASKED, OF_A_TABLE
    SINGULAR = "singular", "Singular configurations", ASKED, OF_A_TABLE, OF_A_TASK
    INVERSE = "inverse", "Inverse kinematics", ASKED, OF_A_TABLE, OF_A_TASK
    RATES = "rates", "Rates and accelerations of the joints", ASKED, OF_A_TABLE, OF_A_TASK
    INERTIA = "inertia", "The bodies: mass centres and inertia", OF_MASSES
    ENERGY = "energy", "Potential and kinetic energy", OF_MASSES
    LAGRANGIAN = "lagrangian", "The Lagrangian", OF_MASSES
    TORQUE = "torque", "The Euler-Lagrange equations", OF_MASSES
    NEWTON_EULER = "newton_euler", "The Newton-Euler recursions", ASKED, OF_A_TABLE
    VECTORIZED = "vectorized", "The matrix form", OF_MASSES
    PARAMETERS = "parameters", "Linear in the parameters", ASKED, OF_MASSES
    STATICS = "statics", "Statics", ASKED, OF_A_TABLE
    CONSTRAINTS = "constraints", "Constraints", ASKED
    EQUILIBRIA = "equilibria", "Equilibria and linearization", ASKED, OF_MASSES
    FORWARD_DYNAMICS = "forward_dynamics", "Forward dynamics", ASKED, OF_MASSES
    TASK_INERTIA = "task_inertia", "Inertia as the task meets it", ASKED, OF_MASSES, OF_A_TABLE, OF_A_TASK
    DEFINITE = "definite", "Inertia matrices: symmetric, positive definite", ASKED

    def __new__(cls, value: str, heading: str = "", *needs: str) -> Stage:
        """The member of that value."""
        stage = str.__new__(cls, value)
        stage._value_ = value
        stage.heading = heading
        stage.needs = frozenset(needs)
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
    def asked_for(self) -> bool:
        """Whether only a robot has it of which something of it is asked."""
        return ASKED in self.needs

    @property
    def needs_masses(self) -> bool:
        """Whether it is left out where no body has mass."""
        return OF_MASSES in self.needs

    @property
    def needs_bodies(self) -> bool:
        """Whether it speaks of bodies, and is left out where a model is given without them."""
        return self is Stage.INERTIA

    @property
    def needs_table(self) -> bool:
        """Whether it speaks of frames and joints, and is left out of a model without a table."""
        return OF_A_TABLE in self.needs


COURSE = tuple(stage for stage in Stage if not stage.asked_for)
"""The stages of the course's derivation, which every robot with masses has."""

ASKED_FOR = tuple(stage for stage in Stage if stage.asked_for)
"""The stages that only a robot has of which something of them is asked."""
