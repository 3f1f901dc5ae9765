"""Verdicts -> marks, each with the one line that explains it.

The record keeps of each answer what its marks are made from (`Kept`), so that other
points, or another policy, need no hand-in to be judged again (`rescored`).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NamedTuple

from dynsolve.answers.verdict import EntryVerdict, JudgedAnswer, Verdict
from dynsolve.grading.policy import Policy, rounded, shown
from dynsolve.quantities.index import Quantities

HALF = Fraction(1, 2)


@dataclass(frozen=True, slots=True)
class Marked:
    """The marks of one answer, and why they are what they are."""

    name: str
    marks: Fraction
    of: Fraction
    why: str


def mark(
    answers: Iterable[JudgedAnswer],
    quantities: Quantities,
    policy: Policy,
    late: bool = False,
    losses: dict[str, str] | None = None,
    parts: dict[str, tuple[JudgedAnswer, ...]] | None = None,
) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers, in their order.

    `quantities` are the robot's, which know the stage of each answer.  `losses` says of an
    answer that follows what it has lost on the way; `parts` has the answers that a whole
    which is not written is judged by.
    """
    found = [_one(a, policy, (losses or {}).get(a.name, ""), (parts or {}).get(a.name, ())) for a in answers]
    if late and policy.late != 1:
        found = [_late(marked, policy) for marked in found]
    return tuple(_capped(found, quantities, policy))


def _one(answer: JudgedAnswer, policy: Policy, loss: str, parts: tuple[JudgedAnswer, ...]) -> Marked:
    if not answer.of:
        return Marked(answer.name, Fraction(0), Fraction(0), f"{answer.verdict}; it carries no marks")
    share, why = _share(answer, policy, loss, parts)
    exact = share * answer.of
    marks = _rounded(exact, answer.of, policy)
    line = f"{why}: {shown(marks)} of {shown(answer.of)}"
    return Marked(answer.name, marks, answer.of, line + _rounding(exact, marks, policy))


def _rounded(exact: Fraction, of: Fraction, policy: Policy) -> Fraction:
    """Marks rounded to the policy's steps, never above `of`; full marks stay full."""
    return exact if exact == of else min(rounded(exact, policy.rounding), of)


def _rounding(exact: Fraction, marks: Fraction, policy: Policy) -> str:
    return f" ({shown(exact)}, rounded to steps of {shown(policy.rounding)})" if exact != marks else ""


def _share(
    answer: JudgedAnswer, policy: Policy, loss: str, parts: tuple[JudgedAnswer, ...]
) -> tuple[Fraction, str]:
    """The share of its marks that an answer earns, and why."""
    if answer.verdict is Verdict.CORRECT:
        return Fraction(1), "correct"
    pieces = [entry.verdict for entry in answer.entries] or [part.verdict for part in parts]
    right, following = pieces.count(Verdict.CORRECT), pieces.count(Verdict.FOLLOWS)
    follow = policy.follow * (HALF if loss else 1)
    earns = "" if follow == 1 else f"which earns {_percent(follow)}"
    lost = f"but {loss}" if loss else ""
    if answer.verdict is Verdict.FOLLOWS and not right:
        source = f"follows from {', '.join(answer.follows_from)}" if answer.follows_from else "follows"
        return follow, ", ".join(filter(None, (source, lost, earns)))
    if len(pieces) < 2 or not right + following:
        return Fraction(0), str(answer.verdict)
    said = [f"{right} of {len(pieces)} {_word(answer)} correct"]
    said += filter(None, (f"{following} following", lost, earns)) if following else ()
    missing = pieces.count(Verdict.MISSING)
    said += [f"{missing} missing"] if missing else []
    return (right + following * follow) / len(pieces), ", ".join(said)


def _word(answer: JudgedAnswer) -> str:
    if not answer.entries:
        return "parts"
    return "rows" if len(answer.entries[0].index) == 1 else "entries"


def _percent(share: Fraction) -> str:
    return f"{shown(share * 100)} %"


def _late(marked: Marked, policy: Policy) -> Marked:
    marks = min(rounded(marked.marks * policy.late, policy.rounding), marked.marks)
    if marks == marked.marks:
        return marked
    why = f"{marked.why}; late, {_percent(policy.late)} of it: {shown(marks)}"
    return replace(marked, marks=marks, why=why)


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

    >>> from dynsolve.quantities.index import Owners
    >>> marks = [("K", Fraction(4)), ("P", Fraction(2)), ("D", Fraction(1))]
    >>> maximum(marks, Quantities(Owners(1, (), ("1",))), Policy(caps={"energy": Fraction(5)}))
    Fraction(6, 1)
    """
    all_of = (Marked(name, of, of, "") for name, of in marks)
    return sum((marked.of for marked in _capped(all_of, quantities, policy)), Fraction(0))


# -- marks anew --------------------------------------------------------------------------------------


class Kept(NamedTuple):
    """What the record keeps of an answer for marking it again; `basis` is the text that `basis` made."""

    name: str
    verdict: str
    loss: str
    basis: str


def basis(answer: JudgedAnswer, parts: tuple[JudgedAnswer, ...]) -> str:
    """What the marks of an answer depend on besides its verdict, as text for the record.

    >>> basis(JudgedAnswer("K", Verdict.FOLLOWS, follows_from=("K1",)), ())
    '[["K1"], [], []]'
    """
    entries = [[*entry.index, str(entry.verdict)] for entry in answer.entries]
    return json.dumps([list(answer.follows_from), entries, [str(part.verdict) for part in parts]])


def rescored(
    kept: Iterable[Kept],
    points: Mapping[str, Fraction],
    quantities: Quantities,
    policy: Policy,
    late: bool,
) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers as they are now.

    >>> from dynsolve.quantities.index import Owners
    >>> kept, quantities = [Kept("K", "follows", "", '[["K1"], [], []]')], Quantities(Owners(1, (), ("1",)))
    >>> policy = Policy(follow=Fraction(1, 2))
    >>> rescored(kept, {"K": Fraction(4)}, quantities, policy, late=False)[0].marks
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
    return mark(answers, quantities, policy, late, losses, parts)
