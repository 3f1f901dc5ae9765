"""What a problem file asks of the equations of motion: which parameters are known, the entries of a."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace

from dynsolve.errors import ReadError
from dynsolve.notation.names import normalize
from dynsolve.problem.cells import Cell, forbid, read_cell, read_expressions
from dynsolve.problem.fields import Fields, describe, did_you_mean, items, mapping, word
from dynsolve.problem.model_keys import BALANCE, INPUTS, KNOWN, MAX_PARAMETERS
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.state import ParsedState, read_equilibrium, read_steady
from dynsolve.problem.yaml_nodes import FaultyNode, MappingNode, ScalarNode, Span, YamlNode

_HELP = PROBLEM["parameters"].help


@dataclass(frozen=True, slots=True)
class ParsedModelQuestions:
    """The names that are known, each with its place, and the entries of a by their names."""

    known: tuple[tuple[str, Span], ...] = ()
    parameters: tuple[tuple[str, Cell], ...] = ()
    linearize: ParsedState | None = None
    steady: ParsedState | None = None
    inputs_given: bool = False
    balanced: tuple[Cell, ...] = ()

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        yield from (cell for _, cell in self.parameters)
        for state in (self.linearize, self.steady):
            yield from state.cells.values() if state else ()


NO_MODEL_QUESTIONS = ParsedModelQuestions()
"""What a file asks that asks nothing of its model."""


def read_model_questions(
    faults: Faults, fields: Fields, coordinates: Mapping[str, str]
) -> ParsedModelQuestions:
    """The keys of a file that ask something of the equations of motion; what is wrong is reported."""
    parameters = _read_parameters(faults, fields.get("parameters"), coordinates)
    given = word(faults, fields.get("inputs"), INPUTS.choices, "inputs", PROBLEM["inputs"].help)
    equilibrium = read_equilibrium(faults, fields.get("linearize"), coordinates)
    return replace(
        parameters,
        linearize=equilibrium,
        steady=read_steady(faults, fields.get("steady"), coordinates),
        inputs_given=given is not None,
        balanced=_read_balanced(faults, fields.get("balance"), len(coordinates)),
    )


def _read_balanced(faults: Faults, node: YamlNode | None, n: int) -> tuple[Cell, ...]:
    help = PROBLEM["balance"].help
    fields = mapping(faults, node, BALANCE.names, "balance", help)
    cells = read_expressions(faults, fields.get("g"), "g", help) if fields else None
    if fields is None or cells is None:
        return ()
    if len(cells) != n:
        faults.error(fields.span, f"g has {len(cells)} entries, for {n} coordinates", help)
    return cells if len(cells) == n else ()


def _read_parameters(
    faults: Faults, node: YamlNode | None, coordinates: Collection[str]
) -> ParsedModelQuestions:
    if node is None or isinstance(node, FaultyNode):
        return NO_MODEL_QUESTIONS
    if not isinstance(node, MappingNode):
        faults.error(node.span, f"parameters is a mapping, not {describe(node)}", _HELP)
        return NO_MODEL_QUESTIONS
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
            forbid(faults, [cell], coordinates, "a parameter is free of coordinates: they stand in Y")
            cells[name] = cell
    if len(cells) > MAX_PARAMETERS:
        faults.error(
            node.span, f"{len(cells)} parameters; at most {MAX_PARAMETERS} are read", "leave some out"
        )
        return NO_MODEL_QUESTIONS
    return ParsedModelQuestions(known, tuple(cells.items()))


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


def check_model_questions(faults: Faults, asked: ParsedModelQuestions, parameters: Collection[str]) -> None:
    """What is known, and what parameters are made of, occurs in the problem, whose `parameters` these are."""
    for name, span in asked.known:
        if name not in parameters:
            _unknown(faults, name, span, parameters)
    for _, cell in asked.parameters:
        for found in cell.names:
            if found.name not in parameters and found.name != "pi":
                _unknown(faults, found.name, cell.span_of(found), parameters)


def _unknown(faults: Faults, name: str, span: Span, parameters: Collection[str]) -> None:
    help = did_you_mean(name, parameters) or f"its parameters are {', '.join(sorted(parameters))}"
    faults.error(span, f"{name} is no parameter of this problem", help)
