"""Runs of letters cut into the names of the problem: `m_2gL_1` is m_2, g and L_1.

Coordinates that a student counts the other way, or from elsewhere: `symbols: {t2: pi/2 - theta2}`.

What belongs to such a coordinate turns with it: its torque, rows of D, columns of a Jacobian.
An answer is in the student's own coordinates, unless it plainly uses the problem's: the
coordinate's own name stands in it.  It is right in these or in those, never in either,
so that no wrong sign is accepted.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from dynsolve.answers.reading.grammar.reader import rate
from dynsolve.answers.reading.grids import Value, symbols_in
from dynsolve.answers.reading.lexer import UPRIGHT_UNITS, Token
from dynsolve.answers.reading.vocabulary import ENERGY_LEVELS, ZERO_LEVELS, Meaning, Vocabulary, spellings
from dynsolve.answers.verdict import Answer
from dynsolve.notation.characters import split
from dynsolve.notation.tree import (
    Negative,
    Node,
    Number,
    Product,
    Quotient,
    Sum,
    Symbol,
    children,
    names_in,
    walk,
)
from dynsolve.quantities.letters import key

_LONGEST_RUN = 60
_FUNCTIONS = frozenset("sin cos tan sqrt cot sec csc sgn sign".split())
_CALLS = frozenset(
    "sin cos tan sqrt cot sec csc Sin Cos Tan Sqrt SIN COS Derivative diff Diff Matrix matrix Rational "
    "transpose Transpose MutableDenseMatrix ImmutableMatrix ImmutableDenseMatrix Integer deg array np "
    "Vector vector diag Diag zeros".split()
)
"""Words that are functions, never products of letters."""

_INVERSE = re.compile(r"a(?:rc)?(?:sin|cos|tan2?)", re.IGNORECASE)
"""Such words where the inverse functions are known, though the problem may have a parameter a."""


def split_names(tokens: list[Token], vocabulary: Vocabulary, naming: bool = False) -> list[Token]:
    """Runs of letters cut into names: `m_2gL_1` into m_2, g and L_1."""
    out: list[Token] = []
    script = power = 0
    for position, token in enumerate(tokens):
        if position < power:
            continue
        if token.kind == "text":
            if not _is_name(token, tokens[position + 1 : position + 2], vocabulary, naming):
                power = _behind_power(tokens, position + 1)
                continue
            token = token._replace(kind="name")
        if token.kind == "{" and out and out[-1].kind in ("_",):
            script += 1
        elif token.kind == "}" and script:
            script -= 1
        if (
            token.kind != "name"
            or len(token.text) < 2
            or script
            or vocabulary.bare_symbol(token.text) is not None
            or (out and out[-1].kind == "_")
        ):
            out.append(token)
            continue
        open_end = tokens[position + 1].kind == "_" if position + 1 < len(tokens) else False
        called = position + 1 < len(tokens) and tokens[position + 1].kind in _ARGUMENTS
        pieces = _pieces(token.text, vocabulary, open_end, called, naming)
        if len(pieces) == 1 and not naming:  # the h_0 of mgh_0 is no name of the problem
            pieces = _pieces(token.text, vocabulary, open_end, called, naming, ZERO_LEVELS)
        if len(pieces) == 1:
            out.append(token)
            continue
        start = token.start
        for number, piece in enumerate(pieces):
            end = start + len(piece) if token.end - token.start == len(token.text) else token.end
            dots = token.dots if number == 0 else 0
            out.append(Token("name", piece, start, end, dots, token.spaced and number == 0))
            start = end if end != token.end else start
    return out


_ARGUMENTS = frozenset({"(", "{", "name", "letter", "number", "fraction", "^", "raised"})
"""What may follow the name of a function: its argument, or its power."""


def _behind_power(tokens: list[Token], start: int) -> int:
    """Where it goes on behind the power of a unit, which is left out with it."""
    kinds = [token.kind for token in tokens[start : start + 5]]
    powers = (["raised"], ["^", "number"], ["^", "{", "number", "}"], ["^", "{", "-", "number", "}"])
    return start + max((len(power) for power in powers if kinds[: len(power)] == power), default=0)


def _is_name(text: Token, after: list[Token], vocabulary: Vocabulary, naming: bool) -> bool:
    r"""Whether a `\text{...}` is a name set upright, and no word or unit beside the formula."""
    if not naming and text.text in UPRIGHT_UNITS and vocabulary.symbol(text.text) is None:
        return False
    if (after and after[0].kind in ("_", "^", "'")) or len(text.text) == 1 or text.text[-1].isdigit():
        return True
    name = key(text.text)
    return vocabulary.symbol(name) is not None or bool(vocabulary.named(name)) or name in ENERGY_LEVELS


def _pieces(
    text: str,
    vocabulary: Vocabulary,
    open_end: bool,
    called: bool,
    naming: bool,
    others: frozenset[str] = frozenset(),
) -> list[str]:
    """The fewest names, `others` among them, that make up a run of letters; the run where there are none."""
    if _known(text, vocabulary, naming) or text in _CALLS or len(text) > _LONGEST_RUN:
        return [text]
    if called and _is_inverse(text, vocabulary):
        return [text]
    starts = _starts(text)
    ends = [*starts[1:], len(text)]
    best: dict[int, list[str] | None] = {len(text): []}
    for start in reversed(starts):
        found: list[str] | None = None
        for end in reversed([e for e in ends if e > start]):
            rest = best.get(end)
            piece = text[start:end]
            if rest is None or (found is not None and len(rest) + 1 >= len(found)):
                continue
            final = end == len(text)
            good = _known(piece, vocabulary, naming) or (final and open_end and len(piece) == 1)
            good = good or (piece in _FUNCTIONS and (not final or called)) or key(piece) in others
            good = good or (final and called and _is_inverse(piece, vocabulary))
            if good:
                found = [piece, *rest]
        best[start] = found
    return best[starts[0]] or [text]


def _is_inverse(piece: str, vocabulary: Vocabulary) -> bool:
    return vocabulary.has_inverse_functions and _INVERSE.fullmatch(piece) is not None


def _starts(text: str) -> list[int]:
    """Where a name may begin: at the letters that are no part of an index in braces."""
    starts, inside = [], False
    for i, character in enumerate(text):
        inside = inside or character == "{"
        if character == "}":
            inside = False
        elif character.isalpha() and not inside and (i == 0 or text[i - 1] != "_"):
            starts.append(i)
    return starts


def _known(piece: str, vocabulary: Vocabulary, naming: bool) -> bool:
    if piece[-1] == "_":
        return False
    name = key(piece)
    if vocabulary.symbol(name) is not None:
        return True
    if vocabulary.named(name) and (naming or len(name) > 1 or len(piece) == 1):
        return True
    if vocabulary.short_angle(name) is not None:
        return True
    return len(name) > 1 and not naming and vocabulary.similar(name) is not None


# Keeping a name of the student's own, with all that follows from it: rates, sine and cosine


def keep_symbol(vocabulary: Vocabulary, name: str, dots: int, value: Value, in_passing: bool = False) -> None:
    """A name for a coordinate is one for its derivatives, and for its sine and cosine too.

    One that a report defines `in_passing`, in the problem's coordinates, leaves s_2 the sine of theirs.
    """
    vocabulary.remembered.clear()
    if dots:
        vocabulary.derived[name, dots] = value
        return
    aliases = {spelling for spelling, _ in spellings(name) if spelling in vocabulary.others}
    vocabulary.defined[name] = Meaning(value)
    found = {order: rate(value, vocabulary, order) for order in (1, 2)}
    rates = {order: one for order, one in found.items() if one is not None}
    for spelling, order in spellings(name):
        known = spelling in vocabulary.symbols or spelling in vocabulary.defined
        if order in rates and (not known or spelling in aliases):
            vocabulary.defined[spelling] = Meaning(rates[order])
    index = "".join(split(name)[1])
    if rates and not in_passing and index.isdigit() and isinstance(value, Node):
        vocabulary.angles[index] = value


def gives_new_meaning(vocabulary: Vocabulary, name: str, value: Value) -> bool:
    r"""Whether `\theta_2 = q_1 + q_2` gives another meaning to what would be read as a coordinate."""
    if vocabulary.is_vector(name) and name not in vocabulary.symbols:  # θ is q₂ alone, and no column
        is_scalar = name == "Theta" and isinstance(value, Node) and bool(names_in(value))
        return is_scalar or (isinstance(value, Node) and rate(value, vocabulary, 1) is not None)
    usual = vocabulary.others.get(name)
    if usual is None or usual.dots or vocabulary.coordinate(usual) is None or isinstance(value, Symbol):
        return False
    return isinstance(value, Node) and rate(value, vocabulary, 1) is not None


def gives_own_angle(vocabulary: Vocabulary, name: str, value: Value) -> bool:
    r"""Whether `\dot\theta = \dot x/R` gives an angle of the own that would be read as a coordinate."""
    base, dots = name.rstrip("'"), name.count("'")
    usual = vocabulary.others.get(name)
    if base and base not in vocabulary.symbols and (only := vocabulary.only_coordinate(base)):
        usual = usual or Symbol(only.name, dots)
    if usual is None or any(character.isdigit() for character in name) or not isinstance(value, Node):
        return False
    symbols = symbols_in(value)
    moves = any(one.dots == usual.dots and vocabulary.coordinate(one) for one in symbols)
    return moves and usual not in symbols and not isinstance(value, Symbol)


# Coordinates that a student counts the other way, or from elsewhere


def with_own_coordinates(
    answers: Sequence[Answer], meanings: Sequence[Node], coordinates: Sequence[str]
) -> Iterator[Answer]:
    """The answers, each with the coordinates that are counted the other way in it.

    `meanings` are what the student's own names for coordinates stand for.
    """
    senses: dict[str, set[int]] = {}
    for meaning in meanings:
        names = {part.name for part in walk(meaning) if isinstance(part, Symbol)} & set(coordinates)
        if len(names) == 1:  # θ₂ - θ₁ is another coordinate, no other sense of one
            senses.setdefault(name := names.pop(), set()).add(_sense(meaning, name))
    turned = {name: found for name, found in senses.items() if -1 in found}
    for answer in answers:
        here = tuple(name for name, found in turned.items() if _is_turned(answer.node, name, 1 in found))
        yield replace(answer, turned=here) if here else answer


def _is_turned(node: Node | None, name: str, has_both: bool) -> bool:
    """Whether an answer is written in the turned coordinate.

    It is not where the coordinate stands in it without a minus, which the name of the turned one never
    leaves; where it does not stand in it at all, the student has no other name for it.
    """
    signs = set(_signs(node, name)) if node is not None else set()
    return signs == {-1} or (not signs and not has_both)


def _signs(node: Node, name: str, sign: int = 1) -> Iterator[int]:
    """-1 for a coordinate, or its rate, with a minus before it, 1 for one without."""
    if isinstance(node, Symbol) and node.name == name:
        yield sign
    for child in children(node):
        yield from _signs(child, name, -1 if isinstance(node, Negative) else 1)


def _sense(meaning: Node, name: str) -> int:
    """1 or -1 for ± a coordinate plus a constant, 0 for what is none of that coordinate."""
    match meaning:
        case Symbol(found, 0):
            return int(found == name)
        case Negative(argument):
            return -_sense(argument, name)
        case Sum(terms):
            used = [sense for term in terms if (sense := _sense(term, name))]
            return used[0] if len(used) == 1 else 0
        case Product((Negative(Number(1, 1)), factor)):
            return -_sense(factor, name)
        case Quotient(numerator, Number(1, 1)):
            return _sense(numerator, name)
    return 0
