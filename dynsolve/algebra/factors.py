"""Factors of a polynomial in sines and cosines: s₂ (L₂c₂ + L₃c₂₃) from its normal form.

The normal form has no s², so that a product may show no factor: s₂(c₂ + s₂) becomes
1 + s₂c₂ - c₂².  In S = sin(q/2) and C = cos(q/2), with

    sin q = 2 S C,   cos q = C² - S²,   1 = C² + S²,

the polynomial is homogeneous in each pair (S, C), and such polynomials factor in one way
alone.  FLINT factors them; what comes out is put together again into sines and cosines of
whole angles: S C into sin q, (C - S)(C + S) into cos q, S² into 1 - cos q.

Factors of polynomials whose coefficients hold square roots of numbers, as √2 of 45°.

With r² = 2 the norm f(r) f(-r) is free of r, and FLINT factors it.  What f has of a factor of the
norm is their greatest common divisor: FLINT finds it modulo a prime for which 2 is a square, once for
each sign of the root there; from these a + b√2 follows, and a division proves it.

What is positive because of how it is written: lengths and masses are, and squares are not negative.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache, lru_cache
from itertools import combinations, product
from math import cos, isqrt, prod, radians, sin, sqrt
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, nmod_mpoly_ctx

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.fourier import fourier_form, terms_of
from dynsolve.algebra.generators import Generator, Pair
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.notation.tree import Number

# What is positive because of how it is written


def is_nonnegative(expr: Expr) -> bool:
    """Whether every term has a positive factor and no coordinate, sine or cosine to an odd power.

    Parameters count as positive, as lengths and masses are, save those that the ring's plan calls signed;
    so do roots of numbers, and sines and cosines of constant angles that are positive.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([("d1", "prismatic")], [Symbol("l")])
    >>> l, d = ring.symbol("l"), ring.symbol("d1")
    >>> is_nonnegative(l + d * d), is_nonnegative(l + d), is_nonnegative(l - d * d)
    (True, False, False)
    """
    free = parameters(expr)
    return all(
        factor > 0 and all(e % 2 == 0 or i in free for i, e in enumerate(exponents))
        for exponents, factor in expr.poly.terms()
    )


def is_positive(expr: Expr) -> bool:
    """Whether it is not negative, and one of its terms is a number or holds parameters alone.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([("d1", "prismatic")], [Symbol("l")])
    >>> l, d = ring.symbol("l"), ring.symbol("d1")
    >>> is_positive(l + d * d), is_positive(d * d)
    (True, False)
    """
    free = parameters(expr)
    return is_nonnegative(expr) and any(_holds_only(exponents, free) for exponents in expr.poly.monoms())


def is_never_zero(expr: Expr) -> bool:
    """Whether it or its negative is positive, as what is divided by is to be."""
    return is_positive(expr) or is_positive(-expr)


def parameters(expr: Expr) -> frozenset[int]:
    """The generators that count as positive, inverses of what is positive among them."""
    ring = expr.ring
    names = {*ring.names, *ring.plan.signed}
    found = frozenset(
        g.index for g in ring.generators if (g.kind == "symbol" and g.name not in names) or _is_constant(g)
    )
    for index, inverted in ring.inverses.items():
        if all(factor > 0 and _holds_only(exponents, found) for exponents, factor in inverted.terms()):
            found |= {index}
    return found


def _is_constant(g: Generator) -> bool:
    """Whether a generator is a positive number."""
    return (_size(g) or 0) > 0


def _size(g: Generator) -> float | None:
    """The number that √2 or cos 20° is; None of what is no number."""
    if g.kind == "root":
        return sqrt(g.node.p / g.node.q) if isinstance(g.node, Number) else None
    if g.kind not in ("sin", "cos", "constant") or not g.angle.is_constant:
        return None
    angle = radians(g.angle.degrees)
    return sin(angle) if g.kind == "sin" else cos(angle)


def in_numbers(expr: Expr) -> dict[tuple[int, ...], float]:
    """What stands before its products as a number, with √2 and cos 20°, by the exponents of all else."""
    sizes = {g.index: size for g in expr.ring.generators if (size := _size(g)) is not None}
    found: dict[tuple[int, ...], float] = {}
    for exponents, factor in expr.poly.to_dict().items():
        key = tuple(0 if i in sizes else int(e) for i, e in enumerate(exponents))
        number = prod(size ** int(exponents[i]) for i, size in sizes.items())
        found[key] = found.get(key, 0.0) + float(factor.p) / float(factor.q) * number
    return found


def _holds_only(exponents: Sequence[int], places: frozenset[int]) -> bool:
    return all(not e or i in places for i, e in enumerate(exponents))


# Factors of polynomials whose coefficients hold square roots of numbers, as √2 of 45°

Signs = tuple[int, ...]
Pairs = Sequence[tuple[int, int]]
"""Generators by two, in each of which the polynomials are homogeneous."""


def factors(poly: fmpq_mpoly, roots: Mapping[int, int], pairs: Pairs) -> list[tuple[fmpq_mpoly, int]]:
    """(factor, multiplicity), up to a number; `roots` are generators with the numbers they square to."""
    degrees = poly.degrees()
    used = {index: square for index, square in roots.items() if degrees[index] > 0}
    if not used:
        return [(factor, int(times)) for factor, times in poly.factor()[1]]
    field = _Field(poly.context(), used, pairs)
    content = poly.term_content()
    poly, _ = divmod(poly, content)
    found = [(factor, int(times)) for factor, times in content.factor()[1] if not field.is_number(factor)]
    for norm, _ in field.norm(poly)[0].factor()[1]:
        while (shared := field.common(poly, norm)) is not None:
            times = 0
            while (rest := field.divided(poly, shared)) is not None:
                poly, times = rest, times + 1
            found.append((shared, times))
    return found if field.is_number(poly) else [*found, (poly, 1)]


def quotient(poly: fmpq_mpoly, divisor: fmpq_mpoly, roots: Mapping[int, int]) -> fmpq_mpoly | None:
    """poly / divisor; None where a rest is left."""
    degrees = divisor.degrees()
    used = {index: square for index, square in roots.items() if degrees[index] > 0}
    if used:
        return _Field(poly.context(), used, ()).divided(poly, divisor)
    found, rest = divmod(poly, divisor)
    return None if rest else found


class _Field:
    """Polynomials in generators of which some are square roots of numbers."""

    def __init__(self, ctx: Any, roots: Mapping[int, int], pairs: Pairs) -> None:
        self.ctx, self.roots, self.pairs = ctx, roots, pairs
        self._gens = ctx.gens()
        self._prime = _prime(tuple(roots.values()))
        get: Any = nmod_mpoly_ctx.get  # its types lack the modulus
        self._finite = get(("n", ctx.nvars()), self._prime, Ordering.lex)
        self._values = [pow(square, (self._prime + 1) // 4, self._prime) for square in roots.values()]

    def reduced(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial that is linear in each root."""
        for index, square in self.roots.items():
            poly %= self._gens[index] ** 2 - square
        return poly

    def is_number(self, poly: fmpq_mpoly) -> bool:
        """Whether nothing but roots occurs."""
        return all(degree <= 0 or index in self.roots for index, degree in enumerate(poly.degrees()))

    def norm(self, poly: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """The product with all conjugates, which is free of roots, and the product of these alone."""
        others = self.ctx.constant(1)
        for index in self.roots:
            turned = [-g if i == index else g for i, g in enumerate(self._gens)]
            conjugate = poly.compose(*turned, ctx=self.ctx)
            others = self.reduced(others * conjugate)
            poly = self.reduced(poly * conjugate)
        return poly, others

    def divided(self, poly: fmpq_mpoly, divisor: fmpq_mpoly) -> fmpq_mpoly | None:
        """poly / divisor; None where a rest is left."""
        norm, others = self.norm(divisor)
        quotient, rest = divmod(self.reduced(poly * others), norm)
        return None if rest else quotient

    def common(self, poly: fmpq_mpoly, other: fmpq_mpoly) -> fmpq_mpoly | None:
        """The greatest common divisor of two polynomials, the second one free of roots; None of none."""
        images: dict[Signs, dict[Any, int]] = {}
        for signs in product((1, -1), repeat=len(self.roots)):
            shared = self._image(poly, signs).gcd(self._image(other, signs))
            if shared.is_constant():
                return None
            lead = pow(int(shared.leading_coefficient()), -1, self._prime)
            images[signs] = {tuple(map(int, e)): int(c) * lead for e, c in shared.to_dict().items()}
        found = self._lifted(images)
        return found if found is not None and self.divided(poly, found) is not None else None

    def _image(self, poly: fmpq_mpoly, signs: Signs) -> Any:
        """A polynomial modulo the prime, with these signs of the roots and 1 for the second of each pair."""
        values = dict(zip(self.roots, map(int.__mul__, signs, self._values), strict=True))
        values |= {index: 1 for _, index in self.pairs}
        terms: dict[tuple[int, ...], int] = {}
        for exponents, number in poly.to_dict().items():
            value = int(number.p) * pow(int(number.q), -1, self._prime)
            value *= prod(values[i] ** int(exponents[i]) for i in values)
            plain = tuple(0 if i in values else int(e) for i, e in enumerate(exponents))
            terms[plain] = (terms.get(plain, 0) + value) % self._prime
        return self._finite.from_dict(terms)

    def _lifted(self, images: Mapping[Signs, Mapping[Any, int]]) -> fmpq_mpoly | None:
        """The polynomial with these images; None where its numbers are too long for the prime."""
        terms: dict[tuple[int, ...], fmpq] = {}
        keys = {key for image in images.values() for key in image}
        highest = {index: max(key[first] for key in keys) for first, index in self.pairs}
        firsts = {index: first for first, index in self.pairs}
        for exponents in keys:
            for chosen in product((0, 1), repeat=len(self.roots)):
                total = sum(
                    image.get(exponents, 0) * prod(s**k for s, k in zip(signs, chosen, strict=True))
                    for signs, image in images.items()
                )
                below = len(images) * prod(v**k for v, k in zip(self._values, chosen, strict=True))
                number = _rational(total * pow(below, -1, self._prime) % self._prime, self._prime)
                if number is None:
                    return None
                places = dict(zip(self.roots, chosen, strict=True))
                places |= {i: degree - exponents[firsts[i]] for i, degree in highest.items()}
                terms[tuple(places.get(i, e) for i, e in enumerate(exponents))] = number
        found: fmpq_mpoly = self.ctx.from_dict({key: value for key, value in terms.items() if value})
        return found


@cache
def _prime(squares: Sequence[int]) -> int:
    """A large prime for which all of these are squares, 3 modulo 4."""
    return next(p for p in _candidates() if all(pow(d, (p - 1) // 2, p) == 1 for d in squares))


def _candidates() -> Iterator[int]:
    candidate = 2**62 - 1
    while True:
        if fmpz(candidate).is_prime():
            yield candidate
        candidate -= 4


def _rational(value: int, prime: int) -> fmpq | None:
    """p/q that is `value` modulo the prime, both small; None where there is none."""
    r, s, bound = (prime, value), (0, 1), isqrt(prime // 2)
    while r[1] > bound:
        quotient = r[0] // r[1]
        r, s = (r[1], r[0] - quotient * r[1]), (s[1], s[0] - quotient * s[1])
    return fmpq(r[1], s[1]) if abs(s[1]) <= bound else None


MOST_TERMS = 20_000
"""A polynomial that may have more terms in half angles is not taken apart."""


def trig_factors(expr: Expr) -> tuple[tuple[Expr, int], ...]:
    """(factor, multiplicity) of an expression, up to a number; those without an angle too.

    A factor of its own is what is irreducible in sines and cosines of whole angles.  An
    expression that is too long, or has roots of letters or inverses of what may not be positive, is its own
    only factor.

    >>> from dynsolve.algebra.angles import Angle
    >>> from dynsolve.algebra.ring_values import build_ring
    >>> ring = build_ring([("q1", "revolute")], [], [Angle.of("q1")])
    >>> s, c = ring.sin(Angle.of("q1")), ring.cos(Angle.of("q1"))
    >>> sorted(map(str, trig_factors(s * (c + s))))[1]
    "(Expr(1*sin(1*(('q1', 1),))), 1)"
    """
    return _trig_factors(expr, expr.ring)


@lru_cache(maxsize=1024)  # of what is 0 in a case the factors are asked for again and again
def _trig_factors(expr: Expr, ring: Ring) -> tuple[tuple[Expr, int], ...]:
    """The ring is named, since values of two rings may be equal."""
    if len(expr) == 0 or leading(expr) == expr:
        return ()
    halves = HalfAngles(ring)
    if not halves.can_hold(expr):
        return ((expr, 1),)
    found: Counter[Expr] = Counter()
    for factor, times in halves.factors(halves.homogeneous(expr)):
        found[factor] += times
    return tuple(found.items())


def trig_quotient(expr: Expr, divisor: Expr) -> Expr | None:
    """expr / divisor, where the divisor is seen to be a factor of it."""
    halves = HalfAngles(expr.ring)
    if expr.is_zero or expr == divisor or not (halves.can_hold(expr) and halves.can_hold(divisor)):
        return expr if expr.is_zero else expr.ring.one if expr == divisor else None
    found = quotient(halves.homogeneous(expr), halves.homogeneous(divisor), halves.roots)
    return None if found is None else halves.expr(found)


def squares(expr: Expr) -> tuple[Expr, ...]:
    """What must be 0 where a sum of squares is, as in 1 + c₁ c₂ = 2 (C₁² C₂² + S₁² S₂²).

    Parameters count as positive.  Nothing of what is no such sum.
    """
    halves = HalfAngles(expr.ring)
    if not halves.can_hold(expr):
        return ()
    terms, free = halves.homogeneous(expr).to_dict(), parameters(expr)
    same_sign = len({number > 0 for number in terms.values()}) == 1
    if not same_sign or any(e % 2 and i not in free for exponents in terms for i, e in enumerate(exponents)):
        return ()
    bare = {tuple(0 if i in free else int(e) for i, e in enumerate(exponents)) for exponents in terms}
    return tuple(halves.expr(halves.ctx.from_dict({exponents: 1})) for exponents in sorted(bare))


def at_edge(expr: Expr) -> tuple[Expr, ...]:
    """What must be 0 where a value at the edge of its range is: 1 + c₂ and 1 + c₂₃ of l (2 + c₂ + c₂₃).

    Parameters count as positive.  Nothing of what may be of both signs, or is 0 for some parameters alone.
    """
    ring, free, one = expr.ring, parameters(expr), expr.ring.one
    trig = [i for pair in ring.pairs for i in (pair.sine, pair.cosine)]
    by_size: dict[tuple[int, ...], dict[tuple[int, ...], Fraction]] = {}
    for exponents, number in expr.poly.to_dict().items():
        size = tuple(0 if i in trig else int(e) for i, e in enumerate(exponents))
        if any(e and i not in free for i, e in enumerate(size)):
            return ()
        powers = tuple(int(exponents[i]) for i in trig)
        by_size.setdefault(size, {})[powers] = fraction(number)
    signs, found = set(), dict[Expr, None]()
    for polynomial in by_size.values():
        waves = dict(terms_of(fourier_form(polynomial)))
        middle = waves.pop(("cos", (0,) * len(ring.pairs)), Fraction(0))
        if not middle or abs(middle) != sum(map(abs, waves.values())):
            return ()
        signs.add(middle > 0)
        for (kind, multiples), size_of in waves.items():
            angle = sum((pair.angle * n for pair, n in zip(ring.pairs, multiples, strict=True)), Angle.zero())
            wave = ring.sin(angle) if kind == "sin" else ring.cos(angle)
            found[one + wave if size_of * middle > 0 else one - wave] = None
    is_moving = all(map(ring.depends_on_coordinates, found))
    return tuple(found) if len(signs) == 1 and is_moving else ()


def halves(expr: Expr) -> tuple[tuple[Expr, ...], ...]:
    """Sets, in one of which all is 0 where an expression is: one for each factor in half angles.

    c₁ + c₂ is 0 where cos((q₁ + q₂)/2) is or cos((q₁ - q₂)/2); a factor is 0 where its products with the
    sine and the cosine of the halves of its angles are, which hold whole angles.
    """
    found, halves = [], HalfAngles(expr.ring)
    poly = halves.homogeneous(expr) if halves.can_hold(expr) else halves.ctx.constant(1)
    parts = factors(poly, halves.roots, [(pair.sine, pair.cosine) for pair in expr.ring.pairs])
    for factor, _ in parts:
        multiples = [factor]
        for pair in expr.ring.pairs:
            if any((int(e[pair.sine]) + int(e[pair.cosine])) % 2 for e in factor.monoms()):
                both = halves.gens[pair.sine], halves.gens[pair.cosine]
                multiples = [multiple * half for multiple in multiples for half in both]
        found.append(tuple(map(halves.expr, multiples)))
    moving = [one for one in found if any(map(expr.ring.depends_on_coordinates, one))]
    return tuple(one for one in moving if not (len(one) == 1 and is_positive(one[0]))) or ((expr,),)


class HalfAngles:
    """The ring's polynomials with S and C in the places of sine and cosine, without relations.

    Where only some `pairs` are halved, the sines and cosines of the others stay as they are.
    """

    def __init__(self, ring: Ring, pairs: Sequence[Pair] | None = None) -> None:
        self.ring = ring
        self.pairs: tuple[Pair, ...] = ring.pairs if pairs is None else tuple(pairs)
        self.roots = numeric_roots(ring)
        self.ctx: Any = fmpq_mpoly_ctx.get(("h", ring.ctx.nvars()), Ordering.lex)
        self.gens: tuple[fmpq_mpoly, ...] = self.ctx.gens()

    def can_hold(self, expr: Expr, most: int = MOST_TERMS) -> bool:
        """Whether the expression is a polynomial in sines, cosines and symbols, and not too long."""
        degrees = expr.poly.degrees()
        plain = ("sin", "cos", "symbol")
        known = parameters(expr) | self.roots.keys()
        others = (g.index for g in self.ring.generators if g.kind not in plain and g.index not in known)
        return not any(degrees[index] > 0 for index in others) and self.has_room(expr, most)

    def has_room(self, expr: Expr, most: int = MOST_TERMS) -> bool:
        """Whether the expression has no more than so many terms in half angles."""
        degrees, size = expr.poly.degrees(), len(expr)
        for pair in self.pairs:
            size *= 1 + 2 * max(int(degrees[pair.sine]) + int(degrees[pair.cosine]), 0)
        return size <= most

    def homogeneous(self, expr: Expr) -> fmpq_mpoly:
        """The polynomial in S and C, of one degree in each pair."""
        poly = expr.poly
        highest = {pair: self._highest(poly, pair) for pair in self.pairs}
        total: fmpq_mpoly = self.ctx.constant(0)
        powers: dict[tuple[Pair, int, int], fmpq_mpoly] = {}
        for exponents, factor in poly.to_dict().items():
            plain = list(exponents)
            term = self.ctx.constant(1)
            for pair, degree in highest.items():
                if degree:
                    key = pair, int(exponents[pair.sine]), int(exponents[pair.cosine])
                    if key not in powers:
                        powers[key] = self._power(*key, degree)
                    term = term * powers[key]
                    plain[pair.sine] = plain[pair.cosine] = 0
            total = total + term * self.ctx.from_dict({tuple(plain): factor})
        return total

    @staticmethod
    def _highest(poly: fmpq_mpoly, pair: Pair) -> int:
        return max((int(e[pair.sine]) + int(e[pair.cosine]) for e in poly.monoms()), default=0)

    def _power(self, pair: Pair, sines: int, cosines: int, degree: int) -> fmpq_mpoly:
        """sin^sines cos^cosines · 1^rest, of degree 2·degree in S and C."""
        S, C = self.gens[pair.sine], self.gens[pair.cosine]
        one: fmpq_mpoly = (C * C + S * S) ** (degree - sines - cosines)
        return (2 * S * C) ** sines * (C * C - S * S) ** cosines * one

    def factors(self, poly: fmpq_mpoly) -> Iterator[tuple[Expr, int]]:
        """Those of a polynomial in S and C, in sines and cosines of whole angles."""
        return self.whole(factors(poly, self.roots, [(pair.sine, pair.cosine) for pair in self.pairs]))

    # -- back to whole angles ----------------------------------------------------------------------

    def whole(self, factors: Iterable[tuple[fmpq_mpoly, int]]) -> Iterator[tuple[Expr, int]]:
        """The factors in sines and cosines of whole angles."""
        odd: list[fmpq_mpoly] = []
        for factor, times in factors:
            if self.is_even(factor):
                if not self._is_one(factor):
                    yield _primitive(self.expr(factor)), times
            else:
                odd += [factor] * times
        for expr in self._paired(odd):
            yield expr, 1

    def _paired(self, odd: list[fmpq_mpoly]) -> Iterator[Expr]:
        """Factors of odd degree two by two, those first that make the shortest; then the rest."""
        while True:
            products = [
                (len(value), i, j, value)
                for i, j in combinations(range(len(odd)), 2)
                if self.is_even(odd[i] * odd[j])
                for value in (self.expr(odd[i] * odd[j]),)
            ]
            if not products:
                break
            _, i, j, value = min(products, key=lambda found: found[:3])
            del odd[j], odd[i]
            yield _primitive(value)
        rest = self.ctx.constant(1)
        for factor in odd:
            rest = rest * factor
        if not rest.is_constant():
            yield _primitive(self.expr(rest))

    def _is_one(self, factor: fmpq_mpoly) -> bool:
        """Whether a factor is some C² + S² = 1."""
        return any(factor == self.gens[pair.sine] ** 2 + self.gens[pair.cosine] ** 2 for pair in self.pairs)

    def is_even(self, factor: fmpq_mpoly) -> bool:
        """Whether a polynomial, of one degree in each pair, is one in whole angles."""
        return all(
            (int(e[pair.sine]) + int(e[pair.cosine])) % 2 == 0 for pair in self.pairs for e in factor.monoms()
        )

    def expr(self, poly: fmpq_mpoly) -> Expr:
        """A polynomial of even degree in each pair, by S² = (1 - c)/2, C² = (1 + c)/2, S C = s/2."""
        ring = self.ring
        total = ring.zero
        for exponents, factor in poly.to_dict().items():
            plain = list(exponents)
            term = ring.one
            for pair in self.pairs:
                S, C = int(exponents[pair.sine]), int(exponents[pair.cosine])
                plain[pair.sine] = plain[pair.cosine] = 0
                if S or C:
                    s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
                    both = S % 2
                    term = term * s**both * (ring.one - c) ** (S // 2) * (ring.one + c) ** (C // 2)
                    term = term / 2 ** ((S + C) // 2)
            total = total + term * Expr(ring, ring.ctx.from_dict({tuple(plain): factor}))
        return total


def numeric_roots(ring: Ring) -> dict[int, int]:
    """The generators that are square roots of whole numbers, with these."""
    found = {index: square for index, square in ring.radicands.items() if square.is_constant()}
    return {index: int(square.leading_coefficient().p) for index, square in found.items()}


def leading(expr: Expr) -> Expr:
    """The number, with the roots in it, that stands before the first term; 0 of what has none."""
    roots = numeric_roots(expr.ring)
    split = [
        (tuple(0 if i in roots else int(e) for i, e in enumerate(exponents)), exponents, number)
        for exponents, number in expr.poly.to_dict().items()
    ]
    first = max((plain for plain, _, _ in split), default=())
    terms = {
        tuple(e if i in roots else 0 for i, e in enumerate(exponents)): number
        for plain, exponents, number in split
        if plain == first
    }
    return Expr(expr.ring, expr.ring.ctx.from_dict(terms))


def ratio(expr: Expr, other: Expr) -> Expr:
    """The number that an expression is of another, where it is one."""
    return leading(expr) * expr.ring.inverse(leading(other))


def _primitive(expr: Expr) -> Expr:
    """The expression with leading coefficient 1."""
    return expr * expr.ring.inverse(leading(expr))
