"""Naming the slip in an answer that is wrong.

What is explained is the difference between the answer and the value that the student's
own nearest answers lead to.  The explanations are tried in the order of `_IN_ORDER`, at
the end of this file, the nearest first.  Each brings its mend, and is told only where the
mend, put into the answer, gives exactly what is expected (`Explanation.holds`); where none
does, what differs is said, and no more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr, equal
from dynsolve.algebra.fraction_matrix import fraction_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.case import Case, Explanation, in_common, likeness
from dynsolve.answers.diagnosis.changed_rules import OF_THE_MATRIX, ChangedDerivation, DerivationSlips
from dynsolve.answers.diagnosis.differences import what_differs
from dynsolve.answers.diagnosis.exchanges import HEAVY, Exchanges, TermSlip
from dynsolve.answers.diagnosis.factors import FactorPairs
from dynsolve.answers.diagnosis.mends import Exchange, Mend, Redoing
from dynsolve.answers.diagnosis.one_place import ratio_of
from dynsolve.answers.diagnosis.parts import is_small, parts
from dynsolve.answers.diagnosis.slips import SLIPS, slip
from dynsolve.answers.diagnosis.steps import variants
from dynsolve.answers.diagnosis.substitution import substitutions
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.diagnosis.terms import TermDiagnoser
from dynsolve.answers.diagnosis.wrong_entry import DimensionCheck, WrongEntry
from dynsolve.answers.judging.entry_comparison import substituted
from dynsolve.answers.judging.follow_through import FollowThrough
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison, Target
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation.energy import velocities
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Node
from dynsolve.problem.model import Problem
from dynsolve.quantities import families

MOST_NAMED = 4
"""More slips than this in one answer are told as the terms that differ."""

MOST_OF_IT = Fraction(1, 2)
"""An answer with at least this share of the key's terms is compared with the key."""


class Diagnoser:
    """Names slips, the nearest that explains an answer.

    `derivation_slips` and `factors` are those of the answers' ring, which hand-ins share.
    """

    def __init__(
        self,
        problem: Problem,
        graph: AnswerGraph,
        follow_through: FollowThrough,
        derivation_slips: DerivationSlips,
        factors: FactorPairs,
    ) -> None:
        self.derivation_slips = derivation_slips
        self.factors = factors
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
    def exchanges(self) -> Exchanges:
        """Names slips in one place."""
        return Exchanges(self.ring, self.dimensions, self.words)

    @cached_property
    def terms(self) -> TermDiagnoser:
        """Finds slips in terms."""
        return TermDiagnoser(self.exchanges, self.factors)

    @cached_property
    def dimension_check(self) -> DimensionCheck:
        """Finds terms that cannot be added."""
        return DimensionCheck(self.graph, self.words, bool(self.problem.values))

    def __call__(self, wrong: WrongEntry) -> tuple[Diagnosis, ...]:
        """The slips in one scalar."""
        mine = wrong.mine
        if not all(isinstance(value, Expr) for value in wrong.expected):
            return tuple(_of_fractions(wrong))
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
            alike = likeness(mine, key)
            if alike >= MOST_OF_IT and alike > likeness(mine, nearest):
                return key
        return nearest

    def _named(self, wrong: WrongEntry, mine: Expr) -> Iterator[Diagnosis]:
        """What is told of an answer: the first explanation that holds, else what differs."""
        constant = self._is_constant(wrong, mine)
        if constant:
            yield slip("constant_term")
        case = Case(wrong, *self._with_numbers(mine, self.expected(wrong)))
        for explain in _IN_ORDER:
            found = next((one for one in explain(self, case) if one.holds(case)), None)
            if found is not None:
                told = found.told()
                yield from (
                    one for one in told if not (constant and one.code in ("missing_term", "extra_term"))
                )
                return
        if is_small(case.expected) and not constant:
            yield from what_differs(self.words, case.mine, case.expected)

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
        return max(choices, key=lambda pair: likeness(*pair))

    # -- one explanation after the other, see _IN_ORDER --------------------------------------------

    def _step_otherwise(self, case: Case) -> Iterator[Explanation]:
        """This step was done wrongly: a Jacobian at the frame's origin, a rule of d/dt left out."""
        node = case.wrong.target.node
        for value, diagnosis in self._variants(node):
            yield from self._redone(case, value, self._done_right(node), diagnosis)

    def _one_number(self, case: Case) -> Iterator[Explanation]:
        """One number for all of it: a sign, a factor."""
        mine, expected = case.mine, case.expected
        ratio = ratio_of(mine, expected)
        if ratio is None:
            return
        mend = Exchange(expected, self.ring.constant(ratio), self.ring.one)
        if ratio == -1:
            one_term = len(parts(mine)) == 1
            told = slip("sign", term=self.words.of(expected)) if one_term else slip("sign_all")
        else:
            told = slip("factor_all", part=self.words.number(ratio))
        yield self._told((mend,), self._refined(told, case.wrong))

    def _one_place(self, case: Case) -> Iterator[Explanation]:
        """One slip in one place: a lost square, a dropped mass, an index, a missing term."""
        one = self.terms.one_place(case.mine, case.expected)
        if one is not None and (
            one.weight < HEAVY or (one.code == "missing_term" and len(parts(one.mend.want)) == 1)
        ):
            yield from self._in_one_place(case, one)

    def _one_bracket(self, case: Case) -> Iterator[Explanation]:
        """A missing term that is several, multiplied out."""
        one = self.terms.one_place(case.mine, case.expected)
        if one is not None and one.code == "missing_term":
            yield from self._in_one_place(case, one)

    def _in_one_place(self, case: Case, one: TermSlip) -> Iterator[Explanation]:
        if one.code != "missing_term" or in_common(case.mine, case.expected):
            yield Explanation((one.mend,), lambda: [self.exchanges.told(one)])

    def _one_substitution(self, case: Case) -> Iterator[Explanation]:
        """One symbol, angle or function for another throughout: m₁ for m₂, θ₂ for θ₁ + θ₂."""
        for diagnosis, mend in substitutions(self.graph, self.words, case.mine, case.expected):
            yield self._told((mend,), self._refined(diagnosis, case.wrong))

    def _something_left_out(self, case: Case) -> Iterator[Explanation]:
        """Something was left out in an earlier step, and every step after it was done correctly."""
        return self._earlier_step(case, omits=True)

    def _earlier_step_otherwise(self, case: Case) -> Iterator[Explanation]:
        """An earlier step was done wrongly, and every step after it correctly."""
        return self._earlier_step(case, omits=False)

    def _earlier_step(self, case: Case, omits: bool) -> Iterator[Explanation]:
        key = self.graph.key(case.wrong.target.node)
        for value, diagnosis, changed in self.derivation_slips.values(case.wrong.target.node):
            if SLIPS[diagnosis.code].omits == omits:
                for found in self._redone(case, value, key, diagnosis):
                    if found.holds(case) and self._fits_the_rest(case.wrong, changed):
                        yield found

    def _several_terms(self, case: Case) -> Iterator[Explanation]:
        """One term too many; several slips in several terms, each named, where they are few.

        Missing terms are named only beside at least as many right ones, so that an answer 0 does not
        reveal the solution.
        """
        one = self.terms.one_place(case.mine, case.expected)
        found = [one] if one is not None else self.terms(case.mine, case.expected)
        found = sorted(found, key=lambda one: one.weight)
        missing = sum(one.code == "missing_term" for one in found)
        if sum(one.code == "trig_part" for one in found) > 1:
            return
        if 0 < len(found) <= MOST_NAMED and missing <= in_common(case.mine, case.expected):
            yield Explanation(tuple(one.mend for one in found), lambda: map(self.exchanges.told, found))

    def _told(self, all_of: tuple[Mend, ...], diagnosis: Diagnosis) -> Explanation:
        return Explanation(all_of, lambda: [diagnosis])

    def _redone(self, case: Case, value: Any, right: Any, diagnosis: Diagnosis) -> Iterator[Explanation]:
        """A step that gave `value` where it gives `right`; not what only a whole matrix can show."""
        before, after = case.wrong.at(value), case.wrong.at(right)
        if diagnosis.code not in OF_THE_MATRIX and before is not None and after is not None:
            yield self._told((Redoing(before, after),), self._refined(diagnosis, case.wrong))

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

    def _variants(self, node: str) -> Iterator[tuple[Any, Diagnosis]]:
        """The values that a step gives when it is done wrongly, from the student's own inputs."""
        if node in ("C", "christoffel"):
            return
        try:
            yield from variants(
                self.graph.robot,
                node,
                lambda name: self._done_right(name) if name == node else self.nearest(name),
            )
        except AlgebraError:  # inputs of the student's from which the step cannot be taken
            return

    def _done_right(self, node: str) -> Any:
        """The value that the student's own inputs of a step lead to."""
        derived = self.follow_through.derived(node) if self.follow_through.touched(node) else ()
        return derived[0].value if derived else self.graph.key(node)

    # -- matrices, differences ---------------------------------------------------------------------

    def whole(
        self, wrong: Sequence[WrongEntry], compared: KeyComparison, found: tuple[Diagnosis, ...]
    ) -> tuple[Diagnosis, ...]:
        """The slips of a matrix, given those of its entries: one for all, where one explains all.

        `wrong` are its entries that are wrong; each must be mended by it.
        """
        mine = [[as_expr(w.value) for w in row] for row in compared.rows]
        if len(mine) * len(mine[0]) == 1 or any(e is None for row in mine for e in row):
            return found
        given = Matrix.of(self.ring, [[e for e in row if e is not None] for row in mine])
        if all(entry.is_zero for entry in given.entries):
            return found
        if wrong[0].name == "C" and self._is_transposed_coriolis(compared):
            return (slip("transposed"),)
        for value, right, diagnosis in self._of_matrix(wrong[0], _is_explained(found)):
            if value == given and all(self._is_mended(entry, value, right) for entry in wrong):
                return (diagnosis, *(d for d in found if d.code == "dimensions"))
        return found

    def _of_matrix(self, wrong: WrongEntry, is_explained: bool) -> Iterator[tuple[Any, Any, Diagnosis]]:
        """What a matrix is under a slip, what it is without, and the slip.

        Where one slip in one place explains it, what was done otherwise long before is no nearer.
        """
        target = wrong.target
        right = target.of(self._done_right(target.node))
        for value, diagnosis in (*self._variants(target.node), *self._transposed(target)):
            yield target.of(value), right, diagnosis
        key = target.of(self.graph.key(target.node))
        for value, diagnosis, changed in self.derivation_slips.values(target.node):
            is_nearer = SLIPS[diagnosis.code].omits or not is_explained
            if is_nearer and self._fits_the_rest(wrong, changed):
                yield target.of(value), key, diagnosis

    def _is_mended(self, entry: WrongEntry, value: Any, right: Any) -> bool:
        """Whether a slip of the whole matrix explains one of its entries."""
        mine, wrong = entry.mine, value[entry.row, entry.column]
        redoing = Redoing(wrong, right[entry.row, entry.column])
        return mine is not None and redoing.applied(mine) == self.expected(entry)

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
        if mine is None or not all(isinstance(value, Expr) for value in wrong.expected):
            return None
        difference = mine - self.expected(wrong)
        return self.words.form(difference) if is_small(difference) else None


def _is_explained(found: Iterable[Diagnosis]) -> bool:
    """Whether one slip, and no list of what differs, was found in the entries of a matrix.

    A term that is doubled, or one too many, may have a cause that says more.
    """
    slips = [one.code for one in found if one.code != "dimensions"]
    return len(slips) == 1 and slips[0] not in _LISTS and slips[0] not in ("factor", "extra_term")


_LISTS = ("terms_differ", "terms_missing", "trig_part")
"""What says that something differs, and not why."""


def _of_fractions(wrong: WrongEntry) -> Iterator[Diagnosis]:
    """Where fractions are expected nothing is told but the wrong sign of all of it."""
    if any(equal(-fraction_of(value), wrong.written.value) for value in wrong.expected):
        yield slip("sign_all")


def _agree(changed: Any, own: Any, key: Any) -> bool:
    """Whether a slip changes nothing that is right, entry by entry: what it changes is as it was written."""
    if not isinstance(changed, Matrix) or not isinstance(own, Matrix) or changed.shape != own.shape:
        return True  # parameters may be as many as the student chose
    entries = zip(changed.entries, own.entries, key.entries, strict=True)
    return all(new in (right, mine) for new, mine, right in entries)


_IN_ORDER: tuple[Callable[[Diagnoser, Case], Iterator[Explanation]], ...] = (
    Diagnoser._step_otherwise,
    Diagnoser._one_number,
    Diagnoser._one_place,
    Diagnoser._one_substitution,
    Diagnoser._something_left_out,
    Diagnoser._one_bracket,
    Diagnoser._earlier_step_otherwise,
    Diagnoser._several_terms,
)
"""The explanations in the order in which they are tried: the first that holds is told."""
