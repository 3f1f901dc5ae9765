"""The Denavit-Hartenberg table of a problem file: its rows, its stars, its coordinates.

The joint variable as a linear combination of coordinates with rational coefficients.

The coordinates that motors bring: `turns: thm1*`, an angle that no row of the table has.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Container, Iterator, Mapping
from fractions import Fraction

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.rationals import rational_value
from dynsolve.errors import ReadError
from dynsolve.notation.characters import normalize
from dynsolve.notation.text import Name
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    names_in,
)
from dynsolve.problem.cells import Cell, made_cell, read_angle, read_cell
from dynsolve.problem.kinds import Fields, describe, did_you_mean, items, word
from dynsolve.problem.specification import MAX_ROWS, PROBLEM, ROW
from dynsolve.problem.yaml_nodes import (
    Faults,
    FaultyNode,
    ListNode,
    MappingNode,
    ScalarNode,
    Span,
    YamlNode,
    too_many,
)

# The joint variable as a linear combination of coordinates with rational coefficients

Rates = dict[str, Fraction]


class NotLinear(Exception):
    """A coordinate occurs otherwise than times a rational number."""

    def __init__(self, message: str, help: str) -> None:
        super().__init__(message)
        self.message, self.help = message, help


_HELP = (
    "a joint variable is a sum of coordinates times rational numbers, plus a constant: p2* - p1*/2 + 90deg"
)


def linear_rates(node: Node, coordinates: Container[str]) -> Rates:
    """Σ rate·coordinate of a formula, its constant part left out; rates of 0 are left out.

    Raises NotLinear.

    >>> from dynsolve.notation.text import read
    >>> linear_rates(read("2*(p2 - p1/3) + 90deg").tree, ("p1", "p2"))
    {'p2': Fraction(2, 1), 'p1': Fraction(-2, 3)}
    """
    return {name: rate for name, rate in _linear_rates(node, coordinates).items() if rate}


def _linear_rates(node: Node, coordinates: Container[str]) -> Rates:
    found = sorted(name for name in names_in(node) if name in coordinates)
    if not found:
        return {}
    match node:
        case Symbol(name):
            return {name: Fraction(1)}
        case Negative(argument):
            return _scaled(_linear_rates(argument, coordinates), Fraction(-1))
        case Parenthesized(argument):
            return _linear_rates(argument, coordinates)
        case Sum(terms):
            total: Rates = {}
            for term in terms:
                for name, rate in _linear_rates(term, coordinates).items():
                    total[name] = total.get(name, Fraction(0)) + rate
            return total
        case Product(factors):
            return _product(factors, coordinates)
        case Quotient(numerator, denominator):
            if any(name in coordinates for name in names_in(denominator)):
                raise NotLinear(f"the coordinate {found[0]} stands in a denominator", _HELP)
            return _scaled(_linear_rates(numerator, coordinates), 1 / _rational(denominator, found[0]))
        case Power(base, Number(1, 1)):
            return _linear_rates(base, coordinates)
        case Power() | Function():
            what = "a power" if isinstance(node, Power) else f"{node.name}(...)"
            raise NotLinear(f"the coordinate {found[0]} stands in {what}: not linear", _HELP)
    raise NotLinear(f"not linear in the coordinate {found[0]}", _HELP)


def _product(factors: tuple[Node, ...], coordinates: Container[str]) -> Rates:
    moving = [f for f in factors if any(name in coordinates for name in names_in(f))]
    first = min(name for name in names_in(moving[0]) if name in coordinates)
    if len(moving) > 1:
        raise NotLinear(f"a product of coordinates, {first} among them: not linear", _HELP)
    rates = _linear_rates(moving[0], coordinates)
    for factor in factors:
        if factor is not moving[0]:
            rates = _scaled(rates, _rational(factor, first))
    return rates


def _scaled(rates: Rates, factor: Fraction) -> Rates:
    return {name: rate * factor for name, rate in rates.items()}


def _rational(node: Node, coordinate: str) -> Fraction:
    value = rational_value(node)
    if value is None:
        raise NotLinear(f"the coefficient of {coordinate} is not a rational number", _HELP)
    if not value:
        raise NotLinear(f"the coefficient of {coordinate} is zero, or divided by zero", _HELP)
    return value


# The coordinates that motors bring: `turns: thm1*`, an angle that no row of the table has

STARRED = re.compile(r"(.*\S)\s*\*")
"""A name with the mark of a joint variable."""


def motor_coordinates(fields: Fields, known: Collection[str]) -> dict[str, str]:
    """Their names with their kind, revolute, in the order of the file; those of the table are none.

    What is wrong with a motor is reported where motors are read (`actions`).
    """
    listed = fields.get("motors")
    found: dict[str, str] = {}
    for item in listed.items if isinstance(listed, ListNode) else ():
        for key, value in item.entries if isinstance(item, MappingNode) else ():
            starred = STARRED.fullmatch(value.text.strip()) if isinstance(value, ScalarNode) else None
            if key.decoded != "turns" or starred is None:
                continue
            try:
                name = normalize(starred[1])
            except ReadError:
                continue
            if name not in known:
                found[name] = "revolute"
    return found


START = "from"
"""The key of a row that says which frame it starts from."""
COLUMNS = tuple(name for name in ROW.names if name != START)
_KINDS = {"theta": "revolute", "d": "prismatic"}
_EXAMPLE = PROBLEM["dh"].help


class DHRow(Struct, frozen=True):
    """A row as the file gives it; `faulty` where something of it was reported."""

    index: int
    span: Span
    cells: Mapping[str, Cell]
    angles: Mapping[str, Angle]
    variable: str | None
    rates: Mapping[str, Fraction]
    faulty: bool
    branch: int | None = None
    """The frame that it starts from, where that is not the one before."""


class DHTable(Struct, frozen=True):
    """The rows and the coordinates, (name, "revolute" | "prismatic"), in their order."""

    rows: tuple[DHRow, ...]
    coordinates: tuple[tuple[str, str], ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the coordinates."""
        return tuple(name for name, _ in self.coordinates)

    @property
    def sound(self) -> bool:
        """Whether nothing of the table was reported."""
        return bool(self.rows) and not any(row.faulty for row in self.rows)


class _Raw(Struct, frozen=True):
    """A row's cells as they were read; those that could not be are left out, and the row is faulty."""

    span: Span
    cells: Mapping[str, Cell]
    faulty: bool
    branch: int | None = None

    def names(self, column: str) -> tuple[Name, ...]:
        return self.cells[column].names if column in self.cells else ()


class _Star(Struct, frozen=True):
    """A starred name: its row, its column, its place."""

    row: int
    column: str
    name: str
    span: Span


def read_table(faults: Faults, fields: Fields, modified: bool) -> DHTable:
    """The table under `dh:` with the order of `coordinates:`; everything wrong with it is reported."""
    if fields.lacks("dh"):
        help = f"add `dh:` with one row per frame; {_EXAMPLE}; or the joint axes of a drawing with `axes:`"
        faults.error((0, 0), "the file has no `dh` table", help)
    nodes = items(faults, fields.get("dh"), "dh", f"one row per frame; {_EXAMPLE}")
    if len(nodes) > MAX_ROWS:
        faults.error(
            fields.key_span("dh"), f"{len(nodes)} rows; at most {MAX_ROWS} are read", "leave some out"
        )
        nodes = nodes[:MAX_ROWS]
    elif not nodes and isinstance(fields.get("dh"), ListNode):
        faults.error(fields.key_span("dh"), "the table has no rows", _EXAMPLE)
    raw = [_read_cells(faults, node, i) for i, node in enumerate(nodes, 1)]
    coordinates = _coordinates(faults, fields, raw)
    rows = tuple(_row(faults, i, row, coordinates, modified) for i, row in enumerate(raw, 1))
    _check_effect(faults, rows, coordinates, fields)
    return DHTable(rows, tuple(coordinates.items()))


def _read_cells(faults: Faults, node: YamlNode, index: int) -> _Raw:
    """The four columns of a row, a mapping in which a missing one is 0, or a list."""
    before = len(faults.errors)
    cells: dict[str, Cell] = {}
    branch = None
    if isinstance(node, MappingNode):
        fields = Fields(faults, node, ROW.names, f"row {index} of the table")
        branch = _read_start(faults, fields, index)
        for column in COLUMNS:
            what = f"{column} of row {index}"
            if column not in fields:
                cells[column] = made_cell(what, "0", node.span[0])
            elif cell := read_cell(faults, fields.get(column), what, stars=column in _KINDS):
                cells[column] = cell
    elif isinstance(node, ListNode):
        cells = read_listed_row(faults, node, index)
    elif not isinstance(node, FaultyNode):
        faults.error(node.span, f"row {index} is not a mapping but {describe(node)}", _EXAMPLE)
    return _Raw(node.span, cells, len(faults.errors) > before or len(cells) < len(COLUMNS), branch)


def read_listed_row(faults: Faults, node: ListNode, index: int) -> dict[str, Cell]:
    """The columns of a row [θ, d, a, α]; empty (reported) where it is not four, in this order."""
    help = "write [theta1*, 0, l1, 0], with a 0 where nothing is, or by names, {theta: theta1*, a: l1}"
    count = len(node.items)
    if count != len(COLUMNS):
        message = f"row {index} is [θ, d, a, α], not {count} cell{'s' * (count != 1)}"
        faults.error(node.span, message, too_many(node, help))
        return {}
    theta, d, *constant = (item.text.strip() if isinstance(item, ScalarNode) else "" for item in node.items)
    if any(text.endswith("*") for text in constant) and "*" not in theta + d:
        message = (
            f"row {index} is [θ, d, a, α] in both conventions, and its star stands in the place of a or α"
        )
        faults.error(node.span, message, help)
        return {}
    cells = {
        column: read_cell(faults, item, f"{column} of row {index}", stars=column in _KINDS)
        for column, item in zip(COLUMNS, node.items, strict=True)
    }
    return {column: cell for column, cell in cells.items() if cell}


def _read_start(faults: Faults, fields: Fields, index: int) -> int | None:
    """The frame that a row starts from, None for the one before; one that is not before it is reported."""
    node = fields.get(START)
    if START not in fields or isinstance(node, FaultyNode):
        return None
    text = node.text.strip() if isinstance(node, ScalarNode) else ""
    if not (text.isdecimal() and int(text) < index):
        what = f"frames 0 to {index - 1}" if index > 1 else "frame 0"
        start = describe(node) if node and not text else text
        help = "write from: 0 for the base, or the number of an earlier row"
        faults.error(fields.span_of(START), f"row {index} starts from {start}, which is none of {what}", help)
        return None
    return None if int(text) == index - 1 else int(text)


def _stars(raw: list[_Raw]) -> list[_Star]:
    """Every starred name, in the order of the file."""
    found = [
        _Star(i, column, name.name, cell.span_of(name))
        for i, row in enumerate(raw, 1)
        for column, cell in row.cells.items()
        for name in cell.names
        if name.star
    ]
    return sorted(found, key=lambda star: star.span)


def _coordinates(faults: Faults, fields: Fields, raw: list[_Raw]) -> dict[str, str]:
    """The coordinates with their kinds, in order of first appearance or of the key `coordinates`."""
    first: dict[str, _Star] = {}
    for star in _stars(raw):
        before = first.setdefault(star.name, star)
        if before.column != star.column:
            message = (
                f"{star.name} stands in {star.column} here and in {before.column} of row {before.row}: "
                "a coordinate is an angle or a length"
            )
            faults.error(star.span, message, "give the two joints coordinates of their own")
    kinds = {name: _KINDS[star.column] for name, star in first.items()}
    whole = not any(row.faulty for row in raw)
    if not kinds and raw and whole:
        help = "mark the joint variables with a star: theta1* in theta, d2* in d"
        faults.error(fields.key_span("dh"), "no joint variable is marked in the table", help)
    return _ordered(faults, fields, kinds, whole)


def ordered_coordinates(faults: Faults, fields: Fields, kinds: dict[str, str]) -> tuple[tuple[str, str], ...]:
    """(name, kind) of the coordinates, in their order or that of the key `coordinates`."""
    return tuple(_ordered(faults, fields, kinds, whole=bool(kinds)).items())


def _ordered(faults: Faults, fields: Fields, kinds: dict[str, str], whole: bool) -> dict[str, str]:
    kinds = kinds | motor_coordinates(fields, kinds)
    if "coordinates" not in fields:
        return kinds
    example = f"write coordinates: [{', '.join(kinds)}]"
    order: dict[str, str] = {}
    for item, type in _listed(faults, fields.get("coordinates"), example):
        name = coordinate_name(faults, item, example)
        if name is None:
            continue
        if type and type.text != kinds.get(name, type.text):
            message = f"{name} is {kinds[name]} in the table, and {type.text} here"
            faults.error(type.span, message, "a star in theta makes it revolute, in d prismatic")
        if name in order:
            faults.error(item.span, f"{name} is listed twice", example)
        elif name in kinds:
            order[name] = kinds[name]
        elif whole:
            help = did_you_mean(name, kinds) or f"mark it in the table: {name}*"
            faults.error(item.span, f"{name} is not a joint variable of the table", help)
    missing = [name for name in kinds if name not in order]
    if missing and order:
        faults.error(fields.key_span("coordinates"), f"coordinates leaves out {', '.join(missing)}", example)
    return order | {name: kinds[name] for name in missing}


def _listed(
    faults: Faults, node: YamlNode | None, example: str
) -> Iterator[tuple[YamlNode, ScalarNode | None]]:
    """The names of a list, or those of a mapping with their types."""
    if not isinstance(node, MappingNode):
        for item in items(faults, node, "coordinates", example):
            yield item, None
        return
    for key, value in node.entries:
        kind = word(faults, value, tuple(_KINDS.values()), f"the type of {key.decoded}")
        yield key, value if kind and isinstance(value, ScalarNode) else None


def coordinate_name(faults: Faults, node: YamlNode, example: str) -> str | None:
    """The name of a coordinate, with or without its star; None (reported) where it is none."""
    if isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ScalarNode):
        faults.error(node.span, f"a coordinate is a name, not {describe(node)}", example)
        return None
    try:
        return normalize(node.text.removesuffix("*"))
    except ReadError as error:
        if set(node.text) & _OF_EXPRESSIONS:
            message = f"one coordinate is wanted here, and `{node.text[:40]}` is an expression"
            faults.error(node.span, message, example)
            return None
        at = node.start + error.offset
        faults.error((at, at + error.length), error.message, example)
        return None


_OF_EXPRESSIONS = frozenset("+-*/^()")


def known_coordinate(faults: Faults, node: YamlNode, coordinates: Collection[str], help: str) -> str | None:
    """A coordinate by its name, None (reported) where there is none of that name."""
    name = coordinate_name(faults, node, help)
    if name is None or name in coordinates:
        return name
    faults.error(node.span, f"{name[:40]} is no coordinate", did_you_mean(name, coordinates) or help)
    return None


def by_coordinate(
    faults: Faults, node: MappingNode, coordinates: Collection[str], help: str
) -> Iterator[tuple[str, YamlNode]]:
    """The entries of a mapping by coordinates; others are reported, those twice too."""
    met: set[str] = set()
    for key, value in node.entries:
        name = known_coordinate(faults, key, coordinates, help)
        if name in met:
            faults.error(key.span, f"{name} stands here already", "keep one of them")
        elif name:
            met.add(name)
            yield name, value


def _row(faults: Faults, index: int, raw: _Raw, coordinates: dict[str, str], modified: bool) -> DHRow:
    before, cells = len(faults.errors), raw.cells
    unstarred = _check_unstarred(faults, cells, coordinates)
    starred = [column for column in _KINDS if any(name.star for name in raw.names(column))]
    if len(starred) == 2:
        _cylindrical(faults, raw.span, cells, modified)
    variable = starred[0] if len(starred) == 1 else None
    rates = _rates(faults, cells[variable], coordinates) if variable and variable not in unstarred else {}
    # a theta whose joint variable was reported is not read as an angle too
    skipped = {"theta"} if variable == "theta" and not rates else set()
    columns = [column for column in ("theta", "alpha") if column in cells and column not in skipped]
    angles = {column: read_angle(faults, cells[column]) for column in columns}
    known = {column: angle for column, angle in angles.items() if angle is not None}
    faulty = raw.faulty or len(faults.errors) > before
    return DHRow(index, raw.span, cells, known, variable, rates, faulty, raw.branch)


def _check_unstarred(faults: Faults, cells: Mapping[str, Cell], coordinates: dict[str, str]) -> set[str]:
    """The columns in which a coordinate stands without its star (reported)."""
    found = set()
    for column, cell in cells.items():
        for name in cell.names:
            if name.star or name.name not in coordinates:
                continue
            message = f"the coordinate {name.name} stands without its star in {cell.what}"
            help = f"write {name.name}*"
            if column not in _KINDS:
                message = f"{cell.what} contains the coordinate {name.name}, but it is constant"
                help = "joint variables stand in theta and d; give this quantity another name"
            faults.error(cell.span_of(name), message, help)
            found.add(column)
    return found


def _rates(faults: Faults, cell: Cell, coordinates: dict[str, str]) -> dict[str, Fraction]:
    """The joint variable as a linear combination of coordinates."""
    try:
        rates = linear_rates(cell.tree, coordinates)
    except NotLinear as error:
        faults.error(cell.span, f"{cell.what}: {error.message}", error.help)
        return {}
    if not rates:
        faults.error(cell.span, f"the joint variable of {cell.what} cancels", "delete it, or mend the signs")
    return rates


def _cylindrical(faults: Faults, span: Span, cells: Mapping[str, Cell], modified: bool) -> None:
    """θ and d of one row are both starred: show the two rows that a cylindrical joint needs."""
    text = {column: " ".join(cell.text.split()) or "0" for column, cell in cells.items()}
    text = {column: text.get(column, "0") for column in COLUMNS}
    zero = dict.fromkeys(COLUMNS, "0")
    turning, sliding = zero | {"theta": text["theta"]}, zero | {"d": text["d"]}
    (turning if modified else sliding).update(a=text["a"], alpha=text["alpha"])
    rows = ["- {" + ", ".join(f"{c}: {row[c]}" for c in COLUMNS) + "}" for row in (turning, sliding)]
    message = "theta and d of one row are both joint variables; a cylindrical joint takes two rows"
    faults.error(span, message, f"write {rows[0]} and {rows[1]}")


def _check_effect(
    faults: Faults, rows: tuple[DHRow, ...], coordinates: dict[str, str], fields: Fields
) -> None:
    """A coordinate that no row turns or moves by (its rates were reported as cancelling)."""
    if any(row.faulty for row in rows):
        return
    moved = {name for row in rows for name, rate in row.rates.items() if rate}
    moved |= motor_coordinates(fields, moved).keys()
    for name in coordinates:
        if name not in moved:
            faults.error(
                fields.key_span("dh"),
                f"the coordinate {name} moves no joint",
                "mend the row that it stands in",
            )
