"""Solutions as documents: the choice and the order of the steps that are shown.

The section that closes a solution: the model, its matrices, the forces row by row.

Everything in it is the result of a step, taken from there, so that it cannot differ.

The steps of a model in numbers as they are printed, with units behind results.

A result that is a number alone has its unit behind it, and so has a matrix whose entries are all measured
in one.  A formula of several factors or terms has none: the unit is that of its left side in the list of
notation, which says so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby, islice
from operator import attrgetter
from types import MappingProxyType

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.derivation.rules import course_rules
from dynsolve.document import (
    Block,
    Document,
    Equations,
    Fold,
    Formula,
    Heading,
    List,
    Prose,
    Reference,
    Table,
    Text,
    rewritten,
)
from dynsolve.document.books import GAUTIER_KHALIL, KHALIL_DOMBRE, cited, of_second_edition, titled
from dynsolve.document.sentences import say
from dynsolve.errors import attempted
from dynsolve.explain.abbreviations import CONSTANTS_LIST, SUMS_LIST, Abbreviate, Abbreviated, Definition
from dynsolve.explain.given import at_the_state, holds_at_state, in_words, statement, to_be_found
from dynsolve.explain.notation_list import in_a_sentence, letters_beside, notation, shorthands_in
from dynsolve.explain.signs import formulas_in
from dynsolve.explain.step import NOT_DERIVED, Detail, Step
from dynsolve.explain.terms import ID, driving_row, rows_in_names
from dynsolve.explain.writing import listed, machine, measured, side_by_side
from dynsolve.notation.printing import Style
from dynsolve.notation.rounding import is_rounded, marked, marked_among_words
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Letter,
    Matrix,
    Node,
    Number,
    Power,
    Relation,
    Row,
    Symbol,
    Transpose,
    Words,
    equation,
    names_in,
    walk,
)
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.quantities import letters
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.owners import heading_of, stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot import units
from dynsolve.robot.model import Robot
from dynsolve.solution.depths import Drawn, Shown
from dynsolve.solution.dynamics import Dynamics
from dynsolve.solution.leading import leading
from dynsolve.solution.numbers import given
from dynsolve.solution.numbers.substitution import DIGITS

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
    if _is_zero(matrix) or any(
        sum(width(write(entry)) + 2 for entry in row) > _WIDEST for row in matrix.rows
    ):
        return node
    return replace(node, parts=(*before, Row((value, Words(" "), units.node(unit)))))


def _is_zero(node: Node) -> bool:
    return isinstance(node, Matrix) and all(entry == ZERO for row in node.rows for entry in row)


# The section that closes a solution: the model, its matrices, the forces row by row

TITLE = "Summary"

_MATRICES = ("D", "C", "friction", "g")

_ZERO = {"C": formula("𝐂 = 𝟎"), "g": formula("𝐠 = 𝟎")}
"""What is left out of the equation of motion where it is zero."""

_ACCELERATIONS = ("qdd", "qdd_forward")
"""Two results of one letter."""


MOST_TWICE = 1000
"""A result with more parts, some twenty lines, is not written in the summary again."""


def in_summary(robot: Robot, steps: Sequence[Step], asked: Sequence[str], is_short: bool) -> frozenset[str]:
    """The steps whose results stand in the summary as well."""
    has_model = is_short and any(step.id == ID for step in steps)
    return (frozenset(asked) - in_model(robot)) | (in_model(robot) if has_model else frozenset())


def stands_twice(robot: Robot, steps: Iterable[Step]) -> bool:
    """Whether a model in no other letters than its own is short enough to be written in the summary again."""
    of_model = in_model(robot)
    nodes = walk(*(node for step in steps if step.id in of_model for node in step.result))
    return next(islice(nodes, MOST_TWICE, None), None) is None


def summary_blocks(
    robot: Robot,
    steps: Sequence[Step],
    detail: Detail,
    short: Abbreviated | None = None,
    *,
    asked: Sequence[str] = (),
    is_short: bool = True,
    sections: Mapping[Stage, int] = MappingProxyType({}),
    forms: Callable[[str], Node],
) -> Iterator[Block]:
    """D q̈ + C q̇ + g = τ with D, C and g, then every force, and whatever else the exercise asks for.

    `sections` are the numbers of the stages that are shown; `forms` writes what no step has alone.
    """
    by_id = {step.id: step for step in steps}
    model = by_id.get(ID)
    of_model = in_model(robot) if model else frozenset()
    of_steps, read_off = _parted(robot, (name for name in asked if name not in of_model))
    above = [name for name in of_steps if _is_told_above(by_id.get(name), detail, sections)]
    others = [
        *_others([name for name in of_steps if name not in above], robot, steps),
        *_read_off(read_off, robot, forms),
        *(_place_of(by_id[name], robot, sections) for name in above),
    ]
    forces = _forces(robot, by_id) if model is None and "tau" in asked else []
    if model is None and not (others or forces):
        return
    yield Heading(TITLE, 2, closing=True)
    names = (
        None if short is None or not short.at_symbols else _Names(robot, by_id, short, tuple(_nodes(others)))
    )
    if model is not None and is_short:
        yield from _model(robot, model, by_id, detail, names, forms)
    elif model is not None:
        yield from _long_model(model, by_id, detail, sections, in_letters=short is not None and short.long)
    else:
        rows = tuple(step.result[0] for step in forces)
        if names and names.short.single and names.short.single.name in walk(*names.others) and forces:
            rows = rows_in_names(robot, names.short, forms)
        yield from names.told([], rows) if names else ()
        yield from _rows(robot, forces, rows, "The generalized forces") if forces else ()
    yield from others


def _is_told_above(step: Step | None, detail: Detail, sections: Mapping[Stage, int]) -> bool:
    """Whether a result is too long to stand in the summary, too."""
    if step is None or detail <= Detail.BRIEF or step.stage not in sections:
        return False
    return next(islice(walk(*step.result), MOST_TWICE, None), None) is not None


def _place_of(step: Step, robot: Robot, sections: Mapping[Stage, int]) -> Text:
    """Where a result stands that is not written again."""
    assert step.stage is not None
    what = in_words(robot, (quantities(robot)[step.id],))
    return Text(say("Section {n} has {what}.", n=str(sections[step.stage]), what=what))


def _nodes(blocks: Iterable[Block]) -> Iterator[Node]:
    """What is displayed in blocks."""
    for block in blocks:
        match block:
            case Formula(node):
                yield node
            case Equations(nodes):
                yield from nodes


def in_model(robot: Robot) -> frozenset[str]:
    """The names of what stands in the model and its rows."""
    return frozenset(("tau", *_MATRICES, *(f"tau{q.index}" for q in robot.coordinates)))


def _model(
    robot: Robot,
    model: Step,
    by_id: Mapping[str, Step],
    detail: Detail,
    names: _Names | None,
    forms: Callable[[str], Node],
) -> Iterator[Block]:
    """The equation of motion in letters and in matrices, and row by row; the names in it."""
    if detail is Detail.FULL:
        yield Text(model.why)
    assert model.formula is not None
    yield Formula(model.formula, source=model.source if detail > Detail.RESULTS else "")
    own = [by_id[name] for name in _MATRICES if name in by_id]
    forces = _forces(robot, by_id)
    if names is not None:
        rows = [node for line in model.lines for node in line.formulas]
        yield from names.told(own, rows or [step.result[0] for step in forces])
    if robot.n > 1 or detail is Detail.RESULTS:
        yield from _matrices(robot, model, own, forms)
    yield from _lines(model)
    if not model.lines and len(forces) == robot.n:
        yield from _rows(robot, forces, [step.result[0] for step in forces])


def _matrices(
    robot: Robot, model: Step, own: Sequence[Step], forms: Callable[[str], Node]
) -> Iterator[Block]:
    """The matrices in the equation of motion, without those that are zero, or by themselves."""
    matrices = tuple(Formula(step.result[0], entries=step.entries) for step in own)
    what = f"{'With the' if model.result else 'The'} matrices of the {machine(robot)}"
    zero = {name: text for name, text in _ZERO.items() if model.result and _is_zero(forms(name))}
    others = Reference(tuple(name for name in _MATRICES if name not in zero), ", ")
    yield Text((*listed([(what, others), *zero.values()]), ":"))
    if model.result:
        yield from (Formula(result, entries=model.entries, otherwise=matrices) for result in model.result)
    else:
        yield from matrices


def _forces(robot: Robot, by_id: Mapping[str, Step]) -> list[Step]:
    """The steps of the generalized forces."""
    return [by_id[name] for q in robot.coordinates if (name := f"tau{q.index}") in by_id]


def _rows(
    robot: Robot, forces: Sequence[Step], rows: Sequence[Node], several: str = "Row by row"
) -> Iterator[Block]:
    """The generalized forces of some steps, row by row; that of a passive coordinate is 0."""
    lead = several if len(forces) > 1 else "The equation of motion"
    yield Text((lead, Reference(tuple(step.id for step in forces), ", "), ":"))
    sides = {driving_row(robot, q): driving_row(robot, q, with_passive=False) for q in robot.coordinates}
    yield Equations(
        tuple(
            equation(sides.get(row.parts[0], row.parts[0]), *row.parts[1:])
            for row in rows
            if isinstance(row, Relation)
        )
    )


class _Names(Struct):
    """What the names in a summary stand for; `others` are its formulas beside the model and the forces."""

    robot: Robot
    by_id: Mapping[str, Step]
    short: Abbreviated
    others: Sequence[Node]

    def told(self, matrices: Sequence[Step], rows: Sequence[Node]) -> Iterator[Block]:
        """The names in some matrices, in the rows of the forces and in what else there is."""
        from dynsolve.explain.named_steps import labels_of_names

        of_matrices = {step.id: self._used(step.result[:1]) for step in matrices}
        of_rows, of_others = self._used(rows), self._used(self.others)
        met = of_rows.union(of_others, *of_matrices.values())
        for one in reversed(self.short.sums):
            met |= self._used([one.meaning]) if one.name in met else set()
        if not met:
            return
        known = quantities(self.robot)
        where: list[Node | str] = [
            known[name].letter(self.robot) for name, found in of_matrices.items() if found
        ]
        if of_rows or of_others:
            where.append("the results below" if of_others else "the rows below")
        below: Prose = ("In ", *listed(where))
        defined = Reference(labels_of_names(list(self.by_id.values()), self.short), ", by ")
        told = sorted(
            (one for one in self.short.sums if one.name in met),
            key=lambda one: (one == self.short.single, len(one.name.name), one.name.name),
        )
        meanings = tuple(equation(one.name, one.meaning) for one in told)
        if self.short.single is not None and len(meanings) == 1:
            yield Text((*below, ", ", *meanings, defined, "."))
        else:
            yield Text((*below, defined, ":"))
            yield Equations(meanings)

    def _used(self, nodes: Iterable[Node]) -> set[Node]:
        return set(walk(*nodes)) & self.short.symbols


def _long_model(
    model: Step,
    by_id: Mapping[str, Step],
    detail: Detail,
    sections: Mapping[Stage, int],
    *,
    in_letters: bool,
) -> Iterator[Block]:
    """Of a long model where D, C and g are; these themselves, in letters, where no stage shows them."""
    if detail is Detail.RESULTS:
        assert model.formula is not None
        yield Formula(model.formula)
        for step in (by_id[name] for name in ("D", "christoffel", "g", "forces") if name in by_id):
            yield from (Formula(result, entries=step.entries) for result in step.result)
        return
    yield Text(model.why)
    assert model.formula is not None
    yield Formula(model.formula, source=model.source)
    number = sections.get(model.stage)
    place = " are those of the matrix form" if number is None else f" are those of section {number}"
    D, g = (letters.D, Reference(("D",))), (letters.G, Reference(("g",)))
    if not in_letters:
        yield Text((*listed([D, (letters.C, Reference(("C",))), g]), place, "."))
    elif by_id["christoffel"].detail > detail:
        yield Text((*listed([D, g]), *say("{place}; $𝐂$ follows from $𝐃$ as it is told there.", place=place)))
        return
    else:
        symbols = say("the Christoffel symbols{which}, which make $𝐂$,", which=Reference(("christoffel",)))
        yield Text((*listed([D, symbols, g]), place, "."))
    if "tau1" in by_id and Stage.TORQUE in sections:
        yield Text(say("The rows of $𝛕$ are those of section {n}.", n=str(sections[Stage.TORQUE])))
    if (row := by_id.get("forces")) is not None:
        yield Text(("Row ", Symbol("k"), " of it", Reference(("forces",), ", "), ":"))
        yield from (Formula(result) for result in row.result)
    yield from _lines(model)


def _parted(robot: Robot, names: Iterable[str]) -> tuple[list[str], list[Quantity]]:
    """The names of what steps give, and what is asked for alone of a whole that they give: d₁₂ of D."""
    known = quantities(robot)
    of_steps: list[str] = []
    read_off: list[Quantity] = []
    for name in names:
        quantity = known.get(name)
        if quantity is not None and quantity.is_read_off:
            read_off.append(quantity)
        else:
            of_steps.append(name)
    return of_steps, read_off


def _read_off(asked: Iterable[Quantity], robot: Robot, forms: Callable[[str], Node]) -> Iterator[Block]:
    """Each with its value, and which of them are zero."""
    values = [(quantity.letter(robot), forms(quantity.form)) for quantity in asked]
    nonzero = tuple(equation(letter, value) for letter, value in values if value != ZERO)
    zero = [letter for letter, value in values if value == ZERO]
    if nonzero:
        yield Equations(nonzero)
    if len(zero) == 1:
        yield Equations((equation(*zero, ZERO),))
    elif zero:
        yield Text((*listed(zero), " are 0."))


def _others(asked: Sequence[str], robot: Robot, steps: Sequence[Step]) -> Iterator[Block]:
    """What else is asked for: what holds everywhere, then, said so, what holds at the given state alone.

    Accelerations, which hold with given rates alone, come last.
    """
    at_state = [name for name in asked if holds_at_state(robot, name)]
    yield from _with_conditions([name for name in asked if name not in at_state], robot, steps)
    for with_rates in (False, True):
        names = [name for name in at_state if (name == "qdd") is with_rates]
        if found := list(_with_conditions(names, robot, steps)):
            yield at_the_state(robot, names)
            yield from found


def _with_conditions(names: Iterable[str], robot: Robot, steps: Sequence[Step]) -> Iterator[Block]:
    """Results that the exercise asks for, and what they hold under: once for those of the same."""
    holds = {name: step.holds for step in steps for name in (step.id, *step.also)}
    for condition, found in groupby(names, key=lambda name: holds.get(name, ())):
        yield from (block for name in found for block in _asked_for(name, robot, steps))
        if condition:
            yield Text(condition)


def _asked_for(name: str, robot: Robot, steps: Sequence[Step]) -> Iterator[Block]:
    """A result that the exercise asks for: the equation of its letter, else what its step gives."""
    quantity = quantities(robot).get(name)
    letter = quantity.letter(robot) if quantity is not None and quantity.family.has_letter else None
    by_letter = [
        Formula(result, entries=step.entries if len(step.result) == 1 else ())
        for step in steps
        if step.id == name or step.id not in _ACCELERATIONS
        for result in step.result or (step.formula,)
        if isinstance(result, Relation) and result.parts[0] == letter
    ]
    yield from by_letter[-1:]
    step = next((step for step in steps if name in (step.id, *step.also)), None)
    if by_letter and step is not None and not step.result:  # it stops at its formula
        yield Text(step.outcome)
    if by_letter or step is None:
        return
    called = quantity.family.called_of(robot).replace(" {}", "") if quantity is not None else step.title
    steady = robot.questions.model.steady if name == "equilibria" else ()
    kept = side_by_side([equation(Symbol(of, 1), value) for of, value in steady]) if steady else ""
    of_motion = say(" with {kept}", kept=kept) if steady else ""
    if not step.title.endswith(NOT_DERIVED):
        yield Text(say(f"{called[0].upper()}{called[1:]}{{of_motion}}:", of_motion=of_motion))
    unknowns = {f"{name}_{q.name}" for q in robot.coordinates} & set(step.uses or ())
    used = [one for one in steps if one.id in (step.uses or ())]
    found = [node for one in used for node in (one.result if one.id in unknowns else one.defines)]
    if step.table is not None or unknowns:
        for matrices, nodes in groupby(found, lambda node: any(isinstance(n, Matrix) for n in walk(node))):
            together = tuple(nodes)
            yield from map(Formula, together) if matrices else (Equations(together),)
        yield from (Text(step.outcome),) if step.outcome else ()
        yield from (Table(step.table.header, step.table.rows),) if step.table is not None else ()
    elif step.title.endswith(NOT_DERIVED):
        yield Text((f"{step.title}. ", *step.outcome))
    elif step.result:
        yield Equations(step.result)
        yield from (
            (Text(step.outcome),) if step.outcome and name in ("equilibria", "balance", "singular") else ()
        )
    else:
        own = [one for one in steps if one.id == name or one.id.startswith(f"{name}_")]
        told = tuple(one.outcome for one in own if one.outcome)
        yield List(told or step.notes or (step.why,))
    yield from (Text(one.concluding) for one in steps if one.id == f"{name}_stability")


def _lines(step: Step) -> Iterator[Block]:
    """The lines of a step, each after what is said of it."""
    for line in step.lines:
        yield Text(line.by)
        yield Equations(line.formulas)


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
        least = leading(solution, steps) if stages is None else steps
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
        if self.solution.is_short or (self.short is not None and self.short.long):
            return self.solution.is_short
        return self.detail is Detail.RESULTS or stands_twice(self.solution.robot, self.steps)

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
            folds = tuple(shown.of_stage(number, of_stage))
            if folds:  # no heading over a stage of which nothing is shown
                self.sections[stage] = number
                yield Heading(f"{number}. {heading_of(stage, robot)}", 2)
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
