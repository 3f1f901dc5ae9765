r"""The answer file: YAML as libraries and people write it.

A file that is valid YAML, or JSON, means what YAML says (`yaml_values`), its scalars taken as they
stand between their quotes (`yaml_values`).  Only a file that YAML refuses is cut key by key
(`entries`), and each value then tried as YAML by itself, so that one bad line makes one
answer unreadable and never the file.  Nothing is expanded, converted or constructed.

A value is whatever stands between one key and the next, so that `\frac{a}{b}` in a list, a tag
or a bracket that never closes spoils that value alone.

    definite: {Ma: "no", Mb: yes, Mc: if}
    definite: yes                              # where there is one matrix

YAML's `no` and `yes` are the words that they look like.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.answers.reading import dh_tables, yaml_values
from dynsolve.answers.reading.answer_list import Member, Origin
from dynsolve.answers.reading.asides import list_unread_keys
from dynsolve.answers.reading.configurations import read_configurations
from dynsolve.answers.reading.displays import Display, chain
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grids import MAX_ANSWERS, MAX_MEMBERS, Abstract
from dynsolve.answers.reading.left_side import (
    LeftSide,
    NamedAnswers,
    RightSide,
    UnknownSide,
    read_left_side,
    read_right_side,
    side_of,
)
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.matrix_parts import part_of, shown
from dynsolve.answers.reading.name_splitting import keep_symbol
from dynsolve.answers.reading.plain import plain_member
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.set_text import span_text
from dynsolve.answers.reading.sources import HIDDEN, PlacedText, Source, hidden, placed
from dynsolve.answers.reading.vocabulary import SET_KINDS, Meaning
from dynsolve.answers.reading.yaml_values import NotYaml, YamlNode, documents, value, without_delimiters
from dynsolve.answers.verdict import Answer, NotRecognized, Place, VerdictAnswer
from dynsolve.errors import Finding, ReadError
from dynsolve.notation.tree import Node
from dynsolve.quantities.family import Kind
from dynsolve.quantities.letters import key

# Answer files that YAML refuses, key by key and line by line

_KEY = re.compile(
    r"""([ \t]*)("[^"\n]{1,200}"|'[^'\n]{1,200}'|[^\s:#\-\[\]{},][^:\n]{0,200}?|-[^\s:][^:\n]{0,50}?)"""
    r"[ \t]{0,20}:(?=[ \t]|$)"
)
_BLOCK = re.compile(r"[|>][+-]?[0-9]?[+-]?[ \t]*(?:#[^\n]*)?$", re.MULTILINE)
_ITEM = re.compile(r"[ \t]*-(?=[ \t]|$)")
_TIGHT = re.compile(r"""([ \t]*)("[^"\n]{1,200}"|'[^'\n]{1,200}'|[^\s:,]{1,80})[ \t]{0,9}:""")
_QUOTED_KEY = re.compile(r"""[ \t]*["'][^"'\n]{1,200}["'][ \t]{0,20}:""")
_FLOW_END = re.compile(r"[,}\s]*\Z")


class KeyedText(Struct, frozen=True):
    """A key with the stretch of text that is its value."""

    key: str
    at: int
    start: int
    end: int


def entries(text: str) -> list[KeyedText]:
    """The keys of the file with their values."""
    if text.lstrip().startswith("{"):
        return list(_braced(text, 0, len(text)))
    return list(_block(text, 0, len(text)))


def inner(text: str, entry: KeyedText | None) -> Iterator[KeyedText]:
    """The entries of a mapping in either style."""
    if entry is None:
        return
    if text[entry.start : entry.end].lstrip().startswith("{"):
        yield from _braced(text, entry.start, entry.end)
        return
    yield from _block(text, text.find("\n", entry.start, entry.end) + 1 or entry.end, entry.end)


def _braced(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of {key: value, ...}: by lines where each begins with a key, else by the commas."""
    opening = text.index("{", start, end)
    line_end = text.find("\n", opening, end)
    if line_end >= 0 and not text[opening + 1 : line_end].strip() and _QUOTED_KEY.match(text, line_end + 1):
        for entry in _block(text, line_end + 1, end):
            closing = _FLOW_END.search(text, entry.start, entry.end)
            is_mapping = text[entry.start : entry.end].lstrip().startswith("{")
            stop = entry.end if is_mapping or closing is None else closing.start()
            yield KeyedText(entry.key, entry.at, entry.start, stop)
        return
    closing_brace = text.rfind("}", opening, end)
    yield from _flow(text, opening + 1, closing_brace if closing_brace > opening else end)


def word(text: str, entry: KeyedText | None) -> str:
    """The first line of a value, without quotes."""
    if entry is None:
        return ""
    found = text[entry.start : entry.end].split("\n")[0].split(" #")[0].strip().strip("'\"")
    return found[:200]


def value_of(text: str, entry: KeyedText) -> PlacedText | None:
    """A value by itself: as YAML, else as it stands; None where it is null or blank."""
    line = text.rfind("\n", 0, entry.at) + 1
    indent = entry.at - line if not text[line : entry.at].strip(" ") else 0
    try:
        (root,) = documents(" " * indent + text[entry.at : entry.end])
        ((_, node),) = root.entries()
        found = value(" " * indent + text[entry.at : entry.end], node)
    except (NotYaml, ValueError):
        return _as_it_stands(text, entry.start, entry.end)
    if found is None:
        return None
    shift = entry.at - indent
    return PlacedText(found.text, found.starts, tuple(origin + shift for origin in found.origins))


def _block(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of a block mapping: a key and all that follows up to the next key of its indentation."""
    indent: int | None = None
    current: tuple[str, int, int] | None = None
    position, level = start, 0
    while position < end:
        stop = text.find("\n", position, end)
        stop = end if stop < 0 else stop
        found = _KEY.match(text, position, stop)
        blank = text[position:stop].lstrip()[:1] in ("", "#")
        if found is not None and not blank and (indent is None or _width(found[1]) <= indent) and level <= 0:
            indent = _width(found[1]) if indent is None else indent
            if current is not None:
                yield KeyedText(current[0], current[1], current[2], position)
            current = (found[2].strip("'\"").strip(), found.start(2), found.end())
            level = _balance(text, found.end(), stop)
        elif current is not None:
            level = max(level + _balance(text, position, stop), 0) if not found or level < 5 else 0
            if found is not None and indent is not None and _width(found[1]) <= indent:
                yield KeyedText(current[0], current[1], current[2], position)
                current, level = (found[2].strip("'\"").strip(), found.start(2), found.end()), 0
        position = stop + 1
    if current is not None:
        yield KeyedText(current[0], current[1], current[2], end)


def _width(indent: str) -> int:
    return len(indent.expandtabs(8))


def _balance(text: str, start: int, stop: int) -> int:
    """How many square brackets stay open in a line."""
    return text.count("[", start, stop) - text.count("]", start, stop)


def _flow(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of {key: value, key: value}."""
    piece = start
    for position in [*_separators(text, start, end), end]:
        first = _BLANK.match(text, piece, position)
        begin = first.end() if first else piece
        found = _KEY.match(text, begin, position) or _TIGHT.match(text, begin, position)
        if found is not None:
            yield KeyedText(found[2].strip("'\"").strip(), found.start(2), found.end(), position)
        piece = position + 1


_MARK = re.compile(r"""(?<=[\[{,:( ])"(?:[^"\\\n]|\\.)*"|(?<=[\[{,: ])'[^'\n]*'(?=\s*[,:}\]])|[()\[\]{},]""")


def _separators(text: str, start: int, end: int) -> Iterator[int]:
    """The commas that stand in no bracket and between no quotes."""
    level = 0
    for found in _MARK.finditer(text, start, end):
        if found[0] in "([{":
            level += 1
        elif found[0] in ")]}":
            level -= 1
        elif found[0] == "," and level <= 0:
            yield found.start()


_BLANK = re.compile(r"\s*")


def _as_it_stands(text: str, start: int, end: int) -> PlacedText:
    """The value of an entry without quotes, comments and the signs of block style."""
    first, value = start, text[start:end].rstrip()
    skipped = len(value) - len(value.lstrip())
    start, value = start + skipped, value[skipped:]
    block = _BLOCK.match(value)
    if block is not None:
        start, value = start + block.end(), value[block.end() :]
    elif len(value) > 1 and value[0] in "'\"" and (inner := _unquoted(value)) is not None:
        start, value = start + 1, inner
    else:
        value = _without_comments(value)
        if "\n" in text[first:start] and _ITEM.match(value):
            value = _listed(value)
    return without_delimiters(placed([(value, start)]))


def _unquoted(value: str) -> str | None:
    """What stands between quotes that enclose the value, None where they do not."""
    closing = value.rfind(value[0])
    after = value[closing + 1 :].strip()
    if closing > 0 and (not after or after[0] == "#") and "\n\n" not in value:
        return value[1:closing]
    return None


def _without_comments(value: str) -> str:
    """The value with blanks in place of `# ...` behind a blank; a value that is one stays."""
    lines = value.split("\n")
    kept = []
    for number, line in enumerate(lines):
        at = line.find(" #")
        if number and line.lstrip().startswith("#"):
            at = 0
        kept.append(line if at < 0 else line[:at] + " " * (len(line) - at))
    return "\n".join(kept).rstrip()


def _listed(value: str) -> str:
    """A block list as [a, b], every character where it was."""
    lines = value.split("\n")
    indent = len(lines[0]) - len(lines[0].lstrip())
    items = [i for i, line in enumerate(lines) if _ITEM.match(line)]
    if len(items) < 2:
        return value
    for number, i in enumerate(items):
        dash = lines[i].index("-")
        lines[i] = lines[i][:dash] + ("," if number else "[") + lines[i][dash + 1 :]
    return "\n".join(lines) + "]" if indent >= 0 else value


# The student's own names: `symbols: {q1: theta1 - 90deg}` and `let: {h: m2*l1*lc2*sin(q2)}`


def own_symbols(reader: EquationReader, display: Display, name: str, is_symbol: bool) -> ReadError | None:
    """Keep one of the student's names; the error where its meaning cannot be read."""
    try:
        shown = prepared(name)[:-1]
        plain = key("".join(t.text for t in shown if t.kind in ("name", "letter", "number")))
        dots = sum(t.dots + (t.text == "dot") + 2 * (t.text == "ddot") for t in shown)
        tokens = prepared(display.text, reader.macros)[:-1]
    except ReadError as error:
        reader.vocabulary.cannot_be_read(key(name), error.message)
        return error
    found = read_right_side(reader.vocabulary, tokens)
    if isinstance(found, ReadError):
        reader.vocabulary.cannot_be_read(plain, found.message)
        return found
    if isinstance(found.value, Abstract):
        return ReadError(found.value.why, 0, 1, "write it in the symbols of the problem")
    if not plain:
        return ReadError("this is no name", 0, 1, "a name is a letter with an index: q1")
    if is_symbol:
        if not dots and isinstance(found.value, Node):
            reader.coordinates.append(found.value)
        keep_symbol(reader.vocabulary, plain, dots, found.value)
    else:
        reader.vocabulary.define(plain, Meaning(found.value))
    return None


# Answers that are verdicts on matrices

_WORDS = {
    "yes": ("yes", "y", "true", "ja", "possible", "can be", "definite", "positive definite"),
    "no": ("no", "n", "false", "nei", "nein", "impossible", "cannot be", "not", "not positive definite"),
    "if": ("if", "sometimes", "conditional", "conditionally", "depends", "under conditions"),
}
_MEANINGS = {word: meaning for meaning, words in _WORDS.items() for word in words}
_EXPECTED = 'write yes, no or if, of several matrices by their names: {Ma: "no", Mb: "yes"}'


def read_verdicts(reader: EquationReader, name: str, place: Place, text: str, node: YamlNode | None) -> None:
    """Read yes, no or if of each matrix; what cannot be read makes the answer unreadable, with its reason."""
    written = text.strip() if node is None else text[node.start : node.end].strip()
    try:
        root = node or yaml_values.root_of(text)
        if root is None:
            raise ReadError("this is no verdict", 0, 1, _EXPECTED)
        found = VerdictAnswer(name, place, written, tuple(_words(text, root)))
    except ReadError as error:
        found = VerdictAnswer(name, place, written, fault=error.message, expected=error.help)
    reader.found.verdicts.append(found)


def _words(text: str, root: YamlNode) -> Iterator[tuple[str, str]]:
    """(name of the matrix, or nothing, and yes, no or if)"""
    pairs = list(root.entries())
    if not pairs:
        yield "", _meaning(yaml_values.word(text, root))
    for name, entry in pairs:
        yield yaml_values.word(text, name), _meaning(yaml_values.word(text, entry))


def _meaning(word: str) -> str:
    plain = word.strip().strip("\"'.").lower()
    if plain not in _MEANINGS:
        raise ReadError(f"`{word[:40]}` is neither yes nor no", 0, 1, _EXPECTED)
    return _MEANINGS[plain]


# The values of an answer file, each of which stands under the name of its answer


def read_value(reader: EquationReader, name: str, place: Place, display: Display) -> None:
    """Read the value that an answer file gives under a name."""
    origin = reader.origin(display, display.label)
    if members := _of_several(reader, name, display):
        reader.read_part(members, replace(origin, names=part_of(reader.vocabulary, members[0])))
        return
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


def _of_several(reader: EquationReader, name: str, display: Display) -> list[list[Token]]:
    """The name and its value, where it names several answers at once; nothing for every other."""
    try:
        first = prepared(name)[:-1]
        if not part_of(reader.vocabulary, first):
            return []
        return [first, *chain(prepared(display.text, reader.macros))]
    except ReadError:
        return []


def announce(reader: EquationReader, name: str) -> None:
    """Keep that a file gives the answer of this letter, or the entry of a matrix, wherever it stands."""
    side = _key(reader, name)
    if isinstance(side, NamedAnswers):
        reader.vocabulary.gives(side.candidates[0])
        reader.vocabulary.calls(key(name))


def _key(reader: EquationReader, name: str) -> LeftSide:
    """What a key of an answer file names."""
    if name.startswith("I") and reader.vocabulary.is_answer(name):
        return NamedAnswers((name,))
    return side_of(reader.vocabulary, name)


def _given(reader: EquationReader, candidates: tuple[str, ...], origin: Origin) -> list[Answer]:
    """The answers that the members of a value are."""
    found = reader.found
    if plain := plain_member(reader.vocabulary, origin.display.text, 0, 0, candidates):
        return found.value([candidates], plain, origin)
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


KEYS = ("problem", "student", "symbols", "let", "atan2", "answers")
"""The keys of an answer file."""

X_FIRST = "xy"
"""What `atan2` says where the student's takes x first, as the first edition of Spong has it."""


class Entry(Struct, frozen=True):
    """A key, the offset that it stands at, and its value, None where it is blank.

    `node` is the value as YAML has it, None in a file that YAML refuses.
    """

    key: str
    at: int
    value: PlacedText | None
    node: YamlNode | None = None


class AnswerFile(Struct, frozen=True):
    """What an answer file says: whose it is, for which problem, its names and its answers."""

    problem: str
    student: str
    names: tuple[tuple[bool, Entry], ...]
    answers: tuple[Entry, ...]
    takes_x_first: bool = False
    """`names` are (whether it is one of `symbols`, entry); `takes_x_first`: the student's atan2 does."""


def read_answer_file(reader: EquationReader, source: Source) -> tuple[tuple[str, str], list[Finding]]:
    """Read an answer file; gives (problem, student) as it says, and what is wrong with the file."""
    file = parsed(source.text)
    faults: list[Finding] = []
    for is_symbol, entry in file.names:
        fault = own_symbols(reader, _text(entry).display(source), entry.key, is_symbol)
        if fault is not None:
            faults.append(_finding(source, entry, fault.message, fault.help))
    if not file.answers:
        message = "there are no answers in this file"
        faults.append(Finding(message, "write them under `answers:`, one a line: K: m1*L1", source.file))
    entries = file.answers[:MAX_ANSWERS]
    for entry in entries:
        announce(reader, entry.key)
    for entry in entries:
        if entry.value is not None:
            place = source.place(entry.at, len(entry.key))
            text = source.text if entry.node is not None else entry.value.text
            named = reader.vocabulary.named_of_kind
            if verdicts := named(entry.key, Kind.VERDICTS):
                read_verdicts(reader, verdicts, place, text, entry.node)
            elif configurations := named(entry.key, *SET_KINDS):
                turned = file.takes_x_first
                read_configurations(reader, configurations, place, text, entry.node, takes_x_first=turned)
            else:
                read_value(reader, entry.key, place, _as_rows(reader, entry, entry.value).display(source))
    known = [*entries, *(entry for is_symbol, entry in file.names if is_symbol)]
    read = [(e.at, e.value.origin(len(e.value.text)) if e.value else e.at + len(e.key)) for e in known]
    list_unread_keys(reader, source, hidden(source.text, read, HIDDEN))
    return (file.problem, file.student), faults


def _as_rows(reader: EquationReader, entry: Entry, value: PlacedText) -> PlacedText:
    """The text of a value; of a table that is drawn in a block of text its rows, of a space its vectors."""
    if reader.vocabulary.named_of_kind(entry.key, Kind.SPAN):
        return span_text(value, lambda word: reader.vocabulary.symbol(key(word)) is not None)
    if entry.key != dh_tables.NAME or "\n" not in value.text:
        return value
    names = [q.name for q in reader.vocabulary.coordinates]
    tables = dh_tables.tables_of(value.text, names)
    return tables[0].value.within(value) if tables else value


def parsed(text: str) -> AnswerFile:
    """The parts of an answer file."""
    try:
        roots = yaml_values.documents(text)
    except NotYaml:
        return _by_lines(text)
    top = [entry for root in roots for entry in root.entries()]
    nodes = {yaml_values.word(text, name): node for name, node in top}
    if not nodes:
        return _by_lines(text)
    names = [
        (part == "symbols", entry)
        for part in ("symbols", "let")
        if part in nodes
        for entry in _entries(text, nodes[part].entries())
    ]
    inside = _entries(text, nodes["answers"].entries()) if "answers" in nodes else ()
    beside = (pair for pair in top if yaml_values.word(text, pair[0]) not in KEYS)
    problem, student, order = (
        yaml_values.word(text, nodes[part])[:200] if part in nodes else ""
        for part in ("problem", "student", "atan2")
    )
    answers = (*inside, *_entries(text, beside))
    return AnswerFile(problem, student, tuple(names), answers, order == X_FIRST)


def _entries(text: str, pairs: Iterable[tuple[YamlNode, YamlNode]]) -> Iterator[Entry]:
    for name, node in pairs:
        yield Entry(yaml_values.word(text, name), name.start, yaml_values.value(text, node), node)


def _by_lines(text: str) -> AnswerFile:
    """The parts of a file that YAML refuses."""
    found = entries(text)
    named = {entry.key: entry for entry in found}
    names = [
        (part == "symbols", Entry(entry.key, entry.at, value_of(text, entry)))
        for part in ("symbols", "let")
        for entry in inner(text, named.get(part))
    ]
    inside = inner(text, named.get("answers"))
    beside = [entry for entry in found if entry.key not in KEYS]
    answers = [
        Entry(entry.key, entry.at, value_of(text, entry)) for entry in [*inside, *beside][:MAX_ANSWERS]
    ]
    problem, student, order = (word(text, named.get(part)) for part in ("problem", "student", "atan2"))
    return AnswerFile(problem, student, tuple(names), tuple(answers), order == X_FIRST)


def _text(entry: Entry) -> PlacedText:
    return entry.value if entry.value is not None else PlacedText("", (0,), (entry.at,))


def _finding(source: Source, entry: Entry, message: str, help: str) -> Finding:
    place = source.place(_text(entry).origin(0))
    return Finding(f"{entry.key}: {message}", help, source.file, place.line, place.column, 1, place.excerpt)
