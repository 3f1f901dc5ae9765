"""`state` of a problem file: exact values of coordinates and of their rates."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from msgspec import Struct

from dynsolve.errors import ReadError
from dynsolve.notation.text import read
from dynsolve.notation.tree import Function, Node, Symbol
from dynsolve.problem.base import ParsedRotation
from dynsolve.problem.bodies import DrawnFrames
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


class Around(Struct, frozen=True):
    """What is known of a file when the keys of a question are read.

    The types of its `coordinates`, how many `rows` its table has, the names of its `points`, whether
    something has mass, and the frames of a drawing.
    """

    coordinates: Mapping[str, str]
    rows: int
    points: Collection[str]
    has_bodies: bool
    drawn: DrawnFrames


class Given(Struct, frozen=True):
    """What a file gives for a question: its values, those that are `constant` and those that may be `moving`.

    `targeted` are those that are numbers alone.  `states` are values of coordinates, of which the ring must
    hold the sines and cosines, as those of the `rotations`.
    """

    constant: tuple[Cell, ...] = ()
    moving: tuple[Cell, ...] = ()
    targeted: tuple[Cell, ...] = ()
    states: tuple[ParsedState, ...] = ()
    rotations: tuple[ParsedRotation, ...] = ()


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
    return read_values(faults, node, kinds)


def read_values(faults: Faults, node: MappingNode, kinds: Mapping[str, str]) -> ParsedState:
    """The values by coordinate, or rate of one; what is wrong with one is reported."""
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
