"""Checks that a person can do on a finished model, each found by the program and proved before it is said.

    conserved     how the energy changes, the momentum of a coordinate that does not appear in L, and the
                  coordinates on which D cannot depend
    definite      D is positive definite, by its diagonal and its determinants or body by body, or singular
    determinant   the determinant of two coupled coordinates, line by line; what makes D diagonal; signs
    equilibrium   that g is zero in every pose, or in none; the joints that gravity does not load
    poses         D in poses of right angles, and without the moments of inertia of the bodies

Of longer arms those are done that read off a result what its pages hide: a coordinate that is
cyclic, on what D depends, entries of g that are zero.

To add one, write a file with a function that gives its step, or None where it has nothing to
say, and name it below.
"""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.explain.context import Context
from dynsolve.explain.sanity.conserved import conserved_step, dependence_step, momenta_step
from dynsolve.explain.sanity.definite import definite_step
from dynsolve.explain.sanity.determinant import decoupled_step
from dynsolve.explain.sanity.equilibrium import equilibrium_step, unloaded_step
from dynsolve.explain.sanity.poses import inertia_poses_step, point_masses_step
from dynsolve.explain.step import Detail, Step

CHECKS = (
    conserved_step,
    definite_step,
    decoupled_step,
    inertia_poses_step,
    equilibrium_step,
    point_masses_step,
)
"""What makes the steps of the checks of short arms, in the order in which they are shown."""

CHECKS_OF_LONGER_ARMS = (momenta_step, dependence_step, unloaded_step)
"""Those of longer arms."""


def sanity_steps(context: Context) -> Iterator[Step]:
    """The checks that speak of a robot."""
    for check in CHECKS if context.is_short else CHECKS_OF_LONGER_ARMS:
        step = check(context)
        if step is not None and step.id not in context.wanted:  # that is a question's
            yield replace(step, detail=Detail.FULL)
