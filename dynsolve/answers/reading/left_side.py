"""What the sides of an equation name: answers, nothing known, or nothing at all."""

from __future__ import annotations

import re
from dataclasses import dataclass

from dynsolve.answers.reading.grammar.derivatives import UnknownVariable
from dynsolve.answers.reading.grammar.forms import Form
from dynsolve.answers.reading.grammar.formula import FormulaReader
from dynsolve.answers.reading.grammar.names import UnknownName
from dynsolve.answers.reading.grammar.references import only_coordinates, skip_arguments, whole_of
from dynsolve.answers.reading.grids import Grid, Value
from dynsolve.answers.reading.name_splitting import split_names
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Function, Negative, Reference, Sum, Symbol
from dynsolve.quantities.spelling import key

_DETERMINANT = re.compile(r"(?:det\(?|\|)J[\w^()]*\|?")
_LONGEST_DETERMINANT = 20
SETS = ("singular", "equilibria", "inverse")
"""The answers that are sets of equations for coordinates."""

_LONGEST_NAME = 9
_AFTER = frozenset("[(_:")
_WHOLE = 6
"""With so many joints J itself is square."""


@dataclass(frozen=True, slots=True)
class NamedAnswers:
    """The answers that a side of an equation may name."""

    candidates: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class UnknownSide:
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
    candidates = tuple(
        name for name in _named(vocabulary, value, reader.candidates) if vocabulary.is_formula(name)
    )
    if candidates:
        return NamedAnswers(candidates)
    own = name_alone(vocabulary, tokens)
    return UnknownSide(own, (), True, "") if own and own in vocabulary.defined else None


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
    if [token.kind for token in member[:3]] == ["(", "number", ")"]:
        member = member[3:]
    elif member[:1] and member[0].kind == "number":
        member = member[1:]
    for end in (at for at, token in enumerate([*member, None]) if at and (not token or token.kind in _AFTER)):
        named = read_left_side(vocabulary, member[:end]) if end < _LONGEST_NAME else None
        if isinstance(named, NamedAnswers):
            return named.candidates
    sets = tuple(name for name in SETS if name in vocabulary.quantities)
    return sets if sets and _is_of_coordinate(vocabulary, member) else ()


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
