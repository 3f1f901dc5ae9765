"""Steps at a depth: which are shown, as how many, with which of their lines.

    results   none: what is given and the summary are the whole solution
    brief     of each step the formula that it comes from and its result, if the summary has not that
    normal    a worked example: steps of a group as one, with the lines that need a thought; of checks the
              outcome
    full      every step with all that it has

A number stands for the same step in normal and in full: 3.1 is a group or a step of its own, 3.1.2 what is
shown in full alone.  Brief has no numbers of steps, and counts the sections that it has.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain, count, zip_longest
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.document import (
    DEFINITIONS,
    Block,
    Equations,
    Fold,
    Formula,
    List,
    Note,
    Picture,
    Table,
    Text,
    Uses,
)
from dynsolve.document.figures import ArmFigure, Figure
from dynsolve.errors import attempted
from dynsolve.explain.step import Detail, Group, Line, Part, Step
from dynsolve.explain.writing import side_by_side
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import NAMED, Letter, Node, Relation, Row, equation, walk
from dynsolve.notation.unicode import UnicodePrinter, to_unicode
from dynsolve.render.page import leads_on
from dynsolve.render.terminal_boxes import TextBox, boxed, height, holds_matrix, pieces

Drawn = Callable[[Figure | ArmFigure], Picture | None]
"""What makes a picture of a drawing; none where there is no such pose of the arm."""

CHECKS = "Checks"


class Item(Struct, frozen=True):
    """What has a number of its own: the steps of a group, or one step."""

    steps: tuple[Step, ...]

    @property
    def group(self) -> Group | None:
        """What several steps are under one title; one step alone is none."""
        return self.steps[0].group if len(self.steps) > 1 else None

    @property
    def title(self) -> str:
        """That of the group, or of the step."""
        return (self.group or self.steps[0]).title

    @property
    def detail(self) -> Detail:
        """The depth from which it is shown."""
        return min(step.detail for step in self.steps)


def items(steps: Iterable[Step]) -> list[Item]:
    """The steps of a stage, those of a group together at the place of its first, unless all are extra."""
    found: dict[str, list[Step]] = {}
    for step in steps:
        key = f"group {step.group.id}" if step.group else step.id
        found.setdefault(key, []).append(step)
    together = [Item(tuple(each)) for each in found.values()]
    parted = (map(Item, zip(item.steps)) if item.detail is Detail.FULL else (item,) for item in together)
    return list(chain.from_iterable(parted))


class Shown(Struct):
    """Turns the items of a solution, in their order, into what a depth shows of them."""

    detail: Detail
    inputs: dict[str, tuple[str, ...]]
    style: Style
    drawn: Drawn | None
    in_summary: frozenset[str]
    earlier: EarlierResults = field(default_factory=lambda: EarlierResults())
    said: set[str] = field(default_factory=set)
    named: list[Relation] = field(default_factory=list)  # names that nothing shown has so far

    def of_stage(self, number: int, steps: Iterable[Step]) -> Iterator[Block]:
        """What is shown of a stage: folds, in brief the formulas alone."""
        if self.detail <= Detail.BRIEF:
            found = (block for item in items(steps) for block in self.results(item))
            yield from condensed(list(found), self.style)
            return
        place, extra = 0, 0
        outcomes: list[Step] = []
        for item in items(steps):
            if item.detail is Detail.FULL:
                extra += 1
                label = f"{number}.{place}.{extra}"
            else:
                place, extra = place + 1, 0
                label = f"{number}.{place}"
            if item.group and self.detail is Detail.FULL:
                yield Fold(f"{label} {item.title}", tuple(self.members(item, label)))
                extra = len(item.steps)
            elif item.detail <= self.detail:
                yield Fold(f"{label} {item.title}", self.blocks(item))
            else:
                outcomes += [step for step in item.steps if step.outcome]
                for step in item.steps:
                    self.earlier.add(step)
        if outcomes and self.detail is Detail.NORMAL:
            yield Fold(f"{number}.{place + 1} {CHECKS}", (List(tuple(step.outcome for step in outcomes)),))

    def blocks(self, item: Item) -> tuple[Block, ...]:
        """An item as one step."""
        if self.detail is Detail.FULL:
            return tuple(self.whole(item.steps[0]))
        return tuple(condensed(list(led_to(self.worked(item))), self.style))

    # -- full --------------------------------------------------------------------------------------

    def members(self, group: Item, label: str) -> Iterator[Fold]:
        """The steps of a group one by one, their numbers after that of the group."""
        for place, step in enumerate(group.steps, 1):
            yield Fold(f"{label}.{place} {step.title}", tuple(self.whole(step)))

    def whole(self, step: Step) -> Iterator[Block]:
        """A step with all that it has."""
        yield from led_to(step_blocks(self.referring(self.telling(step)), self.used(step), self.drawn))
        self.earlier.add(step)

    def telling(self, step: Step) -> Step:
        """A step without what a step that is alike has told."""
        is_told = step.said in self.said
        self.said |= {step.said} - {""}
        return replace(step, why=()) if is_told else step

    def used(self, step: Step) -> tuple[str, ...]:
        """The labels of what a step is computed from."""
        uses = self.inputs.get(step.id, ()) if step.uses is None else step.uses
        return self.earlier.used(step, (*uses, *step.names))

    def referring(self, step: Step) -> Step:
        """A step whose lines have the labels of the equations that they use."""
        return replace(
            step, lines=tuple(replace(line, uses=self.earlier.used(step, line.uses)) for line in step.lines)
        )

    # -- normal ------------------------------------------------------------------------------------

    def worked(self, item: Item) -> Iterator[Block]:
        """An item as one step of a worked example."""
        group = item.group
        if group and group.why:
            yield Text(group.why)
        if group and group.formula is not None:
            yield Formula(group.formula, group.source)
        sources = {group.source} if group else set()
        for step in item.steps:
            if step.detail < Detail.FULL:
                shown = normal(self.referring(self.telling(step)), group)
                shown = replace(shown, source="") if group and step.source in sources else shown
                if group and group.concluding and step is item.steps[-1]:
                    shown = replace(shown, concluding=group.concluding)
                yield from step_blocks(shown, (), self.drawn)
                sources |= {step.source} if shown.formula is not None else set()
            self.earlier.add(step)

    # -- brief -------------------------------------------------------------------------------------

    def results(self, item: Item) -> Iterator[Block]:
        """The formula of an item and its results, names defined where they first occur in one."""
        for step in item.steps:
            self.named += definitions(step)
            if step.detail <= self.detail:
                if step.table is not None:
                    yield Table(step.table.header, step.table.rows)
                if step.formula is not None:
                    yield Formula(step.formula, step.source)
                if Part.RESULT in step.normal and step.id not in self.in_summary:
                    if {node.parts[0] for node in self.named} & set(walk(*step.result)):
                        yield Equations(tuple(self.named))
                        self.named = []
                    yield from result_blocks(step)
            self.earlier.add(step)


def definitions(step: Step) -> Iterator[Relation]:
    """What names stand for that a step introduces."""
    for line in (*step.lines, Line((), step.result)):
        for node in line.formulas:
            if isinstance(node, Relation) and node.signs[-1] == NAMED:
                yield equation(node.parts[-1], node.parts[-2])
            elif isinstance(node, Relation) and line.label.startswith(DEFINITIONS):
                yield node


def normal(step: Step, group: Group | None) -> Step:
    """A step with the parts that a worked example has; what its group has is not repeated."""
    parts = step.normal
    if group and group.why:
        parts &= ~Part.WHY
    if group and group.formula is not None:
        parts &= ~Part.FORMULA
    least = Detail.FULL if Part.LINES in parts else Detail.RESULTS
    lines: list[Line] = []
    is_left_out = False
    for line in step.lines:
        if line.detail < least or line.label.startswith(DEFINITIONS):
            lines.append(replace(line, by=line.joined) if is_left_out and line.joined else line)
            is_left_out = False
        else:
            is_left_out = True
    hidden: dict[str, Any] = {str(part.name).lower(): () for part in Part if part not in parts}
    if "formula" in hidden:
        hidden["formula"] = None
    return replace(step, **{**hidden, "lines": tuple(lines)})


def step_blocks(step: Step, inputs: tuple[str, ...] = (), drawn: Drawn | None = None) -> Iterator[Block]:
    """A step with all that it has; `inputs` are the labels of what its result is computed from."""
    if step.why and not _opens_way(step):
        yield Text(step.why)
    if (figure := step.figure) and drawn:
        picture = attempted(lambda: drawn(figure), lambda: None, f"the picture of {step.title}")
        yield from () if picture is None else (picture,)
    table = () if step.table is None else (Table(step.table.header, step.table.rows),)
    is_result = step.formula is not None and [*map(to_unicode, step.result)] == [to_unicode(step.formula)]
    way = _way(replace(step, formula=None) if is_result else step, inputs)
    yield from chain(way, table) if step.table_last else chain(table, way)
    yield from result_blocks(step, step.source if is_result else "")
    for note in step.notes:
        yield Note(note)


def result_blocks(step: Step, source: str = "") -> Iterator[Block]:
    """The results of a step, each with its label, and its section where no formula stands above."""
    if step.listed:
        yield Equations(step.result, in_columns=True, label=step.id)
    for result, label in labelled_results(step):
        yield Formula(result, source, entries=step.entries, optional=step.optional, label=label)


def _way(step: Step, inputs: tuple[str, ...]) -> Iterator[Block]:
    """The way to the result: the formulas in letters, this robot's quantities in them, and what leads on.

    What goes in is named where it goes in: before the working, the first line, or else the result.
    """
    if step.formula is not None:
        yield Formula(step.formula, step.source)
    for formula in step.further:
        yield Formula(formula, optional=True)
    following = (*((Text(step.why),) if _opens_way(step) else ()), *_leading_on(step))
    yield from _with_uses(following, inputs) if inputs and (following or step.result) else following


def _opens_way(step: Step) -> bool:
    """Whether what is said of a step leads on to its first line, and so names what goes in there."""
    opened = bool(step.lines) and not step.lines[0].by and not step.working
    return opened and step.formula is None and step.table is None and leads_on(step.why)


def _leading_on(step: Step) -> Iterator[Block]:
    """What leads from the formulas in letters to the result."""
    results = set(map(to_unicode, step.result))
    for working in step.working:
        if to_unicode(working) not in results:
            yield Formula(working, optional=True)
    for line in step.lines:
        lead_in = (Text(line.by),) if line.by else ()
        yield from _with_uses(lead_in, line.uses) if line.uses else lead_in
        label = line.label
        if len(line.formulas) == 1:
            yield Formula(line.formulas[0], optional=not (label or line.is_kept), label=label)
        else:
            yield Equations(line.formulas, in_columns=line.in_columns, label=label)
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


def led_to(blocks: Iterable[Block]) -> Iterator[Block]:
    """The blocks, of which a formula that words lead to is never left out: they would lead to nothing."""
    before: Block | None = None
    for block in blocks:
        is_led_to = isinstance(before, Text | Uses) and leads_on(before.parts)
        if isinstance(block, Formula) and is_led_to:
            block = replace(block, optional=False)
        yield block
        before = block


# -- several formulas as one display ---------------------------------------------------------------

_ROOM = 84
"""The cells of a terminal up to which formulas stand side by side."""


def condensed(blocks: Sequence[Block], style: Style) -> list[Block]:
    """The blocks, formulas that follow each other without a word between them in one display.

    Equations with the same left side become a chain, matrices stand side by side where there is room, and
    equations between numbers one under another.
    """
    printer = UnicodePrinter(style)
    found: list[Block] = []
    for each in blocks:
        block = _packed(each, printer)
        joined = _joined(found[-1], block, printer) if found else None
        if joined is not None:
            found.pop()
        found.append(joined or block)
    return found


def _packed(block: Block, printer: UnicodePrinter) -> Block:
    """Equations of matrices beside each other, as many as a line has room for."""
    if not isinstance(block, Equations) or not any(map(holds_matrix, block.nodes)):
        return block
    rows: list[list[Node]] = [[]]
    for node in block.nodes:
        if rows[-1] and _cells(side_by_side([*rows[-1], node]), printer) > _ROOM:
            rows.append([])
        rows[-1].append(node)
    return replace(block, nodes=tuple(map(side_by_side, rows)), in_columns=False)


def _joined(one: Block, other: Block, printer: UnicodePrinter) -> Formula | Equations | None:
    """Two displays as one; None where they stay apart."""
    if isinstance(one, Formula) and isinstance(other, Formula):
        return _chained(one, other, printer) or _beside(one, other, printer) or _listed(one, other, printer)
    if isinstance(one, Equations) and isinstance(other, Formula) and not one.in_columns:
        return _listed(one, other, printer)
    return None


def _chained(one: Formula, other: Formula, printer: UnicodePrinter) -> Formula | None:
    """a = b and a = c as a = b = c; the same of several side by side."""
    pairs = list(zip_longest(_parts(one.node), _parts(other.node)))
    chains = [_chain(first, second) for first, second in pairs if first is not None and second is not None]
    found = [chain for chain in chains if chain is not None]
    if one.label or len(found) < len(pairs):
        return None
    node = side_by_side(found)
    widest = max(_cells(part, printer) for chain in found for part in chain.parts)
    if widest > _ROOM or (len(found) > 1 and _cells(node, printer) > _ROOM):
        return None
    return replace(other, node=node, source=one.source, optional=False)


def _chain(first: Node, second: Node) -> Relation | None:
    """Two equations with one left side as one."""
    if not (isinstance(first, Relation) and isinstance(second, Relation)):
        return None
    if first.parts[0] != second.parts[0] or {*first.signs, *second.signs} != {"="}:
        return None
    last = to_unicode(first.parts[-1])
    parts = (*first.parts, *(part for part in second.parts[1:] if to_unicode(part) != last))
    return Relation(parts, ("=",) * (len(parts) - 1))


def _beside(one: Formula, other: Formula, printer: UnicodePrinter) -> Formula | None:
    if one.source or other.source or bool(one.label) != bool(other.label) or one.optional != other.optional:
        return None
    if not (holds_matrix(one.node) and holds_matrix(other.node)):
        return None
    row = side_by_side([*_parts(one.node), *_parts(other.node)])
    if _cells(row, printer) > _ROOM:
        return None
    return replace(one, node=row, also=(*one.also, other.label, *other.also))


def _parts(node: Node) -> list[Node]:
    """The formulas of a row without the commas between them."""
    return list(node.parts[::2]) if isinstance(node, Row) else [node]


def _listed(one: Formula | Equations, other: Formula, printer: UnicodePrinter) -> Equations | None:
    """Equations of one line each one under another, a chain where two have the same left side or value."""
    nodes = one.nodes if isinstance(one, Equations) else (one.node,)
    if (isinstance(one, Formula) and (one.source or one.entries)) or other.source or other.entries:
        return None
    if one.label.startswith(DEFINITIONS) or any(height(node) > 1 for node in (*nodes, other.node)):
        return None
    labels = [label for label in (one.label, *one.also, other.label, *other.also) if label]
    chain = _chain(nodes[-1], other.node)
    if chain is not None and not (isinstance(one, Formula) and one.label) and _cells(chain, printer) <= _ROOM:
        nodes = (*nodes[:-1], chain)
    elif (alike := _alike(nodes[-1], other.node)) is not None:
        nodes = (*nodes[:-1], alike)
    else:
        nodes = (*nodes, other.node)
    return Equations(nodes, label=labels[0] if labels else "", also=tuple(labels[1:]))


def _alike(first: Node, second: Node) -> Relation | None:
    """One letter of two bodies that has one value, r₁ = 0 and r₂ = 0, as r₁ = r₂ = 0."""
    match first, second:
        case Relation((*some, last)), Relation((Letter(base) as other, value)) if last == value:
            same = all(isinstance(one, Letter) and one.base == base for one in some)
            is_plain = same and {*first.signs, *second.signs} == {"="}
            return equation(*some, other, value) if is_plain else None
    return None


def _cells(node: Node, printer: UnicodePrinter) -> int:
    """How wide a formula is in a terminal."""
    return sum(
        (piece if isinstance(piece, TextBox) else boxed(piece, printer)).width
        for piece in pieces(node, printer)
    )


# -- what a step refers back to: of the steps that it is computed from, the equations that it uses -----
# A step may have several results, the axes and origins of all joints above all.  A later step cites those of
# them whose left side stands in its own formulas, and all of them where none does.


def labelled_results(step: Step) -> Iterator[tuple[Node, str]]:
    """The results of a step that have a number, each with its label."""
    if step.together:
        yield side_by_side(step.result), step.id
    elif not step.listed:  # results without a name are numbered
        labels = chain((step.id, *step.also), (f"{step.id}-{place}" for place in count(2)))
        yield from zip(step.result, labels, strict=False)


class EarlierResults:
    """The numbered results of the steps so far."""

    def __init__(self) -> None:
        self._results: dict[str, list[tuple[Node, str]]] = {}

    def add(self, step: Step) -> None:
        """Remember a step."""
        for line in step.lines:
            if line.label:
                self._results[line.label] = [(formula, line.label) for formula in line.formulas]
        if step.listed or step.together:  # in one display
            results = [(result, step.id) for result in step.result]
            self._results |= dict.fromkeys((step.id, *step.also), results)
        else:
            self._results[step.id] = list(labelled_results(step))

    def used(self, step: Step, names: Iterable[str]) -> tuple[str, ...]:
        """The labels of the equations of the steps `names` that a step uses; `x#2` is the second of x."""
        lines = [node for line in step.lines for node in line.formulas]
        formulas = [node for node in (step.formula, *step.further, *step.working, *lines) if node is not None]
        parts = frozenset(walk(*formulas))
        labels: list[str] = []
        for whole in names:
            name, _, place = whole.partition("#")
            results = self._results.get(name)
            if results is None:  # a further result of an earlier step, by its own label
                labels.append(name)
                continue
            if place:  # a step that is shown in another form may not have it
                labels += [label for _, label in results[int(place) - 1 : int(place)]]
                continue
            cited = [label for node, label in results if any(left in parts for left in _left_sides(node))]
            labels += cited or [label for _, label in results]
        return tuple(dict.fromkeys(labels))


def _left_sides(node: Node) -> Iterator[Node]:
    """The left side of an equation, or of several on one line."""
    parts = node.parts if isinstance(node, Row) else (node,)
    return (part.parts[0] for part in parts if isinstance(part, Relation))
