"""The zero of height, which is the student's to choose.

P may differ from the key by h0 Σ m_i |g|, with one height h0 for all bodies, free of
coordinates, masses and g, of dimension length.  What is looked for is the potential
φ = |g| h0 that a unit of mass has at the key's zero of height.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping

from dynsolve.algebra.expr import Expr
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.units import LENGTH


def potential_at_zero_height(
    answer_ring: AnswerRing, values: Mapping[str, Expr], dimensions: Dimensions
) -> Expr | None:
    """φ as most of P_i and P have it, or as L has it where there is no P; None for the key's own zero.

    `values` are the student's values of P_i, P and L.
    """
    energies = {name: value for name, value in values.items() if name != "L"}
    levels = list(_levels(answer_ring, energies or values, dimensions))
    if not levels:
        return None
    counts = Counter(level for level in levels)
    most = max(counts.values())
    common = [level for level in counts if counts[level] == most]
    best = next((level for level in common if level.is_zero), common[0])
    return None if best.is_zero else best


def _levels(answer_ring: AnswerRing, values: Mapping[str, Expr], dimensions: Dimensions) -> Iterable[Expr]:
    robot = answer_ring.robot
    total = answer_ring.ring.zero
    for body in robot.bodies:
        total = total + body.mass
    masses = {"P": total, "L": -total, **{f"P{body.name}": body.mass for body in robot.bodies}}
    for name, value in values.items():
        difference = value - answer_ring.key(name)
        if difference.is_zero:
            yield difference
            continue
        level = _quotient(difference, masses[name])
        if level is not None and is_zero_height(answer_ring, level, dimensions):
            yield level


def is_zero_height(answer_ring: AnswerRing, level: Expr, dimensions: Dimensions) -> bool:
    """Whether a potential is |g| times a height that may be chosen."""
    ring, robot = answer_ring.ring, answer_ring.robot
    if ring.depends_on_coordinates(level):
        return False
    strength = None
    for entry in robot.gravity.entries:
        if not entry.is_zero:
            strength = entry.poly if strength is None else strength.gcd(entry.poly)
    if strength is None:
        return False
    height = _quotient(level, Expr(ring, strength))
    if height is None:
        return False
    taken = {i for body in robot.bodies for i in _used(body.mass)} | set(_used(Expr(ring, strength)))
    if taken & set(_used(height)):
        return False
    return dimensions.fits(height, LENGTH)


def _quotient(expr: Expr, divisor: Expr) -> Expr | None:
    if divisor.is_zero:
        return None
    quotient, rest = divmod(expr.poly, divisor.poly)
    return None if rest else Expr(expr.ring, quotient)


def _used(expr: Expr) -> list[int]:
    return [i for i, degree in enumerate(expr.poly.degrees()) if degree > 0] if expr.poly else []
