"""Uniform bodies and their inertia about the mass centre.

The principal moments are formulas in the letters of the textbook; the same text is
evaluated for a robot and printed in the explanation.  To add a shape, add its record to
`KINDS`: the keys of its dimensions with their letters, and I_xx, I_yy, I_zz about the mass
centre with the shape's own axis along z.  The reader of problem files, the JSON Schema and
the file of `dynsolve new` know it from there, and `python -m dynsolve.problem.schema`
prints the table for `problems/README.md`.

Source: Spong, Hutchinson, Vidyasagar, Robot Modeling and Control (2006), section
7.2.1, for the box and the method: I_xx = ∫ (y² + z²) dm and so on.  The tests hold
every formula against these integrals.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node, Number, Power, Product, Quotient, Sum, Symbol

AXES = ("x", "y", "z")
"""The axes of a body-attached frame."""

MASS = "m"
"""The letter of the mass in the formulas."""


class Slices(Struct, frozen=True):
    """A shape cut across its own axis, along z, into slices at x from its near end; lengths as formulas.

    `extent` is how far x runs, nothing for a disk, `measure` what a density is multiplied by (`per` length,
    area or volume) for the mass of a slice of thickness 1.  A slice of mass dm has the moments dm `turned`
    about the axis, and dm `tilted` about those across, of x and of y, through its own centre.
    """

    per: str
    extent: str
    measure: str
    turned: str
    tilted: tuple[str, str]


class ShapeKind(Struct, frozen=True):
    """A kind of shape: its dimensions and its principal moments.

    `dimensions` are (key in the file, letter in the formulas).  `moments` are
    I_xx, I_yy, I_zz about the mass centre with the body's own axis along z.
    `has_axis` says whether the file may turn that axis, `along_link` whether it
    lies along the link by default.  `slices` are those that a density is integrated over.
    """

    name: str
    dimensions: tuple[tuple[str, str], ...]
    moments: tuple[str, str, str] | None
    has_axis: bool = False
    along_link: bool = False
    slices: Slices | None = None

    @property
    def keys(self) -> tuple[str, ...]:
        """The names of its dimensions in a file."""
        return tuple(key for key, _ in self.dimensions)

    @property
    def is_round(self) -> bool:
        """Whether it is the same in every direction across its axis."""
        return self.slices is None or len(set(self.slices.tilted)) == 1


_BALL_SQUARE = "x*(2*r - x)"  # of the radius of a slice
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
            slices=Slices("volume", "l_z", "l_x*l_y", "(l_x^2 + l_y^2)/12", ("l_y^2/12", "l_x^2/12")),
        ),
        ShapeKind(
            "cylinder",
            (("radius", "r"), ("length", "l")),
            (_ROUND_SIDE, _ROUND_SIDE, "m*r^2/2"),
            has_axis=True,
            along_link=True,
            slices=Slices("volume", "l", "pi*r^2", "r^2/2", ("r^2/4",) * 2),
        ),
        ShapeKind(
            "hollow_cylinder",
            (("outer", "ro"), ("inner", "ri"), ("length", "l")),
            (_HOLLOW_SIDE, _HOLLOW_SIDE, "m*(ro^2 + ri^2)/2"),
            has_axis=True,
            along_link=True,
            slices=Slices("volume", "l", "pi*(ro^2 - ri^2)", "(ro^2 + ri^2)/2", ("(ro^2 + ri^2)/4",) * 2),
        ),
        ShapeKind(
            "rod",
            (("length", "l"),),
            ("m*l^2/12", "m*l^2/12", "0"),
            has_axis=True,
            along_link=True,
            slices=Slices("length", "l", "1", "0", ("0",) * 2),
        ),
        ShapeKind(
            "disk",
            (("radius", "r"),),
            ("m*r^2/4", "m*r^2/4", "m*r^2/2"),
            has_axis=True,
            slices=Slices("area", "", "pi*r^2", "r^2/2", ("r^2/4",) * 2),
        ),
        ShapeKind(
            "sphere",
            (("radius", "r"),),
            ("2*m*r^2/5",) * 3,
            slices=Slices(
                "volume", "2*r", f"pi*{_BALL_SQUARE}", f"{_BALL_SQUARE}/2", (f"{_BALL_SQUARE}/4",) * 2
            ),
        ),
        ShapeKind(
            "shell",
            (("radius", "r"),),
            ("2*m*r^2/3",) * 3,
            slices=Slices("area", "2*r", "2*pi*r", _BALL_SQUARE, (f"{_BALL_SQUARE}/2",) * 2),
        ),
    )
}
"""Every shape by its name."""


class Shape(Struct, frozen=True):
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
        turned = _turned(moments, self.axis or "z") if KINDS[self.kind].has_axis else moments
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


# -- bodies with a density -------------------------------------------------------------------------


class SliceMoment(Struct, frozen=True):
    """A moment of inertia about an axis of the body's frame (`axes`: xx), as formulas.

    `slice` is that of a slice over its mass, about its own centre; `integral` the moment about the axis
    through the near end, `value` that through the mass centre.  About the body's own axis they are the same.
    """

    axes: str
    slice: Node
    integral: Node
    value: Node


class Density(Struct, frozen=True):
    """The density ρ(x) of a shape, x along its axis from its near end, and what follows from it, as formulas.

    `extent` is how far x runs, None for a disk; `mass` = ∫ ρ A dx and `first` = ∫ ρ A x dx are integrals over
    it, A being the `measure` of a slice, and `center` = first/mass.  `begins` says that the near end of
    the shape is that of its link, else its mass centre is given; `shape` is made with the robot.
    """

    formula: Node
    varies: bool
    extent: Node | None
    measure: Node
    mass: Node
    first: Node
    center: Node
    turned: SliceMoment
    tilted: tuple[SliceMoment, SliceMoment]
    begins: bool
    shape: Shape | None = None
