"""The ring of a problem file, and the values of its cells in it."""

from __future__ import annotations

from collections.abc import Iterable

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.at_state import needed_angles
from dynsolve.algebra.build import build_ring, with_references, with_symbols
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function, Node, Symbol
from dynsolve.problem.cells import Cell
from dynsolve.problem.parsed_file import ParsedFile
from dynsolve.problem.rotations import ParsedRotation
from dynsolve.problem.source import Faults
from dynsolve.robot.geometry import elementary, is_rotation
from dynsolve.robot.model import Convention
from dynsolve.robot.parallel import Turn, absolute_angles


class CellValues:
    """The values of cells in one ring; what has none is reported, once."""

    def __init__(self, faults: Faults, ring: Ring, left_out: frozenset[int]) -> None:
        self.faults, self.ring, self._left_out = faults, ring, left_out

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

    def rotation(self, parsed: ParsedRotation, what: str) -> Matrix | None:
        """The matrix of a rotation; a list that is no rotation is reported."""
        if parsed.turns:
            matrix = Matrix.identity(self.ring, 3)
            for turn in parsed.turns:
                matrix = matrix @ elementary(self.ring, turn.axis, turn.angle)
            return matrix
        rows = [self.column(row) for row in parsed.rows]
        if None in rows:
            return None
        matrix = Matrix.of(self.ring, [row.entries for row in rows if row])
        orthogonal, proper = is_rotation(matrix)
        if orthogonal and proper:
            return matrix
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
    faults: Faults, parsed: ParsedFile, inputs: Iterable[str] = (), references: tuple[str, ...] = ()
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
    return CellValues(faults, ring, frozenset(left_out))


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
    trees += [Function("sgn", Symbol(name, 1)) for name in parsed.actions.signs]
    angles = [angle for _, angle in parsed.angles]
    states = [state for state in (parsed.questions.state, parsed.questions.model.linearize) if state]
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
