"""The rows of the record: of what was judged, what could not be, and what was not handed in."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from dynsolve.answers.marking.marks import mark
from dynsolve.answers.verdict import JudgedAnswer, Verdict
from dynsolve.grading.fingerprints import causes, fingerprint, of_marks, of_policy, program, short
from dynsolve.grading.hand_ins import HandIn, Intake
from dynsolve.grading.pool import Bounds
from dynsolve.grading.problem_set import Item, ProblemSet
from dynsolve.grading.record import Key
from dynsolve.quantities.index import quantities

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
        fingerprint(found) if found else "",
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
    from dynsolve.grading.pages import bare_page

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
            said = _some_of(reasons.get(key, []))
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


def _some_of(said: list[str]) -> list[str]:
    """A few of many reasons, and how many more there are."""
    more = len(said) - MOST_LOST
    return said if more <= 1 else [*said[:MOST_LOST], f"and {more} more"]
