"""The forms in which a person may write a trigonometric polynomial in parallel angles.

One function can be written in many ways: c₂² or 1 - s₂², s₂c₂ or ½ sin 2θ₂,
c₂c₂₃ + s₂s₂₃ or c₃.  A trigonometric form is a sum of products of sines and cosines of
linear angles, with rational factors.  `trig_forms` gives those worth considering:

- powers of s and c, an angle at a time with s² eliminated, with c² eliminated, or
  with neither (every term of the same degree, by factors s² + c² = 1);
- the same over the other choices of two basic angles: θ₂ and θ₃ in place of θ₂ and θ₂ + θ₃;
- the Fourier form (`algebra.fourier`): sines and cosines of integer combinations of angles.

`choice` picks one of them.  A polynomial is a dictionary {exponents: factor}, the
exponents those of (s₁, c₁, s₂, c₂, …) in the basic angles.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from math import comb

from dynsolve.algebra.compact.terms import Exponents, Rational, add_term, exact
from dynsolve.algebra.fourier import FourierForm, Multiples, TrigFunction, fourier_form, positive, terms_of
from dynsolve.algebra.integer_basis import coordinates_in

TrigPolynomial = dict[Exponents, Rational]

TrigMonomial = tuple[tuple[TrigFunction, int], ...]
"""A product of powers of sines and cosines of linear angles."""

TrigForm = dict[TrigMonomial, Rational]
"""A sum of such products, each with its factor."""

LARGEST_POWER = 6
"""Above this power of one angle only the Fourier form and the normal form are tried."""


def trig_forms(poly: TrigPolynomial) -> list[TrigForm]:
    """Every form of `poly` worth considering, the normal form first.

    >>> c2_c23_plus_s2_s23 = {(0, 1, 0, 1): 1, (1, 0, 1, 0): 1}
    >>> {((("cos", (-1, 1)), 1),): 1} in trig_forms(c2_c23_plus_s2_s23)
    True
    """
    count = len(next(iter(poly))) // 2
    used = [j for j in range(count) if any(e[2 * j] or e[2 * j + 1] for e in poly)]
    unit = [tuple(int(i == j) for i in range(count)) for j in range(count)]
    found: list[TrigForm] = [_products(poly, unit)]
    if not used:
        return found
    fourier = fourier_form(poly)
    found.append({() if not any(f[1]) else ((f, 1),): factor for f, factor in terms_of(fourier)})
    if max(max(e) for e in poly) > LARGEST_POWER:
        return _distinct(found)
    basis = [unit[j] for j in used]
    found.extend(_eliminations(_restricted(poly, used), basis))
    for other in _other_bases(basis):
        over = _over_basis(fourier, other)
        if over is not None:
            found.extend(_eliminations(over, other))
    return _distinct(found)


def _other_bases(basis: list[Multiples]) -> Iterator[list[Multiples]]:
    """The other bases of two angles: each of them with their difference."""
    if len(basis) == 2:
        _, difference = positive(tuple(b - a for a, b in zip(*basis, strict=True)))
        for angle in basis:
            yield [angle, difference]


def _restricted(poly: TrigPolynomial, used: list[int]) -> TrigPolynomial:
    """The polynomial in the angles that occur."""
    return {tuple(x for j in used for x in (e[2 * j], e[2 * j + 1])): f for e, f in poly.items()}


def _products(poly: TrigPolynomial, basis: list[Multiples]) -> TrigForm:
    """The polynomial as it stands, its exponents those of sine and cosine of each basic angle."""
    functions = [(name, angle) for angle in basis for name in ("sin", "cos")]
    return {
        tuple((function, k) for function, k in zip(functions, e, strict=True) if k): f
        for e, f in poly.items()
    }


# -- s² + c² = 1 in each angle -----------------------------------------------------------------------


def _eliminations(poly: TrigPolynomial, basis: list[Multiples]) -> Iterator[TrigForm]:
    """s² eliminated (as it comes), c² eliminated, or neither, in each angle."""
    for ways in product(("s", "c", "neither"), repeat=len(basis)):
        written: TrigPolynomial | None = poly
        for j, way in enumerate(ways):
            if written is not None and way == "c":
                written = _without_cos_squares(written, j)
            elif written is not None and way == "neither":
                written = _homogeneous(written, j)
        if written is not None:
            yield _products(written, basis)


def _without_cos_squares(poly: TrigPolynomial, j: int) -> TrigPolynomial:
    """c² → 1 - s² in angle j."""
    result: TrigPolynomial = {}
    for e, f in poly.items():
        s, c = e[2 * j], e[2 * j + 1]
        half, odd = divmod(c, 2)
        for k in range(half + 1):
            add_term(result, _with_powers(e, j, s + 2 * k, odd), f * (-1) ** k * comb(half, k))
    return result


def _without_sin_squares(poly: TrigPolynomial, j: int) -> TrigPolynomial:
    """s² → 1 - c² in angle j."""
    result: TrigPolynomial = {}
    for e, f in poly.items():
        half, odd = divmod(e[2 * j], 2)
        for k in range(half + 1):
            add_term(result, _with_powers(e, j, odd, e[2 * j + 1] + 2 * k), f * (-1) ** k * comb(half, k))
    return result


def _homogeneous(poly: TrigPolynomial, j: int) -> TrigPolynomial | None:
    """Every term of one degree in angle j, by factors s² + c²; None where that fails or changes nothing."""
    degrees = {e[2 * j] + e[2 * j + 1] for e in poly}
    top = max(degrees)
    if len(degrees) == 1 or any((top - d) % 2 for d in degrees):
        return None
    result: TrigPolynomial = {}
    for e, f in poly.items():
        s, c = e[2 * j], e[2 * j + 1]
        half = (top - s - c) // 2
        for k in range(half + 1):
            add_term(result, _with_powers(e, j, s + 2 * k, c + 2 * (half - k)), f * comb(half, k))
    return result


def _with_powers(e: Exponents, j: int, s: int, c: int) -> Exponents:
    """The exponents with other ones for sine and cosine of angle j."""
    return (*e[: 2 * j], s, c, *e[2 * j + 2 :])


# -- another basis -----------------------------------------------------------------------------------


def _over_basis(fourier: FourierForm, basis: list[Multiples]) -> TrigPolynomial | None:
    """The normal form over another basis, or None where an angle is no integer combination of it."""
    result: TrigPolynomial = {}
    for n, (a, b) in fourier.items():
        multiples = coordinates_in(basis, n)
        if multiples is None or any(m.denominator != 1 for m in multiples):
            return None
        cosine, sine = _cos_sin([int(m) for m in multiples])
        for part, factor in ((cosine, a), (sine, b)):
            for e, f in part.items() if factor else ():
                add_term(result, e, f * factor)
    for j in range(len(basis)):
        result = _without_sin_squares(result, j)
    return result


def _cos_sin(multiples: list[int]) -> tuple[TrigPolynomial, TrigPolynomial]:
    """cos and sin of m₁α₁ + m₂α₂ + … as polynomials, by the addition theorems."""
    cosine: TrigPolynomial = {(0,) * (2 * len(multiples)): 1}
    sine: TrigPolynomial = {}
    for j, m in enumerate(multiples):
        c, s = _multiple_angle(m)
        cosine, sine = (
            _sum(_product(cosine, c, j), _product(sine, s, j), -1),
            _sum(_product(sine, c, j), _product(cosine, s, j), 1),
        )
    return cosine, sine


def _multiple_angle(m: int) -> tuple[dict[tuple[int, int], int], dict[tuple[int, int], int]]:
    """cos mα and sin mα as polynomials {(s, c): factor} by de Moivre's formula."""
    cosine: dict[tuple[int, int], int] = {}
    sine: dict[tuple[int, int], int] = {}
    for k in range(abs(m) + 1):
        sign = (-1) ** (k // 2)
        target = sine if k % 2 else cosine
        target[(k, abs(m) - k)] = sign * comb(abs(m), k)
    if m < 0:
        sine = {e: -f for e, f in sine.items()}
    return cosine, sine


def _product(poly: TrigPolynomial, other: dict[tuple[int, int], int], j: int) -> TrigPolynomial:
    """The product with a polynomial {(s, c): factor} in angle j."""
    result: TrigPolynomial = {}
    for e, f in poly.items():
        for (s, c), g in other.items():
            add_term(result, _with_powers(e, j, e[2 * j] + s, e[2 * j + 1] + c), f * g)
    return result


def _sum(left: TrigPolynomial, right: TrigPolynomial, factor: int) -> TrigPolynomial:
    """left + factor · right"""
    result = dict(left)
    for e, f in right.items():
        add_term(result, e, factor * f)
    return result


def _distinct(found: list[TrigForm]) -> list[TrigForm]:
    """Each form once, whole factors as int."""
    seen: dict[frozenset[tuple[TrigMonomial, Rational]], TrigForm] = {}
    for form in found:
        whole = {m: exact(f, 1) for m, f in form.items()}
        seen.setdefault(frozenset(whole.items()), whole)
    return list(seen.values())
