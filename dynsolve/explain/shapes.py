"""What uniform shapes and their dimensions are called in a sentence and in the formulas of their moments."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from dynsolve.algebra.expr import Expr
from dynsolve.notation.tree import Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.robot.model import Body, Robot
from dynsolve.robot.shapes import MASS

SHAPES = {
    "box": "rectangular solid",
    "cylinder": "solid cylinder",
    "hollow_cylinder": "hollow cylinder",
    "rod": "slender rod",
    "disk": "thin disk",
    "sphere": "solid sphere",
    "shell": "thin spherical shell",
}

DIMENSIONS = {
    "radius": "radius",
    "length": "length",
    "outer": "outer radius",
    "inner": "inner radius",
}
"""Their dimensions, by their keys in a file; those of a box are its sides along the axes."""


def shape_letters(robot: Robot) -> Mapping[str, Symbol]:
    """What each letter of the formulas of this robot's shapes is set as: another one where it is taken.

    It is taken by a name of the problem that looks like it, unless it means that in every formula.
    """
    names = {to_unicode(Symbol(name)): name for name in (*robot.parameters, *robot.ring.names)}
    found: dict[str, Symbol] = {}
    for letter, value in (pair for body in robot.bodies for pair in letters_of(body)):
        own = names.get(to_unicode(Symbol(letter)))
        if own is None or value == robot.ring.symbol(own):
            found.setdefault(letter, Symbol(letter))
        else:
            others = (Symbol(other) for other in (letter[0].upper() + letter[1:], f"{letter}s"))
            found[letter] = next(other for other in others if to_unicode(other) not in names)
    return found


def letters_of(body: Body) -> Iterator[tuple[str, Expr]]:
    """The letters of the formulas of a body's shape, and what they are here; of a point there are none."""
    if body.shape is not None and body.shape.formulas:
        yield MASS, body.mass
        yield from body.shape.letters
