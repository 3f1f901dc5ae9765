"""The verdicts of a hand-in: compared, explained, diagnosed, reported.

    the hand-in, compared with the key     judging.hand_in
    what its own answers lead to           judging.explanation
    the verdict of each answer             answer_verdict
    what is not written by itself          unwritten

The answers of the report stand in the order of the derivation, so that the first slip
comes first.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from fractions import Fraction
from functools import cached_property

from dynsolve.answers.answer_verdict import MAY_FOLLOW, NOT_GENERAL, AnswerJudge, in_order, waiting
from dynsolve.answers.configuration_verdict import judged_set
from dynsolve.answers.definite_verdict import judged_verdicts
from dynsolve.answers.diagnosis.changed_rules import DerivationSlips
from dynsolve.answers.diagnosis.diagnoser import Diagnoser
from dynsolve.answers.diagnosis.factors import FactorPairs
from dynsolve.answers.general_formulas import general_formulas, is_given, needed
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.configurations import ConfigurationKey
from dynsolve.answers.judging.entry_comparison import EntryComparer
from dynsolve.answers.judging.explanation import Explanations
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.hand_in import ComparedHandIn
from dynsolve.answers.ledger import Ledger
from dynsolve.answers.marking.marks import mark
from dynsolve.answers.marking.policy import Policy
from dynsolve.answers.marking.substance import weighed
from dynsolve.answers.reading.files import FileReader
from dynsolve.answers.reading.sentences import NO_CLAIMS
from dynsolve.answers.submission import NotRecognized, Submission
from dynsolve.answers.table_verdict import NAME as TABLE
from dynsolve.answers.table_verdict import TableJudge
from dynsolve.answers.unwritten import coriolis_entries, unwritten
from dynsolve.answers.verdict import JudgedAnswer, Report, Verdict
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import derive
from dynsolve.problem.model import Problem
from dynsolve.quantities.index import quantities


class Checker:
    """Judges hand-ins to one problem; what they all share is made once.

    `key` is the problem's derivation, where it has been made already.
    """

    def __init__(self, problem: Problem, key: Derivation | None = None) -> None:
        if problem.robot.questions.state_is_open:
            from dynsolve.solution.reached_state import with_reached_state

            problem = with_reached_state(problem)
        self.problem = problem
        self.key = key if key is not None else derive(problem.robot)
        self.answer_ring = AnswerRing(problem.robot, self.key)
        self.compare_entry = EntryComparer(problem.values, problem.decimals)

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
        return DerivationSlips(AnswerGraph(self.answer_ring))

    @cached_property
    def factors(self) -> FactorPairs:
        """The factors that are mistaken for one another, in the problem's own ring."""
        return FactorPairs(self.answer_ring.ring)

    @cached_property
    def configurations(self) -> ConfigurationKey:
        """The sets of configurations that are right."""
        return ConfigurationKey(self.problem.robot, self.key, self.problem.values, self.problem.decimals)

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
        self.hand_in = ComparedHandIn(checker.answer_ring, checker.compare_entry, others)
        self.graph = self.hand_in.graph

    @cached_property
    def explanations(self) -> Explanations:
        """What the student's own answers lead to."""
        return Explanations(self.hand_in)

    @cached_property
    def _diagnoser(self) -> Diagnoser:
        checker, ring = self.checker, self.hand_in.answer_ring
        is_shared = ring.same and self.graph.zero_potential is None and not self.graph.parameters
        changed = checker.derivation_slips if is_shared else DerivationSlips(self.graph)
        factors = checker.factors if ring.same else FactorPairs(ring.ring)
        return Diagnoser(self.problem, self.graph, self.explanations.values, changed, factors)

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
        unread = self._unread(answers)
        answers = self._with_waiting(answers, unread)
        if self.tables:
            answers[TABLE] = self.checker.table_judge(self.tables)
        sets = self.submission.configurations
        answers |= {
            answer.name: judged_set(
                self.checker.configurations,
                answer,
                self._marks_of(answer.name),
                self.explanations,
                unread,
            )
            for answer in sets
        }
        answers |= {
            answer.name: judged_verdicts(
                self.problem.robot, self.checker.key, answer, self._marks_of(answer.name)
            )
            for answer in self.submission.verdicts
        }
        assembled = self.hand_in.assembled_coriolis
        if assembled is not None:
            answers |= dict(coriolis_entries(judge, assembled, answers))
        for name in dict.fromkeys((*self._asked, *self._wholes)):
            if name not in answers and (name == TABLE or self._has_key(name)):
                answers[name] = self._unwritten(name, answers)
        for name in self.hand_in.definitions.keys() - answers.keys():
            if (defined := self._unwritten(name, answers)).verdict is Verdict.MISSING:
                answers[name] = defined
        return answers

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
            if answer.verdict is not Verdict.WRONG:
                continue
            if doubt := compared.answer_value.answer.doubt:
                found[name] = waiting(answer, NOT_GENERAL.format(doubt))
            elif unread and not compared.obstacles:
                sources = in_order(self.graph, self.explanations.hanging_on(compared, unread))
                if sources:
                    found[name] = waiting(answer, MAY_FOLLOW.format(" and ".join(sources)))
        return found

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
        for name, chains in self.hand_in.definitions.items():
            judged = {chain[0].answer.occurrence[0] for chain in given.get(name, ())}
            unjudged = (chain for chain in chains if chain[0].answer.occurrence[0] not in judged)
            for value in (value for chain in unjudged for value in chain):
                text, label, place = f"{name} = {value.answer.text}", value.answer.label, value.answer.place
                refused.append(NotRecognized(text, label, place, value.fault, (name,)))
        return Ledger(named, answers, refused, explained)

    @property
    def _wholes(self) -> list[str]:
        """The matrices that were written, of which not every entry could be read."""
        return [answer.whole for answer in self.submission.answers if answer.whole]

    @property
    def _asked(self) -> Collection[str]:
        return self.problem.marks or self.problem.find

    def _has_key(self, name: str) -> bool:
        return self.hand_in.compare.target(name).node in self.hand_in.answer_ring.rules

    def _marks_of(self, name: str) -> Fraction:
        return Fraction(self.problem.marks.get(name, 0))

    def _unwritten(self, name: str, answers: dict[str, JudgedAnswer]) -> JudgedAnswer:
        return unwritten(self.graph, name, Fraction(self.problem.marks.get(name, 0)), answers)


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
