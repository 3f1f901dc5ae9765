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
say, and a record of it below.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.explain.context import Context
from dynsolve.explain.sanity.conserved import conserved_step, dependence_step, momenta_step
from dynsolve.explain.sanity.definite import definite_step
from dynsolve.explain.sanity.determinant import decoupled_step
from dynsolve.explain.sanity.equilibrium import equilibrium_step, unloaded_step
from dynsolve.explain.sanity.poses import inertia_poses_step, point_masses_step
from dynsolve.explain.step import Detail, Step


class Check(Struct, frozen=True):
    """A check by its step's id, the condition under which it speaks, and what makes the step."""

    id: str
    speaks_where: str
    step: Callable[[Context], Step | None]


CHECKS = (
    Check("conserved", "the model follows from energies, or a coordinate is cyclic", conserved_step),
    Check("definite", "D is seen to be definite for positive masses, or always singular", definite_step),
    Check("decoupled", "a relation between parameters makes D diagonal", decoupled_step),
    Check("inertia_poses", "a moment of inertia varies with one or two joint angles", inertia_poses_step),
    Check("equilibrium", "gravity is balanced everywhere, or nowhere", equilibrium_step),
    Check("point_masses", "a body has extent, and D is something without it", point_masses_step),
)
"""All checks of short arms, in the order in which they are shown."""

CHECKS_OF_LONGER_ARMS = (
    Check("conserved", "a coordinate stands neither in K nor in P", momenta_step),
    Check("dependence", "each coordinate moves its own joint, in a chain", dependence_step),
    Check("unloaded", "an axis is vertical, or a joint slides level", unloaded_step),
)
"""Those of longer arms."""


def sanity_steps(context: Context) -> Iterator[Step]:
    """The checks that speak of a robot."""
    for check in CHECKS if context.is_short else CHECKS_OF_LONGER_ARMS:
        step = check.step(context)
        if step is not None:
            yield replace(step, detail=Detail.FULL)
