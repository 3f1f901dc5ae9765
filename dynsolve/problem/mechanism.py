"""`model` of a problem file: bodies by their positions, or D and P, K and P, or L, as they are written.

`candidates`, `assume` and `chain`: matrices to be judged, and what is assumed of their parameters.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import pairwise

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_sqrt
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import ReadError
from dynsolve.notation.build import times, total
from dynsolve.notation.characters import normalize
from dynsolve.notation.tree import Function, Node, Number, Quotient, Symbol, walk
from dynsolve.problem.bodies import check_names, read_name, read_tensor
from dynsolve.problem.cells import (
    Cell,
    denominators,
    made_cell,
    read_angle,
    read_cell,
    read_rate_cell,
    read_text,
)
from dynsolve.problem.decoder import Decoder, Record, Stated
from dynsolve.problem.kinds import Fields, describe, did_you_mean, items, word
from dynsolve.problem.model_keys import (
    ASSUME,
    CANDIDATES,
    CHAIN,
    FIXED,
    MAX_ASSUMED,
    MAX_CANDIDATES,
    MAX_COORDINATES,
    MAX_TURNS,
    TURN,
    TYPES,
)
from dynsolve.problem.specification import MODEL, PROBLEM
from dynsolve.problem.table import coordinate_name
from dynsolve.problem.values import CellValues, mass_value, tensor_value
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode
from dynsolve.robot.geometry import rotation_about
from dynsolve.robot.model import Axes, AxesKind, Body, BodyTurn, GivenModel
from dynsolve.robot.questions import Candidate

_HELP = PROBLEM["model"].help
_COORDINATES = MODEL["coordinates"].help


class ParsedTurn(Struct, frozen=True):
    """A turn of a body: its angle, the angle's rate with each coordinate that it holds, its axis."""

    cell: Cell
    angle: Angle
    rates: Mapping[str, Node]
    axis: tuple[Cell, ...]


class Model(Struct, frozen=True):
    """`model` as it is written; `faulty` where something of it was reported."""

    span: Span
    coordinates: tuple[tuple[str, str], ...]
    bodies: tuple[Record, ...] = ()
    D: tuple[tuple[Cell, ...], ...] | None = None
    K: Cell | None = None
    P: Cell | None = None
    L: Cell | None = None
    faulty: bool = False
    stated: tuple[Stated, ...] = ()

    @property
    def rates(self) -> Iterator[Node]:
        """How the angles of the turns change with coordinates."""
        for body in self.bodies:
            for turn in body["turn"]:
                yield from turn.rates.values()

    @property
    def slopes(self) -> Iterator[Node]:
        """1/R for each length R that an angle x/R is divided by: a derivative brings it."""
        for part in (part for one in self.stated if one.moves for part in walk(one.cell.tree)):
            if isinstance(part, Function) and part.name in ("sin", "cos"):
                yield from (Quotient(Number(1), below) for below in denominators(part.argument))


def read_model(faults: Faults, node: YamlNode | None) -> Model:
    """The value of `model`; everything wrong with it is reported."""
    before = len(faults.errors)
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, f"model is a mapping, not {describe(node)}", _HELP)
        return Model(node.span if node else (0, 0), (), faulty=True)
    fields = Fields(faults, node, MODEL.names, "model")
    if fields.lacks("coordinates"):
        faults.error(node.span, "the model has no `coordinates`", f"add {_COORDINATES}")
    types = read_types(faults, fields.get("coordinates"), _COORDINATES)
    _check_ways(faults, fields)
    decoder = Decoder(faults, types, 0)
    bodies = []
    for body in decoder.entries(fields, MODEL["bodies"]):
        body["name"] = read_name(faults, body.get("name"), body.index)
        tensor = body["inertia"] = read_tensor(faults, body.get("inertia"), body.what)
        decoder.keep((cell for row in tensor.rows for cell in row) if tensor else (), constant=FIXED)
        body["turn"] = _read_turns(decoder, body)
        bodies.append(body)
    check_names(bodies)
    K, P, L = (read_rate_cell(faults, fields.get(key), f"{key} of the model", types) for key in "KPL")
    help = "write D: [[..., ...], [..., ...]], a row and a column for each coordinate"
    D = read_square(faults, fields.get("D"), "D", len(types), help)
    decoder.keep(cell for row in D or () for cell in row)
    decoder.keep((K, P, L))
    faulty = len(faults.errors) > before
    return Model(node.span, tuple(types.items()), tuple(bodies), D, K, P, L, faulty, tuple(decoder.stated))


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


# -- the inertia matrix ----------------------------------------------------------------------------


def read_square(
    faults: Faults, node: YamlNode | None, what: str, n: int, help: str
) -> tuple[tuple[Cell, ...], ...] | None:
    """The cells of an n×n matrix, None (reported) where it is none, or is not given."""
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


def _read_turns(decoder: Decoder, body: Record) -> tuple[ParsedTurn, ...]:
    """The turns of a body: one with its `about`, or several as a list."""
    faults, what, node = body.faults, body.what, body.get("turn")
    if not isinstance(node, ListNode):
        if "about" in body and "turn" not in body:
            message = f"{what} has `about` but no `turn` about it"
            faults.error(body.key_span("about"), message, "add turn: theta, or delete it")
        turn = _read_turn(decoder, body, "turn", what)
        return (turn,) if turn else ()
    if "about" in body:
        message = f"each of several turns of {what} has an axis of its own"
        faults.error(body.key_span("about"), message, "write {by: phi, about: [0, 0, 1]} in the list")
    if len(node.items) > MAX_TURNS:
        faults.error(node.span, f"{len(node.items)} turns; at most {MAX_TURNS} are read", "leave some out")
    found = []
    for item in node.items[:MAX_TURNS]:
        if isinstance(item, MappingNode):
            own = Record(decoder, item, TURN, f"a turn of {what}")
            found.append(_read_turn(decoder, own, "by", what))
        elif not isinstance(item, FaultyNode):
            help = "write {by: phi, about: [0, 0, 1]}"
            faults.error(item.span, f"a turn of {what} is a mapping, not {describe(item)}", help)
    return tuple(turn for turn in found if turn)


def _read_turn(decoder: Decoder, turn: Record, key: str, what: str) -> ParsedTurn | None:
    cell = read_cell(decoder.faults, turn.get(key), f"the turn of {what}")
    axis = turn["about"]
    if "about" not in turn:
        axis = tuple(made_cell(f"the axis of {what}", text) for text in "001")
    angle = read_angle(decoder.faults, cell) if cell else None
    if cell is None or axis is None or angle is None:
        return None
    decoder.stated.append(Stated(cell, "", None, angle))
    rates = _rates(decoder.faults, cell, angle, decoder.coordinates)
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


# -- the bodies of a `Robot`, with exact values ----------------------------------------------------

MOST_DEGREE = 8
"""The largest degree of an energy in the coordinates, their sines and cosines, and their rates."""


def placed_bodies(values: CellValues, model: Model) -> list[Body | None]:
    """The bodies of a mechanism by positions; None for one of which something was reported."""
    return [_body(values, body) for body in model.bodies]


def _body(values: CellValues, body: Record) -> Body | None:
    mass = mass_value(values, body["mass"], body.index)
    position = values.column(body["at"]) if body["at"] else None
    tensor = tensor_value(values, body["inertia"], body.index) if body["inertia"] else None
    turns = [_turn(values, turn) for turn in body["turn"]]
    if mass is None or position is None or None in turns or (body["inertia"] and tensor is None):
        return None
    for cell, entry in zip(body["at"], position.entries, strict=True):
        _check_degree(values, cell, entry, MOST_DEGREE // 2)
    return Body(
        name=body["name"],
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


def given_model(values: CellValues, model: Model) -> GivenModel | None:
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
    cells = (("K", model.K), ("P", model.P), ("L", model.L))
    return GivenModel(D, K, P, L, tuple((name, cell.tree) for name, cell in cells if cell))


def _inertia_matrix(values: CellValues, cells: tuple[tuple[Cell, ...], ...]) -> Matrix | None:
    D = values.matrix(cells)
    if D is None:
        return None
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


# `candidates`, `assume` and `chain` of a problem file

_SIGN = re.compile(r">=|<=|[<>≥≤]")
EVERY = ""
"""The name under which stands what is assumed of all matrices."""


class Inequality(Struct, frozen=True):
    """left > right, or ≥ where it is not strict."""

    left: Cell
    right: Cell
    is_strict: bool


class Candidates(Struct, frozen=True):
    """The matrices by name, and what is assumed of each, or under no name of all."""

    matrices: Mapping[str, tuple[tuple[Cell, ...], ...]]
    assumed: Mapping[str, tuple[Inequality, ...]]
    is_relative: bool = False
    faulty: bool = False
    stated: tuple[Stated, ...] = ()


def read_candidates(faults: Faults, fields: Fields, coordinates: Mapping[str, str]) -> Candidates:
    """The matrices of a file and what is assumed; everything wrong with them is reported."""
    before = len(faults.errors)
    found = dict(_read_matrices(faults, fields.get("candidates"), len(coordinates)))
    matrices = {name: rows for name, rows in found.items() if rows is not None}
    assumed = _read_assumed(faults, fields.get("assume"), found)
    decoder = Decoder(faults, coordinates, 0)
    decoder.keep(cell for rows in matrices.values() for row in rows for cell in row)
    sides = (side for every in assumed.values() for one in every for side in (one.left, one.right))
    decoder.keep(sides, constant="it is said of parameters alone")
    chain = word(faults, fields.get("chain"), CHAIN.choices, "chain", "write chain: relative")
    faulty = len(faults.errors) > before
    return Candidates(matrices, assumed, chain is not None, faulty, tuple(decoder.stated))


def _read_matrices(
    faults: Faults, node: YamlNode | None, n: int
) -> Iterator[tuple[str, tuple[tuple[Cell, ...], ...] | None]]:
    """Each by its name; None of one that is faulty."""
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, f"candidates are matrices by name, not {describe(node)}", CANDIDATES.help)
        return
    if len(node.entries) > MAX_CANDIDATES:
        message = f"{len(node.entries)} candidates; at most {MAX_CANDIDATES} are read"
        faults.error(node.span, message, "leave some out")
    for key, value in node.entries[:MAX_CANDIDATES]:
        try:
            name = normalize(key.decoded)
        except ReadError as error:
            at = key.start + error.offset
            faults.error((at, at + error.length), error.message, error.help)
            continue
        yield name, read_square(faults, value, name, n, CANDIDATES.help) if n else None


def _read_assumed(
    faults: Faults, node: YamlNode | None, names: Mapping[str, object]
) -> dict[str, tuple[Inequality, ...]]:
    if isinstance(node, MappingNode):
        found = {}
        for key, value in node.entries:
            if key.decoded not in names:
                help = did_you_mean(key.decoded, names) or "it is said of a candidate by its name"
                faults.error(key.span, f"there is no candidate {key.decoded}", help)
            found[key.decoded] = tuple(_inequalities(faults, value))
        return found
    return {EVERY: tuple(_inequalities(faults, node))}


def _inequalities(faults: Faults, node: YamlNode | None) -> Iterator[Inequality]:
    if node is None or isinstance(node, FaultyNode):
        return
    if not isinstance(node, ListNode):
        faults.error(node.span, f"assume is a list of inequalities, not {describe(node)}", ASSUME.help)
        return
    for item in node.items[:MAX_ASSUMED]:
        if isinstance(item, ScalarNode):
            yield from _inequality(faults, item)
        elif not isinstance(item, FaultyNode):
            faults.error(item.span, f"an inequality is expected, not {describe(item)}", ASSUME.help)


def _inequality(faults: Faults, node: ScalarNode) -> Iterator[Inequality]:
    """a > b, or a > b > c as a > b and b > c."""
    signs = list(_SIGN.finditer(node.text))
    if not signs:
        faults.error(node.span, f"`{node.text[:40]}` is no inequality", ASSUME.help)
        return
    ends = [0, *(sign.end() for sign in signs)]
    starts = [*(sign.start() for sign in signs), len(node.text)]
    sides = [
        read_text(faults, node.text[a:b], node.start + a, "an inequality")
        for a, b in zip(ends, starts, strict=True)
    ]
    for sign, (left, right) in zip(signs, pairwise(sides), strict=True):
        if left is not None and right is not None:
            is_strict = sign[0] in "<>"
            yield Inequality(*((left, right) if sign[0][0] in ">≥" else (right, left)), is_strict)


# -- the matrices, with exact values ---------------------------------------------------------------


def candidates(
    values: CellValues, parsed: Candidates, D: tuple[tuple[Cell, ...], ...] | None
) -> tuple[Candidate, ...]:
    """The matrices to be judged, or the D that a model is given by; what is wrong is reported.

    Each is in a ring of its own, in which it is as short as if it stood alone: cos 2q beside no cos q.
    """
    matrices = parsed.matrices or ({"D": D} if D else {})
    made = []
    for name, rows in matrices.items():
        inequalities = (*parsed.assumed.get(EVERY, ()), *parsed.assumed.get(name, ()))
        sides = (side for one in inequalities for side in (one.left, one.right))
        own = values.alone([*(cell for row in rows for cell in row), *sides])
        matrix = own.matrix(rows)
        if matrix is not None:
            made.append(Candidate(name, matrix, _bounds(own, inequalities), parsed.is_relative))
    return tuple(made)


def assumed(values: CellValues, parsed: Candidates) -> tuple[Bound, ...]:
    """What is assumed of the parameters, whatever matrix they stand in."""
    return _bounds(values, parsed.assumed.get(EVERY, ()))


def _bounds(values: CellValues, parsed: tuple[Inequality, ...]) -> tuple[Bound, ...]:
    found = []
    for one in parsed:
        left, right = values.expr(one.left), values.expr(one.right)
        if left is not None and right is not None:
            found.append(Bound(left - right, one.is_strict))
    return tuple(found)
