"""Marks anew: other points, or another policy, need no hand-in to be judged again.

The record keeps of each answer what its marks were made from, so that `mark` is asked
again as it was asked beside the verdicts themselves.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import NamedTuple

from dynsolve.answers.verdict import EntryVerdict, JudgedAnswer, Verdict
from dynsolve.grading.marking import Marked, mark
from dynsolve.grading.policy import Policy

CHEAP = frozenset(("marks", "policy"))
"""The causes that touch marks alone."""


class Kept(NamedTuple):
    """What the record has of an answer that its marks are made from; `basis` is what `basis` wrote."""

    name: str
    verdict: str
    loss: str
    basis: str


def basis(answer: JudgedAnswer, parts: tuple[JudgedAnswer, ...]) -> str:
    """What the marks of an answer are made from beside its verdict, as the record keeps it.

    >>> basis(Judged("K", Verdict.FOLLOWS, follows_from=("K1",)), ())
    '[["K1"], [], []]'
    """
    entries = [[*entry.index, str(entry.verdict)] for entry in answer.entries]
    return json.dumps([list(answer.follows_from), entries, [str(part.verdict) for part in parts]])


def remarked(
    kept: Iterable[Kept], points: Mapping[str, Fraction], policy: Policy, late: bool
) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers as they are now.

    >>> kept = [Kept("K", "follows", "", '[["K1"], [], []]')]
    >>> remarked(kept, {"K": Fraction(4)}, Policy(follow=Fraction(1, 2)), late=False)[0].marks
    Fraction(2, 1)
    """
    answers, losses, parts = [], {}, {}
    for name, verdict, loss, text in kept:
        follows_from, entries, pieces = json.loads(text)
        answers.append(
            JudgedAnswer(
                name,
                Verdict(verdict),
                follows_from=tuple(follows_from),
                entries=tuple(EntryVerdict(tuple(index), Verdict(of)) for *index, of in entries),
                of=points.get(name, Fraction(0)),
            )
        )
        losses[name] = loss
        parts[name] = tuple(JudgedAnswer(name, Verdict(of)) for of in pieces)
    return mark(answers, policy, late, losses, parts)


def is_cheap(old: Mapping[str, str], new: Mapping[str, str]) -> bool:
    """Whether two sets of causes differ, and only in what touches marks alone.

    >>> is_cheap({"marks": "a", "problem": "p"}, {"marks": "b", "problem": "p"})
    True
    """
    other = {cause for cause in old.keys() | new.keys() if old.get(cause) != new.get(cause)}
    return bool(other) and other <= CHEAP
