"""Drawings beside a step, as data: lines, angles and points in a plane with their names; the arm in a pose.

Coordinates are about 1 and y grows upwards; nothing is to scale.  `dynsolve.draw.figure` draws the
lines, `dynsolve.draw.figure` the arm.
"""

from __future__ import annotations

from enum import Enum

from msgspec import Struct

from dynsolve.notation.tree import Node

Place = tuple[float, float]


class LineKind(Enum):
    """What a line is: an axis with its head, a length of the arm, or one that only helps the eye."""

    AXIS = "axis"
    LENGTH = "length"
    HELP = "help"


class FigureLine(Struct, frozen=True):
    """A straight line; its name stands in the middle, that of an axis at its end."""

    start: Place
    end: Place
    kind: LineKind
    name: Node | None = None


class FigureAngle(Struct, frozen=True):
    """The angle at a place from one direction to another, both in radians from x to y."""

    at: Place
    start: float
    end: float
    name: Node


class Figure(Struct, frozen=True):
    """A drawing, what it shows in words, and the places that are marked by a point."""

    caption: str
    lines: tuple[FigureLine, ...]
    angles: tuple[FigureAngle, ...] = ()
    points: tuple[Place, ...] = ()


class ArmArrow(Struct, frozen=True):
    """An arrow at the tip of the arm; `direction` are its three components in the world."""

    name: Node
    direction: tuple[Node, Node, Node]


class ArmFigure(Struct, frozen=True):
    """The arm where all `zeros` are 0, formulas in the coordinates and parameters, with arrows at its tip."""

    caption: str
    zeros: tuple[Node, ...]
    arrows: tuple[ArmArrow, ...] = ()
