"""Expressions in a problem file: read where they stand, their errors at the very character.

Expressions in which rates of coordinates may stand: x' or x_dot.

Expressions in which coordinates of points may stand: tip.x, P.y.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from math import pi

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.errors import AlgebraError, ReadError
from dynsolve.notation.text import Name, rational, read, tokens
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Power,
    Quotient,
    Reference,
    Symbol,
    mapped,
    names_in,
    walk,
)
from dynsolve.problem.kinds import describe, did_you_mean
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, ScalarNode, Span, YamlNode, too_many
from dynsolve.robot.questions import TIP, coordinate_of


class Cell(Struct, frozen=True):
    """An expression of the file: what it is called in messages, its tree, its names, its place."""

    what: str
    tree: Node
    names: tuple[Name, ...]
    text: str
    start: int

    @property
    def span(self) -> Span:
        """Where it stands."""
        return self.start, self.start + len(self.text)

    def span_of(self, name: Name) -> Span:
        """Where one of its names stands."""
        return self.start + name.offset, self.start + name.offset + name.length


def made_cell(what: str, text: str, start: int = 0) -> Cell:
    """The cell of a default, which stands nowhere in the file."""
    reading = read(text)
    return Cell(what, reading.tree, reading.names, "", start)


def read_cell(
    faults: Faults, node: YamlNode | None, what: str, *, stars: bool = False, arcs: bool = False
) -> Cell | None:
    """The expression of a node, None (reported) where it cannot be read.

    `stars` says that a joint variable may be marked here, `arcs` that it may hold acos, atan2 and the like.
    """
    if node is None or isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ScalarNode):
        faults.error(
            node.span, f"{what} is an expression, not {describe(node)}", "write a number, a name or a formula"
        )
        return None
    if not node.text.strip():
        faults.error(node.span, f"{what} has no value", "write one, or delete the key")
        return None
    return read_text(faults, node.text, node.start, what, stars=stars, arcs=arcs)


def read_text(
    faults: Faults, text: str, start: int, what: str, *, stars: bool = False, arcs: bool = False
) -> Cell | None:
    """The expression that stands at character `start` of the file, None (reported) where it is unreadable."""
    try:
        reading = read(text, stars=stars, arcs=arcs)
    except ReadError as error:
        if stars or not _report_star(faults, text, start, what):
            at = start + error.offset
            faults.error((at, at + error.length), error.message, error.help)
        return None
    return Cell(what, reading.tree, reading.names, text, start)


def _report_star(faults: Faults, text: str, start: int, what: str) -> bool:
    """Whether the text would be readable with marks of joint variables, which have no place here."""
    try:
        marked = [name for name in read(text, stars=True).names if name.star]
    except ReadError:
        return False
    for name in marked:
        at = start + name.offset
        message = f"`{name.name}*` marks a joint variable, but {what} is constant"
        help = f"joint variables stand in theta (revolute) and d (prismatic); here write {name.name}"
        faults.error((at, at + name.length + 1), message, help)
    return bool(marked)


def read_vector(faults: Faults, node: YamlNode | None, what: str) -> tuple[Cell, ...] | None:
    """Three expressions [x, y, z], None (reported) where they are none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ListNode):
        faults.error(node.span, f"{what} is a list [x, y, z], not {describe(node)}", "write three components")
        return None
    if len(node.items) != 3:
        message = f"{what} has {len(node.items)} components, not 3"
        faults.error(node.span, message, too_many(node, "write [x, y, z]"))
        return None
    cells = tuple(
        read_cell(faults, item, f"{what}, {axis}") for item, axis in zip(node.items, "xyz", strict=True)
    )
    return None if None in cells else tuple(cell for cell in cells if cell)


def read_expressions(faults: Faults, node: YamlNode | None, what: str, help: str) -> tuple[Cell, ...] | None:
    """A list of expressions, None (reported) where it is none, or is not given."""
    if node is None or isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ListNode) or not node.items:
        faults.error(node.span, f"{what} is a list of expressions, not {describe(node)}", help)
        return None
    cells = [read_cell(faults, item, f"{what}, component {i}") for i, item in enumerate(node.items, 1)]
    return None if None in cells else tuple(cell for cell in cells if cell)


def read_matrix(faults: Faults, node: ListNode, what: str) -> tuple[tuple[Cell, ...], ...] | None:
    """A 3×3 list of rows, None (reported) where it is none."""
    if len(node.items) != 3:
        faults.error(
            node.span, f"{what} has {len(node.items)} rows, not 3", "write [[..., ..., ...], [...], [...]]"
        )
        return None
    rows = [_matrix_row(faults, row, f"{what}, row {i}") for i, row in enumerate(node.items, 1)]
    return None if None in rows else tuple(row for row in rows if row)


def _matrix_row(faults: Faults, node: YamlNode, what: str) -> tuple[Cell, ...] | None:
    if isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ListNode) or len(node.items) != 3:
        found = f"{len(node.items)} entries" if isinstance(node, ListNode) else describe(node)
        help = "write [..., ..., ...]"
        help = too_many(node, help) if isinstance(node, ListNode) else help
        faults.error(node.span, f"{what}: three entries are expected, not {found}", help)
        return None
    cells = [read_cell(faults, item, what) for item in node.items]
    return None if None in cells else tuple(cell for cell in cells if cell)


def read_angle(faults: Faults, cell: Cell) -> Angle | None:
    """The angle that a cell is, None (reported) where it is none: a bare number above all."""
    try:
        return angle_from_tree(cell.tree)
    except AlgebraError as error:
        for start, end, text in _bare_numbers(cell) if "bare number" in error.message else ():
            message = f"the bare number {text} stands as an angle"
            faults.error((cell.start + start, cell.start + end), message, _in_degrees(text))
            return None
        faults.error(cell.span, f"{cell.what}: {error.message}", error.help)
    return None


def _bare_numbers(cell: Cell) -> Iterator[tuple[int, int, str]]:
    """The numbers of a formula that are terms by themselves, save 0."""
    if not cell.text:
        return
    found = tokens(cell.text)
    kinds = ["+", *(token.kind for token in found)]
    for before, token, after in zip(kinds, found, kinds[2:], strict=False):
        alone = before in ("+", "-", "(") and after in ("+", "-", ")", "end")
        if token.kind == "number" and alone and rational(token):
            yield token.start, token.end, token.text


def _in_degrees(text: str) -> str:
    """The angle that a bare number probably means: degrees, or radians of a multiple of 15 degrees."""
    degrees = float(text) * 180 / pi
    whole = round(degrees / 15) * 15
    meant = whole if whole and abs(degrees - whole) < 0.05 else text
    return f"did you mean {meant}deg? Angles are written in degrees (90deg) or with pi (pi/2)"


def denominators(node: Node) -> Iterator[Node]:
    """The denominators of an expression."""
    for part in walk(node):
        match part:
            case Quotient(_, denominator):
                yield denominator
            case Power(base, Negative()):
                yield base
            case Function("tan", argument):
                yield argument


def forbid(faults: Faults, cells: Iterable[Cell | None], coordinates: Iterable[str], help: str) -> None:
    """Report every coordinate in cells that must be constant."""
    for cell in cells:
        for name in cell.names if cell else ():
            if cell and name.name in coordinates:
                message = f"{cell.what} contains the coordinate {name.name}"
                faults.error(cell.span_of(name), message, help)


# Expressions in which rates of coordinates may stand: x' or x_dot

_PRIMES = re.compile(r"(?<=\w)'{1,2}")


def read_rate_cell(
    faults: Faults, node: YamlNode | None, what: str, coordinates: Collection[str]
) -> Cell | None:
    """The expression of a node, None (reported) where it cannot be read; its names are those of no rate."""
    if not isinstance(node, ScalarNode) or not node.text.strip():
        return read_cell(faults, node, what)
    text = _PRIMES.sub(_spelled_out, node.text)
    try:
        reading = read(text, dots=True)
    except ReadError as error:
        at, end = (node.start + _place(node.text, error.offset + k) for k in (0, error.length))
        faults.error((at, max(end, at + 1)), error.message, error.help)
        return None
    rates = {f"{part.name}_{'d' * part.dots}ot": part for part in _rates(reading.tree)}
    cell = Cell(what, reading.tree, (), node.text, node.start)
    names = [_placed(node.text, name) for name in reading.names]
    for name in names:
        if name.name in rates and not _is_rate(faults, cell, name, rates[name.name], coordinates):
            return None
    return replace(cell, names=tuple(name for name in names if name.name not in rates))


def _spelled_out(primes: re.Match[str]) -> str:
    return f"_{'d' * len(primes[0])}ot"


def _rates(tree: Node) -> list[Symbol]:
    return [part for part in walk(tree) if isinstance(part, Symbol) and part.dots]


def _is_rate(faults: Faults, cell: Cell, name: Name, rate: Symbol, coordinates: Collection[str]) -> bool:
    """Whether it is the first derivative of a coordinate; what it is else is reported."""
    if rate.name not in coordinates:
        message = f"{rate.name} is no coordinate, and so has no rate"
        help = f"coordinates are {', '.join(coordinates)}"
    elif rate.dots > 1:
        message = f"the acceleration of {rate.name} stands in {cell.what}"
        help = "energies hold coordinates and rates alone"
    else:
        return True
    faults.error(cell.span_of(name), message, help)
    return False


def _placed(text: str, name: Name) -> Name:
    """A name where it stands in the text before its primes were spelled out."""
    start, end = _place(text, name.offset), _place(text, name.offset + name.length)
    return replace(name, offset=start, length=end - start)


def _place(text: str, offset: int) -> int:
    """The place in the text of a character of it with its primes spelled out."""
    for primes in _PRIMES.finditer(text):
        if primes.start() >= offset:
            break
        longer = len(_spelled_out(primes)) - len(primes[0])
        offset -= min(longer, offset - primes.start())
    return offset


# Expressions in which coordinates of points may stand: tip.x, P.y

_COORDINATE = re.compile(r"(?<![\w.])([A-Za-z]\w*)\.([xyz])(?!\w)")


def read_point_expression(
    faults: Faults, node: YamlNode, what: str, points: Collection[str], coordinates: Collection[str]
) -> Cell | None:
    """An expression in which P.x is a coordinate of a point; what is wrong with it is reported.

    A `Reference` stands for that coordinate.  Nothing that moves may stand in a denominator.
    """
    dotted = list(_COORDINATE.finditer(node.text)) if isinstance(node, ScalarNode) else []
    for found in dotted:
        if found[1] not in (TIP, *points):
            start = node.start + found.start() if isinstance(node, ScalarNode) else 0
            help = did_you_mean(found[1], (TIP, *points)) or "points are the tip and those of `points:`"
            faults.error((start, start + len(found[1])), f"there is no point {found[1]}", help)
            return None
    plain = replace(node, text=_COORDINATE.sub(r"\1_\2", node.text)) if isinstance(node, ScalarNode) else node
    cell = read_cell(faults, plain, what)
    if cell is None:
        return None
    places = {found.start() for found in dotted}
    meant = {f"{found[1]}_{found[2]}": coordinate_of(found[1], "xyz".index(found[2])) for found in dotted}

    def with_references(part: Node) -> Node:
        return meant.get(part.name, part) if isinstance(part, Symbol) else part

    names = tuple(name for name in cell.names if name.offset not in places)
    sound = replace(cell, tree=mapped(cell.tree, with_references), names=names)
    return sound if _is_polynomial(faults, sound, coordinates) else None


def _is_polynomial(faults: Faults, cell: Cell, coordinates: Collection[str]) -> bool:
    """Whether no coordinate, and no coordinate of a point, stands in a denominator or under a root."""
    roots = [part for part in walk(cell.tree) if isinstance(part, Function) and part.name == "sqrt"]
    for part in (*denominators(cell.tree), *roots):
        if names_in(part) & set(coordinates) or any(isinstance(p, Reference) for p in walk(part)):
            message = f"{cell.what}: a coordinate stands in a denominator or under a root"
            faults.error(cell.span, message, "it is made of sums, products, sines and cosines")
            return False
    return True
