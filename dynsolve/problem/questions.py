"""What a problem file asks around the model, as it is written: named points, the task, forces, the state."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace

from dynsolve.problem.cells import Cell, forbid, read_expressions
from dynsolve.problem.constraints import ParsedConstraint, read_constraints
from dynsolve.problem.drawn_places import NOT_DRAWN, DrawnFrames
from dynsolve.problem.fields import Fields, items, whole_number, word
from dynsolve.problem.kinematic_keys import ALL, IN_LINK, MAX_POINTS, MAX_TASK, POINT, WHOLE
from dynsolve.problem.loads import ParsedLoad, read_loads
from dynsolve.problem.model_questions import (
    NO_MODEL_QUESTIONS,
    ParsedModelQuestions,
    read_model_questions,
)
from dynsolve.problem.places import ParsedPlace, read_link, read_place
from dynsolve.problem.point_expressions import read_point_expression
from dynsolve.problem.reach import NO_REACH, ParsedLimits, ParsedReach, read_limits, read_reach
from dynsolve.problem.rotations import ParsedRotation
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.state import ParsedState, is_reached, read_state
from dynsolve.problem.weights import ParsedWeights, read_weights
from dynsolve.problem.yaml_nodes import FaultyNode, MappingNode, ScalarNode, Span, YamlNode

_NAME = re.compile(r"[A-Za-z][0-9]{0,4}")


@dataclass(frozen=True, slots=True)
class ParsedPoint:
    """One entry of `points:`; None where a part of it was reported."""

    name: str
    link: int | None
    place: ParsedPlace | None
    written: str
    axes: int | None = None


@dataclass(frozen=True, slots=True)
class ParsedTask:
    """`task:`: its components, in which a `Reference` stands for a point's coordinate; of a pose none."""

    cells: tuple[Cell, ...]
    is_twist: bool = False
    is_pose: bool = False
    span: Span = (0, 0)


@dataclass(frozen=True, slots=True)
class ParsedRates:
    """`velocity:` or `acceleration:` of the task."""

    key: str
    span: Span
    cells: tuple[Cell, ...]


@dataclass(frozen=True, slots=True)
class ParsedQuestions:
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
    constraints: tuple[ParsedConstraint, ...] = ()
    reached_state: Span | None = None
    """Where the file says that the state is the configuration that reaches the target."""
    model: ParsedModelQuestions = NO_MODEL_QUESTIONS

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the points."""
        return tuple(point.name for point in self.points)

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
        yield from self.model.constant

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that may hold coordinates."""
        yield from self.task.cells if self.task else ()
        yield from self.model.balanced
        for load in self.loads:
            yield from (*load.force, *load.moment)
        yield from (constraint.cell for constraint in self.constraints)
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
        read_constraints(faults, fields, names, coordinates),
        fields.span_of("state") if is_reached(fields.get("state")) else None,
        read_model_questions(faults, fields, coordinates),
    )


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
