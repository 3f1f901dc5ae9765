"""Gravity and the base frame in a problem file."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.rationals import rational_value
from dynsolve.problem.cells import Cell, forbid, made_cell, read_vector
from dynsolve.problem.fields import Fields, describe
from dynsolve.problem.rotations import ParsedRotation, read_rotation
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import BASE, NO_VALUE, PROBLEM
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, MappingNode, ScalarNode, YamlNode

_GRAVITY_HELP = PROBLEM["gravity"].help
_CONSTANT = "joint variables stand in the table alone"


@dataclass(frozen=True, slots=True)
class ParsedBase:
    """Frame 0 in the world; None for no rotation, no displacement."""

    rotation: ParsedRotation | None
    move: tuple[Cell, ...] | None

    @property
    def cells(self) -> tuple[Cell, ...]:
        """Every expression in it."""
        return (self.rotation.cells if self.rotation else ()) + (self.move or ())


NO_BASE = ParsedBase(None, None)
"""Frame 0 is the world."""


def read_gravity(faults: Faults, fields: Fields, coordinates: tuple[str, ...]) -> tuple[Cell, ...] | None:
    """The three components of gravity; None where they were reported."""
    node = fields.get("gravity")
    if "gravity" not in fields or isinstance(node, FaultyNode):
        if "g" in coordinates:
            message = "g is a coordinate here, but gravity is [0, 0, -g] by default"
            faults.error(
                fields.key_span("dh"), message, "give one of them another letter, or write gravity: none"
            )
        return _components("0", "0", "-g")
    if isinstance(node, ScalarNode) and node.text in NO_VALUE.choices:
        return NO_GRAVITY
    if not isinstance(node, ListNode):
        span = fields.span_of("gravity")
        faults.error(span, f"gravity is a vector, not {describe(node) if node else 'nothing'}", _GRAVITY_HELP)
        return None
    cells = read_vector(faults, node, "gravity")
    forbid(faults, cells or (), coordinates, _CONSTANT)
    if cells and _points_up(cells):
        message = "gravity points upwards here"
        help = (
            "the acceleration of gravity points downwards: [0, 0, -g]; "
            "texts that write P = m gᵀ r mean the opposite vector"
        )
        faults.warn(node.span, message, help, "gravity-upward")
    return cells


def _components(*texts: str) -> tuple[Cell, ...]:
    return tuple(made_cell("gravity", text) for text in texts)


def _points_up(cells: tuple[Cell, ...]) -> bool:
    """Whether it is [0, 0, g] or [0, 0, 9.81]: upwards along z for every reader."""
    x, y, z = cells
    zero = [rational_value(component.tree) == 0 for component in (x, y, z)]
    return zero == [True, True, False] and not _begins_with_minus(z)


def _begins_with_minus(cell: Cell) -> bool:
    return cell.text.lstrip(" (").startswith(("-", "−"))


NO_GRAVITY = _components("0", "0", "0")


def read_base(faults: Faults, node: YamlNode | None, coordinates: tuple[str, ...]) -> ParsedBase:
    """The base frame; what is wrong with it is reported and left out."""
    parsed = _read_base(faults, node)
    forbid(faults, parsed.cells, coordinates, "the base does not move: " + _CONSTANT)
    return parsed


def _read_base(faults: Faults, node: YamlNode | None) -> ParsedBase:
    if isinstance(node, MappingNode):
        fields = Fields(faults, node, BASE.names, "base")
        rotation = read_rotation(faults, fields.get("rotate"), "base")
        move = read_vector(faults, fields.get("move"), "the position of the base")
        return ParsedBase(rotation, move)
    return ParsedBase(read_rotation(faults, node, "base"), None)
