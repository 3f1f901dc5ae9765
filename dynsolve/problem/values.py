"""The names of a problem file, its ring, and the values of its cells in it.

What a symbol is follows from where it stands alone: a mass under `mass`, a length
under `a`, an angle under `alpha`.  A name that is two of these is an error, and so
is one that JSON writes for a coordinate's derivative.

The exact position of a point that is fixed in a link; one that would not be is reported.

The mass and the inertia tensor of a body, made exact; what is wrong with them is reported.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix, needed_angles
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, value_of, with_references, with_symbols
from dynsolve.errors import AlgebraError
from dynsolve.notation.text import Name
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Parenthesized,
    Product,
    Quotient,
    Sum,
    Symbol,
    walk,
)
from dynsolve.problem.base import ParsedRotation
from dynsolve.problem.bodies import ParsedPlace, ParsedTensor
from dynsolve.problem.cells import Cell, denominators
from dynsolve.problem.model import ParsedFile
from dynsolve.problem.yaml_nodes import Faults
from dynsolve.robot.geometry import Links, Turn, absolute_angles, elementary, is_rotation
from dynsolve.robot.model import Convention
from dynsolve.robot.shapes import AXES

# One name is one thing

MAX_SYMBOLS = 500
"""A six-axis arm with ten inertial parameters a link has about 70."""

MAX_PARTS = {"denominators": 60, "roots": 60, "sines and cosines": 300}
"""How many different ones of each a file may have."""

_SUFFIXES = (("_dot", "velocity"), ("_ddot", "acceleration"))


class Role(Struct, frozen=True):
    """The role of a symbol where it stands alone: a mass, a length, an angle, ..."""

    name: str
    kind: str
    cell: Cell
    place: Name | None


def roles(parsed: ParsedFile) -> Iterator[Role]:
    """The roles of all symbols that stand alone in a cell, or as a term of a sum there."""
    for kind, cell in _kinds(parsed):
        for name in sorted(_terms(cell.tree)):
            place = next((found for found in cell.names if found.name == name), None)
            yield Role(name, kind, cell, place)


def _kinds(parsed: ParsedFile) -> Iterator[tuple[str, Cell]]:
    for row in parsed.table.rows:
        for column, cell in row.cells.items():
            yield ("an angle" if column in ("theta", "alpha") else "a length"), cell
    for rotation in parsed.rotations:
        for turn in rotation.turns:
            yield "an angle", turn.cell
    for one in sorted(parsed.stated, key=lambda one: one.role != "an angle"):
        if one.role:
            yield one.role, one.cell
    for point in parsed.questions.points:
        if point.place and point.place.kind != "along":
            yield from (("a length", cell) for cell in point.place.cells)
    yield from ((one.role, one.cell) for one in parsed.decoded if one.role)
    yield from (("a length", cell) for cell in parsed.base.move or ())
    yield from (("an acceleration", cell) for cell in parsed.gravity or ())


def _terms(node: Node) -> set[str]:
    """The names that a formula is, or adds: their dimension is that of the whole."""
    match node:
        case Symbol("pi"):
            return set()
        case Symbol(name):
            return {name}
        case Negative(argument) | Parenthesized(argument):
            return _terms(argument)
        case Sum(terms):
            return set().union(*map(_terms, terms))
        case Quotient(numerator, denominator) if rational_value(denominator) is not None:
            return _terms(numerator)
        case Product(factors):
            rest = [factor for factor in factors if rational_value(factor) is None]
            return _terms(rest[0]) if len(rest) == 1 else set()
    return set()


def check_size(faults: Faults, parsed: ParsedFile) -> bool:
    """Whether the file is small enough for exact algebra; what goes over a bound is reported."""
    symbols: set[str] = set()
    parts: dict[str, set[Node]] = {what: set() for what in MAX_PARTS}
    for cell in parsed.cells:
        for name in cell.names:
            symbols.add(name.name)
            if len(symbols) > MAX_SYMBOLS:
                message = f"{name.name} is one symbol too many: at most {MAX_SYMBOLS} are read"
                faults.error(cell.span_of(name), message, "put numbers for some")
                return False
        for what, node in _parts(cell.tree):
            parts[what].add(node)
            if len(parts[what]) > MAX_PARTS[what]:
                message = f"more than {MAX_PARTS[what]} different {what}, the last of them here"
                faults.error(cell.span, message, "name some of them with symbols of their own")
                return False
    return True


def _parts(tree: Node) -> Iterator[tuple[str, Node]]:
    """The parts that make exact algebra long: each denominator, root, sine and cosine."""
    yield from (("denominators", node) for node in denominators(tree) if rational_value(node) is None)
    for node in walk(tree):
        if isinstance(node, Function):
            yield ("roots" if node.name == "sqrt" else "sines and cosines"), node


def check_symbols(faults: Faults, parsed: ParsedFile) -> None:
    """Report names that are two things."""
    _check_derivatives(faults, parsed)
    first: dict[str, Role] = {}
    told: set[str] = set()
    for role in roles(parsed):
        before = first.setdefault(role.name, role)
        if before.kind == role.kind or role.name in told or role.name in parsed.table.names:
            continue
        if {before.kind, role.kind} == {"a mass", "a moment of inertia"}:
            continue  # with unit lengths an exercise may write m/12 for a moment of inertia
        told.add(role.name)
        here, there = (before, role) if role.place is None or not role.cell.text else (role, before)
        where = (
            f"line {faults.source.position(there.cell.start)[0]}"
            if there.cell.text
            else "the default gravity"
        )
        message = f"{role.name} is {here.kind} here and {there.kind} in {where}"
        place = here.cell.span_of(here.place) if here.place else here.cell.span
        help = "give the two things names of their own"
        if not there.cell.text:
            help = "give gravity another letter, or write gravity: none"
        faults.error(place, message, help)


def _check_derivatives(faults: Faults, parsed: ParsedFile) -> None:
    meanings = {
        name + suffix: f"the {what} of {name}" for name in parsed.table.names for suffix, what in _SUFFIXES
    }
    told: set[str] = set()
    for cell in parsed.cells:
        for name in cell.names:
            if name.name in meanings and name.name not in told:
                told.add(name.name)
                message = f"{name.name} is {meanings[name.name]} in every result, and cannot be a parameter"
                faults.error(cell.span_of(name), message, "give the parameter another name")


# The ring of a problem file, and the values of its cells in it


class CellValues:
    """The values of cells in one ring; what has none is reported, once.

    `written` are the numbers under `values`, as they stand in the file.
    """

    def __init__(
        self, faults: Faults, ring: Ring, left_out: frozenset[int], written: Mapping[str, str]
    ) -> None:
        self.faults, self.ring, self._left_out, self.written = faults, ring, left_out, written

    def expr(self, cell: Cell) -> Expr | None:
        """The value of a cell, None where something of it was reported."""
        if id(cell) in self._left_out:
            return None
        try:
            return value_of(self.ring, cell.tree)
        except AlgebraError as error:
            self.faults.error(cell.span, f"{cell.what}: {error.message}", error.help)
            return None

    def column(self, cells: Iterable[Cell]) -> Matrix | None:
        """The values of three cells as a column."""
        entries = [self.expr(cell) for cell in cells]
        return None if None in entries else Matrix.column(self.ring, [e for e in entries if e is not None])

    def matrix(self, rows: Iterable[Iterable[Cell]]) -> Matrix | None:
        """The values of a matrix, None where something of it was reported."""
        columns = [self.column(row) for row in rows]
        known = [column.entries for column in columns if column]
        return Matrix.of(self.ring, known) if len(known) == len(columns) else None

    def rotation(self, parsed: ParsedRotation, what: str) -> Matrix | None:
        """The matrix of a rotation; a list that is no rotation is reported."""
        if parsed.turns:
            matrix = Matrix.identity(self.ring, 3)
            for turn in parsed.turns:
                matrix = matrix @ elementary(self.ring, turn.axis, turn.angle)
            return matrix
        listed = self.matrix(parsed.rows)
        if listed is None:
            return None
        orthogonal, proper = is_rotation(listed)
        if orthogonal and proper:
            return listed
        if orthogonal:
            message = f"{what} are no rotation: the determinant is -1"
            help = "this is a reflection: turn the sign of one axis, so that x, y and z are right-handed"
        else:
            message = f"{what} are no rotation: R Rᵀ is not the identity"
            help = (
                "entries are exact: write cos(30deg) or sqrt(3)/2, not 0.866; or a product such as Rz(30deg)"
            )
        self.faults.error(parsed.span, message, help)
        return None


def evaluate(
    faults: Faults,
    parsed: ParsedFile,
    written: Mapping[str, str],
    inputs: Iterable[str] = (),
    references: tuple[str, ...] = (),
) -> CellValues | None:
    """The ring that holds everything in the file, and `inputs`; None (reported) where there is none.

    Of `references` it holds the first and second derivatives.

    Cells that no ring can hold are reported one by one and left out.
    """
    coordinates = parsed.table.names
    constant = list(parsed.constant)
    wrong = [cell for cell in constant if any(name.name in coordinates for name in cell.names)]
    left_out = {id(cell) for cell in wrong}
    cells = [cell for cell in (*parsed.moving, *constant) if id(cell) not in left_out]
    try:
        ring = _ring(parsed, cells)
    except AlgebraError:
        culprits = [cell for cell in cells if _fails(faults, parsed, cell)]
        left_out |= {id(cell) for cell in culprits}
        try:
            ring = _ring(parsed, [cell for cell in cells if id(cell) not in left_out])
        except AlgebraError as error:
            if not culprits:
                faults.error((0, 0), error.message, error.help)
            return None
    if inputs:
        ring = with_symbols(ring, inputs)
    if references:
        ring = with_references(ring, references)
    _check_angles(faults, parsed, ring)
    return CellValues(faults, ring, frozenset(left_out), written)


def _check_angles(faults: Faults, parsed: ParsedFile, ring: Ring) -> None:
    """Report angles whose sine the ring has no room for: a thousand times another angle."""
    for cell, angle in parsed.angles:
        try:
            ring.cos(angle)
        except AlgebraError as error:
            faults.error(cell.span, f"{cell.what}: {error.message}", error.help or "write angles of one size")


def _ring(parsed: ParsedFile, cells: list[Cell]) -> Ring:
    turns = [
        Turn(row.angles["theta"], row.angles["alpha"], row.variable == "theta", row.branch)
        for row in parsed.table.rows
        if len(row.angles) == 2
    ]
    preferred = absolute_angles(turns, parsed.table.names, parsed.convention is Convention.MODIFIED)
    trees: list[Node] = [cell.tree for cell in cells]
    if parsed.model:
        trees += (*parsed.model.rates, *parsed.model.slopes)
    trees += parsed.acting.functions if parsed.acting else ()
    angles = [angle for _, angle in parsed.angles]
    states = list(parsed.questions.states)
    for state in states:
        trees += state.turned
    ring = build_ring(parsed.table.coordinates, trees, angles, preferred)
    while not _holds(ring, needed := [a for s in states for a in needed_angles(ring, s.values)]):
        angles += needed
        ring = build_ring(parsed.table.coordinates, trees, angles, preferred)
    return ring


def _holds(ring: Ring, angles: Iterable[Angle]) -> bool:
    """Whether a ring has the sines and cosines of angles."""
    try:
        for angle in angles:
            ring.cos(angle)
    except AlgebraError:
        return False
    return True


def _fails(faults: Faults, parsed: ParsedFile, cell: Cell) -> bool:
    """Whether no ring can hold this cell by itself (reported)."""
    try:
        build_ring(parsed.table.coordinates, [cell.tree])
    except AlgebraError as error:
        faults.error(cell.span, f"{cell.what}: {error.message}", error.help)
        return True
    return False


# The exact position of a point that is fixed in a link; one that would not be is reported

_TIP_ROW = (
    "add a fixed row for the tip, {theta: 0, d: 0, a: l, alpha: 0} with its length, "
    "or give the centre as [x, y, z]"
)


class PlaceBuilder(Struct, frozen=True):
    """The exact positions of points; `links` is None where the table has errors, and geometry waits."""

    faults: Faults
    values: CellValues
    links: Links | None

    def position(self, place: ParsedPlace, link: int | None, key: str, written: str) -> Matrix | None:
        """The point in frame `link`, 3×1; `key` is the one that says it, as `written`.

        None (reported) for a point that would not be fixed there.
        """
        given = self.values.column(place.cells) if place.kind in ("near", "at", "drawn") else None
        fraction = self.values.expr(place.cells[0]) if place.kind == "along" else None
        if place.kind == "at":
            return given
        if place.kind == "drawn":
            return self._drawn(place, given, link)
        if self.links is None or link is None:
            return None
        if place.kind == "origin":
            return self.links.origin()
        near, far = self.links.near_end(link), self.links.far_end(link)
        if place.kind == "near":
            point = near + given if given else None
        elif far is None:
            message = f"link {link} has no far end: the table has no row {link + 1}"
            self.faults.error(place.span, message, _TIP_ROW)
            return None
        elif place.kind == "tip":
            point = far
        else:
            half = self.values.ring.constant(Fraction(1, 2)) if place.kind == "midpoint" else fraction
            point = near + (far - near).scale(half) if half is not None else None
        if point is not None and not self.links.is_fixed(point):
            self._report_moving(self.links, place, link, key, written)
            return None
        return point

    def _drawn(self, place: ParsedPlace, given: Matrix | None, link: int | None) -> Matrix | None:
        """A point of the drawing, which must slide with what its link slides on."""
        if given is None or self.links is None or self.links.is_fixed(given):
            return given
        message = f"this point is not fixed in link {link}: it slides otherwise than the drawing of the link"
        help = "add the letters of the slides that come before the link, and no others"
        self.faults.error(place.span, message, help)
        return None

    def _report_moving(self, links: Links, place: ParsedPlace, link: int, key: str, written: str) -> None:
        shown = "tip" if place.kind == "tip" else written
        message = f"`{shown}` would not be fixed in link {link}: "
        if links.modified:
            message += f"its far end moves with the prismatic joint {link + 1}"
            help = f"add a fixed row for the tip before it, or give the centre in frame {link}: [x, y, z]"
        else:
            message += f"its near end slides along it, for joint {link} is prismatic"
            help = f"measure from the tip, in frame {link}: {key}: {self._back(links, link)}"
        self.faults.error(place.span, message, help)

    def _back(self, links: Links, link: int) -> str:
        """The point a length lc back from the tip of a prismatic link, as a list."""
        ring, joint = self.values.ring, links.joints[link - 1]
        entries = [ring.zero, -ring.sin(joint.alpha), -ring.cos(joint.alpha)]
        words = {0: "0", 1: f"lc{link}", -1: f"-lc{link}"}
        if all(entry.is_number and entry.number in words for entry in entries):
            return "[" + ", ".join(words[int(entry.number)] for entry in entries) + "]"
        return "[x, y, z]"


# The mass and the inertia tensor of a body, made exact; what is wrong with them is reported


def mass_value(values: CellValues, cell: Cell | None, index: int) -> Expr | None:
    """The mass of body `index`; None where a fault of it was reported."""
    mass = values.expr(cell) if cell else None
    if mass is not None and cell and mass.is_number and mass.number < 0:
        values.faults.error(cell.span, f"the mass of body {index} is negative", "masses are not negative")
    return mass


def tensor_value(values: CellValues, tensor: ParsedTensor, index: int) -> Matrix | None:
    """The tensor of body `index`, 3×3; None where a fault of it was reported."""
    zero = values.ring.zero
    rows = [[values.expr(cell) if cell else zero for cell in row] for row in tensor.rows]
    known = [[entry for entry in row if entry is not None] for row in rows]
    asymmetric = False
    for i, j in ((0, 1), (0, 2), (1, 2)):
        above, below = rows[i][j], rows[j][i]
        if tensor.listed and above is not None and below is not None and above != below:
            asymmetric = True
            _report_asymmetry(values, tensor, index, i, j)
    if asymmetric or any(len(row) < 3 for row in known):
        return None
    return Matrix.of(values.ring, known)


def _report_asymmetry(values: CellValues, tensor: ParsedTensor, index: int, i: int, j: int) -> None:
    above, below = tensor.rows[i][j], tensor.rows[j][i]
    assert above and below
    key = AXES[i] + AXES[j]
    message = (
        f"the inertia of body {index} is not symmetric: I_{key[::-1]} = {below.text} is not "
        f"I_{key} = {above.text}"
    )
    help = "an inertia tensor is symmetric: write the same entry in both places"
    values.faults.error(below.span, message, help)
