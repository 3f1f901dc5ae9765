"""`reach` and `limits` of a problem file: what r(q) is to be, and the ranges of the joints."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from dynsolve.notation.tree import Symbol
from dynsolve.problem.cells import Cell, forbid, read_angle, read_cell
from dynsolve.problem.fields import describe, items
from dynsolve.problem.kinematic_keys import MAX_TASK
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.table import by_coordinate
from dynsolve.problem.yaml_nodes import (
    FaultyNode,
    ListNode,
    MappingNode,
    ScalarNode,
    Span,
    YamlNode,
    too_many,
)


@dataclass(frozen=True, slots=True)
class ParsedReach:
    """The values of r(q), names or expressions, and where they stand."""

    cells: tuple[Cell, ...] = ()
    span: Span = (0, 0)

    def names(self, parameters: Collection[str]) -> tuple[str, ...]:
        """The names that are new here, one for each value that is nothing but such a name."""
        found = (cell.tree.name for cell in self.cells if isinstance(cell.tree, Symbol))
        return tuple(name for name in found if name != "pi" and name not in parameters)


NO_REACH = ParsedReach()
"""What a file without the key has."""


def read_reach(faults: Faults, node: YamlNode | None, coordinates: Collection[str]) -> ParsedReach:
    """The values under `reach`; what is wrong with one is reported."""
    help = PROBLEM["reach"].help
    listed = list(_rejoined(faults, items(faults, node, "reach", help)))
    if node is None or isinstance(node, FaultyNode):
        return NO_REACH
    if len(listed) > MAX_TASK:
        faults.error(node.span, f"{len(listed)} values; at most {MAX_TASK} are read", "leave some out")
        return NO_REACH
    cells = tuple(
        read_cell(faults, item, f"value {i} of reach", arcs=True) for i, item in enumerate(listed, 1)
    )
    known = tuple(cell for cell in cells if cell)
    names: set[str] = set()
    for cell in known:
        if not isinstance(cell.tree, Symbol):
            forbid(faults, [cell], coordinates, "a value holds numbers and parameters")
        elif cell.tree.name in coordinates or cell.tree.name in names:
            message = f"{cell.tree.name} means something else already"
            faults.error(cell.span, message, "give the value another name")
        else:
            names.add(cell.tree.name)
    return ParsedReach(known, node.span) if len(known) == len(cells) else NO_REACH


def _rejoined(faults: Faults, listed: Sequence[YamlNode]) -> Iterator[YamlNode]:
    """The items, those that a comma inside parentheses has cut made one again: atan2(4, 3)."""
    waiting = list(listed)
    while waiting:
        node = waiting.pop(0)
        while isinstance(node, ScalarNode) and waiting and node.text.count("(") > node.text.count(")"):
            end = waiting.pop(0).span[1]
            node = replace(node, text=faults.source.text[node.start : end])
        yield node


def check_reach(faults: Faults, reach: ParsedReach, rows: int) -> None:
    """There is a value for each component of the task."""
    if reach.cells and len(reach.cells) != rows:
        faults.error(
            reach.span,
            f"reach has {len(reach.cells)} value{'s' * (len(reach.cells) > 1)}; the task has {rows}",
            "give one value for each component of the task, in their order",
        )


# -- joint ranges ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class ParsedLimits:
    """The range of one coordinate, and where it stands."""

    coordinate: str
    low: Cell
    high: Cell
    span: Span


def read_limits(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> tuple[ParsedLimits, ...]:
    """The ranges under `limits`; what is wrong with one is reported."""
    if node is None or isinstance(node, FaultyNode):
        return ()
    if not isinstance(node, MappingNode):
        faults.error(node.span, "limits is a mapping from coordinates to ranges", PROBLEM["limits"].help)
        return ()
    return tuple(_ranges(faults, node, kinds))


def _ranges(faults: Faults, node: MappingNode, kinds: Mapping[str, str]) -> Iterator[ParsedLimits]:
    help = PROBLEM["limits"].help
    for name, value in by_coordinate(faults, node, kinds, help):
        if not isinstance(value, ListNode) or len(value.items) != 2:
            if not isinstance(value, FaultyNode):
                message = f"the range of {name} is a list [low, high], not {describe(value)}"
                if isinstance(value, ListNode):
                    message = f"the range of {name} has {len(value.items)} ends, not 2"
                remedy = too_many(value, help) if isinstance(value, ListNode) else help
                faults.error(value.span, message, remedy)
        else:
            low, high = (_end(faults, item, name, kinds) for item in value.items)
            if low and high:
                yield ParsedLimits(name, low, high, value.span)


def _end(faults: Faults, node: YamlNode, name: str, kinds: Mapping[str, str]) -> Cell | None:
    cell = read_cell(faults, node, f"the range of {name}")
    forbid(faults, [cell], kinds, "a range holds numbers and parameters")
    if cell and kinds[name] == "revolute" and read_angle(faults, cell) is None:
        return None
    return cell
