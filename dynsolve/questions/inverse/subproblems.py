"""The forms in which an unknown is solved for, each with its solutions and when there are any.

Each form is a record of exact expressions in what is known; `values` gives its solutions
in numbers, in the order in which `questions.inverse.explain` writes them.

    TwoLines      A c + B s = X and A' c + B' s = X'        one angle
    OneLine       A c + B s = X                             two angles, two where X² < A² + B²
    Length        M d = N, and M' d = N' beside it          one length
    RootLength    A d² + B d + C = 0                        two lengths
    Remainder     q = (values - other angles) / rate        one angle

Craig, section 4.4 and appendix C; Spong, section 3.3; Paul (1981), chapter 3.

An expression by what its unknowns do in it: A cos ψ + B sin ψ + C, or A d² + B d + C.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from math import atan2, sqrt
from typing import Any

from msgspec import Struct

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.factors import is_never_zero, is_positive
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.existence import fourier_parts
from dynsolve.questions.inverse.equations import Equation, Squared, Unknowns

# An expression by what its unknowns do in it: A cos ψ + B sin ψ + C, or A d² + B d + C


class Harmonic(Struct, frozen=True):
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
    parts = fourier_parts(expr, map(unknowns.pair, names))
    constant = parts.pop((0,) * len(names), (unknowns.ring.zero, unknowns.ring.zero))[0]
    if len(parts) != 1:
        return None
    ((multiples, (cosine, sine)),) = parts.items()
    return Harmonic(tuple((n, m) for n, m in zip(names, multiples, strict=True) if m), cosine, sine, constant)


def _expr(ring: Any, terms: Mapping[Any, Any]) -> Expr:
    return Expr(ring, ring.ctx.from_dict(dict(terms)))


class Quadratic(Struct, frozen=True):
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


Numbers = Callable[[Expr], float]
"""The value of an expression where everything known has a number."""


def holds_in_general(value: Expr) -> bool:
    """Whether parameters alone stand in what is not 0, as in cos α: it is 0 for special ones at most."""
    ring = value.ring
    given = {*ring.names, *ring.plan.signed}
    used = [ring.generators[index] for index in value.used]
    return all(
        g.name not in given if g.kind == "symbol" else given.isdisjoint(names_of(g.angle))
        for g in used
        if g.kind in ("symbol", "sin", "cos")
    )


NEARLY = 1e-9
"""What rounding may make of 0, relative to the size of what was added up."""


class TwoLines(Struct, frozen=True):
    """A c + B s = X and A' c + B' s = X': the angle of the point where two lines meet."""

    coordinate: str
    first: tuple[Expr, Expr, Expr]
    second: tuple[Expr, Expr, Expr]
    equations: tuple[Equation, ...]
    count = 1

    @property
    def rank(self) -> int:
        """A vector that is turned before other lines, and these before lines that may be parallel."""
        if self.is_rotation:
            return 0
        return 1 if holds_in_general(self.determinant) else 6

    @property
    def is_rotation(self) -> bool:
        """Whether the lines say that a vector is turned: A' = -B and B' = A, or the other way."""
        (a, b, _), (c, d, _) = self.first, self.second
        return (d == a and c == -b) or (d == -a and c == b)

    @property
    def may_be_free(self) -> bool:
        """Whether a vector is turned that may have no length, A² + B², or lines may be parallel."""
        a, b, _ = self.first
        return not (is_positive(a * a + b * b) if self.is_rotation else is_never_zero(self.determinant))

    @property
    def determinant(self) -> Expr:
        """A B' - A' B; where it is 0 the angle is free or there is none."""
        (a, b, _), (c, d, _) = self.first, self.second
        return a * d - c * b

    @property
    def size(self) -> int:
        """How much there is to write."""
        return sum(map(len, (*self.first, *self.second)))

    def values(self, at: Numbers) -> tuple[float, ...]:
        """The angle; none where the determinant is 0."""
        (a, b, x), (c, d, y) = (tuple(map(at, line)) for line in (self.first, self.second))
        determinant = a * d - c * b
        if abs(determinant) <= NEARLY * (abs(a * d) + abs(c * b)):
            return ()
        return (atan2((a * y - c * x) / determinant, (d * x - b * y) / determinant),)


class OneLine(Struct, frozen=True):
    """A c + B s = X: the two angles at which a circle meets a line."""

    coordinate: str
    cosine: Expr
    sine: Expr
    value: Expr
    equations: tuple[Equation, ...]
    count = 2

    @property
    def rank(self) -> int:
        """A direction (X = 0), a single sine or cosine (its factor never 0, or it may be), and then both."""
        if self.value.is_zero:
            return 2
        if not (self.cosine.is_zero or self.sine.is_zero):
            return 5
        return 3 if is_never_zero(self.cosine + self.sine) else 4

    @property
    def size(self) -> int:
        """How much there is to write."""
        return len(self.cosine) + len(self.sine) + len(self.value)

    def values(self, at: Numbers) -> tuple[float, ...]:
        """Both angles, the one with the positive root first; none beyond reach."""
        a, b, x = at(self.cosine), at(self.sine), at(self.value)
        square = a * a + b * b
        height = square - x * x
        if square == 0 or height < -NEARLY * square:
            return ()
        root = sqrt(max(height, 0.0))
        middle = atan2(b, a)
        return middle + atan2(root, x), middle - atan2(root, x)


class Length(Struct, frozen=True):
    """M d = N, of one equation or of two that are added."""

    coordinate: str
    factor: Expr
    value: Expr
    equations: tuple[Equation, ...]
    count = 1

    @property
    def rank(self) -> int:
        """At once where nothing is divided by that may vanish; of two equations after a vector."""
        if self.may_be_free:
            return 1 if holds_in_general(self.factor) else 6
        return len(self.equations) - 1

    @property
    def may_be_free(self) -> bool:
        """Whether M may be 0."""
        return not is_never_zero(self.factor)

    @property
    def size(self) -> int:
        """How much there is to write."""
        return len(self.factor) + len(self.value)

    def values(self, at: Numbers) -> tuple[float, ...]:
        """The length; none where M is 0."""
        factor = at(self.factor)
        return (at(self.value) / factor,) if factor else ()


class RootLength(Struct, frozen=True):
    """A d² + B d + C = 0."""

    coordinate: str
    square: Expr
    linear: Expr
    constant: Expr
    equations: tuple[Equation, ...]
    count = 2

    @property
    def discriminant(self) -> Expr:
        """B² - 4 A C"""
        return self.linear * self.linear - self.square * self.constant * 4

    @property
    def always_exists(self) -> bool:
        """Whether d² is a sum of squares of what is known."""
        origin, rest = self.equations[0].origin, -self.constant
        is_pure = self.linear.is_zero and is_positive(self.square)
        return is_pure and isinstance(origin, Squared) and origin.left in (rest, rest * self.square)

    @property
    def rank(self) -> int:
        """After an equation of the first degree where what it is divided by may vanish."""
        return 3 if is_never_zero(self.square) else 7

    @property
    def size(self) -> int:
        """How much there is to write."""
        return len(self.square) + len(self.linear) + len(self.constant)

    def values(self, at: Numbers) -> tuple[float, ...]:
        """Both lengths, the one with the positive root first; none beyond reach."""
        a, b, c = at(self.square), at(self.linear), at(self.constant)
        radicand = b * b - 4 * a * c
        if a == 0 or radicand < -NEARLY * (b * b + abs(4 * a * c)):
            return ()
        root = sqrt(max(radicand, 0.0))
        return (-b + root) / (2 * a), (-b - root) / (2 * a)


class Remainder(Struct, frozen=True):
    """q = (Σ values - Σ rateₖ qₖ - rest) / rate, where the task gives sums of angles; in radians."""

    coordinate: str
    rate: Fraction
    given: tuple[tuple[str, Fraction], ...]
    others: tuple[tuple[str, Fraction], ...]
    rest: Expr
    equations: tuple[Equation, ...] = ()
    count = 1
    rank = 0

    @property
    def size(self) -> int:
        """How much there is to write."""
        return 1 + len(self.others)

    def values(self, at: Numbers) -> tuple[float, ...]:
        """The angle."""
        symbol = self.rest.ring.symbol
        given, others = (
            sum(float(rate) * at(symbol(name)) for name, rate in terms) for terms in (self.given, self.others)
        )
        return ((given - others - at(self.rest)) / float(self.rate),)


Solved = TwoLines | OneLine | Length | RootLength | Remainder
"""An unknown with its solutions."""


def recognized(equations: Sequence[Equation], unknowns: Unknowns) -> Iterator[Solved]:
    """Every unknown that some of these equations give, in a known form."""
    harmonics: list[tuple[Harmonic, Equation]] = []
    lengths: list[Length] = []
    for equation in equations:
        expr = equation.expr
        if len(unknowns.within(expr)) != 1:
            continue
        wave = harmonic(expr, unknowns)
        if wave is not None and wave.coordinate is not None:
            harmonics.append((wave, equation))
            yield _one_line(wave.coordinate, wave, equation)
        for length in _lengths(equation, unknowns):
            lengths += [length] if isinstance(length, Length) else []
            yield length
    yield from _pairs(harmonics)
    yield from _projected(lengths)


def _one_line(coordinate: str, wave: Harmonic, equation: Equation) -> OneLine:
    """A c + B s = X with the sign that leaves fewer minus signs in its solutions."""
    a, b, x = wave.cosine, wave.sine, -wave.constant
    shown = (a, -b) if x.is_zero else (a, b, x)
    if 2 * sum(map(_negative_terms, shown)) > sum(map(len, shown)):
        a, b, x = -a, -b, -x
    return OneLine(coordinate, a, b, x, (equation,))


def _negative_terms(expr: Expr) -> int:
    return sum(factor < 0 for factor in expr.poly.coeffs())


def _lengths(equation: Equation, unknowns: Unknowns) -> Iterator[Solved]:
    found = quadratic(equation.expr, unknowns)
    if found is None:
        return
    a, b, c = found.square, found.linear, found.constant
    if a.is_zero:
        yield Length(found.coordinate, b, -c, (equation,))
    elif _negative_terms(a) == len(a):
        yield RootLength(found.coordinate, -a, -b, -c, (equation,))
    else:
        yield RootLength(found.coordinate, a, b, c, (equation,))


def _projected(lengths: Iterable[Length]) -> Iterator[Length]:
    """M d = N and M' d = N', where M or M' may vanish, but not both: (M² + M'²) d = M N + M' N'."""
    may_vanish = (one for one in lengths if one.rank)
    for one, other in combinations(may_vanish, 2):
        factor = one.factor * one.factor + other.factor * other.factor
        if one.coordinate == other.coordinate and is_never_zero(factor):
            value = one.factor * one.value + other.factor * other.value
            yield Length(one.coordinate, factor, value, (*one.equations, *other.equations))


def _pairs(harmonics: Iterable[tuple[Harmonic, Equation]]) -> Iterator[Solved]:
    for (one, first), (two, second) in combinations(harmonics, 2):
        if one.coordinate == two.coordinate and one.coordinate is not None:
            lines = TwoLines(
                one.coordinate,
                (one.cosine, one.sine, -one.constant),
                (two.cosine, two.sine, -two.constant),
                (first, second),
            )
            if not lines.determinant.is_zero:
                yield lines
