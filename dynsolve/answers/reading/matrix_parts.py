r"""One row or one column of a matrix, as programs name it: `D(1,:) = [...]`, and the entries as written.

V_1, V_2, or n_1(q, \dot q): the entries of the vector C q̇, where a report gives it row by row.

V_1 is a potential energy too, and h_1 may be anything: what they are is seen when all rows are
there, hold velocities, and an inertia matrix or gravity terms stand beside them, but no energies.

Values in the shape of the answers they are given for: columns, zeros, the parts of a model.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.answers.reading.displays import pieces
from dynsolve.answers.reading.grammar.formula import FormulaReader
from dynsolve.answers.reading.grammar.references import skip_arguments
from dynsolve.answers.reading.grids import Grid, Value, symbols_in, transposed
from dynsolve.answers.reading.left_side import NamedAnswers, read_left_side
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.answers.verdict import Answer, NotRecognized, Place
from dynsolve.errors import ReadError
from dynsolve.notation.characters import split
from dynsolve.notation.tree import (
    ZERO,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
    names_in,
)
from dynsolve.notation.unicode import UnicodePrinter, printable
from dynsolve.quantities import families
from dynsolve.quantities.index import Quantities
from dynsolve.questions.parameters import REFERENCE

_ALL = frozenset({":", "*", "cdot"})
_CLOSING = {"(": ")", "{": "}"}


_BY_RATES = r"(?:frac)?(?:d|partial)L/?(?:d|partial)(?:dotq|q'|qd|qdot)"
_DERIVATIVES = {
    "dLdqd": re.compile(_BY_RATES),
    "dLdq": re.compile(r"(?:frac)?(?:d|partial)L/?(?:d|partial)q"),
    "ddt": re.compile(rf"(?:frac)?d/?dt(?:{_BY_RATES})?"),
}
_LONGEST_DERIVATIVE = 24


def _derivatives(vocabulary: Vocabulary, member: list[Token]) -> tuple[str, ...]:
    """The derivatives of L by all coordinates, which a left side names at once: ∂L/∂q̇, `dLdqd`."""
    if len(member) > _LONGEST_DERIVATIVE or len(vocabulary.coordinates) < 2 or "q" in vocabulary.symbols:
        return ()
    text = "".join(token.text + "'" * token.dots for token in member if token.kind not in "{}()")
    kinds = [kind for kind, pattern in _DERIVATIVES.items() if pattern.fullmatch(text)]
    names = tuple(f"{kind}{q.index}" for kind in kinds for q in vocabulary.coordinates)
    return names if all(map(vocabulary.is_answer, names)) else ()


def part_of(vocabulary: Vocabulary, member: list[Token]) -> tuple[str, ...]:
    """The answers whose values stand below or beside each other where a left side names all of them.

    The entries of a row or a column of a matrix, or the derivatives of L; none of every other side.
    """
    if derivatives := _derivatives(vocabulary, member):
        return derivatives
    if not 6 <= len(member) <= 10 or member[-2].kind not in (*_ALL, "number"):
        return ()
    opening = len(member) - 5
    index = member[opening + 1 : -1]
    if _CLOSING.get(member[opening].kind) != member[-1].kind or index[1].kind != ",":
        return ()
    name = member[:opening]
    name = name[:-1] if name[-1].kind == "_" else name
    side = read_left_side(vocabulary, name)
    if not isinstance(side, NamedAnswers) or len({t.kind in _ALL for t in (index[0], index[2])}) == 1:
        return ()
    axis = 0 if index[2].kind in _ALL else 1
    number = index[2 * axis].text
    parts = vocabulary.quantities.parts(side.candidates[0])
    places = {part: vocabulary.quantities.entry_of(part)[1] for part in parts}
    return tuple(part for part, at in places.items() if len(at) == 2 and str(at[axis] + 1) == number)


def written_entries(tokens: list[Token]) -> list[list[list[Token]]]:
    """The tokens of each entry of a matrix that is written out, row by row; none of anything else."""
    if len(tokens) > 4 and tokens[0].kind in ("[", "(") and tokens[1].kind == "begin":
        tokens = tokens[1:-1]
    if len(tokens) < 3 or (tokens[0].kind, tokens[-1].kind) not in (("begin", "close"), ("[", "]")):
        return []
    inside = tokens[1:-1]
    if tokens[0].kind == "begin":
        return [pieces(row, "&") for row in filter(None, pieces(inside, "\\\\"))]
    is_nested = inside[0].kind == "["
    rows = filter(None, pieces(inside, "," if is_nested else ";"))
    return [list(filter(None, pieces(row[1:-1] if is_nested else row, ","))) for row in rows]


# V_1, V_2, or n_1(q, \dot q)

_ENTRY = re.compile(r"([VNnhcC])([1-9])")
_LETTERS = frozenset("VNnhcC")
_ONLY_WITH_ARGUMENTS = frozenset({"c", "C"})
_ENERGIES = re.compile(r"K.*|L|dL.*")


class Entry(Struct, frozen=True):
    """Which row of which vector a left side names; `is_sure` where its arguments say so."""

    letter: str
    row: int
    is_sure: bool


def entry_of(vocabulary: Vocabulary, member: list[Token]) -> Entry | None:
    """The entry of C q̇ that a left side may name, None for every other side."""
    if len(member) > 40 or member[0].text[:1] not in _LETTERS:
        return None
    reader = FormulaReader(member, vocabulary, naming=True)
    if not reader.begins_with_name():
        return None
    try:
        form = reader.form()
        bare = reader.token.kind == "end"
        skip_arguments(reader)
    except ReadError:
        return None
    found = _ENTRY.fullmatch(form.key)
    if found is None or form.scripts.any or form.dots or reader.token.kind != "end":
        return None
    row = int(found[2])
    if row > len(vocabulary.coordinates) or (bare and found[1] in _ONLY_WITH_ARGUMENTS):
        return None
    return Entry(found[1], row, not bare)


class VectorEntries(Struct):
    """The entries of C q̇ in one hand-in, by letter and row."""

    vocabulary: Vocabulary
    rows: dict[str, dict[int, Answer]] = field(default_factory=dict)
    refused: dict[str, list[NotRecognized]] = field(default_factory=dict)

    def keep(self, entry: Entry, answer: Answer, refused: NotRecognized) -> None:
        """Keep one entry until the whole file is known."""
        self.rows.setdefault(entry.letter, {})[entry.row] = answer
        if entry.is_sure:
            self.refused.setdefault(entry.letter, []).append(refused)

    def settled(
        self, answers: list[Answer], printer: UnicodePrinter
    ) -> tuple[list[Answer], list[NotRecognized]]:
        """The answers with the vector in the place of its entries, and what no vector was made of."""
        lost: list[NotRecognized] = []
        for letter, rows in self.rows.items():
            if self._is_vector(letter, rows, {answer.name for answer in answers}):
                own = {answer.occurrence for answer in rows.values()}
                kept = [answer for answer in answers if answer.occurrence not in own]
                answers = [*kept, column("Cqd", rows, printer)]
            else:
                lost += self.refused.get(letter, [])
        return answers, lost

    def _is_vector(self, letter: str, rows: dict[int, Answer], given: set[str]) -> bool:
        if len(rows) < len(self.vocabulary.coordinates) or "Cqd" in given:
            return False
        nodes = [answer.node for answer in rows.values()]
        if not all(node is not None for node in nodes):
            return False
        if letter in self.refused:
            return True
        beside = {"D", "g", "d11", "g1"} & given and not any(_ENERGIES.fullmatch(name) for name in given)
        symbols = [symbol for node in nodes if node is not None for symbol in symbols_in(node)]
        return bool(beside) and any(symbol.dots == 1 for symbol in symbols)


def column(name: str, rows: dict[int, Answer], printer: UnicodePrinter) -> Answer:
    """The column of the entries, as one answer of that name."""
    ordered = [rows[row] for row in sorted(rows)]
    node = Matrix(tuple((answer.node,) for answer in ordered if answer.node is not None))
    return replace(
        ordered[0],
        name=name,
        node=node,
        text="; ".join(answer.text for answer in ordered),
        read_as=printer.text(node),
        notes=tuple(dict.fromkeys(note for answer in ordered for note in answer.notes)),
        alternatives=(),
        references=tuple(dict.fromkeys(name for answer in ordered for name in answer.references)),
        free=tuple(dict.fromkeys(name for answer in ordered for name in answer.free)),
    )


# Values in the shape of the answers they are given for

_LONGEST_SHOWN = 2_000
_ZEROS = "0"
"""What a vector of zeros is called until it is known what stands beside it."""


def model_parts(vocabulary: Vocabulary, value: Value) -> dict[str, Value]:
    """D, C or the vector C q̇, and g of a model [..][q̈] + [..][q̇] + [..], or [..][q̈] + [..] + [..]; Y and a.

    Of several vectors that are one and the same by their rates, as C q̇ and friction, none is taken.
    """
    n = len(vocabulary.coordinates)
    if isinstance(value, Grid) and value.factors:
        return _regressor_parts(vocabulary, value)
    if not isinstance(value, Grid) or not value.terms:
        return {}
    parts: dict[str, Value] = {}
    vectors: list[tuple[str, Value]] = []
    for term in value.terms:
        if not term.factors:
            vectors.append((_vector_name(term), term))
            continue
        matrix, right = term.factors
        name = {2: "D", 1: "C"}.get(right.is_rates, "")
        if matrix.shape != (n, n) or not name or name in parts:
            return {}
        parts[name] = matrix
    names = [name for name, _ in vectors]
    zeros = "Cqd" if "g" in names else "g"
    names = [zeros if name == _ZEROS else name for name in names]
    parts |= {
        name: vector
        for name, (_, vector) in zip(names, vectors, strict=True)
        if name and names.count(name) == 1
    }
    if "C" in parts:
        parts.pop("Cqd", None)
    return parts if "D" in parts else {}


def _regressor_parts(vocabulary: Vocabulary, value: Grid) -> dict[str, Value]:
    """Y and a of their product, a being free of everything that moves."""
    assert value.factors
    Y, a = value.factors
    moving = {q.name for q in vocabulary.coordinates}
    name = REFERENCE if any(map(vocabulary.is_reference, names_in(Y.node))) else "Y"
    is_regressor = name in vocabulary.quantities and value.shape == (len(moving), 1) and not Y.quantity
    return {name: Y, "a": a} if is_regressor and names_in(a.node).isdisjoint(moving) else {}


def _vector_name(term: Grid) -> str:
    """What a vector beside D q̈ is: C q̇ where it vanishes at rest, g where it holds no rates, else both."""
    if all(entry == ZERO for entry in term.entries):
        return _ZEROS
    if not any(symbol.dots for symbol in symbols_in(term)):
        return "g"
    return "Cqd" if all(map(_vanishes_at_rest, term.entries)) else ""


def _vanishes_at_rest(node: Node) -> bool:
    """Whether a velocity is a factor of every term, as the formula is written."""
    match node:
        case Sum(terms):
            return all(map(_vanishes_at_rest, terms))
        case Product(factors):
            return any(map(_vanishes_at_rest, factors))
        case Negative(part) | Quotient(part) | Power(part):
            return _vanishes_at_rest(part)
        case Symbol(_, dots):
            return dots == 1
    return node == ZERO


def fitted(vocabulary: Vocabulary, candidates: tuple[str, ...], value: Value) -> list[tuple[str, Node, str]]:
    """(name, tree, note) of the candidates that a value can be, of its very shape if any is."""
    exact: list[tuple[str, Node, str]] = []
    loose: list[tuple[str, Node, str]] = []
    for name in candidates:
        shape = vocabulary.shape(name)
        if shape is None:
            if isinstance(value, Node):
                exact.append((name, value, ""))
        elif isinstance(value, Grid):
            if value.shape == shape:
                exact.append((name, value.node, ""))
            elif value.shape == shape[::-1] and 1 in shape:
                turned = transposed(value)
                assert isinstance(turned, Grid)
                loose.insert(0, (name, turned.node, "the row is read as a column"))
            elif 0 in shape:  # of any size: B is D only where it has the size of D
                loose.insert(0, (name, value.node, ""))
            elif name != "Cqd" or 1 in value.shape:  # N = Ḋ - 2C and other matrices have its letters
                loose.append((name, value.node, ""))
        elif shape == (1, 1) and isinstance(value, Node):
            exact.append((name, Matrix(((value,),)), ""))
        elif isinstance(value, Node) and value != ZERO and vocabulary.quantities[name].family is families.W:
            loose.append((name, Matrix(((value,),)), ""))  # of a planar robot, whose axis is known
        elif value == ZERO and 0 in shape:
            exact.append((name, Matrix(((ZERO,),)), ""))
        elif value == ZERO:
            zeros = Matrix(((ZERO,) * shape[1],) * shape[0])
            loose.append((name, zeros, "0 is read as the matrix of zeros"))
    return exact or loose


def with_own_entries(vocabulary: Vocabulary, name: str, node: Node) -> Node:
    """A matrix with its entries for their names: the d_12 below the diagonal of D."""
    if not isinstance(node, Matrix) or not any(isinstance(e, Reference) for row in node.rows for e in row):
        return node

    def entry(found: Node) -> Node:
        if isinstance(found, Reference):
            whole, place = vocabulary.quantities.entry_of(found.quantity)
            if whole == name and not isinstance(node.rows[place[0]][place[1]], Reference):
                return node.rows[place[0]][place[1]]
        return found

    return Matrix(tuple(tuple(entry(found) for found in row) for row in node.rows))


def is_gravity_vector(value: Value, coordinates: int) -> bool:
    """Whether a value is the acceleration of gravity as a vector: one entry alone, g or -9.81.

    A number is taken for that only where the vector is none of generalized forces by its length.
    """
    if not isinstance(value, Grid) or 1 not in value.shape or max(value.shape) not in (2, 3):
        return False
    entries = [entry for entry in value.entries if entry != ZERO]
    if len(entries) != 1:
        return False
    entry = entries[0].argument if isinstance(entries[0], Negative) else entries[0]
    if isinstance(entry, Number):
        return max(value.shape) != coordinates and 9 < entry.p / entry.q < 11
    return isinstance(entry, Symbol) and split(entry.name)[0] == "g"


def misfit(
    vocabulary: Vocabulary, candidates: tuple[str, ...], value: Value, start: int, end: int
) -> ReadError:
    """The error about a value that none of its names can have."""
    name = candidates[0]
    shape = vocabulary.shape(name)
    found = f"a {value.shape[0]}×{value.shape[1]} matrix" if isinstance(value, Grid) else "one expression"
    wanted = f"a {shape[0]}×{shape[1]} matrix" if shape else "one expression"
    return ReadError(f"{name} is {wanted}; this is {found}", start, max(end - start, 1), f"write {wanted}")


def shown(text: str) -> str:
    """A text as it is kept with what was not recognized."""
    text = printable(" ".join(text.split()))
    return text if len(text) <= _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 3] + "..."


# What a sentence says of the entries that are not written: `all others are zero`, `sonst 0`

_OTHER = (
    r"others?|remaining|rest|übrigen|anderen|restlichen|restliche|øvrige|andre|andere|resten"
    r"|not (?:listed|given|shown|mentioned)"
)
_ZERO = r"(?:zero(?:es|s)?|vanish\w*|null|verschwinden|forsvinner|(?:=[ \t]{0,9})?\$?0)(?![\w.,]*\w)"
_REST_IS_ZERO = re.compile(
    rf"\b(?:(?:all|the|alle|die|de)[ \t]+(?:(?:the|die|de)[ \t]+)?)?(?:{_OTHER})\b[^.;\n+*/]{{0,60}}?{_ZERO}"
    rf"|\b(?:otherwise|else|sonst|ellers)[ \t]+(?:all[ \t]+|alles[ \t]+|alt[ \t]+)?{_ZERO}"
    rf"|\b{_ZERO}[ \t]+(?:otherwise|elsewhere|else|sonst|ellers)\b",
    re.IGNORECASE,
)
_NOT = re.compile(
    r"\b(?:not|non|nonzero|nicht|ikke|no|kein\w*)\b(?! (?:listed|given|shown|mentioned))", re.IGNORECASE
)
_WORDS = (
    *("other", "remaining", "rest", "übrigen", "andere", "øvrige", "andre", "listed", "given", "shown"),
    *("mentioned", "else", "ellers", "sonst", "otherwise"),
)
_MOST = 20


def rest_is_zero(text: str) -> Iterator[re.Match[str]]:
    """Where a text says so; without one of the words, which are quickly found, it is not searched."""
    lower = text.lower()
    return _REST_IS_ZERO.finditer(text) if any(word in lower for word in _WORDS) else iter(())


def said_zero(source: Source, text: str) -> Iterator[tuple[Place, str]]:
    """Where a text says that what is not written is zero."""
    for found in islice(rest_is_zero(text), _MOST):
        if not _NOT.search(found[0]):
            yield source.place(found.start(), len(found[0])), shown(found[0])


def others(answers: Iterable[Answer], quantities: Quantities, place: Place, text: str) -> list[Answer]:
    """The entries that a sentence says are zero: those beside the last one that is written before it."""
    answers = list(answers)
    here = place.line, place.column
    before = [a for a in answers if (a.place.line, a.place.column) < here]
    last = max(before, key=lambda a: (a.place.line, a.place.column), default=None)
    whole = quantities.entry_of(last.name)[0] if last is not None else ""
    names = {answer.name for answer in answers}
    if not whole or whole in names:
        return []
    written = {quantities.entry_of(one) for name in names for one in (name, quantities.mirrored(name))}
    by_entry = {quantities.entry_of(part): part for part in reversed(quantities.parts(whole))}
    after = 1 + max(answer.occurrence[0] for answer in answers)
    return [
        Answer(part, "", ZERO, place, text, "0", occurrence=(after + number, 0))
        for number, (entry, part) in enumerate(by_entry.items())
        if entry not in written
    ]
