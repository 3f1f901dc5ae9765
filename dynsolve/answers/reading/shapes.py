"""Values in the shape of the answers they are given for: columns, zeros, the parts of a model."""

from __future__ import annotations

from dynsolve.answers.reading.grids import Grid, Value, transposed
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.names import split
from dynsolve.notation.tree import (
    ZERO,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
)
from dynsolve.notation.unicode import printable
from dynsolve.notation.walk import names_in, walk
from dynsolve.quantities import families
from dynsolve.quantities.model_families import REFERENCE

_LONGEST_SHOWN = 2_000
_ZEROS = "0"
"""What a vector of zeros is called until it is known what stands beside it."""


def model_parts(vocabulary: Vocabulary, value: Value) -> dict[str, Value]:
    """D, C or the vector C q̇, and g of a model [..][q̈] + [..][q̇] + [..], or [..][q̈] + [..] + [..]; Y and a.

    Of several vectors that are one and the same by their rates, as C q̇ and friction, none is taken.
    """
    n = len(vocabulary.coordinates)
    if isinstance(value, Grid) and value.factors:
        return _regressor_parts(vocabulary, value)
    if not isinstance(value, Grid) or not value.terms:
        return {}
    parts: dict[str, Value] = {}
    vectors: list[tuple[str, Value]] = []
    for term in value.terms:
        if not term.factors:
            vectors.append((_vector_name(term), term))
            continue
        matrix, right = term.factors
        name = {2: "D", 1: "C"}.get(right.is_rates, "")
        if matrix.shape != (n, n) or not name or name in parts:
            return {}
        parts[name] = matrix
    names = [name for name, _ in vectors]
    zeros = "Cqd" if "g" in names else "g"
    names = [zeros if name == _ZEROS else name for name in names]
    parts |= {
        name: vector
        for name, (_, vector) in zip(names, vectors, strict=True)
        if name and names.count(name) == 1
    }
    if "C" in parts:
        parts.pop("Cqd", None)
    return parts if "D" in parts else {}


def _regressor_parts(vocabulary: Vocabulary, value: Grid) -> dict[str, Value]:
    """Y and a of their product, a being free of everything that moves."""
    assert value.factors
    Y, a = value.factors
    moving = {q.name for q in vocabulary.coordinates}
    name = REFERENCE if any(map(vocabulary.is_reference, names_in(Y.node))) else "Y"
    is_regressor = name in vocabulary.quantities and value.shape == (len(moving), 1) and not Y.quantity
    return {name: Y, "a": a} if is_regressor and names_in(a.node).isdisjoint(moving) else {}


def _vector_name(term: Grid) -> str:
    """What a vector beside D q̈ is: C q̇ where it vanishes at rest, g where it holds no rates, else both."""
    entries = [entry for row in term.rows for entry in row]
    if all(entry == ZERO for entry in entries):
        return _ZEROS
    if not any(_has_rates(entry) for entry in entries):
        return "g"
    return "Cqd" if all(_vanishes_at_rest(entry) for entry in entries) else ""


def _has_rates(node: Node) -> bool:
    return any(isinstance(part, Symbol) and part.dots for part in walk(node))


def _vanishes_at_rest(node: Node) -> bool:
    """Whether a velocity is a factor of every term, as the formula is written."""
    match node:
        case Sum(terms):
            return all(_vanishes_at_rest(term) for term in terms)
        case Product(factors):
            return any(_vanishes_at_rest(factor) for factor in factors)
        case Negative(argument):
            return _vanishes_at_rest(argument)
        case Quotient(numerator):
            return _vanishes_at_rest(numerator)
        case Power(base):
            return _vanishes_at_rest(base)
        case Symbol(_, dots):
            return dots == 1
    return node == ZERO


def fitted(vocabulary: Vocabulary, candidates: tuple[str, ...], value: Value) -> list[tuple[str, Node, str]]:
    """(name, tree, note) of the candidates that a value can be, of its very shape if any is."""
    exact: list[tuple[str, Node, str]] = []
    loose: list[tuple[str, Node, str]] = []
    for name in candidates:
        shape = vocabulary.shape(name)
        if shape is None:
            if isinstance(value, Node):
                exact.append((name, value, ""))
        elif isinstance(value, Grid):
            if value.shape == shape:
                exact.append((name, value.node, ""))
            elif value.shape == shape[::-1] and 1 in shape:
                turned = transposed(value)
                assert isinstance(turned, Grid)
                loose.insert(0, (name, turned.node, "the row is read as a column"))
            elif 0 in shape:  # of any size: B is D only where it has the size of D
                loose.insert(0, (name, value.node, ""))
            elif name != "Cqd" or 1 in value.shape:  # N = Ḋ - 2C and other matrices have its letters
                loose.append((name, value.node, ""))
        elif shape == (1, 1) and isinstance(value, Node):
            exact.append((name, Matrix(((value,),)), ""))
        elif isinstance(value, Node) and value != ZERO and vocabulary.quantities[name].family is families.W:
            loose.append((name, Matrix(((value,),)), ""))  # of a planar robot, whose axis is known
        elif value == ZERO and 0 in shape:
            exact.append((name, Matrix(((value,),)), ""))
        elif value == ZERO:
            rows, columns = shape
            zeros = Matrix(((ZERO,) * columns,) * rows)
            loose.append((name, zeros, "0 is read as the matrix of zeros"))
    return exact or loose


def with_own_entries(vocabulary: Vocabulary, name: str, node: Node) -> Node:
    """A matrix with its entries for their names: the d_12 below the diagonal of D."""
    if not isinstance(node, Matrix) or not any(isinstance(e, Reference) for row in node.rows for e in row):
        return node

    def entry(found: Node) -> Node:
        if isinstance(found, Reference):
            whole, place = vocabulary.quantities.entry_of(found.quantity)
            if whole == name and not isinstance(node.rows[place[0]][place[1]], Reference):
                return node.rows[place[0]][place[1]]
        return found

    return Matrix(tuple(tuple(entry(found) for found in row) for row in node.rows))


def is_gravity_vector(value: Value, coordinates: int) -> bool:
    """Whether a value is the acceleration of gravity as a vector: one entry alone, g or -9.81.

    A number is taken for that only where the vector is none of generalized forces by its length.
    """
    if not isinstance(value, Grid) or 1 not in value.shape or max(value.shape) not in (2, 3):
        return False
    entries = [entry for row in value.rows for entry in row if entry != ZERO]
    if len(entries) != 1:
        return False
    entry = entries[0].argument if isinstance(entries[0], Negative) else entries[0]
    if isinstance(entry, Number):
        return max(value.shape) != coordinates and 9 < entry.p / entry.q < 11
    return isinstance(entry, Symbol) and split(entry.name)[0] == "g"


def misfit(
    vocabulary: Vocabulary, candidates: tuple[str, ...], value: Value, start: int, end: int
) -> ReadError:
    """The error about a value that none of its names can have."""
    name = candidates[0]
    shape = vocabulary.shape(name)
    found = f"a {value.shape[0]}×{value.shape[1]} matrix" if isinstance(value, Grid) else "one expression"
    wanted = f"a {shape[0]}×{shape[1]} matrix" if shape else "one expression"
    return ReadError(f"{name} is {wanted}; this is {found}", start, max(end - start, 1), f"write {wanted}")


def shown(text: str) -> str:
    """A text as it is kept with what was not recognized."""
    text = printable(" ".join(text.split()))
    return text if len(text) <= _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 3] + "..."
