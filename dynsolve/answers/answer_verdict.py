"""The verdict of one answer that was given.

    unreadable   it has no value (the reader or the ring refused it)
    correct      every entry is the key's
    follows      every entry that is not is explained by the student's own earlier answers,
                 none of which keeps nothing of the key (`judging.explanation`)
    wrong        else; then each wrong entry is diagnosed

A matrix has a verdict for each entry, C for each row of C q̇, and takes the worst.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise, product

from msgspec.structs import replace

from dynsolve.algebra.fraction import RationalExpr, same
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.diagnoser import Diagnoser
from dynsolve.answers.diagnosis.slips import slip, told
from dynsolve.answers.diagnosis.wrong_entry import LONGEST, WrongEntry, multiplied_back
from dynsolve.answers.judging.answer_values import AnswerValue
from dynsolve.answers.judging.configurations import ConfigurationKey
from dynsolve.answers.judging.explanation import Explanations, entry_of
from dynsolve.answers.judging.follow_through import PossibleValue
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.hand_in import Chain, ComparedHandIn, last
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.answers.verdict import (
    ConfigurationAnswer,
    EntryVerdict,
    JudgedAnswer,
    Occurrence,
    Verdict,
    VerdictAnswer,
    unjudged,
    worst,
)
from dynsolve.derivation.graph import Derivation
from dynsolve.errors import attempted
from dynsolve.problem.model import Problem
from dynsolve.quantities.letters import key
from dynsolve.questions.definite.derive import Definiteness
from dynsolve.questions.definite.judge import fault
from dynsolve.questions.judging import Missed
from dynsolve.robot.model import Robot

ROUNDED = "rounded"
NOT_FROM_OWN = "right, though your own earlier answers lead elsewhere"
NOT_CHRISTOFFEL = "C q̇ is right; this is another choice of C than Christoffel's, with which Ḋ - 2C is {}"
FROM_NOTHING = "it is what follows from {}, where next to nothing is right"
UNAFFECTED = "tau is unaffected"
MAY_FOLLOW = "it is not right by itself, and may follow from {}, which could not be read"
NOT_GENERAL = "it is not right in general; {}"
NOT_FOUND = "it holds in every motion, and the accelerations in it are found nowhere"
LONGER = "these are {} parameters; {} are enough"


class AnswerJudge:
    """Judges the answers that were given in one hand-in."""

    def __init__(
        self, problem: Problem, hand_in: ComparedHandIn, explanations: Explanations, diagnoser: Diagnoser
    ) -> None:
        self.problem = problem
        self.hand_in = hand_in
        self.explanations = explanations
        self.diagnoser = diagnoser

    def __call__(self, name: str) -> JudgedAnswer:
        """What is said of the answer to one quantity."""
        chains = self.hand_in.chains[name]
        compared = self.hand_in.comparisons[name]
        value, answer = compared.answer_value, compared.answer_value.answer
        base = unjudged(answer, name, Fraction(self.problem.marks.get(name, 0)))
        base = replace(base, occurrences=self._occurrences(name, chains))
        if value.rows is None:
            unreadable = replace(base, fault=value.fault, expected=value.expected)
            return self._partly(unreadable, value) if value.read is not None else unreadable
        base = _placed_in_chain(base, chains[-1])
        if compared.target.node not in self.hand_in.answer_ring.rules:
            return replace(base, fault=f"{name} is no quantity of this problem")
        return self.compared(base, compared)

    def _partly(self, base: JudgedAnswer, value: AnswerValue) -> JudgedAnswer:
        """A matrix of which some entries could not be read: it waits for a human, the others are judged."""
        compared = self.hand_in.compare(base.name, replace(value, rows=value.read))
        width = 1 if base.name == "C" else len(value.nodes[0])
        unread = {i * width + j % width for i, j in value.answer.unread}
        judged = self.compared(base, compared).entries
        if len(judged) != len(value.nodes) * width:
            return base
        entries = tuple(
            EntryVerdict(entry.index, Verdict.UNREADABLE) if place in unread else entry
            for place, entry in enumerate(judged)
        )
        found = dict.fromkeys(one for entry in entries for one in entry.diagnosis)
        return replace(base, entries=entries, diagnosis=tuple(found))

    def compared(self, base: JudgedAnswer, compared: KeyComparison) -> JudgedAnswer:
        """The verdict of an answer that was compared with the key; `base` is what else is known of it."""
        if compared.correct:
            return self._correct(base, compared)
        source = self.explanations.of_span(compared) if compared.written else None
        if source is not None:
            used = in_order(self.hand_in.graph, source.used)
            return replace(base, verdict=Verdict.FOLLOWS, follows_from=used)
        if not compared.rows or compared.obstacles:
            found = tuple(slip(one.code, yours=one.yours) for one in compared.obstacles)
            return replace(base, verdict=Verdict.WRONG, diagnosis=found)
        whole = self.explanations.of_whole(compared)
        entries = tuple(
            self._entry(base.name, compared, index, i, j, whole)
            for index, i, j in _entries(base.name, compared)
        )
        judged = self._matrix(base, compared, entries) if entries else self._scalar(base, compared, whole)
        if judged.verdict is Verdict.WRONG and compared.missed is not None:
            judged = self._missing(judged, compared.missed)
        nothing = self.explanations.of_nothing(compared) if judged.verdict is Verdict.WRONG else ()
        if not nothing:
            return judged
        return replace(judged, loss=FROM_NOTHING.format(", ".join(in_order(self.hand_in.graph, nothing))))

    # -- correct -----------------------------------------------------------------------------------

    def _correct(self, base: JudgedAnswer, compared: KeyComparison) -> JudgedAnswer:
        notes = list(base.notes)
        if compared.rounded:
            notes.append(ROUNDED)
        if self.explanations.lead_elsewhere(compared):
            notes.append(NOT_FROM_OWN)
        if compared.other:
            notes.append(compared.other)
        notes += self._fewer(base.name)
        if base.name == "C" and not compared.other and not self._is_christoffel(compared.answer_value):
            is_skew = self._is_skew(compared.answer_value)
            notes.append(NOT_CHRISTOFFEL.format(("not " if not is_skew else "") + "skew-symmetric"))
        entries = tuple(EntryVerdict(index, Verdict.CORRECT) for index, _, _ in _entries(base.name, compared))
        return replace(base, verdict=Verdict.CORRECT, notes=tuple(notes), entries=entries)

    def _fewer(self, name: str) -> Iterator[str]:
        """The remark that fewer parameters are enough, where the student chose more than are needed."""
        if name in self.hand_in.graph.parameters:
            mine, least = (
                len(ring.key(name).rows) for ring in (self.hand_in.graph, self.hand_in.answer_ring)
            )
            if mine > least:
                yield LONGER.format(mine, least)

    def _is_christoffel(self, value: AnswerValue) -> bool:
        assert value.rows is not None
        key = self.hand_in.answer_ring.key("C")
        return same(value.rows, tuple(tuple(RationalExpr(entry) for entry in row) for row in key.rows))

    def _is_skew(self, value: AnswerValue) -> bool:
        """Whether Ḋ - 2C is skew-symmetric; of any right C only q̇ᵀ (Ḋ - 2C) q̇ is 0."""
        assert value.rows is not None
        ring = self.hand_in.answer_ring.ring
        if any(entry.divisor is not None for row in value.rows for entry in row):
            return False
        rate: Matrix = self.hand_in.answer_ring.key("D").map(ring.time_derivative)
        C = Matrix.of(ring, ([entry.numerator for entry in row] for row in value.rows))
        N = rate - C.scale(ring.constant(2))
        return (N + N.T).is_zero

    # -- follows, or wrong -------------------------------------------------------------------------

    def _scalar(
        self, base: JudgedAnswer, compared: KeyComparison, whole: PossibleValue | None
    ) -> JudgedAnswer:
        one = self._entry(base.name, compared, (1, 1), 0, 0, whole)
        is_constant = any(found.code == "constant_term" for found in one.diagnosis)
        return replace(
            base,
            notes=(*base.notes, UNAFFECTED) if is_constant else base.notes,
            verdict=one.verdict,
            follows_from=one.follows_from,
            diagnosis=one.diagnosis,
            difference=one.difference,
        )

    def _matrix(
        self, base: JudgedAnswer, compared: KeyComparison, entries: tuple[EntryVerdict, ...]
    ) -> JudgedAnswer:
        verdict = worst([entry.verdict for entry in entries])
        found = tuple(dict.fromkeys(one for entry in entries for one in entry.diagnosis))
        sources: tuple[str, ...] = ()
        if verdict is Verdict.WRONG:
            wrong = [
                self._wrong_entry(base.name, compared, i, j)
                for entry, (_, i, j) in zip(entries, _entries(base.name, compared), strict=True)
                if entry.verdict is Verdict.WRONG
            ]
            of_entries = found
            found = attempted(
                lambda: self.diagnoser.matrices(wrong, compared, of_entries),
                lambda: of_entries,
                f"what is said of {base.name}",
            )
        elif verdict is Verdict.FOLLOWS:
            used = (name for entry in entries for name in entry.follows_from)
            sources = in_order(self.hand_in.graph, used)
        return replace(base, verdict=verdict, entries=entries, diagnosis=found, follows_from=sources)

    def _entry(
        self,
        name: str,
        compared: KeyComparison,
        index: tuple[int, ...],
        i: int,
        j: int,
        whole: PossibleValue | None,
    ) -> EntryVerdict:
        if compared.right[i][j] is not None:
            return EntryVerdict(index, Verdict.CORRECT)
        source = self.explanations.of_entry(compared, i, j, whole)
        if source is not None:
            follows_from = in_order(self.hand_in.graph, source.used)
            return EntryVerdict(index, Verdict.FOLLOWS, follows_from=follows_from)
        plain = EntryVerdict(index, Verdict.WRONG)
        return attempted(
            lambda: self._diagnosed(plain, self._wrong_entry(name, compared, i, j), compared),
            lambda: plain,
            f"what is said of {name}",
        )

    def _diagnosed(self, base: EntryVerdict, wrong: WrongEntry, compared: KeyComparison) -> EntryVerdict:
        told = self.diagnoser.of_coriolis(wrong, compared) if wrong.name == "C" else self.diagnoser(wrong)
        return replace(base, diagnosis=told, difference=self.diagnoser.difference(wrong))

    def _wrong_entry(self, name: str, compared: KeyComparison, i: int, j: int) -> WrongEntry:
        key = self.hand_in.compare.key(compared.target)
        expected = (*self.explanations.expected(compared.target), key)
        wrong = WrongEntry(
            name=name,
            target=compared.target,
            written=compared.rows[i][j],
            expected=tuple(entry_of(value, i, j) for value in expected),
            row=i,
            column=j,
            called=_called(name, compared, i, j),
        )
        return multiplied_back(wrong) if compared.answer_value.answer.is_equation else wrong

    def _missing(self, judged: JudgedAnswer, missed: Missed) -> JudgedAnswer:
        """An answer that misses an equation, which is told first, unless a slip explains it.

        Where the key is one of many solutions, such an answer is wrong as a whole.
        """
        kept = judged.diagnosis
        if missed.is_one_of_many:
            kept = tuple(one for one in kept if one.code in _BY_ITSELF)
            judged = replace(judged, entries=(), difference=None)
        elif kept:
            return judged
        row = ""
        if missed.value is not None and missed.goal is not None:
            value, goal = map(self.diagnoser.words.fraction, (missed.value, missed.goal))
            is_short = max(len(value), len(goal)) <= LONGEST // 2
            row = f": in row {missed.row}, {missed.left} is {value} and not {goal}" if is_short else row
            row = row or f": see row {missed.row}"
        return replace(judged, diagnosis=(slip("equation", part=row, other=missed.equation), *kept))

    # -- where it was given several times ----------------------------------------------------------

    def _occurrences(self, name: str, chains: list[Chain]) -> tuple[Occurrence, ...]:
        """Each place where it was given, where there are several."""
        if len(chains) < 2:
            return ()
        values = [last([chain]) for chain in chains]
        return tuple(Occurrence(v.answer.place, v.answer.label, self._verdict(name, v)) for v in values)

    def _verdict(self, name: str, value: AnswerValue) -> Verdict:
        """The verdict of one occurrence, without its diagnosis."""
        compared = self.hand_in.compare(name, value)
        if value.rows is None:
            return Verdict.UNREADABLE
        if compared.correct:
            return Verdict.CORRECT
        if not compared.rows or compared.obstacles:
            return Verdict.WRONG
        if self.explanations.of_whole(compared) is not None:
            return Verdict.FOLLOWS
        verdicts = []
        for i, row in enumerate(compared.right):
            for j, right in enumerate(row):
                follows = right is None and self.explanations.explains_entry(compared, i, j)
                verdicts.append(
                    Verdict.CORRECT if right is not None else Verdict.FOLLOWS if follows else Verdict.WRONG
                )
        return worst(verdicts)


_BY_ITSELF = ("dimensions", "unknown_symbol", "odd_argument", "numbers_for_letters")
"""What is told of an entry by itself, whatever the key is."""


def _placed_in_chain(base: JudgedAnswer, chain: Chain) -> JudgedAnswer:
    """The place of the slip in a = b = c: the first member that differs from the one before it."""
    for before, after in pairwise(chain):
        if before.rows is None or after.rows is None or same(before.rows, after.rows):
            continue
        note = f"differs from what stands before it, {before.answer.text.strip()}"
        return replace(base, place=after.answer.place, notes=(*base.notes, note))
    first = chain[0].answer
    return replace(base, place=first.place if len(chain) > 1 else base.place)


def _called(name: str, compared: KeyComparison, i: int, j: int) -> str:
    if name == "C":
        return f"Row {i + 1} of C q̇"
    height, width = len(compared.rows), len(compared.rows[0])
    if height * width == 1:
        return "Your answer"
    return f"Entry {i + 1}" if width == 1 else f"Entry ({i + 1}, {j + 1})"


def _entries(name: str, compared: KeyComparison) -> Iterator[tuple[tuple[int, ...], int, int]]:
    """(index from 1, row, column) of the entries that are judged one by one; none of a scalar."""
    if len(compared.rows) == 1 and len(compared.rows[0]) == 1:
        return
    for i, row in enumerate(compared.rows):
        for j in range(len(row)):
            yield ((i + 1,) if name == "C" else (i + 1, j + 1)), i, j


def in_order(graph: AnswerGraph, names: Iterable[str]) -> tuple[str, ...]:
    """Answers in the order of the derivation, each once."""
    return tuple(sorted(dict.fromkeys(names), key=graph.quantities.position))


def waiting(answer: JudgedAnswer, fault: str) -> JudgedAnswer:
    """A wrong answer that a human has to look at, and why."""
    return replace(
        answer, verdict=Verdict.UNREADABLE, fault=fault, waits=True, entries=(), diagnosis=(),
        difference=None, loss="",
    )  # fmt: skip


# The verdict of a set of configurations: singular ones, branches of the inverse kinematics


def _as_read(
    answer: ConfigurationAnswer | VerdictAnswer, of: Fraction, asked: Container[str]
) -> JudgedAnswer:
    """The record of what is no formula, with its fault where it could not be read or was not asked for."""
    foreign = "" if answer.name in asked else f"{answer.name} is not asked for in this problem"
    return JudgedAnswer(
        answer.name, Verdict.UNREADABLE, place=answer.place, read_as=answer.text, of=of,
        fault=answer.fault or foreign, expected=answer.expected,
    )  # fmt: skip


def judged_set(
    key: ConfigurationKey,
    answer: ConfigurationAnswer,
    of: Fraction,
    explanations: Explanations,
    unread: Mapping[str, str],
) -> JudgedAnswer:
    """What is said of a set; `of` are its marks, `unread` as in `Explanations.before`."""
    base = _as_read(answer, of, key.values.rules)
    if base.fault:
        return base
    if key[answer.name].is_skipped:
        return replace(base, fault=f"{answer.name} could not be derived here; a person must judge it")
    found = key.verdict(answer)
    if found.is_right:
        return replace(base, verdict=Verdict.CORRECT, notes=found.notes)
    for values, used in _own_values(explanations, key[answer.name].made_of):
        if key[answer.name].verdict_with(answer.alternatives, values).is_right:
            sources = in_order(explanations.hand_in.graph, used)
            return replace(base, verdict=Verdict.FOLLOWS, follows_from=sources)
    if zero := key[answer.name].vanishing:
        graph = explanations.hand_in.graph
        for own in explanations.own_values(zero):
            if key.is_where_zero(answer, own.value):
                return replace(base, verdict=Verdict.FOLLOWS, follows_from=in_order(graph, own.used))
        if sources := in_order(graph, explanations.before(zero, unread)):
            return replace(base, fault=MAY_FOLLOW.format(" and ".join(sources)), waits=True)
    said = {"number": str(found.number), "where": found.where, "what": found.what}
    fault = told(key.fault(answer.name, found.code), **said)
    return replace(base, verdict=Verdict.WRONG, diagnosis=(fault,))


def _own_values(
    explanations: Explanations, names: Sequence[str]
) -> Iterator[tuple[dict[str, Matrix], frozenset[str]]]:
    """The student's own values of some results, or of one or more of them beside the key's of the others."""
    choices = [
        [None, *(own for own in explanations.own_values(name) if isinstance(own.value, Matrix))]
        for name in names
    ]
    for chosen in product(*choices):
        own = {name: one for name, one in zip(names, chosen, strict=True) if one is not None}
        if own:
            used = frozenset().union(*(one.used for one in own.values()))
            yield {name: one.value for name, one in own.items()}, used


# The verdict of what a student says of matrices: whether each can be an inertia matrix


def judged_verdicts(robot: Robot, derived: Derivation, answer: VerdictAnswer, of: Fraction) -> JudgedAnswer:
    """What is said of the verdicts on matrices, each an entry of its own; `of` are their marks."""
    base = _as_read(answer, of, derived.rules)
    if base.fault:
        return base
    names = [candidate.name for candidate in robot.questions.candidates]
    spelled = {key(name): name for name in names}
    given = {spelled.get(key(name), name): word for name, word in answer.words}
    if len(names) == 1 and "" in given:
        given = {names[0]: given[""]}
    foreign = [name for name in given if name not in names]
    if foreign:
        return replace(
            base, fault=f"there is no matrix {foreign[0]}", expected=f"they are {', '.join(names)}"
        )
    entries = tuple(
        _entry(place, name, found, given.get(name, ""))
        for place, (name, found) in enumerate(zip(names, derived[answer.name], strict=True), 1)
    )
    unread = (entry.verdict is Verdict.UNREADABLE for entry in entries)
    undecided = [name for name, is_unread in zip(names, unread, strict=True) if is_unread]
    if undecided:
        return replace(base, fault=f"{', '.join(undecided)} must be judged by a person", entries=entries)
    slips = tuple(dict.fromkeys(one for entry in entries for one in entry.diagnosis))
    return replace(base, verdict=worst([e.verdict for e in entries]), entries=entries, diagnosis=slips)


def _entry(place: int, name: str, found: object, word: str) -> EntryVerdict:
    if not isinstance(found, Definiteness):
        return EntryVerdict((place,), Verdict.UNREADABLE)
    if not word:
        return EntryVerdict((place,), Verdict.MISSING)
    wrong = fault(found, word)
    if wrong is None:
        return EntryVerdict((place,), Verdict.CORRECT)
    return EntryVerdict((place,), Verdict.WRONG, (told(wrong, number=name),))
