"""The section that closes a solution: the model, its matrices, the forces row by row.

Everything in it is the result of a step, taken from there, so that it cannot differ.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from dynsolve.document import Block, Equations, Formula, Heading, Prose, Reference, Text
from dynsolve.explain import closing
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.named_steps import labels_of_names
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import equation
from dynsolve.quantities import letters
from dynsolve.quantities.robot_stages import stages_of
from dynsolve.robot.model import Robot

TITLE = "Summary"

_MATRICES = ("D", "C", "friction", "g")


def in_summary(steps: Sequence[Step], is_short: bool) -> frozenset[str]:
    """The steps whose results stand in the summary as well."""
    if not is_short or all(step.id != closing.ID for step in steps):
        return frozenset()
    return frozenset(step.id for step in steps if step.id in _MATRICES or re.fullmatch(r"tau\d+", step.id))


def summary_blocks(
    robot: Robot,
    steps: Sequence[Step],
    detail: Detail,
    short: Abbreviated | None = None,
    *,
    asked: Sequence[str] = (),
    is_short: bool = True,
) -> Iterator[Block]:
    """D q̈ + C q̇ + g = τ with D, C and g, then every force; nothing where the model was not asked for.

    Of arms that are not short D, C, g and the forces are not written again, but for one row.  The
    names in C, or in all of them, are repeated beside them, and the rows are in these.
    """
    by_id = {step.id: step for step in steps}
    model = by_id.get(closing.ID)
    if model is None:
        return
    yield Heading(TITLE, 2, closing=True)
    if detail is Detail.FULL:
        yield Text(model.why)
    assert model.formula is not None
    yield Formula(model.formula, source=model.source)
    if not is_short:
        number = list(stages_of(robot)).index(model.stage) + 1
        with_symbols = by_id["christoffel"].detail <= detail
        yield Text(_where_they_are(f" are those of section {number}", with_symbols))
        if with_symbols:
            yield from _lines(model)
        return
    found = Reference(_MATRICES, ", ")
    if model.result:
        yield Text(("With the matrices of this robot", found, ":"))
        matrices = tuple(_results(by_id, [name for name in _MATRICES if name in by_id]))
        for result in model.result:
            yield Formula(result, entries=model.entries, otherwise=matrices)
    else:
        yield Text(("The matrices of this robot", found, ":"))
        yield from _results(by_id, [name for name in _MATRICES if name in by_id])
    if short is not None and short.at_symbols:
        where: Prose = ("these",) if short.inertias and short.inertias.definitions else (letters.C,)
        below: Prose = ("In ", *where, " and in the rows below")
        defined = Reference(labels_of_names(steps, short), ", by ")
        meanings = tuple(equation(one.name, one.meaning) for one in short.sums)
        if short.single is not None and len(meanings) == 1:
            yield Text((*below, " ", *meanings, defined, "."))
        else:
            yield Text((*below, defined, ":"))
            yield Equations(meanings)
    yield from _lines(model)
    forces = [f"tau{q.index}" for q in robot.coordinates]
    if not model.lines and all(name in by_id for name in forces):
        lead = "Row by row" if len(forces) > 1 else "Multiplied out"
        yield Text((lead, Reference(tuple(forces), ", "), ":"))
        yield Equations(tuple(by_id[name].result[0] for name in forces))
    yield from _asked_for(asked, by_id)


def _asked_for(asked: Sequence[str], by_id: Mapping[str, Step]) -> Iterator[Block]:
    """Where the energies and the Lagrangian are, where the exercise asks for them."""
    found = [name for name in ("P", "K", "L") if name in asked and name in by_id]
    if found:
        stand = " stands above" if len(found) == 1 else " stand above"
        where = Reference(tuple(found), ", ")
        yield Text((*listed([getattr(letters, name) for name in found]), stand, where, "."))


def _lines(step: Step) -> Iterator[Block]:
    """The lines of a step, each after what is said of it."""
    for line in step.lines:
        yield Text(line.by)
        yield Equations(line.formulas)


def _where_they_are(place: str, with_symbols: bool) -> Prose:
    """Where D, C and g of a long model are; C is its Christoffel symbols, where these are shown."""
    D, g = (letters.D, Reference(("D",))), (letters.G, Reference(("g",)))
    if not with_symbols:
        return (
            *listed([D, g]),
            f"{place}; ",
            letters.C,
            " follows from ",
            letters.D,
            " as it is told there.",
        )
    symbols = ("the Christoffel symbols", Reference(("christoffel",)), ", which make ", letters.C, ",")
    return (*listed([D, symbols, g]), f"{place}.")


def _results(by_id: Mapping[str, Step], names: Sequence[str]) -> Iterator[Formula]:
    """The first results of steps, as these print them."""
    for name in names:
        step = by_id[name]
        yield Formula(step.result[0], entries=step.entries)
