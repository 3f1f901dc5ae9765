"""Equations of motion in which the forces of the constraint stand, as names λ: D q̈ + ... - A_cᵀ λ = τ.

Without λ they are the key's.  What stands beside λ is A_cᵀ: that of the student's own matrix, or, where
the equations of all coordinates are given, that of any that keeps the same constraint; with one
sign for all of them, for in which direction λ counts is free.

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.2 (1994).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, equal
from dynsolve.answers.judging.answer_values import AnswerValue
from dynsolve.answers.judging.inputs import multiplier_names
from dynsolve.answers.judging.key_comparison import KeyComparer, KeyComparison, Obstacle
from dynsolve.answers.judging.other_solutions import Other
from dynsolve.answers.judging.own_constraint import OwnConstraint
from dynsolve.notation.tree import Node, Number, Symbol
from dynsolve.notation.walk import with_children
from dynsolve.quantities import families

Rows = tuple[tuple[RationalExpr, ...], ...]


@dataclass(frozen=True, slots=True)
class _Equations:
    """One answer without λ, and what stands beside the multipliers in the equation of each coordinate."""

    compared: KeyComparison
    beside: Mapping[int, tuple[Expr, ...]]


def with_moved_multipliers(
    own: OwnConstraint, comparisons: Mapping[str, KeyComparison], compare: KeyComparer
) -> dict[str, KeyComparison]:
    """The comparisons, those of equations with λ in them made without it."""
    found = dict(comparisons)
    names = [name for name in multiplier_names(own.robot) if own.ring.has_symbol(name)]
    if not names:
        return found
    read = {
        name: equations
        for name, one in comparisons.items()
        if compare.graph.quantities[name].family in (families.TAU, families.FORCE)
        and (equations := _without(compare, name, one)) is not None
    }
    beside = {k: row for equations in read.values() for k, row in equations.beside.items()}
    right = _that_are_right(own, beside)
    for name, equations in read.items():
        if not any(not factor.is_zero for row in equations.beside.values() for factor in row):
            continue
        if equations.beside.keys() <= right:
            other = Other.WITHOUT_MULTIPLIERS if equations.compared.correct else None
            found[name] = replace(equations.compared, other=other)
        elif equations.compared.correct:
            found[name] = replace(equations.compared, obstacles=(Obstacle("constraint_forces"),))
    return found


def _without(compare: KeyComparer, name: str, compared: KeyComparison) -> _Equations | None:
    """An answer without λ; None where it has another form than a sum with λ times something."""
    value = compared.answer_value
    if value.rows is None or compared.obstacles or any(len(row) > 1 or row[0].divisor for row in value.rows):
        return None
    quantity = compare.graph.quantities[name]
    first = quantity.index[0] - 1 if quantity.family is families.FORCE else 0
    names = multiplier_names(compare.robot)
    beside: dict[int, tuple[Expr, ...]] = {}
    rests: list[Expr] = []
    for k, row in enumerate(value.rows, first):
        rest, factors = _parted(row[0].numerator, names)
        if any(_parted(factor, names)[0] != factor for factor in factors):
            return None
        beside[k] = factors
        rests.append(rest)
    nodes = tuple(tuple(_put_zero(node, names) for node in row) for row in value.nodes)
    rows = tuple((RationalExpr(rest),) for rest in rests)
    return _Equations(compare(name, AnswerValue(value.answer, rows, nodes)), beside)


def _parted(expr: Expr, names: Sequence[str]) -> tuple[Expr, tuple[Expr, ...]]:
    """An expression without the multipliers, and its derivatives by them."""
    ring, rest, factors = expr.ring, expr, []
    for name in names:
        factor = ring.coefficient(expr, name) if ring.has_symbol(name) else ring.zero
        factors.append(factor)
        rest = rest - factor * ring.symbol(name) if not factor.is_zero else rest
    return rest, tuple(factors)


def _put_zero(node: Node, names: Sequence[str]) -> Node:
    if isinstance(node, Symbol) and node.name in names:
        return Number(0)
    return with_children(node, lambda part: _put_zero(part, names))


def _that_are_right(own: OwnConstraint, beside: Mapping[int, tuple[Expr, ...]]) -> set[int]:
    """The coordinates in whose equations the forces of the constraint are right."""
    if len(beside) == own.robot.n:
        rows = zip(*(beside[k] for k in sorted(beside)), strict=True)
        if own.keeps(tuple(tuple(map(RationalExpr, row)) for row in rows)):
            return set(beside)
    found: list[set[int]] = [
        {k for k, factors in beside.items() if _is_column(own.rows, k, factors, sign)} for sign in (-1, 1)
    ]
    return max(found, key=len)


def _is_column(rows: Rows, k: int, factors: Sequence[Expr], sign: int) -> bool:
    """Whether factors are a column of A_c, with a sign."""
    return all(equal(row[k], RationalExpr(factor * sign)) for row, factor in zip(rows, factors, strict=True))
