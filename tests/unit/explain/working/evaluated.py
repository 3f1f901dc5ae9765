"""The exact value of a printed formula: of matrices, of what they are multiplied by, of everything else."""

from __future__ import annotations

from functools import reduce

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Product, Relation, Sum, Transpose, walk

Value = Expr | Matrix


def evaluated(ring: Ring, node: Node) -> Value:
    """The value of a formula without letters of the derivation."""
    match node:
        case tree.Matrix(rows):
            return Matrix.of(ring, ([value_of(ring, entry) for entry in row] for row in rows))
        case Transpose(argument):
            value = evaluated(ring, argument)
            assert isinstance(value, Matrix)
            return value.T
        case Product(factors) if any(isinstance(part, tree.Matrix) for part in walk(node)):
            return reduce(_times, (evaluated(ring, factor) for factor in factors))
        case Sum(terms) if any(isinstance(part, tree.Matrix) for part in walk(node)):
            return reduce(_plus, (evaluated(ring, term) for term in terms))
    return value_of(ring, node)


def _times(left: Value, right: Value) -> Value:
    if isinstance(left, Expr) and isinstance(right, Expr):
        return left * right
    if isinstance(left, Expr):
        assert isinstance(right, Matrix)
        return right.scale(left)
    return left @ right if isinstance(right, Matrix) else left.scale(right)


def _plus(left: Value, right: Value) -> Value:
    assert isinstance(left, Matrix) and isinstance(right, Matrix)
    return left + right


def scalar(value: Value) -> Value:
    """A matrix of one entry as that entry."""
    return value.entries[0] if isinstance(value, Matrix) and value.shape == (1, 1) else value


def has_letters(node: Node) -> bool:
    """Whether a formula is written in letters of the derivation, and so has no value by itself."""
    return any(isinstance(part, tree.Letter | tree.Derivative | tree.BigSum) for part in walk(node))


def members(ring: Ring, formula: Node) -> list[Value]:
    """The values of those members of an equation that have one; a name in words (det) has none."""
    parts = formula.parts if isinstance(formula, Relation) else (formula,)
    named = [part for part in parts if not has_letters(part) and not isinstance(part, tree.Words)]
    return [scalar(evaluated(ring, part)) for part in named]
