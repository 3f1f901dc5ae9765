r"""What a reader of a report sees: its text without comments and without what is struck out.

Every change keeps the length of the text, so that every character stays at its place.  One more
way to hide text is one more pattern here.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from dynsolve.answers.reading.sources import blanked, hidden

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
    return blanked(found[0])


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
    spans, done = list[tuple[int, int]](), 0
    unclosed: set[str] = set()
    for found in _DELETED.finditer(text):
        closing = f"</{found[1]}>"
        if found.start() < done or closing in unclosed:
            continue
        end = text.find(closing, found.end())
        if end < 0:
            unclosed.add(closing)
        else:
            done = end + len(closing)
            spans.append((found.start(), done))
    return hidden(text, spans)


def _without_false(text: str) -> str:
    r"""The text without what stands between `\iffalse` and its `\else` or `\fi`."""
    spans = list[tuple[int, int]]()
    level, start = 0, -1
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
            spans.append((start, found.end()))
            start = -1
    return hidden(text, [*spans, (start, len(text))] if start >= 0 else spans)


def _script(found: re.Match[str]) -> str:
    """`<sub>1</sub>` as `_{1}`, with blanks that keep every character at its place."""
    sign = "_" if found[1].lower() == "sub" else "^"
    return f"   {sign}{{{found[2]}}}     "


# What the words around a formula in a sentence say of it: that it holds, or why it is no answer

IN_SENTENCE = "it stands in a sentence"
SUPPOSED = "a sentence supposes it"
SPECIAL = "it is said of a special case"
REJECTED = "the sentence takes it back"
QUOTED = "it is quoted"
IN_CASE = "it is said of one case"
CONDITION = "it is a condition"
CONSTANT = "this says what a symbol of the problem is"
NO_CLAIMS = frozenset({CONDITION, SUPPOSED, SPECIAL, REJECTED, QUOTED, CONSTANT})
"""What is said so says nothing of what the student found."""

FREE = "it is an equation of free motion, in which no generalized force stands"


def is_of_case(why: str) -> bool:
    """Whether it is said of one case: behind these words stand those of the sentence."""
    return why.startswith(IN_CASE)


def may_hold(why: str) -> bool:
    """Whether what is said so counts where nothing else answers the same."""
    return why == IN_SENTENCE or is_of_case(why)


def _words(*rows: str) -> re.Pattern[str]:
    return re.compile("|".join(rows), re.IGNORECASE)


_IF = (
    "if|iff|when|whenever|for|unless|wenn|falls|für|hvis|når|dersom"
    r"|assum\w+|suppos\w+|set\w*|let|sei|setz\w*|anta\w*"
)
_NEEDS = (
    r"requir\w+|demand\w*|implies|means|needs?|verlang\w+|forder\w+|erforder\w+|bedeutet|kreve?r?|betyr"
    r"|forutsett?e?r?"
)
_THAT = r"[ \t\n]{1,3}(?:(?:that|dass|at)[ \t\n]{1,3})?\Z"
_SUPPOSES = _words(rf"\b(?:{_IF}|{_NEEDS}),?{_THAT}")
"""The words of a sentence that only supposes what follows, or asks for it."""

_FROM = (
    r"where|wo|condition\w*|equation\w*|solv\w+|from|with|must|aus|löse\w*|mit|(?:gleichgewichts)?bedingung\w*|gleichung\w*"
    r"|muss|fra|løs\w*|med|der|må|betingelse\w*|ligning\w*|likning\w*"
)
_ASKED = _words(rf"\b(?:{_FROM}|(?:we|wir|man|vi)[ \t](?:need|must have|brauchen?|braucht|må ha)){_THAT}")
_ONLY = "exactly|only|just|precisely|genau|nur|dann|bare|nøyaktig|akkurat"
_THEN = _words(rf"[ \t\n,]*(?:(?:{_ONLY})[ \t\n,]+){{0,2}}(?:{_IF}|at|bei|ved)[ \t\n]")
r"""What stands around an `= 0` that is a condition: `from $g = 0$`, `$\det J = 0$ exactly when`."""

_ZERO = re.compile(r"[^=]*=[ \t\n]*(?:\\\w+[ \t]*\{?[ \t]*)?0[ \t\n}.,]*(?:\$|\\\))")
_CASE = re.compile(
    r"(?:\b(?:for|at|if|when|with|bei|für|wenn|falls|mit|ved|når|hvis|med)[ \t\n]+|,[ \t\n]*|\A[ \t>*+-]*)"
    r"\(?\$(?P<left>[^$=]{1,30})=(?:[-+0-9\s.,/{}°^]|\\[dt]?frac|\\pi|π|\\circ|\\pm)+\$",
    re.IGNORECASE,
)
"""A case that is no general one: `for $q_2 = 0$`, `Stretched arm, $q_2 = 0$`."""

_OF_EQUATION = (
    r"(?:[ \t\n]+\w+){0,3}?[ \t\n]+(?:coefficients?|factors?|terms?|koeffizienten|faktoren|terme?"
    r"|koeffisient\w*|faktor\w*|ledd\w*)\b"
)
"""How a comparison goes on that takes a general formula apart."""

_ONE_CASE = _words(
    r"\b(?:special|limiting) cases?\b|\b(?:sonder|spezial)f[aä]ll|\b(?:spesial|grense)tilfelle"
    r"|\bhorizontal position"
    r"|\bstatic(?:ally)?\b|\bstatisch\w*|\bstatisk\b|\b(?:hold|stand)\w* still\b|\bstillst\w+"
    r"|\bnothing moves\b|\bnichts bewegt\b|\bingenting beveger\b"
    r"|\bat rest\b|\bin ruhe\b|\bi ro\b|\blineari[sz]|\bcheck\b|\bprobe\b|\bkontroll\b"
    rf"|(?<!\bby )(?<!\bdurch )(?<!\bved )\b(?:compar|vergleich|sammenlign)(?!\w*{_OF_EQUATION})"
    r"|\bwould\b|\bwürden?\b|\bwären?\b|\bville\b|\bcontributes?\b|\bwithout\b|\bohne\b|\buten\b",
    r"\b(?:for|at|if|when|bei|für|wenn|falls|ved|når|hvis)\b[^$:]{0,40}\$[^$=]{1,60}(?:=[^$=]{1,60})+\$",
    r"\\dot[^$=]{1,30}=[ \t]*0[ \t]*\$|[\u0307'][^$=]{0,10}=[ \t]*0[ \t]*\$",
    r"\(\$[^$=]{1,60}(?:=[^$=]{1,60})+\$\)|=[ \t]*[0-9.,]+(?:\\[,;: ]|[ \t])*\\(?:mathrm|text)[^$]{1,60}\$",
)
"""What may make a formula one of a case: it counts where nothing else answers the same."""

_HAD = "had|thought|wrote|believed|hatten?|dachten?|glaubten?|schrieben?|meinten?|hadde|trodde|skrev|tenkte"
_REJECTED = _words(
    r"\b(?:could|might|would|may)[ \t\n]+(?:\w+[ \t\n]+)?(?:think|believe|expect|guess|suppose|say)\b",
    rf"\b(?:at first|first|zuerst|zunächst|anfangs|først)[ \t\n]+(?:\w+[ \t\n]+)?(?:{_HAD})\b",
    rf"\b(?:{_HAD})[ \t\n]+(?:\w+[ \t\n]+)?(?:at first|first|zuerst|zunächst|anfangs|først)\b",
    r"\b(?:man|wir) könnten?\b|\b(?:kunne|skulle)[ \t\n]+(?:\w+[ \t\n]+)?(?:tro|tenke)\w*",
    r"\b(?:wrong|wrongly|incorrect|fälschlich|falsch|feilaktig|feil)\b"
    r"|\b(?:instead of|rather than|statt|i stedet for)[ \t\n]*\Z",
)
_TURN = _words(
    r"\b(?:but|however|actually|in fact|correct\w*|now|sondern|aber|jedoch|doch|richtig\w*|tatsächlich)\b",
    r"\b(?:men|riktig\w*|egentlig)\b",
)
"""What leads from what is rejected to what holds."""

_TAKEN_BACK = _words(
    r"[^$.;]{0,40}\b(?:is|was|were|would be|ist|war|wäre|er|var|blir)[ \t\n]+(?:\w+[ \t\n]+)?"
    r"(?:wrong|false|incorrect|falsch|feil|galt)\b",
    r"[^$.;]{0,40}\b(?:not|nicht|ikke)[ \t\n]+(?:right|true|correct|richtig|riktig)\b",
    r"[ \t\n,]*(?:which|what|that|this|was|das|som|det)[ \t\n]+(?:falsch|feil|wrong)\b",
)
_BOOK = (
    r"(?:\w*book|literature|lecture|slides?|solution manual|\w*buch|skript|literatur|vorlesung"
    r"|\w*bok(?:a|en)?|forelesning\w*)"
)
_GIVES = (
    "gives?|has|have|had|says?|states?|writes?|gibt|hat|hatten|sagt|schreibt|steht"
    "|gir|har|hadde|sier|skriver|står"
)
_IN_BRACKETS = r"(?:\([^()$]{1,20}\)[ \t\n]*)?"
_AFTER = "nach|laut|gemäß|according to|ifølge|etter|in|im|i"
_QUOTED = _words(
    rf"\b{_BOOK}[ \t\n]*{_IN_BRACKETS}[:,]?(?:[ \t\n]+\w+){{0,2}}[ \t\n]+(?:{_GIVES})\b[^$.;]{{0,40}}\Z",
    rf"\b(?:{_AFTER})(?:[ \t\n]+\w+)?[ \t\n]+{_BOOK}\b[^$.;]{{0,60}}\Z",
)
_BORDER = re.compile(
    r"[.;!?](?=\s)|\n[ \t]*(?=\n)|\n[ \t]*(?:[-*+|]|[0-9]+[.)])[ \t]|\$\$|\\\]|\\end\{\w+\*?\}"
)
_FAR, _NEAR = 300, 60
"""How far back a sentence is looked at, and how far for what stands right before a formula."""

_WORD = re.compile(r"[^\W\d_]{2}")


_CONDITIONS = _words(rf"\b(?:(?!for\b|für\b)(?:{_IF})|{_NEEDS})\b", r"\bf(?:o|ü)r (?:small|kleine|små)\b")
"""Words before a formula without which it does not hold."""


def is_of_one_case(words: str) -> bool:
    """Whether words before an equation say that it may hold in one case alone."""
    return bool(_ONE_CASE.search(words) or _CONDITIONS.search(words))


def said_of(text: str, start: int, end: int, is_coordinate: Callable[[str], bool]) -> str:
    """What a sentence says of the formula between two offsets: why it is no equation of its own."""
    before = text[max(start - _NEAR, 0) : start]
    if _SUPPOSES.search(before):
        return SUPPOSED
    if _ZERO.fullmatch(text, start, end) and (_ASKED.search(before) or _THEN.match(text, end)):
        return SUPPOSED
    return taken_from(text, start, end, is_coordinate) or IN_SENTENCE


def taken_from(text: str, start: int, end: int, is_coordinate: Callable[[str], bool]) -> str:
    """Why the sentence around a formula says that it may not be what holds in general; else empty."""
    before = text[max(start - _FAR, 0) : start]
    open_end = before.rstrip()  # a sentence that has not ended goes on in the display below it
    sentence = _BORDER.split(before if open_end.endswith((".", ";", "!", "?")) else open_end)[-1]
    if any(is_coordinate(case["left"]) for case in _CASE.finditer(sentence)):
        return SPECIAL
    if _TAKEN_BACK.match(text, end):
        return REJECTED
    if not any(map(_WORD.search, sentence.split("$")[::-2])):  # every other piece is a formula
        return ""
    if _REJECTED.search(_TURN.split(sentence)[-1]):
        return REJECTED
    if _QUOTED.search(sentence):
        return QUOTED
    case = _ONE_CASE.search(sentence)
    return f"{IN_CASE}: {case.group().strip()}" if case else ""
