"""What the sides of an equation name: answers, nothing known, or nothing at all."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import pairwise

from msgspec import Struct

from dynsolve.answers.reading.displays import OPENS, pieces
from dynsolve.answers.reading.grammar.brackets import MIRRORED, SYMMETRIC_NOTE
from dynsolve.answers.reading.grammar.derivatives import UnknownVariable
from dynsolve.answers.reading.grammar.formula import FormulaReader
from dynsolve.answers.reading.grammar.names import UnknownName, unknown
from dynsolve.answers.reading.grammar.references import (
    OWN_LETTERS,
    only_coordinates,
    skip_arguments,
    whole_of,
)
from dynsolve.answers.reading.grammar.scripts import Form
from dynsolve.answers.reading.grids import Abstract, Grid, Value, check_size
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.name_splitting import split_names
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.vocabulary import MOST_REMEMBERED, SET_KINDS, Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import ZERO, Function, Negative, Reference, Sum, Symbol, walk
from dynsolve.quantities.family import Kind
from dynsolve.quantities.letters import key

_DETERMINANT = re.compile(r"(?:det\(?|\|)J[\w^()]*\|?")
_LONGEST_DETERMINANT = 20
SETS = ("singular", "equilibria", "inverse")
"""The answers that are sets of equations for coordinates."""

_LONGEST_NAME = 9
_AFTER = frozenset("[(_:")
_WHOLE = 6
"""With so many joints J itself is square."""


class NamedAnswers(Struct, frozen=True):
    """The answers that a side of an equation may name."""

    candidates: tuple[str, ...]


class UnknownSide(Struct, frozen=True):
    """A side that is a name which means nothing.

    `is_name_alone` says that it is nothing but that name, `has_arguments` that arguments follow it.
    """

    key: str
    family: tuple[str, ...]
    is_name_alone: bool
    message: str
    has_arguments: bool = False


LeftSide = NamedAnswers | UnknownSide | None
"""What a side of an equation names; None where it is something else."""


def read_left_sides(vocabulary: Vocabulary, members: list[list[Token]]) -> list[LeftSide]:
    """What each member names: the first one, those before the last, and the last if no other does."""
    found: list[LeftSide] = []
    for index, member in enumerate(members):
        side = None
        last = index == len(members) - 1
        if index == 0:
            side = read_left_side(vocabulary, member)
        elif not last or not any(isinstance(side, NamedAnswers) for side in found):
            side = read_left_side(vocabulary, member)
            if isinstance(side, UnknownSide) or (last and is_symbol(vocabulary, member)):
                side = None
        elif member[0].kind in ("begin", "[") and not any(t.kind in ("+", "-") for t in member):
            side = read_left_side(vocabulary, member)
            side = side if isinstance(side, NamedAnswers) else None
        found.append(side)
    return found


def is_symbol(vocabulary: Vocabulary, member: list[Token]) -> bool:
    """Whether a member alone is a symbol of the problem, which wins on a right-hand side."""
    text = key("".join(t.text for t in member if t.kind in ("name", "letter", "number")))
    script = any(t.kind == "command" and t.text == "script" for t in member)
    return len(member) < 6 and not script and text in vocabulary.symbols


def read_left_side(vocabulary: Vocabulary, member: list[Token]) -> LeftSide:
    """The name that a side is, None where it is something else."""
    if len(member) > 200:
        return None
    if _is_determinant(vocabulary, member):
        return NamedAnswers(("det",))
    if _is_friction(vocabulary, member):
        return NamedAnswers(("friction",))
    if marked := _marked_name(vocabulary, member):
        return UnknownSide(marked, (), True, "")
    tokens = split_names(member, vocabulary, naming=True)
    reader = FormulaReader(tokens, vocabulary, naming=True)
    try:
        value = reader.value()
    except UnknownName as error:
        called = _is_called(reader)
        simple = called or _is_simple(tokens, error.form)
        family = error.family if simple and not called else ()
        return UnknownSide(_defined_key(error.form), family, simple, error.message, called)
    except UnknownVariable as error:
        return UnknownSide("", error.family, False, error.message)
    except ReadError:
        return None
    named = _named(vocabulary, value, reader.candidates)
    candidates = tuple(
        name for name in named if not vocabulary.named_of_kind(name, *SET_KINDS, Kind.VERDICTS)
    )
    if candidates:
        return NamedAnswers(candidates)
    own = name_alone(vocabulary, tokens)
    return UnknownSide(own, (), True, "") if own and own in vocabulary.defined else None


def side_of(vocabulary: Vocabulary, text: str) -> LeftSide:
    """What a text names as a side of an equation."""

    def read() -> LeftSide:
        try:
            return read_left_side(vocabulary, prepared(text)[:-1])
        except ReadError:
            return None

    return vocabulary.once(text, read)


def without_factor(vocabulary: Vocabulary, members: list[list[Token]]) -> list[list[Token]]:
    r"""The members of `2K = ...` divided by the number; those of `\sum M_2 = ...` without the sign."""
    first = members[0]
    if first[0].text == "sum" and first[1:2] and first[1].kind not in ("_", "^"):
        return [first[1:], *members[1:]]
    start = 2 if first[1:2] and first[1].kind in ("*", "cdot") else 1
    if first[0].kind != "number" or not isinstance(read_left_side(vocabulary, first[start:]), NamedAnswers):
        return members
    return [first[start:], *(_divided(member, first[0]) for member in members[1:])]


def _divided(member: list[Token], number: Token) -> list[Token]:
    at = member[0].start
    one, over, below, opening = (
        number._replace(kind=kind, text=text, start=at, end=at)
        for kind, text in (("number", "1"), ("/", "/"), ("number", number.text), ("(", "("))
    )
    end = member[-1].end
    return [one, over, below, opening, *member, opening._replace(kind=")", text=")", start=end, end=end)]


def spoken_of(vocabulary: Vocabulary, member: list[Token], side: LeftSide) -> tuple[str, ...]:
    """The answers that a side speaks of, though it may be more than their name: `(1) g2`, `D[0,0]`.

    An equation for a coordinate may belong to any of the sets.
    """
    if isinstance(side, NamedAnswers):
        return side.candidates
    if isinstance(side, UnknownSide) and side.family:
        return side.family
    whole = member
    if [token.kind for token in member[:3]] == ["(", "number", ")"]:
        member = member[3:]
    elif member[:1] and member[0].kind == "number":
        member = member[1:]
    ends = [at for at, token in enumerate(member) if at and token.kind in _AFTER]
    if member and (member is not whole or side is None):  # else `side` is what the whole was read as
        ends.append(len(member))
    for end in ends:
        named = read_left_side(vocabulary, member[:end]) if end < _LONGEST_NAME else None
        if isinstance(named, NamedAnswers):
            return named.candidates
    sets = tuple(name for name in SETS if name in vocabulary.quantities)
    return sets if sets and _is_of_coordinate(vocabulary, member) else ()


def spoken_in(vocabulary: Vocabulary, text: str) -> tuple[str, ...]:
    """The answers that a text speaks of."""

    def read() -> tuple[str, ...]:
        try:
            member = prepared(text)[:-1]
        except ReadError:
            return ()
        return spoken_of(vocabulary, member, read_left_side(vocabulary, member))

    return vocabulary.once(("spoken", text), read)


def _is_of_coordinate(vocabulary: Vocabulary, member: list[Token]) -> bool:
    """Whether a side is a coordinate, or a sine or cosine of one."""
    try:
        value = FormulaReader(split_names(member, vocabulary), vocabulary).value()
    except ReadError:
        return False
    node = value.argument if isinstance(value, Function) else value
    return isinstance(node, Symbol) and not node.dots and vocabulary.coordinate(node) is not None


def _is_called(reader: FormulaReader) -> bool:
    """Whether coordinates in parentheses follow the name that was taken, and nothing else."""
    if reader.token.kind != "(" or not only_coordinates(reader, reader.position):
        return False
    skip_arguments(reader)
    return reader.token.kind == "end"


def _is_determinant(vocabulary: Vocabulary, member: list[Token]) -> bool:
    """Whether a side is det J or |J_r|, det(J Jᵀ) of one that is not square, where that is an answer."""
    if not vocabulary.is_answer("det") or len(member) > _LONGEST_DETERMINANT:
        return False
    text, n = "".join(token.text for token in member), len(vocabulary.coordinates)
    is_square = vocabulary.quantities.owners.task_rows == n or n == _WHOLE
    return bool(_DETERMINANT.fullmatch(text)) and text.count("J") == (1 if is_square else 2)


def is_read(side: LeftSide, is_named: bool) -> bool:
    """Whether a member is read as a value: it is no name; beside one it may begin with an unknown letter."""
    if isinstance(side, UnknownSide):
        return is_named and not side.is_name_alone
    return not isinstance(side, NamedAnswers)


def _is_friction(vocabulary: Vocabulary, member: list[Token]) -> bool:
    r"""Whether a side is a matrix of friction times the rates: F_v \dot q."""
    texts = [token.text for token in member if token.kind not in ("{", "}")]
    is_product = texts[1:] == ["dot", "q"] and key(texts[0]) in ("Fv", "F", "Fd", "Bv")
    return is_product and vocabulary.is_answer("friction") and key(texts[0]) not in vocabulary.symbols


def called_name(vocabulary: Vocabulary, tokens: list[Token]) -> str:
    """The key of the name that tokens are, which coordinates in parentheses may follow; else empty."""
    end = next((place for place, token in enumerate(tokens) if token.kind == "("), len(tokens))
    is_called = end < len(tokens) and not only_coordinates(FormulaReader(tokens, vocabulary), end)
    return "" if is_called else name_alone(vocabulary, tokens[:end])


def name_alone(vocabulary: Vocabulary, tokens: list[Token]) -> str:
    """The key of the name that tokens are, without powers; empty where they are more."""
    reader = FormulaReader(tokens, vocabulary, naming=True)
    try:
        if len(tokens) > 12 or not reader.begins_with_name():
            return ""
        form = reader.form()
        if form.key not in vocabulary.symbols:
            skip_arguments(reader)
    except ReadError:
        return ""
    return _defined_key(form) if reader.token.kind == "end" and not form.scripts.any else ""


def _marked_name(vocabulary: Vocabulary, tokens: list[Token]) -> str:
    r"""The key of a name of the student's own that its mark, prime or square makes one: I^*, I', v_1^2."""
    reader = FormulaReader(tokens, vocabulary, naming=True)
    try:
        if len(tokens) > 12 or not reader.begins_with_name():
            return ""
        form = reader.form()
    except ReadError:
        return ""
    known = vocabulary.symbol(form.key)
    if form.scripts.powers:
        is_own = known is None
    else:
        is_own = known is not None and vocabulary.coordinate(known.value) is None
    is_marked = is_own and not form.scripts.transposed and form.marked_key != form.key
    return form.marked_key if reader.token.kind == "end" and is_marked and not form.dots else ""


def _is_simple(tokens: list[Token], form: Form) -> bool:
    """Whether the side is this name and nothing else."""
    scripts = form.scripts
    whole = bool(tokens) and form.start <= tokens[0].end and form.end >= tokens[-1].start
    return whole and not scripts.powers and not scripts.transposed and len(tokens) < 12


def _defined_key(form: Form) -> str:
    """What a definition is kept under: the name with a prime for every dot."""
    return form.key + "'" * form.dots


def _named(vocabulary: Vocabulary, value: Value, candidates: tuple[str, ...]) -> tuple[str, ...]:
    """The answers that a value consisting of references alone names."""
    if isinstance(value, Reference):
        return candidates if value.quantity in candidates else (value.quantity,)
    if force := _force(vocabulary, value):
        return (force,)
    if isinstance(value, Grid):
        if value.quantity:
            return candidates if value.quantity in candidates else (value.quantity,)
        return whole_of(vocabulary, value)
    return ()


def _force(vocabulary: Vocabulary, value: Value) -> str:
    """The force that d/dt(∂L/∂q̇_i) - ∂L/∂q_i is."""
    for q in vocabulary.coordinates:
        terms = (Reference(f"ddt{q.index}"), Negative(Reference(f"dLdq{q.index}")))
        if value == Sum(terms):
            return q.force
    return ""


# The members of an equation that are no names: each read as a value, or why it has none

EXPECTED = "a formula is made of numbers, the problem's symbols, + - * / ^, sin, cos, tan and sqrt"
"""What is said where a formula was expected and no better remedy is known."""

_WAYS = ("", "inertia", "spaces", "factors", "decimals", "vectors", "driving")
"""How a value may be read.

As it stands; a bare I_1 as the moment of inertia; blanks between entries, or also between factors, by the
number of columns; 0,5 as a decimal; c and h as the vector C q̇; τ as the force of the only motor.
"""

_PARTED_WAYS = ("spaces", "factors")
"""The ways of `[1 0; 0 m]`, in which 1 0 is no product."""


_UNITS = frozenset("in J N Nm kg kgm rad m s W".split())
_OF_UNITS = frozenset("{ } ( ) [ ] ^ * / - cdot number raised".split())
_LONGEST_UNIT = 30
_PENDING = frozenset("+ - * / ^ _ cdot times command".split())


class RightSide(Struct, frozen=True):
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

    `owners` are the answers it may be a value of.  It is read once, until the student defines something.
    """
    written = (owners, *member)
    found = vocabulary.remembered.get(written)
    if found is None:
        if len(vocabulary.remembered) > MOST_REMEMBERED:
            vocabulary.remembered.clear()
        by_entries = frozenset(vocabulary.own_entries), written
        found = vocabulary.once(by_entries, lambda: _read_anew(vocabulary, member, owners))
        vocabulary.remembered[written] = found
    return found


def _read_anew(vocabulary: Vocabulary, member: list[Token], owners: tuple[str, ...]) -> RightSide | ReadError:
    if not member:
        return ReadError("there is nothing here", 0, 1, EXPECTED)
    tokens = split_names(_without_unit(member, vocabulary), vocabulary)
    first: RightSide | ReadError | None = None
    fits: RightSide | None = None
    for way in _PARTED_WAYS if _has_parted_numbers(tokens) else _WAYS:
        if way and not _may_help(way, tokens):
            continue
        piece = _with_decimals(tokens) if way == "decimals" else tokens
        if way == "factors":
            shape = vocabulary.shape(owners[0]) if owners else None
            piece = _with_commas(tokens, shape[1]) if shape else tokens
            if piece == tokens:
                continue
            if not piece:
                return ReadError(_BLANKS, tokens[0].start, 1, "write commas between the entries")
        found = _read(vocabulary, piece, owners, frozenset({way} - {""}))
        if isinstance(found, RightSide) and has_shape(vocabulary, found, owners[:1]):
            return found
        if isinstance(found, RightSide) and fits is None and has_shape(vocabulary, found, owners):
            fits = found  # [a b; c d] is one column of products, too, where the name may be that of a vector
        is_better = isinstance(first, ReadError) and isinstance(found, RightSide) and way != "vectors"
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
    while start > max(1, len(tokens) - _LONGEST_UNIT) and (
        tokens[start - 1].kind in _OF_UNITS or tokens[start - 1].text in (*_UNITS, "frac")
    ):
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


def has_shape(vocabulary: Vocabulary, found: RightSide, owners: tuple[str, ...]) -> bool:
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
    for place, entry in enumerate(value.entries):
        i, j = divmod(place, value.shape[1])
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


_BLANKS = "blanks stand between entries here, and between factors"


def _with_commas(tokens: list[Token], columns: int) -> list[Token]:
    """The tokens of `[1 0 -R cos(q1); ...]` with commas between so many entries; none where that is open.

    Where blanks stand between entries alone, or other signs do, they are as they were.
    """
    if tokens[0].kind != "[" or tokens[-1].kind != "]":
        return tokens
    found, has_factors = [tokens[0]], False
    for row in pieces(tokens[1:-1], ";"):
        entries = _by_blanks(row)
        factors = [at for at in range(1, len(entries)) if _may_multiply(entries[at - 1], entries[at])]
        if len(pieces(row, ",")) > 1 or any(token.kind in ("[", "\\\\", "&", "begin") for token in row):
            return tokens
        has_factors = has_factors or len(entries) > columns
        if len(entries) > columns and len(entries) - len(factors) != columns:
            return []
        joined = factors if len(entries) > columns else []
        for at, entry in enumerate(entries):
            if at and at not in joined:
                found.append(entry[0]._replace(kind=",", text=",", end=entry[0].start))
            found += entry
        found.append(tokens[-1]._replace(kind=";", text=";", end=tokens[-1].start))
    return [*found[:-1], tokens[-1]] if has_factors else tokens


def _has_parted_numbers(tokens: list[Token]) -> bool:
    """Whether a blank stands between two numbers in a bracket."""
    pairs = pairwise(tokens) if tokens and tokens[0].kind == "[" else ()
    return any(first.kind == second.kind == "number" and second.spaced for first, second in pairs)


def _by_blanks(row: list[Token]) -> list[list[Token]]:
    """The pieces of a row between blanks that stand outside of brackets and beside no sign."""
    found: list[list[Token]] = [[]]
    level = 0
    for position, token in enumerate(row):
        before = row[position - 1].kind if position else "+"
        is_sign = token.kind in _PENDING and token.kind != "command"
        leads = token.kind in ("+", "-") and position + 1 < len(row) and not row[position + 1].spaced
        if level == 0 and token.spaced and before not in _PENDING and (leads or not is_sign):
            found.append([])
        found[-1].append(token)
        level += OPENS.get(token.kind, 0)
    return found


def _may_multiply(left: list[Token], right: list[Token]) -> bool:
    """Whether two pieces may be factors: the first is no number, and no number or sign begins the second."""
    return left[-1].kind != "number" and right[0].kind not in ("number", "+", "-")


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


def _may_help(way: str, tokens: list[Token]) -> bool:
    """Whether another way of reading could make sense of these tokens."""
    if way == "decimals":
        return bool(_decimal_commas(tokens))
    return any(map(_HELPED[way], tokens))


_HELPED: dict[str, Callable[[Token], bool]] = {
    "inertia": lambda token: token.kind == "name" and token.text[0] in "IJ",
    "spaces": lambda token: token.kind == "[",
    "factors": lambda token: token.kind == "[",
    "vectors": lambda token: token.text in OWN_LETTERS,
    "driving": lambda token: token.text == "tau",
}
"""The tokens that another way of reading could make sense of."""
