"""Marks anew: the record keeps of each answer what its marks are made from (`Kept`).

So other points, or another policy, need no hand-in to be judged again (`rescored`).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import NamedTuple

from dynsolve.answers.marking.marks import Marked, mark
from dynsolve.answers.marking.policy import Policy
from dynsolve.answers.verdict import EntryVerdict, JudgedAnswer, Verdict
from dynsolve.quantities.index import Quantities


class Kept(NamedTuple):
    """What the record keeps of an answer for marking it again; `basis` is the text that `basis` made."""

    name: str
    verdict: str
    loss: str
    basis: str


def basis(answer: JudgedAnswer) -> str:
    """What the marks of an answer depend on besides its verdict and its loss, as text for the record.

    >>> basis(JudgedAnswer("K", Verdict.FOLLOWS, follows_from=("K1",)))
    '[["K1"], [], [], 0, 0]'
    """
    entries = [[*entry.index, *_piece(entry)] for entry in answer.entries]
    parts = [_piece(part) for part in answer.parts]
    return json.dumps([list(answer.follows_from), entries, parts, int(answer.zero), int(answer.empty)])


def _piece(piece: EntryVerdict | JudgedAnswer) -> list[str | int]:
    return [str(piece.verdict), int(piece.zero), int(piece.empty)]


def rescored(
    kept: Iterable[Kept],
    points: Mapping[str, Fraction],
    quantities: Quantities,
    policy: Policy,
) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers as they are now.

    >>> from dynsolve.quantities.owners import Owners
    >>> quantities = Quantities(Owners(1, (), ("1",)))
    >>> kept = [Kept("K", "follows", "", '[["K1"], [], [], 0, 0]')]
    >>> policy = Policy(follow=Fraction(1, 2))
    >>> rescored(kept, {"K": Fraction(4)}, quantities, policy)[0].marks
    Fraction(2, 1)
    """
    answers = (_restored(one, points.get(one.name, Fraction(0))) for one in kept)
    return mark(answers, quantities, policy)


def _restored(kept: Kept, of: Fraction) -> JudgedAnswer:
    """The answer as far as its marks depend on it."""
    follows_from, entries, parts, zero, empty = json.loads(kept.basis)
    return JudgedAnswer(
        kept.name,
        Verdict(kept.verdict),
        follows_from=tuple(follows_from),
        entries=tuple(
            EntryVerdict(tuple(index), Verdict(verdict), zero=bool(zero), empty=bool(empty))
            for *index, verdict, zero, empty in entries
        ),
        of=of,
        zero=bool(zero),
        empty=bool(empty),
        loss=kept.loss,
        parts=tuple(JudgedAnswer("", Verdict(v), zero=bool(z), empty=bool(e)) for v, z, e in parts),
    )
