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
from dynsolve.answers.diagnosis.changed_rules import OF_THE_MATRIX, ChangedDerivation, DerivationSlips
from dynsolve.answers.diagnosis.fourier import is_small
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.steps import variants
from dynsolve.answers.diagnosis.substitution import substitutions
from dynsolve.answers.diagnosis.term_slips import LIGHT, TermSlip, tell
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.diagnosis.terms import TermDiagnoser
from dynsolve.answers.diagnosis.wrong_entry import DimensionCheck, WrongEntry
from dynsolve.answers.judging.entry_comparison import substituted
from dynsolve.answers.judging.follow_through import FollowThrough
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison, Target
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation.energy import velocities
from dynsolve.notation.tree import Node
from dynsolve.problem.model import Problem
from dynsolve.quantities import families

MOST_OF_IT = Fraction(1, 2)
"""An answer with at least this share of the key's terms is compared with the key."""


@dataclass(frozen=True)
class _Case:
    """An answer that is wrong, as an element of the ring, and the value that it is compared with."""

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
        follow_through: FollowThrough,
        derivation_slips: DerivationSlips,
    ) -> None:
        self.derivation_slips = derivation_slips
        self._leading: dict[str, frozenset[str]] = {}
        self.problem = problem
        self.graph = graph
        self.follow_through = follow_through
        self.dimensions = graph.answer_ring.dimensions
        self.ring = graph.answer_ring.ring

    @cached_property
    def words(self) -> TermWriter:
        """Writes terms in messages."""
        words = TermWriter(self.graph.answer_ring)
        words.problem_symbols({*self.problem.robot.ring.parameters, *self.ring.names, "pi"})
        return words

    @cached_property
    def terms(self) -> TermDiagnoser:
        """Finds slips in terms."""
        return TermDiagnoser(self.ring, self.dimensions, self.words)

    @cached_property
    def dimension_check(self) -> DimensionCheck:
        """Finds terms that cannot be added."""
        return DimensionCheck(self.graph, self.words, bool(self.problem.values))

    def __call__(self, wrong: WrongEntry) -> tuple[Diagnosis, ...]:
        """The slips in one scalar."""
        mine = wrong.mine
        if mine is None or not is_small(mine):
            return ()
        found = tuple(dict.fromkeys(self._named(wrong, mine)))
        return (*found, *(d for d in self.dimension_check(wrong, mine) if d not in found))

    def expected(self, wrong: WrongEntry) -> Expr:
        """The nearest value that the answer may be compared with: one whose terms can be added.

        Where it has more of the key's terms than of that value's, and most of them, it was
        not taken from the student's own inputs, and is compared with the key.
        """
        nearest, key = self.dimension_check.first_that_fits(wrong), wrong.expected[-1]
        mine = wrong.mine
        if mine is not None and nearest is not key:
            likeness = _likeness(mine, key)
            if likeness >= MOST_OF_IT and likeness > _likeness(mine, nearest):
                return key
        return nearest

    def _named(self, wrong: WrongEntry, mine: Expr) -> Iterator[Diagnosis]:
        if self._is_constant(wrong, mine):
            yield slip("constant_term")
        case = _Case(wrong, *self._with_numbers(mine, self.expected(wrong)), self.terms)
        explained = (tuple(explain(self, case)) for explain in _IN_ORDER)
        yield from next(filter(None, explained), ())

    def _with_numbers(self, mine: Expr, expected: Expr) -> tuple[Expr, Expr]:
        """Both with the numbers of the problem file, as far as the answer has numbers for symbols."""
        indices = self.ring.symbol_indices
        put = {indices[name, 0]: value for name, value in self.problem.values.items() if (name, 0) in indices}
        if not put or not mine.poly:
            return mine, expected
        degrees = mine.poly.degrees()
        unused = {i: value for i, value in put.items() if degrees[i] <= 0}
        choices = [
            (mine, expected),
            (mine, substituted(expected, unused)),
            (substituted(mine, put), substituted(expected, put)),
        ]
        return max(choices, key=lambda pair: _likeness(*pair))

    # -- one explanation after the other, see _IN_ORDER --------------------------------------------

    def _step_otherwise(self, case: _Case) -> Iterator[Diagnosis]:
        """This step was done wrongly: a Jacobian at the frame's origin, a rule of d/dt left out."""
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
        if len(case.term_slips) == 1:
            (one,) = case.term_slips
            is_seen = one.code == "missing_term" and _in_common(case.mine, case.expected) > 0
            if one.weight < LIGHT or is_seen:
                yield one.diagnosis

    def _earlier_step_otherwise(self, case: _Case) -> Iterator[Diagnosis]:
        """An earlier step was done wrongly, and every step after it correctly."""
        for value, diagnosis, changed in self._derived(case.wrong, case.mine):
            is_it = diagnosis.code not in OF_THE_MATRIX and case.wrong.at(value) == case.mine
            if is_it and self._fits_the_rest(case.wrong, changed):
                yield diagnosis
                return

    def _several_terms(self, case: _Case) -> Iterator[Diagnosis]:
        """Several slips in several terms, each named; where they are too many, which terms differ."""
        yield from tell(case.term_slips, _in_common(case.mine, case.expected))

    def _first_of(
        self, values: Iterator[tuple[Any, Diagnosis]], wrong: WrongEntry, mine: Expr
    ) -> Diagnosis | None:
        """The first slip that gives what was written, without those that only a whole matrix can show."""
        return next(
            (
                diagnosis
                for value, diagnosis in values
                if diagnosis.code not in OF_THE_MATRIX and wrong.at(value) == mine
            ),
            None,
        )

    def _fits_the_rest(self, wrong: WrongEntry, changed: ChangedDerivation) -> bool:
        """Whether a slip of an earlier step agrees with all that the student wrote on the way.

        What the student's own answer holds was not left out.
        """
        node = wrong.target.node
        for name, own in self.follow_through.students.items():
            if own.value is None or not changed.reached(name):
                continue
            if name == node:
                if not _agree(changed(name), own.value, self.graph.key(name)):
                    return False
            elif name in self._before(node) and changed(name) != own.value:
                return False
        return True

    def _before(self, node: str) -> frozenset[str]:
        """The nodes that lead to a node."""
        if node not in self._leading:
            self._leading[node] = frozenset()
            inputs = {name for route in self.graph.routes(node) for name in route.inputs}
            self._leading[node] = frozenset(inputs).union(*map(self._before, inputs))
        return self._leading[node]

    def _derived(self, wrong: WrongEntry, *mine: Expr) -> Iterator[tuple[Any, Diagnosis, ChangedDerivation]]:
        """The values of a node under slips of earlier steps; for an answer 0, those that omit something."""
        is_zero = all(value.is_zero for value in mine)
        for found in self.derivation_slips.values(wrong.target.node):
            if not is_zero or found[1].code.endswith("_missing"):
                yield found

    def _refined(self, one: Diagnosis, wrong: WrongEntry) -> Diagnosis:
        """A wrong sign of a potential energy, or of g, is the wrong sign of gravity."""
        quantity = self.dimension_check.quantity(wrong)
        is_gravity = quantity is not None and quantity.family in (families.P_BODY, families.P, families.G)
        if is_gravity and one.code in ("sign", "sign_all"):
            return slip("gravity_sign")
        return one

    def _is_constant(self, wrong: WrongEntry, mine: Expr) -> bool:
        """Whether a potential energy differs by a constant only."""
        quantity = self.dimension_check.quantity(wrong)
        if quantity is None or quantity.family not in (families.P_BODY, families.P, families.L):
            return False
        difference = mine - self.expected(wrong)
        return not difference.is_zero and not self.ring.depends_on_coordinates(difference)

    # -- the step, the derivation ------------------------------------------------------------------

    def nearest(self, node: str) -> Any:
        """The student's own value of a node, or the value that their nearest answers lead to."""
        choices = self.follow_through.choices(node)
        value = choices[0].value if choices else None
        return self.graph.key(node) if value is None else value

    def _variants(self, wrong: WrongEntry, node: str) -> Iterator[tuple[Any, Diagnosis]]:
        if node in ("C", "christoffel"):
            return

        def value(name: str) -> Any:
            if name == node:  # of a whole, the value that its inputs lead to
                derived = self.follow_through.derived(name)
                return derived[0].value if derived else self.graph.key(name)
            return self.nearest(name)

        try:
            yield from variants(self.graph.robot, node, value)
        except Exception:  # noqa: BLE001  inputs of the student's from which the step cannot be taken
            return

    # -- matrices, differences ---------------------------------------------------------------------

    def whole(
        self, wrong: WrongEntry, compared: KeyComparison, found: tuple[Diagnosis, ...]
    ) -> tuple[Diagnosis, ...]:
        """The slips of a matrix, given those of its entries: one for all, where one explains all."""
        mine = [[as_expr(w.value) for w in row] for row in compared.rows]
        if len(mine) * len(mine[0]) == 1 or any(e is None for row in mine for e in row):
            return found
        target = wrong.target
        given = Matrix.of(self.ring, [[e for e in row if e is not None] for row in mine])
        if wrong.name == "C" and self._is_transposed_coriolis(compared):
            return (slip("transposed"),)
        candidates = [*self._variants(wrong, target.node), *self._transposed(target)]
        for value, diagnosis in candidates:
            if target.of(value) == given:
                return (diagnosis, *(d for d in found if d.code == "dimensions"))
        for value, diagnosis, changed in self._derived(wrong, *given.entries):
            if target.of(value) == given and self._fits_the_rest(wrong, changed):
                return (diagnosis, *(d for d in found if d.code == "dimensions"))
        return found

    def _transposed(self, target: Target) -> Iterator[tuple[Any, Diagnosis]]:
        right = target.of(self.graph.key(target.node))
        if isinstance(right, Matrix) and right.shape[0] == right.shape[1] > 1:
            yield right.T, slip("transposed")

    def _is_transposed_coriolis(self, compared: KeyComparison) -> bool:
        """Whether the transpose of C gives the right C q̇."""
        rows = compared.answer_value.rows or ()
        n = self.graph.robot.n
        mine = [as_expr(entry) for row in rows for entry in row]
        if len(mine) != n * n or any(entry is None for entry in mine):
            return False
        C = Matrix.of(self.ring, [[e for e in mine[k::n] if e is not None] for k in range(n)])
        return bool(C @ velocities(self.graph.robot) == self.graph.key("Cqd"))

    def difference(self, wrong: WrongEntry) -> Node | None:
        """The answer minus what was expected, in compact form."""
        mine = wrong.mine
        if mine is None:
            return None
        difference = mine - self.expected(wrong)
        return self.words.form(difference) if is_small(difference) else None


def _agree(changed: Any, own: Any, key: Any) -> bool:
    """Whether a slip changes nothing that is right, entry by entry: what it changes is as it was written."""
    if not isinstance(changed, Matrix) or not isinstance(own, Matrix):
        return True
    entries = zip(changed.entries, own.entries, key.entries, strict=True)
    return all(new in (right, mine) for new, mine, right in entries)


def _in_common(a: Expr, b: Expr) -> int:
    """How many terms two values share."""
    if not a.poly or not b.poly:
        return 0
    return len(a.poly.to_dict().items() & b.poly.to_dict().items())


def _likeness(a: Expr, b: Expr) -> Fraction:
    """The share of the terms of two values that they have in common."""
    same = _in_common(a, b)
    return Fraction(same, max(len(a) + len(b) - same, 1))


_IN_ORDER: tuple[Callable[[Diagnoser, _Case], Iterator[Diagnosis]], ...] = (
    Diagnoser._step_otherwise,
    Diagnoser._one_number,
    Diagnoser._one_substitution,
    Diagnoser._one_term,
    Diagnoser._earlier_step_otherwise,
    Diagnoser._several_terms,
)
"""The explanations in the order in which they are tried: the first that explains an answer is told."""
