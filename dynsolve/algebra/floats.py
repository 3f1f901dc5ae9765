"""The values of exact expressions in floating point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, pi, radians, sin, sqrt

from flint import fmpq_mpoly

from dynsolve.algebra.angles import Atom, names_of
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator, dotted


def evaluate(expr: Expr, values: Mapping[str, float]) -> float:
    """The value at plain names: `theta1`, `theta1_dot`, `theta1_ddot` and the parameters.

    Raises KeyError for a symbol that occurs and has no value.
    """
    for g, degree in zip(expr.ring.generators, expr.poly.degrees(), strict=True):
        if degree > 0:
            _require(g, values)
    return _value(expr.poly, _point(expr, values))


def _require(g: Generator, values: Mapping[str, float]) -> None:
    names = [dotted(g.name, g.dots)] if g.kind == "symbol" else names_of(g.angle)
    for name in names:
        if name != "pi" and name not in values:
            raise KeyError(name)


def _point(expr: Expr, values: Mapping[str, float]) -> list[float]:
    """The value of every generator of the expression's ring."""
    ring = expr.ring
    point = [0.0] * len(ring.generators)
    later: list[Generator] = []
    for g in ring.generators:
        if g.kind == "symbol":
            name = dotted(g.name, g.dots)
            point[g.index] = pi if g.name == "pi" else values.get(name, 0.0)
        elif g.kind in ("sin", "cos", "constant"):
            turn = sum(float(rate) * _atom_value(atom, values) for atom, rate in g.angle.terms)
            angle = radians(float(g.angle.degrees)) + turn
            point[g.index] = sin(angle) if g.kind == "sin" else cos(angle)
        else:
            later.append(g)
    # Roots are of symbols and of roots laid out after them; denominators may hold both.
    for g in sorted(later, key=lambda g: (g.kind == "inverse", -g.index)):
        if g.kind == "root":
            point[g.index] = sqrt(_value(ring.radicands[g.index], point))
        elif g.index in ring.inverses:
            point[g.index] = 1 / _value(ring.inverses[g.index], point)
    return point


def _atom_value(atom: Atom, values: Mapping[str, float]) -> float:
    product = 1.0
    for name, exponent in atom:
        product *= values.get(name, 0.0) ** exponent
    return product


def _value(poly: fmpq_mpoly, point: Sequence[float]) -> float:
    total = 0.0
    for exponents, coefficient in zip(poly.monoms(), poly.coeffs(), strict=True):
        term = int(coefficient.p) / int(coefficient.q)
        for value, exponent in zip(point, exponents, strict=True):
            if exponent:
                term *= value ** int(exponent)
        total += term
    return total
