"""Uniform bodies and their inertia about the mass centre.

The principal moments are formulas in the letters of the textbook; the same text is
evaluated for a robot and printed in the explanation.  To add a shape, add its record to
`KINDS`: the keys of its dimensions with their letters, and I_xx, I_yy, I_zz about the mass
centre with the shape's own axis along z.  The reader of problem files, the JSON Schema and
the file of `dynsolve new` know it from there, and `python -m dynsolve.problem.documentation`
prints the table for `problems/README.md`.

Source: Spong, Hutchinson, Vidyasagar, Robot Modeling and Control (2006), section
7.2.1, for the box and the method: I_xx = ∫ (y² + z²) dm and so on.  The tests hold
every formula against these integrals.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node, Number, Power, Product, Quotient, Sum, Symbol

AXES = ("x", "y", "z")
"""The axes of a body-attached frame."""

MASS = "m"
"""The letter of the mass in the formulas."""


@dataclass(frozen=True, slots=True)
class ShapeKind:
    """A kind of shape: its dimensions and its principal moments.

    `dimensions` are (key in the file, letter in the formulas).  `moments` are
    I_xx, I_yy, I_zz about the mass centre with the body's own axis along z.
    `has_axis` says whether the file may turn that axis, `along_link` whether it
    lies along the link by default, `varies` whether it may have a density.
    """

    name: str
    dimensions: tuple[tuple[str, str], ...]
    moments: tuple[str, str, str] | None
    has_axis: bool = False
    along_link: bool = False
    varies: bool = False

    @property
    def keys(self) -> tuple[str, ...]:
        """The names of its dimensions in a file."""
        return tuple(key for key, _ in self.dimensions)


_ROUND_SIDE = "m*(3*r^2 + l^2)/12"
_HOLLOW_SIDE = "m*(3*(ro^2 + ri^2) + l^2)/12"

KINDS: Mapping[str, ShapeKind] = {
    kind.name: kind
    for kind in (
        ShapeKind("point", (), None),
        ShapeKind(
            "box",
            (("x", "l_x"), ("y", "l_y"), ("z", "l_z")),
            ("m*(l_y^2 + l_z^2)/12", "m*(l_x^2 + l_z^2)/12", "m*(l_x^2 + l_y^2)/12"),
        ),
        ShapeKind(
            "cylinder",
            (("radius", "r"), ("length", "l")),
            (_ROUND_SIDE, _ROUND_SIDE, "m*r^2/2"),
            has_axis=True,
            along_link=True,
        ),
        ShapeKind(
            "hollow_cylinder",
            (("outer", "ro"), ("inner", "ri"), ("length", "l")),
            (_HOLLOW_SIDE, _HOLLOW_SIDE, "m*(ro^2 + ri^2)/2"),
            has_axis=True,
            along_link=True,
        ),
        ShapeKind(
            "rod",
            (("length", "l"),),
            ("m*l^2/12", "m*l^2/12", "0"),
            has_axis=True,
            along_link=True,
            varies=True,
        ),
        ShapeKind("disk", (("radius", "r"),), ("m*r^2/4", "m*r^2/4", "m*r^2/2"), has_axis=True),
        ShapeKind("sphere", (("radius", "r"),), ("2*m*r^2/5",) * 3),
        ShapeKind("shell", (("radius", "r"),), ("2*m*r^2/3",) * 3),
    )
}
"""Every shape by its name."""


@dataclass(frozen=True, slots=True)
class LineDensity:
    """A rod whose mass per length varies: ρ(x), x from its near end, along `axis` of the body's frame.

    As formulas: its length, the integrals M_0 = ∫ ρ dx, M_1 = ∫ ρ x dx and M_2 = ∫ ρ x² dx over it, the place
    M_1/M_0 of the mass centre, and the moment M_2 - M_1²/M_0 across the rod about it.
    """

    density: Node
    length: Node
    axis: str
    mass: Node
    first: Node
    second: Node
    center: Node
    across: Node


@dataclass(frozen=True, slots=True)
class Shape:
    """A uniform body: its kind, its dimensions (m) and the body-attached axis it is turned to.

    `axis` is empty where the kind has none.
    """

    kind: str
    dimensions: tuple[tuple[str, Expr], ...] = ()
    axis: str = ""

    @property
    def formulas(self) -> tuple[tuple[str, Node], ...]:
        """(`xx`, I_xx), (`yy`, I_yy), (`zz`, I_zz) as the textbook prints them; none for a point."""
        moments = KINDS[self.kind].moments
        if moments is None:
            return ()
        turned = _turned(moments, self.axis or "z")
        return tuple((2 * axis, _formula(text)) for axis, text in zip(AXES, turned, strict=True))

    @property
    def letters(self) -> tuple[tuple[str, Expr], ...]:
        """(letter in the formulas, its value here) of every dimension."""
        letters = dict(KINDS[self.kind].dimensions)
        return tuple((letters[key], value) for key, value in self.dimensions)

    def principal_moments(self, mass: Expr) -> tuple[Expr, Expr, Expr]:
        """I_xx, I_yy, I_zz (kg m²) about the mass centre, in the body-attached frame."""
        values = {MASS: mass, **dict(self.letters)}
        if not self.formulas:
            return (mass.ring.zero,) * 3
        xx, yy, zz = (_value(formula, values) for _, formula in self.formulas)
        return xx, yy, zz

    def inertia(self, mass: Expr) -> Matrix:
        """The tensor, 3×3 diagonal (kg m²), about the mass centre, in the body-attached frame."""
        moments, zero = self.principal_moments(mass), mass.ring.zero
        return Matrix.of(mass.ring, ([moments[i] if i == j else zero for j in range(3)] for i in range(3)))


def _turned(moments: tuple[str, str, str], axis: str) -> tuple[str, str, str]:
    """The moments of a body whose own axis lies along `axis` instead of z; the other two are equal."""
    if axis == "z":
        return moments
    across, _, along = moments
    return (along, across, across) if axis == "x" else (across, along, across)


@lru_cache(maxsize=64)
def _formula(text: str) -> Node:
    return read(text).tree


def _value(node: Node, values: Mapping[str, Expr]) -> Expr:
    """A formula of this module's table with values put in."""
    ring = values[MASS].ring
    match node:
        case Number(p, q):
            return ring.constant(Fraction(p, q))
        case Symbol(name):
            return values[name]
        case Sum(terms):
            total = ring.zero
            for term in terms:
                total = total + _value(term, values)
            return total
        case Product(factors):
            product = ring.one
            for factor in factors:
                product = product * _value(factor, values)
            return product
        case Quotient(numerator, Number(p, q)):
            return _value(numerator, values) / Fraction(p, q)
        case Power(base, Number(p, 1)):
            return _value(base, values) ** p
    raise TypeError(f"a formula of a shape is not made of {type(node).__name__}")
