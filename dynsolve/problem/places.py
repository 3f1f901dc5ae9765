"""A point of a link in a problem file: the mass centre of a body, a named point, where a force acts."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.problem.cells import Cell, read_cell, read_vector
from dynsolve.problem.fields import Fields, whole_number, word
from dynsolve.problem.source import Faults
from dynsolve.problem.value_kinds import CENTERS, MEASURED
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, MappingNode, Span, YamlNode


@dataclass(frozen=True, slots=True)
class ParsedPlace:
    """A point of a link: `kind` is tip, origin, midpoint, along (one cell), near, drawn or at (three)."""

    kind: str
    span: Span
    cells: tuple[Cell, ...] = ()


def read_link(faults: Faults, node: YamlNode | None, rows: int, ground: str) -> int | None:
    """The row of the table that something moves with; `ground` says what there is none of on row 0."""
    help = f"links are counted by the rows of the table, from 1 to {rows}" if rows else "write link: 1"
    link = whole_number(faults, node, "link", help)
    if node is None or link is None:
        return None
    if link == 0:
        faults.error(node.span, f"link 0 is the ground, {ground}", help)
        return None
    if rows and link > rows:
        faults.error(node.span, f"there is no link {link}: the table has {rows} row{'s' * (rows > 1)}", help)
        return None
    return link


def read_place(faults: Faults, node: YamlNode | None, what: str, help: str) -> ParsedPlace | None:
    """The point that a value says, None (reported) where it is none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    if isinstance(node, ListNode):
        cells = read_vector(faults, node, what)
        return ParsedPlace("at", node.span, cells) if cells else None
    if isinstance(node, MappingNode):
        return _read_measured(faults, node, what, help)
    kind = word(faults, node, CENTERS.choices, what, help)
    return ParsedPlace(kind, node.span) if kind else None


def _read_measured(faults: Faults, node: MappingNode, what: str, help: str) -> ParsedPlace | None:
    fields = Fields(faults, node, MEASURED.names, what)
    given = tuple(fields)
    if len(given) > 1 or not node.entries:
        faults.error(node.span, f"{what} takes one of along, near and drawn", help)
    if len(given) != 1:
        return None
    if "along" in fields:
        cell = read_cell(faults, fields.get("along"), f"along in {what}")
        return ParsedPlace("along", node.span, (cell,)) if cell else None
    (kind,) = given
    cells = read_vector(faults, fields.get(kind), f"{kind} in {what}")
    return ParsedPlace(kind, node.span, cells) if cells else None
