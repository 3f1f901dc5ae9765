"""The names of a problem file: one name is one thing.

What a symbol is follows from where it stands alone: a mass under `mass`, a length
under `a`, an angle under `alpha`.  A name that is two of these is an error, and so
is one that JSON writes for a coordinate's derivative.
"""

from __future__ import annotations

from collections.abc import Iterator

from msgspec import Struct

from dynsolve.algebra.rationals import rational_value
from dynsolve.notation.text import Name
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Parenthesized,
    Product,
    Quotient,
    Sum,
    Symbol,
    walk,
)
from dynsolve.problem.cells import Cell, denominators
from dynsolve.problem.model import ParsedFile
from dynsolve.problem.yaml_nodes import Faults

MAX_SYMBOLS = 500
"""A six-axis arm with ten inertial parameters a link has about 70."""

MAX_PARTS = {"denominators": 60, "roots": 60, "sines and cosines": 300}
"""How many different ones of each a file may have."""

_SUFFIXES = (("_dot", "velocity"), ("_ddot", "acceleration"))


class Role(Struct, frozen=True):
    """The role of a symbol where it stands alone: a mass, a length, an angle, ..."""

    name: str
    kind: str
    cell: Cell
    place: Name | None


def roles(parsed: ParsedFile) -> Iterator[Role]:
    """The roles of all symbols that stand alone in a cell, or as a term of a sum there."""
    for kind, cell in _kinds(parsed):
        for name in sorted(_terms(cell.tree)):
            place = next((found for found in cell.names if found.name == name), None)
            yield Role(name, kind, cell, place)


def _kinds(parsed: ParsedFile) -> Iterator[tuple[str, Cell]]:
    for row in parsed.table.rows:
        for column, cell in row.cells.items():
            yield ("an angle" if column in ("theta", "alpha") else "a length"), cell
    for rotation in parsed.rotations:
        for turn in rotation.turns:
            yield "an angle", turn.cell
    for one in sorted(parsed.stated, key=lambda one: one.role != "an angle"):
        if one.role:
            yield one.role, one.cell
    for point in parsed.questions.points:
        if point.place and point.place.kind != "along":
            yield from (("a length", cell) for cell in point.place.cells)
    yield from ((one.role, one.cell) for one in parsed.decoded if one.role)
    yield from (("a length", cell) for cell in parsed.base.move or ())
    yield from (("an acceleration", cell) for cell in parsed.gravity or ())


def _terms(node: Node) -> set[str]:
    """The names that a formula is, or adds: their dimension is that of the whole."""
    match node:
        case Symbol("pi"):
            return set()
        case Symbol(name):
            return {name}
        case Negative(argument) | Parenthesized(argument):
            return _terms(argument)
        case Sum(terms):
            return set().union(*map(_terms, terms))
        case Quotient(numerator, denominator) if rational_value(denominator) is not None:
            return _terms(numerator)
        case Product(factors):
            rest = [factor for factor in factors if rational_value(factor) is None]
            return _terms(rest[0]) if len(rest) == 1 else set()
    return set()


def check_size(faults: Faults, parsed: ParsedFile) -> bool:
    """Whether the file is small enough for exact algebra; what goes over a bound is reported."""
    symbols: set[str] = set()
    parts: dict[str, set[Node]] = {what: set() for what in MAX_PARTS}
    for cell in parsed.cells:
        for name in cell.names:
            symbols.add(name.name)
            if len(symbols) > MAX_SYMBOLS:
                message = f"{name.name} is one symbol too many: at most {MAX_SYMBOLS} are read"
                faults.error(cell.span_of(name), message, "put numbers for some")
                return False
        for what, node in _parts(cell.tree):
            parts[what].add(node)
            if len(parts[what]) > MAX_PARTS[what]:
                message = f"more than {MAX_PARTS[what]} different {what}, the last of them here"
                faults.error(cell.span, message, "name some of them with symbols of their own")
                return False
    return True


def _parts(tree: Node) -> Iterator[tuple[str, Node]]:
    """The parts that make exact algebra long: each denominator, root, sine and cosine."""
    yield from (("denominators", node) for node in denominators(tree) if rational_value(node) is None)
    for node in walk(tree):
        if isinstance(node, Function):
            yield ("roots" if node.name == "sqrt" else "sines and cosines"), node


def check_symbols(faults: Faults, parsed: ParsedFile) -> None:
    """Report names that are two things."""
    _check_derivatives(faults, parsed)
    first: dict[str, Role] = {}
    told: set[str] = set()
    for role in roles(parsed):
        before = first.setdefault(role.name, role)
        if before.kind == role.kind or role.name in told or role.name in parsed.table.names:
            continue
        if {before.kind, role.kind} == {"a mass", "a moment of inertia"}:
            continue  # with unit lengths an exercise may write m/12 for a moment of inertia
        told.add(role.name)
        here, there = (before, role) if role.place is None or not role.cell.text else (role, before)
        where = (
            f"line {faults.source.position(there.cell.start)[0]}"
            if there.cell.text
            else "the default gravity"
        )
        message = f"{role.name} is {here.kind} here and {there.kind} in {where}"
        place = here.cell.span_of(here.place) if here.place else here.cell.span
        help = "give the two things names of their own"
        if not there.cell.text:
            help = "give gravity another letter, or write gravity: none"
        faults.error(place, message, help)


def _check_derivatives(faults: Faults, parsed: ParsedFile) -> None:
    meanings = {
        name + suffix: f"the {what} of {name}" for name in parsed.table.names for suffix, what in _SUFFIXES
    }
    told: set[str] = set()
    for cell in parsed.cells:
        for name in cell.names:
            if name.name in meanings and name.name not in told:
                told.add(name.name)
                message = f"{name.name} is {meanings[name.name]} in every result, and cannot be a parameter"
                faults.error(cell.span_of(name), message, "give the parameter another name")
