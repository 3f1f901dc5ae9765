"""A pose of bodies that are given by their positions, and the view of it, in which nothing falls together.

How a body that is given by its position is reached from the world's origin: straight pieces, exactly.

A position is a sum; its terms with the same length before their sines and cosines are one piece: of
(x + l sin θ, l cos θ, 0) the pieces are x (1, 0, 0) and l (sin θ, cos θ, 0).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from itertools import combinations, islice, pairwise, permutations
from random import Random

from msgspec import Struct

from dynsolve.algebra.angles import name_alone, names_of
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.rationals import rational_sqrt
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.derivation.mechanism import angular_jacobian, orientation, position_jacobian
from dynsolve.draw.skeleton import drawn_length, finite
from dynsolve.draw.vectors import (
    IDENTITY,
    NEAR,
    Point,
    Rotation,
    Vector,
    View,
    dot,
    facing,
    length,
    oblique,
    point_to_segment,
    scale,
    unit,
)
from dynsolve.notation.tree import names_in
from dynsolve.problem.model import Problem
from dynsolve.questions.constraints.derive import constraint_functions, holonomic
from dynsolve.robot.model import Body, JointType, Robot

# How a body that is given by its position is reached from the world's origin

Place = tuple[Expr, Expr, Expr]
"""A point or a vector of the world."""

_Terms = list[tuple[int, tuple[int, ...], Expr]]
"""Terms of a place: of which entry, with which exponents, and the term."""

_MOST_ORDERS = 120


class Kind(Enum):
    """What is known of a piece: where it keeps its length, where its direction, both, or neither."""

    ROD = "rod"
    SLIDE = "slide"
    FIXED = "fixed"
    OTHER = "other"


class Piece(Struct, frozen=True):
    """A straight piece from a point to another; `direction` is what stands beside its length.

    `length` is None where it is no monomial times a rational number.
    """

    start: Place
    end: Place
    direction: Place
    length: Expr | None
    kind: Kind

    @property
    def turns(self) -> bool:
        """Whether its direction depends on coordinates."""
        return any(entry.ring.depends_on_coordinates(entry) for entry in self.direction)


def ways(robot: Robot) -> tuple[tuple[Piece, ...], ...]:
    """The pieces that lead to each body; those that several bodies share are equal."""
    centers = {_place(body.center.entries) for body in robot.bodies}
    return tuple(_way(robot.ring, _place(body.center.entries), centers) for body in robot.bodies)


def _place(entries: Sequence[Expr]) -> Place:
    x, y, z = entries
    return x, y, z


def _way(ring: Ring, center: Place, centers: Iterable[Place]) -> tuple[Piece, ...]:
    """The pieces to a centre in an order in which other centres lie on the way, and slides come first."""
    others = set(centers) - {center}
    vectors = list(_vectors(ring, center))
    vectors = sorted(vectors, key=lambda vector: _rank(ring, vector, vectors))
    orders = islice(permutations(vectors), _MOST_ORDERS)
    best = max(orders, key=lambda order: sum(point in others for point in _ways_points(ring, order)))
    points = _ways_points(ring, best)
    return tuple(
        _piece(ring, start, end, vector)
        for start, end, vector in zip([(ring.zero,) * 3, *points], points, best, strict=False)
    )


def _vectors(ring: Ring, place: Place) -> Iterator[Place]:
    """The straight parts of a sum."""
    for group in _grouped(_terms(ring, place), _length):
        yield from _straight(ring, group)


def straight_parts(ring: Ring, way: Place) -> Iterator[tuple[Expr | None, Place]]:
    """The straight parts of a way with their lengths, None where one is no monomial times a number."""
    for vector in _vectors(ring, way):
        yield _piece(ring, vector, vector, vector).length, vector


def _ways_points(ring: Ring, vectors: Iterable[Place]) -> list[Place]:
    points, at = [], (ring.zero, ring.zero, ring.zero)
    for x, y, z in vectors:
        at = at[0] + x, at[1] + y, at[2] + z
        points.append(at)
    return points


def _rank(ring: Ring, vector: Place, others: Sequence[Place]) -> tuple[bool, int, int, bool]:
    """Slides before what turns, what earlier coordinates move before the rest, and what leads back last.

    Of d (cos q, sin q, 0) and -e (cos q, sin q, 0) the second leads back from the end of the first.
    """
    _, direction = _parted(ring, vector)
    moved = [k for k in range(len(ring.names)) if any(not ring.diff(x, k).is_zero for x in vector)]
    own = any(map(ring.depends_on_coordinates, direction)), max(moved, default=-1), len(moved)
    if _is_forward(direction):
        return *own, False
    ahead = [_rank(ring, other, ()) for other in others if _is_opposite(ring, direction, other)]
    return *max([own, *(rank[:3] for rank in ahead)]), bool(ahead)


def _is_forward(direction: Place) -> bool:
    """Whether the first term of a direction is positive."""
    return next(x.poly.leading_coefficient() for x in direction if not x.is_zero) > 0


def _is_opposite(ring: Ring, direction: Place, other: Place) -> bool:
    """Whether something lies in the line of a direction, and leads the other way."""
    _, way = _parted(ring, other)
    along = ring.dot(direction, way)
    across = cross(*(Matrix.column(ring, each) for each in (direction, way)))
    return across.is_zero and along.is_number and along.number < 0


# -- pieces ----------------------------------------------------------------------------------------


def _terms(ring: Ring, place: Place) -> _Terms:
    return [
        (entry, tuple(map(int, exponents)), Expr(ring, ring.ctx.from_dict({exponents: coefficient})))
        for entry, expr in enumerate(place)
        for exponents, coefficient in expr.poly.to_dict().items()
    ]


Key = Callable[[Ring, int, tuple[int, ...]], object]


def _grouped(terms: _Terms, key: Key) -> Iterator[_Terms]:
    groups: dict[object, _Terms] = {}
    for entry, exponents, term in terms:
        groups.setdefault(key(term.ring, entry, exponents), []).append((entry, exponents, term))
    yield from groups.values()


def _length(ring: Ring, entry: int, exponents: tuple[int, ...]) -> object:
    """The factors of a term that are symbols, or inverses of them."""
    return tuple(
        e if g.kind in ("symbol", "inverse") else 0 for g, e in zip(ring.generators, exponents, strict=True)
    )


def _angles(ring: Ring, entry: int, exponents: tuple[int, ...]) -> object:
    """The angles of a term."""
    return frozenset(k for k, pair in enumerate(ring.pairs) if exponents[pair.sine] or exponents[pair.cosine])


def _straight(ring: Ring, group: _Terms) -> Iterator[Place]:
    """A group as vectors whose direction has a constant length; else along the world's axes."""
    vectors: list[Place] = []
    for key in (lambda *_: None, _angles, lambda _, entry, __: entry):
        vectors = [_sum(ring, part) for part in _grouped(group, key)]
        if all(_keeps(ring, _parted(ring, vector)[1]) for vector in vectors):
            break
    yield from vectors


def _sum(ring: Ring, terms: _Terms) -> Place:
    x, y, z = (sum((term for k, _, term in terms if k == entry), start=ring.zero) for entry in range(3))
    return x, y, z


def _parted(ring: Ring, vector: Place) -> tuple[Expr, Place]:
    """A vector as a monomial times what is left."""
    exponents = next(exponents for entry in vector for exponents in entry.poly.monoms())
    length = ring.one
    for g, e in zip(ring.generators, exponents, strict=True):
        if g.kind in ("symbol", "inverse"):
            length = length * ring.generator(g.index) ** int(e)
    x, y, z = (Expr(ring, entry.poly / length.poly) for entry in vector)
    return length, (x, y, z)


def _keeps(ring: Ring, direction: Place) -> bool:
    return not ring.depends_on_coordinates(ring.dot(direction, direction))


def _piece(ring: Ring, start: Place, end: Place, vector: Place) -> Piece:
    length, direction = _parted(ring, vector)
    square = ring.dot(direction, direction)
    factor = rational_sqrt(square.number) if square.is_number else None
    slides, turns = ring.depends_on_coordinates(length), any(map(ring.depends_on_coordinates, direction))
    if not _keeps(ring, direction):
        kind = Kind.OTHER
    elif slides:
        kind = Kind.SLIDE
    else:
        kind = Kind.ROD if turns else Kind.FIXED
    return Piece(start, end, direction, None if factor is None else length * factor, kind)


def angles(ring: Ring) -> frozenset[str]:
    """The names that stand in an angle alone: not the radius R of x/R."""
    atoms = (atom for pair in ring.pairs for atom, _ in pair.angle.terms)
    return frozenset(map(name_alone, atoms)) - {""}


def swept(ring: Ring, angle: str, *values: Expr) -> bool:
    """Whether values depend on an angle through a sine or cosine."""
    return any(
        value.poly.degrees()[index] > 0
        for value in values
        for pair in ring.pairs
        if angle in names_of(pair.angle)
        for index in (pair.sine, pair.cosine)
    )


_TRIES = 160
_ROUNDS = 30
_SEED = 1955
_SIZE = 300.0
"""How wide or high all points together are on paper."""

_LENGTHS = (0.55, 0.75, 1.0, 1.25)
_RADII = (0.16, 0.24)
_PLACES = (0.6, 1.6)
_ANGLES = (0.35, 1.2)
_SLOPES = (0.35, 0.7)
"""Between which values lengths that slide, angles that turn and constant ones are drawn; in radians."""

_AZIMUTHS = (-0.9, -0.6, 0.5, 0.8, 1.1)
_ELEVATION = 0.4
_ENOUGH = 0.22
"""Points that are further apart than this part of the whole picture are no better for it."""


class Turning(Struct, frozen=True):
    """What an angle turns at a vertex: its unit directions from where the angle is 0 to its value.

    `is_axis` says that it is an axis of a body, and no piece.
    """

    name: str
    vertex: Vector
    directions: tuple[Vector, ...]
    is_axis: bool


class PlacedPose(Struct, frozen=True):
    """Bodies in numbers: the value of every name, the ways to the bodies, and how they are seen."""

    robot: Robot
    ways: tuple[tuple[Piece, ...], ...]
    values: Mapping[str, float]
    view: View
    gravity: Vector | None

    def turning(self, steps: int) -> Iterator[Turning]:
        """What each angle turns: the first piece, else the first body."""
        robot, ring = self.robot, self.robot.ring
        coordinates = [q.name for q in robot.coordinates if q.type is JointType.REVOLUTE]
        turned: list[tuple[Sequence[Expr], Sequence[Expr], bool]] = [
            (piece.start, piece.direction, False) for piece in self.pieces
        ]
        for body in robot.bodies:
            axes, center = orientation(robot, body), body.center.entries
            turned += [(center, axes.column_at(k).entries, True) for k in range(3) if body.turns]
        for name in (*coordinates, *sorted(angles(ring) & set(ring.parameters))):
            for vertex, direction, is_axis in turned:
                if swept(ring, name, *direction):
                    values = (self.values[name] * k / steps for k in range(steps + 1))
                    directions = tuple(unit(self.vector(direction, **{name: value})) for value in values)
                    yield Turning(name, self.vector(vertex), directions, is_axis)
                    break

    def rolls(self, body: Body) -> tuple[Vector, Vector] | None:
        """ω and v of a body for the first length that turns it; None where none does."""
        spins, moves, k = _rolling(self.robot, body)
        if k is None:
            return None
        return self.vector(spins.column_at(k).entries), self.vector(moves.column_at(k).entries)

    def radius(self, body: Body) -> str | None:
        """The letter R of a disk for which v² = R² ω² as a length turns it; None where none is."""
        ring = self.robot.ring
        spins, moves, k = _rolling(self.robot, body)
        if k is None:
            return None
        spin, speed = (
            ring.dot(each.column_at(k).entries, each.column_at(k).entries) for each in (spins, moves)
        )
        return next((name for name in ring.parameters if speed == spin * ring.symbol(name) ** 2), None)

    def touches(self, body: Body) -> bool:
        """Whether a disk rolls on a line, on which it does not slide, whatever moves.

        That point is at rest; or another coordinate moves the line: a length that does not turn the body
        and moves it along one direction in its plane, or what turns the body and its way alike.
        """
        robot, ring = self.robot, self.robot.ring
        spins, moves, k = _rolling(robot, body)
        if k is None or length(self.vector(moves.column_at(k).entries)) < NEAR:
            return False
        spin, way = spins.column_at(k), moves.column_at(k)
        to_line, square = cross(spin, way), ring.dot(spin.entries, spin.entries)
        for j in range(robot.n):
            turned, moved = spins.column_at(j), moves.column_at(j)
            if (moved.scale(square) + cross(turned, to_line)).is_zero:
                continue
            carried = Matrix.column(ring, [ring.diff(entry, j) for entry in way.entries])
            in_plane = _is_straight(moved) and ring.dot(moved.entries, spin.entries).is_zero
            if j == k or carried != cross(turned, way) or (turned.is_zero and not in_plane):
                return False
        return True

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The pieces of all ways, each once."""
        return tuple(dict.fromkeys(piece for way in self.ways for piece in way))

    def vector(self, place: Iterable[Expr], **changed: float) -> Vector:
        """A point or a direction, perhaps at other values of some names."""
        return _vector(place, {**self.values, **changed})

    def point(self, place: Iterable[Expr]) -> Point:
        """Where a point is on paper."""
        return self.view.point(self.vector(place))

    def axes(self, turned: Matrix, **changed: float) -> Rotation:
        """The columns of a rotation."""
        x, y, z = (self.vector(turned.column_at(k).entries, **changed) for k in range(3))
        return x, y, z


def _rolling(robot: Robot, body: Body) -> tuple[Matrix, Matrix, int | None]:
    """J_ω and J_v of a body, and the place of the first length that turns it, or angle along a line."""
    spins, moves = angular_jacobian(robot, body), position_jacobian(robot, body.center)
    turning = [k for k in range(robot.n) if not spins.column_at(k).is_zero]
    lengths = [k for k in turning if robot.coordinates[k].type is JointType.PRISMATIC]
    straight = [k for k in turning if _is_straight(moves.column_at(k))]
    return spins, moves, next(iter([*lengths, *straight]), None)


def _is_straight(way: Matrix) -> bool:
    """Whether what moves a point moves it along one line: ẋ = R θ̇."""
    return not way.is_zero and not any(map(way.ring.depends_on_coordinates, way.entries))


def placed_pose(problem: Problem) -> PlacedPose:
    """The pose and the view, of some that are drawn by lot, in which points and pieces are furthest apart."""
    robot = problem.robot
    found, random = ways(robot), Random(_SEED)  # noqa: S311 - the same poses every time are wanted
    pieces = tuple(dict.fromkeys(piece for way in found for piece in way))
    first = _values(problem, pieces, random)
    x, y, z = _vector(robot.gravity.entries, first)
    gravity = unit((x, y, z)) if length((x, y, z)) > NEAR else None
    views = tuple(_views(robot, found, gravity))
    held = constraint_functions(robot, {}).entries if holonomic(robot) else ()
    best: tuple[float, Mapping[str, float], View] = (-math.inf, first, views[0])
    for _ in range(_TRIES):
        view = random.choice(views)
        try:
            values = _kept(robot, held, _values(problem, pieces, random))
            score = _score(pieces, values, view)
        except (ValueError, ZeroDivisionError, OverflowError):
            continue
        if score > best[0]:
            best = score, values, view
    _, chosen, view = best
    return PlacedPose(
        robot, found, chosen, view.sized(_SIZE / _extent(_points(pieces, chosen, view))), gravity
    )


def _vector(place: Iterable[Expr], values: Mapping[str, float]) -> Vector:
    x, y, z = (finite(entry, values) for entry in place)
    return x, y, z


def _values(problem: Problem, pieces: Sequence[Piece], random: Random) -> dict[str, float]:
    """A value for every name: lengths near 1, those of the file in their order; angles of their own."""
    robot = problem.robot
    values = {name: random.choice(_LENGTHS) for name in robot.ring.parameters}
    turned = angles(robot.ring)
    rolled = names_in(*(turn.angle for body in robot.bodies for turn in body.turns)) - set(robot.ring.names)
    values |= {name: random.choice(_RADII) for name in sorted(rolled & set(values))}
    values |= {name: random.uniform(*_SLOPES) for name in sorted(turned & set(values))}
    given = {name: float(value) for name, value in problem.values.items() if name in values}
    entries = [entry for piece in pieces for entry in (*piece.start, *piece.end)]
    indices = {name: robot.ring.symbol_indices[name, 0] for name in given if name not in turned}
    degrees = [entry.poly.degrees() for entry in entries if not entry.is_zero]
    lengths = {name: given[name] for name, k in indices.items() if any(each[k] > 0 for each in degrees)}
    longest = max(map(abs, lengths.values()), default=0.0)
    values |= {name: value for name, value in given.items() if name not in lengths and name not in rolled}
    values |= {name: drawn_length(value / longest) for name, value in lengths.items() if longest}
    for q in robot.coordinates:
        span = _ANGLES if q.type is JointType.REVOLUTE else _PLACES
        values |= {q.name: random.uniform(*span), q.velocity: 0.0, q.acceleration: 0.0}
    return {**values, "pi": math.pi}


def _kept(robot: Robot, held: Sequence[Expr], values: dict[str, float]) -> dict[str, float]:
    """The values, the coordinates moved until each constraint holds; ValueError where none is near."""
    for _ in range(_ROUNDS if held else 0):
        for h in held:
            slopes = [finite(robot.ring.diff(h, k), values) for k in range(robot.n)]
            step = finite(h, values) / sum(slope**2 for slope in slopes)
            for q, slope in zip(robot.coordinates, slopes, strict=True):
                values[q.name] -= step * slope
    if any(abs(finite(h, values)) > NEAR for h in held):
        raise ValueError(values)
    return values


def _views(robot: Robot, found: Iterable[Iterable[Piece]], gravity: Vector | None) -> Iterator[View]:
    """The plane from its front, where all moves in one of the world's planes; else some from above."""
    places = [piece.end for way in found for piece in way]
    axes = [turn.axis.entries for body in robot.bodies for turn in body.turns]
    for k, toward in ((2, IDENTITY[2]), (1, scale(IDENTITY[1], -1.0)), (0, IDENTITY[0])):
        level = gravity is None or abs(gravity[k]) < NEAR
        about = all(entry.is_zero for axis in axes for j, entry in enumerate(axis) if j != k)
        if level and about and all(place[k].is_zero for place in places):
            up = scale(gravity, -1.0) if gravity else IDENTITY[1 if k == 2 else 2]
            yield facing(toward, up)
            return
    up = scale(gravity, -1.0) if gravity else IDENTITY[2]
    ahead = next(axis for axis in IDENTITY if abs(dot(axis, up)) < 0.9)
    yield from (oblique(up, ahead, azimuth, _ELEVATION) for azimuth in _AZIMUTHS)


def _points(pieces: Sequence[Piece], values: Mapping[str, float], view: View) -> dict[Place, Point]:
    places = dict.fromkeys(place for piece in pieces for place in (piece.start, piece.end))
    return {place: view.point(_vector(place, values)) for place in places}


def _extent(points: Mapping[Place, Point]) -> float:
    """How wide or high points are together, whichever is more."""
    return max((max(c) - min(c) for c in zip(*points.values(), strict=True)), default=0.0) or _SIZE


def _score(pieces: Sequence[Piece], values: Mapping[str, float], view: View) -> float:
    """How far the nearest points, or a point and a piece that it is no end of, are apart; and the rest."""
    points = _points(pieces, values, view)
    apart = [math.dist(a, b) for a, b in combinations(points.values(), 2)]
    for piece in pieces:
        same = {piece.start} | {p.end for p in pieces if _is_on_line(p, piece)}
        a, b = points[piece.start], points[piece.end]
        apart += [point_to_segment(point, a, b) for place, point in points.items() if place not in same]
    extent = _extent(points)
    parts = [min(d / extent, _ENOUGH) for d in apart] or [0.0]
    return min(parts) + 0.1 * sum(parts) / len(parts) - _disorder(pieces, points)


def _is_on_line(piece: Piece, other: Piece) -> bool:
    """Whether a piece lies on another from its start, or leads back from its end."""
    return (piece.start, piece.direction) == (other.start, other.direction) or _leads_back(piece, other)


def _leads_back(piece: Piece, other: Piece) -> bool:
    ring = piece.direction[0].ring
    return piece.start == other.end and _is_opposite(ring, piece.direction, other.direction)


def _disorder(pieces: Sequence[Piece], points: Mapping[Place, Point]) -> int:
    """How many pieces on one line from one point do not follow each other in the order of the file.

    A piece at whose end another begins is the last: a link reaches beyond its mass centre.  What leads back
    is shorter than what it leads back on.
    """
    starts = {piece.start for piece in pieces}
    lines: dict[tuple[Place, Place], list[Piece]] = {}
    for piece in sorted(pieces, key=lambda piece: piece.end in starts):
        lines.setdefault((piece.start, piece.direction), []).append(piece)
    return sum(
        math.dist(points[a.start], points[a.end]) > math.dist(points[b.start], points[b.end])
        for line in lines.values()
        for a, b in pairwise(line)
    ) + sum(
        math.dist(points[a.start], points[a.end]) > math.dist(points[b.start], points[b.end])
        for a, b in permutations(pieces, 2)
        if _leads_back(a, b)
    )
