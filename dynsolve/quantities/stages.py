"""The stages of the derivation, in the order of the course: the one list of them."""

from __future__ import annotations

from enum import StrEnum


class Stage(StrEnum):
    """A part of the derivation; its value is what commands and files call it.

    >>> Stage.ENERGY, Stage("energy").heading, Stage.ENERGY == "energy"
    (<Stage.ENERGY: 'energy'>, 'Potential and kinetic energy', True)
    """

    heading: str
    """What stands over it in a report."""

    KINEMATICS = "kinematics", "Forward kinematics"
    JACOBIAN = "jacobian", "The Jacobian"
    INERTIA = "inertia", "The bodies: mass centres and inertia"
    ENERGY = "energy", "Potential and kinetic energy"
    LAGRANGIAN = "lagrangian", "The Lagrangian"
    TORQUE = "torque", "The Euler-Lagrange equations"
    VECTORIZED = "vectorized", "The vectorized form"

    def __new__(cls, value: str, heading: str = "") -> Stage:
        """The member of that value."""
        stage = str.__new__(cls, value)
        stage._value_ = value
        stage.heading = heading
        return stage

    @property
    def number(self) -> int:
        """Its place among the stages, from 1."""
        return list(Stage).index(self) + 1

    @property
    def needs_masses(self) -> bool:
        """Whether it is left out where no body has mass."""
        return self not in (Stage.KINEMATICS, Stage.JACOBIAN)
