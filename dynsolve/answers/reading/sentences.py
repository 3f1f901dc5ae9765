"""What the words around a formula in a sentence say of it: that it holds, or why it is no answer."""

from __future__ import annotations

import re
from collections.abc import Callable

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
    r"|\bat rest\b|\bin ruhe\b|\bi ro\b|\blinearis|\bcheck\b|\bprobe\b|\bkontroll\b"
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
