"""The elements of a ring, and what its variables stand for."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from flint import fmpq, fmpq_mpoly

from dynsolve.algebra.angles import Angle
from dynsolve.notation.tree import Node

if TYPE_CHECKING:
    from dynsolve.algebra.ring import Ring


@dataclass(frozen=True, slots=True)
class Generator:
    """What a variable of the polynomial ring stands for.

    kind is one of `sin`, `cos` (with `angle`), `symbol` (with `name`, `dots`),
    `root` (√ of `node`), `inverse` (1 / `node`'s value, set when first met) or
    `constant` (cos of a constant `angle` of some degrees).
    """

    kind: str
    index: int
    name: str = ""
    dots: int = 0
    angle: Angle = Angle()
    node: Node | None = None


@dataclass(frozen=True, slots=True)
class Pair:
    """The sine and cosine of a basic angle, by the indices of their generators."""

    angle: Angle
    sine: int
    cosine: int


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
        from dynsolve.algebra.values import describe

        return f"Expr({describe(self)})"

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
        return Fraction(int(value.p), int(value.q))


def rational(value: int | Fraction) -> fmpq:
    """A rational number as FLINT's."""
    return fmpq(value) if isinstance(value, int) else fmpq(value.numerator, value.denominator)
