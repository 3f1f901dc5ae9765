"""Expressions in which coordinates of points may stand: tip.x, P.y."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace

from dynsolve.notation.tree import Function, Node, Reference, Symbol
from dynsolve.notation.walk import mapped, names_in, walk
from dynsolve.problem.cells import Cell, denominators, read_cell
from dynsolve.problem.fields import did_you_mean
from dynsolve.problem.source import Faults
from dynsolve.problem.yaml_nodes import ScalarNode, YamlNode
from dynsolve.robot.questions import TIP, coordinate_of

_COORDINATE = re.compile(r"(?<![\w.])([A-Za-z]\w*)\.([xyz])(?!\w)")


def read_point_expression(
    faults: Faults, node: YamlNode, what: str, points: Collection[str], coordinates: Collection[str]
) -> Cell | None:
    """An expression in which P.x is a coordinate of a point; what is wrong with it is reported.

    A `Reference` stands for that coordinate.  Nothing that moves may stand in a denominator.
    """
    dotted = list(_COORDINATE.finditer(node.text)) if isinstance(node, ScalarNode) else []
    for found in dotted:
        if found[1] not in (TIP, *points):
            start = node.start + found.start() if isinstance(node, ScalarNode) else 0
            help = did_you_mean(found[1], (TIP, *points)) or "points are the tip and those of `points:`"
            faults.error((start, start + len(found[1])), f"there is no point {found[1]}", help)
            return None
    plain = replace(node, text=_COORDINATE.sub(r"\1_\2", node.text)) if isinstance(node, ScalarNode) else node
    cell = read_cell(faults, plain, what)
    if cell is None:
        return None
    places = {found.start() for found in dotted}
    meant = {f"{found[1]}_{found[2]}": coordinate_of(found[1], "xyz".index(found[2])) for found in dotted}

    def with_references(part: Node) -> Node:
        return meant.get(part.name, part) if isinstance(part, Symbol) else part

    names = tuple(name for name in cell.names if name.offset not in places)
    sound = replace(cell, tree=mapped(cell.tree, with_references), names=names)
    return sound if _is_polynomial(faults, sound, coordinates) else None


def _is_polynomial(faults: Faults, cell: Cell, coordinates: Collection[str]) -> bool:
    """Whether no coordinate, and no coordinate of a point, stands in a denominator or under a root."""
    roots = [part for part in walk(cell.tree) if isinstance(part, Function) and part.name == "sqrt"]
    for part in (*denominators(cell.tree), *roots):
        if names_in(part) & set(coordinates) or any(isinstance(p, Reference) for p in walk(part)):
            message = f"{cell.what}: a coordinate stands in a denominator or under a root"
            faults.error(cell.span, message, "it is made of sums, products, sines and cosines")
            return False
    return True
