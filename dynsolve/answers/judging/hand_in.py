"""One hand-in compared with the key: its answers by quantity, and which entries of each are right.

    answers -> values in one ring -> by quantity -> each compared with the key

A quantity may be given in several equations, and an equation may be a chain
`K = a = b = c`: the last member of the last equation counts.  Where a notation leaves
open which quantity is meant (I_1), it is the one that the value equals.  The zero of
height is the student's own, see `zero_height`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.answer_values import AnswerValue, AnswerValues
from dynsolve.answers.judging.entry_comparison import EntryComparer
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparer, KeyComparison
from dynsolve.answers.judging.moved_multipliers import with_moved_multipliers
from dynsolve.answers.judging.own_constraint import OwnConstraint, with_own_constraint
from dynsolve.answers.judging.own_parameters import as_matrix, own_parameters
from dynsolve.answers.judging.zero_height import potential_at_zero_height
from dynsolve.answers.submission import Answer
from dynsolve.notation import tree
from dynsolve.notation.walk import names_in, walk
from dynsolve.quantities.model_families import PARAMETERS, REFERENCE, REGRESSORS

IN_NUMBERS = "it repeats the answer with numbers, which the problem does not give"

LARGEST = 4
"""The largest numerator and denominator of the numbers that the formulas of mechanics have."""

Chain = list[AnswerValue]
"""The members of one equation."""


class ComparedHandIn:
    """The answers of one hand-in, compared with the key.

    `answer_ring` is the problem's, extended by what the answers need; `compare_entry` compares
    scalars, by the numbers of the problem file too.  `chains` has the equations of each quantity,
    `comparisons` the comparison of the answer that counts; `definitions` has the equations that
    need what is given nowhere, which are none of the answers.
    """

    def __init__(
        self, answer_ring: AnswerRing, compare_entry: EntryComparer, answers: Sequence[Answer]
    ) -> None:
        values = AnswerValues(answer_ring, answers)
        self.answer_ring = values.answer_ring
        self.compare_entry = compare_entry
        at_keys_height = KeyComparer(values.graph, self.compare_entry, values.changed)
        found = self._without_repetitions(values.all)
        self.chains = _by_quantity([v for v in found if not v.is_definition], at_keys_height)
        self.definitions = _by_quantity([v for v in found if v.is_definition], at_keys_height)
        energies = dict(self._energies())
        potential = potential_at_zero_height(self.answer_ring, energies, self.answer_ring.dimensions)
        self.graph = AnswerGraph(self.answer_ring, potential, self._own_parameters())
        self.compare = KeyComparer(self.graph, self.compare_entry, values.changed)
        compared = {name: self.compare(name, last(chains)) for name, chains in self.chains.items()}
        self.comparisons = (
            self._on_constraint(compared) if self.graph.robot.questions.constraints else compared
        )
        self.assembled_coriolis = self._assembled_coriolis()

    def _without_repetitions(self, values: Sequence[AnswerValue]) -> list[AnswerValue]:
        """The values, those set aside that repeat an answer with numbers which the problem does not give."""
        parameters = set(self.answer_ring.robot.parameters)
        held = [names_in(*(node for row in value.nodes for node in row)) & parameters for value in values]
        unknown = {
            value.answer.name
            for value, names in zip(values, held, strict=True)
            if not names <= self.compare_entry.values.keys()
        }
        return [
            replace(value, is_definition=True, fault=IN_NUMBERS)
            if value.answer.name in unknown and not names and _has_measured_number(value)
            else value
            for value, names in zip(values, held, strict=True)
        ]

    def _on_constraint(self, compared: Mapping[str, KeyComparison]) -> dict[str, KeyComparison]:
        """The comparisons where the student may choose the matrix of the constraint, and where λ stands."""
        own = OwnConstraint(self.graph)
        return with_moved_multipliers(own, with_own_constraint(own, compared), self.compare)

    def _own_parameters(self) -> Mapping[str, Matrix]:
        """The parameters a of τ = Y a that the student chose."""
        asked = PARAMETERS.keys() | REGRESSORS.keys() | {REFERENCE}
        if not self.chains.keys() & asked:
            return {}
        values = {name: last(self.chains[name]) for name in self.chains.keys() & asked}
        written = {name: matrix for name, value in values.items() if (matrix := as_matrix(value, name))}
        return own_parameters(self.answer_ring, written)

    def _energies(self) -> Iterator[tuple[str, Expr]]:
        """The student's P_i, P and L, where they are expressions of the ring."""
        bodies = self.answer_ring.robot.bodies
        names = {"P", "L"} | {f"P{body.name}" for body in bodies}
        for name in names & self.chains.keys() if bodies else ():
            value = last(self.chains[name])
            if value.rows is not None and len(value.entries) == 1:
                expr = as_expr(value.entries[0])
                if expr is not None:
                    yield name, expr

    def _assembled_coriolis(self) -> KeyComparison | None:
        """C put together from its entries, where all of them were given and C was not.

        Many matrices C give the same C q̇: the entries are right or wrong a row at a time.
        """
        n = self.answer_ring.robot.n
        if "C" in self.comparisons or not n:
            return None
        rows: list[Chain] = []
        for i in range(n):
            row = [self.comparisons.get(f"C{i + 1}{j + 1}") for j in range(n)]
            found = [
                entry.answer_value
                for entry in row
                if entry is not None and entry.answer_value.rows is not None
            ]
            if len(found) < n or any(len(value.entries) != 1 for value in found):
                return None
            rows.append(found)
        node = tree.Matrix(tuple(tuple(value.nodes[0][0] for value in row) for row in rows))
        answer = replace(rows[0][0].answer, name="C", node=node)
        values = tuple(tuple(value.entries[0] for value in row) for row in rows)
        return self.compare("C", AnswerValue(answer, values, node.rows))


def _has_measured_number(value: AnswerValue) -> bool:
    """Whether a number stands in a value that no formula of mechanics has of itself, as 9.81 and 3.5."""
    parts = (part for row in value.nodes for node in row for part in walk(node))
    return any(isinstance(p, tree.Number) and (abs(p.p) > LARGEST or p.q > LARGEST) for p in parts)


def last(chains: Sequence[Chain]) -> AnswerValue:
    """The answer that counts of those given for one quantity: the last member of the last equation."""
    return chains[-1][-1]


def _by_quantity(values: Sequence[AnswerValue], compare: KeyComparer) -> dict[str, list[Chain]]:
    """The equations of each quantity, in the order of the hand-in."""
    found: dict[str, list[Chain]] = {}
    for value in values:
        chains = found.setdefault(_quantity(value, compare), [])
        if chains and chains[-1][0].answer.occurrence[0] == value.answer.occurrence[0]:
            chains[-1].append(value)
        else:
            chains.append([value])
    return found


def _quantity(value: AnswerValue, compare: KeyComparer) -> str:
    """The name of the quantity that is meant: of several that the notation allows, the one it equals."""
    answer = value.answer
    for name in (answer.name, *answer.alternatives) if answer.alternatives and value.rows else ():
        if compare(name, value).correct:
            return name
    rules = compare.answer_ring.rules
    known = (name for name in (answer.name, *answer.alternatives) if compare.target(name).node in rules)
    return compare.graph.answer(next(known, answer.name))
