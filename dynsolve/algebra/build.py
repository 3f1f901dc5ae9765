"""Making a ring: the smallest one that holds given formulas."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.ring import NoRoom, Ring
from dynsolve.algebra.ring_plan import RingPlan, plan_ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.tree import Node, Number, Quotient


def build_ring(
    coordinates: Sequence[tuple[str, str]],
    trees: Iterable[Node],
    angles: Iterable[Angle] = (),
    preferred: Sequence[Angle] = (),
) -> Ring:
    """The smallest ring that holds everything in `trees` and the sine and cosine of `angles`.

    `coordinates` are (name, "revolute" | "prismatic"); `preferred` angles are
    taken as basic ones as far as they are independent.  Raises AlgebraError
    for a number used as an angle.
    """
    names = [name for name, _ in coordinates]
    return ring_of(coordinates, plan_ring(names, tuple(trees), tuple(preferred), tuple(angles)))


def with_symbols(ring: Ring, names: Iterable[str]) -> Ring:
    """A ring with further parameters; the generators of the given one keep their places."""
    return ring_of(ring.coordinates, replace(ring.plan, symbols=(*ring.plan.symbols, *names)))


def with_references(ring: Ring, names: Iterable[str]) -> Ring:
    """A ring with the first and second derivatives of further names as symbols."""
    return ring_of(ring.coordinates, replace(ring.plan, references=tuple(names)))


def ring_of(coordinates: Sequence[tuple[str, str]], plan: RingPlan) -> Ring:
    """The ring of a plan, with the relations of its roots and denominators."""
    while True:
        try:
            ring = Ring(coordinates, plan)
            for g in reversed(ring.generators):  # a root may stand under one that is laid out before it
                if g.kind == "root" and g.node is not None:
                    ring.adjoin_root(g.index, value_of(ring, g.node))
            for tree in plan.denominators:
                value_of(ring, Quotient(Number(1), tree))
            return ring
        except NoRoom:
            plan = plan.with_more_inverses()
