"""Numbers as a part of a solution's document.

Which results are shown in numbers, stage by stage.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial
from types import MappingProxyType

from dynsolve.document import Block, Fold, Formula, Heading, Inline, Table, Text
from dynsolve.explain.given import at_the_state, holds_at_state
from dynsolve.explain.step import Detail
from dynsolve.explain.terms import driving_row
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Matrix, Node, Row, Sum, Symbol, Words, equation, walk
from dynsolve.notation.unicode import UnicodePrinter, to_unicode
from dynsolve.quantities import families as of
from dynsolve.quantities import letters
from dynsolve.quantities.families.bodies import DH
from dynsolve.quantities.family import Family, Kind
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.owners import heading_of, stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot import units
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers import given
from dynsolve.solution.numbers.given import GivenValue
from dynsolve.solution.numbers.results import Numbers, State, needed
from dynsolve.solution.numbers.substitution import DIGITS

# Which results are shown in numbers, stage by stage

Shown = tuple[str, Node]
"""The name of a result, and the letter it is shown by."""

_KINEMATICS = ("Jv", "Jw")
"""What is shown beside the last frame where nothing is asked for that there is."""

_ALL = (
    (of.A,), (of.H,), (of.JV,), (of.JW,), (of.RC, of.R, of.I), (of.P_BODY,), (of.P,),
    (of.JV_BODY, of.JW_BODY, of.V, of.W, of.KV, of.KW, of.K_BODY), (of.K,), (of.L,),
    (of.DLDQD, of.DDT, of.DLDQ, of.FORCE), (of.D,), (of.C,), (of.CQD,), (of.G,),
)  # fmt: skip
"""What is shown of one body, or of one coordinate, before the next stands together."""


def asked_results(robot: Robot, asked: Collection[str]) -> dict[Stage, list[Shown]]:
    """The results that an exercise asks for, by stage, as far as they have values."""
    known, stages = quantities(robot), stages_of(robot)
    named = {"tau": [q.name for q in known.of_family(of.FORCE)], "J": _KINEMATICS}
    wanted = {part for name in asked for part in named.get(name, (name,))}
    found = [q for q in known.values() if q.name in wanted and q.family.stage in stages]
    if not found and robot.has_table:
        found = [known[name] for name in (f"H{len(robot.joints)}", *_KINEMATICS)]
    return _by_stage(robot, (q for q in found if q.family.kind is Kind.VALUE and q.family is not DH))


def all_results(robot: Robot, derived: Collection[str]) -> dict[Stage, list[Shown]]:
    """What is `derived`, by stage; the tensor and the axes of a point mass say nothing."""
    known = quantities(robot)
    shown = (q for q in _members(robot, _ALL) if q.family not in (of.R, of.I) or known.is_real(q))
    return _by_stage(robot, (q for q in shown if q.rule in derived))


def _members(robot: Robot, groups: Sequence[tuple[Family, ...]]) -> Iterator[Quantity]:
    known = quantities(robot)
    for group in groups:
        for of_one in zip(*map(known.of_family, group), strict=True):
            yield from of_one


def _by_stage(robot: Robot, shown: Iterable[Quantity]) -> dict[Stage, list[Shown]]:
    found: dict[Stage, list[Shown]] = {}
    stages = stages_of(robot)
    for quantity in shown:
        stage = quantity.family.stage
        if stage in stages:
            letter = quantity.letter(robot)
            if quantity.family is of.FORCE:
                letter = driving_row(robot, robot.coordinates[quantity.index[0] - 1])
            found.setdefault(stage, []).append((quantity.form, letter))
    return {stage: found[stage] for stage in Stage if stage in found}


_WIDEST = 50
"""A matrix that is wider, in characters, has its unit by itself."""


def blocks(
    numbers: Numbers,
    detail: Detail,
    asked: Collection[str] = (),
    derived: Collection[str] = (),
    stages: Iterable[str] | None = None,
    told: Mapping[str, str] = MappingProxyType({}),
    forms: Callable[[str], Node] | None = None,
    digits: int = DIGITS,
) -> Iterator[Block]:
    """The values but for those that are `told`, what is `asked` with them, and at the state.

    Decimals are of so many significant `digits`, if no others are asked for.
    Of chosen stages, and at a state, what was `derived` stands before it.  What values do not change is as
    `forms` has it, and is not repeated.
    """
    robot = numbers.robot
    chosen = None if stages is None else set(stages)
    results = asked_results(robot, asked)
    led_up = {} if detail <= Detail.BRIEF else all_results(robot, derived)
    whole = {
        stage: list(dict.fromkeys((*led_up.get(stage, ()), *results.get(stage, ()))))
        for stage in Stage
        if (stage in led_up or stage in results) and (chosen is None or stage in chosen)
    }
    valued: list[Block] = []
    if numbers.valued is not None and chosen is not None:
        valued = list(_results(robot, whole, partial(numbers.valued.shown, digits=digits), folded=True))
    elif numbers.valued is not None:
        tree = partial(numbers.valued.shown, digits=digits)
        changed = {
            stage: [
                (name, letter)
                for name, letter in shown
                if forms is None or to_unicode(tree(name)) != to_unicode(forms(name))
            ]
            for stage, shown in results.items()
        }
        here = partial(holds_at_state, robot)
        valued = list(_results(robot, _those(changed, lambda name: not here(name)), tree, folded=False))
        if found := list(_results(robot, _those(changed, here), tree, folded=False)):
            valued += (at_the_state(robot, asked), *found)
    if numbers.given.entries:
        yield from _with_heading(_values(numbers, told), valued)
    if numbers.state is not None:
        yield from _state(numbers, numbers.state)
        at_state = partial(numbers.state.shown, digits=digits)
        yield from _results(robot, whole, at_state, folded=True)


# -- values ----------------------------------------------------------------------------------------


def _those(shown: Mapping[Stage, Sequence[Shown]], wanted: Callable[[str], bool]) -> dict[Stage, list[Shown]]:
    """The results of which the names are wanted, of stages that have some."""
    kept = {stage: [one for one in results if wanted(one[0])] for stage, results in shown.items()}
    return {stage: results for stage, results in kept.items() if results}


def _with_heading(values: Iterable[Block], results: Sequence[Block]) -> Iterator[Block]:
    """The values and the results under their heading; nothing where there are none."""
    told = tuple(values)
    if told or results:
        yield Heading("With numbers", 2)
        yield Text(("In SI units (m, kg, s), angles in rad.",))
        yield from (*told, *results)


def _values(numbers: Numbers, told: Mapping[str, str]) -> Iterator[Block]:
    rows: list[tuple[Node, GivenValue, str]] = [
        (Symbol(name), entry, entry.unit)
        for name in numbers.robot.parameters
        if (entry := numbers.given.entries.get((name, 0))) is not None and told.get(name) != entry.text
    ]
    if rows:
        yield _table(rows)
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
    robot: Robot, shown: Mapping[Stage, Sequence[Shown]], tree: Callable[[str], Node], *, folded: bool
) -> Iterator[Block]:
    for stage, results in shown.items():
        formulas = [block for name, letter in results for block in _shown(robot, name, letter, tree(name))]
        if folded:
            yield Fold(heading_of(stage, robot), (*_remark(robot, stage), *formulas))
        else:
            yield from (*_remark(robot, stage), *formulas)


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


def _state(numbers: Numbers, state: State) -> Iterator[Block]:
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
