"""`forces` of a problem file: what acts on the links from outside."""

from __future__ import annotations

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.problem.base import ParsedRotation, read_rotation
from dynsolve.problem.bodies import ParsedPlace, read_place
from dynsolve.problem.cells import Cell, forbid, read_vector
from dynsolve.problem.kinds import Fields, describe, items, read_link, word
from dynsolve.problem.kinematic_keys import IN_LINK
from dynsolve.problem.state import Around, Given
from dynsolve.problem.values import CellValues, PlaceBuilder
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, MappingNode, ScalarNode
from dynsolve.questions.statics.keys import BY, FORCE, FORCES, MAX_FORCES
from dynsolve.robot.geometry import Links
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, Load


class ParsedLoad(Struct, frozen=True):
    """One entry of `forces:`; None where a part was reported or is not given.

    `in_link`: along the axes of the link, turned by `rotation` where that is given.
    """

    link: int | None
    place: ParsedPlace | None
    written: str
    force: tuple[Cell, ...]
    moment: tuple[Cell, ...]
    in_link: bool
    rotation: ParsedRotation | None
    by_robot: bool


class GivenForces(Given, frozen=True):
    """The forces."""

    loads: tuple[ParsedLoad, ...] = ()


def read(faults: Faults, fields: Fields, around: Around) -> GivenForces:
    """The entries under `forces`; everything wrong with one is reported."""
    node = fields.get("forces")
    listed = items(faults, node, "forces", FORCES.help)
    if len(listed) > MAX_FORCES and node:
        faults.error(node.span, f"{len(listed)} forces; at most {MAX_FORCES} are read", "leave some out")
        return GivenForces()
    loads: list[ParsedLoad] = []
    for index, item in enumerate(listed, 1):
        what = f"force {index}"
        if isinstance(item, MappingNode):
            loads.append(_read_load(faults, Fields(faults, item, FORCE.names, what), what, around))
        elif not isinstance(item, FaultyNode):
            faults.error(item.span, f"{what} is not a mapping but {describe(item)}", FORCES.help)
    rotations = tuple(load.rotation for load in loads if load.rotation)
    return GivenForces(
        constant=(
            *(cell for load in loads if load.place for cell in load.place.cells),
            *(cell for rotation in rotations for cell in rotation.entries),
        ),
        moving=tuple(cell for load in loads for cell in (*load.force, *load.moment)),
        rotations=rotations,
        loads=tuple(loads),
    )


def _read_load(faults: Faults, fields: Fields, what: str, around: Around) -> ParsedLoad:
    if fields.lacks("link"):
        faults.error(fields.span, f"{what} has no `link`", f"add {FORCE['link'].help}")
    if fields.lacks("force") and fields.lacks("moment"):
        faults.error(fields.span, f"{what} has neither a `force` nor a `moment`", FORCES.help)
    place: ParsedPlace | None = ParsedPlace("tip", fields.span)
    if "at" in fields:
        place = read_place(faults, fields.get("at"), f"the place of {what}", FORCE["at"].help)
    link = read_link(faults, fields.get("link"), around.rows, "which does not move")
    place = around.drawn.place(faults, place, link)
    constant = "it is fixed in the link: joint variables stand in the table"
    forbid(faults, place.cells if place else (), around.coordinates, constant)
    axes = fields.get("in")
    is_plain = isinstance(axes, ScalarNode) and axes.text in IN_LINK.choices
    rotation = None if is_plain else read_rotation(faults, axes, f"the axes of {what}")
    forbid(faults, rotation.cells if rotation else (), around.coordinates, constant)
    by = word(faults, fields.get("by"), BY.choices, f"by of {what}") if "by" in fields else ""
    return ParsedLoad(
        link=link,
        place=place,
        written=faults.source.text[slice(*fields.span_of("at"))] if "at" in fields else "tip",
        force=read_vector(faults, fields.get("force"), f"the force of {what}") or (),
        moment=read_vector(faults, fields.get("moment"), f"the moment of {what}") or (),
        in_link=is_plain or rotation is not None,
        rotation=rotation,
        by_robot=by == "robot",
    )


def build(values: CellValues, robot: Robot, given: GivenForces) -> Robot:
    """The robot with its forces; Q, the torques that they are at the joints, is asked for with them."""
    found = [_load(values, robot, parsed) for parsed in given.loads]
    loads = tuple(load for load in found if load)
    asked = robot.questions.asked | {*(["Q"] if loads else [])}
    return replace(robot, questions=replace(robot.questions, loads=loads, asked=asked))


def _load(values: CellValues, robot: Robot, parsed: ParsedLoad) -> Load | None:
    """The force of an entry of `forces:`; None where a fault of it was reported."""
    ring = values.ring
    places = PlaceBuilder(values.faults, values, Links(ring, robot.convention, robot.joints))
    zero = Matrix.zero(ring, 3, 1)
    if parsed.place is None or parsed.link is None:
        return None
    position = places.position(parsed.place, parsed.link, "at", parsed.written)
    force = values.column(parsed.force) if parsed.force else zero
    moment = values.column(parsed.moment) if parsed.moment else zero
    axes = Matrix.identity(ring, 3) if parsed.in_link else None
    if parsed.rotation is not None:
        axes = values.rotation(parsed.rotation, "the axes of a force")
    if position is None or force is None or moment is None:
        return None
    place = parsed.link, position
    called = [p.name for p in robot.questions.points if (p.link, p.position) == place and p.axes is None]
    if parsed.link == len(robot.joints) and position.is_zero:
        called.append(TIP)
    point = called[0] if called else ""
    turns = parsed.rotation.factors if parsed.rotation else ()
    return Load(parsed.link, position, force, moment, axes, point, parsed.by_robot, turns)
