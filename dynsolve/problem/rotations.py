"""Rotations in a problem file: `Rz(90deg) Rx(30deg)`, taken left to right, or a 3×3 list."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function
from dynsolve.notation.walk import names_in, walk
from dynsolve.problem.cells import Cell, denominators, read_angle, read_matrix, read_text
from dynsolve.problem.fields import describe
from dynsolve.problem.source import Faults
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, ScalarNode, Span, YamlNode
from dynsolve.robot.model import AxisTurns

_TURN = re.compile(r"R([xyz])\s*\(")
_BETWEEN = re.compile(r"\s*[*·]?\s*")
_HELP = "write a product of rotations such as Rz(90deg) Rx(30deg), or a 3×3 list"
MAX_TURNS = 12


@dataclass(frozen=True, slots=True)
class AxisRotation:
    """One factor: a rotation about `axis` (x, y or z)."""

    axis: str
    cell: Cell
    angle: Angle


@dataclass(frozen=True, slots=True)
class ParsedRotation:
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
