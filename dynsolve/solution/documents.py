"""Solutions as documents: the choice and the order of the steps that are shown.

The steps of a model in numbers as they are printed, with units behind results.

A result that is a number alone has its unit behind it, and so has a matrix whose entries are all measured
in one.  A formula of several factors or terms has none: the unit is that of its left side in the list of
notation, which says so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby
from operator import attrgetter

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.derivation.rules import course_rules
from dynsolve.document import (
    Block,
    Document,
    Equations,
    Fold,
    Heading,
    List,
    Prose,
    Text,
    rewritten,
)
from dynsolve.document.books import GAUTIER_KHALIL, KHALIL_DOMBRE, cited, of_second_edition, titled
from dynsolve.document.sentences import say
from dynsolve.errors import attempted
from dynsolve.explain.abbreviations import CONSTANTS_LIST, SUMS_LIST, Abbreviate, Abbreviated, Definition
from dynsolve.explain.context import MOST_JOINTS
from dynsolve.explain.given import statement, to_be_found
from dynsolve.explain.notation_list import in_a_sentence, letters_beside, notation, shorthands_in
from dynsolve.explain.signs import formulas_in
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.terms import ID
from dynsolve.explain.writing import listed, machine, measured
from dynsolve.notation.printing import Style
from dynsolve.notation.rounding import is_rounded, marked, marked_among_words
from dynsolve.notation.tree import (
    Entry,
    Letter,
    Matrix,
    Node,
    Number,
    Power,
    Relation,
    Row,
    Transpose,
    Words,
    equation,
    names_in,
    walk,
)
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.quantities import letters
from dynsolve.quantities.index import quantities
from dynsolve.quantities.owners import heading_of, stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot import units
from dynsolve.robot.model import Robot
from dynsolve.solution.depths import Drawn, Shown
from dynsolve.solution.dynamics import Dynamics
from dynsolve.solution.leading import leading, needs_forces
from dynsolve.solution.numbers import given
from dynsolve.solution.numbers.substitution import DIGITS
from dynsolve.solution.summary import in_summary, stands_twice, summary_blocks

# The steps of a model in numbers as they are printed

_PARTS_OF_D = ("D_direct", "Dw")
"""What the ids of the steps begin with that give parts of D, which have no letters of their own."""

_WIDEST = 50
"""The characters up to which a row of a matrix leaves room for its unit."""


def measured_steps(steps: Iterable[Step], robot: Robot, style: Style) -> Iterator[Step]:
    """The steps as they are; of a model in numbers with units."""
    if not robot.is_numeric:
        yield from steps
        return
    known, given = _units(robot), frozenset(robot.parameters)
    for step in steps:
        yield _with_units(step, known, style, given)


def _units(robot: Robot) -> dict[Node, str]:
    """The one unit of all entries of each letter that has one."""
    length, count = units.si(units.LENGTH), len(robot.joints)
    found: dict[Node, str] = {letters.o(i): length for i in range(count + 1)}
    found |= {letters.height(letters.index_of(body.name)): length for body in robot.bodies}
    for i in range(1, count + 1):
        _, d, a, _ = letters.columns(robot, Number(i))
        found |= {d: length, a: length}
    found[letters.GRAVITY] = units.si(units.ACCELERATION)
    for name, quantity in quantities(robot).items():
        unit = given.of_result(robot, name)
        several = {unit} if isinstance(unit, str) else {each for row in unit for each in row}
        if len(several) == 1 and quantity.family.has_letter:
            found[quantity.letter(robot)] = several.pop()
    places = range(1, robot.n + 1)
    if letters.D in found:  # its entries are listed where they are summed up
        found |= {letters.entry("d", i, j): found[letters.D] for i in places for j in places}
    if letters.C in found:
        found[letters.bold("N")] = found[letters.C]
    return found


def _with_units(step: Step, known: Mapping[Node, str], style: Style, given: frozenset[str]) -> Step:
    """The step with units behind what goes in and what comes out: numbers, and matrices in one unit.

    What is `given` as a letter has its unit in itself.
    """
    of_parts = known.get(letters.D, "") if step.id.startswith(_PARTS_OF_D) else ""
    of_center = units.si(units.LENGTH) if step.id.startswith("rc") else ""  # as it is given, in its link

    def measure(nodes: Iterable[Node], otherwise: str = "") -> tuple[Node, ...]:
        return tuple(_measured(node, known, otherwise, style, given) for node in nodes)

    if step.id.startswith("I_given"):
        of_parts = _OF_INTEGRALS["I"]
    if step.id.startswith("density"):
        known = {**known, **dict(_of_integrals(step))}
        step = replace(
            step, lines=tuple(replace(line, formulas=measure(line.formulas)) for line in step.lines)
        )
    return replace(
        step,
        further=measure(step.further, of_center),
        working=measure(step.working),
        result=measure(step.result, of_parts),
    )


_OF_INTEGRALS = {"m": "kg", "x": "m", "I": "kg m^2"}
"""The units of what is found by integration, by its letter."""


def _of_integrals(step: Step) -> Iterator[tuple[Node, str]]:
    """The left sides of a step by integration with their units; m x_c is a first moment."""
    for node in (*(node for line in step.lines for node in line.formulas), *step.result):
        if isinstance(node, Relation):
            left = node.parts[0]
            unit = _OF_INTEGRALS.get(left.base) if isinstance(left, Letter) else "kg m"
            yield from [(left, unit)] if unit else ()


def _measured(
    node: Node, known: Mapping[Node, str], otherwise: str, style: Style, given: frozenset[str]
) -> Node:
    """An equation with the unit of its left side behind its right side; each of several side by side."""
    if isinstance(node, Row):
        parts = (_measured(part, known, otherwise, style, given) for part in node.parts)
        return replace(node, parts=tuple(parts))
    if not isinstance(node, Relation):
        return node
    left, *_ = (*before, value) = node.parts
    unit = known.get(left.of if isinstance(left, Entry) else left, otherwise)
    if not unit or not given.isdisjoint(names_in(value)):
        return node
    matrix = value.argument if isinstance(value, Transpose) else value
    if not isinstance(matrix, Matrix):
        return replace(node, parts=(*before, measured(value, unit)))
    write = UnicodePrinter(style).text
    if matrix.is_zero or any(sum(width(write(entry)) + 2 for entry in row) > _WIDEST for row in matrix.rows):
        return node
    return replace(node, parts=(*before, Row((value, Words(" "), units.node(unit)))))


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
        def told(*, by_energies: bool) -> tuple[Step, ...]:
            steps = solution.explain(stages, short, by_energies=by_energies)
            return tuple(measured_steps(steps, solution.robot, solution.style))

        steps = least = told(by_energies=False)
        if stages is None and any(detail is not Detail.FULL for detail in details):
            is_shorter = not needs_forces(solution, steps)
            least = leading(solution, told(by_energies=True) if is_shorter else steps)
        shown = ((detail, steps if detail is Detail.FULL else least) for detail in details)
        parts = (_Parts(solution, detail, stages, own, drawn, short) for detail, own in shown)
        return tuple(each.document() for each in parts)

    names = "what is written in names"
    short = attempted(lambda: solution.abbreviated(abbreviate), lambda: None, names)
    return made(None) if short is None else attempted(lambda: made(short), lambda: made(None), names)


_ROUNDED = (
    " One with more than {digits} significant digits is rounded to these where it is printed, and nowhere "
    "else; ≈ marks that."
)

_IN_SI = "Numbers are exact, in SI units (m, kg, s, N)."

_IN_NUMBERS = (
    f"{_IN_SI}{{rounded}} A unit stands behind a result "
    "that is a number other than 0, and behind some matrices of which all entries have it; any other formula "
    "has that of its left side, and so has an entry of a matrix."
)


class _Parts(Struct, dict=True):
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
            *part("the summary", self.summary),
            *part("the section of numbers", self.numbers),
        )
        stated = part("what is given", lambda: self.statement(derivation))
        style = self.solution.style
        document = Document((
            *stated,
            *part("the list of letters", lambda: self.letters(stated, derivation)),
            *derivation,
            *self.closing(),
            *part("the notation", lambda: self.notation((*stated, *derivation))),
        ))  # fmt: skip
        if self.solution.may_round:
            among_words = partial(marked_among_words, style=style)
            document = rewritten(document, displayed=partial(marked, style=style), inline=among_words)
        rounds = bool(style.digits) and any(is_rounded(node, style) for node in formulas_in(document.blocks))
        document = Document((*self.opening(rounds), *document.blocks))
        return (
            rewritten(document, words=of_second_edition) if self.solution.problem.edition == 2 else document
        )

    @property
    def is_short(self) -> bool:
        """Whether the summary has the model itself, and not where it is."""
        robot = self.solution.robot
        if robot.n <= MOST_JOINTS or (self.short is not None and self.short.long):
            return self.solution.is_short
        return self.detail is Detail.RESULTS or stands_twice(robot, self.steps)

    def opening(self, rounds: bool) -> Iterator[Block]:
        """The title, the source, and how numbers are printed, some of which may be rounded."""
        problem = self.solution.problem
        yield Heading(problem.title, 1)
        if problem.source:
            yield Text((f"{problem.source.rstrip('.')}.",))
        if self.solution.robot.is_numeric:
            rounded = say(_ROUNDED, digits=self.solution.style.digits) if rounds else ""
            yield Text(say(_IN_NUMBERS, rounded=rounded))
        elif self.solution.robot.has_decimals:
            yield Text((_IN_SI,))

    def statement(self, derivation: tuple[Block, ...]) -> Iterator[Block]:
        """The exercise, before a whole solution of it."""
        if self.stages is None:
            sines = shorthands_in(derivation, self.solution.robot, self.solution.style)
            yield from statement(self.solution.forms, self.solution.problem, sines)
            yield from to_be_found(self.solution.forms, self.solution.problem)

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
        """The results that are asked for with numbers, and at a state."""
        if self.solution.numbers is not None:
            from dynsolve.solution.numbers.blocks import blocks

            problem = self.solution.problem
            derived = {name for step in self.steps for name in (step.id, *step.also)}
            told = problem.written if self.stages is None else {}
            yield from blocks(
                self.solution.numbers,
                self.detail,
                problem.find,
                derived,
                self.stages,
                told,
                self.solution.forms,
                self.solution.style.digits or DIGITS,
            )

    def derivation(self) -> Iterator[Block]:
        """Stages and their steps; in a whole derivation what is shown of it is counted."""
        robot, short, asked = self.solution.robot, self.short, self.solution.problem.find
        places = {stage: place for place, stage in enumerate(stages_of(robot), 1)}
        inputs = {rule.name: rule.inputs for rule in course_rules(robot)}
        named_from = _first_in_names(self.steps, short)
        in_closing = in_summary(robot, self.steps, asked, self.is_short)
        shown = Shown(self.detail, inputs, self.solution.style, self.drawn, in_closing)
        own = (step for step in self.steps if step.id != ID)  # that stands in the summary
        for stage, of_stage in groupby(own, attrgetter("stage")):
            is_named = short is not None and stage is named_from and not short.at_symbols
            if short is not None and is_named and self.detail > Detail.RESULTS:
                yield from definition_blocks(short, machine(robot))
            number = places[stage] if self.stages is not None else len(self.sections) + 1
            told = tuple(of_stage)
            folds = tuple(shown.of_stage(number, told))
            if folds:  # no heading over a stage of which nothing is shown
                self.sections[stage] = number
                is_friction = stage is Stage.TORQUE and {step.id for step in told} == {"friction"}
                yield Heading(f"{number}. {told[0].title if is_friction else heading_of(stage, robot)}", 2)
            yield from folds

    def summary(self) -> Iterator[Block]:
        """The model, and whatever else the exercise asks for."""
        return summary_blocks(
            self.solution.robot,
            self.steps,
            self.detail,
            self.short,
            asked=self.solution.problem.find,
            is_short=self.is_short,
            sections=self.sections,
            forms=self.solution.forms,
        )

    def closing(self) -> Iterator[Block]:
        """How the results are verified, and the books."""
        if self.detail is Detail.RESULTS:
            return
        verification = self.solution.verification
        robot, what, how = self.solution.robot, "the results", verification.method
        if not robot.has_dynamics and not any(stage.asked_for for stage in stages_of(robot)):
            yield Text(("No body has mass, so the derivation ends with the Jacobian.",))
        if robot.has_table and _KINEMATIC.issuperset(step.stage for step in self.steps):
            what, how = "the last frame and the Jacobian", "velocities carried outwards from link to link"
        told: Prose = (
            f"Verified: {what} agree with {how} at {verification.states} random states (relative error ",
        )
        told += (*_in_powers_of_ten(verification.max_relative_error), ").")
        if self._holds_more():
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

    def _holds_more(self) -> bool:
        """Whether something is asked for beside the course's derivation that was worked out."""
        asked = self.solution.robot.questions.asked
        if not asked:
            return False
        from dynsolve.solution.asked_checks import skipped

        return bool(asked - {name for name, _ in skipped(self.solution.robot, self.solution.values)})

    def sources(self) -> Iterator[str]:
        """The references that a report makes."""
        if self.short is not None and self.short.constants:
            yield KHALIL_DOMBRE.section("9.4")
        steps = (step for step in self.steps if step.formula is not None and step.detail <= self.detail)
        yield from (step.source for step in steps)


_KINEMATIC = frozenset(
    {
        Stage.KINEMATICS,
        Stage.JACOBIAN,
        Stage.TASK,
        Stage.SINGULAR,
        Stage.INVERSE,
        Stage.RATES,
        Stage.STATICS,
        Stage.CONSTRAINTS,
    }
)
"""The stages that can do without masses; a report of these alone has no equations of motion."""


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
