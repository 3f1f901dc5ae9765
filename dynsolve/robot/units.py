"""Dimensions and units: which quantities may be added, the names of dimensions, the SI size of a unit.

A dimension is three exponents, of mass, length and time.  A result is in SI units; a
value given in others (`units: {L1: mm}`) is turned into them exactly.  To add a unit, add
its line to `KNOWN`; to name a dimension, add it to `_SYMBOLS` (in SI) or to `_WORDS`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction

from msgspec import Struct

from dynsolve.notation.tree import Letter, Node, Number, Row, Words

Dimension = tuple[Fraction, Fraction, Fraction]
"""Exponents of mass, length and time."""


def dimension(mass: int = 0, length: int = 0, time: int = 0) -> Dimension:
    """M^mass L^length T^time"""
    return Fraction(mass), Fraction(length), Fraction(time)


NONE = dimension()
MASS = dimension(mass=1)
LENGTH = dimension(length=1)
INERTIA = dimension(mass=1, length=2)
PER_SECOND = dimension(time=-1)
VELOCITY = dimension(length=1, time=-1)
ACCELERATION = dimension(length=1, time=-2)
MOMENTUM = dimension(mass=1, length=2, time=-1)
ENERGY = dimension(mass=1, length=2, time=-2)
FORCE = dimension(mass=1, length=1, time=-2)


def times(a: Dimension, b: Dimension, power: int | Fraction = 1) -> Dimension:
    """a · b^power"""
    power = power if isinstance(power, Fraction) else int(power)
    return a[0] + b[0] * power, a[1] + b[1] * power, a[2] + b[2] * power


def along(x: Dimension | None, turning: str, sliding: str) -> str:
    """The unit of what acts along x: along an angle or along a length.

    >>> along(LENGTH, "N m/rad", "N/m")
    'N/m'
    """
    return sliding if x == LENGTH else turning


class Unit(Struct, frozen=True):
    """`size` in SI units of this dimension; `degrees` marks an angle counted in degrees."""

    size: Fraction
    dimension: Dimension
    degrees: bool = False


def _unit(size: str, mass: int = 0, length: int = 0, time: int = 0) -> Unit:
    return Unit(Fraction(size), dimension(mass, length, time))


KNOWN: Mapping[str, Unit] = {
    "1": _unit("1"),
    "rad": _unit("1"),
    "m": _unit("1", length=1),
    "dm": _unit("1/10", length=1),
    "cm": _unit("1/100", length=1),
    "mm": _unit("1/1000", length=1),
    "um": _unit("1/1000000", length=1),
    "km": _unit("1000", length=1),
    "in": _unit("0.0254", length=1),
    "ft": _unit("0.3048", length=1),
    "kg": _unit("1", mass=1),
    "g": _unit("1/1000", mass=1),
    "mg": _unit("1/1000000", mass=1),
    "t": _unit("1000", mass=1),
    "lb": _unit("0.45359237", mass=1),
    "s": _unit("1", time=1),
    "ms": _unit("1/1000", time=1),
    "min": _unit("60", time=1),
    "N": _unit("1", 1, 1, -2),
    "mN": _unit("1/1000", 1, 1, -2),
    "kN": _unit("1000", 1, 1, -2),
    "Nm": _unit("1", 1, 2, -2),
    "J": _unit("1", 1, 2, -2),
    "W": _unit("1", 1, 2, -3),
    "deg": Unit(Fraction(1), NONE, degrees=True),
    "°": Unit(Fraction(1), NONE, degrees=True),
}

_RAISED = str.maketrans("⁻¹²³", "-123")
_PIECE = re.compile(r"(?P<unit>[A-Za-zµμ°]+|1)(?:\^?\(?(?P<power>-?[0-9])\)?)?")


def parse(text: str) -> Unit | None:
    """The unit of a text, None for one that is not known.

    >>> parse("g mm²").size, parse("m/s^2").dimension == parse("m s^-2").dimension
    (Fraction(1, 1000000000), True)
    """
    size, dim, sign = Fraction(1), NONE, 1
    compact = text.strip().replace("**", "^").replace("µ", "u").replace("μ", "u").translate(_RAISED)
    if compact in ("deg", "°"):
        return KNOWN["deg"]
    for piece in re.split(r"([ *·/]+)", compact):
        if not piece.strip(" *·"):
            continue
        if piece.strip(" *·") == "/":
            sign = -1
            continue
        found = _PIECE.fullmatch(piece)
        unit = KNOWN.get(found["unit"]) if found else None
        if found is None or unit is None or unit.degrees:
            return None
        power = sign * int(found["power"] or 1)
        size, dim, sign = size * unit.size**power, times(dim, unit.dimension, power), 1
    return Unit(size, dim)


_SYMBOLS: Mapping[Dimension, str] = {
    NONE: "",
    dimension(mass=1): "kg",
    dimension(length=1): "m",
    dimension(mass=1, length=2): "kg m^2",
    dimension(mass=1, length=2, time=-2): "J",
    dimension(mass=1, length=1, time=-2): "N",
}


def si(dim: Dimension) -> str:
    """The SI unit of a dimension, as text.

    >>> si(dimension(length=1, time=-2)), si(dimension(mass=1, length=2))
    ('m/s^2', 'kg m^2')
    """
    if dim in _SYMBOLS:
        return _SYMBOLS[dim]
    units = list(zip(("kg", "m", "s"), dim, strict=True))
    above = " ".join(_raised(name, power) for name, power in units if power > 0)
    below = [_raised(name, -power) for name, power in units if power < 0]
    return "/".join([above or "1", *below])


def of_parameter(dim: Dimension) -> str:
    """The SI unit of a parameter: of a torque, a stiffness or a damping by that of a force.

    >>> of_parameter(dimension(mass=1, time=-2)), of_parameter(ENERGY)
    ('N/m', 'N m')
    """
    if dim == ENERGY:
        return "N m"
    mass, length, time = dim
    if mass == 1 and length <= 0 and time in (-1, -2):
        return f"N{' s' * (time == -1)}/{_raised('m', 1 - length)}"
    return si(dim)


def _raised(name: str, power: Fraction) -> str:
    return name if power == 1 else f"{name}^{power}"


_WORDS = {
    NONE: "a pure number",
    MASS: "a mass",
    LENGTH: "a length",
    INERTIA: "a moment of inertia",
    ACCELERATION: "an acceleration",
    ENERGY: "an energy (or a torque)",
    dimension(mass=1, length=1, time=-2): "a force",
    dimension(mass=1, length=2, time=-1): "an angular momentum",
    dimension(mass=1, length=1, time=-1): "a momentum",
    dimension(length=1, time=-1): "a velocity",
    dimension(time=-1): "an angular velocity",
    dimension(time=-2): "an angular acceleration",
    dimension(length=2): "an area",
    dimension(mass=1, length=1): "a mass times a length",
}


def describe(dim: Dimension) -> str:
    """A dimension in words, or in SI units where it has no name.

    >>> describe(ENERGY), describe(dimension(mass=1, length=2, time=-3))
    ('an energy (or a torque)', 'kg m² s⁻³')
    """
    if dim in _WORDS:
        return _WORDS[dim]
    from dynsolve.notation.unicode import raised

    units = [(u, e) for u, e in zip(("kg", "m", "s"), dim, strict=True) if e]
    return " ".join(u if e == 1 else u + raised(str(e)) for u, e in units)


_SQUARE = re.compile(r"([A-Za-z]+)(?:\^|\*\*)?([2-9²³])")


def node(unit: str) -> Node:
    """A unit as a formula, upright and with its powers raised."""
    parts: list[Node] = []
    words, end = "", 0
    for found in _SQUARE.finditer(unit):
        words += unit[end : found.start()]
        parts += [Words(words)] if words else []
        parts.append(Letter(found[1], None, Number(int(found[2].translate(_RAISED))), "upright"))
        words, end = "", found.end()
    words += unit[end:]
    parts += [Words(words)] if words else []
    return parts[0] if len(parts) == 1 else Row(tuple(parts))
