"""vᵀ v on paper: how the squares of the components of a velocity become the square of the speed.

1. Two components that are one vector, turned by an angle, are exchanged for that vector:
   (U s + V c)² + (U c - V s)² = U² + V².
2. What is left is multiplied out and sorted by lengths and rates, the sines and cosines in
   brackets: l₁ l_c2 (s₁ s₁₂ + c₁ c₁₂) q̇₁ (q̇₁ + q̇₂).  A square that shares no product of
   rates with others stays as it is.
3. The brackets become 1, or the cosine of a difference.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import gcd, lcm
from typing import Any, NamedTuple

from flint import fmpq_mpoly

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator, Pair
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Ring
from dynsolve.explain.forms import Forms, is_numeric
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import Function, Node, Symbol
from dynsolve.robot.model import Robot


@dataclass(frozen=True, slots=True)
class Turned:
    """Two components, by their places, that are (a, b) turned by the angle of a pair."""

    pair: Pair
    places: tuple[int, int]
    parts: tuple[Expr, Expr]


def turned(ring: Ring, components: Sequence[Expr]) -> Turned | None:
    """The first two components that are a vector turned by a basic angle: a s + b c and ±(a c - b s)."""
    for pair in ring.pairs:
        linear = [(k, found) for k, x in enumerate(components) if (found := parts(x, pair)) is not None]
        for (i, (a, b)), (j, (x, y)) in combinations(linear, 2):
            if (x == b and y == -a) or (x == -b and y == a):
                return Turned(pair, (i, j), (a, b))
    return None


def parts(x: Expr, pair: Pair) -> tuple[Expr, Expr] | None:
    """(a, b) of a s + b c, the coefficients free of both; None for anything else, and for 0."""
    poly = x.poly
    a, b = poly.derivative(pair.sine), poly.derivative(pair.cosine)
    if not (a or b) or any(p.degrees()[g] > 0 for p in (a, b) for g in (pair.sine, pair.cosine)):
        return None
    s, c = x.ring.generator(pair.sine).poly, x.ring.generator(pair.cosine).poly
    return (Expr(x.ring, a), Expr(x.ring, b)) if poly == a * s + b * c else None


@dataclass(frozen=True, slots=True)
class Shared:
    """What all components of a velocity share: ½ l₂ and q̇₁ of l₂ s₁ q̇₁/2 and l₂ c₁ q̇₁/2; 1 for nothing."""

    length: Expr
    rate: Expr

    @property
    def whole(self) -> Expr:
        """The length times the rate."""
        return self.length * self.rate


def shared(robot: Robot, components: Sequence[Expr]) -> Shared:
    """The powers of lengths, with the number before them, and of rates that all components share.

    Of decimals they share nothing.
    """
    ring = robot.ring
    if is_numeric(robot):
        return Shared(ring.one, ring.one)
    terms = [term for x in components for term in x.poly.to_dict().items()]

    def common(generators: Iterable[Generator]) -> Expr:
        product = ring.one
        for g in generators:
            power = min((int(exponents[g.index]) for exponents, _ in terms), default=0)
            product = product * ring.generator(g.index) ** power
        return product

    symbols = [g for g in ring.generators if g.kind == "symbol"]
    length = common(g for g in symbols if g.name in ring.parameters)
    if length != ring.one:
        numbers = [Fraction(int(c.p), int(c.q)) for _, c in terms]
        above, below = zip(*((n.numerator, n.denominator) for n in numbers), strict=True)
        length = length * Fraction(gcd(*above), lcm(*below))
    return Shared(length, common(g for g in symbols if g.dots == 1))


def exchanged(components: Sequence[Expr], found: Turned) -> list[Expr]:
    """The components with a turned vector in place of two of them."""
    rest = [x for k, x in enumerate(components) if k not in found.places]
    return [x for x in found.parts if not x.is_zero] + rest


def factor_of_rate(x: Expr, coordinate: str) -> Expr:
    """The factor of q̇ in a component of a velocity."""
    return Expr(x.ring, x.poly.derivative(x.ring.symbol_indices[(coordinate, 1)]))


def separate(ring: Ring, components: Sequence[Expr]) -> tuple[list[Expr], list[Expr]]:
    """(components whose squares share no product of rates with the others, all others)"""
    rates = [products_of_rates(ring, x.poly * x.poly) for x in components]
    alone: list[Expr] = []
    together: list[Expr] = []
    for k, x in enumerate(components):
        others = {rate for j, held in enumerate(rates) if j != k for rate in held}
        (together if rates[k] & others else alone).append(x)
    return alone, together


def products_of_rates(ring: Ring, poly: fmpq_mpoly) -> set[tuple[int, ...]]:
    """The products of rates that occur, as exponents."""
    places = [ring.symbol_indices[(name, 1)] for name in ring.names]
    return {tuple(e[i] for i in places) for e in poly.to_dict()}


class Group(NamedTuple):
    """Terms with the same lengths and angles: as they stand, and with the brackets worked out."""

    multiplied: Node
    reduced: Node


def has_roots(x: Expr) -> bool:
    """Whether a square root or the cosine of a constant angle stands in an expression."""
    degrees = x.poly.degrees()
    return any(g.kind in ("root", "constant") and degrees[g.index] > 0 for g in x.ring.generators)


def groups(forms: Forms, poly: fmpq_mpoly) -> list[Group] | None:
    """A polynomial before s² + c² = 1 is used, by lengths and by the angles of its sines and cosines.

    None where sines and cosines do not come apart from rates.
    """
    ring = forms.robot.ring
    trig = [(pair.sine, pair.cosine) for pair in ring.pairs]
    angular = {g for both in trig for g in both}
    rates = {ring.symbol_indices[(name, 1)] for name in ring.names}
    split: dict[tuple[tuple[int, ...], tuple[int, ...]], dict[tuple[int, ...], Any]] = {}
    for e, factor in poly.to_dict().items():
        angles = tuple(int(e[s] + e[c]) for s, c in trig)
        lengths = tuple(int(x) for i, x in enumerate(e) if i not in angular and i not in rates)
        split.setdefault((angles, lengths), {})[e] = factor
    in_order = sorted(split, key=lambda key: (sum(map(bool, key[0])) > 1, [-a for a in key[0]]))
    made = [_group(forms, ring.ctx.from_dict(split[key]), angular, rates) for key in in_order]
    return None if None in made else [group for group in made if group is not None]


def factored(forms: Forms, poly: fmpq_mpoly) -> Node:
    """A polynomial before s² + c² = 1 is used, as what that leaves alone times what it changes."""
    ring = forms.robot.ring
    content, factors = poly.factor()
    kept, changed = ring.one, list[tuple[Node, int]]()
    for factor, exponent in factors:
        if ring.reduce(factor) == factor:
            kept = kept * Expr(ring, factor) ** int(exponent)
        else:
            changed.append((_terms(ring, factor), int(exponent)))
    front = fraction(content)
    if len(kept) > 1:  # a sum keeps the fractions of its terms
        kept, front = kept * ring.constant(front), Fraction(1)
    return times(front, [(forms.of(kept), 1), *changed], decimal=is_numeric(forms.robot))


def _group(forms: Forms, poly: fmpq_mpoly, angular: set[int], rates: set[int]) -> Group | None:
    """The product of the factors: lengths, what is in brackets, rates; None for a bracket with rates."""
    ring, decimal = forms.robot.ring, is_numeric(forms.robot)
    content, factors = poly.factor()
    lengths = Expr(ring, ring.one.poly)
    brackets: list[tuple[fmpq_mpoly, int]] = []
    velocities: list[tuple[fmpq_mpoly, int]] = []
    for factor, exponent in factors:
        held = {i for i, degree in enumerate(factor.degrees()) if degree > 0}
        if held & angular and held & rates:
            return None
        if held & angular:
            brackets.append((factor, int(exponent)))
        elif held & rates:
            velocities.append((factor, int(exponent)))
        else:
            lengths = lengths * Expr(ring, factor) ** int(exponent)

    def written(bracket: Callable[[fmpq_mpoly], Node]) -> Node:
        inner = [(bracket(factor), exponent) for factor, exponent in brackets]
        outer = [
            (forms.of(Expr(ring, factor)), exponent) for factor, exponent in sorted(velocities, key=_length)
        ]
        return times(fraction(content), [(forms.of(lengths), 1), *inner, *outer], decimal=decimal)

    return Group(
        written(lambda factor: _terms(ring, factor)),
        written(lambda factor: forms.of(Expr(ring, ring.reduce(factor)))),
    )


def _length(velocity: tuple[fmpq_mpoly, int]) -> int:
    return len(velocity[0])


def _terms(ring: Ring, poly: fmpq_mpoly) -> Node:
    """A polynomial term by term, as it stands."""

    def factors(powers: Sequence[int]) -> list[tuple[Node, int]]:
        found = [(ring.generators[i], int(e)) for i, e in enumerate(powers) if e]
        found.sort(key=lambda power: power[0].kind != "root")  # √3 s c
        return [(_written(ring, g), e) for g, e in found]

    return total([times(fraction(factor), factors(powers)) for powers, factor in poly.to_dict().items()])


def _written(ring: Ring, g: Generator) -> Node:
    """A generator as a formula."""
    if g.kind in ("sin", "cos"):
        return Function(g.kind, angle_node(g.angle, ring.names))
    if g.node is None:
        return Symbol(g.name, g.dots)
    return Function("sqrt", g.node) if g.kind == "root" else g.node
