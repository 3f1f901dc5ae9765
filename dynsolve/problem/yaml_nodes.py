"""YAML text -> nodes that know their place, and nothing else that YAML can do.

Only PyYAML's parser of events is used: no composer (it recurses and expands
aliases), no constructor (it runs code for tags), no resolver (it takes `no` for
a boolean, `010` for 8 and `1:30` for 90).  A scalar is its source text.

The syntax errors of YAML's parser, worded so that the writer of a problem file can mend them.

The text of a problem file, and where in it something stands.

Bytes become text here, once: too much of it, another encoding than UTF-8, and
characters that a person cannot see are refused with their place, before any
reader looks at them.
"""

from __future__ import annotations

import re
import unicodedata
from bisect import bisect_right
from functools import cached_property
from itertools import islice
from typing import Any

from msgspec import Struct

from dynsolve.errors import Finding, ProblemError

# The text of a problem file, and where in it something stands

MAX_BYTES = 200_000
"""A larger file is refused unread."""

MAX_FINDINGS = 100
"""After so many errors the rest of them is only counted."""

_LONGEST_EXCERPT = 400

# Controls (save tab and newlines), bidirectional controls, line ends that editors do
# not show, the byte order mark inside a text, and code points that are no characters.
# The marks U+200E and U+200F may stand in a Hebrew or Arabic title; they steer nothing beyond it.
_UNSEEN = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ufeff\ufffe\uffff\ud800-\udfff]"
)


class ProblemText(Struct, frozen=True, dict=True):
    """A problem file's text; `file` is the name that errors carry."""

    text: str
    file: str = ""

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(match.end() for match in re.finditer("\n", self.text))]

    def position(self, index: int) -> tuple[int, int]:
        """Line and column, from 1, of a character."""
        line = bisect_right(self._starts, index)
        return line, index - self._starts[line - 1] + 1

    def line(self, number: int) -> str:
        """The text of a line, from 1, as it is shown under an error."""
        start = self._starts[number - 1]
        end = self._starts[number] - 1 if number < len(self._starts) else len(self.text)
        return _UNSEEN.sub("\ufffd", self.text[start:end].replace("\t", " "))

    def finding(self, start: int, end: int, message: str, help: str = "", code: str = "") -> Finding:
        """What is wrong with the characters from `start` to before `end`."""
        line, column = self.position(min(start, len(self.text)))
        excerpt = self.line(line)
        if len(excerpt) > _LONGEST_EXCERPT:
            excerpt = ""
        length = max(1, min(end - start, len(excerpt) - column + 1)) if excerpt else max(1, end - start)
        return Finding(message, help, self.file, line, column, length, excerpt, code)


def as_source(content: str | bytes, file: str = "") -> ProblemText:
    """The text of a problem file.

    Raises ProblemError for more than `MAX_BYTES`, for bytes that are not UTF-8, and
    for characters that cannot be seen.

    >>> as_source(b"title: x").position(7)
    (1, 8)
    """
    if len(content) > MAX_BYTES:
        message = f"the file is larger than {MAX_BYTES // 1000} kB; a problem file takes a page or two"
        raise ProblemError([Finding(message, "give the problem file itself", file)])
    text = _decoded(content, file) if isinstance(content, bytes) else content
    source = ProblemText(text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n"), file)
    findings = [
        _unseen(source, match.start())
        for match, _ in zip(_UNSEEN.finditer(source.text), range(20), strict=False)
    ]
    if findings:
        raise ProblemError(findings)
    return source


def _decoded(content: bytes, file: str) -> str:
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
            finding = Finding("the file is UTF-16, not UTF-8", "save it with the encoding UTF-8", file, 1, 1)
            raise ProblemError([finding]) from None
        shown = ProblemText(content.decode("utf-8", errors="replace"), file)
        start = len(content[: error.start].decode("utf-8", errors="replace"))
        message = f"the byte 0x{content[error.start]:02x} is not UTF-8"
        finding = shown.finding(start, start + 1, message, "save the file with the encoding UTF-8")
        raise ProblemError([finding]) from None


def _unseen(source: ProblemText, index: int) -> Finding:
    character = source.text[index]
    name = unicodedata.name(character, "a control character")
    message = f"a character that cannot be seen: U+{ord(character):04X} ({name.lower()})"
    return source.finding(index, index + 1, message, "delete it")


class Faults:
    """Collects the errors and warnings of one file while it is read."""

    def __init__(self, source: ProblemText) -> None:
        self.source = source
        self.errors: list[Finding] = []
        self.warnings: list[Finding] = []

    def error(self, span: tuple[int, int], message: str, help: str = "", code: str = "") -> None:
        """Note an error at a span of characters."""
        self.errors.append(self.source.finding(*span, message, help, code))

    def warn(self, span: tuple[int, int], message: str, help: str = "", code: str = "") -> None:
        """Note a warning at a span of characters."""
        self.warnings.append(self.source.finding(*span, message, help, code))

    def found(self) -> list[Finding]:
        """All errors noted so far, in the order of the file; of very many the first."""
        found = sorted(dict.fromkeys(self.errors), key=lambda finding: (finding.line, finding.column))
        shown = found[:MAX_FINDINGS]
        if len(found) > len(shown):
            shown.append(Finding(f"and {len(found) - len(shown)} more", "", self.source.file))
        return shown

    def raise_errors(self) -> None:
        """Raise all errors noted so far as one ProblemError."""
        if self.errors:
            raise ProblemError(self.found())


# The syntax errors of YAML's parser, worded so that the writer of a problem file can mend them

_QUOTES = "put the value in single quotes"


def explain(faults: Faults, error: Any) -> None:
    """Note a syntax error of PyYAML (either of its two parsers) at its place, with a remedy."""
    text = faults.source.text
    problem = (error.problem or "").lower()
    context = (error.context or "").lower()
    at = error.problem_mark.index if error.problem_mark else len(text)
    opened = error.context_mark.index if error.context_mark else at
    start, message, help = _explained(text, problem, context, at, opened)
    faults.error((start, start + 1), message, help)


def _explained(text: str, problem: str, context: str, at: int, opened: int) -> tuple[int, str, str]:
    character = text[at : at + 1]
    if "alias" in context or "anchor" in context:
        return (
            opened,
            "a value cannot begin with `*` or `&`",
            f"the star of a joint variable stands after its name: theta1*; else {_QUOTES}",
        )
    if (tab := _indenting_tab(text, at)) is not None:
        return tab, "a tab cannot indent in YAML", "indent with blanks"
    if "quoted scalar" in context:
        return _quoted(text, problem, at, opened)
    if "flow" in context and character != "-" and "node" not in context:
        return _bracket(text, at, opened)
    if "mapping values are not allowed" in problem:
        return (
            at,
            "this `:` cannot stand here",
            "indent the keys of one mapping alike; a value that holds `: ` is put in single quotes",
        )
    if character in tuple("@`%|>"):
        return at, f"a value cannot begin with `{character}`", _QUOTES
    if character == "-" and text[text.rfind("\n", 0, at) + 1 : at].strip():
        return at, "`- ` begins an item of a list", f"write a minus without a blank after it, or {_QUOTES}"
    if character in ("]", "}"):
        return at, f"this `{character}` closes nothing", "delete it, or add the bracket that it belongs to"
    if character == "," or "node" in context:
        return at, "a value is missing here", "write it, or delete the comma"
    if "could not find expected ':'" in problem:
        return opened, "a `:` is missing after this key", "write `key: value`, a blank after the colon"
    if "expected key" in problem or "block" in problem or "block" in context:
        return (
            at,
            "this line does not fit into the structure",
            "indent the keys of one mapping, and the items of one list, alike",
        )
    return (
        at,
        f"this is not YAML: {problem or 'syntax error'}",
        "compare it with the file that `dynsolve new` writes",
    )


def _indenting_tab(text: str, at: int) -> int | None:
    """Where a tab stands before the first word of the line at fault."""
    start = text.rfind("\n", 0, at) + 1
    indent = text[start : len(text) - len(text[start:].lstrip(" \t"))]
    tab = indent.find("\t")
    return start + tab if tab >= 0 else None


def _quoted(text: str, problem: str, at: int, opened: int) -> tuple[int, str, str]:
    if "escape" in problem:
        return (
            max(text.rfind("\\", opened, at + 1), opened),
            "an escape that YAML does not know",
            "in double quotes `\\` begins an escape: use single quotes",
        )
    return opened, "this quote is never closed", "close it"


def _bracket(text: str, at: int, opened: int) -> tuple[int, str, str]:
    bracket = text[opened : opened + 1]
    closing = {"{": "}", "[": "]"}.get(bracket, "bracket")
    same_line = "\n" not in text[opened:at].rstrip()
    if same_line and (latex := re.search(r"\\[a-zA-Z]+", text[opened:at])):
        message = f"`{latex[0]}` is LaTeX, which has no meaning here"
        return opened + latex.start(), message, "write plain text: theta1, pi/2 or 90deg, a/b, sqrt(2)"
    if same_line and at < len(text) and text[at] not in "\n]}":
        return (
            at,
            "a comma is missing before this",
            f"entries between `{bracket}` and `{closing}` are separated by commas",
        )
    if same_line and text[at : at + 1] in ("]", "}"):
        return at, f"this `{text[at]}` does not close the `{bracket}`", f"write `{closing}`"
    return opened, f"this `{bracket}` is never closed", f"add the `{closing}` that it belongs to"


MAX_DEPTH = 12
"""A problem file needs five levels."""

MAX_EVENTS = 50_000

Span = tuple[int, int]


class ScalarNode(Struct, frozen=True):
    """A value: `text` is the source between its quotes, which begins at character `start`.

    `decoded` is what YAML makes of it (escapes resolved, lines folded): for titles.
    """

    text: str
    start: int
    span: Span
    decoded: str


class ListNode(Struct, frozen=True):
    """A list."""

    items: tuple[YamlNode, ...]
    span: Span


class MappingNode(Struct, frozen=True):
    """Keys with their values, in order."""

    entries: tuple[tuple[ScalarNode, YamlNode], ...]
    span: Span


class FaultyNode(Struct, frozen=True):
    """Something that was reported already; whoever meets it leaves it alone."""

    span: Span


YamlNode = ScalarNode | ListNode | MappingNode | FaultyNode


_DIGITS = re.compile("[+-]?[0-9]+")


def decimal_comma(before: YamlNode, after: YamlNode) -> str:
    """The number that two values next to each other were meant as: 9.81 of 9,81; empty for any others."""
    if not (isinstance(before, ScalarNode) and isinstance(after, ScalarNode)):
        return ""
    adjoin = before.span[1] + 1 == after.span[0] and after.text.isdecimal()
    return f"{before.text}.{after.text}" if adjoin and _DIGITS.fullmatch(before.text) else ""


def write_point(number: str) -> str:
    """The remedy for a decimal comma."""
    return f"did you mean {number}? A decimal is written with a point"


def too_many(node: ListNode, help: str) -> str:
    """The remedy for a list of the wrong length: a decimal comma in it, where there is one."""
    pairs = zip(node.items, node.items[1:], strict=False)
    found = next(filter(None, (decimal_comma(one, other) for one, other in pairs)), "")
    return write_point(found) if found else help


def read_nodes(faults: Faults) -> YamlNode | None:
    """The root node of the source of `faults`; None for an empty file or wrong YAML syntax."""
    import yaml

    loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    text = faults.source.text
    tree = _Tree(faults)
    try:
        for event in islice(yaml.parse(text, Loader=loader), MAX_EVENTS):
            if not tree.take(event):
                return tree.root
    except yaml.MarkedYAMLError as error:
        explain(faults, error)
        return None
    faults.error(
        (len(text), len(text)), f"the file has more than {MAX_EVENTS} parts", "give the problem file itself"
    )
    return None


class _Open:
    """A list or mapping whose end has not come yet."""

    def __init__(self, kind: str, start: int) -> None:
        self.kind, self.start = kind, start
        self.items: list[YamlNode] = []


class _Tree:
    """Builds nodes from events on a stack of its own: no depth of nesting can exhaust Python's."""

    def __init__(self, faults: Faults) -> None:
        self.faults = faults
        self.root: YamlNode | None = None
        self.open: list[_Open] = []
        self.documents = 0

    def take(self, event: Any) -> bool:
        """Take one event in; False ends the reading."""
        kind = type(event).__name__
        start, end = event.start_mark.index, event.end_mark.index
        if kind == "StreamEndEvent":
            return False
        if kind == "DocumentStartEvent":
            return self._document(start, end)
        if kind in ("SequenceStartEvent", "MappingStartEvent"):
            self._properties(event)
            self.open.append(_Open(kind, start))
            if len(self.open) > MAX_DEPTH:
                self.faults.error(
                    (start, start + 1), f"more than {MAX_DEPTH} levels of nesting", "write it flatter"
                )
                self.root = None
                return False
        elif kind in ("SequenceEndEvent", "MappingEndEvent"):
            self._place(self._closed(end))
        elif kind == "ScalarEvent":
            self._properties(event)
            self._place(self._scalar(event, start, end))
        elif kind == "AliasEvent":
            self._alias(event.anchor, start, end)
        return True

    def _document(self, start: int, end: int) -> bool:
        self.documents += 1
        if self.documents == 2:
            message = "a second document begins here; a problem file holds one robot"
            self.faults.error(
                (start, max(end, start + 3)), message, "put the other robot in a file of its own"
            )
        return self.documents < 2

    def _properties(self, event: Any) -> None:
        """Anchors and tags: neither has a use here."""
        start = event.start_mark.index
        if event.anchor:
            span = (start, start + len(event.anchor) + 1)
            self.faults.error(
                span, f"`&{event.anchor}` is a YAML anchor, which a problem file has no use for", "delete it"
            )
        if event.tag:
            text = self.faults.source.text
            length = len(text[start:].split(None, 1)[0]) if text[start : start + 1] == "!" else 1
            message = "a YAML tag (`!...`) has no meaning in a problem file"
            self.faults.error((start, start + length), message, "delete it")

    def _alias(self, name: str, start: int, end: int) -> None:
        message = f"`*{name}` is a YAML alias, which a problem file has no use for"
        help = f"the star of a joint variable stands after its name: {name}*"
        self.faults.error((start, end), message, help)
        self._place(FaultyNode((start, end)))

    def _scalar(self, event: Any, start: int, end: int) -> ScalarNode:
        source = self.faults.source.text
        style = event.style
        text_start, text_end = start, end
        if event.anchor or event.tag:
            text_start = max(start, end - len(event.value)) if not style else source.find(style, start, end)
        if style in ("'", '"'):
            text_start, text_end = text_start + 1, end - 1
        elif style in ("|", ">"):
            line_end = source.find("\n", start, end)
            text_start = line_end + 1 if line_end >= 0 else end
            text_end = text_start + len(source[text_start:text_end].rstrip())
        return ScalarNode(source[text_start:text_end], text_start, (start, max(end, start)), event.value)

    def _closed(self, end: int) -> YamlNode:
        done = self.open.pop()
        text = self.faults.source.text
        end = done.start + len(text[done.start : end].rstrip())
        if done.kind == "SequenceStartEvent":
            return ListNode(tuple(done.items), (done.start, end))
        return MappingNode(self._entries(done.items), (done.start, end))

    def _entries(self, items: list[YamlNode]) -> tuple[tuple[ScalarNode, YamlNode], ...]:
        entries: dict[str, tuple[ScalarNode, YamlNode]] = {}
        last = ""
        for key, value in zip(items[::2], items[1::2], strict=True):
            if isinstance(key, FaultyNode):
                continue
            if last and (whole := decimal_comma(entries[last][1], key)) and value.span[0] == value.span[1]:
                before = entries[last]
                span = (before[1].span[0], key.span[1])
                self.faults.error(span, f"{whole.replace('.', ',')} is cut at its comma", write_point(whole))
                entries[last] = (before[0], FaultyNode(span))
                continue
            if not isinstance(key, ScalarNode):
                self.faults.error(key.span, "a key is a word, not a list or a mapping", "write `key: value`")
            elif key.decoded in entries:
                line, _ = self.faults.source.position(entries[key.decoded][0].span[0])
                message = f"`{key.decoded}` is given twice, first in line {line}"
                self.faults.error(key.span, message, "keep one of them")
            else:
                entries[key.decoded] = (key, value)
                last = key.decoded
        return tuple(entries.values())

    def _place(self, node: YamlNode) -> None:
        if self.open:
            self.open[-1].items.append(node)
        elif self.root is None:
            self.root = node
