"""What a problem file asks around the model: named points, the task, and what each question is given.

What is written becomes the robot's `Questions`, with exact values.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.notation.tree import Node, Reference, has_part, names_in
from dynsolve.problem.base import ParsedRotation
from dynsolve.problem.bodies import NOT_DRAWN, DrawnFrames, ParsedPlace, read_link, read_place
from dynsolve.problem.cells import Cell, forbid, read_point_expression
from dynsolve.problem.kinds import Fields, items, whole_number
from dynsolve.problem.kinematic_keys import IN_LINK, MAX_POINTS, MAX_TASK, POINT, WHOLE
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.state import Around, Given, ParsedState, is_reached, read_state
from dynsolve.problem.values import CellValues, PlaceBuilder
from dynsolve.problem.yaml_nodes import (
    Faults,
    FaultyNode,
    MappingNode,
    ScalarNode,
    Span,
    YamlNode,
)
from dynsolve.quantities.letters import has_base
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import ASKED_FOR, Stage
from dynsolve.robot.geometry import last_origin
from dynsolve.robot.model import Robot
from dynsolve.robot.names import marks, names_taken, spelled
from dynsolve.robot.questions import TIP, NamedPoint, Questions, State, Task, coordinate_of

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


class ParsedQuestions(Struct, frozen=True):
    """What a file asks around the model; `of` is what it gives for each question that has keys of its own.

    `keys` are those of the file, which families may need (`Family.needs`).
    """

    points: tuple[ParsedPoint, ...] = ()
    task: ParsedTask | None = None
    state: ParsedState | None = None
    reached_state: Span | None = None
    """Where the file says that the state is the configuration that reaches the target."""
    of: Mapping[Stage, Given] = {}
    keys: frozenset[str] = frozenset()

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
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        for point in self.points:
            yield from point.place.cells if point.place else ()
        yield from self.state.cells.values() if self.state else ()
        for given in self.of.values():
            yield from given.constant

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that may hold coordinates."""
        yield from self.task.cells if self.task else ()
        for given in self.of.values():
            yield from given.moving

    @property
    def targeted(self) -> Iterator[Cell]:
        """The values that are numbers alone."""
        for given in self.of.values():
            yield from given.targeted

    @property
    def rotations(self) -> Iterator[ParsedRotation]:
        """Every rotation that is given."""
        for given in self.of.values():
            yield from given.rotations

    @property
    def states(self) -> Iterator[ParsedState]:
        """The values of coordinates, of which the ring must hold the sines and cosines."""
        yield from (self.state,) if self.state else ()
        for given in self.of.values():
            yield from given.states


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
    around = Around(coordinates, rows, names, bool(bodies), drawn)
    return ParsedQuestions(
        points,
        _read_task(faults, fields.get("task"), names, coordinates),
        read_state(faults, fields.get("state"), coordinates),
        fields.span_of("state") if is_reached(fields.get("state")) else None,
        {stage: stage.part("file").read(faults, fields, around) for stage in _asking(fields)},
        frozenset(fields),
    )


def _asking(fields: Fields) -> Iterator[Stage]:
    """The questions that read keys of their own, of which the file has one."""
    for stage in ASKED_FOR:
        keys = stage.part("keys")
        if keys is not None and any(key.name in fields for key in keys.KEYS):
            yield stage


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
    for i, cell in enumerate(found, 1):
        if not (has_part(cell.tree, _is_point) or names_in(cell.tree) & {*coordinates}):
            message = f"no joint moves component {i} of the task, in which no coordinate stands"
            help = (
                f"write it in {', '.join(sorted(coordinates))}; the angle of a link is a sum of joint angles"
            )
            faults.warn(cell.span, message, help, "constant-task")
    return ParsedTask(found) if found and len(found) == len(cells) else None


def _is_point(part: Node) -> bool:
    return isinstance(part, Reference)


# The robot's `Questions`


def named_point(places: PlaceBuilder, parsed: ParsedPoint) -> NamedPoint | None:
    """The point of an entry of `points:`; None where a fault of it was reported."""
    if parsed.place is None:
        return None
    position = places.position(parsed.place, parsed.link, "at", parsed.written)
    if position is None or parsed.link is None:
        return None
    return NamedPoint(parsed.name, parsed.link, position, parsed.written, parsed.axes)


def with_questions(
    values: CellValues,
    robot: Robot,
    parsed: ParsedQuestions,
    points: Sequence[NamedPoint],
    asked: frozenset[str],
    is_drawn: bool,
) -> Robot:
    """The robot with what its file asks of it; with a task of its own where one is needed and none given."""
    state = parsed.state.values if parsed.state else {}
    questions = Questions(
        points=tuple(_axes_named(robot, point) for point in points),
        task=_task(parsed.task),
        asked=asked,
        state=State(tuple((name, dots, value) for (name, dots), value in state.items())),
        is_drawn=is_drawn,
        state_is_reached=parsed.reached_state is not None,
    )
    asks_of_tip = parsed.keys & {"velocity", "acceleration"} or Stage.TASK in asked_stages(questions)
    if questions.task is None and (asks_of_tip or parsed.reached_state):
        questions = replace(questions, task=default_task(robot))
    if questions.task is not None:
        questions = replace(
            questions, task=_beside(questions.task, names_taken(robot).union(map(spelled, values.written)))
        )
    robot = replace(robot, questions=questions)
    for stage, given in parsed.of.items():
        robot = stage.part("file").build(values, robot, given)
    if parsed.reached_state is not None and robot.questions.target is None:
        help = "write reach: [...] with a number for each component of the task, or give the state itself"
        values.faults.error(parsed.reached_state, "state: reach needs the numbers of a target", help)
    return robot


def _axes_named(robot: Robot, point: NamedPoint) -> NamedPoint:
    """The point, whose axes are the world's where frame 0 is the world."""
    return replace(point, axes=None) if point.axes == 0 and not has_base(robot) else point


def _beside(task: Task, taken: AbstractSet[str]) -> Task:
    """The task with names of what is to be reached that are none of the file's."""
    tasks = (replace(task, mark=mark) for mark in marks())
    return next(one for one in tasks if taken.isdisjoint(one.reached))


def _task(parsed: ParsedTask | None) -> Task | None:
    if parsed is None:
        return None
    return Task(tuple(cell.tree for cell in parsed.cells), is_twist=parsed.is_twist, is_pose=parsed.is_pose)


def default_task(robot: Robot) -> Task:
    """The coordinates of the tip that move, or all where it never does."""
    tip = last_origin(robot)
    moving = [axis for axis in range(3) if robot.ring.depends_on_coordinates(tip[axis, 0])]
    return Task(tuple(coordinate_of(TIP, axis) for axis in moving or range(3)), is_default=True)
