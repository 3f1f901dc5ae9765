"""Where the steps of springs and rotors are imported: only of robots on which something acts."""

from __future__ import annotations

from dynsolve.explain.context import Context
from dynsolve.explain.step import Step


def acting_steps(context: Context) -> tuple[list[Step], list[Step]]:
    """The step of the springs and that of the rotors, where there are any."""
    if not context.robot.actions:
        return [], []
    from dynsolve.explain.actions import rotor_steps, spring_steps

    return list(spring_steps(context)), list(rotor_steps(context))
