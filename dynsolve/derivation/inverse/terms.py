"""An expression by what its unknowns do in it: A cos ψ + B sin ψ + C, or A d² + B d + C."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fourier import fourier_form
from dynsolve.algebra.rationals import rational
from dynsolve.derivation.inverse.unknowns import Unknowns

Multiples = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Harmonic:
    """A cos ψ + B sin ψ + C, where ψ = Σ multiples·q over unknown angles, each by its name."""

    multiples: tuple[tuple[str, int], ...]
    cosine: Expr
    sine: Expr
    constant: Expr

    @property
    def coordinate(self) -> str | None:
        """The unknown that ψ is, None where ψ is a sum of several or a multiple."""
        return self.multiples[0][0] if len(self.multiples) == 1 and self.multiples[0][1] == 1 else None


def harmonic(expr: Expr, unknowns: Unknowns) -> Harmonic | None:
    """The expression as A cos ψ + B sin ψ + C with A, B, C free of unknowns; None where it is no such sum."""
    if any(unknowns.has(expr, name) for name in unknowns.sliding):
        return None
    names = [name for name in unknowns.turning if unknowns.has(expr, name)]
    if not names:
        return None
    parts = _fourier(expr, names, unknowns)
    constant = parts.pop((0,) * len(names), (unknowns.ring.zero, unknowns.ring.zero))[0]
    if len(parts) != 1:
        return None
    ((multiples, (cosine, sine)),) = parts.items()
    return Harmonic(tuple((n, m) for n, m in zip(names, multiples, strict=True) if m), cosine, sine, constant)


def _fourier(expr: Expr, names: list[str], unknowns: Unknowns) -> dict[Multiples, tuple[Expr, Expr]]:
    """{n: (A, B)} of Σ A cos(n·q) + B sin(n·q) over some unknown angles."""
    ring = expr.ring
    places = [place for name in names for place in unknowns.pair(name)]
    grouped: dict[tuple[int, ...], dict[tuple[int, ...], Fraction]] = {}
    for exponents, factor in expr.poly.to_dict().items():
        powers = tuple(int(exponents[i]) for i in places)
        rest = tuple(0 if i in places else int(e) for i, e in enumerate(exponents))
        grouped.setdefault(rest, {})[powers] = Fraction(int(factor.p), int(factor.q))
    sums: dict[Multiples, tuple[dict[Any, Any], dict[Any, Any]]] = {}
    for rest, polynomial in grouped.items():
        for multiples, (a, b) in fourier_form(polynomial).items():
            cosines, sines = sums.setdefault(multiples, ({}, {}))
            _put(cosines, rest, a)
            _put(sines, rest, b)
    return {n: (_expr(ring, a), _expr(ring, b)) for n, (a, b) in sums.items()}


def _put(terms: dict[Any, Any], exponents: tuple[int, ...], value: Fraction) -> None:
    if value:
        terms[exponents] = rational(value)


def _expr(ring: Any, terms: Mapping[Any, Any]) -> Expr:
    return Expr(ring, ring.ctx.from_dict(dict(terms)))


@dataclass(frozen=True, slots=True)
class Quadratic:
    """A d² + B d + C in one unknown length, with A, B, C free of unknowns."""

    coordinate: str
    square: Expr
    linear: Expr
    constant: Expr


def quadratic(expr: Expr, unknowns: Unknowns) -> Quadratic | None:
    """The expression as A d² + B d + C; None where it holds other unknowns or higher powers."""
    within = unknowns.within(expr)
    if len(within) != 1 or within[0] not in unknowns.sliding:
        return None
    ring, name = expr.ring, within[0]
    index = ring.symbol_indices[(name, 0)]
    if int(expr.poly.degrees()[index]) > 2:
        return None
    by_power: tuple[dict[Any, Any], ...] = ({}, {}, {})
    for exponents, factor in expr.poly.to_dict().items():
        rest = (*exponents[:index], 0, *exponents[index + 1 :])
        by_power[int(exponents[index])][rest] = factor
    constant, linear, square = (_expr(ring, terms) for terms in by_power)
    return Quadratic(name, square, linear, constant)
