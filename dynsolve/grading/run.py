"""The run: everything that was handed in goes through the workers into the record, then out.

What a hand-in's result was made from is its fingerprint: its files, the problem, the
marks, the policy and the program.  Where that is in the record already nothing is
computed; so a run that was stopped goes on, and a regrade does only what is affected.

The keys of the problems of which something waits, kept in the record for the page of the queue.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from functools import partial
from itertools import islice
from pathlib import Path, PurePath
from typing import Any, Protocol

from msgspec import Struct

from dynsolve.answers.marks import to_data
from dynsolve.answers.reading.sources import hidden
from dynsolve.errors import Finding, InputError
from dynsolve.grading.fingerprints import (
    causes,
    fingerprints,
    row_of_result,
    rows_of_absent,
    short,
    touches_marks_alone,
)
from dynsolve.grading.hand_ins import File, HandIn, Intake
from dynsolve.grading.pool import Bounds, program
from dynsolve.grading.record import Record, rescored
from dynsolve.grading.set_file import Item, ProblemSet
from dynsolve.grading.uploads import Uploads, digest
from dynsolve.grading.which_problem import CONVERTED, as_text
from dynsolve.quantities.index import quantities

Data = dict[str, Any]

AHEAD = 4
"""So many hand-ins a worker are under way or wait for one: memory does not grow with their number."""

PATIENCE = 10.0
"""Seconds in which nothing is done before the pool is asked whether it is still there."""

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


class Done(Struct, frozen=True):
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
    record.set_intake(intake.students, intake.waiting, intake.groups)
    record.set_uploads({hand_in.key: hand_in.paths for hand_in in intake.hand_ins})
    record.keep_only({(student, stem) for student in intake.students for stem in problems.stems})
    known, bounds = record.fingerprints(), pool.bounds
    changed = [h for h in intake.hand_ins if known.get(h.key) not in fingerprints(problems, h, bounds)]
    due = [hand_in for hand_in in changed if not _is_rescored(record, problems, hand_in, bounds)]
    pool.prepare(len(due))
    record.write_all(rows_of_absent(problems, intake, known))
    results = _results(pool, due, partial(_submitted, pool, problems, uploads))
    for done, (hand_in, said) in enumerate(results, 1):
        record.write(*row_of_result(problems, hand_in, said, bounds))
        if advance is not None:
            advance(done, len(due))
    return Done(len(intake.hand_ins), len(due), len(changed) - len(due))


def _results(
    pool: Pool, due: list[HandIn], submit: Callable[[HandIn], Future[Data]]
) -> Iterator[tuple[HandIn, Data]]:
    """Each hand-in with what the pool says of it, as soon as it is done."""
    running: dict[Future[Data], HandIn] = {}
    waiting = iter(due)
    while True:
        for hand_in in islice(waiting, max(AHEAD * pool.jobs - len(running), 0)):
            running[submit(hand_in)] = hand_in
        if not running:
            return
        finished, _ = wait(running, timeout=PATIENCE, return_when=FIRST_COMPLETED)
        if not finished:
            pool.check()
        for future in finished:
            yield running.pop(future), future.result()


def _is_rescored(record: Record, problems: ProblemSet, hand_in: HandIn, bounds: Bounds) -> bool:
    """Mark a hand-in anew where its verdicts still hold; False where it must be judged."""
    old, kept = record.kept(hand_in.key)
    new = causes(problems, hand_in, bounds if "bounds" in old else None)
    if not old or not touches_marks_alone(old, new) or not all(answer.basis for answer in kept):
        return False
    problem = problems.item(hand_in.problem).problem
    marks = rescored(kept, problem.marks, quantities(problem.robot), problems.policy)
    record.rescore(hand_in.key, short(new), json.dumps(new, sort_keys=True), marks)
    return True


def _submitted(pool: Pool, problems: ProblemSet, uploads: Uploads, hand_in: HandIn) -> Future[Data]:
    if problems.lacks_variant(hand_in.problem, hand_in.student):
        unknown: Future[Data] = Future()
        unknown.set_result({"reason": "no variant was drawn for this student", "again": True})
        return unknown
    try:
        return pool.submit(payload(problems, uploads, hand_in))
    except InputError as error:  # a file that was there, or was another, a moment ago
        lost: Future[Data] = Future()
        lost.set_result({"reason": error.findings[0].message, "again": True})
        return lost


def payload(problems: ProblemSet, uploads: Uploads, hand_in: HandIn) -> Data:
    """What a worker needs, independent of this machine."""
    return {
        **payload_of_problem(problems.item(hand_in.problem, hand_in.student)),
        "policy": to_data(problems.policy),
        "letters": problems.letters.get(hand_in.key, {}),
        "files": [
            {"name": name, "content": base64.b64encode(content).decode()}
            for name, content in (_own_part(file, _same(uploads, file)) for file in hand_in.files)
        ],
    }


def payload_of_problem(item: Item) -> Data:
    """What a worker needs of a problem."""
    return {
        "problem": {"file": Path(item.problem.file).name, "text": item.text},
        "marks": {name: str(of) for name, of in item.problem.marks.items()},
    }


def _own_part(file: File, content: bytes) -> tuple[str, bytes]:
    """A file without what it holds for other problems; a document then is the report that was made of it."""
    if not file.others:
        return file.name, content
    ending = PurePath(file.name).suffix.lower()
    text = hidden(as_text(content, ending), file.others)
    return f"{file.name}.md" if ending in CONVERTED else file.name, text.encode()


def _same(uploads: Uploads, file: File) -> bytes:
    """The bytes of a file; raises InputError where it has changed since it was listed."""
    content = uploads.read(file.upload)
    if digest(content) != file.digest:
        message = "it was changed while it was graded: grade again"
        raise InputError([Finding(message, "", str(file.upload.path))])
    return content


# The keys of the problems of which something waits, kept in the record for the page of the queue


def keep_keys(record: Record, problems: ProblemSet, stems: Iterable[str], pool: Pool) -> None:
    """Have the keys of these problems set, as far as the record has not those of today."""
    due = {stem: problems.item(stem) for stem in stems}
    due = {stem: item for stem, item in due.items() if _kept(record, stem).get("of") != _of(item)}
    asked = {stem: pool.submit({**payload_of_problem(item), "key": True}) for stem, item in due.items()}
    for stem, future in asked.items():
        data = {"of": _of(due[stem]), "keys": future.result().get("result", {})}
        record.set_run(f"key {stem}", json.dumps(data))


def kept_keys(record: Record, stem: str) -> dict[str, str]:
    """The keys of a problem's answers, in HTML, as far as they are known."""
    found: dict[str, str] = _kept(record, stem).get("keys", {})
    return found


def _kept(record: Record, stem: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(record.run(f"key {stem}") or "{}")
    return found


def _of(item: Item) -> str:
    return short([item.text, sorted(item.problem.marks), program()])
