"""Naming the slip in an answer that is wrong.

What is explained is the difference between the answer and the value that the student's
own nearest answers lead to.  The explanations are tried in the order of `_IN_ORDER`, at
the end of this file; the first that leads exactly to the answer is told, so that the
simplest wins.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import islice
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.changed_rules import OF_THE_MATRIX, DerivationSlips
from dynsolve.answers.diagnosis.fourier import is_small, monomial_expr, monomials
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.steps import variants
from dynsolve.answers.diagnosis.substitution import substitutions
from dynsolve.answers.diagnosis.term_slips import LIGHT, TermSlip, tell
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.diagnosis.terms import TermDiagnoser
from dynsolve.answers.judging.entry_comparison import WrittenEntry
from dynsolve.answers.judging.follow_through import FollowThrough
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Diagnosis
from dynsolve.notation.tree import Node
from dynsolve.problem.model import Problem
from dynsolve.quantities import families
from dynsolve.quantities.index import Quantity
from dynsolve.robot.units import Dimension, describe

MOST_OF_IT = Fraction(1, 2)
"""What shares so much of its terms with the key was taken from it, not from a slip before it."""


@dataclass(frozen=True, slots=True)
class WrongEntry:
    """One scalar that is wrong: what was written, and what its own inputs lead to, the nearest first.

    The last one that is expected is the key.
    """

    name: str
    target: Any
    written: WrittenEntry
    expected: tuple[Expr, ...]
    row: int = 0
    column: int = 0

    @property
    def mine(self) -> Expr | None:
        """The answer as an element of the ring."""
        return as_expr(self.written.value)


@dataclass(frozen=True)
class _Case:
    """An answer that is wrong, as an element of the ring, and the value that it is held against."""

    wrong: WrongEntry
    mine: Expr
    expected: Expr
    find_slips: TermDiagnoser

    @cached_property
    def term_slips(self) -> list[TermSlip]:
        """The slips in single terms, none where there are too many terms to look for them."""
        return self.find_slips(self.mine, self.expected) or []


class Diagnoser:
    """Names slips, the simplest that explains an answer."""

    def __init__(
        self,
        problem: Problem,
        graph: AnswerGraph,
        follow: FollowThrough,
        derivation_slips: DerivationSlips,
    ) -> None:
        self.derivation_slips = derivation_slips
        self.problem = problem
        self.graph = graph
        self.follow = follow
        self.dimensions = graph.field.dimensions
        self.ring = graph.field.ring

    @cached_property
    def words(self) -> TermWriter:
        """Writes terms in messages."""
        words = TermWriter(self.graph.field)
        words.problem_symbols({*self.problem.robot.ring.parameters, *self.ring.names, "pi"})
        return words

    @cached_property
    def terms(self) -> TermDiagnoser:
        """Finds slips in terms."""
        return TermDiagnoser(self.ring, self.dimensions, self.words)

    def __call__(self, question: WrongEntry) -> tuple[Diagnosis, ...]:
        """The slips in one scalar."""
        mine = question.mine
        if mine is None or not is_small(mine):
            return ()
        found = tuple(dict.fromkeys(self._named(question, mine)))
        return (*found, *(d for d in self._misfits(question, mine) if d not in found))

    def expected(self, question: WrongEntry) -> Expr:
        """The nearest value that the answer may be held against: one whose terms can be added.

        What follows from a term that cannot be added tells nobody how to mend this one.
        Nor does what an answer was plainly not taken from: where most of it is the key's,
        and less of it is what its own inputs lead to, it is held against the key.
        """
        nearest, key = self._nearest_fit(question), question.expected[-1]
        mine = question.mine
        if mine is not None and nearest is not key:
            likeness = _likeness(mine, key)
            if likeness >= MOST_OF_IT and likeness > _likeness(mine, nearest):
                return key
        return nearest

    def _nearest_fit(self, question: WrongEntry) -> Expr:
        wanted = self._dimension(question)
        if wanted is not None and not self.problem.values:
            for value in question.expected:
                if self.dimensions.fits(value, wanted):
                    return value
        return question.expected[0]

    def _named(self, question: WrongEntry, mine: Expr) -> Iterator[Diagnosis]:
        if self._is_constant(question, mine):
            yield slip("constant_term")
        case = _Case(question, mine, self.expected(question), self.terms)
        explained = (tuple(explain(self, case)) for explain in _IN_ORDER)
        yield from next(filter(None, explained), ())

    # -- one explanation after the other, see _IN_ORDER --------------------------------------------

    def _step_otherwise(self, case: _Case) -> Iterator[Diagnosis]:
        """The step itself done otherwise: a Jacobian at the frame's origin, a rule of d/dt left out."""
        found = self._first_of(self._variants(case.wrong, case.wrong.target.node), case.wrong, case.mine)
        if found is not None:
            yield self._refined(found, case.wrong)

    def _one_number(self, case: _Case) -> Iterator[Diagnosis]:
        """One number for all of it: a sign, a factor."""
        found = self.terms.whole(case.mine, case.expected)
        if found is not None:
            yield self._refined(found, case.wrong)

    def _one_substitution(self, case: _Case) -> Iterator[Diagnosis]:
        """One symbol, angle or function for another throughout: m₁ for m₂, θ₂ for θ₁ + θ₂."""
        for found in islice(substitutions(self.graph, self.words, case.mine, case.expected), 1):
            yield self._refined(found, case.wrong)

    def _one_term(self, case: _Case) -> Iterator[Diagnosis]:
        """One slip in one term: a lost square, a dropped mass."""
        if len(case.term_slips) == 1 and case.term_slips[0].weight < LIGHT:
            yield case.term_slips[0].diagnosis

    def _earlier_step_otherwise(self, case: _Case) -> Iterator[Diagnosis]:
        """A step long before done otherwise, and everything after it as it should be."""
        found = self._first_of(self._derived(case.wrong, case.mine), case.wrong, case.mine)
        if found is not None:
            yield found

    def _several_terms(self, case: _Case) -> Iterator[Diagnosis]:
        """Several slips in several terms, each named; where they are too many, which terms differ."""
        yield from tell(case.term_slips, _in_common(case.mine, case.expected))

    def _first_of(
        self, values: Iterator[tuple[Any, Diagnosis]], question: WrongEntry, mine: Expr
    ) -> Diagnosis | None:
        """The first slip that gives what was written; one entry alone shows no slip of its matrix."""
        return next(
            (
                told
                for value, told in values
                if told.code not in OF_THE_MATRIX and self._at(question, value) == mine
            ),
            None,
        )

    def _derived(self, question: WrongEntry, *mine: Expr) -> Iterator[tuple[Any, Diagnosis]]:
        """What an earlier step done otherwise makes of a node; 0 is explained by what is left out alone."""
        is_zero = all(value.is_zero for value in mine)
        for value, told in self.derivation_slips.values(question.target.node):
            if not is_zero or told.code.endswith("_missing"):
                yield value, told

    def _refined(self, one: Diagnosis, question: WrongEntry) -> Diagnosis:
        """A wrong sign of everything that is gravity is gravity's."""
        quantity = self._quantity(question)
        is_gravity = quantity is not None and quantity.family in (families.P_BODY, families.P, families.G)
        if is_gravity and one.code in ("sign", "sign_all"):
            return slip("gravity_sign")
        return one

    # -- the step, the derivation ------------------------------------------------------------------

    def nearest(self, node: str) -> Any:
        """A node's value from the student's own nearest answers: their own where there is one."""
        choices = self.follow.choices(node)
        value = choices[0].value if choices else None
        return self.graph.key(node) if value is None else value

    def _variants(self, question: WrongEntry, node: str) -> Iterator[tuple[Any, Diagnosis]]:
        if node in ("C", "christoffel"):
            return

        def value(name: str) -> Any:
            if name == node:  # of a whole, the value that its inputs lead to
                derived = self.follow.derived(name)
                return derived[0].value if derived else self.graph.key(name)
            return self.nearest(name)

        try:
            yield from variants(self.graph.robot, node, value)
        except Exception:  # noqa: BLE001  inputs of the student's from which the step cannot be taken
            return

    def _at(self, question: WrongEntry, value: Any) -> Expr | None:
        found = question.target.of(value)
        if isinstance(found, Matrix):
            rows, columns = found.shape
            if question.row >= rows or question.column >= columns:
                return None
            return found[question.row, question.column]
        return found if isinstance(found, Expr) else None

    # -- constants, dimensions ---------------------------------------------------------------------

    def _is_constant(self, question: WrongEntry, mine: Expr) -> bool:
        """Whether a potential energy differs by a constant only."""
        quantity = self._quantity(question)
        if quantity is None or quantity.family not in (families.P_BODY, families.P, families.L):
            return False
        difference = mine - self.expected(question)
        return not difference.is_zero and not self.ring.depends_on_coordinates(difference)

    def _misfits(self, question: WrongEntry, mine: Expr) -> Iterator[Diagnosis]:
        """Terms that cannot be added to the others."""
        wanted = self._dimension(question)
        if wanted is None or not self.dimensions.known or self.problem.values:
            return
        terms = [monomial_expr(self.ring, m) for m in monomials(mine)] if is_small(mine) else []
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

    def _dimension(self, question: WrongEntry) -> Dimension | None:
        """The dimension of an answer, None where nothing is told of it."""
        quantity = self._quantity(question)
        if quantity is None or not quantity.family.dimension_is_told:
            return None
        place = question.target.entry or (question.row, question.column)
        return self.graph.quantities.dimension(quantity, place[0], place[1])

    def _quantity(self, question: WrongEntry) -> Quantity | None:
        """What the answer is, or is an entry of."""
        return self.graph.quantities.of_rule(question.target.node)

    # -- matrices, differences ---------------------------------------------------------------------

    def whole(self, question: WrongEntry, held: Any, found: tuple[Diagnosis, ...]) -> tuple[Diagnosis, ...]:
        """The slips of a matrix, given those of its entries: one for all, where one explains all."""
        mine = [[as_expr(w.value) for w in row] for row in held.rows]
        if len(mine) * len(mine[0]) == 1 or any(e is None for row in mine for e in row):
            return found
        target = question.target
        given = Matrix.of(self.ring, [[e for e in row if e is not None] for row in mine])
        candidates = [*self._variants(question, target.node), *self._transposed(target)]
        for value, told in candidates:
            if _same(target.of(value), given):
                return (told, *(d for d in found if d.code == "dimensions"))
        for value, told in self._derived(question, *given.entries):
            if _same(target.of(value), given):
                return (told, *(d for d in found if d.code == "dimensions"))
        return found

    def _transposed(self, target: Any) -> Iterator[tuple[Any, Diagnosis]]:
        right = target.of(self.graph.key(target.node))
        if isinstance(right, Matrix) and right.shape[0] == right.shape[1] > 1:
            yield right.T, slip("transposed")

    def difference(self, question: WrongEntry) -> Node | None:
        """The answer minus what was expected, in compact form."""
        mine = question.mine
        if mine is None:
            return None
        difference = mine - self.expected(question)
        return self.words.form(difference) if is_small(difference) else None


def _in_common(a: Expr, b: Expr) -> int:
    """How many terms two values share."""
    if not a.poly or not b.poly:
        return 0
    return len(a.poly.to_dict().items() & b.poly.to_dict().items())


def _likeness(a: Expr, b: Expr) -> Fraction:
    """The share of the terms of two values that they have in common."""
    same = _in_common(a, b)
    return Fraction(same, max(len(a) + len(b) - same, 1))


def _same(a: Any, b: Matrix) -> bool:
    return (
        isinstance(a, Matrix)
        and a.shape == b.shape
        and all(x == y for x, y in zip(a.entries, b.entries, strict=True))
    )


_IN_ORDER: tuple[Callable[[Diagnoser, _Case], Iterator[Diagnosis]], ...] = (
    Diagnoser._step_otherwise,
    Diagnoser._one_number,
    Diagnoser._one_substitution,
    Diagnoser._one_term,
    Diagnoser._earlier_step_otherwise,
    Diagnoser._several_terms,
)
"""The explanations in the order in which they are tried: the first that explains an answer is told."""
