"""A polynomial as a dictionary of terms, laid out for collecting.

The exponents of a term stand in the order in which a person collects: the angle
groups from the base outwards, masses and inertias, the other parameters and
coordinates, velocities and accelerations.  So each step of collecting cuts a
piece off an end, and keys only become shorter.

Polynomials in atoms as dictionaries {monomial: factor}: products, common factors, recurring sums.

A monomial is a sorted tuple of (number of an atom, exponent); see `atoms`.

Squares of sums of sines and cosines: m₃ (L₂ c₂ + l_c3 c₂₃)², as a distance from an axis gives it.

In the normal form such a square is multiplied out, and s² is 1 - c².  It is found again
by its roots: a term a² c² is the square of a c, -a² c² that of a s, a² that of a; two
roots belong together where twice their product stands among the terms as well.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import gcd, isqrt, lcm
from typing import Any, NamedTuple, TypeVar

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx
from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.ring import Expr

# A polynomial as a dictionary of terms, laid out for collecting

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


class TermLayout(Struct, frozen=True):
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
    names = expr.poly.context().names()
    known = {names[i]: (place, 1) for place, i in enumerate(order)}
    return layout, dict(sorted(_read(str(expr.poly), known, len(order)), reverse=True))


def _read(text: str, known: dict[str, tuple[int, int]], width: int) -> Iterator[tuple[Exponents, Rational]]:
    """The terms of a polynomial as FLINT writes it; its own lists have an object for each exponent.

    `known` says place and exponent of a factor, and is added to.

    >>> list(_read("-2*x*y^2 + 1/3*x", {"x": (0, 1), "y": (1, 1)}, 2))
    [((1, 2), -2), ((1, 0), Fraction(1, 3))]
    """
    for term in text.replace(" - ", " + -").split(" + "):
        exponents = [0] * width
        sign, factor = (-1, term[1:]) if term[0] == "-" else (1, term)
        number: Rational = sign
        for part in factor.split("*"):
            found = known.get(part)
            if found is None and part[0].isdigit():
                numerator, _, denominator = part.partition("/")
                number = sign * (
                    Fraction(int(numerator), int(denominator)) if denominator else int(numerator)
                )
                continue
            if found is None:
                name, _, exponent = part.partition("^")
                found = known[part] = (known[name][0], int(exponent))
            exponents[found[0]] = found[1]
        yield tuple(exponents), number


def factors_of(terms: Terms) -> tuple[tuple[Terms, int], ...]:
    """(factor, exponent), a monomial with a number first, where a polynomial is a product of several sums.

    >>> factors_of({(2, 0): 2, (1, 1): 4, (0, 2): 2})
    (({(0, 0): 2}, 1), ({(1, 0): 1, (0, 1): 1}, 2))
    """
    scale = lcm(*(f.denominator for f in terms.values()))
    ctx = fmpz_mpoly_ctx.get(("x", len(next(iter(terms)))), Ordering.lex)
    number, found = ctx.from_dict({e: int(f * scale) for e, f in terms.items()}).factor()
    sums = [(_whole_terms(factor), int(n)) for factor, n in found if len(factor) > 1]
    sums.sort(key=lambda one: len(one[0]))
    if sum(n for _, n in sums) < 2:
        return ()
    monomial = [0] * ctx.nvars()
    for factor, n in found:
        if len(factor) == 1:
            monomial = [x + n * int(y) for x, y in zip(monomial, factor.monoms()[0], strict=True)]
    return (({tuple(monomial): exact(int(number), scale)}, 1), *sums)


def _whole_terms(poly: fmpz_mpoly) -> Terms:
    return {tuple(map(int, e)): int(f) for e, f in poly.to_dict().items()}


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
    atoms = sorted({atom for mono in poly for atom, e in mono if e > 0})
    slopes = {atom: _derivative(poly, atom) for atom in atoms}
    candidates: dict[object, tuple[int, Rational]] = {}
    for atom, part in slopes.items():
        if len(part) > 1:
            key, scale = primitive(part)
            if key in candidates:
                first, other = candidates[key]
                return first, atom, exact(scale, other)
            candidates[key] = atom, scale
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


# Squares of sums of sines and cosines

SQUARED = 2


class Root(NamedTuple):
    """factor · monomial, with one sine or cosine in it or none."""

    factor: Rational
    exponents: Exponents


class Square(NamedTuple):
    """(Σ root)² + rest"""

    roots: tuple[Root, ...]
    rest: Terms


def square_in(terms: Terms, width: int, *, completed: bool = False) -> Square | None:
    """The square with most roots in a polynomial, and what is left without it; None where there is none.

    The first `width` exponents are those of sines and cosines in turn.  `completed`: of three roots or more
    one may be told by its products alone; of (a + l c/2)² + l² c²/12 a book writes a² + a l c + l² c²/3.

    >>> c2, c23 = (0, 1, 0, 0), (0, 0, 0, 1)
    >>> found = square_in({(0, 2, 0, 0, 2, 0): 1, (0, 1, 0, 1, 1, 1): 2, (0, 0, 0, 2, 0, 2): 1}, 4)
    >>> [root.exponents for root in found.roots], found.rest
    ([(0, 1, 0, 0, 1, 0), (0, 0, 0, 1, 0, 1)], {})
    """
    best: tuple[Root, ...] = ()
    roots = list(_roots(terms, width))
    others, most = (list(_others(terms, width)), 2) if completed else ([], 1)
    for first in roots:
        found = _together(first, roots, others, terms, width)
        if len(found) > max(len(best), most) and any(any(root.exponents[:width]) for root in found):
            best = found
    return Square(best, _without(terms, best, width)) if best else None


def _roots(terms: Terms, width: int) -> Iterator[Root]:
    """The roots of the terms that are squares: cosines of those with a plus, sines of those with a minus."""
    for exponents, factor in terms.items():
        root = _rational_root(-factor if factor < 0 and any(exponents[:width]) else factor)
        half = _half(exponents, width, sine=factor < 0)
        if root is not None and half is not None:
            yield Root(root, half)


def _others(terms: Terms, width: int) -> Iterator[Exponents]:
    """What is squared in a term of which the number is no square."""
    for exponents, factor in terms.items():
        half = _half(exponents, width, sine=factor < 0)
        if half is not None and _rational_root(factor if factor > 0 else -factor) is None:
            yield half


def _half(exponents: Exponents, width: int, *, sine: bool) -> Exponents | None:
    """The exponents of the root of a square, with one sine or cosine in it or none."""
    trig, others = exponents[:width], exponents[width:]
    if any(e % 2 for e in others):
        return None
    root = [e // 2 for e in others]
    if not any(trig):
        return (*trig, *root)
    if sum(trig) != SQUARED or SQUARED not in trig[1::2]:
        return None
    place = trig.index(SQUARED) - sine
    return (*(int(i == place) for i in range(width)), *root)


def _rational_root(value: Rational) -> Rational | None:
    """The square root of a positive rational number, None where it is not rational."""
    p, q = value.numerator, value.denominator
    if p <= 0 or isqrt(p) ** 2 != p or isqrt(q) ** 2 != q:
        return None
    return isqrt(p) if q == 1 else Fraction(isqrt(p), isqrt(q))


def _together(
    first: Root, roots: list[Root], others: list[Exponents], terms: Terms, width: int
) -> tuple[Root, ...]:
    """The roots, with their signs, of which twice the product with each other stands among the terms."""
    found = [first]
    for root in roots:
        ratios = {_ratio(one, root, terms, width) for one in found}
        if root != first and ratios in ({1}, {-1}):
            found.append(Root(root.factor * int(ratios.pop()), root.exponents))
    for exponents in others:
        ratios = {_ratio(one, Root(1, exponents), terms, width) for one in found}
        if len(ratios) == 1 and ratios != {0}:
            found.append(Root(ratios.pop(), exponents))
    return tuple(found)


def _ratio(a: Root, b: Root, terms: Terms, width: int) -> Rational:
    """How many times twice the product of two roots stands among the terms."""
    (place, factor), *_ = _product(a, b, width)
    return exact(terms.get(place, 0), 2 * factor)


def _product(a: Root, b: Root, width: int) -> tuple[tuple[Exponents, Rational], ...]:
    """The product of two roots in normal form: of one sine twice, s² = 1 - c², the term with c² is first."""
    factor = a.factor * b.factor
    product = tuple(x + y for x, y in zip(a.exponents, b.exponents, strict=True))
    sine = next((place for place in range(0, width, 2) if product[place] == SQUARED), None)
    if sine is None:
        return ((product, factor),)
    before, after = product[:sine], product[sine + 2 :]
    return ((*before, 0, SQUARED, *after), -factor), ((*before, 0, 0, *after), factor)


def _without(terms: Terms, roots: tuple[Root, ...], width: int) -> Terms:
    """The terms less the square of the sum of the roots."""
    rest = dict(terms)
    for i, a in enumerate(roots):
        for j, b in enumerate(roots[i:]):
            for place, factor in _product(a, b, width):
                add_term(rest, place, -factor if j == 0 else -2 * factor)
    return rest
