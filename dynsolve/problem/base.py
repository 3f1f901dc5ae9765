"""Gravity and the base frame in a problem file.

Rotations in a problem file: `Rz(90deg) Rx(30deg)`, taken left to right, or a 3×3 list.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

from msgspec import Struct

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.rationals import rational_value
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function, names_in, walk
from dynsolve.problem.cells import (
    Cell,
    denominators,
    forbid,
    made_cell,
    read_angle,
    read_matrix,
    read_text,
    read_vector,
)
from dynsolve.problem.kinds import Fields, describe
from dynsolve.problem.specification import BASE, NO_VALUE, PROBLEM
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode
from dynsolve.robot.model import AxisTurns

if TYPE_CHECKING:
    from dynsolve.problem.table import DHTable
    from dynsolve.robot.drawing.normals import Normals

# Rotations in a problem file: `Rz(90deg) Rx(30deg)`, taken left to right, or a 3×3 list

_TURN = re.compile(r"R([xyz])\s*\(")
_BETWEEN = re.compile(r"\s*[*·]?\s*")
_HELP = "write a product of rotations such as Rz(90deg) Rx(30deg), or a 3×3 list"
MAX_TURNS = 12


class AxisRotation(Struct, frozen=True):
    """One factor: a rotation about `axis` (x, y or z)."""

    axis: str
    cell: Cell
    angle: Angle


class ParsedRotation(Struct, frozen=True):
    """A rotation as the file gives it: a product of turns, or nine entries."""

    span: Span
    written: str
    turns: tuple[AxisRotation, ...] = ()
    rows: tuple[tuple[Cell, ...], ...] = ()

    @property
    def entries(self) -> tuple[Cell, ...]:
        """The nine entries of a list."""
        return tuple(cell for row in self.rows for cell in row)

    @property
    def cells(self) -> tuple[Cell, ...]:
        """Every expression in it."""
        return tuple(turn.cell for turn in self.turns) + self.entries

    @property
    def factors(self) -> AxisTurns:
        """Its turns, each by its axis and its angle as it is written."""
        return tuple((turn.axis, turn.cell.tree) for turn in self.turns)


def read_rotation(faults: Faults, node: YamlNode | None, what: str) -> ParsedRotation | None:
    """The rotation of a node, None (reported) where it is none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    if isinstance(node, ListNode):
        rows = read_matrix(faults, node, what)
        written = faults.source.text[slice(*node.span)]
        return ParsedRotation(node.span, written, rows=rows) if rows else None
    if isinstance(node, ScalarNode) and node.text.strip():
        turns = _turns(faults, node, what)
        return ParsedRotation(node.span, node.text, turns=turns) if turns else None
    faults.error(node.span, f"{what} is a rotation, not {describe(node)}", _HELP)
    return None


def _turns(faults: Faults, node: ScalarNode, what: str) -> tuple[AxisRotation, ...] | None:
    turns: list[AxisRotation] = []
    whole = True
    for piece in _pieces(faults, node, what):
        turn = _turn(faults, node, what, *piece) if piece else None
        whole = whole and turn is not None
        if turn:
            turns.append(turn)
    return tuple(turns) if whole else None


def _pieces(faults: Faults, node: ScalarNode, what: str) -> Iterator[tuple[str, int, int] | None]:
    """(axis, start, end of the angle's text) of each factor; None, reported, ends them."""
    text, offset = node.text, 0
    for _ in range(MAX_TURNS):
        found = _TURN.match(text, offset)
        end = _closing(text, found.end()) if found else -1
        if not found or end < 0:
            at = node.start + offset
            if found:
                faults.error(
                    (at, at + found.end() - offset),
                    "this `(` is never closed",
                    "add the `)` that it belongs to",
                )
            else:
                shown = text[offset:].split()[0] if text[offset:].split() else text
                faults.error((at, at + len(shown)), f"{what}: `{shown[:40]}` is no rotation", _HELP)
            yield None
            return
        yield found.group(1), found.end(), end
        between = _BETWEEN.match(text, end + 1)
        offset = between.end() if between else end + 1
        if offset >= len(text):
            return
    faults.error(node.span, f"{what}: more than {MAX_TURNS} rotations", _HELP)
    yield None


def _closing(text: str, start: int) -> int:
    depth = 1
    for index in range(start, len(text)):
        depth += (text[index] == "(") - (text[index] == ")")
        if not depth:
            return index
    return -1


def _turn(
    faults: Faults, node: ScalarNode, what: str, axis: str, start: int, end: int
) -> AxisRotation | None:
    cell = read_text(faults, node.text[start:end], node.start + start, f"the angle of R{axis} in {what}")
    angle = read_angle(faults, cell) if cell else None
    return AxisRotation(axis, cell, angle) if cell and angle is not None else None


def check_moving(faults: Faults, parsed: ParsedRotation, what: str, coordinates: Mapping[str, str]) -> bool:
    """Whether a rotation that is a function of q is one: sines and cosines of sums of revolute coordinates.

    `coordinates` are name -> "revolute" | "prismatic".  What is wrong is reported.
    """
    before = len(faults.errors)
    for turn in parsed.turns:
        _check_linear(faults, turn.cell, turn.angle, what, coordinates)
    for cell in parsed.entries:
        for part in walk(cell.tree):
            if isinstance(part, Function) and part.name != "sqrt":
                with suppress(AlgebraError):  # the ring reports it with its remedy
                    _check_linear(faults, cell, angle_from_tree(part.argument), what, coordinates)
        inside = [
            *denominators(cell.tree),
            *(p for p in walk(cell.tree) if isinstance(p, Function) and p.name == "sqrt"),
        ]
        if any(names_in(part) & coordinates.keys() for part in inside):
            message = f"{what}: a coordinate stands in a denominator or under a root"
            faults.error(cell.span, message, "denominators are free of coordinates (tan is sin/cos)")
    return len(faults.errors) == before


def _check_linear(
    faults: Faults, cell: Cell, angle: Angle, what: str, coordinates: Mapping[str, str]
) -> None:
    for atom, _ in angle.terms:
        moving = [name for name, _ in atom if name in coordinates]
        if not moving:
            continue
        if coordinates[moving[0]] == "prismatic":
            faults.error(
                cell.span,
                f"{what}: the length {moving[0]} stands as an angle",
                "angles are revolute coordinates",
            )
        elif atom != ((moving[0], 1),):
            help = "write a sum of coordinates times rational numbers"
            faults.error(cell.span, f"{what}: an angle is not linear in the coordinate {moving[0]}", help)


_GRAVITY_HELP = PROBLEM["gravity"].help
_CONSTANT = "joint variables stand in the table alone"


class ParsedBase(Struct, frozen=True):
    """Frame 0 in the world; None for no rotation, no displacement."""

    rotation: ParsedRotation | None
    move: tuple[Cell, ...] | None

    @property
    def cells(self) -> tuple[Cell, ...]:
        """Every expression in it."""
        return (self.rotation.cells if self.rotation else ()) + (self.move or ())


class Framed(Struct, frozen=True):
    """A table, where its frame 0 is, and of a drawing what both were made from, with its cells."""

    table: DHTable
    base: ParsedBase
    normals: Normals | None = None
    drawn: tuple[Cell, ...] = ()


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
    return zero == [True, True, False] and not z.text.lstrip(" (").startswith(("-", "−"))


NO_GRAVITY = _components("0", "0", "0")


def read_base(faults: Faults, node: YamlNode | None, coordinates: tuple[str, ...]) -> ParsedBase:
    """The base frame; what is wrong with it is reported and left out."""
    if isinstance(node, MappingNode):
        fields = Fields(faults, node, BASE.names, "base")
        rotation = read_rotation(faults, fields.get("rotate"), "base")
        parsed = ParsedBase(rotation, read_vector(faults, fields.get("move"), "the position of the base"))
    else:
        parsed = ParsedBase(read_rotation(faults, node, "base"), None)
    forbid(faults, parsed.cells, coordinates, "the base does not move: " + _CONSTANT)
    return parsed
