"""`model` of a problem file -> the bodies of a `Robot`, or the model that is given, with exact values."""

from __future__ import annotations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_sqrt
from dynsolve.algebra.ring_values import value_of
from dynsolve.problem.body_values import mass_value, tensor_value
from dynsolve.problem.cells import Cell
from dynsolve.problem.mechanism import ParsedModel, ParsedPlacedBody, ParsedTurn
from dynsolve.problem.values import CellValues
from dynsolve.robot.geometry import rotation_about
from dynsolve.robot.mechanism import BodyTurn, GivenModel
from dynsolve.robot.model import Axes, AxesKind, Body

MOST_DEGREE = 8
"""The largest degree of an energy in the coordinates, their sines and cosines, and their rates."""


def placed_bodies(values: CellValues, model: ParsedModel) -> tuple[Body, ...]:
    """The bodies of a mechanism by positions; what is wrong with one is reported."""
    made = [_body(values, parsed) for parsed in model.bodies]
    return tuple(body for body in made if body)


def _body(values: CellValues, parsed: ParsedPlacedBody) -> Body | None:
    mass = mass_value(values, parsed.mass, parsed.index)
    position = values.column(parsed.at) if parsed.at else None
    tensor = tensor_value(values, parsed.tensor, parsed.index) if parsed.tensor else None
    turns = [_turn(values, turn) for turn in parsed.turns]
    if mass is None or position is None or None in turns or (parsed.tensor and tensor is None):
        return None
    for cell, entry in zip(parsed.at or (), position.entries, strict=True):
        _check_degree(values, cell, entry, MOST_DEGREE // 2)
    return Body(
        name=parsed.name,
        mass=mass,
        link=0,
        center=position,
        axes=Axes(AxesKind.LINK, Matrix.identity(values.ring, 3)),
        inertia=tensor,
        turns=tuple(turn for turn in turns if turn),
    )


def _turn(values: CellValues, parsed: ParsedTurn) -> BodyTurn | None:
    ring = values.ring
    axis = values.column(parsed.axis)
    if axis is None:
        return None
    unit = _unit(axis)
    if unit is None:
        message = f"{parsed.axis[0].what.partition(',')[0]} has no length that is known exactly"
        help = "write a unit vector: [0, 0, 1], [cos(30deg), 0, sin(30deg)], [1/sqrt(2), 1/sqrt(2), 0]"
        values.faults.error(parsed.axis[0].span, message, help)
        return None
    slopes = (
        value_of(ring, parsed.rates[name]) if name in parsed.rates else ring.zero for name in ring.names
    )
    return BodyTurn(unit, Matrix.of(ring, [slopes]), rotation_about(unit, parsed.angle), parsed.cell.tree)


def _unit(axis: Matrix) -> Matrix | None:
    """The unit vector along an axis, None where its length is no rational number."""
    square = axis.ring.dot(axis.entries, axis.entries)
    length = rational_sqrt(square.number) if square.is_number else None
    return axis.scale(axis.ring.constant(1 / length)) if length else None


# -- given energies --------------------------------------------------------------------------------


def given_model(values: CellValues, model: ParsedModel) -> GivenModel | None:
    """D and P, K and P, or L of a file; None where the model has bodies, or a fault was reported."""
    if model.bodies or not (model.D or model.K or model.L):
        return None
    K, P, L = (values.expr(cell) if cell else None for cell in (model.K, model.P, model.L))
    D = _inertia_matrix(values, model.D) if model.D else None
    for cell, energy in ((model.K, K), (model.P, P), (model.L, L)):
        if cell is not None and energy is not None:
            _check_degree(values, cell, energy, MOST_DEGREE)
    if model.K and K is not None and _quadratic_part(K) != K:
        help = "kinetic energy is ½ q̇ᵀ D q̇: every term holds two rates, as m*x'^2/2 or a*x'*theta'"
        values.faults.error(model.K.span, "K is not quadratic in the rates", help)
    if model.P and P is not None and P.ring.without(P, 1) != P:
        values.faults.error(model.P.span, "P holds rates", "potential energy is a function of coordinates")
    if model.L and L is not None and _quadratic_part(L) + L.ring.without(L, 1) != L:
        message = "L is no K - P: beside terms without rates, each term must hold two of them"
        values.faults.error(model.L.span, message, "terms linear in the rates are not read")
    return GivenModel(D, K, P, L)


def _inertia_matrix(values: CellValues, cells: tuple[tuple[Cell, ...], ...]) -> Matrix | None:
    rows = [[values.expr(cell) for cell in row] for row in cells]
    known = [[entry for entry in row if entry is not None] for row in rows]
    if any(len(row) < len(cells) for row in known):
        return None
    D = Matrix.of(values.ring, known)
    for i, row in enumerate(cells):
        for j, cell in enumerate(row):
            _check_degree(values, cell, D[i, j], MOST_DEGREE - 2)
            if j < i and D[i, j] != D[j, i]:
                message = f"D is not symmetric: d{i + 1}{j + 1} is not d{j + 1}{i + 1} = {cells[j][i].text}"
                values.faults.error(cell.span, message, "write the same entry in both places")
    return D


def _quadratic_part(energy: Expr) -> Expr:
    """½ q̇ᵀ H q̇, with H the second derivatives by the rates where these are 0."""
    ring, n = energy.ring, len(energy.ring.names)
    rates = [ring.symbol(name, 1) for name in ring.names]
    slopes = [ring.diff_velocity(energy, k) for k in range(n)]
    total = ring.zero
    for i in range(n):
        for j in range(n):
            total = total + ring.without(ring.diff_velocity(slopes[i], j), 1) * rates[i] * rates[j]
    return total / 2


def _check_degree(values: CellValues, cell: Cell, value: Expr, most: int) -> None:
    degree = value.ring.moving_degree(value)
    if degree > most:
        message = f"{cell.what} is of degree {degree} in the coordinates, their sines, cosines and rates"
        values.faults.error(cell.span, message, f"at most {most} is worked out: energies to degree 8")
