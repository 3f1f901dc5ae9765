"""Matrices of exact expressions.

Determinants and minors of exact matrices, by Laplace's expansion; nothing is divided.

Exact values of coordinates and their rates put into expressions, within one ring.

Coordinates without a value stay: sin(q₁ + q₂) at q₂ = 90° is cos q₁.  The map respects
sums and products; the ring must hold the sines and cosines of the values (`needed_angles`,
`needed_roots`).  An angle may also be one whose sine is a sum of roots, such as atan2(4, 3);
where such a coordinate stands by itself, and not in a sine or cosine, it stays.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from dynsolve.algebra.angles import Angle, angle_from_tree, angle_node, name_alone, names_of
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import times
from dynsolve.notation.tree import ZERO, Function, Node, Symbol, walk

if TYPE_CHECKING:
    from dynsolve.algebra.surds import SurdAngle


class Matrix(Struct, frozen=True):
    """An r×c matrix over a ring; frozen."""

    ring: Ring
    rows: tuple[tuple[Expr, ...], ...]

    @staticmethod
    def of(ring: Ring, rows: Iterable[Iterable[Expr]]) -> Matrix:
        """The matrix with these rows."""
        return Matrix(ring, tuple(tuple(row) for row in rows))

    @staticmethod
    def identity(ring: Ring, n: int) -> Matrix:
        """1, n×n."""
        return Matrix.of(ring, ([ring.one if i == j else ring.zero for j in range(n)] for i in range(n)))

    @staticmethod
    def zero(ring: Ring, r: int, c: int) -> Matrix:
        """0, r×c."""
        return Matrix(ring, ((ring.zero,) * c,) * r)

    @staticmethod
    def column(ring: Ring, entries: Iterable[Expr]) -> Matrix:
        """A column vector."""
        return Matrix.of(ring, ([entry] for entry in entries))

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)"""
        return len(self.rows), len(self.rows[0]) if self.rows else 0

    @property
    def T(self) -> Matrix:
        """The transpose."""
        return Matrix(self.ring, tuple(zip(*self.rows, strict=True)))

    @property
    def entries(self) -> tuple[Expr, ...]:
        """All entries, row by row: of a column vector, its components."""
        return tuple(entry for row in self.rows for entry in row)

    @property
    def is_zero(self) -> bool:
        """Whether every entry is 0."""
        return all(entry.is_zero for entry in self.entries)

    def __getitem__(self, place: tuple[int, int]) -> Expr:
        return self.rows[place[0]][place[1]]

    def __matmul__(self, other: Matrix) -> Matrix:
        columns = other.T.rows
        return Matrix.of(self.ring, ([self.ring.dot(row, column) for column in columns] for row in self.rows))

    def __add__(self, other: Matrix) -> Matrix:
        return self._with(other, lambda a, b: a + b)

    def __sub__(self, other: Matrix) -> Matrix:
        return self._with(other, lambda a, b: a - b)

    def __neg__(self) -> Matrix:
        return self.map(lambda entry: -entry)

    def _with(self, other: Matrix, operation: Callable[[Expr, Expr], Expr]) -> Matrix:
        pairs = zip(self.rows, other.rows, strict=True)
        return Matrix.of(self.ring, (map(operation, mine, theirs) for mine, theirs in pairs))

    def map(self, function: Callable[[Expr], Expr]) -> Matrix:
        """The matrix of function(entry), in the ring of its values."""
        rows = tuple(tuple(map(function, row)) for row in self.rows)
        return Matrix(rows[0][0].ring if rows and rows[0] else self.ring, rows)

    def scale(self, factor: Expr) -> Matrix:
        """factor · self"""
        return self.map(lambda entry: factor * entry)

    def block(self, r0: int, r1: int, c0: int, c1: int) -> Matrix:
        """Rows r0..r1-1 and columns c0..c1-1."""
        return Matrix(self.ring, tuple(row[c0:c1] for row in self.rows[r0:r1]))

    def column_at(self, j: int) -> Matrix:
        """Column j as a column vector."""
        return Matrix(self.ring, tuple((row[j],) for row in self.rows))


def skew(a: Matrix) -> Matrix:
    """S(a), 3×3, with S(a) b = a × b."""
    (x, y, z), zero = a.entries, a.ring.zero
    return Matrix(a.ring, ((zero, -z, y), (z, zero, -x), (-y, x, zero)))


def cross(a: Matrix, b: Matrix) -> Matrix:
    """a × b of two 3×1 columns."""
    (x, y, z), (u, v, w) = a.entries, b.entries
    return Matrix.column(a.ring, (y * w - z * v, z * u - x * w, x * v - y * u))


def hstack(ring: Ring, columns: Sequence[Matrix], height: int) -> Matrix:
    """Columns side by side; a matrix of `height` rows."""
    return Matrix.of(ring, ([c[i, 0] for c in columns] for i in range(height)))


def vstack(upper: Matrix, lower: Matrix) -> Matrix:
    """Two matrices of one width, one above the other."""
    return Matrix(upper.ring, upper.rows + lower.rows)


# Determinants and minors of exact matrices, by Laplace's expansion; nothing is divided


def determinant(matrix: Matrix) -> Expr:
    """det of an n×n matrix.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> determinant(Matrix.of(ring, [[a, b], [b, a]]))
    Expr(1*a^2 + -1*b^2)
    """
    size = len(matrix.rows)
    return _Expansion(matrix).minor(tuple(range(size)), tuple(range(size)))


def work(matrix: Matrix) -> int:
    """The products of terms that a determinant may come to: the permanent of the numbers of terms."""
    sizes = [[len(entry) for entry in row] for row in matrix.rows]
    known: dict[tuple[int, ...], int] = {(): 1}

    def of(columns: tuple[int, ...]) -> int:
        if columns not in known:
            row = sizes[len(sizes) - len(columns)]
            rest = ((row[j], columns[:k] + columns[k + 1 :]) for k, j in enumerate(columns) if row[j])
            known[columns] = sum(size * of(left) for size, left in rest)
        return known[columns]

    return of(tuple(range(len(sizes))))


Place = tuple[tuple[int, ...], tuple[int, ...]]
"""The rows and the columns of a square part, from 0."""


def minors(matrix: Matrix, size: int) -> Iterator[Expr]:
    """The determinants of all square parts of a size that are not 0 for every state."""
    return (value for _, value in placed_minors(matrix, size))


def placed_minors(matrix: Matrix, size: int) -> Iterator[tuple[Place, Expr]]:
    """The same, each with its place."""
    expansion = _Expansion(matrix)
    rows, columns = matrix.shape
    for chosen in combinations(range(rows), size):
        for across in combinations(range(columns), size):
            value = expansion.minor(chosen, across)
            if not value.is_zero:
                yield (chosen, across), value


def parts(matrix: Matrix, size: int) -> Iterator[Matrix]:
    """All square parts of a size."""
    rows, columns = matrix.shape
    for chosen in combinations(range(rows), size):
        for across in combinations(range(columns), size):
            yield Matrix.of(matrix.ring, ([matrix[i, j] for j in across] for i in chosen))


class _Expansion:
    """Minors of one matrix, each computed once, along their first row."""

    def __init__(self, matrix: Matrix) -> None:
        self.matrix = matrix
        self._known: dict[tuple[tuple[int, ...], tuple[int, ...]], Expr] = {}

    def minor(self, rows: tuple[int, ...], columns: tuple[int, ...]) -> Expr:
        """The determinant of the part with these rows and columns."""
        if not rows:
            return self.matrix.ring.one
        key = rows, columns
        if key not in self._known:
            entries, below = [], []
            for k, column in enumerate(columns):
                entry = self.matrix[rows[0], column]
                if not entry.is_zero:
                    entries.append(entry if k % 2 == 0 else -entry)
                    below.append(self.minor(rows[1:], columns[:k] + columns[k + 1 :]))
            self._known[key] = self.matrix.ring.dot(entries, below)
        return self._known[key]


# Exact values of coordinates and their rates put into expressions, within one ring

StateValues = Mapping[tuple[str, int], Node]
"""Formulas free of coordinates by (name, number of dots)."""

INVERSE = ("atan2", "acos", "asin", "atan")
"""The functions that give angles."""


def angle_at(angle: Angle, values: StateValues) -> Angle:
    """An angle with values for the coordinates in it."""
    result = Angle((), angle.degrees)
    for atom, rate in angle.terms:
        if any((name, 0) in values for name, _ in atom):
            size = times(1, [(values.get((name, 0), Symbol(name)), exponent) for name, exponent in atom])
            result = result + angle_from_tree(size, radians=True) * rate
        else:
            result = result + Angle(((atom, rate),))
    return result


def needed_angles(ring: Ring, values: StateValues) -> list[Angle]:
    """The angles whose sines and cosines a ring must hold for these values."""
    return [angle_at(pair.angle, values) for pair in ring.pairs]


def direction_at(angle: Angle, values: StateValues) -> SurdAngle:
    """An angle all of whose coordinates have values, exact; raises NotExact where it is none."""
    from dynsolve.algebra.surds import NotExact, Surd, SurdAngle, exact_value

    found = SurdAngle.of_degrees(angle.degrees)
    for atom, rate in angle.terms:
        name = name_alone(atom)
        value = exact_value(values[name, 0], {}) if (name, 0) in values else None
        if isinstance(value, Surd) and value.is_zero:  # a plain 0 is the angle 0
            continue
        if not isinstance(value, SurdAngle):
            raise NotExact
        found = found + value.times(rate)
    return found


def needed_roots(ring: Ring, values: StateValues) -> list[Node]:
    """What a ring must hold where all coordinates have values: these, and sines and cosines.

    A sine is a sum of roots, or that of a constant angle; raises AlgebraError where it is neither.
    """
    moving = {name for name, _ in ring.coordinates}
    turned = [pair.angle for pair in ring.pairs if moving & set(names_of(pair.angle))]
    found = [node for angle in turned for node in _sine_and_cosine(angle, values)]
    return [*found, *filter(_has_value, values.values())]


def _sine_and_cosine(angle: Angle, values: StateValues) -> tuple[Node, Node]:
    try:
        found = direction_at(angle, values)
        return found.sine.node, found.cosine.node
    except AlgebraError:
        size = angle_node(angle_at(angle, values))
        return Function("sin", size), Function("cos", size)


def _has_value(tree: Node) -> bool:
    """Whether a formula has a value in a ring: no angle of a known sine."""
    return not any(isinstance(part, Function) and part.name in INVERSE for part in walk(tree))


class AtState:
    """Puts values into the expressions of a ring.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.text import read
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> coordinates = [("q1", "revolute"), ("q2", "revolute")]
    >>> ring = build_ring(coordinates, [read("pi").tree], [Angle.of("q1"), both])
    >>> AtState(ring, {("q2", 0): read("90deg").tree})(ring.sin(both)) == ring.cos(Angle.of("q1"))
    True
    """

    def __init__(self, ring: Ring, values: StateValues) -> None:
        self.ring, self.values = ring, values

    @cached_property
    def _images(self) -> tuple[Any, ...]:
        images = [self.ring.generator(g.index) for g in self.ring.generators]
        for pair in self.ring.pairs:
            images[pair.sine], images[pair.cosine] = self._turned(pair)
        for (name, dots), tree in self.values.items():
            if _has_value(tree):
                images[self.ring.symbol_indices[name, dots]] = value_of(self.ring, tree)
        at_rest = [
            Function("sgn", Symbol(*of)) for of, tree in self.values.items() if of[1] == 1 and tree == ZERO
        ]
        for g in self.ring.generators:
            if g.node in at_rest:
                images[g.index] = self.ring.zero
        return tuple(image.poly for image in images)

    def _turned(self, pair: Pair) -> tuple[Expr, Expr]:
        """The sine and the cosine of an angle, with the values in it."""
        ring = self.ring
        try:
            angle = angle_at(pair.angle, self.values)
            if angle == pair.angle:
                return ring.generator(pair.sine), ring.generator(pair.cosine)
            return ring.sin(angle), ring.cos(angle)
        except AlgebraError:
            found = direction_at(pair.angle, self.values)
            return value_of(ring, found.sine.node), value_of(ring, found.cosine.node)

    def __call__(self, expr: Expr) -> Expr:
        """The expression with the values in it."""
        if not self.values or expr.is_number:
            return expr
        return Expr(self.ring, self.ring.reduce(expr.poly.compose(*self._images, ctx=self.ring.ctx)))

    def matrix(self, matrix: Matrix) -> Matrix:
        """The matrix with the values in it."""
        return matrix.map(self)
