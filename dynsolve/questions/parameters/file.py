"""`parameters` of a problem file: which parameters are known, and the entries of a where they are given."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from msgspec.structs import replace

from dynsolve.errors import ReadError
from dynsolve.notation.characters import normalize
from dynsolve.problem.cells import Cell, forbid, read_cell
from dynsolve.problem.kinds import (
    Fields,
    describe,
    did_you_mean,
    items,
)
from dynsolve.problem.state import Around, Given
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, MappingNode, ScalarNode, Span, YamlNode
from dynsolve.questions.parameters.keys import KEYS, KNOWN, MAX_PARAMETERS
from dynsolve.robot.model import Robot

_HELP = KEYS[0].help


class GivenParameters(Given, frozen=True):
    """The names that are known, each with its place, and those of the entries of a, the `constant` cells."""

    known: tuple[tuple[str, Span], ...] = ()
    named: tuple[str, ...] = ()


def read(faults: Faults, fields: Fields, around: Around) -> GivenParameters:
    """The key of a file; what is wrong is reported."""
    node = fields.get("parameters")
    if node is None or isinstance(node, FaultyNode):
        return GivenParameters()
    if not isinstance(node, MappingNode):
        faults.error(node.span, f"parameters is a mapping, not {describe(node)}", _HELP)
        return GivenParameters()
    known: tuple[tuple[str, Span], ...] = ()
    cells: dict[str, Cell] = {}
    for key, value in node.entries:
        if key.decoded == KNOWN:
            known = tuple(_names(faults, value))
            continue
        name, cell = _name(faults, key), read_cell(faults, value, f"the parameter {key.decoded}")
        if name in cells:
            faults.error(key.span, f"{name} is given twice", "keep one of them")
        elif name and cell:
            forbid(faults, [cell], around.coordinates, "a parameter is free of coordinates: they stand in Y")
            cells[name] = cell
    if len(cells) > MAX_PARAMETERS:
        faults.error(
            node.span, f"{len(cells)} parameters; at most {MAX_PARAMETERS} are read", "leave some out"
        )
        return GivenParameters()
    return GivenParameters(tuple(cells.values()), known=known, named=tuple(cells))


def _names(faults: Faults, node: YamlNode) -> Iterator[tuple[str, Span]]:
    for item in items(faults, node, KNOWN, _HELP):
        name = _name(faults, item)
        if name:
            yield name, item.span


def _name(faults: Faults, node: YamlNode) -> str | None:
    if not isinstance(node, ScalarNode):
        if not isinstance(node, FaultyNode):
            faults.error(node.span, "the name of a parameter is expected", _HELP)
        return None
    try:
        return normalize(node.decoded)
    except ReadError as error:
        at = node.start + error.offset
        faults.error((at, at + error.length), error.message, error.help)
        return None


def build(values: CellValues, robot: Robot, given: GivenParameters) -> Robot:
    """The robot with what is known, and with a where it is given; a name that is no parameter is reported."""
    parameters = robot.parameters
    for name, span in given.known:
        if name not in parameters:
            _unknown(values.faults, name, span, parameters)
    for cell in given.constant:
        for found in cell.names:
            if found.name not in parameters and found.name != "pi":
                _unknown(values.faults, found.name, cell.span_of(found), parameters)
    asked = replace(
        robot.questions.model,
        known=frozenset(name for name, _ in given.known),
        named=given.named,
        parameters=values.column(given.constant) if given.constant else None,
    )
    return replace(robot, questions=replace(robot.questions, model=asked))


def _unknown(faults: Faults, name: str, span: Span, parameters: Collection[str]) -> None:
    help = did_you_mean(name, parameters) or f"its parameters are {', '.join(sorted(parameters))}"
    faults.error(span, f"{name} is no parameter of this problem", help)
