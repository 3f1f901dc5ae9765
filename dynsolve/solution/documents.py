"""Solutions as documents: the choice and the order of the steps that are shown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
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
    made = partial(_documents, solution, details, stages, drawn)
    names = "what is written in names"
    short = attempted(lambda: solution.abbreviated(abbreviate), lambda: None, names)
    return made(None) if short is None else attempted(lambda: made(short), lambda: made(None), names)


def _documents(
    solution: Dynamics,
    details: Sequence[Detail],
    stages: tuple[str, ...] | None,
    drawn: Drawn | None,
    short: Abbreviated | None,
) -> tuple[Document, ...]:
    steps = tuple(measured_steps(solution.explain(stages, short), solution.robot, solution.style))
    return tuple(_document(solution, detail, stages, steps, drawn, short) for detail in details)


def _document(
    solution: Dynamics,
    detail: Detail,
    stages: tuple[str, ...] | None,
    steps: Sequence[Step],
    drawn: Drawn | None,
    short: Abbreviated | None,
) -> Document:
    robot = solution.robot
    sections: dict[Stage, int] = {}
    derivation = (
        *_stages(solution, detail, steps, short, drawn, sections if stages is None else None),
        *_part("the numbers", lambda: _numbers(solution, detail, stages)),
        *_part(
            "the summary",
            lambda: summary_blocks(
                robot,
                steps,
                detail,
                short,
                asked=solution.problem.find,
                is_short=solution.is_short,
                sections=sections,
            ),
        ),
    )
    stated = _part("what is given", lambda: _statement(solution, stages, derivation))
    document = Document((
        *_opening(solution),
        *stated,
        *_part("the letters", lambda: _letters(solution, stated, derivation, detail)),
        *derivation,
        *_closing(solution, detail, _sources(steps, detail, short)),
        *_part("the notation", lambda: _notation(solution, (*stated, *derivation), detail, short)),
    ))  # fmt: skip
    return reworded(document, of_second_edition) if solution.problem.edition == 2 else document


def _part(what: str, made: Callable[[], Iterable[Block]]) -> tuple[Block, ...]:
    """A part of the document beside its steps; nothing where it cannot be made."""
    return attempted(lambda: tuple(made()), tuple, what)


def _statement(
    solution: Dynamics, stages: Iterable[str] | None, derivation: tuple[Block, ...]
) -> Iterator[Block]:
    """The exercise, before a whole solution of it."""
    if stages is None:
        sines = shorthands_in(derivation, solution.robot, solution.style)
        yield from statement(solution.forms, solution.problem, sines)


def _letters(
    solution: Dynamics, stated: tuple[Block, ...], shown: tuple[Block, ...], detail: Detail
) -> Iterator[Block]:
    """In brief the letters that go beyond the course and are not defined where they occur."""
    if detail is Detail.BRIEF:
        lines = letters_beside(solution.robot, solution.style, shown, stated)
        if lines:
            yield Text(in_a_sentence(lines))


def _notation(
    solution: Dynamics, shown: tuple[Block, ...], detail: Detail, short: Abbreviated | None
) -> Iterator[Block]:
    """In full every sign that occurs in what is shown, with its meaning and unit."""
    if detail is not Detail.FULL:
        return
    told = notation(solution.robot, solution.style, shown, short)
    if not told.lines:
        return
    yield Heading("Notation", appendix=True)
    if told.remarks:
        yield Text(told.remarks)
    yield told.table


def _numbers(solution: Dynamics, detail: Detail, stages: Iterable[str] | None) -> Iterator[Block]:
    """The section of numeric results, where they were asked for."""
    if solution.numbers is not None:
        from dynsolve.solution.numbers.blocks import blocks

        yield from blocks(solution.numbers, detail, solution.problem.find, stages)


def _sources(steps: Iterable[Step], detail: Detail, short: Abbreviated | None) -> Iterator[str]:
    """The references that a report makes."""
    if short is not None and short.constants:
        yield KHALIL_DOMBRE.section("9.4")
    yield from (step.source for step in steps if step.formula is not None and step.detail <= detail)


def _opening(solution: Dynamics) -> Iterator[Block]:
    problem = solution.problem
    yield Heading(problem.title, 1)
    if problem.source:
        yield Text((f"{problem.source.rstrip('.')}.",))
    if digits := solution.style.digits:
        yield Text((
            f"Numbers are exact, in SI units (m, kg, s, N). One with more than {digits} significant digits "
            "is rounded to these where it is printed, and nowhere else; ≈ marks that. A unit stands behind "
            "a result that is a number other than 0, or a matrix of which all entries have it; any other "
            "formula has that of its left side.",
        ))  # fmt: skip


def _stages(
    solution: Dynamics,
    detail: Detail,
    steps: Sequence[Step],
    short: Abbreviated | None,
    drawn: Drawn | None,
    sections: dict[Stage, int] | None,
) -> Iterator[Block]:
    """Stages and their steps: of a whole derivation what is shown is counted in `sections`."""
    places = {stage: place for place, stage in enumerate(stages_of(solution.robot), 1)}
    inputs = {rule.name: rule.inputs for rule in course_rules(solution.robot)}
    named_from = _first_in_names(steps, short)
    shown = Shown(
        detail,
        inputs,
        solution.style,
        drawn,
        in_summary(solution.robot, steps, solution.problem.find, solution.is_short),
    )
    own = (step for step in steps if step.id != ID)  # that stands in the summary
    for stage, of_stage in groupby(own, attrgetter("stage")):
        if short is not None and stage is named_from and not short.at_symbols and detail > Detail.RESULTS:
            yield from definition_blocks(short, machine(solution.robot))
        number = places[stage] if sections is None else len(sections) + 1
        folds = tuple(shown.of_stage(number, of_stage))
        if folds:  # no heading over a stage of which nothing is shown
            if sections is not None:
                sections[stage] = number
            yield Heading(f"{number}. {heading_of(stage, solution.robot)}", 2)
        yield from folds


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


def _closing(solution: Dynamics, detail: Detail, sources: Iterable[str]) -> Iterator[Block]:
    if detail is Detail.RESULTS:
        return
    verification = solution.verification
    what, how = "the results", verification.method
    if not solution.robot.has_dynamics:
        if not any(stage.asked_for for stage in stages_of(solution.robot)):
            yield Text(("No body has mass, so the derivation ends with the Jacobian.",))
        if solution.robot.has_table:
            what, how = "the last frame and the Jacobian", f"the outward half of {how}"
    told: Prose = (
        f"Verified: {what} agree with {how} at {verification.states} random states (relative error ",
    )
    told += (*_in_powers_of_ten(verification.max_relative_error), ").")
    if solution.robot.questions.asked:
        told += (" The other results that are asked for agree with independent computations in numbers.",)
    if detail is Detail.FULL:
        yield Heading("Verification", 2)
    yield Text(told)
    sources = tuple(sources)
    books = [
        f"{book.name + ' is' if book.name else 'The sections (§) are those of'} {book.full}."
        for book in cited(sources)
    ]
    if books:
        yield Text((" ".join(books),))
    titles = tuple((title,) for title in titled(sources)) if detail is Detail.FULL else ()
    if titles:
        yield List(titles)


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
