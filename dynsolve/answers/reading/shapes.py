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
    Symbol,
)
from dynsolve.notation.unicode import printable

_LONGEST_SHOWN = 2_000


def model_parts(vocabulary: Vocabulary, value: Value) -> dict[str, Value]:
    """D, C and g of a model [..][q̈] + [..][q̇] + [..]."""
    if not isinstance(value, Grid) or not value.terms:
        return {}
    n = len(vocabulary.coordinates)
    parts: dict[str, Value] = {}
    for term in value.terms:
        if term.factors:
            left, right = term.factors
            name = {2: "D", 1: "C"}.get(right.is_rates, "")
            if left.shape != (n, n):
                return {}
            part: Value = left
        else:
            name, part = "g", term
        if not name or name in parts:
            return {}
        parts[name] = part
    return parts if "D" in parts else {}


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
            else:
                loose.append((name, value.node, ""))
        elif shape == (1, 1) and isinstance(value, Node):
            exact.append((name, Matrix(((value,),)), ""))
        elif value == ZERO:
            rows, columns = shape
            zeros = Matrix(((ZERO,) * columns,) * rows)
            loose.append((name, zeros, "0 is read as the matrix of zeros"))
    return exact or loose


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
