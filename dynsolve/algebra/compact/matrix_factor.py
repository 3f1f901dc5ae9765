"""The factor that all entries of a matrix share: (1/12) m l² in front of the tensor of a rod."""

from __future__ import annotations

from dynsolve.algebra.compact.atoms import Rank
from dynsolve.algebra.compact.collect import Collector
from dynsolve.algebra.compact.monomials import common, divide, whole_content
from dynsolve.algebra.compact.terms import exact
from dynsolve.notation.build import number_in_front, split_sign
from dynsolve.notation.tree import ZERO, Matrix, Node, Quotient
from dynsolve.notation.walk import walk


def matrix_factor(collector: Collector, matrix: Matrix) -> tuple[Node, Matrix] | None:
    """(factor, rest) with matrix = factor · rest; None unless that takes fractions out of several entries.

    Masses and lengths go with the fraction, angles and rates stay; a length alone stays too: no entry
    is read more easily without it.
    """
    entries = {entry: collector.decompose(entry) for row in matrix.rows for entry in row if entry != ZERO}
    filled = sum(entry != ZERO for row in matrix.rows for entry in row)
    if filled < 2 or not any(isinstance(split_sign(entry)[1], Quotient) for entry in entries):
        return None
    number = whole_content([factor for factor, _ in entries.values()])
    ranks = collector.atoms.ranks
    shared = tuple(
        (atom, exponent)
        for atom, exponent in common([mono for _, mono in entries.values()])
        if ranks[atom][0] <= Rank.SUM
    )
    if number.denominator == 1 or not shared:
        return None
    rest: dict[Node, Node] = {
        entry: collector.product(exact(factor, number), divide(mono, shared), ())
        for entry, (factor, mono) in entries.items()
    }
    if any(isinstance(part, Quotient) for entry in rest.values() for part in walk(entry)):
        return None
    front = number_in_front(collector.product(number, shared, ()))
    return front, Matrix(tuple(tuple(rest.get(entry, entry) for entry in row) for row in matrix.rows))
