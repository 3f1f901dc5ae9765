"""How a body that is given by its position is reached from the world's origin: straight pieces, exactly.

A position is a sum; its terms with the same length before their sines and cosines are one piece: of
(x + l sin θ, l cos θ, 0) the pieces are x (1, 0, 0) and l (sin θ, cos θ, 0).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import islice, permutations

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.rationals import rational_sqrt
from dynsolve.algebra.ring import Ring
from dynsolve.robot.model import Robot

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


@dataclass(frozen=True, slots=True)
class Piece:
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
    vectors = [part for group in _grouped(_terms(ring, center), _length) for part in _straight(ring, group)]
    vectors.sort(key=lambda vector: _rank(ring, vector))
    orders = islice(permutations(vectors), _MOST_ORDERS)
    best = max(orders, key=lambda order: sum(point in others for point in _points(ring, order)))
    points = _points(ring, best)
    return tuple(
        _piece(ring, start, end, vector)
        for start, end, vector in zip([(ring.zero,) * 3, *points], points, best, strict=False)
    )


def _points(ring: Ring, vectors: Iterable[Place]) -> list[Place]:
    points, at = [], (ring.zero, ring.zero, ring.zero)
    for x, y, z in vectors:
        at = at[0] + x, at[1] + y, at[2] + z
        points.append(at)
    return points


def _rank(ring: Ring, vector: Place) -> tuple[bool, int, int]:
    """Slides before what turns, and what depends on fewer and earlier coordinates before the rest."""
    _, direction = _parted(ring, vector)
    moved = [k for k in range(len(ring.names)) if any(not ring.diff(x, k).is_zero for x in vector)]
    return any(map(ring.depends_on_coordinates, direction)), len(moved), max(moved, default=-1)


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


def _entry(ring: Ring, entry: int, exponents: tuple[int, ...]) -> object:
    return entry


def _straight(ring: Ring, group: _Terms) -> Iterator[Place]:
    """A group as vectors whose direction has a constant length; else along the world's axes."""
    for key in (None, _angles, _entry):
        parts = [group] if key is None else list(_grouped(group, key))
        vectors = [_sum(ring, part) for part in parts]
        if key is _entry or all(_keeps(ring, _parted(ring, vector)[1]) for vector in vectors):
            yield from vectors
            return


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
    return frozenset(atom[0][0] for atom in atoms if len(atom) == 1 and atom[0][1] == 1)


def swept(ring: Ring, angle: str, *values: Expr) -> bool:
    """Whether values depend on an angle through a sine or cosine."""
    return any(
        value.poly.degrees()[index] > 0
        for value in values
        for pair in ring.pairs
        if angle in names_of(pair.angle)
        for index in (pair.sine, pair.cosine)
    )
