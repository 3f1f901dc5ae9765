r"""The answer file: YAML as libraries and people write it.

A file that is valid YAML, or JSON, means what YAML says (`yaml_values`), its scalars taken as they
stand between their quotes (`yaml_scalars`).  Only a file that YAML refuses is cut key by key
(`answer_lines`), and each value then tried as YAML by itself, so that one bad line makes one
answer unreadable and never the file.  Nothing is expanded, converted or constructed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from dynsolve.answers.reading import answer_lines, dh_tables, yaml_values
from dynsolve.answers.reading.configurations import read_configurations
from dynsolve.answers.reading.definitions import own_symbols
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.given_values import announce, read_value
from dynsolve.answers.reading.limits import MAX_ANSWERS
from dynsolve.answers.reading.placed_text import PlacedText
from dynsolve.answers.reading.plain_lines import hidden
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.reading.span_text import span_text
from dynsolve.answers.reading.unread_text import list_unread_keys
from dynsolve.answers.reading.verdicts import read_verdicts
from dynsolve.answers.reading.yaml_values import NotYaml, YamlNode
from dynsolve.errors import Finding
from dynsolve.quantities.spelling import key

KEYS = ("problem", "student", "symbols", "let", "atan2", "answers")
"""The keys of an answer file."""

X_FIRST = "xy"
"""What `atan2` says where the student's takes x first, as the first edition of Spong has it."""


@dataclass(frozen=True, slots=True)
class Entry:
    """A key, the offset that it stands at, and its value, None where it is blank.

    `node` is the value as YAML has it, None in a file that YAML refuses.
    """

    key: str
    at: int
    value: PlacedText | None
    node: YamlNode | None = None


@dataclass(frozen=True, slots=True)
class AnswerFile:
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
            if (verdicts := reader.vocabulary.verdicts_named(entry.key)) is not None:
                text = source.text if entry.node is not None else entry.value.text
                read_verdicts(reader, verdicts, place, text, entry.node)
                continue
            if (configurations := reader.vocabulary.set_named(entry.key)) is not None:
                text = source.text if entry.node is not None else entry.value.text
                takes_x_first = file.takes_x_first
                read_configurations(
                    reader, configurations, place, text, entry.node, takes_x_first=takes_x_first
                )
                continue
            read_value(reader, entry.key, place, _as_rows(reader, entry, entry.value).display(source))
    known = [*entries, *(entry for is_symbol, entry in file.names if is_symbol)]
    read = [(e.at, e.value.origin(len(e.value.text)) if e.value else e.at + len(e.key)) for e in known]
    list_unread_keys(reader, source, hidden(source.text, read))
    return (file.problem, file.student), faults


def _as_rows(reader: EquationReader, entry: Entry, value: PlacedText) -> PlacedText:
    """The text of a value; of a table that is drawn in a block of text its rows, of a space its vectors."""
    if reader.vocabulary.is_space(entry.key):
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
    found = answer_lines.entries(text)
    named = {entry.key: entry for entry in found}
    names = [
        (part == "symbols", Entry(entry.key, entry.at, answer_lines.value_of(text, entry)))
        for part in ("symbols", "let")
        for entry in answer_lines.inner(text, named.get(part))
    ]
    inside = answer_lines.inner(text, named.get("answers"))
    beside = [entry for entry in found if entry.key not in KEYS]
    answers = [
        Entry(entry.key, entry.at, answer_lines.value_of(text, entry))
        for entry in [*inside, *beside][:MAX_ANSWERS]
    ]
    problem, student, order = (
        answer_lines.word(text, named.get(part)) for part in ("problem", "student", "atan2")
    )
    return AnswerFile(problem, student, tuple(names), tuple(answers), order == X_FIRST)


def _text(entry: Entry) -> PlacedText:
    return entry.value if entry.value is not None else PlacedText("", (0,), (entry.at,))


def _finding(source: Source, entry: Entry, message: str, help: str) -> Finding:
    place = source.place(_text(entry).origin(0))
    return Finding(f"{entry.key}: {message}", help, source.file, place.line, place.column, 1, place.excerpt)
