"""Answers held against the key, entry by entry; C by the rows of C q̇."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from dynsolve.algebra.fraction import RationalExpr, as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_values import AnswerValue, fitted
from dynsolve.answers.judging.entry_comparison import EntryComparer, WrittenEntry
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Node, Product, Sum, Symbol

Rows = tuple[tuple[WrittenEntry, ...], ...]


@dataclass(frozen=True, slots=True)
class Target:
    """What an answer is held against: a node, and the one entry of it, from 0, that was asked for."""

    node: str
    entry: tuple[int, ...] = ()

    def of(self, value: Any) -> Any:
        """The part of a node's value that is meant."""
        return value[self.entry] if self.entry else value


@dataclass(frozen=True, slots=True)
class Obstacle:
    """Why an answer cannot be compared with the key: the code of a slip, and what was written instead."""

    code: str
    yours: str = ""


@dataclass(frozen=True, slots=True)
class KeyComparison:
    """An answer held against the key: its entries as they are compared, and whether each is right."""

    given: AnswerValue
    target: Target
    rows: tuple[tuple[WrittenEntry, ...], ...] = ()
    right: tuple[tuple[str | None, ...], ...] = ()
    obstacles: tuple[Obstacle, ...] = ()

    @property
    def correct(self) -> bool:
        """Whether every entry is right."""
        return (
            bool(self.rows) and not self.obstacles and all(r is not None for row in self.right for r in row)
        )

    @property
    def rounded(self) -> bool:
        """Whether a decimal rounds."""
        return any(r for row in self.right for r in row)


class KeyComparer:
    """Holds answers against the key in a graph; `moved` evaluates a changed tree."""

    def __init__(
        self, graph: AnswerGraph, compare: EntryComparer, moved: Callable[[Node], RationalExpr]
    ) -> None:
        self.graph = graph
        self.robot = graph.robot
        self.field = graph.field
        self.compare = compare
        self.moved = moved

    def target(self, name: str) -> Target:
        """What an answer of this name is held against."""
        quantity = self.graph.quantities.get(name)
        if quantity is not None and quantity.is_read_off:
            return Target(quantity.rule, quantity.entry)
        return Target(self.graph.node(name))

    def key(self, target: Target) -> Any:
        """The key's value of a target."""
        return target.of(self.graph.key(target.node))

    def __call__(self, name: str, given: AnswerValue) -> KeyComparison:
        """Hold one answer; where it is too large to be compared, it has a fault."""
        try:
            return self._hold(name, given)
        except AlgebraError as error:
            refused = replace(given, rows=None, fault=error.message, expected=error.help)
            return KeyComparison(refused, self.target(name))

    def _hold(self, name: str, given: AnswerValue) -> KeyComparison:
        target = self.target(name)
        if given.rows is None or target.node not in self.field.rules:
            return KeyComparison(given, target)
        key = self.key(target)
        rows, obstacles = self._coriolis(given) if name == "C" else self._rows(given, key)
        if not rows:
            return KeyComparison(given, target, obstacles=obstacles)
        matrix = key if isinstance(key, Matrix) else Matrix(self.field.ring, ((key,),))
        right = tuple(
            tuple(map(self.compare, expected, written))
            for expected, written in zip(matrix.rows, rows, strict=True)
        )
        return KeyComparison(given, target, rows, right, obstacles)

    def _rows(self, given: AnswerValue, key: Any) -> tuple[Rows, tuple[Obstacle, ...]]:
        """The entries as they are compared, in the key's shape."""
        assert given.rows is not None
        rows = fitted(given.rows, key)
        if rows is None:
            return (), (self._misfit(given, key),)
        nodes = iter([node for row in given.nodes for node in row])
        blank = given.nodes[0][0]  # one 0 for a whole vector, and the last row of a transformation
        return tuple(
            tuple(WrittenEntry(value, next(nodes, blank), self.moved) for value in row) for row in rows
        ), ()

    def _misfit(self, given: AnswerValue, key: Any) -> Obstacle:
        assert given.rows is not None
        shape = key.shape if isinstance(key, Matrix) else (1, 1)
        wanted = f"a {shape[0]}×{shape[1]} matrix" if shape != (1, 1) else "a single expression"
        mine = (
            f"a {len(given.rows)}×{len(given.rows[0])} matrix" if given.is_matrix else "a single expression"
        )
        return Obstacle("shape", f"You wrote {mine}; {given.answer.name} is {wanted}.")

    def _coriolis(self, given: AnswerValue) -> tuple[Rows, tuple[Obstacle, ...]]:
        """C as its C q̇, n×1; a C with accelerations in it is none."""
        assert given.rows is not None
        n, ring = self.robot.n, self.field.ring
        zero = len(given.entries) == 1 and given.entries[0].is_zero
        if not zero and (len(given.rows) != n or len(given.rows[0]) != n):
            return (), (self._misfit(given, self.field.key("C")),)
        rows = []
        for row in given.nodes if not zero else ((given.nodes[0][0],) * n,) * n:
            factors = zip(row, ring.names, strict=True)
            node: Node = Sum(tuple(Product((entry, Symbol(name, 1))) for entry, name in factors))
            rows.append((WrittenEntry(self.moved(node), node, self.moved),))
        return tuple(rows), tuple(self._unfit(given))

    def _unfit(self, given: AnswerValue) -> Iterator[Obstacle]:
        """What no C may hold: accelerations, or joint variables in a denominator."""
        ring = self.field.ring
        accelerations = [ring.symbol(name, 2).poly.degrees() for name in ring.names]
        indices = [list(degrees).index(1) for degrees in accelerations]
        for entry in given.entries:
            value = as_expr(entry)
            if value is None:
                yield Obstacle("C_not_polynomial")
                return
            degrees = value.poly.degrees() if value.poly else ()
            if degrees and any(degrees[i] > 0 for i in indices):
                yield Obstacle("acceleration_in_C")
                return
