r"""The text of an alternative as people write it: `θ₂ = 0 or π`, `q_2 = k\pi, k ∈ ℤ`, `q2 ∈ {0, π}`.

What joins equations is taken apart before any formula is read: `or` into alternatives, `and` into
equations that hold together, outside of parentheses; `and` binds closer, and a value without an
equation of its own, the π of `θ₂ = 0 or π`, is another value of the equation before it.

`HEADS` are what a set is called at the head of a line or as a heading, `ANNOUNCED` what speaks of one in the
text before a formula, `DENIED` what takes that back.  `CASE` makes of a formula behind it a case, of which
its sentence has to say `SAID`.  `AND`, `OR` and `SO` join formulas, what
stands behind `SINCE` gives the reason.  `ALL`, `ARBITRARY` and `REGARDLESS` say that a coordinate is free.

What only says that vectors span a space is left out, so that the vectors remain; a space without a
vector is 0, and a whole space the unit vectors.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise, product

from dynsolve.answers.reading.sources import PlacedText, levels, placed
from dynsolve.errors import ReadError
from dynsolve.quantities.letters import key

# The words around sets in English, German and Norwegian: a table each, one row per language


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
        r"(?:the )?reduced(?: equations(?: of motion)?)?(?: are)?",
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

WITHOUT_MULTIPLIERS = _compiled((
    r"\breduced (?:equations?|model|system|dynamics|form)\b",
    r"\beliminat\w+|\bwithout (?:the )?(?:lagrange )?multipliers?\b",
    r"\breduzierte\w*|\beliminier\w+|\bohne (?:die )?(?:lagrange-?)?multiplikatoren\b",
    r"\breduserte\b|\belimin(?:erer|ert|ering)\w*|\buten (?:lagrange-?)?multiplikator\w*",
))  # fmt: skip
"""What announces equations of motion without multipliers in the sentence before a display."""

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

OR = "or|oder|eller|ou"
AND = "and|und|og|et"
_IT = r"(?:(?:which|it|this|that|was|das|dies|woraus|daraus|es|det|dette|som) )?"
SO = (
    rf"(?:(?:{AND}) )?(?:i\.\s?e\.|that is|hence|thus|therefore"
    r"|so(?: that)?(?: (?:it|the \w+) is)?(?: singular (?:when|if|iff|for|at|where))?"
    rf"|{_IT}(?:gives?|yields?|implies|means|(?:follows?|results?)(?! from)(?: that)?)"
    r"|d\.\s?h\.|das heißt|also|somit|folglich|damit|woraus|daraus"
    rf"|{_IT}(?:(?:folgt|ergibt)(?! aus)(?: sich)?(?:,? dass)?|liefert|bedeutet)"
    rf"|dvs\.?|det vil si|altså|dermed|{_IT}(?:gir|betyr|(?:følger|medfører)(?! av)(?: at)?))"
)
SINCE = "since|because|follows? from|results? from|weil|denn|(?:folgt|ergibt sich) aus|fordi|siden|følger av"
ALL = "any|all|every|(?:alle|jede|beliebige|freie)[rsmn]?|arbitrary|hver|vilkårlige?"
ARBITRARY = "arbitrary|any(?:thing|where)?|free|beliebig|frei|vilkårlig|fri"
REGARDLESS = "(?:independent(?:ly)?|regardless|irrespective) of|whatever|unabhängig von|uavhengig av|uansett"
INTEGER = "(?:(?:is|are) )?(?:an )?integers?|whole numbers?|(?:sind |ist )?ganzzahlig|heltall"
STABLE = r"(?:un)?stable|(?:in)?stabil\w*|ustabil\w*"

Together = tuple[str, ...]
"""The texts of equations that hold together."""

WHOLE_NUMBERS = range(4)
"""What is put for k in `k*pi/2`: every multiple of a quarter turn within one turn."""

_WORD = re.compile(
    rf"\\(?:text|textrm|textnormal|mathrm|mbox)\s*\{{\s*,?\s*({OR}|{AND}|{SO})\s*,?\s*\}}", re.IGNORECASE
)
_SPACE = re.compile(r"\\[,;:! ]|\\q?quad\b|[$~]")
_EQUALS = re.compile(r"==")
_DETERMINANT = re.compile(r"\s*(?:\\?det\b|\||\\lvert|\\left\s*\|)[^=]*=(?=[^=]+=)")
FOLLOWS = re.compile(
    rf"\\(?:implies|iff|(?:Long|long)?(?:[lL]eft)?[rR]ightarrow)\b|<?=>|[⇒⇔⟹⟺]|(?:,\s{{0,9}}|\s)(?:{SO})(?=[\s,])"
)
"""What leads from one form of a set to the next, which says the same."""

_RESTATED = re.compile(
    r"\\?(?:sin|cos|tan)\s*[({]?\s*(?P<of>\\?\w+(?:_\{\w+\})?)\s*[)}]?\s*=\s*[-+]?[01]\s*,\s*"
    rf"(?=(?P=of)\s*=[^=]{{1,80}}?(?:,|\s(?:{OR}|{AND})\s)[^=]{{1,80}}\Z)"
)
"""`sin(q2) = 0, q2 = 0 or pi`: the angles say again what the sine says."""

_REASON = re.compile(rf"(?:,\s{{0,9}}|\s)(?:{SINCE})\s")
_VERB = re.compile(r"\s(?:folgt|følger|gilt|gjelder)\s{0,9}\Z")
_BUILDER = re.compile(r"\\?\{\s{0,9}\([^()=]{1,80}\)\s{0,9}(?:\\mid\b|\||:)(.*?)\\?\}\Z")
"""`{(x, q): q = 0}`, the points for which something holds."""

_COUNT = r"[jklmn](?:_\{?\d\}?)?"
_B = r"\s{0,9}"
_INTEGERS = re.compile(
    rf"{_B}[,;]?{_B}\(?{_B}(?:\\(?:quad|text\{{\s*for\s*\}}|forall)\s*|(?:for|with|where|mit|für|med|der)\s+|∀\s*)?"
    rf"(?<![A-Za-z_\\]){_COUNT}(?:{_B},{_B}{_COUNT}){{0,3}}{_B}"
    rf"(?:(?:\\in|∈|\bin\b)\s*(?:\\mathbb\s*\{{?\s*Z\s*\}}?|ℤ|Z\b|(?:the\s+)?integers)|(?:{INTEGER})\b){_B}\)?"
)
_COUNTED = re.compile(rf"\s*[,;]\s*\(?\s*{_COUNT}\s*=\s*(?:0|\.\.\.|\\[lc]?dots|…)[^=]*\Z")
_MODULO = re.compile(r"\s*(?:\(\s*mod(?:ulo)?\s+([^()]+)\)|\\pmod\s*\{([^{}]*)\}|\bmod(?:ulo)?\s+(.+))\s*\Z")
_HALF_TURN = re.compile(r"\s*(?:\\?pi|π|180\s*(?:°|deg|\^\\circ|\^\{\\circ\}))\s*\Z")
_SET = r"\\?\{(?:[^{}]|\{[^{}]*\})*?\\?\}"
_MEMBERS = re.compile(
    rf"(?:\\in\b|∈|\bin\b|=)({_B}{_SET}(?:{_B}(?:\\times\b|×){_B}{_SET}){{0,5}}){_B}(?:\^{_B}\{{?{_B}[2-6]{_B}\}}?)?{_B}\Z"
)
_RELATION = re.compile(r"=|\\in\b|∈")
_MOST_BEFORE = 12
"""So many names and commas are looked at before a membership."""

_TIMES = re.compile(r"\\times\b|×")
_WHOLE = re.compile(rf"(?<![A-Za-z_\\])({_COUNT})(?![A-Za-z_0-9])")
_OF_TURNS = re.compile(
    rf"(?<![A-Za-z_\\])({_COUNT})(?=[\s*]{{0,3}}(?:\\[dt]?frac\s?\{{?\s?)?(?:\\?pi(?![A-Za-z])|π))"
)
"""A letter before π counts turns, whatever else the problem calls so: k π beside a stiffness k."""

_OR = re.compile(rf"\s(?:{OR})\s|\s\|\|?\s|∨|\\(?:lor|vee)\b|;")
_AND = re.compile(rf"\s(?:{AND})\s|&&?|∧|\\(?:land|wedge)\b")
_JOINTS = re.compile(rf"{_OR.pattern}|{_AND.pattern}|{FOLLOWS.pattern}|,")
_COMMA = re.compile(",")
_COMMA_AND = re.compile(rf",\s{{1,9}}(?:{AND})\s")
_LEADING_AND = re.compile(rf"\A\s*(?:{AND})\s(?=[^=]*=)")


def alternatives(
    texts: Sequence[str], is_name: Callable[[str], bool], is_value: Callable[[str], bool]
) -> Iterator[Together]:
    """The alternatives that texts name, the items of a list.

    `is_name` says whether a letter has a meaning of its own, `is_value` whether no coordinate
    stands in a text.

    >>> list(alternatives(["q2 = 0 or pi and q3 = 0"], lambda letter: False, lambda text: text[0] != "q"))
    [('q2 = 0', 'q3 = 0'), ('q2 = pi', 'q3 = 0')]
    """
    text = " or ".join(_spelled_out(one, is_value) for one in texts)
    for equations in _either(text, is_value):
        found = [letter for one in equations for letter in _WHOLE.findall(one)]
        turns = [letter for one in equations for letter in _OF_TURNS.findall(one)]
        letters = dict.fromkeys(
            letter
            for letter in found
            if (letter in "kn" and not is_name(letter)) or found.count(letter) == turns.count(letter)
        )
        for numbers in product(WHOLE_NUMBERS, repeat=len(letters)):
            yield tuple(_with_numbers(one, dict(zip(letters, numbers, strict=True))) for one in equations)


def _with_numbers(text: str, values: Mapping[str, int]) -> str:
    return _WHOLE.sub(lambda letter: f"({values[letter[1]]})" if letter[1] in values else letter[0], text)


def joined(text: str) -> list[str]:
    """The equations of a text, parted by commas, words and signs outside of brackets.

    >>> joined("q1 = atan2(y, x), q2 = 0 and q3 = pi")
    ['q1 = atan2(y, x)', 'q2 = 0', 'q3 = pi']
    """
    return [part.strip() for part in _parts(in_signs(text), _JOINTS)]


def in_signs(text: str) -> str:
    """The text with its words as words, and blanks for what only sets it."""
    return _EQUALS.sub("=", _SPACE.sub(" ", _WORD.sub(r" \1 ", text)))


def _spelled_out(text: str, is_value: Callable[[str], bool]) -> str:
    """The text with words for signs, behind its last arrow, and without what is said of whole numbers."""
    text = in_signs(text)
    text = _DETERMINANT.sub("", FOLLOWS.split(_REASON.split(text)[0])[-1], count=1)
    text = _RESTATED.sub("", text)
    text = _COUNTED.sub("", _INTEGERS.sub("", _VERB.sub("", text))).strip()
    text = _BUILDER.sub(r"\1", text)
    if (modulo := _MODULO.search(text)) is not None:
        by = next(group for group in modulo.groups() if group is not None)
        text = text[: modulo.start()] + (" + k*pi" if _HALF_TURN.fullmatch(by) else "")
    return _with_or(_memberships(_both(text), is_value))


def held_together(text: str) -> str:
    """`q_1 = 0, q_2 = π` with `and` for its commas, where each is an equation for something else."""
    bare = _INTEGERS.sub("", in_signs(text))
    pieces = _parts(bare, _COMMA)
    lefts = {_left(piece) for piece in pieces}
    is_one = len(lefts) == len(pieces) > 1 and all("=" in piece for piece in pieces)
    return " and ".join(pieces) if is_one and len(pieces) == len(_parts(bare, _JOINTS)) else text


def _both(text: str) -> str:
    """`q_1 = 0 or q_1 = π, and q_2 = 0 or q_2 = π`, where the comma says that `and` parts first."""
    pieces = _parts(text, _COMMA_AND)
    lefts = [{_left(one) for one in _parts(piece, _OR) if "=" in one} for piece in pieces]
    if len(pieces) == 1 or any(len(left) != 1 for left in lefts) or len(set.union(*lefts)) < len(lefts):
        return text
    return " and ".join(f"({piece.strip()})" for piece in pieces)


def _memberships(text: str, is_value: Callable[[str], bool]) -> str:
    """Memberships as equations, which commas join: `q_1, q_2 ∈ {0, π}`, `(q_1, q_2) ∈ {(0, 0), (0, π)}`."""

    def is_name_alone(part: str) -> bool:
        return _RELATION.search(part) is None and not is_value(part)

    parts = _split(text, _JOINTS)
    for at in range(len(parts) - 1, -1, -2):
        found = _MEMBERS.search(parts[at]) if at < len(parts) else None
        if found is None:
            continue
        first, least = at, max(at - _MOST_BEFORE, 0)
        while first > least and parts[first - 1] == "," and is_name_alone(parts[first - 2]):
            first -= 2
        names = [*parts[first:at:2], *_listing(parts[at][: found.start()])]
        parts[first : at + 1] = [_equations(names, [_listing(one) for one in _TIMES.split(found[1])])]
        for joint in (first - 1, first + 1):
            if 0 < joint < len(parts) and parts[joint] == ",":
                parts[joint] = " and "
    return "".join(parts)


def _equations(names: Sequence[str], sets: Sequence[Sequence[str]]) -> str:
    """What says that each name has a value of its set, or all of them those of one tuple of a single set."""
    if len(names) > 1 and len(sets) == 1 and all(value.strip()[:1] == "(" for value in sets[0]):
        points = [zip(names, _listing(value), strict=False) for value in sets[0]]
        choices = [[f"{n} = {v}" for n, v in point if _key(n) != _key(v)] for point in points]
        return "(" + " or ".join("(" + " and ".join(one) + ")" for one in choices) + ")"
    pairs = zip(names, sets if len(sets) > 1 else [sets[0]] * len(names), strict=False)
    each = ["(" + " or ".join(f"{name} = {value}" for value in values) + ")" for name, values in pairs]
    return "(" + " and ".join(each) + ")"


def _listing(text: str) -> list[str]:
    """What commas part between the brackets around all of it, if any."""
    text = text.strip().removeprefix("\\")
    inside = text[1:-1].removesuffix("\\") if text[:1] in "({" and text[-1:] in ")}" else text
    return _parts(inside, _COMMA)


def _key(text: str) -> str:
    return key(text.strip().lstrip("\\"))


def _with_or(text: str) -> str:
    """`a = 0, b = 0 or c = 0` with `or` for its commas."""
    choices = _parts(text, _OR)
    is_list = len(choices) > 1 and "=" in choices[-1] and len(_parts(choices[-1], _COMMA)) == 1
    if not is_list or ";" in text or _AND.search(text) is not None:
        return text
    return " or ".join(_parts(text, _COMMA))


def _either(text: str, is_value: Callable[[str], bool]) -> Iterator[Together]:
    """The alternatives of a text in which words stand for signs."""
    found: list[list[list[str]]] = []
    pieces = _parts(_without_parentheses(text), _OR)
    for piece in pieces:
        for number, one in enumerate(_listed(piece, is_one_of=len(pieces) > 1)):
            first, *others = _parts(one, _AND)
            before = found[-1][-1] if found else []
            if before and "=" not in first and "=" in before[0] and (number or is_value(first)):
                before.append(f"{_left(before[0])} = {first}")
            else:
                found.append([[first]])
            for other in others:
                if _left(other) == _left(first):  # q₂ = 0 and q₂ = π are said of two places
                    found[-1][-1].append(other)
                else:
                    found[-1].append([other])
    for equations in found:
        yield from _together(equations, is_value)


def _together(equations: Sequence[Sequence[str]], is_value: Callable[[str], bool]) -> Iterator[Together]:
    """Every choice of a value of each equation; what stands in parentheses is taken apart in its turn."""
    choices: list[list[Together]] = []
    for values in equations:
        found: list[Together] = []
        for value in values:
            inner = _without_parentheses(value)
            found += _either(inner, is_value) if inner != value.strip() else [_chain(value)]
        choices.append(found)
    for chosen in product(*choices):
        yield tuple(equation for one in chosen for equation in one)


def _chain(text: str) -> Together:
    """sin q₂ = sin q₃ = 0 as two equations."""
    members = text.split("=")
    if len(members) < 3:
        return (text,)
    return tuple(f"{left}={right}" for left, right in pairwise(members))


def _left(text: str) -> str:
    """What stands left of the first equality sign."""
    return text.split("=")[0].strip()


def _listed(text: str, is_one_of: bool) -> list[str]:
    """q₂ = 0, π: further values of one equation, which commas part.

    Where commas part equations, they are alternatives if `and` joins some, and hold together in a
    text that `is_one_of` several alternatives, or with `and` behind the last comma.
    """
    written = _parts(text, _COMMA)
    pieces = [_LEADING_AND.sub("", piece) for piece in written]
    lefts = {_left(piece) for piece in pieces if "=" in piece}
    if len(pieces) == 1 or (len(lefts) == 1 and "=" in pieces[0]):
        return pieces
    if all("=" in piece for piece in pieces):
        if any(len(_parts(piece, _AND)) > 1 for piece in pieces):
            return pieces
        if is_one_of or pieces[-1] != written[-1]:
            return [" and ".join(pieces)]
    help = "write a list of alternatives, and join by `and` what holds together"
    raise ReadError("a comma stands between equations", text.find(","), 1, help)


def _without_parentheses(text: str) -> str:
    """The text without parentheses around all of it, where equations stand in them."""
    text = text.strip()
    if text[:1] == "(" and text[-1:] == ")" and "=" in text:
        inside = text[1:-1]
        if min(levels(inside), default=0) >= 0:
            return inside
    return text


def _parts(text: str, separator: re.Pattern[str]) -> list[str]:
    """What stands between separators outside of brackets."""
    return _split(text, separator)[::2]


def _split(text: str, separator: re.Pattern[str]) -> list[str]:
    """The same with the separators."""
    found, start = list[str](), 0
    open_at: list[int] = []
    for sign in separator.finditer(text):
        open_at = open_at or levels(text)
        if open_at[sign.start()] == 0:
            found += [text[start : sign.start()], sign[0]]
            start = sign.end()
    return [*found, text[start:]]


# Spaces as people write them: `span{[1, 0]}`, `\alpha [1, 0]^T`, `none`, `R^2`

_SPAN = re.compile(
    r"\s*(?:\\(?:mathrm|operatorname\*?|text|textrm|mathop|mathcal)\s*\{\s*span\s*\}|\\?span(?![a-z]))\s*",
    re.I,
)
_FACTOR = re.compile(r"\s*(\\?[A-Za-z]+|[αβγλμ])\s*\\?[*,;]?\s*(?=\\begin|\\left|\[|\()")
_NOTHING = re.compile(
    r"(?:none|nothing|empty|no(?: \w+)? (?:direction|motion|vector)s?|∅|\\(?:empty|var)?(?:nothing|set)|"
    r"[\[{(]?\s*[\]})]|\\?\{\s*(?:\\(?:mathbf|vec|bm)\s*\{?)?\s*0\s*\}?\s*\\?\})\.?",
    re.I,
)
_SPAN_TEXT_WHOLE = re.compile(
    r"\\?(?:mathbb\s*\{?\s*R\s*\}?|[Rℝ])\s*(?:\^\s*\{?\s*([1-6])\s*\}?|([¹²³⁴⁵⁶])|([1-6]))"
)
_FOR_ALL = re.compile(
    r"\s*[,;]\s*(?:\\\S\s*)?(?:\\?forall|∀|for all)?\s*\S{1,8}\s*(?:\\in\b|∈|\bin\b)[^\[\]]*\Z"
)
_OPENING = re.compile(r"\s*(?:\\left\s*)?(\\?\{|\[|\()\s*")
_CLOSING = re.compile(r"\s*(?:\\right\s*)?(\\?\}|\]|\))\s*\Z")
_RAISED = "¹²³⁴⁵⁶"


_JACOBIAN = (
    r"(?:\\(?:left|big|Big))?\(?\s*\{?\\?(?:mathbf|bm|boldsymbol)?\{?J\}?\s*(?:_\{?[a-z]+\}?)?(?:\([^()]*\))?"
)
_TURNED_OVER = r"\s*\^\s*\{?\s*(?:T|\\top|\\intercal|\\mathrm\{T\}|\\mathsf\{T\})\s*\}?"
_NULL = r"\s*\\?(?:mathcal|mathrm|operatorname|text)?\s*\{?\s*(?:N|[Kk]er(?:nel)?|[Nn]ull(?:space)?)\s*\}?\s*"
_RANGE = r"\s*\\?(?:mathcal|mathrm|operatorname|text)?\s*\{?\s*(?:R|[Rr]ange|[Ii]m(?:age)?)\s*\}?\s*"
_SPACES = {
    "lost": re.compile(rf"{_NULL}{_JACOBIAN}{_TURNED_OVER}.*|\s*\\?(?:text|mathrm)?\{{?\s*lost\b.*"),
    "nullspace": re.compile(rf"{_NULL}(?:{_JACOBIAN}.*)?"),
    "rangespace": re.compile(rf"{_RANGE}(?:{_JACOBIAN}.*)?"),
}


def space_named(text: str) -> str:
    r"""The answer that a text is the name of; empty for any other.

    >>> [space_named(text) for text in (r"\mathcal{N}(J_r)", r"\ker J^T", "R(J)", "N_1")]
    ['nullspace', 'lost', 'rangespace', '']
    """
    return next((name for name, pattern in _SPACES.items() if pattern.fullmatch(text.strip())), "")


def span_text(value: PlacedText, is_name: Callable[[str], bool]) -> PlacedText:
    """The text of the vectors alone; `is_name` says whether a word has a meaning in the problem."""
    text = value.text.strip().strip("$").strip()
    if _NOTHING.fullmatch(text):
        return placed([("0", value.origin(0))])
    whole = _SPAN_TEXT_WHOLE.fullmatch(text)
    if whole is not None:
        size = int(whole[1] or whole[3] or _RAISED.index(whole[2]) + 1)
        rows = ", ".join(str([int(i == j) for j in range(size)]) for i in range(size))
        return placed([(f"[{rows}]", value.origin(0))])
    if (numbers := _FOR_ALL.search(value.text)) is not None:
        value = value.part(0, numbers.start())
    if (span := _SPAN.match(value.text)) is not None:
        return _between(value, span.end())
    factor = _FACTOR.match(value.text)
    if factor is None or factor[1].lower() in ("\\begin", "\\left") or is_name(factor[1].strip("\\")):
        return value
    return value.part(factor.end(), len(value.text))


def _between(value: PlacedText, start: int) -> PlacedText:
    """What stands between the brackets behind `span`, as a list."""
    rest = value.part(start, len(value.text))
    opening, closing = _OPENING.match(rest.text), _CLOSING.search(rest.text)
    if opening is None or closing is None or closing.start() < opening.end():
        return rest
    inner = rest.part(opening.end(), closing.start()).pieces()
    return placed([("[", rest.origin(opening.start(1))), *inner, ("]", rest.origin(closing.start(1)))])
