"""What the parameters must satisfy for gravity to move nothing, in whatever configuration.

A sum of products of what moves is 0 for every q where each of its coefficients is, and these are
combinations of a few: the entries of a in g = Y a.  Masses, the acceleration of gravity and the
lengths of the table are positive, and no factors.

Spong, Hutchinson, Vidyasagar, section 7.5.3 (2006), for g = Y a.

Conditions on parameters, compared with numbers: where they hold, gravity must be what is asked for.

Points are found by Newton's method, in which masses and the acceleration of gravity stay, and the
lengths of the table where they can.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import prod

from msgspec.structs import replace

from dynsolve.algebra.factors import is_positive
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.singular.zeros import never_together
from dynsolve.questions.parameters.derive import minimal_parameters
from dynsolve.robot.model import Robot


def never_zero(robot: Robot) -> frozenset[str]:
    """The names of the masses and of the acceleration of gravity."""
    return _names(robot, [*(body.mass for body in robot.bodies), *robot.gravity.entries])


def table_lengths(robot: Robot) -> frozenset[str]:
    """The names of the lengths in the table."""
    return _names(robot, [length for joint in robot.joints for length in (joint.d, joint.a)])


def _names(robot: Robot, exprs: Iterable[Expr]) -> frozenset[str]:
    generators = robot.ring.generators
    used = {i for e in exprs if e.poly for i, degree in enumerate(e.poly.degrees()) if degree > 0}
    return frozenset(generators[i].name for i in used if generators[i].kind == "symbol")


def balance(robot: Robot, gravity: Matrix) -> tuple[Expr, ...] | Skipped:
    """Expressions of parameters, all of which are 0 where g(q) is, for every q, the one that is asked for."""
    wanted = robot.questions.model.balanced
    forces = gravity if wanted is None else gravity - wanted
    held = _names(robot, robot.gravity.entries)
    model = replace(robot.questions.model, known=held)
    found = minimal_parameters(replace(robot, questions=replace(robot.questions, model=model)), forces)
    if isinstance(found, Skipped):
        return found
    masses = never_zero(robot)
    zeros = dict.fromkeys(_without_factors(entry, masses, table_lengths(robot)) for entry in found.entries)
    return tuple(
        zero
        for zero in zeros
        if zero.is_number or not any(zero.quotient(other) for other in zeros if other not in (zero, -zero))
    )


def _without_factors(expr: Expr, masses: frozenset[str], lengths: frozenset[str]) -> Expr:
    """What is 0 where an expression is, all of these being positive; where nothing else is left, these."""
    parts = (_open_part(expr, positive) for positive in (masses | lengths, masses))
    return next((part for part in parts if not part.is_number), expr)


def is_impossible(robot: Robot, condition: Expr) -> bool:
    """Whether a condition asks for a length of the table to be 0, or for what is positive with these."""
    return _open_part(condition, never_zero(robot) | table_lengths(robot)).is_number


def negative_in(robot: Robot, condition: Expr) -> tuple[str, Expr, Expr] | None:
    """A name with factor and rest of a condition that it solves: it is negative, as these have one sign.

    None where the condition may hold for positive parameters, or has several other names than masses and
    lengths of the table.
    """
    positive = never_zero(robot) | table_lengths(robot)
    names = [name for name in sorted(_names(robot, [condition])) if name not in positive]
    if len(names) != 1:
        return None
    factor = robot.ring.coefficient(condition, names[0])
    rest = condition - factor * robot.ring.symbol(names[0])
    free = names[0] in _names(robot, [factor, rest])
    is_held = any(is_positive(sign * factor) and is_positive(sign * rest) for sign in (1, -1))
    return None if free or not is_held else (names[0], factor, rest)


def exclude_each_other(robot: Robot, found: Sequence[Expr]) -> bool:
    """Whether conditions are found to hold together for no parameters, masses and lengths not being 0."""
    names = sorted(never_zero(robot) | table_lengths(robot))
    return never_together(found, prod(map(robot.ring.symbol, names), start=robot.ring.one))


def _open_part(expr: Expr, positive: frozenset[str]) -> Expr:
    """The expression without the factors in which only what is `positive` stands, with positive numbers."""
    ring = expr.ring
    names = {g.index: g.name for g in ring.generators}
    content, factors = expr.poly.factor()
    rest = ring.constant(fraction(content))
    for factor, times in factors:
        own = Expr(ring, factor)
        used = {names[i] for i, degree in enumerate(factor.degrees()) if degree > 0}
        if not (used <= positive and is_positive(own)):
            rest = rest * own ** int(times)
    return rest


# Conditions on parameters, compared with numbers

STATES = 6
