"""The generators of a ring: the variables of its polynomials, and the meaning of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.ring_plan import RingPlan
from dynsolve.notation.tree import Function, Node


@dataclass(frozen=True, slots=True)
class Generator:
    """One variable of the polynomial ring.

    kind is one of `sin`, `cos` (with `angle`), `symbol` (with `name`, `dots`),
    `root` (√ of `node`), `inverse` (1 / a polynomial, set when first needed),
    `constant` (cos of a constant `angle` of some degrees) or `function` (`node`, a
    function that is no polynomial: the sign of a rate, or of an argument without an exact meaning here).
    """

    kind: str
    index: int
    name: str = ""
    dots: int = 0
    angle: Angle = Angle()
    node: Node | None = None


@dataclass(frozen=True, slots=True)
class Pair:
    """The sine and cosine of a basic angle, by the indices of their generators."""

    angle: Angle
    sine: int
    cosine: int


def is_sign(node: Node | None) -> bool:
    """Whether a function is the sign of a rate, sgn q̇: a generator that is 0 at rest."""
    return isinstance(node, Function) and node.name == "sgn"


def dotted(name: str, dots: int) -> str:
    """The plain name of a symbol or of its derivative: `theta1`, `theta1_dot`, `theta1_ddot`."""
    return f"{name}_{'d' * dots}ot" if dots else name


def lay_out(plan: RingPlan) -> tuple[Generator, ...]:
    """The generators of a ring: those that a relation eliminates first, the plain symbols last."""
    laid: list[Generator] = []

    def add(kind: str, **what: Any) -> None:
        laid.append(Generator(kind, len(laid), **what))

    for _ in range(plan.inverses):
        add("inverse")
    for kind in ("sin", "cos"):
        for angle in plan.basic_angles:
            add(kind, angle=angle)
    for node in reversed(plan.roots):
        add("root", node=node)
    if plan.constants.generator_degrees is not None:
        add("constant", angle=Angle((), plan.constants.generator_degrees))
    for dots in (2, 1, 0):
        for name in (*plan.coordinates, *(plan.references if dots else ())):
            add("symbol", name=name, dots=dots)
    for function in plan.functions:
        add("function", node=function)
    for name in plan.symbols:  # last, so that further parameters leave the places of the others as they are
        if name not in plan.coordinates:
            add("symbol", name=name)
    return tuple(laid)


def sine_cosine_pairs(generators: Sequence[Generator]) -> tuple[Pair, ...]:
    """The sines and cosines among the generators, angle by angle."""
    sines = [g for g in generators if g.kind == "sin"]
    cosines = [g for g in generators if g.kind == "cos"]
    return tuple(Pair(s.angle, s.index, c.index) for s, c in zip(sines, cosines, strict=True))
