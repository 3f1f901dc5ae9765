"""Warnings that need the geometry of the robot: a rod beside its link, a moment left out, angles as drawn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from dynsolve.algebra.matrix import Matrix
from dynsolve.errors import Finding
from dynsolve.problem.reader import Reading
from dynsolve.robot.geometry import Links, elementary
from dynsolve.robot.model import Body, Robot
from dynsolve.robot.shapes import AXES, KINDS

if TYPE_CHECKING:
    from dynsolve.problem.bodies import ParsedBody
    from dynsolve.problem.mechanism import ParsedPlacedBody


def beside_its_link(reading: Reading) -> Iterator[Finding]:
    """A rod half-way along a link that it is not parallel to, though it is not across it either."""
    robot = reading.problem.robot
    links = _links(robot)
    for body, parsed in zip(robot.bodies, reading.parsed.bodies, strict=False):
        shape = body.density.shape if body.density else body.shape
        if shape is None or not KINDS[shape.kind].along_link or (body.density and body.density.begins):
            continue
        near, far = links.near_end(body.link), links.far_end(body.link)
        if far is None or not (body.center.scale(robot.ring.constant(2)) - near - far).is_zero:
            continue
        way = links.axes_in_link(body.axes, body.link).T @ (far - near)
        along = [axis for axis, entry in zip(AXES, way.entries, strict=True) if not entry.is_zero]
        if len(along) > 1 and shape.axis in along:
            message = (
                f"body {body.name} hangs in the air: link {body.link} leads along {' and '.join(along)} of "
                f"the body, and the {shape.kind} along {shape.axis} alone lies half-way between its ends"
            )
            help = (
                "give its centre where it is, center: {near: [x, y, z]}, one body for each part of the link, "
                "or axes that turn it into the way from joint to joint"
            )
            span = parsed.fields.span_of("center")
            yield reading.faults.source.finding(*span, message, help, "beside-its-link")


def left_out_moment(reading: Reading) -> Iterator[Finding]:
    """A moment that is left out, about an axis that the body turns about, and that is not 0 of any body.

    About an axis that all mass lies on the moment is 0, and those about the two others are equal.
    """
    model = reading.parsed.model
    listed: Sequence[ParsedBody | ParsedPlacedBody] = model.bodies if model else reading.parsed.bodies
    for body, parsed in zip(reading.problem.robot.bodies, listed, strict=True):
        tensor = parsed.tensor
        if tensor is None or tensor.listed or body.inertia is None or body.inertia.is_zero:
            continue
        turning = _turning(reading.problem.robot, body)
        missing = [
            AXES[k]
            for k in range(3)
            if tensor.rows[k][k] is None
            and body.inertia[(k + 1) % 3, (k + 1) % 3] != body.inertia[(k + 2) % 3, (k + 2) % 3]
            and not all(entry.is_zero for entry in turning.rows[k])
        ]
        if missing:
            axes = " and ".join(missing)
            entries = ", ".join(f"{axis}{axis}: I{body.name}{axis}{axis}" for axis in missing)
            message = f"body {body.name} turns about its {axes} axis, too, where its inertia has no moment"
            help = f"add {entries}; a 0 that is meant is written {missing[0]}{missing[0]}: 0"
            yield reading.faults.source.finding(*tensor.span, message, help, "left-out-moment")


def drawn_angles(reading: Reading) -> Iterator[Finding]:
    """A drawing whose joints stand at other angles than 0 of the table, from which they are counted."""
    normals = reading.parsed.normals
    if normals is None or normals.drawing.zero_is_drawn:
        return
    offset = [
        axis.coordinate
        for k, axis in enumerate(normals.drawing.axes)
        if not axis.slides and normals.all[k].x != normals.all[k + 1].x
    ]
    if offset:
        names = " and ".join(offset)
        given = "zero" in reading.fields
        message = (
            f"{names} {'is' if len(offset) == 1 else 'are'} not 0 as drawn: `zero: table` counts from θ = 0"
        )
        help = "write zero: drawn where the drawing is the pose in which all joints are at 0"
        span = reading.fields.span_of("zero") if given else reading.fields.key_span("axes")
        yield reading.faults.source.finding(*span, message, help, "drawn-angles")


def _links(robot: Robot) -> Links:
    return Links(robot.ring, robot.convention, robot.joints, [q.name for q in robot.coordinates])


def _turning(robot: Robot, body: Body) -> Matrix:
    """The angular velocity of a body along its own axes, 3×n: what each rate adds to it."""
    ring = robot.ring
    turning = Matrix.zero(ring, 3, robot.n)
    for turn in body.turns:
        turning = turn.rotation.T @ turning + turn.axis @ turn.rates
    links = _links(robot)
    z = Matrix.column(ring, (ring.zero, ring.zero, ring.one))
    for joint in robot.path(body.link) if body.link else ():
        rates = dict(joint.rates) if joint.variable == "theta" else {}
        rate = Matrix.of(ring, [[ring.constant(rates.get(k, Fraction(0))) for k in range(robot.n)]])
        about_z, about_x = elementary(ring, "z", joint.theta), elementary(ring, "x", joint.alpha)
        if links.modified:
            turning = about_z.T @ about_x.T @ turning + z @ rate
        else:
            turning = about_x.T @ (about_z.T @ turning + z @ rate)
    return turning if body.turns else links.axes_in_link(body.axes, body.link).T @ turning
