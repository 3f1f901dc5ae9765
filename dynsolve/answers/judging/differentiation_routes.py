"""Velocities and Jacobians by differentiating, beside the geometric way: v = ṙ_c, J_v = ∂r_c/∂q."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.route import Route
from dynsolve.derivation import kinematics
from dynsolve.derivation.mechanism import position_jacobian
from dynsolve.quantities import families, kinematic_families
from dynsolve.quantities.index import Quantity
from dynsolve.robot.model import Robot


def differentiation_routes(robot: Robot, quantity: Quantity) -> Iterator[Route]:
    """The routes to a velocity or a Jacobian of a point in the world's axes from where the point is."""
    owner = quantity.rule.removeprefix(quantity.family.name.partition("{")[0])
    match quantity.family:
        case families.JV_BODY:
            yield Route((f"rc{owner}",), partial(position_jacobian, robot))
        case families.V:
            yield Route((f"rc{owner}",), _rate)
        case families.JV:
            tip = f"H{len(robot.joints)}"
            yield Route((tip,), lambda H: position_jacobian(robot, kinematics.origin(H)))
        case kinematic_families.JV_POINT if _is_in_world(robot, owner):
            yield Route((f"p{owner}",), partial(position_jacobian, robot))
        case kinematic_families.V_POINT if _is_in_world(robot, owner):
            yield Route((f"p{owner}",), _rate)


def _rate(position: Matrix) -> Matrix:
    return position.map(position.ring.time_derivative)


def _is_in_world(robot: Robot, name: str) -> bool:
    """Whether the velocity of a named point is wanted along the axes in which its position is given."""
    return any(point.name == name and point.axes is None for point in robot.questions.points)
