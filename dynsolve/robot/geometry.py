"""Rotations about axes, and the positions of a link's ends in its own frame.

Standard convention: link i reaches from o_{i-1} to o_i; frame i is at its far end.
Modified convention: from o_i to o_{i+1}; frame i is at its near end.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.robot.model import Axes, AxesKind, Convention, Joint, Robot, path_to
from dynsolve.robot.parallel import moving_part


def elementary(ring: Ring, axis: str, angle: Angle) -> Matrix:
    """The rotation about one axis, 3×3.

    R_z = [[c, -s, 0], [s, c, 0], [0, 0, 1]], and the same in cyclic order for x and y.
    """
    c, s, zero, one = ring.cos(angle), ring.sin(angle), ring.zero, ring.one
    if axis == "x":
        return Matrix.of(ring, [[one, zero, zero], [zero, c, -s], [zero, s, c]])
    if axis == "y":
        return Matrix.of(ring, [[c, zero, s], [zero, one, zero], [-s, zero, c]])
    return Matrix.of(ring, [[c, -s, zero], [s, c, zero], [zero, zero, one]])


def rotation_about(axis: Matrix, angle: Angle) -> Matrix:
    """The rotation about a unit vector a, 3×3: R = c E + s S(a) + (1 - c) a aᵀ, S(a) b being a × b.

    Rodrigues' formula; Spong, Hutchinson, Vidyasagar, section 2.5.3.
    """
    ring = axis.ring
    c, s, zero = ring.cos(angle), ring.sin(angle), ring.zero
    x, y, z = axis.entries
    cross = Matrix.of(ring, [[zero, -z, y], [z, zero, -x], [-y, x, zero]])
    return Matrix.identity(ring, 3).scale(c) + cross.scale(s) + (axis @ axis.T).scale(ring.one - c)


def is_rotation(matrix: Matrix) -> tuple[bool, bool]:
    """(R Rᵀ = 1, det R = +1), decided exactly."""
    ring = matrix.ring
    orthogonal = (matrix @ matrix.T - Matrix.identity(ring, 3)).is_zero
    (a, b, c), (d, e, f), (g, h, i) = matrix.rows
    determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return orthogonal, determinant == ring.one


def last_origin(robot: Robot) -> Matrix:
    """The origin of the last frame in the world, 3×1, by the elementary motions of the table."""
    ring, rotation, origin = robot.ring, robot.base_rotation, robot.base_position
    for joint in robot.path(len(robot.joints)):
        about_z, about_x = elementary(ring, "z", joint.theta), elementary(ring, "x", joint.alpha)
        along_z = Matrix.column(ring, (ring.zero, ring.zero, joint.d))
        along_x = Matrix.column(ring, (joint.a, ring.zero, ring.zero))
        if robot.convention is Convention.STANDARD:
            rotation = rotation @ about_z
            origin = origin + rotation @ (along_z + along_x)
            rotation = rotation @ about_x
        else:
            rotation = rotation @ about_x
            origin = origin + rotation @ along_x
            rotation = rotation @ about_z
            origin = origin + rotation @ along_z
    return origin


class Links:
    """The links of a table."""

    def __init__(
        self, ring: Ring, convention: Convention, joints: Sequence[Joint], coordinates: Collection[str]
    ) -> None:
        self.ring, self.convention, self.joints = ring, convention, joints
        self.coordinates = coordinates

    @property
    def modified(self) -> bool:
        """Whether the table is Craig's."""
        return self.convention is Convention.MODIFIED

    def near_end(self, link: int) -> Matrix:
        """The near end of link i in frame i, 3×1.

        Standard: o_{i-1} = (-a, -d sin α, -d cos α).  Modified: o_i = 0.
        """
        return self.origin() if self.modified else -self._step(self.joints[link - 1])

    def far_end(self, link: int) -> Matrix | None:
        """The far end of link i in frame i, 3×1; None where a modified table ends before it.

        Standard: o_i = 0.  Modified: o_{i+1} = (a, -d sin α, d cos α) of the row that follows; of several
        there is no one end.
        """
        if not self.modified:
            return self.origin()
        following = [joint for joint in self.joints if joint.parent == link]
        return self._step(following[0]) if len(following) == 1 else None

    def origin(self) -> Matrix:
        """0, 3×1."""
        return Matrix.zero(self.ring, 3, 1)

    def _step(self, joint: Joint) -> Matrix:
        """o_i - o_{i-1}: in frame i (standard) or in frame i-1 (modified)."""
        sine, cosine = self.ring.sin(joint.alpha), self.ring.cos(joint.alpha)
        across = -(joint.d * sine) if self.modified else joint.d * sine
        return Matrix.column(self.ring, (joint.a, across, joint.d * cosine))

    def is_fixed(self, point: Matrix) -> bool:
        """Whether a point of a link's frame does not move in it."""
        return not any(map(self.ring.depends_on_coordinates, point.entries))

    def rotation_at_rest(self, link: int) -> Matrix:
        """The axes of frame i seen from frame 0 at q = 0, 3×3."""
        rotation = Matrix.identity(self.ring, 3)
        for joint in path_to(self.joints, link):
            theta: Angle = joint.theta - moving_part(joint.theta, self.coordinates)
            about_z = elementary(self.ring, "z", theta)
            about_x = elementary(self.ring, "x", joint.alpha)
            rotation = rotation @ (about_x @ about_z if self.modified else about_z @ about_x)
        return rotation

    def axes_in_link(self, axes: Axes, link: int) -> Matrix:
        """The body-attached axes seen from the link's frame at q = 0, 3×3."""
        if axes.kind is AxesKind.LINK:
            return axes.rotation
        return self.rotation_at_rest(link).T @ axes.rotation.map(self.ring.at_rest)
