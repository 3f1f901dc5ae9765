"""What a result was made from, cause by cause, and what has changed since.

The causes of a result are its files, the problem, the marks, the policy, the program and,
where it went over them, the bounds; its fingerprint is one word for all of them.  Where
the record has the same fingerprint nothing is computed; where only the marks or the policy
differ the answers are marked anew; `--diff` names what has changed.

The rows of the record: of what was judged, what could not be, and what was not handed in.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from fractions import Fraction
from hashlib import sha256
from typing import Any

from dynsolve.answers.marks import Policy, mark, shown, to_data
from dynsolve.answers.verdict import JudgedAnswer, Verdict
from dynsolve.grading.hand_ins import HandIn, Intake
from dynsolve.grading.pool import Bounds, program
from dynsolve.grading.record import Key, Record
from dynsolve.grading.set_file import Item, ProblemSet
from dynsolve.quantities.index import quantities

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


def causes(problems: ProblemSet, hand_in: HandIn, bounds: Bounds | None = None) -> dict[str, str]:
    """What a result is made from, cause by cause, so that a change can be named.

    The `bounds` are one where the hand-in, or an answer of it, went over them.
    """
    item = problems.item(hand_in.problem, hand_in.student)
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


def fingerprints(problems: ProblemSet, hand_in: HandIn, bounds: Bounds) -> tuple[str, str]:
    """The fingerprints of a result that still holds: within any bounds, or over these."""
    return short(causes(problems, hand_in)), short(causes(problems, hand_in, bounds))


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


# The rows of the record: of what was judged, what could not be, and what was not handed in

Data = dict[str, Any]

Row = tuple[Key, str, str, Data]
"""A hand-in: student and problem, its fingerprint, its causes as JSON, and what is known of it."""

MOST_LOST = 3
"""So many equations that were not recognized are named where nothing was, and so many files."""


def row_of_result(problems: ProblemSet, hand_in: HandIn, said: Data, bounds: Bounds) -> Row:
    """The row of a hand-in, from what the pool says of it: its result, or why there is none."""
    result = said.get("result", {})
    reason = said.get("reason", "") or _empty(result)
    over = "reason" in said or result.get("over", False)
    if reason:
        result = _unread(problems, hand_in.problem, reason)
    found = {} if said.get("again") else causes(problems, hand_in, bounds if over else None)
    return (
        hand_in.key,
        short(found) if found else "",
        json.dumps(found, sort_keys=True),
        {
            **result,
            "files": [file.name for file in hand_in.files],
            "left": list(hand_in.left),
            "late": hand_in.late,
            "reason": reason,
            "notes": [*result.get("faults", ()), *result.get("not_recognized", ())],
        },
    )


def _empty(row: Data) -> str:
    """Why a hand-in without any answer needs a human; an empty text where there is an answer."""
    if any(answer["verdict"] != "missing" for answer in row["answers"]):
        return ""
    lost = [f"not recognized: {text}" for text in row["not_recognized"][:MOST_LOST]]
    return "; ".join([*row["faults"], *lost]) or "no answer was found in it"


def _unread(problems: ProblemSet, stem: str, reason: str) -> Data:
    """The row of what could not be judged: unreadable, for a human to look at; missing without a reason."""
    from dynsolve.grading.teacher import bare_page

    item = problems.item(stem)
    html, markdown = bare_page(reason) if reason else ("", "")
    verdict = Verdict.UNREADABLE if reason else Verdict.MISSING
    blank = dict.fromkeys(("label", "message", "read_as", "note", "loss", "form", "basis"), "")
    unjudged = (JudgedAnswer(name, verdict, of=of) for name, of in item.problem.marks.items())
    marked = mark(unjudged, quantities(item.problem.robot), problems.policy)
    answers = [
        {
            **blank, "name": m.name, "verdict": str(verdict), "marks": "0", "of": str(m.of), "line": 0,
            "why": f"{m.why} ({reason})" if reason else m.why, "diagnosis": [], "fault": reason,
        }
        for m in marked
    ]  # fmt: skip
    return {"answers": answers, "html": html, "markdown": markdown}


# -- not handed in -----------------------------------------------------------------------------------


def rows_of_absent(problems: ProblemSet, intake: Intake, known: Mapping[Key, str]) -> Iterator[Row]:
    """The new rows of what was not handed in, or only in a form that waits for a human."""
    handed_in = {hand_in.key for hand_in in intake.hand_ins}
    reasons: dict[Key, list[str]] = {}
    for entry in intake.waiting:
        for stem in (entry.problem,) if entry.problem else problems.stems:
            reasons.setdefault((entry.student, stem), []).append(f"{entry.file}: {entry.reason}")
    missing = {item.stem: _not_judged(problems, item, [], 0) for item in problems.items}
    for student in intake.students:
        for item in problems.items:
            key = (student, item.stem)
            if key in handed_in:
                continue
            said = reasons.get(key, [])
            if len(said) > MOST_LOST + 1:
                said = [*said[:MOST_LOST], f"and {len(said) - MOST_LOST} more"]
            late = intake.late.get(key, 0)
            word, causes, row = _not_judged(problems, item, said, late) if said else missing[item.stem]
            if known.get(key) != word:
                yield key, word, causes, row


def _not_judged(problems: ProblemSet, item: Item, said: list[str], late: int) -> tuple[str, str, Data]:
    """The row of what was not handed in, or waits for a human: its fingerprint, its causes, what it holds."""
    found = {"hand-in": short([said, late]), "marks": of_marks(item), "program": program()}
    found["policy"] = of_policy(problems.policy)
    reason = "; ".join(said)
    row = _unread(problems, item.stem, reason)
    rest = {"files": [], "left": [], "late": late, "reason": reason, "notes": []}
    return short(found), json.dumps(found, sort_keys=True), {**row, **rest}
