"""Solutions as documents: the choice and the order of the steps that are shown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial

from dynsolve.derivation.rules import course_rules
from dynsolve.document import (
    Block,
    Document,
    Equations,
    Fold,
    Formula,
    Heading,
    Note,
    Picture,
    Prose,
    Table,
    Text,
    Uses,
)
from dynsolve.document.figures import ArmFigure, Figure
from dynsolve.errors import attempted
from dynsolve.explain import closing
from dynsolve.explain.abbreviations import (
    CONSTANTS_LIST,
    SUMS_LIST,
    Abbreviate,
    Abbreviated,
    Definition,
)
from dynsolve.explain.citations import GAUTIER_KHALIL, KHALIL_DOMBRE, cited
from dynsolve.explain.notation_list import notation
from dynsolve.explain.statement import statement
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import listed, machine
from dynsolve.notation.tree import Number, Power, Relation, Row, Words, equation
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.quantities.robot_stages import stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.render.page_ends import leads_on
from dynsolve.solution.dynamics import Dynamics
from dynsolve.solution.earlier_results import EarlierResults, labelled_results
from dynsolve.solution.measured_steps import measured_steps
from dynsolve.solution.said_once import SaidOnce
from dynsolve.solution.summary import summary_blocks

Drawn = Callable[[Figure | ArmFigure], Picture | None]
"""What makes a picture of a drawing; none where there is no such pose of the arm."""

CONVENTIONS = {
    "standard": "standard Denavit-Hartenberg (Spong)",
    "modified": "modified Denavit-Hartenberg (Craig)",
}


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
    stages = None if stages is None else tuple(stages)
    made = partial(_document, solution, detail, stages, drawn)
    names = "what is written in names"
    short = attempted(lambda: solution.abbreviated(abbreviate), lambda: None, names)
    return made(None) if short is None else attempted(lambda: made(short), lambda: made(None), names)


def _document(
    solution: Dynamics,
    detail: Detail,
    stages: tuple[str, ...] | None,
    drawn: Drawn | None,
    short: Abbreviated | None,
) -> Document:
    robot = solution.robot
    steps = tuple(measured_steps(solution.explain(stages, short), robot, solution.style))
    derivation = (
        *_stages(solution, detail, steps, short, drawn),
        *_part("the numbers", lambda: _numbers(solution, detail, stages)),
        *_part(
            "the summary",
            lambda: summary_blocks(
                robot, steps, detail, short, asked=solution.problem.find, is_short=solution.is_short
            ),
        ),
    )
    stated = _part("what is given", lambda: _statement(solution, stages))
    return Document((
        *_opening(solution, _sources(steps, detail, short)),
        *stated,
        *_part("the notation", lambda: _notation(solution, (*stated, *derivation), detail, short)),
        *derivation,
        *_closing(solution),
    ))  # fmt: skip


def _part(what: str, made: Callable[[], Iterable[Block]]) -> tuple[Block, ...]:
    """A part of the document beside its steps; nothing where it cannot be made."""
    return attempted(lambda: tuple(made()), tuple, what)


def _statement(solution: Dynamics, stages: Iterable[str] | None) -> Iterator[Block]:
    """The exercise, before a whole solution of it."""
    if stages is None:
        yield from map(Text, statement(solution.forms, solution.problem))


def _notation(
    solution: Dynamics, shown: tuple[Block, ...], detail: Detail, short: Abbreviated | None
) -> Iterator[Block]:
    """Every sign that occurs in what is shown, with its meaning and unit; in brief in one paragraph."""
    told = notation(solution.robot, solution.style, shown, short)
    if not told.lines:
        return
    if detail is Detail.BRIEF:
        yield Text(told.sentence)
        return
    yield Heading("Notation", 2)
    if told.remarks:
        yield Text(told.remarks)
    yield told.table


def _numbers(solution: Dynamics, detail: Detail, stages: Iterable[str] | None) -> Iterator[Block]:
    """The section of numeric results, where they were asked for."""
    if solution.numbers is not None:
        from dynsolve.solution.numbers.blocks import blocks

        yield from blocks(solution.numbers, detail, stages)


def _sources(steps: Iterable[Step], detail: Detail, short: Abbreviated | None) -> Iterator[str]:
    """The references that a report makes."""
    if short is not None and short.constants:
        yield KHALIL_DOMBRE.section("9.4")
    yield from (step.source for step in steps if step.formula is not None and step.detail <= detail)


def _opening(solution: Dynamics, sources: Iterable[str]) -> Iterator[Block]:
    problem = solution.problem
    yield Heading(problem.title, 1)
    facts = [problem.source] if problem.source else []
    if solution.robot.has_table:
        facts.append(f"Convention: {CONVENTIONS[problem.convention.value]}.")
    facts += [
        f"{book.name + ' is' if book.name else 'The sections (§) are those of'} {book.full}."
        for book in cited(sources)
    ]
    for fact in facts:
        yield Text((fact,))


def _stages(
    solution: Dynamics,
    detail: Detail,
    steps: Iterable[Step],
    short: Abbreviated | None,
    drawn: Drawn | None,
) -> Iterator[Block]:
    """Stages and their steps, numbered as in the whole derivation."""
    inputs = {rule.name: rule.inputs for rule in course_rules(solution.robot)}
    numbers = {stage: number for number, stage in enumerate(stages_of(solution.robot), 1)}
    steps = tuple(steps)
    named_from = _first_in_names(steps, short)
    earlier, said = EarlierResults(), SaidOnce()
    stage: Stage | None = None
    place, extra = 0, 0
    heading: Heading | None = None
    for step in steps:
        if step.id == closing.ID:  # it stands in the summary
            continue
        if step.stage != stage:
            if short is not None and step.stage is named_from and _defined_first(short, detail):
                yield from definition_blocks(short, machine(solution.robot))
            stage, place, extra = step.stage, 0, 0
            heading = Heading(f"{numbers[stage]}. {stage.heading}", 2)
        if step.detail is Detail.FULL:  # 7.3.1, so that the others have the same number in every detail
            extra += 1
            number = f"{numbers[stage]}.{place}.{extra}"
        else:
            place, extra = place + 1, 0
            number = f"{numbers[stage]}.{place}"
        if step.detail <= detail:
            if heading:  # none over a stage of which nothing is shown
                yield heading
                heading = None
            uses = inputs.get(step.id, ()) if step.uses is None else step.uses
            told = replace(step, why=said.why(step), lines=tuple(_referring(step, earlier)))
            blocks = tuple(step_blocks(told, detail, earlier.used(step, (*uses, *step.names)), drawn))
            yield Fold(f"{number} {step.title}", blocks, step.detail)
        earlier.add(step)


def _referring(step: Step, earlier: EarlierResults) -> Iterator[Line]:
    """The lines of a step, each with the labels of the equations that it uses."""
    return (replace(line, uses=earlier.used(step, line.uses)) for line in step.lines)


def _first_in_names(steps: Iterable[Step], short: Abbreviated | None) -> Stage:
    """The stage before which names are defined: that of C, or an earlier one in which there are some."""
    names = frozenset() if short is None else frozenset(one.name for one in short.definitions)
    found = (step.stage for step in steps if not names.isdisjoint(walk(*step.result)))
    return next(found, Stage.VECTORIZED)


def _defined_first(short: Abbreviated, detail: Detail) -> bool:
    """Whether names are defined in a section: those of a short model are where they are first used."""
    return not short.at_symbols or detail is Detail.BRIEF


def definition_blocks(short: Abbreviated, what: str) -> Iterator[Block]:
    """The section in which the names are defined; `what` is the arm or the mechanism."""
    if not short.definitions:
        return
    yield Heading("Abbreviations", 2)
    if short.constants:
        yield Fold("Inertial constants", tuple(_constant_blocks(short, what)), Detail.BRIEF)
    if short.sums:
        yield Fold("Recurring terms", tuple(_recurring_blocks(short)), Detail.BRIEF)


def _constant_blocks(short: Abbreviated, what: str) -> Iterator[Block]:
    count = len(short.constants) + len(short.kept)
    own: Prose = (", and ", *listed(short.kept)) if short.kept else ()
    yield Text((
        f"The {what} has {count} base parameter{'s' if count > 1 else ''}: the fewest combinations of "
        "masses, mass centres, moments and products of inertia, and lengths, in which ",
        *listed([letters.D, letters.G]),
        f" are linear, the lengths of the table being known ({KHALIL_DOMBRE.section('9.4')}; "
        f"{GAUTIER_KHALIL}). Only these can be determined from the motions and forces of the joints. Their "
        "number is fixed, their choice is not: as many independent linear combinations of them serve as "
        "well. Chosen here are the constants below",
        *own,
        ".",
    ))  # fmt: skip
    yield Equations(tuple(map(_defined, short.constants)), in_columns=True, label=CONSTANTS_LIST)


def _recurring_blocks(short: Abbreviated) -> Iterator[Block]:
    yield Text(("Terms that occur several times below, each in terms of those before it.",))
    yield Equations(tuple(map(_defined, short.sums)), in_columns=True, label=SUMS_LIST)


def _defined(definition: Definition) -> Relation:
    return equation(definition.name, definition.meaning)


def step_blocks(
    step: Step, detail: Detail, inputs: tuple[str, ...] = (), drawn: Drawn | None = None
) -> Iterator[Block]:
    """A step: in brief its result and the formula that it comes from, else with all that it has.

    `inputs` are the labels of what its result is computed from, as are the `uses` of its lines.
    """
    if detail > Detail.BRIEF and step.why and not _opens_way(step):
        yield Text(step.why)
    if detail > Detail.BRIEF and (figure := step.figure) and drawn:
        picture = attempted(lambda: drawn(figure), lambda: None, f"the picture of {step.title}")
        yield from () if picture is None else (picture,)
    table = () if step.table is None else (Table(step.table.header, step.table.rows),)
    yield from () if step.table_last else table
    if detail > Detail.BRIEF:
        yield from _way(step, inputs)
    elif step.formula is not None:
        yield Formula(step.formula, step.source)
    yield from table if step.table_last else ()
    if step.listed:
        yield Equations(step.result, in_columns=True, label=step.id)
    for result, label in labelled_results(step):
        yield Formula(result, entries=step.entries, optional=step.optional, label=label)
    if detail > Detail.BRIEF:
        for note in step.notes:
            yield Note(note)


def _way(step: Step, inputs: tuple[str, ...]) -> Iterator[Block]:
    """The way to the result: the formulas in letters, this robot's quantities in them, and what leads on.

    What goes in is named where it goes in: before the working, the first line, or else the result.
    """
    if step.formula is not None:
        yield Formula(step.formula, step.source)
    for formula in step.further:
        yield Formula(formula, optional=True)
    following = (*((Text(step.why),) if _opens_way(step) else ()), *_leading_on(step))
    yield from _with_uses(following, inputs) if inputs else following


def _opens_way(step: Step) -> bool:
    """Whether what is said of a step leads on to its first line, and so names what goes in there."""
    opened = bool(step.lines) and not step.lines[0].by and not step.working
    return opened and step.formula is None and step.table is None and leads_on(step.why)


def _leading_on(step: Step) -> Iterator[Block]:
    """What leads from the formulas in letters to the result."""
    for working in step.working:
        yield Formula(working, optional=True)
    for line in step.lines:
        lead_in = (Text(line.by),) if line.by else ()
        yield from _with_uses(lead_in, line.uses) if line.uses else lead_in
        yield (
            Formula(line.formulas[0], optional=not line.label, label=line.label)
            if len(line.formulas) == 1
            else Equations(line.formulas, in_columns=line.in_columns, label=line.label)
        )
    if step.concluding:
        yield Text(step.concluding)


def _with_uses(blocks: tuple[Block, ...], labels: tuple[str, ...]) -> Iterator[Block]:
    """The blocks, what goes in named before the first formula: in its lead-in, where it has one."""
    match blocks:
        case (Text(parts), *rest) if leads_on(parts):
            yield Uses(labels, parts)
        case (Text() as sentence, *rest):
            yield from (sentence, Uses(labels))
        case (*rest,):
            yield Uses(labels)
    yield from rest


def _closing(solution: Dynamics) -> Iterator[Block]:
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
        told += (
            " What only this exercise asks agrees with computations on numbers that share no formula "
            "with it.",
        )
    yield Heading("Verification", 2)
    yield Text(told)


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
