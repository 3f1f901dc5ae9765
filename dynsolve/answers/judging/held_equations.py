"""Equations that hold together, in numbers: of a set of configurations one alternative."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from math import pi, remainder

from dynsolve.derivation.configuration_check import NO_VALUE
from dynsolve.derivation.reached import CLOSE
from dynsolve.notation.tokens import ARCS
from dynsolve.notation.tree import Function, Node, Number
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.notation.walk import mapped, names_in, walk


@dataclass(frozen=True, slots=True)
class HeldEquations:
    """What is 0 together; `are_angles` tells of each whether it counts modulo 2π, as q₂ - π does."""

    program: Program
    are_angles: tuple[bool, ...]

    def hold(self, q: Mapping[str, float]) -> bool:
        """Whether all are 0 at a configuration."""
        try:
            values = self.program.run(q)
        except NO_VALUE:
            return False
        pairs = zip(values, self.are_angles, strict=True)
        return all(abs(remainder(value, 2 * pi) if is_angle else value) < CLOSE for value, is_angle in pairs)


def held_equations(
    nodes: Iterable[Node], coordinates: Collection[str], periodic: Collection[str]
) -> HeldEquations:
    """The equations node = 0, where the angles `periodic` among the coordinates count modulo 2π."""
    nodes = tuple(nodes)
    are_angles = []
    for node in nodes:
        within = names_in(node).intersection(coordinates)
        outside = mapped(node, _without_angle)
        turned = any(isinstance(part, Function) and within & names_in(part) for part in walk(outside))
        are_angles.append(bool(within) and within <= set(periodic) and not turned)
    return HeldEquations(compile_trees(nodes), tuple(are_angles))


def _without_angle(part: Node) -> Node:
    """0 for an angle that a function gives, which like a coordinate counts modulo 2π."""
    return Number(0) if isinstance(part, Function) and part.name in ARCS else part
