"""Naming the one slip that explains all the wrong entries of a matrix."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.mends import Redoing
from dynsolve.answers.diagnosis.one_place import ratio_of
from dynsolve.answers.diagnosis.own_steps import OwnSteps
from dynsolve.answers.diagnosis.slips import SLIPS, slip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.diagnosis.wrong_entry import WrongEntry
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison, Target
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation.energy import velocities


class MatrixDiagnoser:
    """Names the slip of a whole matrix; `expected` says what one of its entries is compared with."""

    def __init__(
        self,
        graph: AnswerGraph,
        steps: OwnSteps,
        expected: Callable[[WrongEntry], Expr],
        words: TermWriter,
    ) -> None:
        self.graph = graph
        self.words = words
        self.ring = graph.answer_ring.ring
        self.steps = steps
        self.expected = expected

    def __call__(
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
            codes = {d.code for d in found}
            is_one = codes in ({"zero"}, {"gravity_missing"})
            return (slip(*codes, yours="Your answer"),) if is_one else found
        if wrong[0].name == "C" and self._is_transposed_coriolis(compared):
            return (slip("transposed"),)
        is_shown = any(entry.mine is None or not entry.mine.is_zero for entry in wrong)
        for value, right, diagnosis in self._of_matrix(given, wrong[0], is_shown, _is_explained(found)):
            if value == given and all(self._is_mended(entry, value, right) for entry in wrong):
                return (diagnosis, *(d for d in found if d.code == "dimensions"))
        return found

    def _of_matrix(
        self, given: Matrix, wrong: WrongEntry, is_shown: bool, is_explained: bool
    ) -> Iterator[tuple[Any, Any, Diagnosis]]:
        """What a matrix is under a slip, what it is without, and the slip.

        Where one slip in one place explains it, what was done otherwise long before is no nearer; a 0 alone
        shows no step of these.
        """
        target = wrong.target
        right = target.of(self.steps.done_right(target.node))
        for value, diagnosis in (*self.steps.done_otherwise(target.node), *self._transposed(target)):
            yield target.of(value), right, diagnosis
        yield from self._multiplied(given, right)
        key = target.of(self.graph.key(target.node))
        for value, diagnosis, changed in self.steps.earlier.values(target.node) if is_shown else ():
            is_nearer = SLIPS[diagnosis.code].omits or not is_explained
            if is_nearer and self.steps.fits_the_rest(target.node, changed):
                yield target.of(value), key, diagnosis

    def _is_mended(self, entry: WrongEntry, value: Any, right: Any) -> bool:
        """Whether a slip of the whole matrix explains one of its entries."""
        mine, wrong = entry.mine, value[entry.row, entry.column]
        redoing = Redoing(wrong, right[entry.row, entry.column])
        return mine is not None and redoing.applied(mine) == self.expected(entry)

    def _multiplied(self, given: Matrix, right: Any) -> Iterator[tuple[Any, Any, Diagnosis]]:
        """One number for all of it."""
        if isinstance(right, Matrix) and right.shape == given.shape:
            pairs = zip(given.entries, right.entries, strict=True)
            ratio = next((ratio_of(*pair) for pair in pairs if not pair[1].is_zero), None)
            if ratio is not None:
                told = (
                    slip("sign_all", yours="Your answer")
                    if ratio == -1
                    else slip("factor_all", yours="Your answer", part=self.words.number(ratio))
                )
                yield right.scale(self.ring.constant(ratio)), right, told

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


def _is_explained(found: Iterable[Diagnosis]) -> bool:
    """Whether slips of one kind, and no list of what differs, were found in the entries of a matrix.

    A term that is doubled, or one too many, may have a cause that says more.
    """
    slips = list({one.code for one in found if one.code != "dimensions"})
    return len(slips) == 1 and slips[0] not in _LISTS and slips[0] not in ("factor", "extra_term")


_LISTS = ("terms_differ", "terms_missing", "trig_part")
"""What says that something differs, and not why."""
