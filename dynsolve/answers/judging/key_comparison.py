"""Answers compared with the key, entry by entry; C by the rows of C q̇."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.fraction import RationalExpr, as_expr, same, simplified
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.answers.judging.answer_values import AnswerValue, as_value, fitted, unfolded
from dynsolve.answers.judging.entry_comparison import (
    EntryComparer,
    WrittenEntry,
    difference,
    placed,
    put_numbers,
    readings,
    spans,
)
from dynsolve.answers.judging.equivalences import (
    as_matrix,
    missed,
    other_solution,
)
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.derivation.graph import Skipped
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import ZERO, Node, Product, Sum, Symbol
from dynsolve.quantities.family import Kind
from dynsolve.quantities.index import Quantity
from dynsolve.quantities.stages import Stage
from dynsolve.questions.constraints.judge import OTHER_SIDE, OwnConstraint
from dynsolve.questions.judging import Case, Missed
from dynsolve.questions.parameters import REGRESSORS
from dynsolve.questions.parameters.judge import forces_of, is_free, wrong_parameters

Rows = tuple[tuple[WrittenEntry, ...], ...]

AT_STATE = "right with the given state put in"


class Target(Struct, frozen=True):
    """What an answer is compared with: a node, and the one entry of it, from 0, that was asked for."""

    node: str
    entry: tuple[int, ...] = ()

    def of(self, value: Any) -> Any:
        """The part of a node's value that is meant."""
        return value[self.entry] if self.entry else value


class Obstacle(Struct, frozen=True):
    """Why an answer cannot be compared with the key: the code of a slip, and what was written instead."""

    code: str
    yours: str = ""


class KeyComparison(Struct, frozen=True):
    """An answer compared with the key: its entries as they are compared, and whether each is right.

    `other` says how it is right although it is not the key's.  `written` are
    the vectors of an answer that is a space, in the ways in which they may be meant.  `missed` is an
    equation that it does not satisfy, `holds_with` whether it does with own values of other results;
    `waits` says why a human has to look at what is not right.
    """

    answer_value: AnswerValue
    target: Target
    rows: tuple[tuple[WrittenEntry, ...], ...] = ()
    right: tuple[tuple[str | None, ...], ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    other: str = ""
    written: tuple[Matrix, ...] = ()
    missed: Missed | None = None
    holds_with: Callable[[Mapping[str, Any]], bool] | None = None
    waits: str = ""

    @property
    def correct(self) -> bool:
        """Whether every entry is right."""
        return bool(self.rows) and not self.obstacles and not any(None in row for row in self.right)

    @property
    def rounded(self) -> bool:
        """Whether a decimal rounds."""
        return any(map(any, self.right))


class KeyComparer:
    """Compares answers with the key; `changed` gives the value of a tree with a decimal changed."""

    def __init__(
        self, graph: AnswerGraph, compare: EntryComparer, changed: Callable[[Node], RationalExpr]
    ) -> None:
        self.graph = graph
        self.robot = graph.robot
        self.answer_ring = graph.answer_ring
        self.compare = compare
        self.changed = changed

    def target(self, name: str) -> Target:
        """What an answer of this name is compared with."""
        quantity = self.graph.quantities.get(name)
        if quantity is not None and quantity.is_read_off:
            return Target(quantity.rule, quantity.entry)
        return Target(self.graph.node(name))

    def key(self, target: Target) -> Any:
        """The key's value of a target."""
        return target.of(self.graph.key(target.node))

    def __call__(self, name: str, value: AnswerValue) -> KeyComparison:
        """Compare one answer; where it is too large to be compared, it has a fault."""
        try:
            return self._compared(name, value)
        except AlgebraError as error:
            refused = replace(value, rows=None, fault=error.message, expected=error.help)
            return KeyComparison(refused, self.target(name))

    def _compared(self, name: str, value: AnswerValue) -> KeyComparison:
        target = self.target(name)
        if value.rows is None or target.node not in self.answer_ring.rules:
            return KeyComparison(value, target)
        key, given = self.key(target), value
        value = self._at_state(target, value)
        if isinstance(key, Skipped):
            fault, help = "the key is too large to be compared with", "a person has to look at this"
            return KeyComparison(replace(value, rows=None, fault=fault, expected=help), target)
        quantity = self.graph.quantities.of_rule(target.node)
        if quantity is not None and quantity.family.kind is Kind.SPAN:
            return self._span(value, target, key)
        if is_free(self.robot, target.node) and target.node not in self.graph.parameters:
            return self._parameters(value, target, key)
        rows, obstacles = self._coriolis(value) if name == "C" else self._rows(name, value, key)
        if not rows:
            return KeyComparison(value, target, obstacles=obstacles)
        expected = key.rows if isinstance(key, Matrix | FractionMatrix) else ((key,),)
        right = tuple(
            tuple(map(self.compare, wanted, written)) for wanted, written in zip(expected, rows, strict=True)
        )
        compared = KeyComparison(value, target, rows, right, obstacles)
        is_equation = value.answer.is_equation
        case = self._case(target.node, quantity, rows, is_equation)
        stages = [one.family.stage for one in self.graph.quantities.values()]
        if compared.correct:
            return replace(compared, other=AT_STATE if value is not given else "")
        other = other_solution(case, stages)
        if not other:
            miss = missed(case, stages)
            return replace(compared, missed=miss, holds_with=self._held_by(case, stages) if miss else None)
        return replace(compared, right=tuple(tuple("" for _ in row) for row in rows), other=other)

    def _held_by(self, case: Case, stages: Sequence[Stage]) -> Callable[[Mapping[str, Any]], bool]:
        """Whether an answer is right where own values stand for some of the key's."""

        def result(own: Mapping[str, Any], name: str) -> Any:
            return own[name] if name in own else self.graph.key(name)

        return lambda own: bool(other_solution(replace(case, result=partial(result, own)), stages))

    def _at_state(self, target: Target, value: AnswerValue) -> AnswerValue:
        """An answer for the given state that holds its coordinates, with the state put in; else the same."""
        quantity, state = self.graph.quantities.of_rule(target.node), self.robot.questions.state
        if quantity is None or not quantity.family.at_state or not state or value.rows is None:
            return value
        at = AtState(self.answer_ring.ring, state.by_symbol)

        def put(entry: RationalExpr) -> RationalExpr:
            divisor = entry.divisor and at(entry.divisor)
            if divisor is not None and divisor.is_zero:
                raise AlgebraError("in the given state it has no value")
            return simplified(RationalExpr(at(entry.numerator), divisor))

        rows = tuple(tuple(map(put, row)) for row in value.rows)
        return value if same(rows, value.rows) else replace(value, rows=rows, put=put)

    def _case(self, node: str, quantity: Quantity | None, rows: Rows, is_equation: bool) -> Case:
        ring, values = self.answer_ring.ring, tuple(tuple(entry.value for entry in row) for row in rows)
        return Case(
            self.robot,
            node,
            quantity,
            [row[0] for row in values],
            partial(as_value, values),
            lambda wanted, row: self.compare(wanted, rows[row][0]) is not None,
            self.graph.key,
            self.graph.parameters,
            lambda value: put_numbers(value, placed(self.compare.values, ring)),
            lambda factors, wanted: self.compare.is_made(wanted, factors, [row[0] for row in rows]),
            is_equation,
        )

    def _parameters(self, value: AnswerValue, target: Target, key: Matrix) -> KeyComparison:
        """Parameters of τ = Y a with which there is no Y, unless they are the key's, but for rounding."""
        rows, _ = self._rows(target.node, value, key)
        right = tuple(
            tuple(map(self.compare, wanted, written)) for wanted, written in zip(key.rows, rows, strict=False)
        )
        compared = KeyComparison(value, target, rows, right)
        if compared.correct:
            return compared
        written = as_matrix(value, target.node)
        if written is None:
            return KeyComparison(
                value, target, obstacles=(Obstacle("parameters", "These are no parameters."),)
            )
        why = wrong_parameters(
            self.graph.robot, forces_of(self.robot, REGRESSORS[target.node], self.graph.key), written
        )
        entries = tuple(
            (WrittenEntry(RationalExpr(e), value.nodes[0][0], self.changed),) for e in written.entries
        )
        unknown = tuple((None,) for _ in entries)
        return KeyComparison(
            value, target, entries, unknown, (Obstacle("parameters", why),), written=(written,)
        )

    def _span(self, value: AnswerValue, target: Target, key: Matrix) -> KeyComparison:
        """Vectors, whether they span the key's space; the verdict is one for all of them."""
        assert value.rows is not None
        height = key.shape[0]
        written = readings(value.rows, height)
        if not spans(key, written, self.compare.values):
            obstacle = Obstacle("span", difference(key, written, height))
            return KeyComparison(value, target, obstacles=(obstacle,), written=written)
        first = WrittenEntry(value.rows[0][0], value.nodes[0][0], self.changed)
        return KeyComparison(value, target, ((first,),), (("",),), written=written)

    def _rows(self, name: str, value: AnswerValue, key: Any) -> tuple[Rows, tuple[Obstacle, ...]]:
        assert value.rows is not None
        rows = fitted(value.rows, key)
        if rows is None:
            whole = self._unfolded(name, value)
            return (whole, ()) if whole is not None else ((), (self._misfit(value, key),))
        put, nodes = value.put, iter([node for row in value.nodes for node in row])

        def changed(node: Node) -> RationalExpr:
            return put(self.changed(node)) if put is not None else self.changed(node)

        blank = value.nodes[0][0]  # one 0 for a whole vector, and the last row of a transformation
        return tuple(
            tuple(WrittenEntry(value, next(nodes, blank), changed) for value in row) for row in rows
        ), ()

    def _unfolded(self, name: str, value: AnswerValue) -> Rows | None:
        """The entries where rows that are zero for every q were left out, as of planar robots they may."""
        assert value.rows is not None
        quantity = self.graph.quantities.get(name)
        nodes = zip(value.rows, value.nodes, strict=True)
        written = [[WrittenEntry(v, n, self.changed) for v, n in zip(*row, strict=True)] for row in nodes]
        zero = WrittenEntry(RationalExpr(self.answer_ring.ring.zero), ZERO, self.changed)
        return None if quantity is None else unfolded(self.answer_ring, quantity, written, zero)

    def _misfit(self, value: AnswerValue, key: Any) -> Obstacle:
        assert value.rows is not None
        shape = key.shape if isinstance(key, Matrix | FractionMatrix) else (1, 1)
        wanted = f"a {shape[0]}×{shape[1]} matrix" if shape != (1, 1) else "a single expression"
        mine = (
            f"a {len(value.rows)}×{len(value.rows[0])} matrix" if value.is_matrix else "a single expression"
        )
        return Obstacle("shape", f"You wrote {mine}; {value.answer.name} is {wanted}.")

    def _coriolis(self, value: AnswerValue) -> tuple[Rows, tuple[Obstacle, ...]]:
        """C as its C q̇, n×1; a C with accelerations in it is none."""
        assert value.rows is not None
        n, ring = self.robot.n, self.answer_ring.ring
        zero = len(value.entries) == 1 and value.entries[0].is_zero
        if not zero and (len(value.rows) != n or len(value.rows[0]) != n):
            return (), (self._misfit(value, self.answer_ring.key("C")),)
        rows = []
        for row in value.nodes if not zero else ((value.nodes[0][0],) * n,) * n:
            factors = zip(row, ring.names, strict=True)
            node: Node = Sum(tuple(Product((entry, Symbol(name, 1))) for entry, name in factors))
            rows.append((WrittenEntry(self.changed(node), node, self.changed),))
        return tuple(rows), tuple(self._unfit(value))

    def _unfit(self, value: AnswerValue) -> Iterator[Obstacle]:
        """What no C may hold: accelerations, or joint variables in a denominator."""
        ring = self.answer_ring.ring
        accelerations = [ring.symbol(name, 2).poly.degrees() for name in ring.names]
        indices = [list(degrees).index(1) for degrees in accelerations]
        for entry in value.entries:
            expr = as_expr(entry)
            if expr is None:
                yield Obstacle("C_not_polynomial")
                return
            degrees = expr.poly.degrees() if expr.poly else ()
            if degrees and any(degrees[i] > 0 for i in indices):
                yield Obstacle("acceleration_in_C")
                return


def with_own_constraint(
    own: OwnConstraint, comparisons: Mapping[str, KeyComparison]
) -> dict[str, KeyComparison]:
    """The comparisons, those of A_c and its rate being right where they belong together."""
    found = dict(comparisons)
    for name, is_right in (("Ac", own.matrix), ("Ac_dot", own.rate)):
        compared = found.get(name)
        if compared is None or compared.answer_value.rows is None or not compared.rows:
            continue
        if not compared.correct or own.is_other:
            other = is_right(compared.answer_value.rows)
            if other or compared.correct:
                found[name] = _as_a_whole(compared, other)
        if name == "Ac" and found[name].correct:
            own.rows = compared.answer_value.rows
    return found


def _as_a_whole(compared: KeyComparison, other: str) -> KeyComparison:
    """A comparison of which every entry is right in another way, or wrong where that is empty."""
    right = tuple(tuple("" if other else None for _ in row) for row in compared.rows)
    return replace(compared, right=right, other=other)


def with_own_multipliers(
    own: OwnConstraint, comparisons: Mapping[str, KeyComparison], compare: KeyComparer, sides: Sequence[int]
) -> dict[str, KeyComparison]:
    """The comparisons, those of λ being right on one of these sides of the equations of motion.

    1 is the side of the key, D q̈ + C q̇ + g = τ + A_cᵀ λ, and -1 the other.
    """
    found = dict(comparisons)
    for name, compared in comparisons.items():
        if compared.target.node != "lambda" or compared.answer_value.rows is None or not compared.rows:
            continue
        tried = [_on_side(own, compared, compare, side) for side in (1, -1)]
        right = [one for side, one in zip((1, -1), tried, strict=True) if side in sides and one.correct]
        if right:
            found[name] = right[0]
        elif any(one.correct for one in tried):
            found[name] = replace(compared, obstacles=(Obstacle("multiplier_side"),))
        elif compared.correct:
            found[name] = tried[0]
        elif (missed := own.missed(_written(compared).values())) is not None:
            found[name] = replace(compared, missed=missed)
    return found


def _written(compared: KeyComparison) -> dict[int, RationalExpr]:
    """The multipliers of an answer by their places, from 0."""
    first = compared.target.entry[0] if compared.target.entry else 0
    return {first + k: row[0].value for k, row in enumerate(compared.rows)}


def _on_side(own: OwnConstraint, compared: KeyComparison, compare: KeyComparer, side: int) -> KeyComparison:
    """Multipliers as they are right on one side of the equations of motion."""
    told = OTHER_SIDE if side < 0 else ""
    if not own.is_other:
        if side > 0 and compared.correct:
            return compared
        key = compare.key(compared.target)
        wanted = map(fraction_of, key.entries if isinstance(key, Matrix | FractionMatrix) else (key,))
        right = tuple(
            (compare.compare(-w if side < 0 else w, row[0]),)
            for w, row in zip(wanted, compared.rows, strict=True)
        )
        if all(one is not None for (one,) in right):
            return replace(compared, right=right, other=told)
    other = own.multipliers(_written(compared), side)
    return _as_a_whole(compared, "; ".join(filter(None, (told, other))) if other else "")
