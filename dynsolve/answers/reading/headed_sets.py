r"""Sets in the lines of a report that a head names, as `Equilibria: $\theta = 0$ or $\theta = \pi$`.

The head is a name of the set, with a colon behind it; what follows on its
line, or the items of the list below, are the alternatives.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from dynsolve.answers.reading.configurations import read_configurations
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.set_text import held_together
from dynsolve.answers.reading.set_words import ALL, AND, ARBITRARY, HEADS, OR, REGARDLESS, STABLE
from dynsolve.answers.reading.sources import Source

_MARK = (
    r"(?:[ \t>*_#+$|-]|\(?(?:[0-9]{1,2}|[A-Za-z])[.)](?=[* \t])|\\(?:item|noindent|par|quad|,|;|:|!|\[|\())*"
)
_FONT = r"(?:\\(?:text\w{0,2}|emph|underline|paragraph\*?|(?:sub){0,2}section\*?|math(?:rm|bf))[ \t]*\{)?"
_HEAD = r"(?P<head>[^\W\d_](?:[^\W\d_]|[ \t'-]){2,60}?)[*_ \t}]*"
_POINT = r"(?:[ \t]*\$?\([^()=\n]{1,60}\)\$?[ \t]*)?"
"""The coordinates in their order, behind a head: `$(q_1, q_2)$`."""

_LINE = re.compile(
    rf"(?m)^{_MARK}(?P<shown>{_FONT}[*_]*{_HEAD}"
    rf"(?:{_POINT}(?:[:=]|\.(?=[*_ \t}}]*\$))[*_ \t}}]*(?P<value>[^\n]*)|(?P<alone>)))$"
)
_ITEM = re.compile(
    r"\n(?:[ \t]*\n)?(?:[ \t]*\\begin\{(?:itemize|enumerate)\}[^\n]*\n)?"
    r"[ \t]*(?:[-*+•]|\(?[0-9a-z]{1,2}[.)]|\\item\b)[ \t]*(?P<value>[^\n]*)"
)
_REMARK = re.compile(
    r"\((?=[^()=\\]*[^\W\d_]{4})[^()=\\]*\)(?!\s*(?:=|∈|\\in))"
    rf"|,?[ \t]+(?:both |all |beide |begge )?(?:{STABLE})\b|^[ \t]*(?:{STABLE})[ \t]*:",
    re.IGNORECASE,
)
_NAME = r"\$?\\?[A-Za-z]\w{0,9}(?:_\{?\w{1,3}\}?)?\$?"
_TURN = r"(?:2[ \t]*(?:\\pi|π)|360(?:°|\^\{?\\circ\}?))"
_HALF = r"(?:\\pi|π|180(?:°|\^\{?\\circ\}?))"
_WHOLE_LINE = (
    rf"(?:(?:\\mathbb[ \t]*\{{?[ \t]*)?[Rℝ]\}}?(?![A-Za-z])|[\[(][ \t]*0[ \t]*,[ \t]*{_TURN}[ \t]*[\])\[]"
    rf"|[\[(\]][ \t]*[-−–][ \t]*{_HALF}[ \t]*,[ \t]*{_HALF}[ \t]*[\])\[])"
)
_ANY = (
    rf"\b(?:{ALL})[ \t]+(?:(?:values? of|Werte?|verdi(?:er)? av)[ \t]+)?{_NAME}"
    rf"(?:[ \t]*(?:∈|\\in\b)[ \t]*{_WHOLE_LINE}\$?)?"
    rf"|\b(?:{REGARDLESS})[ \t]+{_NAME}"
    rf"|{_NAME}[ \t]+(?:(?:is|are|being|may be|can be|ist|er)[ \t]+)?(?:{ARBITRARY})\b[,;]?"
    rf"|{_NAME}[ \t]*(?:∈|\\in\b)[ \t]*{_WHOLE_LINE}\$?(?:[ \t]*(?:{ARBITRARY})\b)?"
)
ANY = re.compile(
    rf"[ \t]{{0,9}}\((?:{_ANY})\)"
    rf"|[,;]?[ \t]{{0,9}}(?:\b(?:with|for|where|mit|bei|für|med|ved|{AND})[ \t]+)?(?:{_ANY})"
)
_DECORATION = re.compile(r"\\bar\b\s*|(?<=[\w}])(?:_\{?eq?\}?(?![A-Za-z0-9])|\^\{?\*\}?)")
_LEADING = re.compile(rf"\A(?:[\s,;]|(?:{AND}|with|for|mit|für|med|ved)\s)+")
_TUPLE = re.compile(r"\(([^()=]{1,80}(?:\([^()]{1,40}\)[^()=]{0,40})?)\)")
_BETWEEN = re.compile(rf"(?:\s|,|;|\b(?:{AND}|{OR})\b|=|∈|\\in\b|\\?[{{}}])*")
_TRAILING = re.compile(r"(?:[\s.,;]|\\\]|\\\)|\\\\|\$\$)+\Z")
_REST = re.compile(
    rf"(?<=\$)[ \t]*(?:\.[ \t]+|[,;][ \t]+(?!(?:.*[ \t])?(?:{AND}|{OR})[ \t]))[^\W\d_][^$=∈\\<>]*\Z"
)
"""What a sentence goes on with behind the last formula of a set."""

_RELATION = re.compile(r"=|∈|\\in\b|\bnone\b|\bno\b")
_MATHEMATICS = re.compile(r"\$|\\[()\[\]]")
_NOT_LINE_END = re.compile(r"[^\n]")
_CLOSING = re.compile(r"(?:\\\]|\\\)|\$\$?)[ \t.,;]*\Z")
_PAIRS = (("\\[", "\\]"), ("\\(", "\\)"))
_BLANK = " \t$*_}"
_BLANKS = re.compile(r"[ \t]+")
_MOST = 200
"""So many lines are looked at."""


@dataclass(frozen=True, slots=True)
class HeadedSet:
    """What stands behind the head of a set, between two offsets of the report."""

    name: str
    start: int
    end: int
    text: str


def headed_sets(text: str, reader: EquationReader) -> list[HeadedSet]:
    """The sets that heads name in a report."""
    asked = [name for name in HEADS if name in reader.vocabulary.quantities]
    coordinates = [q.name for q in reader.vocabulary.coordinates]
    found: list[HeadedSet] = []
    for line in _LINE.finditer(text) if asked else ():
        name = next((name for name in asked if HEADS[name].fullmatch(line["head"])), "")
        if name and len(found) < _MOST and line.start() >= (found[-1].end if found else 0):
            end, values = _values(text, line)
            value = _value(values, coordinates, is_joined=name != "singular")
            if value and _RELATION.search(value):
                start = line.start("shown")
                found.append(HeadedSet(name, start, _before_closing(text, start, end), value))
    return found


def _values(text: str, line: re.Match[str]) -> tuple[int, list[str]]:
    """Where the values of a head end, and these: those of its line, else the items of the list below."""
    if (line["value"] or "").strip(_BLANK):
        return line.end(), [line["value"]]
    end, values = line.end(), list[str]()
    while len(values) < _MOST and (item := _ITEM.match(text, end)) is not None:
        values.append(item["value"])
        end = item.end()
    return end, values


def _before_closing(text: str, start: int, end: int) -> int:
    """The end without the sign that closes a display which was opened before the start."""
    shown = text[start:end]
    closing = _CLOSING.search(shown)
    is_inside = shown.count("$") % 2 == 1 or any(shown.count(a) < shown.count(b) for a, b in _PAIRS)
    return start + closing.start() if closing is not None and is_inside else end


def _value(values: list[str], coordinates: Sequence[str], is_joined: bool) -> str:
    """The values as alternatives of one text, without dollars, and what is said of them beside.

    `is_joined` says that commas of a single value part what holds together.
    """
    plain = []
    for value in values:
        value = _REST.sub("", ANY.sub("", _BLANKS.sub(" ", value)))
        value = _MATHEMATICS.sub(" ", _DECORATION.sub("", ANY.sub("", _REMARK.sub("", value))))
        plain.append(_points(_LEADING.sub("", _TRAILING.sub("", value)).strip(), coordinates))
    return held_together(plain[0]) if is_joined and len(plain) == 1 else " ; ".join(plain)


def _points(text: str, coordinates: Sequence[str]) -> str:
    """Points in parentheses as one set: `(q_1, q_2) = (0, 0), (pi, 0)`; any other text as it is."""
    tuples = [found[1] for found in _TUPLE.finditer(text)]
    rest = _TUPLE.sub("", text)
    sizes = {one.count(",") + 1 for one in tuples}
    if not tuples or _BETWEEN.fullmatch(rest) is None or sizes != {len(coordinates)}:
        return text
    names = ", ".join(coordinates)
    if "=" in rest or "∈" in rest or "\\in" in rest:
        names, *tuples = tuples
    return f"({names}) ∈ {{{', '.join(f'({one})' for one in tuples)}}}"


def read_headed(reader: EquationReader, source: Source, found: Iterable[HeadedSet]) -> None:
    """Read sets that were found, each as an answer file gives it."""
    for one in found:
        read_configurations(reader, one.name, source.place(one.start, 1), one.text, None)


def without(text: str, found: Iterable[HeadedSet]) -> str:
    """The text with blanks for the sets that were found, as long as it was."""
    for one in found:
        text = text[: one.start] + _NOT_LINE_END.sub(" ", text[one.start : one.end]) + text[one.end :]
    return text
