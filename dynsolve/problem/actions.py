"""`forces` of a problem file: what acts on the links from outside.

`weights` of a problem file: what the rates of the joints cost where a task leaves a choice.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from msgspec import Struct

from dynsolve.problem.base import ParsedRotation, read_rotation
from dynsolve.problem.bodies import NOT_DRAWN, DrawnFrames, ParsedPlace, read_place
from dynsolve.problem.cells import Cell, forbid, made_cell, read_cell, read_vector
from dynsolve.problem.kinds import Fields, describe, items, read_link, word
from dynsolve.problem.kinematic_keys import BY, BY_INERTIA, FORCE, IN_LINK, MAX_FORCES
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.table import by_coordinate
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode

# `forces` of a problem file: what acts on the links from outside

_HELP = PROBLEM["forces"].help


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


# `weights` of a problem file

_WEIGHTS_CONSTANT = "a weight holds numbers and parameters"


class ParsedWeights(Struct, frozen=True):
    """W by rows, none where it is the inertia matrix; and where it stands."""

    rows: tuple[tuple[Cell, ...], ...]
    span: Span

    @property
    def is_inertia(self) -> bool:
        """Whether W is D(q)."""
        return not self.rows


def read_weights(
    faults: Faults, node: YamlNode | None, coordinates: Mapping[str, str], has_bodies: bool
) -> ParsedWeights | None:
    """W of a file, None where there is none; what is wrong with it is reported."""
    help = PROBLEM["weights"].help
    rows: list[list[Cell | None]] = []
    match node:
        case None | FaultyNode():
            return None
        case ScalarNode() if node.text in BY_INERTIA.choices:
            if not has_bodies:
                faults.error(node.span, "no body has mass, so there is no inertia matrix D", help)
            return ParsedWeights((), node.span)
        case MappingNode():
            rows = _diagonal(faults, node, list(coordinates))
        case ListNode():
            rows = _listed(faults, node, len(coordinates))
        case _:
            faults.error(node.span, f"weights is a mapping or a matrix, not {describe(node)}", help)
    cells = tuple(tuple(cell for cell in row if cell) for row in rows)
    for row in cells:
        forbid(faults, row, coordinates, _WEIGHTS_CONSTANT)
    is_whole = bool(cells) and all(len(row) == len(coordinates) for row in cells)
    return ParsedWeights(cells, node.span) if is_whole else None


def _diagonal(faults: Faults, node: MappingNode, names: Sequence[str]) -> list[list[Cell | None]]:
    """The weights by coordinate; those that are not given are 1."""
    given = {
        name: read_cell(faults, value, f"the weight of {name}")
        for name, value in by_coordinate(faults, node, names, PROBLEM["weights"].help)
    }
    one, zero = (made_cell("a weight", text, node.span[0]) for text in "10")
    return [[given.get(name, one) if name == other else zero for other in names] for name in names]


def _listed(faults: Faults, node: ListNode, size: int) -> list[list[Cell | None]]:
    rows = [row.items if isinstance(row, ListNode) else () for row in node.items]
    if len(rows) != size or any(len(row) != size for row in rows):
        message = f"the matrix of the weights is {size}×{size}, a row and a column for each coordinate"
        faults.error(node.span, message, PROBLEM["weights"].help)
        return []
    return [[read_cell(faults, item, f"a weight, row {i}") for item in row] for i, row in enumerate(rows, 1)]
