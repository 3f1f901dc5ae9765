"""What else counts as an answer DH: `also` and `strict` in a problem file."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.notation.tree import Node
from dynsolve.problem.fields import Fields, describe, items, word
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import MAX_ROWS, PROBLEM, STRICT
from dynsolve.problem.table import COLUMNS, read_listed_row
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, YamlNode

Table = tuple[tuple[Node, ...], ...]
"""Rows of θ, d, a, α as they are written."""

_MOST_TABLES = 20
_HELP = PROBLEM["also"].help


@dataclass(frozen=True, slots=True)
class AcceptedTables:
    """Further tables that count as they stand, and whether coordinates must be counted as the key does."""

    also: tuple[Table, ...] = ()
    strict: bool = False


def read_accepted_tables(faults: Faults, fields: Fields) -> AcceptedTables:
    """What `also` and `strict` say; everything wrong with them is reported."""
    strict = word(faults, fields.get("strict"), STRICT.choices, "strict", PROBLEM["strict"].help)
    nodes = items(faults, fields.get("also"), "also", _HELP)
    if len(nodes) > _MOST_TABLES:
        faults.error(fields.key_span("also"), f"{len(nodes)} tables; at most {_MOST_TABLES} are read", _HELP)
    tables = [_read_table(faults, node, i) for i, node in enumerate(nodes[:_MOST_TABLES], 1)]
    return AcceptedTables(tuple(table for table in tables if table), strict == "true")


def _read_table(faults: Faults, node: YamlNode, number: int) -> Table | None:
    rows = items(faults, node, f"table {number} of also", _HELP)
    if len(rows) > MAX_ROWS:
        faults.error(node.span, f"{len(rows)} rows; at most {MAX_ROWS} are read", _HELP)
    read = [_read_row(faults, row, i) for i, row in enumerate(rows[:MAX_ROWS], 1)]
    return tuple(row for row in read if row) if read and None not in read else None


def _read_row(faults: Faults, node: YamlNode, index: int) -> tuple[Node, ...] | None:
    if isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ListNode):
        message = f"row {index} of this table is [θ, d, a, α], not {describe(node)}"
        faults.error(node.span, message, _HELP)
        return None
    cells = read_listed_row(faults, node, index)
    return tuple(cell.tree for cell in cells.values()) if len(cells) == len(COLUMNS) else None
