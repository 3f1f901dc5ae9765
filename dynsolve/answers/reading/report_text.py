r"""What a reader of a report sees: its text without comments and without what is struck out.

Every change keeps the length of the text, so that every character stays at its place.  One more
way to hide text is one more pattern here.
"""

from __future__ import annotations

import re

_NOT_LINE_END = re.compile(r"[^\n]")
_LATEX_COMMENT = re.compile(r"(?<!\\)(?:\\\\)*(%[^\n]*)")
_HIDDEN = re.compile(
    r"\\begin\{comment\}(?s:.*?)(?:\\end\{comment\}|\Z)|\\end\{document\}(?s:.*)|<!--(?s:.*?)(?:-->|\Z)"
)
_DELETED = re.compile(r"<(del|s|strike)(?:\s[^>\n]{0,200})?>")
_CONDITION = re.compile(r"\\(?:if(?!f(?![A-Za-z]))[A-Za-z@]*|else(?![A-Za-z])|fi(?![A-Za-z]))")
_STRUCK = re.compile(r"(?<!~)~~(?!~)((?:(?!\n[ \t]*\n)[^~]|(?<!~)~(?!~)){1,5000}?)~~(?!~)")
_EMPHASIS = re.compile(
    r"(?m)^([ \t>+-]{0,20}(?:[0-9]{1,2}[.)][ \t]+)?)(\*\*|__)([^*_\n=]{1,60}[:=]?)\2"
    r"(?=[ \t]*[:=]|(?<=[:=]\2)[ \t])"
)
"""A bold name at the beginning of a line: `**K1** = ...`, `**K1:** ...`."""

_CODE = re.compile(r"(?<!`)`([^`\n]{1,1000})`(?!`)")
_SCRIPT = re.compile(r"<(sub|sup)>([^<>\n]{1,80})</\1>", re.IGNORECASE)


def visible(text: str, latex: bool) -> str:
    """The text with blanks for what is commented out or struck through, `<sub>` and `<sup>` as scripts."""
    if latex:
        text = _LATEX_COMMENT.sub(lambda found: _without(found, 1), text)
    text = _HIDDEN.sub(_blank, text)
    if "\\iffalse" in text:
        text = _without_false(text)
    if not latex:
        text = _STRUCK.sub(lambda found: found[0] if _cuts_formula(found) else _struck(found), text)
        text = _without_deleted(text)
        text = _SCRIPT.sub(_script, text)
        text = _EMPHASIS.sub(r"\1  \3  ", text)
        text = _CODE.sub(r" \1 ", text)
    return text


def _blank(found: re.Match[str]) -> str:
    return _NOT_LINE_END.sub(" ", found[0])


def _struck(found: re.Match[str]) -> str:
    """Blanks; a formula alone on its line leaves a full stop: the words above it are of no other."""
    text, blank = found.string, _blank(found)
    line = (
        text[text.rfind("\n", 0, found.start()) + 1 : found.start()] + text[found.end() :].partition("\n")[0]
    )
    return blank if line.strip() or "$" not in found[1] else "." + blank[1:]


def _without(found: re.Match[str], group: int) -> str:
    kept = found.start(group) - found.start()
    return found[0][:kept] + " " * len(found[group])


def _cuts_formula(found: re.Match[str]) -> bool:
    """Whether one of the two signs stands inside a formula, where `~` is a blank."""
    text = found.string
    paragraph = text.rfind("\n\n", max(found.start() - 2_000, 0), found.start()) + 1
    before = text[max(paragraph, found.start() - 2_000) : found.start()]
    return any(_leaves_open(piece) for piece in (before, found[1]))


def _leaves_open(text: str) -> bool:
    """Whether a formula begins in a text and does not end there."""
    displays = text.count("$$")
    pairs = (("\\[", "\\]"), ("\\(", "\\)"))
    inline = text.count("$") - 2 * displays
    return bool(displays % 2 or inline % 2) or any(text.count(a) != text.count(b) for a, b in pairs)


def _without_deleted(text: str) -> str:
    """The text without what stands between `<del>` and `</del>`."""
    pieces: list[str] = []
    done = 0
    unclosed: set[str] = set()
    for found in _DELETED.finditer(text):
        closing = f"</{found[1]}>"
        if found.start() < done or closing in unclosed:
            continue
        end = text.find(closing, found.end())
        if end < 0:
            unclosed.add(closing)
            continue
        pieces += [
            text[done : found.start()],
            _NOT_LINE_END.sub(" ", text[found.start() : end + len(closing)]),
        ]
        done = end + len(closing)
    return "".join([*pieces, text[done:]])


def _without_false(text: str) -> str:
    r"""The text without what stands between `\iffalse` and its `\else` or `\fi`."""
    pieces: list[str] = []
    done, level, start = 0, 0, -1
    for found in _CONDITION.finditer(text):
        word = found[0]
        if start < 0:
            if word == "\\iffalse":
                start, level = found.start(), 0
            continue
        if word.startswith("\\if"):
            level += 1
        elif level and word == "\\fi":
            level -= 1
        elif not level:
            pieces += [text[done:start], _NOT_LINE_END.sub(" ", text[start : found.end()])]
            done, start = found.end(), -1
    if start >= 0:
        pieces += [text[done:start], _NOT_LINE_END.sub(" ", text[start:])]
        done = len(text)
    return "".join([*pieces, text[done:]])


def _script(found: re.Match[str]) -> str:
    """`<sub>1</sub>` as `_{1}`, with blanks that keep every character at its place."""
    sign = "_" if found[1].lower() == "sub" else "^"
    return f"   {sign}{{{found[2]}}}     "
