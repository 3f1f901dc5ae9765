"""Which signs occur in a document: names, shorthands and letters of the textbook, by their kinds.

A kind is what signs of one meaning share: K_{v_1} and K_{v_2} are ("K", "italic", "v#"), c_121 is
("c", "italic", "###"), the name l_1 is ("", "name", "l1").
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from dynsolve.document import Block, Equations, Fold, Formula, List, Note, Table, Text, Uses
from dynsolve.notation.characters import GREEK
from dynsolve.notation.printing import Style, shorthand
from dynsolve.notation.tree import Function, Letter, Node, Row, Symbol, Transpose, Words
from dynsolve.notation.walk import children

Kind = tuple[str, str, str]
"""Base, style and shape of the indices; of a name ("", "name", the name)."""

TIME: Kind = ("", "name", "t")
TRANSPOSED: Kind = ("T", "raised", "")
"""The T over a matrix that is transposed."""

_SAME: dict[Kind, Kind] = {
    ("x", "bold", ""): ("x", "bold", "#"),
    ("y", "bold", ""): ("y", "bold", "#"),
    ("z", "bold", ""): ("z", "bold", "#"),
    ("o", "bold", ""): ("o", "bold", "#"),
    ("A", "bold", ""): ("A", "bold", "#"),
    ("H", "bold", ""): ("H", "bold", "#^"),
    ("R", "bold", ""): ("R", "bold", "#^"),
    ("r", "bold", "c"): ("r", "bold", "c#"),
    ("R", "bold", "ztheta"): ("R", "bold", "z#"),
    ("R", "bold", "x#"): ("R", "bold", "z#"),
    ("R", "bold", "y#"): ("R", "bold", "z#"),
    ("I", "bold", "#^"): ("I", "bold", "#"),
    ("I", "bold", "#given"): ("I", "bold", "#"),
}
"""Kinds that mean the same: an axis or a matrix without its number, a rotation about another axis."""

MOTIONS = ("Rot", "Trans")
"""The names of the motions of a row of the table."""


def index_shape(node: Node | None) -> str:
    """The shape of indices: `#` for what counts, `v` and `omega` for what says which.

    >>> from dynsolve.notation.tree import Number
    >>> index_shape(Row((Words("c"), Number(1)))), index_shape(Letter("v", Symbol("i")))
    ('c#', 'v#')
    """
    match node:
        case None:
            return ""
        case Row(parts):
            return "".join(map(index_shape, parts))
        case Letter(base, sub):
            return base + index_shape(sub)
        case Words(text):
            text = text.strip()
            return "" if text == "," else text
        case Symbol(name) if name in GREEK or name == "r":  # r is the task, in J_r
            return name
    return "#"


def kind_of(node: Node, style: Style) -> Kind | None:
    """The kind of a sign; None for what is none."""
    match node:
        case Letter(base, _, _, "upright"):  # the name of a motion, or a unit, which is no sign
            return (base, "upright", "") if base in MOTIONS else None
        case Letter(base, sub, sup, kind):
            raised = "^" if sup is not None else ""
            found = base, kind, index_shape(sub) + raised
            return _SAME.get(found, found)
        case Symbol(name):
            return None if name == "pi" else ("", "name", name)
        case Function() if short := shorthand(node, style):
            return short[0], "shorthand", short[1]
    return None


def kinds_in(nodes: Iterable[Node], style: Style) -> set[Kind]:
    """The kinds of all signs that are printed; what trees share is looked at once."""
    found: set[Kind] = set()
    seen: set[int] = set()
    pending = list(nodes)
    while pending:
        node = pending.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        kind = kind_of(node, style)
        if kind is not None:
            found.add(kind)
        if isinstance(node, Letter | Symbol) and node.dots:
            found.add(TIME)  # a dot is a derivative by it
        if isinstance(node, Transpose):
            found.add(TRANSPOSED)
        if not (isinstance(node, Letter) or (kind and kind[1] == "shorthand")):
            pending += children(node)
    return found


def formulas_in(blocks: Iterable[Block]) -> Iterator[Node]:
    """Every formula of a document, displayed or among words."""
    for block in blocks:
        match block:
            case Formula(node, _, entries):
                yield node
                yield from (name for row in entries for name in row)
            case Equations(nodes):
                yield from nodes
            case Text(parts) | Note(parts) | Uses(_, parts):
                yield from (part for part in parts if isinstance(part, Node))
            case List(items):
                yield from (part for item in items for part in item if isinstance(part, Node))
            case Table(header, rows):
                yield from (cell for row in (header, *rows) for cell in row if isinstance(cell, Node))
            case Fold(_, inner):
                yield from formulas_in(inner)
