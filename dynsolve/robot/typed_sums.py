"""Sums as a file has them, which its formulas are written with wherever they are a factor.

These are differences such as R - r, and with them their rates; what is squared, such as (L sin q - d)² in
an energy; and what a spring or damper acts along first, x₂ - x₁ - δ.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import negated, summands, total
from dynsolve.notation.tree import ZERO, Function, Negative, Node, Power, Sum, Symbol, mapped, names_in, walk
from dynsolve.robot.model import Robot


def typed_sums(cells: Iterable[Node]) -> Iterator[Sum]:
    """The differences of letters, numbers and products of them, and all sums that are squared."""
    nodes = list(walk(*cells))
    squared = {node.base for node in nodes if isinstance(node, Power)}
    for node in nodes:
        if isinstance(node, Sum) and not any(isinstance(part, Sum) for part in walk(*node.terms)):
            is_difference = any(isinstance(term, Negative) for term in node.terms)
            if node in squared or (is_difference and not _has_functions(node)):
                yield node


def printed_sums(robot: Robot, form: Callable[[Expr], Node]) -> Iterator[Sum]:
    """Deflections and typed sums, and the rates of these, in their order, each term in its printed `form`."""
    for act in robot.actions.stored:
        for one, other in act.differences:
            difference = deflection(one, other, form)
            if isinstance(difference, Sum):
                yield difference
    rates = {Symbol(name): Symbol(name, 1) for name in robot.ring.names}

    def rate(node: Node) -> Node:
        return rates.get(node, node) if isinstance(node, Symbol) else node

    for damper in robot.actions.resisting:
        stretched = mapped(along(damper.along[0], form), rate) if damper.along else ZERO
        if isinstance(stretched, Sum):
            yield stretched
    for typed in robot.typed_sums:
        try:
            printed = total([form(value_of(robot.ring, term)) for term in typed.terms])
        except AlgebraError:  # of an angle alone, q - 30 deg: no factor of anything
            continue
        if not isinstance(printed, Sum):
            continue
        terms = printed.terms
        if len({frozenset(names_in(term)) for term in terms}) < len(typed.terms):  # d + c - d
            continue
        yield printed
        if not _has_functions(typed) and all(names_in(term) & {*robot.ring.names} for term in terms):
            yield Sum(tuple(mapped(term, rate) for term in terms))


def deflection(one: Expr, other: Expr, form: Callable[[Expr], Node]) -> Node:
    """x₂ - x₁ - δ: what acts along x₂ - x₁ and is at rest at δ, each as printed by itself."""
    return total([along(one, form), negated(form(other))])


def along(one: Expr, form: Callable[[Expr], Node]) -> Node:
    """What something acts along, a coordinate first: y + L θ/2, as y - L θ/2."""
    coordinates = {*map(Symbol, one.ring.names)}
    return total(sorted(summands(form(one)), key=lambda term: term not in coordinates))


def _has_functions(node: Node) -> bool:
    return any(isinstance(part, Function) for part in walk(node))
