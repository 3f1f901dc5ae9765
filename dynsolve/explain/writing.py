"""Pieces of formulas and sentences that several stages write."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import islice
from types import MappingProxyType

from dynsolve.document import Inline, Prose
from dynsolve.notation.build import split_sign
from dynsolve.notation.tree import (
    ZERO,
    BigSum,
    Letter,
    Matrix,
    Node,
    Number,
    Row,
    Sum,
    Symbol,
    Words,
    mapped,
    walk,
)
from dynsolve.robot import units
from dynsolve.robot.model import Body, Coordinate, JointType, Robot

LARGEST_WORKING = 260
"""Matrices whose entries have more parts than this are not put into a formula; it stays in letters."""


def turns(q: Coordinate) -> bool:
    """Whether a coordinate is an angle."""
    return q.type is JointType.REVOLUTE


def machine(robot: Robot) -> str:
    """What moves, in a sentence."""
    return "arm" if robot.has_table else "mechanism"


def name_of(body: Body) -> str:
    """The name of a body in a sentence."""
    return f"body {body.name}"


def are_counted(bodies: Sequence[Body]) -> bool:
    """Whether bodies are called 1, 2, ..., as a sum over them counts."""
    return [body.name for body in bodies] == [str(place) for place in range(1, len(bodies) + 1)]


def listed(parts: Sequence[Prose | Node | str], conjunction: str = "and") -> Prose:
    """a, b and c

    >>> listed(["a", "b", "c"])
    ('a', ', ', 'b', ' and ', 'c')
    """
    prose: list[Inline] = []
    for i, part in enumerate(parts):
        if i:
            prose.append(f" {conjunction} " if i == len(parts) - 1 else ", ")
        prose += list(part) if isinstance(part, tuple) else [part]
    return tuple(prose)


def and_joined(names: Sequence[str]) -> str:
    """a, b and c

    >>> and_joined(["1"]), and_joined(["1", "2", "3"])
    ('1', '1, 2 and 3')
    """
    return "".join(part for part in listed(names) if isinstance(part, str))


def agreeing(text: str, count: int) -> str:
    """A sentence of one or of several things, from "singular|plural" where they differ.

    >>> agreeing("Branch|Branches 2 is|are not real", 1), agreeing("Branch|Branches 1, 2 is|are not real", 2)
    ('Branch 2 is not real', 'Branches 1, 2 are not real')
    """
    return re.sub(r"(\w+)\|(\w+)", r"\1" if count == 1 else r"\2", text)


def side_by_side(parts: Sequence[Node]) -> Node:
    """Formulas on one line, commas between them; one alone as it is."""
    if len(parts) == 1:
        return parts[0]
    row: list[Node] = []
    for part in parts:
        row += [part] if not row else [Words(", "), part]
    return Row(tuple(row))


def as_row(prose: Prose) -> Row:
    """Words and formulas as one formula."""
    return Row(tuple(part if isinstance(part, Node) else Words(str(part)) for part in prose))


def scalar(form: Node) -> Node:
    """The entry of a 1×1 matrix: what there is one of is written as a number.  Other forms as they are."""
    match form:
        case Matrix(((entry,),)):
            return entry
    return form


def measured(form: Node, unit: str) -> Node:
    """A number with its unit: 2.5 kg.  Other forms, and 0, as they are."""
    if not isinstance(split_sign(form)[1], Number) or form == ZERO:
        return form
    return Row((form, Words(" "), units.node(unit)))


def sum_of(terms: Sequence[Node]) -> Node:
    """The sum of terms as they are; 0 of none."""
    if not terms:
        return ZERO
    return terms[0] if len(terms) == 1 else Sum(tuple(terms))


def counted_sum(body: Node, index: Node, count: int, own: Mapping[Node, Node] = MappingProxyType({})) -> Node:
    """Σ_{index=1}^{count} body; of one its index put in, and `own`, what its letters are called."""
    if count > 1:
        return BigSum(body, index, Number(1), Number(count))
    named = mapped(body, lambda node: own.get(node, node))
    return mapped(named, lambda node: Number(1) if node == index else node)


def sum_over_coordinates(body: Node, index: Node, robot: Robot) -> Node:
    """Σ_{index=1}^{n} body; a single coordinate is called by its name."""
    name = robot.coordinates[0].name
    own: dict[Node, Node] = {Letter("q", index, dots=dots): Symbol(name, dots) for dots in (0, 1)}
    return counted_sum(body, index, robot.n, own)


def column_of(matrix: Matrix, j: int) -> Matrix:
    """A column of a tree."""
    return Matrix(tuple((row[j],) for row in matrix.rows))


def block_of(matrix: Matrix, rows: int, first: int, last: int) -> Matrix:
    """The first rows of some columns of a tree."""
    return Matrix(tuple(row[first:last] for row in matrix.rows[:rows]))


def is_small(*nodes: Node) -> bool:
    """Whether trees are small enough to be put into a formula and still be read."""
    return next(islice(walk(*nodes), LARGEST_WORKING, None), None) is None


def flat(entries: Iterable[Node]) -> Node:
    """(v_x, v_y): a column as a line of text can hold it, its commas nearer than those of a list."""
    parts: list[Node] = []
    for entry in entries:
        parts += [Words(",\N{NO-BREAK SPACE}"), entry] if parts else [entry]
    return Row((Words("("), *parts, Words(")")))
