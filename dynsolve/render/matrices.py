"""Matrices in displayed formulas: where they stand, and how one that is too wide is given entry by entry."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.document import Formula
from dynsolve.notation.tree import ZERO, Entry, Letter, Matrix, Node, Number, Relation, Row, Words, equation
from dynsolve.notation.walk import children, walk

_SHALLOW = 4
_OTHERS = Words("every other entry")


def holds_matrix(node: Node, depth: int = _SHALLOW) -> bool:
    """Whether a matrix stands in a formula, near enough to its top to be laid out."""
    if isinstance(node, Matrix):
        return True
    return depth > 0 and any(holds_matrix(part, depth - 1) for part in children(node))


def height(node: Node) -> int:
    """How many rows the highest matrix in a formula has."""
    return max((len(part.rows) for part in walk(node) if isinstance(part, Matrix)), default=1)


def entries_by_value(matrix: Matrix) -> list[tuple[Node, list[tuple[int, int]]]]:
    """The different entries of a matrix, each with all of its places (from 0); those that are 0 last.

    >>> from dynsolve.notation.tree import ONE
    >>> [places for _, places in entries_by_value(Matrix(((ZERO, ONE), (ONE, ZERO))))]
    [[(0, 1), (1, 0)], [(0, 0), (1, 1)]]
    """
    places: dict[Node, list[tuple[int, int]]] = {}
    for i, row in enumerate(matrix.rows):
        for j, entry in enumerate(row):
            places.setdefault(entry, []).append((i, j))
    zeros = places.pop(ZERO, None)
    return [*places.items(), *([(ZERO, zeros)] if zeros else [])]


def entry_equations(matrix: Matrix, left: Node | None, formula: Formula) -> Iterator[Relation]:
    """`d_12 = d_21 = ...`: equal entries in one chain, those that are 0 last.

    Zeros of what has no letter of its own, (A - B)_12, are told in words: their names are long.
    """
    found = entries_by_value(matrix)
    for value, places in found:
        names = [entry_name(i, j, matrix, left, formula) for i, j in places]
        first = names[0]
        has_letter = not isinstance(first, Entry) or isinstance(first.of, Letter)
        if value == ZERO and len(names) > 1 < len(found) and not has_letter:
            names = [_OTHERS]
        yield equation(*names, value)


def given_name(i: int, j: int, matrix: Matrix, formula: Formula) -> Node | None:
    """The name that a formula gives to an entry of its matrix, if it does."""
    if len(formula.entries) == len(matrix.rows) and len(formula.entries[i]) == len(matrix.rows[i]):
        return formula.entries[i][j]
    return None


def entry_name(i: int, j: int, matrix: Matrix, left: Node | None, formula: Formula) -> Node:
    """The name of an entry: given, or the letter on the left with the entry's place."""
    if (given := given_name(i, j, matrix, formula)) is not None:
        return given
    place: list[Node] = [Number(i + 1), Number(j + 1)]
    if len(matrix.rows[0]) == 1 or len(matrix.rows) == 1:
        place = [Number(max(i, j) + 1)]
    between = [Words(",")] if max(i, j) >= 9 else []  # 1 and 11 are not 11 and 1
    index = place[0] if len(place) == 1 else Row((place[0], *between, place[1]))
    if isinstance(left, Letter) and left.sub is None and left.sup is None:
        return Letter(left.base, index, None, dots=left.dots)
    if left is None:
        return Row((Words("["), *place, Words("]")))
    return Entry(left, index)
