"""The smallest value of a function of coordinates, as inequalities between parameters.

f > 0 for every q exactly if f > 0 where one coordinate makes it smallest, whatever the others are:
so one coordinate after the other is taken out.

    A + B u,  u a sine or cosine     smallest at u = 1 or u = -1
    A + B u²                         at u = 0 or u = ±1
    A + B u + C u²                   at u = ±1 where C ≤ 0, or its vertex lies outside
    A + B cos θ + C sin θ            A - √(B² + C²), so A > 0 and A² > B² + C²
    A + B cos² θ + C sin θ cos θ     the same of 2θ
    A + B d + C d²,  d a length      A - B²/(4C), so C > 0 and 4AC > B²
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound, follows

MOST = 64
"""More inequalities than this are not worked with."""


@dataclass(frozen=True, slots=True)
class Extreme:
    """An inequality that must hold, and where the function has that value.

    `where` is (generator, value) of sines, cosines and lengths, as far as the place is known.
    """

    bound: Bound
    where: tuple[tuple[int, int], ...] = ()

    def at(self, generator: int, value: int, bound: Bound) -> Extreme:
        """The same at a value of a further generator."""
        return Extreme(bound, (*self.where, (generator, value)))


def smallest(f: Expr, assumed: Sequence[Bound]) -> list[Extreme] | None:
    """Inequalities between parameters that hold exactly if f > 0 for every q; None where none are found."""
    found = [Extreme(Bound(f))]
    ring = f.ring
    while True:
        step = _next(_moving(found), found)
        if step is None:
            return found if not any(ring.depends_on_coordinates(e.bound.value) for e in found) else None
        reduced = [_without(step, extreme, assumed) for extreme in found]
        if any(part is None for part in reduced):
            return None
        found = list(dict.fromkeys(extreme for part in reduced if part for extreme in part))
        if len(found) > MOST:
            return None


def _moving(found: Sequence[Extreme]) -> Iterator[Pair | int]:
    """The coordinates that may be taken out: angles by their sines and cosines, lengths by their place."""
    ring = found[0].bound.value.ring
    yield from (pair for pair in ring.pairs if ring.depends_on_coordinates(ring.cos(pair.angle)))
    yield from (ring.symbol_indices[(name, 0)] for name in ring.names)


def _next(moving: Iterator[Pair | int], found: Sequence[Extreme]) -> Pair | int | None:
    """The first of them that occurs."""
    degrees = [extreme.bound.value.poly.degrees() for extreme in found]
    for one in moving:
        places = (one,) if isinstance(one, int) else (one.sine, one.cosine)
        if any(d[i] > 0 for d in degrees for i in places):
            return one
    return None


def _without(step: Pair | int, extreme: Extreme, assumed: Sequence[Bound]) -> list[Extreme] | None:
    if isinstance(step, int):
        return _without_length(step, extreme)
    return _without_angle(step, extreme, assumed)


def _coefficients(value: Expr, *generators: int) -> dict[tuple[int, ...], Expr]:
    """The coefficients of a polynomial in some generators, by their exponents."""
    parts: dict[tuple[int, ...], dict[tuple[int, ...], object]] = {}
    for exponents, factor in value.poly.to_dict().items():
        key = tuple(int(exponents[i]) for i in generators)
        rest = tuple(0 if i in generators else int(e) for i, e in enumerate(exponents))
        parts.setdefault(key, {})[rest] = factor
    ring = value.ring
    return {key: Expr(ring, ring.ctx.from_dict(terms)) for key, terms in parts.items()}


# -- angles ----------------------------------------------------------------------------------------


def _without_angle(pair: Pair, extreme: Extreme, assumed: Sequence[Bound]) -> list[Extreme] | None:
    value, ring = extreme.bound.value, extreme.bound.value.ring
    found = _coefficients(value, pair.sine, pair.cosine)
    zero = ring.zero
    keys = set(found)
    if keys <= {(0, 0)}:
        return [extreme]
    if keys <= {(0, 0), (0, 1), (0, 2)}:
        return _in_one(extreme, pair.cosine, [found.get((0, k), zero) for k in range(3)], assumed)
    if keys <= {(0, 0), (1, 0), (0, 2)}:  # c² = 1 - s²
        squares = found.get((0, 2), zero)
        by_sine = [found.get((0, 0), zero) + squares, found.get((1, 0), zero), -squares]
        return _in_one(extreme, pair.sine, by_sine, assumed)
    A, B, C = (found.get(key, zero) for key in ((0, 0), (0, 1), (1, 0)))
    if keys <= {(0, 0), (0, 2), (1, 1)}:  # in cos 2θ and sin 2θ
        B, C = found.get((0, 2), zero) / 2, found.get((1, 1), zero) / 2
        A = A + B
    elif not keys <= {(0, 0), (0, 1), (1, 0)}:
        return None
    if not extreme.bound.is_strict:
        return None
    return [replace(extreme, bound=Bound(A)), replace(extreme, bound=Bound(A * A - B * B - C * C))]


def _in_one(
    extreme: Extreme, u: int, coefficients: Sequence[Expr], assumed: Sequence[Bound]
) -> list[Extreme] | None:
    """A + B u + C u² over -1 ≤ u ≤ 1."""
    A, B, C = coefficients
    strict = extreme.bound.is_strict
    ends = [extreme.at(u, 1, Bound(A + B + C, strict)), extreme.at(u, -1, Bound(A - B + C, strict))]
    if B.is_zero:
        return [extreme.at(u, 0, Bound(A, strict)), ends[0]]
    outside = (-C, B - C * 2, -B - C * 2)
    if C.is_zero or any(follows(Bound(value, False), assumed) for value in outside):
        return ends
    if follows(Bound(A * C * 4 - B * B), assumed) and follows(Bound(A), assumed):
        return []
    return None


# -- lengths ---------------------------------------------------------------------------------------


def _without_length(d: int, extreme: Extreme) -> list[Extreme] | None:
    """A + B d + C d² + ... over all lengths."""
    value, ring = extreme.bound.value, extreme.bound.value.ring
    found = {key[0]: part for key, part in _coefficients(value, d).items()}
    strict = extreme.bound.is_strict
    A, B, C = (found.get(k, ring.zero) for k in range(3))
    if all(power % 2 == 0 for power in found):
        if any(power > 2 for power in found):
            return None
        return [extreme.at(d, 0, Bound(A, strict)), replace(extreme, bound=Bound(C, False))]
    if max(found) == 1:
        return [replace(extreme, bound=Bound(-B * B, False)), extreme.at(d, 0, Bound(A, strict))]
    if max(found) > 2 or not strict:
        return None
    return [replace(extreme, bound=Bound(C)), replace(extreme, bound=Bound(A * C * 4 - B * B))]
