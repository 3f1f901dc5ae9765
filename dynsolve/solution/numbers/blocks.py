"""Numbers as a part of a solution's document.

Which results are shown in numbers, stage by stage.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from itertools import chain

from dynsolve.document import Block, Fold, Formula, Heading, Inline, Table, Text
from dynsolve.explain.step import Detail
from dynsolve.explain.terms import driving_row
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Matrix, Node, Row, Sum, Symbol, Words, equation, walk
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import families as of
from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.owners import heading_of, stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot import units
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers import given
from dynsolve.solution.numbers.given import GivenValue
from dynsolve.solution.numbers.results import Numbers, State, needed

# Which results are shown in numbers, stage by stage

Shown = tuple[str, Node]
"""The name of a result, and the letter it is shown by."""

_MAIN = (
    (of.H,), (of.JV,), (of.JW,), (of.P,), (of.K,), (of.L,), (of.FORCE,), (of.D,), (of.C,), (of.CQD,), (of.G,),
)  # fmt: skip
"""What an exercise asks for, of the frames the last one."""

_ALL = (
    (of.A,), (of.H,), (of.JV,), (of.JW,), (of.RC, of.R, of.I), (of.P_BODY,), (of.P,),
    (of.JV_BODY, of.JW_BODY, of.V, of.W, of.KV, of.KW, of.K_BODY), (of.K,), (of.L,),
    (of.DLDQD, of.DDT, of.DLDQ, of.FORCE), (of.D,), (of.C,), (of.CQD,), (of.G,),
)  # fmt: skip
"""What is shown of one body, or of one coordinate, before the next stands together."""


def main_results(robot: Robot) -> dict[Stage, list[Shown]]:
    """The results that an exercise asks for, by stage."""
    last = len(robot.joints)
    shown = (q for q in _members(robot, _MAIN) if q.family is not of.H or q.index == (last,))
    return _by_stage(robot, chain(shown, _asked(robot)))


def all_results(robot: Robot) -> dict[Stage, list[Shown]]:
    """Every result of the derivation, by stage; the tensor and the axes of a point mass say nothing."""
    known = quantities(robot)
    shown = (q for q in _members(robot, _ALL) if q.family not in (of.R, of.I) or known.is_real(q))
    return _by_stage(robot, chain(shown, _asked(robot)))


def _asked(robot: Robot) -> Iterator[Quantity]:
    """What only this exercise asks, as far as it has values."""
    asked = robot.questions.asked
    return (q for q in quantities(robot).values() if q.name in asked and q.family.kind is Kind.VALUE)


def _members(robot: Robot, groups: Sequence[tuple[Family, ...]]) -> Iterator[Quantity]:
    known = quantities(robot)
    for group in groups:
        for of_one in zip(*map(known.of_family, group), strict=True):
            yield from of_one


def _by_stage(robot: Robot, shown: Iterator[Quantity]) -> dict[Stage, list[Shown]]:
    found: dict[Stage, list[Shown]] = {}
    stages = stages_of(robot)
    for quantity in shown:
        stage = quantity.family.stage
        if stage in stages:
            letter = quantity.letter(robot)
            if quantity.family is of.FORCE:
                letter = driving_row(robot, robot.coordinates[quantity.index[0] - 1])
            found.setdefault(stage, []).append((quantity.rule, letter))
    return {stage: found[stage] for stage in Stage if stage in found}


_WIDEST = 50
"""A matrix that is wider, in characters, has its unit by itself."""


def blocks(
    numbers: Numbers,
    detail: Detail,
    asked: Collection[str] = (),
    derived: Collection[str] = (),
    stages: Iterable[str] | None = None,
) -> Iterator[Block]:
    """The values, what is `asked` and what that is `derived` from with them, and at the state.

    Where results alone are shown, only what is asked.
    """
    chosen = None if stages is None else set(stages)
    names = {"tau": {f"tau{q.index}" for q in numbers.robot.coordinates}}
    wanted = set().union(*(names.get(name, {name}) for name in asked))

    def led_to(found: dict[Stage, list[Shown]], known: Collection[str]) -> dict[Stage, list[Shown]]:
        return {stage: [one for one in shown if one[0] in known] for stage, shown in found.items()}

    if numbers.given.entries:
        yield from _values(numbers)
    if numbers.valued is not None:
        known = wanted if detail is Detail.RESULTS else {*wanted, *derived}
        yield from _results(
            numbers.robot, led_to(main_results(numbers.robot), known), numbers.valued.shown, chosen
        )
    if numbers.state is not None:
        shown = main_results(numbers.robot) if detail <= Detail.BRIEF else all_results(numbers.robot)
        yield from _state(numbers, numbers.state, led_to(shown, {*wanted, *derived}), chosen)


# -- values ----------------------------------------------------------------------------------------


def _values(numbers: Numbers) -> Iterator[Block]:
    yield Heading("With numbers", 2)
    words = "Lengths are in m, angles in rad."
    if numbers.robot.has_dynamics:
        words = (
            "Lengths in m, masses in kg, times in s and angles in rad: torques are then in N m, forces in N "
            "and energies in J."
        )
    yield Text((words,))
    yield _table(
        (Symbol(name), entry, entry.unit)
        for name in numbers.robot.parameters
        if (entry := numbers.given.entries.get((name, 0))) is not None
    )
    if numbers.lacking:
        yield Text((*_names("Without a value, and so still a symbol: ", numbers.lacking), "."))


def _table(rows: Iterable[tuple[Node, GivenValue, str]]) -> Table:
    cells: list[tuple[Inline, ...]] = [
        (symbol, _written(entry), units.node(unit) if unit else "") for symbol, entry, unit in rows
    ]
    return Table(("symbol", "value", "unit"), tuple(cells))


def _written(entry: GivenValue) -> str:
    """A value as it was given: 30° for 30deg."""
    return entry.text.replace(" deg", "°").replace("deg", "°").replace("-", "−")


def _names(words: str, names: Iterable[str]) -> Iterator[Inline]:
    yield words
    for i, name in enumerate(names):
        if i:
            yield ", "
        yield Symbol(name)


# -- results ---------------------------------------------------------------------------------------


def _results(
    robot: Robot, shown: dict[Stage, list[Shown]], tree: Callable[[str], Node], stages: set[str] | None
) -> Iterator[Block]:
    for stage, results in shown.items():
        if results and (stages is None or stage in stages):
            formulas = [
                block for name, letter in results for block in _shown(robot, name, letter, tree(name))
            ]
            yield Fold(heading_of(stage, robot), (*_remark(robot, stage), *formulas))


def _entries(robot: Robot, name: str) -> tuple[tuple[Node, ...], ...]:
    """The names of the entries of a matrix that may be too wide for the page."""
    if name == "g":
        return letters.entries_of_column("g", robot.n)
    return letters.entries(name.lower(), robot.n) if name in ("D", "C") else ()


def _remark(robot: Robot, stage: Stage) -> Iterator[Block]:
    """Where the entries of one matrix are measured in several units."""
    kinds = {q.type for q in robot.coordinates}
    if stage is Stage.KINEMATICS:
        yield Text(("The fourth column of H is a position, in m.",))
    if stage is Stage.JACOBIAN and len(kinds) > 1:
        words = (
            "The columns of the linear part that belong to an angle are in m, those of a length pure numbers."
        )
        yield Text((words,))


def _shown(robot: Robot, name: str, letter: Node, result: Node) -> Iterator[Block]:
    """letter = result, in its unit: after a number, after `in` where a symbol is left.

    A matrix that may be too wide for the page has its unit before it.
    """
    unit = _unit(given.of_result(robot, name), letter)
    formula = equation(letter, result)
    if unit is None:
        yield Formula(formula, entries=_entries(robot, name))
    elif isinstance(result, Matrix) and _is_wide(result):
        yield Formula(Row((letter, Words(" in "), unit)))
        yield Formula(formula, entries=_entries(robot, name))
    else:
        plain = not any(isinstance(part, Symbol | Sum) for part in walk(result))
        lead = " " if plain and not isinstance(unit, Matrix) else " in "
        yield Formula(equation(letter, Row((result, Words(lead), unit))))


def _unit(unit: str | given.Units, letter: Node) -> Node | None:
    """The unit of a result, a matrix of units where entries differ; None where nothing is to be said."""
    if isinstance(unit, str):
        return units.node(unit) if unit else None
    several = {entry for row in unit for entry in row}
    if len(several) == 1:
        return _unit(several.pop(), letter)
    if len(unit[0]) == 1 or letter in (letters.D, letters.C):
        return Matrix(tuple(tuple(units.node(entry or "1") for entry in row) for row in unit))
    return None


def _is_wide(matrix: Matrix) -> bool:
    printed = UnicodePrinter(PLAIN)
    return any(sum(len(printed.text(entry)) + 2 for entry in row) > _WIDEST for row in matrix.rows)


# -- a state ---------------------------------------------------------------------------------------


def _state(
    numbers: Numbers, state: State, shown: dict[Stage, list[Shown]], stages: set[str] | None
) -> Iterator[Block]:
    robot = numbers.robot
    yield Heading("At a state", 2)
    rows: list[tuple[Node, GivenValue, str]] = []
    still = []
    for dots in (0, 1, 2):
        for q in robot.coordinates:
            entry = state.given.entries[q.name, dots]
            if dots and entry.text == "0":
                still.append(Symbol(q.name, dots))
            else:
                unit = entry.unit or ("" if "deg" in entry.text or "°" in entry.text else "rad")
                rows.append((Symbol(q.name, dots), entry, unit))
    yield _table(rows)
    if still:
        words: list[Inline] = []
        for i, symbol in enumerate(still):
            words += [", " if i else "", symbol]
        if len(still) == 2 * robot.n:
            words = ["All velocities and accelerations"]
        yield Text((*words, " is 0." if len(still) == 1 else " are 0."))
    free = needed(state.robot)
    if free:
        yield Text((*_names("Parameters without a value stay symbols: ", free), "."))
    yield from _results(robot, shown, state.shown, stages)
