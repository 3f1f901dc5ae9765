"""Whose marks a regrade has changed, and why."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction

from dynsolve.grading.policy import shown
from dynsolve.grading.record import Key, Record

_CAUSES = {
    "hand-in": "the hand-in changed",
    "problem": "the problem changed",
    "marks": "the marks changed",
    "policy": "the policy changed",
    "program": "the program changed",
    "bounds": "the bounds changed",
}


def changes(record: Record) -> Iterator[str]:
    """A line for each answer whose marks are not what they were when the last run was finished."""
    if not record.compared():
        return
    for key, causes, answers in record.standing():
        old_causes, old = record.finished(key)
        new = {name: rest for name, *rest in answers}
        yield from _of_hand_in(key, _why(old_causes, json.loads(causes)), old, new)
    for key in record.gone():
        yield from _of_hand_in(key, "it is there no more", record.finished(key)[1], {})


def _of_hand_in(key: Key, why: str, old: dict[str, list[str]], new: dict[str, list[str]]) -> Iterator[str]:
    for name in dict.fromkeys((*old, *new)):
        was, now = old.get(name), new.get(name)
        if (was and was[1]) != (now and now[1]):
            reason = "; ".join(part for part in (why, now[2] if now else "") if part)
            yield f"{key[0]} {key[1]} {name}: {_marks(was)} -> {_marks(now)} ({reason})"


def _marks(entry: list[str] | None) -> str:
    return "none" if entry is None else shown(Fraction(entry[1]))


def _why(old: dict[str, str], new: dict[str, str]) -> str:
    if not old:
        return "it is new"
    return ", ".join(said for cause, said in _CAUSES.items() if old.get(cause) != new.get(cause))
