"""What a result was made from, cause by cause, and what has changed since.

The causes of a result are its files, the problem, the marks, the policy, the program and,
where it went over them, the bounds; its fingerprint is one word for all of them.  Where
the record has the same fingerprint nothing is computed; where only the marks or the policy
differ the answers are marked anew; `--diff` names what has changed.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import dynsolve
from dynsolve.answers.marking.policy import Policy, shown, to_data
from dynsolve.grading.hand_ins import HandIn
from dynsolve.grading.pool import Bounds
from dynsolve.grading.problem_set import Item, ProblemSet
from dynsolve.grading.record import Key, Record

_CAUSES = {
    "hand-in": "the hand-in changed",
    "problem": "the problem changed",
    "marks": "the marks changed",
    "policy": "the policy changed",
    "program": "the program changed",
    "bounds": "the bounds changed",
}

OF_MARKS_ALONE = frozenset(("marks", "policy"))
"""The causes that touch marks alone."""


@lru_cache(maxsize=1)
def program() -> str:
    """What identifies the program: every source file that a result depends on."""
    root = Path(dynsolve.__file__).parent
    found = sha256()
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root).as_posix()
        if not name.startswith(("cli/", "draw/")):
            with suppress(FileNotFoundError):  # the program is changed just now
                found.update(name.encode() + b"\0" + path.read_bytes())
    return found.hexdigest()[:16]


def causes(problems: ProblemSet, hand_in: HandIn, bounds: Bounds | None = None) -> dict[str, str]:
    """What a result is made from, cause by cause, so that a change can be named.

    The `bounds` are one where the hand-in, or an answer of it, went over them.
    """
    item = problems.item(hand_in.problem)
    files = [[file.name, file.digest, *file.others] for file in hand_in.files]
    found = {
        "hand-in": short([files, hand_in.late, list(hand_in.left), hand_in.group]),
        "problem": short(item.text),
        "marks": of_marks(item),
        "asked": short(sorted(item.problem.marks)),
        "hints": str(problems.policy.hints),
        "policy": of_policy(problems.policy),
        "program": program(),
    }
    return {**found, "bounds": short([bounds.seconds, bounds.memory])} if bounds else found


def of_policy(policy: Policy) -> str:
    """The policy as a cause, without its hints, which are a cause by themselves."""
    return short({name: value for name, value in to_data(policy).items() if name != "hints"})


def of_marks(item: Item) -> str:
    """The marks of a problem as a cause."""
    return short({name: str(of) for name, of in item.problem.marks.items()})


def fingerprint(found: dict[str, str]) -> str:
    """One hash of all causes: the fingerprint of a result."""
    return short(found)


def fingerprints(problems: ProblemSet, hand_in: HandIn, bounds: Bounds) -> tuple[str, str]:
    """The fingerprints of a result that still holds: within any bounds, or over these."""
    within, over = causes(problems, hand_in), causes(problems, hand_in, bounds)
    return fingerprint(within), fingerprint(over)


def short(data: Any) -> str:
    """A short hash of data that JSON can represent."""
    return sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()[:16]


def touches_marks_alone(old: Mapping[str, str], new: Mapping[str, str]) -> bool:
    """Whether two sets of causes differ, and only in what touches marks alone.

    >>> touches_marks_alone({"marks": "a", "problem": "p"}, {"marks": "b", "problem": "p"})
    True
    """
    other = {cause for cause in old.keys() | new.keys() if old.get(cause) != new.get(cause)}
    return bool(other) and other <= OF_MARKS_ALONE


# -- whose marks a regrade has changed --------------------------------------------------------------


def changes(record: Record, policy: Policy) -> Iterator[str]:
    """A line for each answer whose marks are not what they were when the last run was finished."""
    if not record.compared():
        return
    for key, causes, answers in record.standing(policy):
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
