"""A basis of angles: independent linear forms such that every given form is an integer combination of them.

θ₁ and θ₁ + θ₂ are such a basis of themselves; θ₁/2 is one of θ₁ and 3θ₁/2.  An angle is
a vector of rational rates here; the eliminations are FLINT's.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm

from flint import fmpq_mat, fmpz_mat

from dynsolve.algebra.rationals import fraction, rational

Vector = tuple[Fraction, ...]


def coordinates_in(
    basis: Sequence[Sequence[int | Fraction]], vector: Sequence[int | Fraction]
) -> tuple[Fraction, ...] | None:
    """The coefficients of `vector` in a `basis`; None outside its span, or where it is no basis.

    >>> basis = [(Fraction(1), Fraction(0)), (Fraction(1), Fraction(1))]
    >>> coordinates_in(basis, (Fraction(0), Fraction(2)))
    (Fraction(-2, 1), Fraction(2, 1))
    """
    if not basis:
        return None if any(vector) else ()
    last = len(basis) - 1
    columns = [*basis, vector]
    echelon, rank = fmpq_mat([[rational(v[i]) for v in columns] for i in range(len(vector))]).rref()
    if rank != len(basis) or not echelon[last, last]:
        return None
    return tuple(fraction(echelon[j, len(basis)]) for j in range(len(basis)))


def integer_basis(vectors: Sequence[Vector]) -> list[Vector]:
    """Independent vectors whose integer combinations are exactly those of `vectors`.

    The given vectors are kept as long as they serve, in their order, so that the
    caller chooses the basis by what it names first.

    >>> half = Fraction(1, 2)
    >>> integer_basis([(Fraction(1),), (half,)])
    [(Fraction(1, 2),)]
    """
    basis: list[Vector] = []
    for vector in vectors:
        if not any(vector):
            continue
        found = coordinates_in(basis, vector)
        if found is None:
            basis.append(vector)
        elif any(c.denominator != 1 for c in found):
            basis = _hermite([*basis, vector])
    return basis


def _hermite(vectors: Sequence[Vector]) -> list[Vector]:
    """The rows of Hermite's normal form of dependent vectors, over a common denominator."""
    scale = lcm(*(x.denominator for v in vectors for x in v))
    rows = fmpz_mat([[int(x * scale) for x in v] for v in vectors]).hnf().tolist()
    return [tuple(Fraction(int(x), scale) for x in row) for row in rows if any(row)]
