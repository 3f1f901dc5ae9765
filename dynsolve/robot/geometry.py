"""Rotations about axes, and the positions of a link's ends in its own frame.

Standard convention: link i reaches from o_{i-1} to o_i; frame i is at its far end.
Modified convention: from o_i to o_{i+1}; frame i is at its near end.

Absolute angles of parallel joints: θ₁, θ₁ + θ₂, θ₁ + θ₂ + θ₃.

Where consecutive revolute axes are parallel, everything a planar arm does is a
function of the running sums of its joint angles, and books write it in them:
s₁, c₁₂, s₁₂₃.  Between two consecutive revolute joints the frames are turned by a
constant rotation C (prismatic and fixed rows turn nothing with q).  C takes the
one axis z to ±z exactly where the axes are parallel, as

    Rot_z(ψ) C Rot_z(θ) = C Rot_z(θ ± ψ),    C z = ±z,

so the absolute angle goes on as θ ± ψ, its sign being that of C_33.  Whether
C_33 = ±1 is decided in floating point, with symbolic angles at fixed irrational
values: the choice of basic angles may be unlucky, it cannot be wrong.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from math import cos, radians, sin, sqrt

from msgspec import Struct, field

from dynsolve.algebra.angles import Angle, Atom, names_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.robot.model import Axes, AxesKind, Convention, Joint, Robot, path_to

# Absolute angles of parallel joints: θ₁, θ₁ + θ₂, θ₁ + θ₂ + θ₃

_TOLERANCE = 1e-9

Column = tuple[float, ...]
Rotation = tuple[tuple[float, float, float], ...]


class Turn(Struct, frozen=True):
    """The rotation of a row of the table: its θ and α; `revolute` where θ holds the joint variable.

    `start` is the frame that the row starts from, the one before where it is None.
    """

    theta: Angle
    alpha: Angle
    revolute: bool
    start: int | None = None


def absolute_angles(turns: Sequence[Turn], coordinates: Collection[str], modified: bool) -> list[Angle]:
    """The angles in which formulas about this robot are short, the first joint's first.

    For a run of parallel revolute axes the running sums; for a lone axis the joint's
    own linear form, each with its constant part: cos(θ₁ + 30°) is shorter than what it
    expands to.

    >>> q1, q2 = Angle.of("q1"), Angle.of("q2")
    >>> planar = [Turn(q1, Angle.zero(), True), Turn(q2, Angle.zero(), True)]
    >>> absolute_angles(planar, ("q1", "q2"), modified=False) == [q1, q1 + q2]
    True
    """
    found = [angle for run in _runs(turns, coordinates, modified) for angle in run]
    return [_leading_positive(angle, coordinates) for angle in found if angle.terms]


def parallel_groups(
    turns: Sequence[Turn], coordinates: Collection[str], modified: bool
) -> list[frozenset[str]]:
    """The coordinates that turn about parallel axes, a set for each run of them."""
    return [
        frozenset(name for angle in run for name in names_of(angle) if name in coordinates)
        for run in _runs(turns, coordinates, modified)
    ]


def turned_otherwise(turns: Sequence[Turn], modified: bool) -> frozenset[str]:
    """The names in constant angles of the table about axes that the first revolute axis is not parallel to.

    The revolute axes are parallel.  Such an angle, as a twist, adds to none about them.
    """
    ends: list[Rotation] = [_about_z(0.0)]
    turned: list[tuple[Angle, Column]] = []
    own: Column | None = None
    for row, turn in enumerate(turns):
        before, after = _constant_rotations(turn, (), modified)
        at_axis = _times(ends[row if turn.start is None else turn.start], before)
        x, _, z = zip(*at_axis, strict=True)
        own = z if own is None and turn.revolute else own
        turned += [(turn.theta, z), (turn.alpha, x)]
        ends.append(_times(at_axis, after))
    if own is None:
        return frozenset()
    others = (names_of(angle) for angle, about in turned if not _are_parallel(about, own))
    return frozenset(name for names in others for name in names)


def _are_parallel(one: Column, other: Column) -> bool:
    return abs(abs(sum(x * y for x, y in zip(one, other, strict=True))) - 1) < _TOLERANCE


def _runs(turns: Sequence[Turn], coordinates: Collection[str], modified: bool) -> list[list[Angle]]:
    """The absolute angles, a list for each run of parallel revolute axes."""
    runs: list[list[Angle]] = []
    ends: list[_End] = [_End()]
    for row, turn in enumerate(turns):
        end = ends[row if turn.start is None else turn.start]
        before, after = _constant_rotations(turn, coordinates, modified)
        between = None if end.between is None else _times(end.between, before)
        run, absolute = end.run, end.absolute
        if turn.revolute:
            sign = _sign(between) if between is not None else 0
            own = turn.theta
            if own.degrees % 90 == 0:  # a quarter turn makes a sine of a cosine, and no other angle
                own = Angle(own.terms)
            if sign:
                absolute = own + absolute * sign
            else:
                run, absolute = len(runs), own
                runs.append([])
            runs[run].append(absolute)
            between = after
        elif between is not None:
            between = _times(between, after)
        ends.append(_End(between, run, absolute))
    return runs


class _End(Struct, frozen=True):
    """What a row goes on from: the rotation since the last revolute axis, its run, its absolute angle."""

    between: Rotation | None = None
    run: int = 0
    absolute: Angle = field(default_factory=Angle.zero)


def moving_part(angle: Angle, coordinates: Collection[str]) -> Angle:
    """The part of an angle that turns with coordinates."""
    return Angle(tuple((atom, rate) for atom, rate in angle.terms if _moves(atom, coordinates)))


def _moves(atom: Atom, coordinates: Collection[str]) -> bool:
    return any(name in coordinates for name, _ in atom)


def _leading_positive(angle: Angle, coordinates: Collection[str]) -> Angle:
    rates = moving_part(angle, coordinates).terms
    return -angle if rates and rates[0][1] < 0 else angle


def _constant_rotations(
    turn: Turn, coordinates: Collection[str], modified: bool
) -> tuple[Rotation, Rotation]:
    """The constant rotations of a row before and after its joint axis; of a fixed row, both parts.

    The constant part of a revolute θ is a turn about the joint's own axis, and matters to no sign.
    """
    alpha = _about_x(_value(turn.alpha))
    theta = _about_z(0.0 if turn.revolute else _value(turn.theta))
    return (alpha, theta) if modified else (theta, alpha)


def _sign(rotation: Rotation) -> int:
    """+1 or -1 where the rotation takes z to ±z, else 0."""
    cosine = rotation[2][2]
    return round(cosine) if abs(abs(cosine) - 1) < _TOLERANCE else 0


def _value(angle: Angle) -> float:
    """The angle in radians, each name at an irrational value that depends on its spelling alone."""
    total = radians(float(angle.degrees))
    for atom, rate in angle.terms:
        term = float(rate)
        for name, exponent in atom:
            code = sum(ord(character) * 31**i for i, character in enumerate(name)) % 9973
            term *= (0.5 + (sqrt(2) * code) % 1.0) ** exponent
        total += term
    return total


def _about_x(angle: float) -> Rotation:
    c, s = cos(angle), sin(angle)
    return ((1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c))


def _about_z(angle: float) -> Rotation:
    c, s = cos(angle), sin(angle)
    return ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))


def _times(left: Rotation, right: Rotation) -> Rotation:
    columns = tuple(zip(*right, strict=True))
    rows = [tuple(sum(a * b for a, b in zip(row, column, strict=True)) for column in columns) for row in left]
    return tuple((row[0], row[1], row[2]) for row in rows)


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


def rotation_along(ring: Ring, joints: Iterable[Joint], *, modified: bool) -> Matrix:
    """The axes of the frame behind some rows of a table seen from the frame before them, 3×3."""
    rotation = Matrix.identity(ring, 3)
    for joint in joints:
        about_z, about_x = elementary(ring, "z", joint.theta), elementary(ring, "x", joint.alpha)
        rotation = rotation @ (about_x @ about_z if modified else about_z @ about_x)
    return rotation


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

    def __init__(self, ring: Ring, convention: Convention, joints: Sequence[Joint]) -> None:
        self.ring, self.convention, self.joints = ring, convention, joints

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
        following = self.rows_after(link)
        return self._step(following[0]) if len(following) == 1 else None

    def rows_after(self, link: int) -> list[Joint]:
        """The rows that start from the frame of a link."""
        return [joint for joint in self.joints if joint.parent == link]

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
        path = path_to(self.joints, link)
        return rotation_along(self.ring, path, modified=self.modified).map(self.ring.at_rest)

    def axes_in_link(self, axes: Axes, link: int) -> Matrix:
        """The body-attached axes seen from the link's frame at q = 0, 3×3."""
        if axes.kind is AxesKind.LINK:
            return axes.rotation
        return self.rotation_at_rest(link).T @ axes.rotation.map(self.ring.at_rest)
