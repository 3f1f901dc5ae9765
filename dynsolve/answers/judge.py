"""The verdicts of a hand-in.

    answers -> values in one field -> held against the key -> held against what the
    student's own answers lead to -> what is left is diagnosed

The order of the report is that of the derivation, so that the first slip comes first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.changed_rules import DerivationSlips
from dynsolve.answers.diagnosis.diagnoser import Diagnoser, WrongEntry
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.judging.answer_ring import Field
from dynsolve.answers.judging.answer_values import AnswerValue, AnswerValues, same
from dynsolve.answers.judging.entry_comparison import EntryComparer
from dynsolve.answers.judging.follow_through import FollowThrough, PossibleValue
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparer, KeyComparison, Target
from dynsolve.answers.judging.student_values import student_values
from dynsolve.answers.judging.zero_height import potential_at_zero_height
from dynsolve.answers.reading.files import FileReader
from dynsolve.answers.submission import Submission
from dynsolve.answers.verdict import (
    EntryVerdict,
    JudgedAnswer,
    Occurrence,
    Report,
    Verdict,
    worst,
)
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import derive
from dynsolve.notation import tree
from dynsolve.problem.model import Problem

NOT_FROM_OWN = "not_from_own"
NOT_CHRISTOFFEL = "C q̇ is right; this is another choice of C than Christoffel's"
UNAFFECTED = "tau is unaffected"

MOST_EXPECTED = 4
"""From so many of the values that a student's own answers lead to a slip is looked for."""

BY_PARTS = "judged by its parts"
BY_MIRROR = "judged as the entry that it mirrors: D is symmetric"


class Checker:
    """Judges hand-ins to one problem; what they all share is made once.

    `key` is the problem's derivation, where it has been made already.
    """

    def __init__(self, problem: Problem, key: Derivation | None = None) -> None:
        self.problem = problem
        self.key = key if key is not None else derive(problem.robot)
        self.field = Field(problem.robot, self.key)

    @cached_property
    def reader(self) -> FileReader:
        """Reads what is handed in."""
        return FileReader(self.problem)

    @cached_property
    def derivations(self) -> DerivationSlips:
        """The derivations with a rule replaced, in the problem's own ring."""
        return DerivationSlips(AnswerGraph(self.field))

    def __call__(self, submission: Submission) -> Report:
        """Judge a hand-in."""
        return Judge(self, submission).report()


def check(problem: Problem, submission: Submission, key: Derivation | None = None) -> Report:
    """Judge one hand-in; see `Checker` for many."""
    return Checker(problem, key)(submission)


class Judge:
    """Judges one hand-in."""

    def __init__(self, checker: Checker, submission: Submission) -> None:
        self.checker = checker
        self.problem = problem = checker.problem
        self.submission = submission
        self.hand = AnswerValues(checker.field, submission.answers)
        self.field = self.hand.field
        self.dimensions = self.field.dimensions
        self.compare = EntryComparer(problem.values)
        self.graph = AnswerGraph(self.field)
        self.hold = KeyComparer(self.graph, self.compare, self.hand.moved)
        self.groups = self._grouped()
        level = potential_at_zero_height(self.field, dict(self._energies()), self.dimensions)
        self.graph.shift = level
        self.held = {name: self.hold(name, self._value(chains)) for name, chains in self.groups.items()}
        self.assembled = self._assembled()

    # -- what was handed in ------------------------------------------------------------------------

    def _grouped(self) -> dict[str, list[list[AnswerValue]]]:
        """The answers by name, and of each name by the equation they stand in."""
        groups: dict[str, list[list[AnswerValue]]] = {}
        for given in self.hand.given:
            chains = groups.setdefault(self._name(given), [])
            if chains and chains[-1][0].answer.occurrence[0] == given.answer.occurrence[0]:
                chains[-1].append(given)
            else:
                chains.append([given])
        return groups

    def _name(self, given: AnswerValue) -> str:
        """The quantity that is meant where the notation leaves two: the one that it equals."""
        answer = given.answer
        for name in (answer.name, *answer.alternatives) if answer.alternatives and given.rows else ():
            if self.hold(name, given).correct:
                return name
        return self.graph.answer(answer.name)

    def _value(self, chains: list[list[AnswerValue]]) -> AnswerValue:
        """The answer that counts: the last member of the last equation."""
        return chains[-1][-1]

    def _energies(self) -> Iterator[tuple[str, Expr]]:
        """The student's own P_i, P and L, where they are expressions of the ring."""
        names = {"P", "L"} | {f"P{b.name}" for b in self.problem.robot.bodies}
        for name in names & self.groups.keys() if self.problem.robot.bodies else ():
            given = self._value(self.groups[name])
            if given.rows is not None and len(given.entries) == 1:
                value = as_expr(given.entries[0])
                if value is not None:
                    yield name, value

    def _assembled(self) -> KeyComparison | None:
        """C put together from its entries where all were given: free as a whole, it is held by row."""
        n = self.problem.robot.n
        names = [[f"C{i + 1}{j + 1}" for j in range(n)] for i in range(n)]
        entries = [[self.held.get(name) for name in row] for row in names]
        if "C" in self.held or not n:
            return None
        rows = []
        for row in entries:
            found = [h.given for h in row if h is not None and h.given.rows is not None]
            if len(found) < n or any(len(given.entries) != 1 for given in found):
                return None
            rows.append(found)
        node = tree.Matrix(tuple(tuple(given.nodes[0][0] for given in row) for row in rows))
        answer = replace(rows[0][0].answer, name="C", node=node)
        values = tuple(tuple(given.entries[0] for given in row) for row in rows)
        return self.hold("C", AnswerValue(answer, values, node.rows))

    # -- held against what the student's own answers lead to ---------------------------------------

    @cached_property
    def follow(self) -> FollowThrough:
        """The candidates that the student's own answers lead to."""
        return FollowThrough(self.graph, student_values(self.graph, self.held))

    def _candidates(self, held: KeyComparison) -> Sequence[PossibleValue]:
        return self.follow.derived(held.target.node)

    # -- verdicts ----------------------------------------------------------------------------------

    @cached_property
    def diagnoser(self) -> Diagnoser:
        """Names slips."""
        shared = self.field.same and self.graph.shift is None
        derivations = self.checker.derivations if shared else DerivationSlips(self.graph)
        return Diagnoser(self.problem, self.graph, self.follow, self.dimensions, derivations)

    def judged(self, name: str) -> JudgedAnswer:
        """What is said of one answer."""
        chains = self.groups[name]
        held = self.held[name]
        answer = held.given.answer
        base = JudgedAnswer(
            name,
            Verdict.WRONG,
            answer.label,
            answer.place,
            answer.read_as,
            answer.notes,
            of=Fraction(self.problem.marks.get(name, 0)),
            occurrences=self._occurrences(name, chains),
            written=answer.node,
        )
        if held.given.rows is None:
            return replace(
                base, verdict=Verdict.UNREADABLE, fault=held.given.fault, expected=held.given.expected
            )
        base = self._with_chain(base, chains[-1])
        if held.target.node not in self.field.rules:
            return replace(base, verdict=Verdict.UNREADABLE, fault=f"{name} is no quantity of this problem")
        if held.correct:
            return self._scored(self._as_correct(base, name, held))
        return self._scored(self._as_other(base, name, held))

    def _scored(self, judged: JudgedAnswer) -> JudgedAnswer:
        earned = judged.of if judged.verdict in (Verdict.CORRECT, Verdict.FOLLOWS) else Fraction(0)
        return replace(judged, marks=earned)

    def _as_correct(self, base: JudgedAnswer, name: str, held: KeyComparison) -> JudgedAnswer:
        notes = list(base.notes)
        if held.rounded:
            notes.append("rounded")
        if self._not_from_own(held):
            notes.append(NOT_FROM_OWN)
        if name == "C" and not self._is_christoffel(held.given):
            notes.append(NOT_CHRISTOFFEL)
        entries = tuple(EntryVerdict(index, Verdict.CORRECT) for index, _, _ in self._entries(name, held))
        return replace(base, verdict=Verdict.CORRECT, notes=tuple(notes), entries=entries)

    def _is_christoffel(self, given: AnswerValue) -> bool:
        assert given.rows is not None
        C: Matrix = self.field.key("C")
        key = tuple(tuple(RationalExpr(entry) for entry in row) for row in C.rows)
        return same(given.rows, key)

    def _not_from_own(self, held: KeyComparison) -> bool:
        """Whether the student's own wrong answers lead elsewhere."""
        if held.target.node in ("Cqd", "C", "christoffel") and not self.problem.robot.bodies:
            return False
        if not self.follow.touched(held.target.node):
            return False
        key = self.hold.key(held.target)
        led = False
        for value in self._nearest_of_routes(held.target):
            if _equal(value, key):
                return False
            led = True
        return led

    def _nearest_of_routes(self, target: Target) -> Iterator[Any]:
        """The value of each route from the nearest own answers."""
        for route in self.graph.routes(target.node):
            if not any(self.follow.own.get(i) or self.follow.touched(i) for i in route.inputs):
                continue
            one = next(iter(self.follow._combinations(route)), None)
            if one is not None:
                yield target.of(one.value)

    def _entries(self, name: str, held: KeyComparison) -> Iterator[tuple[tuple[int, ...], int, int]]:
        """(index from 1, row, column) of the entries that are judged one by one; none of a scalar."""
        if len(held.rows) == 1 and len(held.rows[0]) == 1:
            return
        for i, row in enumerate(held.rows):
            for j in range(len(row)):
                yield ((i + 1,) if name == "C" else (i + 1, j + 1)), i, j

    def _as_other(self, base: JudgedAnswer, name: str, held: KeyComparison) -> JudgedAnswer:
        if not held.rows or held.obstacles:
            return replace(base, diagnosis=tuple(slip(one.code, yours=one.yours) for one in held.obstacles))
        whole = self._whole_follows(held)
        entries = tuple(
            self._entry(name, held, index, i, j, whole) for index, i, j in self._entries(name, held)
        )
        if not entries:
            one = self._entry(name, held, (1, 1), 0, 0, whole)
            notes = base.notes
            if any(d.code == "constant_term" for d in one.diagnosis):
                notes = (*notes, UNAFFECTED)
            return replace(
                base,
                notes=notes,
                verdict=one.verdict,
                follows_from=one.follows_from,
                diagnosis=one.diagnosis,
                difference=one.difference,
            )
        verdict = worst([entry.verdict for entry in entries])
        used = [name for entry in entries for name in entry.follows_from]
        found = tuple(dict.fromkeys(d for entry in entries for d in entry.diagnosis))
        if verdict is Verdict.WRONG:
            found = self.diagnoser.whole(self._question(name, held, 0, 0), held, found)
        return replace(
            base, verdict=verdict, entries=entries, diagnosis=found,
            follows_from=self._sorted(used) if verdict is Verdict.FOLLOWS else (),
        )  # fmt: skip

    def _sorted(self, names: Sequence[str]) -> tuple[str, ...]:
        return tuple(sorted(dict.fromkeys(names), key=self.graph.place))

    def _matches(self, held: KeyComparison, candidate: PossibleValue, i: int, j: int) -> bool:
        value = held.target.of(candidate.value)
        expected = value[i, j] if isinstance(value, Matrix) else value
        return self.compare(expected, held.rows[i][j]) is not None

    def _whole_follows(self, held: KeyComparison) -> PossibleValue | None:
        """The first candidate that explains every entry that is not right by itself."""
        places = [(i, j) for i, row in enumerate(held.right) for j, r in enumerate(row) if r is None]
        for one in self._candidates(held):
            if one.used and all(self._matches(held, one, i, j) for i, j in places):
                return one
        return None

    def _row_follows(self, held: KeyComparison, i: int) -> PossibleValue | None:
        """The force that an entry of τ is taken from."""
        for one in self.follow.choices(f"tau{i + 1}"):
            if one.used and one.value is not None and self.compare(one.value, held.rows[i][0]) is not None:
                return one
        return None

    def _entry(
        self,
        name: str,
        held: KeyComparison,
        index: tuple[int, ...],
        i: int,
        j: int,
        whole: PossibleValue | None,
    ) -> EntryVerdict:
        if held.right[i][j] is not None:
            return EntryVerdict(index, Verdict.CORRECT)
        one = self._row_follows(held, i) if held.target.node == "tau" else whole
        if one is None:
            one = next((c for c in self._candidates(held) if c.used and self._matches(held, c, i, j)), None)
        if one is not None:
            return EntryVerdict(index, Verdict.FOLLOWS, follows_from=self._sorted(list(one.used)))
        question = self._question(name, held, i, j)
        return EntryVerdict(
            index, Verdict.WRONG, self.diagnoser(question), difference=self.diagnoser.difference(question)
        )

    def _question(self, name: str, held: KeyComparison, i: int, j: int) -> WrongEntry:
        key = self.hold.key(held.target)
        return WrongEntry(
            name=name,
            target=held.target,
            written=held.rows[i][j],
            expected=tuple(_at(value, i, j) for value in (*self._led_to(held.target), key)),
            row=i,
            column=j,
        )

    def _led_to(self, target: Target) -> Iterator[Any]:
        """The values that the student's own answers lead to, the nearest first."""
        if self.follow.touched(target.node):
            for one in self.follow.derived(target.node)[:MOST_EXPECTED]:
                yield target.of(one.value)

    # -- places ------------------------------------------------------------------------------------

    def _occurrences(self, name: str, chains: list[list[AnswerValue]]) -> tuple[Occurrence, ...]:
        """Each place where it was given, where there are several."""
        if len(chains) < 2:
            return ()
        found = []
        for chain in chains:
            last = chain[-1]
            found.append(Occurrence(last.answer.place, last.answer.label, self._verdict_of(name, last)))
        return tuple(found)

    def _verdict_of(self, name: str, given: AnswerValue) -> Verdict:
        held = self.hold(name, given)
        if given.rows is None:
            return Verdict.UNREADABLE
        if held.correct:
            return Verdict.CORRECT
        if not held.rows or held.obstacles:
            return Verdict.WRONG
        whole = self._whole_follows(held)
        if whole is not None:
            return Verdict.FOLLOWS
        verdicts = []
        for i, row in enumerate(held.right):
            for j, right in enumerate(row):
                follows = any(c.used and self._matches(held, c, i, j) for c in self._candidates(held))
                verdicts.append(
                    Verdict.CORRECT if right is not None else Verdict.FOLLOWS if follows else Verdict.WRONG
                )
        return worst(verdicts)

    def _with_chain(self, base: JudgedAnswer, chain: list[AnswerValue]) -> JudgedAnswer:
        """The place of the slip in a = b = c: the first member that differs from the one before it."""
        for before, after in pairwise(chain):
            if before.rows is None or after.rows is None or same(before.rows, after.rows):
                continue
            note = f"differs from what stands before it, {before.answer.text.strip()}"
            return replace(base, place=after.answer.place, notes=(*base.notes, note))
        first = chain[0].answer
        return replace(base, place=first.place if len(chain) > 1 else base.place)

    # -- the whole hand-in -------------------------------------------------------------------------

    def report(self) -> Report:
        """Everything that is said of the hand-in."""
        answers = {name: self.judged(name) for name in self.groups}
        if self.assembled is not None:
            answers |= dict(self._by_row(self.assembled, answers))
        for name in self.problem.marks or self.problem.find:
            if name not in answers and self.hold.target(name).node in self.field.rules:
                answers[name] = self._unwritten(name, answers)
        ordered = sorted(answers.values(), key=lambda a: self.graph.place(a.name))
        wrong = [a for a in ordered if a.verdict is Verdict.WRONG]
        first = next((a.name for a in wrong if a.given), wrong[0].name if wrong else "")
        return Report(
            self.problem.stem,
            self.submission.student,
            self.submission.file,
            tuple(ordered),
            self.submission.not_recognized,
            first,
            self.submission.faults,
        )

    def _by_row(
        self, whole: KeyComparison, answers: dict[str, JudgedAnswer]
    ) -> Iterator[tuple[str, JudgedAnswer]]:
        """The entries of C, each with the verdict of its row of C q̇."""
        base = JudgedAnswer("C", Verdict.WRONG)
        one = self._as_correct(base, "C", whole) if whole.correct else self._as_other(base, "C", whole)
        if whole.obstacles:
            return
        for entry in one.entries:
            for j in range(self.problem.robot.n):
                name = f"C{entry.index[0]}{j + 1}"
                wrong = entry.verdict is Verdict.WRONG and answers[name].verdict is Verdict.WRONG
                yield (
                    name,
                    self._scored(
                        replace(
                            answers[name],
                            verdict=Verdict.WRONG if entry.verdict is Verdict.WRONG else entry.verdict,
                            follows_from=entry.follows_from,
                            diagnosis=answers[name].diagnosis if wrong else entry.diagnosis,
                            difference=answers[name].difference if wrong else entry.difference,
                        )
                    ),
                )

    def _unwritten(self, name: str, answers: dict[str, JudgedAnswer]) -> JudgedAnswer:
        """A whole that is not written: judged by its parts where all of them are, else missing."""
        of = Fraction(self.problem.marks.get(name, 0))
        parts = self._written_parts(name, answers)
        if parts is None:
            base = JudgedAnswer(name, Verdict.MISSING, of=of, given=False)
            return self._scored(self._within_whole(base, answers) or base)
        verdict = worst([part.verdict for part in parts])
        used = [n for part in parts for n in part.follows_from] if verdict is Verdict.FOLLOWS else []
        return self._scored(
            JudgedAnswer(
                name,
                verdict,
                parts[0].label,
                parts[0].place,
                of=of,
                given=False,
                notes=(BY_PARTS,),
                follows_from=self._sorted(used),
            )
        )

    def _within_whole(self, base: JudgedAnswer, answers: dict[str, JudgedAnswer]) -> JudgedAnswer | None:
        """An entry that is not written by itself: judged in the matrix, or as the one it mirrors in D."""
        name, place = self.graph.whole(base.name)
        mirrored = answers.get(f"d{place[1]}{place[0]}") if name == "D" else None
        if mirrored is not None and mirrored.given:
            return replace(mirrored, name=base.name, of=base.of, given=False, notes=(BY_MIRROR,))
        whole = answers.get(name)
        if whole is None or not whole.given:
            return None
        found = next((e for e in whole.entries if place in (e.index, (*e.index, place[1]))), None)
        return replace(
            base, verdict=found.verdict if found else whole.verdict, label=whole.label, place=whole.place,
            notes=(f"an entry of {whole.name}",), follows_from=found.follows_from if found else (),
            diagnosis=found.diagnosis if found else whole.diagnosis, fault=whole.fault,
            expected=whole.expected, difference=found.difference if found else None,
        )  # fmt: skip

    def _written_parts(self, name: str, answers: dict[str, JudgedAnswer]) -> list[JudgedAnswer] | None:
        parts = self.graph.parts(name)
        found: list[JudgedAnswer] = []
        for part in parts:
            mirrored = f"d{part[2]}{part[1]}" if name == "D" else part
            if part in answers:
                found.append(answers[part])
            elif mirrored in answers:
                found.append(answers[mirrored])
            else:
                inner = self._written_parts(part, answers)
                if inner is None:
                    return None
                found += inner
        return found or None


def _equal(a: Any, b: Any) -> bool:
    if isinstance(a, Matrix) and isinstance(b, Matrix):
        return a.shape == b.shape and all(x == y for x, y in zip(a.entries, b.entries, strict=True))
    return bool(a == b)


def _at(value: Any, i: int, j: int) -> Expr:
    found: Expr = value[i, j] if isinstance(value, Matrix) else value
    return found
