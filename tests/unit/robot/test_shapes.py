"""The moments of shapes against integrals over the body, which share no formula with them."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import pytest
import sympy as sp

from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import build_ring
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import Symbol
from dynsolve.robot.shapes import AXES, KINDS, Shape

NAMES = ("m", "x", "y", "z", "r", "ro", "ri", "l")
m, a, b, c, r, ro, ri, length = sp.symbols("m a b c r ro ri l", positive=True)
u, v, w = sp.symbols("u v w", real=True)
s, phi, theta = sp.symbols("s phi theta", real=True)


def ring() -> Ring:
    return build_ring([("q1", "revolute")], [Symbol(name) for name in NAMES])


def about(position, density, *ranges) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """I_xx, I_yy, I_zz of a mass distribution: ∫ (|p|² - p_k²) density."""
    x, y, z = position
    return tuple(
        sp.simplify(sp.integrate(density * square, *ranges))
        for square in (y**2 + z**2, x**2 + z**2, x**2 + y**2)
    )


@cache
def integrals() -> dict[str, tuple[sp.Expr, ...]]:
    tube = (s * sp.cos(phi), s * sp.sin(phi), w)
    ball = (s * sp.sin(theta) * sp.cos(phi), s * sp.sin(theta) * sp.sin(phi), s * sp.cos(theta))
    whole, half = (phi, 0, 2 * sp.pi), (theta, 0, sp.pi)
    along = (w, -length / 2, length / 2)
    sphere = [coordinate.subs(s, r) for coordinate in ball]
    return {
        "box": about((u, v, w), m / (a * b * c), (u, -a / 2, a / 2), (v, -b / 2, b / 2), (w, -c / 2, c / 2)),
        "cylinder": about(tube, s * m / (sp.pi * r**2 * length), (s, 0, r), whole, along),
        "hollow_cylinder": about(tube, s * m / (sp.pi * (ro**2 - ri**2) * length), (s, ri, ro), whole, along),
        "rod": about((0, 0, w), m / length, along),
        "disk": about((tube[0], tube[1], 0), s * m / (sp.pi * r**2), (s, 0, r), whole),
        "sphere": about(
            ball, s**2 * sp.sin(theta) * m / (sp.Rational(4, 3) * sp.pi * r**3), (s, 0, r), half, whole
        ),
        "shell": about(sphere, sp.sin(theta) * m / (4 * sp.pi), half, whole),
    }


@pytest.mark.parametrize("kind", sorted(set(KINDS) - {"point"}))
def test_the_moments_are_the_integrals(kind: str) -> None:
    shape = Shape(kind, (), "z" if KINDS[kind].has_axis else "")
    expected = integrals()[kind]
    letters = {"l_x": a, "l_y": b, "l_z": c, "m": m, "r": r, "ro": ro, "ri": ri, "l": length}
    for (_, formula), integral in zip(shape.formulas, expected, strict=True):
        ours = sp.sympify(to_python(formula), locals=letters)
        assert sp.simplify(ours - integral) == 0


def test_a_shape_is_turned_with_its_axis() -> None:
    algebra = ring()
    mass, dimensions = algebra.symbol("m"), (("radius", algebra.symbol("r")), ("length", algebra.symbol("l")))
    for axis in AXES:
        moments = Shape("cylinder", dimensions, axis).principal_moments(mass)
        along = [name for name, moment in zip(AXES, moments, strict=True) if moments.count(moment) == 1]
        assert along == [axis]


def test_a_tensor_of_numbers() -> None:
    algebra = ring()
    box = Shape("box", tuple((key, algebra.constant(value)) for key, value in (("x", 1), ("y", 2), ("z", 3))))
    tensor = box.inertia(algebra.constant(12))
    assert [[entry.number for entry in row] for row in tensor.rows] == [[13, 0, 0], [0, 10, 0], [0, 0, 5]]
    ball = Shape("sphere", (("radius", algebra.constant(Fraction(1, 2))),)).inertia(algebra.constant(10))
    assert ball[0, 0].number == 1


def test_a_point_has_no_inertia() -> None:
    algebra = ring()
    assert Shape("point").inertia(algebra.symbol("m")).is_zero
    assert Shape("point").formulas == ()
