"""Constraints of a problem file, as they are written: h(q) = 0, or an expression linear in the rates."""

from __future__ import annotations

from collections.abc import Collection

from msgspec import Struct

from dynsolve.notation.tree import Node, Symbol, names_in, walk
from dynsolve.problem.action_keys import MAX_CONSTRAINTS, RATES
from dynsolve.problem.cells import Cell, denominators, read_point_expression, read_rate_cell
from dynsolve.problem.kinds import Fields, items
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import Faults, MappingNode, YamlNode

_LINEAR = "a constraint on rates is a sum of rates, each times a function of the coordinates"


class ParsedConstraint(Struct, frozen=True):
    """What is 0; `in_rates` says that rates stand in it, and not a function of the coordinates alone."""

    cell: Cell
    in_rates: bool = False


def read_constraints(
    faults: Faults, fields: Fields, points: Collection[str], coordinates: Collection[str]
) -> tuple[ParsedConstraint, ...]:
    """The entries of `constraints`; what is wrong with one is reported."""
    node = fields.get("constraints")
    listed = items(faults, node, "constraints", PROBLEM["constraints"].help)
    if len(listed) > MAX_CONSTRAINTS and node:
        message = f"{len(listed)} constraints; at most {MAX_CONSTRAINTS} are read"
        faults.error(node.span, message, "leave some out")
        return ()
    read = [_read(faults, item, i, points, coordinates) for i, item in enumerate(listed, 1)]
    return tuple(constraint for constraint in read if constraint)


def _read(
    faults: Faults, node: YamlNode, index: int, points: Collection[str], coordinates: Collection[str]
) -> ParsedConstraint | None:
    what = f"constraint {index}"
    if isinstance(node, MappingNode):
        fields = Fields(faults, node, RATES.names, what)
        if fields.lacks("rates"):
            faults.error(node.span, f"{what} has no `rates`", RATES["rates"].help)
            return None
        cell = read_rate_cell(faults, fields.get("rates"), what, coordinates)
        return (
            ParsedConstraint(cell, in_rates=True) if cell and _is_linear(faults, cell, coordinates) else None
        )
    found = read_point_expression(faults, node, what, points, coordinates)
    if found is None:
        return None
    if not names_in(found.tree) & set(coordinates) and not _has_points(found.tree):
        help = "write what the motion keeps at 0: tip.x - k, q1 + q2 - pi/2"
        faults.error(found.span, f"{what}: no coordinate occurs in it", help)
        return None
    return ParsedConstraint(found)


def _has_points(tree: Node) -> bool:
    from dynsolve.notation.tree import Reference

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
