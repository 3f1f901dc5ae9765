"""Time derivatives of what coordinates are written in: θ̇_1 + θ̇_2 for θ_1 + θ_2."""

from __future__ import annotations

from dynsolve.answers.reading.grids import Abstract, Grid, Value
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Negative,
    Node,
    Number,
    Product,
    Quotient,
    Sum,
    Symbol,
)


def rate(value: Value, vocabulary: Vocabulary, dots: int) -> Value | None:
    """The time derivative of what is linear in coordinates; None for everything else."""
    if isinstance(value, Abstract):
        return value
    if isinstance(value, Grid):
        if value.is_rates >= 0 and value.is_rates + dots <= 2:
            return vocabulary.velocities(value.is_rates + dots)
        return None
    found: Node | None = value
    for _ in range(dots):
        found = _rate(found, vocabulary) if found is not None else None
    return found


def _rate(node: Node, vocabulary: Vocabulary) -> Node | None:
    match node:
        case Number() | Degrees():
            return ZERO
        case Symbol(name, dots):
            if vocabulary.coordinate(node) is None and not vocabulary.is_reference(name):
                return None
            return Symbol(name, dots + 1) if dots < 2 else None
        case Negative(argument):
            inner = _rate(argument, vocabulary)
            return None if inner is None else Negative(inner)
        case Sum(terms):
            rates = [_rate_of_term(term, vocabulary) for term in terms]
            kept = [r for r in rates if r is not None and r != ZERO]
            if any(r is None for r in rates) or not kept:
                return None
            return kept[0] if len(kept) == 1 else Sum(tuple(kept))
    return None


def _rate_of_term(node: Node, vocabulary: Vocabulary) -> Node | None:
    """That of a term of a sum: a constant has none."""
    if _is_constant(node, vocabulary):
        return ZERO
    return _rate(node, vocabulary)


def _is_constant(node: Node, vocabulary: Vocabulary) -> bool:
    match node:
        case Number() | Degrees():
            return True
        case Symbol():
            return vocabulary.coordinate(node) is None
        case Negative(argument):
            return _is_constant(argument, vocabulary)
        case Product(parts) | Sum(parts):
            return all(_is_constant(part, vocabulary) for part in parts[:20]) and len(parts) <= 20
        case Quotient(p, q):
            return _is_constant(p, vocabulary) and _is_constant(q, vocabulary)
    return False
