"""A robot with numbers for some of its parameters: a robot like any other."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from dynsolve.algebra.ring_plan import rational_value
from dynsolve.notation.tree import Degrees, Node, Number, Parenthesized, Symbol, number
from dynsolve.robot.model import Body, Joint, Robot
from dynsolve.solution.numbers.substitution import Replacements, Substitution, replaced


def robot_with(robot: Robot, values: Replacements) -> Robot:
    """The robot with these values for its parameters.

    Raises AlgebraError where a formula has no meaning with them.
    """
    angles = [angle for joint in robot.joints for angle in (joint.theta, joint.alpha)]
    put = Substitution(robot.ring, values, angles)
    return Robot(
        ring=put.ring,
        convention=robot.convention,
        coordinates=robot.coordinates,
        joints=tuple(_joint(joint, put) for joint in robot.joints),
        bodies=tuple(_body(body, put) for body in robot.bodies),
        gravity=put.matrix(robot.gravity),
        base_rotation=put.matrix(robot.base_rotation),
        base_position=put.matrix(robot.base_position),
        parameters=tuple(name for name in robot.parameters if (name, 0) not in values),
    )


def _joint(joint: Joint, put: Substitution) -> Joint:
    theta, d, a, alpha = (_written(node, put.values) for node in joint.written)
    return replace(
        joint,
        theta=put.angle(joint.theta),
        d=put(joint.d),
        a=put(joint.a),
        alpha=put.angle(joint.alpha),
        written=(theta, d, a, alpha),
    )


def _written(node: Node, values: Replacements) -> Node:
    """A cell of the table with values in it; one that is a number is written as one."""
    if isinstance(node, Symbol | Number | Degrees):
        tree = replaced(node, values)
    else:
        bare = {key: Parenthesized(value) if not isinstance(value, Number) else value
                for key, value in values.items()}  # fmt: skip
        tree = replaced(node, bare)
    value: Fraction | None = rational_value(tree)
    return tree if value is None else number(value)


def _body(body: Body, put: Substitution) -> Body:
    shape = body.shape
    if shape is not None:
        shape = replace(shape, dimensions=tuple((key, put(value)) for key, value in shape.dimensions))
    return replace(
        body,
        mass=put(body.mass),
        center=put.matrix(body.center),
        axes=replace(body.axes, rotation=put.matrix(body.axes.rotation)),
        inertia=None if body.inertia is None else put.matrix(body.inertia),
        shape=shape,
        about_point=None if body.about_point is None else put.matrix(body.about_point),
    )
