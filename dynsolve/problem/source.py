"""The text of a problem file, and where in it something stands.

Bytes become text here, once: too much of it, another encoding than UTF-8, and
characters that a person cannot see are refused with their place, before any
reader looks at them.
"""

from __future__ import annotations

import re
import unicodedata
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property

from dynsolve.errors import Finding, ProblemError

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


@dataclass(frozen=True)
class ProblemText:
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
