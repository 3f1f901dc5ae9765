"""Given orientations R_b of bodies that do not turn with their links: harmless or a fault.

A problem file may give R_b as a function of the coordinates.  The frame of a rigid body
turns with its link; one that does not is accepted where the kinetic energy is the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from dynsolve.errors import Finding, ProblemError
from dynsolve.problem import Problem
from dynsolve.robot.geometry import rotation_along
from dynsolve.robot.model import AxesKind, Body, Convention, Robot

if TYPE_CHECKING:
    from dynsolve.derivation.graph import Derivation


def check_axes(problem: Problem, values: Derivation | None = None) -> tuple[Finding, ...]:
    """Warnings about given R_b that do not turn with their links.

    `values` is the robot's derivation, if it is at hand.  Raises ProblemError where the
    kinetic energy would come out wrong.
    """
    robot = problem.robot
    warnings, faults = [], []
    for place, body in enumerate(robot.bodies):
        if body.axes.kind is not AxesKind.BASE or _turns_with_link(robot, body):
            continue
        path = ("masses", place, "axes")
        what = f"the given rotation of body {body.name} does not turn with link {body.link}"
        if _agree(robot, body, values):
            message = f"{what}; it is used as given, since the kinetic energy comes out the same"
            help = "write `axes: base` for a frame that turns"
            warnings.append(problem.finding(path, message, help, "axes-fixed"))
        else:
            message = f"{what}, and the kinetic energy would come out wrong"
            help = (
                "a body's frame turns with its link: `axes: base` is parallel to frame 0 at q = 0 and turns"
            )
            faults.append(problem.finding(path, message, help, "axes-fixed"))
    if faults:
        raise ProblemError(faults)
    return tuple(warnings)


def _turns_with_link(robot: Robot, body: Body) -> bool:
    modified = robot.convention is Convention.MODIFIED
    turned = rotation_along(robot.ring, robot.path(body.link), modified=modified)
    return not any(map(robot.ring.depends_on_coordinates, (turned.T @ body.axes.rotation).entries))


def _agree(robot: Robot, body: Body, values: Derivation | None) -> bool:
    """Whether the kinetic energy is the same all the same; only what asks it imports the derivation."""
    from dynsolve.derivation.euler_lagrange import given_axes_agree
    from dynsolve.derivation.rules import derive

    return given_axes_agree(robot, body, derive(robot) if values is None else values)
