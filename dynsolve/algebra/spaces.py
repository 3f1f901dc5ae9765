"""Spaces spanned by exact vectors: what a matrix takes to zero, and what it reaches.

A basis is a matrix whose columns span the space; of {0} it has no columns.  Ranks are those for general
values of what is left as a symbol.  Where A has its rank, the vectors are to be independent.  Those that
stand on a minor of A are not where it is 0.  If they may be, columns are combined first, so that

    y a - x b   and   u a + v b,   u x + v y never 0, as s² + c² = 1,

stand in the place of columns a and b with entries x and y in a row.  Of the row one entry is left at last;
then its column, and the row, is done with, as the other columns are across it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from dynsolve.algebra.factors import is_never_zero, parameters
from dynsolve.algebra.linear_systems import adjugate, basis, part, primitive, rank_parts
from dynsolve.algebra.lowest_terms import without_shared, zero_of_all
from dynsolve.algebra.matrix import Matrix, determinant, minors
from dynsolve.algebra.ring import Expr

_Vector = tuple[Expr, ...]
_Four = tuple[Expr, Expr, Expr, Expr]


def nullspace(matrix: Matrix) -> Matrix:
    """A basis of the x with A x = 0, without denominators.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> ring = build_ring([(name, "prismatic") for name in "xy"], [])
    >>> nullspace(Matrix.of(ring, [[ring.symbol("x"), ring.symbol("y")]])).entries
    (Expr(1*y), Expr(-1*x))
    """
    found, width = rank_parts(matrix), matrix.shape[1]
    first = _across(matrix, found.rows, found.columns)
    if width - found.rank < 2 or _terms(first) == 0:
        return first
    rows = part(matrix, found.rows, tuple(range(width)))
    units = Matrix.identity(matrix.ring, width)
    starts = (units, *(_combined(rows, squares_first=order) for order in (True, False)))
    return min((one for start in starts for one in _bases(rows, start)), key=_size)


def rangespace(matrix: Matrix) -> Matrix:
    """A basis of all A x: independent columns; of a matrix with independent rows the unit vectors.

    Where columns may be dependent though A has its rank, what is across all that is across A.
    """
    found, (height, width) = rank_parts(matrix), matrix.shape
    if found.rank == height:
        return Matrix.identity(matrix.ring, height)
    rows = tuple(range(height))
    choices = (found.columns, *combinations(range(width), found.rank))
    bases = [
        _primitive(part(matrix, rows, columns)) for columns in choices if _minor(matrix, found.rows, columns)
    ]
    if found.rank == 0 or _terms(bases[0]) == 0:
        return bases[0]
    return min((*bases, nullspace(nullspace(matrix.T).T)), key=_size)


def dependent_where(vectors: Matrix) -> Expr | None:
    """What is 0 where a factor makes independent columns dependent; None where that is too long.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> ring = build_ring([(name, "prismatic") for name in "xyz"], [])
    >>> x, y, z = (ring.symbol(name) for name in "xyz")
    >>> dependent_where(Matrix.of(ring, [[y, z], [-x, ring.zero], [ring.zero, -x]]))
    Expr(1*x)
    """
    return zero_of_all(list(minors(vectors, vectors.shape[1])))


def _across(matrix: Matrix, rows: Sequence[int], columns: Sequence[int]) -> Matrix:
    """The x with A x = 0 by independent rows and columns, which meet in M.

    A further column j depends on these: x_j = det M, and the others are -adj M times that column.
    """
    ring, width = matrix.ring, matrix.shape[1]
    M = part(matrix, tuple(rows), tuple(columns))
    vectors = []
    for free in (j for j in range(width) if j not in columns):
        vector = [ring.zero] * width
        vector[free] = determinant(M)
        depending = (adjugate(M) @ part(matrix, tuple(rows), (free,))).entries if rows else ()
        for column, entry in zip(columns, depending, strict=True):
            vector[column] = -entry
        vectors.append(primitive(vector))
    return basis(matrix, vectors, width)


def _bases(rows: Matrix, columns: Matrix) -> Iterator[Matrix]:
    """Bases of the x with A x = 0 in combined columns: one by each minor of what is left of A.

    A row in which one entry is left is done with, and so is its column.
    """
    every, matrix = tuple(range(columns.shape[0])), rows @ columns
    left, free = list(range(matrix.shape[0])), list(range(matrix.shape[1]))
    while done := next(((i, used) for i in left if len(used := _used(matrix.rows[i], free)) == 1), None):
        left.remove(done[0])
        free.remove(*done[1])
    rest, across = part(matrix, tuple(left), tuple(free)), part(columns, every, tuple(free))
    if not left:
        yield across
    for chosen in combinations(range(len(free)), len(left)) if left else ():
        if _minor(rest, range(len(left)), chosen):
            yield _primitive(across @ _across(rest, range(len(left)), chosen))


def _combined(rows: Matrix, squares_first: bool) -> Matrix:
    """Columns, whose determinant is never 0, that leave as few entries in the rows as can be."""
    width = rows.shape[1]
    done: list[_Vector] = []
    columns, left = list(Matrix.identity(rows.ring, width).rows), list(rows.rows)
    while left:
        tries = [(row, _cleared(row, columns, squares_first)) for row in left]
        single = [one for one in tries if len(_used(_entries(*one), range(len(columns)))) == 1]
        if not single:
            break
        row, columns = min(single, key=lambda one: sum(len(entry) for column in one[1] for entry in column))
        left.remove(row)
        (k,) = _used(_entries(row, columns), range(len(columns)))
        done.append(columns.pop(k))
    for row in left:
        columns = _cleared(row, columns, squares_first)
    return basis(rows, [*columns, *done], width)


def _cleared(row: _Vector, columns: Sequence[_Vector], squares_first: bool) -> list[_Vector]:
    """Columns combined two by two until no two of them have entries in a row that can be."""
    columns = list(columns)
    ways = (_by_squares, _by_one) if squares_first else (_by_one, _by_squares)
    while True:
        entries = _entries(row, columns)
        used = _used(entries, range(len(columns)))
        pairs = [one for one in combinations(used, 2) if sum(len(entries[k]) for k in one) <= _MOST_TERMS]
        found = ((j, k, way(entries[j], entries[k])) for way in ways for j, k in pairs)
        chosen = next(((j, k, four) for j, k, four in found if four is not None), None)
        if chosen is None:
            return columns
        j, k, (x, y, u, v) = chosen
        a, b = columns[j], columns[k]
        across, along = _sum(y, a, -x, b), _sum(u, a, v, b)
        columns[j], columns[k] = (along, across) if v.is_zero else (across, along)


def _by_one(x: Expr, y: Expr) -> _Four | None:
    """x, y without what they share, 0, 1 or 1, 0, if one of them is never 0."""
    zero, one = x.ring.zero, x.ring.one
    x, y = without_shared([x, y])
    if is_never_zero(y):
        return x, y, zero, one
    return (x, y, one, zero) if is_never_zero(x) else None


def _by_squares(x: Expr, y: Expr) -> _Four | None:
    """x, y without what they share, and u, v with u x + v y = p q (s² + c²), if x = p s, y = q c."""
    x, y = without_shared([x, y])
    p, q = _positive_part(x), _positive_part(y)
    s, c = x.quotient(p), y.quotient(q)
    assert s is not None and c is not None
    return (x, y, q * s, p * c) if is_never_zero(s * s + c * c) else None


def _positive_part(expr: Expr) -> Expr:
    """The lengths that all terms share."""
    positive = parameters(expr)
    ((exponents, _),) = expr.poly.term_content().terms()
    shared = tuple(e if i in positive else 0 for i, e in enumerate(exponents))
    return Expr(expr.ring, expr.ring.ctx.from_dict({shared: 1}))


def _sum(u: Expr, a: _Vector, v: Expr, b: _Vector) -> _Vector:
    return tuple(primitive([u * x + v * y for x, y in zip(a, b, strict=True)]))


def _entries(row: _Vector, columns: Sequence[_Vector]) -> list[Expr]:
    return [row[0].ring.dot(row, column) for column in columns]


def _used(entries: Sequence[Expr], places: Sequence[int]) -> list[int]:
    return [k for k in places if not entries[k].is_zero]


def _minor(matrix: Matrix, rows: Sequence[int], columns: Sequence[int]) -> bool:
    """Whether some rows and columns are independent where they meet."""
    return not determinant(part(matrix, tuple(rows), tuple(columns))).is_zero


def _primitive(vectors: Matrix) -> Matrix:
    return basis(vectors, [primitive(column) for column in vectors.T.rows], vectors.shape[0])


def _size(vectors: Matrix) -> tuple[int, int]:
    """How long the condition is under which the vectors are dependent, and they themselves."""
    return _terms(vectors), sum(map(len, vectors.entries))


def _terms(vectors: Matrix) -> int:
    """The terms of the condition under which vectors are dependent: 0 where they never are."""
    value = dependent_where(vectors)
    if value is None:
        return _UNKNOWN
    return 0 if is_never_zero(value) else len(value)


_MOST_TERMS = 16
"""Longer entries of a row are not combined: to find what they share takes long, and hardly any fit."""

_UNKNOWN = 1_000_000
"""More terms than a condition has that is known."""
