"""Solutions as documents: the choice and the order of the steps that are shown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from operator import attrgetter

from dynsolve.derivation.rules import course_rules
from dynsolve.document import Block, Document, Equations, Fold, Heading, List, Prose, Text, reworded
from dynsolve.document.sentences import say
from dynsolve.errors import attempted
from dynsolve.explain.abbreviations import CONSTANTS_LIST, SUMS_LIST, Abbreviate, Abbreviated, Definition
from dynsolve.explain.given import statement
from dynsolve.explain.notation_list import in_a_sentence, letters_beside, notation, shorthands_in
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.terms import ID
from dynsolve.explain.writing import (
    GAUTIER_KHALIL,
    KHALIL_DOMBRE,
    cited,
    listed,
    machine,
    of_second_edition,
    titled,
)
from dynsolve.notation.tree import Number, Power, Row, Words, equation
from dynsolve.notation.walk import walk
from dynsolve.quantities.robot_stages import heading_of, stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.solution.depths import Drawn, Shown
from dynsolve.solution.dynamics import Dynamics
from dynsolve.solution.measured_steps import measured_steps
from dynsolve.solution.summary import in_summary, summary_blocks


def solution_document(
    solution: Dynamics,
    detail: Detail = Detail.NORMAL,
    stages: Iterable[str] | None = None,
    abbreviate: Abbreviate = Abbreviate.AUTO,
    drawn: Drawn | None = None,
) -> Document:
    """A solution with the steps of some stages, in the depth of `detail`.

    `abbreviate` says whether long results are written in names, which are defined first; `drawn`
    makes the pictures of steps that have one, where there can be any.
    """
    (document,) = solution_documents(solution, (detail,), stages, abbreviate, drawn)
    return document


def solution_documents(
    solution: Dynamics,
    details: Sequence[Detail],
    stages: Iterable[str] | None = None,
    abbreviate: Abbreviate = Abbreviate.AUTO,
    drawn: Drawn | None = None,
) -> tuple[Document, ...]:
    """The same in several depths, of steps that are made once."""
    stages = None if stages is None else tuple(stages)

    def made(short: Abbreviated | None) -> tuple[Document, ...]:
        steps = tuple(measured_steps(solution.explain(stages, short), solution.robot, solution.style))
        parts = (_Parts(solution, detail, stages, steps, drawn, short) for detail in details)
        return tuple(each.document() for each in parts)

    names = "what is written in names"
    short = attempted(lambda: solution.abbreviated(abbreviate), lambda: None, names)
    return made(None) if short is None else attempted(lambda: made(short), lambda: made(None), names)


_IN_NUMBERS = (
    "Numbers are exact, in SI units (m, kg, s, N). One with more than {digits} significant digits is "
    "rounded to these where it is printed, and nowhere else; ≈ marks that. A unit stands behind a result "
    "that is a number other than 0, or a matrix of which all entries have it; any other formula has that "
    "of its left side."
)


@dataclass
class _Parts:
    """The parts of a document, of which one that cannot be made is left out."""

    solution: Dynamics
    detail: Detail
    stages: tuple[str, ...] | None
    steps: Sequence[Step]
    drawn: Drawn | None
    short: Abbreviated | None
    sections: dict[Stage, int] = field(default_factory=dict)

    def document(self) -> Document:
        """What is given, the derivation, the summary, how it is verified, the notation."""

        def part(what: str, made: Callable[[], Iterable[Block]]) -> tuple[Block, ...]:
            return attempted(lambda: tuple(made()), tuple, what)

        derivation = (
            *self.derivation(),
            *part("the numbers", self.numbers),
            *part("the summary", self.summary),
        )
        stated = part("what is given", lambda: self.statement(derivation))
        document = Document((
            *self.opening(),
            *stated,
            *part("the letters", lambda: self.letters(stated, derivation)),
            *derivation,
            *self.closing(),
            *part("the notation", lambda: self.notation((*stated, *derivation))),
        ))  # fmt: skip
        return reworded(document, of_second_edition) if self.solution.problem.edition == 2 else document

    def opening(self) -> Iterator[Block]:
        """The title, the source, and how numbers are printed."""
        problem = self.solution.problem
        yield Heading(problem.title, 1)
        if problem.source:
            yield Text((f"{problem.source.rstrip('.')}.",))
        if digits := self.solution.style.digits:
            yield Text(say(_IN_NUMBERS, digits=digits))

    def statement(self, derivation: tuple[Block, ...]) -> Iterator[Block]:
        """The exercise, before a whole solution of it."""
        if self.stages is None:
            sines = shorthands_in(derivation, self.solution.robot, self.solution.style)
            yield from statement(self.solution.forms, self.solution.problem, sines)

    def letters(self, stated: tuple[Block, ...], shown: tuple[Block, ...]) -> Iterator[Block]:
        """In brief the letters that go beyond the course and are not defined where they occur."""
        if self.detail is Detail.BRIEF:
            lines = letters_beside(self.solution.robot, self.solution.style, shown, stated)
            if lines:
                yield Text(in_a_sentence(lines))

    def notation(self, shown: tuple[Block, ...]) -> Iterator[Block]:
        """In full every sign that occurs in what is shown, with its meaning and unit."""
        if self.detail is Detail.FULL:
            told = notation(self.solution.robot, self.solution.style, shown, self.short)
            if told.lines:
                yield Heading("Notation", appendix=True)
                yield from (Text(told.remarks),) if told.remarks else ()
                yield told.table

    def numbers(self) -> Iterator[Block]:
        """The section of numeric results, where they were asked for."""
        if self.solution.numbers is not None:
            from dynsolve.solution.numbers.blocks import blocks

            yield from blocks(self.solution.numbers, self.detail, self.solution.problem.find, self.stages)

    def derivation(self) -> Iterator[Block]:
        """Stages and their steps; in a whole derivation what is shown of it is counted."""
        robot, short, asked = self.solution.robot, self.short, self.solution.problem.find
        places = {stage: place for place, stage in enumerate(stages_of(robot), 1)}
        inputs = {rule.name: rule.inputs for rule in course_rules(robot)}
        named_from = _first_in_names(self.steps, short)
        in_closing = in_summary(robot, self.steps, asked, self.solution.is_short)
        shown = Shown(self.detail, inputs, self.solution.style, self.drawn, in_closing)
        own = (step for step in self.steps if step.id != ID)  # that stands in the summary
        for stage, of_stage in groupby(own, attrgetter("stage")):
            is_named = short is not None and stage is named_from and not short.at_symbols
            if short is not None and is_named and self.detail > Detail.RESULTS:
                yield from definition_blocks(short, machine(robot))
            number = places[stage] if self.stages is not None else len(self.sections) + 1
            folds = tuple(shown.of_stage(number, of_stage))
            if folds:  # no heading over a stage of which nothing is shown
                self.sections[stage] = number
                yield Heading(f"{number}. {heading_of(stage, robot)}", 2)
            yield from folds

    def summary(self) -> Iterator[Block]:
        """The model, and whatever else the exercise asks for."""
        asked, is_short = self.solution.problem.find, self.solution.is_short
        robot, sections = self.solution.robot, self.sections
        return summary_blocks(
            robot, self.steps, self.detail, self.short, asked=asked, is_short=is_short, sections=sections
        )

    def closing(self) -> Iterator[Block]:
        """How the results are verified, and the books."""
        if self.detail is Detail.RESULTS:
            return
        verification = self.solution.verification
        what, how = "the results", verification.method
        if not self.solution.robot.has_dynamics:
            if not any(stage.asked_for for stage in stages_of(self.solution.robot)):
                yield Text(("No body has mass, so the derivation ends with the Jacobian.",))
            if self.solution.robot.has_table:
                what, how = "the last frame and the Jacobian", f"the outward half of {how}"
        told: Prose = (
            f"Verified: {what} agree with {how} at {verification.states} random states (relative error ",
        )
        told += (*_in_powers_of_ten(verification.max_relative_error), ").")
        if self.solution.robot.questions.asked:
            told += (" The other results that are asked for agree with independent computations in numbers.",)
        if self.detail is Detail.FULL:
            yield Heading("Verification", 2)
        yield Text(told)
        sources = tuple(self.sources())
        books = [
            f"{book.name + ' is' if book.name else 'The sections (§) are those of'} {book.full}."
            for book in cited(sources)
        ]
        if books:
            yield Text((" ".join(books),))
        titles = tuple((title,) for title in titled(sources)) if self.detail is Detail.FULL else ()
        if titles:
            yield List(titles)

    def sources(self) -> Iterator[str]:
        """The references that a report makes."""
        if self.short is not None and self.short.constants:
            yield KHALIL_DOMBRE.section("9.4")
        steps = (step for step in self.steps if step.formula is not None and step.detail <= self.detail)
        yield from (step.source for step in steps)


def _first_in_names(steps: Iterable[Step], short: Abbreviated | None) -> Stage:
    """The stage before which names are defined: that of C, or an earlier one in which there are some."""
    names = frozenset() if short is None else frozenset(one.name for one in short.definitions)
    found = (step.stage for step in steps if not names.isdisjoint(walk(*step.result)))
    return next(found, Stage.VECTORIZED)


def definition_blocks(short: Abbreviated, what: str) -> Iterator[Block]:
    """The section in which the names are defined; `what` is the arm or the mechanism."""
    if not short.definitions:
        return
    yield Heading("Abbreviations", 2)
    if short.constants:
        told = Text(_of_constants(short, what))
        yield Fold("Inertial constants", (told, _definitions(short.constants, CONSTANTS_LIST)))
    if short.sums:
        told = Text(("Terms that occur several times below, each in terms of those before it.",))
        yield Fold("Recurring terms", (told, _definitions(short.sums, SUMS_LIST)))


def _definitions(definitions: Iterable[Definition], label: str) -> Equations:
    defined = tuple(equation(one.name, one.meaning) for one in definitions)
    return Equations(defined, in_columns=True, label=label)


def _of_constants(short: Abbreviated, what: str) -> Prose:
    count = len(short.constants) + len(short.kept)
    return say(
        "The {what} has {count} base {parameters}: the fewest combinations of masses, mass centres, "
        "moments and products of inertia, and lengths, in which $𝐃$ and $𝐠$ are linear, the lengths of "
        "the table being known ({book}; {article}). Only these can be determined from the motions and "
        "forces of the joints. Their number is fixed, their choice is not: as many independent linear "
        "combinations of them serve as well. Chosen here are the constants below{kept}.",
        what=what,
        count=count,
        parameters="parameter" if count == 1 else "parameters",
        book=KHALIL_DOMBRE.section("9.4"),
        article=GAUTIER_KHALIL,
        kept=(", and ", *listed(short.kept)) if short.kept else (),
    )


def _in_powers_of_ten(size: float) -> Prose:
    """3.6·10⁻¹⁶; 0 for what is exact.

    >>> _in_powers_of_ten(0.0)
    ('0',)
    """
    if not size:
        return ("0",)
    mantissa, exponent = f"{size:.1e}".split("e")
    power = Power(Number(10), Number(int(exponent)))
    return (Row((Words(f"{mantissa}·"), power)),)
