"""The words around sets in English, German and Norwegian: a table each, one row per language.

`HEADS` are what a set is called at the head of a line or as a heading, `ANNOUNCED` what speaks of one in the
text before a formula, `DENIED` what takes that back.  `CASE` makes of a formula behind it a case, of which
its sentence has to say `SAID`.  `AND`, `OR` and `SO` join formulas, what
stands behind `SINCE` gives the reason.  `ALL`, `ARBITRARY` and `REGARDLESS` say that a coordinate is free.
"""

from __future__ import annotations

import re
from collections.abc import Iterable


def _any(*rows: str) -> str:
    return "|".join(rows)


def _compiled(rows: Iterable[str]) -> re.Pattern[str]:
    return re.compile("|".join(rows), re.IGNORECASE)


_PLACES = (
    r"(?: (?:points?|configurations?|positions?|states?|sets?))?(?: are| is)?",
    r"(?:lagen?|punkte?|zustände?|stellung(?:en)?|konfiguration(?:en)?)",
    r"(?:punkt|still?ing|tilstand|posisjon|konfigurasjon)(?:er|en|et|ene)?",
)
_AT = ("(?: sind| ist| bei| für)?", "(?: er| når| for| ved)?")

HEADS = {
    "equilibria": _compiled((
        rf"(?:the |all )*equilibri(?:a|um){_PLACES[0]}",
        rf"(?:die |alle )*(?:gleichgewichte?|gleichgewichts{_PLACES[1]}|ruhelagen?){_AT[0]}",
        rf"(?:alle )?likevekts?-?(?:{_PLACES[2]})?{_AT[1]}",
    )),
    "singular": _compiled((
        rf"(?:the |all )*singular(?:ity|ities)?{_PLACES[0]}",
        rf"(?:die |alle )*(?:singularität(?:en)?|singuläre? ?(?:{_PLACES[1]})?){_AT[0]}",
        rf"(?:alle )?(?:singularitet(?:er|en|ene)?|singulære? ?(?:{_PLACES[2]})?){_AT[1]}",
    )),
    "reduced": _compiled((
        r"(?:the )?reduced equations(?: of motion)?(?: are)?",
        r"(?:die )?reduzierten? (?:bewegungs)?gleichungen",
        r"(?:de )?reduserte (?:bevegelses)?(?:ligningene|ligninger|likninger|likningene)",
    )),
    "balance": _compiled((
        r"(?:the )?(?:conditions? (?:for|of) )?(?:gravity )?balanc(?:e|ed|ing)(?: conditions?| of gravity)?",
        r"(?:die )?(?:ausgleichsbedingung(?:en)?|bedingung(?:en)? für den (?:gewichts|massen)ausgleich)",
        r"(?:betingelse(?:r|n|ne)? for )?balanser(?:ing|t)",
    )),
}  # fmt: skip

ANNOUNCED = {
    "singular": _compiled((
        r"singular|rank|invertib|determinant|\\det\b|\bdet\b|vanish",
        r"singulär|\brang\b|invertierbar|verschwind",
        r"singulær|inverterbar|forsvinn",
    )),
    "inverse": _compiled((
        r"invers|reach|solution|branch|elbow", r"rückwärtskinemati|erreich|lösung|ellbogen|ellenbogen",
        r"løsning|\bnå\b|albue",
    )),
    "equilibria": _compiled((
        r"equilibri|at rest\b|balance", r"gleichgewicht|ruhelage|in ruhe\b", r"likevekt|\bi ro\b",
    )),
}  # fmt: skip

DENIED = _compiled((
    r"\b(?:not|never|no|non-?singular|un(?!d\b|s\b|ser|ten\b|[dt]er\b)\w+|except|near|about|around|lineari[sz]\w*"
    r"|far from|full rank|regular)\b",
    r"\b(?:nicht|kein\w*|nie|außer|nahe|regulär|linearisier\w*|weit (?:von|weg)|volle[nr]? rang)\b",
    r"\b(?:ikke|ingen|aldri|unntatt|nær|rundt|regulær|langt fra|full rang)\b",
))  # fmt: skip

CASE = re.compile(
    r"\b(?:for|at|if|when|with|für|bei|wenn|falls|mit|ved|når|hvis|med)[\s,:$]*(?:\\[\[(]\s*)?\Z",
    re.IGNORECASE,
)
_IS_ZERO = r"(?:=|\$)\s*0\s*(?:\$|\\[\])])"
SAID = {
    "singular": _compiled((
        r"singular|rank|invertib|vanish|\bzero\b", r"singulär|\brang\b|invertierbar|verschwind|\bnull\b",
        r"singulær|inverterbar|forsvinn", _IS_ZERO,
    )),
    "equilibria": _compiled((ANNOUNCED["equilibria"].pattern, _IS_ZERO)),
}  # fmt: skip

OR = _any("or", "oder", "eller", "ou")
AND = _any("and", "und", "og", "et", "y")
_IT = r"(?:(?:which|it|this|that|was|das|dies|woraus|daraus|es|det|dette|som) )?"
SO = rf"(?:(?:{AND}) )?" + _any(
    r"(?:i\.\s?e\.", "that is", "hence", "thus", "therefore", "so(?: that)?",
    rf"{_IT}(?:gives?|yields?|implies|means|(?:follows?|results?)(?! from)(?: that)?)",
    r"d\.\s?h\.", "das heißt", "also", "somit", "folglich", "damit", "woraus", "daraus",
    rf"{_IT}(?:(?:folgt|ergibt)(?! aus)(?: sich)?(?:,? dass)?|liefert|bedeutet)",
    r"dvs\.?", "det vil si", "altså", "dermed", rf"{_IT}(?:gir|betyr|(?:følger|medfører)(?! av)(?: at)?)",
) + ")"  # fmt: skip
SINCE = _any(
    "since", "because", "follows? from", "results? from", "weil", "denn", "(?:folgt|ergibt sich) aus",
    "fordi", "siden", "følger av",
)  # fmt: skip
ALL = _any("any", "all", "every", r"(?:alle|jede|beliebige|freie)[rsmn]?", "arbitrary", "hver", "vilkårlige?")
ARBITRARY = _any("arbitrary", r"any(?:thing|where)?", "free", "beliebig", "frei", "vilkårlig", "fri")
REGARDLESS = _any(
    r"(?:independent(?:ly)?|regardless|irrespective) of", "whatever",
    "unabhängig von", "uavhengig av", "uansett",
)  # fmt: skip
INTEGER = _any(
    r"(?:(?:is|are) )?(?:an )?integers?", "whole numbers?", r"(?:sind |ist )?ganzzahlig", "heltall"
)
STABLE = r"(?:un)?stable|(?:in)?stabil\w*|ustabil\w*"
