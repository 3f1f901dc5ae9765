"""Constant angles from exact vectors: -90°, 30°, β + 90°.

An angle is looked for in floating point, with every letter at a few fixed values, among
degrees and whole multiples of the angles that the drawing is made with; what is found is
then proved in the ring.  So is the sign of a length: one that is positive, whatever
positive values the letters have.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import product
from math import acos, atan2, degrees, exp
from random import Random

from dynsolve.algebra.angles import Angle, Atom, names_of
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import evaluate
from dynsolve.errors import AlgebraError

_SEED = 20_060_302
_SAMPLES = 6
_LARGEST_MULTIPLE = 2
_FINEST = 60
"""A part of a degree that a drawing may have: minutes."""
_TOLERANCE = 1e-7

Values = dict[str, float]


@lru_cache(maxsize=32)
def samples(ring: Ring) -> tuple[Values, ...]:
    """Positive values for every letter of a ring, those of angles acute; the same ones every time."""
    random = Random(_SEED)  # noqa: S311 - the same values every time are wanted
    angles = {name for angle in ring.plan.basic_angles for name in names_of(angle)}

    def value(name: str) -> float:
        return random.uniform(0.2, 1.3) if name in angles else exp(random.uniform(-1.5, 1.5))

    return tuple({name: value(name) for name in ring.parameters} for _ in range(_SAMPLES))


def sign(expr: Expr) -> int:
    """+1 or -1 where an expression has that sign for all positive letters, else 0."""
    signs = {_sign(evaluate(expr, values)) for values in samples(expr.ring)}
    return signs.pop() if len(signs) == 1 else 0


def _sign(value: float) -> int:
    return 0 if abs(value) < _TOLERANCE else 1 if value > 0 else -1


def angle_of(cosine: Expr, sine: Expr) -> Angle | None:
    """The angle with this cosine and sine, a number in (-180°, 180°]; None where none is found."""
    ring = cosine.ring
    for angle in direction_angles(cosine, sine):
        if _cos_sin(ring, angle) == (cosine, sine):
            return angle
    return None


def angle_between(cosine: Expr) -> Angle | None:
    """The angle in (0°, 180°) that has this cosine; None where none is found."""
    ring = cosine.ring
    floats = [degrees(acos(max(-1.0, min(1.0, evaluate(cosine, v))))) for v in samples(ring)]
    for angle in _candidates(ring, floats):
        found = _cos_sin(ring, angle)
        if found and found[0] == cosine:
            return angle
    return None


def direction_angles(along: Expr, across: Expr) -> Iterator[Angle]:
    """Angles whose tangent may be across / along, in the quadrant of the two; still to be proved."""
    ring = along.ring
    values = samples(ring)
    floats = [degrees(atan2(evaluate(across, v), evaluate(along, v))) for v in values]
    yield from _candidates(ring, floats)
    # where a length changes its sign with the letters, the direction turns round
    acute = [(value + 90) % 180 - 90 for value in floats]
    if acute != floats:
        yield from _candidates(ring, acute)


def _cos_sin(ring: Ring, angle: Angle) -> tuple[Expr, Expr] | None:
    try:
        return ring.cos(angle), ring.sin(angle)
    except AlgebraError:
        return None


def _candidates(ring: Ring, floats: Sequence[float]) -> Iterator[Angle]:
    """Sums of degrees and multiples of the ring's symbolic angles that have these values at the samples."""
    atoms = ring.plan.fixed
    values = [[degrees(float(rate) * _atom(atom, v)) for atom, rate in atoms] for v in samples(ring)]
    multiples = range(-_LARGEST_MULTIPLE, _LARGEST_MULTIPLE + 1)
    every = sorted(product(multiples, repeat=min(len(atoms), 3)), key=lambda times: sum(map(abs, times)))
    for times in every:
        rests = [
            value - sum(k * part for k, part in zip(times, parts, strict=False))
            for value, parts in zip(floats, values, strict=True)
        ]
        constant = Fraction(rests[0]).limit_denominator(_FINEST)
        if all(_same_direction(rest, float(constant)) for rest in rests):
            terms = [(atom, rate * k) for k, (atom, rate) in zip(times, atoms, strict=False) if k]
            yield Angle(tuple(sorted(terms)), _reduced(constant))


def _same_direction(a: float, b: float) -> bool:
    return abs((a - b + 180) % 360 - 180) < _TOLERANCE


def _reduced(constant: Fraction) -> Fraction:
    """The same direction in (-180°, 180°]."""
    return -((-constant + 180) % 360 - 180)


def _atom(atom: Atom, values: Values) -> float:
    value = 1.0
    for name, exponent in atom:
        value *= values[name] ** exponent
    return value
