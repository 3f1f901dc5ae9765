"""The elements of a ring.

An element and its ring know each other; when the program runs, `ring` imports this
file, and this file imports `ring` for its type alone.

The generators of a ring: the variables of its polynomials, and the meaning of each.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from flint import fmpq, fmpq_mpoly
from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.rationals import fraction, rational
from dynsolve.algebra.ring_plan import RingPlan
from dynsolve.notation.tree import Function, Node

if TYPE_CHECKING:
    from dynsolve.algebra.ring import Ring


# The generators of a ring: the variables of its polynomials, and the meaning of each


class Generator(Struct, frozen=True):
    """One variable of the polynomial ring.

    kind is one of `sin`, `cos` (with `angle`), `symbol` (with `name`, `dots`),
    `root` (√ of `node`), `inverse` (1 / a polynomial, set when first needed),
    `constant` (cos of a constant `angle` of some degrees) or `function` (`node`, a
    function that is no polynomial: the sign of a rate, or of an argument without an exact meaning here).
    """

    kind: str
    index: int
    name: str = ""
    dots: int = 0
    angle: Angle = Angle()
    node: Node | None = None


class Pair(Struct, frozen=True):
    """The sine and cosine of a basic angle, by the indices of their generators."""

    angle: Angle
    sine: int
    cosine: int


def is_sign(node: Node | None) -> bool:
    """Whether a function is the sign of a rate, sgn q̇: a generator that is 0 at rest."""
    return isinstance(node, Function) and node.name == "sgn"


def dotted(name: str, dots: int) -> str:
    """The plain name of a symbol or of its derivative: `theta1`, `theta1_dot`, `theta1_ddot`."""
    return f"{name}_{'d' * dots}ot" if dots else name


def lay_out(plan: RingPlan) -> tuple[Generator, ...]:
    """The generators of a ring: those that a relation eliminates first, the plain symbols last."""
    laid: list[Generator] = []

    def add(kind: str, **what: Any) -> None:
        laid.append(Generator(kind, len(laid), **what))

    for _ in range(plan.inverses):
        add("inverse")
    for kind in ("sin", "cos"):
        for angle in plan.basic_angles:
            add(kind, angle=angle)
    for node in reversed(plan.roots):
        add("root", node=node)
    if plan.constants.generator_degrees is not None:
        add("constant", angle=Angle((), plan.constants.generator_degrees))
    for dots in (2, 1, 0):
        for name in (*plan.coordinates, *(plan.references if dots else ())):
            add("symbol", name=name, dots=dots)
    for function in plan.functions:
        add("function", node=function)
    for name in plan.symbols:  # last, so that further parameters leave the places of the others as they are
        if name not in plan.coordinates:
            add("symbol", name=name)
    return tuple(laid)


def sine_cosine_pairs(generators: Sequence[Generator]) -> tuple[Pair, ...]:
    """The sines and cosines among the generators, angle by angle."""
    sines = [g for g in generators if g.kind == "sin"]
    cosines = [g for g in generators if g.kind == "cos"]
    return tuple(Pair(s.angle, s.index, c.index) for s, c in zip(sines, cosines, strict=True))


Terms = tuple[tuple[float, tuple[tuple[int, int], ...]], ...]
"""Of each term its coefficient, and its generators with their powers."""


def terms_of(poly: fmpq_mpoly) -> Terms:
    """The terms of a polynomial in floating point."""
    places = [index for index, degree in enumerate(poly.degrees()) if degree > 0]
    return tuple(
        (
            int(coefficient.p) / int(coefficient.q),
            tuple((index, int(exponents[index])) for index in places if exponents[index]),
        )
        for exponents, coefficient in zip(poly.monoms(), poly.coeffs(), strict=True)
    )


class Expr:
    """An element of a ring, in normal form.  Immutable; `==` decides equality exactly."""

    __slots__ = ("_terms", "poly", "ring")

    def __init__(self, ring: Ring, poly: fmpq_mpoly) -> None:
        self.ring = ring
        self.poly = poly
        self._terms: Terms | None = None

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

    @property
    def used(self) -> tuple[int, ...]:
        """The places of the generators that occur."""
        return tuple(i for i, degree in enumerate(self.poly.degrees()) if degree > 0)

    @property
    def terms(self) -> Terms:
        """Its terms in floating point, written once: it is evaluated at many points."""
        if self._terms is None:
            self._terms = terms_of(self.poly)
        return self._terms

    def quotient(self, divisor: Expr) -> Expr | None:
        """This over a divisor, None where that does not divide it."""
        quotient, rest = divmod(self.poly, divisor.poly)
        return None if rest else Expr(self.ring, quotient)

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
