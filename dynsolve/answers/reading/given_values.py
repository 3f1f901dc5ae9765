"""The values of an answer file, each of which stands under the name of its answer.

Equations in plain text: lines `tau1 = ...`, as they are typed and as MATLAB and Python print them.

Coordinates that a student counts the other way, or from elsewhere: `symbols: {t2: pi/2 - theta2}`.

What belongs to such a coordinate turns with it: its torque, rows of D, columns of a Jacobian.
An answer is in the student's own coordinates, unless it plainly uses the problem's: the
coordinate's own name stands in it.  It is right in these or in those, never in either,
so that no wrong sign is accepted.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from msgspec.structs import replace

from dynsolve.answers.reading.answer_list import Member, Origin
from dynsolve.answers.reading.displays import Display, chain
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grids import MAX_MEMBERS, Abstract
from dynsolve.answers.reading.left_side import (
    LeftSide,
    NamedAnswers,
    RightSide,
    UnknownSide,
    read_left_side,
    read_right_side,
)
from dynsolve.answers.reading.matrix_parts import rest_is_zero, shown
from dynsolve.answers.reading.pretty_print import one_line
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.verdict import Answer, NotRecognized, Place
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Negative, Node, Number, Product, Quotient, Sum, Symbol, children, walk

# The values of an answer file, each of which stands under the name of its answer


def read_value(reader: EquationReader, name: str, place: Place, display: Display) -> None:
    """Read the value that an answer file gives under a name."""
    origin = reader.origin(display, display.label)
    side = _key(reader, name)
    names = side.family if isinstance(side, UnknownSide) else ()
    refused = NotRecognized(shown(f"{name}: {display.text}"), "", place, "it names nothing known", names)
    if isinstance(side, NamedAnswers):
        reader.found.answers += _given(reader, side.candidates, origin)
    elif isinstance(side, UnknownSide) and side.family:
        made = _given(reader, side.family[:1], origin)
        reader.found.put_off(side.family, made, refused)
    else:
        reader.found.not_recognized.append(refused)


def announce(reader: EquationReader, name: str) -> None:
    """Keep that a file gives the entry of a matrix under this name, wherever it stands."""
    side = _key(reader, name)
    if isinstance(side, NamedAnswers):
        reader.vocabulary.gives(side.candidates[0])


def _key(reader: EquationReader, name: str) -> LeftSide:
    """What a key of an answer file names."""
    if name.startswith("I") and reader.vocabulary.is_answer(name):
        return NamedAnswers((name,))
    try:
        return read_left_side(reader.vocabulary, prepared(name)[:-1])
    except ReadError:
        return None


def _given(reader: EquationReader, candidates: tuple[str, ...], origin: Origin) -> list[Answer]:
    """The answers that the members of a value are."""
    found = reader.found
    try:
        members = chain(prepared(origin.display.text, reader.macros))
        if len(members) > MAX_MEMBERS:
            message = f"more than {MAX_MEMBERS} members of one chain"
            raise ReadError(message, 0, 1, "write the value alone")
    except ReadError as error:
        return [found.unreadable(candidates, error, origin, 0)]
    side = read_left_side(reader.vocabulary, members[0]) if len(members) > 1 else None
    if isinstance(side, NamedAnswers) and set(side.candidates) & set(candidates):
        members = members[1:]
    made: list[Answer] = []
    for index, tokens in enumerate(members):
        member = Member(index, tokens, _value(reader, candidates, tokens))
        if isinstance(member.found, ReadError):
            made += found.unread(candidates, member, origin)
        else:
            made += found.value([candidates], member, origin)
    return made


def _value(reader: EquationReader, candidates: tuple[str, ...], tokens: list[Token]) -> RightSide | ReadError:
    """The value of a member, which is no value where it consists of letters of the derivation."""
    if not tokens:
        return ReadError("nothing stands on one side of this `=`", 0, 1, "write the value alone")
    found = read_right_side(reader.vocabulary, tokens, candidates)
    if isinstance(found, RightSide) and isinstance(found.value, Abstract):
        help = "write it in the symbols of the problem"
        return ReadError(found.value.why, tokens[0].start, 1, help)
    return found


# Equations in plain text

_HEAD = r"[ \t]*[^\s=:][^=:\n]{0,40}[ \t]*(?::=|[=:])[ \t]*"
_COUNTED = r"(?:[0-9]{1,2}(?:\.[0-9]{1,2}){0,2}[a-z]?|[A-Za-z](?:\.[0-9]{1,2})?|[ivx]{2,4})"
_LEAD = re.compile(
    r"[ \t]*(?:\(%[io][0-9]{1,4}\)[ \t]*|>>>?[ \t]+|[-*+•>][ \t]+)?"
    rf"(?:\({_COUNTED}\.?\)[ \t]+|\([0-9.]{{1,6}}\)|{_COUNTED}[.)][ \t]+"
    r"|[0-9]{1,2}\.[0-9]{1,2}[ \t]+(?=[A-Za-z\\]))?"
    r"(?:(?:[Ll]et|[Ss]ei|[Ll]a|[Ww]here|[Ww]ith|[Ww]obei|[Mm]it|[Mm]ed|[Dd]er|[Hh]vor)[ \t]+"
    r"(?=[^\s=]{1,20}[ \t]*=))?"
)
"""What stands before an equation in its line: a prompt, the mark of a list, its number."""

_EQUATION = re.compile(r"[^\n=]{1,200}=")
_ITEM = re.compile(r"[-*+][ \t]+[^=]{1,60}=|[-*+][ \t]+[^\s:]{1,40}:[ \t]")
"""The next item of a list, which is no term of the equation above."""

_NAMED = re.compile(r"([^\s:=|$]{1,40})[ \t]?:[ \t]+(?=\S)")
_TERMINATOR = re.compile(r"\$[ \t]*\Z")
"""The sign that ends a line of Maxima without showing its value."""

_SAID = re.compile(r"[^\n=$]{1,150}:[ \t]+(?=[^\s:=]{1,40}[ \t]*=)")
_WORDS = re.compile(
    rf"(?:[^\W\d_]{{2,30}}[,.]?[ \t]+){{1,20}}(?:{_COUNTED}[.)][ \t]+)?(?=[^\s:=]{{1,40}}[ \t]*=)"
)
"""The words of a sentence before an equation: `The potential energy P = ...`."""

_SPOKEN = re.compile(
    r"(?:(?:the|total|die|gesamte|den|totale?)[ \t]+)*(?:"
    r"(?P<K>kinetic energy|kinetische energie|kinetiske? energi(?:en)?)"
    r"|(?P<P>potential energy|poten[tz]ielle energie|potensielle? energi(?:en)?)"
    r"|(?P<L>lagrangian|lagrange[- ]?fun(?:ktion|ksjon(?:en)?))"
    r"|(?P<D>(?:inertia|mass) matrix|(?:massen|tr[äa]gheits)matrix|(?:masse|treghets)matrisen?)"
    r"|(?P<g>gravity vector|gravita(?:tions|sjons)vektor(?:en)?)"
    r")[ \t]*(?P<sign>:?=|:(?=[^=\n]*[*^])(?![^\n]*=))",
    re.IGNORECASE,
)
"""The name of an answer in words, before a formula: `Kinetic energy = ...`, `Potensiell energi: ...`."""

_SIGN = re.compile("[=:]")
_SIGN_BELOW = re.compile(r"\n[ \t]*=(?!=)")
"""The next line begins with the sign of the equation: `K1` stands alone on this one."""

_AND = re.compile(
    r"[ \t](?:and|og|und|et|y|with|where|mit|wobei|med|hvor|der)[ \t](?=[ \t]{0,9}[^\s:=]{1,40}[ \t]*=)"
)
_REMARK = re.compile(r"(?:(?<=\s)|(?<=[;)\]]))(?:#|//|%(?!pi\b))[^\n]*")
_SAID_BEHIND = re.compile(r"[ \t]+(?:for|für)[ \t]+(?:all|alle|any|every)[ \t][^\n]*\Z")
"""Where a value holds, said behind it."""

_SPOKEN_WORDS = r"[^\W\d_]{4,30}(?:[ \t][^\W\d_]{1,30}){0,6}"
_REMARK_BEHIND = re.compile(rf"(?<=\S)[ \t]{{2,9}}(?:\({_SPOKEN_WORDS}\)|\[{_SPOKEN_WORDS}\])[ \t]*\Z")
"""Words in brackets, apart from the value: `   [Coriolis]`."""

_DOTS = re.compile(r"\.\.\.[ \t]*(?=\n)")
_ROW_END = re.compile(r"(?<=[^\s=+\-*/,;(\[{&\\.])[ \t]*\n[ \t]*(?=[^\s=+\-*/),;\]])")
"""The end of a line where no sign says that it goes on: within brackets, as in MATLAB, that of a row."""

_NOT_LINE_END = re.compile(r"[^\n]")
FORMULA = "\0"
"""What stands for each character of a formula that is read as such."""

_BLANK_LINE = re.compile(r"\n[ \t]*(?=\n|\Z)")
_ENTRY = re.compile(r"[ \t]*[^\s=\[#%:][^=\n:]*")
"""A line that is one entry of a column, or one row of a matrix, as MATLAB prints it."""

_PARAGRAPH = re.compile(
    rf"(?:{_HEAD}\n(?:[ \t]*\n)?)?(?:(?!{_HEAD}(?:\n|\Z))[^\n]*[^\s][^\n]*(?:\n|\Z))+", re.MULTILINE
)
"""Lines below each other, which may draw one formula; a name and its sign may stand above them alone."""

_POWERS = re.compile(r"[ \t]{2,}[0-9][0-9 \t]*")
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_TRAILING = frozenset("=+-*/,([{&\\")
_LEADING = frozenset("=+-*/)][")


def hidden(text: str, spans: list[tuple[int, int]]) -> str:
    """The text with a sign for what is read elsewhere: no line with one is an equation in plain text."""
    pieces: list[str] = []
    done = 0
    for start, end in sorted(spans):
        if end > done:
            start = max(start, done)
            pieces += [text[done:start], _NOT_LINE_END.sub(FORMULA, text[start:end])]
            done = end
    return "".join([*pieces, text[done:]])


def plain_lines(
    text: str, start: int, end: int, names_answer: Callable[[str], bool]
) -> Iterator[tuple[int, str]]:
    """The equations between two offsets: each with its own, and its text, which has the length it had."""
    position, begins = start, True
    while position < end:
        stop = text.find("\n", position, end)
        stop = end if stop < 0 else stop
        drawn = _PARAGRAPH.match(text, position, end) if begins else None
        if drawn is not None and (equation := one_line(drawn[0], names_answer)):
            yield position, equation
            position = drawn.end()
            continue
        begins = not text[position:stop].strip()
        has_sign = _SIGN.search(text, position, stop) or _SIGN_BELOW.match(text, stop)
        first = _begins(text, position, stop, names_answer) if has_sign else -1
        if first >= 0:
            head, stop = stop, _whole(text, first, stop, end)
            if bottom := _column_end(text, first, head, stop, end):
                yield first, _column(text[first:head], text[head:bottom])
                stop = bottom
            else:
                yield first, _formula(_with_powers(text, first, stop), names_answer)
        position = stop + 1


def _begins(text: str, start: int, stop: int, names_answer: Callable[[str], bool]) -> int:
    """Where the equation of a line begins, behind a list's mark or `Potential energy: `; -1 without one."""
    if text.find(FORMULA, start, stop) >= 0:
        return -1
    lead = _LEAD.match(text, start, stop)
    first = lead.end() if lead else start
    if (spoken := _SPOKEN.match(text, first, stop)) is not None and names_answer(_letter(spoken)):
        return first
    if (named := _NAMED.match(text, first, stop)) is not None and names_answer(named[1]):
        return first
    if not _EQUATION.match(text, first, stop):
        return first if _SIGN_BELOW.match(text, stop) and names_answer(text[first:stop].strip()) else -1
    said = _SAID.match(text, first, stop)
    first = said.end() if said else first
    words = _WORDS.match(text, first, stop)
    heads = [text[at : text.index("=", at)].strip() for at in (first, words.end() if words else first)]
    if words is not None and names_answer(heads[1]) and not names_answer(heads[0]):  # `det J = ...`
        return words.end()
    return first


def _letter(spoken: re.Match[str]) -> str:
    """The name of the answer that words call."""
    return next(name for name in "KPLDg" if spoken[name])


def _with_powers(text: str, first: int, stop: int) -> str:
    """The line with the powers that stand above it, as SymPy's pprint and MATLAB's pretty print them."""
    line = text[first:stop]
    begin = text.rfind("\n", 0, first) + 1
    above = text[text.rfind("\n", 0, max(begin - 1, 0)) + 1 : max(begin - 1, 0)]
    if not _POWERS.fullmatch(above) or "\n" in line:
        return line
    signs = list(line.ljust(len(above) - (first - begin)))
    for found in re.finditer("[0-9]", above):
        at = found.start() - (first - begin)
        at -= at > 1 and signs[at - 1] == " " != signs[at - 2]  # one blank too far to the right
        if at < 1 or signs[at] != " " or signs[at - 1] == " ":
            return line
        signs[at] = _RAISED[int(found[0])]
    return "".join(signs)


def _with_rows(piece: str) -> str:
    """The equation with a semicolon where a line within brackets ends a row."""
    parts, done, depth = list[str](), 0, 0
    for found in _ROW_END.finditer(piece):
        part = piece[done : found.start()]
        depth += part.count("[") - part.count("]")
        parts += [part, f";{found[0][1:]}" if depth > 0 else found[0]]
        done = found.end()
    return "".join(parts) + piece[done:]


def _formula(piece: str, names_answer: Callable[[str], bool]) -> str:
    """The equation without remarks and the dots of lines that go on; `K1: ...` as `K1= ...`."""
    piece = _REMARK.sub(lambda found: " " * len(found[0]), piece)
    piece = _DOTS.sub(lambda found: " " * len(found[0]), _with_rows(piece))
    if (rest := next(rest_is_zero(piece), None)) is not None:
        piece = re.sub(r"[\s,;]{1,9}(?:(?:and|und|og)[ \t]{1,9})?\Z", "", piece[: rest.start()])
    piece = _REMARK_BEHIND.sub("", _SAID_BEHIND.sub("", _TERMINATOR.sub("", piece)))
    piece = _AND.sub(lambda found: ";" + " " * (len(found[0]) - 1), piece)
    if (spoken := _SPOKEN.match(piece)) is not None:
        piece = f"{_letter(spoken):<{spoken.end() - 1}}={piece[spoken.end() :]}"
    named = _NAMED.match(piece)
    if named is not None and names_answer(named[1]):
        at = piece.index(":", named.end(1))
        piece = f"{piece[:at]}={piece[at + 1 :]}"
    return piece


def _whole(text: str, start: int, stop: int, end: int) -> int:
    """Where an equation ends that goes on in the lines below."""
    level, seen = 0, start
    for _ in range(100):
        line = _REMARK.sub("", text[seen:stop]).rstrip()
        goes_on = line.endswith("...")
        line = line.removesuffix("...").rstrip()
        level += sum(map(line.count, "([{")) - sum(map(line.count, ")]}"))
        if line.endswith("=") and seen == start:
            stop = _skip_blank_lines(text, stop, end)
        below = text.find("\n", stop + 1, end)
        below = end if below < 0 else below
        following = text[stop + 1 : below].strip()
        pending = level > 0 or goes_on or line[-1:] in _TRAILING
        leads = following[:1] in _LEADING and not _ITEM.match(following)
        if stop >= end or not following or not (pending or leads):
            break
        seen, stop = stop, below
    return stop


def _column_end(text: str, first: int, head: int, stop: int, end: int) -> int:
    """Where the lines end that MATLAB prints without brackets below `g =`; 0 where there is only one."""
    if not text[first:head].rstrip().endswith("=") or not _BLANK_LINE.match(text, head, end):
        return 0
    blank = _BLANK_LINE.search(text, stop, end)
    below = blank.start() if blank else end
    lines = text[stop:below].split("\n")
    is_column = len(lines) > 1 and all(_ENTRY.fullmatch(line) for line in lines[1:])
    return below if is_column and _ENTRY.fullmatch(text[head:stop].strip("\n \t")) else 0


def _column(head: str, lines: str) -> str:
    """The lines as rows of a matrix: its brackets stand for the first line's end and behind the last."""
    first = len(lines) - len(lines.lstrip())
    blank, entries = lines[:first], lines[first:].rstrip()
    return f"{head}{blank[:-1]}[{entries.replace(chr(10), ';')}]"


def _skip_blank_lines(text: str, stop: int, end: int) -> int:
    """The end of the last blank line below, as MATLAB prints one between `K1 =` and the value."""
    last = stop
    for _ in range(3):
        below = text.find("\n", last + 1, end)
        if below < 0 or text[last + 1 : below].strip():
            break
        last = below
    return last


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
