"""`velocity`, `acceleration`, `weights` of a problem file: rates of a task, and what those of joints cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.problem.cells import Cell, forbid, made_cell, read_cell, read_expressions
from dynsolve.problem.kinds import Fields, describe
from dynsolve.problem.state import Around, Given
from dynsolve.problem.table import by_coordinate
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode
from dynsolve.questions.rates.keys import ACCELERATION, BY_INERTIA, VELOCITY, WEIGHTS
from dynsolve.robot.model import Robot


class ParsedRates(Struct, frozen=True):
    """`velocity:` or `acceleration:` of the task."""

    key: str
    span: Span
    cells: tuple[Cell, ...]


_WEIGHTS_CONSTANT = "a weight holds numbers and parameters"


class ParsedWeights(Struct, frozen=True):
    """W by rows, none where it is the inertia matrix; and where it stands."""

    rows: tuple[tuple[Cell, ...], ...]
    span: Span

    @property
    def is_inertia(self) -> bool:
        """Whether W is D(q)."""
        return not self.rows


class GivenRates(Given, frozen=True):
    """The rates of the task, and the weights."""

    rates: tuple[ParsedRates, ...] = ()
    weights: ParsedWeights | None = None


def read(faults: Faults, fields: Fields, around: Around) -> GivenRates:
    """The keys of a file; what is wrong is reported."""
    rates = tuple(
        ParsedRates(key.name, fields.span_of(key.name), cells)
        for key in (VELOCITY, ACCELERATION)
        if (cells := read_expressions(faults, fields.get(key.name), key.name, key.help)) is not None
    )
    weights = _read_weights(faults, fields.get("weights"), around.coordinates, around.has_bodies)
    return GivenRates(
        constant=tuple(cell for row in weights.rows for cell in row) if weights else (),
        moving=tuple(cell for one in rates for cell in one.cells),
        rates=rates,
        weights=weights,
    )


def _read_weights(
    faults: Faults, node: YamlNode | None, coordinates: Mapping[str, str], has_bodies: bool
) -> ParsedWeights | None:
    """W of a file, None where there is none; what is wrong with it is reported."""
    help = WEIGHTS.help
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
        for name, value in by_coordinate(faults, node, names, WEIGHTS.help)
    }
    one, zero = (made_cell("a weight", text, node.span[0]) for text in "10")
    return [[given.get(name, one) if name == other else zero for other in names] for name in names]


def _listed(faults: Faults, node: ListNode, size: int) -> list[list[Cell | None]]:
    rows = [row.items if isinstance(row, ListNode) else () for row in node.items]
    if len(rows) != size or any(len(row) != size for row in rows):
        message = f"the matrix of the weights is {size}×{size}, a row and a column for each coordinate"
        faults.error(node.span, message, WEIGHTS.help)
        return []
    return [[read_cell(faults, item, f"a weight, row {i}") for item in row] for i, row in enumerate(rows, 1)]


def build(values: CellValues, robot: Robot, given: GivenRates) -> Robot:
    """The robot with the rates of its task and the weights."""
    questions = robot.questions
    rows = questions.task.rows if questions.task else 0
    rates = {one.key: _rates(values, one, rows) for one in given.rates}
    questions = replace(
        questions,
        velocity=rates.get(VELOCITY.name),
        acceleration=rates.get(ACCELERATION.name),
        weights=_weights(values, given.weights),
        weighs_by_inertia=given.weights is not None and given.weights.is_inertia,
    )
    return replace(robot, questions=questions)


def _weights(values: CellValues, parsed: ParsedWeights | None) -> Matrix | None:
    """W, n×n; None where there is none, where it is D, or where it was reported to be no such matrix."""
    if parsed is None or parsed.is_inertia:
        return None
    columns = [values.column(row) for row in parsed.rows]
    if None in columns:
        return None
    W = Matrix.of(values.ring, [column.entries for column in columns if column])
    help = "weights are symmetric and positive, so that q̇ᵀ W q̇ is a cost"
    if W.T != W:
        values.faults.error(parsed.span, "the matrix of the weights is not symmetric", help)
    for size in range(1, len(W.rows) + 1):
        minor = determinant(Matrix.of(values.ring, [row[:size] for row in W.rows[:size]]))
        if minor.is_zero or (minor.is_number and minor.number < 0):
            values.faults.error(parsed.span, "the matrix of the weights is not positive definite", help)
            return None
    return W


def _rates(values: CellValues, parsed: ParsedRates, rows: int) -> Matrix | None:
    """The velocity or acceleration of the task, m×1; one of another length is reported."""
    if len(parsed.cells) != rows:
        has = f"the task has {rows} component{'s' * (rows != 1)}"
        values.faults.error(
            parsed.span, f"{parsed.key} has {len(parsed.cells)} components; {has}", "write one for each"
        )
        return None
    return values.column(parsed.cells)
