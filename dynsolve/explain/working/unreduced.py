"""The value of a tree as a polynomial before any relation is used: s² + c² is not yet 1.

Two trees of the same exact value have the same unreduced value where only products were
multiplied out and terms collected on the way from one to the other.  Where the unreduced values
differ, an identity of sine and cosine was used; `identities` finds which.
"""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq_mpoly

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.rationals import rational
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)


def unreduced(ring: Ring, node: Node) -> fmpq_mpoly:
    """The polynomial of a scalar tree, its products multiplied out and nothing else done.

    Raises AlgebraError for a tree without a value in the ring.
    """
    match node:
        case Sum(terms):
            return sum((unreduced(ring, term) for term in terms), start=ring.zero.poly)
        case Product(factors):
            product = ring.one.poly
            for factor in factors:
                product = product * unreduced(ring, factor)
            return product
        case Negative(argument):
            return -unreduced(ring, argument)
        case Parenthesized(argument):
            return unreduced(ring, argument)
        case Power(base, Number(p, 1)):
            return unreduced(ring, base) ** p
        case Quotient(numerator, Number(p, q)):
            return unreduced(ring, numerator) * rational(Fraction(q, p))
        case Quotient(numerator, denominator):
            return unreduced(ring, numerator) * ring.inverse(value_of(ring, denominator)).poly
        case Symbol(name, dots):
            return ring.symbol(name, dots).poly
        case Function("sin" | "cos" as name, argument):
            return _turned(ring, name, angle_from_tree(argument))
    return value_of(ring, node).poly


def _turned(ring: Ring, name: str, angle: Angle) -> fmpq_mpoly:
    """The sine or cosine of an angle by the addition theorems alone: cos 2θ = c² - s²."""
    if angle.degrees:
        return (ring.cos(angle) if name == "cos" else ring.sin(angle)).poly
    c, s = ring.one.poly, ring.zero.poly
    for pair, times in zip(ring.pairs, ring.multiples(angle), strict=True):
        c1, s1 = ring.generator(pair.cosine).poly, ring.generator(pair.sine).poly
        for _ in range(abs(times)):
            turn = s1 if times > 0 else -s1
            c, s = c * c1 - s * turn, s * c1 + c * turn
    return c if name == "cos" else s
