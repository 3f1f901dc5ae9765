"""The kinds of values that a key of a file may have, and the key itself.

A kind knows no file: `schema.py` says what JSON Schema makes of it, `documentation.py` how
it is written.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

BRACKETS = re.compile(r"\{[^{}]*(?:\{[^{}]*\})?[^{}]*\}|\[[^]]*\]")
"""An example in a sentence: [0, 0, -g], {rod: {length: l1}}."""


@dataclass(frozen=True, slots=True)
class Plain:
    """A value without parts; `json` is what JSON Schema says of it."""

    called: str
    json: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Word:
    """One of a few words."""

    choices: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ListOf:
    """A list of at least `least` and at most `most` values of one kind."""

    items: ValueKind
    called: str
    least: int = 0
    most: int | None = None


@dataclass(frozen=True, slots=True)
class MapOf:
    """A mapping from names that the file chooses to values of one kind."""

    values: ValueKind
    called: str


@dataclass(frozen=True, slots=True)
class Keyed:
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


@dataclass(frozen=True, slots=True)
class OneOf:
    """A value of one of several kinds."""

    kinds: tuple[ValueKind, ...]


@dataclass(frozen=True, slots=True)
class Shared:
    """A kind that several keys have; the schema defines it once, under `name`."""

    name: str
    kind: ValueKind
    called: str
    meaning: str = ""


ValueKind = Plain | Word | ListOf | MapOf | Keyed | OneOf | Shared


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a mapping.

    `meaning` is one sentence, `more` what else a writer should know.  `example` is a
    value in YAML; one that is `active` stands in the file of `dynsolve new` as it is,
    others as a comment.  `default` is the value where the key is not given, or words
    about it.  `remedy` is the help of an error about the value, where it is not simply
    the example.
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

    @property
    def described(self) -> str:
        """Its meaning: its own, or else that of its kind."""
        return self.meaning or (self.kind.meaning if isinstance(self.kind, Shared) else "")

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
