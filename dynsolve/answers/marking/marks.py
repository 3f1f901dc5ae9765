"""Verdicts -> marks, each with the one line that explains it.

A matrix earns by its entries that carry something in the key; the others are zeros that anybody
can write, and count with the rest.  With r of N entries right, and z of the Z zeros, the share is
r/N · (N + z)/(N + Z): one slip takes its part, wherever it is made, and zeros alone earn nothing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

from dynsolve.answers.marking.policy import Policy, rounded, shown
from dynsolve.answers.verdict import JudgedAnswer, Verdict
from dynsolve.quantities.index import Quantities

HALF = Fraction(1, 2)

BY_ITSELF = "earns nothing by itself"


@dataclass(frozen=True, slots=True)
class Marked:
    """The marks of one answer, and why they are what they are."""

    name: str
    marks: Fraction
    of: Fraction
    why: str


class Piece(Protocol):
    """An entry of a matrix, or a part of a whole."""

    @property
    def verdict(self) -> Verdict:
        """What was found of it."""

    @property
    def zero(self) -> bool:
        """Whether the key is 0 there."""

    @property
    def empty(self) -> bool:
        """Whether it earns nothing by itself."""


def mark(answers: Iterable[JudgedAnswer], quantities: Quantities, policy: Policy) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers, in their order, before what being `late` takes off.

    `quantities` are the robot's, which know the stage of each answer.
    """
    return tuple(_capped((_one(answer, policy) for answer in answers), quantities, policy))


def _one(answer: JudgedAnswer, policy: Policy) -> Marked:
    if not answer.of:
        return Marked(answer.name, Fraction(0), Fraction(0), f"{answer.verdict}; it carries no marks")
    share, why = _share(answer, policy)
    exact = share * answer.of
    marks = _rounded(exact, answer.of, policy)
    line = f"{why}: {shown(marks)} of {shown(answer.of)}"
    return Marked(answer.name, marks, answer.of, line + _rounding(exact, marks, policy))


def _rounded(exact: Fraction, of: Fraction, policy: Policy) -> Fraction:
    """Marks rounded to the policy's steps, never above `of`; full marks stay full."""
    return exact if exact == of else min(rounded(exact, policy.rounding), of)


def _rounding(exact: Fraction, marks: Fraction, policy: Policy) -> str:
    return f" ({shown(exact)}, rounded to steps of {shown(policy.rounding)})" if exact != marks else ""


def _share(answer: JudgedAnswer, policy: Policy) -> tuple[Fraction, str]:
    """The share of its marks that an answer earns, and why."""
    if answer.empty and answer.zero:
        return Fraction(0), f"{answer.verdict}, but {answer.loss}"
    if answer.verdict is Verdict.CORRECT:
        return Fraction(1), "correct"
    pieces: tuple[Piece, ...] = answer.entries or answer.parts
    right = _count(pieces, Verdict.CORRECT)
    follow = policy.follow * (0 if answer.empty else HALF if answer.loss else 1)
    earns = "" if follow == 1 else f"which {_earns(answer, follow)}"
    lost = f"but {answer.loss}" if answer.loss else ""
    if answer.verdict is Verdict.FOLLOWS and not right:
        source = f"follows from {', '.join(answer.follows_from)}" if answer.follows_from else "follows"
        if not pieces or answer.empty or not any(piece.empty for piece in pieces):
            return follow, ", ".join(filter(None, (source, lost, earns)))
    following = _count(pieces, Verdict.FOLLOWS)
    if len(pieces) < 2 or not right + following:
        return Fraction(0), str(answer.verdict)
    said = [f"{right} of {len(pieces)} {_word(answer)} correct"]
    said += filter(None, (f"{following} following", lost, earns)) if following else ()
    missing = _count(pieces, Verdict.MISSING)
    said += [f"{missing} missing"] if missing else []
    return _of_pieces(pieces, follow), ", ".join([*said, *_zeros(pieces)])


def _count(pieces: Iterable[Piece], verdict: Verdict) -> int:
    return sum(piece.verdict is verdict for piece in pieces)


def _earns(answer: JudgedAnswer, follow: Fraction) -> str:
    return BY_ITSELF if answer.empty else f"earns {_percent(follow)}"


def _of_pieces(pieces: tuple[Piece, ...], follow: Fraction) -> Fraction:
    """The share that a matrix or a whole earns by its pieces."""
    carrying = [piece for piece in pieces if not piece.zero]
    zeros = [piece for piece in pieces if piece.zero]
    right = sum((_worth(piece, follow) for piece in carrying), Fraction(0))
    beside = sum((_worth(piece, follow) for piece in zeros), Fraction(0))
    if not carrying:
        return beside / len(pieces)
    return right / len(carrying) * (len(carrying) + beside) / len(pieces)


def _worth(piece: Piece, follow: Fraction) -> Fraction:
    if piece.verdict is Verdict.CORRECT:
        return Fraction(1)
    return follow if piece.verdict is Verdict.FOLLOWS and not piece.empty else Fraction(0)


def _zeros(pieces: tuple[Piece, ...]) -> Iterator[str]:
    """What is said of entries that earn nothing by themselves."""
    zeros = sum(piece.zero for piece in pieces)
    if 0 < zeros < len(pieces):
        yield f"{zeros} of them 0 in the key, which count with the rest"
    empty = sum(piece.empty and piece.verdict is Verdict.FOLLOWS for piece in pieces)
    if empty:
        yield f"{empty} empty, which {BY_ITSELF}"


def _word(answer: JudgedAnswer) -> str:
    if not answer.entries:
        return "parts"
    return "rows" if len(answer.entries[0].index) == 1 else "entries"


def _percent(share: Fraction) -> str:
    return f"{shown(share * 100)} %"


def deduction(total: Fraction, days: int, policy: Policy) -> Marked | None:
    """The line that deducts from what all answers earn, so many days late, begun ones counted; or none.

    What is kept is rounded once, and the rounding never gives back what being late has taken.

    >>> deduction(Fraction(3), 1, Policy(late=Fraction(4, 5), rounding=Fraction(1, 2)))
    Marked(name='late', marks=Fraction(-1, 2), of=Fraction(0, 1), why='80 % of 3 is 2.5')
    """
    share, step = policy.kept(days), policy.rounding
    if share == 1 or not total:
        return None
    kept = rounded(total * share, step)
    if kept >= total:
        kept = (total * share / step).__floor__() * step
    return Marked("late", kept - total, Fraction(0), f"{_percent(share)} of {shown(total)} is {shown(kept)}")


def _capped(found: Iterable[Marked], quantities: Quantities, policy: Policy) -> Iterator[Marked]:
    """Cap the marks of each stage, in the order of the answers; what they are out of is capped too.

    What is left of the cap beside the marks that are earned goes to what could be earned,
    in order, so that no answer has more marks than it is out of.
    """
    found, left = list(found), dict(policy.caps)
    if not left:
        yield from found
        return
    earned = []
    for marked in found:
        stage = quantities.stage(marked.name)
        earned.append(min(marked.marks, left.get(stage, marked.marks)))
        if stage in left:
            left[stage] -= earned[-1]
    for marked, marks in zip(found, earned, strict=True):
        stage = quantities.stage(marked.name)
        if stage not in left:
            yield marked
            continue
        of = marks + min(marked.of - marks, left[stage])
        left[stage] -= of - marks
        why = marked.why
        if (marks, of) != (marked.marks, marked.of):
            why += f"; {stage} is capped at {shown(policy.caps[stage])}: {shown(marks)} of {shown(of)}"
        yield Marked(marked.name, marks, of, why)


def maximum(marks: Iterable[tuple[str, Fraction]], quantities: Quantities, policy: Policy) -> Fraction:
    """The most that a problem can earn.

    >>> from dynsolve.quantities.owners import Owners
    >>> marks = [("K", Fraction(4)), ("P", Fraction(2)), ("D", Fraction(1))]
    >>> maximum(marks, Quantities(Owners(1, (), ("1",))), Policy(caps={"energy": Fraction(5)}))
    Fraction(6, 1)
    """
    all_of = (Marked(name, of, of, "") for name, of in marks)
    return sum((marked.of for marked in _capped(all_of, quantities, policy)), Fraction(0))
