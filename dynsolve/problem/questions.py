"""What a problem file asks around the model, as it is written: named points, the task, forces, the state.

`reach` and `limits` of a problem file: what r(q) is to be, and the ranges of the joints.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.notation.tree import Symbol
from dynsolve.problem.actions import ParsedLoad, ParsedWeights, read_loads, read_weights
from dynsolve.problem.base import ParsedRotation
from dynsolve.problem.bodies import NOT_DRAWN, DrawnFrames, ParsedPlace, read_link, read_place
from dynsolve.problem.cells import (
    Cell,
    forbid,
    read_angle,
    read_cell,
    read_expressions,
    read_point_expression,
)
from dynsolve.problem.kinds import Fields, describe, items, whole_number, word
from dynsolve.problem.kinematic_keys import (
    ALL,
    IN_LINK,
    MAX_POINTS,
    MAX_TASK,
    POINT,
    WHOLE,
)
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.state import Given, ParsedState, is_reached, read_state
from dynsolve.problem.table import by_coordinate
from dynsolve.problem.yaml_nodes import (
    Faults,
    FaultyNode,
    ListNode,
    MappingNode,
    ScalarNode,
    Span,
    YamlNode,
    too_many,
)
from dynsolve.quantities.stages import ASKED_FOR, Stage

# `reach` and `limits` of a problem file: what r(q) is to be, and the ranges of the joints


class ParsedReach(Struct, frozen=True):
    """The values of r(q), names or expressions, and where they stand."""

    cells: tuple[Cell, ...] = ()
    span: Span = (0, 0)

    def names(self, parameters: Collection[str]) -> tuple[str, ...]:
        """The names that are new here, one for each value that is nothing but such a name."""
        found = (cell.tree.name for cell in self.cells if isinstance(cell.tree, Symbol))
        return tuple(name for name in found if name != "pi" and name not in parameters)


NO_REACH = ParsedReach()
"""What a file without the key has."""


def read_reach(faults: Faults, node: YamlNode | None, coordinates: Collection[str]) -> ParsedReach:
    """The values under `reach`; what is wrong with one is reported."""
    help = PROBLEM["reach"].help
    listed = list(_rejoined(faults, items(faults, node, "reach", help)))
    if node is None or isinstance(node, FaultyNode):
        return NO_REACH
    if len(listed) > MAX_TASK:
        faults.error(node.span, f"{len(listed)} values; at most {MAX_TASK} are read", "leave some out")
        return NO_REACH
    cells = tuple(
        read_cell(faults, item, f"value {i} of reach", arcs=True) for i, item in enumerate(listed, 1)
    )
    known = tuple(cell for cell in cells if cell)
    names: set[str] = set()
    for cell in known:
        if not isinstance(cell.tree, Symbol):
            forbid(faults, [cell], coordinates, "a value holds numbers and parameters")
        elif cell.tree.name in coordinates or cell.tree.name in names:
            message = f"{cell.tree.name} means something else already"
            faults.error(cell.span, message, "give the value another name")
        else:
            names.add(cell.tree.name)
    return ParsedReach(known, node.span) if len(known) == len(cells) else NO_REACH


def _rejoined(faults: Faults, listed: Sequence[YamlNode]) -> Iterator[YamlNode]:
    """The items, those that a comma inside parentheses has cut made one again: atan2(4, 3)."""
    waiting = list(listed)
    while waiting:
        node = waiting.pop(0)
        while isinstance(node, ScalarNode) and waiting and node.text.count("(") > node.text.count(")"):
            end = waiting.pop(0).span[1]
            node = replace(node, text=faults.source.text[node.start : end])
        yield node


def check_reach(faults: Faults, reach: ParsedReach, rows: int) -> None:
    """There is a value for each component of the task."""
    if reach.cells and len(reach.cells) != rows:
        faults.error(
            reach.span,
            f"reach has {len(reach.cells)} value{'s' * (len(reach.cells) > 1)}; the task has {rows}",
            "give one value for each component of the task, in their order",
        )


# -- joint ranges ----------------------------------------------------------------------------------


class ParsedLimits(Struct, frozen=True):
    """The range of one coordinate, and where it stands."""

    coordinate: str
    low: Cell
    high: Cell
    span: Span


def read_limits(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> tuple[ParsedLimits, ...]:
    """The ranges under `limits`; what is wrong with one is reported."""
    if node is None or isinstance(node, FaultyNode):
        return ()
    if not isinstance(node, MappingNode):
        faults.error(node.span, "limits is a mapping from coordinates to ranges", PROBLEM["limits"].help)
        return ()
    return tuple(_ranges(faults, node, kinds))


def _ranges(faults: Faults, node: MappingNode, kinds: Mapping[str, str]) -> Iterator[ParsedLimits]:
    help = PROBLEM["limits"].help
    for name, value in by_coordinate(faults, node, kinds, help):
        if not isinstance(value, ListNode) or len(value.items) != 2:
            if not isinstance(value, FaultyNode):
                message = f"the range of {name} is a list [low, high], not {describe(value)}"
                if isinstance(value, ListNode):
                    message = f"the range of {name} has {len(value.items)} ends, not 2"
                remedy = too_many(value, help) if isinstance(value, ListNode) else help
                faults.error(value.span, message, remedy)
        else:
            low, high = (_end(faults, item, name, kinds) for item in value.items)
            if low and high:
                yield ParsedLimits(name, low, high, value.span)


def _end(faults: Faults, node: YamlNode, name: str, kinds: Mapping[str, str]) -> Cell | None:
    cell = read_cell(faults, node, f"the range of {name}")
    forbid(faults, [cell], kinds, "a range holds numbers and parameters")
    if cell and kinds[name] == "revolute" and read_angle(faults, cell) is None:
        return None
    return cell


_NAME = re.compile(r"[A-Za-z][0-9]{0,4}")


class ParsedPoint(Struct, frozen=True):
    """One entry of `points:`; None where a part of it was reported."""

    name: str
    link: int | None
    place: ParsedPlace | None
    written: str
    axes: int | None = None


class ParsedTask(Struct, frozen=True):
    """`task:`: its components, in which a `Reference` stands for a point's coordinate; of a pose none."""

    cells: tuple[Cell, ...]
    is_twist: bool = False
    is_pose: bool = False
    span: Span = (0, 0)


class ParsedRates(Struct, frozen=True):
    """`velocity:` or `acceleration:` of the task."""

    key: str
    span: Span
    cells: tuple[Cell, ...]


class ParsedQuestions(Struct, frozen=True):
    """What a file asks around the model."""

    points: tuple[ParsedPoint, ...] = ()
    task: ParsedTask | None = None
    loads: tuple[ParsedLoad, ...] = ()
    state: ParsedState | None = None
    velocity: ParsedRates | None = None
    acceleration: ParsedRates | None = None
    reach: ParsedReach = NO_REACH
    all_branches: bool = False
    limits: tuple[ParsedLimits, ...] = ()
    weights: ParsedWeights | None = None
    reached_state: Span | None = None
    """Where the file says that the state is the configuration that reaches the target."""
    of: Mapping[Stage, Given] = {}
    """What is given for questions that read their keys themselves."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the points."""
        return tuple(point.name for point in self.points)

    @property
    def constraints(self) -> int:
        """How many constraints there are."""
        given = self.of.get(Stage.CONSTRAINTS)
        return len(given.moving) if given else 0

    @property
    def needed(self) -> frozenset[str]:
        """What families need that is given (`Family.needs`)."""
        return self.rates.union(*(given.needed for given in self.of.values()))

    @property
    def rates(self) -> frozenset[str]:
        """Which rates are given: velocity, acceleration."""
        return frozenset(rates.key for rates in (self.velocity, self.acceleration) if rates)

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        for place in (*(point.place for point in self.points), *(load.place for load in self.loads)):
            yield from place.cells if place else ()
        for rotation in self.rotations:
            yield from rotation.entries
        yield from self.state.cells.values() if self.state else ()
        for row in self.weights.rows if self.weights else ():
            yield from row
        for given in self.of.values():
            yield from given.constant

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that may hold coordinates."""
        yield from self.task.cells if self.task else ()
        for given in self.of.values():
            yield from given.moving
        for load in self.loads:
            yield from (*load.force, *load.moment)
        for rates in (self.velocity, self.acceleration):
            yield from rates.cells if rates else ()

    @property
    def targeted(self) -> Iterator[Cell]:
        """The values that are to be reached, and the ends of joint ranges."""
        yield from self.reach.cells
        for one in self.limits:
            yield from (one.low, one.high)

    @property
    def rotations(self) -> Iterator[ParsedRotation]:
        """Every rotation that is given."""
        yield from (load.rotation for load in self.loads if load.rotation)


def read_questions(
    faults: Faults,
    fields: Fields,
    rows: int,
    coordinates: Mapping[str, str],
    bodies: Collection[str],
    drawn: DrawnFrames = NOT_DRAWN,
) -> ParsedQuestions:
    """The keys of a file that ask something around the model; what is wrong with one is reported."""
    read = _read_points(faults, fields.get("points"), rows, bodies)
    points = tuple(replace(point, place=drawn.place(faults, point.place, point.link)) for point in read)
    for point in points:
        forbid(
            faults,
            point.place.cells if point.place else (),
            coordinates,
            "it is fixed in the link: joint variables stand in the table",
        )
    names = [point.name for point in points]
    task = _read_task(faults, fields.get("task"), names, coordinates)
    return ParsedQuestions(
        points,
        task,
        read_loads(faults, fields.get("forces"), rows, coordinates, drawn),
        read_state(faults, fields.get("state"), coordinates),
        _read_rates(faults, fields, "velocity"),
        _read_rates(faults, fields, "acceleration"),
        read_reach(faults, fields.get("reach"), coordinates),
        word(faults, fields.get("branches"), ALL.choices, "branches", "write branches: all") is not None,
        read_limits(faults, fields.get("limits"), coordinates),
        read_weights(faults, fields.get("weights"), coordinates, bool(bodies)),
        fields.span_of("state") if is_reached(fields.get("state")) else None,
        {stage: stage.part("file").read(faults, fields, coordinates, names) for stage in _asking(fields)},
    )


def _asking(fields: Fields) -> Iterator[Stage]:
    """The questions that read keys of their own, of which the file has one."""
    for stage in ASKED_FOR:
        keys = stage.part("keys")
        if keys is not None and any(key.name in fields for key in keys.KEYS):
            yield stage


def _read_rates(faults: Faults, fields: Fields, key: str) -> ParsedRates | None:
    cells = read_expressions(faults, fields.get(key), key, PROBLEM[key].help)
    return None if cells is None else ParsedRates(key, fields.span_of(key), cells)


# -- points ----------------------------------------------------------------------------------------


def _read_points(
    faults: Faults, node: YamlNode | None, rows: int, bodies: Collection[str]
) -> Iterator[ParsedPoint]:
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, "points is a mapping from names to points", PROBLEM["points"].help)
        return
    if len(node.entries) > MAX_POINTS:
        faults.error(
            node.span, f"{len(node.entries)} points; at most {MAX_POINTS} are read", "leave some out"
        )
        return
    for key, value in node.entries:
        name = key.decoded
        if not _NAME.fullmatch(name):
            help = "a point's name is a letter, and digits after it: P, C, P1"
            faults.error(key.span, f"`{name[:40]}` cannot be the name of a point", help)
        elif name in bodies:
            faults.error(key.span, f"{name} is the name of a body", "give the point another name")
        else:
            yield _read_point(faults, name, value, rows)


def _read_point(faults: Faults, name: str, node: YamlNode, rows: int) -> ParsedPoint:
    what = f"the point {name}"
    if not isinstance(node, MappingNode):
        if not isinstance(node, FaultyNode):
            help = f"write {name}: {{link: 2, at: {{near: [lc2, 0, 0]}}}}"
            faults.error(node.span, f"{what} is a mapping with its link and its place", help)
        return ParsedPoint(name, None, None, "")
    fields = Fields(faults, node, POINT.names, what)
    if fields.lacks("link"):
        faults.error(node.span, f"{what} has no `link`", f"add {POINT['link'].help}")
    link = read_link(faults, fields.get("link"), rows, "whose points do not move")
    axes = _read_axes(faults, fields.get("in"), rows, link)
    if "at" not in fields:
        return ParsedPoint(name, link, ParsedPlace("tip", node.span), "tip", axes)
    place = read_place(faults, fields.get("at"), f"the place of {name}", POINT["at"].help)
    return ParsedPoint(name, link, place, faults.source.text[slice(*fields.span_of("at"))], axes)


def _read_axes(faults: Faults, node: YamlNode | None, rows: int, link: int | None) -> int | None:
    """The frame along whose axes a point's velocity is written, None for the world's."""
    if isinstance(node, ScalarNode) and node.text in IN_LINK.choices:
        return link
    help = POINT["in"].help
    frame = whole_number(faults, node, "a frame", help)
    if node is not None and frame is not None and frame > rows:
        faults.error(
            node.span, f"there is no frame {frame}: the table has {rows} row{'s' * (rows > 1)}", help
        )
        return None
    return frame


# -- the task --------------------------------------------------------------------------------------


def _read_task(
    faults: Faults, node: YamlNode | None, points: Collection[str], coordinates: Collection[str]
) -> ParsedTask | None:
    if isinstance(node, ScalarNode) and node.text in WHOLE.choices:
        return ParsedTask((), is_twist=True, is_pose=node.text == "pose", span=node.span)
    listed = items(faults, node, "task", PROBLEM["task"].help)
    if len(listed) > MAX_TASK and node:
        faults.error(node.span, f"{len(listed)} components; at most {MAX_TASK} are read", "leave some out")
        return None
    if node is not None and not isinstance(node, FaultyNode) and not listed:
        faults.error(node.span, "the task has no components", PROBLEM["task"].help)
    cells = [
        read_point_expression(faults, item, f"component {i} of the task", points, coordinates)
        for i, item in enumerate(listed, 1)
    ]
    found = tuple(cell for cell in cells if cell)
    return ParsedTask(found) if found and len(found) == len(cells) else None
