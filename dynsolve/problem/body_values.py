"""The mass and the inertia tensor of a body, made exact; what is wrong with them is reported."""

from __future__ import annotations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.problem.bodies import ParsedTensor
from dynsolve.problem.cells import Cell
from dynsolve.problem.values import CellValues
from dynsolve.robot.shapes import AXES


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
