"""The dresses of a trigonometric polynomial in the angles of one parallel group.

One function has many faces: c₂² and 1 - s₂², s₂c₂ and ½ sin 2θ₂, c₂c₂₃ + s₂s₂₃
and c₃.  A dress is a sum of monomials in sines and cosines of linear angles, with
rational factors.  `dresses` writes a polynomial in every dress worth having:

- powers of s and c with s² or c² eliminated, an angle at a time, and the
  homogeneous one with neither;
- the same over each choice of independent partial sums of the angles;
- the Fourier form, sums of sin and cos of integer combinations.

Polynomials are dictionaries {exponents: factor} with exponents (s₁, c₁, s₂, c₂, ...)
in the group's basic angles.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, product
from math import comb

from dynsolve.algebra.compact.terms import Factor, exact

Exponents = tuple[int, ...]
Poly = dict[Exponents, Factor]

Turns = tuple[int, ...]
"""An angle as integer multiples of the group's basic angles."""

Wave = tuple[str, Turns]
"""sin or cos of an angle."""

Monomial = tuple[tuple[Wave, int], ...]
"""A product of powers of sines and cosines."""

Dress = dict[Monomial, Factor]

LARGEST_POWER = 6
"""Above this power of one angle only the Fourier form and the normal form are tried."""


def dresses(poly: Poly) -> list[Dress]:
    """Every dress of `poly` worth having, the normal form first."""
    count = len(next(iter(poly))) // 2
    used = [j for j in range(count) if any(e[2 * j] or e[2 * j + 1] for e in poly)]
    unit = [tuple(int(i == j) for i in range(count)) for j in range(count)]
    found: list[Dress] = [_plain(poly, unit)]
    if not used:
        return found
    waves = _fourier(poly, count)
    found.append(_fourier_dress(waves))
    if max(max(e) for e in poly) > LARGEST_POWER:
        return _distinct(found)
    for basis in _bases(used, unit):
        over = poly if basis == [unit[j] for j in used] else None
        local = _restrict(poly, used) if over is not None else _from_waves(waves, basis, count)
        if local is None:
            continue
        found.extend(_eliminations(local, basis))
    return _distinct(found)


def _bases(used: list[int], unit: list[Turns]) -> Iterator[list[Turns]]:
    yield [unit[j] for j in used]
    if len(used) == 2:
        first, second = (unit[j] for j in used)
        difference = _positive(tuple(b - a for a, b in zip(first, second, strict=True)))[1]
        yield [first, difference]
        yield [second, difference]


def _positive(turns: Turns) -> tuple[int, Turns]:
    """(sign, angle) with the last turning multiple positive: θ₂ - θ₁ and not θ₁ - θ₂."""
    last = next((t for t in reversed(turns) if t), 1)
    return (1, turns) if last > 0 else (-1, tuple(-t for t in turns))


def _restrict(poly: Poly, used: list[int]) -> Poly:
    return {tuple(x for j in used for x in (e[2 * j], e[2 * j + 1])): f for e, f in poly.items()}


def _plain(poly: Poly, basis: list[Turns]) -> Dress:
    return {_monomial(e, basis): f for e, f in poly.items()}


def _monomial(exponents: Exponents, basis: list[Turns]) -> Monomial:
    parts = []
    for j, turns in enumerate(basis):
        for name, exponent in (("sin", exponents[2 * j]), ("cos", exponents[2 * j + 1])):
            if exponent:
                parts.append(((name, turns), exponent))
    return tuple(parts)


def _eliminations(poly: Poly, basis: list[Turns]) -> Iterator[Dress]:
    """s² eliminated (as it comes), c² eliminated, or neither, in each angle."""
    for ways in product("sch", repeat=len(basis)):
        turned: Poly | None = poly
        for j, way in enumerate(ways):
            if turned is not None and way == "c":
                turned = _without_cos_squares(turned, j)
            elif turned is not None and way == "h":
                turned = _homogeneous(turned, j)
        if turned is not None:
            yield _plain(turned, basis)


def _without_cos_squares(poly: Poly, j: int) -> Poly:
    """c² → 1 - s² in angle j."""
    result: Poly = {}
    for e, f in poly.items():
        s, c = e[2 * j], e[2 * j + 1]
        half, odd = divmod(c, 2)
        for k in range(half + 1):
            _add(result, _put(e, j, s + 2 * k, odd), f * (-1) ** k * comb(half, k))
    return result


def _homogeneous(poly: Poly, j: int) -> Poly | None:
    """Every term of one degree in angle j, by factors s² + c²; None where that fails or changes nothing."""
    degrees = {e[2 * j] + e[2 * j + 1] for e in poly}
    top = max(degrees)
    if len(degrees) == 1 or any((top - d) % 2 for d in degrees):
        return None
    result: Poly = {}
    for e, f in poly.items():
        s, c = e[2 * j], e[2 * j + 1]
        half = (top - s - c) // 2
        for k in range(half + 1):
            _add(result, _put(e, j, s + 2 * k, c + 2 * (half - k)), f * comb(half, k))
    return result


def _put(e: Exponents, j: int, s: int, c: int) -> Exponents:
    return (*e[: 2 * j], s, c, *e[2 * j + 2 :])


def _add(poly: Poly, key: Exponents, value: Factor) -> None:
    total = poly.get(key, 0) + value
    if total:
        poly[key] = total
    else:
        poly.pop(key, None)


# -- the Fourier form --------------------------------------------------------------------------------

Waves = dict[Turns, tuple[Fraction, Fraction]]
"""f = Σ a cos(n·α) + b sin(n·α): {n: (a, b)}, n with its last turning multiple positive."""


def _fourier(poly: Poly, count: int) -> Waves:
    total: dict[Turns, list[Fraction]] = {}
    for e, f in poly.items():
        spectrum: dict[Turns, tuple[Fraction, Fraction]] = {(0,) * count: (Fraction(f), Fraction(0))}
        for j in range(count):
            for _ in range(e[2 * j]):
                spectrum = _times_wave(spectrum, j, sine=True)
            for _ in range(e[2 * j + 1]):
                spectrum = _times_wave(spectrum, j, sine=False)
        for n, (re, im) in spectrum.items():
            sign, turns = _positive(n)
            entry = total.setdefault(turns, [Fraction(0), Fraction(0)])
            entry[0] += re
            entry[1] -= sign * im
    return {n: (a, b) for n, (a, b) in total.items() if a or b}


def _times_wave(
    spectrum: dict[Turns, tuple[Fraction, Fraction]], j: int, *, sine: bool
) -> dict[Turns, tuple[Fraction, Fraction]]:
    """Multiply Σ x e^{i n·α} by c = (e^{iα} + e^{-iα})/2 or s = (e^{iα} - e^{-iα})/(2i)."""
    result: dict[Turns, tuple[Fraction, Fraction]] = {}
    for n, (re, im) in spectrum.items():
        for step in (1, -1):
            shifted = (*n[:j], n[j] + step, *n[j + 1 :])
            x, y = (im * step, -re * step) if sine else (re, im)
            old = result.get(shifted, (Fraction(0), Fraction(0)))
            result[shifted] = (old[0] + x / 2, old[1] + y / 2)
    return result


def _fourier_dress(waves: Waves) -> Dress:
    dress: Dress = {}
    for n, (a, b) in waves.items():
        if not any(n):
            dress[()] = a
            continue
        if a:
            dress[((("cos", n), 1),)] = a
        if b:
            dress[((("sin", n), 1),)] = b
    return dress


def _from_waves(waves: Waves, basis: list[Turns], count: int) -> Poly | None:
    """The normal form over another basis, or None where an angle is no integer combination of it."""
    result: Poly = {}
    for n, (a, b) in waves.items():
        multiples = _solve(basis, n, count)
        if multiples is None:
            return None
        cosine: Poly = {(0,) * (2 * len(basis)): Fraction(1)}
        sine: Poly = {}
        for j, m in enumerate(multiples):
            c, s = _multiple_angle(m)
            cosine, sine = (
                _minus(_times(cosine, c, j), _times(sine, s, j)),
                _plus(_times(sine, c, j), _times(cosine, s, j)),
            )
        for part, factor in ((cosine, a), (sine, b)):
            for e, f in part.items():
                if factor:
                    _add(result, e, f * factor)
    return _normal(result, len(basis))


def _solve(basis: list[Turns], n: Turns, count: int) -> tuple[int, ...] | None:
    """The integers m with Σ m_j basis_j = n, for one or two basis vectors with small entries."""
    if len(basis) == 1:
        lead = next(i for i in range(count) if basis[0][i])
        m, rest = divmod(n[lead], basis[0][lead])
        return (m,) if not rest and tuple(m * b for b in basis[0]) == n else None
    (i, k) = next(
        (i, k)
        for i, k in combinations(range(count), 2)
        if basis[0][i] * basis[1][k] != basis[0][k] * basis[1][i]
    )
    a, b, c, d = basis[0][i], basis[1][i], basis[0][k], basis[1][k]
    determinant = a * d - b * c
    m, r = divmod(n[i] * d - b * n[k], determinant)
    p, q = divmod(a * n[k] - n[i] * c, determinant)
    if r or q or any(m * x + p * y != z for x, y, z in zip(basis[0], basis[1], n, strict=True)):
        return None
    return m, p


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


def _times(poly: Poly, wave: dict[tuple[int, int], int], j: int) -> Poly:
    result: Poly = {}
    for e, f in poly.items():
        for (s, c), g in wave.items():
            _add(result, _put(e, j, e[2 * j] + s, e[2 * j + 1] + c), f * g)
    return result


def _plus(left: Poly, right: Poly) -> Poly:
    result = dict(left)
    for e, f in right.items():
        _add(result, e, f)
    return result


def _minus(left: Poly, right: Poly) -> Poly:
    return _plus(left, {e: -f for e, f in right.items()})


def _normal(poly: Poly, count: int) -> Poly:
    """s² → 1 - c² in every angle."""
    for j in range(count):
        result: Poly = {}
        for e, f in poly.items():
            half, odd = divmod(e[2 * j], 2)
            for k in range(half + 1):
                _add(result, _put(e, j, odd, e[2 * j + 1] + 2 * k), f * (-1) ** k * comb(half, k))
        poly = result
    return poly


def _distinct(found: list[Dress]) -> list[Dress]:
    """Each dress once, whole factors as int."""
    seen: dict[frozenset[tuple[Monomial, Factor]], Dress] = {}
    for dress in found:
        whole = {m: exact(f, 1) for m, f in dress.items()}
        seen.setdefault(frozenset(whole.items()), whole)
    return list(seen.values())
