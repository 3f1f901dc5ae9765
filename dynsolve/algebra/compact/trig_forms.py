"""The forms in which a person may write a trigonometric polynomial in parallel angles.

One function can be written in many ways: c₂² or 1 - s₂², s₂c₂ or ½ sin 2θ₂,
c₂c₂₃ + s₂s₂₃ or c₃.  A trigonometric form is a sum of products of sines and cosines of
linear angles, with rational factors.  `trig_forms` gives those worth considering:

- powers of s and c, an angle at a time with s² eliminated, with c² eliminated, or
  with neither (every term of the same degree, by factors s² + c² = 1);
- the same over the other choices of two basic angles: θ₂ and θ₃ in place of θ₂ and θ₂ + θ₃;
- the Fourier form (`algebra.ring`): sines and cosines of integer combinations of angles, and with squares
  for those of doubled angles.

`AngleGroup.choose` picks one of them.  A polynomial is a dictionary {exponents: factor}, the
exponents those of (s₁, c₁, s₂, c₂, …) in the basic angles.

Choosing the form of each of many small trigonometric polynomials.

The shortest form of one may be dear for the whole: a product of sines and cosines that
other coefficients are written with already costs only its own coefficient.  So the
shortest form is taken for each, and then chosen again, one after the other, at the prices
that the forms of the others make: beside l² c₂² it is b² (2 - c₂²) and not b² (1 + s₂²).

The forms of polynomials in cos δ, the generator of a problem's constant angles.

4 cos³10° - 3 cos 10° is √3/2, and 1 - 2 cos²40° is -sin 10°: a polynomial in cos δ is a
vector in the powers below the degree of its minimal polynomial, and so is every
cos jδ.  A multiple of one of these, or a sum of two, is what a person writes.

Angles that turn about parallel axes, together: only they combine in sums like θ₂ + θ₃.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations, product
from math import comb, inf
from operator import mul
from typing import NamedTuple

from flint import fmpq, fmpq_poly, fmpz_poly

from dynsolve.algebra.angles import Angle, coordinates_in
from dynsolve.algebra.compact.terms import Exponents, Numbered, Parts, Rational, add_term, exact, primitive
from dynsolve.algebra.fourier import FourierForm, Multiples, TrigFunction, fourier_form, positive, terms_of
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.rationals import fraction, rational
from dynsolve.algebra.ring import Ring

TrigPolynomial = dict[Exponents, Rational]

TrigMonomial = tuple[tuple[TrigFunction, int], ...]
"""A product of powers of sines and cosines of linear angles."""

TrigForm = dict[TrigMonomial, Rational]
"""A sum of such products, each with its factor."""

LARGEST_POWER = 6
"""Above this power of one angle only the Fourier form and the normal form are tried."""

MOST_DOUBLED = 4
"""Of more cosines of doubled angles no squares are made."""

MOST_COMBINED = 6
"""Of more terms no two are combined by themselves."""


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
    found.extend(_squares(fourier))
    if max(max(e) for e in poly) > LARGEST_POWER:
        return _distinct(found)
    basis = [unit[j] for j in used]
    found.extend(_eliminations(_restricted(poly, used), basis))
    for other in _other_bases(basis):
        over = _over_basis(fourier, other)
        if over is not None:
            found.extend(_eliminations(over, other))
    return _distinct(found)


def _squares(fourier: FourierForm) -> Iterator[TrigForm]:
    """1 - cos 2α = 2 sin² α and 1 + cos 2α = 2 cos² α where these take up of the constant: s₂² + s₃²."""
    terms = list(terms_of(fourier))
    constant = sum((f for (_, n), f in terms if not any(n)), start=Fraction(0))
    even = [name == "cos" and not any(m % 2 for m in n) for (name, n), _ in terms]
    doubled = [(n, f) for is_even, ((_, n), f) in zip(even, terms, strict=True) if is_even and any(n)]
    rest = [term for is_even, term in zip(even, terms, strict=True) if not is_even]
    for signs in product((1, -1), repeat=len(doubled)) if constant and len(doubled) <= MOST_DOUBLED else ():
        left = constant - sum(map(mul, signs, (f for _, f in doubled)), start=Fraction(0))
        if abs(left) < abs(constant):
            halves = (
                (sign, tuple(m // 2 for m in n), f) for sign, (n, f) in zip(signs, doubled, strict=True)
            )
            yield {
                **({(): left} if left else {}),
                **{((one, 1),): f for one, f in rest},
                **{((("cos" if sign > 0 else "sin", n), 2),): 2 * f * sign for sign, n, f in halves},
            }


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
                written = _without_squares(written, 2 * j + 1)
            elif written is not None and way == "neither":
                written = _homogeneous(written, j)
        if written is not None:
            yield _products(written, basis)
            yield from _with_one_combined(written, basis)


def _with_one_combined(poly: TrigPolynomial, basis: list[Multiples]) -> Iterator[TrigForm]:
    """Two terms as a product: s₁² s₁₂² + s₁ c₁ s₁₂ c₁₂ - 1 as s₁ s₁₂ c₂ - 1."""
    for (e, f), (other, g) in combinations(poly.items(), 2) if len(poly) <= MOST_COMBINED else ():
        if f not in (g, -g):
            continue
        shared = tuple(map(min, e, other))
        pair = {tuple(a - b for a, b in zip(one, shared, strict=True)): h for one, h in ((e, f), (other, g))}
        terms = list(terms_of(fourier_form(pair)))
        if len(terms) == 1 and any(terms[0][0][1]):
            (((name, multiples), factor),) = terms
            columns = zip(*basis, strict=True)
            sign, angle = positive(tuple(sum(map(mul, multiples, column)) for column in columns))
            (beside,) = _products({shared: 1}, basis)
            rest = {one: h for one, h in poly.items() if one not in (e, other)}
            combined = (*beside, ((name, angle), 1))
            yield _products(rest, basis) | {combined: factor * sign if name == "sin" else factor}


def _without_squares(poly: TrigPolynomial, place: int) -> TrigPolynomial:
    """s² → 1 - c², where the sine stands at an even place; c² → 1 - s², where the cosine does at an odd."""
    j, is_cosine = divmod(place, 2)
    result: TrigPolynomial = {}
    for e, f in poly.items():
        half, odd = divmod(e[place], 2)
        other = e[place - 1 if is_cosine else place + 1]
        for k in range(half + 1):
            powers = (other + 2 * k, odd) if is_cosine else (odd, other + 2 * k)
            add_term(result, _with_powers(e, j, *powers), f * (-1) ** k * comb(half, k))
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
        result = _without_squares(result, 2 * j)
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


# Choosing the form of each of many small trigonometric polynomials

TERM = 3.0
"""What a term costs besides its sines and cosines: a sign, a product and a coefficient."""

MIXED = 0.125
"""What each term with another sign than most costs: of a + b s² and (a + b) - b c² the first is taken."""

SHARED = 0.75
"""The part of the price of sines and cosines that is saved where another coefficient stands at them too."""


class _Option(NamedTuple):
    """A form by the numbers of its monomials, and its price; the least it may cost beside others."""

    items: tuple[tuple[int, Rational], ...]
    price: float
    trig_prices: tuple[float, ...]
    least: float


class AngleGroup:
    """Basic angles that combine, and the choice among the forms of polynomials in their sines and cosines.

    `places` are the indices of their generators, `powers` and `monomials` number what is given and what is
    chosen.  The forms of every polynomial met so far are kept, up to a rational factor: the
    entries of D, C and the torques share a few dozen, and PUMA 560 would take 70 %
    longer without.
    """

    def __init__(
        self,
        angles: Sequence[Angle],
        places: Sequence[int],
        forms: Callable[[TrigPolynomial], list[TrigForm]] = trig_forms,
    ) -> None:
        self.angles = angles
        self.places = places
        self.powers = Numbered[Exponents]((0,) * len(places))
        self.monomials = Numbered[TrigMonomial](())
        self._forms = forms
        self._made: dict[frozenset[tuple[int, Rational]] | int, list[_Option]] = {}

    def angle(self, multiples: Sequence[int]) -> Angle:
        """The angle of these multiples of the basic ones."""
        total = Angle()
        for basic, multiple in zip(self.angles, multiples, strict=True):
            total = total + basic * multiple
        return total

    def choose(
        self, polynomials: Mapping[Parts, dict[int, Rational]]
    ) -> Iterator[tuple[Parts, tuple[tuple[int, Rational], ...], Rational]]:
        """(key, the terms of the chosen form, the factor of all of them) of each polynomial.

        The keys are the monomials in parameters whose coefficients the polynomials are.
        """
        options = {key: self._options(polynomial) for key, polynomial in polynomials.items()}
        chosen = {key: made[0] for key, (made, _) in options.items()}
        uses = Counter(number for option in chosen.values() for number, _ in option.items)
        for key, (made, _) in options.items():
            if len(made) > 1:
                for number, _ in chosen[key].items:
                    uses[number] -= 1
                chosen[key] = _cheapest(made, uses)
                for number, _ in chosen[key].items:
                    uses[number] += 1
        return ((key, chosen[key].items, factor) for key, (_, factor) in options.items())

    def _options(self, polynomial: dict[int, Rational]) -> tuple[list[_Option], Rational]:
        """(forms, the cheapest first; the factor they are to be multiplied with)"""
        key: frozenset[tuple[int, Rational]] | int
        if len(polynomial) == 1:
            ((key, scale),) = polynomial.items()
        else:
            key, scale = primitive(polynomial)
        made = self._made.get(key)
        if made is None:
            whole = {self.powers.values[number]: exact(f, scale) for number, f in polynomial.items()}
            made = self._made[key] = sorted(map(self._option, self._forms(whole)), key=lambda o: o.price)
        return made, scale

    def _option(self, form: TrigForm) -> _Option:
        trig_prices = tuple(
            float(sum(2 + _angle_price(multiples) + (e > 1) for (_, multiples), e in mono)) for mono in form
        )
        odd = sum(0.5 * (abs(f) != 1) + (f.denominator != 1) for f in form.values())
        minuses = sum(f < 0 for f in form.values())
        mixed = MIXED * min(minuses, len(form) - minuses)
        price = TERM * len(form) + sum(trig_prices) + odd + mixed
        items = tuple((self.monomials.number(mono), f) for mono, f in form.items())
        return _Option(items, price, trig_prices, price - SHARED * sum(trig_prices))


def _cheapest(options: list[_Option], uses: Counter[int]) -> _Option:
    """The option that costs least where other coefficients are written with some monomials."""
    best, least = options[0], inf
    for option in options:
        if option.least < least:
            terms = zip(option.items, option.trig_prices, strict=True)
            price = option.price - SHARED * sum(price for (number, _), price in terms if uses[number])
            if price < least:
                best, least = option, price
    return best


def _angle_price(multiples: Multiples) -> int:
    """The operations inside sin( ): 1 for θ₂ + θ₃ and for 2θ₂."""
    return sum(1 + (abs(m) != 1) for m in multiples if m) - 1


# The forms of polynomials in cos δ, the generator of a problem's constant angles

_KNOWN: dict[Fraction, tuple[TrigMonomial, Fraction]] = {
    Fraction(0): ((), Fraction(1)),
    Fraction(60): ((), Fraction(1, 2)),
    Fraction(30): (((("sqrt", (3,)), 1),), Fraction(1, 2)),
    Fraction(45): (((("sqrt", (2,)), 1),), Fraction(1, 2)),
}
"""Cosines that are written without an angle."""

_Known = tuple[tuple[TrigMonomial, Fraction], tuple[Fraction, ...]]
"""What is written, with its number, and its vector."""


class ConstantForms:
    """Writes polynomials {(k,): factor} in powers of cos δ, by sines and cosines of `written` angles.

    Angles are in degrees.

    >>> ten = ConstantForms(Fraction(10))
    >>> ten({(3,): 4, (1,): -3})
    [{((('sqrt', (3,)), 1),): Fraction(1, 2)}]
    """

    def __init__(self, delta: Fraction, written: Collection[Fraction] = ()) -> None:
        self.delta = delta
        self.written = written
        halves = fmpz_poly.cos_minpoly(int(360 / delta))
        self._relation = fmpq_poly(halves)(fmpq_poly([0, 2]))
        self._degree = int(halves.degree())
        self._cosines = [(self._name(j), self._vector(self._chebyshev(j))) for j in range(int(90 / delta))]
        self._squares = list(self._of_squares())

    def __call__(self, poly: TrigPolynomial) -> list[TrigForm]:
        """The shortest form: one cosine, a square of a written one, two, or the sum over all powers."""
        vector = self._vector(fmpq_poly(self._dense(poly)))
        for among, count in ((self._cosines, 1), (self._squares, 1), (self._cosines, 2)):
            found = next(self._combinations(vector, among, count), None)
            if found is not None:
                return [found]
        return [self._fourier(poly)]

    def _of_squares(self) -> Iterator[_Known]:
        """sin² and cos² of the written angles: sin² 20° and not (1 - cos 40°)/2."""
        for angle in sorted(self.written):
            for j in (angle / self.delta, (90 - angle) / self.delta):
                mono, _ = self._name(int(j))
                if mono and mono[0][0][0] != "sqrt":
                    yield (((mono[0][0], 2),), Fraction(1)), self._vector(self._chebyshev(int(j)) ** 2)

    def _dense(self, poly: TrigPolynomial) -> list[fmpq]:
        dense = [fmpq(0)] * (max(k for (k,) in poly) + 1)
        for (k,), factor in poly.items():
            dense[k] = rational(factor)
        return dense

    def _vector(self, polynomial: fmpq_poly) -> tuple[Fraction, ...]:
        rest = polynomial % self._relation
        coefficients = [fraction(c) for c in rest.coeffs()]
        return (*coefficients, *(Fraction(0) for _ in range(self._degree - len(coefficients))))

    @staticmethod
    def _chebyshev(j: int) -> fmpq_poly:
        return fmpq_poly(fmpz_poly.chebyshev_t(j))

    def _name(self, j: int) -> tuple[TrigMonomial, Fraction]:
        """cos jδ by a root, or of an angle that is written, or as the sine of the complement above 45°."""
        angle = self.delta * j
        if angle in _KNOWN:
            return _KNOWN[angle]
        is_sine = angle > 45
        if (angle in self.written) != (90 - angle in self.written):
            is_sine = angle not in self.written
        if is_sine:
            return ((("sin", (int(90 / self.delta) - j,)), 1),), Fraction(1)
        return ((("cos", (j,)), 1),), Fraction(1)

    def _combinations(
        self, vector: tuple[Fraction, ...], among: Sequence[_Known], count: int
    ) -> Iterator[TrigForm]:
        for chosen in combinations(among, count):
            factors = coordinates_in([v for _, v in chosen], vector)
            if factors is not None and all(factors):
                yield {
                    mono: exact(f * scale, 1) for ((mono, scale), _), f in zip(chosen, factors, strict=True)
                }

    def _fourier(self, poly: TrigPolynomial) -> TrigForm:
        """Σ cos jδ by cos^k δ = 2^-k Σ_i C(k, i) cos (k - 2i)δ."""
        form: TrigForm = {}
        for (k,), factor in poly.items():
            for i in range(k + 1):
                mono, scale = self._name(abs(k - 2 * i))
                total = form.get(mono, 0) + factor * scale * Fraction(comb(k, i), 2**k)
                form[mono] = exact(total, 1)
        return {mono: factor for mono, factor in form.items() if factor}


# Angles that turn about parallel axes, together: only they combine in sums like θ₂ + θ₃


def angle_groups(ring: Ring, parallel: Iterable[Iterable[str]] = ()) -> list[AngleGroup]:
    """The ring's angles in groups, from the base outwards; constant ones last."""
    groups = [
        AngleGroup(
            [pair.angle for pair in pairs],
            [i for pair in pairs for i in (pair.sine, pair.cosine)],
        )
        for pairs in _parallel_pairs(ring, parallel)
    ]
    constant = [
        AngleGroup([g.angle], [g.index], ConstantForms(g.angle.degrees, ring.plan.constants.written))
        for g in ring.generators
        if g.kind == "constant"
    ]
    return groups + constant


def _parallel_pairs(ring: Ring, parallel: Iterable[Iterable[str]]) -> list[tuple[Pair, ...]]:
    """The ring's basic angles by parallel group, from the base outwards.

    Two angles belong together where they share a coordinate, or where their
    coordinates stand in one group of `parallel`.
    """
    given = [frozenset(names) for names in parallel]
    groups: list[tuple[set[str], list[Pair]]] = []
    for pair in ring.pairs:
        names = {name for atom, _ in pair.angle.terms for name, _ in atom}
        names = names & set(ring.names) or names
        for together in given:
            if names & together:
                names |= together
        touching = [group for group in groups if names & group[0]]
        for group in touching:
            groups.remove(group)
            names |= group[0]
        groups.append((names, [member for group in touching for member in group[1]] + [pair]))
    last = len(ring.names)
    groups.sort(
        key=lambda group: min((ring.names.index(n) for n in group[0] if n in ring.names), default=last)
    )
    return [tuple(members) for _, members in groups]
