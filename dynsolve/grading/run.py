"""The run: everything that was handed in goes through the workers into the record, then out.

What a hand-in's result was made from is its fingerprint: its files, the problem, the
marks, the policy and the program.  Where that is in the record already nothing is
computed; so a run that was stopped goes on, and a regrade does only what is affected.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from dynsolve.answers.verdict import JudgedAnswer, Verdict
from dynsolve.errors import Finding, InputError
from dynsolve.grading.fingerprints import (
    causes,
    fingerprint,
    fingerprints,
    of_marks,
    of_policy,
    program,
    short,
    touches_marks_alone,
)
from dynsolve.grading.hand_ins import File, HandIn, Intake
from dynsolve.grading.marking import mark, rescored
from dynsolve.grading.policy import to_data
from dynsolve.grading.pool import Bounds
from dynsolve.grading.problem_set import Item, ProblemSet
from dynsolve.grading.record import Key, Record
from dynsolve.grading.uploads import Uploads, digest

Data = dict[str, Any]

AHEAD = 4
"""So many hand-ins a worker are under way or wait for one: memory does not grow with their number."""

PATIENCE = 10.0
"""Seconds in which nothing is done before the pool is asked whether it is still there."""

MOST_LOST = 3
"""So many equations that were not recognized are named where nothing was, and so many files."""

Advance = Callable[[int, int], None]


class Pool(Protocol):
    """What runs the work, on this machine or on a cluster."""

    @property
    def bounds(self) -> Bounds:
        """What one hand-in may use."""

    @property
    def jobs(self) -> int:
        """How many hand-ins are worked on at once."""

    def prepare(self, count: int) -> None:
        """Begin to start what so many hand-ins need, while there is something else to do."""

    def submit(self, payload: Data) -> Future[Data]:
        """A future of {"result": ...} or {"reason": ...}."""

    def check(self) -> None:
        """Called where nothing was done for a while; raises UsageError where nothing will be."""

    def close(self) -> None:
        """End all work."""


@dataclass(frozen=True, slots=True)
class Done:
    """How much a run had to do: all hand-ins, those that were judged, and those only marked anew."""

    hand_ins: int
    computed: int
    rescored: int


def grade_all(
    problems: ProblemSet,
    uploads: Uploads,
    intake: Intake,
    record: Record,
    pool: Pool,
    advance: Advance | None = None,
) -> Done:
    """Bring the record up to what was handed in; every hand-in is written when it is done.

    Raises KeyboardInterrupt after what is done was written.
    """
    record.set_intake(intake.students, intake.waiting)
    known = record.fingerprints()
    keys = {(h.student, h.problem) for h in intake.hand_ins}
    record.keep_only({(student, stem) for student in intake.students for stem in problems.stems})
    other = [
        h
        for h in intake.hand_ins
        if known.get((h.student, h.problem)) not in fingerprints(problems, h, pool.bounds)
    ]
    due = [hand_in for hand_in in other if not _is_rescored(record, problems, hand_in, pool.bounds)]
    pool.prepare(len(due))
    record.write_all(_absent(problems, intake, keys, known))
    running: dict[Future[Data], HandIn] = {}
    waiting = iter(due)
    done = 0
    while True:
        for hand_in in _some(waiting, AHEAD * pool.jobs - len(running)):
            running[_submitted(pool, problems, uploads, hand_in)] = hand_in
        if not running:
            break
        finished, _ = wait(running, timeout=PATIENCE, return_when=FIRST_COMPLETED)
        if not finished:
            pool.check()
        for future in finished:
            hand_in = running.pop(future)
            _write(record, problems, hand_in, future.result(), pool.bounds)
            done += 1
            if advance is not None:
                advance(done, len(due))
    return Done(len(intake.hand_ins), done, len(other) - len(due))


def _is_rescored(record: Record, problems: ProblemSet, hand_in: HandIn, bounds: Bounds) -> bool:
    """Mark a hand-in anew where its verdicts still hold; False where it must be judged."""
    key = (hand_in.student, hand_in.problem)
    old, kept = record.kept(key)
    new = causes(problems, hand_in, bounds if "bounds" in old else None)
    if not old or not touches_marks_alone(old, new) or not all(answer.basis for answer in kept):
        return False
    points = problems.item(hand_in.problem).problem.marks
    marks = rescored(kept, points, problems.policy, hand_in.late)
    record.rescore(key, fingerprint(new), json.dumps(new, sort_keys=True), marks)
    return True


def _submitted(pool: Pool, problems: ProblemSet, uploads: Uploads, hand_in: HandIn) -> Future[Data]:
    try:
        return pool.submit(payload(problems, uploads, hand_in))
    except InputError as error:  # a file that was there, or was another, a moment ago
        lost: Future[Data] = Future()
        lost.set_result({"reason": error.findings[0].message, "again": True})
        return lost


def _absent(
    problems: ProblemSet, intake: Intake, keys: set[Key], known: Mapping[Key, str]
) -> Iterator[tuple[Key, str, str, Data]]:
    """The new rows of what was not handed in, or only in a form that waits for a human."""
    reasons: dict[Key, list[str]] = {}
    for entry in intake.waiting:
        for stem in (entry.problem,) if entry.problem else problems.stems:
            reasons.setdefault((entry.student, stem), []).append(f"{entry.file}: {entry.reason}")
    missing = {item.stem: _not_judged(problems, "", item, []) for item in problems.items}
    for student in intake.students:
        for item in problems.items:
            key = (student, item.stem)
            if key in keys:
                continue
            said = _some_of(reasons.get(key, []))
            word, causes, row = _not_judged(problems, student, item, said) if said else missing[item.stem]
            if known.get(key) != word:
                yield key, word, causes, row


def _not_judged(problems: ProblemSet, student: str, item: Item, said: list[str]) -> tuple[str, str, Data]:
    """The row of what was not handed in, or waits for a human: its fingerprint, its causes, what it holds."""
    found = {"hand-in": short(said), "marks": of_marks(item), "program": program()}
    found["policy"] = of_policy(problems.policy)
    reason = "; ".join(said)
    row = _unread(problems, student, item.stem, reason)
    rest = {"files": [], "left": [], "late": False, "reason": reason, "notes": []}
    return short(found), json.dumps(found, sort_keys=True), {**row, **rest}


def _some_of(said: list[str]) -> list[str]:
    """A few of many reasons, and how many more there are."""
    more = len(said) - MOST_LOST
    return said if more <= 1 else [*said[:MOST_LOST], f"and {more} more"]


def _some(source: Iterator[HandIn], count: int) -> Iterator[HandIn]:
    for _, hand_in in zip(range(count), source, strict=False):
        yield hand_in


def payload(problems: ProblemSet, uploads: Uploads, hand_in: HandIn) -> Data:
    """What a worker needs, and nothing of this machine."""
    item = problems.item(hand_in.problem)
    return {
        "problem": {"file": Path(item.problem.file).name, "text": item.text},
        "marks": {name: str(of) for name, of in item.problem.marks.items()},
        "policy": to_data(problems.policy),
        "student": hand_in.student,
        "late": hand_in.late,
        "files": [
            {"name": file.name, "content": base64.b64encode(_same(uploads, file)).decode()}
            for file in hand_in.files
        ],
    }


def _same(uploads: Uploads, file: File) -> bytes:
    """The bytes of a file; raises InputError where they are others than when it was listed."""
    content = uploads.read(file.upload)
    if digest(content) != file.digest:
        message = "it was changed while it was graded: grade again"
        raise InputError([Finding(message, "", str(file.upload.path))])
    return content


def _write(record: Record, problems: ProblemSet, hand_in: HandIn, said: Data, bounds: Bounds) -> None:
    row = said.get("result", {})
    reason = said.get("reason", "") or _empty(row)
    over = "reason" in said or row.get("over", False)
    if reason:
        row = _unread(problems, hand_in.student, hand_in.problem, reason)
    found = {} if said.get("again") else causes(problems, hand_in, bounds if over else None)
    record.write(
        (hand_in.student, hand_in.problem),
        fingerprint(found) if found else "",
        json.dumps(found, sort_keys=True),
        {
            **row,
            "files": [file.name for file in hand_in.files],
            "left": list(hand_in.left),
            "late": hand_in.late,
            "reason": reason,
            "notes": [*row.get("faults", ()), *row.get("not_recognized", ())],
        },
    )


def _empty(row: Data) -> str:
    """Why a hand-in is for a human to look at in which no answer was found; nothing where there is one."""
    if any(answer["verdict"] != "missing" for answer in row["answers"]):
        return ""
    lost = [f"not recognized: {text}" for text in row["not_recognized"][:MOST_LOST]]
    return "; ".join([*row["faults"], *lost]) or "no answer was found in it"


def _unread(problems: ProblemSet, student: str, stem: str, reason: str) -> Data:
    """The row of what could not be judged: unreadable, for a human to look at; missing without a reason."""
    from dynsolve.grading.pages import bare_page

    item = problems.item(stem)
    html, markdown = bare_page(item.problem.title, student, reason) if reason else ("", "")
    verdict = Verdict.UNREADABLE if reason else Verdict.MISSING
    blank = dict.fromkeys(("label", "message", "read_as", "note", "loss", "form", "basis"), "")
    marked = mark((JudgedAnswer(n, verdict, of=of) for n, of in item.problem.marks.items()), problems.policy)
    answers = [
        {
            **blank, "name": m.name, "verdict": str(verdict), "marks": "0", "of": str(m.of), "line": 0,
            "why": f"{m.why} ({reason})" if reason else m.why, "diagnosis": [], "fault": reason,
        }
        for m in marked
    ]  # fmt: skip
    return {"answers": answers, "html": html, "markdown": markdown}
