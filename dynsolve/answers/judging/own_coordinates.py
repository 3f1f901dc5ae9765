"""Answers in the student's own coordinates, as they read in the problem's.

Where the student's coordinate is -q_i plus a constant, the rates and the generalized force
of it have the other sign.  With S the diagonal matrix of the signs: τ, f, g, C q̇, dLdqd, ddt
and dLdq become S times themselves, D and C become S D S and S C S, a Jacobian J S,
and c_ijk takes the signs of all three; energies, positions and velocities stay.
"""

from __future__ import annotations

from collections.abc import Callable

from dynsolve.answers.submission import Answer
from dynsolve.notation.tree import Matrix, Negative, Node, Reference
from dynsolve.notation.walk import with_children
from dynsolve.quantities import families, model_families, static_families
from dynsolve.quantities import kinematic_families as asked
from dynsolve.quantities.family import Owner
from dynsolve.quantities.index import Quantities, Quantity

_OF_ROWS = (
    families.TAU, families.G, families.CQD, static_families.Q, static_families.TAU_STATIC,
    asked.QD, asked.QDD, model_families.QDD_FORWARD,
)  # fmt: skip
_OF_COLUMNS = (
    families.JV, families.JW, families.J, families.JV_BODY, families.JW_BODY, asked.JV_POINT, asked.JW_POINT,
    asked.JV_DOT, asked.JW_DOT, asked.J_DOT, asked.JR, asked.JR_DOT,
)  # fmt: skip
_OF_BOTH = (families.D, families.C)


def in_problems_coordinates(answer: Answer, quantities: Quantities) -> Node | None:
    """The tree of an answer with the signs that it has in the coordinates of the problem."""
    node = answer.node
    if node is None or not answer.turned:
        return node
    order = [q.name for q in quantities.owners.coordinates]
    turned = {order.index(name) for name in answer.turned}

    def is_turned(name: str, row: int, column: int) -> bool:
        quantity = quantities.get(name)
        found = () if quantity is None else _coordinates(quantity, row, column)
        return sum(k in turned for k in found) % 2 == 1

    node = _references_turned(node, is_turned)
    if not isinstance(node, Matrix):
        return Negative(node) if is_turned(answer.name, 0, 0) else node
    is_row = len(node.rows) == 1 and (quantities[answer.name].shape or (1, 1))[1] == 1
    return Matrix(
        tuple(
            tuple(
                Negative(entry) if is_turned(answer.name, j if is_row else i, j) else entry
                for j, entry in enumerate(row)
            )
            for i, row in enumerate(node.rows)
        )
    )


def _references_turned(node: Node, is_turned: Callable[[str, int, int], bool]) -> Node:
    """The student's own answers, which are kept in the problem's coordinates, turned back."""
    if isinstance(node, Reference):
        turned = is_turned(node.quantity, (node.row or 1) - 1, (node.column or 1) - 1)
        return Negative(node) if turned else node
    return with_children(node, lambda child: _references_turned(child, is_turned))


def _coordinates(quantity: Quantity, row: int, column: int) -> tuple[int, ...]:
    """The coordinates whose signs an entry takes, from 0."""
    family = quantity.family
    if family in _OF_ROWS:
        return (row,)
    if family in _OF_COLUMNS:
        return (column,)
    if family in _OF_BOTH:
        return row, column
    if family.owner in (Owner.COORDINATE, Owner.PAIR, Owner.TRIPLE):
        return tuple(i - 1 for i in quantity.index)
    return ()
