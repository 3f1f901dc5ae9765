"""What decides about the rank of a matrix: what is left of it when everything simple is taken away.

Rows may be turned among each other by an angle, and multiples of rows and columns added to others: the
rank stays what it is, everywhere.  A Jacobian so gets the axes of the frame in which it is shortest.
Where an entry is a number or a length, its row and its column can be cleared and left out: the rank of
the matrix is 1 more than that of the rest.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.positivity import is_positive

Rows = tuple[tuple[Expr, ...], ...]


def core(matrix: Matrix) -> tuple[int, Matrix]:
    """(k, rest): everywhere the rank of the matrix is k more than that of the rest."""
    rows, pivots = _without_zeros(matrix.rows), 0
    while rows:
        if (place := _pivot(rows)) is not None:
            rows, pivots = _without_zeros(_cleared(rows, *place)), pivots + 1
        elif (shorter := _shorter(matrix, rows)) is not None:
            rows = shorter
        else:
            break
    return pivots, Matrix(matrix.ring, rows)


def _without_zeros(rows: Rows) -> Rows:
    """Without the rows and columns that are 0."""
    kept = [row for row in rows if not all(entry.is_zero for entry in row)]
    return _turned_over(column for column in zip(*kept, strict=True) if not all(e.is_zero for e in column))


def _turned_over(lines: Iterator[tuple[Expr, ...]] | Rows) -> Rows:
    return tuple(zip(*lines, strict=True))


def _pivot(rows: Rows) -> tuple[int, int] | None:
    """The place of an entry that is never 0: a number first, and where least is to be cleared."""
    places = [
        (not entry.is_number, _size((row,)) * _size((tuple(other[j] for other in rows),)), i, j)
        for i, row in enumerate(rows)
        for j, entry in enumerate(row)
        if _is_never_zero(entry)
    ]
    return min(places)[2:] if places else None


def _is_never_zero(entry: Expr) -> bool:
    ring = entry.ring
    return len(entry) == 1 and not ring.depends_on_coordinates(entry) and (
        is_positive(entry) or is_positive(-entry)
    )  # fmt: skip


def _cleared(rows: Rows, i: int, j: int) -> Rows:
    """The rows without row i and column j, from which multiples of row i were taken so that column j is 0."""
    pivot = rows[i][j]

    def entry(row: tuple[Expr, ...], k: int) -> Expr:
        if row[j].is_zero:
            return row[k]
        across = row[j] * rows[i][k]
        return row[k] - across / pivot.number if pivot.is_number else row[k] * pivot - across

    columns = [k for k in range(len(rows[i])) if k != j]
    return tuple(tuple(entry(row, k) for k in columns) for row in (*rows[:i], *rows[i + 1 :]))


def _shorter(matrix: Matrix, rows: Rows) -> Rows | None:
    """The shortest that two rows turned, or a row or column added to another, make of the matrix, or None."""
    columns = _turned_over(rows)
    found = [(_size(new) - _size(rows), k, new) for k, new in enumerate(_with_turns(matrix, rows))]
    for lines, back in ((rows, tuple), (columns, _turned_over)):
        found += [
            (_size(new) - _size(rows), len(found) + k, back(new)) for k, new in enumerate(_with_sums(lines))
        ]
    gain, _, best = min(found, key=lambda one: one[:2], default=(0, 0, rows))
    return best if gain < 0 else None


def _with_turns(matrix: Matrix, rows: Rows) -> Iterator[Rows]:
    ring = matrix.ring
    for pair in ring.pairs:
        s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
        for i, j in permutations(range(len(rows)), 2):
            mine, other = rows[i], rows[j]
            turned = tuple(c * a + s * b for a, b in zip(mine, other, strict=True))
            across = tuple(c * b - s * a for a, b in zip(mine, other, strict=True))
            yield _replaced(rows, {i: turned, j: across})


def _with_sums(lines: Rows) -> Iterator[Rows]:
    """Less a multiple of another line, by which a term of an entry is gone."""
    for i, j in permutations(range(len(lines)), 2):
        ring = lines[i][0].ring
        pairs = [both for both in zip(lines[i], lines[j], strict=True) if not any(e.is_zero for e in both)]
        for times in dict.fromkeys(Expr(ring, divmod(a.poly, b.poly)[0]) for a, b in pairs):
            if not times.is_zero:
                yield _replaced(
                    lines, {i: tuple(a - times * b for a, b in zip(lines[i], lines[j], strict=True))}
                )


def _replaced(lines: Rows, new: dict[int, tuple[Expr, ...]]) -> Rows:
    return tuple(new.get(k, line) for k, line in enumerate(lines))


def _size(lines: Rows) -> int:
    return sum(len(entry) for line in lines for entry in line)
