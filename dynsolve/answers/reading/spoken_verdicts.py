r"""Verdicts on matrices in the lines of a report: `$M_a$: no`, `| $M_b$ | yes |`, `M_c is not valid`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from dynsolve.answers.reading.sources import Source
from dynsolve.answers.submission import VerdictAnswer
from dynsolve.quantities.spelling import key

_NAME = r"(?<![A-Za-z_\\])(?P<name>[A-Za-z]\}?(?:_?\{?[A-Za-z0-9]{1,4}\}?)?)(?:\([^()\n]{0,9}\))?"
_SAID = re.compile(rf"{_NAME}[ \t$*`}}|:=→-]*(?P<said>[^\n,;|:=$]{{1,90}})")
_HEAD = re.compile(r"[^A-Za-z\n]*(?:textbf\{)?(?:positive[ -])?definite[^A-Za-z\n]*[:=]", re.IGNORECASE)
_IS_ONE = re.compile(r"(?:inertia matri|positive[ -]definite|\bcan be\b|\bcould be\b|admissible|\bvalid\b)")
_NOT = re.compile(r"\b(?:not|cannot|can't|never|isn't|non)\b")
_BEGINNINGS = {
    "yes": re.compile(r"(?:yes|ja|true|possible|ok|✓|✔)(?!\w)"),
    "no": re.compile(r"(?:no|nei|nein|false|impossible|✗|✘|×)(?!\w)"),
    "if": re.compile(r"(?:(?:only )?if|conditional(?:ly)?|sometimes|provided)\b"),
}
_NOT_LINE_END = re.compile(r"[^\n]")


def spoken_verdicts(names: Sequence[str], source: Source, text: str) -> tuple[list[VerdictAnswer], str]:
    """The verdicts that a report says on the matrices of these names, and the text without their lines.

    Of one matrix it may be what stands behind the head `definite:` that is said.
    """
    spelled = {key(name): name for name in names}
    said: dict[str, str] = {}
    first, at, lines = -1, 0, list[str]()
    for line in text.splitlines(keepends=True):
        found = list(_verdicts(line, spelled)) or list(_headed(line) if len(names) < 2 else ())
        first = at if found and first < 0 else first
        said |= found
        lines.append(_NOT_LINE_END.sub(" ", line) if found else line)
        at += len(line)
    if not said:
        return [], text
    written = ", ".join(f"{name}: {word}" for name, word in said.items())
    answer = VerdictAnswer("definite", source.place(first, 1), written, tuple(said.items()))
    return [answer], "".join(lines)


def _headed(line: str) -> Iterator[tuple[str, str]]:
    """What one line says of the only matrix."""
    head = _HEAD.match(line)
    word = _meaning(line[head.end() :].strip(" \t\n$*_").lower()) if head is not None else ""
    if word:
        yield "", word


def _verdicts(line: str, spelled: dict[str, str]) -> Iterator[tuple[str, str]]:
    """(matrix, yes, no or if) of what one line says."""
    for found in _SAID.finditer(line):
        name = spelled.get(key(found["name"]))
        word = _meaning(found["said"].strip().lower()) if name else ""
        if name and word:
            yield name, word


def _meaning(said: str) -> str:
    """yes, no or if; empty of words that say neither."""
    for word, beginning in _BEGINNINGS.items():
        if beginning.match(said):
            return word
    if _IS_ONE.search(said):
        return "no" if _NOT.search(said) else "yes"
    return ""
