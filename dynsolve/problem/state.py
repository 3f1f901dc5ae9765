"""`state` of a problem file: exact values of coordinates and of their rates."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct

from dynsolve.errors import ReadError
from dynsolve.notation.text import read
from dynsolve.notation.tree import Function, Node, Symbol
from dynsolve.problem.cells import Cell, forbid, read_angle, read_cell
from dynsolve.problem.kinds import did_you_mean
from dynsolve.problem.kinematic_keys import REACHED
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, MappingNode, ScalarNode, YamlNode

_HELP = PROBLEM["state"].help


class ParsedState(Struct, frozen=True):
    """The values by (name, number of dots); `kinds` are the types of the coordinates."""

    cells: Mapping[tuple[str, int], Cell]
    kinds: Mapping[str, str]

    @property
    def values(self) -> dict[tuple[str, int], Node]:
        """The formulas."""
        return {symbol: cell.tree for symbol, cell in self.cells.items()}

    @property
    def turned(self) -> list[Node]:
        """The cosines of the angles in it, which a ring must hold."""
        return [
            Function("cos", cell.tree)
            for (name, dots), cell in self.cells.items()
            if not dots and self.kinds[name] == "revolute"
        ]


def is_reached(node: YamlNode | None) -> bool:
    """Whether the state is the configuration that reaches the target."""
    return isinstance(node, ScalarNode) and node.text in REACHED.choices


def read_state(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> ParsedState | None:
    """The state of a file, None where there is none; what is wrong with a value is reported."""
    if node is None or isinstance(node, FaultyNode) or is_reached(node):
        return None
    if not isinstance(node, MappingNode):
        faults.error(node.span, "state is a mapping from coordinates to values, or reach", _HELP)
        return None
    return _read_values(faults, node, kinds)


def read_equilibrium(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> ParsedState | None:
    """The values of `linearize`, which are of coordinates alone; None where there are none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    help = PROBLEM["linearize"].help
    if not isinstance(node, MappingNode):
        faults.error(node.span, "linearize is a mapping from coordinates to values", help)
        return None
    found = _read_values(faults, node, kinds)
    for name, dots in found.cells:
        if dots:
            faults.error(node.span, f"the rate of {name} is 0 in an equilibrium", help)
    return found


def read_steady(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> ParsedState | None:
    """The rates of `steady`, each under its coordinate's name or its own; None where there are none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    help = PROBLEM["steady"].help
    if not isinstance(node, MappingNode):
        faults.error(node.span, "steady is a mapping from coordinates to their constant rates", help)
        return None
    rates = dict.fromkeys(kinds, "prismatic")  # a rate is a number also where the coordinate is an angle
    found = _read_values(faults, node, rates)
    if any(dots > 1 for _, dots in found.cells):
        faults.error(node.span, "an acceleration is 0 where the rate is constant", help)
    cells = {(name, 1): cell for (name, _), cell in found.cells.items()}
    if len(cells) == len(kinds):
        faults.error(node.span, "no coordinate is left that could be in balance", help)
    return ParsedState(cells, kinds)


def _read_values(faults: Faults, node: MappingNode, kinds: Mapping[str, str]) -> ParsedState:
    cells: dict[tuple[str, int], Cell] = {}
    for key, value in node.entries:
        symbol = _symbol(faults, key, kinds)
        cell = read_cell(faults, value, f"the value of {key.decoded}")
        if symbol is None or cell is None:
            continue
        if symbol in cells:
            faults.error(key.span, f"{key.decoded} has a value already", "keep one of them")
        forbid(faults, [cell], kinds, "a value holds numbers and parameters")
        if not symbol[1] and kinds[symbol[0]] == "revolute" and read_angle(faults, cell) is None:
            continue
        cells[symbol] = cell
    return ParsedState(cells, kinds)


def _symbol(faults: Faults, key: ScalarNode, kinds: Mapping[str, str]) -> tuple[str, int] | None:
    """The coordinate and the number of its dots that a key names: q1, q1', q1_dot."""
    text = key.decoded.strip()
    name = text.rstrip("'")
    try:
        tree = read(name, dots=True).tree
    except ReadError:
        tree = None
    if isinstance(tree, Symbol) and tree.name in kinds and tree.dots + len(text) - len(name) <= 2:
        return tree.name, tree.dots + len(text) - len(name)
    known = [q + mark for q in kinds for mark in ("", "'")]
    faults.error(
        key.span, f"`{text[:40]}` is no coordinate and no rate of one", did_you_mean(text, known) or _HELP
    )
    return None
