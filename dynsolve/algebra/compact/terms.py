"""A polynomial as a dictionary of terms, laid out for collecting.

The exponents of a term stand in the order in which a person collects: the angle
groups from the base outwards, masses and inertias, the other parameters and
coordinates, velocities and accelerations.  So each step of collecting cuts a
piece off an end, and keys only become shorter.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import gcd, lcm
from typing import Any, TypeVar

from flint import Ordering, fmpq_mpoly_ctx

from dynsolve.algebra.expr import Expr

Rational = int | Fraction
"""A rational factor: an int wherever it is whole, since those are fast."""

Exponents = tuple[int, ...]
Terms = dict[Exponents, Rational]

_Key = TypeVar("_Key", bound=Hashable)


def exact(value: Rational, divisor: Rational) -> Rational:
    """value / divisor, an int where it is whole."""
    if isinstance(value, int) and isinstance(divisor, int) and not value % divisor:
        return value // divisor
    quotient = Fraction(value) / divisor
    return quotient.numerator if quotient.denominator == 1 else quotient


def add_term(poly: dict[_Key, Rational], key: _Key, factor: Rational) -> None:
    """Add a term to a polynomial; one that cancels is left out."""
    total = poly.get(key, 0) + factor
    if total:
        poly[key] = total
    else:
        poly.pop(key, None)


def primitive(poly: Mapping[_Key, Rational]) -> tuple[frozenset[tuple[_Key, Rational]], Rational]:
    """(key, factor): polynomials that differ by a rational factor alone share the key.

    >>> primitive({"x": 2, "y": -4}) == (frozenset({("x", 1), ("y", -2)}), 2)
    True
    """
    values = poly.values()
    if all(type(f) is int for f in values):
        denominator, whole = 1, poly
    else:
        denominator = lcm(*(f.denominator for f in values))
        whole = {k: int(f * denominator) for k, f in poly.items()}
    shared = gcd(*whole.values())  # type: ignore[arg-type]
    if whole[min(whole)] < 0:  # type: ignore[type-var]
        shared = -shared
    if shared == 1:
        key: Any = frozenset(whole.items())
    else:
        key = frozenset((k, f // shared) for k, f in whole.items())
    return key, shared if denominator == 1 else exact(shared, denominator)


@dataclass(frozen=True, slots=True)
class TermLayout:
    """Which generator each place of the exponents belongs to.

    `groups` are (number of the angle group, how many places it has), the next one
    first; `leading`, `parameters` and `rates` are generators' indices.
    """

    groups: tuple[tuple[int, int], ...]
    leading: tuple[int, ...]
    parameters: tuple[int, ...]
    rates: tuple[int, ...]

    def without_rates(self) -> TermLayout:
        """The layout after the velocities have been split off."""
        return replace(self, rates=())

    def without_leading(self) -> TermLayout:
        """The layout after the masses have been split off."""
        return replace(self, leading=())

    def without_group(self) -> TermLayout:
        """The layout after the first angle group has been split off."""
        return replace(self, groups=self.groups[1:])

    @property
    def symbols(self) -> tuple[int, ...]:
        """The generators of the places that are no angles."""
        return self.leading + self.parameters + self.rates


def split_tail(terms: Terms, width: int) -> dict[Exponents, Terms]:
    """The terms by their last `width` exponents."""
    result: dict[Exponents, Terms] = {}
    for e, f in terms.items():
        result.setdefault(e[-width:], {})[e[:-width]] = f
    return result


def split_middle(terms: Terms, start: int, stop: int) -> dict[Exponents, Terms]:
    """The terms by their exponents from `start` to `stop`."""
    result: dict[Exponents, Terms] = {}
    for e, f in terms.items():
        result.setdefault(e[start:stop], {})[e[:start] + e[stop:]] = f
    return result


def read_terms(
    expr: Expr, groups: Sequence[Sequence[int]], kinds: Mapping[int, str]
) -> tuple[TermLayout, Terms]:
    """The terms of an expression in the layout of the generators it uses.

    `groups` are the angle groups' generators, sines and cosines in turn; `kinds`
    says `leading`, `parameter` or `rate` of the others.
    """
    used = {i for i, degree in enumerate(expr.poly.degrees()) if degree}
    present = [(g, places) for g, places in enumerate(groups) if not used.isdisjoint(places)]
    rest = {
        kind: tuple(i for i in sorted(used) if kinds.get(i) == kind)
        for kind in ("leading", "parameter", "rate")
    }
    layout = TermLayout(
        tuple((g, len(places)) for g, places in present), rest["leading"], rest["parameter"], rest["rate"]
    )
    order = [*(i for _, places in present for i in places), *layout.symbols]
    if not order:
        return layout, {(): _factor(expr.poly.leading_coefficient())}
    # Reading through a ring of these generators alone is several times faster.  FLINT has one context for
    # one name and size, and projects nothing onto the polynomial's own: so it has another name.
    small = fmpq_mpoly_ctx.get(("term", len(order)), Ordering.lex)
    place = {i: k for k, i in enumerate(order)}
    projected = expr.poly.project_to_context(small, {i: place[i] for i in used})
    return layout, {tuple(map(int, e)): _factor(f) for e, f in projected.to_dict().items()}


def _factor(value: Any) -> Rational:
    return int(value.p) if value.q == 1 else Fraction(int(value.p), int(value.q))
