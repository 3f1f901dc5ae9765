"""The kinds of values that a key of a file may have, and the key itself.

A kind knows no file: `schema.py` says what JSON Schema makes of it, `documentation.py` how
it is written.

Kinds of values that several keys of a problem file have.

The structure of a problem file: which keys a mapping has, what kind of value each holds.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, ClassVar

from msgspec import Struct

from dynsolve.errors import ReadError
from dynsolve.notation.characters import normalize
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode

BRACKETS = re.compile(r"\{[^{}]*(?:\{[^{}]*\})?[^{}]*\}|\[[^]]*\]")
"""An example in a sentence: [0, 0, -g], {rod: {length: l1}}."""


class Plain(Struct, frozen=True):
    """A value without parts; `json` is what JSON Schema says of it."""

    called: str
    json: Mapping[str, Any]


class Expression(Struct, frozen=True):
    """A formula.

    `role` is what a symbol is that stands alone in it, in the words of a message.  `constant` says why no
    coordinate may stand in it, and is empty where one may.
    """

    role: str = ""
    constant: str = ""
    called: ClassVar[str] = "an expression"
    meaning: ClassVar[str] = "A number, a name or a formula: m1*lc1^2, 9.81, sqrt(3)/2, 90deg."


class Coordinate(Plain, frozen=True):
    """A coordinate by its name; `new` where a star after it makes one."""

    new: bool = False


class Link(Plain, frozen=True):
    """A row of the table by its number; `ground` says what row 0, the ground, is none for."""

    ground: str = ""


class Word(Struct, frozen=True):
    """One of a few words."""

    choices: tuple[str, ...]


class ListOf(Struct, frozen=True):
    """A list of at least `least` and at most `most` values of one kind.

    `told` is what an error about another value says before the help of the key, `empty` what is wrong with a
    list without values, where that is an error.  These are reported at the key where `at_key` says so.
    """

    items: ValueKind
    called: str
    least: int = 0
    most: int | None = None
    told: str = ""
    empty: str = ""
    at_key: bool = False


class MapOf(Struct, frozen=True):
    """A mapping from names that the file chooses to values of one kind."""

    values: ValueKind
    called: str


class Keyed(Struct, frozen=True):
    """A mapping with known keys, at least `least` of them, and exactly one of those of `one_of`."""

    keys: tuple[Key, ...]
    least: int = 0
    one_of: tuple[str, ...] = ()

    def __getitem__(self, name: str) -> Key:
        """The key of this name."""
        return next(key for key in self.keys if key.name == name)

    @property
    def names(self) -> tuple[str, ...]:
        """The known keys, in the order of the documentation."""
        return tuple(key.name for key in self.keys)

    @property
    def required(self) -> tuple[Key, ...]:
        """The keys that have to be there."""
        return tuple(key for key in self.keys if key.required)


class OneOf(Struct, frozen=True):
    """A value of one of several kinds."""

    kinds: tuple[ValueKind, ...]


class Shared(Struct, frozen=True):
    """A kind that several keys have; the schema defines it once, under `name`."""

    name: str
    kind: ValueKind
    called: str
    meaning: str = ""


ValueKind = Plain | Expression | Word | ListOf | MapOf | Keyed | OneOf | Shared


class Key(Struct, frozen=True):
    """A key of a mapping.

    `meaning` is one sentence, `more` what else a writer should know.  `example` is a
    value in YAML; one that is `active` stands in the file of `dynsolve new` as it is,
    others as a comment.  `default` is the value where the key is not given, or words
    about it.  `remedy` is the help of an error about the value, where it is not simply
    the example.  `called` is what an error calls the value, with {of} for the mapping, {last} for the
    last part of "a turn of body 1".  `own` says that the file of its part reads it.  `serves` are the answers
    that it is given for, where it is for nothing else.
    """

    name: str
    kind: ValueKind
    meaning: str = ""
    example: str = ""
    default: str = ""
    required: bool = False
    more: str = ""
    active: bool = False
    remedy: str = ""
    called: str = ""
    own: bool = False
    serves: tuple[str, ...] = ()

    @property
    def described(self) -> str:
        """Its meaning: its own, or else that of its kind."""
        return self.meaning or (self.kind.meaning if isinstance(self.kind, Shared | Expression) else "")

    @property
    def help(self) -> str:
        """What an error about its value advises."""
        return self.remedy or f"write {self.name}: {self.example}"


def ways(kind: ValueKind) -> list[str]:
    """The ways in which a value of this kind is written; code is set in backticks.

    >>> ways(OneOf((Word(("tip", "origin")), Plain("a number", {}))))
    ['`tip`', '`origin`', 'a number']
    """
    match kind:
        case Word(choices):
            return [f"`{choice}`" for choice in choices]
        case OneOf(kinds):
            return [way for one in kinds for way in ways(one)]
        case Keyed(keys):
            brief = len(keys) > 2
            return [f"`{{{', '.join(key.name if brief else f'{key.name}: {key.example}' for key in keys)}}}`"]
    return [kind.called]


def either(names: Iterable[str]) -> str:
    """One of several.

    >>> either(["a", "b", "c"])
    'a, b or c'
    """
    *most, last = names
    return f"{', '.join(most)} or {last}" if most else last


# Kinds of values that several keys of a problem file have

TEXT = Plain("a line of text", {"type": ["string", "number"]})
NUMBER = Plain("a number", {"type": ["string", "number"]})
NAME = Plain("a name", {"type": "string"})
COORDINATE = Coordinate("a name", {"type": "string"})
EXPRESSION = Expression()


def vector(role: str = "", constant: str = "") -> Shared:
    """Three expressions [x, y, z]; see `Expression`."""
    return Shared("vector", ListOf(Expression(role, constant), "", 3, 3), "`[x, y, z]`")


VECTOR = vector()
MATRIX = Shared("matrix", ListOf(VECTOR, "", 3, 3), "a 3×3 list")
ROTATION = Shared(
    "rotation",
    OneOf((Plain("`Rz(90deg) Rx(30deg)`", {"type": "string", "pattern": "^R[xyz] ?\\("}), MATRIX)),
    "a rotation",
    "A product of rotations, left to right: Rz(90deg) Rx(30deg); or a 3×3 list.",
)

# -- a point of a link -----------------------------------------------------------------------------

CENTERS = Word(("tip", "origin", "midpoint"))
ALONG = Keyed((Key("along", EXPRESSION, example="1/2", required=True),))
NEAR = Keyed((Key("near", VECTOR, example="[lc1, 0, 0]", required=True),))
DRAWN = Keyed((Key("drawn", VECTOR, example="[l1, 0, h]", required=True),))
MEASURED = Keyed((*ALONG.keys, *NEAR.keys, *DRAWN.keys))
PLACE = OneOf((CENTERS, ALONG, NEAR, DRAWN, VECTOR))
LINK = Plain("a whole number", {"type": "integer", "minimum": 1})
FRAME = Plain("a whole number", {"type": "integer", "minimum": 0})
OF_PROBLEM = "it is a constant of the problem"
PARAMETER = Expression(constant=OF_PROBLEM)
VISCOUS = Expression("a coefficient of viscous friction", OF_PROBLEM)
MOST_ACTS = 20
"""The most springs, dampers and motors that are read, of each."""


def list_of(name: str, record: Keyed) -> ListOf:
    """A list of what acts: of springs, each a record of these keys; `name` is what one is called."""
    return ListOf(Shared(name.replace(" ", "_"), record, f"a {name}"), f"a list of {name}s", 0, MOST_ACTS)


# The structure of a problem file: which keys a mapping has, what kind of value each holds


def describe(node: YamlNode) -> str:
    """The kind of a node in words, for a message."""
    if isinstance(node, MappingNode):
        return "a mapping"
    if isinstance(node, ListNode):
        return "a list"
    return f"`{_short(node.text)}`" if isinstance(node, ScalarNode) and node.text else "nothing"


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= 40 else text[:37] + "..."


CALLED = {
    "name": ("title",),
    "robot": ("title", "dh"),
    "joints": ("dh",),
    "table": ("dh",),
    "links": ("masses", "dh"),
    "bodies": ("masses",),
    "at": ("center", "through"),
    "com": ("center",),
    "cog": ("center",),
    "position": ("center", "at"),
    "m": ("mass",),
    "tensor": ("inertia",),
    "params": ("values",),
    "numbers": ("values",),
    "parameters": ("values",),
    "points": ("marks",),
    "wanted": ("find",),
    "answers": ("find",),
    "damping": ("friction", "dampers"),
    "offset": ("d",),
    "length": ("a",),
    "twist": ("alpha",),
}
"""What other files call a key: where it is none itself, the first of these that is."""


def nearest(word: str, known: Iterable[str]) -> str:
    """The known word that was probably meant, or nothing where none is near.

    >>> nearest("mas", ("mass", "link")), nearest("zx", ("xx", "xz")), nearest("foo", ("mass",))
    ('mass', 'xz', '')
    >>> nearest("com", ("mass", "center")), nearest("bodies", ("masses", "model"))
    ('center', 'masses')
    """
    folded = {name.lower(): name for name in known}
    word = word.lower()[:60]
    if word in folded:
        return folded[word]
    for key in CALLED.get(word, ()):
        if key in folded:
            return key
    if word[::-1] in folded:
        return folded[word[::-1]]
    close = get_close_matches(word, folded, 1, 0.6)
    return folded[close[0]] if close else ""


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The question whether the nearest known word was meant, or nothing."""
    meant = nearest(word, known)
    return f"did you mean `{meant}`?" if meant else ""


def odd_letter(word: str) -> str:
    """A remark on the first letter that is not Latin but may look so."""
    for character in word:
        if not character.isascii():
            name = unicodedata.name(character, "?").lower()
            return f"`{character}` is U+{ord(character):04X} ({name})"
    return ""


def _spelled_out(word: str, known: Sequence[str]) -> str:
    """The known word that is written with a Greek letter, as in the table on paper."""
    try:
        spelled = normalize(word) if not word.isascii() else ""
    except ReadError:
        return ""
    return spelled if spelled in known else ""


def unknown(faults: Faults, key: ScalarNode, value: YamlNode, known: Sequence[str], what: str) -> str:
    """Note an unknown key; the known one that was probably meant, or nothing."""
    word = key.decoded
    name, colon, _ = word.partition(":")
    if colon and name.strip() in known and isinstance(value, ScalarNode) and not value.text:
        message = f"a blank is missing after the colon of `{name}:`"
        help = f"write `{name}: {word.partition(':')[2].strip()}`"
        faults.error(key.span, message, help)
        return name.strip()
    odd = odd_letter(word)
    plain = "".join(c if c.isascii() else "?" for c in word)
    meant = _spelled_out(word, known) or nearest(plain, known)
    help = f"did you mean `{meant}`?" if meant else f"known are {', '.join(known)}"
    if odd:
        help = f"{odd}; {help}"
    faults.error(key.span, f"unknown key `{_short(word)}` in {what}", help)
    return meant


class Fields:
    """A mapping with known keys; unknown ones are reported when it is made."""

    def __init__(self, faults: Faults, node: MappingNode, known: Sequence[str], what: str) -> None:
        self.faults, self.span, self.what = faults, node.span, what
        self._values: dict[str, YamlNode] = {}
        self._keys: dict[str, ScalarNode] = {}
        self._meant: set[str] = set()
        for key, value in node.entries:
            if key.decoded in known:
                self._values[key.decoded], self._keys[key.decoded] = value, key
            else:
                self._meant.add(unknown(faults, key, value, known, what))

    def __contains__(self, key: str) -> bool:
        return key in self._values

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def lacks(self, key: str) -> bool:
        """Whether a key is not given, not even misspelled."""
        return key not in self._values and key not in self._meant

    def get(self, key: str) -> YamlNode | None:
        """The value of a key, None where it is not given."""
        return self._values.get(key)

    def refuse(self, key: str) -> None:
        """Take out a key that was reported, so that nothing more is said of it."""
        self._meant.add(key)
        del self._values[key]

    def key_span(self, key: str) -> Span:
        """Where a key stands; where it does not, the mapping."""
        return self._keys[key].span if key in self._keys else self.span

    def span_of(self, key: str) -> Span:
        """Where the value of a key stands; where it does not, the mapping."""
        node = self._values.get(key)
        if node is None:
            return self.span
        return node.span if node.span[1] > node.span[0] else self.key_span(key)


def mapping(
    faults: Faults, node: YamlNode | None, known: Sequence[str], what: str, help: str
) -> Fields | None:
    """A mapping's fields, or None (reported) where it is none."""
    if isinstance(node, MappingNode):
        return Fields(faults, node, known, what)
    if node is not None and not isinstance(node, FaultyNode):
        faults.error(node.span, f"{what} must be a mapping, not {describe(node)}", help)
    return None


def items(faults: Faults, node: YamlNode | None, what: str, help: str) -> tuple[YamlNode, ...]:
    """The items of a list; empty (and reported) where it is none."""
    if isinstance(node, ListNode):
        return node.items
    if node is not None and not isinstance(node, FaultyNode):
        faults.error(node.span, f"{what} must be a list, not {describe(node)}", help)
    return ()


def word(
    faults: Faults, node: YamlNode | None, known: Sequence[str], what: str, help: str = ""
) -> str | None:
    """One of a few words, None (reported, with `help` unless one is close) where it is another."""
    if node is None or isinstance(node, FaultyNode):
        return None
    text = node.text if isinstance(node, ScalarNode) else ""
    if text in known:
        return text
    choices = ", ".join(known)
    close = did_you_mean(text, known) if text else ""
    message = f"{what} is one of {choices}, not {describe(node)}"
    faults.error(node.span, message, close or help or f"write one of {choices}")
    return None


def whole_number(faults: Faults, node: YamlNode | None, what: str, help: str) -> int | None:
    """A number 0, 1, 2, ... of few digits, None (reported) where it is none."""
    if node is None or isinstance(node, FaultyNode):
        return None
    if isinstance(node, ScalarNode) and node.text.isascii() and node.text.isdigit() and len(node.text) <= 4:
        return int(node.text)
    faults.error(node.span, f"{what} is a whole number, not {describe(node)}", help)
    return None


def read_link(faults: Faults, node: YamlNode | None, rows: int, ground: str) -> int | None:
    """The row of the table that something moves with; `ground` says what there is none of on row 0."""
    help = f"links are counted by the rows of the table, from 1 to {rows}" if rows else "write link: 1"
    link = whole_number(faults, node, "link", help)
    if node is None or link is None:
        return None
    if link == 0:
        faults.error(node.span, f"link 0 is the ground, {ground}", help)
        return None
    if rows and link > rows:
        faults.error(node.span, f"there is no link {link}: the table has {rows} row{'s' * (rows > 1)}", help)
        return None
    return link


def free_text(faults: Faults, node: YamlNode | None, what: str) -> str:
    """A line of prose; empty where there is none."""
    if isinstance(node, ScalarNode):
        return " ".join(node.decoded.split())
    if node is not None and not isinstance(node, FaultyNode):
        faults.error(node.span, f"{what} is a line of text, not {describe(node)}", "write it on one line")
    return ""
