"""Whether two chains of joint axes are one mechanism, for some choice of frames.

What is free of a table (Spong et al. 3.2): each z points along its joint axis or against it, frame 0
is anywhere on the first axis, a sliding axis has a direction and no place, and the hand may
have any x.  So the student's chain is laid on the key's, from the base on:

1. turned: each link so that the axes on it point as the key's do, or against them; a link on which
   all axes are parallel so that the next one is on the right side.  How far a joint had to be turned
   for that is where the student counts it from.
2. moved: along the first axis, and by sliding joints; what is then left between the two is wrong.

Everything is in numbers; the caller repeats it for other values of the letters.

A chain knows no frames: only where each joint's axis lies and which way it points when every
coordinate is 0, and where the hand is then.  Two tables describe the same mechanism where their
chains can be laid on each other (`matching`), whatever frames they were made with.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from math import atan2, pi, remainder, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.derivation.drawn_motion import rodrigues
from dynsolve.derivation.newton_euler import (
    IDENTITY,
    ZERO,
    Rotation,
    Vector,
    applied,
    column,
    cross,
    dot,
    elementary,
    minus,
    plus,
    scaled,
    times,
)

# A Denavit-Hartenberg table in numbers, as the chain of joint axes that it describes

Rates = tuple[tuple[int, float], ...]
"""(index of a coordinate from 0, how fast the joint moves with it)"""


class NumberRow(Struct, frozen=True):
    """A row in numbers: the constant parts of θ and d, and a and α; angles in radians.

    `variable` is "theta" or "d", None for a fixed frame; `rates` belong to it.
    """

    theta: float
    d: float
    a: float
    alpha: float
    variable: str | None = None
    rates: Rates = ()


class JointLine(Struct, frozen=True):
    """A joint axis where every coordinate is 0; `row` is that of the table, from 1."""

    turns: bool
    point: Vector
    direction: Vector
    rates: Rates
    row: int


class Pose(Struct, frozen=True):
    """Where a frame is: its axes as the columns of R, and its origin."""

    R: Rotation
    o: Vector

    def turned(self, axis: str, angle: float) -> Pose:
        """The frame after a turn about one of its own axes."""
        return Pose(times(self.R, elementary(axis, angle)), self.o)

    def moved(self, axis: str, way: float) -> Pose:
        """The frame after a slide along one of its own axes."""
        return Pose(self.R, plus(self.o, scaled(column(self.R, 0 if axis == "x" else 2), way)))


class Chain(Struct, frozen=True):
    """The joint axes from the base to the hand, and the hand's frame, where every coordinate is 0."""

    joints: tuple[JointLine, ...]
    hand: Pose


def chain_of(rows: Iterable[NumberRow], modified: bool) -> Chain:
    """The chain of a table, seen from its frame 0."""
    joints: list[JointLine] = []
    pose = Pose(IDENTITY, ZERO)
    for index, row in enumerate(rows, 1):
        if modified:
            pose = pose.turned("x", row.alpha).moved("x", row.a)
        if row.variable:
            turns = row.variable == "theta"
            joints.append(JointLine(turns, pose.o, column(pose.R, 2), row.rates, index))
        pose = pose.turned("z", row.theta).moved("z", row.d)
        if not modified:
            pose = pose.moved("x", row.a).turned("x", row.alpha)
    return Chain(tuple(joints), pose)


_DEPENDENT = 1e-9
_SEEN = 1e-6
_MOST_WAYS = 64


class Match(Struct, frozen=True):
    """How a chain lies on the key's.

    `senses` are +1 where a joint's axis points as the key's does, else -1; `offsets` what the
    student's joint variable is, by its own sense, where the key's is 0 in its.  `base` and `shift`
    take the student's frame 0 to the key's.
    """

    senses: tuple[int, ...]
    offsets: tuple[float, ...]
    base: Rotation
    shift: Vector

    @property
    def is_turned_over(self) -> bool:
        """Whether the student's z_0 points against the key's."""
        return self.base[2][2] < 0

    @property
    def turn(self) -> float:
        """The angle from the key's x_0 to the student's, in radians."""
        return atan2(self.base[1][0], self.base[0][0])

    def lies_like(self, other: Match) -> bool:
        """Whether all axes point as in another match."""
        return (self.senses, self.is_turned_over) == (other.senses, other.is_turned_over)

    def unturned(self) -> Match:
        """The same with x_0 along the key's, and the first joint, which turns, counted from elsewhere."""
        turn = -self.turn if self.is_turned_over else self.turn
        base = times(rodrigues((0.0, 0.0, 1.0), -self.turn), self.base)
        return replace(self, base=base, offsets=(self.offsets[0] + turn, *self.offsets[1:]))


class Mismatch(Struct, frozen=True):
    """The first joint (from 0, the number of joints for the hand) that cannot be laid on the key's, and why.

    `reason` is "direction"; "side" where the axes of a link are parallel and the next one is too far off or
    too near; "place" where all point as the key's do and some lie elsewhere.
    """

    joint: int
    reason: str

    @property
    def depth(self) -> tuple[bool, int, bool]:
        """How far the chains agree: first they are turned, joint by joint, then moved."""
        return self.reason == "place", self.joint, self.reason == "side"


class _Turned(Struct, frozen=True):
    """A chain turned so far.

    `R` takes the student's axes to the key's world; `free` is the direction about which it may still
    be turned (None: all is settled), `owner` the joint that would do it, -1 for the base, whose
    rotation is `base`.  `rotations` are those of the links that carry the joints and the hand.
    """

    R: Rotation
    free: Vector | None
    owner: int
    base: Rotation
    senses: tuple[int, ...] = ()
    turned: tuple[float, ...] = ()
    rotations: tuple[Rotation, ...] = ()


class Matching:
    """Lays a student's chain on the key's.

    `base_is_free` says that frame 0 may be anywhere, the first axis having no place;
    `tolerance` is what counts as rounding.
    """

    def __init__(self, key: Chain, student: Chain, base_is_free: bool, tolerance: float) -> None:
        self.key, self.student, self.base_is_free, self.tolerance = key, student, base_is_free, tolerance
        self.deepest = Mismatch(0, "direction")

    def found(self) -> tuple[Match, ...] | Mismatch:
        """The ways in which the chains agree, the fewest changes first, or where they part."""
        ways = (Match(t.senses, m[0], t.base, m[1]) for t in self._turnings(0, None) if (m := self._moved(t)))
        return tuple(sorted(islice(ways, _MOST_WAYS), key=self._changes)) or self.deepest

    def _changes(self, match: Match) -> tuple[int, bool]:
        """How many joints are counted otherwise, and frame 0 turned or turned over; whether it is."""
        joints = zip(match.senses, match.offsets, self.key.joints, strict=True)
        turned = match.is_turned_over or abs(match.turn) > _SEEN
        changed = sum(sense < 0 or is_seen(offset, joint.turns) for sense, offset, joint in joints)
        return turned + changed, turned

    def _fails(self, joint: int, reason: str) -> None:
        self.deepest = max(self.deepest, Mismatch(joint, reason), key=lambda found: found.depth)

    # -- turned ------------------------------------------------------------------------------------

    def _turnings(self, joint: int, before: _Turned | None) -> Iterator[_Turned]:
        """Every way of turning the links from a joint on, the key's own senses first."""
        if joint == len(self.key.joints):
            assert before is not None
            yield from self._hand_turned(before)
            return
        mine, keys = self.student.joints[joint], self.key.joints[joint]
        for sense in (1, -1):
            turned = self._pointed(before, mine.direction, scaled(keys.direction, sense))
            if turned is None:
                self._fails(joint, "direction")
                continue
            turned = replace(turned, senses=(*turned.senses, sense))
            placed = self._sided(turned, joint) if keys.turns else turned
            if placed is None:
                self._fails(joint, "side")
                continue
            yield from self._turnings(joint + 1, self._joint_freed(placed, joint, keys))

    def _joint_freed(self, turned: _Turned, joint: int, keys: JointLine) -> _Turned:
        """After a turning joint all that follows may be turned about its axis."""
        turned = replace(turned, turned=(*turned.turned, 0.0), rotations=(*turned.rotations, turned.R))
        if not keys.turns or turned.free is not None:
            return turned  # what could be turned about the same line before can still
        return replace(turned, free=keys.direction, owner=joint)

    def _hand_turned(self, before: _Turned) -> Iterator[_Turned]:
        last = len(self.key.joints)
        mine, keys = self.student.hand.R, self.key.hand.R
        ways = [self._pointed(before, _z(mine), scaled(_z(keys), sense)) for sense in (1, -1)]
        if ways == [None, None]:
            self._fails(last, "direction")
        for turned in ways:
            placed = self._sided(turned, last) if turned is not None else None
            if placed is not None:
                yield replace(placed, rotations=(*placed.rotations, placed.R))
            elif turned is not None:
                self._fails(last, "side")

    def _pointed(self, before: _Turned | None, direction: Vector, target: Vector) -> _Turned | None:
        """A direction of the student's turned to point as the key's; None where it cannot."""
        if before is None:
            first = _rotation_to(direction, target)
            return _Turned(first, target, -1, first)
        now = applied(before.R, direction)
        if _length(minus(now, target)) <= self.tolerance:
            parallel = before.free is not None and _length(cross(before.free, target)) <= self.tolerance
            return before if parallel or before.free is None else replace(before, free=None)
        if before.free is None or abs(dot(minus(now, target), before.free)) > self.tolerance:
            return None
        return _turned_about(before, now, target)

    def _sided(self, turned: _Turned, joint: int) -> _Turned | None:
        """Where all axes of a link are parallel, the next one turned to its side; None where it is off."""
        if turned.free is None or self._reference(joint) is None:
            return turned
        way, target = self._ways(turned, joint)
        way, target = _across(way, turned.free), _across(target, turned.free)
        mine, keys = _length(way), _length(target)
        if abs(mine - keys) > self.tolerance * max(1.0, keys):
            return None
        if keys <= self.tolerance * 10:
            return turned
        return _turned_about(turned, way, target)

    def _reference(self, joint: int) -> int | None:
        """The joint before one whose axis has a place: a turning one, or the first; None for the first."""
        if joint == 0:
            return None
        return next((j for j in range(joint - 1, 0, -1) if self.key.joints[j].turns), 0)

    def _ways(self, turned: _Turned, joint: int) -> tuple[Vector, Vector]:
        """The way from the last placed axis to a joint's or the hand: the student's turned, and the key's."""
        before = self._reference(joint)
        assert before is not None
        ends = [
            chain.joints[joint].point if joint < len(chain.joints) else chain.hand.o
            for chain in (self.student, self.key)
        ]
        starts = [chain.joints[before].point for chain in (self.student, self.key)]
        return applied(turned.R, minus(ends[0], starts[0])), minus(ends[1], starts[1])

    # -- moved -------------------------------------------------------------------------------------

    def _moved(self, turned: _Turned) -> tuple[tuple[float, ...], Vector] | None:
        """How far each joint and frame 0 are displaced to lie on the key's; None where nothing does it."""
        import numpy as np

        joints = self.key.joints
        n = len(joints)
        placed = [j for j in range(n) if joints[j].turns or j == 0]
        slides = [j for j in range(n) if not joints[j].turns]
        unknowns = [("along", j) for j in placed] + [("base", k) for k in range(3 * self.base_is_free)]
        unknowns += [("slide", j) for j in slides]
        ends = [j for j in placed if j] + [n]
        A, b = np.zeros((3 * len(ends), len(unknowns))), np.zeros(3 * len(ends))
        for block, end in enumerate(ends):
            rows = slice(3 * block, 3 * block + 3)
            start = self._reference(end)
            assert start is not None
            way, target = self._ways(replace(turned, R=turned.rotations[end]), end)
            b[rows] = minus(target, way)
            for k, (kind, j) in enumerate(unknowns):
                if kind == "base":
                    A[rows, k] = [float(start == 0 and axis == j) for axis in range(3)]
                elif kind == "along":
                    A[rows, k] = scaled(joints[j].direction, float(j == start) - float(j == end))
                elif start <= j < end:
                    A[rows, k] = joints[j].direction
        solution, left = _solved(A, b)
        size = max(1.0, float(np.abs(b).max(initial=0.0)))
        for block, end in enumerate(ends):
            if float(np.abs(left[3 * block : 3 * block + 3]).max()) > self.tolerance * size:
                self._fails(end, "place")
                return None
        ways = {j: value for (kind, j), value in zip(unknowns, solution, strict=True) if kind == "slide"}
        free = [value for (kind, _), value in zip(unknowns, solution, strict=True) if kind == "base"]
        x, y, z = scaled(joints[0].direction, solution[0])
        shift = (x + free[0], y + free[1], z + free[2]) if free else (x, y, z)
        moves = (ways[j] if j in ways else turned.turned[j] for j in range(n))
        return tuple(sense * move for sense, move in zip(turned.senses, moves, strict=True)), shift


def is_seen(offset: float, turns: bool) -> bool:
    """Whether an offset is more than rounding, and of an angle no whole turn."""
    return abs(remainder(offset, 2 * pi) if turns else offset) > _SEEN


def _turned_about(before: _Turned, vector: Vector, target: Vector) -> _Turned:
    """Turned about the free direction until a vector points across it as another does."""
    assert before.free is not None
    angle = atan2(dot(cross(vector, target), before.free), dot(_across(vector, before.free), target))
    turn = rodrigues(before.free, angle)
    R, owner = times(turn, before.R), before.owner
    if owner < 0:
        return replace(before, R=R, free=None, base=times(turn, before.base))
    angles = list(before.turned)
    angles[owner] += angle
    return replace(before, R=R, free=None, turned=tuple(angles))


def _rotation_to(vector: Vector, target: Vector) -> Rotation:
    axis, cosine = cross(vector, target), dot(vector, target)
    sine = _length(axis)
    if sine > 1e-12:
        return rodrigues(scaled(axis, 1 / sine), atan2(sine, cosine))
    if cosine > 0:
        return IDENTITY
    other = (1.0, 0.0, 0.0) if abs(vector[0]) < 0.9 else (0.0, 1.0, 0.0)
    across = cross(vector, other)
    return rodrigues(scaled(across, 1 / _length(across)), pi)


def _across(vector: Vector, direction: Vector) -> Vector:
    return minus(vector, scaled(direction, dot(vector, direction)))


def _length(vector: Vector) -> float:
    return sqrt(dot(vector, vector))


def _z(R: Rotation) -> Vector:
    return R[0][2], R[1][2], R[2][2]


def _solved(A: Any, b: Any) -> tuple[list[float], Any]:
    """(x, b - A x) of least squares; of columns that depend on each other the first is used."""
    import numpy as np

    used: list[int] = []
    for k in range(A.shape[1]):
        if np.linalg.matrix_rank(A[:, [*used, k]], tol=_DEPENDENT) > len(used):
            used.append(k)
    x = np.zeros(A.shape[1])
    if used:
        x[used] = np.linalg.lstsq(A[:, used], b, rcond=None)[0]
    return [float(value) for value in x], b - A @ x
