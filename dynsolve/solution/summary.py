"""The section that closes a solution: the model, its matrices, the forces row by row.

Everything in it is the result of a step, taken from there, so that it cannot differ.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from dynsolve.document import Block, Equations, Formula, Heading, List, Prose, Reference, Table, Text
from dynsolve.document.sentences import say
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.given import CALLED
from dynsolve.explain.named_steps import labels_of_names
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.terms import ID
from dynsolve.explain.writing import is_small, listed, side_by_side
from dynsolve.notation.tree import ZERO, Relation, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.index import quantities
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

TITLE = "Summary"

_MATRICES = ("D", "C", "friction", "g")

_AT_STATE = frozenset({"Q", "tau_static", "qd", "qdd", "nullspace", "rangespace", "lost"})
"""What is computed at the state that a file gives."""

_ACCELERATIONS = ("qdd", "qdd_forward")
"""Two results of one letter."""


def in_summary(robot: Robot, steps: Sequence[Step], asked: Sequence[str], is_short: bool) -> frozenset[str]:
    """The steps whose results stand in the summary as well."""
    has_model = is_short and any(step.id == ID for step in steps)
    return (frozenset(asked) - in_model(robot)) | (in_model(robot) if has_model else frozenset())


def summary_blocks(
    robot: Robot,
    steps: Sequence[Step],
    detail: Detail,
    short: Abbreviated | None = None,
    *,
    asked: Sequence[str] = (),
    is_short: bool = True,
    sections: Mapping[Stage, int] = MappingProxyType({}),
) -> Iterator[Block]:
    """D q̈ + C q̇ + g = τ with D, C and g, then every force, and whatever else the exercise asks for.

    `sections` are the numbers of the stages that are shown.
    """
    by_id = {step.id: step for step in steps}
    model = by_id.get(ID)
    of_model = in_model(robot) if model else frozenset()
    if not is_short and detail is not Detail.RESULTS:  # what is short of a long model, if it is asked for
        of_model -= {name for name in ("D", "g") if name in by_id and is_small(*by_id[name].result)}
    others = list(_others([name for name in asked if name not in of_model], robot, steps))
    if model is None and not others:
        return
    yield Heading(TITLE, 2, closing=True)
    if model is not None and is_short:
        yield from _model(robot, model, by_id, detail, short)
    elif model is not None:
        yield from _long_model(model, by_id, detail, sections)
    yield from others


def in_model(robot: Robot) -> frozenset[str]:
    """The names of what stands in the model and its rows."""
    return frozenset(("tau", *_MATRICES, *(f"tau{q.index}" for q in robot.coordinates)))


def _model(
    robot: Robot, model: Step, by_id: Mapping[str, Step], detail: Detail, short: Abbreviated | None
) -> Iterator[Block]:
    """The equation of motion in letters and in matrices, and row by row; the names in it."""
    if detail is Detail.FULL:
        yield Text(model.why)
    assert model.formula is not None
    yield Formula(model.formula, source=model.source if detail > Detail.RESULTS else "")
    if short is not None and short.at_symbols:
        yield from _names(by_id, short)
    own = [by_id[name] for name in _MATRICES if name in by_id]
    matrices = tuple(Formula(step.result[0], entries=step.entries) for step in own)
    what = "With the matrices" if model.result else "The matrices"
    yield Text((what, " of this robot", Reference(_MATRICES, ", "), ":"))
    if model.result:
        yield from (Formula(result, entries=model.entries, otherwise=matrices) for result in model.result)
    else:
        yield from matrices
    yield from _lines(model)
    forces = [f"tau{q.index}" for q in robot.coordinates]
    if not model.lines and all(name in by_id for name in forces):
        lead: Prose = ("Row by row" if len(forces) > 1 else "Multiplied out",)
        passive = [letters.force(robot.coordinates[k]) for k in robot.actions.passive]
        lead += (", with ", equation(*passive, ZERO)) if passive else ()
        yield Text((*lead, Reference(tuple(forces), ", "), ":"))
        yield Equations(tuple(by_id[name].result[0] for name in forces))


def _names(by_id: Mapping[str, Step], short: Abbreviated) -> Iterator[Block]:
    """What the names in C, or in all of the matrices, stand for."""
    where = "the matrices" if short.inertias and short.inertias.definitions else letters.C
    below: Prose = ("In ", where, " and in the rows below")
    defined = Reference(labels_of_names(list(by_id.values()), short), ", by ")
    meanings = tuple(equation(one.name, one.meaning) for one in short.sums)
    if short.single is not None and len(meanings) == 1:
        yield Text((*below, " ", *meanings, defined, "."))
    else:
        yield Text((*below, defined, ":"))
        yield Equations(meanings)


def _long_model(
    model: Step, by_id: Mapping[str, Step], detail: Detail, sections: Mapping[Stage, int]
) -> Iterator[Block]:
    """Of a long model where D, C and g are; these themselves where no stage shows them."""
    if detail is Detail.RESULTS:
        assert model.formula is not None
        yield Formula(model.formula)
        for name in ("D", "christoffel", "g"):
            step = by_id[name]
            yield from (Formula(result, entries=step.entries) for result in step.result)
        return
    yield Text(model.why)
    assert model.formula is not None
    yield Formula(model.formula, source=model.source)
    number = sections.get(model.stage)
    place = " are those of the matrix form" if number is None else f" are those of section {number}"
    D, g = (letters.D, Reference(("D",))), (letters.G, Reference(("g",)))
    if by_id["christoffel"].detail > detail:
        yield Text((*listed([D, g]), *say("{place}; $𝐂$ follows from $𝐃$ as it is told there.", place=place)))
        return
    symbols = say("the Christoffel symbols{which}, which make $𝐂$,", which=Reference(("christoffel",)))
    yield Text((*listed([D, symbols, g]), f"{place}."))
    yield from _lines(model)


def _others(asked: Sequence[str], robot: Robot, steps: Sequence[Step]) -> Iterator[Block]:
    """What else is asked for: what holds everywhere, then, said so, what holds at the given state alone."""
    state = robot.questions.state.values
    at_state = [name for name in asked if state and name.rstrip("0123456789") in _AT_STATE]
    for name in (name for name in asked if name not in at_state):
        yield from _asked_for(name, robot, steps)
    found = [block for name in at_state for block in _asked_for(name, robot, steps)]
    if found:
        given = side_by_side([equation(Symbol(name, dots), value) for name, dots, value in state])
        yield Text(say("At {given}:", given=given))
        yield from found


def _asked_for(name: str, robot: Robot, steps: Sequence[Step]) -> Iterator[Block]:
    """A result that the exercise asks for: the equation of its letter, else what its step gives."""
    quantity = quantities(robot).get(name)
    letter = quantity.letter(robot) if quantity is not None and quantity.family.has_letter else None
    by_letter = [
        Formula(result, entries=step.entries if len(step.result) == 1 else ())
        for step in steps
        if step.id == name or step.id not in _ACCELERATIONS
        for result in step.result
        if isinstance(result, Relation) and result.parts[0] == letter
    ]
    yield from by_letter[-1:]
    step = next((step for step in steps if name in (step.id, *step.also)), None)
    if by_letter or step is None:
        return
    called = CALLED.get(name, step.title)
    steady = robot.questions.model.steady if name == "equilibria" else ()
    kept = side_by_side([equation(Symbol(of, 1), value) for of, value in steady]) if steady else ""
    of_motion = say(" with {kept}", kept=kept) if steady else ""
    yield Text(say(f"{called[0].upper()}{called[1:]}{{of_motion}}:", of_motion=of_motion))
    if step.table is not None:
        unknowns = {f"{name}_{q.name}" for q in robot.coordinates} & set(step.uses or ())
        formulas = tuple(result for one in steps if one.id in unknowns for result in one.result)
        yield from (Equations(formulas),) if formulas else ()
        yield Table(step.table.header, step.table.rows)
    elif step.result:
        yield Equations(step.result)
        yield from (Text(step.outcome),) if step.outcome and name == "equilibria" else ()
    else:
        told = tuple(one.outcome for one in steps if one.stage is step.stage and one.outcome)
        yield List(told or step.notes or (step.why,))
    yield from (Text(one.concluding) for one in steps if one.id == f"{name}_stability")


def _lines(step: Step) -> Iterator[Block]:
    """The lines of a step, each after what is said of it."""
    for line in step.lines:
        yield Text(line.by)
        yield Equations(line.formulas)
