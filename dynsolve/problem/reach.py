"""`reach` of a problem file: the names that the values of r(q) have in the inverse kinematics."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from dynsolve.errors import ReadError
from dynsolve.notation.names import normalize
from dynsolve.problem.fields import items
from dynsolve.problem.kinematic_keys import MAX_TASK
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import FaultyNode, ScalarNode, Span, YamlNode


@dataclass(frozen=True, slots=True)
class ParsedReach:
    """The names, and where they stand."""

    names: tuple[str, ...] = ()
    span: Span = (0, 0)


NO_REACH = ParsedReach()
"""What a file without the key has."""


def read_reach(faults: Faults, node: YamlNode | None, taken: Collection[str]) -> ParsedReach:
    """The names under `reach`; `taken` are those that mean something else already."""
    help = PROBLEM["reach"].help
    listed = items(faults, node, "reach", help)
    if node is None or isinstance(node, FaultyNode):
        return NO_REACH
    if len(listed) > MAX_TASK:
        faults.error(node.span, f"{len(listed)} values; at most {MAX_TASK} are read", "leave some out")
        return NO_REACH
    names: list[str] = []
    for item in listed:
        name = _name(faults, item, help)
        if name in taken or name in names:
            faults.error(item.span, f"{name} means something else already", "give the value another name")
        elif name:
            names.append(name)
    return ParsedReach(tuple(names), node.span)


def _name(faults: Faults, node: YamlNode, help: str) -> str | None:
    if not isinstance(node, ScalarNode):
        if not isinstance(node, FaultyNode):
            faults.error(node.span, "the name of a value is expected", help)
        return None
    try:
        return normalize(node.text)
    except ReadError as error:
        at = node.start + error.offset
        faults.error((at, at + error.length), error.message, help)
        return None


def check_reach(faults: Faults, reach: ParsedReach, rows: int) -> None:
    """There is a name for each component of the task."""
    if reach.names and len(reach.names) != rows:
        faults.error(
            reach.span,
            f"reach names {len(reach.names)} value{'s' * (len(reach.names) > 1)}; the task has {rows}",
            "name one value for each component of the task, in their order",
        )
