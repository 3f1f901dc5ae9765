"""What was read before: a cohort writes the same names and terms over and over.

A term is known by its tokens, so a term that was met before costs a look-up instead of
a descent.  Only what means the same wherever it stands is remembered: terms in the
symbols of the problem, without a name of an answer and without a note.  A memory holds
for one set of names; what a student defines begins a new one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.measure import Measure, measured
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Node

MOST = 8_000
"""So much of a kind is remembered; then it is begun anew."""

MOST_TOKENS = 40
"""A longer term is read as it comes: it is seldom written twice."""

Signs = tuple[tuple[Any, ...], ...]
"""What tokens say, without where they stand."""

_OPENS = frozenset({"(", "[", "{", "begin"})
_CLOSES = frozenset({")", "]", "}", "close"})
_ENDS = frozenset({",", ";", "&", "\\\\", "end", "="})
_BEFORE_A_SIGN = frozenset({"*", "/", "^", "cdot", "times", "_", "over"})


class Term(NamedTuple):
    """A term that was read: its tree, the symbols in it, and how many levels deeper it goes."""

    node: Node
    symbols: tuple[str, ...]
    levels: int


def signs(tokens: list[Token]) -> Signs:
    """What tokens say; a blank counts before `*` alone, which may be a product or a mark."""
    return tuple([(t[0], t[1], t[4], t[5] and t[0] == "*") for t in tokens])


def extent(tokens: list[Token], start: int) -> int:
    """Where the term that begins there ends; 0 where its tokens alone do not tell."""
    level = 0
    last = min(len(tokens), start + MOST_TOKENS)
    for at in range(start, last):
        kind = tokens[at][0]
        if kind in _OPENS:
            level += 1
        elif kind in _CLOSES:
            if level == 0:
                return at
            level -= 1
        elif level == 0 and (kind == "+" or kind == "-"):
            return 0 if at == start or tokens[at - 1][0] in _BEFORE_A_SIGN else at
        elif level == 0 and kind in _ENDS:
            return at
    return 0


@dataclass(frozen=True, slots=True)
class NamedAnswers:
    """The answers that a side of an equation may name."""

    candidates: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Unknown:
    """A side that is a name which means nothing; `simple` where it is that name alone."""

    key: str
    family: tuple[str, ...]
    simple: bool
    message: str


Side = NamedAnswers | Unknown | None
"""What a side of an equation names; None where it is something else."""


@dataclass(slots=True)
class Memory:
    """What names and terms were found to be.

    `plain` are names without scripts, `pieces` runs of letters with the names they are
    made of; `sides` and `keys` what the left sides of equations and the keys of answer
    files name; `measures` the sizes of the remembered trees by their identity; `cuts` and
    `members` the parts and the values of whole texts, for students copy.  Of each kind
    there are at most `most`.
    """

    terms: dict[Signs, Term] = field(default_factory=dict)
    measures: dict[int, Measure] = field(default_factory=dict)
    plain: dict[str, Node] = field(default_factory=dict)
    pieces: dict[tuple[Any, ...], list[str]] = field(default_factory=dict)
    sides: dict[Signs, Side] = field(default_factory=dict)
    keys: dict[str, Side] = field(default_factory=dict)
    cuts: dict[tuple[Any, str], Any] = field(default_factory=dict)
    members: dict[tuple[str, int, tuple[str, ...]], Any] = field(default_factory=dict)
    most: int = MOST

    def keep(self, key: Signs, term: Term) -> None:
        """Remember a term, unless it is too large to be read at all."""
        if key in self.terms:  # its measure stands under the identity of the tree that is there
            return
        if len(self.terms) >= self.most:
            self.terms, self.measures = {}, {}
        try:
            self.measures[id(term.node)] = measured(term.node, {}, self.measures)
        except ReadError:
            return
        self.terms[key] = term
