"""Verdicts -> marks, each with the one line that explains it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from dynsolve.answers.verdict import Judged, Verdict
from dynsolve.grading.policy import Policy, rounded, shown, stage_of

HALF = Fraction(1, 2)


@dataclass(frozen=True, slots=True)
class Marked:
    """The marks of one answer, and why they are what they are."""

    name: str
    marks: Fraction
    of: Fraction
    why: str


def mark(
    answers: Iterable[Judged],
    policy: Policy,
    late: bool = False,
    losses: dict[str, str] | None = None,
    parts: dict[str, tuple[Judged, ...]] | None = None,
) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers, in their order.

    `losses` says of an answer that follows what it has lost on the way; `parts` has the
    answers that a whole which is not written is judged by.
    """
    found = [_one(a, policy, (losses or {}).get(a.name, ""), (parts or {}).get(a.name, ())) for a in answers]
    if late and policy.late != 1:
        found = [_late(marked, policy) for marked in found]
    return tuple(_capped(found, policy))


def _one(answer: Judged, policy: Policy, loss: str, parts: tuple[Judged, ...]) -> Marked:
    if not answer.of:
        return Marked(answer.name, Fraction(0), Fraction(0), f"{answer.verdict}; it carries no marks")
    share, why = _share(answer, policy, loss, parts)
    exact = share * answer.of
    marks = rounded(exact, policy.rounding)
    line = f"{why}: {shown(marks)} of {shown(answer.of)}"
    return Marked(answer.name, marks, answer.of, line + _rounding(exact, marks, policy))


def _rounding(exact: Fraction, marks: Fraction, policy: Policy) -> str:
    return f" ({shown(exact)}, rounded to steps of {shown(policy.rounding)})" if exact != marks else ""


def _share(answer: Judged, policy: Policy, loss: str, parts: tuple[Judged, ...]) -> tuple[Fraction, str]:
    """The share of its marks that an answer earns, and why."""
    if answer.verdict is Verdict.CORRECT:
        return Fraction(1), "correct"
    if answer.verdict is Verdict.FOLLOWS:
        source = f"follows from {', '.join(answer.follows_from)}" if answer.follows_from else "follows"
        if loss:
            return HALF * policy.follow, f"{source}, but {loss}; {_percent(HALF * policy.follow)}"
        return policy.follow, source if policy.follow == 1 else f"{source}, {_percent(policy.follow)}"
    pieces = [entry.verdict for entry in answer.entries] or [part.verdict for part in parts]
    if answer.verdict is Verdict.WRONG and len(pieces) > 1:
        right = pieces.count(Verdict.CORRECT)
        follow = pieces.count(Verdict.FOLLOWS)
        share = (right + follow * policy.follow) / len(pieces)
        if loss:
            share *= HALF
        if right or follow:
            word = "entries" if answer.entries else "parts"
            count = f"{right} of {len(pieces)} {word} correct" + (f", {follow} following" if follow else "")
            return share, count + (f", but {loss}; half" if loss else "")
    return Fraction(0), str(answer.verdict)


def _percent(share: Fraction) -> str:
    return f"which earns {shown(share * 100)} %"


def _late(marked: Marked, policy: Policy) -> Marked:
    marks = rounded(marked.marks * policy.late, policy.rounding)
    if marks == marked.marks:
        return marked
    return replace(
        marked, marks=marks, why=f"{marked.why}; late, {shown(policy.late * 100)} % of it: {shown(marks)}"
    )


def _capped(found: Iterable[Marked], policy: Policy) -> Iterator[Marked]:
    """No stage earns more than its cap; what an answer may earn shrinks with it."""
    earned: dict[str, Fraction] = {}
    offered: dict[str, Fraction] = {}
    for marked in found:
        stage = stage_of(marked.name)
        if stage not in policy.caps:
            yield marked
            continue
        cap = policy.caps[stage]
        marks = min(marked.marks, cap - earned.get(stage, Fraction(0)))
        of = min(marked.of, cap - offered.get(stage, Fraction(0)))
        earned[stage] = earned.get(stage, Fraction(0)) + marks
        offered[stage] = offered.get(stage, Fraction(0)) + of
        why = marked.why
        if marks != marked.marks:
            why += f"; {stage} is capped at {shown(cap)}: {shown(marks)}"
        yield Marked(marked.name, marks, of, why)


def maximum(marks: Iterable[tuple[str, Fraction]], policy: Policy) -> Fraction:
    """The most that a problem can earn.

    >>> marks = [("K", Fraction(4)), ("P", Fraction(2)), ("D", Fraction(1))]
    >>> maximum(marks, Policy(caps={"energy": Fraction(5)}))
    Fraction(6, 1)
    """
    all_of = (Marked(name, of, of, "") for name, of in marks)
    return sum((marked.of for marked in _capped(all_of, policy)), Fraction(0))
