"""What the steps of a derivation give from the student's own answers: done right, and done otherwise.

A wrong step is told by what it makes of everything after it.  Each variant of a
step (see `steps`) is put into the key's derivation, and the answer is compared with
what comes out at its own place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from dynsolve.algebra.fraction import as_expr, equal
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.diagnosis.exchanges import multiplied, ratio_of
from dynsolve.answers.diagnosis.slips import SLIPS, slip
from dynsolve.answers.diagnosis.steps import variants
from dynsolve.answers.diagnosis.wrong_entry import TermWriter, WrongEntry
from dynsolve.answers.judging.follow_through import FollowThrough
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison, Target
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.link_frame import velocities
from dynsolve.errors import AlgebraError

# Slips that run through the derivation: the graph with one rule replaced

MOST_TERMS = 1_500
"""Robots whose kinetic energy has more terms than this are diagnosed step by step only."""


OF_THE_MATRIX = ("transposed", "rows_swapped")
"""What is said of a matrix itself: of what comes after it, it would be false."""


_ACTING = ("Ps", "Km", "friction")
"""What acts beside gravity, where anything does."""


class ChangedDerivation:
    """The key's derivation with the value of one node, or of one kind of node, replaced."""

    def __init__(self, graph: AnswerGraph, values: dict[str, Any]) -> None:
        self.graph = graph
        self._values = values
        self._reached: dict[str, bool] = {}

    def reached(self, node: str) -> bool:
        """Whether the replacement changes a node."""
        if node not in self._reached:
            self._reached[node] = node in self._values or any(
                self.reached(name) for route in self.graph.routes(node)[:1] for name in route.inputs
            )
        return self._reached[node]

    def __call__(self, node: str) -> Any:
        """The node's value; AlgebraError where the replacement leads to none."""
        if node not in self._values:
            if not self.reached(node):
                return self.graph.key(node)
            self._values[node] = self._computed(node)
        found = self._values[node]
        if isinstance(found, Skipped):
            raise AlgebraError(found.why)
        return found

    def _computed(self, node: str) -> Any:
        """The value by the node's first route; why there is none is kept, so that it is not tried again."""
        route = self.graph.routes(node)[0]
        try:
            return route.compute(*map(self, route.inputs))
        except AlgebraError as error:
            return Skipped(str(error))


class DerivationSlips:
    """The derivations with a rule replaced, made when first asked for."""

    def __init__(self, graph: AnswerGraph) -> None:
        self.graph = graph
        self._made: list[tuple[str, ChangedDerivation, Diagnosis]] | None = None

    def values(self, node: str) -> Iterator[tuple[Any, Diagnosis, ChangedDerivation]]:
        """What a node becomes under every slip that reaches it, and what everything else becomes."""
        for source, replaced, told in self.made():
            if source != node and replaced.reached(node):
                try:
                    yield replaced(node), told, replaced
                except AlgebraError:  # a step that cannot be taken from there tells nothing
                    continue

    def made(self) -> list[tuple[str, ChangedDerivation, Diagnosis]]:
        """(the node that goes wrong first, the derivation, the slip), slips that omit something first."""
        if self._made is None:
            self._made = sorted(self._make(), key=lambda made: not SLIPS[made[2].code].omits)
        return self._made

    def _make(self) -> Iterator[tuple[str, ChangedDerivation, Diagnosis]]:
        graph, robot = self.graph, self.graph.robot
        if not robot.has_dynamics or len(graph.key("K")) > MOST_TERMS:
            return
        for node in self._sources():
            right = graph.key(node)
            for wrong, told in variants(robot, node, graph.key):
                if told.code not in OF_THE_MATRIX and wrong != right:
                    yield node, ChangedDerivation(graph, {node: wrong}), told
        yield from self._everywhere()

    def _sources(self) -> Iterator[str]:
        robot = self.graph.robot
        for joint in robot.joints:
            yield f"A{joint.index}"
        for body in robot.bodies:
            yield from (f"rc{body.name}", f"Jv{body.name}", f"Jw{body.name}")
            if not body.is_point:
                yield from (f"I_body{body.name}", f"I{body.name}", f"Kw{body.name}")
            yield from (f"P{body.name}", f"K{body.name}")
        yield from (name for name in _ACTING if name in self.graph.answer_ring.rules)
        yield from ("P", "K", "L")
        for q in robot.coordinates:
            yield from (f"ddt{q.index}", f"tau{q.index}")

    def _everywhere(self) -> Iterator[tuple[str, ChangedDerivation, Diagnosis]]:
        """The same slip for every body or coordinate at once."""
        robot, graph = self.graph.robot, self.graph
        kinds: list[tuple[str, list[str]]] = [
            (head, [f"{head}{b.name}" for b in robot.bodies]) for head in ("rc", "Jv", "Jw", "I", "Kw", "K")
        ]
        kinds += [(head, [f"{head}{q.index}" for q in robot.coordinates]) for head in ("ddt", "tau")]
        for head, nodes in kinds:
            by_code: dict[str, dict[str, Any]] = {}
            told_as: dict[str, Diagnosis] = {}
            for node in nodes:
                for wrong, told in variants(robot, node, graph.key):
                    changed = by_code.setdefault(told.code, {})
                    if node not in changed and wrong != graph.key(node):
                        changed[node] = wrong
                        told_as.setdefault(told.code, told)
            for code, changed in by_code.items():
                if len(changed) > 1:
                    yield head, ChangedDerivation(graph, dict(changed)), told_as[code]


class OwnSteps:
    """What steps give from the student's own answers; `earlier` are the slips of the steps before them."""

    def __init__(self, graph: AnswerGraph, follow_through: FollowThrough, earlier: DerivationSlips) -> None:
        self.graph = graph
        self.follow_through = follow_through
        self.earlier = earlier
        self._leading: dict[str, frozenset[str]] = {}

    def done_right(self, node: str) -> Any:
        """The value that the student's own inputs of a step lead to."""
        derived = self.follow_through.derived(node) if self.follow_through.touched(node) else ()
        return derived[0].value if derived else self.graph.key(node)

    def done_otherwise(self, node: str) -> Iterator[tuple[Any, Diagnosis]]:
        """The values that a step gives when it is done wrongly, from the student's own inputs."""
        if node in ("C", "christoffel"):
            return
        try:
            yield from variants(
                self.graph.robot,
                node,
                lambda name: self.done_right(name) if name == node else self._nearest(name),
            )
        except AlgebraError:  # inputs of the student's from which the step cannot be taken
            return

    def _nearest(self, node: str) -> Any:
        """The student's own value of a node, or the value that their nearest answers lead to."""
        choices = self.follow_through.choices(node)
        value = choices[0].value if choices else None
        return self.graph.key(node) if value is None else value

    def fits_the_rest(self, node: str, changed: ChangedDerivation) -> bool:
        """Whether a slip of an earlier step agrees with all that the student wrote on the way.

        What the student's own answer holds was not left out.
        """
        for name, own in self.follow_through.students.items():
            if own.value is None or not changed.reached(name):
                continue
            if name == node:
                if not self.fits_what_is_written(node, changed(node), self.graph.key(node)):
                    return False
            elif name in self._before(node) and changed(name) != own.value:
                return False
        return True

    def fits_what_is_written(self, node: str, changed: Any, right: Any) -> bool:
        """Whether a slip changes no entry of a matrix that is right: what it changes is as it was written."""
        own = self.follow_through.students.get(node)
        written = own.value if own is not None else None
        if not isinstance(changed, Matrix) or not isinstance(written, Matrix):
            return True
        if changed.shape != written.shape:
            return True  # parameters may be as many as the student chose
        entries = zip(changed.entries, written.entries, right.entries, strict=True)
        return all(new in (wanted, mine) for new, mine, wanted in entries)

    def _before(self, node: str) -> frozenset[str]:
        if node not in self._leading:
            self._leading[node] = frozenset()
            inputs = {name for route in self.graph.routes(node) for name in route.inputs}
            self._leading[node] = frozenset(inputs).union(*map(self._before, inputs))
        return self._leading[node]


# Naming the one slip that explains all the wrong entries of a matrix


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
        given = self._given(compared)
        if given.shape == (1, 1):
            return found
        if all(entry.is_zero for entry in given.entries):
            codes = {d.code for d in found}
            is_one = codes in ({"zero"}, {"gravity_missing"})
            return (slip(*codes, yours="Your answer"),) if is_one else found
        if wrong[0].name == "C" and self._is_transposed_coriolis(compared):
            return (slip("transposed"),)
        is_shown = any(entry.mine is None or not entry.mine.is_zero for entry in wrong)
        for value, right, diagnosis in self._of_matrix(given, wrong[0], is_shown, _is_explained(found)):
            if value == given and all(self._is_mended(entry, right) for entry in wrong):
                return (diagnosis, *(d for d in found if d.code == "dimensions"))
        return found

    def _given(self, compared: KeyComparison) -> Matrix | FractionMatrix:
        mine = [[as_expr(w.value) for w in row] for row in compared.rows]
        if any(e is None for row in mine for e in row):
            return FractionMatrix(self.ring, tuple(tuple(w.value for w in row) for row in compared.rows))
        return Matrix.of(self.ring, [[e for e in row if e is not None] for row in mine])

    def _of_matrix(
        self, given: Matrix | FractionMatrix, wrong: WrongEntry, is_shown: bool, is_explained: bool
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

    def _is_mended(self, entry: WrongEntry, right: Any) -> bool:
        """Whether the step done right gives what is expected of an entry, which may be a fraction."""
        return equal(fraction_of(right[entry.row, entry.column]), fraction_of(self.expected(entry)))

    def _multiplied(self, given: Matrix | FractionMatrix, right: Any) -> Iterator[tuple[Any, Any, Diagnosis]]:
        """One number for all of it."""
        if isinstance(right, Matrix) and isinstance(given, Matrix) and right.shape == given.shape:
            pairs = zip(given.entries, right.entries, strict=True)
            ratio = next((ratio_of(*pair) for pair in pairs if not pair[1].is_zero), None)
            if ratio is not None:
                told = (
                    slip("sign_all", yours="Your answer")
                    if ratio == -1
                    else multiplied(self.words, "Your answer", ratio)
                )
                yield right.scale(self.ring.constant(ratio)), right, told

    def _transposed(self, target: Target) -> Iterator[tuple[Any, Diagnosis]]:
        right = target.of(self.graph.key(target.node))
        if isinstance(right, Matrix) and right.shape[0] == right.shape[1] > 1:
            yield right.T, slip("transposed")

    def _is_transposed_coriolis(self, compared: KeyComparison) -> bool:
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
