"""`weights` of a problem file: what the rates of the joints cost where a task leaves a choice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from dynsolve.problem.cells import Cell, forbid, made_cell, read_cell
from dynsolve.problem.fields import describe
from dynsolve.problem.kinematic_keys import BY_INERTIA
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.table import by_coordinate
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode

_CONSTANT = "a weight holds numbers and parameters"


@dataclass(frozen=True, slots=True)
class ParsedWeights:
    """W by rows, none where it is the inertia matrix; and where it stands."""

    rows: tuple[tuple[Cell, ...], ...]
    span: Span

    @property
    def is_inertia(self) -> bool:
        """Whether W is D(q)."""
        return not self.rows


def read_weights(
    faults: Faults, node: YamlNode | None, coordinates: Mapping[str, str], has_bodies: bool
) -> ParsedWeights | None:
    """W of a file, None where there is none; what is wrong with it is reported."""
    help = PROBLEM["weights"].help
    rows: list[list[Cell | None]] = []
    match node:
        case None | FaultyNode():
            return None
        case ScalarNode() if node.text in BY_INERTIA.choices:
            if not has_bodies:
                faults.error(node.span, "no body has mass, so there is no inertia matrix D", help)
            return ParsedWeights((), node.span)
        case MappingNode():
            rows = _diagonal(faults, node, list(coordinates))
        case ListNode():
            rows = _listed(faults, node, len(coordinates))
        case _:
            faults.error(node.span, f"weights is a mapping or a matrix, not {describe(node)}", help)
    cells = tuple(tuple(cell for cell in row if cell) for row in rows)
    for row in cells:
        forbid(faults, row, coordinates, _CONSTANT)
    is_whole = bool(cells) and all(len(row) == len(coordinates) for row in cells)
    return ParsedWeights(cells, node.span) if is_whole else None


def _diagonal(faults: Faults, node: MappingNode, names: Sequence[str]) -> list[list[Cell | None]]:
    """The weights by coordinate; those that are not given are 1."""
    given = {
        name: read_cell(faults, value, f"the weight of {name}")
        for name, value in by_coordinate(faults, node, names, PROBLEM["weights"].help)
    }
    one, zero = (made_cell("a weight", text, node.span[0]) for text in "10")
    return [[given.get(name, one) if name == other else zero for other in names] for name in names]


def _listed(faults: Faults, node: ListNode, size: int) -> list[list[Cell | None]]:
    rows = [row.items if isinstance(row, ListNode) else () for row in node.items]
    if len(rows) != size or any(len(row) != size for row in rows):
        message = f"the matrix of the weights is {size}×{size}, a row and a column for each coordinate"
        faults.error(node.span, message, PROBLEM["weights"].help)
        return []
    return [[read_cell(faults, item, f"a weight, row {i}") for item in row] for i, row in enumerate(rows, 1)]
