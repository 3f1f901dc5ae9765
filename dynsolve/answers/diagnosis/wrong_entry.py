"""What is diagnosed: one scalar that is wrong, and whether its terms can be added at all."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.fraction_matrix import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.numbers import has_a_plain_number
from dynsolve.answers.diagnosis.parts import is_small, monomial_expr, parts
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.judging.entry_comparison import WrittenEntry
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import Target
from dynsolve.answers.verdict import Diagnosis
from dynsolve.quantities.index import Quantity
from dynsolve.robot.units import Dimension, describe


@dataclass(frozen=True, slots=True)
class WrongEntry:
    """One scalar that is wrong: what was written, and what its own inputs lead to, the nearest first.

    The last one that is expected is the key.  `called` is what a message calls it.
    """

    name: str
    target: Target
    written: WrittenEntry
    expected: tuple[Expr, ...]
    row: int = 0
    column: int = 0
    called: str = "Your answer"

    @property
    def mine(self) -> Expr | None:
        """The answer as an element of the ring."""
        return as_expr(self.written.value)

    def at(self, value: Any) -> Expr | None:
        """What a value of the node has at the place of this scalar, None where it has no such place."""
        found = self.target.of(value)
        if isinstance(found, Matrix | FractionMatrix):
            rows, columns = found.shape
            if self.row >= rows or self.column >= columns:
                return None
            found = found[self.row, self.column]
        return found if isinstance(found, Expr) else None


class DimensionCheck:
    """Finds terms that cannot be added: masses, lengths and times have units by their role.

    Where the problem gives numbers for symbols a term may lack its unit, and nothing is told; nor of a
    term with another number than ½ or 2, which may stand for a letter.
    """

    def __init__(self, graph: AnswerGraph, words: TermWriter, has_numbers: bool) -> None:
        self.graph = graph
        self.ring = graph.answer_ring.ring
        self.dimensions = graph.answer_ring.dimensions
        self.words = words
        self.has_numbers = has_numbers

    def first_that_fits(self, wrong: WrongEntry) -> Expr:
        """The nearest of the expected values whose terms can be added."""
        wanted = self.dimension(wrong)
        if wanted is not None and not self.has_numbers:
            for value in wrong.expected:
                if self.dimensions.fits(value, wanted):
                    return value
        return wrong.expected[0]

    def __call__(self, question: WrongEntry, mine: Expr) -> Iterator[Diagnosis]:
        """Terms that cannot be added to the others."""
        wanted = self.dimension(question)
        if wanted is None or not self.dimensions.known or self.has_numbers:
            return
        if not self.dimensions.fits(question.expected[-1], wanted):
            return
        by_monomial = parts(mine) if is_small(mine) else {}
        terms = [monomial_expr(self.ring, m) for m, term in by_monomial.items() if has_a_plain_number(term)]
        known = [(term, found) for term in terms if (found := self.dimensions.of(term)) is not None]
        for term, found in known:
            if found != wanted:
                mixed = any(other != found for _, other in known)
                how = "but it is added to what is" if mixed else "where this should be"
                yield slip(
                    "dimensions",
                    term=self.words.of(term),
                    part=describe(found),
                    how=how,
                    other=describe(wanted),
                )
                return

    def dimension(self, question: WrongEntry) -> Dimension | None:
        """The dimension of an answer, None where nothing is told of it."""
        quantity = self.quantity(question)
        if quantity is None or not quantity.family.dimension_is_told:
            return None
        place = question.target.entry or (question.row, question.column)
        return self.graph.quantities.dimension(quantity, place[0], place[1])

    def quantity(self, question: WrongEntry) -> Quantity | None:
        """What the answer is, or is an entry of."""
        return self.graph.quantities.of_rule(question.target.node)
