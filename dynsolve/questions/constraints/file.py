"""Constraints of a problem file, as they are written: h(q) = 0, or an expression linear in the rates."""

from __future__ import annotations

from collections.abc import Collection

from msgspec.structs import replace

from dynsolve.notation.tree import Node, Reference, Symbol, names_in, walk
from dynsolve.problem.cells import Cell, denominators, read_point_expression, read_rate_cell
from dynsolve.problem.kinds import Fields, items
from dynsolve.problem.state import Around, Given
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults, MappingNode, YamlNode
from dynsolve.questions.constraints.keys import KEYS, MAX_CONSTRAINTS, RATES
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Constraint

_LINEAR = "a constraint on rates is a sum of rates, each times a function of the coordinates"


class GivenConstraints(Given, frozen=True):
    """What is 0, the `moving` cells; `in_rates` says of each whether it is linear in the rates."""

    in_rates: tuple[bool, ...] = ()


def read(faults: Faults, fields: Fields, around: Around) -> GivenConstraints:
    """The entries of `constraints`; what is wrong with one is reported."""
    node = fields.get("constraints")
    listed = items(faults, node, "constraints", KEYS[0].help)
    if len(listed) > MAX_CONSTRAINTS and node:
        message = f"{len(listed)} constraints; at most {MAX_CONSTRAINTS} are read"
        faults.error(node.span, message, "leave some out")
        return GivenConstraints()
    found = [_read(faults, item, i, around.points, around.coordinates) for i, item in enumerate(listed, 1)]
    kept = [entry for entry in found if entry is not None]
    return GivenConstraints(moving=tuple(cell for cell, _ in kept), in_rates=tuple(one for _, one in kept))


def _read(
    faults: Faults, node: YamlNode, index: int, points: Collection[str], coordinates: Collection[str]
) -> tuple[Cell, bool] | None:
    """What is 0, and whether rates stand in it."""
    what = f"constraint {index}"
    if isinstance(node, MappingNode):
        fields = Fields(faults, node, RATES.names, what)
        if fields.lacks("rates"):
            faults.error(node.span, f"{what} has no `rates`", RATES["rates"].help)
            return None
        cell = read_rate_cell(faults, fields.get("rates"), what, coordinates)
        return (cell, True) if cell and _is_linear(faults, cell, coordinates) else None
    found = read_point_expression(faults, node, what, points, coordinates)
    if found is None:
        return None
    if not names_in(found.tree) & set(coordinates) and not _has_points(found.tree):
        help = "write what the motion keeps at 0: tip.x - k, q1 + q2 - pi/2"
        faults.error(found.span, f"{what}: no coordinate occurs in it", help)
        return None
    return found, False


def _has_points(tree: Node) -> bool:
    return any(isinstance(part, Reference) for part in walk(tree))


def _is_linear(faults: Faults, cell: Cell, coordinates: Collection[str]) -> bool:
    """Whether rates stand in it at all, and no coordinate or rate below a fraction bar."""
    below = [part for node in denominators(cell.tree) for part in walk(node)]
    moving = [p for p in below if isinstance(p, Symbol) and (p.dots or p.name in coordinates)]
    if moving or not any(isinstance(part, Symbol) and part.dots for part in walk(cell.tree)):
        why = "a coordinate stands in a denominator" if moving else "no rate occurs in it"
        faults.error(cell.span, f"{cell.what}: {why}", _LINEAR)
        return False
    return True


def build(values: CellValues, robot: Robot, given: GivenConstraints) -> Robot:
    """The robot with its constraints; A_c stands in the equations of motion, and is asked for with them."""
    pairs = zip(given.moving, given.in_rates, strict=True)
    constraints = tuple(_constraint(values, robot, cell, in_rates) for cell, in_rates in pairs)
    asked = robot.questions.asked | {*(["Ac"] if constraints else [])}
    return replace(robot, questions=replace(robot.questions, constraints=constraints, asked=asked))


def _constraint(values: CellValues, robot: Robot, cell: Cell, in_rates: bool) -> Constraint:
    """A constraint; one on the rates that is not linear in them is reported."""
    constraint = Constraint(cell.tree, in_rates)
    value = values.expr(cell) if in_rates else None
    if value is not None:
        ring = robot.ring
        factors = [ring.coefficient(value, name, 1) for name in ring.names]
        terms = (factor * ring.symbol(name, 1) for factor, name in zip(factors, ring.names, strict=True))
        moving = any(ring.coefficient(f, name, 1) != ring.zero for f in factors for name in ring.names)
        if moving or sum(terms, start=ring.zero) != value:
            help = "a constraint on rates is a sum of rates, each times a function of the coordinates"
            values.faults.error(cell.span, f"{cell.what} is not linear in the rates", help)
    return constraint
