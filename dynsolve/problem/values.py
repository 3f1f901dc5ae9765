"""The ring of a problem file, and the values of its cells in it."""

from __future__ import annotations

from collections.abc import Iterable

from dynsolve.algebra.build import build_ring
from dynsolve.algebra.evaluate import value_of
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.errors import AlgebraError
from dynsolve.problem.cells import Cell
from dynsolve.problem.rotations import RotationSheet, elementary, is_rotation
from dynsolve.problem.sheet import Sheet
from dynsolve.problem.source import Faults
from dynsolve.robot.model import Convention
from dynsolve.robot.parallel import Turn, absolute_angles


class CellValues:
    """The values of cells in one ring; what has none is reported, once."""

    def __init__(self, report: Faults, ring: Ring, left_out: frozenset[int]) -> None:
        self.report, self.ring, self._left_out = report, ring, left_out

    def expr(self, cell: Cell) -> Expr | None:
        """The value of a cell, None where something of it was reported."""
        if id(cell) in self._left_out:
            return None
        try:
            return value_of(self.ring, cell.tree)
        except AlgebraError as error:
            self.report.error(cell.span, f"{cell.what}: {error.message}", error.help)
            return None

    def column(self, cells: Iterable[Cell]) -> Matrix | None:
        """The values of three cells as a column."""
        entries = [self.expr(cell) for cell in cells]
        return None if None in entries else Matrix.column(self.ring, [e for e in entries if e is not None])

    def rotation(self, sheet: RotationSheet, what: str) -> Matrix | None:
        """The matrix of a rotation; a list that is no rotation is reported."""
        if sheet.turns:
            matrix = Matrix.identity(self.ring, 3)
            for turn in sheet.turns:
                matrix = matrix @ elementary(self.ring, turn.axis, turn.angle)
            return matrix
        rows = [self.column(row) for row in sheet.rows]
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
        self.report.error(sheet.span, message, help)
        return None


def evaluate(report: Faults, sheet: Sheet) -> CellValues | None:
    """The ring that holds everything in the file; None (reported) where there is none.

    Cells that no ring can hold are reported one by one and left out.
    """
    coordinates = sheet.table.names
    constant = list(sheet.constant)
    wrong = [cell for cell in constant if any(name.name in coordinates for name in cell.names)]
    left_out = {id(cell) for cell in wrong}
    cells = [cell for cell in (*sheet.moving, *constant) if id(cell) not in left_out]
    try:
        ring = _ring(sheet, cells)
    except AlgebraError:
        culprits = [cell for cell in cells if _fails(report, sheet, cell)]
        left_out |= {id(cell) for cell in culprits}
        try:
            ring = _ring(sheet, [cell for cell in cells if id(cell) not in left_out])
        except AlgebraError as error:
            if not culprits:
                report.error((0, 0), error.message, error.help)
            return None
    _check_angles(report, sheet, ring)
    return CellValues(report, ring, frozenset(left_out))


def _check_angles(report: Faults, sheet: Sheet, ring: Ring) -> None:
    """Report angles whose sine the ring has no room for: a thousand times another angle."""
    for cell, angle in sheet.angles:
        try:
            ring.cos(angle)
        except AlgebraError as error:
            report.error(cell.span, f"{cell.what}: {error.message}", error.help or "write angles of one size")


def _ring(sheet: Sheet, cells: list[Cell]) -> Ring:
    turns = [
        Turn(row.angles["theta"], row.angles["alpha"], row.variable == "theta")
        for row in sheet.table.rows
        if len(row.angles) == 2
    ]
    preferred = absolute_angles(turns, sheet.table.names, sheet.convention is Convention.MODIFIED)
    return build_ring(
        sheet.table.coordinates,
        [cell.tree for cell in cells],
        [angle for _, angle in sheet.angles],
        preferred,
    )


def _fails(report: Faults, sheet: Sheet, cell: Cell) -> bool:
    """Whether no ring can hold this cell by itself (reported)."""
    try:
        build_ring(sheet.table.coordinates, [cell.tree])
    except AlgebraError as error:
        report.error(cell.span, f"{cell.what}: {error.message}", error.help)
        return True
    return False
