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
from itertools import chain, zip_longest
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.fraction import RationalExpr, as_expr, cancelled, equal, is_zero
from dynsolve.algebra.linear_systems import fraction_of
from dynsolve.algebra.ring import Expr
from dynsolve.answers.diagnosis.exchanges import (
    HEAVY,
    Exchanges,
    TermDiagnoser,
    TermSlip,
    multiplied,
    ratio_of,
)
from dynsolve.answers.diagnosis.factors import FactorPairs
from dynsolve.answers.diagnosis.mends import (
    Exchange,
    Mend,
    Redoing,
    Renaming,
    in_common,
    is_small,
    likeness,
    mends,
    parts,
)
from dynsolve.answers.diagnosis.own_steps import OF_THE_MATRIX, DerivationSlips, MatrixDiagnoser, OwnSteps
from dynsolve.answers.diagnosis.slips import SLIPS, slip
from dynsolve.answers.diagnosis.substitution import substitutions, throughout
from dynsolve.answers.diagnosis.wrong_entry import (
    DimensionCheck,
    TermWriter,
    WrongEntry,
    number_for_a_letter,
    what_differs,
)
from dynsolve.answers.judging.entry_comparison import placed, substituted
from dynsolve.answers.judging.follow_through import FollowThrough
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison, Target
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation.link_frame import velocities
from dynsolve.notation.build import split_sign
from dynsolve.notation.tree import Node
from dynsolve.problem.model import Problem
from dynsolve.quantities import families

# An answer that is to be explained, and an explanation of it, which is told only where it holds


class Case(Struct, frozen=True, dict=True):
    """An answer that is wrong, as an element of the ring, and the value that it is compared with."""

    wrong: WrongEntry
    mine: Expr
    expected: Expr


class Explanation(Struct, frozen=True, dict=True):
    """What is told of an answer, and what mends it; `told` makes the words."""

    mends: tuple[Mend, ...]
    told: Callable[[], Iterable[Diagnosis]]

    def holds(self, case: Case) -> bool:
        """Whether it is true: with the slips mended the answer is what is expected, exactly."""
        return mends(self.mends, case.mine, case.expected)


MOST_NAMED = 4
"""More slips than this in one answer are told as the terms that differ."""

OF_OWN = "By your own answers before it: "
"""What is said first where something is true of what these lead to, and not of the key."""

_OF_A_CONSTANT = ("missing_term", "extra_term", "another_model")
"""What says no more than that a constant stands there."""

_OF_GRAVITY = ("gravity_missing", "gravity_sign")
"""What would be true of a whole matrix as it is told, and is said of one entry."""

MOST_OF_IT = Fraction(1, 2)
"""An answer with at least this share of the key's terms is compared with the key."""


class Diagnoser:
    """Names slips, the nearest that explains an answer.

    `derivation_slips`, `factors` and `words` are those of the answers' ring, which hand-ins share.
    """

    def __init__(
        self,
        problem: Problem,
        graph: AnswerGraph,
        follow_through: FollowThrough,
        derivation_slips: DerivationSlips,
        factors: FactorPairs,
        words: TermWriter,
    ) -> None:
        self.factors, self.words = factors, words
        self.problem = problem
        self.graph = graph
        self.steps = OwnSteps(graph, follow_through, derivation_slips)
        self.dimensions = graph.answer_ring.dimensions
        self.ring = graph.answer_ring.ring

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

    @cached_property
    def matrices(self) -> MatrixDiagnoser:
        """Finds the slip of a whole matrix."""
        return MatrixDiagnoser(self.graph, self.steps, self.expected, self.words)

    def __call__(self, wrong: WrongEntry) -> tuple[Diagnosis, ...]:
        """The slips in one scalar."""
        mine = wrong.mine
        if wrong.is_of_fractions:
            return tuple(self._of_fractions(wrong))
        if mine is None or not is_small(mine):
            return ()
        mine, numbers = self._in_letters(wrong, mine)
        found = tuple(dict.fromkeys((*numbers, *self._named(wrong, mine))))
        if any(one.code == "numbers_for_letters" for one in found):
            return found
        found = (*found, *(d for d in self.dimension_check(wrong, mine) if d not in found))
        if wrong.factor is None or wrong.factor == self.ring.one:
            return found
        by = self.words.of(wrong.factor)
        return tuple(replace(one, message=f"Multiplied by {by}: {one.message}") for one in found)

    def of_coriolis(self, row: WrongEntry, compared: KeyComparison) -> tuple[Diagnosis, ...]:
        """The slips in a row of C q̇: said of one entry of C, where this alone is not Christoffel's."""
        wrong = self._entry_of_coriolis(row, compared) or row
        return tuple(
            d if d.message.startswith(wrong.called) else replace(d, message=f"{wrong.called}: {d.message}")
            for d in self(wrong)
        )

    def _entry_of_coriolis(self, row: WrongEntry, compared: KeyComparison) -> WrongEntry | None:
        """The one entry of C that, put right, gives what is expected of its row of C q̇, or the key's row."""
        rows, k = compared.answer_value.rows or (), row.row
        if row.mine is None or row.mine.is_zero:
            return None
        expected: dict[int, list[Expr]] = {}
        for C in (self.steps.done_right("C"), self.graph.key("C")):
            different = [j for j, entry in enumerate(rows[k]) if entry != RationalExpr(C[k, j])]
            led = (C @ velocities(self.graph.robot))[k, 0]
            if len(different) == 1 and led in (self.expected(row), row.expected[-1]):
                expected.setdefault(different[0], []).append(C[k, different[0]])
        for j, values in expected.items():
            written = replace(row.written, value=rows[k][j], node=compared.answer_value.nodes[k][j])
            target, called = Target("C", (k, j)), f"Entry ({k + 1}, {j + 1}) of C"
            return WrongEntry(row.name, target, written, tuple(values), k, j, called)
        return None

    def expected(self, wrong: WrongEntry) -> Expr:
        """The nearest value that the answer may be compared with: one whose terms can be added.

        Where it has more of the key's terms than of that value's, and most of them, it was
        not taken from the student's own inputs, and is compared with the key.  Of fractions the nearest.
        """
        if wrong.is_of_fractions:
            return wrong.expected[0]
        nearest, key = self.dimension_check.first_that_fits(wrong), wrong.expected[-1]
        mine = wrong.mine
        if mine is not None and nearest is not key:
            alike = likeness(mine, key)
            if alike >= MOST_OF_IT and alike > likeness(mine, nearest):
                return key
        return nearest

    def _in_letters(self, wrong: WrongEntry, mine: Expr) -> tuple[Expr, list[Diagnosis]]:
        """The answer with letters for the numbers in their places, and what is said of these."""
        told: list[Diagnosis] = []
        expected = self.expected(wrong)
        while is_small(expected) and (found := number_for_a_letter(mine, expected, self._numbers)):
            letter, number, mend = found
            part, other = self.words.of(self.ring.constant(number)), self.words.generator(letter)
            told.append(slip("number_for_letter", yours=self.words.of(mend.have), part=part, other=other))
            mine = mend.applied(mine)
        return mine, told

    def _named(self, wrong: WrongEntry, mine: Expr) -> Iterator[Diagnosis]:
        """What is told of an answer: the first explanation that holds, else what differs.

        It holds of the nearest value, or of the key; what is true of the first only says so.
        """
        nearest, key = self.expected(wrong), wrong.expected[-1]
        if mine in (nearest, key):
            return
        constant = self._is_constant(wrong, mine)
        if constant:
            yield slip("constant_term")
        values = [nearest] if nearest == key else [nearest, key]
        cases = [[Case(wrong, *pair) for pair in self._with_numbers(mine, value)] for value in values]
        explained = chain.from_iterable(
            self._explained([case for case in alike if case is not None]) for alike in zip_longest(*cases)
        )
        case, found = next((pair for pair in explained if pair[1].holds(pair[0])), (cases[0][0], None))
        told: Iterable[Diagnosis] = ()
        if found is not None:
            told = (one for one in found.told() if not constant or one.code not in _OF_A_CONSTANT)
        elif is_small(case.expected) and not constant:
            told = what_differs(self.words, wrong.called, case.mine, case.expected)
        of_step = found is not None and any(isinstance(mend, Redoing) for mend in found.mends)
        first = "" if of_step or case in cases[-1] else OF_OWN
        for one in told:
            is_of_entry = one.code in _OF_GRAVITY and wrong.called.startswith("Entry")
            of_entry = f"{wrong.called}: " if is_of_entry else ""
            yield replace(one, message=f"{first}{of_entry}{one.message}")

    def _explained(self, cases: Sequence[Case]) -> Iterator[tuple[Case, Explanation]]:
        """One slip, of the first case that has it; else several, of that case which has the fewest."""
        yield from ((case, one) for case in cases for explain in _IN_ORDER for one in explain(self, case))
        several = [(case, one) for case in cases for one in self._several_terms(case)]
        yield from sorted(several, key=lambda pair: len(pair[1].mends))

    def _of_fractions(self, wrong: WrongEntry) -> Iterator[Diagnosis]:
        """What differs above the denominator of the nearest value, as the answer writes it."""
        written, nearest = wrong.written.value, fraction_of(wrong.expected[0])
        value, below = nearest.numerator, nearest.denominator
        ratio = as_expr(cancelled(RationalExpr(written.denominator, below)))
        if ratio is not None and ratio.is_number:
            value, below = value * ratio, written.denominator
        elif split_sign(self.words.form(below))[0] < 0:
            value, below = -value, -below
        if written.numerator.is_number and written.denominator.is_number:
            value, below = substituted(value, self._numbers), substituted(below, self._numbers)
        above = as_expr(cancelled(RationalExpr(written.numerator * below, written.divisor)))
        if above is None or not is_small(above):
            if any(equal(-fraction_of(value), written) for value in wrong.expected):
                yield slip("sign_all", yours=wrong.called)
            return
        case = Case(wrong, *self._with_numbers(above, value)[0])
        if is_zero(case.mine + case.expected):
            whole = as_expr(cancelled(RationalExpr(value, below)))
            is_term = whole is not None and len(parts(whole)) == 1
            told = slip("sign", term=self.words.of(-whole)) if whole and is_term else None
            yield told or slip("sign_all", yours=wrong.called)
            return
        for explain in _OF_TERMS:
            found = next((one for one in explain(self, case) if one.holds(case)), None)
            if found is not None:
                yield from (self._over(below, told) for told in found.told())
                return

    def _over(self, below: Expr, told: Diagnosis) -> Diagnosis:
        if below.is_number:
            return told
        return replace(told, message=f"Over {self.words.of(below)}: {told.message}")

    @property
    def _numbers(self) -> dict[int, Fraction]:
        return placed(self.problem.values, self.ring)

    def _with_numbers(self, mine: Expr, expected: Expr) -> list[tuple[Expr, Expr]]:
        """Both as they are, and with the numbers of the problem file, where the answer lacks symbols.

        Those that are most alike come first.
        """
        put, here = self._numbers, set(mine.used)
        unused = {i: value for i, value in put.items() if i not in here}
        if not unused.keys() & set(expected.used):
            return [(mine, expected)]
        choices = [
            (mine, substituted(expected, unused)),
            (mine, expected),
            (substituted(mine, put), substituted(expected, put)),
        ]
        different = [pair for pair in choices if pair[0] != pair[1]]
        return sorted(different, key=lambda pair: likeness(*pair), reverse=True) or [(mine, expected)]

    # -- one explanation after the other, see _IN_ORDER --------------------------------------------

    def _step_otherwise(self, case: Case) -> Iterator[Explanation]:
        """This step was done wrongly: a Jacobian at the frame's origin, a rule of d/dt left out."""
        node = case.wrong.target.node
        for value, diagnosis in self.steps.done_otherwise(node):
            right = self.steps.done_right(node)
            for found in self._redone(case, value, right, diagnosis):
                if found.holds(case) and self.steps.fits_what_is_written(node, value, right):
                    yield found

    def _one_number(self, case: Case) -> Iterator[Explanation]:
        """One number for all of it: a sign, a factor."""
        mine, expected = case.mine, case.expected
        ratio = ratio_of(mine, expected)
        if ratio is None:
            return
        mend = Exchange(expected, self.ring.constant(ratio), self.ring.one)
        if ratio == -1:
            one_term = len(parts(mine)) == 1
            term, called = self.words.of(mine), case.wrong.called
            told = slip("sign", term=term) if one_term else slip("sign_all", yours=called)
        else:
            told = multiplied(self.words, case.wrong.called, ratio)
        yield self._told((mend,), self._refined(told, case.wrong))

    def _another_model(self, case: Case) -> Iterator[Explanation]:
        """Something more than the problem has, as a load at the tip: without its letters all is right."""
        here = [self.ring.generators[i] for i in case.mine.used]
        unknown = [g for g in here if g.kind == "symbol" and self.words.is_unknown(g)]
        if unknown:
            mend = Renaming(case.mine, {g.index: self.ring.zero.poly for g in unknown})
            told = slip("another_model", part=" and ".join(map(self.words.generator, unknown)))
            yield self._told((mend,), told)

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
        node = case.wrong.target.node
        for value, diagnosis, changed in self.steps.earlier.values(node):
            if SLIPS[diagnosis.code].omits == omits:
                for found in self._redone(case, value, self.graph.key(node), diagnosis):
                    if found.holds(case) and self.steps.fits_the_rest(node, changed):
                        yield found

    def _throughout(self, case: Case) -> Iterator[Explanation]:
        """One symbol for another everywhere."""
        for diagnosis, mend in throughout(self.words, case.mine, case.expected):
            yield self._told((mend,), diagnosis)

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

    def _refined(self, one: Diagnosis, wrong: WrongEntry) -> Diagnosis:
        """A wrong sign of a potential energy, or of g, is the wrong sign of gravity."""
        quantity = self.dimension_check.quantity(wrong)
        is_gravity = quantity is not None and quantity.family in (families.P_BODY, families.P, families.G)
        is_gravity = is_gravity and not self.graph.robot.actions.stored
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

    def difference(self, wrong: WrongEntry) -> Node | None:
        """The answer minus what was expected, in compact form."""
        mine = wrong.mine
        if mine is None or wrong.is_of_fractions:
            return None
        difference = mine - self.expected(wrong)
        return self.words.form(difference) if is_small(difference) else None


_IN_ORDER: tuple[Callable[[Diagnoser, Case], Iterator[Explanation]], ...] = (
    Diagnoser._step_otherwise,
    Diagnoser._one_number,
    Diagnoser._another_model,
    Diagnoser._one_place,
    Diagnoser._one_substitution,
    Diagnoser._something_left_out,
    Diagnoser._one_bracket,
    Diagnoser._earlier_step_otherwise,
    Diagnoser._throughout,
)
"""The explanations in the order in which they are tried, the first that holds; then several slips."""

_OF_TERMS = (
    Diagnoser._one_number,
    Diagnoser._one_place,
    Diagnoser._one_substitution,
    Diagnoser._several_terms,
)
"""Those that look at terms alone."""
