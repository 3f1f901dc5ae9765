"""The values of exact expressions in floating point."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, radians, sin, sqrt
from typing import TYPE_CHECKING

from flint import fmpq_mpoly

from dynsolve.algebra.angles import Atom, names_of
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator, dotted

if TYPE_CHECKING:
    from dynsolve.algebra.ring import Ring


def evaluate(expr: Expr, values: Mapping[str, float]) -> float:
    """The value at plain names: `theta1`, `theta1_dot`, `theta1_ddot` and the parameters.

    Raises KeyError for a symbol that occurs and has no value.
    """
    return _value(expr.ring, expr.poly, values, {})


def _require(g: Generator, values: Mapping[str, float]) -> None:
    names = [dotted(g.name, g.dots)] if g.kind == "symbol" else names_of(g.angle)
    for name in names:
        if name != "pi" and name not in values:
            raise KeyError(name)


def _generator(ring: Ring, g: Generator, values: Mapping[str, float], known: dict[int, float]) -> float:
    """The value of a generator; roots and inverses are of expressions in others."""
    match g.kind:
        case "symbol":
            name = dotted(g.name, g.dots)
            return pi if g.name == "pi" else values[name]
        case "root":
            return sqrt(_value(ring, ring.radicands[g.index], values, known))
        case "inverse":
            return 1 / _value(ring, ring.inverses[g.index], values, known)
    turn = sum(float(rate) * _atom_value(atom, values) for atom, rate in g.angle.terms)
    angle = radians(float(g.angle.degrees)) + turn
    return sin(angle) if g.kind == "sin" else cos(angle)


def _atom_value(atom: Atom, values: Mapping[str, float]) -> float:
    product = 1.0
    for name, exponent in atom:
        product *= values.get(name, 0.0) ** exponent
    return product


def _value(ring: Ring, poly: fmpq_mpoly, values: Mapping[str, float], known: dict[int, float]) -> float:
    """The value of a polynomial; `known` are generators whose values were found before."""
    places = [index for index, degree in enumerate(poly.degrees()) if degree > 0]
    for index in places:
        if index not in known:
            g = ring.generators[index]
            _require(g, values)
            known[index] = _generator(ring, g, values, known)
    total = 0.0
    for exponents, coefficient in zip(poly.monoms(), poly.coeffs(), strict=True):
        term = int(coefficient.p) / int(coefficient.q)
        for index in places:
            if exponents[index]:
                term *= known[index] ** int(exponents[index])
        total += term
    return total
