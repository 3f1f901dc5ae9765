"""How g = 0 is solved: a row that one sine or cosine makes 0 says where, and is put into the others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.ring import Ring
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.sign import sign_of
from dynsolve.notation.tree import ZERO, Degrees, Negative, Node, Row, Words, equation
from dynsolve.quantities import letters


@dataclass(frozen=True, slots=True)
class Zero:
    """Row `row` of g, from 0, is `value` once the zeros before it are put in: 0 where a sine or cosine is."""

    row: int
    value: Expr
    factor: Generator


def zeros(context: Context) -> tuple[Zero, ...] | None:
    """The rows of g one after the other, from the last on; None where one does not say where it is 0."""
    left = [k for k in reversed(range(context.robot.n)) if not context.values["g"][k, 0].is_zero]
    found: list[Zero] = []
    while left:
        told = next((zero for k in left if (zero := _zero(context, k, found)) is not None), None)
        if told is None:
            return None
        found.append(told)
        left.remove(told.row)
    return tuple(found)


def _zero(context: Context, k: int, known: Sequence[Zero]) -> Zero | None:
    """Row k, where a sine or cosine times what surely has a sign is left of it."""
    value = at_zeros(context.values["g"][k, 0], known)
    ring = value.ring
    degrees = value.poly.degrees()
    turning = [g for g in ring.generators if g.kind in ("sin", "cos") and degrees[g.index] > 0]
    if len(turning) != 1:
        return None
    (factor,) = turning
    beside = _put(value, {factor.index: 1})
    if value != beside * ring.generator(factor.index) or not sign_of(context, beside):
        return None
    return Zero(k, value, factor)


def at_zeros(value: Expr, known: Sequence[Zero]) -> Expr:
    """A value where the rows of g are 0."""
    return _put(value, {zero.factor.index: 0 for zero in known})


def _put(value: Expr, images: Mapping[int, int]) -> Expr:
    """A value with numbers for some generators."""
    ring = value.ring
    point = [
        (ring.constant(images[g.index]) if g.index in images else ring.generator(g.index)).poly
        for g in ring.generators
    ]
    return Expr(ring, ring.reduce(value.poly.compose(*point, ctx=ring.ctx)))


def written(context: Context, zero: Zero) -> Node:
    """g_3 = m_3 g l_c3 c_23 = 0, so c_23 = 0, θ_2 + θ_3 = ±90°"""
    ring = context.robot.ring
    row = equation(letters.entry("g", zero.row + 1), context.show(zero.value), ZERO)
    factor = equation(context.show(ring.generator(zero.factor.index)), ZERO)
    return Row((row, Words(", so "), factor, Words(", "), _angle(ring, zero.factor)))


def _angle(ring: Ring, factor: Generator) -> Node:
    """Where a sine or a cosine is 0."""
    is_sine = factor.kind == "sin"
    one, other = (ZERO, Degrees(180)) if is_sine else (Degrees(90), Negative(Degrees(90)))
    return Row((equation(angle_node(factor.angle, ring.names), one), Words(" or "), other))
