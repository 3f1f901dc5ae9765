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


class Unreduced:
    """Polynomials of scalar trees in one ring, products multiplied out and nothing else done.

    Raises AlgebraError for a tree without a value in the ring.
    """

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self._turned: dict[Node, tuple[fmpq_mpoly, fmpq_mpoly]] = {}

    def __call__(self, node: Node) -> fmpq_mpoly:
        """The polynomial of a tree."""
        ring = self.ring
        match node:
            case Sum(terms):
                return sum(map(self, terms), start=ring.zero.poly)
            case Product(factors):
                product = ring.one.poly
                for factor in factors:
                    product = product * self(factor)
                return product
            case Negative(argument):
                return -self(argument)
            case Parenthesized(argument):
                return self(argument)
            case Power(base, Number(p, 1)):
                return self(base) ** p
            case Quotient(numerator, Number(p, q)):
                return self(numerator) * rational(Fraction(q, p))
            case Quotient(numerator, denominator):
                return self(numerator) * ring.inverse(value_of(ring, denominator)).poly
            case Symbol(name, dots):
                return ring.symbol(name, dots).poly
            case Function("sin" | "cos" as name, argument):
                return self._cosine_and_sine(argument)[name == "sin"]
        return value_of(ring, node).poly

    def _cosine_and_sine(self, argument: Node) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        found = self._turned.get(argument)
        if found is None:
            found = self._turned[argument] = turned(self.ring, angle_from_tree(argument))
        return found


def turned(ring: Ring, angle: Angle) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """(cos, sin) of an angle by the addition theorems alone: cos 2θ = c² - s²."""
    if angle.degrees:
        return ring.cos(angle).poly, ring.sin(angle).poly
    c, s = ring.one.poly, ring.zero.poly
    for pair, times in zip(ring.pairs, ring.multiples(angle), strict=True):
        c1, s1 = ring.generator(pair.cosine).poly, ring.generator(pair.sine).poly
        for _ in range(abs(times)):
            turn = s1 if times > 0 else -s1
            c, s = c * c1 - s * turn, s * c1 + c * turn
    return c, s
