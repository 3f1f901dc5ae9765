"""A whole problem file as it was read, before anything is computed; its names, and its ring.

What a symbol is follows from where it stands alone: a mass under `mass`, a length
under `a`, an angle under `alpha`.  A name that is two of these is an error, and so
is one that JSON writes for a coordinate's derivative.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import needed_angles
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import build_ring, with_references, with_symbols
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
from dynsolve.problem.base import ParsedBase, ParsedRotation
from dynsolve.problem.bodies import is_point
from dynsolve.problem.cells import Cell, denominators
from dynsolve.problem.decoder import Record, Stated
from dynsolve.problem.table import DHTable
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults
from dynsolve.quantities.owners import Owners
from dynsolve.quantities.stages import ASKED_FOR
from dynsolve.robot.geometry import Turn, absolute_angles
from dynsolve.robot.model import Convention, Coordinate, JointType
from dynsolve.robot.names import spelled

if TYPE_CHECKING:
    from dynsolve.problem.acting import Acting
    from dynsolve.problem.mechanism import Candidates, Model
    from dynsolve.problem.questions import ParsedQuestions
    from dynsolve.robot.drawing.normals import Normals


class ParsedFile(Struct, frozen=True):
    """The parts of a problem file that make a robot."""

    convention: Convention
    table: DHTable
    gravity: tuple[Cell, ...] | None
    base: ParsedBase
    bodies: tuple[Record, ...]
    questions: ParsedQuestions
    normals: Normals | None = None
    """Of a drawing, the normals that its table was made from."""
    drawn: tuple[Cell, ...] = ()
    """The cells of the drawing."""
    acting: Acting | None = None
    model: Model | None = None
    """In the place of a table and its bodies: a mechanism by positions, or given energies."""
    stated: tuple[Stated, ...] = ()
    """The expressions of the bodies, the model and the candidates."""
    candidates: Candidates | None = None
    """Matrices to be judged, alone or beside a model, and what is assumed of their parameters."""

    @property
    def has_matrices(self) -> bool:
        """Whether there are matrices to be judged: candidates, or the D of a model."""
        if self.candidates is None:
            return False
        return bool(self.candidates.matrices) or (self.model is not None and self.model.D is not None)

    @property
    def is_of_matrices(self) -> bool:
        """Whether matrices stand in the place of a robot."""
        return self.candidates is not None and self.model is None and not self.table.rows

    @property
    def sound(self) -> bool:
        """Whether nothing of the table, its bodies or the model was reported."""
        if self.candidates is not None and self.candidates.faulty:
            return False
        if self.model is not None or self.is_of_matrices:
            return self.model is None or not self.model.faulty
        return self.table.sound and not any(body.faulty for body in self.bodies)

    @property
    def coordinates(self) -> tuple[Coordinate, ...]:
        """The generalized coordinates in their order."""
        return tuple(
            Coordinate(name, JointType(kind), index)
            for index, (name, kind) in enumerate(self.table.coordinates, 1)
        )

    @property
    def owners(self) -> Owners:
        """What the answers to this problem can belong to, whatever of it is asked for."""
        bodies = self.model.bodies if self.model else self.bodies
        return Owners(
            rows=len(self.table.rows),
            coordinates=self.coordinates,
            bodies=tuple(body["name"] for body in bodies),
            points=frozenset(body["name"] for body in bodies if is_point(body)),
            named=self.questions.names,
            stages=frozenset(ASKED_FOR),
            constraints=self.questions.constraints,
            given=self.questions.keys
            | frozenset(
                name
                for name, there in (
                    ("mass", self.bodies or self.model),
                    ("function", self.questions.task is None or not self.questions.task.is_twist),
                    ("references", True),
                )
                if there
            ),
            actions=self.acting.terms if self.acting else frozenset(),
            has_matrices=self.has_matrices,
            has_robot=not self.is_of_matrices,
        )

    @property
    def decoded(self) -> tuple[Stated, ...]:
        """What acts, as it was decoded."""
        return self.acting.stated if self.acting else ()

    @property
    def rotations(self) -> Iterator[ParsedRotation]:
        """The rotations that are given, but for those of bodies."""
        if self.base.rotation:
            yield self.base.rotation
        yield from self.questions.rotations

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that may hold coordinates: d, and rotations given from the base."""
        yield from (row.cells["d"] for row in self.table.rows if not row.faulty)
        yield from (one.cell for one in self.stated if one.moves)
        yield from self.questions.moving
        yield from (one.cell for one in self.decoded if one.moves)

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        yield from (row.cells["a"] for row in self.table.rows if not row.faulty)
        yield from (one.cell for one in self.stated if one.moves is False)
        yield from self.gravity or ()
        yield from self.base.move or ()
        if self.base.rotation:
            yield from self.base.rotation.entries
        yield from self.questions.constant
        yield from (one.cell for one in self.decoded if one.moves is False)

    @property
    def angles(self) -> Iterator[tuple[Cell, Angle]]:
        """Every angle that is turned by, with the cell it stands in."""
        for row in self.table.rows:
            if not row.faulty:
                yield from ((row.cells[column], angle) for column, angle in row.angles.items())
        turns = self.base.rotation.turns if self.base.rotation else ()
        yield from ((turn.cell, turn.angle) for turn in turns)
        yield from ((one.cell, one.angle) for one in self.stated if one.angle is not None)
        yield from ((turn.cell, turn.angle) for given in self.questions.rotations for turn in given.turns)

    @property
    def spelled(self) -> frozenset[str]:
        """Every name that the file calls something, as it is known (`robot.names`)."""
        found = (name.name for cell in (*self.cells, *self.questions.targeted) for name in cell.names)
        return frozenset(map(spelled, (*found, *self.table.names)))

    @property
    def cells(self) -> Iterator[Cell]:
        """Every cell that was read."""
        for row in self.table.rows:
            yield from row.cells.values()
        yield from self.drawn
        for rotation in self.rotations:
            yield from rotation.cells
        yield from (one.cell for one in self.stated)
        yield from self.gravity or ()
        yield from self.base.move or ()
        yield from self.questions.constant
        yield from self.questions.moving
        yield from (one.cell for one in self.decoded)


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


# The ring of a problem file


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
