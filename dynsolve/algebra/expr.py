"""The elements of a ring.

An element and its ring know each other; when the program runs, `ring` imports this
file, and this file imports `ring` for its type alone.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from flint import fmpq, fmpq_mpoly

from dynsolve.algebra.generators import Generator, dotted
from dynsolve.algebra.rationals import fraction, rational

if TYPE_CHECKING:
    from dynsolve.algebra.ring import Ring


class Expr:
    """An element of a ring, in normal form.  Immutable; `==` decides equality exactly."""

    __slots__ = ("poly", "ring")

    def __init__(self, ring: Ring, poly: fmpq_mpoly) -> None:
        self.ring = ring
        self.poly = poly

    def __add__(self, other: Expr) -> Expr:
        return Expr(self.ring, self.poly + other.poly)

    def __sub__(self, other: Expr) -> Expr:
        return Expr(self.ring, self.poly - other.poly)

    def __neg__(self) -> Expr:
        return Expr(self.ring, -self.poly)

    def __mul__(self, other: Expr | int | Fraction) -> Expr:
        if isinstance(other, Expr):
            return Expr(self.ring, self.ring.reduce(self.poly * other.poly))
        return Expr(self.ring, self.poly * rational(other))

    __rmul__ = __mul__

    def __truediv__(self, other: int | Fraction) -> Expr:
        return Expr(self.ring, self.poly / rational(other))

    def __pow__(self, exponent: int) -> Expr:
        power = self.ring.one
        for _ in range(exponent):
            power = power * self
        return power

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Expr) and bool(self.poly == other.poly)

    def __hash__(self) -> int:
        return hash(str(self.poly))

    def __repr__(self) -> str:
        """The normal form as text, for people who debug."""
        names = [_text(g) for g in self.ring.generators]
        terms = []
        for exponents, coefficient in self.poly.to_dict().items():
            powers = [f"{names[i]}^{e}" if e > 1 else names[i] for i, e in enumerate(exponents) if e]
            terms.append("*".join([str(coefficient), *powers]))
        return f"Expr({' + '.join(terms) or '0'})"

    @property
    def is_zero(self) -> bool:
        """Whether it is 0."""
        return not self.poly

    @property
    def is_number(self) -> bool:
        """Whether it is a rational number."""
        return bool(self.poly.is_constant())

    def __len__(self) -> int:
        """The number of terms of the normal form."""
        return len(self.poly)

    @property
    def number(self) -> Fraction:
        """Its value where `is_number`."""
        value = self.poly.leading_coefficient() if self.poly else fmpq(0)
        return fraction(value)


def _text(g: Generator) -> str:
    if g.kind in ("sin", "cos"):
        return f"{g.kind}({' + '.join(f'{rate}*{atom}' for atom, rate in g.angle.terms)})"
    return dotted(g.name, g.dots) or f"{g.kind}{g.index}"
