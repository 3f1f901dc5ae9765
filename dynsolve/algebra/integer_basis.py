"""A basis of angles: independent linear forms of which every given one is an integer combination."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm

Vector = tuple[Fraction, ...]


def integer_coordinates(basis: Sequence[Vector], vector: Vector) -> tuple[Fraction, ...] | None:
    """The coefficients of `vector` in an independent `basis`, or None outside its span.

    >>> basis = [(Fraction(1), Fraction(0)), (Fraction(1), Fraction(1))]
    >>> integer_coordinates(basis, (Fraction(0), Fraction(2)))
    (Fraction(-2, 1), Fraction(2, 1))
    """
    width = len(basis)
    rows = [[b[i] for b in basis] + [vector[i]] for i in range(len(vector))]
    pivots = 0
    for j in range(width):
        pivot = next((r for r in range(pivots, len(rows)) if rows[r][j]), None)
        if pivot is None:
            raise ValueError("the basis is dependent")
        rows[pivots], rows[pivot] = rows[pivot], rows[pivots]
        lead = rows[pivots][j]
        rows[pivots] = [x / lead for x in rows[pivots]]
        for r, row in enumerate(rows):
            if r != pivots and row[j]:
                factor = row[j]
                rows[r] = [x - factor * y for x, y in zip(row, rows[pivots], strict=True)]
        pivots += 1
    if any(row[width] for row in rows[pivots:]):
        return None
    return tuple(rows[j][width] for j in range(width))


def lattice_basis(vectors: Sequence[Vector]) -> list[Vector]:
    """Independent vectors whose integer combinations are exactly those of `vectors`.

    The given vectors are kept as long as they serve, in their order, so that the
    caller chooses the basis by what it names first.

    >>> half = Fraction(1, 2)
    >>> lattice_basis([(Fraction(1),), (half,)])
    [(Fraction(1, 2),)]
    """
    basis: list[Vector] = []
    for vector in vectors:
        if not any(vector):
            continue
        found = integer_coordinates(basis, vector)
        if found is None:
            basis.append(vector)
        elif any(c.denominator != 1 for c in found):
            basis = _refined([*basis, vector])
    return basis


def _refined(vectors: Sequence[Vector]) -> list[Vector]:
    """A reduced basis of a lattice given by dependent vectors: Hermite's form, over a common denominator."""
    scale = lcm(*(x.denominator for v in vectors for x in v))
    rows = [[int(x * scale) for x in v] for v in vectors]
    done: list[list[int]] = []
    for j in range(len(rows[0])):
        while sum(1 for row in rows if row[j]) > 1:
            rows.sort(key=lambda row: (not row[j], abs(row[j])))
            lead = rows[0]
            rows = [lead] + [
                [x - (row[j] // lead[j]) * y for x, y in zip(row, lead, strict=True)] for row in rows[1:]
            ]
        lead_row = next((row for row in rows if row[j]), None)
        if lead_row is not None:
            rows.remove(lead_row)
            done.append(lead_row if lead_row[j] > 0 else [-x for x in lead_row])
    return [tuple(Fraction(x, scale) for x in row) for row in done]


def rational_gcd(values: Sequence[Fraction]) -> Fraction:
    """The largest rational of which every value is an integer multiple.

    >>> rational_gcd([Fraction(10), Fraction(25)])
    Fraction(5, 1)
    """
    scale = lcm(*(v.denominator for v in values))
    return Fraction(gcd(*(int(v * scale) for v in values)), scale)
