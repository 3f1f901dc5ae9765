"""What holds for several bodies, coordinates or columns alike: said of the first, and referred to after that.

Two steps say the same where their titles and their sentences differ in the number that the title names,
and in the one before it, alone: with "body 2" η₂ and o₁ stand where η₁ and o₀ stood with "body 1".
"""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import dataclass

from dynsolve.document import Inline, Prose, Reference
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.latex import to_latex
from dynsolve.notation.tree import Node
from dynsolve.render.page_ends import leads_on

_OF = re.compile(r"\b(body|coordinate|column|frame) (\w+)", re.IGNORECASE)
_SHORT = 60
"""Sentences of up to so many characters are no longer than what refers to them, and are repeated."""


@dataclass(frozen=True, slots=True)
class _Said:
    """What a step says: of whom, in which account, in which words."""

    name: str
    detail: Detail
    text: str


class SaidOnce:
    """What the steps so far have said."""

    def __init__(self) -> None:
        self._said: dict[str, list[_Said]] = defaultdict(list)

    def why(self, step: Step) -> Prose:
        """Why a step is taken; where the same is said of another body: As for body 1."""
        text = "".join(map(_words, step.why))
        of = _OF.search(step.title)
        if of is None or len(text) <= _SHORT:
            return step.why
        kind, name = of[1].lower(), of[2]
        before = self._said[_OF.sub(kind, step.title)]
        for said in before:
            if said.detail <= step.detail and _is_the_same(said.text, said.name, text, name):
                labels = [label for part in step.why if isinstance(part, Reference) for label in part.labels]
                ending = ":" if leads_on(step.why) else "."
                return (f"As for {kind} {said.name}", Reference(tuple(labels), ", with "), ending)
        before.append(_Said(name, step.detail, text))
        return step.why


def _words(part: Inline) -> str:
    """A piece of a sentence as it is compared; of references what leads to them, their numbers being few."""
    if isinstance(part, Node):
        return to_latex(part)
    return part.before if isinstance(part, Reference) else str(part)


def _is_the_same(text: str, name: str, other: str, other_name: str) -> bool:
    """Whether two texts differ in the names alone, and in the number before each.

    >>> _is_the_same("o_0 to o_1", "1", "o_1 to o_2", "2"), _is_the_same("q_2", "1", "q_3", "2")
    (True, False)
    """
    pieces, others = _split(text, name), _split(other, other_name)
    if len(pieces) != len(others):
        return False
    pairs = {(name, other_name)}
    if name.isdecimal() and other_name.isdecimal():
        pairs.add((str(int(name) - 1), str(int(other_name) - 1)))
    return all(one == two or (one, two) in pairs for one, two in zip(pieces, others, strict=True))


def _split(text: str, name: str) -> list[str]:
    """A text cut at its numbers and at a name."""
    return re.split(rf"(\d+|\b{re.escape(name)}\b)", text)
