"""The printed sign of everything in a report, so that none stands for two things.

The names of the problem are kept as they are, and so are the shorthands s_1 and c_12.  A letter of the
textbook that would look like one of them is set otherwise:

- a scalar in another letter, the energy P_1 beside a length P_1 as U_1 (`SPONGS`, `OWN`), and the entry
  c_12 of C as C_12 wherever c_1 is a cosine: it would be read as cos(θ_1 + θ_2);
- a vector or a matrix is bold, on paper and in a terminal: the axis **z**_1 beside the coordinate z_1 of a
  mass centre, the term **g** beside the number g.

To give a letter another one, add it to one of these.  The choices are told in the list of notation
(`explain.notation_list`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import reduce
from itertools import chain, combinations, islice, product

from msgspec.structs import replace

from dynsolve.document import Block, Equations, Fold, Formula, List, Note, Table, Text, Uses
from dynsolve.explain.context import shown_digits, style_of
from dynsolve.explain.forms import parallel_coordinates
from dynsolve.explain.parameter_meanings import names_in
from dynsolve.explain.recurring import Definition
from dynsolve.notation.characters import GREEK
from dynsolve.notation.printing import Sign, Style, shorthand
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    children,
)
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import letters
from dynsolve.quantities.letters import OWN, SPONGS
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Robot
from dynsolve.robot.names import free_letter, names_taken, other_letters, spelled
from dynsolve.robot.units import NONE, Dimension, si, times

CONSTANTS_OF_SOLUTIONS = "ABDXY"
"""What a solution of inverse kinematics calls what stands beside its sines and cosines."""


MORE_DIGITS = 2
"""So many digits more than the longest number of the problem are shown: sums of what is printed add up."""


def report_style(robot: Robot, digits: int | None = None) -> Style:
    """The style of a report on a robot, in which every sign has one meaning.

    A model in numbers is shown with `digits` significant digits; without these, with a few more than the
    longest number of the problem has, so that a reader can follow each line from the one before it; beside
    letters a short fraction that comes to no end is one.  Where masses are letters, a number is a decimal
    if that comes to an end, and exact.
    """
    style = _with_free_shorthands(robot, style_of(robot))
    short = filter(None, (shorthand(node, style) for node in shorthands(robot, style)))
    taken = names_taken(robot).union(f"{letter}{index}".replace(",", "") for letter, index in short)
    found: dict[Sign, str] = {}
    for (base, count), others in (SPONGS | OWN).items():
        is_like_cosine = (base, count) == ("c", 2)  # c₁₂ of 𝐂 reads as one, with or without shorthands
        indices = tuple(_indices(robot, base, count))
        letter = free_letter(islice(other_letters(base, others), is_like_cosine, None), indices, taken)
        taken = taken.union(f"{letter}{index}" for index in indices)
        if letter != base:
            found[base, "italic", count] = letter
    decimal = style.decimal or digits is not None
    shown = digits or (shown_digits(robot) + MORE_DIGITS if decimal and robot.is_numeric else 0)
    gravity = {name for entry in robot.gravity.entries for name in names_in(entry)}
    has_letters = digits is None and not gravity.issuperset(robot.parameters)
    return replace(style, letters=found, bold=True, decimal=decimal, digits=shown, fractions=has_letters)


def _with_free_shorthands(robot: Robot, style: Style) -> Style:
    """The style; where a shorthand looks like a name of the problem, as c_12 for a length, without any."""
    own = (*robot.parameters, *(q.name for q in robot.coordinates))
    names = {UnicodePrinter().text(Symbol(name)) for name in own}
    write = UnicodePrinter(style).text
    clash = any(write(node) in names for node in shorthands(robot, style))
    return replace(style, shorthand={}) if clash else style


def shorthands(robot: Robot, style: Style) -> Iterator[Function]:
    """What the style writes as s_1 and c_12: sines and cosines of angles, and of sums in parallel joints."""
    for group in parallel_coordinates(robot):
        members = [Symbol(q.name) for q in robot.coordinates if q.name in group]
        sizes = range(1, len(members) + 1)
        for chosen in chain.from_iterable(combinations(members, size) for size in sizes):
            angle: Node = chosen[0] if len(chosen) == 1 else Sum(chosen)
            for name in ("sin", "cos"):
                if shorthand(node := Function(name, angle), style):
                    yield node


def _indices(robot: Robot, base: str, count: int) -> Iterable[str]:
    """The indices of a letter: bodies, points, coordinates or constraints, entries by coordinates."""
    bodies = [spelled(body.name) for body in robot.bodies]
    numbers = [*map(str, range(1, robot.n + 1))]
    match base:
        case "P":
            return (*bodies, "s")
        case "K":
            return (f"{part}{index}" for part in ("", "v", "omega") for index in (*bodies, "m", "i"))
        case "eta":
            return (*bodies, "i")
        case "m":  # of any body: those of the problem keep their names
            return ("i",)
        case "x" | "y" | "z":
            return ("tip", *(point.name for point in robot.questions.points))
        case "lambda":
            return map(str, range(1, len(robot.questions.constraints) + 1))
        case "tau":
            return (f"{part}{number}" for part in ("", "f", "static") for number in numbers)
        case "u":
            return "123"
        case "theta" | "d" | "a" | "alpha" if count == 1:  # columns, where these have the number of a row
            column = ("theta", "d", "a", "alpha").index(base)
            has_numbers = isinstance(letters.columns(robot, letters.COUNT)[0], Letter)
            named = ((str(joint.index), joint.written[column]) for joint in robot.joints if has_numbers)
            return (
                row for row, entry in named if entry not in (Symbol(f"{base}{row}"), Symbol(f"{base}_{row}"))
            )
    return map("".join, product(numbers, repeat=count))


# -- which signs occur in a document: names, shorthands and letters of the textbook, by their kinds
# A kind is what signs of one meaning share: K_{v_1} and K_{v_2} are ("K", "italic", "v#"), c_121 is
# ("c", "italic", "###"), the name l_1 is ("", "name", "l1").

Kind = tuple[str, str, str]
"""Base, style and shape of the indices; of a name ("", "name", the name)."""

TIME: Kind = ("", "name", "t")
TRANSPOSED: Kind = ("T", "raised", "")
"""The T over a matrix that is transposed."""

_SAME: dict[Kind, Kind] = {
    **{(letter, "bold", ""): (letter, "bold", "#") for letter in "xyzoA"},
    **{(letter, "bold", ""): (letter, "bold", "#^") for letter in "HR"},
    ("r", "bold", "c"): ("r", "bold", "c#"),
    **{("R", "bold", shape): ("R", "bold", "z#") for shape in ("ztheta", "x#", "y#")},
    **{("I", "bold", shape): ("I", "bold", "#") for shape in ("#^", "#given")},
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
        kind = kind_of(node, style) if isinstance(node, (Letter, Symbol, Function)) else None
        if kind is not None:
            found.add(kind)
        if isinstance(node, (Letter, Symbol)) and node.dots:
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


# -- the units of abbreviations, from the formulas that define them: σ₁ = m₂ l_c2² + I₂ is in kg m²


def units_of(robot: Robot, definitions: Iterable[Definition]) -> dict[str, list[str]]:
    """The names by their unit, in order; under the empty unit those of which it cannot be told.

    Nothing can be told where the problem gives numbers for lengths or masses: they hide their units.
    """
    known = Dimensions(robot.ring, robot)
    found: dict[Node, Dimension | None] = {}

    def of_symbol(symbol: Symbol) -> Dimension | None:
        if symbol in found:
            return found[symbol]
        return known.of(robot.ring.symbol(symbol.name, symbol.dots))

    by_unit: dict[str, list[str]] = {}
    for one in definitions:
        own = found[one.name] = _dimension(one.meaning, of_symbol) if known.known else None
        by_unit.setdefault("" if own is None else si(own), []).append(one.name.name)
    return by_unit


def _dimension(node: Node, of_symbol: Callable[[Symbol], Dimension | None]) -> Dimension | None:
    """The dimension of a formula; None where that of a part is unknown, or terms of a sum differ."""

    def of(part: Node) -> Dimension | None:
        return _dimension(part, of_symbol)

    match node:
        case Number() | Degrees() | Function("sin" | "cos"):
            return NONE
        case Symbol():
            return of_symbol(node)
        case Negative(part) | Parenthesized(part):
            return of(part)
        case Sum(terms):
            different = set(map(of, terms))
            return different.pop() if len(different) == 1 else None
        case Product(factors):
            return reduce(_multiplied, map(of, factors))
        case Power(base, Number(exponent, 1)):
            return _multiplied(NONE, of(base), exponent)
        case Quotient(above, below):
            return _multiplied(of(above), of(below), -1)
    return None


def _multiplied(a: Dimension | None, b: Dimension | None, power: int = 1) -> Dimension | None:
    return None if a is None or b is None else times(a, b, power)
