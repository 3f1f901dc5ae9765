"""`model` of a problem file: bodies by their positions, or D and P, K and P, or L, as they are written.

`model` of a problem file -> the bodies of a `Robot`, or the model that is given, with exact values.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_sqrt
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import Function, Node, Number, Quotient, Symbol, walk
from dynsolve.problem.action_keys import MAX_COORDINATES, MAX_TURNS, TURN, TYPES
from dynsolve.problem.bodies import ParsedTensor, check_names, read_name, read_tensor
from dynsolve.problem.cells import (
    Cell,
    denominators,
    forbid,
    made_cell,
    read_angle,
    read_cell,
    read_rate_cell,
    read_vector,
)
from dynsolve.problem.kinds import Fields, describe, items, word
from dynsolve.problem.specification import MAX_BODIES, MODEL, PLACED_BODY, PROBLEM
from dynsolve.problem.table import coordinate_name
from dynsolve.problem.values import CellValues, mass_value, tensor_value
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, Span, YamlNode
from dynsolve.robot.actions import BodyTurn, GivenModel
from dynsolve.robot.geometry import rotation_about
from dynsolve.robot.model import Axes, AxesKind, Body

# `model` of a problem file

_HELP = PROBLEM["model"].help
_COORDINATES = MODEL["coordinates"].help
_CONSTANT = "it is constant: coordinates stand in `at` and `turn`"


class ParsedTurn(Struct, frozen=True):
    """A turn of a body: its angle, the angle's rate with each coordinate that it holds, its axis."""

    cell: Cell
    angle: Angle
    rates: Mapping[str, Node]
    axis: tuple[Cell, ...]


class ParsedPlacedBody(Struct, frozen=True):
    """One entry of `bodies`; None where a part was reported or is not given."""

    index: int
    span: Span
    fields: Fields
    name: str
    mass: Cell | None
    at: tuple[Cell, ...] | None
    turns: tuple[ParsedTurn, ...]
    tensor: ParsedTensor | None

    @property
    def is_point(self) -> bool:
        """Whether it has no inertia about its mass centre."""
        return self.tensor is None

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        if self.mass:
            yield self.mass
        if self.tensor:
            yield from (cell for row in self.tensor.rows for cell in row if cell)
        for turn in self.turns:
            yield from turn.axis


class ParsedModel(Struct, frozen=True):
    """`model` as it is written; `faulty` where something of it was reported."""

    span: Span
    coordinates: tuple[tuple[str, str], ...]
    bodies: tuple[ParsedPlacedBody, ...] = ()
    D: tuple[tuple[Cell, ...], ...] | None = None
    K: Cell | None = None
    P: Cell | None = None
    L: Cell | None = None
    faulty: bool = False

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        for body in self.bodies:
            yield from body.constant

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that may hold coordinates."""
        for body in self.bodies:
            yield from body.at or ()
        for row in self.D or ():
            yield from row
        yield from (cell for cell in (self.K, self.P, self.L) if cell)

    @property
    def turns(self) -> Iterator[ParsedTurn]:
        """The turns of all bodies."""
        for body in self.bodies:
            yield from body.turns

    @property
    def cells(self) -> Iterator[Cell]:
        """Every cell that was read."""
        yield from self.constant
        yield from self.moving
        yield from (turn.cell for turn in self.turns)

    @property
    def rates(self) -> Iterator[Node]:
        """How the angles of the turns change with coordinates."""
        for turn in self.turns:
            yield from turn.rates.values()

    @property
    def slopes(self) -> Iterator[Node]:
        """1/R for each length R that an angle x/R is divided by: a derivative brings it."""
        for cell in self.moving:
            for part in walk(cell.tree):
                if isinstance(part, Function) and part.name in ("sin", "cos"):
                    yield from map(_inverse, denominators(part.argument))


def read_model(faults: Faults, node: YamlNode | None) -> ParsedModel:
    """The value of `model`; everything wrong with it is reported."""
    before = len(faults.errors)
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, f"model is a mapping, not {describe(node)}", _HELP)
        return ParsedModel(node.span if node else (0, 0), (), faulty=True)
    fields = Fields(faults, node, MODEL.names, "model")
    if fields.lacks("coordinates"):
        faults.error(node.span, "the model has no `coordinates`", f"add {_COORDINATES}")
    types = read_types(faults, fields.get("coordinates"), _COORDINATES)
    _check_ways(faults, fields)
    bodies = _read_bodies(faults, fields.get("bodies"), types)
    scalars = {
        key: read_rate_cell(faults, fields.get(key), f"{key} of the model", types) for key in ("K", "P", "L")
    }
    D = _read_matrix(faults, fields.get("D"), len(types))
    model = ParsedModel(node.span, tuple(types.items()), bodies, D, scalars["K"], scalars["P"], scalars["L"])
    return replace(model, faulty=len(faults.errors) > before)


def read_types(faults: Faults, node: YamlNode | None, help: str) -> dict[str, str]:
    """Coordinates by name with their types, `revolute` or `prismatic`; what is wrong is reported."""
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, f"coordinates are names with their types, not {describe(node)}", help)
        return {}
    types: dict[str, str] = {}
    for key, value in node.entries[:MAX_COORDINATES]:
        name = coordinate_name(faults, key, help)
        kind = word(faults, value, TYPES.choices, f"the type of {key.decoded}", help)
        if name is None or kind is None:
            continue
        if name in types:
            faults.error(key.span, f"{name} is listed twice", help)
        types[name] = kind
    if not node.entries:
        faults.error(node.span, "there are no coordinates", help)
    if len(node.entries) > MAX_COORDINATES:
        message = f"{len(node.entries)} coordinates; at most {MAX_COORDINATES} are read"
        faults.error(node.span, message, "leave some out")
    return types


def _check_ways(faults: Faults, fields: Fields) -> None:
    """Exactly one of bodies, D, K and L stands in a model, and P beside D or K."""
    given = [key for key in ("bodies", "D", "K", "L") if key in fields]
    if not given:
        help = "add `bodies`, each with its mass and `at: [x, y, z]`; or D and P, K and P, or L"
        faults.error(fields.span, "the model has neither bodies nor energies", help)
    for key in given[1:]:
        message = f"`{key}` stands beside `{given[0]}`, and either says the whole model"
        faults.error(fields.key_span(key), message, "keep one of them")
    if "P" in fields and given and given[0] in ("bodies", "L"):
        message = f"`P` stands beside `{given[0]}`, which already says it"
        help = "gravity gives P of bodies; `springs` adds to it" if given[0] == "bodies" else "L is K - P"
        faults.error(fields.key_span("P"), message, help)


def _inverse(node: Node) -> Node:
    return Quotient(Number(1), node)


# -- the inertia matrix ----------------------------------------------------------------------------


def _read_matrix(faults: Faults, node: YamlNode | None, n: int) -> tuple[tuple[Cell, ...], ...] | None:
    help = "write D: [[..., ...], [..., ...]], a row and a column for each coordinate"
    if node is None or isinstance(node, FaultyNode):
        return None
    return read_square(faults, node, "D", n, help)


def read_square(
    faults: Faults, node: YamlNode, what: str, n: int, help: str
) -> tuple[tuple[Cell, ...], ...] | None:
    """The cells of an n×n matrix, None (reported) where it is none."""
    listed = items(faults, node, what, help)
    if isinstance(node, ListNode) and len(listed) != n:
        faults.error(node.span, f"{what} has {len(listed)} rows, not {n}", help)
        return None
    rows = [_read_row(faults, row, f"{what}, row {i}", n, help) for i, row in enumerate(listed, 1)]
    return tuple(row for row in rows if row) if listed and None not in rows else None


def _read_row(faults: Faults, node: YamlNode, what: str, n: int, help: str) -> tuple[Cell, ...] | None:
    listed = items(faults, node, what, help)
    if isinstance(node, ListNode) and len(listed) != n:
        faults.error(node.span, f"{what} has {len(listed)} entries, not {n}", help)
        return None
    cells = [read_cell(faults, item, f"{what}, column {j}") for j, item in enumerate(listed, 1)]
    return tuple(cell for cell in cells if cell) if listed and None not in cells else None


# -- bodies ----------------------------------------------------------------------------------------


def _read_bodies(
    faults: Faults, node: YamlNode | None, coordinates: Mapping[str, str]
) -> tuple[ParsedPlacedBody, ...]:
    listed = items(faults, node, "bodies", MODEL["bodies"].help)
    if isinstance(node, ListNode) and not listed:
        faults.error(node.span, "the model has no bodies", MODEL["bodies"].help)
    if len(listed) > MAX_BODIES and node:
        faults.error(node.span, f"{len(listed)} bodies; at most {MAX_BODIES} are read", "leave some out")
        listed = listed[:MAX_BODIES]
    read = [_read_body(faults, entry, i, coordinates) for i, entry in enumerate(listed, 1)]
    bodies = tuple(body for body in read if body)
    check_names(faults, bodies)
    return bodies


def _read_body(
    faults: Faults, node: YamlNode, index: int, coordinates: Mapping[str, str]
) -> ParsedPlacedBody | None:
    what = f"body {index}"
    if not isinstance(node, MappingNode):
        if not isinstance(node, FaultyNode):
            help = MODEL["bodies"].help
            faults.error(node.span, f"{what} is not a mapping but {describe(node)}", help)
        return None
    fields = Fields(faults, node, PLACED_BODY.names, what)
    for key in PLACED_BODY.required:
        if fields.lacks(key.name):
            faults.error(node.span, f"{what} has no `{key.name}`", f"add {key.help}")
    body = ParsedPlacedBody(
        index=index,
        span=node.span,
        fields=fields,
        name=read_name(faults, fields.get("name"), index),
        mass=read_cell(faults, fields.get("mass"), f"the mass of {what}"),
        at=read_vector(faults, fields.get("at"), f"the position of {what}"),
        turns=_read_turns(faults, fields, what, coordinates),
        tensor=read_tensor(faults, fields.get("inertia"), what),
    )
    forbid(faults, body.constant, coordinates, _CONSTANT)
    return body


def _read_turns(
    faults: Faults, fields: Fields, what: str, coordinates: Mapping[str, str]
) -> tuple[ParsedTurn, ...]:
    """The turns of a body: one with its `about`, or several as a list."""
    node = fields.get("turn")
    if not isinstance(node, ListNode):
        if "about" in fields and "turn" not in fields:
            message = f"{what} has `about` but no `turn` about it"
            faults.error(fields.key_span("about"), message, "add turn: theta, or delete it")
        turn = _read_turn(faults, fields, "turn", what, coordinates)
        return (turn,) if turn else ()
    if "about" in fields:
        message = f"each of several turns of {what} has an axis of its own"
        faults.error(fields.key_span("about"), message, "write {by: phi, about: [0, 0, 1]} in the list")
    if len(node.items) > MAX_TURNS:
        faults.error(node.span, f"{len(node.items)} turns; at most {MAX_TURNS} are read", "leave some out")
    found = []
    for item in node.items[:MAX_TURNS]:
        if isinstance(item, MappingNode):
            own = Fields(faults, item, TURN.names, f"a turn of {what}")
            if own.lacks("by"):
                faults.error(item.span, f"a turn of {what} has no `by`", "add by: phi")
            found.append(_read_turn(faults, own, "by", what, coordinates))
        elif not isinstance(item, FaultyNode):
            help = "write {by: phi, about: [0, 0, 1]}"
            faults.error(item.span, f"a turn of {what} is a mapping, not {describe(item)}", help)
    return tuple(turn for turn in found if turn)


def _read_turn(
    faults: Faults, fields: Fields, key: str, what: str, coordinates: Mapping[str, str]
) -> ParsedTurn | None:
    cell = read_cell(faults, fields.get(key), f"the turn of {what}")
    axis = read_vector(faults, fields.get("about"), f"the axis of {what}")
    if "about" not in fields:
        axis = tuple(made_cell(f"the axis of {what}", text) for text in "001")
    angle = read_angle(faults, cell) if cell else None
    if cell is None or axis is None or angle is None:
        return None
    rates = _rates(faults, cell, angle, coordinates)
    return None if rates is None else ParsedTurn(cell, angle, rates, axis)


def _rates(
    faults: Faults, cell: Cell, angle: Angle, coordinates: Mapping[str, str]
) -> dict[str, Node] | None:
    """The derivative of the angle by each coordinate; None (reported) where it is not linear in them."""
    rates: dict[str, list[Node]] = {}
    for atom, rate in angle.terms:
        moving = [(name, exponent) for name, exponent in atom if name in coordinates]
        if moving and (len(moving) > 1 or moving[0][1] != 1):
            message = f"{cell.what} is not linear in the coordinate {moving[0][0]}"
            help = "a turn is a sum of coordinates times what is free of them: theta - x/R"
            faults.error(cell.span, message, help)
            return None
        for name, _ in moving:
            rest = [(Symbol(other), exponent) for other, exponent in atom if other != name]
            rates.setdefault(name, []).append(times(rate, rest))
    return {name: total(terms) for name, terms in rates.items()}


# `model` of a problem file -> the bodies of a `Robot`, or the model that is given, with exact values

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
