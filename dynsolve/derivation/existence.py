"""Whether there are angles at which A cos θ + B sin θ + C is 0: where A² + B² ≥ C²."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound
from dynsolve.derivation.parameter_signs import ParameterSigns


@dataclass(frozen=True, slots=True)
class Turn:
    """A cos θ + B sin θ + C, with A, B and C free of coordinates."""

    pair: Pair
    cosine: Expr
    sine: Expr
    rest: Expr

    @property
    def is_one_sided(self) -> bool:
        """Whether the cosine stands alone, or the sine."""
        return self.cosine.is_zero or self.sine.is_zero

    @property
    def room(self) -> Expr:
        """A² + B² - C², which is not negative where it is 0 for some angle."""
        return self.cosine**2 + self.sine**2 - self.rest**2


def turn_of(value: Expr) -> Turn | None:
    """An expression as such a sum; None where it is another, or holds no angle."""
    ring = value.ring
    for pair in ring.pairs:
        parts: dict[tuple[int, int], Expr] = {}
        for exponents, number in value.poly.to_dict().items():
            key = (int(exponents[pair.cosine]), int(exponents[pair.sine]))
            plain = tuple(0 if k in (pair.cosine, pair.sine) else e for k, e in enumerate(exponents))
            parts[key] = parts.get(key, ring.zero) + Expr(ring, ring.ctx.from_dict({plain: number}))
        if not parts.keys() - {(0, 0)}:
            continue
        free = not any(ring.depends_on_coordinates(part) for part in parts.values())
        if free and parts.keys() <= {(0, 0), (1, 0), (0, 1)}:
            return Turn(pair, *(parts.get(key, ring.zero) for key in ((1, 0), (0, 1), (0, 0))))
        return None
    return None


def conditions(values: Iterable[Expr], signs: ParameterSigns) -> tuple[Bound, ...] | None:
    """What the parameters must satisfy for these to be 0 somewhere; None where they never are."""
    found = []
    for value in values:
        turn = turn_of(value)
        if turn is None or turn.rest.is_zero:
            continue
        left = signs.open_part(turn.room)
        if signs.is_positive(-left):
            return None
        if not left.is_number:
            found.append(Bound(left, False))
    return tuple(found)
