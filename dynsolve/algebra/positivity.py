"""What is positive because of how it is written: lengths and masses are, and squares are not negative."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, radians, sin

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.notation.tree import Number


def is_nonnegative(expr: Expr) -> bool:
    """Whether every term has a positive factor and no coordinate, sine or cosine to an odd power.

    Parameters count as positive, as lengths and masses are, save those that the ring's plan calls signed;
    so do roots of numbers, and sines and cosines of constant angles that are positive.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([("d1", "prismatic")], [Symbol("l")])
    >>> l, d = ring.symbol("l"), ring.symbol("d1")
    >>> is_nonnegative(l + d * d), is_nonnegative(l + d), is_nonnegative(l - d * d)
    (True, False, False)
    """
    free = parameters(expr)
    return all(
        factor > 0 and all(e % 2 == 0 or i in free for i, e in enumerate(exponents))
        for exponents, factor in expr.poly.terms()
    )


def is_positive(expr: Expr) -> bool:
    """Whether it is not negative, and one of its terms is a number or holds parameters alone.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([("d1", "prismatic")], [Symbol("l")])
    >>> l, d = ring.symbol("l"), ring.symbol("d1")
    >>> is_positive(l + d * d), is_positive(d * d)
    (True, False)
    """
    free = parameters(expr)
    return is_nonnegative(expr) and any(_holds_only(exponents, free) for exponents in expr.poly.monoms())


def parameters(expr: Expr) -> frozenset[int]:
    """The generators that count as positive."""
    ring = expr.ring
    names = {*ring.names, *ring.plan.signed}
    return frozenset(
        g.index for g in ring.generators if (g.kind == "symbol" and g.name not in names) or _is_constant(g)
    )


def _is_constant(g: Generator) -> bool:
    """Whether a generator is a positive number."""
    if g.kind == "root":
        return isinstance(g.node, Number)
    if g.kind not in ("sin", "cos", "constant") or not g.angle.is_constant:
        return False
    angle = radians(g.angle.degrees)
    return (sin(angle) if g.kind == "sin" else cos(angle)) > 0


def _holds_only(exponents: Sequence[int], places: frozenset[int]) -> bool:
    return all(not e or i in places for i, e in enumerate(exponents))
