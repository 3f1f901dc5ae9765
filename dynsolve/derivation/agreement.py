"""The exact comparison of two ways to the same quantity.

D, C q̇ and g are read off from τ, and assembled directly: D from the Jacobians, C from
the Christoffel symbols, g from the potential energy.
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import energy
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.link_frame import quadratic_energy
from dynsolve.robot.model import AxesKind, Body, Robot


@dataclass(frozen=True, slots=True)
class Agreement:
    """Whether the two ways to D, C q̇ and g give the same, and whether Ḋ - 2C is skew-symmetric."""

    inertia: bool
    coriolis: bool
    gravity: bool
    skew_symmetric: bool

    @property
    def holds(self) -> bool:
        """Whether all of these hold."""
        return self.inertia and self.coriolis and self.gravity and self.skew_symmetric


def agreement(robot: Robot, values: Derivation) -> Agreement:
    """Compare what is read off from τ with what is assembled directly."""
    rates = energy.velocities(robot)
    C: Matrix = values["C"]
    skew = values["D"].map(robot.ring.time_derivative) - C.scale(robot.ring.constant(2))
    return Agreement(
        inertia=values["D"] == values["D_direct"],
        coriolis=C @ rates == values["Cqd"],
        gravity=values["g"] == values["g_direct"],
        skew_symmetric=(skew + skew.T).is_zero,
    )


def given_axes_agree(robot: Robot, body: Body, values: Derivation) -> bool:
    """Whether a given R_b that does not turn with its link gives the same kinetic energy all the same.

    Compares the textbook's K_ω, with R_b as given, with that of the frame which coincides
    with it at q = 0 and turns with the link.
    """
    if body.axes.kind is not AxesKind.BASE or body.is_point:
        return True
    w, tensor = values[f"w{body.name}"], values[f"I{body.name}"]
    return energy.rotational_energy(w, tensor) == quadratic_energy(robot, values[f"Dw{body.name}"])
