"""A polynomial as a dictionary of terms, laid out for collecting.

The monomial of a term is cut into parts in the order in which a person collects: one for each
angle group from the base outwards, masses and inertias, the other parameters and
coordinates, velocities and accelerations.  Each part is known by its number (`Numbered`), so that
one polynomial is one dictionary, whatever expression it is a piece of.

Polynomials in atoms as dictionaries {monomial: factor}: products, common factors, recurring sums.

A monomial is a sorted tuple of (number of an atom, exponent); see `atoms`.

Squares of sums of sines and cosines: m₃ (L₂ c₂ + l_c3 c₂₃)², as a distance from an axis gives it.

In the normal form such a square is multiplied out, and s² is 1 - c².  It is found again
by its roots: a term a² c² is the square of a c, -a² c² that of a s, a² that of a; two
roots belong together where twice their product stands among the terms as well.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import comb, gcd, isqrt, lcm
from typing import Any, Generic, NamedTuple, TypeVar

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

Rational = int | Fraction
"""A rational factor: an int wherever it is whole, since those are fast."""

Exponents = tuple[int, ...]

Parts = tuple[int, ...]
"""Of a term the numbers of its parts: those of the angle groups that are left, and three more."""

Terms = dict[Parts, Rational]

MASSES, SYMBOLS, RATES = -3, -2, -1
"""The places of the last parts: of masses and inertias, of other parameters and coordinates, of rates."""

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


Value = TypeVar("Value", bound=Hashable)


class Numbered(Generic[Value]):
    """Values, and the number that stands for each: 0 for the first."""

    def __init__(self, first: Value) -> None:
        self.values = [first]
        self._numbers = {first: 0}

    def number(self, value: Value) -> int:
        """The number of a value, the same for equal ones."""
        found = self._numbers.setdefault(value, len(self.values))
        if found == len(self.values):
            self.values.append(value)
        return found


def split_at(terms: Terms, place: int) -> dict[int, Terms]:
    """The terms by one of their parts, counted from the end."""
    result: dict[int, Terms] = {}
    for parts, f in terms.items():
        after = parts[place:][1:]
        result.setdefault(parts[place], {})[(*parts[:place], 0, *after)] = f
    return result


# Polynomials in atoms as dictionaries {monomial

Monomial = tuple[tuple[int, int], ...]
Polynomial = dict[Monomial, Rational]


def multiply(left: Monomial, right: Monomial) -> Monomial:
    """The product of two monomials."""
    exponents = dict(left)
    for atom, exponent in right:
        exponents[atom] = exponents.get(atom, 0) + exponent
    return tuple(sorted((a, e) for a, e in exponents.items() if e))


def divide(mono: Monomial, by: Monomial) -> Monomial:
    """mono / by"""
    return multiply(mono, tuple((atom, -exponent) for atom, exponent in by))


def common(monos: Iterable[Monomial]) -> Monomial:
    """The largest monomial that divides all; an inverse is common where all have it."""
    monos = list(monos)
    first = dict(monos[0])
    for mono in monos[1:]:
        other = dict(mono)
        for atom in list(first):
            exponent = other.get(atom, 0)
            mine = first[atom]
            if mine > 0 and exponent > 0:
                first[atom] = min(mine, exponent)
            elif mine < 0 and exponent < 0:
                first[atom] = max(mine, exponent)
            else:
                del first[atom]
    return tuple(sorted(first.items()))


def content(factors: Iterable[Rational]) -> Rational:
    """The factor worth drawing out: the common divisor of whole numbers, and a denominator if all have one.

    The denominator must be a multiple of the others: (m₁ + 2 m₂)/4, but a/2 + b/3 and h + d/2 + l/2.
    """
    factors = list(factors)
    shared = gcd(*(f.numerator for f in factors))
    if set(map(type, factors)) <= {int}:
        return shared
    denominators = {f.denominator for f in factors}
    largest = max(denominators)
    if 1 in denominators or any(largest % d for d in denominators):
        return 1
    return Fraction(shared, largest)


def whole_content(factors: Iterable[Rational]) -> Rational:
    """The content that leaves coprime whole numbers: of 1 and 1/2 it is 1/2."""
    factors = list(factors)
    return exact(gcd(*(f.numerator for f in factors)), lcm(*(f.denominator for f in factors)))


def joined_pair(poly: Polynomial) -> tuple[int, int, Rational] | None:
    """(x, y, r) where the polynomial is one in x + r·y: ∂/∂y = r ∂/∂x, and not merely linear in them."""
    counts = Counter(atom for mono in poly for atom, _ in mono)
    alike = Counter(counts.values())  # where x + r·y stands, as many terms hold x as hold y
    found: dict[object, tuple[int, Rational]] = {}
    for atom in sorted({atom for mono in poly for atom, e in mono if e > 0}):
        if counts[atom] > 1 and alike[counts[atom]] > 1:
            key, scale = primitive(_derivative(poly, atom))
            if key in found:
                first, other = found[key]
                return first, atom, exact(scale, other)
            found[key] = atom, scale
    return None


def _derivative(poly: Polynomial, atom: int) -> Polynomial:
    """∂poly/∂atom"""
    result: Polynomial = {}
    for mono, f in poly.items():
        for a, e in mono:
            if a == atom:
                result[divide(mono, ((a, 1),))] = f * e
    return result


def join(poly: Polynomial, x: int, y: int, whole: int) -> Polynomial:
    """A polynomial in x + r·y, with y put to 0 and x replaced by the atom `whole`."""
    result: Polynomial = {}
    for mono, f in poly.items():
        exponents = dict(mono)
        if y in exponents:
            continue
        if x in exponents:
            exponents[whole] = exponents.pop(x)
        result[tuple(sorted(exponents.items()))] = f
    return result


def factors_of(poly: Polynomial) -> tuple[tuple[Polynomial, int], ...]:
    """(factor, exponent), a monomial with a number first, where a polynomial is a product of several sums.

    >>> a, b = ((0, 1),), ((1, 1),)
    >>> factors_of({multiply(a, a): 2, multiply(a, b): 4, multiply(b, b): 2})
    (({(): 2}, 1), ({((1, 1),): 1, ((0, 1),): 1}, 2))
    """
    powers = [{(a, e > 0): abs(e) for a, e in mono} for mono in poly]
    letters = sorted(set().union(*powers), reverse=True)
    scale = lcm(*(f.denominator for f in poly.values()))
    ctx = fmpz_mpoly_ctx.get(("x", len(letters)), Ordering.lex)
    terms = zip(powers, poly.values(), strict=True)
    dense = {tuple(exponents.get(a, 0) for a in letters): int(f * scale) for exponents, f in terms}
    number, found = ctx.from_dict(dense).factor()
    factors = [(_in_atoms(factor, letters), int(n)) for factor, n in found]
    sums = sorted((one for one in factors if len(one[0]) > 1), key=lambda one: len(one[0]))
    if sum(n for _, n in sums) < 2:
        return ()
    single = [(a, e * n) for factor, n in factors if len(factor) == 1 for mono in factor for a, e in mono]
    return (({tuple(sorted(single)): exact(int(number), scale)}, 1), *sums)


def _in_atoms(poly: fmpz_mpoly, letters: Sequence[tuple[int, bool]]) -> Polynomial:
    """A polynomial in atoms and inverses of atoms, which are not `True`."""
    result: Polynomial = {}
    for exponents, factor in poly.to_dict().items():
        powers = ((a, int(e) if up else -int(e)) for (a, up), e in zip(letters, exponents, strict=True) if e)
        result[tuple(sorted(powers))] = int(factor)
    return result


# Squares of sums of sines and cosines

SQUARED = 2


Product = tuple[Exponents, Monomial]
"""Sines and cosines in turn of the angles of a group, by their exponents, and the symbols beside them."""


class Root(NamedTuple):
    """factor · monomial, with one sine or cosine in it or none."""

    factor: Rational
    monomial: Product


class Square(NamedTuple):
    """(Σ root)² + rest"""

    roots: tuple[Root, ...]
    rest: dict[Product, Rational]


def homogeneous(terms: Mapping[Product, Rational]) -> dict[Product, Rational] | None:
    """A polynomial with s² + c² for 1 wherever terms are of lower degree in a pair; None where none is.

    As the factors of (a s + b c)(a c - b s) = (a² - b²) s c + a b (2c² - 1) are found: a b (c² - s²).

    >>> homogeneous({((1, 1), ()): 3, ((0, 2), ()): 2, ((0, 0), ()): -1})
    {((1, 1), ()): 3, ((0, 2), ()): 1, ((2, 0), ()): -1}
    """
    found, raised = dict(terms), False
    for j in range(0, len(next(iter(terms))[0]), 2):
        degrees = {trig[j] + trig[j + 1] for trig, _ in found}
        most = max(degrees)
        if len(degrees) == 1 or any((most - degree) % 2 for degree in degrees):
            continue
        raised, before, found = True, found, {}
        for (trig, symbols), f in before.items():
            lacking = (most - trig[j] - trig[j + 1]) // 2
            for k in range(lacking + 1):
                own = (*trig[:j], trig[j] + 2 * k, trig[j + 1] + 2 * (lacking - k), *trig[j + 2 :])
                add_term(found, (own, symbols), comb(lacking, k) * f)
    return found if raised else None


def square_in(terms: Mapping[Product, Rational], *, completed: bool = False) -> Square | None:
    """The square with most roots in a polynomial, and what is left without it; None where there is none.

    `completed`: of three roots or more one may be told by its products alone; of (a + l c/2)² + l² c²/12 a
    book writes a² + a l c + l² c²/3.

    >>> a, b, both = ((0, 2),), ((1, 2),), ((0, 1), (1, 1))
    >>> found = square_in({((0, 2, 0, 0), a): 1, ((0, 1, 0, 1), both): 2, ((0, 0, 0, 2), b): 1})
    >>> [root.monomial for root in found.roots], found.rest
    ([((0, 1, 0, 0), ((0, 1),)), ((0, 0, 0, 1), ((1, 1),))], {})
    """
    best: tuple[Root, ...] = ()
    roots = list(_roots(terms))
    others, most = (list(_others(terms)), 2) if completed else ([], 1)
    for first in roots:
        found = _together(first, roots, others, terms)
        if len(found) > max(len(best), most) and any(any(root.monomial[0]) for root in found):
            best = found
    return Square(best, _without(terms, best)) if best else None


def _roots(terms: Mapping[Product, Rational]) -> Iterator[Root]:
    """The roots of the terms that are squares: cosines of those with a plus, sines of those with a minus."""
    for monomial, factor in terms.items():
        root = rational_root(-factor if factor < 0 and any(monomial[0]) else factor)
        half = _half(monomial, sine=factor < 0)
        if root is not None and half is not None:
            yield Root(root, half)


def _others(terms: Mapping[Product, Rational]) -> Iterator[Product]:
    """What is squared in a term of which the number is no square."""
    for monomial, factor in terms.items():
        half = _half(monomial, sine=factor < 0)
        if half is not None and rational_root(factor if factor > 0 else -factor) is None:
            yield half


def _half(monomial: Product, *, sine: bool) -> Product | None:
    """The root of a square, with one sine or cosine in it or none."""
    trig, symbols = monomial
    if any(e % 2 for _, e in symbols):
        return None
    root = tuple((atom, e // 2) for atom, e in symbols)
    if not any(trig):
        return trig, root
    if sum(trig) != SQUARED or SQUARED not in trig[1::2]:
        return None
    place = trig.index(SQUARED) - sine
    return tuple(int(i == place) for i in range(len(trig))), root


def rational_root(value: Rational) -> Rational | None:
    """The square root of a positive rational number, None where it is not rational."""
    p, q = value.numerator, value.denominator
    if p <= 0 or isqrt(p) ** 2 != p or isqrt(q) ** 2 != q:
        return None
    return isqrt(p) if q == 1 else Fraction(isqrt(p), isqrt(q))


def _together(
    first: Root, roots: list[Root], others: list[Product], terms: Mapping[Product, Rational]
) -> tuple[Root, ...]:
    """The roots, with their signs, of which twice the product with each other stands among the terms."""
    found = [first]
    for root in roots:
        ratios = {_ratio(one, root, terms) for one in found}
        if root != first and ratios in ({1}, {-1}):
            found.append(Root(root.factor * int(ratios.pop()), root.monomial))
    for monomial in others:
        ratios = {_ratio(one, Root(1, monomial), terms) for one in found}
        if len(ratios) == 1 and ratios != {0}:
            found.append(Root(ratios.pop(), monomial))
    return tuple(found)


def _ratio(a: Root, b: Root, terms: Mapping[Product, Rational]) -> Rational:
    """How many times twice the product of two roots stands among the terms."""
    (place, factor), *_ = _product(a, b)
    return exact(terms.get(place, 0), 2 * factor)


def _product(a: Root, b: Root) -> tuple[tuple[Product, Rational], ...]:
    """The product of two roots in normal form: of one sine twice, s² = 1 - c², the term with c² is first."""
    factor = a.factor * b.factor
    trig = tuple(x + y for x, y in zip(a.monomial[0], b.monomial[0], strict=True))
    symbols = multiply(a.monomial[1], b.monomial[1])
    sine = next((place for place in range(0, len(trig), 2) if trig[place] == SQUARED), None)
    if sine is None:
        return (((trig, symbols), factor),)
    before, after = trig[:sine], trig[sine + 2 :]
    return (((*before, 0, SQUARED, *after), symbols), -factor), (((*before, 0, 0, *after), symbols), factor)


def _without(terms: Mapping[Product, Rational], roots: tuple[Root, ...]) -> dict[Product, Rational]:
    """The terms less the square of the sum of the roots."""
    rest = dict(terms)
    for i, a in enumerate(roots):
        for j, b in enumerate(roots[i:]):
            for place, factor in _product(a, b):
                add_term(rest, place, -factor if j == 0 else -2 * factor)
    return rest
