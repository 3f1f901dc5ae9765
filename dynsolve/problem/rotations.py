"""Rotations in a problem file: `Rz(90deg) Rx(30deg)`, taken left to right, or a 3×3 list."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function
from dynsolve.notation.walk import names_in, walk
from dynsolve.problem.cells import Cell, denominators, read_angle, read_matrix, read_text
from dynsolve.problem.fields import describe
from dynsolve.problem.source import Faults
from dynsolve.problem.yaml_nodes import Faulty, Scalar, Sequence, Span, YamlNode

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
class RotationSheet:
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


def read_rotation(report: Faults, node: YamlNode | None, what: str) -> RotationSheet | None:
    """The rotation of a node, None (reported) where it is none."""
    if node is None or isinstance(node, Faulty):
        return None
    if isinstance(node, Sequence):
        rows = read_matrix(report, node, what)
        written = report.source.text[slice(*node.span)]
        return RotationSheet(node.span, written, rows=rows) if rows else None
    if isinstance(node, Scalar) and node.text.strip():
        turns = _turns(report, node, what)
        return RotationSheet(node.span, node.text, turns=turns) if turns else None
    report.error(node.span, f"{what} is a rotation, not {describe(node)}", _HELP)
    return None


def _turns(report: Faults, node: Scalar, what: str) -> tuple[AxisRotation, ...] | None:
    turns: list[AxisRotation] = []
    whole = True
    for piece in _pieces(report, node, what):
        turn = _turn(report, node, what, *piece) if piece else None
        whole = whole and turn is not None
        if turn:
            turns.append(turn)
    return tuple(turns) if whole else None


def _pieces(report: Faults, node: Scalar, what: str) -> Iterator[tuple[str, int, int] | None]:
    """(axis, start, end of the angle's text) of each factor; None, reported, ends them."""
    text, offset = node.text, 0
    for _ in range(MAX_TURNS):
        found = _TURN.match(text, offset)
        end = _closing(text, found.end()) if found else -1
        if not found or end < 0:
            at = node.start + offset
            if found:
                report.error(
                    (at, at + found.end() - offset),
                    "this `(` is never closed",
                    "add the `)` that it belongs to",
                )
            else:
                shown = text[offset:].split()[0] if text[offset:].split() else text
                report.error((at, at + len(shown)), f"{what}: `{shown[:40]}` is no rotation", _HELP)
            yield None
            return
        yield found.group(1), found.end(), end
        between = _BETWEEN.match(text, end + 1)
        offset = between.end() if between else end + 1
        if offset >= len(text):
            return
    report.error(node.span, f"{what}: more than {MAX_TURNS} rotations", _HELP)
    yield None


def _closing(text: str, start: int) -> int:
    depth = 1
    for index in range(start, len(text)):
        depth += (text[index] == "(") - (text[index] == ")")
        if not depth:
            return index
    return -1


def _turn(report: Faults, node: Scalar, what: str, axis: str, start: int, end: int) -> AxisRotation | None:
    cell = read_text(report, node.text[start:end], node.start + start, f"the angle of R{axis} in {what}")
    angle = read_angle(report, cell) if cell else None
    return AxisRotation(axis, cell, angle) if cell and angle is not None else None


def check_moving(report: Faults, sheet: RotationSheet, what: str, coordinates: Mapping[str, str]) -> bool:
    """Whether a rotation that is a function of q is one: sines and cosines of sums of revolute coordinates.

    `coordinates` are name -> "revolute" | "prismatic".  What is wrong is reported.
    """
    before = len(report.errors)
    for turn in sheet.turns:
        _check_linear(report, turn.cell, turn.angle, what, coordinates)
    for cell in sheet.entries:
        for part in walk(cell.tree):
            if isinstance(part, Function) and part.name != "sqrt":
                with suppress(AlgebraError):  # the ring reports it with its remedy
                    _check_linear(report, cell, angle_from_tree(part.argument), what, coordinates)
        inside = [
            *denominators(cell.tree),
            *(p for p in walk(cell.tree) if isinstance(p, Function) and p.name == "sqrt"),
        ]
        if any(names_in(part) & coordinates.keys() for part in inside):
            message = f"{what}: a coordinate stands in a denominator or under a root"
            report.error(cell.span, message, "denominators are free of coordinates (tan is sin/cos)")
    return len(report.errors) == before


def _check_linear(
    report: Faults, cell: Cell, angle: Angle, what: str, coordinates: Mapping[str, str]
) -> None:
    for atom, _ in angle.terms:
        moving = [name for name, _ in atom if name in coordinates]
        if not moving:
            continue
        if coordinates[moving[0]] == "prismatic":
            report.error(
                cell.span,
                f"{what}: the length {moving[0]} stands as an angle",
                "angles are revolute coordinates",
            )
        elif atom != ((moving[0], 1),):
            help = "write a sum of coordinates times rational numbers"
            report.error(cell.span, f"{what}: an angle is not linear in the coordinate {moving[0]}", help)


def elementary(ring: Ring, axis: str, angle: Angle) -> Matrix:
    """The rotation about one axis, 3×3.

    R_z = [[c, -s, 0], [s, c, 0], [0, 0, 1]], and the same in cyclic order for x and y.
    """
    c, s, zero, one = ring.cos(angle), ring.sin(angle), ring.zero, ring.one
    if axis == "x":
        return Matrix.of(ring, [[one, zero, zero], [zero, c, -s], [zero, s, c]])
    if axis == "y":
        return Matrix.of(ring, [[c, zero, s], [zero, one, zero], [-s, zero, c]])
    return Matrix.of(ring, [[c, -s, zero], [s, c, zero], [zero, zero, one]])


def is_rotation(matrix: Matrix) -> tuple[bool, bool]:
    """(R Rᵀ = 1, det R = +1), decided exactly."""
    ring = matrix.ring
    orthogonal = (matrix @ matrix.T - Matrix.identity(ring, 3)).is_zero
    (a, b, c), (d, e, f), (g, h, i) = matrix.rows
    determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return orthogonal, determinant == ring.one
