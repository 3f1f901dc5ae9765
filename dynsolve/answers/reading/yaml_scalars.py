r"""The scalars of an answer file: what stands between their quotes, with the place of every character.

LaTeX is full of backslashes, and so people write `"\theta_1"` between double quotes, where YAML would
have them write `"\\theta_1"`, as every library does.  Both are read, each value by itself:

- A value is *escaped* if every run of backslashes in it is one that a library writes (an even number,
  or an escape of YAML and JSON), and an even run stands directly before a letter or before one of the
  signs that make a command.  All its escapes are then resolved: `"\\frac"` is `\frac`, `"\\\\"` is `\\`.
- In every other value backslashes stand for themselves, save `\uXXXX`, `\UXXXXXXXX`, `\xXX`, `\"`,
  `\/` and one at the end of a line, which are always escapes, and `\n` and `\t`, which are where the letters
  that follow make no command (`\nu`, `\theta`).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from dynsolve.answers.reading.placed_text import Piece

_RUN = re.compile(r"(\\+)((?s:.)?)")
_HEX = "[0-9a-fA-F]"
_PAIR = rf"u[dD][89abAB]{_HEX}{{2}}\\u[dD][c-fC-F]{_HEX}{{2}}"
"""Two halves of one character, as JSON writes those beyond U+FFFF."""

_CODE = rf"{_PAIR}|u{_HEX}{{4}}|U{_HEX}{{8}}|x{_HEX}{{2}}"
_NEXT_LINE = r"\n[ \t]*(?:\\\\\n[ \t]*(?=\\ ))?"
"""The end of a line, and the backslash alone in a line that PyYAML adds where it cuts before a blank."""

_ESCAPE = re.compile(rf"\\(?:({_CODE})|({_NEXT_LINE})|((?s:.)))")
_IS_CODE = re.compile(_CODE)
_LINE_END = re.compile(rf"(?<!\\)((?:\\\\)*)\\{_NEXT_LINE}")
"""A backslash at the end of a line, with which a library cuts a long value."""

_COMMAND_SIGNS = frozenset(",;:!{}")
_NEUTRAL = frozenset('"/\n \t_nt')
"""What may follow a lone backslash in a value that a library wrote and in one written by hand."""

_CONTROLS = {"n": "\n", "N": "\n", "L": "\n", "P": "\n", "r": "\n", "\\": "\\", '"': '"', "/": "/"}
_LETTERS = re.compile(r"[A-Za-z]*")
_COMMANDS = frozenset(
    "nabla natural ncong ne nearrow neg negthinspace neq newline nexists ngeq ni nicefrac nleq nobreak "
    "nolimits nonumber normalsize not notag notin nu nwarrow "
    "tag tan tanh tau tbinom tdot text textbf textit textnormal textrm textstyle texttt tfrac the theta "
    "thickspace thinspace tilde times tiny to top triangle triangleq".split()
)
"""The commands of LaTeX that begin like an escape, `\\n` or `\\t`."""

_FOLD = re.compile(r"[ \t]*\n[ \t\n]*")


def plain(raw: str, start: int) -> Iterator[Piece]:
    """A scalar without quotes that begins at an offset of the file."""
    yield folded(raw), start


def single_quoted(raw: str, start: int) -> Iterator[Piece]:
    """What stands between single quotes: a doubled one is one."""
    text = folded(raw)
    position = 0
    while (doubled := text.find("''", position)) >= 0:
        yield text[position : doubled + 1], start + position
        position = doubled + 2
    yield text[position:], start + position


def literal(raw: str, start: int) -> Iterator[Piece]:
    """A block after `|`: lines as they stand."""
    yield raw, start


def block_folded(raw: str, start: int) -> Iterator[Piece]:
    """A block after `>`: lines are joined, save those that are indented further."""
    lines = raw.split("\n")
    widths = [len(line) - len(line.lstrip(" ")) for line in lines]
    base = min((width for width, line in zip(widths, lines, strict=True) if line.strip()), default=0)
    kept = [lines[0]] if lines else []
    for number in range(1, len(lines)):
        pair = (number - 1, number)
        joins = all(lines[i].strip() and widths[i] == base for i in pair)
        kept += [" " if joins else "\n", lines[number]]
    yield "".join(kept), start


def double_quoted(raw: str, start: int) -> Iterator[Piece]:
    """What stands between double quotes, its escapes resolved where they are meant."""
    escaped = is_escaped(raw)
    text = folded(raw)
    position = 0
    for found in _ESCAPE.finditer(raw):
        meant = _meant(raw, found, escaped)
        if meant is not None:
            yield text[position : found.start()], start + position
            yield meant, start + found.start()
            position = found.end()
    yield text[position:], start + position


def is_escaped(raw: str) -> bool:
    """Whether the backslashes of a command are doubled."""
    doubled = False
    raw = _LINE_END.sub(r"\1", raw)
    for run in _RUN.finditer(raw):
        follows = run[2]
        if len(run[1]) % 2 == 0:
            sign = (follows.isalpha() and follows.isascii()) or follows in _COMMAND_SIGNS
            doubled = doubled or bool(follows and sign) or (follows in ("(", "[") and run.start() == 0)
        elif follows not in _NEUTRAL and not _IS_CODE.match(raw, run.end() - len(follows)):
            return False
    return doubled


def _meant(raw: str, found: re.Match[str], escaped: bool) -> str | None:
    """What an escape stands for, None where it is no escape."""
    code, line_end, sign = found.groups()
    if code:
        return _character(code)
    if line_end:
        return ""
    if sign in '"/':
        return str(sign)
    if escaped:
        return _CONTROLS.get(sign, " ")
    if sign in "nt":
        letters = _LETTERS.match(raw, found.start() + 1)
        return None if letters and letters[0] in _COMMANDS else "\n" if sign == "n" else " "
    return None


def _character(code: str) -> str:
    if "\\" in code:
        pair = [int(half.strip("\\")[1:], 16) for half in (code[:5], code[5:])]
        return chr(0x10000 + ((pair[0] - 0xD800) << 10) + pair[1] - 0xDC00)
    value = int(code[1:], 16)
    return chr(value) if value <= 0x10FFFF and not 0xD800 <= value <= 0xDFFF else "\ufffd"


def folded(raw: str) -> str:
    """The text with blanks for single ends of lines; blank lines stay, and so does every offset."""
    if "\n" not in raw:
        return raw
    return _FOLD.sub(_joined, raw)


def _joined(found: re.Match[str]) -> str:
    return found[0].replace("\n", " ") if found[0].count("\n") == 1 else found[0]
