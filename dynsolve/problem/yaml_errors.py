"""The syntax errors of YAML's parser, worded so that the writer of a problem file can mend them."""

from __future__ import annotations

import re
from typing import Any

from dynsolve.problem.source import Faults

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
