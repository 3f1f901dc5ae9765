"""Joint axes as a drawing shows them, in a problem file: `axes`, `tip`, `zero`.

What is read becomes the rows of a table and the base, which then stand for `dh` and `base`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from dynsolve.problem.cells import Cell, forbid, read_vector
from dynsolve.problem.fields import Fields, describe, items, word
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import DRAWN_AXIS, HAND, MAX_ROWS, PROBLEM, ZERO
from dynsolve.problem.table import coordinate_name, ordered_coordinates
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, MappingNode, Span, YamlNode

Vector = tuple[Cell, ...]

_EXAMPLE = PROBLEM["axes"].help
_POSE = "the drawing shows one pose, in which turning joints are at 0"


@dataclass(frozen=True, slots=True)
class ParsedAxis:
    """One entry of `axes`; `through` is None for a sliding axis without a place."""

    span: Span
    coordinate: str
    kind: str
    direction: Vector
    through: Vector | None


@dataclass(frozen=True, slots=True)
class ParsedHand:
    """The hand: its place, and its axes z and x where they are given."""

    span: Span
    at: Vector
    z: Vector | None = None
    x: Vector | None = None


@dataclass(frozen=True, slots=True)
class ParsedDrawing:
    """What `axes`, `tip` and `zero` say; `coordinates` are (name, kind) in their order."""

    span: Span
    axes: tuple[ParsedAxis, ...]
    hand: ParsedHand
    zero_is_drawn: bool
    coordinates: tuple[tuple[str, str], ...]

    @property
    def points(self) -> Iterator[Vector]:
        """The points that are given."""
        yield from (axis.through for axis in self.axes if axis.through)
        yield self.hand.at

    @property
    def directions(self) -> Iterator[Vector]:
        """The directions that are given."""
        yield from (axis.direction for axis in self.axes)
        yield from (direction for direction in (self.hand.z, self.hand.x) if direction)

    @property
    def cells(self) -> tuple[Cell, ...]:
        """Every expression in it."""
        return tuple(cell for vector in (*self.points, *self.directions) for cell in vector)


def read_drawing(faults: Faults, fields: Fields) -> ParsedDrawing | None:
    """The drawing of a file; None where something of it was reported."""
    before = len(faults.errors)
    for key in ("dh", "base"):
        if key in fields:
            message = f"`{key}` and `axes` are both given, but the axes say where every frame is"
            faults.error(fields.key_span(key), message, f"delete `{key}`, or the axes")
    nodes = _nodes(faults, fields)
    axes = [_read_axis(faults, node, i) for i, node in enumerate(nodes, 1)]
    known = tuple(axis for axis in axes if axis)
    hand = _read_hand(faults, fields)
    zero = word(faults, fields.get("zero"), ZERO.choices, "zero", PROBLEM["zero"].help) or "table"
    kinds = _kinds(faults, fields, known)
    if hand is None or len(known) < len(nodes) or not known:
        return None
    drawing = ParsedDrawing(
        fields.key_span("axes"), known, hand, zero == "drawn", ordered_coordinates(faults, fields, kinds)
    )
    _check_letters(faults, drawing)
    return drawing if len(faults.errors) == before else None


def _nodes(faults: Faults, fields: Fields) -> tuple[YamlNode, ...]:
    nodes = items(faults, fields.get("axes"), "axes", f"an entry a joint; {_EXAMPLE}")
    if len(nodes) > MAX_ROWS:
        message = f"{len(nodes)} axes; at most {MAX_ROWS} are read"
        faults.error(fields.key_span("axes"), message, "leave some out")
    elif not nodes and isinstance(fields.get("axes"), ListNode):
        faults.error(fields.key_span("axes"), "there are no joint axes", _EXAMPLE)
    return nodes[:MAX_ROWS]


def _read_axis(faults: Faults, node: YamlNode, index: int) -> ParsedAxis | None:
    what = f"axis {index}"
    if not isinstance(node, MappingNode):
        if not isinstance(node, FaultyNode):
            faults.error(node.span, f"{what} is not a mapping but {describe(node)}", _EXAMPLE)
        return None
    fields = Fields(faults, node, DRAWN_AXIS.names, what)
    given = [key for key in ("turn", "slide") if key in fields]
    if len(given) != 1:
        message = f"{what} both turns and slides" if given else f"{what} says neither `turn` nor `slide`"
        help = "a cylindrical joint is two axes" if given else _EXAMPLE
        faults.error(node.span, message, help)
        return None
    (joint,) = given
    turns = joint == "turn"
    key, other = ("about", "along") if turns else ("along", "about")
    if other in fields:
        message = f"`{other}` belongs to `{'slide' if turns else 'turn'}`; an axis {joint}s {key} a direction"
        faults.error(fields.key_span(other), message, f"write {key}: [x, y, z]")
        return None
    for needed in (key, "through") if turns else (key,):
        if fields.lacks(needed):
            faults.error(node.span, f"{what} has no `{needed}`", _EXAMPLE)
    value = fields.get(joint)
    name = coordinate_name(faults, value, f"write {joint}: q{index}") if value else None
    direction = read_vector(faults, fields.get(key), f"the direction of {what}")
    through = read_vector(faults, fields.get("through"), f"the point of {what}")
    sound = name and direction and (through or (not turns and "through" not in fields))
    kind = "revolute" if turns else "prismatic"
    return ParsedAxis(node.span, name, kind, direction, through) if sound and name and direction else None


def _read_hand(faults: Faults, fields: Fields) -> ParsedHand | None:
    node = fields.get("tip")
    if node is None:
        if fields.lacks("tip"):
            faults.error(fields.key_span("axes"), "the hand has no place", f"add {PROBLEM['tip'].help}")
        return None
    if not isinstance(node, MappingNode):
        at = read_vector(faults, node, "the tip")
        return ParsedHand(node.span, at) if at else None
    parts = Fields(faults, node, HAND.names, "tip")
    if parts.lacks("at"):
        faults.error(node.span, "tip has no `at`", PROBLEM["tip"].help)
    at = read_vector(faults, parts.get("at"), "the tip")
    z = read_vector(faults, parts.get("z"), "z of the tip")
    x = read_vector(faults, parts.get("x"), "x of the tip")
    if "x" in parts and "z" not in parts:
        faults.error(parts.key_span("x"), "the tip has an x and no z", "give its z too")
        return None
    unread = ("z" in parts and not z) or ("x" in parts and not x)
    return None if at is None or unread else ParsedHand(node.span, at, z, x)


def _kinds(faults: Faults, fields: Fields, axes: tuple[ParsedAxis, ...]) -> dict[str, str]:
    """The coordinates with their kinds, in the order of the axes."""
    kinds: dict[str, str] = {}
    for axis in axes:
        if axis.coordinate in kinds:
            message = f"{axis.coordinate} is the coordinate of another axis already"
            faults.error(axis.span, message, "give every joint a coordinate of its own")
        kinds.setdefault(axis.coordinate, axis.kind)
    return kinds


def _check_letters(faults: Faults, drawing: ParsedDrawing) -> None:
    """Coordinates in the drawing: no angle at all, a sliding joint's in points alone."""
    kinds: Mapping[str, str] = dict(drawing.coordinates)
    turning = [name for name, kind in kinds.items() if kind == "revolute"]
    forbid(faults, (cell for point in drawing.points for cell in point), turning, _POSE)
    forbid(faults, (cell for direction in drawing.directions for cell in direction), kinds, _POSE)
