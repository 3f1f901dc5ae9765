r"""Left sides that name answers, found in the raw text of a hand-in by patterns alone.

The patterns share no code with the program: what they find has to be in exactly one outcome of the report, or
an equation was lost.  Beginnings of lines, formulas, cells and items are looked at; `a + K = E` names no K.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from dynsolve.answers.judge import Checker
from dynsolve.answers.verdict import Report, Submission

_FONT = r"(?:\\(?:mathbf|bm|boldsymbol|mathrm|mathit|mathcal|bar|vec)\s*\{?\s*)?"
_INDEX = r"(?:_?\{?[1-9]{1,2}\}?|[₁-₉]{1,2})"
_ARGUMENTS = r"(?:\s*(?:\\left)?\((?:[^()=\n]|\([^()\n]*\)){0,60}\))?"
_ARC = r"(?:\\operatorname\{)?(?:\\pm\s*)?\\?a(?:rc)?(?:tan2?|cos|sin)"
_BRACKETS = r"(?:\[[0-9, ]{1,6}\])?"


@dataclass(frozen=True, slots=True)
class Family:
    """How the left sides of some answers are written, and what these answers are called."""

    written: str
    called: str


FAMILIES = {
    "D": Family(rf"{_FONT}(?:D|B|M(?=\s*\())\}}?{_INDEX}?{_BRACKETS}|[bd]_?\{{?[1-9]{{2}}\}}?", r"D|d\d+"),
    "C": Family(rf"{_FONT}C\}}?{_INDEX}?{_BRACKETS}|c_?\{{?[1-9]{{2}}\}}?", r"C\d*|Cqd|c\d+"),
    "g": Family(rf"{_FONT}[gG]\}}?{_INDEX}?{_BRACKETS}", r"g\d*"),
    "tau": Family(rf"{_FONT}(?:\\tau(?![A-Za-z])|tau|τ)\}}?{_INDEX}?{_BRACKETS}", r"tau\d*|f\d+|D"),
    "K": Family(rf"{_FONT}K\}}?{_INDEX}?|E_\{{?(?:\\mathrm\{{)?kin\}}*", r"K\w*"),
    "P": Family(rf"{_FONT}P\}}?{_INDEX}?|E_\{{?(?:\\mathrm\{{)?pot\}}*", r"P\w*"),
    "L": Family(rf"{_FONT}L\}}?", r"L"),
    "Jv": Family(r"J_?\{?v\}?", r"Jv\w*|J"),
    "H": Family(r"H_\{?[0-9]\}?\^\{?0\}?|H\^\{?0\}?_\{?[0-9]\}?|H[0-9]", r"H\d+"),
    "singular": Family("(?i:singular(?:ities)?|singular configurations?)", "singular"),
    "equilibria": Family("(?i:equilibri(?:a|um)(?: points?)?)", "equilibria"),
    "inverse": Family(rf"(?:q|\\theta|theta|θ){_INDEX}(?=\s*=\s*{_ARC})", "inverse"),
}  # fmt: skip

_SIGN = r"\s{0,3}(?:&\s*)?(?::|\\colon)?=(?![=>])"
_BEGINS = re.compile(
    r"(?:\A|[$&,;|:>#`\"'.({\[]|\*\*|\A\s*\*|\\\\|\\[\[(]|(?:begin|text|tag|item)\*?\{[^{}]*\}|(?<![A-Za-z\\])[A-Za-z]{2,}"
    r"|\\(?:q?quad|item|left|noindent)|(?:\A|\n)\s*\(?[0-9.]{1,4}[.)])\s*\Z"
)
"""What stands before a left side; after anything else the name is part of a longer one."""


@dataclass(frozen=True, slots=True)
class LeftSide:
    """A left side that names an answer: its line from 1, and the family."""

    line: int
    family: str


def left_sides(text: str, ending: str, asked: Collection[str]) -> Iterator[LeftSide]:
    """The left sides of a hand-in that name what is asked for."""
    shown = _shown(text.replace("\\\\", "\\") if ending == "ipynb" else text, ending)
    sign = r"[\"']?\s{0,3}[:=](?=\s)" if ending == "yaml" else _SIGN
    for name, family in FAMILIES.items():
        if any(re.fullmatch(family.called, one) for one in asked):
            for found in re.finditer(rf"(?<![\w\\^}}])(?:{family.written})(?![\w]){_ARGUMENTS}{sign}", shown):
                before = shown[shown.rfind("\n", 0, found.start()) + 1 : found.start()]
                if _BEGINS.search(before):
                    yield LeftSide(shown.count("\n", 0, found.start()) + 1, name)


def _shown(text: str, ending: str) -> str:
    """The text with blanks for comments and what is struck out."""
    hidden = [r"~~[^~]*~~", r"<!--.*?-->", r"<(?:del|s)>.*?</(?:del|s)>"]
    hidden += [r"(?<!\\)%[^\n]*", r"\\begin\{comment\}.*?\\end\{comment\}"] if ending == "tex" else []
    hidden += [r"(?m)(?:^|(?<=\s))#[^\n]*"] if ending == "yaml" else []
    for pattern in hidden:
        text = re.sub(pattern, lambda found: re.sub(r"[^\n]", " ", found[0]), text, flags=re.DOTALL)
    return text


def asked(check: Checker, report: Report) -> set[str]:
    """What is asked for, with all that it can be given by."""
    within = check.reader.vocabulary.quantities.within
    return {part for answer in report.answers for part in within(answer.name)}


LONGEST = 12
"""A value may begin so many lines below its left side."""


def outcomes(read: Submission, report: Report, side: LeftSide, below: int) -> list[str]:
    """What became of a left side, the next one standing on the line `below`."""
    called = re.compile(FAMILIES[side.family].called)
    last = min(side.line + LONGEST, max(below - 1, side.line))
    given = [a for a in report.answers if a.given]
    places = [(a.name, one.place) for a in given for one in (a, *a.occurrences) if one.place]
    is_set = any(a.name == side.family for a in (*read.configurations, *read.verdicts))
    is_given = any(called.fullmatch(name) and side.line <= place.line <= last for name, place in places)
    found = ["judged"] if is_set or is_given else []
    queued = [one for one in report.not_recognized if one.waits]
    for outcome, records in (("queued", queued), ("set aside", report.set_aside)):
        if any(side.line == n.place.line and any(map(called.fullmatch, n.answers)) for n in records):
            found.append(outcome)
    return found


def unaccounted(
    read: Submission, report: Report, sides: Sequence[LeftSide]
) -> list[tuple[LeftSide, list[str]]]:
    """The left sides that are in no outcome of the report, or in several."""
    lines = sorted({side.line for side in sides})
    found = []
    for side in sides:
        below = next((line for line in lines if line > side.line), side.line + LONGEST)
        became = outcomes(read, report, side, below)
        if len(became) != 1 and (not became or sides.count(side) == 1):
            found.append((side, became))
    return found


def lost(check: Checker, text: str, ending: str, read: Submission, report: Report) -> list[LeftSide]:
    """The left sides of a hand-in that are not in exactly one outcome."""
    sides = list(left_sides(text, ending, asked(check, report)))
    return [side for side, _ in unaccounted(read, report, sides)]
