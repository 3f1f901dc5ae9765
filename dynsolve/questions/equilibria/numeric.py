"""All the zeros of an equation between an angle and its sines, where that has no parameter.

k q + c + Σ A cos(w q) + B sin(w q) is 0 nowhere beyond (|c| + Σ √(A² + B²))/|k|.  An interval holds no zero
where the value in its middle is more than the steepest slope can change, and at most one where the slope
there is more than the strongest bend can change; others are halved.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees, hypot

from dynsolve.algebra.generators import Pair
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.existence import coordinates_in, fourier_parts

MOST_INTERVALS = 20_000
"""After so many, as at a zero at which the slope is 0, too, nothing is said."""

ROUNDING = 1e-12


def all_zeros(value: Expr) -> tuple[str, tuple[float, ...]] | None:
    """The angle that stands in a value and in a sine, and all the zeros in degrees; None of any other."""
    ring, names = value.ring, coordinates_in(value)
    factor = ring.coefficient(value, names[0]) if len(names) == 1 else ring.zero
    if factor.is_zero or not factor.is_number:
        return None
    (name,) = names
    rest = value - factor * ring.symbol(name)
    turning = [pair for pair in ring.pairs if ring.depends_on_coordinates(ring.generator(pair.sine))]
    swings = fourier_parts(rest, [(pair.sine, pair.cosine) for pair in turning])
    try:
        sizes = [
            (_rate(name, turning, multiples), hypot(*(evaluate(part, {}) for part in both)))
            for multiples, both in swings.items()
        ]
    except KeyError:  # a parameter, or another coordinate
        return None
    if not any(rate for rate, _ in sizes):
        return None
    steep = abs(float(factor.number))
    far = sum(size for _, size in sizes) / steep
    slope = ring.diff(value, ring.names.index(name))
    bounds = steep + sum(rate * size for rate, size in sizes), sum(rate**2 * size for rate, size in sizes)
    found = [*_isolated(value, slope, name, (-far - 1.1, far + 1.3), bounds)]
    return None if None in found else (name, tuple(degrees(zero) for zero in found if zero is not None))


def _rate(name: str, turning: Sequence[Pair], multiples: Sequence[int]) -> float:
    """How often an angle turns while the coordinate does once."""
    rates = (dict(pair.angle.terms).get(((name, 1),), 0) for pair in turning)
    return abs(float(sum(times * rate for times, rate in zip(multiples, rates, strict=True))))


def _isolated(
    value: Expr, slope: Expr, name: str, between: tuple[float, float], bounds: tuple[float, float]
) -> Iterator[float | None]:
    """The zeros between two numbers; None where there may be others. `bounds` are of slope and bend."""
    left, steepest, bend = [between], *bounds
    for _ in range(MOST_INTERVALS):
        if not left:
            return
        low, high = left.pop()
        middle, half = (low + high) / 2, (high - low) / 2
        if abs(evaluate(value, {name: middle})) > steepest * half:
            continue
        if abs(evaluate(slope, {name: middle})) > bend * half:
            yield from _between(value, name, low, high)
        else:
            left += [(low, middle), (middle, high)]
    yield None


def _between(value: Expr, name: str, low: float, high: float) -> Iterator[float]:
    """The zero of what grows or falls, or none."""
    sign = 1 if evaluate(value, {name: low}) < 0 else -1
    if evaluate(value, {name: high}) * sign < 0:
        return
    while high - low > ROUNDING * max(1.0, abs(low)):
        middle = (low + high) / 2
        if evaluate(value, {name: middle}) * sign < 0:
            low = middle
        else:
            high = middle
    yield (low + high) / 2
