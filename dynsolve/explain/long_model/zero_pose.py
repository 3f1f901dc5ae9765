"""A check of the last frame: where the end of the arm is with all joint angles 0, and in numbers."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import prod

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.rationals import fraction
from dynsolve.derivation.kinematics import origin
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.pose import at, turning_in
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import Negative, Node, Number, equation
from dynsolve.quantities import letters


def at_zero_angles(context: Context) -> Prose:
    """To check: with all joint angles 0 the entries of o_6 are a₂ + a₃ = 0.4521, -d₃ = -0.15005 and so on.

    Nothing where an angle has no sine and cosine of its own.
    """
    ring, last = context.robot.ring, len(context.robot.joints)
    end = origin(context.values[f"H{last}"])
    turning = turning_in(context.robot, *end.entries)
    if not turning:
        return ()
    place = [at(ring, entry, dict.fromkeys(turning, 0)) for entry in end.entries]
    lengths = {name: value for name, text in context.lengths.items() if (value := _decimal(text)) is not None}
    known = all(_symbols(entry) <= lengths.keys() for entry in place)
    entries = [
        equation(*dict.fromkeys((context.show(entry), _shown(_value(entry, lengths)))))
        if known
        else context.show(entry)
        for entry in place
    ]
    unit = " (in m)." if known else "."
    return (
        "To check: with all joint angles 0 the entries of ",
        letters.o(last),
        " are ",
        *listed(entries),
        unit,
    )


def _decimal(text: str) -> Fraction | None:
    try:
        return Fraction(text)
    except ValueError:  # an angle in degrees, or a formula
        return None


def _symbols(expr: Expr) -> set[str]:
    """The names in a value without sines and cosines."""
    generators = expr.ring.generators
    return {generators[i].name for i, degree in enumerate(expr.poly.degrees()) if degree > 0}


def _value(expr: Expr, values: Mapping[str, Fraction]) -> Fraction:
    """The number that a value is."""
    names = [generator.name for generator in expr.ring.generators]
    total = Fraction(0)
    for powers, factor in expr.poly.to_dict().items():
        used = zip(names, map(int, powers), strict=True)
        total += fraction(factor) * prod(values[name] ** power for name, power in used if power)
    return total


def _shown(value: Fraction) -> Node:
    """A number with a decimal point."""
    size = Number(abs(value.numerator), value.denominator, decimal=value.denominator > 1)
    return Negative(size) if value < 0 else size
