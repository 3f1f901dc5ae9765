"""The verdicts of a hand-in: compared, explained, diagnosed, reported.

    the hand-in, compared with the key     judging.hand_in
    what its own answers lead to           judging.explanation
    the verdict of each answer             answer_verdict
    what is not written by itself          unwritten

The answers of the report stand in the order of the derivation, so that the first slip
comes first.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction
from functools import cached_property

from msgspec.structs import replace

from dynsolve.answers.answer_verdict import (
    MAY_FOLLOW,
    NOT_FOUND,
    NOT_GENERAL,
    AnswerJudge,
    in_order,
    judged_set,
    judged_verdicts,
    waiting,
)
from dynsolve.answers.diagnosis.diagnoser import Diagnoser
from dynsolve.answers.diagnosis.factors import FactorPairs
from dynsolve.answers.diagnosis.own_steps import DerivationSlips
from dynsolve.answers.diagnosis.wrong_entry import TermWriter
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.configurations import ConfigurationKey
from dynsolve.answers.judging.entry_comparison import EntryComparer
from dynsolve.answers.judging.explanation import Explanations
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.hand_in import ComparedHandIn
from dynsolve.answers.marks import Policy, mark, weighed
from dynsolve.answers.reading.files import FileReader
from dynsolve.answers.reading.report_text import NO_CLAIMS
from dynsolve.answers.table_verdict import NAME as TABLE
from dynsolve.answers.table_verdict import TableJudge
from dynsolve.answers.unwritten import coriolis_entries, general_formulas, is_given, needed, unwritten
from dynsolve.answers.verdict import (
    JudgedAnswer,
    Ledger,
    NotRecognized,
    Report,
    Submission,
    Verdict,
)
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import derive
from dynsolve.problem.model import Problem
from dynsolve.quantities.family import FORMED
from dynsolve.quantities.index import quantities
from dynsolve.questions.constraints import MULTIPLIERS
from dynsolve.questions.constraints.judge import IN_MOTION


class Checker:
    """Judges hand-ins to one problem; what they all share is made once.

    `key` is the problem's derivation, where it has been made already.
    """

    def __init__(self, problem: Problem, key: Derivation | None = None) -> None:
        if problem.robot.questions.state_is_open:
            from dynsolve.solution.asked_checks import with_reached_state

            problem = with_reached_state(problem)
        self.problem = problem
        self.key = key if key is not None else derive(problem.robot)
        self.graph = AnswerGraph(AnswerRing(problem.robot, self.key))
        self.compare_entry = EntryComparer(problem.values, problem.decimals)
        self._words: TermWriter | None = None

    @cached_property
    def reader(self) -> FileReader:
        """Reads what is handed in."""
        return FileReader(self.problem)

    @cached_property
    def table_judge(self) -> TableJudge:
        """Judges Denavit-Hartenberg tables."""
        return TableJudge(self.problem)

    @cached_property
    def derivation_slips(self) -> DerivationSlips:
        """The derivations with a rule changed, in the problem's own ring."""
        return DerivationSlips(self.graph)

    @cached_property
    def factors(self) -> FactorPairs:
        """The factors that are mistaken for one another, in the problem's own ring."""
        return FactorPairs(self.graph.answer_ring.ring)

    def words(self) -> TermWriter:
        """Writes terms of the problem's own ring in messages."""
        if self._words is None or self._words.remembers_many:
            self._words = TermWriter(self.graph.answer_ring, self.problem.robot)
        return self._words

    @cached_property
    def configurations(self) -> ConfigurationKey:
        """The sets of configurations that are right."""
        return ConfigurationKey(self.problem.robot, self.key, self.problem.values, self.problem.decimals)

    def work_out(self, submission: Submission) -> None:
        """Work out the key's values of what is handed in, and of what is asked for that has a form."""
        named = self.graph.quantities
        asked = (name for name in self.problem.marks or self.problem.find if name in named)
        formed = [name for name in asked if named[name].family.kind in FORMED]
        written = [answer.name for answer in submission.answers]
        written += [answer.name for answer in submission.configurations]
        written += [answer.name for answer in submission.verdicts]
        for node in map(self.graph.node, (*formed, *written)):
            if node in self.key.rules:
                self.graph.key(node)

    def __call__(self, submission: Submission) -> Report:
        """Judge a hand-in."""
        return self.report(Judge(self, submission))

    def report(self, judge: Judge) -> Report:
        """All verdicts of a hand-in; what follows a table in other frames is judged in these, too."""
        submission, report = judge.submission, judge.report()
        tables = [answer for answer in submission.answers if answer.name == TABLE]
        if not tables or len(tables) == len(submission.answers):
            return report
        for own in self.table_judge.own_problems(tables[-1]):
            if all(answer.verdict in RIGHT for answer in report.answers if answer.given):
                break
            report = in_either(report, Judge(Checker(own), submission).report())
        return report


def check(problem: Problem, submission: Submission, key: Derivation | None = None) -> Report:
    """Judge one hand-in; see `Checker` for many."""
    return Checker(problem, key)(submission)


class Judge:
    """Judges one hand-in."""

    def __init__(self, checker: Checker, submission: Submission) -> None:
        self.checker = checker
        self.problem = checker.problem
        self.submission = submission
        self.tables = [answer for answer in submission.answers if answer.name == TABLE]
        others = [answer for answer in submission.answers if answer.name != TABLE]
        general = list(general_formulas(submission, self._asked, quantities(self.problem.robot)))
        self._general = {answer.name for answer in general}
        others += general
        self.hand_in = ComparedHandIn(checker.graph, checker.compare_entry, others, submission.general)
        self._abbreviations = list[JudgedAnswer]()
        self.graph = self.hand_in.graph

    @cached_property
    def explanations(self) -> Explanations:
        """What the student's own answers lead to."""
        return Explanations(self.hand_in)

    @cached_property
    def _diagnoser(self) -> Diagnoser:
        checker, ring = self.checker, self.hand_in.answer_ring
        is_shared = self.graph is checker.graph
        changed = checker.derivation_slips if is_shared else DerivationSlips(self.graph)
        factors = checker.factors if ring.same else FactorPairs(ring.ring)
        words = checker.words() if ring.same else TermWriter(ring, self.problem.robot)
        return Diagnoser(self.problem, self.graph, self.explanations.values, changed, factors, words)

    def report(self) -> Report:
        """Everything that is said of the hand-in."""
        answers = self._answers()
        ledger = self._ledger(answers)
        answers = ledger.waiting(answers)
        position = self.graph.quantities.position
        in_order = tuple(sorted(answers.values(), key=lambda answer: position(answer.name)))
        ordered = weighed(self.problem, self.hand_in, in_order)
        wrong = sorted(
            (answer for answer in ordered if answer.verdict is Verdict.WRONG),
            key=lambda answer: (not answer.given, self._comes_late(answer.name)),
        )
        return Report(
            self.problem.stem,
            self.submission.student,
            self.submission.file,
            self._marked(ordered),
            tuple(ledger.not_recognized),
            wrong[0].name if wrong else "",
            self.submission.faults,
            tuple(ledger.set_aside),
        )

    def _comes_late(self, name: str) -> bool:
        """Whether an answer is a torque of a hand-in that assembles them from D, C and g."""
        direction = self.explanations.direction
        return self.graph.node(name) in direction.forces and direction.is_assembled()

    def _marked(self, answers: tuple[JudgedAnswer, ...]) -> tuple[JudgedAnswer, ...]:
        """The answers with the marks that they earn where a course decides nothing else."""
        marks = mark(answers, self.graph.quantities, Policy())
        return tuple(replace(a, marks=m.marks) for a, m in zip(answers, marks, strict=True))

    def _answers(self) -> dict[str, JudgedAnswer]:
        """The answers that were given, and those that were asked for, by name."""
        judge = AnswerJudge(self.problem, self.hand_in, self.explanations, self._diagnoser)
        answers = {name: judge(name) for name in self.hand_in.chains}
        for name in list(self._own_names(answers)):
            self._abbreviations.append(answers.pop(name))
        unread = self._unread(answers)
        answers = self._with_waiting(answers, unread)
        if self.tables:
            answers[TABLE] = self.checker.table_judge(self.tables)
        sets = self.submission.configurations
        answers |= {
            one.name: judged_set(
                self.checker.configurations, one, self._marks_of(one.name), self.explanations, unread
            )
            for one in sets
        }
        answers |= {
            one.name: judged_verdicts(self.problem.robot, self.checker.key, one, self._marks_of(one.name))
            for one in self.submission.verdicts
        }
        assembled = self.hand_in.assembled_coriolis
        if assembled is not None:
            answers |= dict(coriolis_entries(judge, assembled, answers))
        wholes = (answer.whole for answer in self.submission.answers if answer.whole)
        target, rules = self.hand_in.compare.target, self.hand_in.answer_ring.rules
        for name in dict.fromkeys((*self._asked, *wholes)):
            if name not in answers and (name == TABLE or target(name).node in rules):
                answers[name] = self._unwritten(name, answers)
        for name in self.hand_in.definitions.keys() - answers.keys():
            if (defined := self._unwritten(name, answers)).verdict is Verdict.MISSING:
                answers[name] = defined
        return answers

    def _own_names(self, answers: dict[str, JudgedAnswer]) -> Iterator[str]:
        """What is wrong as an answer, unasked, and makes others right: an abbreviation, m_12 = m_2 + m_L."""
        for name, answer in answers.items():
            if answer.verdict is not Verdict.WRONG or name in self._asked:
                continue
            if self.graph.quantities[name].family in MULTIPLIERS:  # a λ in an equation is its unknown
                continue
            made = [
                answers[other]
                for other, chains in self.hand_in.chains.items()
                if any(name in value.answer.references for chain in chains for value in chain)
            ]
            if made and all(one.verdict is Verdict.CORRECT for one in made):
                yield name

    def _unread(self, answers: dict[str, JudgedAnswer]) -> dict[str, str]:
        """The nodes of what could not be read, and the answers of these that stand for them."""
        quantities, read = self.graph.quantities, {n for n, a in answers.items() if a.read_as}
        unknown = (one for one in self.submission.not_recognized if one.why not in NO_CLAIMS)
        named = (
            name
            for one in unknown
            for name in one.answers
            if read.isdisjoint({name, quantities.entry_of(name)[0]})
            and not (quantities.parts(name) and read.issuperset(quantities.parts(name)))
        )
        faulty = (name for name, answer in answers.items() if answer.verdict is Verdict.UNREADABLE)
        target, rules = self.hand_in.compare.target, self.hand_in.answer_ring.rules
        return {node: name for name in (*named, *faulty) if (node := target(name).node) in rules}

    def _with_waiting(
        self, answers: dict[str, JudgedAnswer], unread: dict[str, str]
    ) -> dict[str, JudgedAnswer]:
        """The answers; what is not right waits if it may be of one case, or follow from what was not read."""
        found = dict(answers)
        for name, answer in answers.items():
            compared = self.hand_in.comparisons[name]
            if any(IN_MOTION in note for note in answer.notes) and not self._finds_accelerations:
                found[name] = waiting(answer, NOT_FOUND)
            if answer.verdict is not Verdict.WRONG:
                continue
            if compared.waits:
                found[name] = waiting(answer, compared.waits)
            elif doubt := compared.answer_value.answer.doubt:
                found[name] = waiting(answer, NOT_GENERAL.format(doubt))
            elif unread and not compared.obstacles:
                sources = self._not_or(in_order(self.graph, self.explanations.hanging_on(compared, unread)))
                if sources:
                    found[name] = waiting(answer, MAY_FOLLOW.format(" and ".join(sources)))
        return found

    @property
    def _finds_accelerations(self) -> bool:
        """Whether the hand-in has what the accelerations come to, or equations that they are found from."""
        sets = {one.name for one in self.submission.configurations}
        return bool({"qdd_forward", "reduced"} & (sets | self.hand_in.chains.keys()))

    def _not_or(self, names: Sequence[str]) -> list[str]:
        """Answers that could not be read, the first of those that one equation may be: V is P, or C q̇."""
        others: set[str] = set()
        for one in self.submission.not_recognized:
            others |= set([name for name in one.answers if name in names][1:])
        return [name for name in names if name not in others]

    def _ledger(self, answers: dict[str, JudgedAnswer]) -> Ledger:
        """What becomes of the equations that are none of the answers; formulas that count are."""
        named, given = self.graph.quantities, self.hand_in.chains
        refused, explained = list(self.submission.not_recognized), list[NotRecognized]()
        for one in self.submission.left_alone:
            needs = needed(named, one.answers[0], one.needs) if one.needs else []
            lacking = [name for name in needs if not is_given(named, name, given)]
            if lacking and not any(is_given(named, name, given) for name in one.answers):
                why = f"{lacking[0]} stands in it and is given nowhere: this is a definition"
                refused.append(replace(one, why=why))
            elif lacking or not one.needs or self._general.isdisjoint(one.answers):
                explained.append(one)
        explained += (
            NotRecognized(own.read_as, own.label, own.place, "it defines an abbreviation")
            for own in self._abbreviations
            if own.place is not None
        )
        for name, chains in self.hand_in.definitions.items():
            judged = {chain[0].answer.occurrence[0] for chain in given.get(name, ())}
            unjudged = (chain for chain in chains if chain[0].answer.occurrence[0] not in judged)
            for value in (value for chain in unjudged for value in chain):
                text, label, place = f"{name} = {value.answer.text}", value.answer.label, value.answer.place
                refused.append(NotRecognized(text, label, place, value.fault, (name,)))
        return Ledger(named, answers, refused, explained)

    @property
    def _asked(self) -> Collection[str]:
        return self.problem.marks or self.problem.find

    def _marks_of(self, name: str) -> Fraction:
        return Fraction(self.problem.marks.get(name, 0))

    def _unwritten(self, name: str, answers: dict[str, JudgedAnswer]) -> JudgedAnswer:
        return unwritten(self.graph, name, self._marks_of(name), answers)


IN_OWN_FRAMES = "in your own frames"
RIGHT = (Verdict.CORRECT, Verdict.FOLLOWS)


def in_either(keys: Report, own: Report) -> Report:
    """The report where each answer counts in the key's frames or in those of the student's table."""
    theirs = {answer.name: answer for answer in keys.answers}
    answers = tuple(_better(theirs.get(answer.name), answer) for answer in own.answers)
    wrong = [answer.name for answer in answers if answer.verdict is Verdict.WRONG]
    firsts = [first for first in (own.first_wrong, keys.first_wrong, *wrong) if first in wrong]
    return replace(own, answers=answers, first_wrong=firsts[0] if firsts else "")


def _better(in_keys: JudgedAnswer | None, in_own: JudgedAnswer) -> JudgedAnswer:
    if in_keys is None or in_own.name == TABLE:
        return in_keys or in_own
    ranks = [RIGHT.index(a.verdict) if a.verdict in RIGHT else len(RIGHT) for a in (in_keys, in_own)]
    if ranks[0] < ranks[1]:
        return in_keys
    is_other = in_own.given and ranks[0] != ranks[1]
    return replace(in_own, notes=(*in_own.notes, IN_OWN_FRAMES)) if is_other else in_own
