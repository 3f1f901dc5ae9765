"""`model` of a problem file: bodies by their positions, or D and P, K and P, or L, as they are written."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from dynsolve.algebra.angles import Angle
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import Function, Node, Number, Quotient, Symbol
from dynsolve.notation.walk import walk
from dynsolve.problem.bodies import ParsedTensor, check_names, read_name, read_tensor
from dynsolve.problem.cells import Cell, denominators, forbid, made_cell, read_angle, read_cell, read_vector
from dynsolve.problem.fields import Fields, describe, items, word
from dynsolve.problem.mechanism_keys import MAX_COORDINATES, MAX_TURNS, TURN, TYPES
from dynsolve.problem.rate_cells import read_rate_cell
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import MAX_BODIES, MODEL, PLACED_BODY, PROBLEM
from dynsolve.problem.table import coordinate_name
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, MappingNode, Span, YamlNode

_HELP = PROBLEM["model"].help
_COORDINATES = MODEL["coordinates"].help
_CONSTANT = "it is constant: coordinates stand in `at` and `turn`"


@dataclass(frozen=True, slots=True)
class ParsedTurn:
    """A turn of a body: its angle, the angle's rate with each coordinate that it holds, its axis."""

    cell: Cell
    angle: Angle
    rates: Mapping[str, Node]
    axis: tuple[Cell, ...]


@dataclass(frozen=True, slots=True)
class ParsedPlacedBody:
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


@dataclass(frozen=True, slots=True)
class ParsedModel:
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
