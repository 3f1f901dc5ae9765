"""The members of an equation that are no names: each read as a value, or why it has none."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.answers.reading.displays import OPENS
from dynsolve.answers.reading.grammar.brackets import MIRRORED, SYMMETRIC_NOTE
from dynsolve.answers.reading.grammar.formula import FormulaReader
from dynsolve.answers.reading.grammar.names import unknown
from dynsolve.answers.reading.grammar.references import OWN_LETTERS
from dynsolve.answers.reading.grids import Abstract, Grid, Value
from dynsolve.answers.reading.limits import check_size
from dynsolve.answers.reading.name_splitting import split_names
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import ZERO, Reference
from dynsolve.notation.walk import walk

EXPECTED = "a formula is made of numbers, the problem's symbols, + - * / ^, sin, cos, tan and sqrt"
"""What is said where a formula was expected and no better remedy is known."""

_WAYS: tuple[frozenset[str], ...] = (
    frozenset(),
    frozenset({"inertia"}),
    frozenset({"spaces"}),
    frozenset({"decimals"}),
    frozenset({"vectors"}),
    frozenset({"driving"}),
)
"""How a value may be read.

As it stands; a bare I_1 as the moment of inertia; blanks between entries; 0,5 as a decimal; c and h as the
vector C q̇; τ as the force of the only motor.
"""


_UNITS = frozenset("in J N Nm kg kgm rad m s W".split())
_OF_UNITS = frozenset("{ } ( ) [ ] ^ * / - cdot number raised".split())
_LONGEST_UNIT = 30
_PENDING = frozenset("+ - * / ^ _ cdot times command".split())


@dataclass(frozen=True, slots=True)
class RightSide:
    """A member that was read, with what its value is made of.

    `is_definition` says that names of the derivation alone stand in it, so that it has no value of its
    own; `has_letters`, that some of these stand
    in a scalar beside symbols of the problem: they may be the student's own, and mean nothing here.
    """

    value: Value
    references: tuple[str, ...]
    notes: tuple[str, ...]
    free: tuple[str, ...]
    is_definition: bool
    has_letters: bool = False


def read_right_side(
    vocabulary: Vocabulary, member: list[Token], owners: tuple[str, ...] = ()
) -> RightSide | ReadError:
    """A member's value, or why it has none; readings that take a bolder guess come last.

    `owners` are the answers it may be a value of.
    """
    if not member:
        return ReadError("there is nothing here", 0, 1, EXPECTED)
    tokens = split_names(_without_unit(member, vocabulary), vocabulary)
    first: RightSide | ReadError | None = None
    fits: RightSide | None = None
    for options in _WAYS:
        if options and not _may_help(options, tokens):
            continue
        piece = _with_decimals(tokens) if "decimals" in options else tokens
        found = _read(vocabulary, piece, owners, options)
        if isinstance(found, RightSide) and _has_shape(vocabulary, found, owners[:1]):
            return found
        if isinstance(found, RightSide) and fits is None and _has_shape(vocabulary, found, owners):
            fits = found  # [a b; c d] is one column of products, too, where the name may be that of a vector
        is_better = isinstance(first, ReadError) and isinstance(found, RightSide) and "vectors" not in options
        if first is None or is_better:
            first = found
    if fits is not None:
        return fits
    assert first is not None
    if isinstance(first, RightSide):
        return first
    return ReadError(first.message, max(first.offset, member[0].start), max(first.length, 1), first.help)


def _without_unit(tokens: list[Token], vocabulary: Vocabulary) -> list[Token]:
    """The tokens without the unit behind them: `... * cos(q1) Nm`, `... [N m]`, `... (kg m^2/s^2)`."""
    start = len(tokens)
    while start > max(1, len(tokens) - _LONGEST_UNIT) and _is_of_unit(tokens[start - 1]):
        start -= 1
    for position in range(start, len(tokens)):
        first, before = tokens[position], tokens[position - 1].kind
        names = [token.text for token in tokens[position:] if token.text in _UNITS]
        unknown = [name for name in names if vocabulary.symbol(name) is None]
        is_group = first.kind == "[" or (first.kind == "{" and before != "}" and len(names) > 1)
        begins = is_group or (first.spaced and (first.kind == "(" or first.text in unknown))
        level = sum(OPENS.get(token.kind, 0) for token in tokens[position:])
        if begins and unknown and not level and before not in _PENDING:
            return tokens[:position]
    return tokens


def _is_of_unit(token: Token) -> bool:
    return token.text in _UNITS or token.kind in _OF_UNITS or token.text == "frac"


def _read(
    vocabulary: Vocabulary, tokens: list[Token], owners: tuple[str, ...], options: frozenset[str]
) -> RightSide | ReadError:
    owner = owners[0] if owners else ""
    reader = FormulaReader(tokens, vocabulary, owner=owner, options=options)
    try:
        value = reader.value()
        definition = isinstance(value, Abstract) or (
            _is_names_only(reader, vocabulary) and not _is_by_entries(vocabulary, value, owners)
        )
        if isinstance(value, Abstract) and reader.letters and _is_worked_out(reader, vocabulary, owners):
            raise unknown(reader, reader.letters[0], reader.letters[0].key)
        if not definition:
            _check_shape(vocabulary, value, owners)
        if not isinstance(value, Abstract):
            node = value.node if isinstance(value, Grid) else value
            if SYMMETRIC_NOTE in reader.notes and any(part is MIRRORED for part in walk(node)):
                raise ReadError("a mark stands here for no entry across the diagonal", help="write the entry")
            check_size(node)
    except ReadError as error:
        return error
    except RecursionError:
        return ReadError("this is nested too deeply", 0, 1, "write it in fewer levels")
    is_scalar = not any(vocabulary.shape(owner) for owner in owners)
    return RightSide(
        value,
        tuple(reader.references),
        tuple(reader.notes),
        tuple(reader.free),
        definition,
        has_letters=bool(is_scalar and reader.letters and reader.symbols),
    )


def is_value(found: RightSide | ReadError) -> bool:
    """Whether a member has a value of its own."""
    return isinstance(found, RightSide) and not found.is_definition


def is_abstract(found: RightSide | ReadError) -> bool:
    """Whether a member stands for no value of this robot."""
    return isinstance(found, RightSide) and isinstance(found.value, Abstract)


def is_name(found: RightSide | ReadError, name: str) -> bool:
    """Whether a member is nothing but the name of an answer."""
    return isinstance(found, RightSide) and found.value == Reference(name)


def why_no_value(found: RightSide) -> str:
    """Why a side that was read gives its name no value."""
    return found.value.why if isinstance(found.value, Abstract) else "it holds names of the derivation alone"


def _has_shape(vocabulary: Vocabulary, found: RightSide, owners: tuple[str, ...]) -> bool:
    """Whether a value has the shape of one of the answers it is given for."""
    value = found.value
    if isinstance(value, Abstract) or not owners:
        return True
    shapes = [vocabulary.shape(owner) for owner in owners]
    if isinstance(value, Grid):
        return any(shape and value.shape in (shape, shape[::-1]) for shape in shapes)
    return value == ZERO or None in shapes or (1, 1) in shapes


def _check_shape(vocabulary: Vocabulary, value: Value, owners: tuple[str, ...]) -> None:
    """Raise ReadError for a matrix where only a scalar belongs."""
    if isinstance(value, Grid) and owners and not any(vocabulary.shape(o) for o in owners):
        rows, columns = value.shape
        message = f"{owners[0]} is one expression; this is a {rows}×{columns} matrix"
        raise ReadError(message, help="check what is transposed, and what is a vector")


def _is_names_only(reader: FormulaReader, vocabulary: Vocabulary) -> bool:
    """Whether what was read holds names of the derivation alone, or masses beside its vectors."""
    if not reader.references and not reader.names_used:
        return False
    if not reader.symbols:
        return True
    vectors = any(vocabulary.shape(name) for name in reader.references)
    return vectors and set(reader.symbols) <= vocabulary.masses


def _is_by_entries(vocabulary: Vocabulary, value: Value, owners: tuple[str, ...]) -> bool:
    """Whether a matrix gives some entries by name and others not: [0, g_2], [[C_11, C_12], [-C_12, 0]]."""
    if not isinstance(value, Grid):
        return False
    quantities = vocabulary.quantities
    wholes = {
        quantities.entry_of(part.quantity)[0] for part in walk(value.node) if isinstance(part, Reference)
    }
    if not wholes or not wholes <= set(owners):
        return False
    for i, row in enumerate(value.rows):
        for j, entry in enumerate(row):
            name = entry.quantity if isinstance(entry, Reference) else ""
            places = {quantities.entry_of(one)[1] for one in (name, quantities.mirrored(name))}
            if places.isdisjoint({(i, j), (j, i)} if 1 in value.shape else {(i, j)}):
                return True
    return False


def _is_worked_out(reader: FormulaReader, vocabulary: Vocabulary, owners: tuple[str, ...]) -> bool:
    """Whether a scalar holds lengths and coordinates, so that no letter in it is one of the derivation."""
    if not owners or any(vocabulary.shape(owner) is not None for owner in owners):
        return False
    return bool(set(reader.symbols) - vocabulary.masses)


def _decimal_commas(tokens: list[Token]) -> list[int]:
    """Where commas stand between the digits of a number, outside of lists: `0,5 m_1`, not `[0,5]`."""
    found: list[int] = []
    lists = 0
    for position, token in enumerate(tokens[:-1]):
        lists += (token.kind == "[") - (token.kind == "]")
        if token.kind != "," or lists > 0 or position == 0 or position - 2 in found:
            continue
        before, after = tokens[position - 1], tokens[position + 1]
        digits = before.kind == after.kind == "number" and before.text.isdigit() and after.text.isdigit()
        if digits and before.end == token.start and token.end == after.start:
            found.append(position)
    return found


def _with_decimals(tokens: list[Token]) -> list[Token]:
    """The tokens with one number for the digits on both sides of a decimal comma."""
    out = list(tokens)
    for position in reversed(_decimal_commas(tokens)):
        before, after = tokens[position - 1], tokens[position + 1]
        number = before._replace(text=f"{before.text}.{after.text}", end=after.end)
        out[position - 1 : position + 2] = [number]
    return out


def _may_help(options: frozenset[str], tokens: list[Token]) -> bool:
    """Whether another way of reading could make sense of these tokens."""
    if "inertia" in options:
        return any(t.kind == "name" and t.text[0] in "IJ" for t in tokens)
    if "decimals" in options:
        return bool(_decimal_commas(tokens))
    if "driving" in options:
        return any(t.text == "tau" for t in tokens)
    if "vectors" in options:
        return any(t.text in OWN_LETTERS for t in tokens)
    return any(t.kind == "[" for t in tokens)
