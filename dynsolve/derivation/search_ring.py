"""The ring in which coordinates are solved for: one basic angle a revolute coordinate, values as symbols."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import lcm

from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, Contents, name_alone
from dynsolve.algebra.rationals import rational_gcd
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import ring_of


def search_ring(ring: Ring, values: Sequence[str], given_angles: Mapping[str, Angle]) -> Ring:
    """The ring with one basic angle a revolute coordinate and the task's `values` as symbols.

    `given_angles` are the coordinates that sums of angles in the task give away, each as an angle of
    such values and of other coordinates: the names of these values are angles too.
    """
    names = [name for name, _ in ring.coordinates]
    carried = [_put(pair.angle, given_angles) for pair in ring.pairs]
    turning = tuple(
        (_unit(names, name, _finest_rate(carried, name)), Angle())
        for name, kind in ring.coordinates
        if (kind == "revolute" or _turns(carried, name)) and name not in given_angles
    )
    constants = Contents(angles=tuple(Angle((), one.degrees) for one in carried if one.degrees % 90))
    plan = ring.plan.extended(constants, 0) if given_angles else ring.plan
    fixed = dict(plan.fixed)
    for atom, rate in (term for angle in (*given_angles.values(), *carried) for term in angle.terms):
        if name_alone(atom) not in names:
            fixed[atom] = rational_gcd((rate, fixed.get(atom, rate)))
    symbols = tuple(dict.fromkeys((*plan.symbols, *values)))
    return ring_of(
        ring.coordinates,
        replace(plan, turning=turning, fixed=tuple(fixed.items()), symbols=symbols, signed=tuple(values)),
    )


def _put(angle: Angle, angles: Mapping[str, Angle]) -> Angle:
    """An angle with others for coordinates."""
    found = angle
    for atom, rate in angle.terms:
        if (name := name_alone(atom)) in angles:
            found = found + (angles[name] - Angle.of(name)) * rate
    return found


def _unit(names: Sequence[str], name: str, rate: Fraction) -> tuple[Fraction, ...]:
    return tuple(rate if other == name else Fraction(0) for other in names)


def _turns(angles: Sequence[Angle], name: str) -> bool:
    """Whether a coordinate stands alone in an angle, as the length x does in cos(x/2)."""
    return any(atom == ((name, 1),) for angle in angles for atom, _ in angle.terms)


def _finest_rate(angles: Sequence[Angle], name: str) -> Fraction:
    """The part of a coordinate of which all its multiples in angles are whole multiples."""
    rates = [rate for angle in angles for atom, rate in angle.terms if atom == ((name, 1),)]
    return Fraction(1, lcm(*(rate.denominator for rate in rates))) if rates else Fraction(1)
