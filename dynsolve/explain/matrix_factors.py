"""Matrices of bodies with what all entries share in front: J_v = ½ L [...], I = (1/12) m l² [...].

Only where the matrix, with it in front, fits every page: a wider one is given entry by entry.
"""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.compact.collect import matrix_factor
from dynsolve.explain.context import Context, style_of
from dynsolve.notation.build import factors_of, number_in_front
from dynsolve.notation.tree import Matrix, Node, Number, Product, Quotient, Transpose
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.quantities import letters


def matrix_width(context: Context, matrix: Matrix) -> int:
    """How wide a matrix is in characters, two blanks between its columns."""
    printer = UnicodePrinter(style_of(context.robot))
    columns = zip(*matrix.rows, strict=True)
    return sum(max(width(printer.text(entry)) for entry in column) + 2 for column in columns)


WIDEST = 50
"""The characters up to which a matrix has its factor in front."""


def factored(context: Context, node: Node) -> Node:
    """A matrix, or a product of matrices, with what their entries share in front of it."""
    match node:
        case Matrix(rows) if len(rows[0]) > 1 and node.is_zero:
            return letters.bold("0")
        case Matrix():
            found = _factored(context, node)
            return node if found is None else Product((*factors_of(found[0]), found[1]))
        case Product():
            factors = tuple(_flat(node))
            if not any(isinstance(factor, Number | Quotient) for factor in factors):
                return _product(context, factors) or node
    return node


def _flat(product: Product) -> Iterator[Node]:
    """The factors of a product and of the products in it."""
    for factor in product.factors:
        if isinstance(factor, Product):
            yield from _flat(factor)
        else:
            yield factor


def _product(context: Context, factors: tuple[Node, ...]) -> Node | None:
    """A product of matrices, what their entries share in front of it; None where they share nothing."""
    scalars: list[Node] = []
    matrices: list[Node] = []
    for factor in factors:
        inner = factor.argument if isinstance(factor, Transpose) else factor
        if isinstance(inner, Matrix) and (found := _factored(context, inner)):
            scalars.append(found[0])
            matrices.append(found[1] if inner is factor else Transpose(found[1]))
        else:
            (matrices if isinstance(factor, Matrix | Transpose) else scalars).append(factor)
    if not matrices or len(matrices) + len(scalars) == len(factors):
        return None
    collector = context.forms.compactor.collector
    front = number_in_front(collector.product(*collector.decompose(Product(tuple(scalars))), ()))
    return Product((*factors_of(front), *matrices))


def _factored(context: Context, matrix: Matrix) -> tuple[Node, Matrix] | None:
    found = matrix_factor(context.forms.compactor.collector, matrix)
    if found is None or matrix_width(context, found[1]) > WIDEST:
        return None
    return found
