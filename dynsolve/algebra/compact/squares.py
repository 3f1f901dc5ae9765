"""Squares of sums of sines and cosines: m₃ (L₂ c₂ + l_c3 c₂₃)², as a distance from an axis gives it.

In the normal form such a square is multiplied out, and s² is 1 - c².  It is found again
by its roots: a term a² c² is the square of a c, -a² c² that of a s, a² that of a; two
roots belong together where twice their product stands among the terms as well.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import isqrt
from typing import NamedTuple

from dynsolve.algebra.compact.terms import Exponents, Rational, Terms, add_term


class Root(NamedTuple):
    """factor · monomial, with one sine or cosine in it or none."""

    factor: Rational
    exponents: Exponents


class Square(NamedTuple):
    """(Σ root)² + rest"""

    roots: tuple[Root, ...]
    rest: Terms


def square_in(terms: Terms, width: int) -> Square | None:
    """The square with most roots in a polynomial, and what is left without it; None where there is none.

    The first `width` exponents are those of sines and cosines in turn.

    >>> c2, c23 = (0, 1, 0, 0), (0, 0, 0, 1)
    >>> found = square_in({(0, 2, 0, 0, 2, 0): 1, (0, 1, 0, 1, 1, 1): 2, (0, 0, 0, 2, 0, 2): 1}, 4)
    >>> [root.exponents for root in found.roots], found.rest
    ([(0, 1, 0, 0, 1, 0), (0, 0, 0, 1, 0, 1)], {})
    """
    best: tuple[Root, ...] = ()
    roots = list(_roots(terms, width))
    for first in roots:
        found = _together(first, roots, terms)
        if len(found) > max(len(best), 1) and any(any(root.exponents[:width]) for root in found):
            best = found
    return Square(best, _without(terms, best, width)) if best else None


def _roots(terms: Terms, width: int) -> Iterator[Root]:
    """The roots of the terms that are squares: cosines of those with a plus, sines of those with a minus."""
    for exponents, factor in terms.items():
        trig, others = exponents[:width], exponents[width:]
        root = _rational_root(-factor if factor < 0 and any(trig) else factor)
        if root is None or any(e % 2 for e in others):
            continue
        if not any(trig):
            yield Root(root, (*trig, *(e // 2 for e in others)))
        elif sum(trig) == 2 and 2 in trig[1::2]:
            place = trig.index(2) - (factor < 0)
            yield Root(root, (*(int(i == place) for i in range(width)), *(e // 2 for e in others)))


def _rational_root(value: Rational) -> Rational | None:
    """The square root of a positive rational number, None where it is not rational."""
    p, q = value.numerator, value.denominator
    if p <= 0 or isqrt(p) ** 2 != p or isqrt(q) ** 2 != q:
        return None
    return isqrt(p) if q == 1 else Fraction(isqrt(p), isqrt(q))


def _together(first: Root, roots: list[Root], terms: Terms) -> tuple[Root, ...]:
    """The roots, with their signs, of which twice the product with each other stands among the terms."""
    found = [first]
    for root in roots:
        products = [(one, terms.get(_product(one, root), 0)) for one in found]
        signs = {product / (2 * one.factor * root.factor) for one, product in products}
        if root != first and signs in ({1}, {-1}):
            found.append(Root(root.factor * int(signs.pop()), root.exponents))
    return tuple(found)


def _product(a: Root, b: Root) -> Exponents:
    return tuple(x + y for x, y in zip(a.exponents, b.exponents, strict=True))


def _without(terms: Terms, roots: tuple[Root, ...], width: int) -> Terms:
    """The terms less the square of the sum of the roots."""
    rest = dict(terms)
    for i, a in enumerate(roots):
        for b in roots[i + 1 :]:
            add_term(rest, _product(a, b), -2 * a.factor * b.factor)
        square, factor = list(_product(a, a)), -a.factor * a.factor
        sine = next((place for place in range(0, width, 2) if square[place]), None)
        if sine is not None:  # s² = 1 - c²
            square[sine] = 0
            add_term(rest, (*square[: sine + 1], 2, *square[sine + 2 :]), -factor)
        add_term(rest, tuple(square), factor)
    return rest
