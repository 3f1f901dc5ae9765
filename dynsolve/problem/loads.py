"""`forces` of a problem file: what acts on the links from outside."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from dynsolve.problem.cells import Cell, forbid, read_vector
from dynsolve.problem.drawn_places import NOT_DRAWN, DrawnFrames
from dynsolve.problem.fields import Fields, describe, items, word
from dynsolve.problem.kinematic_keys import BY, FORCE, IN_LINK, MAX_FORCES
from dynsolve.problem.places import ParsedPlace, read_link, read_place
from dynsolve.problem.rotations import ParsedRotation, read_rotation
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import FaultyNode, MappingNode, ScalarNode, YamlNode

_HELP = PROBLEM["forces"].help


@dataclass(frozen=True, slots=True)
class ParsedLoad:
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


def read_loads(
    faults: Faults,
    node: YamlNode | None,
    rows: int,
    coordinates: Collection[str],
    drawn: DrawnFrames = NOT_DRAWN,
) -> tuple[ParsedLoad, ...]:
    """The entries under `forces:`; everything wrong with one is reported."""
    listed = items(faults, node, "forces", _HELP)
    if len(listed) > MAX_FORCES and node:
        faults.error(node.span, f"{len(listed)} forces; at most {MAX_FORCES} are read", "leave some out")
        return ()
    return tuple(_loads(faults, listed, rows, coordinates, drawn))


def _loads(
    faults: Faults,
    listed: Collection[YamlNode],
    rows: int,
    coordinates: Collection[str],
    drawn: DrawnFrames,
) -> Iterator[ParsedLoad]:
    for index, node in enumerate(listed, 1):
        what = f"force {index}"
        if isinstance(node, MappingNode):
            yield _read_load(faults, Fields(faults, node, FORCE.names, what), what, rows, coordinates, drawn)
        elif not isinstance(node, FaultyNode):
            faults.error(node.span, f"{what} is not a mapping but {describe(node)}", _HELP)


def _read_load(
    faults: Faults,
    fields: Fields,
    what: str,
    rows: int,
    coordinates: Collection[str],
    drawn: DrawnFrames,
) -> ParsedLoad:
    if fields.lacks("link"):
        faults.error(fields.span, f"{what} has no `link`", f"add {FORCE['link'].help}")
    if fields.lacks("force") and fields.lacks("moment"):
        faults.error(fields.span, f"{what} has neither a `force` nor a `moment`", _HELP)
    place: ParsedPlace | None = ParsedPlace("tip", fields.span)
    if "at" in fields:
        place = read_place(faults, fields.get("at"), f"the place of {what}", FORCE["at"].help)
    link = read_link(faults, fields.get("link"), rows, "which does not move")
    place = drawn.place(faults, place, link)
    constant = "it is fixed in the link: joint variables stand in the table"
    forbid(faults, place.cells if place else (), coordinates, constant)
    axes = fields.get("in")
    is_plain = isinstance(axes, ScalarNode) and axes.text in IN_LINK.choices
    rotation = None if is_plain else read_rotation(faults, axes, f"the axes of {what}")
    forbid(faults, rotation.cells if rotation else (), coordinates, constant)
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
