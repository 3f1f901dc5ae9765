"""What a problem file gives for equilibria: what motors hold, the wanted g, a state, constant rates."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import replace

from dynsolve.problem.cells import Cell, read_expressions
from dynsolve.problem.kinds import Fields, mapping, word
from dynsolve.problem.state import Around, Given, ParsedState, read_values
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, MappingNode, YamlNode
from dynsolve.questions.equilibria.keys import BALANCE, BALANCE_KEY, INPUTS, INPUTS_KEY, LINEARIZE, STEADY
from dynsolve.robot.model import Robot


class GivenEquilibrium(Given, frozen=True):
    """The state to linearize at and the constant rates; the wanted g are the `moving` cells."""

    linearize: ParsedState | None = None
    steady: ParsedState | None = None
    inputs_given: bool = False


def read(faults: Faults, fields: Fields, around: Around) -> GivenEquilibrium:
    """The keys of a file; what is wrong is reported."""
    inputs = word(faults, fields.get("inputs"), INPUTS.choices, "inputs", INPUTS_KEY.help)
    linearize = _read_equilibrium(faults, fields.get("linearize"), around.coordinates)
    steady = _read_steady(faults, fields.get("steady"), around.coordinates)
    return GivenEquilibrium(
        constant=tuple(cell for state in (linearize, steady) if state for cell in state.cells.values()),
        moving=_read_balanced(faults, fields.get("balance"), len(around.coordinates)),
        states=(linearize,) if linearize else (),
        linearize=linearize,
        steady=steady,
        inputs_given=inputs is not None,
    )


def _read_balanced(faults: Faults, node: YamlNode | None, n: int) -> tuple[Cell, ...]:
    help = BALANCE_KEY.help
    fields = mapping(faults, node, BALANCE.names, "balance", help)
    cells = read_expressions(faults, fields.get("g"), "g", help) if fields else None
    if fields is None or cells is None:
        return ()
    if len(cells) != n:
        faults.error(fields.span, f"g has {len(cells)} entries, for {n} coordinates", help)
    return cells if len(cells) == n else ()


def _read_equilibrium(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> ParsedState | None:
    """The values of `linearize`, which are of coordinates alone; None where there are none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    help = LINEARIZE.help
    if not isinstance(node, MappingNode):
        faults.error(node.span, "linearize is a mapping from coordinates to values", help)
        return None
    found = read_values(faults, node, kinds)
    for name, dots in found.cells:
        if dots:
            faults.error(node.span, f"the rate of {name} is 0 in an equilibrium", help)
    if not node.entries:
        faults.error(node.span, "linearize has no coordinate", help)
    return found


def _read_steady(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> ParsedState | None:
    """The rates of `steady`, each under its coordinate's name or its own; None where there are none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    help = STEADY.help
    if not isinstance(node, MappingNode):
        faults.error(node.span, "steady is a mapping from coordinates to their constant rates", help)
        return None
    rates = dict.fromkeys(kinds, "prismatic")  # a rate is a number also where the coordinate is an angle
    found = read_values(faults, node, rates)
    if any(dots > 1 for _, dots in found.cells):
        faults.error(node.span, "an acceleration is 0 where the rate is constant", help)
    cells = {(name, 1): cell for (name, _), cell in found.cells.items()}
    if len(cells) == len(kinds):
        faults.error(node.span, "no coordinate is left that could be in balance", help)
    return ParsedState(cells, kinds)


def build(values: CellValues, robot: Robot, given: GivenEquilibrium) -> Robot:
    """The robot with what is given."""
    at = given.linearize.values if given.linearize else {}
    steady = given.steady.values if given.steady else {}
    asked = replace(
        robot.questions.model,
        inputs_given=given.inputs_given,
        balanced=values.column(given.moving) if given.moving else None,
        linearize=tuple((name, dots, value) for (name, dots), value in at.items()),
        steady=tuple((name, value) for (name, _), value in steady.items()),
    )
    return replace(robot, questions=replace(robot.questions, model=asked))
