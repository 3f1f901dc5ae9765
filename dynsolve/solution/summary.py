"""The section that closes a solution: the model, its matrices, the forces row by row, and what else is asked.

Everything in it is the result of a step, taken from there, so that it cannot differ.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import groupby, islice
from types import MappingProxyType

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.document import (
    Block,
    Equations,
    Formula,
    Heading,
    List,
    Prose,
    Reference,
    Table,
    Text,
)
from dynsolve.document.sentences import say
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.given import at_the_state, holds_at_state, in_words
from dynsolve.explain.step import NOT_DERIVED, Detail, Step
from dynsolve.explain.terms import ID, driving_row, rows_in_names
from dynsolve.explain.writing import listed, machine, side_by_side
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Matrix,
    Node,
    Relation,
    Symbol,
    equation,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

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
    """Whether a model of more coordinates is short enough to be written in the summary again."""
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
        *_others([name for name in of_steps if name not in above], robot, steps, has_inertia="D" in asked),
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
    zero = {}
    for name, text in _ZERO.items() if model.result else ():
        match forms(name):
            case Matrix() as matrix if matrix.is_zero:
                zero[name] = text
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


def _others(
    asked: Sequence[str], robot: Robot, steps: Sequence[Step], *, has_inertia: bool
) -> Iterator[Block]:
    """What else is asked for: what holds everywhere, then, said so, what holds at the given state alone.

    Accelerations, which hold with given rates alone, come last.  Where there is D its entries are not told.
    """
    if has_inertia:
        entries = {one for row in letters.entries("d", robot.n) for one in row}
        steps = [replace(step, defines=_without(step.defines, entries)) for step in steps]
    at_state = [name for name in asked if holds_at_state(robot, name)]
    yield from _with_conditions([name for name in asked if name not in at_state], robot, steps)
    for with_rates in (False, True):
        names = [name for name in at_state if (name == "qdd") is with_rates]
        if found := list(_with_conditions(names, robot, steps)):
            yield at_the_state(robot, names)
            yield from found


def _without(defined: Iterable[Node], entries: Collection[Node]) -> tuple[Node, ...]:
    return tuple(one for one in defined if not (isinstance(one, Relation) and one.parts[0] in entries))


def _with_conditions(names: Iterable[str], robot: Robot, steps: Sequence[Step]) -> Iterator[Block]:
    """Results that the exercise asks for, what letters in them stand for, and what they hold under.

    What is the same of several is said once.
    """
    told = {name: (step.defines, step.holds) for step in steps for name in (step.id, *step.also)}
    for (defined, condition), found in groupby(names, key=lambda name: told.get(name, ((), ()))):
        if defined:
            what = "With the divisor of several entries:" if len(defined) == 1 else "With"
            yield from (Text((what,)), Equations(defined))
        yield from (block for name in found for block in _asked_for(name, robot, steps))
        if condition:
            yield Text(condition)


def _asked_for(name: str, robot: Robot, steps: Sequence[Step]) -> Iterator[Block]:
    """A result that the exercise asks for: the equation of its letter, else what its step gives."""
    quantity = quantities(robot).get(name)
    letter = quantity.letter(robot) if quantity is not None and quantity.family.has_letter else None
    by_letter = [
        Formula(node, entries=step.entries if len(step.result) == 1 else ())
        for without_result in (True, False)
        for step in steps
        if without_result is not bool(step.result) and (step.id == name or step.id not in _ACCELERATIONS)
        for node in step.result or (step.formula,)
        if isinstance(node, Relation) and node.parts[0] == letter
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
    of_motion: Prose = say(" with {kept}", kept=kept) if steady else ()
    if name == "equilibria" and robot.questions.loads:
        of_motion = (*of_motion, " without the forces from outside")
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
