"""Joint axes as a drawing shows them, in a problem file: `axes`, `tip`, `zero`.

What is read becomes the rows of a table and the base, which then stand for `dh` and `base`.

A drawing in a problem file -> the rows of its table, and where frame 0 is.

The vectors are put into a ring of their own, the textbook's procedure
(`dynsolve.robot.drawing`) finds the frames, and what it finds is written as the cells of
`dh` and `base`, from where everything goes on as if they had been in the file.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_node
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, ring_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import total
from dynsolve.notation.text import Name
from dynsolve.notation.tree import Function, Node, Symbol, walk
from dynsolve.problem.base import Framed, ParsedBase, ParsedRotation
from dynsolve.problem.cells import Cell, forbid, read_vector
from dynsolve.problem.decoder import Decoder, Record
from dynsolve.problem.kinds import Fields, word
from dynsolve.problem.specification import HAND, PROBLEM, ZERO
from dynsolve.problem.table import DHRow, DHTable, coordinate_name, ordered_coordinates
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults, MappingNode, Span
from dynsolve.robot.drawing.normals import (
    Drawing,
    DrawnAxis,
    Hand,
    Line,
    NeedsMore,
    NoAngle,
    Normals,
    divided,
    dot,
    normals_of,
    root,
)
from dynsolve.robot.drawing.rows import DrawnRow, placed, rows_of
from dynsolve.robot.model import Convention, JointType

Vector = tuple[Cell, ...]

_EXAMPLE = PROBLEM["axes"].help
_POSE = "the drawing shows one pose, in which turning joints are at 0"


class ParsedHand(Struct, frozen=True):
    """The hand: its place, and its axes z and x where they are given."""

    span: Span
    at: Vector
    z: Vector | None = None
    x: Vector | None = None


class ParsedDrawing(Struct, frozen=True):
    """What `axes`, `tip` and `zero` say; `coordinates` are (name, kind) in their order."""

    span: Span
    axes: tuple[Record, ...]
    hand: ParsedHand
    zero_is_drawn: bool
    coordinates: tuple[tuple[str, str], ...]

    @property
    def points(self) -> Iterator[Vector]:
        """The points that are given."""
        yield from (axis["through"] for axis in self.axes if axis["through"])
        yield self.hand.at

    @property
    def directions(self) -> Iterator[Vector]:
        """The directions that are given."""
        yield from (axis["direction"] for axis in self.axes)
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
    decoder = Decoder(faults, {}, 0)
    axes = list(decoder.entries(fields, PROBLEM["axes"]))
    known = tuple(axis for axis in axes if _is_whole(axis))
    hand = _read_hand(faults, fields)
    zero = word(faults, fields.get("zero"), ZERO.choices, "zero", PROBLEM["zero"].help) or "table"
    kinds = _kinds(faults, fields, known)
    if hand is None or not known or len(known) < len(decoder.listed(fields, PROBLEM["axes"])):
        return None
    drawing = ParsedDrawing(
        fields.key_span("axes"), known, hand, zero == "drawn", ordered_coordinates(faults, fields, kinds)
    )
    _check_letters(faults, drawing)
    return drawing if len(faults.errors) == before else None


def _is_whole(axis: Record) -> bool:
    """Whether an axis has its coordinate, its direction and the point that it needs; else it is reported."""
    faults, what = axis.faults, axis.what
    given = [key for key in ("turn", "slide") if key in axis]
    if len(given) != 1:
        message = f"{what} both turns and slides" if given else f"{what} says neither `turn` nor `slide`"
        help = "a cylindrical joint is two axes" if given else _EXAMPLE
        faults.error(axis.span, message, help)
        return False
    (joint,) = given
    turns = joint == "turn"
    key, other = ("about", "along") if turns else ("along", "about")
    if other in axis:
        message = f"`{other}` belongs to `{'slide' if turns else 'turn'}`; an axis {joint}s {key} a direction"
        faults.error(axis.key_span(other), message, f"write {key}: [x, y, z]")
        return False
    for needed in (key, "through") if turns else (key,):
        if axis.lacks(needed):
            faults.error(axis.span, f"{what} has no `{needed}`", _EXAMPLE)
    value = axis.get(joint)
    axis["coordinate"] = coordinate_name(faults, value, f"write {joint}: q{axis.index}") if value else None
    axis["kind"], axis["direction"] = "revolute" if turns else "prismatic", axis[key]
    placed = axis["through"] or (not turns and "through" not in axis)
    return bool(axis["coordinate"] and axis["direction"] and placed)


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


def _kinds(faults: Faults, fields: Fields, axes: tuple[Record, ...]) -> dict[str, str]:
    """The coordinates with their kinds, in the order of the axes."""
    kinds: dict[str, str] = {}
    for axis in axes:
        name = axis["coordinate"]
        if name in kinds:
            message = f"{name} is the coordinate of another axis already"
            faults.error(axis.span, message, "give every joint a coordinate of its own")
        kinds.setdefault(name, axis["kind"])
    return kinds


def _check_letters(faults: Faults, drawing: ParsedDrawing) -> None:
    """Coordinates in the drawing: no angle at all, a sliding joint's in points alone."""
    kinds: Mapping[str, str] = dict(drawing.coordinates)
    turning = [name for name, kind in kinds.items() if kind == "revolute"]
    forbid(faults, (cell for point in drawing.points for cell in point), turning, _POSE)
    forbid(faults, (cell for direction in drawing.directions for cell in direction), kinds, _POSE)


# A drawing in a problem file -> the rows of its table, and where frame 0 is

_MOST_RINGS = 12
_SPARE_INVERSES = 6


_NOTHING = Framed(DHTable((), ()), ParsedBase(None, None))


def from_drawing(faults: Faults, parsed: ParsedDrawing | None, convention: Convention) -> Framed:
    """The table and the base of a drawing; what is wrong with it is reported."""
    if parsed is None:
        return _NOTHING
    more: list[Node] = []
    for _ in range(_MOST_RINGS):
        ring = _ring(faults, parsed, more)
        if ring is None:
            return _NOTHING
        try:
            return _Framing(faults, parsed, ring, convention).framed() or _NOTHING
        except NeedsMore as needed:
            more.append(_tree(ring, needed.missing))
        except NoAngle as error:
            span = parsed.hand.span if error.axis is None else parsed.axes[error.axis].span
            faults.error(span, error.message, error.help)
            return _NOTHING
        except AlgebraError as error:
            faults.error(parsed.span, error.message, error.help)
            return _NOTHING
    faults.error(parsed.span, "the lengths of this drawing are roots of roots", "name some of them")
    return _NOTHING


def _ring(faults: Faults, parsed: ParsedDrawing, more: list[Node]) -> Ring | None:
    """The ring that holds the drawing and more; None (reported) where there is none."""
    try:
        ring = build_ring([], [*(cell.tree for cell in parsed.cells), *more])
    except AlgebraError as error:
        before = len(faults.errors)
        for cell in parsed.cells:
            _report_alone(faults, cell)
        if len(faults.errors) == before:
            faults.error(parsed.span, error.message, error.help)
        return None
    plan = replace(ring.plan, inverses=ring.plan.inverses + _SPARE_INVERSES)
    return ring_of([], plan)


def _tree(ring: Ring, missing: Expr | Angle) -> Node:
    """A formula with which the ring holds what it lacks."""
    if isinstance(missing, Angle):
        return Function("cos", angle_node(missing))
    return Function("sqrt", Compactor(ring).form(missing))


def _report_alone(faults: Faults, cell: Cell) -> None:
    try:
        build_ring([], [cell.tree])
    except AlgebraError as error:
        faults.error(cell.span, f"{cell.what}: {error.message}", error.help)


class _Framing:
    """The drawing of one file in one ring."""

    def __init__(self, faults: Faults, parsed: ParsedDrawing, ring: Ring, convention: Convention) -> None:
        self.faults, self.parsed, self.ring, self.convention = faults, parsed, ring, convention
        self.cells = CellValues(faults, ring, frozenset(), {})

    def framed(self) -> Framed | None:
        """The table and the base; None where something was reported."""
        drawing = self._drawing()
        if drawing is None or not self._moves_as_drawn(drawing):
            return None
        normals = normals_of(placed(drawing))
        writer = _Writer(self.parsed, normals)
        table = DHTable(tuple(writer.rows()), self.parsed.coordinates)
        return Framed(table, writer.base(), normals, self.parsed.cells)

    # -- the vectors -------------------------------------------------------------------------------

    def _drawing(self) -> Drawing | None:
        parsed = self.parsed
        axes = [self._axis(axis) for axis in parsed.axes]
        hand = parsed.hand
        at = self.cells.column(hand.at)
        z = self._unit(hand.z) if hand.z else None
        x = self._unit(hand.x) if hand.x else None
        known = tuple(axis for axis in axes if axis)
        if at is None or len(known) < len(axes) or (hand.z and z is None) or (hand.x and x is None):
            return None
        if x is not None and z is not None and not dot(x, z).is_zero:
            self.faults.error(_span(hand.x), "x of the tip is not perpendicular to its z", "mend one of them")
            return None
        return Drawing(self.ring, self.convention, known, Hand(at, z, x), parsed.zero_is_drawn)

    def _axis(self, axis: Record) -> DrawnAxis | None:
        direction, through = self._unit(axis["direction"]), axis["through"]
        point = self.cells.column(through) if through else Matrix.zero(self.ring, 3, 1)
        if direction is None or point is None:
            return None
        line = Line(point, direction)
        return DrawnAxis(axis["coordinate"], JointType(axis["kind"]), line, through is not None)

    def _unit(self, cells: Vector) -> Matrix | None:
        """A direction of length 1."""
        vector = self.cells.column(cells)
        if vector is None:
            return None
        square = dot(vector, vector)
        if square == self.ring.one:
            return vector
        if square.is_zero:
            self.faults.error(_span(cells), "this direction is 0", "write a direction such as [0, 0, 1]")
            return None
        length = root(self.ring, square)
        return vector.map(lambda entry: divided(entry, length))

    # -- what slides moves all that follows --------------------------------------------------------

    def _moves_as_drawn(self, drawing: Drawing) -> bool:
        """Whether the letter of every slide moves what follows it and nothing else; if not it is reported."""
        before = len(self.faults.errors)
        for i, axis in enumerate(drawing.axes):
            if drawing.drawn_slide(axis):
                self._check_slide(drawing, i, axis)
        return len(self.faults.errors) == before

    def _check_slide(self, drawing: Drawing, i: int, slide: DrawnAxis) -> None:
        zero, way = Matrix.zero(self.ring, 3, 1), slide.line.direction
        for j, (axis, parsed) in enumerate(zip(drawing.axes, self.parsed.axes, strict=True)):
            along = way if j > i else zero
            moved = axis.line.point.map(lambda entry: self.ring.coefficient(entry, slide.coordinate)) - along
            # a line that is moved along itself stays where it is
            if parsed["through"] and not cross(moved, axis.line.direction).is_zero:
                self._report_still(slide, f"axis {j + 1}", _span(parsed["through"]), j > i)
        moved = drawing.hand.at.map(lambda entry: self.ring.coefficient(entry, slide.coordinate)) - way
        if not moved.is_zero:
            self._report_still(slide, "the tip", _span(self.parsed.hand.at), follows=True)

    def _report_still(self, slide: DrawnAxis, what: str, span: Span, follows: bool) -> None:
        name = slide.coordinate
        if follows:
            message = f"{what} does not move with the slide {name}, though {name} is drawn"
            help = f"add {name} times the direction of the slide, or write 0 for {name} everywhere"
        else:
            message = f"{what} comes before the slide {name} and moves with it here"
            help = f"leave {name} out of it"
        self.faults.error(span, message, help)


class _Writer:
    """Writes what was found as the cells of a file."""

    def __init__(self, parsed: ParsedDrawing, normals: Normals) -> None:
        self.parsed, self.normals = parsed, normals
        self.form = Compactor(normals.drawing.ring).form

    def rows(self) -> Iterator[DHRow]:
        """The rows of the table."""
        drawn = {axis["coordinate"]: axis.span for axis in self.parsed.axes}
        for index, row in enumerate(rows_of(self.normals), 1):
            span = drawn[row.axis.coordinate] if row.axis else self.parsed.hand.span
            yield self._row(index, row, span)

    def _row(self, index: int, row: DrawnRow, span: Span) -> DHRow:
        theta, d = row.theta, [self.form(row.d)] if not row.d.is_zero else []
        turned = [angle_node(theta)] if theta != Angle.zero() else []
        variable = None
        if row.axis:
            name, variable = row.axis.coordinate, "d" if row.axis.slides else "theta"
            (d if row.axis.slides else turned).insert(0, Symbol(name, star=True))
            theta = theta if row.axis.slides else theta + Angle.of(name)
        trees = {
            "theta": total(turned),
            "d": total(d),
            "a": self.form(row.a),
            "alpha": angle_node(row.alpha),
        }
        cells = {column: _cell(f"{column} of row {index}", tree, span) for column, tree in trees.items()}
        rates = {row.axis.coordinate: Fraction(1)} if row.axis else {}
        angles = {"theta": theta, "alpha": row.alpha}
        return DHRow(index, span, cells, angles, variable, rates, faulty=False)

    def base(self) -> ParsedBase:
        """Frame 0 in the world."""
        first, lines = self.normals.all[0], self.normals.lines
        z = lines[0].direction
        columns = (first.x, cross(z, first.x), z)
        rotation, span = Matrix.of(first.x.ring, (c.entries for c in columns)).T, self.parsed.span
        turned = None
        if rotation != Matrix.identity(first.x.ring, 3):
            rows = tuple(tuple(self._base_cell(entry) for entry in row) for row in rotation.rows)
            turned = ParsedRotation(span, "", rows=rows)
        moved = None if first.end.is_zero else tuple(map(self._base_cell, first.end.entries))
        return ParsedBase(turned, moved)

    def _base_cell(self, entry: Expr) -> Cell:
        return _cell("the base", self.form(entry), self.parsed.span)


def _cell(what: str, tree: Node, span: Span) -> Cell:
    names = tuple(Name(part.name, 0, 0, part.star) for part in walk(tree) if isinstance(part, Symbol))
    return Cell(what, tree, tuple(name for name in names if name.name != "pi"), "", span[0])


def _span(cells: Vector | None) -> Span:
    assert cells
    return cells[0].span[0], cells[-1].span[1]
