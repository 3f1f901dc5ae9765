"""Equations between what the task gives and what the unknowns make, and how others come from them.

An equation is kept as `left = right`: to the right stands what holds unknowns and no value
of the task, to the left everything else.  A system is a list of such equations that are
components of one vector, so that they may be turned about an axis and their squares added:

    turned by ψ     c lᵢ + s lⱼ = c rᵢ + s rⱼ,   -s lᵢ + c lⱼ = -s rᵢ + c rⱼ
    squared         Σ lᵢ² = Σ rᵢ²
    moved           lᵢ - aᵢ = bᵢ, where rᵢ = aᵢ + bᵢ and aᵢ is all that holds one unknown
    combined        a lⱼ - b lᵢ = a rⱼ - b rᵢ, where a d in rᵢ and b d in rⱼ are all that holds a length d

They hold wherever the equations do.

The ring in which a task is solved for its coordinates, and which of these are still unknown.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import combinations, permutations
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.ring import Expr, Ring

# The ring in which a task is solved for its coordinates, and which of these are still unknown


class Unknowns(Struct, frozen=True, dict=True):
    """The coordinates that are still looked for, in one ring; `values` are the names of the task's values."""

    ring: Ring
    names: tuple[str, ...]
    values: tuple[str, ...]

    def without(self, name: str) -> Unknowns:
        """The same after `name` has been solved for."""
        return replace(self, names=tuple(other for other in self.names if other != name))

    @cached_property
    def turning(self) -> tuple[str, ...]:
        """The unknown angles."""
        return tuple(name for name in self.names if self._kind[name] == "revolute")

    @cached_property
    def sliding(self) -> tuple[str, ...]:
        """The unknown lengths."""
        return tuple(name for name in self.names if self._kind[name] == "prismatic")

    @cached_property
    def _kind(self) -> dict[str, str]:
        return dict(self.ring.coordinates)

    @cached_property
    def _generators(self) -> dict[str, tuple[int, ...]]:
        """Of each coordinate the generators in which it occurs."""
        found: dict[str, list[int]] = {name: [] for name in self.names}
        for pair in self.ring.pairs:
            for atom, _ in pair.angle.terms:
                for name, _ in atom:
                    if name in found:
                        found[name] += [pair.sine, pair.cosine]
        for name in found:
            found[name].append(self.ring.symbol_indices[(name, 0)])
        return {name: tuple(indices) for name, indices in found.items()}

    @cached_property
    def places(self) -> tuple[int, ...]:
        """The generators of all unknowns."""
        return tuple(i for indices in self._generators.values() for i in indices)

    def pair(self, name: str) -> tuple[int, int]:
        """The generators of the sine and the cosine of an unknown angle."""
        sine, cosine, _ = self._generators[name]
        return sine, cosine

    def sine(self, name: str) -> Expr:
        """sin of an unknown angle."""
        return self.ring.sin(Angle.of(name))

    def cosine(self, name: str) -> Expr:
        """cos of an unknown angle."""
        return self.ring.cos(Angle.of(name))

    def has(self, expr: Expr, name: str) -> bool:
        """Whether an unknown occurs in an expression."""
        degrees = expr.poly.degrees()
        return any(degrees[i] > 0 for i in self._generators[name])

    def within(self, expr: Expr) -> tuple[str, ...]:
        """The unknowns that occur in an expression."""
        return tuple(name for name in self.names if self.has(expr, name))

    def factor(self, expr: Expr, name: str) -> Expr | None:
        """The factor of an unknown length, where that stands in one term with what is known; else None."""
        index = self.ring.symbol_indices[(name, 0)]
        if int(expr.poly.degrees()[index]) != 1:
            return None
        found = self.ring.coefficient(expr, name)
        return None if self.within(found) else found

    def split(self, expr: Expr) -> tuple[Expr, Expr]:
        """(the terms without an unknown, the others)"""
        known: dict[tuple[int, ...], Any] = {}
        unknown: dict[tuple[int, ...], Any] = {}
        for exponents, factor in expr.poly.to_dict().items():
            is_unknown = any(exponents[i] for i in self.places)
            (unknown if is_unknown else known)[exponents] = factor
        ring = self.ring
        return Expr(ring, ring.ctx.from_dict(known)), Expr(ring, ring.ctx.from_dict(unknown))


class Given(Struct, frozen=True):
    """Component `index` (from 0) of the task."""

    index: int


class OfPoint(Struct, frozen=True):
    """Coordinate `index` (from 0) of a point that some joints do not move.

    It is seen from the frame before joint `joint` (from 1); 0 is where the arm begins.
    """

    index: int
    joint: int = 0


class OfTurn(Struct, frozen=True):
    """Entry (`row`, `column`) (from 0) of the rotation that some joints make together."""

    row: int
    column: int


Direct = Given | OfPoint | OfTurn
"""What is read off, and not made from other equations."""


class Turned(Struct, frozen=True):
    """The first (cos, sin) or second (-sin, cos) component of two equations turned by a coordinate."""

    first: Equation
    second: Equation
    coordinate: str
    is_second: bool


class Squared(Struct, frozen=True):
    """The sum of the squares of some equations."""

    parts: tuple[Equation, ...]

    @property
    def left(self) -> Expr:
        """Σ left²"""
        return _squares([part.left for part in self.parts])


class Combined(Struct, frozen=True):
    """`factors[0]`·first - `factors[1]`·second, in which a length that stands in both drops out."""

    first: Equation
    second: Equation
    coordinate: str
    factors: tuple[Expr, Expr]


Origin = Direct | Turned | Squared | Combined
"""Where an equation comes from."""


def turns(origin: Origin) -> int:
    """How often something was turned on the way to an equation."""
    match origin:
        case Given() | OfPoint() | OfTurn():
            return 0
        case Turned(first, second):
            return 1 + max(turns(first.origin), turns(second.origin))
        case Combined(first, second):
            return max(turns(first.origin), turns(second.origin))
        case Squared(parts):
            return max(turns(part.origin) for part in parts)


class Equation(Struct, frozen=True):
    """left = right."""

    left: Expr
    right: Expr
    origin: Origin

    @property
    def expr(self) -> Expr:
        """right - left, which is 0."""
        return self.right - self.left


def lineage(equations: Iterable[Equation]) -> Iterator[Equation]:
    """The equations that these come from, and they themselves; each after those that it comes from."""
    for equation in equations:
        match equation.origin:
            case Turned(first, second) | Combined(first, second):
                yield from lineage((first, second))
            case Squared(parts):
                yield from lineage(parts)
        yield equation


System = tuple[Equation, ...]
"""Components of one vector, in the order of the task."""


def arranged(equation: Equation, unknowns: Unknowns) -> Equation:
    """The equation with all terms without an unknown on the left."""
    known, unknown = unknowns.split(equation.right)
    if known.is_zero:
        return equation
    return Equation(equation.left - known, unknown, equation.origin)


def turned_systems(system: System, unknowns: Unknowns) -> Iterator[System]:
    """The systems in which two components are turned by a coordinate that then stands on the left alone."""
    for name in unknowns.turning:
        c, s = unknowns.cosine(name), unknowns.sine(name)
        for i, j in permutations(range(len(system)), 2):
            a, b = system[i], system[j]
            if not (unknowns.has(a.right, name) and unknowns.has(b.right, name)):
                continue
            others = unknowns.without(name)
            right = [others.split(value) for value in (c * a.right + s * b.right, c * b.right - s * a.right)]
            if any(unknowns.has(value, name) for _, value in right) or all(
                value.is_zero for _, value in right
            ):
                continue
            left = (c * a.left + s * b.left, c * b.left - s * a.left)
            pair = [
                Equation(x - known, value, Turned(a, b, name, k == 1))
                for k, (x, (known, value)) in enumerate(zip(left, right, strict=True))
            ]
            replaced = {i: pair[0], j: pair[1]}
            yield tuple(replaced.get(k, equation) for k, equation in enumerate(system))


def parted_systems(system: System, unknowns: Unknowns) -> Iterator[System]:
    """The systems with one unknown apart: on the left alone, or left in one equation alone."""
    yield from _moved_systems(system, unknowns)
    yield from _combined_systems(system, unknowns)


def _moved_systems(system: System, unknowns: Unknowns) -> Iterator[System]:
    """The systems in which all terms with one unknown are on the left, and others on the right."""
    for name in unknowns.names:
        others = unknowns.without(name)
        alone = replace(unknowns, names=(name,))
        parts = [alone.split(equation.right) for equation in system]
        if sum(bool(others.within(right)) for right, moved in parts if not moved.is_zero) > 1:
            yield tuple(
                Equation(e.left - moved, right, e.origin)
                for e, (right, moved) in zip(system, parts, strict=True)
            )


def _combined_systems(system: System, unknowns: Unknowns) -> Iterator[System]:
    """The systems in which a length drops out of all equations but one, in which it has a known factor."""
    for name in unknowns.sliding:
        factors = [unknowns.factor(equation.right, name) for equation in system]
        for i, a in enumerate(factors):
            if a is None or all(b is None for k, b in enumerate(factors) if k != i):
                continue
            yield tuple(
                e if b is None or k == i else _combined((e, a), (system[i], b), name, unknowns)
                for k, (e, b) in enumerate(zip(system, factors, strict=True))
            )


def _combined(
    one: tuple[Equation, Expr], other: tuple[Equation, Expr], name: str, unknowns: Unknowns
) -> Equation:
    """An equation times a factor minus another times one, without a factor that both have."""
    (e, a), (f, b) = one, other
    shared = a.poly.gcd(b.poly)
    first = divmod(a.poly, shared)[0].leading_coefficient()
    a, b = (Expr(a.ring, divmod(x.poly, shared)[0] / first) for x in (a, b))
    origin = Combined(e, f, name, (a, b))
    return arranged(Equation(e.left * a - f.left * b, e.right * a - f.right * b, origin), unknowns)


def squared_sums(system: System) -> Iterator[Equation]:
    """Σ left² = Σ right² over every choice of at least two components that hold unknowns."""
    moving = [equation for equation in system if not equation.right.is_zero]
    for size in range(2, len(moving) + 1):
        for chosen in combinations(moving, size):
            origin = Squared(chosen)
            yield Equation(origin.left, _squares([e.right for e in chosen]), origin)


def _squares(values: Sequence[Expr]) -> Expr:
    return values[0].ring.dot(values, values)
