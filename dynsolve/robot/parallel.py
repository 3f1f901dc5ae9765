"""Absolute angles of parallel joints: θ₁, θ₁ + θ₂, θ₁ + θ₂ + θ₃.

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

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from math import cos, radians, sin, sqrt

from dynsolve.algebra.angles import Angle, Atom, names_of

_TOLERANCE = 1e-9

Rotation = tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, slots=True)
class Turn:
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
            if sign:
                absolute = turn.theta + absolute * sign
            else:
                run, absolute = len(runs), turn.theta
                runs.append([])
            runs[run].append(absolute)
            between = after
        elif between is not None:
            between = _times(between, after)
        ends.append(_End(between, run, absolute))
    return runs


@dataclass(frozen=True, slots=True)
class _End:
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
