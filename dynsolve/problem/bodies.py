"""The bodies of a problem file: what each entry of `masses:` says, before anything is computed.

Points of a drawing in the frames of their links: `{drawn: [x, y, z]}`, and `axes: base`.

In frame i with origin o and axes x, y, z a point p of the drawing is (x·(p - o), y·(p - o), z·(p - o)).
The letter of a slide is its drawn value there, and falls out of what is fixed in its link.

A point of a link in a problem file: the mass centre of a body, a named point, where a force acts.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.rationals import rational_value
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import Node, Number
from dynsolve.problem.base import ParsedRotation, check_moving, read_rotation
from dynsolve.problem.cells import Cell, denominators, read_cell, read_matrix, read_vector
from dynsolve.problem.decoder import Decoder, Record
from dynsolve.problem.kinds import (
    CENTERS,
    MEASURED,
    Fields,
    describe,
    did_you_mean,
    word,
)
from dynsolve.problem.kinds import read_link as read_link
from dynsolve.problem.specification import (
    AXIS,
    BODY,
    FROM_BASE,
    IN_LINK,
    NO_VALUE,
    PROBLEM,
    TENSOR,
    dimensions,
)
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode
from dynsolve.robot.model import AxesKind, Convention, DrawnPoint, JointType
from dynsolve.robot.shapes import AXES, KINDS

if TYPE_CHECKING:
    from dynsolve.robot.drawing.normals import Normals

# A point of a link in a problem file


class ParsedPlace(Struct, frozen=True):
    """A point of a link: `kind` is tip, origin, midpoint, along (one cell), near, drawn or at (three).

    Of a point of a drawing `cells` are those in the frame of its link.
    """

    kind: str
    span: Span
    cells: tuple[Cell, ...] = ()
    drawn: DrawnPoint | None = None


def read_place(faults: Faults, node: YamlNode | None, what: str, help: str) -> ParsedPlace | None:
    """The point that a value says, None (reported) where it is none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    if isinstance(node, ListNode):
        cells = read_vector(faults, node, what)
        return ParsedPlace("at", node.span, cells) if cells else None
    if isinstance(node, MappingNode):
        return _read_measured(faults, node, what, help)
    kind = word(faults, node, CENTERS.choices, what, help)
    return ParsedPlace(kind, node.span) if kind else None


def _read_measured(faults: Faults, node: MappingNode, what: str, help: str) -> ParsedPlace | None:
    fields = Fields(faults, node, MEASURED.names, what)
    given = tuple(fields)
    if len(given) > 1 or not node.entries:
        faults.error(node.span, f"{what} takes one of along, near and drawn", help)
    if len(given) != 1:
        return None
    if "along" in fields:
        cell = read_cell(faults, fields.get("along"), f"along in {what}")
        return ParsedPlace("along", node.span, (cell,)) if cell else None
    (kind,) = given
    cells = read_vector(faults, fields.get(kind), f"{kind} in {what}")
    return ParsedPlace(kind, node.span, cells) if cells else None


# Points of a drawing in the frames of their links: `{drawn: [x, y, z]}`, and `axes: base`


class DrawnFrames(Struct, frozen=True):
    """The frames in the pose that is drawn, each as the trees of x, y, z and the origin, the hand's last.

    Of a table there are none.
    """

    frames: tuple[tuple[tuple[Node, ...], ...], ...] = ()
    slides: frozenset[str] = frozenset()

    @staticmethod
    def of(normals: Normals | None, names: Sequence[tuple[str, str]]) -> DrawnFrames:
        """Those of a drawing; `names` are (coordinate, kind)."""
        if normals is None:
            return DrawnFrames()
        from dynsolve.algebra.compact.compactor import Compactor
        from dynsolve.robot.drawing.normals import frames

        drawing = normals.drawing
        form = Compactor(drawing.ring).form

        def trees(vector: Matrix) -> tuple[Node, ...]:
            return tuple(map(form, vector.entries))

        found = [
            (trees(x), trees(cross(z, x)), trees(z), trees(origin))
            for origin, x, z in frames(normals, drawing.convention is Convention.MODIFIED)
        ]
        slides = frozenset(name for name, kind in names if kind == JointType.PRISMATIC.value)
        hand, x = normals.hand, normals.hand_x
        found.append((trees(x), trees(cross(hand.direction, x)), trees(hand.direction), trees(hand.point)))
        return DrawnFrames(tuple(found), slides)

    def place(self, faults: Faults, place: ParsedPlace | None, link: int | None) -> ParsedPlace | None:
        """A place in the frame of its link; one that is not drawn as it is, None where it was reported."""
        if place is None or place.kind != "drawn":
            return place
        if not self.frames:
            help = "give the point in the frame of its link: [x, y, z], or the joint axes with `axes`"
            faults.error(place.span, "there is no drawing in which this point could be", help)
            return None
        if link is None:
            return None
        for cell in place.cells:
            if any(rational_value(below) == 0 for below in denominators(cell.tree)):
                faults.error(cell.span, f"{cell.what}: the denominator is zero")
                return None
        *axes, origin = self.frames[link]
        at = tuple(cell.tree for cell in place.cells)
        away = tuple(total([end, negated(start)]) for end, start in zip(at, origin, strict=True))
        pairs = zip(place.cells, axes, strict=True)
        cells = tuple(self._cell(cell, _dot(axis, away)) for cell, axis in pairs)
        return replace(place, cells=cells, drawn=DrawnPoint(at, tuple(axes), away))

    def _cell(self, cell: Cell, tree: Node) -> Cell:
        names = tuple(name for name in cell.names if name.name not in self.slides)
        return replace(cell, tree=tree, names=names)

    def axes_of_world(self, link: int | None, span: Span) -> ParsedRotation | None:
        """The world seen from a link's frame in the pose that is drawn; None without a drawing."""
        if not self.frames or link is None:
            return None
        rows = tuple(
            tuple(Cell("the axes of the world", entry, (), "", span[0]) for entry in axis)
            for axis in self.frames[link][:3]
        )
        return ParsedRotation(span, "base", rows=rows)


def _dot(a: Sequence[Node], b: Sequence[Node]) -> Node:
    """a · b of trees."""
    return total([times(1, [(x, 1), (y, 1)]) for x, y in zip(a, b, strict=True)])


NOT_DRAWN = DrawnFrames()
"""The frames of a file with a table."""

_NAME = re.compile(r"[A-Za-uxyzXYZ]?[0-9]*")
_EXAMPLE = PROBLEM["masses"].help
_CENTER_HELP, _SHAPE_HELP, _TENSOR_HELP = (BODY[key].help for key in ("center", "shape", "inertia"))


class ParsedShape(Struct, frozen=True):
    """A shape with its dimensions; `axis` is empty where the file does not say."""

    kind: str
    span: Span
    dimensions: Mapping[str, Cell]
    axis: str = ""
    density: Cell | None = None


class ParsedTensor(Struct, frozen=True):
    """An inertia tensor: 3×3 cells, None where an entry is 0; `listed` where a full list was given."""

    span: Span
    rows: tuple[tuple[Cell | None, ...], ...]
    listed: bool


class ParsedAxes(Struct, frozen=True):
    """The body-attached axes; `rotation` None for those of the link or of the base."""

    kind: AxesKind
    span: Span
    rotation: ParsedRotation | None
    written: str


def is_point(body: Record) -> bool:
    """Whether a body has no inertia about its mass centre: no tensor, and no shape with an extent."""
    return body["inertia"] is None and (body["shape"] is None or body["shape"].kind == "point")


def read_bodies(decoder: Decoder, fields: Fields, drawn: DrawnFrames = NOT_DRAWN) -> tuple[Record, ...]:
    """The entries under `masses:`; everything wrong with one is reported."""
    if _is_empty(fields.get("masses")):
        return ()
    bodies = []
    for body in decoder.entries(fields, PROBLEM["masses"]):
        before = len(decoder.faults.errors)
        _read_body(decoder, body, drawn)
        body.faulty |= len(decoder.faults.errors) > before
        bodies.append(body)
    check_names(bodies)
    return tuple(bodies)


def _is_empty(node: YamlNode | None) -> bool:
    return isinstance(node, ScalarNode) and node.text in ("", *NO_VALUE.choices)


def _read_body(decoder: Decoder, body: Record, drawn: DrawnFrames) -> None:
    """The parts of a body that are not said by the kinds of their keys; `integrals` are those of a density.

    These are x of the mass centre, and the moments about it, that about the axis first.
    """
    faults, index, what = decoder.faults, body.index, body.what
    body["name"] = read_name(faults, body.get("name"), index)
    shape = body["shape"] = _read_shape(faults, body.get("shape"), what)
    density = shape.density if shape else None
    if density is None and body.lacks("mass"):
        help = BODY["mass"].help.format(index=index)
        faults.error(body.span, f"{what} has no `mass`", f"add {help}")
    tensor = body["inertia"] = read_tensor(faults, body.get("inertia"), what)
    center = _read_center(faults, body, index, varies=density is not None)
    body["center"] = drawn.place(faults, center, body["link"])
    body["about"] = _check_about(body)
    axes = _read_axes(faults, body.get("axes"), index, decoder.coordinates)
    axes = body["axes"] = _in_drawn_pose(axes, body["link"], drawn)
    if shape and density:
        _integrate(decoder, body, shape, density)
    if body["center"]:
        measured = body["center"].kind != "along"
        decoder.keep(body["center"].cells, "a length" if measured else "", IN_LINK)
    decoder.keep(body["integrals"] or (), constant=IN_LINK)
    decoder.keep(shape.dimensions.values() if shape else (), "a length", IN_LINK)
    if tensor:
        cells = dict.fromkeys(cell for row in tensor.rows for cell in row)
        decoder.keep(cells, "a moment of inertia", IN_LINK)
    if axes and axes.rotation:
        decoder.keep_rotation(axes.rotation, IN_LINK if axes.kind is AxesKind.LINK else "")


def _integrate(decoder: Decoder, body: Record, shape: ParsedShape, density: Cell) -> None:
    """What follows from the density of a body; a key that would say its mass too is reported."""
    from dynsolve.problem.density import cell_of, density_of

    for key in ("mass", "inertia"):
        if key in body:
            message = f"{body.what} has a density, from which its {key} follows"
            body.faults.error(body.key_span(key), message, f"delete {key}, or the density")
    begins = "center" not in body
    found = density_of(body.faults, density, shape.kind, shape.dimensions, shape.axis, begins=begins)
    if found is None:
        return

    def cell(tree: Node) -> Cell:
        return cell_of(density, f"the density of {body.what}", tree)

    body["density"], body["mass"] = found, cell(found.mass)
    decoder.keep([body["mass"]], constant=IN_LINK)
    moments = (found.turned, *found.tilted)
    body["integrals"] = (cell(found.center), *(cell(moment.value) for moment in moments))
    if begins:
        body["center"] = ParsedPlace("near", density.span, (cell(Number(0)),) * 3)


def read_name(faults: Faults, node: YamlNode | None, index: int) -> str:
    """The name of a body: its place in the list unless the file gives one."""
    if node is None or isinstance(node, FaultyNode):
        return str(index)
    text = node.text if isinstance(node, ScalarNode) else ""
    if text and len(text) <= 8 and _NAME.fullmatch(text):
        return text
    faults.error(node.span, f"the name of body {index} cannot be {describe(node)}", BODY["name"].help)
    return str(index)


def check_names(bodies: Sequence[Record]) -> None:
    """Report a name that two bodies have."""
    first: dict[str, Record] = {}
    for body in bodies:
        other = first.setdefault(body["name"], body)
        if other is not body:
            message = f"body {body.index} has the name {body['name']}, which body {other.index} has already"
            help = "give each a name of its own; the default is its place in the list"
            body.faults.error(body.span_of("name"), message, help)


def _read_center(faults: Faults, fields: Fields, index: int, *, varies: bool) -> ParsedPlace | None:
    if fields.get("center") is None:
        if varies:
            return None
        if "inertia" in fields or isinstance(fields.get("shape"), MappingNode):
            mass = fields.get("mass")
            if isinstance(mass, ScalarNode) and mass.text == "0":
                return ParsedPlace("tip", fields.span)  # where it is enters nothing
            if fields.lacks("center"):
                faults.error(fields.span, f"body {index} is not a point and has no `center`", _CENTER_HELP)
            return None
        return ParsedPlace("tip", fields.span)
    return read_place(faults, fields.get("center"), f"the centre of body {index}", _CENTER_HELP)


def _read_shape(faults: Faults, node: YamlNode | None, body: str) -> ParsedShape | None:
    if node is None or isinstance(node, FaultyNode):
        return None
    if isinstance(node, ScalarNode):
        return _bare_shape(faults, node, body)
    if not isinstance(node, MappingNode) or len(node.entries) != 1:
        named = [key.decoded for key, _ in node.entries] if isinstance(node, MappingNode) else []
        beside = named[:1] if named[1:] == ["axis"] and KINDS.get(named[0]) else []
        help = (
            f"write axis among its dimensions: {{{beside[0]}: {{..., axis: z}}}}" if beside else _SHAPE_HELP
        )
        faults.error(node.span, f"the shape of {body} is one shape with its dimensions", help)
        return None
    key, value = node.entries[0]
    if key.decoded not in KINDS or key.decoded == "point":
        help = did_you_mean(key.decoded, KINDS) or f"shapes are {', '.join(KINDS)}"
        faults.error(key.span, f"`{key.decoded}` is no shape with dimensions", help)
        return None
    if not isinstance(value, MappingNode):
        _missing_dimensions(faults, key.span, key.decoded)
        return None
    return _read_dimensions(faults, key.decoded, value, body, node.span)


def _bare_shape(faults: Faults, node: ScalarNode, body: str) -> ParsedShape | None:
    if node.text == "point":
        return ParsedShape("point", node.span, {})
    if node.text in KINDS:
        _missing_dimensions(faults, node.span, node.text)
        return None
    help = did_you_mean(node.text, KINDS) or f"shapes are {', '.join(KINDS)}"
    faults.error(node.span, f"the shape of {body} cannot be {describe(node)}", help)
    return None


def _missing_dimensions(faults: Faults, span: Span, kind: str) -> None:
    written = ", ".join(f"{key.name}: ..." for key in dimensions(kind).required)
    faults.error(span, f"a {kind} needs its dimensions", f"write shape: {{{kind}: {{{written}}}}}")


def _read_dimensions(
    faults: Faults, kind: str, node: MappingNode, body: str, span: Span
) -> ParsedShape | None:
    record = dimensions(kind)
    lengths = [key.name for key in record.required]
    fields = Fields(faults, node, record.names, f"the {kind} of {body}")
    missing = [name for name in lengths if fields.lacks(name)]
    if missing:
        help = f"a {kind} has {', '.join(lengths)}"
        faults.error(node.span, f"the {kind} of {body} lacks {' and '.join(missing)}", help)
    cells = {name: read_cell(faults, fields.get(name), f"{name} of the {kind}") for name in lengths}
    axis = word(faults, fields.get("axis"), AXIS.choices, f"axis of the {kind}") if "axis" in fields else ""
    found = {key: cell for key, cell in cells.items() if cell}
    if len(found) < len(lengths) or axis is None:
        return None
    density = (
        read_cell(faults, fields.get("density"), f"the density of {body}") if "density" in fields else None
    )
    if axis and density is None and not KINDS[kind].has_axis:
        message = f"the {kind} of {body} has an axis, along which nothing varies"
        faults.error(fields.key_span("axis"), message, "delete it, or give the shape a density")
    return ParsedShape(kind, span, found, axis, density)


def read_tensor(faults: Faults, node: YamlNode | None, body: str) -> ParsedTensor | None:
    """The tensor under `inertia`, None where there is none or it was reported."""
    if node is None or isinstance(node, FaultyNode):
        return None
    if isinstance(node, ListNode):
        words = [item.text for item in node.items if isinstance(item, ScalarNode)]
        if len(words) == len(node.items) == 3:
            moments = ", ".join(f"{axis}{axis}: {moment}" for axis, moment in zip(AXES, words, strict=True))
            message = f"the inertia of {body} is a tensor, not a list of three"
            faults.error(node.span, message, f"write {{{moments}}}, or three rows of three")
            return None
        rows = read_matrix(faults, node, f"the inertia of {body}")
        return ParsedTensor(node.span, rows, listed=True) if rows else None
    if not isinstance(node, MappingNode) or not node.entries:
        faults.error(node.span, f"the inertia of {body} is a tensor, not {describe(node)}", _TENSOR_HELP)
        return None
    fields = Fields(faults, node, TENSOR.names, f"the inertia of {body}")
    cells = {key: read_cell(faults, fields.get(key), f"I_{key} of {body}") for key in fields}
    if None in cells.values():
        return None
    entry = [["xx", "xy", "xz"], ["xy", "yy", "yz"], ["xz", "yz", "zz"]]
    return ParsedTensor(node.span, tuple(tuple(cells.get(key) for key in row) for row in entry), listed=False)


def _check_about(body: Record) -> str:
    about: str = body["about"] or "center"
    if about == "center" or "inertia" in body:
        return about
    message = f"{body.what} has `about: {about}` but no `inertia` that it belongs to"
    help = "delete it: the inertia of a shape is about its centre"
    body.faults.error(body.key_span("about"), message, help)
    return "center"


def _in_drawn_pose(axes: ParsedAxes | None, link: int | None, drawn: DrawnFrames) -> ParsedAxes | None:
    """Of a drawing axes of the base are those of the world in the pose that is drawn."""
    if axes is None or axes.kind is not AxesKind.REST:
        return axes
    rotation = drawn.axes_of_world(link, axes.span)
    return axes if rotation is None else ParsedAxes(AxesKind.LINK, axes.span, rotation, axes.written)


def _read_axes(
    faults: Faults, node: YamlNode | None, index: int, coordinates: Mapping[str, str]
) -> ParsedAxes | None:
    """None stands for the axes of the link's frame, and for axes that were reported."""
    what = f"the axes of body {index}"
    if node is None or isinstance(node, FaultyNode):
        return None
    if isinstance(node, ScalarNode) and node.text == "base":
        return ParsedAxes(AxesKind.REST, node.span, None, "base")
    if isinstance(node, MappingNode):
        fields = Fields(faults, node, FROM_BASE.names, what)
        if fields.lacks("base"):
            faults.error(node.span, f"{what}: the key `base` is expected", "write axes: {base: Rz(theta1)}")
            return None
        rotation = read_rotation(faults, fields.get("base"), what)
        sound = rotation and check_moving(faults, rotation, what, coordinates)
        if rotation is None or not sound:
            return None
        return ParsedAxes(AxesKind.BASE, node.span, rotation, rotation.written)
    rotation = read_rotation(faults, node, what)
    return ParsedAxes(AxesKind.LINK, node.span, rotation, rotation.written) if rotation else None
