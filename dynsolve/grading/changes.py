"""Whose marks a regrade has changed, and why."""

from __future__ import annotations

import json
from collections.abc import Iterator

from dynsolve.grading.policy import shown
from dynsolve.grading.record import Record

Before = dict[tuple[str, str], tuple[dict[str, str], dict[str, list[str]]]]

_CAUSES = {
    "hand-in": "the hand-in changed",
    "problem": "the problem changed",
    "marks": "the marks changed",
    "policy": "the policy changed",
    "program": "the program changed",
}


def changes(before: Before, record: Record) -> Iterator[str]:
    """A line for each answer whose marks are not what they were when the last run was finished."""
    now = {key: (json.loads(causes), {n: rest for n, *rest in a}) for key, causes, a in record.standing()}
    for key in sorted(before.keys() | now.keys()):
        old_causes, old = before.get(key, ({}, {}))
        new_causes, new = now.get(key, ({}, {}))
        why = _why(old_causes, new_causes)
        for name in dict.fromkeys((*old, *new)):
            was, is_ = old.get(name), new.get(name)
            if (was and was[1]) != (is_ and is_[1]):
                yield f"{key[0]} {key[1]} {name}: {_marks(was)} -> {_marks(is_)} ({_reason(why, was, is_)})"


def _marks(entry: list[str] | None) -> str:
    from fractions import Fraction

    return "none" if entry is None else shown(Fraction(entry[1]))


def _why(old: dict[str, str], new: dict[str, str]) -> str:
    if not old:
        return "it is new"
    if not new:
        return "it is there no more"
    return ", ".join(said for cause, said in _CAUSES.items() if old.get(cause) != new.get(cause))


def _reason(why: str, was: list[str] | None, now: list[str] | None) -> str:
    explained = now[2] if now else ""
    return "; ".join(part for part in (why, explained) if part)
